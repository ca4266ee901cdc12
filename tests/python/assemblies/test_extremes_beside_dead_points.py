"""Extremes of analogues, which are infinite at dead points, against plain scans."""

from __future__ import annotations

import math
import random
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
import pytest
from numpy.typing import NDArray

import assur
from assemblies.test_numbers import six_bar, triad
from campaigns.checks.campaign_variants import variant_of
from models.mechanisms import mixed_models
from models.mechanisms.mechanism_data import arguments

if TYPE_CHECKING:
    from collections.abc import Iterator

    from assur._extreme import Extreme

Array: TypeAlias = NDArray[np.float64]

FOUR_BAR = ("C.x", "C.y", "coupler", "rocker")
ORDERS = (0, 1, 2, 3)
# Positions of a scan, closer together toward the ends of an interval; nearer to the ends, as an
# angle, none is taken: there conditions exceed some thousand.
POSITIONS = 8001
NEAR_END = 1e-3
# By how much, relative to itself and to the middle of all values, a scan may be above an extreme:
# rounding of third analogues.
ROUNDING = 1e-8


def scans(m: assur.Mechanism) -> Iterator[tuple[Array, assur.Motion]]:
    """Positions of every interval of an assembly, a turn where the driver goes round."""
    limits = m.limits()
    for low, high in limits.intervals.tolist():
        if math.isinf(low):
            q = m.q0 + np.linspace(-math.pi, math.pi, POSITIONS) * np.asarray(
                limits.period, dtype=float
            )
        else:
            part = np.cos(np.linspace(math.pi - NEAR_END, NEAR_END, POSITIONS))
            q = 0.5 * (low + high) + 0.5 * (high - low) * part
        yield q, m.solve(q, order=3, on_error="nan")


def column(motion: assur.Motion, name: str, order: int) -> Array:
    """The values of a coordinate's derivative."""
    joint, dot, axis = name.rpartition(".")
    key = ("value", "d1", "d2", "d3")[order]
    values = getattr(motion.joint(joint) if dot else motion[name], key)
    return np.asarray(values[:, "xy".index(axis)] if dot else values)


def check(m: assur.Mechanism, names: tuple[str, ...], orders: tuple[int, ...] = ORDERS) -> int:
    """No position of a scan is beyond an extreme, and every finite extreme is taken on."""
    motions = list(scans(m))
    finite = 0
    for name in names:
        for order in orders:
            values = np.concatenate([column(motion, name, order) for _, motion in motions])
            try:
                found = m.extremes(name, order=order)
            except assur.InputError:
                turned = motions[0][1].link(name).value
                assert order == 0
                assert abs(turned[-1] - turned[0]) > math.pi
                continue
            size = float(np.nanmedian(np.abs(values)))
            for end, beyond in (
                (found.min, found.min.value - np.nanmin(values)),
                (found.max, np.nanmax(values) - found.max.value),
            ):
                slack = ROUNDING * (abs(end.value) + size) if math.isfinite(end.value) else 0.0
                assert not beyond > slack, (name, order, end, beyond)
                if math.isinf(end.value) and order:
                    assert _grows_toward(motions, name, order, end), (name, order, end)
                if math.isfinite(end.value) and math.isfinite(end.q):
                    near_end = any(
                        abs(end.q - q[side]) < 1e-5 for q, _ in motions for side in (0, -1)
                    )
                    if not near_end:
                        there = m.solve([end.q], order=max(order, 1))
                        own = float(column(there, name, order)[0])
                        assert own == pytest.approx(end.value, rel=1e-9, abs=1e-11 * size)
                    finite += 1
    return finite


def _grows_toward(
    motions: list[tuple[Array, assur.Motion]], name: str, order: int, end: Extreme
) -> bool:
    """Whether a scan grows toward an end where an analogue is infinite."""
    for q, motion in motions:
        values = column(motion, name, order)
        for side, near in ((0, q[0]), (-1, q[-1])):
            if abs(near - end.q) < 1e-5 * (q[-1] - q[0]):
                last, before = values[side], values[1 + 3 * side]
                return bool(last * end.value > 0.0 and abs(last) > abs(before))
    return False


