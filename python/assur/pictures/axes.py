"""Axes of pictures: a frame in true proportion without axes, and a scale bar."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import short
from assur.errors import InputError
from assur.pictures import sizes
from assur.pictures.numerals import length_text

if TYPE_CHECKING:
    from collections.abc import Callable

    from matplotlib.axes import Axes

    from assur._arrays import Float
    from assur.pictures.style import Style

# A new figure: its width and the limits of its height, inches; one that is too tall gets narrow.
WIDTH, LEAST_WIDTH, LEAST_HEIGHT, GREATEST_HEIGHT = 6.4, 3.6, 2.4, 6.4
# About the mechanism, points: for names, pivots, drivers; and below for the scale bar.
MARGIN, FOOT = 30.0, 30.0
# About the length of the scale bar, points.
SCALE_BAR = 55.0
TEXT = 9.0
# Squares of the extent must not overflow, nor the number of pixels per unit.
LEAST_EXTENT, GREATEST_EXTENT = 1e-100, 1e100


def pyplot() -> Any:
    """Return matplotlib's pyplot."""
    try:
        import matplotlib.pyplot as plt
    except ImportError as error:  # pragma: no cover
        message = 'drawing needs matplotlib: pip install "assur[plot]"'
        raise ImportError(message) from error
    return plt


def listed_axes(ax: Any) -> list[Any]:
    """Return axes given one, as a sequence or as an array of them, in a list."""
    try:
        return list(np.atleast_1d(np.asarray(ax, dtype=object)).flat)
    # Lists of different lengths; one that contains itself.
    except (ValueError, RuntimeError) as error:
        message = f"ax is {short(ax)}: matplotlib axes are needed, or a list of them"
        raise InputError(message) from error


def checked_axes(ax: Any) -> Any:
    """Return axes to draw on, which must be plain ones."""
    if not hasattr(ax, "add_artist") or not hasattr(ax, "transData"):
        message = f"ax is {type(ax).__name__}, no matplotlib axes"
        raise InputError(message)
    if ax.figure is None:
        message = "ax was removed from its figure: nothing would be seen"
        raise InputError(message)
    if getattr(ax, "name", "rectilinear") != "rectilinear":
        message = f"ax has the projection {ax.name!r}: mechanisms are drawn on plain axes"
        raise InputError(message)
    return ax


def root_figure(ax: Any) -> Any:
    """Return the figure that the axes are on in the end: they may be on a part of it."""
    return ax.figure.figure


@dataclass(frozen=True)
class Canvas:
    """Axes whose scale is fixed.

    Attributes
    ----------
    ax : matplotlib.axes.Axes
        Where to draw.
    style : Style
        Its colours.
    scale : float
        Points to a metre.
    size : float
        Points to a px of the symbols: they shrink where links are short.
    low, high : ndarray
        Corners of the visible area, m.
    """

    ax: Axes
    style: Style
    scale: float
    size: float
    low: Float
    high: Float

    def points(self, at: Any) -> Float:
        """Return points of the drawing in points of print."""
        printed: Float = np.asarray(at, dtype=np.float64) * self.scale
        return printed


