"""Many runs in one call: each has the bits that it has alone."""

from __future__ import annotations

import copy
import math
import pickle
import warnings
from functools import cache
from typing import Any

import numpy as np
import pytest

import assur
from assur import Body, Damper, Force, Gravity, Spring, Torque, events
from models.machines.machines import five_bar, four_bar

RTOL = 1e-8


def slider_crank(**parts: Any) -> assur.Machine:
    bodies = {
        "crank": Body(inertia=0.5),
        "rod": Body(mass=4.0, inertia=0.05, at=(0.2, 0.01)),
        "piston": Body(mass=20.0),
    }
    return assur.Machine(assur.SliderCrank(0.1, 0.4), bodies=bodies, **parts)


def two_drivers() -> assur.Machine:
    names = ("c1", "b1", "b2", "c2")
    bodies = {name: Body(mass=1.0 + i, inertia=0.3, at=(0.4, 0.1)) for i, name in enumerate(names)}
    return assur.Machine(
        five_bar(),
        bodies=bodies,
        loads=[Gravity((0.0, -4.0)), Damper("C", "E", 0.3), Torque("c2", 0.5)],
    )


def pushed(driven: str) -> assur.Machine:
    """A slider-crank driven by its piston, or by a cylinder on its crank."""
    if driven == "bore":
        mechanism = assur.Mechanism(
            joints={"O": (0, 0), "A": (0.06, 0.08), "B": (0.45, 0.03)},
            links={"ground": "O", "crank": "OA", "rod": "AB", "piston": "B"},
            slides={"bore": assur.Slide("piston", on="ground", angle=0.0, origin="O")},
            driver="bore",
        )
        bodies = {"piston": Body(mass=2.0), "crank": Body(inertia=0.05)}
        return assur.Machine(mechanism, bodies=bodies, loads=[Gravity()])
    boom = assur.Mechanism(
        joints={"O": (0, 0), "A": (1.0, 0.3), "G": (0.6, -0.8)},
        links={"ground": "OG", "boom": "OA"},
        slides={"ram": assur.Cylinder("G", "A")},
        driver="ram",
    )
    return assur.Machine(boom, bodies={"boom": Body(mass=30.0, at="A")}, loads=[Gravity()])


def rubbing() -> assur.Machine:
    pairs = {"A": assur.JointFriction(0.5, 0.05), "bore": assur.SlideFriction(0.5, 0.1)}
    return slider_crank(loads=[Gravity((9.81, 0.0))], friction=pairs)


def with_table() -> assur.Machine:
    q = np.linspace(0.0, 2.0 * np.pi, 13)
    force = assur.Table(q, np.sin(q))
    speeds = np.array([-400.0, 0.0, 10.0, 400.0])
    motor = assur.Table(speeds, np.array([60.0, 40.0, 0.0, -60.0]), periodic=False)
    return slider_crank(loads=[Torque("crank", force)], motor=motor)


def with_functions() -> assur.Machine:
    return slider_crank(loads=[Force("B", (lambda t, _, v: 20.0 * math.cos(t) - 2.0 * v, 0.0))])


def lever() -> assur.Machine:
    linkage = assur.FourBar(1.0, 3.0, 3.0, 3.0).with_driver("rocker")
    return assur.Machine(linkage, bodies={"crank": Body(inertia=0.5), "rocker": Body(inertia=1.0)})


STATES = np.linspace(0.2, 6.0, 9)
SPEEDS = np.linspace(-3.0, 3.0, 9)
PAIR = np.random.default_rng(3).uniform(-0.2, 0.2, (7, 2))
OBSTACLE = events.Obstacle(events.Position(4.0, direction="rising"), 0.5)

