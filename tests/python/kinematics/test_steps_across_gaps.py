"""Angles of random designs step across every gap by at most half a turn."""

from __future__ import annotations

import os

import numpy as np
import pytest

import assur
import bits
import design_spaces
import gap_steps
import partial_requests

# Random mechanisms of every kind, each with a space of designs: 10, or 1000 in a campaign.
COUNT = 1000 if os.environ.get("HYPOTHESIS_PROFILE") == "slow" else 10
PARTS = 10


def ways(m: assur.Mechanism) -> list[gap_steps.Array]:
    """A turn to either side of the drawing, or a slide's way down and up."""
    if isinstance(m.driver, str) and m.driver in m.slides:
        return [m.q0 + np.linspace(0.0, end, 2001) for end in (-3.0, 3.0)]
    return [m.q0 + np.linspace(-2 * np.pi, 2 * np.pi, 2881)]


@pytest.mark.parametrize("part", range(PARTS))
def test_the_shorter_way(part: int) -> None:
    for seed in range(part, COUNT, PARTS):
        for name, batch, _ in partial_requests.cases(seed):
            if np.ndim(batch.q0):
                continue  # every position has a way of its own
            for i in range(partial_requests.DESIGNS):
                design = batch.design(i)
                found = [text for q in ways(design) for text in gap_steps.far(design, q)]
                assert not found, f"{name}, design {i}: {found}"


def test_an_island_within_a_cell() -> None:
    """Found once: between two gaps of very different depth it was not looked for."""
    rng = np.random.default_rng(280)
    drawn = bits.random(280)
    for count in (200, 100):
        rng.uniform(-2, 8, count)
    for _ in range(2):
        rng.uniform(1, 16, 20)
    design = design_spaces.space(drawn, rng, 12).design(4)
    q = design.q0 + np.linspace(0.0, 2 * np.pi, 4001)
    assert len(gap_steps.gaps(design, q)) == 4
    assert not list(gap_steps.far(design, q))


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("turned", [0.0, np.pi])
def test_half_a_turn_is_clockwise(side: float, turned: float) -> None:
    """A cylinder goes through length 0, and points the other way."""
    angle = float(np.arctan2(side, -1.0)) + turned
    m = assur.Mechanism(
        joints={"A": (0, 0), "B": (2, 0), "C": (1, side)},
        links={"ground": ["A", "B"], "boom": ["A", "C"], "barrel": ["B"], "rod": ["C"]},
        driver="drive",
        slides={"drive": assur.Slide("rod", "barrel", angle, "B")},
    )
    assert isinstance(m.q0, float)
    (gap,) = gap_steps.gaps(m, np.linspace(m.q0, -m.q0, 4001))
    step = gap.steps[list(m.links).index("barrel")]
    assert step == pytest.approx(-np.pi, abs=1e-7)
