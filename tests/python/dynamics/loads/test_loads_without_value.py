"""Forces without a finite value: the error names the load, its coordinate and the place."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, get_args

import numpy as np
import pytest

import assur
from assur import Body, Damper, Force, Gravity, Machine, Pressure, Spring, Status, Table, Torque
from assur.dynamics.loads.loads import BetweenPoints
from models.machines.every_load import KINDS, missing

if TYPE_CHECKING:
    from collections.abc import Callable

Q = np.linspace(0.0, 2.0 * np.pi, 25)
BODIES = {"piston": Body(mass=2.0), "crank": Body(inertia=0.1)}
SHORT = Table([0.35, 0.45], [0.0, 10.0], over="bore")


def slider() -> assur.Mechanism:
    return assur.SliderCrank(0.1, 0.4)


def machine(*loads: Any) -> Machine:
    return Machine(slider(), bodies=BODIES, loads=loads)


ASKED: list[Callable[[Machine, Any], Any]] = [
    lambda m, q: m.reactions(q, speed=2.0),
    lambda m, q: m.effort(q, speed=2.0),
    lambda m, q: m.reduced_moment(q, 2.0),
]
CASES: list[tuple[Any, float, str, float | None]] = [
    (
        Force("B", (SHORT, 0.0)),
        0.0,
        "the Force at 'B': a table over 'bore' covers 0.35 to 0.45: 0.5, at q = 0, is not in it",
        0.5,
    ),
    (
        Torque("rod", Table([-0.1, 0.3], [1.0, 2.0], over="rod")),
        1.5,
        "the Torque on 'rod': a table over 'rod' covers -0.1 to 0.3: ",
        -math.asin(0.25 * math.sin(1.5)),
    ),
    (
        Pressure("bore", 0.01, Table([0.0, 1.0], [1e5, 2e5], periodic=False), "forward"),
        2.0,
        "the Pressure in 'bore': a table over q covers 0 to 1: 2 is not in it",
        2.0,
    ),
    (
        Torque("crank", lambda _t, q, _speed: math.inf if q == 1.25 else 1.0),
        1.25,
        "the Torque on 'crank': at q = 1.25 its function gave inf, it must be finite",
        math.inf,
    ),
    (
        Spring("B", ("ground", (0.5, 0.0)), 3.0, 0.1),
        0.0,
        "the Spring from 'B' to a point of 'ground' has length zero",
        None,
    ),
    (
        Damper("B", ("ground", (0.5, 0.0)), 3.0),
        0.0,
        "the Damper from 'B' to a point of 'ground' has length zero",
        None,
    ),
]


def test_no_kind_is_left_out() -> None:
    """Loads without direction where their ends meet; numbers of every kind."""
    assert not missing((case[0] for case in CASES), get_args(BetweenPoints))
    assert set(KINDS) <= {kind for kind, _ in NUMBERS}


@pytest.mark.parametrize("ask", ASKED)
@pytest.mark.parametrize("case", CASES)
def test_the_load_is_named(
    ask: Callable[[Machine, Any], Any], case: tuple[Any, float, str, float | None]
) -> None:
    load, q, message, value = case
    with pytest.raises(assur.AssurError) as raised:
        ask(machine(Gravity(), Torque("crank", 1.0), load), q)
    assert str(raised.value).startswith(f"loads[2], {message}")
    assert raised.value.q == q
    if value is not None:
        assert raised.value.value == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize("ask", ASKED)
def test_a_design_of_a_batch_is_named(ask: Callable[[Machine, Any], Any]) -> None:
    """The stroke of the second alone is too long."""
    batch = assur.SliderCrank([0.05, 0.051], 0.4)
    with pytest.raises(assur.InputError) as raised:
        ask(Machine(batch, bodies=BODIES, loads=[Force("B", (SHORT, 0.0))]), Q)
    assert raised.value.kind == "table_ends"
    assert (raised.value.design, raised.value.q) == ((1,), 0.0)
    assert raised.value.value == pytest.approx(0.451)


def test_a_motor_over_the_coordinate_is_named() -> None:
    motor = assur.ConstantTorque(Table([0.0, 1.0], [1.0, 2.0], periodic=False))
    own = Machine(slider(), bodies=BODIES, motor=motor)
    assert np.isfinite(own.reactions(2.0).driver)


def test_positions_without_forces_have_a_status() -> None:
    found = machine(Force("B", (SHORT, 0.0))).reactions(Q, on_error="nan")
    bore = slider().solve(Q)["bore"].value
    outside = (bore < 0.35) | (bore > 0.45)
    assert (found.status == np.where(outside, Status.NO_VALUE, Status.OK)).all()
    assert (np.isnan(found.driver) == outside).all()
    assert found.undetermined == ()
    at = int(np.flatnonzero(outside)[0])
    with pytest.raises(assur.InputError, match="no reactions there: a load or an inertia force"):
        found.plot(at=at)


def test_a_load_that_does_not_act_needs_no_value() -> None:
    """Beyond its table a load acts on the way back alone."""
    load = Force("B", (SHORT, 0.0), while_="forward", over="bore")
    back = np.linspace(0.05, 3.0, 20)
    found = machine(load).reactions(back, speed=1.0)
    assert np.isfinite(found.driver).all()
    assert (found.status == Status.OK).all()


def test_a_speed_beyond_all_numbers() -> None:
    with pytest.raises(assur.MotionError, match="every load by itself has a value, a speed"):
        machine(Gravity()).reactions(0.5, speed=1e200)


def test_one_driver_without_a_moment_is_enough() -> None:
    """The torques overflow at the first driver; the moment of the second is zero."""
    five = assur.examples.five_bar()
    left = str(five.description.drivers[0])
    overloaded = Machine(five, bodies={}, loads=[Torque(left, 1e308), Torque(left, 1e308)])
    drawn: Any = five.q0
    turned = np.add(drawn, 0.1)
    assert np.array_equal(overloaded.reduced_moment(drawn, on_error="nan"), [np.inf, 0.0])
    places: list[Any] = [drawn, [turned, drawn]]
    for q in places:
        for ask in (overloaded.reduced_moment, overloaded.effort):
            with pytest.raises(assur.MotionError, match="a mass is too great there") as raised:
                ask(q)
            assert raised.value.q == tuple(np.atleast_2d(q)[0])


@pytest.mark.parametrize("driver", [0, 1])
def test_one_driver_without_a_number_is_enough(driver: int) -> None:
    """Whichever driver's coordinate or speed is NaN, nothing is computed."""
    five = assur.examples.five_bar()
    loaded = Machine(five, bodies={}, loads=[Torque(str(five.description.drivers[0]), 1.0)])
    wrong = np.where(np.arange(2) == driver, np.nan, five.q0)
    for ask in (loaded.reduced_moment, loaded.effort):
        with pytest.raises(assur.InputError, match="a finite coordinate is needed"):
            ask(wrong, 1.0)
        with pytest.raises(assur.InputError, match="speed"):
            ask(five.q0, wrong)
    for of_place in (loaded.reduced_inertia, loaded.potential):
        with pytest.raises(assur.InputError, match="a finite coordinate is needed"):
            of_place(wrong)


