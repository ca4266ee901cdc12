"""A machine's flywheel has one interface and one meaning, whatever the motor."""

from __future__ import annotations

import math
import pickle
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest

import assur
from assur import Body, Gravity, InputError
from assur.dynamics.flywheel.steady import SteadyFlywheel
from models.machines.machines import press

TURN = math.tau
MEANS = ("extremes", "period")
Q, T = np.linspace(-9.0, 30.0, 101), np.linspace(-1.0, 3.0, 101)
# Tables are refined until the flywheel changes by 1e-9 of the inertia; the integrated motion is
# closer. Of moments the spline of the last table is off by as much, of places of extremes the root
# of a derivative is.
TABLES_RTOL = 1e-9
PLACE_ATOL = 1e-7


def four_bar() -> assur.Machine:
    """It is drawn at a quarter turn: there the integrated motion begins, tables at 0."""
    bodies = {
        "crank": Body(inertia=0.8),
        "coupler": Body(mass=1.0, inertia=0.1),
        "rocker": Body(mass=2.0, inertia=0.5, at="C"),
    }
    return assur.Machine(assur.FourBar(1.0, 3.0, 2.5, 3.0), bodies=bodies, loads=[Gravity()])


MACHINES = {"press": press, "four-bar": four_bar}
CURVES = {
    "speed": Q,
    "time": Q,
    "coordinate": T,
    "speed_at": T,
    "reduced_moment": Q,
    "reduced_inertia": Q,
    "work": Q,
}


def public(one: object) -> set[str]:
    return {name for name in dir(one) if not name.startswith("_")}


@pytest.mark.parametrize("mean", MEANS)
@pytest.mark.parametrize("name", list(MACHINES))
def test_a_constant_motor_in_both_ways(name: str, mean: Any) -> None:
    """By tables, and by the integrated motion with the same flywheel and mean speed."""
    machine = MACHINES[name]()
    tables = machine.flywheel(0.05, mean_speed=20.0, mean=mean)
    motion = SteadyFlywheel(machine, machine.steady_state(20.0, mean=mean, flywheel=tables.inertia))
    assert isinstance(tables, assur.flywheel.Flywheel)
    assert public(tables) == public(motion)
    assert (motion.inertia, motion.shape, motion.mean) == (tables.inertia, (), mean)
    for number in ("speed0", "delta", "mean_speed", "period"):
        assert getattr(motion, number) == pytest.approx(getattr(tables, number), rel=TABLES_RTOL)
    size = np.abs(tables.reduced_moment(Q)).max()
    assert motion.motor_moment == pytest.approx(tables.motor_moment, abs=TABLES_RTOL * size)
    assert motion.power == pytest.approx(tables.power, abs=TABLES_RTOL * size * 20.0)
    for extreme in ("max", "min"):
        one, other = getattr(motion, extreme), getattr(tables, extreme)
        assert one.value == pytest.approx(other.value, rel=TABLES_RTOL)
        assert one.q == pytest.approx(other.q, abs=PLACE_ATOL)
    for curve, x in CURVES.items():
        one, other = (np.asarray(getattr(f, curve)(x)) for f in (motion, tables))
        assert one.shape == other.shape == x.shape
        assert not one.flags.writeable
        assert not other.flags.writeable
        # The work is a difference of kinetic energies: its error is a part of theirs.
        size = 200.0 * tables.inertia if curve == "work" else np.abs(other).max()
        assert np.abs(one - other).max() <= TABLES_RTOL * size
        assert type(getattr(motion, curve)(1.0)) is type(getattr(tables, curve)(1.0)) is float
        assert getattr(motion, curve)([]).shape == (0,)
        assert getattr(motion, curve)([[0.5, 1.0]]).shape == (1, 2)
    for one, other in zip(
        motion.energy_mass(points=50), tables.energy_mass(points=50), strict=True
    ):
        assert np.abs(one - other).max() <= TABLES_RTOL * np.abs(other).max()
    assert repr(motion) == repr(tables)
    assert motion.explain() == tables.explain()
    for f in (motion, tables):
        with pytest.raises(InputError, match="q has nan"):
            f.speed([0.0, math.nan])
        with pytest.raises(InputError, match="points is 1"):
            f.energy_mass(points=1)


