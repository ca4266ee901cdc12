"""A metric over one dimension of a sweep."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.ticker import FuncFormatter

from assur.description.dotted_names import is_angle
from assur.pictures.chart import CURVE, TEXT, headroom, mark, title
from assur.pictures.maps.quantity_axis import name_axis
from assur.pictures.maps.regions import HATCHES
from assur.pictures.maps.values import extremes, level_text, value_text
from assur.pictures.points import point_in_data, settle
from assur.pictures.text import plain_size

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.pictures.maps.values import Reasons
    from assur.pictures.style import Style


def metric_curve(
    ax: Any,
    name: str,
    axis: tuple[str, Float],
    values: Float,
    reasons: Reasons,
    best: str,
    unit: str,
    style: Style,
) -> None:
    """Draw the values over the axis, with gaps hatched and extremes marked."""
    x_name, x = axis
    margin = 0.0 if len(x) > 1 else abs(float(x[0])) or 1.0
    ax.set_xlim(float(x[0]) - margin, float(x[-1]) + margin)
    name_axis(ax.xaxis, x_name, x, is_angle(x_name), style)
    title(ax, name, style)
    (line,) = ax.plot(x, values, color=style.path, linewidth=CURVE, gid=name)
    known = np.isfinite(values)
    alone = known & ~np.roll(known, 1) & ~np.roll(known, -1)
    if alone.any():
        # A line shows no point without neighbours.
        line.set(marker="o", markersize=3.0, markevery=np.flatnonzero(alone).tolist())
    headroom(ax, values)
    if unit:
        ax.yaxis.set_major_formatter(FuncFormatter(lambda z, _: level_text(z) + unit))
    settle(ax)
    _spans(ax, x, reasons, style)
    for text, i in extremes(values, best):
        caption = f"{text} {value_text(float(values[i]), values)}{unit}"
        mark(ax, float(x[i]), float(values[i]), caption, text == "max", style.path, style)


def _spans(ax: Any, x: Float, reasons: Reasons, style: Style) -> None:
    """Hatch where there is no value, halfway to the neighbours."""
    ends = np.concatenate([x[:1], (x[1:] + x[:-1]) / 2.0, x[-1:]])
    for i, (text, which) in enumerate(reasons):
        flags = np.concatenate([[False], which, [False]])
        starts = np.flatnonzero(flags[1:] & ~flags[:-1])
        stops = np.flatnonzero(~flags[1:] & flags[:-1])
        for low, high in zip(ends[starts], ends[stops], strict=True):
            ax.axvspan(
                low, high, facecolor=style.canvas, edgecolor=style.faint, linewidth=0.0,
                hatch=HATCHES[i % len(HATCHES)], zorder=1.5, gid=f"region {text}",
            )  # fmt: skip
        widest = int(np.argmax(ends[stops] - ends[starts]))
        low, high = float(ends[starts][widest]), float(ends[stops][widest])
        _write_span(ax, low, high, text, style)


def _write_span(ax: Any, low: float, high: float, text: str, style: Style) -> None:
    """Write a reason across its span, or along it where that is narrow."""
    room = (high - low) / point_in_data(ax)[0]
    width = plain_size(text, TEXT)[0]
    ax.text(
        (low + high) / 2.0, 0.5, text, transform=ax.get_xaxis_transform(), ha="center",
        va="center", rotation=0.0 if width + 8.0 < room else 90.0, color=style.ink, fontsize=TEXT,
        zorder=4.0, gid="reason", parse_math=False,
        bbox={"facecolor": style.canvas, "edgecolor": "none", "pad": 2.5},
    )  # fmt: skip
