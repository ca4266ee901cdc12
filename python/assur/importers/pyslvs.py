"""pyslvs: expressions, with the drivers given apart."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from assur._arrays import short
from assur.errors import InputError
from assur.importers.build import finish
from assur.importers.names import listed
from assur.importers.pyslvs_expression import Expression
from assur.importers.sketch import GROUND, Input, Sketch
from assur.importers.source import open_source

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from assur.importers.build import Imported
    from assur.importers.source import Source, SourceLike

__all__ = ["read"]


def read(
    source: SourceLike,
    *,
    drivers: Sequence[tuple[int, int]] = (),
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
        A text that is not an expression, with its line; drivers that turn nothing.
    StructureError
        A linkage that is not a mechanism.

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
    reader = Expression(opened)
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
        names = listed(sorted(both)) or "none"
        problem = f"one moving link must have joints {base} and {joint}, not {names}"
        raise source.error(place, problem, joint=joint)
    return Input(place, joint=base, link=both.pop())
