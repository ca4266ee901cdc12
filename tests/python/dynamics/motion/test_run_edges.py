"""Runs where something ends, jumps, coincides or cannot be."""

from __future__ import annotations

import math
import pickle
from functools import cache
from typing import Any

import numpy as np
import pytest

import assur
from assur import (
    Body,
    Gravity,
    InputError,
    Table,
    Torque,
    TorsionDamper,
    TorsionSpring,
    events,
)
from assur.dynamics.motion import integrate
from models.machines.machines import five_bar, pendulum, press, wheel
from oracles.dynamics.oracle_dae import Dae

TURN = math.tau
ANY: Any = None  # what types would not let pass


def four_bar() -> assur.Mechanism:
    return assur.FourBar(1.0, 3.0, 2.5, 3.2)


def test_turning_points_differ_from_dead_points() -> None:
    """At two of them the potential is the same: only the geometry distinguishes them from rest."""
    run = wheel(TorsionSpring("crank", 50.0)).run(100.0, q0=1.0, rtol=1e-12)
    assert run.end == "reached"
    assert abs(run.q[-1] - math.cos(500.0)) < 1e-8
    driven = wheel(Torque("crank", lambda t, _, __: math.cos(t))).run(100.0)
    assert driven.end == "reached"
    for rtol in (1e-2, 1e-4, 1e-6, 1e-10):
        assert pendulum().run(100.0, q0=math.pi - 1.0, rtol=rtol).end == "reached"
    resting = pendulum().run(q_end=9.0, q0=3.0, speed0=1e-3)
    assert resting.end == "rest"


@pytest.mark.parametrize("rtol", [1e-2, 1e-3, 1e-5])
def test_loose_tolerances_make_no_dead_points(rtol: float) -> None:
    machine = assur.Machine(
        five_bar(),
        bodies={
            name: Body(mass=1.0 + i, inertia=0.3, at=(0.4, 0.1))
            for i, name in enumerate(("c1", "b1", "b2", "c2"))
        },
        loads=[Gravity((0.0, -4.0)), Torque("c2", 0.5)],
    )
    assert machine.run(1.2, speed0=[1.0, -0.5], rtol=rtol).end == "reached"
    rocker = assur.FourBar(1.0, 3.0, 3.0, 3.0).with_driver("rocker")
    dead = assur.Machine(rocker, bodies={"crank": Body(inertia=1.0), "rocker": Body(inertia=1.0)})
    run = dead.run(50.0, q0=2.0, speed0=1.0, rtol=rtol)
    assert run.end == "dead point"
    assert abs(run.q[-1] - (math.pi - math.acos(14.0 / 18.0))) < 100.0 * rtol


def test_two_drivers_come_to_a_dead_point() -> None:
    """Both bars in one line: the joint between goes through, the drivers turn back."""
    machine = assur.Machine(
        five_bar(),
        bodies={
            name: Body(mass=1.0, inertia=0.3, at=(0.4, 0.1)) for name in ("c1", "b1", "b2", "c2")
        },
    )
    run = machine.run(20.0, speed0=[0.6, -0.6])
    assert run.end == "dead point"
    assert run.t[-1] < 20.0
    at = machine.mechanism.solve(run.q[-1]) if machine.mechanism else None
    assert at is not None
    assert at.condition > 1e3
    assert run.energy.error < 1e-7


def two_driven_slides(scale: float) -> assur.Machine:
    at = {"A": (0.0, 0.0), "C": (1.2, 1.1), "E": (3.0, 0.0)}
    m = assur.Mechanism(
        joints={name: (x * scale, y * scale) for name, (x, y) in at.items()},
        links={"ground": [], "s1": "A", "b1": "AC", "b2": "CE", "s2": "E"},
        slides={
            "p": assur.Slide("s1", on="ground", angle=0.0),
            "r": assur.Slide("s2", on="ground", angle=0.0),
        },
        driver=["p", "r"],
    )
    return assur.Machine(
        m, bodies={name: Body(mass=1.0, inertia=0.3 * scale**2) for name in ("b1", "b2")}
    )


@cache
def two_driven_slides_of_size_1() -> tuple[Any, Any]:
    """Coordinates and speeds after 2 s."""
    q, speeds = Dae(two_driven_slides(1.0)).run([2.0], {"p": -0.2, "r": 0.1})
    return q[0], speeds[0]


