"""Loads over the value of a slide or the angle of a link, against closed forms."""

from __future__ import annotations

import copy
import math
import pickle
from typing import Any

import numpy as np
import pytest

import assur
from assur import Body, Force, FourBar, Machine, Table, Torque
from models.machines.shapers import CRANK, ROD, STROKE, TURN, integral, place, slider, turning

# A jump at 0.36 and a kink at 0.45, over the whole stroke.
FORCE = Table(
    [0.3, 0.36, 0.36, 0.45, 0.5], [0.0, 0.0, -900.0, -300.0, 0.0], spline="linear", over="bore"
)
CUTS = tuple(
    turns * TURN + sign * turning(x)
    for turns in range(-3, 4)
    for sign in (-1.0, 1.0)
    for x in (0.36, 0.45)
) + tuple(math.pi * k for k in range(-6, 7))


def force(x: float) -> float:
    if x < 0.36:
        return 0.0
    return -900.0 + 600.0 * (x - 0.36) / 0.09 if x < 0.45 else -300.0 * (0.5 - x) / 0.05


def moment(q: float) -> float:
    x, rate = place(q)
    return force(float(x)) * float(rate)


def pushed(**parts: Any) -> Machine:
    bodies = {"crank": Body(inertia=0.8), "piston": Body(mass=3.0)}
    return Machine(slider(), bodies=bodies, loads=[Force("B", (FORCE, 0.0))], **parts)


def inertia(q: Any) -> Any:
    return 0.8 + 3.0 * place(q)[1] ** 2


def test_the_reduced_moment_is_virtual_work() -> None:
    q = np.linspace(-1.0, 13.0, 57)
    found = pushed().reduced_moment(q)
    np.testing.assert_allclose(found, [moment(float(one)) for one in q], rtol=1e-12, atol=1e-11)


@pytest.mark.parametrize("speed0", [25.0, -25.0])
def test_a_run_gains_the_work_over_the_slide(speed0: float) -> None:
    run = pushed().run(t_end=0.6, q0=0.4, speed0=speed0, rtol=1e-12)
    for q, speed in zip(run.q[::5], run.speed[::5], strict=True):
        low, high = sorted((0.4, float(q)))
        work = integral(moment, low, high, *CUTS) * (1.0 if q > 0.4 else -1.0)
        kinetic = 0.5 * (inertia(q) * speed**2 - inertia(0.4) * speed0**2)
        assert kinetic == pytest.approx(work, abs=3e-9)
    assert run.energy.error < 1e-11
    stops = np.array([q for q in CUTS if run.q.min() < q < run.q.max()])
    assert np.abs(run.q[:, None] - stops).min(axis=0).max() < 1e-12


def test_a_run_over_q_is_that_in_time() -> None:
    along = pushed().run(q_end=7.0, q0=0.4, speed0=25.0, rtol=1e-12)
    in_time = pushed().run(t_end=float(along.t[-1]), q0=0.4, speed0=25.0, rtol=1e-12)
    assert in_time.q[-1] == pytest.approx(7.0, abs=1e-11)
    work = integral(moment, 0.4, 7.0, *CUTS)
    expected = math.sqrt((inertia(0.4) * 625.0 + 2.0 * work) / inertia(7.0))
    assert float(along.speed[-1]) == pytest.approx(expected, rel=1e-12)


def test_a_load_over_place_alone_takes_nothing_in_a_turn() -> None:
    motor = assur.LinearMotor(stall=40.0, no_load=30.0)
    steady = pushed(motor=motor).steady_state()
    assert steady.power == pytest.approx(0.0, abs=1e-8)
    assert steady.mean_speed < 30.0
    assert steady.delta > 0.05


def test_a_flywheel_is_that_of_a_closed_form() -> None:
    machine = Machine(slider(), loads=[Force("B", (FORCE, 0.0))])
    found = machine.flywheel(0.04, mean_speed=12.0)
    # Without masses the motor gives nothing: the excess of energy is the work over the stroke.
    work = -integral(force, *STROKE, 0.36, 0.45)
    assert found.inertia == pytest.approx(work / (0.04 * 144.0), rel=1e-9)
    assert found.motor_moment == pytest.approx(0.0, abs=1e-9)


def test_reactions_give_the_effort() -> None:
    q, speed, acceleration = np.linspace(0.1, 6.0, 23), 11.0, -40.0
    machine = pushed()
    effort = machine.effort(q, speed, acceleration)
    found = machine.reactions(q, speed, acceleration)
    np.testing.assert_allclose(found.driver, effort, rtol=1e-11)
    h = 1e-6
    slope = (inertia(q + h) - inertia(q - h)) / (2.0 * h)
    own = inertia(q) * acceleration + 0.5 * slope * speed**2 - [moment(float(one)) for one in q]
    np.testing.assert_allclose(effort, own, rtol=1e-7, atol=1e-6)


