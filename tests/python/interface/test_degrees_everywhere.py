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
    "Machine.dynamics": lambda **at: MACHINE.dynamics(**at, speed=2.0).bias,
    "Machine.acceleration": lambda **at: MACHINE.acceleration(**at, speed=2.0, effort=1.0),
    "adapters.scipy.Residuals": lambda **at: (
        missed := assur.adapters.scipy.Residuals(FOUR_BAR, {"rocker": np.ones(3)}, **at)
    ).fun(missed.x0),
    "Machine.d_acceleration": lambda **at: MACHINE.d_acceleration(**at, speed=2.0, effort=1.0),
    "Machine.d_effort": lambda **at: MACHINE.d_effort(**at, speed=2.0),
    "Machine.linearize": lambda **at: MACHINE.linearize(**at, speed=2.0, effort=1.0).A,
    "Machine.effort": lambda **at: MACHINE.effort(**at, speed=2.0),
    "Machine.duty": lambda **at: MACHINE.duty(**at, speed=2.0).effort,
    "Machine.internal_loads": lambda **at: (
        MACHINE.internal_loads("rocker", **at).peak("moment").value
    ),
    "Machine.reduced_inertia": lambda **at: MACHINE.reduced_inertia(**at).value,
    "Machine.reduced_moment": MACHINE.reduced_moment,
    "Machine.potential": MACHINE.potential,
    "pareto": lambda **at: (
        assur.pareto(
            FOUR_BAR,
            maximize={"angle": assur.metric.min_transmission_angle("C"), **SWING},
            bounds={"rocker.length": (2.3, 2.7)},
            population=4,
            generations=2,
            **at,
        ).designs.values
    ),
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
    in_place = {"q": "deg", "q0": "deg0", "q_end": "deg_end"}
    without = {
        name
        for name, signature in callables().items()
        for q, deg in in_place.items()
        if q in signature.parameters and deg not in signature.parameters
    }
    # What holds coordinates beside values, as a record or a table does, or goes on from them.
    records = {
        "DeadPoint", "DesignFit", "Fit", "LinkageFit", "Machine.step", "Mechanism.defects",
        "SingularLocus", "Table",
        "balance.fit", "balance.harmonics", "balance.rotating_parts", "events.Position",
        "flywheel.Extreme", "slider_crank.Extreme",
    }  # fmt: skip
    assert without == records


def test_the_start_and_the_end_of_a_run() -> None:
    spun = assur.Machine(FOUR_BAR, bodies={"rocker": ROD, "crank": assur.Body(inertia=9.0)})
    one = spun.run(deg0=30.0, speed0=4.0, deg_end=200.0)
    two = spun.run(q0=30.0 * (np.pi / 180.0), speed0=4.0, q_end=200.0 * (np.pi / 180.0))
    np.testing.assert_array_equal(one.t, two.t)
    np.testing.assert_array_equal(one.at(deg=[40.0, 50.0]), two.at(q=np.radians([40.0, 50.0])))
    with pytest.raises(assur.InputError, match=r"run\(\): both q0 and deg0 are given"):
        spun.run(1.0, 0.0, deg0=30.0)
    with pytest.raises(assur.InputError, match=r"both q_end and deg_end are given"):
        spun.run(q_end=1.0, deg_end=30.0, speed0=1.0)
    many = spun.run(deg0=[30.0, 40.0], speed0=4.0, deg_end=200.0)
    np.testing.assert_array_equal(many[0].t, one.t)
    np.testing.assert_array_equal(many.at(deg=50.0)[1][0], one.at(deg=50.0).q)
    steady = spun.steady_state(10.0, deg0=30.0)
    np.testing.assert_array_equal(steady.q, spun.steady_state(10.0, q0=np.pi / 6).q)
    np.testing.assert_array_equal(steady.at(deg=40.0), steady.at(40.0 * (np.pi / 180.0)))


def test_laws_in_degrees() -> None:
    t = np.linspace(0.0, 0.5, 7)
    one = FOUR_BAR.follow(deg=assur.laws.Cycloidal(10.0, 100.0, duration=0.5), t=t).joint("C")
    law = assur.laws.Cycloidal(np.radians(10.0), np.radians(100.0), duration=0.5)
    two = FOUR_BAR.follow(law, t).joint("C")
    for own, other in (
        (one.value, two.value),
        (one.velocity(), two.velocity()),
        (one.acceleration(), two.acceleration()),
        (one.jerk(), two.jerk()),
    ):
        np.testing.assert_allclose(own, other, rtol=1e-11, atol=1e-11 * np.abs(other).max())
    with pytest.raises(assur.InputError, match=r"follow\(\): both laws and deg are given"):
        FOUR_BAR.follow(law, t, deg=law)
    with pytest.raises(assur.InputError, match=r"follow\(\): neither laws nor deg is given"):
        FOUR_BAR.follow(t=t)
    with pytest.raises(assur.InputError, match=r"follow\(\): t is not given"):
        FOUR_BAR.follow(law)
    lift = assur.SliderCrank(1.0, 3.0).with_driver("bore", q=3.0)
    with pytest.raises(assur.InputError, match="driver 'bore' is a slide"):
        lift.follow(deg=assur.laws.Uniform(2.5, 3.5, duration=1.0), t=t)


def test_an_angle_to_find() -> None:
    assert FOUR_BAR.find("rocker", deg=100.0) == FOUR_BAR.find("rocker", 100.0 * (np.pi / 180.0))
    with pytest.raises(assur.InputError, match="deg is for the angle of a link"):
        FOUR_BAR.find("C.x", deg=100.0)
    with pytest.raises(assur.InputError, match="both value and deg"):
        FOUR_BAR.find("rocker", 1.0, deg=100.0)
    with pytest.raises(assur.InputError, match="deg"):
        FOUR_BAR.find("rocker", deg=np.nan)
    with pytest.raises(assur.InputError, match="neither value nor deg"):
        FOUR_BAR.find("rocker")


def test_a_flywheel() -> None:
    phi = np.linspace(0.0, 2.0 * np.pi, 25)
    wheel = assur.flywheel.evaluate(phi, 10.0 * np.sin(phi), np.full(25, 2.0), speed0=10.0)
    for curve in (
        wheel.speed, wheel.time, wheel.work, wheel.reduced_moment, wheel.reduced_inertia,
    ):  # fmt: skip
        np.testing.assert_array_equal(curve(deg=DEGREES), curve(DEGREES * (np.pi / 180.0)))


def test_an_impact_and_a_map() -> None:
    stop = assur.Torque("rocker", -1.0)
    at = 75.0 * (np.pi / 180.0)
    hit = MACHINE.impact(stop, deg=75.0, speed=5.0)
    assert hit.speed == MACHINE.impact(stop, at, speed=5.0).speed
    over = {"rocker.length": [2.4, 2.6], "ground.D.x": [3.1, 3.3]}
    counts = FOUR_BAR.map("assemblies", over, deg=75.0).values
    np.testing.assert_array_equal(counts, FOUR_BAR.map("assemblies", over, q=at).values)
