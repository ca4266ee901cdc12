"""Names and numbers on pictures, kept clear of lines."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.font_manager import FontProperties
from matplotlib.text import Text
from matplotlib.textpath import text_to_path

from assur.pictures.scene.labels import along, placed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur._arrays import Float
    from assur.pictures.axes import Canvas

# Serif italic for joints and quantities; what it lacks comes from the default font.
NAME_FONT = ["STIXGeneral", "DejaVu Serif", "DejaVu Sans"]
NAME_SIZE = 12.0
# Between points that stand for a line, points.
STEP = 4.0


def name_font(size: float = NAME_SIZE) -> FontProperties:
    """Return the font of names."""
    return FontProperties(family=NAME_FONT, style="italic", size=size)


def text_size(text: str, font: FontProperties) -> tuple[float, float]:
    """Return width and height of a text, points."""
    width, height, _ = text_to_path.get_text_width_height_descent(text, font, ismath=False)
    return float(width), float(height)


def write_names(
    on: Canvas,
    texts: Sequence[str],
    points: Float,
    radii: Float,
    lines: list[Float],
    gids: Sequence[str],
    zorder: float = 5.0,
) -> list[Any]:
    """Write names beside points, m; `radii` of their symbols are in points, `lines` in m."""
    font = name_font()
    boxes = np.array([text_size(text, font) for text in texts]).reshape(-1, 2)
    obstacles = along([on.points(line) for line in lines], STEP)
    bounds = (on.points(on.low), on.points(on.high))
    middles = placed(on.points(points), boxes, radii, obstacles, bounds) / on.scale
    written = []
    for text, (x, y), gid in zip(texts, middles, gids, strict=True):
        artist = Text(
            x,
            y,
            text,
            fontproperties=font,
            color=on.style.ink,
            horizontalalignment="center",
            verticalalignment="center",
            zorder=zorder,
            gid=gid,
            parse_math=False,
        )
        on.ax.add_artist(artist)
        written.append(artist)
    return written