def canvas(
    ax: Any,
    extent: tuple[Float, Float],
    style: Style,
    link: float,
    head: float = 0.0,
    sides: float = MARGIN,
) -> Canvas:
    """Return axes in true proportion that show `extent`; `link` is the usual length of a link, m.

    `head`: points for text above; `sides`: margins on the left and the right. Axes that have
    something drawn on keep it in sight.
    """
    # Beyond every number, the width is infinite.
    with np.errstate(over="ignore", invalid="ignore"):
        low, high = _spread(*extent)
        greatest = float((high - low).max())
    if not LEAST_EXTENT < greatest < GREATEST_EXTENT:
        message = (
            f"the picture would be {greatest:.3g} wide: from {LEAST_EXTENT:g} to "
            f"{GREATEST_EXTENT:g} can be drawn"
        )
        raise InputError(message)
    # Left, below, right, above.
    border = np.array([sides, MARGIN + FOOT, sides, MARGIN + head])
    if ax is None:
        ax = _new_axes(high - low, border[:2] + border[2:], style)
    else:
        ax = checked_axes(ax)
        if "log" in (ax.get_xscale(), ax.get_yscale()):
            message = "ax has a logarithmic scale: true proportion needs linear ones"
            raise InputError(message)
        if ax.has_data() or ax.artists or ax.patches or ax.texts:
            (x0, x1), (y0, y1) = sorted(ax.get_xlim()), sorted(ax.get_ylim())
            low, high = np.minimum(low, (x0, y0)), np.maximum(high, (x1, y1))
    # Limits stay as they are when the layout changes later; twins cannot keep them.
    box = ax.get_position(original=True)
    siblings = {*ax.get_shared_x_axes().get_siblings(ax), *ax.get_shared_y_axes().get_siblings(ax)}
    twins = any(
        sibling is not ax and sibling.get_position(True).bounds == box.bounds
        for sibling in siblings
    )
    ax.set_aspect("equal", adjustable="datalim" if twins else "box")
    ax.set_axis_off()
    size = np.maximum(72.0 * root_figure(ax).get_size_inches() * (box.width, box.height), 1.0)
    # In small axes margins take no more than half.
    border *= np.minimum(1.0, size / 2.0 / (border[:2] + border[2:]))[[0, 1, 0, 1]]
    inner = size - border[:2] - border[2:]
    scale = float((inner / np.maximum(high - low, 1e-300)).min())
    # What remains of the room lies on both sides.
    free = (inner - (high - low) * scale) / 2.0
    low, high = low - (border[:2] + free) / scale, high + (border[2:] + free) / scale
    ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
    density = scale * link / sizes.POINTS_PER_PX / sizes.USUAL_LINK
    px = sizes.POINTS_PER_PX * float(np.clip(density, sizes.LEAST_DENSITY, 1.0))
    return Canvas(ax, style, scale, px, low, high)


def _spread(low: Float, high: Float) -> tuple[Float, Float]:
    """Return corners that are apart: a point alone is seen with half a metre about it."""
    least = 0.5 if (low == high).all() else 0.0
    # So far from the origin numbers do not differ by less.
    least = max(least, 1e-12 * float(np.abs([low, high]).max()))
    grown = np.maximum(least - (high - low).max() / 2.0, 0.0)
    return low - grown, high + grown


def _new_axes(span: Float, margins: Float, style: Style) -> Any:
    """Return axes that fill a new figure in the proportion of the drawing."""
    border = margins / 72.0
    width, height = np.maximum(span, 1e-300)
    tall = float((WIDTH - border[0]) * height / width + border[1])
    figure_height, figure_width = float(np.clip(tall, LEAST_HEIGHT, GREATEST_HEIGHT)), WIDTH
    if tall > GREATEST_HEIGHT:
        narrow = (GREATEST_HEIGHT - border[1]) * width / height + border[0]
        figure_width = float(np.clip(narrow, LEAST_WIDTH, WIDTH))
    figure = plain_figure((figure_width, figure_height), style)
    return figure.add_axes((0.0, 0.0, 1.0, 1.0), facecolor=style.canvas)


def plain_figure(size: tuple[float, float], style: Style) -> Any:
    """Return a figure for axes with places of their own, ignoring the layout in rcParams."""
    plt = pyplot()
    from matplotlib.layout_engine import PlaceHolderLayoutEngine

    # None would be replaced by the layout of rcParams when the figure is saved.
    none = PlaceHolderLayoutEngine(adjust_compatible=True, colorbar_gridspec=True)
    return plt.figure(figsize=size, facecolor=style.canvas, layout=none)


def nice_length(length: float) -> float:
    """Return the greatest 1, 2 or 5 times a power of ten up to a length."""
    power = 10.0 ** np.floor(np.log10(length))
    return float(max(step * power for step in (1.0, 2.0, 5.0) if step * power <= length))


def scale_bar(on: Canvas, write: Callable[[float], str] = length_text) -> None:
    """Draw a scale bar in the lower left corner; `write` gives its length with the unit."""
    length = nice_length(SCALE_BAR * 1.4 / on.scale)
    x, y = on.low + 0.45 * FOOT / on.scale
    tick = 3.0 / on.scale
    ends = np.array([[x, y + tick], [x, y - tick], [x, y], [x + length, y], [x + length, y + tick]])
    ends = np.vstack([ends, [x + length, y - tick]])
    from matplotlib.lines import Line2D
    from matplotlib.text import Text

    line = Line2D(*ends.T, color=on.style.second, linewidth=1.0, gid="scale")
    text = Text(
        x + length + 5.0 / on.scale,
        y,
        write(length),
        color=on.style.second,
        fontsize=TEXT,
        verticalalignment="center_baseline",
        gid="scale",
    )
    on.ax.add_artist(line)
    on.ax.add_artist(text)
