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
    assert not found.locked
    assert len(found.solutions) == 1
    mechanism: Any = engine().mechanism
    without = Machine(mechanism, loads=engine().loads)
    np.testing.assert_allclose(without.reactions(math.radians(degrees)).driver, bare, rtol=1e-9)
    # The power balance.
    loss = sum(found.losses.values())
    assert abs(found.driver * speed - (bare * speed + loss)) < 1e-6 * abs(bare)
    # At rest, about to move that way, the forces are the same.
    still = engine().reactions(math.radians(degrees), sense=speed)
    assert still.driver == found.driver
    assert sum(still.losses.values()) == 0.0


# q°, driver without friction, driver, normal, moment, force of the pin A on the rod
TILTED = [
    (30, 7.270878542, 12.21205949, -47.25098634, -15.95207273, (-380.0520171, -94.69187080)),
    (120, -102.6600835, -93.18189385, 278.5340453, -17.18767972, (1442.530405, -524.3862856)),
    (300, 46.26587741, 53.50398516, -94.94613252, -15.42242212, (399.2307443, 340.7983729)),
]


@pytest.mark.parametrize("case", TILTED, ids=str)
def test_a_tilted_piston_with_masses(case: Any) -> None:
    degrees, bare, driver, normal, moment, pin = case
    bodies = {"rod": Body(mass=1.2, inertia=0.015, at=(0.12, 0.0)), "piston": Body(mass=2.0)}
    load = Force(("piston", (0.03, 0.02)), (-800.0, 0.0))
    one = assur.SliderCrank(crank=0.1, rod=0.35)
    friction: Any = {**ENGINE_FRICTION, "bore": SlideFriction(0.1, 0.06)}
    found = Machine(one, bodies=bodies, loads=[load], friction=friction).reactions(
        math.radians(degrees), 60.0
    )
    np.testing.assert_allclose(found.driver, driver, rtol=1e-9)
    guide = found.slide("bore")
    np.testing.assert_allclose([guide.normal, guide.moment], [normal, moment], rtol=1e-9)
    np.testing.assert_allclose(found.joint("A", on="rod"), pin, rtol=1e-9)
    without = Machine(one, bodies=bodies, loads=[load]).reactions(math.radians(degrees), 60.0)
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
        slides={"way": assur.Slide("block", "ground", angle=0.0)},
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
    assert none.locked
    assert np.isnan(none.driver)
    assert none.solutions == ()
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


def degrees_of(intervals: list[Any]) -> Any:
    """All of them as ends within a turn from 0°, ascending."""
    both = np.degrees(np.concatenate(intervals))
    turns = np.floor(both[:, :1] / 360.0 + 1e-9)
    both = both - 360.0 * turns
    return both[np.argsort(both[:, 0])]


def test_a_rocker_that_drives_holds_near_the_dead_points() -> None:
    numbers = (1.0, 4.5, 1.5, 4.9), (0.04, 0.03, 0.03, 0.04)
    held = [four_bar(torque, *numbers).self_locking() for torque in (100.0, -100.0)]
    assert all(one.locked.size == 0 for one in held)
    ends = degrees_of([one.holding for one in held])
    # Either torque drives on one side of a dead point: together they hold it on both.
    joined = [ends[0, 0], ends[1, 1], ends[2, 0], ends[3, 1]]
    known = [11.32576989, 19.14528813, 182.4061261, 192.7240218]
    # Known to their last digits.
    np.testing.assert_allclose(joined, known, rtol=0, atol=6e-8)
    np.testing.assert_allclose([ends[0, 1], ends[2, 1]], [ends[1, 0], ends[3, 0]], atol=1e-9)


def test_a_piston_that_drives_does_not_start_near_the_dead_points() -> None:
    held = [engine().self_locking(sense=sense).holding for sense in (1, -1)]
    ends = np.degrees(np.concatenate(held)).ravel()
    ends = ends[np.argsort(abs((ends + 90.0) % 360.0 - 90.0))]
    near = abs((ends + 180.0) % 360.0 - 180.0)
    # 0° and 180° themselves end an interval on each side.
    np.testing.assert_allclose(sorted(near[near < 90.0])[-2:], [1.981592570] * 2, atol=1e-8)
    far = 180.0 - near[near > 90.0]
    np.testing.assert_allclose(sorted(far)[-2:], [2.649633689] * 2, atol=1e-8)


