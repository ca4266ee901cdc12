"""Files that pictures are written to."""

from __future__ import annotations

from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from assur._arrays import short
from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator


def checked_path(path: Any, suffixes: Collection[str] = ()) -> Path:
    """Return a path whose ending is one of those known, if there are such."""
    try:
        own = Path(path)
    except TypeError as error:
        message = f"path is {short(path)}: a path is needed"
        raise InputError(message) from error
    if suffixes and own.suffix.lower() not in suffixes:
        message = f"{str(own)!r} ends in {own.suffix!r}: the name must end in {', '.join(suffixes)}"
        raise InputError(message)
    return own


@contextmanager
def writing(path: Path) -> Iterator[None]:
    """Name the file if it cannot be written."""
    try:
        yield
    except (OSError, ValueError) as error:
        message = f"{path}: cannot be written: {getattr(error, 'strerror', None) or error}"
        raise InputError(message) from error
