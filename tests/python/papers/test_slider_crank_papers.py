"""P1 (Chernysh et al.) and P2 (Ambarcumyanc and Subbotina): every number, and 50 digits beside."""

from __future__ import annotations

import itertools
import math
from fractions import Fraction
from typing import Any

import mpmath  # type: ignore[import-untyped]
import numpy as np
import pytest

import assur
from assur import slider_crank as sc

MP = mpmath.MPContext()
MP.dps = 50
RATIOS = (1.5, 2.0, 3.0, 3.7, 5.0, 8.0, 20.0)
ANGLES = np.array([-7.0, -1e-4, 1e-9, 0.3, 1.2, math.pi / 2, 2.6, 3.1, 4.4, 6.2, 40.0])
# Some tens of roundings.
EXACT = 2e-15
# Half a unit in the last place, a little more: relative to a number just above a power of two.
LAST_BIT = 1.14e-16


def exact(phi: Any, k: Any) -> Any:
    """Stroke per crank length at 50 digits: the papers' first formula as it stands (4)."""
    return k + 1 - MP.cos(phi) - k * MP.cos(MP.asin(MP.sin(phi) / k))


def by_fraction(phi: Any, lam: Any, n: int) -> Any:
    u = MP.mpf(1)
    for _ in range(1, n):
        u = 1 - lam**2 * MP.sin(phi) ** 2 / (4 * u)
    return 1 - MP.cos(phi) + lam * MP.sin(phi) ** 2 / (2 * u)


@pytest.mark.parametrize("k", RATIOS)
@pytest.mark.parametrize("order", [0, 1, 2])
def test_the_exact_motion_at_fifty_digits(k: float, order: int) -> None:
    found = sc.stroke(ANGLES, 1.0, k)
    got = (found.value, found.d1, found.d2)[order]
    angle = sc.rod_angle(ANGLES, 1.0, k)
    rod = (angle.value, angle.d1, angle.d2)[order]
    for i, phi in enumerate(ANGLES):
        wanted = MP.diff(lambda p: exact(p, MP.mpf(k)), MP.mpf(float(phi)), order)
        size = abs(wanted) if order == 0 else 1
        # Nothing is lost near the dead points.
        turns = abs(float(phi)) * 2.3e-16
        assert abs(got[i] - wanted) <= EXACT * float(size) + 2 * turns, phi
        wanted = MP.diff(lambda p: -MP.asin(MP.sin(p) / MP.mpf(k)), MP.mpf(float(phi)), order)
        assert abs(rod[i] - wanted) <= EXACT + 2 * turns, phi


def test_both_conventions_and_the_general_engine() -> None:
    crank, rod = np.array([[0.11], [0.05], [2.0]]), np.array([[0.407], [0.08], [3.1]])
    q = np.linspace(-4.0, 9.0, 53)
    for i in range(3):
        motion = assur.SliderCrank(crank[i, 0], rod[i, 0]).solve(q)
        x = sc.coordinate(q, crank, rod)
        bore = motion.slide("bore")
        size = crank[i, 0] + rod[i, 0]
        for mine, its in ((x.value, bore.value), (x.d1, bore.d1), (x.d2, bore.d2)):
            assert np.abs(mine[i] - its).max() <= 1e-13 * size
        s = sc.stroke(q, crank, rod)
        np.testing.assert_allclose(s.value[i], size - bore.value, atol=1e-14 * size)
        angle = sc.rod_angle(q, crank, rod)
        link = motion.link("rod")
        for mine, its in ((angle.value, link.value), (angle.d1, link.d1), (angle.d2, link.d2)):
            assert np.abs(mine[i] - its).max() <= 1e-13
        at = sc.rod_point(q, crank, rod, along=0.3 * rod)
        both = 0.7 * motion.joint("A").value + 0.3 * motion.joint("B").value
        np.testing.assert_allclose(at.value[i], both, atol=1e-14 * size)
        w, e = 31.0, -4.0
        a = 0.7 * motion.joint("A").acceleration(w, e) + 0.3 * motion.joint("B").acceleration(w, e)
        np.testing.assert_allclose(at.acceleration(w, e)[i], a, atol=1e-10 * size)


