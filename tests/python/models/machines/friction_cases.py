"""Machines with Coulomb friction in their pairs, and their reactions to ten digits.

Found twice: in body coordinates with multipliers, friction as loads; and link by link in closed
form with Newton's method.  A journal's friction moment is coefficient × radius × pair force; a
slide's friction is coefficient × max(|normal|, 2 |moment| / length).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import assur
from assur import Body, Force, Torque

if TYPE_CHECKING:
    from collections.abc import Mapping


@dataclass(frozen=True)
class Journal:
    """Friction of a pin: the links, and coefficient and radius."""

    link: str
    other: str
    coefficient: float
    radius: float


@dataclass(frozen=True)
class Bearing:
    """Friction of a slide: coefficient and length, centred on the sliding point."""

    coefficient: float
    length: float


@dataclass(frozen=True)
class FrictionCase:
    """A machine without friction, its friction, where it is, and what is known of it."""

    name: str
    machine: assur.Machine
    friction: Mapping[str, Journal | Bearing]
    q: float
    speed: float
    driver: float
    efficiency: float | None = None
    forces: Mapping[str, Any] = field(default_factory=dict)  # "normal bore", "A on rod" …


ENGINE: dict[str, Journal | Bearing] = {
    "O": Journal("crank", "ground", 0.08, 0.02),
    "A": Journal("rod", "crank", 0.08, 0.025),
    "B": Journal("piston", "rod", 0.08, 0.012),
    "bore": Bearing(0.1, 0.06),
}
LINKAGE: dict[str, Journal | Bearing] = {
    "A": Journal("crank", "ground", 0.1, 0.4),
    "B": Journal("coupler", "crank", 0.1, 0.3),
    "C": Journal("rocker", "coupler", 0.1, 0.3),
    "D": Journal("rocker", "ground", 0.1, 0.4),
}

# degrees, speed, driver, efficiency, normal, moment: 800 N on the piston, no masses
PUSHED = (
    (60, 1, -74.33975914, 0.9351252958, 192.3701292, 0.7719481170),
    (150, 1, -26.92104636, 0.8973682118, 111.4692941, -0.7648221677),
    (250, 1, 72.4977057, 0.9317434993, -232.0803164, -0.8210849956),
    (60, -1, -85.08696765, 0.9343041933, 217.2690956, -0.8159666669),
    (150, -1, -33.18998836, 0.9038870298, 119.6612467, 0.7879066886),
    (250, -1, 62.91605592, 0.9314099123, -214.5038736, 0.7752565643),
)
# degrees, driver, normal, moment, force at A on the rod: with masses, the load beside the pin
RUNNING = (
    (30, 12.21205949, -47.25098634, -15.95207273, (-380.0520171, -94.69187080)),
    (120, -93.18189385, 278.5340453, -17.18767972, (1442.530405, -524.3862856)),
    (300, 53.50398516, -94.94613252, -15.42242212, (399.2307443, 340.7983729)),
)
# degrees, torque on the rocker, driver, efficiency, force at C on the rocker (speed 1)
ROCKING = (
    (60, -100, 61.37704075, 0.8686412748, (-70.35785624, -9.040379995)),
    (160, -100, 70.58505385, 0.7726652003, (-151.9175903, -8.487205070)),
    (300, 100, 76.08447432, 0.8902646401, (61.35973845, 35.93560700)),
    (60, 100, -45.94690523, 0.8618066828, None),
    (160, 100, -41.86218809, 0.7675696984, None),
    (300, -100, -60.14207879, 0.8878983862, None),
)


def friction_cases() -> list[FrictionCase]:
    m = assur.SliderCrank(0.1, 0.35)
    pushed = assur.Machine(m, loads=[Force(("piston", (0.0, 0.0)), (-800.0, 0.0))])
    out = [
        FrictionCase(
            f"pushed {degrees} {speed:+d}",
            pushed,
            ENGINE,
            math.radians(degrees),
            float(speed),
            driver,
            efficiency,
            {"normal bore": normal, "moment bore": moment},
        )
        for degrees, speed, driver, efficiency, normal, moment in PUSHED
    ]
    bodies = {"rod": Body(mass=1.2, inertia=0.015, at=(0.12, 0.0)), "piston": Body(mass=2.0)}
    running = assur.Machine(
        m, bodies=bodies, loads=[Force(("piston", (0.03, 0.02)), (-800.0, 0.0))]
    )
    out += [
        FrictionCase(
            f"running {degrees}",
            running,
            ENGINE,
            math.radians(degrees),
            60.0,
            driver,
            None,
            {"normal bore": normal, "moment bore": moment, "A on rod": force},
        )
        for degrees, driver, normal, moment, force in RUNNING
    ]
    linkage = assur.FourBar(1.0, 4.5, 1.5, 4.9)
    out += [
        FrictionCase(
            f"rocking {degrees} {torque:+d}",
            assur.Machine(linkage, loads=[Torque("rocker", float(torque))]),
            LINKAGE,
            math.radians(degrees),
            1.0,
            driver,
            efficiency,
            {} if force is None else {"C on rocker": force},
        )
        for degrees, torque, driver, efficiency, force in ROCKING
    ]
    return out
