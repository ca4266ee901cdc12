"""Linkages that the core found as mechanisms with names that users read."""

from __future__ import annotations

from string import ascii_uppercase
from typing import TYPE_CHECKING, TypeAlias

from assur.errors import InputError
from assur.kinematics.mechanism import Mechanism

if TYPE_CHECKING:
    from collections.abc import Iterator

# Joints with their places, the traced one last; links with their joints, ground and crank first.
Drawn: TypeAlias = tuple[list[tuple[str, float, float]], list[tuple[str, list[str]]]]

GROUND, CRANK = "ground", "crank"


# A crank with a point on it: where a name is wrong, this is refused as every linkage would be.
SMALLEST: Drawn = (
    [("A", 0.0, 0.0), ("B", 1.0, 0.0), ("P", 1.0, 1.0)],
    [(GROUND, ["A"]), (CRANK, ["A", "B", "P"])],
)


def check_name(joint: str) -> None:
    """Refuse a name that the traced joint cannot have."""
    if joint in (GROUND, CRANK):
        message = f"targets: {joint!r} is a link of every linkage: call the traced joint otherwise"
        raise InputError(message, joint=joint)
    mechanism_of(SMALLEST, joint)


def mechanism_of(drawn: Drawn, traced: str) -> Mechanism:
    """Return the mechanism; links but ground and crank are called by their joints."""
    joints, links = drawn
    free = _letters(traced)
    names = {joint: next(free) for joint, _, _ in joints[:-1]}
    names[joints[-1][0]] = traced
    # Letters one after another are read as such, other names are not.
    between = "" if all(len(name) == 1 for name in names.values()) else "_"
    members = {}
    for link, on in links:
        own = [names[joint] for joint in on]
        name = link if link in (GROUND, CRANK) else between.join(own[:2])
        members[f"{name}_" if name == traced else name] = own
    return Mechanism({names[joint]: (x, y) for joint, x, y in joints}, members, CRANK)


def _letters(taken: str) -> Iterator[str]:
    """Yield A to Z, then A2 to Z2 and so on, without the name that is taken."""
    number = 1
    while True:
        for letter in ascii_uppercase:
            name = letter if number == 1 else f"{letter}{number}"
            if name != taken:
                yield name
        number += 1
