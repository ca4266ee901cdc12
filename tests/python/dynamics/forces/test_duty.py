"""The duty of a drive against closed forms and quadrature."""

from __future__ import annotations

import math
import pickle
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import minimize_scalar

import assur
from assur import Body, Force, Gravity, Machine, Spring, Torque, TorsionDamper, TorsionSpring
from models.machines.machines import cylinder, five_bar, four_bar, press

TURN = math.tau
OPEN = np.linspace(0.0, TURN, 360, endpoint=False)  # without the end of the turn
CLOSED = np.linspace(0.0, TURN, 361)


def near(found: Any, wanted: Any, rtol: float = 1e-12) -> None:
    np.testing.assert_allclose(found, wanted, rtol=rtol, atol=rtol)


def rotor(mass: float = 3.0, radius: float = 0.2, *loads: Any) -> Machine:
    m = assur.Mechanism(
        joints={"O": (0, 0), "A": (radius, 0)},
        links={"ground": ["O"], "rotor": ["O", "A"]},
        driver="rotor",
    )
    return Machine(
        m, bodies={"rotor": Body(mass=mass, inertia=0.05, at="A")}, loads=[Gravity(), *loads]
    )


@pytest.mark.parametrize("q", [OPEN, CLOSED, OPEN + 0.1234, CLOSED[::-1], OPEN[::-1], 3 * OPEN])
def test_a_weight_on_a_rotor(q: Any) -> None:
    """Effort m g r cos q: extremes m g r, rms m g r/√2, no energy, half of the work in a lift."""
    omega = math.copysign(4.0, q[1] - q[0])
    turns = abs(round((q[-1] - q[0]) / TURN))
    duty = rotor().duty(q, omega)
    most = 3.0 * 9.81 * 0.2
    np.testing.assert_allclose(duty.effort, most * np.cos(q), rtol=1e-13, atol=1e-13)
    steps = (q[1] - q[0]) ** 4 / 40
    near(duty.max.value, most, steps)
    near(duty.min.value, -most, steps)
    near(math.cos(duty.max.q), 1.0, 1e-9)
    near(math.cos(duty.min.q), -1.0, 1e-9)
    near(duty.rms, most / math.sqrt(2.0))
    near(duty.energy, 0.0)
    near([duty.work_in, duty.work_out], [2 * most * turns] * 2, 2 * steps)
    near(duty.power, duty.effort * omega)
    near([duty.max_power.value, duty.min_power.value], [4 * most, -4 * most], steps)
    near(duty.time, turns * TURN / 4.0)
    near(duty.mean_power, 0.0)


def test_a_constant_force_on_a_piston() -> None:
    """It gives back over one stroke, 2 r F, what it took over the other."""
    machine = Machine(assur.SliderCrank(0.1, 0.35), loads=[Force("B", (-800.0, 0.0))])
    duty = machine.duty(OPEN, 10.0)
    near([duty.work_in, duty.work_out], [160.0, 160.0], 1e-7)
    near(duty.energy, 0.0)

    def effort(q: float) -> float:
        sine = 0.1 * math.sin(q) / 0.35
        return (
            -800.0
            * 0.1
            * (math.sin(q) + 0.1 / 0.35 * math.sin(q) * math.cos(q) / math.sqrt(1 - sine * sine))
        )

    near(duty.effort, [effort(q) for q in OPEN], 1e-12)
    peak = minimize_scalar(effort, bounds=(0.5, 2.0), options={"xatol": 1e-12})
    near(duty.min.value, peak.fun, 1e-8)
    near(duty.min.q, peak.x, 1e-5)
    near(duty.rms, math.sqrt(quad(lambda q: effort(q) ** 2, 0, TURN)[0] / TURN), 1e-12)
    # Three quarters of the turn, of uneven steps, from their own definition.
    q = np.sort(np.append(np.random.default_rng(4).uniform(0.2, 4.7, 400), [0.2, 4.7]))
    part = machine.duty(q, 10.0)
    near(part.energy, quad(effort, 0.2, 4.7, epsabs=1e-12)[0], 1e-6)
    size = quad(lambda x: abs(effort(x)), 0.2, 4.7, points=[math.pi], epsabs=1e-12)[0]
    near(part.work_in + part.work_out, size, 1e-6)
    near(part.work_in - part.work_out, part.energy)
    near(part.rms, math.sqrt(quad(lambda x: effort(x) ** 2, 0.2, 4.7)[0] / 4.5), 1e-6)
    near(part.time, 0.45)