CASES: dict[str, tuple[Any, dict[str, Any]]] = {
    "motor": (
        lambda: slider_crank(loads=[Gravity()], motor=assur.LinearMotor(50.0, 15.0)),
        {"t_end": 1.0, "q0": STATES, "speed0": SPEEDS},
    ),
    "springs": (
        lambda: slider_crank(loads=[Spring("A", "B", 1e3, 0.3), Damper("A", "B", 3.0)]),
        {"t_end": [0.3, 0.6, 1.2], "q0": STATES[:3], "speed0": 2.0},
    ),
    "many drivers": (
        two_drivers,
        {"t_end": 0.8, "q0": np.asarray(five_bar().q0) + PAIR, "speed0": 5.0 * PAIR},
    ),
    "slide": (lambda: pushed("bore"), {"t_end": 1.0, "q0": np.linspace(0.35, 0.45, 5)}),
    "cylinder": (
        lambda: pushed("ram"),
        {"t_end": 0.4, "q0": [1.0, 1.1, 1.2], "speed0": [0.1, 0.0, -0.1]},
    ),
    "friction": (rubbing, {"t_end": 3.0, "q0": STATES[:5], "speed0": [2.0, 0.0, -1.0, 0.5, 3.0]}),
    "tables": (with_table, {"t_end": 1.0, "q0": STATES, "speed0": SPEEDS}),
    "functions": (with_functions, {"t_end": 0.5, "q0": STATES[:4], "speed0": SPEEDS[:4]}),
    "events": (
        lambda: slider_crank(loads=[Gravity()]),
        {
            "t_end": 3.0,
            "q0": STATES,
            "speed0": SPEEDS,
            "events": [
                events.Position(2.0, stop=False),
                events.Speed(1.0),
                events.Rest(stop=False),
            ],
        },
    ),
    "obstacle": (
        lambda: slider_crank(loads=[Torque("crank", 3.0)]),
        {"t_end": 4.0, "q0": [0.0, 1.0, 3.5], "events": [OBSTACLE]},
    ),
    "crossing": (
        lambda: slider_crank(loads=[Gravity()]),
        {"t_end": 1.0, "q0": STATES, "events": [events.Crossing(lambda t, *_: t - 0.4)]},
    ),
    "dead points": (lever, {"t_end": 9.0, "q0": [2.1, 2.3, 1.9], "speed0": [1.0, -1.0, 0.5]}),
    "over q": (
        lambda: slider_crank(loads=[Gravity()], motor=assur.ConstantTorque(40.0)),
        {"q_end": [8.0, 9.0, 12.0], "q0": [0.0, 0.5, 1.0], "speed0": 5.0},
    ),
    "tabulated": (
        lambda: assur.Machine.from_table(
            np.linspace(0.0, 2 * np.pi, 25), -10 * np.sin(np.linspace(0, 2 * np.pi, 25)), 2.0
        ),
        {"t_end": 2.0, "q0": STATES, "speed0": SPEEDS},
    ),
    "DOPRI5": (
        lambda: slider_crank(loads=[Gravity()]),
        {"t_end": 1.0, "q0": STATES, "speed0": SPEEDS, "method": "RK45"},
    ),
}


def bits(part: Any) -> Any:
    """All numbers of a state, to the bit."""
    if isinstance(part, dict):
        return {key: bits(value) for key, value in part.items()}
    if isinstance(part, list):
        return [bits(one) for one in part]
    return part.tobytes() if isinstance(part, np.ndarray) else repr(part)


def same(one: assur.Run, other: assur.Run) -> bool:
    """Whether two runs agree to the bit: steps, events, energies, ends and dense output."""
    return bool(bits(one._core.__reduce__()[1][0]) == bits(other._core.__reduce__()[1][0]))


def alone(machine: assur.Machine, arguments: dict[str, Any], index: int) -> assur.Run:
    """One of the runs by itself."""
    tails = {"q0": machine.driver_count > 1, "speed0": machine.driver_count > 1}
    one = dict(arguments)
    for name in ("t_end", "q_end", "q0", "speed0"):
        if name in one and np.ndim(one[name]) > tails.get(name, False):
            one[name] = np.asarray(one[name])[index].tolist()
    made: assur.Run = machine.run(rtol=RTOL, **one)
    return made


@cache
def batch(name: str) -> tuple[assur.Machine, dict[str, Any], assur.Runs]:
    make, arguments = CASES[name]
    machine = make()
    return machine, arguments, machine.run(rtol=RTOL, **arguments)


@pytest.mark.parametrize("name", CASES)
def test_each_run_has_the_bits_that_it_has_alone(name: str) -> None:
    machine, arguments, runs = batch(name)
    assert isinstance(runs, assur.Runs)
    for index, run in enumerate(runs):
        single = alone(machine, arguments, index)
        assert same(run, single), index
        assert run.end == single.end == runs.end[index]
        assert run.message == single.message == runs.explain(index)
        assert [repr(event) for event in run.events] == [repr(event) for event in single.events]
        assert bits(run.energy.balance) == bits(single.energy.balance)
        assert bits(runs.t_end[index]) == bits(single.t[-1])
        assert np.array_equal(runs.q_end[index], single.q[-1])
        assert np.array_equal(runs.speed_end[index], single.speed[-1])


