"""Where the keys of a TOML text are: maintained parsers do not say."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

from assur.files.lexer import Token, tokens
from assur.files.parser import loads

if TYPE_CHECKING:
    from collections.abc import Iterator

# Keys and, within lists, indices.
KeyPath: TypeAlias = tuple[str | int, ...]


def key_positions(text: str) -> dict[KeyPath, int]:
    """Return the offset of every key and of every entry of a list in a text that is valid TOML."""
    return _Reader(text).positions


class _Reader:
    """Reads statements one after another; the text has been parsed, so nothing can be wrong."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.positions: dict[KeyPath, int] = {}
        # Number of tables in each array of tables.
        self.counts: dict[KeyPath, int] = {}
        self.rest: Iterator[Token] = (t for t in tokens(text) if t.kind != "comment")
        self.token: Token | None = next(self.rest, None)
        table: KeyPath = ()
        while self.token is not None:
            if self.token.kind == "newline":
                self.advance()
            elif self.token.kind == "[":
                table = self.header()
            else:
                self.pair(table)

    def advance(self) -> Token:
        """Return the token and go to the next."""
        token = self.token
        self.token = next(self.rest, None)
        return token if token is not None else Token("newline", len(self.text), len(self.text))

    @property
    def kind(self) -> str:
        return "newline" if self.token is None else self.token.kind

    def header(self) -> KeyPath:
        """Read [a.b] or [[a.b]], and return the path of the table."""
        bracket = self.advance()
        is_array = self.kind == "[" and self.token is not None and self.token.start == bracket.end
        if is_array:
            self.advance()
        parts = self.key()
        path: KeyPath = ()
        for number, (part, start) in enumerate(parts):
            path = (*path, part)
            self.positions.setdefault(path, start)
            if is_array and number == len(parts) - 1:
                self.counts[path] = self.counts.get(path, 0) + 1
            if path in self.counts:
                path = (*path, self.counts[path] - 1)
                self.positions.setdefault(path, start)
        while self.kind == "]":
            self.advance()
        return path

    def key(self) -> list[tuple[str, int]]:
        """Read a dotted key: its parts with their offsets."""
        parts: list[tuple[str, int]] = []
        while self.kind in ("word", "string", "."):
            kind, start, end = self.advance()
            if kind != ".":
                raw = self.text[start:end]
                parts.append((raw if kind == "word" else loads(f"k={raw}")["k"], start))
        return parts

    def pair(self, table: KeyPath) -> None:
        """Read key = value."""
        path = table
        for part, start in self.key():
            path = (*path, part)
            self.positions.setdefault(path, start)
        self.advance()  # =
        self.value(path)

    def value(self, path: KeyPath) -> None:
        """Read a value; the depth of brackets is limited before."""
        opening = self.kind
        if opening not in ("[", "{"):
            while self.kind not in (",", "]", "}", "newline"):
                self.advance()
            return
        self.advance()
        index = 0
        while self.kind not in ("]", "}"):
            if self.kind in (",", "newline"):
                self.advance()
            elif opening == "{":
                self.pair(path)
            else:
                assert self.token is not None
                self.positions[(*path, index)] = self.token.start
                self.value((*path, index))
                index += 1
        self.advance()