@pytest.mark.parametrize("scale", [1.0, 1e-3, 1e-6, 1e3])
def test_two_driven_slides_of_any_size(scale: float) -> None:
    machine = two_driven_slides(scale)
    run = machine.run(2.0, speed0=[-0.2 * scale, 0.1 * scale])
    assert run.end == "reached"
    assert run.energy.error < 1e-9
    # The same motion whatever the size: that of free bodies with constraints, of the size 1.
    q, speeds = two_driven_slides_of_size_1()
    own = run.at(2.0)
    assert np.abs(own.q / scale - q).max() < 1e-11
    assert np.abs(own.speed / scale - speeds).max() < 1e-11


def test_a_narrow_barrier_is_not_crossed() -> None:
    """Almost at rest beside the top, on the way up: it must turn back."""
    for q0, speed in ((0.01, 1e-8), (0.003, 1e-9), (0.05, 1e-6)):
        run = pendulum().run(q_end=30.0, q0=q0, speed0=speed)
        assert run.end == "rest"
        assert abs(run.q[-1] - (TURN - q0)) < 1e-4
    for q0, speed in ((0.5, 1e-3), (1.0, 0.1), (2.0, 1.0)):
        run = pendulum().run(q_end=30.0, q0=q0, speed0=speed)
        highest = TURN - math.acos(math.cos(q0) + speed**2 / 2.0)
        assert run.end == "rest"
        assert abs(run.q[-1] - highest) < 1e-9


def test_the_time_of_a_dead_point_is_that_of_the_other_driver() -> None:
    """Driven by the crank the same motion goes through: there the rocker rests."""
    by_crank = assur.FourBar(1.0, 3.0, 3.0, 3.0)
    bodies = {"crank": Body(inertia=1.0), "rocker": Body(inertia=1.0)}
    through = assur.Machine(by_crank, bodies=bodies)
    # The crank's angle where it lies over the coupler: the joint beyond is 3 − 1 away.
    folded = math.pi + math.acos(2.0**2 / (2.0 * 2.0 * 3.0))
    run = through.run(9.0, q0=2.0, speed0=1.0, events=[events.Position(folded)], rtol=1e-13)
    at = by_crank.solve(2.0).link("rocker")
    rocker = assur.Machine(by_crank.with_driver("rocker"), bodies=bodies)
    for asked in ("t_end", "q_end"):
        options: dict[str, Any] = {
            asked: 50.0 if asked == "t_end" else at.value + math.copysign(3, at.d1)
        }
        own = rocker.run(q0=at.value, speed0=at.d1, rtol=1e-12, **options)
        assert own.end == "dead point"
        assert abs(own.t[-1] - run.t[-1]) < 1e-8


def test_functions_of_motors_are_asked_by_motions_alone() -> None:
    def power(_: float, __: float, speed: float) -> float:
        return 100.0 / speed

    machine = assur.Machine(
        assur.SliderCrank(0.1, 0.4),
        bodies={"crank": Body(inertia=0.5)},
        loads=[Torque("crank", -1.0)],
        motor=assur.ConstantTorque(power),
    )
    assert machine.reduced_inertia(0.3).value == 0.5
    assert machine.reduced_moment(0.3) == -1.0
    assert machine.potential(0.3) == 0.0
    assert machine.run(1.0, speed0=5.0).end == "reached"


def test_an_event_at_a_knot_happens_once() -> None:
    table = Table([0.0, 1.0, 2.0, TURN], [0.0, 2.0, -2.0, 0.0], spline="linear")
    for method in ("DOP853", "RK45"):
        watched = [events.Position(1.0, stop=False), events.Position(2.0, stop=False)]
        run = wheel(Torque("crank", table)).run(
            3.0, q0=0.0, speed0=1.0, events=watched, method=method
        )
        assert [one.event for one in run.events] == watched
        over = wheel(Torque("crank", table)).run(q_end=3.0, q0=0.0, speed0=1.0, events=watched)
        assert [one.event for one in over.events] == watched
    both = [events.Position(0.5, stop=False), events.Position(0.5)]
    run = wheel().run(2.0, q0=0.0, speed0=1.0, events=both)
    assert [one.event for one in run.events] == both
    # Coming back through the same knot it happens again.
    back = wheel(Torque("crank", table), Torque("crank", -3.0))
    again = back.run(3.0, q0=0.9, speed0=0.6, events=[events.Position(1.0, stop=False)])
    assert len(again.events) == 2


