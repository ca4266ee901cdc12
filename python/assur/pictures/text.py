"""Names and numbers on pictures, kept clear of lines."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from assur.pictures.scene.labels import along, chosen

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.font_manager import FontProperties

    from assur._arrays import Float
    from assur.pictures.axes import Canvas

# Serif italic for joints and quantities; letters it lacks come from the default font.
NAME_FONT = ["STIXGeneral", "DejaVu Serif", "DejaVu Sans"]
NAME_SIZE = 12.0
# For a letter that no font has.
MISSING = "□"
# Letters of a name beside the title of a diagram.
LONGEST = 40
# Between points that stand for a line, points.
STEP = 4.0


def name_font(size: float = NAME_SIZE) -> FontProperties:
    """Return the font of names."""
    from matplotlib import rcParams
    from matplotlib.font_manager import FontProperties

    return FontProperties(family=[*NAME_FONT, *rcParams["font.family"]], style="italic", size=size)


def printable(text: str) -> str:
    """Return a text with a box for each letter that the default font, rcParams, does not have.

    Matplotlib draws the same for such a letter, with a warning.
    """
    if text.isascii():
        return text
    from matplotlib import rcParams

    known = _letters(tuple(rcParams["font.family"]), tuple(rcParams["font.sans-serif"]))
    return "".join(letter if letter == "\n" or ord(letter) in known else MISSING for letter in text)


def shortened(text: str) -> str:
    """Return a text of no more than `LONGEST` letters, shortened in its middle."""
    if len(text) <= LONGEST:
        return text
    half = LONGEST // 2
    return f"{text[:half]}…{text[1 - half :]}"


@lru_cache(maxsize=8)
def _letters(families: tuple[str, ...], _: tuple[str, ...]) -> frozenset[int]:
    """Return the letters of the first font of each family; a generic one depends on rcParams."""
    from matplotlib.font_manager import FontProperties, findfont, get_font

    letters: set[int] = set()
    for family in families:
        font = get_font(findfont(FontProperties(family=[family])))
        letters.update(font.get_charmap())
    return frozenset(letters)


@lru_cache(maxsize=1024)
def _measured(text: str, font: FontProperties) -> tuple[float, float, float]:
    """Return width, height and descent of a text, points."""
    from matplotlib.textpath import text_to_path

    measured = text_to_path.get_text_width_height_descent(text, font, ismath=False)
    width, height, descent = (float(length) for length in measured)
    return width, height, descent


def text_size(text: str, font: FontProperties) -> tuple[float, float]:
    """Return width and height of a text, points."""
    return _measured(printable(text), font)[:2]


def plain_size(text: str, size: float) -> tuple[float, float]:
    """Return width and height of a text in the default font, points."""
    from matplotlib.font_manager import FontProperties

    return text_size(text, FontProperties(size=size))


def baseline(text: str, font: FontProperties) -> float:
    """Return how far a text's baseline is above the middle of its box, points; mostly negative."""
    _, height, descent = _measured(printable(text), font)
    return descent - height / 2.0


def write_names(
    on: Canvas,
    texts: Sequence[str],
    points: Float,
    radii: Float,
    lines: list[Float],
    gids: Sequence[str],
    boxes: Float | None = None,
    light: list[Float] | None = None,
    font: FontProperties | None = None,
    colours: Sequence[str] | None = None,
    sizes: Sequence[tuple[float, float]] | None = None,
) -> list[Any]:
    """Write names beside points, m.

    `radii` of their symbols are in points, `lines` in m; `boxes` are there already: their
    middles and halves in points, (k, 2, 2); `light` are lines to be covered first.
    The font and ink of names by default; texts whose `sizes`, points, are given may have formulas.
    """
    names = Names(on, texts, radii, gids, font, colours, sizes)
    names.place(points, lines, boxes, light)
    return names.artists


def name_boxes(on: Canvas) -> Float:
    """Return the boxes of the joints' names on a canvas: middles and halves, points, (k, 2, 2)."""
    font = name_font()
    boxes = []
    for artist in on.ax.texts:
        if str(artist.get_gid()).startswith("name "):
            text = artist.get_text()
            middle = on.points(artist.get_position()) - (0.0, baseline(text, font))
            boxes.append([middle, np.array(text_size(text, font)) / 2.0])
    return np.array(boxes, dtype=np.float64).reshape(-1, 2, 2)


class Names:
    """Names on a canvas, placed beside their points; in motion they stay where they were."""

    def __init__(
        self,
        on: Canvas,
        texts: Sequence[str],
        radii: Float,
        gids: Sequence[str],
        font: FontProperties | None = None,
        colours: Sequence[str] | None = None,
        sizes: Sequence[tuple[float, float]] | None = None,
    ) -> None:
        from matplotlib.text import Text

        font = font or name_font()
        texts = [printable(text) for text in texts]
        self._on = on
        measured = [text_size(text, font) for text in texts] if sizes is None else sizes
        self._boxes = np.array(measured, dtype=np.float64).reshape(-1, 2)
        # Formulas are centred: their baselines are not known.
        plain = sizes is None
        self._baselines = [baseline(text, font) if plain else 0.0 for text in texts]
        self._radii = radii
        self._kept: Any = None
        self.artists: list[Any] = []
        inks = colours or [on.style.ink] * len(texts)
        for text, gid, ink in zip(texts, gids, inks, strict=True):
            artist = Text(
                0.0,
                0.0,
                text,
                fontproperties=font,
                color=ink,
                horizontalalignment="center",
                verticalalignment="baseline" if plain else "center",
                zorder=5.0,
                gid=gid,
                parse_math=not plain,
            )
            on.ax.add_artist(artist)
            self.artists.append(artist)

    def place(
        self,
        points: Float,
        lines: list[Float],
        boxes: Float | None = None,
        light: list[Float] | None = None,
    ) -> None:
        """Move the names to points, m, clear of lines."""
        on = self._on
        bounds = on.points(on.low), on.points(on.high)
        middles, self._kept = chosen(
            on.points(points),
            self._boxes,
            self._radii,
            along([on.points(line) for line in lines], STEP, bounds),
            bounds,
            boxes,
            along([on.points(line) for line in light or []], STEP, bounds),
            self._kept,
        )
        for artist, drop, (x, y) in zip(self.artists, self._baselines, middles, strict=True):
            artist.set_position((x / on.scale, (y + drop) / on.scale))
