"""The first solution and the safety belong to the path on which all coefficients grow from 0."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

import assur
from assur import Body, Force, JointFriction, Machine, SlideFriction

if TYPE_CHECKING:
    from assur.dynamics.friction import PairFriction


def press(times: float) -> Machine:
    """Pins and a bore with two solutions beyond about 0.5 times these coefficients."""
    bodies = {
        "crank": Body(2.07, 0.0023, (0.176, -0.0066)),
        "rod": Body(0.427, 0.0476, (0.0977, -0.0076)),
        "piston": Body(3.94),
    }
    friction: dict[str, PairFriction] = {
        "A": JointFriction(0.82 * times, 0.034),
        "B": JointFriction(0.97 * times, 0.078),
        "bore": SlideFriction(1.09 * times, 0.0416),
    }
    loads = [Force("B", (-18.0, -12.5), on="piston")]
    return Machine(assur.SliderCrank(0.104, 0.4354, 0.0237), bodies, loads, friction=friction)


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
