"""The error of a file: its place and its cause."""

from __future__ import annotations

import os
from typing import Any

from assur._arrays import short
from assur.errors import InputError

__all__ = ["FileError"]


class FileError(InputError):
    """A file that cannot be read or written, or does not describe a mechanism.

    It has the fields of the error that the same words raise in Python (`kind`, `joint`, `link` …),
    which is its ``__cause__``, and:

    Attributes
    ----------
    path : str or None
        The file, as it was given.
    line, column : int or None
        The place, counted from 1; None if the file cannot be opened at all.
    key : str or None
        The key, such as ``"links.crank"`` or ``"loads[0].at"``; None if the text is not TOML.

    Examples
    --------
    >>> import assur
    >>> assur.load("missing.toml")
    Traceback (most recent call last):
    ...
    assur.files.errors.FileError: missing.toml: cannot be read: No such file or directory
    """

    def __init__(
        self,
        message: str = "",
        *,
        path: str | None = None,
        line: int | None = None,
        column: int | None = None,
        key: str | None = None,
        **fields: Any,
    ) -> None:
        super().__init__(message, **fields)
        self.path = path
        self.line = line
        self.column = column
        self.key = key


def file_name(path: Any) -> str:
    """Return the name of a file."""
    try:
        return os.fsdecode(path)
    except TypeError as error:
        message = f"path is {short(path)}: the name of a file is needed"
        raise InputError(message) from error
