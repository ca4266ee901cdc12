"""Loads that act in one direction of motion: cutting, dry friction of tools, one-way drives."""

from __future__ import annotations

import copy
import itertools
import math
import pickle
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import assur
from assur import Body, Force, FourBar, LinearMotor, Machine, Table, Torque
from assur.dynamics.forces.force_system import force_system
from models.machines.shapers import STROKE, TURN, place, slider

CUT = 700.0


def shaper(*loads: Any, inertia: float = 0.5, mass: float = 4.0, **parts: Any) -> Machine:
    """It cuts while its slide goes backward: from 0.5 m to 0.3 m, q from 0 to π."""
    cut = Force("B", (CUT, 0.0), while_="backward", over="bore")
    bodies = {"crank": Body(inertia=inertia), "piston": Body(mass=mass)}
    return Machine(slider(), bodies=bodies, loads=[cut, *loads], **parts)


def cutting(q: Any) -> Any:
    return CUT * np.minimum(place(q)[1], 0.0)


def inertia(q: Any) -> Any:
    return 0.5 + 4.0 * place(q)[1] ** 2


def test_it_acts_in_its_direction_alone() -> None:
    q = np.linspace(-3.0, 9.0, 41)
    np.testing.assert_allclose(shaper().reduced_moment(q, 2.0), cutting(q), rtol=1e-12, atol=1e-12)
    # Backward the slide goes the other way at every place.
    back = CUT * np.maximum(place(q)[1], 0.0)
    np.testing.assert_allclose(shaper().reduced_moment(q, -2.0), back, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("turn", [0.0, math.pi, TURN, -math.pi])
def test_where_its_coordinate_turns_back_it_does_not_act(turn: float) -> None:
    follower = Torque("crank", 5.0, while_="forward", over="bore")
    machine = Machine(slider(), loads=[follower])
    assert machine.reduced_moment(turn, 3.0) == 0.0
    assert machine.reactions(turn, 3.0).driver == 0.0
    assert (
        machine.reduced_moment(turn - 1e-6, 3.0) + machine.reduced_moment(turn + 1e-6, 3.0) == 5.0
    )


@pytest.mark.parametrize("speed0", [60.0, -60.0])
def test_a_run_loses_the_work_of_the_strokes(speed0: float) -> None:
    run = shaper().run(t_end=0.8, q0=1.0, speed0=speed0, rtol=1e-12)
    way = math.copysign(1.0, speed0)
    turns = [math.pi * k for k in range(-20, 21)]
    for q, speed in zip(run.q[::7], run.speed[::7], strict=True):
        low, high = sorted((1.0, float(q)))
        stops = np.array([low, *(at for at in turns if low < at < high), high])
        steps = np.diff(place(stops)[0]) * way
        work = CUT * float(np.minimum(steps, 0.0).sum())
        kinetic = 0.5 * (inertia(q) * speed**2 - inertia(1.0) * speed0**2)
        assert kinetic == pytest.approx(work, abs=2e-9)
    assert run.energy.error < 1e-12
    inside = [q for q in turns if run.q.min() < q < run.q.max()]
    assert len(inside) >= 5
    assert np.abs(run.q[:, None] - inside).min(axis=0).max() < 1e-12


def test_a_load_that_jumps_where_the_slide_turns_back() -> None:
    ratchet = Torque("crank", -8.0, while_="forward", over="bore")
    machine = Machine(slider(), bodies={"crank": Body(inertia=0.5)}, loads=[ratchet])
    run = machine.run(t_end=1.0, q0=0.5, speed0=30.0, rtol=1e-12)
    # The slide goes forward from π to 2π.
    within = run.q % TURN
    braked = (run.q // TURN) * math.pi + np.maximum(within - math.pi, 0.0)
    np.testing.assert_allclose(0.25 * (run.speed**2 - 900.0), -8.0 * braked, atol=1e-10)
    along = machine.run(q_end=float(run.q[-1]), q0=0.5, speed0=30.0, rtol=1e-12)
    assert along.t[-1] == pytest.approx(1.0, rel=1e-11)


def test_dry_friction_on_a_spring_loses_its_part_each_stroke() -> None:
    # A mass on a spring, with a constant force against its motion: each stroke is 2 F/k shorter,
    # and it stays where the spring no longer moves it (J. P. Den Hartog, Mechanical Vibrations,
    # 4th ed. 1956, 8.6).
    mass = assur.Mechanism(
        {"B": (0.5, 0.0), "O": (0.0, 0.0)},
        {"ground": ["O"], "block": ["B"]},
        driver="guide",
        slides={"guide": assur.Slide("block", on="ground", angle=0.0, origin="O")},
    )
    rub = [
        Force("B", (-3.0, 0.0), while_="forward"),
        Force("B", (3.0, 0.0), while_="backward", over="guide"),
    ]
    spring = assur.Spring("O", "B", 100.0, 0.5)
    machine = Machine(mass, bodies={"block": Body(mass=1.0)}, loads=[spring, *rub])
    run = machine.run(t_end=5.0, q0=0.5 + 0.2, rtol=1e-12)
    assert [record.event for record in run.events if record.event != "slip"] == ["stick"]
    # 0.2, −0.14, 0.08 and −0.02: the spring pulls with 2 N.
    assert run.q[-1] == pytest.approx(0.48, abs=1e-9)
    ends = run.q[np.flatnonzero(np.abs(run.speed) < 1e-9)]
    for place_ in (0.7, 0.36, 0.58, 0.48):
        assert np.abs(ends - place_).min() < 1e-9
    assert run.events[-1].t == pytest.approx(3.0 * math.pi / 10.0, abs=1e-9)
    assert run.energy.error < 1e-11


def test_a_brake_stops_a_wheel_and_holds_it() -> None:
    brake = [
        Torque("crank", -6.0, while_="forward"),
        Torque("crank", 6.0, while_="backward"),
        Torque("crank", 2.0),
    ]
    machine = Machine(slider(), bodies={"crank": Body(inertia=0.5)}, loads=brake)
    run = machine.run(t_end=3.0, q0=0.0, speed0=10.0)
    assert run.events[0].event == "stick"
    assert run.events[0].t == pytest.approx(10.0 * 0.5 / 4.0, rel=1e-9)
    assert run.q[-1] == pytest.approx(0.5 * 10.0 * 1.25, rel=1e-9)
    assert run.speed[-1] == 0.0
    # A stronger load moves it on.
    moved = Machine(
        slider(), bodies={"crank": Body(inertia=0.5)}, loads=[*brake, Torque("crank", 5.0)]
    )
    late = moved.run(t_end=2.0, q0=0.0)
    assert late.speed[-1] == pytest.approx((5.0 + 2.0 - 6.0) / 0.5 * 2.0, rel=1e-9)


@pytest.mark.parametrize("q0", [0.0, math.pi])
@pytest.mark.parametrize("load", [9.0, -9.0])
def test_a_start_from_rest_where_the_slide_turns_back(q0: float, load: float) -> None:
    # On the way away from q0 the slide goes one way whichever the sense.
    word: Any = "backward" if q0 == 0.0 else "forward"
    brake = Torque("crank", -math.copysign(4.0, load), while_=word, over="bore")
    machine = Machine(
        slider(), bodies={"crank": Body(inertia=0.5)}, loads=[Torque("crank", load), brake]
    )
    run = machine.run(t_end=0.5, q0=q0)
    expected = math.copysign(5.0, load) / 0.5
    assert abs(run.q[-1] - q0) < math.pi
    assert run.q[-1] - q0 == pytest.approx(0.125 * expected, rel=1e-10)


def test_a_steady_state_closes_for_another_integrator() -> None:
    motor = LinearMotor(stall=90.0, no_load=25.0)
    steady = shaper(motor=motor).steady_state()

    def rates(q: float, y: Any) -> list[float]:
        speed = math.sqrt(y[0])
        h = 1e-6
        slope = (inertia(q + h) - inertia(q - h)) / (2.0 * h)
        moment = 90.0 * (1.0 - speed / 25.0) + float(cutting(q))
        return [(2.0 * moment - slope * y[0]) / inertia(q), 1.0 / speed]

    start = float(steady.q[0])
    state = [float(steady.speed[0]) ** 2, 0.0]
    inside = (math.pi * k for k in range(4) if start < math.pi * k < start + TURN)
    cuts = sorted({start, start + TURN, *inside})
    for a, b in itertools.pairwise(cuts):
        state = list(solve_ivp(rates, (a, b), state, "DOP853", rtol=1e-12, atol=1e-12).y[:, -1])
    assert state[0] == pytest.approx(float(steady.speed[0]) ** 2, rel=1e-8)
    assert state[1] == pytest.approx(steady.period, rel=1e-8)
    assert steady.power * steady.period == pytest.approx(CUT * (STROKE[1] - STROKE[0]), rel=1e-10)


def test_a_shapers_flywheel_by_hand() -> None:
    # Without masses: the cut takes CUT x' from 0 to π and nothing on the way back, the motor gives
    # its mean.
    found = shaper(inertia=0.0, mass=0.0).flywheel(1 / 30, mean_speed=8.0)
    mean = CUT * 0.2 / TURN
    assert found.motor_moment == pytest.approx(mean, rel=1e-9)
    q = np.linspace(0.0, math.pi, 400_001)
    excess = -cutting(q) - mean
    middle = -cutting(0.5 * (q[1:] + q[:-1])) - mean
    step = q[1] - q[0]
    parts = (excess[:-1] + 4.0 * middle + excess[1:]) * step / 6.0
    work = np.concatenate([[0.0], np.cumsum(parts)])
    assert found.inertia == pytest.approx((work.max() - work.min()) / (64.0 / 30.0), rel=1e-9)
    # With its own motor: the same machine integrated.
    driven = shaper(motor=LinearMotor(60.0, 20.0)).flywheel(1 / 30)
    assert driven.delta == pytest.approx(1 / 30, rel=1e-9)
    assert driven.steady is not None
    assert driven.steady.power * driven.period == pytest.approx(CUT * 0.2, rel=1e-9)


def test_reactions_give_the_effort() -> None:
    q = np.linspace(0.2, 6.1, 19)
    machine = shaper(Torque("rod", 3.0, while_="forward", over="rod"))
    for speed in (7.0, -7.0):
        effort = machine.effort(q, speed, 20.0)
        np.testing.assert_allclose(machine.reactions(q, speed, 20.0).driver, effort, rtol=1e-11)
    for sense in (1, -1):
        own = machine.effort(q, sense=sense)
        np.testing.assert_allclose(machine.reactions(q, sense=sense).driver, own, rtol=1e-11)
        still = -cutting(q) if sense > 0 else -CUT * np.maximum(place(q)[1], 0.0)
        assert np.abs(own - still).max() < 3.0


def test_friction_and_a_cut_together() -> None:
    plain = shaper(friction={"bore": assur.SlideFriction(coefficient=0.0, length=0.1)})
    own, other = (one.run(t_end=0.3, q0=1.0, speed0=30.0) for one in (plain, shaper()))
    assert own.q[-1] == pytest.approx(other.q[-1], rel=1e-11)
    rubbing = shaper(friction={"bore": assur.SlideFriction(coefficient=0.2, length=0.1)})
    q = np.array([1.0, 4.0])
    more = rubbing.reactions(q, 3.0).driver - shaper().reactions(q, 3.0).driver
    assert more[0] > 1.0 > more[1] >= 0.0


def test_loads_inside_a_link_have_the_cut() -> None:
    # Statics of a piston whose force comes and goes: the rod bears it with its direction alone.
    loads = shaper(mass=0.0, inertia=0.0)
    q = np.array([1.0, 5.0])
    inside = loads.internal_loads("rod", q, speed=2.0)
    assert abs(inside.axial[0]).max() > CUT
    assert abs(inside.axial[1]).max() == pytest.approx(0.0, abs=1e-9)


def test_a_table_and_a_direction_together() -> None:
    table = Table([0.3, 0.35, 0.35, 0.5], [0.0, 0.0, 900.0, 500.0], spline="linear", over="bore")
    cut = Force("B", (table, 0.0), while_="backward", over="bore")
    machine = Machine(slider(), bodies={"crank": Body(inertia=1.0)}, loads=[cut])
    run = machine.run(q_end=TURN, q0=0.0, speed0=30.0, rtol=1e-12)
    work = 0.15 * 700.0
    assert 0.5 * (900.0 - float(run.speed[-1]) ** 2) == pytest.approx(work, rel=1e-12)
    found = Machine(slider(), loads=[cut]).flywheel(0.02, mean_speed=10.0)
    assert found.motor_moment == pytest.approx(work / TURN, rel=1e-10)


def test_the_default_is_the_driver() -> None:
    machine = Machine(FourBar(1.0, 3.0, 2.5, 3.2), loads=[Torque("rocker", 4.0, while_="backward")])
    assert machine.reduced_moment(1.0, 2.0) == 0.0
    rate = machine.mechanism.solve(1.0).link("rocker").d1  # type: ignore[union-attr]
    assert machine.reduced_moment(1.0, -2.0) == pytest.approx(4.0 * float(rate), rel=1e-14)


def test_copies_act_alike() -> None:
    for twin in (copy.deepcopy(shaper()), pickle.loads(pickle.dumps(shaper()))):
        own, other = (one.run(t_end=0.2, q0=1.0, speed0=9.0) for one in (shaper(), twin))
        np.testing.assert_array_equal(own.q, other.q)


def test_at_rest_a_direction_is_needed() -> None:
    with pytest.raises(assur.InputError, match=r"speed is 0 at q = 1: a load with while_= needs"):
        shaper().reduced_moment(1.0)
    with pytest.raises(assur.InputError, match=r"sense=\+1 or −1"):
        shaper().reactions(1.0)
    with pytest.raises(assur.InputError, match=r"a load has while_=: it acts in one direction"):
        shaper().equilibria()


def test_self_locking_has_the_loads_of_its_sense() -> None:
    rubs = {name: assur.JointFriction(0.1, radius=0.03) for name in "OAB"}
    stroke = (math.pi, TURN)

    def holding(force: float, sense: int, *loads: Any) -> Any:
        machine = Machine(slider(), loads=[Force("B", (force, 0.0)), *loads], friction=rubs)
        return machine.self_locking(sense=sense, between=stroke).holding

    cut = shaper().loads[0]
    # The slide goes forward there: the cut does not act, whatever pushes.
    plain = holding(40.0, 1)
    assert plain.shape == (2, 2)
    np.testing.assert_array_equal(holding(40.0, 1, cut), plain)
    # It goes backward, and the cut is greater than what pulls: friction has nothing to hold.
    assert np.ptp(holding(-40.0, -1), axis=1).sum() > 0.1
    assert np.ptp(holding(-40.0, -1, cut), axis=1).sum() < 1e-6


def test_an_impact_has_no_direction() -> None:
    machine = Machine(slider(), bodies={"crank": Body(inertia=1.0)})
    with pytest.raises(assur.InputError, match=r"an impact is not a motion in one direction"):
        machine.impact(Force("B", (1.0, 0.0), while_="forward"), 1.0, 3.0)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"while_": "upward"}, r"Force while_ is 'upward': one of 'forward', 'backward'"),
        ({"over": "bore"}, r"names the coordinate of while_=, which is missing"),
        ({"while_": "forward", "over": 3}, r"Force over: the name 3 is not a string"),
    ],
)
def test_wrong_directions_are_refused(options: Any, message: str) -> None:
    with pytest.raises(assur.InputError, match=message):
        Force("B", (1.0, 0.0), **options)


def test_an_unknown_coordinate_is_refused() -> None:
    with pytest.raises(assur.AssurError, match=r'"bore"'):
        Machine(slider(), loads=[Torque("crank", 1.0, while_="forward", over="bor")])


@pytest.mark.parametrize("way", ["forward", "backward"])
def test_at_a_dead_point_a_load_is_not_drawn_either(way: Any) -> None:
    """There the computed rate of the slide is rounding, of either sign."""
    load = Force("B", (5.0, 0.0), while_=way, over="bore")
    q = np.array([0.0, math.pi, -math.pi, 2.0 * math.pi])
    found = Machine(assur.SliderCrank(0.1, 0.35), loads=[load]).reactions(q, speed=1.0)
    np.testing.assert_array_equal(found.driver, 0.0)
    for row in range(q.size):
        assert all(force.kind != "load" for force in force_system(found, None, row).forces)
