"""Four-bars, slider-cranks and guides against their closed forms."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
import numpy.typing as npt
import pytest

from assur import examples
from oracles.kinematics.example_checks import EXACT, STRAIGHT, TURN, coordinates

if TYPE_CHECKING:
    import assur

Float: TypeAlias = npt.NDArray[np.float64]


def test_crank_rocker() -> None:
    """Freudenstein's equation (1954): K1 cos ψ − K2 cos φ + K3 = cos(φ − ψ)."""
    a, b, c, d = 0.04, 0.12, 0.08, 0.1
    motion = examples.crank_rocker().solve(TURN, order=1)
    psi = motion.link("rocker").value
    k1, k2, k3 = d / a, d / c, (a * a - b * b + c * c + d * d) / (2 * a * c)
    misfit = k1 * np.cos(psi) - k2 * np.cos(TURN) + k3 - np.cos(TURN - psi)
    assert np.max(np.abs(misfit)) <= EXACT * (k1 + k2 + abs(k3))
    # it swings between the positions with crank and coupler in one line
    ends = [math.pi - math.acos((c * c + d * d - (b + e) ** 2) / (2 * c * d)) for e in (a, -a)]
    assert [psi.min(), psi.max()] == pytest.approx(sorted(ends), abs=1e-4)  # between samples
    forty = examples.crank_rocker().solve(math.radians(40), order=0)
    angles = [math.degrees(forty.link(n).value) for n in ("coupler", "rocker")]
    # The triangle of B, C and D by the law of cosines, to three decimals.
    assert angles == pytest.approx([20.298, 57.325], abs=5e-4)


def test_chebyshev_lambda() -> None:
    """P from the right angle BDP; a straight half, and x as even as Chebyshev has it."""
    unit = 0.05
    motion = examples.chebyshev_lambda().solve(TURN, order=1)
    b = np.stack([unit * np.cos(TURN), unit * np.sin(TURN)], axis=-1) - [2 * unit, 0.0]
    s = np.hypot(*b.T)
    up = np.sqrt((5 * unit - s) * (5 * unit + s)) / s
    want = np.stack([2 * unit + up * b[:, 1], -up * b[:, 0]], axis=-1)
    point = motion.joint("P").value
    assert np.max(np.abs(point - want)) <= EXACT * 5 * unit
    half = point[np.abs(motion.q - math.pi) <= 0.5 * math.pi] / unit
    assert np.ptp(half[:, 0]) == pytest.approx(4.0, abs=STRAIGHT)
    assert half[:, 1].min() == pytest.approx(4.0, abs=STRAIGHT)
    assert half[:, 1].max() <= 4.01


def test_engine() -> None:
    r, rod = 0.045, 0.15
    motion = examples.engine().solve(TURN)
    s = r * np.sin(TURN)
    bore, cos_delta = motion.slide("bore"), np.sqrt(1 - (s / rod) ** 2)
    sin_delta = s / rod
    assert np.max(np.abs(bore.value - (r * np.cos(TURN) + rod * cos_delta))) <= EXACT * rod
    assert np.ptp(bore.value) == pytest.approx(2 * r, rel=EXACT)
    speed = -r * (np.sin(TURN) + np.cos(TURN) * sin_delta / cos_delta)
    assert np.max(np.abs(bore.d1 - speed)) <= EXACT * rod
    turned = (np.cos(TURN) / cos_delta) ** 2 / cos_delta * r / rod
    acceleration = -r * (np.cos(TURN) - np.sin(TURN) * sin_delta / cos_delta + turned)
    assert np.max(np.abs(bore.d2 - acceleration)) <= EXACT * rod


def lever_angle(r: float, d: float) -> Float:
    """Direction from D, d below O, to the crank pin; continuous from near 0."""
    return np.unwrap(np.arctan2(r * np.sin(TURN) + d, r * np.cos(TURN)))


def time_ratio(mechanism: assur.Mechanism) -> float:
    """Crank angle of the ram's forward stroke over that of its return, to a sample of 0.5°."""
    out = mechanism.solve((TURN[1:] + TURN[:-1]) / 2, order=1).slide("bed").d1 > 0
    return float(np.sum(out) / np.sum(~out))


