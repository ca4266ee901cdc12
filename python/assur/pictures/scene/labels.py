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
# A name in motion stays until another place is better by this.
WORSE = 4.5
# Beyond this distance nothing is better for being farther.
ENOUGH = 14.0
# Cost of a place that is not above or right of its point: reading habits, in points.
HABIT = 1.5
# How much worse it is to cover a line, or a name or joint, than a light line.
ON_LINE, ON_NAME = 4.0, 12.0


def placed(
    points: Float,
    sizes: Float,
    radius: Float,
    obstacles: Float,
    bounds: tuple[Float, Float],
    taken: Float | None = None,
    light: Float | None = None,
) -> Float:
    """Return the middles of names' boxes: see `chosen`."""
    return chosen(points, sizes, radius, obstacles, bounds, taken, light)[0]


def chosen(
    points: Float,
    sizes: Float,
    radius: Float,
    obstacles: Float,
    bounds: tuple[Float, Float],
    taken: Float | None = None,
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
    taken : ndarray, optional
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
    count = len(points)
    middles, places = np.empty_like(points), np.zeros(count, dtype=np.intp)
    boxes = np.zeros((0, 2, 2)) if taken is None else taken
    # One row per obstacle: its middle, half its size, and the cost of covering it.
    symbols = np.column_stack([points, np.full((count, 2), radius.max()), np.full(count, ON_NAME)])
    things = np.concatenate(
        [
            _rows(obstacles, ON_LINE),
            _rows(light if light is not None else points[:0], 1.0),
            np.column_stack([boxes.reshape(-1, 4), np.full(len(boxes), ON_NAME)]),
            symbols,
            np.empty((count, 5)),
        ]
    )
    first = len(things) - 2 * count
    for i, (point, size) in enumerate(zip(points, sizes, strict=True)):
        half = size / 2.0
        # The box touches a circle about the point.
        gap = radius[i] + GAP
        centres = point + directions * (gap + np.abs(directions) @ half)[:, None]
        known = things[: first + count + i]
        near = (np.abs(known[:, :2] - point) < gap + size + known[:, 2:4] + ENOUGH).all(axis=1)
        near[first + i] = False
        clear = _clearance(centres, half, known[near])
        border = within(centres, half, bounds)
        clear = np.minimum(clear, np.where(border < 0.0, ON_NAME * border, border))
        worth = np.minimum(clear, ENOUGH) - habit
        best = int(np.argmax(worth))
        if kept is not None and worth[kept[i]] > worth[best] - WORSE:
            best = int(kept[i])
        middles[i], places[i] = centres[best], best
        things[first + count + i] = (*centres[best], *half, ON_NAME)
    return middles, places


def _rows(points: Float, weight: float) -> Float:
    """Return points as things in the way."""
    rows = np.zeros((len(points), 5))
    rows[:, :2], rows[:, 4] = points, weight
    return rows


def clearance(centres: Float, half: Float, points: Float) -> Float:
    """Return the distance of each box from the nearest of points, negative inside."""
    return _clearance(centres, half, _rows(points, 1.0))


def _clearance(centres: Float, half: Float, things: Float) -> Float:
    """Return the distance of each box from the nearest thing, negative inside, by its weight."""
    if not len(things):
        return np.full(len(centres), np.inf)
    dx = np.abs(things[:, 0] - centres[:, :1]) - (things[:, 2] + half[0])
    dy = np.abs(things[:, 1] - centres[:, 1:]) - (things[:, 3] + half[1])
    inside = things[:, 4] * np.minimum(np.maximum(dx, dy), 0.0)
    outside = np.sqrt(np.maximum(dx, 0.0) ** 2 + np.maximum(dy, 0.0) ** 2)
    distance: Float = (outside + inside).min(axis=1)
    return distance


def within(centres: Float, half: Float, bounds: tuple[Float, Float]) -> Float:
    """Return how far each box is inside a frame, negative outside."""
    inside: Float = np.minimum(centres - half - bounds[0], bounds[1] - centres - half).min(axis=1)
    return inside


def along(polylines: list[Float], step: float, bounds: tuple[Float, Float] | None = None) -> Float:
    """Return points along lines, no farther apart than a step, (m, 2).

    With `bounds`, the corners of a picture, only those in or near it.
    """
    starts = np.concatenate([np.zeros((0, 2)), *(line[:-1] for line in polylines)])
    ends = np.concatenate([np.zeros((0, 2)), *(line[1:] for line in polylines)])
    known = np.isfinite(starts).all(axis=1) & np.isfinite(ends).all(axis=1)
    starts, ends = starts[known], ends[known]
    if bounds is not None:
        starts, ends = _cut(starts, ends, *bounds)
    return between(starts, ends, step)


def _cut(starts: Float, ends: Float, low: Float, high: Float) -> tuple[Float, Float]:
    """Return the parts of segments within a frame with as much again on each side.

    Lines may go far beyond a picture, by a million times its width.
    """
    low, high = 2.0 * low - high, 2.0 * high - low
    way = ends - starts
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        sides = np.stack([(low - starts) / way, (high - starts) / way])
    # Parallel to a side: all of it or nothing.
    inside = (starts >= low) & (starts <= high)
    first = np.where(way == 0.0, np.where(inside, 0.0, 2.0), sides.min(axis=0)).max(axis=1)
    last = np.where(way == 0.0, 1.0, sides.max(axis=0)).min(axis=1)
    first, last = np.maximum(first, 0.0), np.minimum(last, 1.0)
    seen = first <= last
    starts, way, first, last = starts[seen], way[seen], first[seen, None], last[seen, None]
    whole = (first == 0.0) & (last == 1.0)
    return starts + first * way, np.where(whole, ends[seen], starts + last * way)


def between(starts: Float, ends: Float, step: float) -> Float:
    """Return points along segments, no farther apart than a step, (m, 2)."""
    counts = np.ceil(np.hypot(*(ends - starts).T) / step).astype(int) + 1
    first = np.repeat(np.cumsum(counts) - counts, counts)
    parts = (np.arange(len(first)) - first) / np.repeat(np.maximum(counts - 1, 1), counts)
    whole: Float = np.repeat(starts, counts, axis=0)
    points: Float = whole + parts[:, None] * np.repeat(ends - starts, counts, axis=0)
    return points
