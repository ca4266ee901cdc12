"""Periodic motions and flywheels at the edge of what can be found."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import assur
from assur import Body, Force, InputError, Table, Torque, TorsionDamper, TorsionSpring
from models.machines.machines import press, wheel

TURN = math.tau


def four_bar() -> assur.Mechanism:
    return assur.FourBar(1.0, 3.0, 2.5, 3.2)


def test_machines_without_loads_have_any_speed() -> None:
    free = assur.Machine(
        assur.SliderCrank(0.1, 0.4), bodies={"crank": Body(inertia=0.5), "piston": Body(mass=2.0)}
    )
    own = free.steady_state(10.0, mean="period")
    assert abs(own.mean_speed - 10.0) < 1e-9
    assert abs(own.motor_work) < 1e-9
    for rtol in (1e-4, 1e-6, 1e-8):
        driven = press(assur.LinearMotor(90.0, 30.0)).steady_state(rtol=rtol, method="RK45")
        exact = press(assur.LinearMotor(90.0, 30.0)).steady_state()
        assert abs(driven.mean_speed - exact.mean_speed) < 1e3 * rtol
    with pytest.raises(InputError, match="it must be at most"):
        free.steady_state(10.0, rtol=1e-3)
    far = press(assur.InductionMotor(60.0, 0.2, 15.7)).steady_state(100.0, flywheel=5.0)
    near = press(assur.InductionMotor(60.0, 0.2, 15.7)).steady_state(flywheel=5.0)
    assert abs(far.mean_speed - near.mean_speed) < 1e-9
    heavy = press(assur.LinearMotor(90.0, 30.0)).steady_state(flywheel=1e4)
    assert heavy.delta < 1e-4


def test_periods_must_be_the_same() -> None:
    motor = assur.LinearMotor(90.0, 30.0)
    half = Torque("crank", lambda _, q, __: -5.0 * math.sin(q / 2.0))
    for load in (TorsionSpring("crank", 1.0), half):
        with pytest.raises(assur.MotionError, match="differs from period to period"):
            press(motor, loads=[load]).steady_state()
    assert press(motor, loads=[half]).steady_state(turns=2).multiplier < 1.0
    with pytest.raises(assur.MotionError, match="moment is not periodic over a turn") as caught:
        press(loads=[half]).flywheel(0.01, mean_speed=12.0)
    assert (caught.value.kind, caught.value.design) == ("not_periodic", None)
    # A design that is a thousandth of another is seen too.
    lengths = np.array([1e3, 1.0])
    pair = assur.SliderCrank(0.1 * lengths, 0.4 * lengths)
    half_turns = Force("B", (lambda _, q, __: -1.0 if q < TURN else -1.1, 0.0))
    both = assur.Machine(pair, bodies={"crank": Body(inertia=1.0)}, loads=[half_turns])
    with pytest.raises(assur.MotionError, match="not periodic over a turn") as caught:
        both.flywheel(0.01, mean_speed=12.0)
    assert (caught.value.kind, caught.value.design) == ("not_periodic", (0,))
    # Of this mechanism the inertia is the same after a turn from 0, the assembly is not.
    kite = assur.Machine(
        assur.FourBar(1.0, 2.0, 3.0, 4.0),
        bodies={"crank": Body(inertia=0.2), "rocker": Body(inertia=2.0), "coupler": Body(mass=1.0)},
        loads=[TorsionDamper("rocker", 0.5)],
    )
    with pytest.raises(assur.MotionError, match=r"not periodic over this span.*turns=2"):
        kite.steady_state(5.0, q0=0.0, rtol=1e-9)


def test_steady_state_raises_at_the_step_limit() -> None:
    motor = assur.LinearMotor(90.0, 30.0)
    enough = press(motor).steady_state().run.statistics.steps
    for steps in (1, enough // 2):
        with pytest.raises(assur.MotionError, match="max_steps was reached at q = "):
            press(motor).steady_state(max_steps=steps)
    # One step short: the search ends, the period itself does not.
    with pytest.raises(assur.MotionError, match="max_steps was reached at q = "):
        press(motor).steady_state(max_steps=enough - 1)
    with pytest.raises(assur.MotionError, match="time limit was reached"):
        press(motor).steady_state(max_seconds=0.0)


def test_speeds_that_cannot_be_met() -> None:
    with pytest.raises(assur.MotionError, match="mean speed of 1 rad/s was found"):
        press().steady_state(1.0, mean="period")
    with pytest.raises(assur.MotionError, match="runs away"):
        press().steady_state(1e8, mean="period")
    overrun = assur.Machine(
        four_bar(),
        bodies={"crank": Body(inertia=0.05), "rocker": Body(mass=0.9, inertia=0.1)},
        loads=[Torque("crank", 50.0)],
        motor=assur.InductionMotor(3.78, 0.145, 14.64),
    )
    with pytest.raises(assur.MotionError, match="the steady speed is poorly determined"):
        overrun.steady_state()


def test_motors_that_are_not_constant_are_not_taken_for_it() -> None:
    swelling = assur.ConstantTorque(Table([0.0, math.pi, TURN], [0.0, 20.0, 0.0], spline="linear"))
    crank = {"crank": Body(inertia=0.5)}
    machine = assur.Machine(
        assur.SliderCrank(0.1, 0.4), bodies=crank, loads=[Torque("crank", -10.0)], motor=swelling
    )
    with pytest.raises(InputError, match="is not a constant motor"):
        machine.flywheel(0.001, mean_speed=10.0)
    torques: tuple[Any, ...] = (np.int64(500), np.float32(500.0))
    for torque in torques:
        given = press(assur.ConstantTorque(torque))
        with pytest.warns(assur.AssurWarning, match="500 N·m"):
            given.flywheel(0.05, mean_speed=20.0)
    listed = press([assur.ConstantTorque(28.45)])
    assert (
        listed.flywheel(0.05, mean_speed=20.0).inertia
        == press().flywheel(0.05, mean_speed=20.0).inertia
    )


def test_knots_without_number() -> None:
    machine = wheel(Torque("crank", Table([0.0, 3.0, TURN], [0.0, 1.0, 0.0], spline="linear")))
    for q0, q_end in ((0.0, 1e12), (1e17, 1e17 + 1e3)):
        with pytest.raises(InputError, match=r"more than 1e7 knots"):
            machine.run(q_end=q_end, q0=q0, speed0=1.0)
    fine = Table([0.0, TURN / 2e9, TURN / 1e9], [0.0, 1.0, 0.0], spline="linear")
    with pytest.raises(InputError, match="knots"):
        wheel(Torque("crank", fine)).steady_state(5.0)
    with pytest.raises(InputError, match="knots"):
        wheel(Torque("crank", fine)).flywheel(0.1, mean_speed=5.0)


def test_moments_of_rounding_are_the_same_a_turn_on() -> None:
    tilted = assur.SliderCrank(0.1, 0.4).with_dimensions({"bore.angle": 0.3})
    for loads in (
        [Torque("crank", 0.1), Torque("crank", 0.2), Torque("crank", -0.3)],
        [assur.Spring("O", "A", 100.0, 0.1)],
    ):
        bodies = {"crank": Body(inertia=0.5), "piston": Body(mass=20.0)}
        assert (
            assur.Machine(tilted, bodies=bodies, loads=loads)
            .flywheel(0.01, mean_speed=12.0)
            .inertia
            > 0.0
        )


def test_designs_that_are_others_a_turn_on_are_nan() -> None:
    lengths = ([3.0, 2.5, 4.0], [1.0, 2.5, 2.5], [3.0, 1.0, 4.5])
    bodies = {
        "crank": Body(inertia=0.1),
        "coupler": Body(mass=2.0, inertia=0.3),
        "rocker": Body(mass=1.0, inertia=0.2),
    }
    batch = assur.Machine(assur.FourBar(1.0, *lengths), bodies=bodies)
    with pytest.raises(assur.MotionError, match=r"design \(1,\): the reduced inertia") as caught:
        batch.flywheel(0.001, mean_speed=10.0)
    error = caught.value
    assert (error.kind, error.design) == ("inertia_not_periodic", (1,))
    # The same kind, and the same inertia there, as of the one design in a steady state.
    alone = batch.design(1)
    assert error.value == alone.reduced_inertia(error.q).value
    with pytest.raises(assur.MotionError) as caught:
        alone.steady_state(10.0)
    assert caught.value.kind == error.kind
    made = batch.flywheel(0.001, mean_speed=10.0, on_error="nan")
    assert np.isnan(made.inertia[1])
    assert made.inertia[2] == batch.design(2).flywheel(0.001, mean_speed=10.0).inertia


def test_steady_state_raises_at_a_dead_point() -> None:
    bodies = {"crank": Body(inertia=0.1), "rocker": Body(mass=1.0, inertia=0.2)}
    swinging = assur.Machine(
        assur.FourBar(2.0, 1.0, 3.0, 4.0), bodies=bodies, loads=(), motor=assur.LinearMotor(5, 9)
    )
    for turns in (1, 2):
        with pytest.raises(assur.PositionError, match=r"a dead point of dyad \"C\" at q = 1\.318"):
            swinging.steady_state(turns=turns, q0=0.5)
    with pytest.raises(assur.PositionError, match="the motion cannot start at q0"):
        swinging.steady_state(q0=math.pi)