def test_an_extreme_between_poles() -> None:
    """The second analogue goes to −∞ at both ends: its greatest value is a stationary point."""
    m = assur.FourBar(3.0, 2.5, 2.0, 4.0)
    least = m.extremes("rocker", order=2).min
    assert least.value == pytest.approx(-6.592825, abs=1e-6)
    # The printed place is that of 400 001 positions.
    assert least.q == pytest.approx(-0.244111, abs=7e-6)
    rocker = m.solve(least.q, order=3).link("rocker")
    assert float(rocker.d2) == pytest.approx(least.value, rel=1e-12)
    assert float(rocker.d3) == pytest.approx(0.0, abs=1e-6)
    # By formulas that know nothing of the core's: the closure by complex numbers, differences.
    q = least.q + np.array([-2e-3, -1e-3, 0.0, 1e-3, 2e-3])
    b = 3.0 * np.exp(1j * q)
    chord = b - 4.0
    cosine = (np.abs(chord) ** 2 + 2.0**2 - 2.5**2) / (2.0 * 2.0 * np.abs(chord))
    side = float(np.sign(math.sin(float(rocker.value) - np.angle(chord)[2])))
    angle = np.angle(chord) + side * np.arccos(cosine)
    second = (-angle[0] + 16 * angle[1] - 30 * angle[2] + 16 * angle[3] - angle[4]) / (12 * 1e-6)
    assert second == pytest.approx(least.value, rel=1e-6)


@pytest.mark.parametrize("part", range(6))
def test_random_four_bars(part: int) -> None:
    rng = np.random.default_rng(part)
    ends = turns = finite = 0
    while ends < 8 or turns < 2:
        m = assur.FourBar(*rng.uniform(0.5, 4.0, 4))
        intervals = m.limits().intervals
        if not len(intervals) or (ends >= 8 and math.isfinite(intervals[0, 0])):
            continue
        finite += check(m, FOUR_BAR)
        if math.isfinite(intervals[0, 0]):
            ends += 1
        else:
            turns += 1
    assert finite > 100


def test_slider_cranks_and_their_slides() -> None:
    rng = np.random.default_rng(2)
    for _ in range(6):
        crank, rod, offset = rng.uniform([0.5, 0.3, 0.0], [2.0, 3.0, 0.8])
        m = assur.SliderCrank(crank, rod, offset)
        if not len(m.limits().intervals):
            continue
        check(m, ("bore", "rod", "B.x"))
        driven = m.with_driver("bore", q=0.5)
        check(driven, ("crank", "rod", "A.x", "A.y"))


@pytest.mark.parametrize("length", [9.0, 7.0])
def test_six_bars(length: float) -> None:
    m = six_bar(length)
    check(m, tuple(link for link in m.links if link != "ground"))


def test_a_triad() -> None:
    m = triad()
    joint = list(m.joints)[-1]
    check(m, (*(link for link in m.links if link != "ground"), f"{joint}.x", "R.y"))


def test_a_pin_of_the_crank_has_finite_extremes() -> None:
    """What does not depend on the dyad that folds is smooth there: it may have extremes there."""
    m = assur.FourBar(3.0, 2.5, 2.0, 4.0)
    low, high = m.limits().intervals[0]
    q = np.append(np.linspace(low, high, 4001), 0.0)
    for order, of_pin in enumerate((np.cos(q), -np.sin(q), -np.cos(q), np.sin(q))):
        found = m.extremes("B.x", order=order)
        values = 3.0 * of_pin
        assert found.min.value == pytest.approx(values.min(), abs=1e-9)
        assert found.max.value == pytest.approx(values.max(), abs=1e-9)


@pytest.mark.parametrize("phi", [0.6, 2.0, 2.5, -1.9, 1.1])
def test_a_joint_that_crosses_an_axis_at_a_dead_point(phi: float) -> None:
    """Where the dyad is flat along x, x′ of its joint is finite, x″ is not."""
    dead = 3.0 * np.exp(1j * phi)
    ground = dead + 4.5
    for q in (phi - 0.4, phi + 0.4):
        pin = 3.0 * np.exp(1j * q)
        chord = ground - pin
        apart = abs(chord)
        if 0.5 < apart < 4.5:
            break
    along = (2.5**2 - 2.0**2 + apart**2) / (2.0 * apart)
    tip = pin + chord / apart * complex(along, math.sqrt(2.5**2 - along**2))
    places = {"A": 0j, "B": pin, "C": tip, "D": ground}
    m = assur.Mechanism(
        {name: (at.real, at.imag) for name, at in places.items()},
        {"ground": "AD", "crank": "AB", "coupler": "BC", "rocker": "CD"},
        "crank",
    )
    assert np.abs(m.limits().intervals - phi).min() < 1e-9
    check(m, ("C.x", "C.y"))
    first, second = (m.extremes("C.x", order=order) for order in (1, 2))
    assert not any(abs(end.q - phi) < 1e-6 for end in (first.min, first.max)
                   if math.isinf(end.value))  # fmt: skip
    beside = m.solve(phi + np.array([1e-6, 4e-6]) * (q - phi), order=2).joint("C").d2[:, 0]
    assert beside[0] / beside[1] == pytest.approx(2.0, rel=0.05)
    extreme = second.max if beside[0] > 0.0 else second.min
    assert math.isinf(extreme.value)


