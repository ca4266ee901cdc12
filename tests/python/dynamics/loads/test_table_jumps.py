"""A coordinate given twice in a table is a jump, and motions restart there."""

from __future__ import annotations

import copy
import math
import pickle
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad

import assur
from assur import Body, Force, Machine, Table, Torque
from models.machines.shapers import TURN, integral, place, slider

STEP = Table([0.0, 1.0, 1.0, 4.0, 4.0, TURN], [0.0, 0.0, -30.0, -50.0, 0.0, 0.0], spline="linear")


def step(q: float) -> float:
    within = q % TURN
    return -30.0 - 20.0 * (within - 1.0) / 3.0 if 1.0 < within < 4.0 else 0.0


def loaded(*loads: Any, inertia: float = 2.0) -> Machine:
    return Machine(slider(), bodies={"crank": Body(inertia=inertia)}, loads=loads)


@pytest.mark.parametrize("spline", ["not-a-knot", "natural", "clamped", "linear"])
def test_pieces_are_tables_of_their_own(spline: assur.flywheel.Spline) -> None:
    knots, values = np.array([0.0, 0.3, 1.0, 1.4, 2.0]), np.array([1.0, 2.0, -1.0, 3.0, 0.5])
    later, others = np.array([2.0, 2.7, 3.0, 4.0]), np.array([7.0, 5.0, 6.0, 1.0])
    whole = Table(
        np.concatenate([knots, later]),
        np.concatenate([values, others]),
        spline=spline,
        periodic=False,
    )
    halves = [
        Table(x, y, spline=spline, periodic=False) for x, y in ((knots, values), (later, others))
    ]
    for half, x in zip(halves, ([0.0, 0.2, 1.9999999], [2.0, 2.2, 3.9, 4.0]), strict=True):
        np.testing.assert_array_equal(whole.at(x), half.at(x))
    assert whole.at(2.0) == 7.0
    assert np.isnan(whole.at([-0.1, 4.1])).all()


def test_a_period_may_jump_at_its_seam() -> None:
    saw = Table([0.0, 0.0, 3.0], [1.0, 4.0, 1.0], spline="linear")
    same = Table([0.0, 3.0, 3.0], [4.0, 1.0, 4.0], spline="linear")
    x = [-0.5, 0.0, 1.0, 2.5, 3.0, 4.0]
    np.testing.assert_allclose(saw.at(x), [1.5, 4.0, 3.0, 1.5, 4.0, 3.0], rtol=1e-15)
    np.testing.assert_array_equal(saw.at(x), same.at(x))


def test_moments_have_the_value_behind_a_jump() -> None:
    q = np.array([0.5, 1.0, 2.5, 4.0, 5.0, 1.0 + 3 * TURN])
    found = loaded(Torque("crank", STEP)).reduced_moment(q)
    np.testing.assert_allclose(found, [0.0, -30.0, -40.0, 0.0, 0.0, -30.0], rtol=1e-12)


@pytest.mark.parametrize("back", [False, True])
def test_a_run_gains_the_integral(back: bool) -> None:
    run = loaded(Torque("crank", STEP)).run(
        t_end=2.0, q0=0.0, speed0=-20.0 if back else 20.0, rtol=1e-12
    )
    q = np.linspace(run.q[0], run.q[-1], 7)[1:]
    inside = [run.at(np.interp(at, *sort(run.q, run.t))) for at in q]
    for state in inside:
        cuts = [1.0 + TURN * k for k in range(-9, 9)] + [4.0 + TURN * k for k in range(-9, 9)]
        cuts += [TURN * k for k in range(-9, 9)]
        low, high = sorted((float(state.q), 0.0))
        work = -integral(step, low, high, *cuts) if back else integral(step, low, high, *cuts)
        assert 0.5 * 2.0 * (state.speed**2 - 400.0) == pytest.approx(work, abs=1e-8)
    assert run.energy.error < 1e-12
    assert {1.0, 4.0} <= {round(abs(x) if not back else x % TURN, 12) for x in run.q}


