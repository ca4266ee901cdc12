"""Every call that takes coordinates takes them in degrees, too."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import matplotlib.pyplot as plt
import numpy as np
import pytest

import assur
from interface.public_interface import callables

if TYPE_CHECKING:
    from collections.abc import Callable

FOUR_BAR = assur.FourBar(1.0, 3.0, 2.5, 3.2)
# As its line has it: inside a link loads go along the line.
ROD = assur.Body(mass=1.0, inertia=2.5**2 / 12, at=(1.25, 0.0))
MACHINE = assur.Machine(FOUR_BAR, bodies={"rocker": ROD}, loads=[assur.Gravity((0.0, -9.81))])
TABLE = assur.Machine.from_table(np.linspace(0.0, 2.0 * np.pi, 9), np.ones(9), 1.0)
DEGREES = np.array([30.0, 75.0, 200.0])
SWING = {"swing": assur.metric.span("rocker")}
CALLS: dict[str, Callable[..., Any]] = {
    "Mechanism.solve": lambda **at: FOUR_BAR.solve(**at).joint("C").value,
    "Machine.reactions": lambda **at: MACHINE.reactions(**at, speed=2.0).driver,
    "Machine.effort": lambda **at: MACHINE.effort(**at, speed=2.0),
    "Machine.duty": lambda **at: MACHINE.duty(**at, speed=2.0).effort,
    "Machine.internal_loads": lambda **at: (
        MACHINE.internal_loads("rocker", **at).peak("moment").value
    ),
    "Machine.reduced_inertia": lambda **at: MACHINE.reduced_inertia(**at).value,
    "Machine.reduced_moment": MACHINE.reduced_moment,
    "Machine.potential": MACHINE.potential,
    "sweep": lambda **at: assur.sweep(FOUR_BAR, {}, **at, metrics=SWING)["swing"],
}
ONE: dict[str, Callable[..., Any]] = {
    "Mechanism.assemblies": lambda **at: [a.q for a in FOUR_BAR.assemblies(**at)],
    "Mechanism.with_driver": lambda **at: FOUR_BAR.with_driver("rocker", **at).q0,
}


@pytest.mark.parametrize("name", [*CALLS, *ONE])
def test_degrees_are_radians(name: str) -> None:
    call, at = (CALLS[name], DEGREES) if name in CALLS else (ONE[name], np.array(75.0))
    np.testing.assert_array_equal(call(deg=at), call(q=at * (np.pi / 180.0)))
    for wrong in ({"q": at, "deg": at}, {} if name != "Mechanism.with_driver" else None):
        if wrong is not None:
            with pytest.raises(assur.InputError, match=r"\(\): (both|neither) q (and|nor) deg"):
                call(**wrong)


def test_a_slide_has_no_degrees() -> None:
    press = FOUR_BAR.with_driver("rocker")
    lift = assur.SliderCrank(1.0, 3.0).with_driver("bore", q=1.0)
    assert press.solve(deg=100.0).q == pytest.approx(np.radians(100.0))
    with pytest.raises(assur.InputError, match="driver 'bore' is a slide"):
        assur.sweep(lift, {}, deg=[1.0, 2.0])
    with pytest.raises(assur.InputError, match="driver 'bore' is a slide"):
        lift.assemblies(deg=1.0)


def test_a_table_is_of_a_crank() -> None:
    assert TABLE.reduced_moment(deg=30.0) == TABLE.reduced_moment(np.pi / 6)


def test_a_picture() -> None:
    one, two = FOUR_BAR.plot(deg=40.0), FOUR_BAR.plot(q=40.0 * np.pi / 180.0)
    for first, second in zip(one.lines, two.lines, strict=True):
        np.testing.assert_array_equal(first.get_xydata(), second.get_xydata())
    plt.close("all")


def test_calls_with_coordinates_take_degrees() -> None:
    without = {
        name
        for name, signature in callables().items()
        if "q" in signature.parameters
        and "deg" not in signature.parameters
        and name.partition(".")[0] in ("Mechanism", "Machine", "sweep")
    }
    # A place of defects is checked against joints; an impact is at one position.
    assert without == {"Machine.impact", "Mechanism.defects", "Mechanism.map"}
