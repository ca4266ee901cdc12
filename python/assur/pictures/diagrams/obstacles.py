"""What texts of a diagram avoid: its curves, marks and other texts."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.pictures.chart import MARK
from assur.pictures.points import bounds, in_points, per_px, text_box
from assur.pictures.scene.labels import along, between
from assur.pictures.text import STEP

if TYPE_CHECKING:
    from assur._arrays import Float


def obstacles(ax: Any) -> Float:
    """Return points along all curves and about all texts of a diagram, points of print."""
    low, high = bounds(ax)
    lines: list[Float] = []
    segments = [np.zeros((2, 0, 2))]
    for line in ax.lines:
        if str(line.get_gid()).startswith(("zero", "event")):
            # Texts may cover them.
            continue
        points = np.column_stack(
            [np.asarray(column, dtype=np.float64) for column in line.get_data()]
        )
        if line.get_transform() != ax.transData:
            # A level or a place all across the axes.
            points = line.get_transform().transform(points) * per_px(ax)
        else:
            points = in_points(ax, points)
        if line.get_linestyle() == "None":
            lines.extend(outline(point, MARK / 2.0 + 1.0) for point in points)
            continue
        segments.append(_within(points, low, high))
    boxes = [_text_lines(text) for text in ax.texts if text.get_text()]
    starts, ends = np.concatenate(segments, axis=1)
    curves = between(starts, ends, STEP)
    return np.concatenate([curves, along([*lines, *boxes], STEP)])


def _within(points: Float, low: Float, high: Float) -> Float:
    """Return the starts and ends of a line's segments within a box, (2, n, 2)."""
    known: Any = np.isfinite(points).all(axis=1)
    pairs = known[:-1] & known[1:]
    starts, ends = points[:-1][pairs], points[1:][pairs]
    span = ends - starts
    with np.errstate(divide="ignore", invalid="ignore"):
        parts = np.sort(np.array([low - starts, high - starts]) / span, axis=0)
    inside = (starts >= low) & (starts <= high)
    # A segment along an axis is within its limits all the way or nowhere.
    first = np.where(span == 0.0, np.where(inside, 0.0, 2.0), parts[0]).max(axis=1).clip(0.0)
    last = np.where(span == 0.0, np.where(inside, 1.0, -1.0), parts[1]).min(axis=1).clip(max=1.0)
    kept = first <= last
    starts, span = starts[kept], span[kept]
    return np.array([starts + first[kept, None] * span, starts + last[kept, None] * span])


def outline(middle: Float, half: float | Float) -> Float:
    """Return the closed outline of a box."""
    corners = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]])
    return middle + half * corners


def _text_lines(text: Any) -> Float:
    """Return the outline of a text and the line through its middle."""
    low, high = text_box(text)
    middle, half = (low + high) / 2.0, (high - low) / 2.0
    return np.vstack(
        [outline(middle, half), middle - half * (1.0, 0.0), middle + half * (1.0, 0.0)]
    )
