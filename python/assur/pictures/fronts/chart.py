"""The values of two goals as SVG text: each point is a link to its design."""

from __future__ import annotations

import html
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from assur.pictures.axes import nice_length
from assur.pictures.chart import require_shown
from assur.pictures.fronts.goal import far_apart, range_of
from assur.pictures.numerals import true_minus

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur._arrays import Float
    from assur.pictures.fronts.goal import Goal

FloatT = TypeVar("FloatT", float, "Float")

# Of the picture, px: its size, the room of the numbers at the axes.
WIDTH, HEIGHT = 460.0, 340.0
LEFT, RIGHT, TOP, BOTTOM = 64.0, 16.0, 28.0, 46.0
MARK, ROOM = 5.0, 26.0
# Beside the points, a part of their range; at least so many ticks.
MARGIN, TICKS = 0.08, 4.0


def front_svg(goals: Sequence[Goal]) -> str:
    """Return the picture of the first two of some goals, in the colours of the page around it."""
    across, up = goals[:2]
    for goal in (across, up):
        require_shown(float(np.abs(goal.values).max()))
    x_low, x_high = range_of(across.shown, MARGIN)
    y_low, y_high = range_of(up.shown, MARGIN)

    def right(values: FloatT) -> FloatT:
        return LEFT + (WIDTH - LEFT - RIGHT) * (values - x_low) / (x_high - x_low)

    def down(values: FloatT) -> FloatT:
        return TOP + (HEIGHT - TOP - BOTTOM) * (y_high - values) / (y_high - y_low)

    drawn = []
    for value, text in _ticks(x_low, x_high):
        x = right(value)
        drawn.append(f'<path d="M{x:.1f} {TOP:g}V{HEIGHT - BOTTOM:g}"/>')
        drawn.append(f'<text x="{x:.1f}" y="{HEIGHT - BOTTOM + 16.0:g}" class="x">{text}</text>')
    for value, text in _ticks(y_low, y_high):
        y = down(value)
        drawn.append(f'<path d="M{LEFT:g} {y:.1f}H{WIDTH - RIGHT:g}"/>')
        drawn.append(f'<text x="{LEFT - 6.0:g}" y="{y + 4.0:.1f}" class="y">{text}</text>')
    x_title, y_title = (html.escape(goal.title) for goal in (across, up))
    middle = LEFT + (WIDTH - LEFT - RIGHT) / 2.0
    drawn.append(f'<text x="{middle:g}" y="{HEIGHT - 8.0:g}" class="x">{x_title}</text>')
    drawn.append(f'<text x="8" y="14">{y_title}</text>')
    points = np.column_stack([right(across.shown), down(up.shown)])
    named = set(far_apart(points, ROOM))
    # Toward the better side there is no other point.
    aside = (8.0 if across.is_maximized else -8.0, -6.0 if up.is_maximized else 14.0)
    anchor = "start" if across.is_maximized else "end"
    values = [goal.texts() for goal in goals]
    for index, (x, y) in enumerate(points.tolist()):
        told = ", ".join(
            f"{goal.name} {texts[index]} {goal.shown_unit[0]}".rstrip()
            for goal, texts in zip(goals, values, strict=True)
        )
        label = (
            f'<text x="{x + aside[0]:.1f}" y="{y + aside[1]:.1f}" text-anchor="{anchor}">'
            f"{index}</text>"
            if index in named
            else ""
        )
        drawn.append(
            f'<a href="#{index}"><title>{index}: {html.escape(told)}</title>'
            f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{MARK:g}"/>{label}</a>'
        )
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH:g} {HEIGHT:g}" '
        f'role="group" aria-label="{y_title}, {x_title}">{"".join(drawn)}</svg>'
    )


def _ticks(low: float, high: float) -> list[tuple[float, str]]:
    """Return the multiples of a step of 1, 2 or 5 times a power of ten, with their texts."""
    step = nice_length((high - low) / TICKS)
    counts = range(int(np.ceil(low / step)), int(np.floor(high / step)) + 1)
    return [(count * step, true_minus(f"{count * step:.6g}")) for count in counts]