@pytest.mark.parametrize("name", CASES)
def test_common_points_have_the_bits_of_each_run(name: str) -> None:
    machine, arguments, runs = batch(name)
    along_q = "q_end" in arguments
    ends = runs.q_end if along_q else runs.t_end
    grid = np.linspace(1.0 if along_q else 0.0, float(np.max(ends)), 7)
    state = runs.at(q=grid) if along_q else runs.at(grid)
    for index, run in enumerate(runs):
        inside = grid <= ends[index]
        own = run.at(q=grid[inside]) if along_q else run.at(grid[inside])
        for many, one in zip(state, own, strict=True):
            assert np.array_equal(many[index][inside], one)
            assert np.isnan(many[index][~inside]).all()
    assert machine.driver_count == 1 or state.q.shape == (*runs.shape, 7, machine.driver_count)


def test_ends_differ_in_one_batch() -> None:
    runs = batch("dead points")[2]
    assert set(runs.end.tolist()) <= {"dead point", "reached"}
    assert "dead point" in runs.end
    assert len(set(batch("events")[2].t_end.tolist())) > 3
    assert any(event.event == "stick" for run in batch("friction")[2] for event in run.events)


def test_designs_and_states() -> None:
    lengths = np.array([0.3, 0.4, 0.5])
    press = slider_crank(loads=[Gravity()])
    assert press.mechanism is not None
    machine = press.of(press.mechanism.with_dimensions({"rod.length": lengths}))
    angle = events.TransmissionAngle("B", limit=1.45, stop=False)
    runs: assur.Runs = machine.run(0.5, q0=[0.5, 1.5], speed0=[2.0, -1.0], events=[angle])
    assert runs.shape == (3, 2)
    for i in range(3):
        for j, (q, speed) in enumerate([(0.5, 2.0), (1.5, -1.0)]):
            single = machine.design(i).run(0.5, q, speed, events=[angle])
            assert same(runs[i, j], single)
            assert runs.q_end[i, j] == single.q[-1]
    assert len(runs) == 6
    assert same(runs[3], runs[1, 1])
    assert runs[1:3].shape == (2,)
    assert same(runs[1:3][1], runs[1, 0])
    assert runs.at([0.1, 0.2, 0.3]).speed.shape == (3, 2, 3)
    each: Any = machine.run(0.1, q0=0.5)
    assert isinstance(each, assur.Runs)
    assert each.shape == (3,)


def test_shapes_broadcast() -> None:
    machine = slider_crank()
    runs: assur.Runs = machine.run([[0.1], [0.2]], q0=[0.0, 1.0, 2.0], speed0=1.0)
    assert runs.shape == (2, 3)
    assert runs.t_end.tolist() == [[0.1] * 3, [0.2] * 3]
    assert same(runs[-1], runs[1, 2])
    assert same(runs[-1, -1], runs[1, 2])
    none: assur.Runs = machine.run(0.1, q0=np.empty(0))
    assert (len(none), none.shape, none.at([0.0, 0.1]).q.shape) == (0, (0,), (0, 2))


def test_only_the_ends() -> None:
    machine, arguments, whole = batch("events")
    ends: assur.Runs = machine.run(rtol=RTOL, keep="ends", **arguments)
    for name in ("t_end", "q_end", "speed_end", "end", "status"):
        assert np.array_equal(getattr(ends, name), getattr(whole, name)), name
    for one, full in zip(ends, whole, strict=True):
        assert [repr(event) for event in one.events] == [repr(event) for event in full.events]
        assert (one.t.tolist(), one.statistics) == ([full.t[-1]], full.statistics)
        assert one.energy.kinetic[-1] == full.energy.kinetic[-1]
    with pytest.raises(assur.InputError, match=r"only the ends .* keep='all'"):
        ends.at(0.1)


def test_what_cannot_start_is_nan_in_its_place() -> None:
    machine = lever()
    states = [2.3, 0.2, 1.9, 0.1]
    with pytest.raises(assur.PositionError, match=r"run 1: .*and 1 more of 4; on_error='nan'"):
        machine.run(0.1, q0=states, speed0=0.1)
    runs: assur.Runs = machine.run(0.1, q0=states, speed0=0.1, on_error="nan")
    assert runs.end.tolist() == ["reached", "failed", "reached", "failed"]
    assert [assur.Status(code).name for code in runs.status] == ["OK", "UNREACHABLE"] * 2
    assert np.isnan(runs.t_end).tolist() == [False, True] * 2
    assert np.isnan(runs.at(0.05).q).tolist() == [False, True] * 2
    assert same(runs[2], machine.run(0.1, 1.9, 0.1))
    with pytest.raises(assur.PositionError, match="cannot start at q0") as alone_:
        machine.run(0.1, 0.2, 0.1)
    with pytest.raises(assur.PositionError) as caught:
        runs[1]
    assert str(caught.value) == str(alone_.value) == runs.explain(1)