def test_a_smooth_motion_of_a_mechanism_that_is_not() -> None:
    """At constant speed steps are wide, the transmission angle goes up and down in each."""
    machine = assur.Machine(four_bar(), bodies={"crank": Body(inertia=1.0)})
    cases: tuple[tuple[float, dict[str, Any]], ...] = (
        (85.0, {"t_end": 2 * TURN}),
        (89.0, {"q_end": 2 * TURN}),
    )
    for degrees, end in cases:
        watched = events.TransmissionAngle(
            "C", math.radians(degrees), stop=False, direction="either"
        )
        run = machine.run(q0=0.0, speed0=1.0, events=[watched], **end)
        own = four_bar().solve(np.linspace(0.0, 2 * TURN, 20001)).transmission_angle("C")
        crossings = np.count_nonzero(np.diff(own > math.radians(degrees)))
        assert len(run.events) == crossings == 8


def test_a_machine_does_not_change() -> None:
    machine = wheel()
    with pytest.raises(AttributeError, match="is immutable"):
        machine.motor = assur.ConstantTorque(1.0)


def test_a_run_of_zero_length_has_an_acceleration() -> None:
    machine = wheel(Torque("crank", 3.0))
    assert machine.run(0.0).acceleration == pytest.approx([1.5])
    assert machine.run(q_end=1.0, q0=1.0, speed0=2.0).acceleration == pytest.approx([1.5])


def test_motions_are_pickled() -> None:
    pend = pendulum().run(3.0, q0=1.0, events=[events.Rest(), events.Position(0.5)])
    steady = press(assur.LinearMotor(90.0, 30.0)).steady_state(mean="period")
    for made in (pend, steady.run):
        again = pickle.loads(pickle.dumps(made))
        assert (repr(again), again.message) == (repr(made), made.message)
        assert again.energy.error == made.energy.error
        assert [one.t for one in again.events] == [one.t for one in made.events]
    times = np.linspace(0.0, 3.0, 50)
    assert np.array_equal(pickle.loads(pickle.dumps(pend)).at(times), pend.at(times))
    again = pickle.loads(pickle.dumps(steady))
    assert (again.delta, again.power, again.mean) == (steady.delta, steady.power, "period")
    assert np.array_equal(again.at([1.0, 9.0]), steady.at([1.0, 9.0]))
    # The run up to a dead point too.
    lever = assur.Machine(four_bar().with_driver("rocker"), bodies={"rocker": Body(inertia=1.0)})
    dead = lever.run(9.0, speed0=1.0)
    assert dead.end == "dead point"
    assert np.array_equal(pickle.loads(pickle.dumps(dead)).at(dead.t), dead.at(dead.t))
    with pytest.raises(InputError, match="not the state of a run"):
        type(pend._core)({})