def test_the_mean_effort_is_the_net_work_of_the_loads() -> None:
    """At constant speed over a whole turn inertia, weights and springs do no work."""
    bodies = {
        "crank": Body(mass=3.0, inertia=0.4, at=(0.3, 0.2)),
        "coupler": Body(mass=2.0, inertia=0.5, at=(1.1, 0.4)),
    }
    idle: list[Any] = [Gravity(), Spring("P", "D", 30.0, 0.4), Force("C", (3.0, 9.0))]
    near(Machine(four_bar(), bodies=bodies, loads=idle).duty(OPEN, 7.0).energy, 0.0, 1e-10)
    loads = [*idle, TorsionDamper("rocker", 0.8), Torque("crank", -5.0)]
    duty = Machine(four_bar(), bodies=bodies, loads=loads).duty(OPEN, 7.0)

    def lost(q: float) -> float:
        rate = float(four_bar().solve(q).link("rocker").d1)
        return 5.0 + 0.8 * 7.0 * rate * rate

    wanted = quad(lost, 0.0, TURN, epsabs=1e-11, limit=200)[0]
    near(duty.energy, wanted, 1e-9)
    near(duty.mean_power * duty.time, duty.energy)
    near(np.mean(duty.effort) * TURN, duty.energy)
    near(duty.work_in - duty.work_out, duty.energy)
    near(duty.time, TURN / 7.0)


def test_numbers_change_with_the_fourth_power_of_the_step() -> None:
    mechanism = press().mechanism
    assert mechanism is not None
    machine = Machine(mechanism, bodies=press().bodies, loads=[Gravity()])
    fine = machine.duty(np.linspace(0.3, 2.9, 6401), 12.0)
    errors = []
    for count in (101, 201, 401):
        coarse = machine.duty(np.linspace(0.3, 2.9, count), 12.0)
        errors.append(
            [
                abs(coarse.energy - fine.energy),
                abs(coarse.work_in - fine.work_in),
                abs(coarse.rms - fine.rms),
                abs(coarse.max.value - fine.max.value),
            ]
        )
    assert (np.array(errors[0]) > 8 * np.array(errors[2])).all()
    assert (np.array(errors[2]) < 1e-7 * abs(fine.energy)).all()


def test_a_speed_that_changes_weights_means_by_time() -> None:
    """Speed s = ω (1 + cos q / 2): T = 2π/(ω √(1 − 1/4)); the damper takes c ∫ s dq."""
    mechanism = rotor().mechanism
    assert mechanism is not None
    machine = Machine(mechanism, bodies={}, loads=[TorsionDamper("rotor", 0.7)])
    omega = 5.0
    speed = omega * (1 + 0.5 * np.cos(OPEN))
    duty = machine.duty(OPEN, speed, -0.5 * omega * np.sin(OPEN) * speed)
    near(duty.time, TURN / (omega * math.sqrt(0.75)))
    near(duty.energy, 0.7 * omega * TURN)
    near(duty.mean_power, duty.energy / duty.time)
    # ∫ (c s)² dq / s over the time.
    near(duty.rms, math.sqrt(0.7**2 * omega * TURN / duty.time))
    near([duty.work_in, duty.work_out], [duty.energy, 0.0])
    assert duty.work_out >= 0.0


