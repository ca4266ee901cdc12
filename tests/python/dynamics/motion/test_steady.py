"""Periodic motions: closed forms, the energy integral of tables, and waiting."""

from __future__ import annotations

import math
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest

import assur
import press_motion
from assur import Body, InputError, Torque, flywheel
from models.machines.machines import press

TURN = math.tau
ANY: Any = "median"  # what types would not let pass
PAPER_PHI = np.linspace(0.0, TURN, 9)
PAPER_MOMENT = [-0.23, -274.4, -950.5, 19.9, 1.26, -300.0, -23.9, -15.9, -0.23]
PAPER_INERTIA = np.array([4.93, 5.07, 5.1, 5.1, 4.93, 5.05, 5.1, 5.14, 4.93])


def wheel(load: float, motor: Any, inertia: float = 2.0) -> assur.Machine:
    """A crank with an inertia and a constant load: nothing else has mass."""
    crank = {"crank": Body(inertia=inertia)}
    return assur.Machine(
        assur.SliderCrank(0.1, 0.4), bodies=crank, loads=[Torque("crank", -load)], motor=motor
    )


@pytest.mark.parametrize("span", [1, 2, 3])
def test_tables_without_a_motor_are_their_energy_integral(span: int) -> None:
    """`assur.flywheel` knows no integrator; here the moment is found too."""
    exact = flywheel.evaluate(
        PAPER_PHI, PAPER_MOMENT, PAPER_INERTIA, flywheel=19.918150, mean_speed=15.0, mean="period"
    )
    machine = assur.Machine.from_table(PAPER_PHI, PAPER_MOMENT, PAPER_INERTIA)
    own = machine.steady_state(15.0, turns=span, mean="period", flywheel=19.918150)
    assert abs(own.mean_speed - 15.0) < 1e-10
    assert abs(own.delta - exact.delta) < 1e-11
    assert abs(own.motor_moment - exact.motor_moment) < 1e-9
    assert abs(own.found_moment - exact.motor_moment) < 1e-9
    assert abs(own.max.value - exact.max.value) < 1e-10
    assert abs(own.min.value - exact.min.value) < 1e-10
    assert abs(own.max.q % TURN - exact.max.q) < 1e-7
    assert abs(own.period - span * exact.period) < 1e-10
    assert abs(own.multiplier - 1.0) < 1e-10
    at = own.at(np.linspace(-10.0, 30.0, 17))
    assert np.abs(at.speed - exact.speed(at.q)).max() < 1e-9
    assert np.abs(at.t - exact.time(at.q)).max() < 1e-9


def test_a_linear_motor_under_a_constant_load() -> None:
    """ω = n (1 − L/M); a change dies away as exp(−2π M / (n J ω))."""
    for ratio in (1.0, -3.0):
        motor = assur.LinearMotor(50.0, 40.0, ratio=ratio, rotor_inertia=0.1)
        own = wheel(math.copysign(20.0, ratio), motor).steady_state(mean="period")
        load, inertia = 20.0 / abs(ratio), 2.0 + 0.1 * ratio**2
        speed = 40.0 * (1.0 - load / 50.0) / abs(ratio)
        assert abs(own.mean_speed - speed) < 1e-11
        assert own.delta < 1e-11
        assert math.copysign(1.0, own.speed[0]) == math.copysign(1.0, ratio)
        damping = ratio**2 * 50.0 / 40.0
        assert abs(own.multiplier - math.exp(-TURN * damping / (inertia * speed))) < 1e-10
        assert abs(own.motor_work - 20.0 * TURN) < 1e-8
        assert abs(own.power - 20.0 * speed) < 1e-8
        assert abs(own.motor_moment - math.copysign(20.0, ratio)) < 1e-9


def test_an_induction_motor_runs_on_its_stable_side() -> None:
    motor = assur.InductionMotor(breakdown=60.0, slip=0.2, synchronous=100.0)
    for load in (1.0, 30.0, 59.9):
        own = wheel(load, motor, 50.0).steady_state()
        # 2 M s sb / (s² + sb²) = L.
        slip = 0.2 * (60.0 - math.sqrt(60.0**2 - load**2)) / load
        assert abs(own.mean_speed - 100.0 * (1.0 - slip)) < 1e-7
        assert own.multiplier < 1.0
    for load in (60.1, 100.0):
        with pytest.raises(assur.MotionError, match="never makes up for the loads"):
            wheel(load, motor, 50.0).steady_state()