def torn(_t: float, _q: float, speed: float) -> float:
    """A load that has a value at rest alone."""
    return 0.0 if speed == 0.0 else math.nan


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: wheel().run(1.0, speed0=ANY), "speed0"),
        (
            lambda: press().flywheel(0.1, mean_speed=[10.0, 20.0]),
            r"mean_speed has the shape \(2,\)",
        ),
        (lambda: press().flywheel(0.1, mean_speed=math.nan), "mean_speed is nan"),
        (lambda: wheel().run(), "run needs t_end or q_end"),
        (lambda: wheel().run(1.0, q_end=2.0), "run needs t_end or q_end"),
        (lambda: wheel().run(q_end=2.0), "needs an initial speed"),
        (lambda: wheel().run(q_end=-2.0, q0=0.0, speed0=1.0), "lies behind q0"),
        (lambda: wheel().run(1.0, breaks=[-np.inf]), "breaks has -inf"),
        (lambda: wheel().run(1.0, rtol=0.0), "rtol is 0.0"),
        (lambda: wheel().run(1.0, atol=-1.0), "atol is -1.0"),
        (lambda: wheel().run(1.0, max_step=0.0), "max_step is 0.0"),
        (lambda: wheel().run(1.0, max_steps=0), "max_steps is 0"),
        (lambda: wheel().run(1.0, max_seconds=-1.0), "max_seconds is -1"),
        (lambda: wheel().run(1.0, method=ANY), "method is None"),
        (lambda: wheel().run(1.0, events=ANY), "events must be a sequence"),
        (lambda: wheel().run(1.0, events=[ANY]), "None is not an event"),
        (lambda: wheel().run(1.0, events=[events.TransmissionAngle("A", 50.0)]), "acute"),
        (
            lambda: wheel().run(1.0, events=[events.Rest(driver=1)]),
            "the machine has 1 driver,",
        ),
        (lambda: wheel().run(1.0, events=[events.Crossing(ANY)]), "a function of"),
        (lambda: wheel().run(1.0, q0=[[1.0], [2.0, 3.0]]), "q0"),
        (lambda: wheel().run(math.inf), "t_end is inf"),
        (lambda: assur.Machine(ANY, bodies={}), "None is not an assur.Mechanism"),
        (lambda: assur.Machine(four_bar(), bodies=ANY), "bodies is None"),
        (lambda: assur.Machine(four_bar(), bodies={}, loads=ANY), "loads must be a sequence"),
        (lambda: wheel(Torque(ANY, 1.0)), "Torque link is None"),
        (lambda: wheel(Torque("crank", 1.0, on="crank")), "give two links"),
        (lambda: wheel(assur.Spring("A", "A", 1.0, 0.0)), "it has no length"),
        (lambda: wheel(Torque("crank", torn)).run(1.0, speed0=1.0), "gave nan at t = 0"),
    ],
)
def test_refusals(make: Any, said: str) -> None:
    with pytest.raises(InputError, match=said):
        make()


def from_table(inertia: Any = 1.0, motor: Any = None, **options: Any) -> assur.Machine:
    return assur.Machine.from_table([0.0, TURN], [1.0, 1.0], inertia, motor=motor, **options)


@pytest.mark.parametrize(
    ("make", "kind", "fields"),
    [
        (lambda: assur.Machine.from_table([], [], []), "too_short", {"value": 0.0}),
        (lambda: from_table([1.0, -2.0]), "negative", {"q": TURN, "value": -2.0}),
        (lambda: Table([1.0], [1.0]), "too_short", {"value": 1.0}),
        (lambda: Table([0.0, 1.0], [1.0, 1.0], spline="periodic"), "too_short", {"value": 2.0}),
        (lambda: Table([0.0, 1.0], [1.0, math.nan]), "not_finite", {"value": math.nan}),
        (lambda: Table([0.0, 2.0, 1.0], [1, 1, 1]), "not_increasing", {"q": 1.0, "value": 1.0}),
        (
            lambda: wheel(inertia=0.0).run(1.0, speed0=1.0),
            "no_inertia",
            {"driver": "crank", "q": 0.0, "value": 0.0},
        ),
        (lambda: from_table(periodic=False).run(1.0, q0=7.0), "table_ends", {"value": 7.0}),
        (
            lambda: from_table(motor=Table([0.0, 9.0], [1.0, 0.0])).run(1.0, speed0=11.0),
            "table_ends",
            {"value": 11.0},
        ),
    ],
)
def test_refusals_with_a_kind(make: Any, kind: str, fields: dict[str, Any]) -> None:
    with pytest.raises(InputError) as caught:
        make()
    assert caught.value.kind == kind
    names = ("joint", "link", "driver", "design", "q", "t", "value")
    found = {name: getattr(caught.value, name) for name in names}
    np.testing.assert_equal(found, dict.fromkeys(names) | fields)  # NaN is NaN