def rocker_angle(q: Any) -> Any:
    """Of FourBar(1, 3, 2.5, 3.2), open: the angle of its rocker, by the circles' intersection."""
    bx, by = np.cos(q), np.sin(q)
    dx, dy = 3.2 - bx, -by
    d = np.hypot(dx, dy)
    along = (9.0 - 6.25 + d**2) / (2.0 * d)
    across = np.sqrt(9.0 - along**2)
    cx, cy = bx + (along * dx - across * dy) / d, by + (along * dy + across * dx) / d
    return np.arctan2(cy, cx - 3.2)


@pytest.mark.parametrize("spline", ["linear", "natural"])
def test_a_torque_over_a_links_angle(spline: assur.flywheel.Spline) -> None:
    mechanism = FourBar(1.0, 3.0, 2.5, 3.2)
    q = np.linspace(0.0, TURN, 200)
    angles = rocker_angle(q)
    np.testing.assert_allclose(mechanism.solve(q).link("rocker").value, angles, rtol=1e-12)
    low, high = angles.min() - 0.1, angles.max() + 0.1
    knots = np.linspace(low, high, 6)
    values = np.array([5.0, -10.0, -40.0, 20.0, 7.0, -3.0])
    table = Table(knots, values, spline=spline, over="rocker")
    machine = Machine(
        mechanism, bodies={"crank": Body(inertia=3.0)}, loads=[Torque("rocker", table)]
    )
    h = 1e-5
    rate = (rocker_angle(q + h) - rocker_angle(q - h)) / (2.0 * h)
    own = Table(knots, values, spline=spline, periodic=False).at(angles) * rate
    np.testing.assert_allclose(machine.reduced_moment(q), own, atol=1e-7)
    run = machine.run(t_end=5.0, q0=0.3, speed0=6.0)
    # Its potential: the integral of the torque over the angle.
    fine = np.linspace(low, high, 200_001)
    each = Table(knots, values, spline=spline, periodic=False).at(0.5 * (fine[1:] + fine[:-1]))
    potential = np.concatenate([[0.0], -np.cumsum(each) * (fine[1] - fine[0])])
    total = 1.5 * run.speed**2 + np.interp(rocker_angle(run.q), fine, potential)
    np.testing.assert_allclose(total, total[0], rtol=1e-8)


def test_rest_over_a_slide_has_its_exact_stiffness() -> None:
    # A force that pulls the piston to 0.42 m like a spring, but is a table.
    pull = Table([0.2, 0.6], [200.0 * 0.22, -200.0 * 0.18], spline="linear", over="bore")
    spring = assur.Spring(("ground", (0.0, 0.0)), "B", 200.0, 0.42)
    bodies = {"crank": Body(inertia=0.8), "piston": Body(mass=3.0)}
    own, other = (
        Machine(slider(), bodies=bodies, loads=[load]).equilibria()
        for load in (Force("B", (pull, 0.0)), spring)
    )
    for name in ("q", "stable", "frequency", "stiffness"):
        np.testing.assert_allclose(getattr(own, name), getattr(other, name), rtol=1e-9, atol=1e-12)
    assert own.stable.sum() == 2


def test_designs_have_their_own_knots() -> None:
    crank = np.array([0.08, 0.1, 0.12])
    table = Table([0.0, 0.36, 0.36, 0.45, 1.0], [0.0, 0.0, -900.0, -300.0, 0.0], over="bore")
    batch = Machine(
        slider().with_dimensions({"crank.length": crank}), loads=[Force("B", (table, 0.0))]
    )
    q = np.linspace(0.0, TURN, 31)
    flywheels = batch.flywheel(0.04, mean_speed=12.0)
    reactions = batch.reactions(q, 5.0, threads=2)
    for index in range(3):
        one = batch.design(index)
        np.testing.assert_array_equal(batch.reduced_moment(q)[index], one.reduced_moment(q))
        np.testing.assert_array_equal(reactions.driver[index], one.reactions(q, 5.0).driver)
        own = one.flywheel(0.04, mean_speed=12.0)
        assert flywheels.inertia[index] == own.inertia
        assert flywheels.speed(1.0)[index] == own.speed(1.0)
        assert flywheels.max.q[index] == own.max.q
    twin = pickle.loads(pickle.dumps(flywheels))
    np.testing.assert_array_equal(twin.inertia, flywheels.inertia)
    assert flywheels.explain(2) == batch.design(2).flywheel(0.04, mean_speed=12.0).explain()