def test_a_table_of_torque_over_speed() -> None:
    motor = assur.Table([-5.0, 10.0, 20.0, 30.0], [60.0, 50.0, 45.0, 0.0], spline="linear")
    own = wheel(30.0, motor).steady_state()
    assert abs(own.mean_speed - (30.0 - 30.0 / 4.5)) < 1e-10
    # A load over the turn moves the speed through the knot at 20.
    phi = np.linspace(0.0, TURN, 13)
    moment = -40.0 - 35.0 * np.sin(phi)
    moment[-1] = moment[0]
    machine = assur.Machine.from_table(
        phi, moment, np.full(13, 1.0), motor=motor, spline="periodic"
    )
    own = machine.steady_state()
    assert own.min.value < 20.0 < own.max.value
    later = machine.run(60.0, q0=0.0, speed0=25.0, rtol=1e-12)
    settled = (later.q > later.q[-1] - TURN) & (later.q < later.q[-1])
    assert np.abs(later.speed[settled] - own.at(later.q[settled]).speed).max() < 1e-9
    with pytest.raises(InputError, match=r"table ends at 30"):
        wheel(-10.0, motor).steady_state()


@pytest.mark.parametrize(
    "motor",
    [
        assur.LinearMotor(90.0, 30.0),
        assur.InductionMotor(30.0, 0.3, 300.0, ratio=10.0, rotor_inertia=0.05),
    ],
    ids=["linear", "induction"],
)
def test_shooting_is_waiting(motor: Any) -> None:
    machine = press(motor)
    own = machine.steady_state()
    run = machine.run(60.0, q0=0.0, speed0=25.0, rtol=1e-12)
    last = (run.q > run.q[-1] - TURN) & (run.q < run.q[-1])
    assert np.abs(run.speed[last] - own.at(run.q[last]).speed).max() < 1e-9
    assert own.delta > 0.02
    # What a change becomes, by differences of whole runs.
    q0, speed = own.q[0], own.speed[0]
    ends = []
    for part in (-1e-4, 1e-4):
        end = machine.run(q_end=q0 + TURN, q0=q0, speed0=speed * (1.0 + part), rtol=1e-13)
        ends.append(end.speed[-1] ** 2)
    change = (ends[1] - ends[0]) / (speed**2 * 4e-4)
    assert abs(change - own.multiplier) < 1e-7
    assert own.multiplier > 1e-4
    # All work of a turn: that of the motor, of the load, of the weights none.
    assert abs(own.run.energy.kinetic[-1] - own.run.energy.kinetic[0]) < 1e-9 * own.motor_work
    assert own.run.energy.error < 1e-11


def test_extremes_are_those_of_the_curve() -> None:
    own = press(assur.LinearMotor(90.0, 30.0)).steady_state()
    curve = own.at(np.linspace(0.0, TURN, 20001))
    assert abs(curve.speed.max() - own.max.value) < 1e-6
    assert abs(curve.speed.min() - own.min.value) < 1e-6
    assert (curve.speed <= own.max.value + 1e-12).all()
    assert (curve.speed >= own.min.value - 1e-12).all()
    assert abs(own.at(own.max.q).acceleration) < 1e-6


def test_dampers_and_functions() -> None:
    damped = press(assur.ConstantTorque(60.0), loads=[assur.TorsionDamper("crank", 4.0)])
    with pytest.raises(InputError, match="speed="):
        damped.steady_state()
    own = damped.steady_state(10.0, flywheel=20.0)

    def brake(_: float, __: float, speed: float) -> float:
        return -4.0 * speed

    braked = press(assur.ConstantTorque(60.0), loads=[Torque("crank", brake)])
    called = braked.steady_state(10.0, flywheel=20.0)
    assert abs(called.mean_speed - own.mean_speed) < 1e-9
    assert abs(called.multiplier - own.multiplier) < 1e-6

    def later(t: float, _: float, speed: float) -> float:
        return -4.0 * speed - 0.1 * t

    with pytest.raises(assur.MotionError, match="depends on the time"):
        press(assur.ConstantTorque(60.0), loads=[Torque("crank", later)]).steady_state(
            10.0, flywheel=20.0
        )
    # Without a motor: the moment that keeps the mean speed.
    kept = press(loads=[assur.TorsionDamper("crank", 4.0)]).steady_state(15.0, mean="period")
    again = press(
        assur.ConstantTorque(kept.found_moment), loads=[assur.TorsionDamper("crank", 4.0)]
    ).steady_state(12.0, mean="period")
    assert abs(again.mean_speed - 15.0) < 1e-8


