"""Files that pictures are written to."""

from __future__ import annotations

from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator


def checked_path(path: Any, suffixes: Iterable[str]) -> Path:
    """Return a path whose ending is one of those known."""
    try:
        own = Path(path)
    except TypeError as error:
        message = f"path is {type(path).__name__}: the name of a file is needed"
        raise InputError(message) from error
    known = list(suffixes)
    if own.suffix.lower() not in known:
        message = f"{str(path)!r}: the name must end in {', '.join(known)}"
        raise InputError(message)
    return own


@contextmanager
def writing(path: Path) -> Iterator[None]:
    """Name the file if it cannot be written."""
    try:
        yield
    except OSError as error:
        message = f"{path}: cannot be written: {error.strerror or error}"
        raise InputError(message) from error
