"""Machines doubt degrees, splines that leave their rows, and coordinates that never change."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur

if TYPE_CHECKING:
    from collections.abc import Callable

TURN = math.tau


def press(*loads: Any) -> assur.Machine:
    return assur.Machine(
        assur.SliderCrank(0.1, 0.4), bodies={"piston": assur.Body(mass=20.0)}, loads=loads
    )


CALLS: dict[str, Callable[[Any], Any]] = {
    "reactions": lambda q: press().reactions(q, 6.0),
    "effort": lambda q: press().effort(q, 6.0),
    "reduced_moment": lambda q: press().reduced_moment(q),
    "reduced_inertia": lambda q: press().reduced_inertia(q),
    "run": lambda q: press().run(0.1, q0=q[1], speed0=1.0),
    "find": lambda q: assur.FourBar(1.0, 3.0, 2.5, 3.0).find("rocker", q[1]),
}


@pytest.mark.parametrize("name", CALLS)
def test_degrees(name: str) -> None:
    with pytest.warns(assur.AssurWarning, match=r"np\.radians") as seen:
        CALLS[name]([0, 90, 180])
    assert seen[0].filename == __file__


def test_a_spline_that_leaves_its_rows() -> None:
    rows = np.radians([0, 330, 350, 360]), [0, -9000, -9000, 0]
    with pytest.warns(assur.AssurWarning, match='between rows of -9000 … 0: spline="pchip"'):
        table = assur.Table(*rows, spline="not-a-knot")
    assert table.at(np.linspace(0.0, TURN, 1000)).max() > 9000.0
    assur.Table(*rows, spline="linear")
    assur.Table(*rows)
    # Enough rows of a smooth curve do not leave their range by far.
    q = np.linspace(0.0, TURN, 13)
    assur.Table(q, np.append(np.sin(q)[:-1], 0.0), spline="not-a-knot")


@pytest.mark.parametrize("q", [[0.0, 5e-324, 1e-323], [0.0, 1.0, 2.0]])
def test_a_spline_beyond_all_numbers_is_not_doubted(q: list[float]) -> None:
    """No warning of NumPy: what reads the curve says that it is not finite."""
    assur.Table(q, [0.0, 1e308, 0.0], spline="not-a-knot")
    assur.Table(q, [0.0, 1e308, 0.0])


def test_a_table_wider_than_all_numbers() -> None:
    for spline in ("linear", "natural"):
        with pytest.raises(assur.InputError, match="from -1e\\+308 to 1e\\+308 is wider"):
            assur.Table([-1e308, 0.0, 1e308], [0.0, 1.0, 0.0], spline=spline)


@pytest.mark.parametrize("size", [1e-9, 1.0, 1e14])
def test_links_of_any_size_turn(size: float) -> None:
    """A cylinder's rocker: beside the drawing by parts of its size, not by millimetres."""
    m = assur.Mechanism(
        {"A": (0, 0), "B": (1.1 * size, 0.9 * size), "R": (0.9 * size, 0)},
        {"ground": "AR", "arm": "AB"},
        "ram",
        slides={"ram": assur.Cylinder("R", "B")},
    )
    assur.Machine(m, loads=[assur.Torque("arm", 1.0, while_="forward", over="arm")])


@pytest.mark.parametrize(
    "load",
    [
        assur.Force("B", (9.0, 0.0), while_="forward", over="piston"),
        assur.Torque("rod", assur.Table([-9.0, 9.0], [1.0, 1.0], over="piston")),
    ],
)
def test_a_link_that_never_turns(load: Any) -> None:
    with pytest.raises(assur.InputError, match='does not turn: its travel is the slide "bore"'):
        press(load)
    press(assur.Torque("rod", 1.0, while_="forward", over="rod"))


def test_the_flywheel_of_four_strokes() -> None:
    """The same as from the table over two turns, which one turn does not fit."""
    q = np.linspace(0.0, 2.0 * TURN, 25)
    gas = assur.Table(q, np.append(np.sin(q / 2.0)[:-1] ** 2 * 900.0, 0.0), spline="linear")
    machine = press(assur.Force("B", (gas, 0.0)))
    with pytest.raises(assur.InputError, match="pass turns="):
        machine.flywheel(0.05, mean_speed=20.0)
    own = machine.flywheel(0.05, mean_speed=20.0, turns=2)
    at = np.linspace(0.0, 2.0 * TURN, 24 * 200 + 1)
    moment, inertia = machine.reduced_moment(at, 20.0), machine.reduced_inertia(at).value
    moment[-1], inertia[-1] = moment[0], inertia[0]
    table = assur.flywheel.from_table(
        at, moment, inertia, fluctuation=0.05, mean_speed=20.0, spline="linear"
    )
    assert own.inertia == pytest.approx(table.inertia, rel=1e-4)
    assert own.delta == pytest.approx(0.05, rel=1e-12)


def test_degrees_come_back_as_they_were_typed() -> None:
    degrees = np.array([0.0, 30.0, 60.0, 90.5, 240.0, 359.99])
    motion = assur.SliderCrank(0.1, 0.4).solve(deg=degrees)
    assert motion.to_dataframe(degrees=True)["q"].tolist() == degrees.tolist()


def test_periods_far_too_short_are_refused() -> None:
    """They would be searched for minutes."""
    short = 1e-10
    rows = [0.0, short / 2, short / 2, short], [0.0, 1.0, 2.0, 0.0]
    with pytest.raises(assur.InputError, match="over 'bore' has a period of 1e-10"):
        press(
            assur.Force("B", (assur.Table(*rows, spline="linear", periodic=True, over="bore"), 0.0))
        )
    machine = press(assur.Torque("crank", assur.Table(*rows, spline="linear")))
    with pytest.raises(assur.InputError, match="too many jumps"):
        machine.duty(np.linspace(0.0, 6.0, 50), 3.0)
