"""Every row of a run has the acceleration of its own state; where it jumps, that before it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import assur
from assur import Body, Force, JointFriction, Machine, SlideFriction, Table, Torque, events

INERTIA = 0.5
TURN = math.tau
WHEEL = assur.FourBar(1.0, 3.0, 3.0, 3.0)
BODIES = {"crank": Body(inertia=INERTIA)}
# The greatest distance of a row from the knot that ends it, rad.
AT_KNOT = 1e-9

KNOTS = np.array([0.0, 0.7, 1.9, 1.9, 3.3, 5.0, TURN])
TORQUES = np.array([1.0, 4.0, -1.5, 2.5, 3.0, -2.0, 1.0])


def torque_before(q: Any) -> Any:
    """Return the table's value; at a jump, of two rows at one coordinate, that of the first."""
    x = np.mod(q, TURN)
    x = np.where((x < AT_KNOT) & (q > AT_KNOT), TURN, x)
    high = np.clip(np.searchsorted(KNOTS, x - AT_KNOT), 1, None)
    part = (x - KNOTS[high - 1]) / (KNOTS[high] - KNOTS[high - 1])
    return TORQUES[high - 1] + part * (TORQUES[high] - TORQUES[high - 1])


@pytest.mark.parametrize("rtol", [1e-4, 1e-8, 1e-12])
def test_rows_at_knots_and_jumps_have_the_torque_before_them(rtol: float) -> None:
    machine = Machine(
        WHEEL, bodies=BODIES, loads=[Torque("crank", Table(KNOTS, TORQUES, spline="linear"))]
    )
    run = machine.run(t_end=9.0, q0=0.2, speed0=3.0, rtol=rtol)
    at_knot = np.abs(np.mod(run.q[:, None], TURN) - KNOTS).min(axis=1) < AT_KNOT
    assert at_knot.sum() > 15
    expected = torque_before(run.q) / INERTIA
    assert np.abs(run.acceleration - expected).max() < 2e-12
    assert np.abs(run.at(run.t).acceleration - expected).max() < 2e-12
    over = machine.run(q_end=20.0, q0=0.2, speed0=3.0, rtol=rtol)
    assert np.abs(over.acceleration - torque_before(over.q) / INERTIA).max() < 2e-12


def test_rows_at_knots_of_a_motor_have_its_torque() -> None:
    speeds, torques = [0.0, 2.0, 3.0, 5.0, 9.0], [8.0, 6.0, 7.0, 2.0, 0.0]
    motor = Table(speeds, torques, spline="linear", periodic=False)
    run = Machine(WHEEL, bodies=BODIES, motor=motor).run(t_end=2.0, q0=0.0, speed0=0.5, rtol=1e-5)
    assert np.isclose(run.speed[:, None], speeds[1:4], atol=1e-12).any(axis=0).all()
    expected = np.interp(run.speed, speeds, torques) / INERTIA
    assert np.abs(run.acceleration - expected).max() < 1e-12


def test_the_last_row_at_an_event_has_the_acceleration_there() -> None:
    load = Torque("crank", lambda t, q, w: math.cos(3.0 * q) + w + t)
    machine = Machine(WHEEL, bodies=BODIES, loads=[load])
    for place in (0.02, 0.3, 1.3, 2.9):
        at = events.Position(place, stop=True)
        run = machine.run(t_end=9.0, q0=0.0, speed0=1.0, events=[at], rtol=1e-4)
        expected = (np.cos(3.0 * run.q) + run.speed + run.t) / INERTIA
        assert run.end == "event"
        assert np.abs(run.acceleration - expected).max() < 1e-12 * np.abs(expected).max()


# A slider-crank with friction in its piston and its piston pin.
CRANK, ROD = 0.1, 0.35
MASS, WEIGHT = 1.5, -30.0
SLIDING, LENGTH, CIRCLE = 0.2, 0.1, 0.1 * 0.01
WAYS, FORCES = [0.2, 0.3, 0.5], [1.0, 5.0, 2.0]


