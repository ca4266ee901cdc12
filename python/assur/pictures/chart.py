"""Axes of diagrams: a title with the unit, a grid along y, extremes with their places."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.errors import InputError
from assur.pictures.axes import checked_axes, listed_axes, pyplot
from assur.pictures.numerals import ten, true_minus
from assur.pictures.text import printable

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.pictures.style import Style

# A diagram: its size, inches; the room above and below the curve, relative to its range.
WIDTH, HEIGHT = 5.2, 3.2
HEADROOM = 0.18
# About each of them, inches.
PAD = 0.08
# From a diagram to its title, points, where a sentence is between them.
BELOW = 20.0
TEXT = 9.0
CURVE, MARK = 2.2, 6.0
# Ranges of an axis beyond these have no ticks: matplotlib takes their logarithm and their sums.
LEAST_SHOWN, GREATEST_SHOWN = 1e-300, 1e300
# Greatest numbers beside an axis, and the least of them, without a power of ten.
LEAST, MOST = 0.1, 1000.0


def chart_axes(
    ax: Any, style: Style, rows: int = 1, columns: int = 1, height: float = HEIGHT
) -> Any:
    """Return axes for a diagram, or an array of them in one figure, in the colours of a style.

    Given axes are used as they are; several may be given as a sequence.
    """
    if ax is None:
        figure, axes = pyplot().subplots(
            rows,
            columns,
            figsize=(WIDTH * columns, height * rows),
            layout="constrained",
            facecolor=style.canvas,
        )
        figure.get_layout_engine().set(w_pad=PAD, h_pad=PAD)
    else:
        several = listed_axes(ax)
        if len(several) != rows * columns:
            needed = "one is" if rows * columns == 1 else f"{rows * columns} are"
            message = f"ax has {len(several)} axes: {needed} needed"
            raise InputError(message)
        for panel in several:
            checked_axes(panel)
        axes = (
            several[0]
            if rows * columns == 1
            else np.array(several).reshape(rows, columns).squeeze()
        )
    for panel in np.atleast_1d(axes).flat:
        if "log" in (panel.get_xscale(), panel.get_yscale()):
            message = "ax has a logarithmic scale: diagrams have linear ones"
            raise InputError(message)
        _dress(panel, style)
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


def title(ax: Any, text: str, style: Style, below: str = "") -> None:
    """Write what a diagram shows, with its unit, on the left above it; `below` is a sentence."""
    ax.set_title(
        printable(text), loc="left", color=style.ink, fontsize=TEXT + 1.5, fontweight="bold",
        pad=BELOW if below else None, parse_math=False,
    )  # fmt: skip
    if below:
        ax.annotate(
            printable(below), (0.0, 1.0), xytext=(0.0, 5.0), xycoords="axes fraction",
            textcoords="offset points", color=style.second, fontsize=TEXT, gid="sentence",
            annotation_clip=False, parse_math=False,
        )  # fmt: skip


def degree_ticks(ax: Any, low: float, high: float) -> None:
    """Put ticks at every 60°, or at every turn for long spans."""
    from matplotlib.ticker import FuncFormatter, MultipleLocator

    steps = (60.0, 180.0, 360.0, 720.0, 3600.0)
    step = next((s for s in steps if (high - low) / s <= 8.0), None)
    if step is not None and (high - low) >= 120.0:
        ax.xaxis.set_major_locator(MultipleLocator(step))
    ax.xaxis.set_major_formatter(FuncFormatter(_degrees))


def _degrees(x: float, _: Any) -> str:
    # Figures that are pickled have no functions without a name.
    return true_minus(f"{x:.6g}°")


def scaled(ax: Any, unit: str, greatest: float) -> tuple[str, float]:
    """Divide the numbers at the y-axis by a power of ten that suits them.

    Returns the unit with that power, and the power's value. The data stay as they are.
    """
    from matplotlib.ticker import ScalarFormatter

    power = 0
    if np.isfinite(greatest) and greatest > 0.0 and not LEAST <= greatest < MOST:
        power = 3 * int(np.floor(np.log10(greatest) / 3.0))

    numbers = ScalarFormatter(useOffset=False)
    numbers.set_scientific(bool(power))
    numbers.set_powerlimits((power, power))
    ax.yaxis.set_major_formatter(numbers)
    # The title has the power.
    ax.yaxis.get_offset_text().set_visible(False)
    if not power:
        return unit, 1.0
    if power == -3 and unit.startswith("m"):
        return f"m{unit}", 1e-3
    return f"{ten(power)} {unit}".rstrip(), 10.0**power


def zero_line(ax: Any, style: Style) -> None:
    """Draw the line of zero where it is in sight."""
    low, high = sorted(ax.get_ylim())
    if low < 0.0 < high:
        ax.axhline(0.0, color=style.second, linewidth=0.9, alpha=0.8, zorder=1.0, gid="zero")


def require_shown(greatest: float) -> None:
    """Refuse values that no axis can have; `greatest` is their greatest size."""
    if greatest and not LEAST_SHOWN <= greatest <= GREATEST_SHOWN:
        message = (
            f"the diagram would show values of {greatest:.3g}: from {LEAST_SHOWN:g} to "
            f"{GREATEST_SHOWN:g} can be drawn"
        )
        raise InputError(message, value=greatest)


def headroom(ax: Any, values: Float, part: float = HEADROOM) -> None:
    """Leave room for marks above and below the curve; its middle if it is constant."""
    known = values[np.isfinite(values)]
    if not known.size:
        return
    low, high = float(known.min()), float(known.max())
    greatest = max(abs(low), abs(high))
    require_shown(greatest)
    span = high - low
    if span <= 1e-9 * greatest:
        span = abs(high) or 1.0
    ax.set_ylim(low - part * span, high + part * span)


def dot(ax: Any, x: float, y: float, colour: str, style: Style, marker: str = "o") -> None:
    """Mark a point of a curve by a ring, or another hollow marker."""
    ax.plot(
        [x], [y], marker, markersize=MARK, markerfacecolor=style.canvas, markeredgecolor=colour,
        markeredgewidth=1.6, zorder=4.0, clip_on=False, gid="mark", scalex=False, scaley=False,
    )  # fmt: skip


def mark(ax: Any, x: float, y: float, text: str, above: bool, colour: str, style: Style) -> Any:
    """Mark a point of a curve and write beside it, away from the curve and within the axes."""
    dot(ax, x, y, colour, style)
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