@pytest.mark.parametrize("mean", MEANS)
@pytest.mark.parametrize("slope", [1e-2, 1e-3])
def test_a_motor_that_is_almost_constant(mean: Any, slope: float) -> None:
    """Its moment changes by the slope times the fluctuation: so much do all results."""
    moment, delta = press().flywheel(0.05, mean_speed=20.0).motor_moment, 0.05
    motor = assur.LinearMotor(moment * (1.0 + slope), 20.0 * (1.0 + slope) / slope)
    own = press(motor).flywheel(delta, mean=mean)
    constant = press().flywheel(delta, mean_speed=own.mean_speed, mean=mean)
    assert constant.steady is None
    assert own.steady is not None
    assert own.steady.multiplier < 1.0
    for number in ("inertia", "speed0", "motor_moment", "power", "period"):
        assert getattr(own, number) == pytest.approx(getattr(constant, number), rel=slope * delta)
    for curve, x in CURVES.items():
        one, other = (np.asarray(getattr(f, curve)(x)) for f in (own, constant))
        assert np.abs(one - other).max() <= slope * delta * np.abs(other).max()


@pytest.mark.parametrize("ratio", [1.0, -3.0])
def test_a_motor_of_its_own(ratio: float) -> None:
    """Either way round: the curves are those of the integrated motion."""
    f = press(assur.LinearMotor(90.0, 90.0, ratio=ratio)).flywheel(0.02)
    steady = f.steady
    assert steady is not None
    sign = math.copysign(1.0, ratio)
    assert f.speed0 == f.speed(0.0) == steady.at(0.0).speed
    assert math.copysign(1.0, f.speed0) == sign
    assert f.mean_speed > 0.0
    for number in ("inertia", "delta", "mean_speed", "mean", "period", "motor_moment"):
        assert getattr(f, number) == getattr(steady, number)
    assert f.power == pytest.approx(steady.power, rel=1e-14)
    assert f.delta == pytest.approx(0.02, rel=1e-10)
    for extreme in (f.max, f.min):
        assert 0.0 <= sign * extreme.q <= TURN
        assert f.speed(extreme.q) == pytest.approx(sign * extreme.value, rel=1e-12)
    assert f.time(sign * 3.0 * TURN) == pytest.approx(3.0 * f.period, rel=1e-14)
    # An ulp of 30 rad.
    assert np.abs(f.coordinate(f.time(Q)) - Q).max() < 1e-14
    assert np.abs(f.speed_at(f.time(Q)) - f.speed(Q)).max() < 1e-12
    # The work of the motor in a turn is that of all loads, weights included.
    q = np.linspace(0.0, sign * TURN, 20001)
    work = np.sum(0.5 * (f.reduced_moment(q)[1:] + f.reduced_moment(q)[:-1]) * np.diff(q))
    assert f.motor_moment * sign * TURN == pytest.approx(-work, rel=1e-6)
    assert f.work(sign * TURN) == pytest.approx(0.0, abs=1e-9 * abs(work))
    again = pickle.loads(pickle.dumps(f))
    assert repr(again) == repr(f)
    assert np.array_equal(again.work(Q), f.work(Q))


@pytest.mark.parametrize("ratio", [1.0, -3.0])
def test_its_pictures(ratio: float) -> None:
    f = press(assur.LinearMotor(90.0, 90.0, ratio=ratio)).flywheel(0.02)
    sign = math.copysign(1.0, ratio)
    q, speed = map(np.asarray, f.plot().lines[0].get_data())
    assert (q[0], q[-1]) == (0.0, sign * TURN)
    np.testing.assert_array_equal(speed, f.speed(q))
    t, speed = map(np.asarray, f.plot("time").lines[0].get_data())
    assert (t[0], t[-1]) == (0.0, pytest.approx(f.period))
    np.testing.assert_array_equal(speed, f.speed(q))
    marks: list[Any] = [line.get_data() for line in f.plot().lines if line.get_gid() == "mark"]
    for (x, y), extreme in zip(marks, (f.max, f.min), strict=True):
        assert (x[0], y[0]) == (extreme.q, sign * extreme.value)
    inertia, energy = f.plot("energy-mass").lines[0].get_data()
    np.testing.assert_array_equal((inertia, energy), f.energy_mass())
    plt.close("all")
