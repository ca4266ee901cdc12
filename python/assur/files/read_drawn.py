"""Where a mechanism is drawn, if not in its drawing: an assembly that `assemblies` found."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.kinematics.assembly import SAME
from assur.kinematics.configuration import size_of
from assur.kinematics.model import AssemblyNumbers, Place, at_place
from assur.kinematics.solve import solve

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from assur._arrays import Float
    from assur.files.node import Node
    from assur.kinematics.mechanism import Mechanism
    from assur.kinematics.model import MechanismModel

REQUIRED = ("q", "joints", "angles")
OPTIONAL = ("signs", "class_angles", "slides", "is_double", "dimensions", "drawn")


def drawn_at(mechanism: Mechanism, section: Node, sized: Callable[[Node], Mechanism]) -> Mechanism:
    """Return the mechanism drawn where the section says.

    Parameters
    ----------
    mechanism : Mechanism
        As in its drawing, with its dimensions.
    section : Node
        The section "drawn".
    sized : callable
        Gives the mechanism with the dimensions of a section.
    """
    place = _place(mechanism, section, sized)
    base = place.mechanism
    with section.refusing():
        core = base.core.drawn_in(base.values.tolist(), list(place.q), place.numbers)
    drawn = at_place(mechanism, place, core)
    _check(at_place(base, place, core), place, section)
    return drawn


def _place(mechanism: Mechanism, section: Node, sized: Callable[[Node], Mechanism]) -> Place:
    entries = section.keys((*REQUIRED, *OPTIONAL), required=REQUIRED)
    design = mechanism
    if "dimensions" in entries:
        design = sized(entries["dimensions"])
    if design.shape:
        raise section.missing("dimensions", ": a batch is drawn at a place of one design")
    if "drawn" in entries:
        design = drawn_at(design, entries["drawn"], sized)
    q = np.atleast_1d(entries["q"].array())
    if q.shape != (mechanism.driver_count,):
        message = f"has {q.size} numbers: there are {mechanism.driver_count} drivers"
        raise entries["q"].error(message)
    core = mechanism.core
    numbers: AssemblyNumbers = {
        "signs": [int(x) for x in _named(section, "signs", [n for n, _ in core.assembly], _sign)],
        "class_angles": _class_angles(entries),
        "slides": _named(section, "slides", mechanism.slides, _number),
        "joints": _named(section, "joints", mechanism.joint_names, _pair),
        "angles": _named(section, "angles", mechanism.links, _number),
        "is_double": entries["is_double"].flag() if "is_double" in entries else False,
    }
    return Place(design, tuple(q.tolist()), numbers)


def _class_angles(entries: dict[str, Node]) -> list[float]:
    if "class_angles" not in entries:
        return []
    return [node.number() for node in entries["class_angles"].entries()]


def _number(node: Node) -> float:
    return node.number()


def _pair(node: Node) -> tuple[float, float]:
    return node.pair()


def _sign(node: Node) -> int:
    if (sign := node.whole()) not in (1, -1):
        raise node.error(f"is {sign}: it must be 1 or -1")
    return sign


def _named(section: Node, key: str, names: Iterable[str], read: Callable[[Node], Any]) -> list[Any]:
    """Return the values of all names, in their order."""
    names = list(names)
    if key not in section.value:
        if names:
            raise section.missing(key)
        return []
    entries = section.table()[key].keys(names, required=names)
    return [read(entries[name]) for name in names]


def _check(drawn: MechanismModel, place: Place, section: Node) -> None:
    """Refuse a place in which the mechanism does not fit together."""
    motion = solve(drawn, drawn.q0, order=0, on_error="nan")
    targets: Float = np.array(place.numbers["joints"]).reshape(-1, 2)
    there = np.array([motion.joint(name).value for name in drawn.joint_names]).reshape(-1, 2)
    # The comparison is false for NaN.
    if not bool((np.abs(there - targets) <= SAME * size_of(drawn)).all()):
        message = (
            "does not fit the dimensions: leave it to save(), or leave it out, and draw the "
            "mechanism in [joints]"
        )
        raise section.error(message)
