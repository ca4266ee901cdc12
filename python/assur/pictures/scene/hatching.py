"""Hatching as strokes: along a line, and inside an area."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from assur._arrays import Float

# Px of a hatching stroke across its line.
DEPTH = 7.0


def hatched_line(start: Float, end: Float, spacing: float, depth: float) -> Float:
    """Return strokes of hatching on the right of a line, (n, 2, 2)."""
    along = end - start
    length = float(np.hypot(*along))
    if not length:
        return np.zeros((0, 2, 2))
    unit = along / length
    right = np.array([unit[1], -unit[0]])
    # Each leans back from its foot by its depth, and none beyond the line's ends.
    feet = np.arange(spacing, length + 1e-9 * spacing, spacing)[:, None]
    near = start + feet * unit
    lean = np.minimum(depth * 0.7, feet)
    return np.stack([near, near + lean * (right - unit)], axis=1)


def hatched_area(corners: Float, spacing: float) -> Float:
    """Return strokes at 45° inside a convex area, (n, 2, 2)."""
    direction = np.array([1.0, 1.0]) / np.sqrt(2.0)
    normal = np.array([-1.0, 1.0]) / np.sqrt(2.0)
    heights = corners @ normal
    ends = []
    closed = list(zip(corners, np.roll(corners, -1, axis=0), strict=True))
    for level in np.arange(heights.min() + spacing / 2.0, heights.max(), spacing):
        cuts = []
        for a, b in closed:
            ha, hb = float(a @ normal) - level, float(b @ normal) - level
            if (ha < 0.0) != (hb < 0.0):
                cuts.append(a + (b - a) * (ha / (ha - hb)))
        if len(cuts) == 2:
            ends.append(sorted(cuts, key=lambda cut: float(cut @ direction)))
    return np.array(ends).reshape(-1, 2, 2)