@pytest.mark.parametrize("way", [1.0, -1.0])
@pytest.mark.parametrize("over_q", [False, True])
def test_a_run_that_starts_outside_a_table_names_load_value_and_range(
    way: float, over_q: bool
) -> None:
    beyond = Table([0.0, 1.0], [1.0, 2.0], periodic=False)
    for load, q0, message, value in [
        (
            Force("B", (SHORT, 0.0)),
            0.0,
            "the Force at 'B': a table over 'bore' covers 0.35 to 0.45: 0.5, at q = 0, is not in",
            0.5,
        ),
        (
            Torque("rod", Table([-0.1, 0.3], [1.0, 2.0], over="rod")),
            1.5,
            "the Torque on 'rod': a table over 'rod' covers -0.1 to 0.3: -0.252033517, at q = 1.5",
            -math.asin(0.25 * math.sin(1.5)),
        ),
        (
            Torque("crank", beyond),
            3.0,
            "the Torque on 'crank': a table over q covers 0 to 1: 3 is not in it",
            3.0,
        ),
    ]:
        own = machine(Gravity(), Torque("crank", 1.0), load)
        end: dict[str, Any] = {"q_end": q0 + way} if over_q else {"t_end": 1.0}
        with pytest.raises(assur.InputError) as raised:
            own.run(q0=q0, speed0=5.0 * way, **end)
        assert str(raised.value).startswith(f"loads[2], {message}")
        assert str(raised.value).endswith("; extend the table, or start within it")
        assert raised.value.kind == "table_ends"
        assert raised.value.q == q0
        assert raised.value.value == pytest.approx(value, rel=1e-12)


def test_a_steady_state_names_a_table_that_does_not_cover_its_period() -> None:
    with pytest.raises(assur.InputError) as raised:
        machine(Force("B", (SHORT, 0.0))).steady_state(speed=5.0, q0=1.2)
    assert str(raised.value).startswith("loads[0], the Force at 'B': a table over 'bore' covers")
    bore = float(slider().solve(raised.value.q).slide("bore").value)
    assert raised.value.value == pytest.approx(bore, rel=1e-12)
    assert not 0.35 <= bore <= 0.45


