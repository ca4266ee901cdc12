"""Guides at angles that are known to rounding only."""

from __future__ import annotations

import math

import numpy as np
import pytest

import assur


@pytest.mark.parametrize("degrees", [90, 180, 270, 45, 30, -90, 450])
def test_a_block_falls_along_its_guide(degrees: float) -> None:
    """cos(π/2) is 6e-17, so the block lay beside the guide, and that was the mechanism's size."""
    angle = math.radians(degrees)
    along = np.array([math.cos(angle), math.sin(angle)])
    one = assur.Mechanism(
        joints={"O": (0, 0), "B": tuple(2.0 * along)},
        links={"ground": "O", "block": "B"},
        slides={"way": assur.Slide("block", "ground", angle=angle, origin="O")},
        driver="way",
    )
    assert one.dimensions["way.offset"] == 0.0
    pull = assur.Force("B", tuple(-30.0 * along))
    run = assur.Machine(one, bodies={"block": assur.Body(mass=3.0)}, loads=[pull]).run(
        t_end=0.5, q0=2.0
    )
    assert run.statistics.steps < 30
    np.testing.assert_allclose(run.at(0.5).q, 2.0 - 0.5 * 10.0 * 0.25, rtol=1e-10)


def test_an_offset_that_is_drawn_stays() -> None:
    one = assur.Mechanism(
        joints={"O": (0, 0), "B": (1e-9, 2.0)},
        links={"ground": "O", "block": "B"},
        slides={"way": assur.Slide("block", "ground", angle=math.pi / 2, origin="O")},
        driver="way",
    )
    assert one.dimensions["way.offset"] == pytest.approx(-1e-9, rel=1e-6)