def test_a_load_without_a_value_is_the_same_error_in_a_run_and_by_itself() -> None:
    """A damper along no line, a table that ends, a function that gives NaN."""
    outside = Table([1.0, 2.0], [1.0, 1.0], periodic=False)
    cases: list[tuple[Any, type[assur.AssurError], str]] = [
        (assur.Damper("A", ("ground", (0.1, 0.0)), 3.0), assur.MotionError, "not_finite"),
        (Torque("crank", outside), InputError, "table_ends"),
        (Torque("crank", torn), InputError, "not_finite"),
    ]
    for load, error, kind in cases:
        machine = wheel(load)
        with pytest.raises(error) as by_itself:
            machine.reduced_moment([0.0, 0.5], 1.0)
        with pytest.raises(error) as in_a_run:
            machine.run(1.0, q0=0.0, speed0=1.0)
        assert by_itself.value.kind == in_a_run.value.kind == kind
        assert by_itself.value.q == 0.0


def test_a_start_without_a_position_is_refused() -> None:
    swinging = assur.Machine(assur.FourBar(3.0, 1.0, 2.0, 3.0), bodies={"crank": Body(inertia=1.0)})
    with pytest.raises(assur.PositionError, match="cannot start at q0: at q = 3, dyad") as caught:
        swinging.run(1.0, q0=3.0)
    error = caught.value
    assert (error.kind, error.joint, error.group, error.q) == ("not_closed", "C", "C", 3.0)


def test_degrees_are_doubted() -> None:
    with pytest.warns(assur.AssurWarning, match="degrees"):
        wheel(Torque("crank", Table([0.0, 90.0, 360.0], [0.0, 1.0, 0.0])))


def test_tables_and_limits_end_a_run_with_a_warning() -> None:
    once = assur.Machine.from_table([0.0, 5.0], [1.0, 1.0], [1.0, 1.0], periodic=False)
    both: tuple[dict[str, Any], ...] = ({"t_end": 50.0}, {"q_end": 50.0})
    for asked in both:
        with pytest.warns(assur.AssurWarning, match="a table over q ends"):
            run = once.run(q0=1.0, speed0=3.0, **asked)
        assert run.end == "table ends"
        assert abs(run.q[-1] - 5.0) < 1e-14
        assert np.isfinite(run.energy.kinetic).all()
    with pytest.warns(assur.AssurWarning, match="max_steps"):
        assert wheel().run(1e9, speed0=1.0, max_step=1.0, max_steps=9).end == "step limit"
    with pytest.warns(assur.AssurWarning, match="max_seconds"):
        assert wheel().run(1e9, speed0=1.0, max_step=1.0, max_seconds=0.0).end == "time limit"
    still = wheel().run(0.0, speed0=1.0)
    assert still.at(0.0).speed == 1.0


@pytest.mark.parametrize("method", ["DOP853", "RK45"])
def test_stiff_machines_are_reported(method: Any) -> None:
    braked = wheel(TorsionDamper("crank", 1e6), Torque("crank", 100.0))
    with pytest.warns(assur.AssurWarning, match="stiff"):
        assert braked.run(1.0, method=method, max_steps=5000).end == "step limit"


def test_a_run_may_end_at_the_time_of_a_knot() -> None:
    rows = [1.9036057848577688, 2.389018380201142, 3.837363979520809, 3.998000887250964]
    for seed in range(30):
        values = np.random.default_rng(seed).normal(0.0, 3.0, 4)
        values[-1] = values[0]
        machine = wheel(Torque("crank", Table(rows, values, spline="linear")))
        q0, speed0 = 0.5684791439409276, -5.465030032399637
        knot = rows[0] - 2.0 * (rows[-1] - rows[0])
        along = machine.run(q_end=knot, q0=q0, speed0=speed0, rtol=1e-12)
        if along.end == "reached":
            run = machine.run(float(along.t[-1]), q0, speed0, max_step=0.02, max_steps=500)
            assert run.end == "reached"
            assert abs(run.q[-1] - knot) < 1e-9


def test_a_balance_of_energy_that_is_off_warns(monkeypatch: pytest.MonkeyPatch) -> None:
    machine = press()
    machine.run(0.1, speed0=10.0)
    # Drifting steps are refused, so that a balance as bad as the limit is not to be had.
    monkeypatch.setattr(integrate, "IMBALANCE_WARN_FLOOR", 1e-16)
    monkeypatch.setattr(integrate, "IMBALANCE_WARN_RTOLS", 0.0)
    with pytest.warns(assur.AssurWarning, match="balance of energy is off by"):
        machine.run(0.1, speed0=10.0)
