"""Own sine, cosine, arc tangent and arc sine against 50 digits, over the whole range of doubles.

The bounds are those that rust/core/src/math/trig.rs states, in units in the last place of the
exact value rounded to a double.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import mpmath  # type: ignore[import-untyped]
import numpy as np
import numpy.typing as npt
import pytest

from assur import _core

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

SIN_COS_ULP = 0.9
ATAN2_ULP = 1.7
ASIN_ULP = 1.3
UNIT_ANGLE_ULP = 3.2
# More, in parts of what the length of the vector is off by.
UNIT_ANGLE_PER_LENGTH = 0.42
# Where the reduction of sines and cosines changes: 2^21 π/2, rounded down.
FEW_TURNS = 3294198.0

Float = npt.NDArray[np.float64]
MP = mpmath.MPContext()
MP.dps = 50
SIZE = 3000
TINY = 5e-324
MAX = np.finfo(float).max
HARDEST = 6381956970095103.0 * 2.0**797


def rng(name: str) -> np.random.Generator:
    return np.random.default_rng(list(name.encode()))


def signed(size: Float, seed: str) -> Float:
    """With random signs."""
    signs: Float = rng(seed).choice([-1.0, 1.0], size.shape)
    return signs * size


def of_exponents(low: int, high: int, seed: str, count: int = SIZE) -> Float:
    """Random doubles, exponents evenly between 2^low and 2^high, subnormals included."""
    random = rng(seed)
    numbers = np.ldexp(random.uniform(1.0, 2.0, count), random.integers(low, high, count))
    return signed(numbers, seed + "signs")


def around(value: float, count: int = 50) -> Float:
    """The doubles next to it on both sides."""
    at = np.float64(value).view(np.int64)
    return (at + np.arange(-count, count + 1)).view(np.float64)


def near_multiples() -> Float:
    """The doubles nearest to k π/2: the first ones, some others, and the nearest of all."""
    first, second, third = parts_of_half_pi()
    k = np.arange(1.0, 2**21 + 1)
    x = k * (np.pi / 2)
    # k times the first two parts is exact.
    apart = ((k * first - x) + k * second) + k * third
    x += apart
    apart = ((k * first - x) + k * second) + k * third
    hardest = np.argsort(np.abs(apart))[:SIZE]
    some = rng("multiples").integers(0, k.size, SIZE)
    return signed(x[np.concatenate([np.arange(SIZE), some, hardest])], "multiples")


def parts_of_half_pi() -> tuple[float, float, float]:
    """π/2 in two parts of at most 32 bits and the rest."""
    half = MP.pi / 2
    first = float(MP.floor(half * 2**30) / 2**30)
    second = float(MP.floor((half - first) * 2**64) / 2**64)
    return first, second, float(half - first - second)


def hardest_of_each_exponent() -> Float:
    """Of m 2^e, m < 2^53, the nearest to a multiple of π/2, for each e from 0 on.

    Its m is a denominator of the continued fraction of 2^e / (π/2).
    """
    bits = 2400
    with MP.workprec(bits + 50):
        half_pi = int(MP.floor(MP.pi / 2 * MP.mpf(2) ** bits))
    found = [HARDEST]
    for exponent in range(971):
        numerator, denominator = half_pi, (2**exponent << bits) % half_pi
        before, m = 1, 0
        while (following := before + numerator // denominator * m) < 2**53:
            before, m = m, following if m else 1
            numerator, denominator = denominator, numerator % denominator
        found.append(float(m) * 2.0**exponent)
    return signed(np.array(found), "hardest")


def ulps(got: Float, exact: Iterable[Any]) -> Float:
    errors = []
    for value, right in zip(got.tolist(), exact, strict=True):
        unit = np.spacing(abs(float(right)))
        errors.append(float(abs(value - right) / MP.mpf(unit)))
    return np.array(errors)


ANGLES: dict[str, Callable[[], Float]] = {
    "all exponents": lambda: of_exponents(-1074, 1024, "all"),
    "usual exponents": lambda: of_exponents(-10, 22, "usual"),
    "first eighth of a turn": lambda: rng("eighth").uniform(-0.8, 0.8, SIZE),
    "turn": lambda: rng("turn").uniform(-2 * np.pi, 2 * np.pi, SIZE),
    "many turns": lambda: rng("many").uniform(-FEW_TURNS, FEW_TURNS, SIZE),
    "far": lambda: rng("far").uniform(-1e9, 1e9, SIZE),
    "near multiples": near_multiples,
    "eighths of turns": lambda: (
        (rng("eighths").integers(-(2**21), 2**21, SIZE) + 0.5) * np.pi / 2
        + rng("beside").normal(0.0, 1e-2, SIZE)
    ),
    "where the reduction changes": lambda: np.concatenate(
        [s * around(x) for s in (-1, 1) for x in (FEW_TURNS, 2.0**20, 2.0**21 * np.pi / 2)]
    ),
    "hardest": hardest_of_each_exponent,
    "ends": lambda: np.array([TINY, -TINY, 2.0**-1022, MAX, -MAX, HARDEST, -HARDEST]),
}


@pytest.mark.parametrize("name", ANGLES)
def test_sin_cos(name: str) -> None:
    x = ANGLES[name]()
    sin, cos = _core.sin_cos(x)
    exact = [MP.cos_sin(MP.mpf(value)) for value in x.tolist()]
    assert ulps(sin, (pair[1] for pair in exact)).max() < SIN_COS_ULP
    assert ulps(cos, (pair[0] for pair in exact)).max() < SIN_COS_ULP


def polar(angle: Float) -> tuple[Float, Float]:
    radius = of_exponents(-3, 3, "radius", angle.size)
    return radius * np.sin(angle), radius * np.cos(angle)


def same_exponent() -> tuple[Float, Float]:
    """Quotients that are not extreme, of coordinates that may be; many are subnormal."""
    random = rng("same")
    exponents = np.concatenate(
        [random.integers(-1074, 1023, SIZE), random.integers(-1074, -1000, SIZE)]
    )
    y, x = (np.ldexp(random.uniform(1.0, 2.0, exponents.size), exponents) for _ in range(2))
    return signed(y, "same y"), signed(x, "same x")


POINTS: dict[str, Callable[[], tuple[Float, Float]]] = {
    "all exponents": lambda: (of_exponents(-1074, 1024, "y"), of_exponents(-1074, 1024, "x")),
    "usual exponents": lambda: (of_exponents(-6, 6, "y"), of_exponents(-6, 6, "x")),
    "same exponent": same_exponent,
    "turn": lambda: polar(rng("turn").uniform(-np.pi, np.pi, 2 * SIZE)),
    "near eighths of turns": lambda: polar(
        rng("eighths").integers(-4, 5, SIZE) * np.pi / 4 + of_exponents(-50, -3, "beside")
    ),
    # There the quotient's ulp is twice that of the angle.
    "under powers of two": lambda: polar(
        2.0 ** rng("powers").integers(-10, 1, SIZE) * (1 - np.abs(of_exponents(-40, -6, "under")))
    ),
    "subnormal angles": lambda: (of_exponents(-1074, -1000, "y"), of_exponents(0, 40, "x")),
}


@pytest.mark.parametrize("name", POINTS)
def test_atan2(name: str) -> None:
    y, x = POINTS[name]()
    pairs = zip(y.tolist(), x.tolist(), strict=True)
    exact = [MP.atan2(MP.mpf(b), MP.mpf(a)) for b, a in pairs]
    assert ulps(_core.atan2(y, x), exact).max() < ATAN2_ULP


TURNS: dict[str, Callable[[], Float]] = {
    "turn": lambda: rng("turn").uniform(-np.pi, np.pi, 4 * SIZE),
    "near sixteenths of turns": lambda: (
        rng("sixteenths").integers(-8, 9, SIZE) * np.pi / 8 + of_exponents(-50, -3, "beside")
    ),
    "small": lambda: of_exponents(-1074, -1, "small"),
    "about half a turn": lambda: np.pi - of_exponents(-60, -2, "half a turn"),
}


@pytest.mark.parametrize("name", TURNS)
def test_unit_angle(name: str) -> None:
    angle = TURNS[name]()
    y, x = np.sin(angle), np.cos(angle)
    points = [(MP.mpf(b), MP.mpf(a)) for b, a in zip(y.tolist(), x.tolist(), strict=True)]
    exact = [MP.atan2(b, a) for b, a in points]
    unit = np.spacing(np.abs([float(right) for right in exact]))
    off = np.array([float(abs(MP.hypot(b, a) - 1)) for b, a in points])
    errors = ulps(_core.unit_angle(y, x), exact)
    assert (errors < UNIT_ANGLE_ULP + UNIT_ANGLE_PER_LENGTH * off / unit).all()


def test_unit_angle_of_axes() -> None:
    one, zero, nan = 1.0, 0.0, np.nan
    x = np.array([one, one, -one, -one, zero, zero, nan])
    y = np.array([zero, -zero, zero, -zero, one, -one, nan])
    found, half = _core.unit_angle(y, x), np.pi / 2
    np.testing.assert_array_equal(found, [0.0, 0.0, np.pi, -np.pi, half, -half, nan])
    np.testing.assert_array_equal(np.signbit(found[:2]), [False, True])


SINES: dict[str, Callable[[], Float]] = {
    "all exponents": lambda: of_exponents(-1074, 0, "sines"),
    "usual": lambda: rng("usual").uniform(-1.0, 1.0, SIZE),
    "above the half": lambda: signed(rng("half").uniform(0.5, 0.51, SIZE), "half"),
    "next to the half": lambda: np.concatenate([around(0.5), around(-0.5)]),
    "next to one": lambda: signed(1.0 - np.abs(of_exponents(-53, -2, "one")), "one"),
    "ends": lambda: np.array([1.0, -1.0, TINY, -TINY, 2.0**-1022]),
}


@pytest.mark.parametrize("name", SINES)
def test_asin(name: str) -> None:
    x = SINES[name]()
    exact = [MP.asin(MP.mpf(value)) for value in x.tolist()]
    assert ulps(_core.asin(x), exact).max() < ASIN_ULP


def test_zeros_infinities_and_nan() -> None:
    zero, inf, nan = 0.0, np.inf, np.nan
    sin, cos = _core.sin_cos(np.array([zero, -zero, inf, -inf, nan]))
    np.testing.assert_array_equal(sin, [zero, -zero, nan, nan, nan])
    np.testing.assert_array_equal(np.signbit(sin[:2]), [False, True])
    np.testing.assert_array_equal(cos, [1.0, 1.0, nan, nan, nan])

    special = np.array([zero, -zero, TINY, -TINY, 1.0, -1.0, MAX, -MAX, inf, -inf, nan])
    y, x = (a.ravel() for a in np.meshgrid(special, special))
    got, expected = _core.atan2(y, x), np.arctan2(y, x)
    np.testing.assert_array_equal(np.signbit(got[got == 0.0]), np.signbit(expected[got == 0.0]))
    np.testing.assert_allclose(got, expected, rtol=4e-16, atol=0.0)

    arc = _core.asin(np.array([zero, -zero, 1.0, -1.0, np.nextafter(1.0, 2.0), -2.0, inf, nan]))
    np.testing.assert_array_equal(arc, [zero, -zero, np.pi / 2, -np.pi / 2, nan, nan, nan, nan])
    np.testing.assert_array_equal(np.signbit(arc[:2]), [False, True])


def test_bits_do_not_depend_on_the_neighbours() -> None:
    """Eight at a time, one at a time (fewer than eight), and next to others."""
    count = 8 * 7 * 40
    x = of_exponents(-30, 60, "neighbours", count)
    y = of_exponents(-30, 60, "others", count)
    x[::50], x[::51], x[::53] = np.inf, np.nan, MAX
    sevens = np.arange(count).reshape(-1, 7)
    shuffled = rng("shuffled").permutation(count)
    functions: list[Callable[[npt.NDArray[np.intp]], Float]] = [
        lambda i: _core.sin_cos(x[i])[0],
        lambda i: _core.sin_cos(x[i])[1],
        lambda i: _core.atan2(y[i], x[i]),
        lambda i: _core.asin(np.clip(x[i], -1.0, 1.0)),
    ]
    for function in functions:
        together = function(np.arange(count))
        alone = np.concatenate([function(row) for row in sevens])
        np.testing.assert_array_equal(alone, together)
        np.testing.assert_array_equal(function(shuffled), together[shuffled])