def test_what_has_no_inertia_has_no_value() -> None:
    bare = assur.Machine(assur.SliderCrank(0.1, 0.4), bodies={"piston": Body(mass=1.0)})
    runs: assur.Runs = bare.run(0.01, q0=[0.0, 1.0], speed0=0.1, on_error="nan")
    assert runs.status.tolist() == [assur.Status.NO_VALUE, assur.Status.OK]


def test_a_table_that_ends_is_named_with_its_run() -> None:
    table = assur.Table(np.linspace(0.0, 2.0, 5), np.ones(5), periodic=False)
    machine = slider_crank(loads=[Torque("crank", table)])
    with pytest.raises(assur.InputError, match=r"run 1: .*Torque.*table"):
        machine.run(0.1, q0=[1.0, 3.0])


def test_one_warning_counts_early_ends() -> None:
    machine = slider_crank(loads=[Gravity()])
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        runs = machine.run(1.0, q0=STATES, max_steps=5)
    assert [str(warning.message) for warning in caught] == [
        "9 of 9 runs ended early: 9 step limit; explain(index) says where"
    ]
    assert caught[0].filename == __file__
    assert set(runs.end) == {"step limit"}


def test_a_function_that_fails_ends_all() -> None:
    def load(t: float, q: float, _: float) -> float:
        if t > 0.05 and q > 1.0:
            message = "no more"
            raise ZeroDivisionError(message)
        return 1.0

    machine = slider_crank(loads=[Torque("crank", load)])
    with pytest.raises(ZeroDivisionError, match="no more"):
        machine.run(0.1, q0=[0.0, 2.0], on_error="nan")


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ({"t_end": 1.0, "q0": [0.0, 1.0], "speed0": [1.0, 2.0, 3.0]}, "shapes of the runs"),
        ({"t_end": [1.0, np.nan]}, "t_end"),
        ({"t_end": 1.0, "q0": [0.0, 1.0], "keep": "some"}, "keep"),
        ({"t_end": 1.0, "q0": [0.0, 1.0], "on_error": "hold"}, "on_error"),
        ({"t_end": 1.0, "q0": [0.0, 1.0], "threads": 0}, "threads"),
        ({"q_end": [1.0, 2.0], "q0": [0.0, 3.0], "speed0": 1.0}, "run 1: q_end = 2 lies behind"),
        ({"q_end": [1.0, 2.0], "q0": 0.0}, "run 0: q_end: a run over q needs an initial speed"),
    ],
)
def test_bad_input(arguments: dict[str, Any], told: str) -> None:
    with pytest.raises(assur.InputError, match=told):
        slider_crank().run(**arguments)


def test_the_last_axis_is_that_of_the_drivers() -> None:
    with pytest.raises(
        assur.InputError, match=r"speed0 has the shape \(3,\): its last axis must be 2"
    ):
        two_drivers().run(0.1, speed0=[1.0, 2.0, 3.0])


def test_bad_questions() -> None:
    runs = batch("motor")[2]
    with pytest.raises(assur.InputError, match="these runs go along t"):
        runs.at(q=1.0)
    with pytest.raises(assur.InputError, match=r"shape \(1, 2\)"):
        runs.at([[0.1, 0.2]])
    with pytest.raises(IndexError):
        runs[99]
    wrong: list[Any] = ["first", 0.5, True, (0, 0), None]
    for index in wrong:
        with pytest.raises(assur.InputError, match="an index is a whole number"):
            runs[index]


def test_threads_change_no_bit() -> None:
    machine = four_bar()
    bodies = {"crank": Body(inertia=0.4), "rocker": Body(inertia=0.6)}
    wheel = assur.Machine(machine, bodies=bodies, loads=[Gravity()])
    q = np.linspace(0.0, 6.0, 200)
    one: assur.Runs = wheel.run(0.2, q0=q, threads=1, rtol=1e-6)
    two: assur.Runs = wheel.run(0.2, q0=q, threads=2, rtol=1e-6)
    assert all(same(a, b) for a, b in zip(one, two, strict=True))


def test_copies_and_pickles() -> None:
    machine = lever()
    runs: assur.Runs = machine.run(0.1, q0=[2.3, 0.2], speed0=0.1, on_error="nan")
    for again in (copy.copy(runs), copy.deepcopy(runs), pickle.loads(pickle.dumps(runs))):
        assert repr(again) == repr(runs) == "<assur.Runs of shape (2,): 1 failed, 1 reached>"
        assert same(again[0], runs[0])
        assert again.explain(1) == runs.explain(1)
    part = pickle.loads(pickle.dumps(runs[:1]))
    assert part.shape == (1,)
