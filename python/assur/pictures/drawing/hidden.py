"""Lines without what lies under circles and blocks drawn after them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from assur._arrays import Float

# A piece shorter than this fraction of its line is dropped.
SHORTEST = 1e-9


def outside_circle(pieces: Float, centre: Float, radius: float) -> Float:
    """Return segments (n, 2, 2) without what lies in a circle."""
    start, along = pieces[:, 0] - centre, pieces[:, 1] - pieces[:, 0]
    a = np.maximum((along * along).sum(axis=1), 1e-300)
    b = (start * along).sum(axis=1)
    c = (start * start).sum(axis=1) - radius**2
    root = np.sqrt(np.maximum(b * b - a * c, 0.0))
    enter, leave = (-b - root) / a, (-b + root) / a
    misses = b * b <= a * c
    return _without(pieces, np.where(misses, 2.0, enter), np.where(misses, 2.0, leave))


def outside_polygon(pieces: Float, corners: Float) -> Float:
    """Return segments without what lies in a convex polygon (Cyrus and Beck)."""
    edges = np.roll(corners, -1, axis=0) - corners
    inward = np.stack([-edges[:, 1], edges[:, 0]], axis=1)
    middle = corners.mean(axis=0)
    inward *= np.sign(((middle - corners) * inward).sum(axis=1))[:, None]
    along = pieces[:, 1] - pieces[:, 0]
    speed = along @ inward.T
    depth = np.stack(
        [
            ((pieces[:, 0] - corner) * n).sum(axis=1)
            for corner, n in zip(corners, inward, strict=True)
        ],
        axis=1,
    )
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        at = -depth / speed
    enter = np.where(speed > 0.0, at, -np.inf).max(axis=1)
    leave = np.where(speed < 0.0, at, np.inf).min(axis=1)
    parallel_outside = ((speed == 0.0) & (depth <= 0.0)).any(axis=1)
    misses = parallel_outside | (enter >= leave)
    return _without(pieces, np.where(misses, 2.0, enter), np.where(misses, 2.0, leave))


def _without(pieces: Float, enter: Float, leave: Float) -> Float:
    """Return segments without the part from `enter` to `leave`."""
    along = pieces[:, 1] - pieces[:, 0]
    enter, leave = np.clip(enter, 0.0, 1.0), np.clip(leave, 0.0, 1.0)
    untouched = enter >= leave
    before = (enter > SHORTEST) & ~untouched
    after = (leave < 1.0 - SHORTEST) & ~untouched
    cut_in = pieces[:, 0] + enter[:, None] * along
    cut_out = pieces[:, 0] + leave[:, None] * along
    return np.concatenate(
        [
            pieces[untouched],
            np.stack([pieces[before, 0], cut_in[before]], axis=1),
            np.stack([cut_out[after], pieces[after, 1]], axis=1),
        ]
    )
