"""Centres of mass: quartered circles."""

from __future__ import annotations

from typing import TYPE_CHECKING

from matplotlib.patches import Circle, Wedge

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.pictures.axes import Canvas

# Radius and width of the line, px; quarters that are filled, degrees.
RADIUS, WIDTH = 7.0, 1.5
FILLED = (0.0, 180.0)


def mass_centre(on: Canvas, at: Float, link: str) -> None:
    """Draw the centre of mass of a link."""
    x, y = float(at[0]), float(at[1])
    radius, gid = RADIUS * on.size / on.scale, f"mass centre {link}"
    ink, ground = on.style.ink, on.style.canvas
    circle = Circle(
        (x, y),
        radius,
        facecolor=ground,
        edgecolor=ink,
        linewidth=WIDTH * on.size,
        zorder=3.2,
        gid=gid,
    )
    on.ax.add_artist(circle)
    for first in FILLED:
        quarter = Wedge(
            (x, y), radius, first, first + 90.0, facecolor=ink, linewidth=0.0, zorder=3.3, gid=gid
        )
        on.ax.add_artist(quarter)
