"""What a request may use beside its own fields: the file given, and the time it has."""

from __future__ import annotations

import hashlib
import os
import time
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from assur.errors import InputError
from assur.files.errors import FileError
from assur.files.limits import MOST_BYTES
from assur.studio.limits import SECONDS

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    import numpy.typing as npt


@dataclass(frozen=True)
class Answer:
    """What a kind answers: fields of the header, and arrays by name."""

    header: dict[str, Any]
    arrays: Mapping[str, npt.NDArray[Any]] = field(default_factory=dict)


class TimeIsUpError(InputError):
    """A computation took longer than a request may."""

    def __init__(self, seconds: float) -> None:
        message = f"this takes longer than {seconds:g} s, the limit of a request"
        super().__init__(message, kind="time_limit", hint="ask for fewer rows, cells or turns")


class Deadline:
    """When a request must be done. Loops call `check`."""

    def __init__(self, seconds: float = SECONDS) -> None:
        self.seconds = seconds
        self._end = time.monotonic() + seconds

    def left(self) -> float:
        """Return the seconds left; at least one millisecond, which ends what takes a limit."""
        return max(self._end - time.monotonic(), 1e-3)

    def check(self) -> None:
        """Raise when time is up."""
        if time.monotonic() > self._end:
            raise TimeIsUpError(self.seconds)


@dataclass(frozen=True)
class Given:
    """What the command named: a file, or an example. No other file is ever opened."""

    path: Path | None = None
    example: str | None = None

    @property
    def title(self) -> str:
        """Its name on the page."""
        return self.path.name if self.path is not None else str(self.example)

    @property
    def id(self) -> str:
        """What distinguishes it from other files and examples, for what a browser keeps of it."""
        source = f"example:{self.example}" if self.path is None else os.path.realpath(self.path)
        return stamp_of(os.fsencode(source))

    @property
    def is_saved(self) -> bool:
        """Whether the page may save to it: files of other programs are only read."""
        return self.path is not None and self.path.suffix.lower() == ".toml"

    def bytes(self) -> bytes:
        """Return the contents of the file."""
        assert self.path is not None
        try:
            with self.path.open("rb") as file:
                return file.read(MOST_BYTES + 1)
        except OSError as error:
            message = f"{self.path.name}: cannot be read: {error.strerror or error}"
            raise FileError(message, path=self.path.name) from error


def stamp_of(raw: bytes) -> str:
    """Return what distinguishes one content of a file from another."""
    return hashlib.sha256(raw).hexdigest()[:16]


@dataclass(frozen=True)
class Session:
    """What a request may use."""

    given: Given | None
    deadline: Deadline
    # Other pages that have the file given open.
    others: int = 0
