"""Limits of motion against analytic ones, and against numbers found with forty digits."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import pytest

import assur
from assemblies.test_numbers import six_bar, triad

if TYPE_CHECKING:
    from collections.abc import Sequence

INF = math.inf
# Dead points are promised to this.
DEAD_POINT = 1e-10


def intervals(limits: assur.Limits, wanted: Sequence[Sequence[float]]) -> None:
    assert limits.intervals.shape == (len(wanted), 2), limits
    expected = np.reshape(wanted, (-1, 2))
    np.testing.assert_allclose(limits.intervals, expected, rtol=0.0, atol=DEAD_POINT)


@pytest.mark.parametrize(
    ("lengths", "wanted"),
    [
        ((1, 4, 3, 4.5), [(-INF, INF)]),
        ((3, 2.5, 2, 1), [(-INF, INF)]),
        (
            (3, 1, 2.5, 3.2),
            [(-1.19817029881, -0.484525998168), (0.484525998168, 1.19817029881)],
        ),
        (
            (3, 4, 1, 4.5),
            [(-1.41273154688, -0.722734247813), (0.722734247813, 1.41273154688)],
        ),
        ((3, 2.5, 2, 4), [(-1.37156423955, 1.37156423955)]),
        ((4, 2.5, 3, 2), [(-2.26610827325, 2.26610827325)]),
        ((2, 4, 2.2, 3), [(0.620937577836, math.tau - 0.620937577836)]),
        ((2, 2.5, 4, 3), [(0.460493425059, math.tau - 0.460493425059)]),
        ((1, 1, 1, 5), []),
    ],
)
def test_four_bars_of_every_class(
    lengths: Sequence[float], wanted: Sequence[Sequence[float]]
) -> None:
    crank, coupler, rocker, ground = lengths
    modes: tuple[Literal["open", "crossed"], ...] = ("open", "crossed")
    for mode in modes:
        limits = assur.FourBar(crank, coupler, rocker, ground, mode=mode).limits()
        intervals(limits, wanted)
        turns = wanted == [(-INF, INF)]
        assert limits.full_rotation is turns
        assert limits.period == (1 if turns else None)
        assert {one.group for one in limits.dead_points} <= {"II(coupler, rocker)"}
        assert [one.q for one in limits.dead_points] == sorted(
            q for pair in limits.intervals.tolist() for q in pair if math.isfinite(q)
        )


@pytest.mark.parametrize(
    ("lengths", "wanted"),
    [
        ((1, 3, 0.5), [(-INF, INF)]),
        (
            (2, 1.5, 0.3),
            [
                (-0.643501108793, 1.11976951500),
                (math.pi - 1.11976951500, math.pi + 0.643501108793),
            ],
        ),
        ((1, 1.2, 0.6), [(-0.643501108793, math.pi + 0.643501108793)]),
    ],
)
def test_slider_cranks(lengths: Sequence[float], wanted: Sequence[Sequence[float]]) -> None:
    intervals(assur.SliderCrank(*lengths).limits(), wanted)


def test_random_four_bars_by_cosines() -> None:
    rng = np.random.default_rng(5)
    for a, b, c, d in rng.uniform(0.3, 3.0, (300, 4)):
        outer = (a * a + d * d - (b + c) ** 2) / (2 * a * d)
        inner = (a * a + d * d - (b - c) ** 2) / (2 * a * d)
        limits = assur.FourBar(a, b, c, d).limits()
        if outer > 1 or inner < -1:
            wanted: list[tuple[float, float]] = []
        elif outer <= -1 and inner >= 1:
            wanted = [(-INF, INF)]
        elif inner >= 1:
            wanted = [(-math.acos(outer), math.acos(outer))]
        elif outer <= -1:
            wanted = [(math.acos(inner), math.tau - math.acos(inner))]
        else:
            near, far = math.acos(inner), math.acos(outer)
            wanted = [(-far, -near), (near, far)]
        # Within half a turn of the coordinate that it is drawn at.
        q0 = float(assur.FourBar(a, b, c, d).q0)
        turns = [math.tau * round((q0 - sum(own) / 2.0) / math.tau) for own in wanted
                 if math.isfinite(own[0])]  # fmt: skip
        if turns:
            wanted = sorted(
                (low + turn, high + turn) for (low, high), turn in zip(wanted, turns, strict=True)
            )
        assert limits.intervals.shape == (len(wanted), 2)
        np.testing.assert_allclose(limits.intervals, np.reshape(wanted, (-1, 2)), atol=1e-9)


def test_six_bar_whose_second_dyad_ends_the_motion() -> None:
    limits = six_bar(9.0).limits()
    intervals(limits, [(5.20792005806 - math.tau, 2.98320733986)])
    assert {one.group for one in limits.dead_points} == {"II(bar, rocker2)"}
    assert not limits.full_rotation


def test_kite_closes_after_two_turns() -> None:
    limits = assur.FourBar(1, 2, 2, 1).limits()
    intervals(limits, [(-INF, INF)])
    assert limits.full_rotation
    assert limits.period == 2
    assert not limits.dead_points


def test_triad_that_never_returns() -> None:
    mechanism = assur.Mechanism(
        {
            "O": (1.13, 1.22),
            "A": (0.61, 1.75),
            "P": (1.22, 0.71),
            "Q": (2.79, 0),
            "R": (0.44, 0.5),
            "U": (1.02, 1.24),
            "V": (1.37, 0.28),
        },
        {"ground": "OUV", "crank": "OA", "plate": "PQR", "l1": "AP", "l2": "UQ", "l3": "VR"},
        "crank",
    )
    assert mechanism.q0 == pytest.approx(2.34667096860, abs=1e-11)
    limits = mechanism.limits()
    intervals(limits, [(-0.0302123439018, 13.0705099420)])
    assert limits.period is None
    assert not limits.full_rotation
    assert {one.group for one in limits.dead_points} == {"III(plate, l1, l2, l3)"}


def test_triad_that_closes_after_two_turns() -> None:
    mechanism = assur.Mechanism(
        {
            "O": (2.63, 2.2),
            "A": (0.38, 1.89),
            "P": (2.58, 1.68),
            "Q": (0.24, 1.5),
            "R": (0.55, 0.03),
            "U": (2.1, 2.05),
            "V": (2.27, 0.82),
        },
        {"ground": "OUV", "crank": "OA", "plate": "PQR", "l1": "AP", "l2": "UQ", "l3": "VR"},
        "crank",
    )
    limits = mechanism.limits()
    intervals(limits, [(-INF, INF)])
    assert limits.period == 2
    assert limits.full_rotation


def test_class_iii_of_order_four_that_closes_after_three_turns() -> None:
    mechanism = assur.Mechanism(
        {
            "O": (1.39, 0.21),
            "A": (1.78, 2.34),
            "U": (0, 0),
            "V": (1.79, 0),
            "W": (1.69, -1.2),
            "Q": (2.81, 0),
            "R": (4.24, -1.49),
            "M": (1.06, -1.92),
            "T": (3.14, -2.34),
            "P": (3.38, 0.65),
        },
        {
            "ground": "OUVW",
            "crank": "OA",
            "one": "QRM",
            "other": "MTP",
            "l1": "UQ",
            "l2": "VR",
            "l3": "WT",
            "l4": "AP",
        },
        "crank",
    )
    limits = mechanism.limits()
    assert limits.period == 3
    assert limits.full_rotation


def two_triads(rng: np.random.Generator, in_series: bool) -> assur.Mechanism:
    """Two triads on one crank, or the second on the plate of the first."""
    first = triad()
    moved = {name: tuple(rng.uniform(-1.0, 3.0, 2)) for name in ("P2", "Q2", "R2", "U2", "V2")}
    return assur.Mechanism(
        {**first.joints, **moved},
        {
            **first.links,
            "ground": ["O", "U", "V", "U2", "V2"],
            "plate2": ["P2", "Q2", "R2"],
            "m1": ["R" if in_series else "A", "P2"],
            "m2": ["U2", "Q2"],
            "m3": ["V2", "R2"],
        },
        "crank",
    )


@pytest.mark.parametrize("in_series", [False, True])
def test_the_group_that_folds_is_named(in_series: bool) -> None:
    """Beside a fold the angles of the group that folds turn by far the fastest."""
    rng = np.random.default_rng(11)
    named = set()
    for _ in range(12):
        mechanism = two_triads(rng, in_series)
        own, later = (group for group in mechanism.structure.groups if group.cls > 2)
        limits = mechanism.limits()
        for point in limits.dead_points:
            beside = point.q + 1e-6 * (float(mechanism.q0) - point.q)
            motion = mechanism.solve(beside, order=1)
            rates = [abs(float(motion.link(group.links[0]).d1)) for group in (own, later)]
            # A fold of the first carries the second with it.
            folds = own if rates[0] > 100.0 else later
            assert max(rates) > 100.0
            named.add(folds.links)
            assert point.group is not None
            assert ("plate2" in point.group) == (folds is later)
    assert len(named) == 2


def test_batches_equal_single_designs_to_the_bit() -> None:
    rng = np.random.default_rng(9)
    lengths = rng.uniform(0.3, 3.0, (4, 20, 5))
    batch = assur.FourBar(*lengths)
    limits = batch.limits()
    assert limits.intervals.shape[:2] == (20, 5)
    assert np.shape(limits.full_rotation) == (20, 5)
    for index in np.ndindex(20, 5):
        alone, own = batch.design(index).limits(), limits[index]
        assert alone.intervals.tobytes() == own.intervals.tobytes()
        assert (alone.full_rotation, alone.period) == (own.full_rotation, own.period)
        assert alone.dead_points == own.dead_points
    assert len(limits.dead_points) == 20
    nested: list[Any] = [*limits.dead_points]
    assert len(nested[0]) == 5
    mechanism = triad()
    names = ["l1.length", "l2.length"]
    stretch = rng.uniform(0.99, 1.01, (2, 6))
    several = mechanism.with_dimensions(
        {name: mechanism.dimensions[name] * by for name, by in zip(names, stretch, strict=True)}
    )
    for number in range(6):
        alone, own = several.design(number).limits(), several.limits()[number]
        assert alone.intervals.tobytes() == own.intervals.tobytes()


def test_every_position_within_the_limits_exists_and_none_outside() -> None:
    rng = np.random.default_rng(4)
    for mechanism, count in (
        (six_bar(9.0), 4),
        (six_bar(7.0), 4),
        (assur.FourBar(3, 1, 2.5, 3.2), 2),
    ):
        found = mechanism.assemblies(0.6)
        assert len(found) == count
        for assembly in found:
            limits = mechanism.limits(assembly=assembly)
            q = rng.uniform(-math.pi, math.pi, 300)
            motion = mechanism.solve(q, order=0, assembly=assembly, on_error="nan")
            reached = motion.status <= assur.Status.SINGULAR
            shifted = q[:, None, None] + math.tau * np.array([-1, 0, 1])[:, None]
            low, high = limits.intervals[:, 0], limits.intervals[:, 1]
            inside = ((low <= shifted) & (shifted <= high)).any(axis=(1, 2))
            assert (inside == reached).all()
