"""Steps of environments against the method by hand, runs, closed forms and energy."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import assur
from models.machines.stepping_machines import (
    arm,
    dead_ends,
    engine,
    five_bar,
    flywheel,
    pendulum,
    pulled,
)

TURN = 2.0 * math.pi


def by_hand(machine: assur.Machine, q: Any, speed: Any, effort: Any, dt: float) -> tuple[Any, Any]:
    """One step of the classical method with the accelerations of single calls."""

    def slope(state: Any) -> Any:
        return np.stack([state[1], machine.acceleration(state[0], state[1], effort)])

    start = np.stack([q, speed])
    first = slope(start)
    second = slope(start + 0.5 * dt * first)
    third = slope(start + 0.5 * dt * second)
    last = slope(start + dt * third)
    q, speed = start + dt / 6.0 * (first + 2.0 * second + 2.0 * third + last)
    return q, speed


@pytest.mark.parametrize("make", [five_bar, engine, flywheel, pulled, arm])
@pytest.mark.parametrize("dt", [1e-3, -2e-3, 0.02])
def test_a_step_is_the_method_by_hand(make: Any, dt: float) -> None:
    machine = make()
    rng = np.random.default_rng(2)
    q0 = np.asarray(machine.mechanism.q0)
    q = q0 + rng.uniform(-0.2, 0.2, (30, *q0.shape))
    speed, effort = rng.normal(size=q.shape), rng.normal(size=q.shape)
    after = machine.step(q, speed, effort, dt)
    wanted_q, wanted_speed = by_hand(machine, q, speed, effort, dt)
    assert after.q == pytest.approx(wanted_q, rel=1e-13, abs=1e-13)
    assert after.speed == pytest.approx(wanted_speed, rel=1e-11, abs=1e-11)
    assert after.status.tolist() == [0] * 30


def test_a_pendulum_swings_as_long_as_jacobi_says() -> None:
    """Its period is 4 K(sin(θ/2)) √(L/g), by the arithmetic-geometric mean."""
    greatest, length, g = 1.2, 0.5, 9.81
    a, b = 1.0, math.cos(greatest / 2.0)
    for _ in range(8):
        a, b = (a + b) / 2.0, math.sqrt(a * b)
    period = TURN * math.sqrt(length / g) / a
    steps = 4000
    start = -math.pi / 2.0 + greatest
    q, speed, _ = pendulum(length).step(start, 0.0, 0.0, period / steps, n=steps)
    assert q == pytest.approx(start, abs=1e-11)
    assert speed == pytest.approx(0.0, abs=1e-10)


def test_energy_is_kept_as_the_order_says() -> None:
    """The error falls by at least 2⁴ where the step is halved."""
    machine = engine(loads=[assur.Gravity((9.81, 0.0))])
    q, speed = np.linspace(0.0, 3.0, 7), 8.0

    def energy(at: Any, rate: Any) -> Any:
        kinetic = 0.5 * machine.reduced_inertia(at).value * rate**2
        return kinetic + machine.potential(at)

    before = energy(q, speed)
    errors = []
    for steps in (200, 400, 800):
        after = machine.step(q, speed, 0.0, 1.0 / steps, n=steps)
        errors.append(float(np.abs(energy(after.q, after.speed) - before).max()))
    assert errors[1] < errors[0] / 15.0
    assert errors[2] < errors[1] / 15.0
    assert errors[2] < 1e-8 * float(np.abs(before).max())


def test_runs_go_the_same_way() -> None:
    motor = assur.LinearMotor(stall=50.0, no_load=15.0, rotor_inertia=0.02)
    work = assur.Table([0.0, 2.0, 4.0, TURN], [0.0, -300.0, 100.0, 0.0], spline="pchip")
    machine = engine(loads=[assur.Force("B", (work, 0.0))], motor=motor)
    run = machine.run(0.7, q0=0.3, speed0=2.0, rtol=1e-11)
    after = machine.step(0.3, 2.0, None, 0.7 / 7000, n=7000)
    assert after.q == pytest.approx(float(run.q[-1]), abs=1e-8)
    assert after.speed == pytest.approx(float(run.speed[-1]), abs=1e-7)


def test_an_environment_has_the_bits_that_it_has_alone() -> None:
    machine = five_bar()
    rng = np.random.default_rng(4)
    q = np.asarray(machine.mechanism.q0) + rng.uniform(-0.3, 0.3, (700, 2))  # type: ignore[union-attr]
    speed = rng.normal(size=(700, 2))
    every = machine.step(q, speed, [0.1, -0.1], 1e-3, n=5, threads=2)
    again = machine.step(q, speed, [0.1, -0.1], 1e-3, n=5, threads=1)
    assert np.array_equal(every.q, again.q)
    assert np.array_equal(every.speed, again.speed)
    for row in (0, 255, 256, 699):
        alone = machine.step(q[row], speed[row], [0.1, -0.1], 1e-3, n=5)
        assert np.array_equal(alone.q, every.q[row])
        assert np.array_equal(alone.speed, every.speed[row])
    # Five calls of one step, too.
    now, rate = q, speed
    for _ in range(5):
        now, rate, _ = machine.step(now, rate, [0.1, -0.1], 1e-3)
    assert np.array_equal(now, every.q)
    assert np.array_equal(rate, every.speed)


def test_designs_have_environments_of_their_own() -> None:
    mechanism = assur.SliderCrank([0.1, 0.12], [0.4, 0.45])
    machine = assur.Machine(mechanism, bodies={"piston": assur.Body(mass=2.0)})
    q = np.array([[0.3, 0.8, 1.1], [0.4, 0.9, 1.2]])
    after = machine.step(q, 1.0, [[0.1], [0.2]], 1e-3, n=3)
    assert after.q.shape == (2, 3)
    for index, effort in enumerate((0.1, 0.2)):
        alone = machine.of(mechanism.design(index)).step(q[index], 1.0, effort, 1e-3, n=3)
        assert np.array_equal(alone.q, after.q[index])
    assert machine.step(0.5, 1.0, 0.0, 1e-3).q.shape == (2,)


def test_a_driven_slide() -> None:
    """A block on a guide under its weight and a spring: x = x0 cos ωt."""
    mechanism = assur.Mechanism(
        joints={"O": (0, 0), "B": (0.3, 0.0)},
        links={"ground": "O", "block": "B"},
        driver="bore",
        slides={"bore": assur.Slide("block", on="ground", angle=0.0, origin="O")},
    )
    spring = assur.Spring("B", ("ground", (-0.5, 0.0)), 50.0, 0.5)
    body = assur.Body(mass=2.0)
    machine = assur.Machine(mechanism, bodies={"block": body}, loads=[spring])
    t = 0.9
    q, speed, status = machine.step([0.1, 0.2], 0.0, 0.0, t / 3000, n=3000)
    assert q == pytest.approx(np.array([0.1, 0.2]) * math.cos(5.0 * t), abs=1e-11)
    assert speed == pytest.approx(-5.0 * np.array([0.1, 0.2]) * math.sin(5.0 * t), abs=1e-10)
    assert status.tolist() == [0, 0]


def test_environments_that_reach_a_dead_point_say_so() -> None:
    """The crank stops at 1.3716 rad; the others go on with the bits that they have alone."""
    machine = dead_ends()
    q, speed = np.array([0.2, 1.3, -0.4, float("nan")]), np.array([0.1, 3.0, 0.2, 0.0])
    after = machine.step(q, speed, 0.0, 1e-3, n=100)
    assert after.status.tolist() == [0, 3, 0, 7]
    assert np.isfinite(after.q).tolist() == [True, False, True, False]
    assert after.q[0] == machine.step(0.2, 0.1, 0.0, 1e-3, n=100).q
    held = machine.step(q, speed, 0.0, 1e-3, n=100, on_error="hold")
    assert held.status.tolist() == [0, 3, 0, 7]
    assert 1.3 < held.q[1] < 1.37156
    assert held.q[2] == after.q[2]
    with pytest.raises(assur.InputError, match=r"environment 1: UNREACHABLE .*q = \[1\.3\]"):
        machine.step(q, speed, 0.0, 1e-3, n=100, on_error="raise")
    # A step ends before the dead point: the state that is held exists.
    assert machine.dynamics(held.q[1], held.speed[1]).status == 0


def test_a_step_that_ends_where_nothing_is_fails() -> None:
    """Also where only its last stage, or only its end, is beyond what exists."""
    table = assur.Table([0.0, 1.0], [1.0, 2.0], periodic=False)
    machine = engine(loads=[assur.Torque("crank", table)])
    for n in (1, 2):
        after = machine.step(0.9992, 1.0, 0.0, 1e-3, n=n)
        assert after.status == assur.Status.NO_VALUE
        assert np.isnan([after.q, after.speed]).all()
        held = machine.step(0.9992, 1.0, 0.0, 1e-3, n=n, on_error="hold")
        assert (held.q, held.speed) == (0.9992, 1.0)
    with pytest.raises(assur.InputError, match=r"NO_VALUE .* a load has no finite value there"):
        machine.step(0.9992, 1.0, 0.0, 1e-3, on_error="raise")
    # Beside the dead point at 1.37156: many states, each after a step of its own.
    ends = assur.Machine(
        assur.FourBar(3.0, 2.5, 2.0, 4.0),
        bodies={"rocker": assur.Body(mass=1.0, inertia=0.1), "crank": assur.Body(inertia=0.2)},
    )
    rng = np.random.default_rng(7)
    q = 1.37156 - rng.uniform(0.0, 0.02, 20_000)
    speed, effort = rng.uniform(-30.0, 30.0, q.size), rng.uniform(-50.0, 50.0, q.size)
    for rule in ("nan", "hold"):
        after = ends.step(q, speed, effort, 1e-3, on_error=rule)
        good = after.status <= 1
        assert 0 < good.sum() < q.size
        assert (np.abs(np.asarray(after.q) - q)[good] <= 1.0).all()
        there = good if rule == "nan" else np.isfinite(after.q)
        assert (ends.dynamics(np.asarray(after.q)[there], on_error="nan").status <= 2).all()


@pytest.mark.parametrize(("speed", "effort"), [(0.0, 1e9), (900.0, -1e7)])
def test_no_step_goes_farther_than_a_radian(speed: float, effort: float) -> None:
    assert engine().step(1.0, speed, effort, 1e-3).status == assur.Status.BAD_INPUT


def test_a_change_point_is_stepped_through() -> None:
    """A parallelogram goes on in its branch; there the numbers are those of the motion."""
    machine = assur.Machine(
        assur.FourBar(4.0, 1.0, 4.0, 1.0),
        bodies={"rocker": assur.Body(inertia=0.1), "crank": assur.Body(inertia=0.1)},
    )
    now = machine.dynamics(0.0, 1.0)
    assert now.mass_matrix == pytest.approx(machine.reduced_inertia(0.0).value)
    assert now.status == assur.Status.NEAR_SINGULAR
    assert machine.acceleration(0.0, 1.0, 1.0) == pytest.approx(5.0)
    after = machine.step([-0.05, 0.0], 1.0, 0.0, 1e-2, n=10)
    assert (after.status <= 1).all()
    assert after.speed == pytest.approx(np.ones(2), rel=1e-9)


def test_invalid_designs_are_named_in_place() -> None:
    mechanism = assur.SliderCrank([0.1, -1.0, 0.12], 0.4)
    machine = assur.Machine(mechanism, bodies={"piston": assur.Body(mass=2.0)})
    after = machine.step(0.5, 1.0, 0.0, 1e-3, n=4)
    assert after.status.tolist() == [0, int(assur.Status.BAD_DIMENSION), 0]
    assert np.isnan(after.q).tolist() == [False, True, False]


REFUSED: dict[str, tuple[Any, str]] = {
    "too far in a step": (
        lambda: engine().step([0.1, 0.2], [1.0, 2000.0], 0.0, 1e-3, on_error="raise"),
        r"environment 1: BAD_INPUT .*speed = \[2000\.0\]: it goes too far in a step of 0\.001 s",
    ),
    "no time": (lambda: engine().step(0.1, 1.0, 0.0, 0.0), "dt is 0: a time is needed"),
    "a time that is NaN": (lambda: engine().step(0.1, 1.0, 0.0, math.nan), "dt"),
    "no steps": (lambda: engine().step(0.1, 1.0, 0.0, 1e-3, n=0), "n is 0"),
    "friction": (
        lambda: engine(friction={"B": assur.JointFriction(0.1, radius=0.01)}).step(0, 1, 0, 0.1),
        "without friction, which this machine has in 'B'",
    ),
    "a function": (
        lambda: engine(loads=[assur.Torque("crank", lambda t, _q, _v: t)]).step(
            0.1, 1.0, 0.0, 1e-3
        ),
        "step.. calls no Python functions",
    ),
    "the shape of efforts": (
        lambda: engine().step([0.1, 0.2], 1.0, [1.0, 2.0, 3.0], 1e-3),
        r"effort has the shape \(3,\), q \(2,\)",
    ),
    "a method": (
        lambda: engine().step(0.1, 1.0, 0.0, 1e-3, method="euler"),  # type: ignore[arg-type]
        "method",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refusals(name: str) -> None:
    call, message = REFUSED[name]
    with pytest.raises(assur.InputError, match=message):
        call()