def sort(q: np.ndarray, t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    order = np.argsort(q)
    return q[order], t[order]


def test_both_ways_along_q_and_in_time_agree() -> None:
    machine = loaded(Torque("crank", STEP))
    along = machine.run(q_end=9.0, q0=0.2, speed0=20.0, rtol=1e-12)
    in_time = machine.run(t_end=float(along.t[-1]), q0=0.2, speed0=20.0, rtol=1e-12)
    assert in_time.q[-1] == pytest.approx(9.0, abs=1e-11)
    assert in_time.speed[-1] == pytest.approx(float(along.speed[-1]), rel=1e-12)


def test_a_steady_state_takes_what_the_motor_gives() -> None:
    motor = assur.LinearMotor(stall=60.0, no_load=40.0)
    machine = Machine(
        slider(), bodies={"crank": Body(inertia=2.0)}, loads=[Torque("crank", STEP)], motor=motor
    )
    steady = machine.steady_state()
    taken = -integral(step, 0.0, TURN, 1.0, 4.0)
    assert steady.power * steady.period == pytest.approx(taken, rel=1e-11)
    assert steady.delta > 0.01


def test_a_flywheel_by_hand() -> None:
    # Nothing has mass but the flywheel: I δ ω² is the greatest excess of energy. The motor gives
    # the mean moment, which between the jumps falls short of the load's 20 N·m over 3 rad.
    load = Table(
        [0.0, 1.0, 1.0, 4.0, 4.0, TURN], [0.0, 0.0, -20.0, -20.0, 0.0, 0.0], spline="linear"
    )
    found = loaded(Torque("crank", load), inertia=0.0).flywheel(0.05, mean_speed=10.0)
    mean = 60.0 / TURN
    assert found.motor_moment == pytest.approx(mean, rel=1e-13)
    assert found.inertia == pytest.approx((20.0 - mean) * 3.0 / (0.05 * 100.0), rel=1e-12)
    assert found.max.q == pytest.approx(1.0, abs=1e-12)
    assert found.min.q == pytest.approx(4.0, abs=1e-12)
    seam = Table([0.0, 0.0, 3.0, 3.0, TURN], [0.0, -20.0, -20.0, 0.0, 0.0], spline="linear")
    other = loaded(Torque("crank", seam), inertia=0.0).flywheel(0.05, mean_speed=10.0)
    assert other.inertia == pytest.approx(found.inertia, rel=1e-12)


def test_reactions_agree_with_the_power() -> None:
    machine = loaded(Force("B", (STEP, 0.0)))
    q = np.array([0.5, 1.0, 2.0, 3.9, 4.1])
    effort = machine.effort(q, speed=3.0)
    np.testing.assert_allclose(machine.reactions(q, speed=3.0).driver, effort, rtol=1e-13)
    np.testing.assert_allclose(effort, -STEP.at(q) * place(q)[1], rtol=1e-13, atol=1e-14)


@pytest.mark.parametrize("speed0", [20.0, -20.0])
def test_the_drive_of_a_motion_is_its_motor(speed0: float) -> None:
    motor = assur.LinearMotor(stall=60.0, no_load=40.0)
    cut = Force("B", (700.0, 0.0), while_="backward", over="bore")
    over = Table([0.3, 0.4, 0.4, 0.5], [0.0, 0.0, 90.0, 10.0], spline="linear", over="bore")
    loads: list[Any] = [Torque("crank", STEP), cut, Force("B", (over, 0.0))]
    machine = Machine(slider(), bodies={"crank": Body(inertia=2.0)}, loads=loads, motor=motor)
    run = machine.run(t_end=1.0, q0=0.0, speed0=speed0)
    given = 60.0 * (1.0 - run.speed / 40.0)
    # The cut holds it where it comes to rest: then the drive is not determined.
    moves = np.abs(run.speed) > 1e-6
    for effort in (machine.reactions(run, sense=1).driver, machine.effort(run, sense=1)):
        np.testing.assert_allclose(effort[moves], given[moves], rtol=1e-6)
    assert run.end == "reached"
    assert moves.sum() > 20
    if speed0 > 0.0:
        steady = machine.steady_state()
        duty = machine.duty(steady)
        assert duty.energy == pytest.approx(steady.power * steady.period, rel=1e-3)


# Where the bore is 0.48 m, and 50 kN times the ram's travel for each radian there.
BEGINS = math.acos((0.48**2 + 0.1**2 - 0.4**2) / (2.0 * 0.48 * 0.1))


def per_radian(q: float) -> float:
    """Travel of the ram for each radian of the crank (0.1 m, rod 0.4 m)."""
    sine, cosine = math.sin(q), math.cos(q)
    return 0.1 * sine + 0.01 * sine * cosine / math.sqrt(0.16 - 0.01 * sine * sine)


PEAK = 5e4 * per_radian(BEGINS)


def pressing() -> Machine:
    """50 kN against the ram over its last 20 mm, on the way out."""
    force = Table([0.3, 0.48, 0.48, 0.5], [0.0, 0.0, -5e4, -5e4], spline="linear", over="bore")
    load = Force("B", (force, 0.0), while_="forward", over="bore")
    return Machine(assur.SliderCrank(0.1, 0.4), loads=[load])


@pytest.mark.parametrize("positions", [72, 360, 3600])
@pytest.mark.parametrize("way", [1.0, -1.0])
def test_a_duty_goes_from_jump_to_jump(positions: int, way: float) -> None:
    """The peak is that beside the jump by the force on the ram, the energy 50 kN · 20 mm."""
    q = way * np.linspace(0.0, TURN, positions, endpoint=False)
    duty = pressing().duty(q, way * TURN)
    most = duty.max if way > 0.0 else duty.min
    assert abs(most.value) == pytest.approx(PEAK, rel=1e-7)
    assert math.cos(most.q) == pytest.approx(math.cos(BEGINS), abs=1e-8)
    assert duty.energy == pytest.approx(1000.0, rel=3e-6)
    assert duty.mean == pytest.approx(way * 1000.0 / TURN, rel=3e-6)
    assert duty.time == pytest.approx(1.0, rel=1e-12)
    assert duty.work_out == pytest.approx(0.0, abs=3e-3)


@pytest.mark.parametrize("beside", [1e-4, 1e-6, 1e-9, 0.0])
def test_positions_beside_a_jump_do_no_harm(beside: float) -> None:
    at = TURN - BEGINS
    q = np.unique([*np.linspace(0.0, TURN, 361), at - beside, at + beside])
    duty = pressing().duty(q, TURN)
    assert duty.max.value == pytest.approx(PEAK, rel=1e-7)
    assert duty.energy == pytest.approx(1000.0, rel=1e-7)


def test_several_paths_of_one_design_are_cut_each() -> None:
    """The second has no jump, and is as it would be alone."""
    machine = loaded(Torque("crank", STEP))
    paths = np.stack([np.linspace(0.0, 2.0, 41), np.linspace(1.2, 1.9, 41)])
    whole = machine.duty(paths, 3.0)
    for row, path in enumerate(paths):
        alone = machine.duty(path, 3.0)
        for name in ("energy", "rms", "mean", "work_in", "work_out", "time"):
            assert np.asarray(getattr(whole, name))[row] == getattr(alone, name), name
        assert np.asarray(whole.max.value)[row] == alone.max.value


def test_a_duty_across_the_reversal_of_friction() -> None:
    """A guide's friction jumps at the dead centres.

    The rod takes part of the load of 1 kN off the guide, by the tangent of its angle.
    """
    rubbing = Machine(
        assur.SliderCrank(0.1, 0.4),
        loads=[Force("B", (0.0, -1000.0))],
        friction={"bore": assur.SlideFriction(0.1, length=1.0)},
    )
    duty = rubbing.duty(np.linspace(0.3, 0.3 + TURN, 61), 2.0)

    def loss(q: float) -> float:
        tangent = 0.1 * math.sin(q) / math.sqrt(0.16 - 0.01 * math.sin(q) ** 2)
        return 0.1 * 1000.0 / (1.0 + 0.1 * tangent) * per_radian(q)

    assert duty.lost == pytest.approx(2.0 * quad(loss, 0.0, math.pi)[0], rel=1e-5)


def test_a_batch_across_jumps_warns() -> None:
    machine = loaded(Torque("crank", STEP))
    q = np.linspace(0.0, TURN, 400)
    batch = Machine(slider().with_dimensions({"rod.length": [0.4, 0.5]}), loads=machine.loads)
    with pytest.warns(assur.AssurWarning, match=r"loads may jump between positions"):
        batch.duty(q, 3.0)


def test_rest_in_a_jump_is_refused_and_beside_it_found() -> None:
    jumping = Table([0.0, 2.0, 2.0, 4.0, TURN], [1.0, 1.0, -1.0, -1.0, 1.0], spline="linear")
    machine = loaded(Torque("crank", jumping))
    with pytest.raises(assur.MotionError, match=r"jump at q = 2"):
        machine.equilibria()
    found = machine.equilibria(between=(2.5, 7.0))
    np.testing.assert_allclose(found.q, [0.5 * (4.0 + TURN)], rtol=1e-13)
    assert not found.stable.any()


def test_copies_are_the_same() -> None:
    for twin in (copy.deepcopy(STEP), pickle.loads(pickle.dumps(STEP))):
        np.testing.assert_array_equal(twin.q, STEP.q)
        assert (twin.periodic, twin.over) == (True, None)


@pytest.mark.parametrize(
    ("q", "spline", "periodic", "message"),
    [
        ([0.0, 1.0, 1.0, 1.0, 2.0], "linear", False, r"q = 1.0 comes three times"),
        ([0.0, 0.0, 1.0, 2.0, 3.0], "linear", False, r"jumps at its end, q = 0.0"),
        ([0.0, 1.0, 2.0, 3.0, 3.0], "natural", False, r"jumps at its end, q = 3.0"),
        ([0.0, 1.0, 1.0, 2.0, 3.0], "periodic", True, r'spline="periodic" is one curve'),
        ([0.0, 1.0, 0.5, 2.0, 3.0], "linear", True, r"q\[2\] = 0.5 is below q\[1\] = 1.0"),
    ],
)
def test_wrong_jumps_are_refused(
    q: list[float], spline: assur.flywheel.Spline, periodic: bool, message: str
) -> None:
    with pytest.raises(assur.InputError, match=message):
        Table(q, np.zeros(5), spline=spline, periodic=periodic)


def test_motors_have_no_jumps_over_speed() -> None:
    jumping = Table([-10.0, 0.0, 0.0, 50.0], [9.0, 9.0, 5.0, 0.0], spline="linear", periodic=False)
    with pytest.raises(assur.InputError, match=r"its torque jumps at 0 rad/s"):
        Machine(slider(), motor=jumping)
