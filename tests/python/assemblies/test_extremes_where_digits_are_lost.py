"""Extremes beside dead points of what is smooth there, though it is made of what is not.

Right values are those of an oracle that computes with 50 digits.
"""

from __future__ import annotations

import math
import random
from typing import TYPE_CHECKING

import numpy as np
import pytest

import assur
from campaigns.campaign_cases import random_case
from models.mechanisms.higher_models import higher_case
from models.mechanisms.mechanism_data import Description, arguments
from models.mechanisms.mixed_models import mixed_case
from models.mechanisms.variants import Variant, shuffled
from oracles.kinematics import oracle, oracle_guess

if TYPE_CHECKING:
    from oracles.kinematics.oracle_system import Pose

# Distances of the oracle's positions from an end, and how well their line gives the limit.
BESIDE = (1e-8, 2e-8)
GOOD = 1e-6


def pose(d: Description, m: assur.Mechanism, q: float) -> Pose:
    """Where the oracle's iteration begins."""
    here = m.solve(q, order=0)
    joints = {name: here.joint(name).value for name in d.joints}
    angles = {name: float(here.link(name).value) for name in d.links.keys() - {"ground"}}
    return oracle_guess.guess_from_joints(d, joints, angles)


def limit(d: Description, name: str, order: int, end: float, inward: float) -> float:
    """A derivative toward an end of an interval."""
    m = assur.Mechanism(**arguments(d))
    joint, dot, axis = name.rpartition(".")
    values = []
    for distance in BESIDE:
        q = end + inward * distance
        there = oracle.solve(d, q, pose(d, m, q), order)
        if dot:
            values.append(float(there.joints[joint].tensor(order)["xy".index(axis)]))
        else:
            values.append(float({**there.links, **there.slides}[name].tensor(order)))
    return 2.0 * values[0] - values[1]


# A third analogue is the difference of terms that grow as the power −5/2 of the distance.
@pytest.mark.parametrize(("order", "good"), [(1, 1e-10), (2, 1e-9), (3, 1e-7)])
def test_a_slide_on_a_link_that_folds(order: int, good: float) -> None:
    """The joint on it moves smoothly in its frame, but both are solved from what folds."""
    d = random_case(10376).description
    m = assur.Mechanism(**arguments(d))
    [[low, high]] = m.limits().intervals.tolist()
    ends = [limit(d, "s0", order, end, inward) for end, inward in ((low, 1.0), (high, -1.0))]
    for v in (Variant.same(d), *(shuffled(Variant.same(d), random.Random(i)) for i in range(3))):
        # Driven by the angle between two links, listed either way.
        other = assur.Mechanism(**arguments(v.description))
        found = other.extremes("s0", order=order)
        values = sorted([found.min.value, found.max.value])
        assert values == pytest.approx(sorted(ends), rel=good)


def test_errors_that_are_all_the_same_beside_a_dead_point() -> None:
    d = random_case(4791).description
    m = assur.Mechanism(**arguments(d))
    low = m.limits().intervals[0, 0]
    found = m.extremes("s4", order=3).max
    assert found.q == low
    assert found.value == pytest.approx(limit(d, "s4", 3, low, 1.0), rel=GOOD)


def test_a_greatest_rate_where_slopes_step_over_zero() -> None:
    """Some 1e-6 rad from a dead point."""
    d = mixed_case(2271).description
    m = assur.Mechanism(**arguments(d))
    low = m.limits().intervals[0, 0]
    found = m.extremes("L13", order=1).max
    rates = []
    for q in (found.q, low + 5e-7, low + 8e-7):
        there = oracle.solve(d, q, pose(d, m, q), 1)
        rates.append(float(there.links["L13"].tensor(1)))
    assert found.value == pytest.approx(rates[0], rel=1e-4)
    assert rates[0] > max(rates[1:])


def test_two_dead_points_a_millionth_apart() -> None:
    """The nearer one is passed by another dyad, so rates rise far, but to a limit."""
    d = random_case(100046).description
    m = assur.Mechanism(**arguments(d))
    [[low, high]] = m.limits().intervals.tolist()
    for order in (1, 2):
        found = m.extremes("J1.y", order=order)
        # The distance over 1e-6, squared, is what the line neglects.
        there = limit(d, "J1.y", order, high, -1.0)
        assert found.max.value == pytest.approx(there, rel=1e-3)
        assert found.min.value == pytest.approx(limit(d, "J1.y", order, low, 1.0), rel=GOOD)
        assert found.max.q == high


def test_what_is_far_smaller_than_all_else_is_not_zero() -> None:
    """An interval of 1e-4 rad beside a joint at infinity, whose third analogues are of 1e20."""
    d = random_case(100071).description
    m = assur.Mechanism(**arguments(d))
    high = m.limits().intervals[1, 1]
    greatest = m.extremes("J7.x", order=3).max
    assert greatest.value == pytest.approx(limit(d, "J7.x", 3, high, -1.0), rel=1e-9)
    assert greatest.q == high


@pytest.mark.parametrize("order", range(4))
def test_a_joint_at_infinity_beside_a_dead_point(order: int) -> None:
    """On both sides of it: to −∞ and back from ∞, so even derivatives take on both."""
    m = assur.Mechanism(**arguments(random_case(100055).description))
    found = m.extremes("J9.y", order=order)
    assert found.min.value == -math.inf
    assert (found.max.value == math.inf) == (order % 2 == 0)


def test_a_pole_below_a_sharp_motion() -> None:
    """Within the interval values rise to a million times the coefficient of the pole at its end."""
    m = assur.Mechanism(**arguments(higher_case(5046).description))
    found = m.extremes("b.x", order=3)
    assert (found.min.value, found.max.value) == (-math.inf, math.inf)
    low = m.limits().intervals[0, 0]
    near = m.solve(low + np.array([1e-7, 1e-5]), order=3).joint("b").d3[:, 0]
    assert near[0] / near[1] == pytest.approx(1e5, rel=1e-3)  # the power −5/2 of the distance


@pytest.mark.parametrize(
    ("seed", "name", "order"),
    [(200021, "J1.y", 1), (200025, "J6.x", 1), (200025, "J6.x", 3), (200025, "J5.x", 2)],
)
def test_no_pole_where_values_rise_to_a_limit(seed: int, name: str, order: int) -> None:
    d = random_case(seed).description
    m = assur.Mechanism(**arguments(d))
    found = m.extremes(name, order=order)
    far = max((found.min, found.max), key=lambda end: abs(end.value))
    apart = np.abs(m.limits().intervals - far.q)
    assert apart.min() < 1e-9
    inward = 1.0 if apart[:, 0].min() == apart.min() else -1.0
    there = limit(d, name, order, far.q, inward)
    assert far.value == pytest.approx(there, rel=1e-4)


@pytest.mark.parametrize("order", [1, 2, 3])
def test_a_dwell_beside_a_dead_point_is_one_stretch(order: int) -> None:
    m = assur.Mechanism(**arguments(random_case(10376).description))
    [[low, high]] = m.limits().intervals.tolist()
    found = m.extremes("s0", order=order)
    for stretches in found.dwells(1e-4 * abs(found.max.value)):
        [[first, last]] = stretches
        # The value is monotone: it dwells at the ends.
        assert first == low or last == high
