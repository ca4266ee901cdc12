"""Points of links without a joint there, against joints in the same place."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np
import pytest

import assur
from assur import examples
from models.errors.refusals import refused

ORDERS = ("value", "d1", "d2", "d3")
# Of lengths of about 1, and of their analogues.
ROUNDING = 1e-13


def test_a_coupler_point_is_a_joint() -> None:
    x, y = np.linspace(1.0, 1.4, 3), 0.7
    m = assur.FourBar(1.0, [2.9, 3.0, 3.1], 2.5, 3.2, point=(x, y))
    motion = m.solve(np.linspace(0.1, 6.0, 7), order=3)
    for i in range(3):
        found, wanted = motion[i].point("coupler", (x[i], y)), motion[i].joint("P")
        for order in ORDERS:
            np.testing.assert_allclose(
                getattr(found, order), getattr(wanted, order), rtol=0.0, atol=ROUNDING
            )
    several = motion.point("coupler", [(0.0, 0.0), (0.3, 0.1)])
    assert several.value.shape == (2, 3, 7, 2)
    np.testing.assert_allclose(several.value[0], motion.joint("B").value, atol=ROUNDING)
    plain = assur.FourBar(1.0, 3.0, 2.5, 3.2, mode="crossed").solve(1.0)
    with_point = assur.FourBar(1.0, 3.0, 2.5, 3.2, mode="crossed", point=(1.2, 0.7)).solve(1.0)
    np.testing.assert_array_equal(with_point["C"], plain["C"])


def test_with_two_drivers() -> None:
    at = {"A": (0, 0), "B": (0, 1), "P": (0.7, 1.2), "D": (1.4, 0.6), "E": (1, 0), "X": (0.9, 1.5)}
    links = {"ground": "AE", "left": "AB", "rod": "BPX", "arm": "DP", "right": "ED"}
    m = assur.Mechanism(at, links, ("left", "right"))
    motion = m.solve(m.q0 + np.linspace(0.0, 0.2, 4)[:, None], order=3)
    local = (m.dimensions["rod.X.x"], m.dimensions["rod.X.y"])
    for order in ORDERS:
        found = getattr(motion.point("rod", local), order)
        wanted = getattr(motion.joint("X"), order)
        np.testing.assert_allclose(found, wanted, rtol=0.0, atol=10 * ROUNDING)


def test_of_a_sliding_link_and_of_the_ground() -> None:
    motion = assur.SliderCrank(0.05, 0.2).solve([0.3, 1.0])
    ahead = motion.point("piston", (0.02, 0.0))
    np.testing.assert_array_equal(ahead.value[:, 0], motion.joint("B").value[:, 0] + 0.02)
    np.testing.assert_array_equal(motion.point("ground", (0.3, 0.1)).value, [(0.3, 0.1)] * 2)
    np.testing.assert_array_equal(motion.point("ground", (0.3, 0.1)).d1, 0.0)
    # The whole library: the first two joints of a link, by its frame.
    m = examples.jansen_leg()
    leg = m.solve(m.q0)
    for link, joints in m.links.items():
        if link != "ground" and len(joints) > 1:
            at = [(0.0, 0.0), (m.dimensions[f"{link}.length"], 0.0)]
            np.testing.assert_allclose(leg.point(link, at), leg.joint(joints[:2]), atol=ROUNDING)


def test_refusals() -> None:
    motion = assur.SliderCrank(0.05, 0.2).solve(0.3)
    refused(assur.InputError, "local", partial(motion.point, "rod", 0.3))
    refused(assur.InputError, "local", partial(motion.point, "rod", (0.3, np.nan)))
    refused(assur.InputError, "rood", partial(motion.point, "rood", (0.3, 0.1)))
    number: Any = 1.0
    refused(assur.InputError, "point", partial(assur.FourBar, 1.0, 3.0, 2.5, 3.2, point=number))


@pytest.mark.parametrize("ground", ["AD", "DA"])
def test_points_of_the_ground_are_those_of_the_drawing(ground: str) -> None:
    mechanism = assur.Mechanism(
        joints={"A": (1, 2), "B": (2, 2), "C": (4, 4), "D": (5, 2)},
        links={"ground": ground, "crank": "AB", "coupler": "BC", "rocker": "DC"},
        driver="crank",
    )
    point = mechanism.solve([0.1, 0.2]).point("ground", (0.5, 0.25))
    np.testing.assert_array_equal(point.value, [(0.5, 0.25)] * 2)
    np.testing.assert_array_equal(point.d2, 0.0)
