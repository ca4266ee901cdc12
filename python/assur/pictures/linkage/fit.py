"""A linkage that was found, its path and the one that was asked for: see `Fit.plot`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from matplotlib.lines import Line2D

from assur.pictures.linkage.path import path_picture
from assur.pictures.style import style_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from assur._arrays import Float
    from assur._faces import Motion

# Wider than a path and behind it: what is drawn well lies within.
WIDTH = 7.0
BEHIND = 0.5


def fit_picture(motion: Motion, joint: str, target: Float, ax: Any, dark: bool) -> Axes:
    """Draw the linkage at its first position, its path, and the target's corners (K, 2), m."""
    axes = path_picture(motion, joint, ax, None, None, (1.0, 0.0), False, dark)
    wanted = Line2D(
        *target.T,
        color=style_of(dark).faint,
        linewidth=WIDTH,
        solid_capstyle="round",
        solid_joinstyle="round",
        zorder=BEHIND,
        gid=f"target {joint}",
    )
    axes.add_line(wanted)
    return axes
