"""Motions with friction are as accurate as without, however fast and loaded they are."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import assur
from assur import Body, JointFriction, Machine, Torque

RADIUS, ROD = 0.1, 0.35
INERTIA, MASS, ROD_INERTIA, CENTRE, PISTON = 0.2, 1.2, 0.015, 0.12, 2.0
CIRCLES = (0.1 * 0.025, 0.1 * 0.012)


def engine(speed: float = 1.0, load: float = 0.0) -> Machine:
    return Machine(
        assur.SliderCrank(RADIUS, ROD),
        bodies={
            "crank": Body(inertia=INERTIA),
            "rod": Body(mass=MASS, inertia=ROD_INERTIA, at=(CENTRE, 0.0)),
            "piston": Body(mass=PISTON),
        },
        loads=[Torque("crank", load * speed**2)] if load else [],
        friction={"A": JointFriction(0.1, 0.025), "B": JointFriction(0.1, 0.012)},
    )


def acceleration(q: float, speed: float, load: float) -> float:
    """By the equations of each body alone; the moments of friction by iteration."""
    s, c = math.sin(q), math.cos(q)
    sine = -RADIUS * s / ROD
    cosine = math.sqrt(1.0 - sine * sine)
    # The rod's angle ψ from A to B: ROD sin ψ = −RADIUS sin q; its rates per q̇, and per q̇².
    first = -RADIUS * c / (ROD * cosine)
    second = (RADIUS * s + ROD * sine * first**2) / (ROD * cosine)
    arm = np.array([cosine, sine])
    across = np.array([-sine, cosine])
    pin1, pin2 = RADIUS * np.array([-s, c]), -RADIUS * np.array([c, s])
    centre1 = pin1 + CENTRE * first * across
    centre2 = pin2 + CENTRE * (second * across - first**2 * arm)
    end1 = pin1[0] + ROD * first * across[0]
    end2 = pin2[0] + ROD * (second * across[0] - first**2 * arm[0])
    # Unknowns: q̈, force of the crank on the rod, force of the piston on the rod.
    m = np.zeros((5, 5))
    right = np.zeros(5)
    square = speed * speed
    m[0:2, 0] = MASS * centre1
    m[0, 1] = m[0, 3] = m[1, 2] = m[1, 4] = -1.0
    right[0:2] = -MASS * centre2 * square
    to_pin, to_end = -CENTRE * arm, (ROD - CENTRE) * arm
    m[2] = [ROD_INERTIA * first, to_pin[1], -to_pin[0], to_end[1], -to_end[0]]
    right[2] = -ROD_INERTIA * second * square
    m[3, 0], m[3, 3] = PISTON * end1, 1.0
    right[3] = -PISTON * end2 * square
    m[4] = [INERTIA, -RADIUS * s, RADIUS * c, 0.0, 0.0]
    right[4] = load
    on_rod = -np.sign(speed * (first - 1.0)), -np.sign(speed * first)
    friction = [0.0, 0.0]
    found: Any = np.zeros(5)
    for _ in range(60):
        own = right.copy()
        own[2] += friction[0] + friction[1]
        own[4] -= friction[0]
        found = np.linalg.solve(m, own)
        new = [
            on_rod[0] * CIRCLES[0] * math.hypot(found[1], found[2]),
            on_rod[1] * CIRCLES[1] * math.hypot(found[3], found[4]),
        ]
        if new == friction:
            break
        friction = new
    return float(found[0])


@pytest.mark.parametrize("speed", [1.0, 1e3, 1e6])
@pytest.mark.parametrize("load", [0.0, 3.0, -40.0])
def test_accelerations_have_all_digits(speed: float, load: float) -> None:
    for q in np.linspace(0.2, 6.1, 8):
        run = engine(speed, load).run(t_end=0.0, q0=q, speed0=speed)
        own = acceleration(float(q), 1.0, load) * speed**2
        assert abs(run.acceleration[0] / own - 1.0) < 1e-12


@pytest.mark.parametrize("load", [1.0, 1e3, 1e6, 1e9])
def test_friction_that_is_nothing_changes_nothing(load: float) -> None:
    m = assur.SliderCrank(0.1, 0.35)
    bodies = {"piston": Body(mass=1.0), "crank": Body(inertia=0.01)}
    free, rubbing = (
        Machine(m, bodies=bodies, loads=[Torque("crank", load)], friction=friction)
        .run(t_end=1e-9, q0=1.0, speed0=1e-3)
        .acceleration[0]
        for friction in ({}, {"A": JointFriction(1e-15, 0.01)})
    )
    assert abs(rubbing / free - 1.0) < 1e-15


def test_effort_of_computing_does_not_depend_on_the_speed() -> None:
    """The same motion in other units of time, to a dead point."""
    bars = {name: Body(mass=1.0, inertia=0.5) for name in ("crank", "coupler", "rocker")}
    m = assur.FourBar(3.0, 2.5, 2.0, 4.0)
    for w in (1.0, 1e2, 1e4):
        machine = Machine(
            m,
            bodies=bars,
            loads=[Torque("crank", -20.0 * w**2)],
            friction={"C": JointFriction(0.1, 0.1)},
        )
        run = machine.run(t_end=5.0 / w, q0=0.5, speed0=w)
        assert run.end == "dead point"
        assert run.statistics.evaluations < 7500


def path(q: float, to: float, state: Any) -> Any:
    """Speed and time at another coordinate of a free motion, where c does not jump between."""
    if q == to:
        return state

    def rates(q: float, y: Any) -> list[float]:
        return [acceleration(q, 1.0, 0.0) * y[0], 1.0 / y[0]]

    return solve_ivp(rates, (q, to), state, "DOP853", rtol=1e-13, atol=1e-15).y[:, -1]


def free_motion(q: float, t_end: float) -> tuple[float, float]:
    """Coordinate and speed of a free motion from speed 1: q̈ = c(q) q̇²."""
    state, corner = np.array([1.0, 0.0]), 0.5 * math.pi
    # The rod turns back at quarters of a turn, and its friction with it.
    while True:
        after = path(q, corner, state)
        if after[1] > t_end:
            break
        q, state, corner = corner, after, corner + math.pi
    at, own = q, state
    for _ in range(6):
        at += float((t_end - own[1]) * own[0])
        own = path(q, at, state)
    return at, float(own[0])


def test_a_fast_motion_is_as_accurate_as_a_slow_one() -> None:
    """Free, q̈ = c(q) q̇²: the same path at any speed, to about a hundred tolerances over 20 rad."""
    q, rate = free_motion(0.3, 20.0)
    for speed in (1.0, 1e4, 1e5):
        run = engine().run(t_end=20.0 / speed, q0=0.3, speed0=speed, rtol=1e-12)
        assert run.statistics.steps < 500
        assert abs(run.q[-1] - q) < 2e-9
        assert abs(run.speed[-1] / speed - rate) < 1e-10


def test_a_small_and_fast_six_bar_comes_to_its_dead_point() -> None:
    """Two dyads, mm and 0.1 ms."""
    length, time = 1e-3, 1e-4
    at = {
        "A": (0, 0),
        "B": (1.0, 0.5),
        "C": (3.2, 2.1),
        "D": (4.0, 0),
        "E": (5.5, 2.4),
        "F": (6.2, 0),
    }
    m = assur.Mechanism(
        joints={name: (x * length, y * length) for name, (x, y) in at.items()},
        links={
            "ground": "ADF",
            "crank": "AB",
            "coupler": "BC",
            "rocker": "DC",
            "rod": "CE",
            "lever": "FE",
        },
        driver="lever",
    )
    bodies = {name: Body(mass=1.0, inertia=0.5 * length**2) for name in m.links if name != "ground"}
    torque = 20.0 * length**2 / time**2
    friction = {name: JointFriction(0.1, 0.05 * length) for name in "BCE"}
    for own in ({}, friction):
        machine = Machine(m, bodies=bodies, loads=[Torque("lever", -torque)], friction=own)
        run = machine.run(t_end=20.0 * time, q0=m.q0, speed0=-1.0 / time)
        assert run.end == "dead point"
        assert run.statistics.evaluations < 7500
