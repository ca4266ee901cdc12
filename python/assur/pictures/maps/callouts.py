"""Texts beside points and lines of a chart, clear of lines and of each other."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.pictures.chart import TEXT
from assur.pictures.points import bounds, in_data, in_points, text_box
from assur.pictures.scene.labels import along, placed, within
from assur.pictures.text import STEP, plain_size, printable

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur._arrays import Float

# Number of points along a line beside which its text may stand.
CANDIDATES = 48
# About a text, points.
PAD = 1.0
# About texts that others make room for, px: when they are drawn they may be a little larger.
CLEAR = 2.0


def _write(ax: Any, text: str, middle: Float, colour: Any, gid: str) -> Any:
    """Write a text with its middle at a place, points."""
    x, y = in_data(ax, middle)
    return ax.text(
        x, y, printable(text), color=colour, fontsize=TEXT, ha="center", va="center", zorder=5.0,
        gid=gid, parse_math=False,
    )  # fmt: skip


def _covered(texts: Sequence[Any]) -> list[Float]:
    """Return lines that fill the boxes of texts, points."""
    lines = []
    for text in texts:
        (x0, y0), (x1, y1) = text_box(text)
        lines += [np.array([[x0, y], [x1, y]]) for y in (y0, (y0 + y1) / 2.0, y1)]
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
    widths = np.array([plain_size(text, TEXT) for text in texts]) + PAD
    covered = [*(in_points(ax, line) for line in lines), *_covered(avoid)]
    obstacles = along(covered, STEP)
    printed = in_points(ax, points)
    middles = placed(printed, widths, np.full(len(printed), size / 2.0), obstacles, bounds(ax))
    return [
        _write(ax, text, middle, colour, gid) for text, middle in zip(texts, middles, strict=True)
    ]


def write_along(
    ax: Any,
    texts: Sequence[str],
    lines: Sequence[Float],
    colours: Sequence[Any],
    gids: Sequence[str],
    further: Sequence[Float] = (),
    avoid: Sequence[Any] = (),
) -> list[Any]:
    """Write a text beside each line where there is most room; lines are in data."""
    drawn = [in_points(ax, line) for line in lines]
    obstacles = along([*drawn, *(in_points(ax, line) for line in further), *_covered(avoid)], STEP)
    frame = bounds(ax)
    written = []
    for text, line, colour, gid in zip(texts, drawn, colours, gids, strict=True):
        known = line[np.isfinite(line).all(axis=1)]
        known = known[((known >= frame[0]) & (known <= frame[1])).all(axis=1)]
        if not len(known):
            continue
        few = known[np.unique(np.linspace(0, len(known) - 1, CANDIDATES).astype(int))]
        box = np.array(plain_size(text, TEXT)) + PAD
        best, room = None, -np.inf
        for point in few:
            middle = placed(point[None], box[None], np.zeros(1), obstacles, frame)[0]
            apart = (np.abs(obstacles - middle) - box / 2.0).max(axis=1).min(initial=np.inf)
            clear = min(float(apart), float(within(middle[None], box / 2.0, frame)[0]))
            if clear > room:
                best, room = middle, clear
        assert best is not None
        written.append(_write(ax, text, best, colour, gid))
        edge = np.array([[-0.5, 0.0], [0.5, 0.0]]) * box
        obstacles = np.vstack([obstacles, along([best + edge], STEP)])
    return written


def clear_of(ax: Any, texts: Sequence[Any], gid: str) -> None:
    """Remove texts of a name that lie on others or on one another, or leave the axes."""
    taken = [text.get_window_extent().padded(CLEAR) for text in texts]
    low, high = ax.bbox.get_points()
    for text in [written for written in ax.texts if written.get_gid() == gid]:
        box = text.get_window_extent()
        leaves = (box.min < low).any() or (box.max > high).any()
        if leaves or any(box.overlaps(kept) for kept in taken):
            text.remove()
        else:
            taken.append(box)