def test_a_constant_motor_must_be_in_balance() -> None:
    free = press().steady_state(12.0, mean="period")
    assert abs(free.mean_speed - 12.0) < 1e-10
    assert abs(free.multiplier - 1.0) < 1e-9
    # Rounded to three digits it is balanced.
    rounded = press(assur.ConstantTorque(round(free.found_moment, 1)))
    with pytest.warns(assur.AssurWarning, match=r"0\.0487 N·m more than the motor gives"):
        own = rounded.steady_state(12.0)
    assert abs(own.found_moment) < 0.1
    assert abs(own.motor_moment - free.motor_moment) < 1e-8
    with pytest.raises(assur.MotionError, match=r"mean moment is 80 N·m where [\d.]+ N·m would be"):
        press(assur.ConstantTorque(80.0)).steady_state(12.0)


@pytest.mark.parametrize("mean", ["extremes", "period"])
def test_flywheel_with_a_motor(mean: Any) -> None:
    machine = press(assur.InductionMotor(150.0, 0.3, 300.0, ratio=10.0, rotor_inertia=0.01))
    without = machine.steady_state(mean=mean)
    own = machine.flywheel(0.02, mean=mean)
    assert without.delta > 0.02
    assert abs(own.delta - 0.02) < 1e-10
    assert own.inertia > 1.0
    again = machine.steady_state(flywheel=own.inertia, mean=mean)
    assert abs(again.delta - 0.02) < 1e-10
    with pytest.raises(InputError, match=r"none is needed"):
        machine.flywheel(without.delta * 1.01, mean=mean)


def test_flywheel_of_a_weak_motor() -> None:
    """Without a flywheel the machine would stop; with one it does not."""
    machine = press(assur.LinearMotor(40.0, 9.0))
    with pytest.raises(assur.MotionError, match=r"cannot carry the load: .*stalls at q = 5\.759"):
        machine.steady_state()
    own = machine.flywheel(0.1)
    assert abs(own.delta - 0.1) < 1e-10


def test_two_turns_of_a_kite() -> None:
    kite = assur.FourBar(1.0, 1.0, 2.0, 2.0)
    bodies = {"crank": Body(inertia=1.0), "rocker": Body(inertia=0.5)}
    machine = assur.Machine(kite, bodies=bodies, motor=assur.LinearMotor(5.0, 8.0))
    own = machine.steady_state(turns=2, q0=1.0, rtol=1e-10)
    assert abs(own.q[-1] - own.q[0] - 2 * TURN) < 1e-12
    run = machine.run(60.0, q0=1.0, speed0=7.0)
    place = 1.0 + 2 * TURN * math.floor((run.q[-1] - 1.0) / (2 * TURN))
    crossed = machine.run(60.0, q0=1.0, speed0=7.0, events=[assur.events.Position(place)])
    assert abs(crossed.speed[-1] - own.speed[0]) < 1e-6


def test_pictures() -> None:
    steady = press(assur.LinearMotor(90.0, 30.0)).steady_state()
    ax = steady.plot()
    assert ax.lines[0].get_gid() == "curve speed"
    q, speeds = map(np.asarray, ax.lines[0].get_data())
    assert np.ptp(q) == pytest.approx(TURN)
    np.testing.assert_allclose(speeds, steady.at(q).speed, rtol=1e-12)
    run = press(assur.LinearMotor(90.0, 30.0)).run(
        1.0, events=[assur.events.Position(3.0, stop=False)]
    )
    for what in ("speed", "q", "acceleration", "energy"):
        ax = run.plot(what)
        t, drawn = map(np.asarray, ax.lines[0].get_data())
        assert (t[0], t[-1]) == (run.t[0], run.t[-1])
        own = run.energy.kinetic if what == "energy" else getattr(run.at(t), what)
        np.testing.assert_array_equal(drawn, own)
    with pytest.raises(InputError, match="what is 'jerk'"):
        run.plot("jerk")
    plt.close("all")