@pytest.mark.parametrize("order", [1, 2])
def test_stretches_beside_poles(order: int) -> None:
    """Where an analogue stays near its finite extreme, though it is infinite at the other end."""
    m = assur.FourBar(3.0, 2.5, 2.0, 4.0)
    for name in FOUR_BAR:
        found = m.extremes(name, order=order)
        for end, pick in ((found.min, 0), (found.max, 1)):
            if not math.isfinite(end.value):
                continue
            tolerance = 0.02 * abs(end.value)
            stretches = found.dwells(tolerance)[pick]
            assert any(low <= end.q <= high for low, high in stretches)
            for q, motion in scans(m):
                near = np.abs(column(motion, name, order) - end.value) <= tolerance
                own = np.zeros_like(near)
                for low, high in stretches:
                    own |= (low <= q) & (q <= high)
                # At the very ends of a stretch rounding decides.
                assert (near != own).sum() <= 2 * len(stretches)


def test_a_dead_point_just_beyond_where_a_joint_goes_to_infinity() -> None:
    """The end is 8e-6 rad before it: no polynomial through values farther away gets there."""
    m = assur.Mechanism(**arguments(mixed_models.mixed_case(24982).description))
    low, _ = m.limits().intervals[0]
    q = low + np.geomspace(1e-5, 1e-2, 200)
    motion = m.solve(q, order=2)
    for order, jet in ((1, motion.link("L5").d1), (2, motion.link("L5").d2)):
        found = m.extremes("L5", order=order)
        assert found.min.value <= jet.min()
        assert found.max.value >= jet.max()


@pytest.mark.parametrize(("seed", "name", "side"), [(56062, "J5.x", 1), (57742, "s1", 1)])
def test_a_joint_goes_to_infinity_just_beyond_a_dead_point(seed: int, name: str, side: int) -> None:
    """As C/(π − q), 8e-8 rad before π; the coordinate does not take part in the fold."""
    m = assur.Mechanism(**arguments(mixed_models.mixed_case(seed).description))
    end = m.limits().intervals[0][side]
    motion = m.solve(end - np.geomspace(1e-9, 1.0, 200), order=3)
    for order in range(4):
        found = m.extremes(name, order=order)
        scan = column(motion, name, order)
        assert found.min.value <= scan.min()
        assert found.max.value >= scan.max()
    if seed == 56062:
        distance = math.pi - end
        values = [m.extremes(name, order=order).max.value for order in (0, 2)]
        assert values[1] == pytest.approx(2.0 * values[0] / distance**2, rel=1e-3)


def test_digits_lost_beside_a_dead_point_do_not_hide_a_pole() -> None:
    """No polynomial is followed to 1e-4 there, in one of two orders of the links."""
    description = mixed_models.mixed_case(78316).description
    drawn = assur.Mechanism(**arguments(description))
    other = variant_of(description, drawn, random.Random("variants 78316"))
    for own in (description, other.description):
        m = assur.Mechanism(**arguments(own))
        third = m.extremes("s3", order=3)
        assert (third.min.value, third.max.value) == (-math.inf, math.inf)


@pytest.mark.parametrize("order", [1, 3])
def test_an_interval_of_a_few_hundred_million_roundings(order: int) -> None:
    """Three 10⁻⁷ rad wide: nodes as near as elsewhere would be two roundings from its end."""
    m = assur.Mechanism(**arguments(mixed_models.mixed_case(90311).description))
    low = m.limits().intervals[2, 0]
    found = m.extremes("L5", order=order)
    assert (found.min.value, found.max.value) == (-math.inf, math.inf)
    assert found.min.q == low


def test_a_slide_that_goes_on_for_ever_as_far_as_a_group_is_followed() -> None:
    """To 1e5 m; extremes looked at 1.6e5, found nothing and ended at the last node."""
    m = assur.Mechanism(**arguments(mixed_models.mixed_case(4023).description))
    assert m.limits().intervals[0, 1] == math.inf
    far = m.solve([1e3, 1e4]).slide("s0").value
    assert far[1] / far[0] == pytest.approx(10.0, rel=1e-2)
    assert m.extremes("s0").min == (-math.inf, math.inf)
    rate = m.extremes("s0", order=1)
    assert rate.min.value <= (far[1] - far[0]) / 9e3 + 1e-6


def test_rounding_beside_a_dead_point_is_no_pole() -> None:
    """Where a group of class IV is singular, a smooth slide has lost all digits at order 2."""
    description = mixed_models.mixed_case(70081).description
    drawn = assur.Mechanism(**arguments(description))
    other = variant_of(description, drawn, random.Random("variants 70081"))
    again = assur.Mechanism(**arguments(other.description))
    one, two = drawn.extremes("s5", order=2), again.extremes(other.names["slide"]["s5"], order=2)
    assert two.min.value == pytest.approx(one.min.value, rel=1e-9)
    assert one.min.value == pytest.approx(-0.98816, abs=1e-5)
