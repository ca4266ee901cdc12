"""Limits of chains of dyads beside other dead points, against fifty digits and `solve`."""

from __future__ import annotations

import math
import random
from typing import TYPE_CHECKING

import mpmath  # type: ignore[import-untyped]
import numpy as np
import pytest

import assur
from assur import Status
from campaigns import campaign_cases
from models.mechanisms import flat_models, mixed_models
from models.mechanisms.frames import Frame
from models.mechanisms.mechanism_data import Description, arguments
from models.mechanisms.variants import Variant, framed, shuffled

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from models.mechanisms import dyad_models

# Dead points are promised to this.
DEAD_POINT = 1e-10
SCANNED = 4001
# A bracket is halved to the spacing of q.
HALVINGS = 50
# Positions beside ends and the drawing.
BESIDE = np.geomspace(1e-9, 1e-2, 40)
# Where guides become parallel a limit is not an end of what `solve` finds: a joint is at infinity.
POLE = 1e4

KINDS: dict[str, Callable[[int], dyad_models.Case]] = {
    "random": campaign_cases.random_case,
    "mixed": mixed_models.mixed_case,
    "flat": flat_models.flat_case,
}


def pin(q: mpmath.mpf) -> mpmath.mpc:
    """Where coupler and rocker meet: crank 3, coupler 2.5, rocker 2, ground 4."""
    b = 3 * mpmath.expj(q)
    chord = 4 - b
    d = abs(chord)
    along = (d**2 + mpmath.mpf(2.5) ** 2 - 4) / (2 * d)
    return b + chord / d * mpmath.mpc(along, mpmath.sqrt(mpmath.mpf(2.5) ** 2 - along**2))


@pytest.mark.parametrize("before", [0.0, *np.geomspace(1e-14, 1e-2, 25)])
@pytest.mark.parametrize("pivot", [6.5 + 0.5j, 4.0 + 4.0j, -1.0 - 2.0j, 1.0j])
def test_a_dyad_that_folds_just_before_another(before: float, pivot: complex) -> None:
    """A second dyad hangs at the four-bar's pin and folds so much before the four-bar does."""
    with mpmath.workdps(50):
        outer = mpmath.acos((9 + 16 - mpmath.mpf(4.5) ** 2) / 24)
        fold, drawn = outer - mpmath.mpf(before), mpmath.mpf("1.1")
        reach, near = abs(pin(fold) - pivot), abs(pin(drawn) - pivot)
        # Stretched where the pin goes away from the pivot, folded where it comes nearer.
        rod = (mpmath.mpf("0.6") * reach) if near < reach else mpmath.mpf("1.5") * reach
        arm = reach - rod if near < reach else rod - reach
        chord = pivot - pin(drawn)
        along = (near**2 + rod**2 - arm**2) / (2 * near)
        knee = pin(drawn) + chord / near * mpmath.mpc(along, mpmath.sqrt(rod**2 - along**2))
        crank, c, e, upper = (complex(x) for x in (3 * mpmath.expj(drawn), pin(drawn), knee, fold))
    joints = {"A": 0j, "B": crank, "C": c, "D": 4 + 0j, "E": e, "F": pivot}
    mechanism = assur.Mechanism(
        {name: (at.real, at.imag) for name, at in joints.items()},
        {"ground": "ADF", "crank": "AB", "coupler": "BC", "rocker": "CD", "rod": "CE", "arm": "EF"},
        "crank",
    )
    limits = mechanism.limits()
    found = [end for _, end in limits.intervals.tolist() if abs(end - upper.real) < 0.5]
    assert found == pytest.approx([upper.real], abs=1e-12, rel=0.0), limits
    if before > 1e-12:
        assert "II(rod, arm)" in {point.group for point in limits.dead_points}


def there(mechanism: assur.Mechanism, q: NDArray[np.float64]) -> NDArray[np.bool_]:
    found = mechanism.solve(q, order=0, on_error="nan", threads=1)
    return np.asarray(found.status) <= Status.SINGULAR


def apart(one: NDArray[np.float64], other: NDArray[np.float64]) -> NDArray[np.float64]:
    """How far each is from the nearest of the other, on a turn."""
    if not len(other):
        return np.full(len(one), np.inf)
    turned = np.remainder(one[:, None] - other + math.pi, math.tau) - math.pi
    return np.asarray(np.abs(turned).min(axis=1))


def faults(d: Description) -> list[str]:
    """What limits of a class II chain say otherwise than a scan whose changes are bisected."""
    mechanism = assur.Mechanism(**arguments(d))
    intervals, q0 = np.asarray(mechanism.limits().intervals), float(mechanism.q0)
    ends = intervals[np.isfinite(intervals)]
    around = [at + side * BESIDE for at in (q0, *ends) for side in (-1, 1)]
    q = np.unique(np.concatenate([q0 + np.linspace(-math.pi, math.pi, SCANNED), *around]))
    reached = there(mechanism, q)
    low, high, before = q[:-1], q[1:], reached[:-1]
    change = before != reached[1:]
    low, high, before = low[change], high[change], before[change]
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        same = there(mechanism, middle) == before
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    faults = [f"solve ends at {at!r}" for at in low[apart(low, ends) > DEAD_POINT].tolist()]
    for at in ends[apart(ends, low) > DEAD_POINT].tolist():
        beside = mechanism.solve(at + np.array([-1e-9, 1e-9]), order=0, on_error="nan", threads=1)
        if not (np.asarray(beside.condition) > POLE).all():
            faults.append(f"limits end at {at!r}")
    if not ((intervals[:, 0] <= q0) & (q0 <= intervals[:, 1])).any():
        faults.append(f"the drawing's {q0!r} is in no interval")
    return [f"{fault}: {intervals.tolist()}" for fault in faults]