def test_a_potential_has_no_value_beyond_a_table() -> None:
    own = machine(Gravity(), Force("B", (SHORT, 0.0)))
    bore = slider().solve(Q).slide("bore").value
    outside = (bore < 0.35) | (bore > 0.45)
    found = own.potential(Q, on_error="nan")
    assert (np.isnan(found) == outside).all()
    assert np.array_equal(found[~outside], machine(Gravity()).potential(Q)[~outside])
    with pytest.raises(assur.InputError, match="the Force at 'B': a table over 'bore' covers"):
        own.potential(0.0)
    beyond = Table([0.0, 1.0, 2.0], [-1.0, 1.0, 1.0], spline="linear", periodic=False)
    over_q = machine(Torque("crank", beyond))
    with pytest.raises(assur.InputError, match="a table over q covers 0 to 2: 3 is not in it"):
        over_q.potential([1.0, 3.0])
    assert np.isnan(over_q.potential([1.0, 3.0], on_error="nan")).tolist() == [False, True]
    # Loads of one direction only need no value where they do not act.
    assert np.isfinite(machine(Force("B", (SHORT, 0.0), while_="forward")).potential(Q)).all()
    batch = Machine(
        assur.SliderCrank([0.05, 0.051], 0.4), bodies=BODIES, loads=[Force("B", (SHORT, 0.0))]
    )
    with pytest.raises(assur.InputError) as raised:
        batch.potential(0.0)
    assert raised.value.design == (1,)


NUMBERS: list[tuple[type, dict[str, Any]]] = [
    (Body, {"mass": 1.0, "inertia": 1.0, "at": (0.0, 0.0)}),
    (Gravity, {"acceleration": (0.0, -1.0)}),
    (Force, {"at": ("rod", (0.1, 0.0)), "force": (1.0, 2.0)}),
    (Torque, {"link": "crank", "torque": 1.0}),
    (
        Pressure,
        {"slide": "bore", "area": 1.0, "pressure": 1e5, "expands": "forward", "ambient": 0.0},
    ),
    (assur.Gas, {"pressure": 1e5, "volume": 1e-3, "at": 0.1, "exponent": 1.3}),
    (
        Spring,
        {
            "first": ("rod", (0.0, 0.1)),
            "second": "A",
            "stiffness": 1.0,
            "length": 1.0,
            "preload": 0.0,
        },
    ),
    (Damper, {"first": ("rod", (0.0, 0.1)), "second": "A", "damping": 1.0}),
    (assur.TorsionSpring, {"link": "crank", "stiffness": 1.0, "angle": 0.0, "preload": 0.0}),
    (assur.TorsionDamper, {"link": "crank", "damping": 1.0}),
    (Table, {"q": [0.0, 1.0], "value": [1.0, 1.0], "ratio": 1.0, "rotor_inertia": 0.0}),
    (assur.ConstantTorque, {"torque": 1.0, "ratio": 1.0, "rotor_inertia": 0.0}),
    (assur.LinearMotor, {"stall": 1.0, "no_load": 2.0, "ratio": 1.0, "rotor_inertia": 0.0}),
    (
        assur.InductionMotor,
        {"breakdown": 1.0, "slip": 0.1, "synchronous": 9.0, "ratio": 1.0, "rotor_inertia": 0.0},
    ),
    (
        assur.JointFriction,
        {"coefficient": 0.1, "radius": 0.1, "viscous": 0.0, "static_coefficient": 0.2},
    ),
    (
        assur.SlideFriction,
        {"coefficient": 0.1, "length": 0.1, "viscous": 0.0, "static_coefficient": 0.2},
    ),
]


def with_number(value: Any, number: float) -> list[Any]:
    """Return a field's value with each of its numbers replaced in turn."""
    if isinstance(value, float):
        return [number]
    if isinstance(value, str):
        return []
    return [
        type(value)(one if i == index else other for i, other in enumerate(value))
        for index, part in enumerate(value)
        for one in with_number(part, number)
    ]


@pytest.mark.parametrize("number", [math.nan, math.inf, -math.inf])
@pytest.mark.parametrize(("kind", "fields"), NUMBERS)
def test_a_number_that_is_not_finite_names_the_load_and_the_field(
    kind: Callable[..., Any], fields: dict[str, Any], number: float
) -> None:
    # The components of a force have names of their own; gravity has nothing but its acceleration.
    names = {"force": "f", "acceleration": "Gravity"}
    kind(**fields)
    for field, value in fields.items():
        for wrong in with_number(value, number):
            with pytest.raises(assur.InputError) as raised:
                kind(**{**fields, field: wrong})
            message = str(raised.value)
            assert message.startswith(kind.__name__)
            assert names.get(field, field) in message
            assert repr(number) in message


def test_a_force_names_its_joint_and_its_component() -> None:
    with pytest.raises(assur.InputError, match=r"^Force at 'B': fy is nan: a finite number"):
        Force("B", (1.0, math.nan))
    with pytest.raises(assur.InputError, match=r"^Torque on 'rod': torque is inf: a finite number"):
        Torque("rod", math.inf)
