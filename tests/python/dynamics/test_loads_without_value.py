"""Forces without a finite value: the error names the load, its coordinate and the place."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur import Body, Damper, Force, Gravity, Machine, Pressure, Spring, Status, Table, Torque

if TYPE_CHECKING:
    from collections.abc import Callable

Q = np.linspace(0.0, 2.0 * np.pi, 25)
BODIES = {"piston": Body(2.0), "crank": Body(inertia=0.1)}
SHORT = Table([0.35, 0.45], [0.0, 10.0], over="bore")


def slider() -> assur.Mechanism:
    return assur.SliderCrank(0.1, 0.4)


def machine(*loads: Any) -> Machine:
    return Machine(slider(), BODIES, loads)


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
        ask(Machine(batch, BODIES, [Force("B", (SHORT, 0.0))]), Q)
    assert raised.value.kind == "table_ends"
    assert (raised.value.design, raised.value.q) == ((1,), 0.0)
    assert raised.value.value == pytest.approx(0.451)


def test_a_motor_over_the_coordinate_is_named() -> None:
    motor = assur.ConstantTorque(Table([0.0, 1.0], [1.0, 2.0], periodic=False))
    own = Machine(slider(), BODIES, motor=motor)
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
