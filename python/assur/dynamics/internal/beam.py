"""A link as a beam: normal force, shear and bending moment as polynomials between loads."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from assur._search import bisected

if TYPE_CHECKING:
    from collections.abc import Iterator

    from assur._arrays import Float

QUANTITIES = ("axial", "shear", "moment")
# Halvings from a cell to a neighbouring number.
HALVINGS = 60
# Values computed at once: some milliseconds.
PART = 1 << 16


class Density(NamedTuple):
    """Mass per length at nodes along a beam, linear between them: (K,) each, m and kg/m."""

    x: Float
    value: Float

    def integrals(self) -> tuple[float, float, float]:
        """Return mass, place of its centre, and moment of inertia about it."""
        h = np.diff(self.x)
        left, right = self.value[:-1], self.value[1:]
        mass = (h * (left + right)).sum() / 2.0
        first = (h * h * (left + 2.0 * right) / 6.0 + self.x[:-1] * h * (left + right) / 2.0).sum()
        centre = first / mass if mass > 0.0 else 0.0
        # About the centre, cell by cell, so that nothing cancels.
        a = self.x[:-1] - centre
        zeroth, once = h * (left + right) / 2.0, h * h * (left + 2.0 * right) / 6.0
        twice = h * h * h * (left + 3.0 * right) / 12.0
        return float(mass), float(centre), float((a * a * zeroth + 2.0 * a * once + twice).sum())

    def within(self, edges: Float) -> tuple[Float, Float]:
        """Return the density just right of the left edges of cells, and its slope in them."""
        cell = np.searchsorted(self.x, edges[:, :-1], side="right") - 1
        cell = np.minimum(cell, self.x.size - 2)
        length, rise = np.diff(self.x), np.diff(self.value)
        slope = np.divide(rise, length, out=np.zeros(rise.shape), where=length > 0.0)[cell]
        return self.value[cell] + slope * (edges[:, :-1] - self.x[cell]), slope


class PointLoad(NamedTuple):
    """Force along and across a beam, and couple, at a place x: (P,) each."""

    x: Float
    along: Float
    across: Float
    couple: Float


class Beam(NamedTuple):
    """Polynomials of the three quantities in cells between loads, at P positions.

    Attributes
    ----------
    edges : ndarray
        Where cells begin and end, (P, cells + 1), m.
    coefficients : dict of str to ndarray
        Coefficients of powers of the distance from a cell's left edge, (P, cells, 5), by quantity.
    end : ndarray
        What is left of the quantities beyond the last load, (P, 3): 0 in equilibrium.
    """

    edges: Float
    coefficients: dict[str, Float]
    end: Float

    def at(self, quantity: str, x: Float) -> Float:
        """Return a quantity at places x, (n,), as (P, n): at a load just beyond it."""
        positions = self.edges.shape[0]
        values = np.empty((positions, x.size))
        # In parts: NumPy hears no signal within an operation.
        for of_x in _parts(x.size, PART):
            for rows in _parts(positions, max(1, PART // x[of_x].size)):
                values[rows, of_x] = self._part(quantity, rows, x[of_x])
        return values

    def _part(self, quantity: str, rows: slice, x: Float) -> Float:
        """Return a quantity at some of the positions."""
        edges, coefficients = self.edges[rows], self.coefficients[quantity][rows]
        inner = edges[:, 1:-1, np.newaxis]
        cell = np.minimum((x >= inner).sum(axis=1), edges.shape[1] - 2)
        each = np.arange(edges.shape[0])[:, np.newaxis]
        return _value(coefficients[each, cell], x - edges[each, cell])

    def extremes(self, quantity: str) -> tuple[Float, Float, Float, Float]:
        """Return the least value and its place, the greatest and its place, (P,) each."""
        coefficients = self.coefficients[quantity]
        length = np.diff(self.edges)
        places = [np.zeros(length.shape), length, *_stationary(coefficients, length)]
        t = np.stack(places, axis=-1)
        values = _value(coefficients[:, :, np.newaxis], t).reshape(
            t.shape[0], t.shape[1] * t.shape[2]
        )
        x = (self.edges[:, :-1, np.newaxis] + t).reshape(values.shape)
        rows = np.arange(values.shape[0])
        low, high = np.argmin(values, axis=1), np.argmax(values, axis=1)
        return values[rows, low], x[rows, low], values[rows, high], x[rows, high]


def solve_beam(
    length: float, density: Density, axial: Float, across: Float, loads: list[PointLoad]
) -> Beam:
    """Return the loads inside a beam of a given motion.

    N′ = μ (a − g)·e, V′ = μ (a − g)·n, M′ = −V; at a load F with a couple C, N falls by F·e, V by
    F·n, and M by C.

    Parameters
    ----------
    length : float
        m.
    density : Density
        Its first node is at 0, its last at `length`.
    axial, across : ndarray
        (a − g)·e and (a − g)·n at x = 0, and their slopes by x, (P, 2).
    loads : list of PointLoad
        All forces at places from 0 to `length`.
    """
    positions = axial.shape[0]
    nodes = np.broadcast_to(density.x[:-1], (positions, density.x.size - 1))
    starts = np.concatenate([nodes, *(load.x[:, np.newaxis] for load in loads)], axis=1)
    # No cell begins at the far end, so loads there are in no cell.
    starts = np.sort(np.where(starts < length, starts, 0.0), axis=1)
    edges = np.concatenate([starts, np.full((positions, 1), length)], axis=1)
    jumps = np.zeros((3, positions, edges.shape[1]))
    rows = np.arange(positions)
    for load in loads:
        cell = (edges < load.x[:, np.newaxis]).sum(axis=1)
        for jump, size in zip(jumps, (load.along, load.across, load.couple), strict=True):
            jump[rows, cell] -= size
    h = np.diff(edges)
    mass, slope = density.within(edges)
    start = edges[:, :-1]
    empty = np.zeros((*h.shape, 5))
    coefficients = {name: empty.copy() for name in QUANTITIES}
    for name, rate in (("axial", axial), ("shear", across)):
        first = rate[:, :1] + rate[:, 1:] * start
        rows_of = coefficients[name]
        rows_of[..., 1] = mass * first
        rows_of[..., 2] = (mass * rate[:, 1:] + slope * first) / 2.0
        rows_of[..., 3] = slope * rate[:, 1:] / 3.0
    end = np.empty((positions, 3))
    for k, name in enumerate(QUANTITIES):
        rows_of = coefficients[name]
        if name == "moment":
            rows_of[..., 1:] = -coefficients["shear"][..., :-1] / np.arange(1.0, 5.0)
        whole = _value(rows_of, h)
        # Loads at the left edge of a cell count in it.
        before = np.cumsum(
            np.concatenate([jumps[k][:, :1], whole + jumps[k][:, 1:]], axis=1), axis=1
        )
        rows_of[..., 0], end[:, k] = before[:, :-1], before[:, -1]
    return Beam(edges, coefficients, end)


def _parts(count: int, size: int) -> Iterator[slice]:
    return (slice(start, start + size) for start in range(0, count, size))


def _value(coefficients: Float, t: Float) -> Float:
    """Return polynomials, whose coefficients are on the last axis, by Horner's rule."""
    value = coefficients[..., -1] * np.ones(np.shape(t))
    for k in range(coefficients.shape[-1] - 2, -1, -1):
        value = value * t + coefficients[..., k]
    return value


