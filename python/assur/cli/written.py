"""Files that are written: refused before the work if they cannot be, and never in part."""

from __future__ import annotations

import os
import secrets
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Iterator


@contextmanager
def replacing(path: str) -> Iterator[Path]:
    """Yield a file beside `path` that replaces it at the end, or not at all."""
    target = Path(os.path.realpath(path))
    if target.exists() and not target.is_file():
        # A device or a named pipe.
        yield target
        return
    temporary = target.with_name(f".assur-{secrets.token_hex(4)}")
    try:
        try:
            yield temporary
            with suppress(OSError):
                temporary.chmod(target.stat().st_mode & 0o777)
            temporary.replace(target)
        except OSError as error:
            raise cannot_write(path, error) from error
    finally:
        with suppress(OSError):
            temporary.unlink()


def require_writable(path: str) -> None:
    """Refuse a file that cannot be written, before the work whose result it takes."""
    try:
        target = Path(os.path.realpath(path))
        if target.is_dir():
            raise IsADirectoryError(None, "it is a directory")
        if target.exists():
            if not os.access(target, os.W_OK):
                raise PermissionError(None, "it is write-protected")
            if not target.is_file():
                return
        probe = target.with_name(f".assur-{secrets.token_hex(4)}")
        probe.open("xb").close()
        probe.unlink()
        with suppress(FileNotFoundError):
            target.lstat()  # refuses a name that is too long
    except (OSError, ValueError) as error:
        raise cannot_write(path, error) from error


def refuse_same(path: str, source: str) -> None:
    """Refuse to overwrite the input."""
    is_same = False
    with suppress(OSError, ValueError):
        is_same = Path(path).samefile(source)
    if is_same:
        message = f"{path} is the file that is read: name another"
        raise InputError(message)


def cannot_write(path: str, error: Exception) -> InputError:
    """Return the error of a file."""
    why = getattr(error, "strerror", None) or error
    return InputError(f"{path}: cannot be written: {why}")
