"""Axes of diagrams: a title with the unit, a grid along y, extremes with their places."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.pictures.axes import checked_axes, pyplot
from assur.pictures.text import text_size

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.pictures.style import Style

# A diagram: its size, inches; the room above and below the curve, relative to its range.
WIDTH, HEIGHT = 5.2, 3.2
HEADROOM = 0.18
TEXT = 9.0
CURVE, MARK = 2.2, 6.0


def chart_axes(ax: Any, style: Style, rows: int = 1, columns: int = 1) -> Any:
    """Return axes for a diagram, or an array of them in one figure, in the colours of a style.

    Given axes are used as they are; several may be given as a sequence.
    """
    if ax is None:
        _, axes = pyplot().subplots(
            rows,
            columns,
            figsize=(WIDTH * columns, HEIGHT * rows),
            layout="constrained",
            facecolor=style.canvas,
        )
    else:
        several = list(np.atleast_1d(np.asarray(ax, dtype=object)).flat)
        axes = several[0] if rows * columns == 1 else np.array(several).reshape(rows, columns)
    for one in np.atleast_1d(axes).flat:
        _dress(checked_axes(one), style)
    return axes


def _dress(ax: Any, style: Style) -> None:
    ax.set_facecolor(style.canvas)
    for side in ("left", "right", "top"):
        ax.spines[side].set_visible(False)
    ax.spines["bottom"].set_color(style.second)
    ax.tick_params(colors=style.second, labelsize=TEXT)
    ax.tick_params(axis="y", length=0.0)
    ax.grid(visible=True, axis="y", color=style.grid, linewidth=0.8)
    ax.set_axisbelow(True)


def title(ax: Any, text: str, style: Style) -> None:
    """Write what a diagram shows, with its unit, on the left above it."""
    ax.set_title(text, loc="left", color=style.ink, fontsize=TEXT + 1.5, fontweight="bold")


def degree_ticks(ax: Any, low: float, high: float) -> None:
    """Put ticks at every 60°, of long spans at every turn."""
    from matplotlib.ticker import FuncFormatter, MultipleLocator

    steps = (60.0, 180.0, 360.0, 720.0, 3600.0)
    step = next((s for s in steps if (high - low) / s <= 8.0), None)
    if step is not None and (high - low) >= 120.0:
        ax.xaxis.set_major_locator(MultipleLocator(step))
    ax.xaxis.set_major_formatter(FuncFormatter(lambda x, _: f"{x:.6g}°".replace("-", "−")))


def number(x: float) -> str:
    """Write three digits, with a true minus."""
    text = f"{x:#.3g}" if 1e-3 <= abs(x) < 1e4 else f"{x:.3g}"
    return text.rstrip(".").replace("-", "−")


def headroom(ax: Any, values: Float) -> None:
    """Leave room for marks above and below the curve; its middle if it is constant."""
    known = values[np.isfinite(values)]
    if not known.size:
        return
    low, high = float(known.min()), float(known.max())
    span = high - low
    if span <= 1e-9 * max(abs(low), abs(high)):
        span = abs(high) or 1.0
    ax.set_ylim(low - HEADROOM * span, high + HEADROOM * span)


def mark(ax: Any, x: float, y: float, text: str, above: bool, colour: str, style: Style) -> Any:
    """Mark a point of a curve and write beside it, away from the curve and within the axes."""
    ax.plot(
        [x], [y], "o", markersize=MARK, markerfacecolor=style.canvas, markeredgecolor=colour,
        markeredgewidth=1.6, zorder=4, clip_on=False, gid="mark",
    )  # fmt: skip
    low, high = ax.get_xlim()
    part = (x - low) / (high - low) if high > low else 0.5
    # Near the sides the text goes inward.
    sides = ("left", "center", "right")
    side = sides[0] if part < 0.15 else sides[2] if part > 0.85 else sides[1]
    return ax.annotate(
        text, (x, y), xytext=(0.0, 7.0 if above else -7.0), textcoords="offset points",
        horizontalalignment=side, verticalalignment="bottom" if above else "top",
        color=style.ink, fontsize=TEXT, zorder=5, gid="mark text",
    )  # fmt: skip


def fits(text: str, ax: Any) -> bool:
    """Whether a title fits above its axes."""
    from matplotlib.font_manager import FontProperties

    width = text_size(text, FontProperties(size=TEXT + 1.5, weight="bold"))[0]
    return width <= 72.0 * float(ax.get_position().width * ax.figure.get_figwidth())
