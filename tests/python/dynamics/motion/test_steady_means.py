"""The mean speed asked for is the mean speed that `mean` names, and that of the result."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import assur
from assur import Body, Force, Gravity, Table, TorsionDamper
from models.errors.refusals import refused

TURN = 2.0 * math.pi
PHI = np.linspace(0.0, TURN, 241)


def slider_crank() -> assur.Machine:
    work = Table([0.0, 3.5, 5.0, TURN], [0.0, 0.0, -150.0, 0.0], spline="linear")
    bodies = {
        "crank": Body(inertia=0.5),
        "rod": Body(mass=5.0, inertia=0.1, at=(0.15, 0.0)),
        "piston": Body(mass=20.0),
    }
    return assur.Machine(
        assur.SliderCrank(0.1, 0.4), bodies=bodies, loads=[Gravity(), Force("B", (work, 0.0))]
    )


def four_bar() -> assur.Machine:
    bodies = {
        "crank": Body(inertia=0.8),
        "coupler": Body(mass=1.0, inertia=0.2, at=(1.0, 0.2)),
        "rocker": Body(mass=2.0),
    }
    return assur.Machine(assur.FourBar(1.0, 3.0, 2.5, 3.0), bodies=bodies, loads=[Gravity()])


def damped() -> assur.Machine:
    bodies = {"crank": Body(inertia=0.8), "rocker": Body(mass=2.0, inertia=0.5)}
    damper = TorsionDamper("rocker", 2.0)
    return assur.Machine(assur.FourBar(1.0, 3.0, 2.5, 3.0), bodies=bodies, loads=[damper])


def table() -> assur.Machine:
    return assur.Machine.from_table(PHI, 40.0 * np.sin(2.0 * PHI), 2.0 + np.cos(PHI))


MACHINES = {"slider-crank": slider_crank, "four-bar": four_bar, "damped": damped, "table": table}


@pytest.mark.parametrize("mean", ["extremes", "period"])
@pytest.mark.parametrize("speed", [11.0, -14.0, 300.0])
@pytest.mark.parametrize("name", list(MACHINES))
def test_the_mean_asked_for_is_met(name: str, speed: float, mean: Any) -> None:
    machine = MACHINES[name]()
    steady = machine.steady_state(speed, mean=mean)
    assert steady.mean_speed == pytest.approx(abs(speed), rel=1e-11)
    assert math.copysign(1.0, steady.speed[0]) == math.copysign(1.0, speed)
    # By the curve itself.
    q = np.linspace(steady.q[0], steady.q[-1], 20001)
    speeds = np.abs(steady.at(q).speed)
    if mean == "extremes":
        # A parabola through the top is h²/8 of its curvature off the samples.
        assert 0.5 * (speeds.min() + speeds.max()) == pytest.approx(abs(speed), rel=1e-6)
    else:
        inverse = np.sum(0.5 * (1.0 / speeds[1:] + 1.0 / speeds[:-1])) / 20000.0
        assert 1.0 / inverse == pytest.approx(abs(speed), rel=1e-6)


def test_without_a_word_it_is_the_mean_of_the_extremes() -> None:
    steady = table().steady_state(10.0)
    assert steady.mean == "extremes"
    assert steady.mean_speed == 0.5 * (steady.max.value + steady.min.value)
    assert steady.mean_speed == pytest.approx(10.0, rel=1e-11)


def test_the_extremes_are_those_of_the_energy_integral() -> None:
    """ω² J = C + 2 W: the same level by `assur.flywheel`, which does not integrate."""
    phi, inertia = PHI, 2.0 + np.cos(PHI)
    moment = 40.0 * np.sin(2.0 * PHI)
    for speed in (6.0, 10.0, 100.0):
        exact = assur.flywheel.evaluate(phi, moment, inertia, mean_speed=speed)
        steady = assur.Machine.from_table(phi, moment, inertia).steady_state(speed)
        assert steady.max.value == pytest.approx(exact.max.value, rel=1e-9)
        assert steady.min.value == pytest.approx(exact.min.value, rel=1e-9)
        assert steady.period == pytest.approx(exact.period, rel=1e-9)


def test_with_a_flywheel_added_the_mean_is_met_too() -> None:
    steady = slider_crank().steady_state(9.0, flywheel=3.0)
    assert steady.mean_speed == pytest.approx(9.0, rel=1e-11)
    assert steady.inertia == 3.0


def test_a_mean_below_half_the_greatest_speed_there_must_be_is_refused() -> None:
    """Weights alone: at the slowest the greatest speed is what the fall gives."""
    machine = four_bar()
    least = assur.flywheel.evaluate(
        PHI,
        _closed(machine.reduced_moment(PHI)),
        _closed(machine.reduced_inertia(PHI).value),
        mean_speed=9.0,
    )
    level = machine.reduced_inertia(PHI).value * np.square(least.speed(PHI))
    # The level falls until the slowest place is at rest; half the greatest speed is left.
    slowest = int(np.argmin(level))
    fastest = np.sqrt(np.max((level - level[slowest]) / machine.reduced_inertia(PHI).value))
    steady = machine.steady_state(0.52 * fastest)
    assert steady.mean_speed == pytest.approx(0.52 * fastest, rel=1e-11)
    for part in (0.49, 0.1):
        said = "mean speed extremes flywheel="
        refused(assur.MotionError, said, lambda p=part: machine.steady_state(p * fastest))  # type: ignore[misc]


def _closed(column: Any) -> Any:
    """But for rounding its end is its beginning."""
    return np.append(column[:-1], column[0])


def test_a_motor_that_sets_its_own_speed_keeps_it() -> None:
    """The speed is a first guess then, whatever the mean."""
    motor = assur.LinearMotor(50.0, 15.0)
    machine = assur.Machine(
        assur.SliderCrank(0.1, 0.4),
        bodies={"piston": Body(mass=20.0), "crank": Body(inertia=0.5)},
        loads=[assur.Torque("crank", -20.0)],
        motor=motor,
    )
    own = machine.steady_state()
    for mean in ("extremes", "period"):
        steady = machine.steady_state(12.0, mean=mean)
        assert steady.max.value == pytest.approx(own.max.value, rel=1e-9)
