"""Texts beside points and lines of a chart, clear of lines and of each other."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.font_manager import FontProperties

from assur.pictures.chart import TEXT
from assur.pictures.scene.labels import along, placed
from assur.pictures.text import STEP, text_size

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur._arrays import Float

# Of points along a line beside which its text may stand.
CANDIDATES = 48
# About a text, points.
PAD = 1.0


def _points(ax: Any, data: Float) -> Float:
    """Return data in points of print; the axes are laid out."""
    own: Float = ax.transData.transform(data) * 72.0 / ax.get_figure(root=True).dpi
    return own


def _bounds(ax: Any) -> tuple[Float, Float]:
    box = ax.get_window_extent()
    per = 72.0 / ax.get_figure(root=True).dpi
    return np.array([box.x0, box.y0]) * per, np.array([box.x1, box.y1]) * per


def _write(ax: Any, text: str, middle: Float, colour: Any, gid: str) -> Any:
    """Write a text with its middle at a place, points."""
    x, y = ax.transData.inverted().transform(middle * ax.get_figure(root=True).dpi / 72.0)
    return ax.text(
        x, y, text, color=colour, fontsize=TEXT, ha="center", va="center", zorder=5.0,
        gid=gid, parse_math=False,
    )  # fmt: skip


def boxes(texts: Sequence[Any]) -> list[Any]:
    """Return the extents of texts, px."""
    return [text.get_window_extent() for text in texts]


def _covered(ax: Any, texts: Sequence[Any]) -> list[Float]:
    """Return lines that fill the boxes of texts, points."""
    per = 72.0 / ax.get_figure(root=True).dpi
    lines = []
    for box in boxes(texts):
        middle = (box.y0 + box.y1) / 2.0
        lines += [np.array([[box.x0, y], [box.x1, y]]) * per for y in (box.y0, middle, box.y1)]
    return lines


def write_beside(
    ax: Any,
    texts: Sequence[str],
    points: Float,
    size: float,
    colour: Any,
    gid: str,
    lines: Sequence[Float] = (),
    avoid: Sequence[Any] = (),
) -> list[Any]:
    """Write texts beside points, clear of lines (all in data) and of other texts."""
    if not len(texts):
        return []
    font = FontProperties(size=TEXT)
    widths = np.array([text_size(text, font) for text in texts]) + PAD
    covered = [*(_points(ax, line) for line in lines), *_covered(ax, avoid)]
    obstacles = along(covered, STEP)
    own = _points(ax, points)
    middles = placed(own, widths, np.full(len(own), size / 2.0), obstacles, _bounds(ax))
    return [
        _write(ax, text, middle, colour, gid) for text, middle in zip(texts, middles, strict=True)
    ]


def write_along(
    ax: Any,
    texts: Sequence[str],
    lines: Sequence[Float],
    colours: Sequence[Any],
    gids: Sequence[str],
    others: Sequence[Float] = (),
    avoid: Sequence[Any] = (),
) -> list[Any]:
    """Write a text beside each line where there is most room; lines are in data."""
    font = FontProperties(size=TEXT)
    drawn = [_points(ax, line) for line in lines]
    obstacles = along([*drawn, *(_points(ax, line) for line in others), *_covered(ax, avoid)], STEP)
    bounds = _bounds(ax)
    written = []
    for text, line, colour, gid in zip(texts, drawn, colours, gids, strict=True):
        known = line[np.isfinite(line).all(axis=1)]
        known = known[((known >= bounds[0]) & (known <= bounds[1])).all(axis=1)]
        if not len(known):
            continue
        few = known[np.unique(np.linspace(0, len(known) - 1, CANDIDATES).astype(int))]
        box = np.array(text_size(text, font)) + PAD
        best, room = None, -np.inf
        for point in few:
            middle = placed(point[None], box[None], np.zeros(1), obstacles, bounds)[0]
            apart = (np.abs(obstacles - middle) - box / 2.0).max(axis=1).min(initial=np.inf)
            border = np.minimum(middle - bounds[0], bounds[1] - middle) - box / 2.0
            clear = min(float(apart), float(border.min()))
            if clear > room:
                best, room = middle, clear
        assert best is not None
        written.append(_write(ax, text, best, colour, gid))
        edge = np.array([[-0.5, 0.0], [0.5, 0.0]]) * box
        obstacles = np.vstack([obstacles, along([best + edge], STEP)])
    return written


def clear_of(ax: Any, texts: Sequence[Any], gid: str) -> None:
    """Remove texts of a name that lie on others or on one another, or leave the axes."""
    taken = boxes(texts)
    frame = ax.get_window_extent()
    for text in [one for one in ax.texts if one.get_gid() == gid]:
        box = text.get_window_extent()
        leaves = box.x0 < frame.x0 or box.x1 > frame.x1 or box.y0 < frame.y0 or box.y1 > frame.y1
        if leaves or any(box.overlaps(other) for other in taken):
            text.remove()
        else:
            taken.append(box)
