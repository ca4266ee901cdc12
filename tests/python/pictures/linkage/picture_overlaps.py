"""Which texts of a picture lie on its lines, symbols or other texts."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import PathPatch
from matplotlib.textpath import TextPath

# What of a text's ink may be under a line's edge, px: less is not seen.
SEEN = 0.5


def ink(text: Any) -> np.ndarray[Any, Any]:
    """Return the box of a text's outlines as they are drawn, px: (low, high)."""
    outline = TextPath((0, 0), text.get_text(), prop=text.get_fontproperties()).get_extents()
    per_point = text.figure.dpi / 72.0
    box = np.array([outline.min, outline.max]) * per_point
    anchor = text.get_transform().transform(text.get_position())
    window = text.get_window_extent()
    # Horizontally the layout is centred, or starts at the anchor; vertically it has its baseline.
    shift = {
        "center": anchor[0] - box[:, 0].mean(),
        "left": anchor[0],
        "right": anchor[0] - box[1, 0],
    }[text.get_horizontalalignment()]
    rise = {
        "baseline": anchor[1],
        "top": window.y1 - box[1, 1],
        "center": (window.y0 + window.y1) / 2.0 - box[:, 1].mean(),
        "center_baseline": anchor[1] - box[1, 1] / 2.0,
        "bottom": window.y0 - box[0, 1],
    }[text.get_verticalalignment()]
    return np.asarray(box + np.array([shift, rise]))


def segments(ax: Any, light: bool) -> list[tuple[np.ndarray[Any, Any], float]]:
    """Return the drawn lines as points, px, each with half its width."""
    per_point = ax.figure.dpi / 72.0
    found: list[tuple[np.ndarray[Any, Any], float]] = []
    for artist in ax.get_children():
        gid = artist.get_gid() or ""
        if not light and gid.startswith(("position", "trace")):
            continue
        if isinstance(artist, PathPatch) and artist.get_linewidth() > 1.0:
            path = artist.get_transform().transform_path(artist.get_path())
            half = artist.get_linewidth() * per_point / 2.0
            found += [(np.asarray(line), half) for line in path.to_polygons(closed_only=False)]
        elif isinstance(artist, Line2D) and artist.get_gid():
            points = artist.get_transform().transform(artist.get_xydata())
            if artist.get_marker() == "o":
                radius = artist.get_markersize() * per_point / 2.0
                found += [(np.array([point, point]), radius) for point in points]
            else:
                found.append((points, artist.get_linewidth() * per_point / 2.0))
    return found


def overlapping(ax: Any, light: bool = True) -> tuple[list[str], int]:
    """Return the texts that lie on a line, a symbol or another text, and the number of texts."""
    texts = [text for text in ax.texts if text.get_text()]
    boxes = [ink(text) for text in texts]
    lines = segments(ax, light)
    starts = np.concatenate([points[:-1] for points, _ in lines])
    ends = np.concatenate([points[1:] for points, _ in lines])
    halves = np.concatenate([np.full(len(points) - 1, half) for points, half in lines])
    bad = []
    for i, (text, box) in enumerate(zip(texts, boxes, strict=True)):
        on_text = any(
            (np.minimum(box[1], other[1]) - np.maximum(box[0], other[0]) > SEEN).all()
            for j, other in enumerate(boxes)
            if j != i
        )
        if on_text or _crosses(box, starts, ends, halves - SEEN).any():
            bad.append(text.get_text())
    return bad, len(texts)


def _crosses(
    box: np.ndarray[Any, Any],
    starts: np.ndarray[Any, Any],
    ends: np.ndarray[Any, Any],
    halves: np.ndarray[Any, Any],
) -> np.ndarray[Any, Any]:
    """Whether each segment meets the box, grown by half its width (Liang and Barsky's clipping)."""
    low, high = box[0] - halves[:, None], box[1] + halves[:, None]
    along = ends - starts
    with np.errstate(divide="ignore", invalid="ignore"):
        one, other = (low - starts) / along, (high - starts) / along
    within = (starts >= low) & (starts <= high)
    enter = np.where(along == 0.0, np.where(within, -np.inf, np.inf), np.minimum(one, other))
    leave = np.where(along == 0.0, np.where(within, np.inf, -np.inf), np.maximum(one, other))
    return np.asarray(np.maximum(enter.max(axis=1), 0.0) <= np.minimum(leave.min(axis=1), 1.0))
