"""Places of names: of sixteen about a point, the one farthest from lines and other names."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur._arrays import Float

PLACES = 16
# Between a symbol and its name, points.
GAP = 3.0
# A name in motion stays until another place is better by so much.
WORSE = 4.5
# Beyond this distance nothing is better for being farther.
ENOUGH = 14.0
# What a place that is not above or right of its point loses: reading habits, in points.
HABIT = 1.5
# How much worse it is to cover a line, or a name or joint, than a light line.
ON_LINE, ON_NAME = 4.0, 12.0


def placed(
    points: Float,
    sizes: Float,
    radius: Float,
    obstacles: Float,
    bounds: tuple[Float, Float],
    others: Float | None = None,
    light: Float | None = None,
) -> Float:
    """Return the middles of names' boxes: see `chosen`."""
    return chosen(points, sizes, radius, obstacles, bounds, others, light)[0]


def chosen(
    points: Float,
    sizes: Float,
    radius: Float,
    obstacles: Float,
    bounds: tuple[Float, Float],
    others: Float | None = None,
    light: Float | None = None,
    kept: npt.NDArray[np.intp] | None = None,
) -> tuple[Float, npt.NDArray[np.intp]]:
    """Return the middles of names' boxes, and which of the places each has taken.

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
    others : ndarray, optional
        (k, 2, 2): middles and halves of boxes that are there already.
    light : ndarray, optional
        (l, 2): points along light lines, which a box covers rather than anything else.
    kept : ndarray, optional
        (n,), the places taken before: a name moves only where it is clearly better off.

    Returns
    -------
    middles : ndarray
        (n, 2). All lengths are in the same unit.
    places : ndarray
        (n,).
    """
    angles = np.arange(PLACES) * (2.0 * np.pi / PLACES) + np.pi / 4.0
    directions = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    habit = HABIT * (1.0 - directions.sum(axis=1) / np.sqrt(2.0)) / 2.0
    middles, taken_places = np.empty_like(points), np.zeros(len(points), dtype=np.intp)
    taken = [] if others is None else [(middle, half) for middle, half in others]
    for i, (point, size) in enumerate(zip(points, sizes, strict=True)):
        half = size / 2.0
        # The box touches a circle about the point.
        gap = radius[i] + GAP
        centres = point + directions * (gap + np.abs(directions) @ half)[:, None]
        near = gap + 2.0 * size.max() + ENOUGH
        clearance = _clearance(centres, half, _within(obstacles, point, near), ON_LINE)
        if light is not None:
            faint = _clearance(centres, half, _within(light, point, near))
            clearance = np.minimum(clearance, faint)
        border = np.minimum(centres - half - bounds[0], bounds[1] - centres - half).min(axis=1)
        clearance = np.minimum(clearance, np.where(border < 0.0, ON_NAME * border, border))
        for other, own in taken:
            apart = np.abs(centres - other) - half - own
            gaps = np.maximum(apart[:, 0], apart[:, 1])
            clearance = np.minimum(clearance, np.where(gaps < 0.0, ON_NAME * gaps, gaps))
        rest = np.delete(points, i, axis=0)
        if len(rest):
            joints = _clearance(centres, half, rest, ON_NAME) - radius.max()
            clearance = np.minimum(clearance, joints)
        worth = np.minimum(clearance, ENOUGH) - habit
        best = int(np.argmax(worth))
        if kept is not None and worth[kept[i]] > worth[best] - WORSE:
            best = int(kept[i])
        middles[i], taken_places[i] = centres[best], best
        taken.append((centres[best], half))
    return middles, taken_places


def _within(points: Float, of: Float, reach: float) -> Float:
    near: Float = points[(np.abs(points - of) < reach).all(axis=1)]
    return near


def _clearance(centres: Float, half: Float, obstacles: Float, weight: float = 1.0) -> Float:
    """Return the distance of each box from the nearest obstacle, negative inside, by a weight."""
    if not len(obstacles):
        return np.full(len(centres), np.inf)
    apart = np.abs(obstacles[None] - centres[:, None]) - half
    outside = np.hypot(*np.moveaxis(np.maximum(apart, 0.0), -1, 0))
    inside = weight * np.minimum(apart.max(axis=-1), 0.0)
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