def test_coefficients_printed() -> None:
    three = [1.08515507, -1, -0.0857771443, 6.31192447e-4, -9.28978204e-6]
    five = [1.05038139, -1, -0.0505095997, 1.28862761e-4, -6.57527258e-7]
    found = sc.fourier([3.0, 5.0])
    np.testing.assert_allclose(found, [three, five], rtol=6e-9)
    # The paper's own terms (12): three of A0, three of A2, two of A4, one of A6.
    k = 3.0
    a0 = 1 + 1 / (4 * k) + 3 / (64 * k**3) + 5 / (256 * k**5)
    a2 = -(1 / (4 * k) + 1 / (16 * k**3) + 15 / (512 * k**5))
    printed = [a0, -1.0, a2, 1 / (64 * k**3) + 3 / (256 * k**5), -1 / (512 * k**5)]
    np.testing.assert_allclose(sc.fourier(k, harmonics=6, terms=3), printed, rtol=4e-16)
    more = a0 + 175 / (16384 * k**7)
    assert math.isclose(sc.fourier(k, harmonics=0, terms=4)[0], more, rel_tol=4e-16)


@pytest.mark.parametrize("k", [1.05, 1.1, 1.2, 1.7, 2.5, *RATIOS])
def test_coefficients_at_fifty_digits(k: float) -> None:
    """By the integral that defines them (trapezoids of a periodic function converge at once)."""
    count = 4000 if k < 1.1 else 600
    points = [2 * MP.pi * i / count for i in range(count)]
    values = [exact(p, MP.mpf(k)) for p in points]
    found = sc.fourier(k, harmonics=12)
    assert found.shape == (8,)
    for index, harmonic in enumerate((0, 1, 2, 4, 6, 8, 10, 12)):
        cosines = (MP.cos(harmonic * p) for p in points)
        total = MP.fsum(v * c for v, c in zip(values, cosines, strict=True)) / count
        wanted = total if harmonic == 0 else 2 * total
        assert abs(found[index] - wanted) <= LAST_BIT * abs(wanted) + MP.mpf("1e-40"), harmonic


@pytest.mark.parametrize("k", [1.05, 1.2, *RATIOS, 100.0])
@pytest.mark.parametrize("terms", [0, 1, 2, 3, 4, 5, 6, 20])
def test_coefficients_of_few_terms_in_fractions(k: float, terms: int) -> None:
    """By the powers of the sine that are kept, in whole numbers."""
    found = sc.fourier(k, harmonics=12, terms=terms)
    for n in range(7):
        inner = sum(
            Fraction(math.comb(2 * m, m) * math.comb(2 * m, m - n), (2 * m - 1) * 16**m)
            / Fraction(k) ** (2 * m - 1)
            for m in range(max(n, 1), terms + 1)
        )
        wanted = 1 + inner if n == 0 else (-1) ** n * 2 * inner
        got = Fraction(float(found[0 if n == 0 else n + 1]))
        assert abs(got - wanted) <= Fraction(LAST_BIT) * abs(wanted), n


@pytest.mark.parametrize("k", RATIOS)
def test_errors_of_the_series_fall_at_their_rates(k: float) -> None:
    """By 1/k² a term, and by (k − √(k² − 1))² a harmonic."""
    phi = np.linspace(0.0, np.pi, 181)
    s = sc.stroke(phi, 1.0, k).value

    def error(harmonics: int, terms: int | None) -> float:
        series = sc.stroke(phi, 1.0, k, method="series", harmonics=harmonics, terms=terms)
        return float(np.abs(series.value - s).max())

    by_harmonic = [error(2 * n, None) for n in range(1, 9)]
    rate = (k - math.sqrt(k * k - 1)) ** 2
    printed = {1.5: 0.1459, 3.0: 0.02944, 5.0: 0.01021}
    assert k not in printed or abs(rate - printed[k]) < 6e-5 * 10 ** -(k > 2)
    for a, b in itertools.pairwise(by_harmonic):
        if b > 1e-14:
            assert 0.5 * rate < b / a < 1.1 * rate
    by_term = [error(2 * n, n) for n in range(1, 9)]
    for a, b in itertools.pairwise(by_term):
        if b > 1e-14:
            assert 0.3 / k**2 < b / a < 1.0 / k**2
    assert error(200 if k < 2 else 60, None) < 1e-14


def test_approximate_formulas() -> None:
    """(14), (15), (16), and their greatest errors."""
    phi = np.linspace(0.0, 2 * np.pi, 20001)
    for k, wanted in ((3.0, (0.004906, 0.006421, 0.020220)), (5.0, (0.001021, 0.001329, 0.004124))):
        short, whole = sc.stroke(phi, 1.0, k, method="series"), sc.stroke(phi, 1.0, k)
        formula = 1 + 1 / (4 * k) - np.cos(phi) - np.cos(2 * phi) / (4 * k)
        np.testing.assert_allclose(short.value, formula, atol=1e-15)
        np.testing.assert_allclose(short.d1, np.sin(phi) + np.sin(2 * phi) / (2 * k), atol=1e-15)
        np.testing.assert_allclose(short.d2, np.cos(phi) + np.cos(2 * phi) / k, atol=2e-15)
        pairs = ((short.value, whole.value), (short.d1, whole.d1), (short.d2, whole.d2))
        for (a, b), error in zip(pairs, wanted, strict=True):
            assert math.isclose(np.abs(a - b).max(), error, abs_tol=6e-7)


