"""Angles of random designs step across every gap by at most half a turn."""

from __future__ import annotations

import numpy as np
import pytest

import assur
from campaigns import campaign_cases
from models.mechanisms.mechanism_data import arguments
from net import bits, design_spaces, partial_requests
from oracles.kinematics import gap_steps
from support.samples import sample

# Random mechanisms of every kind, each with a space of designs: 10, or 1000 in a campaign.
COUNT = sample(10, 1000)
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


@pytest.mark.parametrize("part", range(PARTS))
def test_beside_the_drawing(part: int) -> None:
    """One rounding beside the drawing's coordinate, where a turn ends, no angle is a turn away."""
    for seed in range(part, 3 * COUNT, PARTS):
        batch = design_spaces.crank_space(seed, partial_requests.DESIGNS)
        (q0,) = np.unique(batch.q0)
        q = np.nextafter(q0, [-np.inf, q0, np.inf])
        motion = batch.solve(q, order=0, outputs=list(batch.links), on_error="nan")
        for name in batch.links:
            apart = np.ptp(motion.link(name).value, axis=1)
            assert not np.any(apart > 1.0), (seed, name)


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


def test_an_island_beside_a_dead_point_that_cannot_be_reached() -> None:
    """A later dyad, open at both knots, closes between them, where an earlier one has its end."""
    design = assur.Mechanism(**arguments(campaign_cases.MAKE["random"](17462).description))
    assert not list(gap_steps.far(design, way(design, 2 * np.pi)))


def test_a_gap_within_a_cell() -> None:
    """An earlier dyad opens and closes again between two knots, and cuts an island off."""
    batches = (batch for name, batch, _ in partial_requests.cases(678) if "changing" in name)
    design = next(batches).design(2)
    assert not list(gap_steps.far(design, way(design, 2 * np.pi)))


@pytest.mark.parametrize(
    ("kind", "seed", "link", "gap"),
    [
        ("changing", 865, "L7", -0.34),  # different dyads do not close on both sides of an island
        ("changing", 5496, "L6", -1.2783),
        ("random", 11789, "L7", 0.831),  # stretched before an island, folded behind it
        ("random", 10395, "L5", 1.579),
        ("random", 12255, "L6", -1.53),
        ("random", 13786, "L6", 0.84),
    ],
)
def test_islands_of_the_knot_by_knot_tracer(kind: str, seed: int, link: str, gap: float) -> None:
    """The campaign of class II found them missed, up to 4° wide: angles beyond were a turn off."""
    m = assur.Mechanism(**arguments(campaign_cases.MAKE[kind](seed).description))
    step_is_nearest(m, link, gap)


def test_an_island_behind_a_point_that_is_far_away() -> None:
    m = assur.Mechanism(**arguments(campaign_cases.MAKE["changing"](3765).description))
    step_is_nearest(m.with_assembly(assur.Assembly({"J3": -1, "J6": 1})), "L6", 2.74)


def step_is_nearest(m: assur.Mechanism, link: str, gap: float) -> None:
    q = np.linspace(gap - 1.3, gap + 1.3, 26001)
    across = [g for g in gap_steps.gaps(m, q) if g.before < gap < g.behind]
    assert len(across) == 1
    assert gap_steps.is_nearest(across[0].steps)[list(m.links).index(link)]


def way(m: assur.Mechanism, reach: float) -> gap_steps.Array:
    """Many positions from the drawing upward."""
    return np.asarray(m.q0 + np.linspace(0.0, reach, 20_001))


@pytest.mark.parametrize("seed", [2804, 4648, 5468, 18681, 40091, 49999, 76381])
def test_islands_of_knots_in_lanes(seed: int) -> None:
    """The campaign of class II found them missed, up to 8° wide: angles beyond were a turn off.

    They lie in a cell after the end of a gap, between stretched and folded, or where the rate of a
    discriminant is unknown.
    """
    m = assur.Mechanism(**arguments(campaign_cases.MAKE["random"](seed).description))
    assert not list(gap_steps.far(m, way(m, 2 * np.pi)))


@pytest.mark.parametrize(
    ("seed", "reach"), [(12710, 6.28), (18695, 0.8), (47622, 6.28), (74077, 6.28)]
)
def test_links_that_turn_round_at_the_edge_of_a_gap(seed: int, reach: float) -> None:
    """The outer joints of a dyad nearly coincide there: within 1e-5 rad it turns by half a turn."""
    m = assur.Mechanism(**arguments(campaign_cases.MAKE["random"](seed).description))
    assert not list(gap_steps.far(m, way(m, reach)))


def test_an_island_of_a_slide_for_any_request() -> None:
    """Knots in lanes depend on the requested positions, the tracer's do not: both must agree."""
    m = assur.Mechanism(**arguments(campaign_cases.MAKE["random"](84809).description))
    island = np.linspace(0.0224, 0.0695, 7)
    alone = m.solve(island, order=0, outputs=list(m.links))
    among = m.solve([-0.3, *island, 0.2], order=0, outputs=list(m.links), on_error="nan")
    for name in m.links:
        assert np.array_equal(alone.link(name).value, among.link(name).value[1:-1]), name


def test_closer_scans_of_a_short_range() -> None:
    """They solve more knots than the range has: once those had signs of another call, and an angle
    near the drawing was a turn off (2.324 + 2π).
    """
    m = assur.Mechanism(**arguments(campaign_cases.MAKE["random"](80129).description))
    q = float(m.q0) + 0.0397799355633266
    near = np.linspace(float(m.q0), q, 200)
    for asked in ([q], [q, q + 0.001], near, [q, q + 0.5]):
        angles = m.solve(asked, order=0, outputs=["L6"], on_error="nan").link("L6").value
        assert abs(angles[-1 if asked is near else 0] - 2.3240746929381437) < 1e-12


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("turned", [0.0, np.pi])
def test_half_a_turn_is_clockwise(side: float, turned: float) -> None:
    """A cylinder goes through length 0, and points the other way."""
    angle = float(np.arctan2(side, -1.0)) + turned
    m = assur.Mechanism(
        joints={"A": (0, 0), "B": (2, 0), "C": (1, side)},
        links={"ground": ["A", "B"], "boom": ["A", "C"], "barrel": ["B"], "rod": ["C"]},
        driver="drive",
        slides={"drive": assur.Slide("rod", "barrel", angle=angle, origin="B")},
    )
    assert isinstance(m.q0, float)
    (gap,) = gap_steps.gaps(m, np.linspace(m.q0, -m.q0, 4001))
    step = gap.steps[list(m.links).index("barrel")]
    assert step == pytest.approx(-np.pi, abs=1e-7)
