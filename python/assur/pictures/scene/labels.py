"""Places of names: of sixteen about a point, the one farthest from lines and other names."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from assur._arrays import Float

PLACES = 16
# Beyond this distance nothing is better for being farther.
ENOUGH = 14.0
# What a place that is not above or right of its point loses: reading habits, in points.
HABIT = 1.5


def placed(
    points: Float,
    sizes: Float,
    radius: Float,
    obstacles: Float,
    bounds: tuple[Float, Float],
    reach: float = 3.0,
) -> Float:
    """Return the middles of names' boxes.

    Parameters
    ----------
    points : ndarray
        (n, 2), what the names belong to.
    sizes : ndarray
        (n, 2), width and height of their boxes.
    radius : ndarray
        (n,), of the symbols at the points.
    obstacles : ndarray
        (m, 2): points along lines and outlines, no farther apart than about half a box.
    bounds : (ndarray, ndarray)
        Corners of the picture, which the boxes stay within.
    reach : float
        Gap between the symbol and the box.

    Returns
    -------
    ndarray
        (n, 2). All lengths are in the same unit.
    """
    angles = np.arange(PLACES) * (2.0 * np.pi / PLACES) + np.pi / 4.0
    directions = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    habit = HABIT * (1.0 - directions.sum(axis=1) / np.sqrt(2.0)) / 2.0
    middles = np.empty_like(points)
    taken: list[tuple[Float, Float]] = []
    for i, (point, size) in enumerate(zip(points, sizes, strict=True)):
        half = size / 2.0
        # The box touches a circle about the point.
        gap = radius[i] + reach
        centres = point + directions * (gap + np.abs(directions) @ half)[:, None]
        near = obstacles[(np.abs(obstacles - point) < gap + 2.0 * size.max() + ENOUGH).all(axis=1)]
        clearance = _clearance(centres, half, near)
        border = np.minimum(centres - half - bounds[0], bounds[1] - centres - half).min(axis=1)
        clearance = np.minimum(clearance, border)
        for other, own in taken:
            apart = np.abs(centres - other) - half - own
            clearance = np.minimum(clearance, np.maximum(apart[:, 0], apart[:, 1]))
        others = np.delete(points, i, axis=0)
        if len(others):
            clearance = np.minimum(clearance, _clearance(centres, half, others) - radius.max())
        best = int(np.argmax(np.minimum(clearance, ENOUGH) - habit))
        middles[i] = centres[best]
        taken.append((centres[best], half))
    return middles


def _clearance(centres: Float, half: Float, obstacles: Float) -> Float:
    """Return the distance of each box from the nearest obstacle, negative inside."""
    if not len(obstacles):
        return np.full(len(centres), np.inf)
    apart = np.abs(obstacles[None] - centres[:, None]) - half
    outside = np.hypot(*np.moveaxis(np.maximum(apart, 0.0), -1, 0))
    inside = np.minimum(apart.max(axis=-1), 0.0)
    distance: Float = (outside + inside).min(axis=1)
    return distance


def along(polylines: list[Float], step: float) -> Float:
    """Return points along lines, no farther apart than a step, (m, 2)."""
    starts = np.concatenate([np.zeros((0, 2)), *(line[:-1] for line in polylines)])
    ends = np.concatenate([np.zeros((0, 2)), *(line[1:] for line in polylines)])
    known = np.isfinite(starts).all(axis=1) & np.isfinite(ends).all(axis=1)
    starts, ends = starts[known], ends[known]
    counts = np.ceil(np.hypot(*(ends - starts).T) / step).astype(int) + 1
    first = np.repeat(np.cumsum(counts) - counts, counts)
    parts = (np.arange(len(first)) - first) / np.repeat(np.maximum(counts - 1, 1), counts)
    whole: Float = np.repeat(starts, counts, axis=0)
    points: Float = whole + parts[:, None] * np.repeat(ends - starts, counts, axis=0)
    return points