def test_greatest_speed_printed() -> None:
    degrees = {
        3: (73.175297, 73.693451, 71.565051),
        4: (76.720978, 77.012124, 75.963757),
        5: (79.100135, 79.272357, 78.690068),
        6: (80.782779, 80.891045, 80.537678),
    }
    speeds = {
        3: (1.054639547, 1.049600431, 1.054092553),
        4: (1.030882699, 1.029166485, 1.030776406),
        5: (1.019833080, 1.019100606, 1.019803903),
    }
    for k, wanted in degrees.items():
        for method, angle in zip(("exact", "series", "perpendicular"), wanted, strict=True):
            found = sc.greatest_speed(float(k), method=method)  # type: ignore[arg-type]
            assert abs(math.degrees(found.q) - angle) < 6e-7
            if k in speeds:
                value = speeds[k][("exact", "series", "perpendicular").index(method)]
                assert abs(found.value - value) < 6e-10
    many = sc.greatest_speed(np.array(RATIOS))
    # Stationary to the last digits.
    assert np.abs(sc.stroke(many.q, 1.0, np.array(RATIOS)).d2).max() < 1e-15


def test_greatest_acceleration() -> None:
    limit = (3 + math.sqrt(21)) / 2
    value, at = sc.greatest_acceleration(3.0)
    assert abs(math.degrees(at) - 137.612519) < 6e-7
    assert abs(value + 0.697525367) < 6e-10
    for k in (limit, 4.0, 9.0):
        value, at = sc.greatest_acceleration(k)
        assert at == math.pi
        assert value == pytest.approx(-(1 - 1 / k), abs=1e-15)
    # Just before, the summit leaves the dead point.
    assert 3.0 < sc.greatest_acceleration(limit - 0.01).q < math.pi


def test_errata_of_the_vector_paper() -> None:
    """(29) lacks the rod's term; (5) has a wrong sign; the stroke runs to 2 cranks."""
    l1, l2, w, phi = 0.11, 0.407, 31.0, 0.7
    x, rod = sc.coordinate(phi, l1, l2), sc.rod_angle(phi, l1, l2)
    assert abs(float(x.acceleration(w)) + 86.313406) < 6e-7
    f2, w2 = float(rod.value), w * float(rod.d1)
    printed = -l1 * w**2 * math.cos(phi - f2) / math.cos(f2)
    assert abs(printed + 68.810417) < 6e-7
    right = -(l1 * w**2 * math.cos(phi - f2) + l2 * w2**2) / math.cos(f2)
    assert math.isclose(right, float(x.acceleration(w)), rel_tol=1e-14)
    # (5) with the sign corrected is (7), (23), (25).
    delta, rate = -f2, -w2
    speed = l1 * (w * math.sin(phi) + (l2 / l1) * math.sin(delta) * rate)
    assert math.isclose(speed, float(sc.stroke(phi, l1, l2).velocity(w)), rel_tol=1e-14)
    assert math.isclose(-speed, float(x.velocity(w)), rel_tol=1e-14)
    assert math.isclose(float(sc.stroke(math.pi, l1, l2).value), 2 * l1, rel_tol=1e-15)
    # (36), (37), (41), (42): by analogues, with crank acceleration.
    e = 5.0
    f22 = (l1 * math.sin(phi) + l2 * float(rod.d1) ** 2 * math.sin(f2)) / (l2 * math.cos(f2))
    assert math.isclose(float(rod.d2), f22, rel_tol=1e-13)
    assert math.isclose(
        float(rod.acceleration(w, e)), w**2 * f22 + e * float(rod.d1), rel_tol=1e-13
    )
    s3 = l1 * math.sin(f2 - phi) / math.cos(f2)
    assert math.isclose(float(x.d1), s3, rel_tol=1e-14)
    # "Dropping A6 keeps the fifth digit": from k = 3 on.
    assert abs(sc.fourier(3.0)[4]) < 1e-5 < abs(sc.fourier(2.0)[4])
    assert abs(abs(sc.fourier(2.0)[4]) - 9.0e-5) < 6e-6
    # Not harmonic: A2 is 8.6 % of A1.
    assert abs(sc.fourier(3.0)[2] / sc.fourier(3.0)[1] - 0.0858) < 5e-5
    assert math.isclose(np.abs(sc.rod_angle(np.pi / 2, 1.0, 3.0).value), math.asin(1 / 3))


