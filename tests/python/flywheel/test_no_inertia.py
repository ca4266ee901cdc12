"""Turning-moment diagrams alone: machines whose inertia is all in the flywheel, or in a rotor."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import assur
from assur import InputError, Machine, flywheel
from models.errors.refusals import refused

TURN = 2.0 * math.pi
PHI = np.linspace(0.0, TURN, 1441)
# Khurmi & Gupta, Theory of Machines, chapter 16: crank effort of a multi-cylinder engine, N·m.
SINE, COSINE, SPEED, DELTA = 9500.0, -5700.0, 6.0 * math.pi, 0.01
MOMENT = 20000.0 + SINE * np.sin(2.0 * PHI) + COSINE * np.cos(2.0 * PHI)
# M − mean = R sin(2 φ + ψ): the work between its zeros is R/2 · 2.
ENERGY = math.hypot(SINE, COSINE)


def test_the_flywheel_of_a_turning_moment_diagram_is_the_textbooks() -> None:
    """I = ΔE / (δ ω²), exact for the mean of the extremes: ω₁² − ω₂² = 2 δ ω²."""
    exact = ENERGY / (DELTA * SPEED**2)
    assert exact == pytest.approx(3118.1055575, abs=1e-7)
    made = flywheel.from_table(PHI, MOMENT, fluctuation=DELTA, mean_speed=SPEED)
    # The spline through rows h apart is off by some h⁴/384 of the fourth derivative, 4e-11 of it.
    assert made.inertia == pytest.approx(exact, rel=1e-9)
    assert made.mean_speed == pytest.approx(SPEED, rel=1e-14)
    assert made.delta == pytest.approx(DELTA, rel=1e-12)
    assert made.motor_moment == pytest.approx(-20000.0, rel=1e-12)


@pytest.mark.parametrize("zero", [0.0, 0, 0.0 * PHI, np.zeros((2, 1441))])
def test_zero_inertia_is_zero_however_it_is_written(zero: Any) -> None:
    one = flywheel.from_table(PHI, MOMENT, fluctuation=DELTA, mean_speed=SPEED)
    made = flywheel.from_table(PHI, MOMENT, zero, fluctuation=DELTA, mean_speed=SPEED)
    assert np.unique(made.inertia).tolist() == [one.inertia]


@pytest.mark.parametrize("mean", ["extremes", "period"])
def test_an_inertia_of_its_own_is_taken_off_the_flywheel(mean: Any) -> None:
    """A constant one: the flywheel is less by as much."""
    bare = flywheel.from_table(PHI, MOMENT, 0.0, fluctuation=DELTA, mean_speed=SPEED, mean=mean)
    own = flywheel.from_table(PHI, MOMENT, 70.0, fluctuation=DELTA, mean_speed=SPEED, mean=mean)
    assert own.inertia + 70.0 == pytest.approx(bare.inertia, rel=1e-12)
    assert own.max.value == pytest.approx(bare.max.value, rel=1e-12)
    again = flywheel.evaluate(PHI, MOMENT, 0.0, flywheel=bare.inertia, mean_speed=SPEED, mean=mean)
    assert again.delta == pytest.approx(DELTA, rel=1e-10)


def test_the_speed_over_the_turn_is_the_energy_integral() -> None:
    made = flywheel.from_table(PHI, MOMENT, fluctuation=DELTA, mean_speed=SPEED)
    q = np.linspace(0.0, TURN, 37)
    work = SINE * (1.0 - np.cos(2.0 * q)) / 2.0 + COSINE * np.sin(2.0 * q) / 2.0
    squared = made.speed0**2 + 2.0 * work / made.inertia
    np.testing.assert_allclose(made.speed(q), np.sqrt(squared), rtol=1e-11)


@pytest.mark.parametrize("spline", ["linear", "not-a-knot"])
def test_the_inertia_may_be_zero_in_a_part_of_the_turn(spline: Any) -> None:
    """ω² (I + K) gains twice the work, and the wanted extremes are met."""
    smooth = np.clip(np.sin(PHI), 0.0, None) ** 2
    inertia = 400.0 * (smooth if spline == "linear" else smooth**2)
    made = flywheel.from_table(
        PHI, MOMENT, inertia, fluctuation=DELTA, mean_speed=SPEED, spline=spline
    )
    assert made.delta == pytest.approx(DELTA, rel=1e-10)
    q = np.linspace(0.0, TURN, 97)
    gain = np.square(made.speed(q)) * (made.reduced_inertia(q) + made.inertia)
    gain = gain - made.speed0**2 * (made.reduced_inertia(0.0) + made.inertia)
    np.testing.assert_allclose(gain, 2.0 * made.work(q), rtol=1e-9, atol=1e-6 * ENERGY)


def test_a_machine_without_inertia_is_refused() -> None:
    wheels: list[Any] = [0.0, [5000.0, 0.0]]
    for wheel in wheels:
        with pytest.raises(InputError, match=r"flywheel of 0 kg·m².*give the machine an inertia"):
            flywheel.evaluate(PHI, MOMENT, 0.0, flywheel=wheel, speed0=SPEED)
        with pytest.raises(InputError, match=r"flywheel of 0 kg·m².*give the machine an inertia"):
            flywheel.evaluate(PHI, MOMENT, 0.0, flywheel=wheel, mean_speed=SPEED)
    part = np.where(PHI < 1.0, 0.0, 5000.0)
    part[-1] = 0.0
    with pytest.raises(InputError, match="at phi = 0 rad with a flywheel of 0"):
        flywheel.evaluate(PHI, MOMENT, part, mean_speed=SPEED, spline="linear")


def test_negative_inertia_is_refused_where_it_is() -> None:
    inertia = np.zeros(1441)
    inertia[700] = -1e-9
    makes: list[tuple[Any, dict[str, float]]] = [
        (flywheel.from_table, {"fluctuation": DELTA}),
        (flywheel.evaluate, {"flywheel": 9.0}),
    ]
    for make, more in makes:
        with pytest.raises(InputError, match=r"-1e-9 kg·m² at phi = 3\.05"):
            make(PHI, MOMENT, inertia, mean_speed=SPEED, **more)
    with pytest.raises(InputError, match=r"-1e-09 kg·m² at phi = 3\.05"):
        Machine.from_table(PHI, MOMENT, inertia)
    refused(
        InputError,
        "inertia -2",
        lambda: flywheel.from_table(PHI, MOMENT, -2.0, fluctuation=DELTA, mean_speed=SPEED),
    )
    # A coarse spline beside rows of zero goes far below them.
    coarse = [0.0, 0.0, 0.0, 9.0, 9.0, 0.0, 0.0]
    phi, moment = np.linspace(0.0, TURN, 7), np.zeros(7)
    refused(
        InputError,
        'negative spline="linear"',
        lambda: flywheel.from_table(phi, moment, coarse, fluctuation=DELTA, mean_speed=SPEED),
    )


def test_both_fluctuation_and_mean_speed_are_needed() -> None:
    make: Any = flywheel.from_table
    refused(InputError, "mean_speed missing", lambda: make(PHI, MOMENT, fluctuation=0.01))
    refused(InputError, "fluctuation missing", lambda: make(PHI, MOMENT, mean_speed=SPEED))


def test_a_machine_of_a_table_may_have_its_rotor_alone() -> None:
    """ω² J/2 gains the work of loads and motor; J is the rotor's."""
    work_of_turn = 20000.0 * TURN
    motor = assur.ConstantTorque(-10000.0, ratio=2.0, rotor_inertia=50.0)
    machine = Machine.from_table(PHI, MOMENT, motor=motor)
    assert machine.reduced_inertia([0.0, 1.0]).value.tolist() == [200.0, 200.0]
    run = machine.run(q_end=TURN, q0=0.0, speed0=40.0)
    np.testing.assert_allclose(run.speed[-1], 40.0, rtol=1e-9)
    # At a quarter turn (π/2) the sine alone has done work, SINE; the mean is balanced.
    quarter = run.at(q=0.5 * math.pi).speed
    assert quarter == pytest.approx(math.sqrt(40.0**2 + 2.0 * SINE / 200.0), rel=1e-9)
    steady = machine.steady_state(SPEED)
    assert abs(steady.motor_work) == pytest.approx(work_of_turn, rel=1e-9)
    assert steady.mean_speed == pytest.approx(SPEED, rel=1e-11)
    wheel = machine.flywheel(DELTA, mean_speed=SPEED)
    assert isinstance(wheel, flywheel.Flywheel)
    assert wheel.inertia == pytest.approx(ENERGY / (DELTA * SPEED**2) - 200.0, rel=1e-9)