def test_the_drive_of_a_steady_state_is_its_motor() -> None:
    """Found by shooting: its effort is the motor's torque, its energy the motor's work."""
    bodies = {"crank": Body(inertia=0.5), "piston": Body(mass=20.0)}
    loads: list[Any] = [TorsionDamper("crank", 1.5), Gravity((0.0, -9.81))]
    motor = assur.LinearMotor(stall=90.0, no_load=30.0)
    machine = Machine(assur.SliderCrank(0.1, 0.4), bodies=bodies, loads=loads, motor=motor)
    steady = machine.steady_state(q0=0.0)
    state = steady.at(CLOSED)
    duty = machine.duty(CLOSED, state.speed, state.acceleration)
    near(duty.effort, 90.0 * (1.0 - state.speed / 30.0), 1e-7)
    near(duty.energy, steady.motor_work, 1e-8)
    near(duty.time, steady.period, 1e-8)
    near(duty.mean_power, steady.power, 1e-8)
    near([duty.work_in, duty.work_out], [duty.energy, 0.0], 1e-8)


def test_a_spring_that_winds_up_is_not_periodic() -> None:
    """Its effort k q does not end as it began: the range is that of the positions."""
    machine = rotor(0.0, 0.2, TorsionSpring("rotor", 2.0))
    for q in (OPEN, CLOSED):
        duty = machine.duty(q, 1.0)
        near(duty.energy, q[-1] ** 2)
        near(duty.max, (2.0 * q[-1], q[-1]))
        near(duty.min, (0.0, 0.0))


def test_few_positions() -> None:
    """Two and three positions: a line and a parabola."""
    machine = rotor(0.0, 0.2, TorsionSpring("rotor", 2.0))
    for count in (2, 3, 4, 5):
        duty = machine.duty(np.linspace(-1.0, 2.0, count), 3.0)
        near([duty.energy, duty.work_in, duty.work_out], [3.0, 4.0, 1.0])
        near(duty.time, 1.0)


def test_batches_and_failed_designs() -> None:
    m = assur.FourBar(1.0, 4.0, 3.0, 3.5).with_dimensions({"coupler.length": [[4.0, 9.0, 4.2]]})
    machine = Machine(m, bodies={"coupler": Body(mass=2.0, inertia=0.1)}, loads=[Gravity()])
    with pytest.raises(assur.PositionError, match=r"design \(0, 1\)"):
        machine.duty(OPEN, 5.0)
    duty = machine.duty(OPEN, 5.0, on_error="nan")
    assert duty.effort.shape == duty.power.shape == (1, 3, 360)
    numbers = [np.asarray(duty[k]) for k in (3, 5, 8, 9, 10, 11)]
    numbers += [np.asarray(one) for k in (1, 2, 6, 7) for one in duty[k]]
    for number in numbers:
        assert number.shape == (1, 3)
        assert np.isnan(number).tolist() == [[False, True, False]]
    for index in (0, 2):
        alone = machine.design((0, index)).duty(OPEN, 5.0)
        assert alone.rms == duty.rms[0, index]
        assert alone.max == (duty.max.value[0, index], duty.max.q[0, index])
        assert (alone.energy, alone.work_in) == (duty.energy[0, index], duty.work_in[0, index])
    # Each design with its own q: one covers the turn, the other a part of it.
    q = np.stack([OPEN, OPEN / 2, CLOSED[1:] + 9.0])[None]
    m = assur.FourBar(1.0, 4.0, 3.0, 3.5).with_dimensions({"coupler.length": [[4.0, 4.1, 4.2]]})
    machine = Machine(m, bodies={"coupler": Body(mass=2.0, inertia=0.1)}, loads=[Gravity()])
    duty = machine.duty(q, 5.0)
    for index in range(3):
        alone = machine.design((0, index)).duty(q[0, index], 5.0)
        assert (alone.energy, alone.rms) == (duty.energy[0, index], duty.rms[0, index])
        assert alone.min == (duty.min.value[0, index], duty.min.q[0, index])