def test_the_picture_of_the_example_shows_the_start_and_both_periodic_motions() -> None:
    figure = press_motion.draw(press_motion.press())
    start, periodic = (ax.lines for ax in figure.axes)
    t, speed = next(line for line in start if line.get_gid() == "curve crank").get_data()
    assert (t[0], t[-1], speed[0]) == (0.0, 3.0, 0.0)
    # It begins at a dead point, where the piston rests: the rod turns 0.08/0.3 as fast as the
    # crank, and its centre of mass moves with 2/3 of the speed of the crank pin. The motor by
    # Kloss's formula, halfway to the first point.
    inertia = 0.2 + 12.0**2 * 0.01 + 0.08 * (0.08 / 0.3) ** 2 + 6.0 * (0.08 * 2.0 / 3.0) ** 2
    slip = 1.0 - 12.0 * speed[1] / 2.0 / 157.08
    torque = 12.0 * 2.0 * 32.0 / (slip / 0.25 + 0.25 / slip)
    assert speed[1] / t[1] == pytest.approx(torque / inertia, rel=1e-3)
    deltas = []
    bare, wheeled = (line.get_data() for line in periodic)
    for q, speeds in (bare, wheeled):
        assert (q[0], q[-1]) == (0.0, TURN)
        assert speeds[0] == pytest.approx(speeds[-1], rel=1e-9)
        deltas.append(2.0 * np.ptp(speeds) / (speeds.max() + speeds.min()))
    # The start has come to the motion without a flywheel; the flywheel is for δ = 0.05.
    assert bare[1].min() < speed[-1] < bare[1].max()
    assert deltas[1] == pytest.approx(0.05, rel=1e-3)  # between the points drawn
    for delta, line in zip(deltas, periodic, strict=True):
        assert f"δ = {delta:.3g}" in str(line.get_label())
    plt.close("all")


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: press().steady_state(0.0), "speed is 0"),
        (lambda: press(assur.LinearMotor(9.0, 30.0)).steady_state(turns=0), "turns is 0"),
        (lambda: press().steady_state(5.0, flywheel=-1.0), "flywheel = -1"),
        (lambda: press().steady_state(5.0, mean=ANY), "mean is 'median'"),
        (
            lambda: press(
                loads=[Torque("crank", assur.Table([0.0, 9.0], [1.0, 1.0]))]
            ).steady_state(5.0),
            "a table's period of 9 rad does not fit",
        ),
        (
            lambda: press(
                loads=[Torque("crank", assur.Table([0.0, 9.0], [1.0, 2.0], periodic=False))]
            ).steady_state(5.0),
            "not periodic",
        ),
        (
            lambda: press(assur.LinearMotor(90.0, 30.0)).flywheel(0.1, mean_speed=20.0),
            "omit mean_speed",
        ),
        (lambda: press().flywheel(0.1), "mean_speed is needed"),
    ],
)
@pytest.mark.filterwarnings("ignore:.*degrees")
def test_refusals(make: Any, said: str) -> None:
    with pytest.raises(InputError, match=said):
        make()


def test_refusals_with_a_kind() -> None:
    with pytest.raises(InputError) as caught:
        press().steady_state()
    assert (caught.value.kind, caught.value.hint is None) == ("needs_speed", False)
    for wanted in (2.5, 0.0, -1.0):
        # The same of the machine's own motor and of tables.
        for machine, mean_speed in ((press(assur.LinearMotor(90.0, 30.0)), None), (press(), 20.0)):
            with pytest.raises(InputError) as caught:
                machine.flywheel(wanted, mean_speed=mean_speed)
            assert (caught.value.kind, caught.value.value) == ("bad_fluctuation", wanted)


def test_a_stall_is_a_motion_error() -> None:
    with pytest.raises(assur.MotionError) as caught:
        press(assur.LinearMotor(2.0, 30.0)).steady_state()
    assert (caught.value.kind, caught.value.value) == ("stops", 30.0)
    assert 0.0 < float(caught.value.q) <= TURN  # type: ignore[arg-type]


def test_a_dead_point_is_the_same_error_in_a_steady_state_and_in_solve() -> None:
    swinging = assur.FourBar(2.0, 3.0, 3.0, 4.5)
    machine = assur.Machine(
        swinging, bodies={"crank": Body(inertia=1.0), "rocker": Body(inertia=1.0)}
    )
    with pytest.raises(assur.PositionError) as caught:
        machine.steady_state(5.0)
    assert (caught.value.kind, caught.value.joint, caught.value.group) == ("dead_point", "C", "C")
    # The law of cosines: crank and ground span 2 + 4.5² − 2·2·4.5 cos q = 6².
    reached = math.acos((2.0**2 + 4.5**2 - 6.0**2) / (2.0 * 2.0 * 4.5))
    assert caught.value.q == pytest.approx(reached, abs=1e-6)
    with pytest.raises(assur.PositionError) as caught:
        swinging.solve(reached + 1e-3)
    assert (caught.value.kind, caught.value.joint, caught.value.group) == ("not_closed", "C", "C")
