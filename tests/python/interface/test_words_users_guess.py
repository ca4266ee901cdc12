"""What new users typed first: each says what there is, or does what they meant."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import assur
from assur import metric

PRESS = assur.SliderCrank(0.1, 0.4)
MACHINE: Any = assur.Machine(PRESS, bodies={"piston": assur.Body(mass=2.0)})
FOUR_BAR: Any = assur.FourBar(1.0, 3.0, 2.5, 3.2)
MADE: Any = {
    "tilt": (assur.FourBar, (1.0, 3.0, 2.5, 3.2), "FourBar", "ground_angle"),
    "coupler_point": (assur.FourBar, (1.0, 3.0, 2.5, 3.2), "FourBar", "point"),
    "eccentricity": (assur.SliderCrank, (0.1, 0.4), "SliderCrank", "offset"),
    "masses": (assur.Machine, (PRESS,), "Machine", "bodies"),
    "omega": (MACHINE.effort, (1.0,), "effort", "speed"),
    "alpha": (MACHINE.reactions, (1.0,), "reactions", "acceleration"),
}


@pytest.mark.parametrize("old", MADE)
def test_a_keyword_of_another_name(old: str) -> None:
    call, given, name, new = MADE[old]
    with pytest.raises(TypeError, match=rf"^{name}\(\) has no argument '{old}': it is {new}=$"):
        call(*given, **{old: 1.0})


@pytest.mark.parametrize(
    "pin",
    [
        lambda found: found.joint("A"),
        lambda found: found.bearing("A"),
        lambda found: found.joint_moment("A"),
    ],
)
def test_a_force_without_its_link(pin: Any) -> None:
    with pytest.raises(assur.InputError, match=r'joint "A" is one of crank, rod: .*on="rod"'):
        pin(MACHINE.reactions([0.5, 1.0]))


def test_slip_is_a_fraction() -> None:
    with pytest.raises(assur.InputError, match=r"slip is 15: a fraction .* 0\.15"):
        assur.InductionMotor(60.0, 15.0, 157.0)
    assert assur.InductionMotor(60.0, 1.0, 157.0).slip == 1.0


def test_what_is_1_or_0_is_a_condition() -> None:
    q, grounds = np.radians(np.arange(15, 360, 30)), {"ground.D.x": [2.9, 3.003, 9.0]}
    four_bar, asked = assur.FourBar(1.0, 2.0, 2.0, 3.0), {"swing": metric.span("rocker")}
    for condition, kept in ((metric.full_rotation(), [0]), (metric.reachable(), [0, 1])):
        found = assur.sweep(four_bar, grounds, q, metrics=asked, where=[condition])
        assert found.kept.tolist() == kept
    flag: Any = metric.full_rotation()
    wrong: Any
    for wrong, message in (
        ([metric.span("rocker")], "is not a condition"),
        ([flag == 1], "False is not a condition.*not by =="),
        (flag, r"a list of conditions is needed, where=\[full_rotation\(\)\]"),
    ):
        with pytest.raises(assur.InputError, match=message):
            assur.sweep(four_bar, grounds, q, metrics=asked, where=wrong)


def test_a_table_says_of_which_coordinate_a_load_goes_one_way() -> None:
    """Without `over=` the direction was that of the crank, which always goes forward."""
    table = assur.Table([0.3, 0.5], [-900.0, -900.0], spline="linear", over="bore", periodic=False)
    one, two = (
        assur.Force("B", (table, 0.0), while_="forward", **over) for over in ({}, {"over": "bore"})
    )
    assert one == two
    assert assur.Force("B", (1.0, 0.0), while_="forward").over is None
    array: Any = np.array([1.0, 0.0])
    assert assur.Force("B", array, while_="forward").over is None
    turning = assur.Table([0.0, 1.0], [1.0, 2.0], over="rod", periodic=False)
    with pytest.raises(assur.InputError, match="tables are over 'bore' and 'rod': say which"):
        assur.Force("B", (table, turning), while_="forward")
    assert assur.Force("B", (table, turning), while_="forward", over="rod").over == "rod"
    assert assur.Torque("crank", table, while_="backward").over == "bore"
    assert assur.Torque("crank", table, while_="backward", over="rod").over == "rod"


@pytest.mark.parametrize(
    "call",
    [
        lambda: FOUR_BAR.assemblies(60),
        lambda: FOUR_BAR.follow(assur.laws.Polynomial345(0, 60, 0.5), [0.1]),
        lambda: FOUR_BAR.follow(
            assur.laws.Sequence(
                (
                    assur.laws.Uniform(0.0, 45.0, 1.0),
                    assur.laws.Harmonic(45.0, 90.0, 1.0, begin=1.0),
                )
            ),
            [0.1],
        ),
    ],
)
def test_degrees_are_asked_about(call: Any) -> None:
    with pytest.warns(assur.AssurWarning, match=r"turns; for degrees: deg="):
        call()


def test_a_bearing_is_printed_in_a_few_lines() -> None:
    found = MACHINE.reactions(np.linspace(0.0, 6.0, 500), 3.0).bearing("A", on="crank")
    assert len(repr(found)) < 400


def test_ground_angles_in_degrees_are_asked_about() -> None:
    with pytest.warns(assur.errors.AssurWarning, match="ground_angle is 20 rad: is it in degrees"):
        assur.FourBar(1.0, 3.0, 2.5, 3.2, ground_angle=20)


def test_a_link_that_only_slides_is_named_by_its_slide() -> None:
    assert repr(PRESS.extremes("piston")) == "<assur.Extremes 0 everywhere; it slides along 'bore'>"
    with pytest.raises(assur.InputError, match="does not turn: it gives its force along 'bore'"):
        PRESS.solve([0.5, 1.0]).mechanical_advantage("piston")


def test_names_of_dimensions_are_those_of_the_link() -> None:
    with pytest.raises(assur.InputError, match=r'no dimension "ground.length"; .*"ground\.D\.x"'):
        FOUR_BAR.with_dimensions({"ground.length": 3.0})


def test_sampled_forces_of_loads_that_jump_are_announced() -> None:
    """A press of 200 kN over 6 mm: between 70 positions a fifth of the peak is missed."""
    cut = assur.Table(
        [0.24, 0.394, 0.394, 0.4],
        [0.0, 0.0, -2e5, -2e5],
        spline="linear",
        over="bore",
        periodic=False,
    )
    crank = assur.SliderCrank(0.08, 0.32)
    jumps = assur.Force("B", (cut, 0.0), while_="forward", on="piston")
    steady = assur.Force("B", (-2e5, 0.0), on="piston")
    q, asked = np.linspace(0.0, 2 * np.pi, 70, endpoint=False), {"T": metric.peak_effort(speed=1.0)}
    rods = {"rod.length": [0.32, 0.32]}
    with pytest.warns(assur.errors.AssurWarning, match=r"peak_effort\(\) is over the positions"):
        few = assur.sweep(assur.Machine(crank, loads=[jumps]), rods, q, metrics=asked)["T"][0]
    assert few < 0.8 * assur.Machine(crank, loads=[jumps]).duty(q, speed=1.0).max.value
    # Without jumps nothing is said: warnings are errors here.
    assur.sweep(assur.Machine(crank, loads=[steady]), rods, q, metrics=asked)


def test_an_index_of_a_position_is_asked_for_and_checked() -> None:
    pytest.importorskip("matplotlib")
    with pytest.raises(
        assur.InputError, match=r"at \(\): one index into the shape \(2,\) is needed: at=0"
    ):
        PRESS.solve([0.5, 1.0]).polygon("velocity")
    # It was ignored where there is one position alone.
    with pytest.raises(assur.InputError, match=r"at 30: one index into the shape \(\)"):
        PRESS.solve(deg=30).polygon("velocity", at=30)


def test_examples_have_similar_names() -> None:
    with pytest.raises(AttributeError, match="did you mean watt_"):
        _ = assur.examples.watt  # type: ignore[attr-defined]
