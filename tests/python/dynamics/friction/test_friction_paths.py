"""The first solution and the safety belong to the path on which all coefficients grow from 0."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur import Body, Force, JointFriction, Machine, SlideFriction

if TYPE_CHECKING:
    from assur.dynamics.loads.friction import PairFriction


def press(times: float) -> Machine:
    """Pins and a bore with two solutions beyond about 0.5 times these coefficients."""
    bodies = {
        "crank": Body(mass=2.07, inertia=0.0023, at=(0.176, -0.0066)),
        "rod": Body(mass=0.427, inertia=0.0476, at=(0.0977, -0.0076)),
        "piston": Body(mass=3.94),
    }
    friction: dict[str, PairFriction] = {
        "A": JointFriction(0.82 * times, 0.034),
        "B": JointFriction(0.97 * times, 0.078),
        "bore": SlideFriction(1.09 * times, 0.0416),
    }
    loads = [Force("B", (-18.0, -12.5), on="piston")]
    return Machine(
        assur.SliderCrank(0.104, 0.4354, 0.0237), bodies=bodies, loads=loads, friction=friction
    )


def test_the_first_solution_goes_on_from_smaller_coefficients() -> None:
    """From step to step it changes less than it is apart from the other solution."""
    before: float | None = None
    for times in np.linspace(0.02, 1.4, 70).tolist():
        reactions = press(times).reactions(-1.87, -2.8, 18.6)
        drives = [float(one.driver) for one in reactions.solutions]
        assert reactions.driver == drives[0]
        if before is not None:
            assert abs(drives[0] - before) < 0.15
            assert all(abs(drives[0] - before) < abs(other - before) for other in drives[1:])
        before = drives[0]
    # By a continuation in steps of 1e-3 of Newton and Euler's equations.
    assert before == pytest.approx(1.4053090813588374, rel=1e-9)


@pytest.mark.parametrize("times", [1.0, 29.03, 31.93, 32.22, 32.29, 36.0, 42.0])
def test_safety_is_where_the_path_ends_whatever_it_begins_with(times: float) -> None:
    """On the way the law of the bore has a corner, where the path bends and goes on."""
    friction: dict[str, PairFriction] = {
        "A": JointFriction(0.1 * times, 0.01),
        "bore": SlideFriction(0.1 * times, 0.1),
    }
    loads = [Force("B", (-100.0, 20.0), on="piston")]
    machine = Machine(assur.SliderCrank(0.1, 0.3), loads=loads, friction=friction)
    safety = machine.reactions(0.272, -1.0).safety
    assert times * safety == pytest.approx(42.415674, rel=1e-7)


@pytest.mark.parametrize("times", [0.2, 1.0, 3.7, 6.0, 7.5])
def test_the_path_may_turn_back_at_a_corner_where_nothing_is_singular(times: float) -> None:
    """The bore's law comes to its corner, and the determinant jumps from 1.43 to −1.65.

    By the balance of the links, Newton's iteration with 40 digits on each side of the corner: both
    sides are solutions below it, and beyond it neither is. Farther on there is another solution, to
    which a long step would lead.
    """
    friction: dict[str, PairFriction] = {
        "O": JointFriction(0.30677798776251813 * times, 0.025181780134908828),
        "B": JointFriction(0.14469853296185275 * times, 0.026700061042563304),
        "bore": SlideFriction(0.5201112949688464 * times, 0.08768114424336929),
    }
    bodies = {
        "crank": Body(
            mass=3.901445797808873,
            inertia=0.003347392584418952,
            at=(-0.03617870697824903, 0.01590788676987244),
        ),
        "rod": Body(
            mass=3.4882303443817575,
            inertia=0.04491111667190858,
            at=(-0.03007397482214262, -0.01543584513949571),
        ),
        "piston": Body(
            mass=0.4559905865891969,
            inertia=0.022556371274955626,
            at=(-0.018703925477693048, -0.03623695293373248),
        ),
    }
    loads: list[Any] = [
        Force("B", (25.219478021812492, -9.140614440404601)),
        assur.Spring("O", ("rod", (0.05, 0.03)), 130.79936546997112, 0.1574506184688631),
        assur.Damper(("ground", (0.0, 1.9)), ("rod", (0.02, 0.03)), 4.300218600497804),
    ]
    linkage = assur.SliderCrank(0.193768440232073, 0.892424197694784, 0.108020104912621)
    machine = Machine(linkage, bodies=bodies, loads=loads, friction=friction)
    found = machine.reactions(-0.08806302186425219, 10.249475468437039, -49.3137351671353)
    assert times * found.safety == pytest.approx(7.741976812442126, rel=1e-7)
