"""A load of every kind, for tests that hold them all to the same laws; on a drag-link press."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, get_args

import assur
from assur import Body
from assur.dynamics.loads.loads import Load

if TYPE_CHECKING:
    from collections.abc import Iterable

KINDS: tuple[type, ...] = get_args(Load)
# The second crank turns with the first one, at another speed: beyond a turn its angle is what it
# has turned in all.
PRESS = assur.Mechanism(
    joints={"A": (0, 0), "B": (0.0, 0.15), "C": (0.17, 0.09), "D": (0.05, 0), "E": (0.5, 0)},
    links={
        "ground": "AD",
        "crank": "AB",
        "coupler": "BC",
        "second": "DC",
        "rod": "CE",
        "ram": "E",
    },
    driver="crank",
    slides={"bore": assur.Slide("ram", on="ground", angle=0.0, origin="A")},
)
BODIES = {
    "crank": Body(mass=0.7, inertia=0.05, at=(0.04, 0.01)),
    "second": Body(mass=0.9, inertia=0.03, at=(0.05, 0.01)),
    "rod": Body(mass=1.2, inertia=0.015, at=(0.12, -0.02)),
    "ram": Body(mass=2.0, inertia=0.0, at=(0.01, 0.03)),
}
EVERY_LOAD: dict[type, Load] = {
    assur.Gravity: assur.Gravity((0.5, -9.81)),
    assur.Force: assur.Force(("rod", (0.1, 0.02)), (30.0, lambda _t, _q, v: -v), axes="crank"),
    assur.Torque: assur.Torque("rod", lambda _t, _q, v: 3.0 - 0.2 * v, on="second"),
    assur.Pressure: assur.Pressure("bore", 1e-3, lambda _t, _q, v: 2e5 + 1e3 * v, "backward"),
    assur.Spring: assur.Spring("E", ("ground", (0.2, 0.3)), 300.0, 0.1, preload=2.0),
    assur.TorsionSpring: assur.TorsionSpring("second", 3.0, angle=0.2, on="rod", preload=-1.0),
    assur.Damper: assur.Damper(("rod", (0.1, 0.02)), ("ground", (0.2, 0.3)), 40.0),
    assur.TorsionDamper: assur.TorsionDamper("rod", 0.7, on="second"),
}


def missing(loads: Iterable[Any], kinds: Iterable[type] = KINDS) -> set[str]:
    """Names of the kinds of which there is none among loads."""
    there = tuple(loads)
    return {kind.__name__ for kind in kinds if not any(type(one) is kind for one in there)}