def test_copies_move_alike() -> None:
    machine = pushed()
    for twin in (copy.deepcopy(machine), pickle.loads(pickle.dumps(machine))):
        own, other = (one.run(t_end=0.3, q0=0.4, speed0=25.0) for one in (machine, twin))
        np.testing.assert_array_equal(own.q, other.q)


def test_the_end_of_a_table() -> None:
    short = Table([0.35, 0.5], [0.0, 10.0], over="bore")
    machine = Machine(
        slider(), bodies={"crank": Body(inertia=1.0)}, loads=[Force("B", (short, 0.0))]
    )
    with pytest.raises(assur.InputError, match=r"covers 0\.35 to 0\.5: 0\.3, at q = 3.14159"):
        machine.reduced_moment(math.pi)
    assert np.isnan(machine.reduced_moment(math.pi, on_error="nan"))
    with pytest.warns(assur.AssurWarning, match=r"the Force at 'B': a table over 'bore' ends at"):
        run = machine.run(t_end=5.0, q0=0.5, speed0=5.0)
    assert run.end == "table ends"
    assert place(run.q[-1])[0] == pytest.approx(0.35, abs=1e-12)
    with pytest.raises(assur.InputError, match=r"a table over 'bore' covers 0\.35 to 0\.5"):
        machine.run(t_end=5.0, q0=3.0, speed0=5.0)
    with pytest.warns(assur.AssurWarning, match=r"a table over 'bore' ends at"):
        over = machine.run(q_end=5.0, q0=0.5, speed0=5.0)
    assert over.end == "table ends"
    assert (over.q[-1], over.t[-1]) == pytest.approx((run.q[-1], run.t[-1]), rel=1e-9)


def test_a_table_may_end_where_the_slide_turns_back() -> None:
    exact = Table(STROKE, [-50.0, 50.0], spline="linear", over="bore")
    machine = Machine(
        slider(), bodies={"crank": Body(inertia=1.0)}, loads=[Force("B", (exact, 0.0))]
    )
    run = machine.run(t_end=5.0, q0=0.0, speed0=15.0, rtol=1e-12)
    assert run.end == "reached"
    potential = -250.0 * (place(run.q)[0] - ROD) ** 2
    total = 0.5 * run.speed**2 + potential
    np.testing.assert_allclose(total, total[0], rtol=1e-10)
    assert STROKE == (ROD - CRANK, ROD + CRANK)


@pytest.mark.parametrize(
    ("over", "message"),
    [
        ("bores", r'"bore"'),
        ("pistn", r'"piston"'),
        ("ground", r"the ground does not move"),
    ],
)
def test_unknown_coordinates_are_refused_with_the_nearest(over: str, message: str) -> None:
    table = Table([0.0, 1.0], [0.0, 1.0], over=over)
    with pytest.raises(assur.AssurError, match=message):
        Machine(slider(), loads=[Force("B", (table, 0.0))])


def test_motors_follow_q() -> None:
    table = Table([0.0, 1.0], [0.0, 1.0], over="bore")
    with pytest.raises(assur.InputError, match=r"motors follow q"):
        Machine(slider(), motor=assur.ConstantTorque(table))
    with pytest.raises(assur.InputError, match=r"over its own speed"):
        Machine(slider(), motor=table)


def test_several_drivers_reduce_but_do_not_run() -> None:
    joints = {"A": (0, 0), "B": (1, 0.3), "C": (2.2, 0.9), "E": (3.4, 0.2), "F": (4.0, 0.0)}
    links = {"ground": ["A", "F"], "a": ["A", "B"], "b": ["B", "C"], "c": ["C", "E"]}
    links["d"] = ["F", "E"]
    five = assur.Mechanism(joints, links, driver=["a", "d"])
    table = Table([-7.0, 7.0], [-7.0, 7.0], spline="linear", over="b")
    machine = Machine(five, loads=[Torque("b", table, while_="forward", over="c")])
    q, speed = np.add(five.q0, [0.1, -0.1]), np.array([1.0, 0.5])
    link = five.solve(q).link("b")
    rate = five.solve(q).link("c").velocity(speed)
    moment = machine.reduced_moment(q, np.sign(rate) * speed)
    np.testing.assert_allclose(moment, link.value * link.d1, rtol=1e-12)
    np.testing.assert_array_equal(machine.reduced_moment(q, -np.sign(rate) * speed), [0.0, 0.0])
    own = machine.reactions(q, np.sign(rate) * speed)
    np.testing.assert_allclose(own.driver, -moment, rtol=1e-11)
    with pytest.raises(assur.InputError, match=r"several drivers has no loads with over="):
        machine.run(t_end=1.0)
