"""An oracle for the flywheel of a machine in steady motion: mpmath, 50 digits, no closed forms.

Nothing here is fast and nothing is shared with the library.  A spline is the solution of one dense
system for all four coefficients of every piece; an extreme of the speed is a zero of the sign of
dω/dφ, found by sampling and bracketing; the flywheel is the root of a 2-D Newton iteration.
"""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import mpmath  # type: ignore[import-untyped]

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence


mp = mpmath.MPContext()  # a context of our own: no other test can change its precision
mp.dps = 50
mpf = mp.mpf
Number: TypeAlias = Any  # mpmath has no types
Function: TypeAlias = "Callable[[Number], Number]"
Ends = Literal["not-a-knot", "natural", "clamped", "periodic"]
Mean = Literal["extremes", "period"]


def powers(t: Number, order: int) -> list[Number]:
    """Return the derivative of (1, t, t², t³) of an order at t."""
    return [mp.ff(k, order) * t ** (k - order) if k >= order else mpf(0) for k in range(4)]


class Spline:
    """A C² cubic through a table, p_i(t) = Σ c[i][k] t^k with t = x − x_i on piece i.

    Parameters
    ----------
    x, y
        Knots, increasing, at least four; values ("periodic" wants the last equal to the first).
    ends
        The two conditions beside interpolation and C²; "clamped" is with zero slopes.
    """

    def __init__(self, x: Sequence[Number], y: Sequence[Number], ends: Ends) -> None:
        self.x = [mpf(v) for v in x]
        n, h = len(x) - 1, [b - a for a, b in pairwise(self.x)]
        rows: list[tuple[dict[int, list[Number]], Number]] = []
        for i in range(n):
            rows += [({i: powers(mpf(0), 0)}, mpf(y[i])), ({i: powers(h[i], 0)}, mpf(y[i + 1]))]
            if i + 1 < n:
                rows += [self._smooth(i, i + 1, h[i], order) for order in (1, 2)]
        if ends == "periodic":
            rows += [self._smooth(n - 1, 0, h[-1], order) for order in (1, 2)]
        elif ends == "not-a-knot":
            rows += [self._smooth(i, i + 1, h[i], 3) for i in (0, n - 2)]
        else:
            order = {"clamped": 1, "natural": 2}[ends]
            rows += [({i: powers(t, order)}, mpf(0)) for i, t in ((0, mpf(0)), (n - 1, h[-1]))]
        a, b = mp.zeros(4 * n), mp.zeros(4 * n, 1)
        for r, (blocks, right) in enumerate(rows):
            b[r] = right
            for i, block in blocks.items():
                for k in range(4):
                    a[r, 4 * i + k] = block[k]
        c = mp.lu_solve(a, b)
        self.c = [[c[4 * i + k] for k in range(4)] for i in range(n)]
        self.below = [mpf(0)]  # the integral up to each knot
        for i in range(n):
            self.below.append(self.below[i] + self._area(i, h[i]))

    @staticmethod
    def _smooth(i: int, j: int, h: Number, order: int) -> tuple[dict[int, list[Number]], Number]:
        return {i: powers(h, order), j: [-v for v in powers(mpf(0), order)]}, mpf(0)

    def _area(self, i: int, t: Number) -> Number:
        c = self.c[i]
        return t * (c[0] + t * (c[1] / 2 + t * (c[2] / 3 + t * c[3] / 4)))

    def _place(self, x: Number) -> tuple[int, Number]:
        i = min(max(bisect_right(self.x, x) - 1, 0), len(self.c) - 1)
        return i, x - self.x[i]

    def __call__(self, x: Number) -> Number:
        """Return the value at x; beyond the table the last piece goes on."""
        i, t = self._place(x)
        c = self.c[i]
        return c[0] + t * (c[1] + t * (c[2] + t * c[3]))

    def slope(self, x: Number) -> Number:
        """Return the first derivative at x."""
        i, t = self._place(x)
        c = self.c[i]
        return c[1] + t * (2 * c[2] + t * 3 * c[3])

    def integral(self, x: Number) -> Number:
        """Return the integral from the first knot to x, exact."""
        i, t = self._place(x)
        return self.below[i] + self._area(i, t)


@dataclass(frozen=True)
class Machine:
    """One turn of a machine: breaks of smoothness, excess moment, its work, inertia, its slope."""

    breaks: list[Number]
    excess: Function  # M + M_motor
    work: Function  # W, its integral from the first break
    inertia: Function
    slope: Function  # dI/dφ
    motor: Number  # the constant moment that balances the turn


@dataclass(frozen=True)
class Motion:
    """The extremes of the speed over a turn, where they occur, and the time of the turn."""

    flywheel: Number
    speed0: Number
    top: Number
    top_at: Number
    low: Number
    low_at: Number
    turn: Number

    def mean(self, kind: Mean) -> Number:
        """Return (max + min)/2 or 2π / T."""
        return (self.top + self.low) / 2 if kind == "extremes" else 2 * mp.pi / self.turn

    def delta(self, kind: Mean) -> Number:
        """Return (max − min) / mean, by the mean so named."""
        return (self.top - self.low) / self.mean(kind)


