"""Outlines of links: convex hulls of their holes, offset, with arcs about the corners."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur.pictures.drawing.marks import THIN, Outline
from assur.pictures.scene.geometry import hull

if TYPE_CHECKING:
    from assur._arrays import Float

# How far a centre mark goes beyond its hole, relative to the hole's radius.
MARK = 1.6


def rounded_hull(layer: str, points: Float, radius: float) -> Outline:
    """Return the outline at a distance from the convex hull of points.

    One point gives a circle of two arcs, two a stadium.
    """
    span = np.ptp(points, axis=0)
    corners = points[hull(points)] if span.any() else points[:1]
    if len(corners) == 1:
        reach = np.array([radius, 0.0])
        ends = np.stack([corners[0] - reach, corners[0] + reach])
        return Outline(layer, ends, np.ones(2), closed=True)
    edges = np.roll(corners, -1, axis=0) - corners
    lengths = np.hypot(*edges.T)
    # The hull turns left: outside is on the right.
    normals = np.stack([edges[:, 1], -edges[:, 0]], axis=1) / lengths[:, None]
    before = np.roll(normals, 1, axis=0)
    turn = np.arctan2(
        before[:, 0] * normals[:, 1] - before[:, 1] * normals[:, 0], (before * normals).sum(axis=1)
    )
    # Where a stadium turns back rounding may say −180°.
    turn = np.where(turn < 0.0, turn + 2.0 * np.pi, turn)
    outline = np.stack([corners + radius * before, corners + radius * normals], axis=1)
    bulges = np.stack([np.tan(turn / 4.0), np.zeros(len(turn))], axis=1)
    return Outline(layer, outline.reshape(-1, 2), bulges.reshape(-1), closed=True)


def rectangle(layer: str, start: Float, end: Float, width: float) -> Outline:
    """Return a rectangle about the line from start to end."""
    along = end - start
    left = np.array([-along[1], along[0]]) / float(np.hypot(*along)) * width / 2.0
    return Outline(
        layer, np.stack([start - left, end - left, end + left, start + left]), closed=True
    )


def centre_mark(layer: str, centre: Float, radius: float) -> list[Outline]:
    """Return the two dash-dotted lines of a hole's centre."""
    reach = MARK * radius
    across, upward = np.array([reach, 0.0]), np.array([0.0, reach])
    return [
        Outline(layer, np.stack([centre - arm, centre + arm]), weight=THIN, dash_dotted=True)
        for arm in (across, upward)
    ]
