"""A value of a file with its key, read as the expected type or refused with its place."""

from __future__ import annotations

import datetime as dt
import difflib
import math
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from assur._arrays import real_array, short
from assur.errors import AssurError, DimensionError, InputError, StructureError
from assur.files.errors import FileError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from assur._arrays import Float
    from assur.files.positions import KeyPath
    from assur.files.tree import Tree


@dataclass(frozen=True, slots=True)
class Node:
    """A value, the path of its key, and the file."""

    source: Tree
    path: KeyPath
    value: Any

    def error(self, message: str, **fields: Any) -> FileError:
        """Return an error at this key."""
        return self.source.error(self.path, message, **fields)

    def missing(self, key: str, why: str = "") -> FileError:
        """Return the error of a key that this table lacks."""
        return self.source.error((*self.path, key), f"is missing{why}")

    def wrong(self, needed: str) -> FileError:
        """Return the error of a value of another type."""
        return self.error(f"is {described(self.value)}: {needed} is needed")

    @contextmanager
    def refusing(self, locate: Callable[[AssurError], KeyPath] | None = None) -> Iterator[None]:
        """Raise what Python refuses as an error of this key, or of the key that `locate` gives."""
        try:
            yield
        except FileError:
            raise
        except (DimensionError, InputError, StructureError) as error:
            path = self.path if locate is None else locate(error)
            raise self.source.error_of(path, error) from error

    # -- tables ------------------------------------------------------------------------------

    def table(self) -> dict[str, Node]:
        """Return the entries of a table."""
        if not isinstance(self.value, dict):
            raise self.wrong("a table")
        return {k: Node(self.source, (*self.path, k), v) for k, v in self.value.items()}

    def keys(self, known: Iterable[str], required: Iterable[str] = ()) -> dict[str, Node]:
        """Return the entries of a table that has no other keys, and all that are required."""
        entries, known = self.table(), list(known)
        for key, node in entries.items():
            if key not in known:
                raise node.error(f"unknown key{near(key, known)}; known are {', '.join(known)}")
        for key in required:
            if key not in entries:
                raise self.missing(key)
        return entries

    # -- lists -------------------------------------------------------------------------------

    def entries(self, needed: str = "a list") -> list[Node]:
        """Return the entries of a list."""
        if not isinstance(self.value, list):
            raise self.wrong(needed)
        return [Node(self.source, (*self.path, i), v) for i, v in enumerate(self.value)]

    def names(self) -> list[str]:
        """Return a list of names."""
        return [node.text() for node in self.entries('a list of names, ["A", "B"],')]

    def pair(self) -> tuple[float, float]:
        """Return two numbers."""
        nodes = self.entries("a list of two numbers, [x, y],")
        if len(nodes) != 2:
            message = f"has {len(nodes)} entries: two numbers, [x, y], are needed"
            raise self.error(message)
        return nodes[0].number(), nodes[1].number()

    # -- single values -----------------------------------------------------------------------

    def number(self) -> float:
        """Return a finite number."""
        if isinstance(self.value, bool) or not isinstance(self.value, int | float):
            raise self.wrong("a number")
        number = float(self.value)
        if not math.isfinite(number):
            message = f"is {described(number)}: a finite number is needed"
            raise self.error(message, value=number)
        return number

    def whole(self) -> int:
        """Return a whole number."""
        if isinstance(self.value, bool) or not isinstance(self.value, int):
            raise self.wrong("a whole number")
        return self.value

    def text(self) -> str:
        """Return a string."""
        if not isinstance(self.value, str):
            raise self.wrong("a text in quotes")
        return self.value

    def flag(self) -> bool:
        """Return true or false."""
        if not isinstance(self.value, bool):
            raise self.wrong("true or false")
        return self.value

    def word(self, known: Iterable[str]) -> str:
        """Return one of some words."""
        word, known = self.text(), list(known)
        if word not in known:
            message = f"is {short(word)}{near(word, known)}; known are {', '.join(known)}"
            raise self.error(message)
        return word

    def array(self, finite: bool = True) -> Float:
        """Return a number, or nested lists of numbers, as an array."""
        if not isinstance(self.value, list):
            return real_array(self.number(), "it")
        self._check_numbers(finite)
        try:
            return real_array(self.value, "it")
        except InputError as error:
            # All entries are numbers, so it is the shape.
            message = "its lists have different lengths: one number for each design is needed"
            raise self.error(message) from error

    def _check_numbers(self, finite: bool) -> None:
        if set(map(type, self.value)) == {float} and (not finite or all_finite(self.value)):
            return
        for node in self.entries():
            if isinstance(node.value, list):
                node._check_numbers(finite)
            elif finite or not isinstance(node.value, float):
                node.number()


def all_finite(values: list[float]) -> bool:
    """Whether no number is infinite or NaN."""
    return all(map(math.isfinite, values))


def near(word: str, known: Iterable[str]) -> str:
    """Return a question that suggests what was meant, or nothing."""
    plain = {candidate.lower(): candidate for candidate in known}
    matches = difflib.get_close_matches(word.lower(), plain, n=1)
    return f"; did you mean {plain[matches[0]]}?" if matches else ""


def described(value: Any) -> str:
    """Return the type of a TOML value, for a message."""
    if isinstance(value, dict):
        return "a table"
    if isinstance(value, list):
        return f"a list of {len(value)}" if value else "an empty list"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, dt.date | dt.time):
        return "a date or time"
    if isinstance(value, float) and not math.isfinite(value):
        return "NaN" if math.isnan(value) else "infinite"
    return f"the text {short(value)}" if isinstance(value, str) else short(value)