def test_whitworth() -> None:
    r, d, e, rod = 0.1, 0.05, 0.15, 0.39
    mechanism = examples.whitworth()
    motion = mechanism.solve(TURN)
    beta = lever_angle(r, d)
    lever = motion.link("lever")
    assert np.max(np.abs(lever.value - (beta - math.pi))) <= EXACT * 10
    assert lever.value[-1] - lever.value[0] == pytest.approx(math.tau, abs=EXACT)
    s = motion.slide("slot").value
    assert np.max(np.abs(s**2 - (r * r + d * d + 2 * r * d * np.sin(TURN)))) <= EXACT * (r + d) ** 2
    assert lever.d1 == pytest.approx((r * r + r * d * np.sin(TURN)) / s**2, abs=10 * EXACT)
    ram = -e * np.cos(beta) + np.sqrt(rod**2 - (e * np.sin(beta)) ** 2)
    bed = motion.slide("bed")
    assert np.max(np.abs(bed.value - ram)) <= EXACT * (e + rod)
    # the ram turns where the lever lies along the bed, 30° beyond the crank's own level
    alpha = math.asin(d / r)
    ends = mechanism.solve([-alpha, math.pi + alpha], order=1)
    assert np.max(np.abs(ends.slide("bed").d1)) <= EXACT
    assert ends.slide("bed").value == pytest.approx([rod - e, rod + e], abs=EXACT)
    assert time_ratio(mechanism) == pytest.approx((math.pi + 2 * alpha) / (math.pi - 2 * alpha))


def test_shaper() -> None:
    r, d, e, rod = 0.1, 0.2, 0.4, 0.15
    mechanism = examples.shaper()
    motion = mechanism.solve(TURN)
    beta = lever_angle(r, d)
    assert np.max(np.abs(motion.link("lever").value - beta)) <= EXACT * 10
    end = np.stack([e * np.cos(beta), e * np.sin(beta) - d], axis=-1)
    ram = end[:, 0] + np.sqrt(rod**2 - (end[:, 1] - 0.17) ** 2)
    bed = motion.slide("bed")
    assert np.max(np.abs(bed.value - ram)) <= EXACT
    # the lever turns back where the crank is at right angles to it
    alpha = math.asin(r / d)
    ends = mechanism.solve([-alpha, math.pi + alpha], order=1)
    assert ends.link("lever").value == pytest.approx(
        [math.pi / 2 - alpha, math.pi / 2 + alpha], abs=EXACT
    )
    assert np.max(np.abs(ends.link("lever").d1)) <= EXACT
    assert np.max(np.abs(ends.slide("bed").d1)) <= EXACT
    assert time_ratio(mechanism) == pytest.approx((math.pi - 2 * alpha) / (math.pi + 2 * alpha))


def test_scotch_yoke() -> None:
    r = 0.05
    q = np.concatenate([TURN, -3 * TURN])
    motion = examples.scotch_yoke().solve(q, order=3)
    bed, c, s = motion.slide("bed"), r * np.cos(q), r * np.sin(q)
    for got, want in ((bed.value, c), (bed.d1, -s), (bed.d2, -c), (bed.d3, s)):
        assert np.max(np.abs(got - want)) <= EXACT * r
    assert np.max(np.abs(np.abs(motion.slide("slot").value) - np.abs(s))) <= EXACT * r
    assert np.max(np.abs(motion.link("yoke").value - motion.link("yoke").value[0])) <= EXACT


def test_tangent_generator() -> None:
    h = 0.1
    q = coordinates("tangent_generator")
    mechanism = examples.tangent_generator()
    motion = mechanism.solve(q, order=3)
    rail, t = motion.slide("rail"), np.tan(q)
    g = 1 + t * t  # its own derivative: 2 t g
    for got, want in (
        (rail.value, h * t),
        (rail.d1, h * g),
        (rail.d2, 2 * h * t * g),
        (rail.d3, 2 * h * g * (g + 2 * t * t)),
    ):
        assert np.max(np.abs(got - want)) <= EXACT * np.max(np.abs(want))
    assert np.max(np.abs(motion.slide("slot").value - h / np.cos(q))) <= EXACT * h / math.cos(1.4)


def test_trammel() -> None:
    """An ellipse: half axes BP and AP; the bar's middle runs on a circle."""
    motion = examples.trammel().solve(TURN)
    x, y = motion.joint("P").value.T
    assert np.max(np.abs((x / 0.2) ** 2 + (y / 0.08) ** 2 - 1)) <= EXACT
    assert np.max(np.abs(x - 0.2 * np.cos(TURN))) <= EXACT * 0.2
    assert np.max(np.abs(y - 0.08 * np.sin(TURN))) <= EXACT * 0.2
    assert np.max(np.abs(motion.slide("x").value - 0.12 * np.cos(TURN))) <= EXACT * 0.2
    assert np.max(np.abs(motion.slide("y").value + 0.12 * np.sin(TURN))) <= EXACT * 0.2
    by_slide = examples.trammel().with_driver("x").solve(np.linspace(-0.119, 0.119, 101), order=0)
    x, y = by_slide.joint("P").value.T
    assert np.max(np.abs((x / 0.2) ** 2 + (y / 0.08) ** 2 - 1)) <= EXACT
    assert np.all(y < 0)  # as drawn
    middle = (motion.joint("A").value + motion.joint("B").value) / 2
    assert np.max(np.abs(np.hypot(*middle.T) - 0.06)) <= EXACT * 0.2
