"""The grammar of pyslvs: ``M[J[R, A[angle], color[Green], P[x, y], L[ground, L1]], ...]``.

J is a joint: its type R, P or RP, for P and RP the direction A of the guide in degrees, perhaps a
color, its place P and its links L. The first link of a P or RP joint carries the guide.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from assur._arrays import short

if TYPE_CHECKING:
    from collections.abc import Iterator

    from assur.errors import InputError
    from assur.importers.source import Source

BLANK = re.compile(r"\s+")
TOKEN = re.compile(r"[A-Za-z_][A-Za-z0-9_-]*|[-+.0-9][-+.0-9eE]*|[\[\](),]")


def is_text(text: str) -> bool:
    """Whether a text begins as an expression."""
    return re.match(r"\s*M\s*\[", _without_comments(text[:100_000])) is not None


def _without_comments(text: str) -> str:
    """Remove ``# ...`` and ``#[ ... #]``, each to the end of its line; lines keep their numbers."""
    kept, position, last = [], 0, text.rfind("#]")
    while (start := text.find("#", position)) >= 0:
        kept.append(text[position:start])
        inside = start
        if text.startswith("#[", start) and start < last:
            inside = text.index("#]", start)
            kept.append("\n" * text.count("\n", start, inside))
        end = text.find("\n", inside)
        position = len(text) if end < 0 else end
    return "".join([*kept, text[position:]])


class Expression:
    """The grammar of an expression."""

    def __init__(self, source: Source) -> None:
        self._source = source
        self._text = _without_comments(source.text)
        self._position = 0
        self._token = ""
        self._start = 0
        self._next()

    @property
    def line(self) -> int:
        """The line of the present token."""
        return self._text.count("\n", 0, self._start) + 1

    def joints(self) -> Iterator[tuple[int, str, float | None, tuple[float, float], list[str]]]:
        """Return line, type, angle, place and links of every joint."""
        self._open("M")
        while self._token != "]":
            line = self.line
            yield (line, *self._joint())
            if self._token != "]":
                self._take(",")
        self._take("]")
        if self._token:
            raise self._wrong("the end")

    def _joint(self) -> tuple[str, float | None, tuple[float, float], list[str]]:
        self._open("J")
        kind, angle = self._token, None
        if kind not in ("R", "P", "RP"):
            raise self._wrong("R, P or RP")
        self._next()
        self._take(",")
        if self._token == "A":
            (angle,) = self._numbers("A", 1)
            self._take(",")
        if self._token == "color":
            self._color()
            self._take(",")
        x, y = self._numbers("P", 2)
        self._take(",")
        links = self._links()
        self._take("]")
        return kind, angle, (x, y), links

    def _numbers(self, name: str, count: int) -> list[float]:
        self._open(name)
        numbers = []
        for index in range(count):
            if index:
                self._take(",")
            place = f"line {self.line}"
            numbers.append(self._source.number(self._token, place, f"{name}[...]"))
            self._next()
        self._take("]")
        return numbers

    def _color(self) -> None:
        self._open("color")
        while self._token not in ("]", ""):
            self._next()
        self._take("]")

    def _links(self) -> list[str]:
        self._open("L")
        names: list[str] = []
        while self._token != "]":
            if not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", self._token):
                raise self._wrong("the name of a link")
            names.append(self._token)
            self._next()
            if self._token != "]":
                self._take(",")
        self._take("]")
        return list(dict.fromkeys(names))

    def _open(self, name: str) -> None:
        self._take(name)
        self._take("[")

    def _take(self, token: str) -> None:
        if self._token != token:
            raise self._wrong(repr(token))
        self._next()

    def _wrong(self, needed: str) -> InputError:
        token = short(self._token) if self._token else "the end"
        return self._source.error(f"line {self.line}", f"{needed} is needed here, not {token}")

    def _next(self) -> None:
        text = self._text
        blank = BLANK.match(text, self._position)
        self._start = blank.end() if blank else self._position
        if self._start >= len(text):
            self._token, self._position = "", len(text)
            return
        token = TOKEN.match(text, self._start)
        self._token = token[0] if token else text[self._start]
        self._position = self._start + len(self._token)
