"""A file that has been read and parsed, and errors that say where in it."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

from assur._files import reason, shown_path
from assur.files.errors import FileError, file_name
from assur.files.lexer import line_and_column
from assur.files.limits import MOST_BYTES, beyond_limits
from assur.files.parser import loads
from assur.files.positions import key_positions
from assur.files.tree import Tree, shown, with_fields

if TYPE_CHECKING:
    from os import PathLike

    from assur.errors import AssurError
    from assur.files.positions import KeyPath

__all__ = ["Source"]

# How the parser ends its messages.
PLACE = re.compile(r" \(at (?:line (\d+), column (\d+)|end of document)\)$")
# What follows the first sign of equality of a line.
ASSIGNED = re.compile(r"[^=]*=\s*(.*)")


class Source(Tree):
    """A TOML file: its data, and where each key is.

    Parameters
    ----------
    path : path-like
        The file.
    raw : bytes, optional
        What is in it, if it has been read already.
    """

    def __init__(self, path: str | PathLike[str], raw: bytes | None = None) -> None:
        self.path = file_name(path)
        self.text = self._decoded(self._bytes() if raw is None else self._few(raw))
        self._positions: dict[KeyPath, int] | None = None
        excess = beyond_limits(self.text)
        if excess is not None:
            at, message = excess
            raise self._at(*line_and_column(self.text, at), message)
        super().__init__(self._parsed())

    def _bytes(self) -> bytes:
        try:
            with Path(self.path).open("rb") as file:
                raw = file.read(MOST_BYTES + 1)
        except (OSError, ValueError) as error:
            # A ValueError: a path with a NUL.
            message = f"{shown_path(self.path)}: cannot be read: {reason(error)}"
            raise FileError(message, path=self.path) from error
        return self._few(raw)

    def _few(self, raw: bytes) -> bytes:
        if len(raw) > MOST_BYTES:
            limit = f"{MOST_BYTES // 2**20} MiB, the limit of a file"
            message = f"{shown_path(self.path)}: is larger than {limit}"
            raise FileError(message, path=self.path)
        return raw

    def _decoded(self, raw: bytes) -> str:
        raw = raw.removeprefix(b"\xef\xbb\xbf")  # which some editors write first
        try:
            # The parser counts Windows' line end as one character; keys are at the same line and
            # column.
            return raw.decode("utf-8").replace("\r\n", "\n")
        except UnicodeDecodeError as error:
            before = raw[: error.start].decode("utf-8")
            message = f"byte 0x{raw[error.start]:02x} is not UTF-8: save the file as UTF-8"
            raise self._at(*line_and_column(before, len(before)), message) from error

    def _parsed(self) -> dict[str, Any]:
        try:
            return loads(self.text)
        except ValueError as error:
            message, place = str(error), PLACE.search(str(error))
            line, column = line_and_column(self.text, len(self.text))
            if place is not None:
                message = message[: place.start()]
                if place[1]:
                    line, column = int(place[1]), int(place[2])
            message = f"not TOML: {message[:1].lower()}{message[1:]}{self._hint(line)}"
            raise self._at(line, column, message) from error

    def _hint(self, line: int) -> str:
        """Return what may be meant by a line that is not TOML."""
        lines = self.text.split("\n")
        assigned = ASSIGNED.match(lines[line - 1]) if line <= len(lines) else None
        if assigned is None:
            known = "assur.importers.read reads files of other programs"
            return "" if "=" in self.text else f"; {known}"
        if assigned[1].startswith("("):
            return "; a place is written [0, 0]"
        return '; a text is written in quotes, "…"' if assigned[1][:1].isalpha() else ""

    def _at(self, line: int, column: int, message: str, key: str | None = None) -> FileError:
        named = f"{key}: " if key else ""
        message = f"{shown_path(self.path)}:{line}:{column}: {named}{message}"
        return FileError(message, path=self.path, line=line, column=column, key=key)

    def error(
        self, path: KeyPath, message: str, cause: AssurError | None = None, **fields: Any
    ) -> FileError:
        """Return the error of a key, with the fields of its cause."""
        if self._positions is None:
            self._positions = key_positions(self.text)
        known = path
        while known and known not in self._positions:
            known = known[:-1]
        line, column = line_and_column(self.text, self._positions.get(known, 0))
        return with_fields(self._at(line, column, message, shown(path)), cause, fields)