def test_locked_interval_of_the_crank_rocker() -> None:
    machine = four_bar(-100.0, (1.0, 4.5, 1.5, 4.985), (0.1, 0.1, 0.1, 0.1))
    found = machine.self_locking(between=(math.pi - 0.5, math.pi + 0.5))
    edge = 0.0825900520399
    assert any(
        abs(low - (math.pi - edge)) < 1e-10 and abs(high - math.pi) < 1e-10
        for low, high in found.locked
    )


# Coupler, rocker; ρ at B, C, D; limits on the outer side at s = ±1, on the inner side.
LIMITS = [
    ((4.5, 1.5), (0.75 * math.sin(0.2),) * 3, (0.26627160962, 0.0), (0.2, 0.06627160962)),
    ((4.5, 1.5), (0.1, 0.1, 0.1), (0.17819067879, 0.0), (0.13373158941, 0.04445908938)),
    (
        (4.0, 2.5),
        (0.06, 0.08, 0.05),
        (0.08703061300, -0.01700030885),
        (0.04702344239, 0.02300686176),
    ),
    (
        (2.5, 3.5),
        (0.15, 0.05, 0.1),
        (0.12295585328, 0.05429687459),
        (0.08288094760, 0.09437178027),
    ),
]
ZONES = [
    (4.04451986348, 4.96022164888),
    (4.02002286869, 4.98216023333),
    (2.50735130846, 5.49417466047),
    (2.03820516736, 4.98898011617),
]


@pytest.mark.parametrize("case", range(4))
def test_exact_limits_of_the_transmission_angle(case: int) -> None:
    (coupler, rocker), (b, c, d), outer, inner = LIMITS[case]
    find: Any = assur.crank_rocker.least_transmission_angle
    limits = [
        find(1.0, c, 1.0, d, rocker, f_b=1.0, r_b=b, coupler=coupler, exact=True, side=side)
        for side in ("outer", "inner")
    ]
    np.testing.assert_allclose(limits, [max(outer), max(inner)], rtol=0, atol=1e-11)
    zone = assur.crank_rocker.ground_range
    ends = [zone(coupler, rocker, margin=0.0, gamma_min=limit) for limit in limits]
    np.testing.assert_allclose([ends[1][0], ends[0][1]], ZONES[case], rtol=0, atol=1e-10)
    # The solver agrees: a crank passes a little inside the zone, and jams a little outside.
    for part, jams in ((-1e-9, False), (1e-9, True)):
        ground = ends[0][1] * (1.0 + part)
        locked = []
        for torque in (-100.0, 100.0):
            machine = four_bar(torque, (1.0, coupler, rocker, ground), (0.0, b, c, d))
            at = math.pi + np.array([-1e-13, -1e-10, -1e-7, 1e-7, 1e-10, 1e-13])
            locked.append(machine.reactions(at, 1.0, on_error="nan").locked)
        assert np.any(locked) == jams, (part, locked)


@pytest.mark.parametrize("side", ["outer", "inner"])
@pytest.mark.parametrize("case", range(4))
def test_the_solver_locks_at_the_exact_limit(case: int, side: Any) -> None:
    """The transmission angle at the extreme at which no solution is left, by bisection."""
    (coupler, rocker), (b, c, d), *_ = LIMITS[case]
    limit = assur.crank_rocker.least_transmission_angle(
        1.0, c, 1.0, d, rocker, f_b=1.0, r_b=b, coupler=coupler, exact=True, side=side
    )
    squares, product = coupler**2 + rocker**2, 2 * coupler * rocker
    sign = 1.0 if side == "outer" else -1.0
    # At the extreme itself coupler and rocker rest in C; beside it by 1e-8 γ is the same.
    at = (math.pi if side == "outer" else 0.0) + np.array([-1e-8, 1e-8])

    def locks(gamma: float) -> bool:
        ground = math.sqrt(squares + sign * product * math.cos(gamma)) - sign
        return any(
            four_bar(torque, (1.0, coupler, rocker, ground), (0.0, b, c, d))
            .reactions(at, 1.0)
            .locked.any()
            for torque in (-100.0, 100.0)
        )

    low, high = 0.9 * limit, 1.1 * limit
    assert locks(low)
    assert not locks(high)
    for _ in range(45):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if locks(middle) else (low, middle)
    assert abs(low - limit) <= 1e-12
