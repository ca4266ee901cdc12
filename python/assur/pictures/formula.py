"""The structural formula in the colours of its groups."""

from __future__ import annotations

from typing import TYPE_CHECKING

from matplotlib.font_manager import FontProperties
from matplotlib.text import Text

from assur.pictures.axes import MARGIN, TEXT
from assur.pictures.text import text_size

if TYPE_CHECKING:
    from assur.pictures.axes import Canvas
    from assur.pictures.subject import Subject

ARROW = " → "
LINE_HEIGHT = 1.5


def write_formula(subject: Subject, on: Canvas) -> None:
    """Write the formula in the upper left corner, each group in its colour."""
    font = FontProperties(size=TEXT + 1.0)
    # The driver, then the groups in solving order.
    pieces = subject.mechanism.structure.formula.split(ARROW)
    left, top = on.low[0] + 10.0 / on.scale, on.high[1] - 8.0 / on.scale
    right = on.high[0] - 10.0 / on.scale
    x, y = left, top
    for i, piece in enumerate(pieces):
        text = piece if i == 0 else f"→ {piece}"
        width = text_size(text + " ", font)[0] / on.scale
        if x > left and x + width > right:
            x, y = left, y - LINE_HEIGHT * font.get_size_in_points() / on.scale
        colour = on.style.driver if i == 0 else on.style.group(i - 1)
        artist = Text(
            x,
            y,
            text,
            fontproperties=font,
            color=colour,
            verticalalignment="top",
            parse_math=False,
            zorder=6.0,
            gid="formula",
        )
        on.ax.add_artist(artist)
        x += width + 2.0 / on.scale


def formula_height(subject: Subject) -> float:
    """Return what the formula needs above the mechanism, points; at least the usual margin."""
    return max(MARGIN, (len(subject.mechanism.structure.groups) + 1) * 0.0)