def test_a_point_of_the_rod_at_fifty_digits() -> None:
    k, a, b = MP.mpf(3), MP.mpf(1), MP.mpf("0.25")

    def position(p: Any) -> tuple[Any, Any]:
        d = MP.asin(MP.sin(p) / k)
        x = MP.cos(p) + a * MP.cos(d) + b * MP.sin(d)
        return x, MP.sin(p) - a * MP.sin(d) + b * MP.cos(d)

    found = sc.rod_point(0.7, 1.0, 3.0, 1.0, 0.25)
    for i in range(2):
        for order, got in enumerate((found.value, found.d1, found.d2)):
            wanted = MP.diff(lambda p, i=i: position(p)[i], MP.mpf(0.7), order)
            assert abs(got[i] - wanted) < 1e-15


# λ, approximation: per cent of the stroke and where, of the velocity analogue and where.
RELATIVE = {
    (3, 1): ((0.472502, 73.69), (0.948717, 127.64)),
    (3, 2): ((0.013217, 80.51), (0.029660, 117.89)),
    (3, 3): ((0.000381, 83.29), (0.000945, 113.06)),
    (5, 1): ((0.106528, None), (0.178290, None)),
    (5, 2): ((0.001027, None), (0.001975, None)),
    (5, 3): ((1.02e-5, None), (2.20e-5, None)),
}
ABSOLUTE = {
    (3, 1): 0.020220,
    (3, 2): 9.003e-4,
    (3, 3): 3.551e-5,
    (5, 1): 0.004124,
    (5, 2): 6.334e-5,
    (5, 3): 8.633e-7,
}


def last_digit(value: float, digits: int) -> float:
    """Half a unit of the last of so many digits, and a little."""
    return 0.51 * 10.0 ** (math.floor(math.log10(value)) + 1 - digits)


def test_largest_deviations_printed() -> None:
    for (k, n), pairs in RELATIVE.items():
        for quantity, (percent, degrees) in zip(("stroke", "d1"), pairs, strict=True):
            found = sc.deviation(1 / k, n, quantity=quantity)  # type: ignore[arg-type]
            allowed = 6e-7 if percent > 1e-4 else 6e-8
            assert abs(100 * found.relative - percent) < allowed, (k, n, quantity)
            if degrees is not None:
                assert abs(math.degrees(found.relative_at) - degrees) < 6e-3
    for (k, n), size in ABSOLUTE.items():
        found = sc.deviation(1 / k, n, quantity="d2")
        assert abs(found.absolute - size) < last_digit(size, 4 if (k, n) != (3, 1) else 5)
        assert np.isnan(found.relative)
        assert abs(math.degrees(found.absolute_at) - 90.0) < 1e-4
    # The paper's 0.022 % is the extreme of 0-90° only.
    phi = np.linspace(1e-3, np.pi / 2, 20001)
    near = sc.stroke(phi, 1.0, 3.0, method="fraction", n=2).d1 / sc.stroke(phi, 1.0, 3.0).d1 - 1
    worst = int(np.abs(near).argmax())
    assert abs(100 * abs(near[worst]) - 0.021751) < 6e-7
    assert abs(math.degrees(phi[worst]) - 65.61) < 6e-3


@pytest.mark.parametrize("n", [1, 2, 3, 6, 12])
@pytest.mark.parametrize("k", RATIOS)
def test_the_fraction_at_fifty_digits(k: float, n: int) -> None:
    lam = MP.mpf(1.0 / k)
    found = sc.stroke(ANGLES, 1.0 / k, 1.0, method="fraction", n=n)
    for i, phi in enumerate(ANGLES):
        turns = abs(float(phi)) * 2.3e-16
        for order, got in enumerate((found.value, found.d1, found.d2)):
            wanted = MP.diff(lambda p: by_fraction(p, lam, n), MP.mpf(float(phi)), order)
            assert abs(got[i] * k - wanted) <= 2 * EXACT + 2 * turns, (phi, order)
    # What is lacking, where it is less than any rounding too.
    size = sc.deviation(1.0 / k, n)
    at = MP.mpf(float(size.absolute_at))
    with MP.workdps(150):
        wanted = exact(at, 1 / lam) - by_fraction(at, lam, n)
    assert math.isclose(size.absolute, float(wanted), rel_tol=1e-11)


