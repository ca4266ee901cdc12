"""Points of pictures."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.lines import Line2D

if TYPE_CHECKING:
    from assur.pictures.axes import Canvas


def dots(on: Canvas, at: Any, size: float, colour: str, gid: str, zorder: float = 4.0) -> None:
    """Draw a point, (2,), or several, (n, 2), of a diameter in points."""
    points = np.asarray(at, dtype=np.float64).reshape(-1, 2)
    artist = Line2D(
        points[:, 0],
        points[:, 1],
        linestyle="none",
        marker="o",
        markersize=size,
        color=colour,
        zorder=zorder,
        gid=gid,
    )
    on.ax.add_artist(artist)