def test_a_machine_of_a_table_may_have_its_flywheel_alone() -> None:
    machine = Machine.from_table(PHI, MOMENT)
    wheel = ENERGY / (DELTA * SPEED**2)
    steady = machine.steady_state(SPEED, flywheel=wheel)
    assert steady.delta == pytest.approx(DELTA, rel=1e-9)
    assert steady.found_moment == pytest.approx(-20000.0, rel=1e-9)
    made = machine.flywheel(DELTA, mean_speed=SPEED)
    assert made.inertia == pytest.approx(wheel, rel=1e-9)
    # A motor whose torque falls with the speed, without a rotor: the flywheel is found.
    linear = Machine.from_table(PHI, -MOMENT, motor=assur.LinearMotor(40000.0, 2.0 * SPEED))
    evened = linear.flywheel(0.02)
    assert evened.delta == pytest.approx(0.02, rel=1e-9)


def test_without_any_inertia_a_machine_of_a_table_does_not_move() -> None:
    machine = Machine.from_table(PHI, MOMENT, motor=assur.ConstantTorque(-20000.0))
    for ask in (
        lambda: machine.run(1.0, 0.0, 5.0),
        lambda: machine.run(q_end=1.0, q0=0.0, speed0=5.0),
        lambda: machine.steady_state(5.0),
    ):
        with pytest.raises(InputError, match="the reduced inertia is 0 kg·m² at q = 0"):
            ask()


