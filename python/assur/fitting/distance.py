"""How far a curve is from a path: polylines, in the path's frame."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from assur._arrays import Float

# Samples of a path at equal distances along it.
SAMPLES = 1000
# Points that are compared in order, at every shift.
ORDERED = 256
# Pairs of a point and a segment at once: their arrays fit a cache.
PAIRS = 1 << 14


class Nearest(NamedTuple):
    """The nearest places of a polyline: distances, segments, and where on these."""

    distance: Float
    segment: Float
    part: Float


def nearest(points: Float, line: Float) -> Nearest:
    """Return the place of a polyline (K, 2) that is nearest to each of some points (P, 2)."""
    start, (x, y) = line[:-1].T, np.diff(line, axis=0).T
    square = x * x + y * y
    # What has no length is its start.
    over = np.divide(1.0, square, out=np.zeros_like(square), where=square > 0.0)
    found = []
    step = max(1, PAIRS // len(x))
    for first in range(0, len(points), step):
        # Arrays of one component each: sums over a short axis are slow.
        off_x, off_y = (
            own[first : first + step, np.newaxis] - begins
            for own, begins in zip(points.T, start, strict=True)
        )
        part = np.clip((off_x * x + off_y * y) * over, 0.0, 1.0)
        off_x -= part * x
        off_y -= part * y
        away = off_x * off_x + off_y * off_y
        best = away.argmin(axis=1)
        rows = np.arange(len(best))
        found.append((np.sqrt(away[rows, best]), best, part[rows, best]))
    return Nearest(*map(np.concatenate, zip(*found, strict=True)))


def lengths_along(line: Float) -> Float:
    """Return the distance along a polyline of each of its corners."""
    steps = np.sqrt((np.diff(line, axis=0) ** 2).sum(axis=1))
    return np.concatenate([[0.0], np.cumsum(steps)])


def resampled(line: Float, count: int) -> Float:
    """Return points at equal distances along a polyline, both ends among them."""
    along = lengths_along(line)
    wanted = np.linspace(0.0, along[-1], count)
    return np.stack([np.interp(wanted, along, line[:, axis]) for axis in range(2)], axis=-1)


def chamfer(curve: Float, path: Float, samples: int = SAMPLES) -> float:
    """Return the mean nearest distance from path to curve plus that from curve to path.

    Means are over lengths: of the curve (N, 2) by the trapezoidal rule, of the path by samples.
    """
    along = lengths_along(curve)
    away = nearest(curve, path).distance
    steps = np.diff(along)
    back = float((0.5 * steps * (away[1:] + away[:-1])).sum())
    # A curve that stands still is a point.
    from_curve = back / along[-1] if along[-1] > 0.0 else away[0]
    there = nearest(resampled(path, samples), curve).distance
    from_path = float((0.5 * (there[1:] + there[:-1])).mean())
    return float(from_curve) + from_path


def ordered(curve: Float, path: Float, is_closed: bool) -> float:
    """Return 2π times the mean squared distance of points in order, at equal parts of both lengths.

    In the better direction; of a closed path at the best of all shifts.
    """
    count = ORDERED + 1 if is_closed else ORDERED
    one, other = resampled(curve, count), resampled(path, count)
    if is_closed:
        one, other = one[:-1], other[:-1]
    shifts = range(ORDERED) if is_closed else (0,)
    means = [
        ((np.roll(way, shift, axis=0) - other) ** 2).sum(axis=1).mean()
        for way in (one, one[::-1])
        for shift in shifts
    ]
    return 2.0 * np.pi * float(min(means))
