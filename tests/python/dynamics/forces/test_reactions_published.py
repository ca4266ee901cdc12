"""Reactions that others have published, by the library and by the oracle."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import assur
from assur import Body
from models.machines.published_machines import Printed, Published, published
from oracles.dynamics.reaction_view import View

PUBLISHED = {case.name: case for case in published()}


def library(machine: Any, *where: Any) -> Any:
    return machine.reactions(*where)


Solver = Any
both = pytest.mark.parametrize("solve", [View, library])


@both
@pytest.mark.parametrize("name", PUBLISHED)
def test_published(name: str, solve: Solver) -> None:
    case = PUBLISHED[name]
    found = solve(case.machine, case.q, case.speed, 0.0)
    for printed in case.printed:
        value = np.asarray(asked(found, printed), np.float64)
        wanted = np.asarray(printed.value, np.float64)
        if not printed.signed:
            value = np.abs(value)
        assert np.abs(value - wanted).max() <= printed.within, (printed.what, value)


def asked(found: Any, printed: Printed) -> Any:
    kind, *names = printed.what
    if kind == "driver":
        return found.driver
    if kind == "normal":
        return found.slide(*names).normal
    force = found.joint(names[0], on=names[1])
    return np.hypot(*force) if kind == "size" else force


@pytest.mark.parametrize("name", PUBLISHED)
def test_effort(name: str) -> None:
    """The drive by power alone."""
    case: Published = PUBLISHED[name]
    machine: Any = case.machine
    where = case.q, case.speed, 0.0
    by_balance = machine.reactions(*where).driver
    assert abs(machine.effort(*where) - by_balance) <= 1e-11 * max(1.0, abs(by_balance))


@both
def test_whipping(solve: Solver) -> None:
    """Khurmi, A Textbook of Machine Design, chapter 32: greatest whipping moment 51.3 N·m.

    A uniform rod of 1.64 kg/m, l = 380 mm, r = 95 mm, 1800 rpm.  The book takes the piston's end
    to be at rest and the crankpin's to have ω² r across the rod: the load grows along the rod and
    its greatest moment is m ω² r l / (9 √3), at l / √3 from the piston.
    """
    r, length, mass, omega = 0.095, 0.38, 1.64 * 0.38, 2 * math.pi * 1800 / 60
    classical = mass * omega**2 * r * length / (9 * math.sqrt(3.0))
    assert abs(classical - 51.3) < 0.05
    rocker = assur.Mechanism(
        joints={"O": (0, 0), "E": (length, 0)},
        links={"ground": ["O"], "rod": ["O", "E"]},
        driver="rod",
    )
    machine = assur.Machine(
        rocker, bodies={"rod": Body(mass=mass, inertia=mass * length**2 / 12, at=(length / 2, 0.0))}
    )
    alpha = omega**2 * r / length
    found = solve(machine, 0.0, 0.0, alpha)
    # two pins carry the rod, no couple: the driver's is a pair of forces at its ends
    pin = found.joint("O", on="rod")[1] - found.driver / length
    x = length / math.sqrt(3.0)
    moment = pin * x - mass / length * alpha * x**3 / 6
    assert abs(moment - classical) < 1e-9 * classical
    assert abs(moment - 51.3) < 0.05


BALANCES: dict[str, tuple[float, float, float, float, float, float]] = {
    # crank, reciprocating, rotating mass, fraction, radius of the balance mass, its mass
    "sarthaks 491921": (0.15, 50.0, 37.0, 2 / 3, 0.4, 26.38),
    "Illustration 1, page 310": (0.09, 120.0, 70.0, 2 / 3, 0.15, 90.0),
}


@pytest.mark.parametrize("name", BALANCES)
def test_partial_balance(name: str) -> None:
    """B b = (m + c m_rec) r, to the printed digits.

    sarthaks.com/491921; FOSSEE's companion of a textbook on machines, chapter 12, illustration 1.
    """
    r, reciprocating, rotating, fraction, radius, printed = BALANCES[name]
    assert abs((rotating + fraction * reciprocating) * r / radius - printed) < 0.01


@both
def test_residue(solve: Solver) -> None:
    """The residual force of the second engine at 30°, a long rod: printed 3263.971 N.

    The source takes 57.3° for a radian; a yoke stands for the long rod.
    """
    r, omega = 0.09, 2 * math.pi * 250 / 60
    yoke = assur.Mechanism(
        joints={"O": (0, 0), "A": (r, 0), "Y": (0.3, 0)},
        links={"ground": ["O"], "crank": ["O", "A"], "block": ["A"], "yoke": ["Y"]},
        slides={
            "across": assur.Slide("block", on="yoke", angle=math.pi / 2),
            "bore": assur.Slide("yoke", on="ground", angle=0.0),
        },
        driver="crank",
    )
    # the rotating mass and the balance mass opposite: one body with their moment
    mass, moment = 70.0 + 90.0, 70.0 * r - 90.0 * 0.15
    bodies = {
        "crank": Body(mass=mass, inertia=0.0, at=(moment / mass, 0.0)),
        "yoke": Body(mass=120.0),
    }
    q = np.array([30.0 / 57.3, math.radians(30.0)])
    force = solve(assur.Machine(yoke, bodies=bodies), q, omega, 0.0).shaking_force
    size = np.hypot(force[:, 0], force[:, 1])
    assert abs(size[0] - 3263.971) < 0.00051
    assert abs(size[1] - 3264.065) < 0.00051