@pytest.mark.parametrize(
    ("kind", "seed"),
    [
        *(("random", seed) for seed in (27, 116, 250, 335, 502, 517)),
        ("mixed", 47),
        *(("flat", seed) for seed in (112, 118, 1089, 2275)),
    ],
)
def test_chains_that_fold_beside_other_dead_points(kind: str, seed: int) -> None:
    d = KINDS[kind](seed).description
    assert not faults(d)
    assert not faults(shuffled(Variant.same(d), random.Random(seed)).description)


@pytest.mark.parametrize("seed", [9, 69, 158, 165, 188, 248, 350, 369])
def test_stretches_around_change_points(seed: int) -> None:
    """Where a dyad has a change point in the very middle of a stretch, the stretch exists."""
    mechanism = assur.Mechanism(**arguments(campaign_cases.changing_case(seed).description))
    intervals, q0 = np.asarray(mechanism.limits().intervals), float(mechanism.q0)
    assert ((intervals[:, 0] <= q0) & (q0 <= intervals[:, 1])).any()
    q = q0 + np.linspace(-math.pi, math.pi, SCANNED)
    turns = q + math.tau * np.arange(-2, 3)[:, None]
    low, high = intervals.T[:, :, None, None]
    held = ((low <= turns) & (turns <= high)).any(axis=(0, 1))
    assert not (there(mechanism, q) & ~held).any()
    for start, end in intervals:
        assert there(
            mechanism, start + (end - start) * np.linspace(1e-6, 1.0 - 1e-6, SCANNED)
        ).all()


@pytest.mark.parametrize("ulps", [-64, -1, 0, 1, 64])
def test_a_six_bar_whose_crank_is_as_long_as_the_ground(ulps: int) -> None:
    """A sign changes where the crank is opposite: in the second turn the motion is another."""
    length = 0.1 + ulps * math.ulp(0.1)
    mechanism = assur.examples.stephenson_3().with_dimensions({"crank.length": length})
    intervals, q0 = np.asarray(mechanism.limits().intervals), float(mechanism.q0)
    assert ((intervals[:, 0] <= q0) & (q0 <= intervals[:, 1])).any()
    turns = 2 if abs(ulps) <= 1 else 1
    q = q0 + np.linspace(-math.tau, math.tau, SCANNED)
    at = q + turns * math.tau * np.arange(-2, 3)[:, None]
    low, high = intervals.T[:, :, None, None]
    held = ((low <= at) & (at <= high)).any(axis=(0, 1))
    # An interval is cut at the change point if its lengths miss that by a little.
    assert not (held & ~there(mechanism, q)).any()
    assert np.count_nonzero(there(mechanism, q) & ~held) <= 1
    if turns == 2:
        np.testing.assert_allclose(
            intervals, [[-5.877519615, -0.402715842], [0.761723602, 5.880469465]], atol=1e-8
        )


def test_random_chains_end_where_solve_does() -> None:
    checked = 0
    for seed in range(60):
        case = campaign_cases.random_case(seed)
        if case.driver.startswith("slide") or len(case.description.drivers) > 1:
            continue
        assert not faults(case.description), seed
        checked += 1
    assert checked > 30


@pytest.mark.parametrize("seed", [222, 546])
def test_change_points_are_no_ends_in_any_frame(seed: int) -> None:
    """Turned, a drawing has other rounding, by which a discriminant may be less than 0 there."""
    d = campaign_cases.changing_case(seed).description
    turned = framed(Variant.same(d), Frame(0.7, (1.0, -2.0), mirror=False)).description
    one, two = (assur.Mechanism(**arguments(of)) for of in (d, turned))
    assert len(one.limits().dead_points) == len(two.limits().dead_points)
    assert one.limits().full_rotation == two.limits().full_rotation


def test_redundant_links_that_do_not_fit() -> None:
    """`solve` has no position there."""
    m = assur.examples.locomotive()
    assert m.limits().full_rotation
    longer = m.with_dimensions({"coupling_rod.length": 2.21})
    assert (longer.solve(longer.q0 + np.arange(-3.0, 3.0), on_error="nan").status > 2).all()
    assert not len(longer.limits().intervals)
    crossed = m.with_assembly(assur.Assembly({"A1": -1}))
    assert (crossed.solve(m.q0 + np.arange(-3.0, 3.0), on_error="nan").status > 2).all()
    assert not len(crossed.limits().intervals)


@pytest.mark.parametrize("longer", [0.0, 1e-13, 1e-11, 1e-10, 1e-9])
def test_redundant_links_that_nearly_fit(longer: float) -> None:
    """Where `solve` has a position an interval holds it, over the change points too."""
    m = assur.examples.locomotive()
    m = m.with_dimensions({"coupling_rod.length": 2.2 + longer})
    q = float(m.q0) + np.linspace(-math.pi, math.pi, 361)
    there = m.solve(q, on_error="nan").status <= Status.SINGULAR
    assert there.any()
    low, high = np.asarray(m.limits().intervals).T[:, :, None]
    assert ((low <= q) & (q <= high)).any(axis=0)[there].all()


@pytest.mark.parametrize("longer", [1e-8, 1e-6])
def test_redundant_links_that_fit_here_and_there(longer: float) -> None:
    m = assur.examples.locomotive().with_dimensions({"coupling_rod.length": 2.2 + longer})
    q = float(m.q0) + np.linspace(-math.pi, math.pi, 361)
    assert (m.solve(q, on_error="nan").status > Status.SINGULAR).any()
    assert not len(m.limits().intervals)