def _slope(coefficients: Float) -> Float:
    rates: Float = coefficients[..., 1:] * np.arange(1.0, coefficients.shape[-1])
    return rates


def _stationary(coefficients: Float, length: Float) -> list[Float]:
    """Return where the slopes of polynomials of degree 4 vanish within (0, length).

    The slope is monotone between its own stationary points, which a quadratic gives; there halving
    finds its root to the last bit. A part without a root gives one of its ends.
    """
    slope = _slope(coefficients)
    first, second = _quadratic_roots(_slope(slope), length)
    turns = [np.zeros(length.shape), np.minimum(first, second), np.maximum(first, second), length]
    return [_halve(slope, a, b) for a, b in pairwise(turns)]


def _quadratic_roots(coefficients: Float, length: Float) -> tuple[Float, Float]:
    """Return the roots of c + b t + a t², kept within (0, length); 0 without real roots."""
    c, b, a = (coefficients[..., k] for k in range(3))
    with np.errstate(all="ignore"):
        root = np.sqrt(b * b - 4.0 * a * c)
        # Without cancellation: the product of both roots is c/a.
        half = -0.5 * (b + np.where(b >= 0.0, root, -root))
        both = half / a, c / half
    inside = [np.where((t > 0.0) & (t < length), t, 0.0) for t in both]
    return inside[0], inside[1]


def _halve(slope: Float, a: Float, b: Float) -> Float:
    """Return the root between a and b of polynomials that are monotone there; a without one."""
    at_a = _value(slope, a)
    has_root = (at_a * np.sign(_value(slope, b))) < 0.0
    low, high = bisected(lambda t: (_value(slope, t) > 0.0) == (at_a > 0.0), a, b, HALVINGS)
    return np.where(has_root, 0.5 * (low + high), a)
