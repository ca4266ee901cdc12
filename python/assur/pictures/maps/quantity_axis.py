"""Axes of a chart in the unit that suits: data stay in m and rad, ticks are written in it."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.ticker import FuncFormatter, MaxNLocator, MultipleLocator

from assur.pictures.chart import TEXT
from assur.pictures.numerals import length_unit, true_minus
from assur.pictures.text import printable, shortened

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.pictures.style import Style

# Steps between ticks of angles, degrees; and the most ticks.
STEPS = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 60.0, 90.0, 180.0, 360.0, 720.0, 3600.0)
MOST = 8.0


def unit_of(values: Float, is_angle: bool) -> tuple[str, float]:
    """Return the unit that suits lengths, m, or angles, rad, and its factor."""
    if is_angle:
        return "°", 180.0 / np.pi
    finite = np.abs(values[np.isfinite(values)])
    return length_unit(float(finite.max(initial=0.0)) or 1.0)


def name_axis(
    axis: Any, name: str, values: Float, is_angle: bool, style: Style
) -> tuple[str, float]:
    """Name an axis of a chart and write its ticks in the unit that suits; return the unit."""
    unit, factor = unit_of(values, is_angle)
    low, high = (float(end) for end in axis.get_view_interval())
    span = abs(high - low) * factor
    if is_angle:
        step = next((step for step in STEPS if span / step <= MOST), STEPS[-1])
        axis.set_major_locator(MultipleLocator(step / factor))
    else:
        axis.set_major_locator(MaxNLocator(6, steps=[1, 2, 5, 10]))
    suffix = unit if is_angle else ""

    axis.set_major_formatter(FuncFormatter(partial(_tick, factor=factor, suffix=suffix)))
    name = shortened(name)
    text = name if is_angle else f"{name}, {unit}"
    axis.set_label_text(printable(text), color=style.second, fontsize=TEXT, parse_math=False)
    return unit, factor


def _tick(x: float, _: Any, factor: float, suffix: str) -> str:
    # Rounded, for a tick is a multiple of a step that has no exact number.
    text = f"{round(x * factor, 9):.6g}"
    return true_minus("0" if text == "-0" else text) + suffix
