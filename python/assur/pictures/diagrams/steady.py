"""The speed of a machine in periodic motion, with its fluctuation."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.pictures import chart
from assur.pictures.diagrams.notes import Note, write_notes
from assur.pictures.diagrams.run import run_picture
from assur.pictures.numerals import degrees_text, number, radians_text
from assur.pictures.points import settle
from assur.pictures.style import blend, style_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from matplotlib.axes import Axes

    from assur._arrays import Float
    from assur._faces import Flywheel, SteadyState
    from assur.pictures.style import Style

# Points of a curve over a period.
POINTS = 1001
TINT = 0.12


def steady_picture(steady: SteadyState, what: str, ax: Any, degrees: bool, dark: bool) -> Axes:
    """See `SteadyState.plot`."""
    if what == "energy":
        return run_picture(steady.run, what, ax, dark, named=False)
    q = np.linspace(steady.q[0], steady.q[-1], POINTS)
    state = steady.at(q)
    if what == "speed":
        abscissa = over_q(q, degrees)
    else:
        first = float(state.t[0])
        abscissa = over_time(state.t - first, lambda at: float(steady.at(at).t) - first)
    wheel = f" with {steady.inertia:.4g} kg·m²" if steady.inertia else ""
    return speed_diagram(ax, abscissa, state.speed, steady, wheel, style_of(dark))


class Abscissa:
    """The abscissa of a curve over a turn: its values, its name, and the places of extremes."""

    def __init__(
        self, values: Float, label: str, of: Callable[[float], float], place: Callable[[float], str]
    ) -> None:
        self.values, self.label, self.of, self.place = values, label, of, place


def over_q(q: Float, degrees: bool) -> Abscissa:
    """Return the driver's coordinate."""
    if not degrees:
        return Abscissa(q, "q, rad", float, radians_text)
    x = np.degrees(q)
    span = float(np.ptp(x))
    return Abscissa(x, "q", lambda at: float(np.degrees(at)), lambda at: degrees_text(at, span))


def over_time(t: Float, of: Callable[[float], float]) -> Abscissa:
    """Return the time; `of` gives it at a coordinate."""
    return Abscissa(t, "t, s", of, lambda at: f"{number(at)} s")


def speed_diagram(
    ax: Any,
    over: Abscissa,
    speed: Float,
    of: Flywheel | SteadyState,
    wheel: str,
    style: Style,
) -> Axes:
    """Draw a speed with its extremes and mean, the band of its fluctuation shaded."""
    axes: Axes = chart.chart_axes(ax, style)
    start(axes, over, style)
    sign = float(np.copysign(1.0, speed[0]))
    least, greatest, mean = (
        sign * float(value) for value in (of.min.value, of.max.value, of.mean_speed)
    )
    axes.plot(over.values, speed, color=style.driver, linewidth=chart.CURVE, gid="curve speed")
    axes.axhspan(
        least, greatest, color=blend(style.driver, style.canvas, TINT), zorder=0.5, linewidth=0.0,
        gid="fluctuation",
    )  # fmt: skip
    axes.axhline(
        mean, color=style.second, linewidth=0.9, linestyle=(0.0, (5.0, 3.0)), zorder=1.5, gid="mean"
    )
    chart.headroom(axes, np.array([least, greatest]))
    unit, power = chart.scaled(axes, "rad/s", max(abs(least), abs(greatest)))
    chart.title(axes, f"Speed, {unit}: δ = {of.delta:.3g}{wheel}", style)
    settle(axes)
    span = abs(greatest - least) / power
    notes = [
        Note(
            over.of(float(extreme.q)),
            sign * float(extreme.value),
            f"{number(sign * float(extreme.value) / power, span)} at "
            f"{over.place(over.of(float(extreme.q)))}",
            style.driver,
            "extreme speed",
        )
        for extreme in (of.max, of.min)
    ]
    write_notes(axes, notes, style)
    write_mean(axes, over, speed, mean, f"mean {number(mean / power, span)}", style)
    return axes


def write_mean(ax: Any, over: Abscissa, speed: Float, mean: float, text: str, style: Style) -> None:
    """Write the mean on its line, where the curve is far from it."""
    width = max(len(over.values) // 6, 1)
    apart = np.abs(speed - mean)
    clear = np.array([apart[i : i + width].min() for i in range(len(apart) - width)])
    i = int(np.argmax(clear)) + width // 2
    above = bool(speed[i] < mean)
    ax.annotate(
        text, (over.values[i], mean), xytext=(0.0, 2.0 if above else -2.0),
        textcoords="offset points", horizontalalignment="center",
        verticalalignment="bottom" if above else "top", color=style.second, fontsize=chart.TEXT,
        zorder=5.0, gid="mean text",
    ).set_in_layout(False)  # fmt: skip


def start(ax: Any, over: Abscissa, style: Style) -> None:
    """Put limits, ticks and name on the abscissa."""
    low, high = float(over.values.min()), float(over.values.max())
    ax.set_xlim(low, high)
    if over.label == "q":
        chart.degree_ticks(ax, low, high)
    ax.set_xlabel(over.label, color=style.second, fontsize=chart.TEXT)