def from_table(
    x: Sequence[Number], m: Sequence[Number], inertia: Sequence[Number], ends: Ends
) -> Machine:
    """Return the machine of a table over one turn, x[0] to x[-1]; M_motor balances the moment."""
    s, i = Spline(x, m, ends), Spline(x, inertia, ends)
    motor = -s.integral(s.x[-1]) / (s.x[-1] - s.x[0])
    return Machine(
        s.x,
        lambda p: s(p) + motor,
        lambda p: s.integral(p) + motor * (p - s.x[0]),
        i,
        i.slope,
        motor,
    )


def omega(k: Machine, flywheel: Number, speed0: Number, phi: Number) -> Number:
    """Return the speed at phi from the integral of energy; ValueError where it would stop."""
    mass, mass0 = k.inertia(phi) + flywheel, k.inertia(k.breaks[0]) + flywheel
    square = (2 * k.work(phi) + mass0 * speed0**2) / mass
    if mass <= 0 or mass0 <= 0 or square <= 0:
        raise ValueError(f"no motion at {mp.nstr(phi, 8)} with I_f = {mp.nstr(flywheel, 8)}")
    return mp.sqrt(square)


def stationary(f: Function, breaks: Sequence[Number], samples: int = 24) -> list[Number]:
    """Return the breaks and every bracketed zero of f, the derivative, between them."""
    found = list(breaks)
    for a, b in pairwise(breaks):
        grid = [a + (b - a) * j / samples for j in range(samples + 1)]
        value = [f(p) for p in grid]
        for j in range(samples):
            if value[j] * value[j + 1] < 0:
                root = mp.findroot(f, (grid[j], grid[j + 1]), solver="illinois", tol=mpf(10) ** -80)
                found.append(root)
            elif value[j + 1] == 0:
                found.append(grid[j + 1])
    return found


def extremes(k: Machine, flywheel: Number, speed0: Number) -> tuple[Number, Number, Number, Number]:
    """Return max ω, its angle, min ω, its angle (the first of equals)."""
    c = (k.inertia(k.breaks[0]) + flywheel) * speed0**2

    def rate(p: Number) -> Number:  # the numerator of d(ω²)/dφ
        return 2 * k.excess(p) * (k.inertia(p) + flywheel) - (2 * k.work(p) + c) * k.slope(p)

    at = sorted(stationary(rate, k.breaks))
    speed = [omega(k, flywheel, speed0, p) for p in at]
    top, low = max(speed), min(speed)  # the ends of the turn are equal but for the last digits
    first = [
        next(p for p, w in zip(at, speed, strict=True) if mp.almosteq(w, v)) for v in (top, low)
    ]
    return top, first[0], low, first[1]


def turn_time(k: Machine, flywheel: Number, speed0: Number) -> Number:
    """Return T = ∮ dφ/ω, Gauss-Legendre on every piece."""
    total, error = mp.quad(
        lambda p: 1 / omega(k, flywheel, speed0, p), k.breaks, error=True, method="gauss-legendre"
    )
    if error > mpf(10) ** -38:
        raise ArithmeticError(f"turn time not resolved: {mp.nstr(error, 3)}")
    return total


def motion(k: Machine, flywheel: Number, speed0: Number) -> Motion:
    """Return the extremes and the time of the turn for a flywheel and a first speed."""
    f, w = mpf(flywheel), mpf(speed0)
    return Motion(f, w, *extremes(k, f, w), turn_time(k, f, w))


def work_range(k: Machine) -> Number:
    """Return ΔE = max W − min W over the turn."""
    work = [k.work(p) for p in stationary(k.excess, k.breaks)]
    return max(work) - min(work)


def solve(k: Machine, delta: Number, mean: Number, kind: Mean) -> Motion:
    """Return the motion with (max − min)/mean = delta and that mean, by a 2-D Newton iteration."""
    delta, mean = mpf(delta), mpf(mean)

    def residual(flywheel: Number, speed0: Number) -> list[Number]:
        top, _, low, _ = extremes(k, flywheel, speed0)
        if kind == "extremes":
            return [top - mean * (1 + delta / 2), low - mean * (1 - delta / 2)]
        return [
            top - low - delta * mean,
            turn_time(k, flywheel, speed0) * mean**2 - 2 * mp.pi * mean,
        ]

    # The start, right to first order in delta, from four points on every piece.
    grid = [a + (b - a) * j / 4 for a, b in pairwise(k.breaks) for j in range(4)]
    swing = [k.work(p) / mean**2 - k.inertia(p) / 2 for p in grid]
    mass = (max(swing) - min(swing)) / delta
    start = (
        mass - mp.fsum(map(k.inertia, grid)) / len(grid),
        mean * (1 - ((max(swing) + min(swing)) / 2 - swing[0]) / mass),
    )
    root = mp.findroot(residual, start, tol=mpf(10) ** -72)
    return motion(k, root[0], root[1])
