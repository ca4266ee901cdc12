"""The structural formula in the colours of its groups."""

from __future__ import annotations

from typing import TYPE_CHECKING

from matplotlib.font_manager import FontProperties
from matplotlib.text import Text

from assur.pictures.axes import TEXT
from assur.pictures.text import printable, text_size

if TYPE_CHECKING:
    from assur._faces import Mechanism
    from assur.pictures.axes import Canvas

ARROW = " → "
# Size of the formula, points.
SIZE, LINE, BORDER, GAP = TEXT + 1.0, 15.0, 10.0, 5.0


def formula_lines(mechanism: Mechanism, width: float) -> list[list[tuple[int, str, float]]]:
    """Return the formula in lines no wider than a width, points.

    Each piece with its number, 0 for the drivers, then the groups in solving order, and its x.
    """
    font = FontProperties(size=SIZE)
    lines: list[list[tuple[int, str, float]]] = [[]]
    x = 0.0
    for i, piece in enumerate(printable(mechanism.structure.formula).split(ARROW)):
        text = piece if i == 0 else f"→ {piece}"
        length = text_size(text, font)[0]
        if lines[-1] and x + length > width - 2.0 * BORDER:
            lines.append([])
            x = 0.0
        lines[-1].append((i, text, x))
        x += length + GAP
    return lines


def write_formula(mechanism: Mechanism, on: Canvas) -> None:
    """Write the formula in the upper left corner, each group in its colour."""
    width = float((on.high[0] - on.low[0]) * on.scale)
    for row, line in enumerate(formula_lines(mechanism, width)):
        for i, text, x in line:
            artist = Text(
                on.low[0] + (BORDER + x) / on.scale,
                on.high[1] - (BORDER + row * LINE) / on.scale,
                text,
                fontproperties=FontProperties(size=SIZE),
                color=on.style.group(i - 1) if i else on.style.driver,
                verticalalignment="top",
                parse_math=False,
                zorder=6.0,
                gid="formula",
            )
            on.ax.add_artist(artist)
