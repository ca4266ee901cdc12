"""Friction in pairs: worked cases with numbers by two formulations, and the law itself."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import assur
from assur import Body, Force, JointFriction, Machine, SlideFriction, Torque

CIRCLES = {"O": (0.08, 0.02), "A": (0.08, 0.025), "B": (0.08, 0.012)}
ENGINE_FRICTION = {name: JointFriction(*numbers) for name, numbers in CIRCLES.items()}


def engine(**more: Any) -> Machine:
    """A slider-crank without masses, loaded at the piston."""
    return Machine(
        assur.SliderCrank(crank=0.1, rod=0.35),
        loads=[Force("B", (-800.0, 0.0), on="piston")],
        friction={**ENGINE_FRICTION, "bore": SlideFriction(0.1, 0.06)},
        **more,
    )


# q°, sense, driver without friction, driver, efficiency, normal, moment
ENGINE = [
    (60, 1, -79.49711067, -74.33975914, 0.9351252958, 192.3701292, 0.7719481170),
    (150, 1, -30.0, -26.92104636, 0.8973682118, 111.4692941, -0.7648221677),
    (250, 1, 67.549266, 72.4977057, 0.9317434993, -232.0803164, -0.8210849956),
    (60, -1, -79.49711067, -85.08696765, 0.9343041933, 217.2690956, -0.8159666669),
    (150, -1, -30.0, -33.18998836, 0.9038870298, 119.6612467, 0.7879066886),
    (250, -1, 67.549266, 62.91605592, 0.9314099123, -214.5038736, 0.7752565643),
]


@pytest.mark.parametrize("case", ENGINE, ids=str)
def test_slider_crank(case: tuple[float, ...]) -> None:
    degrees, speed, bare, driver, efficiency, normal, moment = case
    found = engine().reactions(math.radians(degrees), speed)
    np.testing.assert_allclose(found.driver, driver, rtol=1e-9)
    np.testing.assert_allclose(found.efficiency, efficiency, rtol=1e-9)
    guide = found.slide("bore")
    np.testing.assert_allclose([guide.normal, guide.moment], [normal, moment], rtol=1e-9)
    assert not found.locked and len(found.solutions) == 1
    without = Machine(engine().mechanism, loads=engine().loads)
    np.testing.assert_allclose(without.reactions(math.radians(degrees)).driver, bare, rtol=1e-9)
    # The power balance.
    loss = sum(found.losses.values())
    assert abs(found.driver * speed - (bare * speed + loss)) < 1e-6 * abs(bare)
    # At rest, about to move that way, the forces are the same.
    still = engine().reactions(math.radians(degrees), sense=speed)
    assert still.driver == found.driver and sum(still.losses.values()) == 0.0


# q°, driver without friction, driver, normal, moment, force of the pin A on the rod
TILTED = [
    (30, 7.270878542, 12.21205949, -47.25098634, -15.95207273, (-380.0520171, -94.69187080)),
    (120, -102.6600835, -93.18189385, 278.5340453, -17.18767972, (1442.530405, -524.3862856)),
    (300, 46.26587741, 53.50398516, -94.94613252, -15.42242212, (399.2307443, 340.7983729)),
]


@pytest.mark.parametrize("case", TILTED, ids=str)
def test_a_tilted_piston_with_masses(case: Any) -> None:
    degrees, bare, driver, normal, moment, pin = case
    bodies = {"rod": Body(1.2, 0.015, (0.12, 0.0)), "piston": Body(2.0)}
    load = Force(("piston", (0.03, 0.02)), (-800.0, 0.0))
    one = assur.SliderCrank(crank=0.1, rod=0.35)
    friction = {**ENGINE_FRICTION, "bore": SlideFriction(0.1, 0.06)}
    found = Machine(one, bodies, [load], friction=friction).reactions(math.radians(degrees), 60.0)
    np.testing.assert_allclose(found.driver, driver, rtol=1e-9)
    guide = found.slide("bore")
    np.testing.assert_allclose([guide.normal, guide.moment], [normal, moment], rtol=1e-9)
    np.testing.assert_allclose(found.joint("A", on="rod"), pin, rtol=1e-9)
    without = Machine(one, bodies, [load]).reactions(math.radians(degrees), 60.0)
    np.testing.assert_allclose(without.driver, bare, rtol=1e-9)


FOUR_BAR = [
    (60, -100, 53.31463093, 61.37704075, 0.8686412748, (-70.35785624, -9.040379995)),
    (160, -100, 54.53861477, 70.58505385, 0.7726652003, (-151.9175903, -8.487205070)),
    (300, 100, 67.73531715, 76.08447432, 0.8902646401, (61.35973845, 35.93560700)),
]
REVERSED = {60: (-45.94690523, 0.8618066828), 160: (-41.86218809, 0.7675696984)}
REVERSED[300] = (-60.14207879, 0.8878983862)


def four_bar(torque: float, lengths: Any, circles: Any) -> Machine:
    friction = {
        name: JointFriction(1.0, circle)
        for name, circle in zip("ABCD", circles, strict=True)
        if circle > 0.0
    }
    return Machine(assur.FourBar(*lengths), loads=[Torque("rocker", torque)], friction=friction)


@pytest.mark.parametrize("case", FOUR_BAR, ids=str)
def test_four_bar(case: Any) -> None:
    degrees, torque, _, driver, efficiency, force = case
    numbers = (1.0, 4.5, 1.5, 4.9), (0.04, 0.03, 0.03, 0.04)
    found = four_bar(torque, *numbers).reactions(math.radians(degrees), 1.0)
    np.testing.assert_allclose(found.driver, driver, rtol=1e-9)
    np.testing.assert_allclose(found.efficiency, efficiency, rtol=1e-9)
    np.testing.assert_allclose(found.joint("C", on="rocker"), force, rtol=1e-9)
    driver, efficiency = REVERSED[degrees]
    found = four_bar(-torque, *numbers).reactions(math.radians(degrees), 1.0)
    np.testing.assert_allclose(found.driver, driver, rtol=1e-9)
    np.testing.assert_allclose(found.efficiency, efficiency, rtol=1e-9)


def test_two_solutions_or_none() -> None:
    one = assur.Mechanism(
        joints={"O": (0, 0), "A": (0, 0.1), "B": (0.15, -0.2)},
        links={"ground": "O", "crank": "OA", "rod": "AB", "block": "B"},
        slides={"way": assur.Slide("block", "ground", 0.0)},
        driver="crank",
    )

    def pressed(q: float) -> Machine:
        friction = {"way": SlideFriction(0.6, 1.0)}
        return Machine(one, loads=[Force("B", (-q, 300.0), on="block")], friction=friction)

    found = pressed(100.0).reactions(one.q0, -1.0)
    assert len(found.solutions) == 2
    first, second = found.solutions
    np.testing.assert_allclose(first.driver, -12.72727273, rtol=1e-9)
    np.testing.assert_allclose(first.slide("way").normal, -45.45454545, rtol=1e-9)
    np.testing.assert_allclose(second.driver, -40.0, rtol=1e-9)
    np.testing.assert_allclose(second.slide("way").normal, 500.0, rtol=1e-9)
    assert first.driver == found.driver
    none = pressed(160.0).reactions(one.q0, -1.0)
    assert none.locked and np.isnan(none.driver) and none.solutions == ()
    assert none.safety < 1.0 < found.safety


def test_locked_beside_the_stretched_position() -> None:
    """P5's crank-rocker is locked on one side of it, though γ is never below P5's limit."""
    machine = four_bar(-100.0, (1.0, 4.5, 1.5, 4.985), (0.1, 0.1, 0.1, 0.1))
    # P5 counts the crank's angle from that position, clockwise.
    edge = 0.0825900520399

    def at(phi: Any) -> Any:
        return machine.reactions(math.pi - np.asarray(phi), 1.0)

    assert at([1e-9, 0.5 * edge, edge * (1 - 1e-9)]).locked.all()
    assert not at([-1e-9, edge * (1 + 1e-9), 1.5 * edge]).locked.any()
    np.testing.assert_allclose(
        abs(at([-0.02, 1.5 * edge]).driver), [91.44838124, 1221.754320], rtol=1e-9
    )
