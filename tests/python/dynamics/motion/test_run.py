"""Motions: against free bodies with constraints, closed forms, and the energy."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

import assur
from assur import Body, Damper, Force, Gravity, Spring, Torque, TorsionDamper, TorsionSpring, events
from assur.examples import loom
from models.machines.machines import five_bar, four_bar, pendulum
from oracles.dynamics.oracle_dae import Dae

if TYPE_CHECKING:
    from collections.abc import Callable

# What runs are to agree with the constrained bodies to (coordinates of some 10 rad).
DAE = 1e-9


def slider_crank() -> assur.Mechanism:
    return assur.Mechanism(
        joints={"O": (0, 0), "A": (0.06, 0.08), "B": (0.45, 0.03)},
        links={"ground": "O", "crank": "OA", "rod": "AB", "piston": "B"},
        slides={"bore": assur.Slide("piston", on="ground", angle=0.0, origin="O")},
        driver="crank",
    )


def loaded_four_bar() -> assur.Machine:
    return assur.Machine(
        four_bar(),
        bodies={
            "crank": Body(mass=1.0, inertia=0.4),
            "coupler": Body(mass=2.0, inertia=0.7, at=(1.1, 0.3)),
            "rocker": Body(mass=1.5, inertia=0.6, at=(1.0, -0.1)),
        },
        loads=[
            Gravity((0.3, -9.81)),
            Force("P", (3.0, lambda t, _, speed: 2.0 * math.cos(3.0 * t) - 0.1 * speed)),
            Torque("rocker", 1.5, on="coupler"),
            Damper("P", "D", 0.4),
            TorsionDamper("coupler", 0.3, on="crank"),
            TorsionSpring("rocker", 2.0, angle=0.7),
        ],
    )


def stiff() -> assur.Machine:
    """Springs that oscillate some hundred times in a turn."""
    crank = {
        "crank": Body(inertia=0.02),
        "rod": Body(mass=0.6, inertia=0.01, at=(0.2, 0.0)),
        "piston": Body(mass=1.2),
    }
    springs = [
        Spring("B", ("ground", (0.9, 0.02)), 4e5, 0.4),
        Spring("A", "B", 1e3, 0.2, preload=5.0),
    ]
    return assur.Machine(slider_crank(), bodies=crank, loads=[*springs, Gravity()])


def class_iv() -> assur.Machine:
    m = loom()
    masses = {
        name: Body(mass=1.0 + i, inertia=0.2)
        for i, name in enumerate(("l234", "l365", "l48", "l876"))
    }
    return assur.Machine(
        m, bodies={**masses, "crank": Body(inertia=3.0)}, loads=[Gravity(), Torque("l107", 2.0)]
    )


MACHINES: dict[str, tuple[Callable[[], assur.Machine], float, float]] = {
    "four-bar": (loaded_four_bar, 3.0, 4.0),
    "stiff springs": (stiff, 20.0, 0.15),
    "class IV": (class_iv, 3.0, 2.0),
}


@pytest.mark.parametrize("name", MACHINES)
def test_run_is_that_of_free_bodies_with_constraints(name: str) -> None:
    make, speed, end = MACHINES[name]
    machine = make()
    assert machine.mechanism is not None
    driver = str(machine.mechanism.driver)
    times = np.linspace(0.0, end, 9)
    q, speeds = Dae(machine).run(times, {driver: speed})
    run = machine.run(end, speed0=speed, rtol=1e-12)
    own = run.at(times)
    assert run.end == "reached"
    assert np.ptp(own.q) > 1.0
    assert np.abs(own.q - q[:, 0]).max() < DAE
    assert np.abs(own.speed - speeds[:, 0]).max() < DAE * np.abs(speeds).max()


def test_two_drivers() -> None:
    machine = assur.Machine(
        five_bar(),
        bodies={
            name: Body(mass=1.0 + i, inertia=0.3, at=(0.4, 0.1))
            for i, name in enumerate(("c1", "b1", "b2", "c2"))
        },
        loads=[Gravity((0.0, -4.0)), Damper("C", "E", 0.3), Torque("c2", 0.5)],
    )
    times = np.linspace(0.0, 1.2, 7)
    q, speeds = Dae(machine).run(times, {"c1": 1.0, "c2": -0.5})
    run = machine.run(1.2, speed0=[1.0, -0.5], rtol=1e-12)
    assert run.end == "reached"
    assert run.q.shape == (run.t.size, 2)
    own = run.at(times)
    assert np.abs(own.q - q).max() < DAE
    assert np.abs(own.speed - speeds).max() < DAE * np.abs(speeds).max()
    assert run.energy.error < 1e-10


@pytest.mark.parametrize(
    "motor",
    [
        assur.LinearMotor(30.0, 40.0, ratio=2.0, rotor_inertia=0.02),
        assur.InductionMotor(25.0, 0.3, 50.0, ratio=2.0, rotor_inertia=0.02),
        assur.ConstantTorque(4.0, ratio=2.0, rotor_inertia=0.02),
    ],
    ids=["linear", "induction", "constant"],
)
def test_motors(motor: Any) -> None:
    bodies = {
        "crank": Body(inertia=0.1),
        "rod": Body(mass=0.6, inertia=0.01, at=(0.2, 0.0)),
        "piston": Body(mass=1.2),
    }
    machine = assur.Machine(slider_crank(), bodies=bodies, loads=[Gravity()], motor=motor)

    def drive(speed: float) -> tuple[float, float]:
        own = 2.0 * speed
        if isinstance(motor, assur.LinearMotor):
            torque = 30.0 * (1.0 - own / 40.0)
        elif isinstance(motor, assur.InductionMotor):
            slip = 1.0 - own / 50.0
            torque = 2.0 * 25.0 / (slip / 0.3 + 0.3 / slip)
        else:
            torque = 4.0
        return 2.0 * torque, 4.0 * 0.02

    times = np.linspace(0.0, 0.6, 5)
    q, speeds = Dae(machine).run(times, {"crank": 0.0}, drive)
    own = machine.run(0.6, rtol=1e-12).at(times)
    assert np.abs(own.q - q[:, 0]).max() < DAE
    assert np.abs(own.speed - speeds[:, 0]).max() < DAE * np.abs(speeds).max()


def test_over_the_coordinate_and_over_the_time() -> None:
    machine = assur.Machine(
        slider_crank(),
        bodies={"crank": Body(inertia=0.3), "piston": Body(mass=2.0)},
        loads=[
            Force(
                "B", (assur.Table([0.0, 2.0, 4.0, math.tau], [0, 30, -20, 0], spline="linear"), 0.0)
            )
        ],
        motor=assur.LinearMotor(20.0, 12.0),
    )
    over_time = machine.run(5.0, q0=0.3, speed0=8.0, rtol=1e-12)
    over_q = machine.run(q_end=float(over_time.q[-1]), q0=0.3, speed0=8.0, rtol=1e-12)
    assert abs(over_q.t[-1] - 5.0) < 1e-10
    assert abs(over_q.speed[-1] - over_time.speed[-1]) < 1e-9
    assert abs(over_q.at(q=20.0).speed - over_time.at(float(over_q.at(q=20.0).t)).speed) < 1e-8
    assert over_q.energy.error < 1e-11
    # Backward what the motor dampens grows.
    there = machine.run(0.5, q0=0.3, speed0=8.0, rtol=1e-12)
    back = machine.run(0.0, q0=there.q[-1], speed0=there.speed[-1], t0=0.5, rtol=1e-12)
    assert abs(back.q[-1] - 0.3) < 1e-9
    assert abs(back.speed[-1] - 8.0) < 1e-8


def quarter(amplitude: float) -> float:
    """Quarter of the period of a pendulum with √(g/l) = 1: π/2 over the mean of 1 and cos(a/2)."""
    a, b = 1.0, math.cos(amplitude / 2.0)
    for _ in range(8):
        a, b = (a + b) / 2.0, math.sqrt(a * b)
    return math.pi / 2.0 / a


def test_event_times_are_those_of_a_pendulum() -> None:
    # Its lowest place is at the angle π.
    watched: list[Any] = [events.Position(math.pi, stop=False), events.Rest(stop=False)]
    run = pendulum().run(60.0, q0=math.pi - 1.0, rtol=1e-12, events=watched)
    own = quarter(1.0)
    times: dict[Any, list[float]] = {watched[0]: [], watched[1]: []}
    for one in run.events:
        times[one.event].append(one.t)
    odd = own * (2 * np.arange(len(times[watched[0]])) + 1)
    even = own * 2 * (np.arange(len(times[watched[1]])) + 1)
    assert len(odd) > 8
    assert len(even) > 8
    assert np.abs(np.array(times[watched[0]]) - odd).max() < 1e-10
    assert np.abs(np.array(times[watched[1]]) - even).max() < 1e-10
    # The speed at the bottom is 2 sin(1/2).
    fast = events.Speed(2.0 * math.sin(0.5) * 0.5)
    run = pendulum().run(60.0, q0=math.pi - 1.0, rtol=1e-12, events=[fast])
    # Where half that speed is: cos a − cos 1 = v²/2, and its time by the energy integral.
    assert run.end == "event"
    angle = run.events[0].q - math.pi
    assert abs(math.cos(angle) - math.cos(1.0) - run.speed[-1] ** 2 / 2.0) < 1e-12
    assert abs(run.speed[-1] - math.sin(0.5)) < 1e-13


def test_free_fall_of_a_piston() -> None:
    """A driven slide: s = s0 + v t − g t²/2; the time of a place is a root."""
    m = assur.Mechanism(
        joints={"O": (0, 0), "A": (0.06, 0.08), "B": (0.45, 0.0)},
        links={"ground": "O", "crank": "OA", "rod": "AB", "piston": "B"},
        slides={"bore": assur.Slide("piston", on="ground", angle=0.0, origin="O")},
        driver="bore",
    )
    machine = assur.Machine(m, bodies={"piston": Body(mass=3.0)}, loads=[Gravity((-2.0, 0.0))])
    run = machine.run(1.0, speed0=-0.1, events=[events.Position(0.4)], rtol=1e-12)
    # 0.05 = 0.1 t + t².
    exact = (-0.1 + math.sqrt(0.01 + 0.2)) / 2.0
    assert abs(run.t[-1] - exact) < 1e-12
    assert abs(run.speed[-1] + 0.1 + 2.0 * exact) < 1e-12


def test_transmission_angle_at_its_limit() -> None:
    machine = assur.Machine(assur.FourBar(1.0, 3.0, 2.5, 3.2), bodies={"crank": Body(inertia=1.0)})
    limit = math.radians(50.0)
    run = machine.run(20.0, q0=1.5, speed0=1.0, events=[events.TransmissionAngle("C", limit)])
    assert run.end == "event"
    assert machine.mechanism is not None
    own = machine.mechanism.solve(float(run.q[-1])).transmission_angle("C")
    assert abs(own - limit) < 1e-11
    press = assur.Machine(slider_crank(), bodies={"crank": Body(inertia=1.0)})
    watched = events.TransmissionAngle("bore", math.radians(80.0), stop=False)
    run = press.run(2.0, speed0=5.0, events=[watched])
    assert len(run.events) >= 2
    for one in run.events:
        at = slider_crank().solve(one.q).transmission_angle("bore")
        assert abs(at - math.radians(80.0)) < 1e-10


def time_to_dead_point(speed: float) -> float:
    """Time of (1, 3, 3, 3) without loads, both inertias 1, from the rocker's angle 2 at ±1 rad/s.

    The energy (1 + r'²) ω²/2 is constant, ω the crank's speed and r' the rocker's analogue. Over
    the crank's angle nothing is singular at the dead point, so the time is ∫ dq/ω.
    """

    def diagonal(crank: float) -> tuple[float, float, float]:
        x, y = math.cos(crank) - 3.0, math.sin(crank)
        return x, y, math.hypot(x, y)

    def rocker(crank: float) -> float:
        x, y, d = diagonal(crank)
        return math.atan2(y, x) % math.tau - math.acos(d / 6.0)

    def analogue(crank: float) -> float:
        x, y, d = diagonal(crank)
        turns = (x * math.cos(crank) + y * math.sin(crank)) / d**2
        return turns + 0.5 * math.sin(crank) / (d * math.sqrt(1.0 - d**2 / 36.0))

    # Crank and coupler in one line, where C is 3 - 1 or 3 + 1 from A.
    towards = {1.0: math.pi + math.acos(1.0 / 3.0), -1.0: math.acos(2.0 / 3.0)}[speed]
    assert abs(analogue(towards)) < 1e-15
    start: float = brentq(lambda crank: rocker(crank) - 2.0, 2.0, 2.4, xtol=1e-15)
    energy = 1.0 / analogue(start) ** 2 + 1.0
    time, _ = quad(
        lambda crank: math.sqrt((1.0 + analogue(crank) ** 2) / energy), start, towards, epsabs=1e-13
    )
    return abs(time)


def test_dead_point_ends_a_run_as_an_event() -> None:
    rocker = assur.FourBar(1.0, 3.0, 3.0, 3.0).with_driver("rocker")
    bodies = {"crank": Body(inertia=1.0), "rocker": Body(inertia=1.0)}
    machine = assur.Machine(rocker, bodies=bodies)
    # Crank and coupler are then in one line: 3 − 1 or 3 + 1 opposite to the rocker.
    ends = [math.pi - math.acos((9.0 + 9.0 - far**2) / 18.0) for far in (4.0, 2.0)]
    for speed, end in ((-1.0, ends[0]), (1.0, ends[1])):
        run = machine.run(50.0, q0=2.0, speed0=speed, rtol=1e-11)
        assert run.end == "dead point"
        assert run.events[-1].event == "dead point"
        assert abs(run.q[-1] - end) < 1e-9
        assert run.t[-1] < 5.0
        assert "dead point" in run.message
        over = machine.run(q_end=2.0 + 3.0 * speed, q0=2.0, speed0=speed)
        assert over.end == "dead point"
        assert abs(over.q[-1] - end) < 1e-9
        exact = time_to_dead_point(speed)
        assert abs(run.t[-1] - exact) < 1e-9
        assert abs(over.t[-1] - exact) < 1e-9


def test_rest_differs_from_a_dead_point() -> None:
    run = pendulum().run(20.0, q0=math.pi - 1.0)
    assert run.end == "reached"
    run = pendulum().run(q_end=7.0, q0=math.pi, speed0=0.5)
    assert run.end == "rest"
    assert abs(run.q[-1] - math.pi - 2.0 * math.asin(0.25)) < 1e-9


def test_through_change_points() -> None:
    """A kite's crank turns through its change points with the energy it has."""
    kite = assur.FourBar(1.0, 1.0, 2.0, 2.0)
    machine = assur.Machine(kite, bodies={"crank": Body(inertia=1.0), "rocker": Body(inertia=2.0)})
    run = machine.run(30.0, q0=1.0, speed0=1.5)
    assert run.end == "reached"
    assert run.q[-1] > 15.0
    assert run.energy.error < 1e-8
    parallelogram = assur.FourBar(1.0, 3.0, 1.0, 3.0)
    machine = assur.Machine(parallelogram, bodies={"rocker": Body(inertia=2.0)})
    run = machine.run(30.0, q0=1.0, speed0=1.5, rtol=1e-12)
    assert abs(run.q[-1] - 46.0) < 1e-9


def test_energy_of_a_thousand_turns() -> None:
    machine = assur.Machine(
        four_bar(),
        bodies={
            "crank": Body(inertia=2.0),
            "coupler": Body(mass=1.0, inertia=0.5, at=(1.1, 0.3)),
            "rocker": Body(mass=1.0, inertia=0.6),
        },
        loads=[Gravity((0.0, -1.0))],
    )
    run = machine.run(2100.0, speed0=3.5, rtol=1e-12)
    turns = (run.q - run.q[0]) / math.tau
    assert turns[-1] > 1000.0
    drift = np.abs(run.energy.balance) / run.energy.kinetic.max()
    assert drift.max() < 1e-9
    # The error of a turn is that of truncation, which has one sign: 4e-13 each, so that it grows
    # with the turns and no faster. Ten times the turns make at most twice ten times the error
    # (what grew with their square would make a hundred times; measured: 9.7 and 9.3).
    at = [float(drift[turns < n].max()) for n in (10, 100, 1000)]
    assert at[0] < 1e-11
    assert at[1] < 20.0 * at[0]
    assert at[2] < 20.0 * at[1]


def test_both_methods_and_tolerances() -> None:
    machine = loaded_four_bar()
    exact = machine.run(3.0, speed0=3.0, rtol=1e-13).at(3.0).q
    errors = {}
    for method in ("DOP853", "RK45"):
        for rtol in (1e-6, 1e-8, 1e-10):
            run = machine.run(3.0, speed0=3.0, rtol=rtol, method=method)
            errors[method, rtol] = abs(float(run.q[-1] - exact))
            assert errors[method, rtol] < 300.0 * rtol
    assert machine.run(3.0, speed0=3.0, rtol=1e-3, atol=(1e-3, 1e-2)).statistics.steps < 60


def test_functions_are_called_once_a_stage_with_floats() -> None:
    asked: list[tuple[float, float, float]] = []

    def load(t: float, q: float, speed: float) -> float:
        assert type(t) is type(q) is type(speed) is float
        asked.append((t, q, speed))
        return -speed

    machine = assur.Machine(
        four_bar(), bodies={"crank": Body(inertia=2.0)}, loads=[Torque("crank", load)]
    )
    asked.clear()
    run = machine.run(1.0, speed0=1.0)
    # And once to find the size of the accelerations.
    assert len(asked) == run.statistics.evaluations + 1
    assert abs(run.speed[-1] - math.exp(-0.5)) < 1e-9
    assert run.energy.error < 1e-9


def test_time_dependent_loads_and_breaks() -> None:
    def step(t: float, _: float, __: float) -> float:
        return 1.0 if t < 0.5 else -3.0

    machine = assur.Machine(
        four_bar(), bodies={"crank": Body(inertia=2.0)}, loads=[Torque("crank", step)]
    )
    run = machine.run(1.0, speed0=1.0, breaks=[0.5])
    assert abs(run.speed[-1] - (1.0 + 0.25 - 0.75)) < 1e-12
    assert run.statistics.steps < 20


def test_tables_of_different_periods() -> None:
    """Loads over one turn, two and a third of one; J is constant, work is the tables' integral."""
    tables = [
        assur.Table([0.0, 1.0, math.tau], [0.0, 1.0, 0.0], spline="linear"),
        assur.Table([0.0, 5.0, 2 * math.tau], [0.5, -1.0, 0.5], spline="linear"),
        assur.Table([0.0, 1.0, math.tau / 3.0], [0.0, 0.3, 0.0], spline="linear"),
    ]
    m = assur.FourBar(1.0, 3.0, 2.5, 3.2)
    machine = assur.Machine(
        m, bodies={"crank": Body(inertia=2.0)}, loads=[Torque("crank", t) for t in tables]
    )
    # Means 1/2, −1/4 and 0.15.
    work = 2 * math.tau * (0.5 - 0.25 + 0.15)
    run = machine.run(q_end=2 * math.tau, q0=0.0, speed0=1.0, rtol=1e-12)
    assert abs(run.speed[-1] - math.sqrt(1.0 + work)) < 1e-12
    timed = machine.run(float(run.t[-1]), q0=0.0, speed0=1.0, rtol=1e-12)
    assert abs(timed.q[-1] - 2 * math.tau) < 1e-10
    # Between the ends the knots are 1, 5, 2π, 2π + 1 and 2π/3 i, 2π/3 i + 1: all three at once at
    # 2π count once. That at the end of the run counts where the time goes beyond it.
    knots = {1.0, 5.0, math.tau + 1.0} | {math.tau / 3.0 * i for i in range(1, 6)}
    knots |= {math.tau / 3.0 * i + 1.0 for i in range(6)}
    inside = len({round(q, 9) for q in knots})
    assert inside == 12
    assert run.statistics.restarts == inside
    for part, extra in ((1.0 - 1e-9, 0), (1.0 + 1e-9, 1)):
        around = machine.run(float(run.t[-1]) * part, q0=0.0, speed0=1.0, rtol=1e-12)
        assert around.statistics.restarts == inside + extra
