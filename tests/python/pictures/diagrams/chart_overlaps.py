"""Which texts of a diagram lie on a curve or on another text, by what is drawn."""

from __future__ import annotations

from itertools import combinations
from typing import Any

import numpy as np


def texts(ax: Any) -> list[Any]:
    return [text for text in ax.texts if text.get_text()]


def overlapping(figure: Any) -> tuple[int, list[str]]:
    """Return the number of texts in all axes, and those that overlap."""
    figure.canvas.draw()
    renderer = figure.canvas.get_renderer()
    count, bad = 0, []
    for ax in figure.axes:
        boxes = [(text, text.get_window_extent(renderer)) for text in texts(ax)]
        count += len(boxes)
        curves = [
            ax.transData.transform(np.column_stack([np.asarray(x, float) for x in line.get_data()]))
            for line in ax.lines
            if str(line.get_gid()).startswith(("curve", "tangent"))
        ]
        for text, box in boxes:
            for curve in curves:
                points = dense(curve)
                points = points[((points > ax.bbox.min) & (points < ax.bbox.max)).all(axis=1)]
                inside = (points > box.min + 1.0).all(axis=1) & (points < box.max - 1.0).all(axis=1)
                if inside.any():
                    bad.append(f"{text.get_text()!r} on a curve")
                    break
        for (one, a), (other, b) in combinations(boxes, 2):
            if a.padded(-1.0).overlaps(b.padded(-1.0)):
                bad.append(f"{one.get_text()!r} on {other.get_text()!r}")
    return count, bad


def dense(curve: Any) -> Any:
    """Return points along a curve, at most two px apart."""
    known = np.isfinite(curve).all(axis=1)
    pairs = known[:-1] & known[1:]
    starts, ends = curve[:-1][pairs], curve[1:][pairs]
    steps = int(np.clip(np.abs(ends - starts).max(initial=2.0) / 2.0, 1.0, 500.0)) + 1
    parts = np.linspace(0.0, 1.0, steps)[:, None, None]
    return (starts + parts * (ends - starts)).reshape(-1, 2)
