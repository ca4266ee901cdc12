"""Paths of files: checked before anything is made, and named where a file cannot be written."""

from __future__ import annotations

from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from assur._arrays import short
from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator


def checked_path(path: Any, suffixes: Collection[str] = (), what: str = "path") -> Path:
    """Return a path whose ending is one of those known, if there are such."""
    try:
        checked = Path(path)
    except TypeError as error:
        message = f"{what} is {short(path)}: a path is needed"
        raise InputError(message) from error
    if suffixes and checked.suffix.lower() not in suffixes:
        known = ", ".join(suffixes)
        message = (
            f"{shown_path(checked)!r} ends in {checked.suffix!r}: the name must end in {known}"
        )
        raise InputError(message)
    return checked


def shown_path(path: Any) -> str:
    """Return a path as messages show it: even one that is not Unicode text can be printed."""
    return str(path).encode("utf-8", "backslashreplace").decode("utf-8")


def reason(error: Exception) -> str:
    """Return in words why a file cannot be read or written."""
    return str(getattr(error, "strerror", None) or error)


@contextmanager
def writing(path: Path) -> Iterator[None]:
    """Name the file if it cannot be written."""
    try:
        yield
    # A ValueError: a path with a NUL, or with half of a surrogate pair.
    except (OSError, ValueError) as error:
        message = f"{shown_path(path)}: cannot be written: {reason(error)}"
        raise InputError(message) from error