def test_a_driven_slide_and_a_machine_of_tables() -> None:
    machine = Machine(
        cylinder(), bodies={"arm": Body(mass=9.0, inertia=0.3, at="P")}, loads=[Gravity()]
    )
    q = np.linspace(0.7, 1.2, 401)
    duty = machine.duty(q, 0.2)
    near(duty.time, 2.5)
    rise = machine.potential(q[-1]) - machine.potential(q[0])
    near(duty.energy, quad(lambda x: float(machine.effort(x, 0.2)), 0.7, 1.2)[0], 1e-8)
    still = Machine(
        cylinder(), bodies={"arm": Body(mass=9.0, inertia=0.0, at="P")}, loads=[Gravity()]
    )
    near(still.duty(q, 1e-9).energy, rise, 1e-8)
    phi = np.linspace(0.0, TURN, 100)
    table = Machine.from_table(phi, np.sin(phi) - 2.0, 1.0, spline="periodic")
    near(table.duty(OPEN, 1.0).energy, 2.0 * TURN, 1e-9)


def test_it_can_be_pickled() -> None:
    duty = rotor().duty(OPEN, 2.0)
    again = pickle.loads(pickle.dumps(duty))
    assert again.max == duty.max
    assert np.array_equal(again.effort, duty.effort)


REFUSED: list[tuple[Any, str]] = [
    ((0.5, 1.0), "two positions"),
    (([0.5], 1.0), "two positions"),
    (([], 1.0), "two positions"),
    ((np.empty((0, 4)), 1.0), ""),
    (([0.0, 1.0, 1.0], 1.0), "q goes from 1 to 1"),
    (([0.0, 1.0, 0.5], 1.0), "q goes from 1 to 0.5.*one stroke"),
    (([0.0, math.nan, 0.5], 1.0), "q has nan"),
    (([0.0, math.inf], 1.0), "q has inf"),
    (([0.0, 1.0], 0.0), r"speed is 0 at q = 0, though q ascends.*effort"),
    (([0.0, 1.0], -1.0), "speed is -1 at q = 0, though q ascends"),
    (([1.0, 0.0], 1.0), "speed is 1 at q = 1, though q descends"),
    (([0.0, 1.0], [1.0, 0.0]), "speed is 0 at q = 1"),
    (([0.0, 1.0], math.nan), "speed is nan"),
    (([0.0, 1.0], [1.0, 1.0, 1.0]), "speed has the shape"),
    (([0.0, 1.0], 1.0, math.inf), "acceleration is inf"),
    (([0.0, 1.0], 1.0, [1.0] * 3), "acceleration has the shape"),
    (("turn", 1.0), "q is 'turn'"),
    ((None, 1.0), "neither q nor deg is given"),
    (([0.0, 1.0], "fast"), "speed is 'fast'"),
]


@pytest.mark.parametrize(("arguments", "message"), REFUSED)
def test_what_is_no_motion_is_refused(arguments: Any, message: str) -> None:
    if not message:
        assert rotor().duty(*arguments).energy.shape == (0,)
        return
    with pytest.raises(assur.InputError, match=message):
        rotor().duty(*arguments)


def test_several_drivers_and_numbers_too_great_are_refused() -> None:
    with pytest.raises(assur.InputError, match=r"2 drivers.*effort"):
        Machine(five_bar(), bodies={}).duty(np.ones((4, 2)), 1.0)
    with pytest.raises(assur.InputError, match="on_error"):
        rotor().duty(OPEN, 1.0, on_error="skip")  # type: ignore[arg-type]
    great = rotor(0.0, 0.2, Torque("rotor", 1e300))
    with pytest.raises(assur.MotionError, match="too great"):
        great.duty(OPEN, 1e100)
    near(great.duty(OPEN, 1.0).rms / 1e300, 1.0)
    tiny = rotor(0.0, 0.2, Torque("rotor", 1e-300)).duty(OPEN, 1.0)
    near([tiny.rms * 1e300, tiny.work_in], [1.0, 0.0])
