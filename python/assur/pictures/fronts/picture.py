"""The values of two goals of all designs: see `ParetoFront.plot`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.pictures.chart import TEXT, chart_axes, require_shown
from assur.pictures.fronts.goal import far_apart, range_of
from assur.pictures.points import in_points, settle
from assur.pictures.style import style_of
from assur.pictures.text import printable

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

    from assur.pictures.fronts.goal import Goal
    from assur.pictures.style import Style

# Inches; a point and the room of an index, points; beside the points, a part of their range.
HEIGHT = 4.0
MARK, ROOM = 5.5, 24.0
MARGIN = 0.08


def front_picture(goals: Sequence[Goal], ax: Any, dark: bool) -> Axes:
    """Draw the first two of some goals."""
    style = style_of(dark)
    ax = chart_axes(ax, style, height=HEIGHT)
    across, up = goals[:2]
    for goal in (across, up):
        require_shown(float(np.abs(goal.values).max()))
    ax.set(xlim=range_of(across.values, MARGIN), ylim=range_of(up.values, MARGIN))
    ax.grid(visible=True, color=style.grid, linewidth=0.8)
    _name(ax.xaxis, across, style)
    _name(ax.yaxis, up, style)
    ax.plot(
        across.values, up.values, "o", markersize=MARK, markerfacecolor=style.path,
        markeredgecolor=style.canvas, markeredgewidth=0.8, zorder=3.0, gid="designs",
    )  # fmt: skip
    settle(ax)
    points = np.column_stack([across.values, up.values])
    named = far_apart(in_points(ax, points), ROOM)
    ax.plot(
        *points[named].T, "o", markersize=MARK, markerfacecolor=style.ink,
        markeredgecolor=style.canvas, markeredgewidth=0.8, zorder=3.5, gid="named designs",
    )  # fmt: skip
    # Toward the better side there is no other point.
    aside = [5.0 if goal.is_maximized else -5.0 for goal in (across, up)]
    for index in named:
        ax.annotate(
            str(index), points[index], xytext=aside, textcoords="offset points",
            ha="left" if across.is_maximized else "right",
            va="bottom" if up.is_maximized else "top", color=style.ink, fontsize=TEXT - 1.0,
            zorder=4.0, gid="index", annotation_clip=False,
        )  # fmt: skip
    drawn: Axes = ax
    return drawn


def _name(axis: Any, goal: Goal, style: Style) -> None:
    """Name an axis, with ticks in the unit that suits."""
    from matplotlib.ticker import MaxNLocator

    from assur.pictures.maps.quantity_axis import name_axis

    if goal.is_angle or goal.unit == "m":
        name_axis(axis, goal.name, goal.values, goal.is_angle, style)
    else:
        axis.set_major_locator(MaxNLocator(6, steps=[1, 2, 5, 10]))
    axis.set_label_text(printable(goal.title), color=style.second, fontsize=TEXT, parse_math=False)
