"""Requests: JSON of a page, read field by field or refused."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NoReturn

import numpy as np

from assur.errors import InputError
from assur.files.node import Node
from assur.files.tree import Tree
from assur.studio.limits import KIB, MOST_ROWS, MOST_UP

if TYPE_CHECKING:
    from collections.abc import Iterable

    from assur._arrays import Float
    from assur.kinematics.mechanism import Mechanism

ENVELOPE = ("id", "rev", "kind")
MOST_ID = 2**53


@dataclass(frozen=True)
class Request:
    """A request: `rev` is the page's revision of its document; both numbers come back as sent."""

    id: int
    rev: int
    kind: str
    fields: dict[str, Any]


class MalformedError(InputError):
    """A message that is not a request; `id` is its own as far as it has one."""

    def __init__(self, message: str, identifier: int | None = None) -> None:
        super().__init__(message, kind="malformed")
        self.id = identifier


def parse(text: str | bytes) -> Request:
    """Return the request of a message.

    Raises
    ------
    MalformedError
        What is not JSON, too long, or has no id, rev and kind.
    """
    if len(text if isinstance(text, bytes) else text.encode(errors="replace")) > MOST_UP:
        message = f"a message may have {MOST_UP // KIB} KiB: this document is too large"
        raise MalformedError(message)
    try:
        data = json.loads(text, parse_constant=_refuse)
    except RecursionError as error:
        message = "not JSON as needed: it is nested too deeply"
        raise MalformedError(message) from error
    except ValueError as error:
        message = f"not JSON: {error}"
        raise MalformedError(message) from error
    if not isinstance(data, dict):
        message = "a message is a JSON object with id, rev and kind"
        raise MalformedError(message)
    number = data.get("id")
    identifier = number if _is_whole(number) else None
    for key in ("id", "rev"):
        if not _is_whole(data.get(key)):
            message = f"{key}: a whole number is needed"
            raise MalformedError(message, identifier)
    if not isinstance(data.get("kind"), str):
        message = "kind: a text is needed"
        raise MalformedError(message, identifier)
    rest = {key: value for key, value in data.items() if key not in ENVELOPE}
    return Request(data["id"], data["rev"], data["kind"], rest)


def _refuse(word: str) -> NoReturn:
    message = f"{word} is not a JSON number"
    raise ValueError(message)


def _is_whole(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and abs(value) < MOST_ID


class Fields:
    """The fields of a request of one kind: no others, each read as what it must be."""

    def __init__(
        self, data: dict[str, Any], known: Iterable[str], required: Iterable[str] = ()
    ) -> None:
        self._node = Node(Tree(data), (), data)
        self._entries = self._node.keys(known, required)

    def __contains__(self, name: str) -> bool:
        """Whether a field is given; null is not."""
        return name in self._entries and self._entries[name].value is not None

    def __getitem__(self, name: str) -> Any:
        """Return a field as it was sent."""
        return self._entries[name].value if name in self._entries else None

    def node(self, name: str) -> Node:
        """Return a field with its key, for what reads it further."""
        if name not in self:
            raise self._node.missing(name)
        return self._entries[name]

    def error(self, name: str, message: str, **fields: Any) -> InputError:
        """Return the error of a field."""
        return Node(self._node.source, (name,), None).error(message, **fields)

    def number(self, name: str, default: float | None = None) -> float:
        """Return a finite number."""
        return default if default is not None and name not in self else self.node(name).number()

    def optional(self, name: str) -> float | None:
        """Return a finite number, or None."""
        return self.node(name).number() if name in self else None

    def whole(self, name: str, default: int, low: int, high: int) -> int:
        """Return a whole number within limits."""
        if name not in self:
            return default
        number = self.node(name).whole()
        if not low <= number <= high:
            raise self.error(name, f"is {number}: {low} to {high} is needed")
        return number

    def rows(self, default: int, name: str = "rows") -> int:
        """Return a number of rows."""
        return self.whole(name, default, 3, MOST_ROWS)

    def word(self, name: str, known: Iterable[str], default: str | None = None) -> str:
        """Return one of some words."""
        if default is not None and name not in self:
            return default
        return self.node(name).word(known)

    def text(self, name: str) -> str:
        """Return a text."""
        return self.node(name).text()

    def flag(self, name: str) -> bool:
        """Return whether a switch is on."""
        return self.node(name).flag() if name in self else False

    def pair(self, name: str) -> tuple[float, float]:
        """Return two numbers."""
        return self.node(name).pair()

    def drivers(self, name: str, mechanism: Mechanism, default: float | None = None) -> Any:
        """Return a number for each driver: for one driver a number, else an array."""
        count = mechanism.driver_count
        if name not in self:
            if default is None:
                return np.asarray(mechanism.q0) if count > 1 else mechanism.q0
            return default if count == 1 else np.full(count, default)
        numbers: Float = self.node(name).array()
        if numbers.shape != (() if count == 1 else (count,)):
            needed = "a number" if count == 1 else f"a list of {count} numbers, one of each driver,"
            raise self.error(name, f"{needed} is needed")
        return float(numbers) if count == 1 else numbers