@pytest.mark.parametrize("k", RATIOS)
def test_errors_of_the_fraction_fall_by_tan2(k: float) -> None:
    """Each approximation is too small, and each order gains tan²(δ/2)."""
    rate = math.tan(0.5 * math.asin(1 / k)) ** 2
    printed = {3.0: 0.02944, 5.0: 0.01021}
    assert k not in printed or abs(rate - printed[k]) < 6e-6
    for quantity in ("stroke", "d1", "d2"):
        sizes = [sc.deviation(1 / k, n, quantity=quantity).absolute for n in range(1, 9)]
        for a, b in itertools.pairwise(sizes):
            assert b / a < 3 * rate if quantity != "stroke" else b / a <= rate * (1 + 1e-9)
    phi = np.linspace(0.0, np.pi, 91)
    s = sc.stroke(phi, 1.0, k).value
    assert (sc.stroke(phi, 1.0, k, method="fraction", n=1).value <= s + 1e-15).all()


def test_both_papers_agree() -> None:
    """(5) of the second is (14) of the first, but for its constant; (10) is (15)."""
    phi = np.linspace(0.0, 6.0, 61)
    a = sc.stroke(phi, 2.0, 7.0, method="fraction", n=1)
    b = sc.stroke(phi, 2.0, 7.0, method="series")
    for mine, other in ((a.value, b.value), (a.d1, b.d1), (a.d2, b.d2)):
        np.testing.assert_allclose(mine, other, atol=4e-15)


def test_closed_contour() -> None:
    corners = sc.contour(1.0, 0.11, 0.407)
    assert corners.shape == (4, 2)
    sides = np.hypot(*np.diff(corners, axis=0).T)
    np.testing.assert_allclose(sides[:2], [0.11, 0.407], rtol=1e-15)
    np.testing.assert_array_equal(corners[0], corners[-1])


def test_shapes_broadcast() -> None:
    s = sc.stroke(np.zeros(5), np.ones((3, 1)), 2.0)
    assert s.value.shape == s.d2.shape == (3, 5)
    assert sc.fourier(np.full((2, 3), 4.0), harmonics=8).shape == (2, 3, 6)
    assert sc.rod_point(np.zeros(4), 1.0, 2.0, np.ones((2, 1))).d1.shape == (2, 4, 2)
    assert sc.deviation([0.2, 0.3], 2).relative.shape == (2,)


@pytest.mark.parametrize(
    ("call", "kind", "words"),
    [
        (lambda: sc.stroke(0.1, 2.0, 1.0), assur.DimensionError, "rod is 1.0, not longer"),
        (lambda: sc.stroke(0.1, 1.0, 1.0), assur.DimensionError, "k = 1"),
        (lambda: sc.stroke(0.1, -1.0, 1.0), assur.DimensionError, "crank is -1.0"),
        (lambda: sc.stroke(0.1, 1.0, [2.0, 0.0]), assur.DimensionError, "rod is 0.0"),
        (lambda: sc.stroke(math.nan, 1.0, 2.0), assur.InputError, "phi is nan"),
        (lambda: sc.stroke(0.1, 1.0, math.inf), assur.InputError, "rod is inf"),
        (lambda: sc.stroke(0.1, 1.0, 2.0, method="best"), assur.InputError, "method"),  # type: ignore[arg-type]
        (lambda: sc.stroke(0.1, 1.0, 2.0, method="fraction", n=0), assur.InputError, "n is 0"),
        (lambda: sc.stroke([1, 2], [1, 2, 3], 4.0), assur.InputError, "broadcast"),
        (lambda: sc.fourier(1.0), assur.InputError, "k > 1"),
        (lambda: sc.fourier(3.0, harmonics=5), assur.InputError, "even"),
        (lambda: sc.fourier(3.0, harmonics=4, terms=-1), assur.InputError, "terms is -1"),
        (lambda: sc.fourier(1.0 + 1e-12), assur.InputError, "do not end"),
        (lambda: sc.deviation(1.2, 2), assur.InputError, "below 1"),
        (lambda: sc.deviation(0.2, 2, quantity="d3"), assur.InputError, "quantity"),  # type: ignore[arg-type]
        (lambda: sc.greatest_speed(0.5), assur.InputError, "k is 0.5"),
        (lambda: sc.contour(np.zeros(2), 1.0, 2.0), assur.InputError, "one position"),  # type: ignore[arg-type]
    ],
)
def test_bad_input_is_refused(call: Any, kind: type[Exception], words: str) -> None:
    with pytest.raises(kind, match=words):
        call()