def rubbing(length: float = 1.0, time: float = 1.0) -> Machine:
    """Return the machine in units of which a metre and a second have so many."""
    force, mass_moment = length / time**2, length**2
    ways = Table(np.multiply(WAYS, length), np.multiply(FORCES, force), over="bore")
    return Machine(
        assur.SliderCrank(CRANK * length, ROD * length),
        bodies={"crank": Body(mass=2.0, inertia=0.05 * mass_moment), "piston": Body(mass=MASS)},
        loads=[Force("B", (ways, WEIGHT * force), on="piston")],
        friction={
            "bore": SlideFriction(SLIDING, LENGTH * length),
            "B": JointFriction(0.1, 0.01 * length),
        },
    )


def acceleration(q: float, before: float, speed: float) -> float:
    """Return the acceleration of the crank by the balance of each link; `before`: q just before."""
    sine = CRANK / ROD * math.sin(q)
    cosine = math.sqrt(1.0 - sine**2)
    # The rod leans by asin(sine) below the guide: its rate, by q, and that of the piston.
    lean = CRANK / ROD * math.cos(q) / cosine
    slope = -CRANK * math.sin(q) - ROD * sine * lean
    lean2 = (-sine + sine * lean**2) / cosine
    bend = -CRANK * math.cos(q) - ROD * (cosine * lean**2 + sine * lean2)
    place = CRANK * math.cos(q) + ROD * cosine
    slides = -math.copysign(1.0, math.sin(before)) * speed
    turns = math.copysign(1.0, math.cos(before)) * speed
    load = (
        float(Table(WAYS, FORCES, periodic=False).at(place))
        if WAYS[0] <= place <= WAYS[-1]
        else math.nan
    )
    fx = fy = friction = moment = rate = 0.0
    for _ in range(200):
        rate = (fx * CRANK * math.sin(q) - fy * CRANK * math.cos(q)) / 0.05
        drive = MASS * (slope * rate + bend * speed**2) - load - friction
        # The rod is free of mass: the moment of its forces balances the pin's.
        fx, fy = drive, (drive * -sine * ROD - moment) / (cosine * ROD)
        # The piston turns against the rod, which turns by −lean.
        moment = -math.copysign(CIRCLE * math.hypot(fx, fy), turns)
        normal = -(fy + WEIGHT)
        friction = -math.copysign(SLIDING * max(abs(normal), 2.0 * abs(moment) / LENGTH), slides)
    return rate


def test_rows_where_friction_reverses_have_the_acceleration_before() -> None:
    run = rubbing().run(t_end=1.0, q0=1.0, speed0=15.0, rtol=1e-12)
    found = [
        acceleration(float(q), float(q) + (1e-9 if i == 0 else -1e-9), float(speed))
        for i, (q, speed) in enumerate(zip(run.q, run.speed, strict=True))
    ]
    assert np.abs(run.acceleration - found).max() < 1e-9 * np.abs(found).max()
    # At each dead centre a step ends; the acceleration jumps there.
    for turn in (1, 2, 3, 4):
        row = int(np.abs(run.q - turn * math.pi).argmin())
        q, speed = float(run.q[row]), float(run.speed[row])
        assert abs(q - turn * math.pi) < 1e-12
        before, behind = (acceleration(q, q + side, speed) for side in (-1e-9, 1e-9))
        assert run.acceleration[row] == pytest.approx(before, abs=1e-10)
        assert abs(behind - before) > 0.05
    # Reactions are those of the same side.
    assert np.abs(rubbing().effort(run)).max() < 1e-12


def test_reversals_of_friction_end_steps_and_none_is_refused_for_them() -> None:
    counts = []
    for length, time in ((1.0, 1.0), (1000.0, 1.0), (1.0, 3600.0), (39.37, 60.0), (1e-3, 1e3)):
        run = rubbing(length, time).run(t_end=time, q0=1.0, speed0=15.0 / time, rtol=1e-9)
        counts.append((run.statistics.steps, run.statistics.rejected))
    steps = [steps for steps, _ in counts]
    assert max(steps) <= 1.05 * min(steps)
    assert max(steps) < 100
    assert all(rejected < 0.5 * steps for steps, rejected in counts)