def test_a_place_without_inertia_is_named() -> None:
    """A piston alone: at its dead points nothing resists the crank, but for rounding."""
    press = Machine(assur.SliderCrank(0.1, 0.4), bodies={"piston": assur.Body(mass=20.0)})
    for q0 in (0.0, math.pi):
        with pytest.raises(InputError, match=r"the reduced inertia is \S+ kg·m² at q = .*positive"):
            press.steady_state(5.0, q0=q0)
    # With a flywheel it runs, and the flywheel is found.
    wheel = press.flywheel(0.05, mean_speed=20.0)
    assert isinstance(wheel, flywheel.Flywheel)
    steady = press.steady_state(20.0, flywheel=wheel.inertia)
    assert steady.delta == pytest.approx(0.05, rel=1e-9)


def test_statics_needs_no_bodies() -> None:
    """Virtual work: the crank's moment is the force times the piston's analogue."""
    press = assur.SliderCrank(0.1, 0.4)
    q = np.linspace(0.2, 6.0, 9)
    machine = Machine(press, loads=[assur.Force("B", (-1000.0, 0.0))])
    expected = -1000.0 * press.solve(q).slide("bore").d1
    np.testing.assert_allclose(machine.reduced_moment(q), expected, rtol=1e-14)
    assert dict(machine.bodies) == {}
    np.testing.assert_array_equal(machine.reduced_inertia(q).value, np.zeros(9))
    refused(InputError, "reduced inertia is 0", lambda: machine.run(1.0))
