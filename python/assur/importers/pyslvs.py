"""pyslvs: expressions ``M[J[R, P[x, y], L[ground, L1]], ...]``, with the drivers given apart.

J is a joint: its type R, P or RP, for P and RP the direction A of the guide in degrees, perhaps a
color, its place P and its links L. The first link of a P or RP joint carries the guide.
"""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any

from assur._arrays import short
from assur.errors import InputError
from assur.importers.build import finish
from assur.importers.names import listed
from assur.importers.sketch import GROUND, Input, Sketch
from assur.importers.source import open_source

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from assur.importers.build import Imported
    from assur.importers.source import Source, SourceLike

__all__ = ["read"]

BLANK = re.compile(r"\s+")
TOKEN = re.compile(r"[A-Za-z_][A-Za-z0-9_-]*|[-+.0-9][-+.0-9eE]*|[\[\](),]")


def read(
    source: SourceLike,
    drivers: Sequence[tuple[int, int]] = (),
    *,
    scale: float = 1.0,
    assembly: Mapping[str, int] | None = None,
) -> Imported:
    """Read an expression of pyslvs.

    Parameters
    ----------
    source : str or path-like
        The expression, or a file with it.
    drivers : sequence of (int, int)
        For every driver the joint about which it turns and another joint of the link that it
        turns, counted from 0; twice the same joint drives the slide there.
    scale : float
        The unit of length, m.
    assembly : mapping of str to int, optional
        For dyads drawn with their links collinear: see `Mechanism`.

    Returns
    -------
    Imported
        Joints are P0, P1 and so on, as pyslvs counts them.

    Raises
    ------
    InputError
        What is no expression, with its line; drivers that turn nothing.
    StructureError
        What is no mechanism.

    Examples
    --------
    >>> from assur import importers
    >>> found = importers.pyslvs.read('''M[
    ...     J[R, P[0, 0], L[ground, crank]],
    ...     J[R, P[0, 1], L[crank, rod]],
    ...     J[RP, A[0], P[3, 0], L[ground, rod]],
    ... ]''', drivers=[(0, 1)])
    >>> found.mechanism.structure.formula
    'I(crank) → II(rod, P2_block)'
    """
    opened = open_source(source)
    sketch = Sketch()
    reader = _Reader(opened)
    kinds = []
    for count, (line, kind, angle, at, links) in enumerate(reader.joints()):
        opened.require_few(count)
        _add(opened, sketch, f"line {line}", f"P{count}", kind, angle, at, links)
        kinds.append(kind)
    for driver in _pairs(drivers, len(kinds)):
        sketch.inputs.append(_input(opened, sketch, driver))
    if not sketch.inputs:
        problem = "an expression of pyslvs names no driver: give drivers=[(0, 1)], or as it may be"
        raise opened.error("", problem)
    return finish(opened, sketch, "pyslvs", scale, assembly)


def is_text(text: str) -> bool:
    """Whether a text begins as an expression."""
    return re.match(r"\s*M\s*\[", _without_comments(text[:100_000])) is not None


def _pairs(drivers: Any, count: int) -> list[tuple[int, int]]:
    try:
        pairs = [tuple(pair) for pair in drivers]
    except TypeError:
        pairs = [()]
    for pair in pairs:
        whole = all(isinstance(i, int) and not isinstance(i, bool) for i in pair)
        if len(pair) != 2 or not whole or not all(0 <= i < count for i in pair):
            needed = f"pairs of joints from 0 to {count - 1} are needed"
            message = f"drivers is {short(drivers)}: {needed}"
            raise InputError(message)
    return [(base, joint) for base, joint in pairs]


def _add(
    source: Source,
    sketch: Sketch,
    place: str,
    name: str,
    kind: str,
    angle: float | None,
    at: tuple[float, float],
    links: list[str],
) -> None:
    sketch.joints[name] = at
    if kind == "R" or len(links) < 2:
        for link in links:
            sketch.connect(name, link)
        return
    if angle is None:
        raise source.error(place, f"sliding joint {name} has no angle A[...]", joint=name)
    if kind == "P" and len(links) > 2:
        problem = f"sliding joint {name} has {len(links)} links, {listed(links)}: two are needed"
        raise source.error(place, problem, joint=name)
    sketch.links.setdefault(links[0], [])
    turned = math.radians(math.remainder(angle, 360.0))
    sketch.add_slot(name, links[0], links[1:], turned, turns=kind == "RP")


def _input(source: Source, sketch: Sketch, driver: tuple[int, int]) -> Input:
    base, joint = (f"P{number}" for number in driver)
    place = f"driver {driver}"
    if base == joint:
        for name, slot in sketch.slots.items():
            if slot.joint == joint:
                return Input(place, slide=name)
        raise source.error(place, f"joint {joint} does not slide", joint=joint)
    both = set(sketch.links_at(base)) & set(sketch.links_at(joint)) - {GROUND}
    if len(both) != 1:
        found = listed(sorted(both)) or "none"
        problem = f"one moving link must have joints {base} and {joint}, not {found}"
        raise source.error(place, problem, joint=joint)
    return Input(place, joint=base, link=both.pop())


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


class _Reader:
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

    def _wrong(self, wanted: str) -> InputError:
        found = short(self._token) if self._token else "the end"
        return self._source.error(f"line {self.line}", f"{wanted} is needed here, not {found}")

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
