"""A metric over one or two dimensions of a sweep: see `Measures.plot`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib import patheffects
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.ticker import FuncFormatter, MaxNLocator

from assur.description.dotted_names import is_angle
from assur.pictures.chart import TEXT, chart_axes, title
from assur.pictures.maps.callouts import clear_of, write_beside
from assur.pictures.maps.metric_curve import metric_curve
from assur.pictures.maps.quantity_axis import name_axis
from assur.pictures.maps.regions import hatched_region, roomiest
from assur.pictures.maps.values import extremes, level_text, value_text
from assur.pictures.points import point_in_data, settle
from assur.pictures.style import blend, style_of
from assur.pictures.text import plain_size

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from assur._arrays import Float
    from assur.pictures.maps.values import Reasons
    from assur.pictures.style import Style

# Steps of a map's colours; the least of the hue on the canvas.
LEVELS, PALEST = 7, 0.14
MARK = 7.0


def metric_picture(
    name: str,
    axes: list[tuple[str, Float]],
    values: Float,
    reasons: Reasons,
    ax: Any,
    dark: bool,
    best: str,
    degrees: bool,
) -> Axes:
    """Draw `values` over one or two named axes; each of `reasons` has the nodes without value."""
    style = style_of(dark)
    ax = chart_axes(ax, style)
    values = np.where(np.isfinite(values), values, np.nan) * (180.0 / np.pi if degrees else 1.0)
    unit = "°" if degrees else ""
    if len(axes) == 1:
        metric_curve(ax, name, axes[0], values, reasons, best, unit, style)
    else:
        _map(ax, name, axes, values, reasons, best, unit, style)
    drawn: Axes = ax
    return drawn


def _map(
    ax: Any,
    name: str,
    axes: list[tuple[str, Float]],
    values: Float,
    reasons: Reasons,
    best: str,
    unit: str,
    style: Style,
) -> None:
    (x_name, x), (y_name, y) = axes
    ax.grid(visible=False)
    ax.set(xlim=(x[0], x[-1]), ylim=(y[0], y[-1]))
    name_axis(ax.xaxis, x_name, x, is_angle(x_name), style)
    name_axis(ax.yaxis, y_name, y, is_angle(y_name), style)
    title(ax, name, style)
    if np.isfinite(values).any():
        _contours(ax, x, y, values, unit, style)
    settle(ax)
    _write_reasons(ax, x, y, reasons, style)
    places = [(text, np.unravel_index(i, values.shape)) for text, i in extremes(values, best)]
    _mark_best(
        ax, [(text, x[i], y[j], values[i, j]) for text, (i, j) in places], values, unit, style
    )


def _contours(ax: Any, x: Float, y: Float, values: Float, unit: str, style: Style) -> None:
    """Fill between contours in one hue, write their values, and draw the colour bar."""
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    if high - low <= 1e-9 * max(abs(low), abs(high)):
        low, high = low - 0.5 * (abs(low) or 1.0), high + 0.5 * (abs(high) or 1.0)
    levels = MaxNLocator(LEVELS, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)
    hue = [blend(style.path, style.canvas, PALEST), blend(style.path, style.canvas, 1.0)]
    colours = LinearSegmentedColormap.from_list("assur", hue)
    # Colours reach halfway to the nodes without value, lines end at the last with one.
    filled = ax.contourf(x, y, _reached(values).T, levels=levels, cmap=colours, zorder=1.0)
    filled.set_gid("colours")
    if min(values.shape) > 1:
        masked = np.ma.masked_invalid(values.T)
        inner = [level for level in levels if low < level < high]
        lines = ax.contour(
            x, y, masked, levels=inner, colors=style.ink, linewidths=0.7, alpha=0.55, zorder=3.0
        )
        lines.set_gid("contours")
        texts = ax.clabel(
            lines, fmt=lambda z: f"{level_text(z)}{unit}", fontsize=TEXT - 1.0, inline=True
        )
        for text in texts:
            text.set(color=style.ink, zorder=3.5, gid="contour value")
    bar = ax.get_figure().colorbar(filled, ax=ax, aspect=28.0, pad=0.02)
    bar.outline.set_visible(False)
    bar.ax.tick_params(colors=style.second, labelsize=TEXT, length=0.0)
    bar.ax.yaxis.set_major_formatter(FuncFormatter(lambda z, _: level_text(z) + unit))
    bar.ax.set_gid("colour bar")


def _reached(values: Float) -> Float:
    """Return values, with those of neighbours where they are missing."""
    whole = values.copy()
    for _ in range(2):
        padded = np.pad(whole, 1, constant_values=np.nan)
        known = np.isfinite(padded)
        total, count = np.zeros_like(values), np.zeros_like(values)
        rows, columns = values.shape
        for i in range(3):
            for j in range(3):
                part = (slice(i, i + rows), slice(j, j + columns))
                total += np.where(known[part], padded[part], 0.0)
                count += known[part]
        with np.errstate(invalid="ignore"):
            whole = np.where(np.isfinite(whole), whole, total / count)
    return whole


def _write_reasons(ax: Any, x: Float, y: Float, reasons: Reasons, style: Style) -> None:
    """Hatch where there is no value, with the reason in it, or in a legend if it has no room."""
    left = []
    if reasons and min(len(x), len(y)) > 1:
        nowhere = np.any([which for _, which in reasons], axis=0)
        edge = ax.contour(
            x, y, nowhere.T.astype(float), levels=[0.5], colors=style.second, linewidths=1.0
        )
        edge.set(zorder=2.5, gid="edge")
    point = point_in_data(ax)
    for i, (text, which) in enumerate(reasons):
        if min(len(x), len(y)) > 1:
            patch = hatched_region(ax, x, y, which, i, style, f"region {text}")
        box = (np.array(plain_size(text, TEXT)) + 8.0) * point
        at_x, at_y, room = roomiest(x, y, which, box)
        if room >= 1.0:
            ax.text(
                at_x, at_y, text, ha="center", va="center", color=style.ink, fontsize=TEXT,
                zorder=4.0, gid="reason", parse_math=False,
                bbox={"facecolor": style.canvas, "edgecolor": "none", "pad": 2.5},
            )  # fmt: skip
        else:
            patch.set_label(text.replace("$", r"\$"))
            left.append(patch)
    if left:
        ax.legend(
            handles=left, loc="upper center", bbox_to_anchor=(0.5, -0.18), ncols=2, frameon=False,
            fontsize=TEXT, labelcolor=style.ink,
        ).set_gid("reasons")  # fmt: skip


def _mark_best(
    ax: Any, places: list[tuple[str, Any, Any, Any]], values: Float, unit: str, style: Style
) -> None:
    """Mark designs by a ring with the value beside it; values of contours make room."""
    for text, x, y, _ in places:
        ax.plot(
            [x], [y], "o", markersize=MARK, markerfacecolor=style.canvas, clip_on=False,
            markeredgecolor=style.driver, markeredgewidth=2.0, zorder=5.0, gid=f"best {text}",
        )  # fmt: skip
    captions = [f"{text} {value_text(float(value), values)}{unit}" for text, _, _, value in places]
    points = np.array([(x, y) for _, x, y, _ in places]).reshape(-1, 2)
    reasons = [text for text in ax.texts if text.get_gid() == "reason"]
    written = write_beside(ax, captions, points, MARK, style.driver, "best text", avoid=reasons)
    for text in written:
        text.set_path_effects([patheffects.withStroke(linewidth=3.0, foreground=style.canvas)])
    clear_of(ax, [*reasons, *written], "contour value")
