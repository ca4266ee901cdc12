"""Symbols of quantities with subscripts, for texts of pictures."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from matplotlib.font_manager import FontProperties

from assur.pictures.text import name_font, printable, text_size

if TYPE_CHECKING:
    from collections.abc import Sequence

# Letters that the font of formulas has for certain.
PLAIN = re.compile(r"[A-Za-z0-9_()]+")
# A quantity between dollar signs: letter, what stands above it and below.
FORMULA = re.compile(r"\$([^$^_]+)(?:\^\{([^}]*)\})?(?:_\{([^}]*)\})?(?:\^\{([^}]*)\})?\$")
# Matplotlib's formulas: size of indices, and heights, relative to the size.
SMALL, HEIGHT, HEIGHT_ABOVE = 0.7, 1.25, 1.5


def formula_font(size: float) -> FontProperties:
    """Return the default font, with formulas in serif italic."""
    return FontProperties(size=size, math_fontfamily="stix")


def symbol(letter: str, names: Sequence[str], upper: str = "") -> str:
    """Write a quantity with names below it, and what stands above: a^n_CB.

    Names of one letter stand together, of longer ones the second follows a slash.
    """
    if not all(PLAIN.fullmatch(name) for name in names):
        above = f"^{upper}" if upper else ""
        return f"{letter}{above}({printable('/'.join(names))})".replace("$", r"\$")
    short = len(names) < 2 or all(len(name.rstrip("0123456789")) == 1 for name in names)
    below = ("" if short else "/").join(name.replace("_", r"\_") for name in names)
    above = f"^{{{upper}}}" if upper else ""
    return f"${letter}{above}_{{{below}}}$" if below else f"${letter}{above}$"


def formula_size(text: str, font: FontProperties) -> tuple[float, float]:
    """Return width and height of a text with formulas, points, to about a point.

    To let matplotlib read the formulas would take a hundred times as long.
    """
    size = float(font.get_size_in_points())
    big, small = name_font(size), name_font(SMALL * size)
    width, height = 0.0, HEIGHT * size
    # What a pattern with four groups splits comes in fives: text, letter, above, below, above.
    pieces = FORMULA.split(text)
    for i in range(0, len(pieces), 5):
        if pieces[i]:
            width += text_size(pieces[i].replace(r"\$", "$"), font)[0]
        if i + 1 < len(pieces):
            letter, above, below, later = (piece or "" for piece in pieces[i + 1 : i + 5])
            above = (above or later).replace(r"\infty", "∞")
            sides = [text_size(side.replace("\\", ""), small)[0] for side in (above, below) if side]
            width += text_size(letter, big)[0] + max(sides, default=0.0) + 0.15 * size
            if above:
                height = HEIGHT_ABOVE * size
    return width, height
