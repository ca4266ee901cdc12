"""Pictures of a flywheel: speed, moments, work, and Wittenbauer's diagram."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur._search import bisected
from assur.pictures import chart
from assur.pictures.diagrams.line_names import Named, name_lines
from assur.pictures.diagrams.notes import Note, write_notes
from assur.pictures.diagrams.peaks import peaks
from assur.pictures.diagrams.steady import TINT, Abscissa, over_q, over_time, speed_diagram, start
from assur.pictures.diagrams.wittenbauer import wittenbauer_diagram
from assur.pictures.numerals import number
from assur.pictures.points import settle
from assur.pictures.style import blend, style_of

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur._faces import Flywheel
    from assur.pictures.style import Style

# Areas below this fraction of the greatest are not labelled.
SMALL = 0.04
# Halvings of a step to find where a sign changes.
HALVINGS = 50


def flywheel_picture(
    flywheel: Flywheel,
    what: str,
    span: tuple[float, float],
    points: int,
    ax: Any,
    degrees: bool,
    dark: bool,
) -> Any:
    """See `Flywheel.plot`."""
    style = style_of(dark)
    q = np.linspace(*span, points)
    if what == "energy-mass":
        return wittenbauer_diagram(flywheel, q, ax, style)
    if what == "reduced":
        return reduced_diagrams(flywheel, q, ax, over_q(q, degrees), style)
    if what == "moment":
        return moment_diagram(flywheel, q, ax, over_q(q, degrees), style)
    if what == "energy":
        return energy_diagram(flywheel, q, ax, over_q(q, degrees), style)
    if what == "speed":
        over = over_q(q, degrees)
    else:
        over = over_time(flywheel.time(q), lambda at: float(flywheel.time(at)))
    return speed_diagram(ax, over, flywheel.speed(q), flywheel, wheel_text(flywheel), style)


def wheel_text(flywheel: Flywheel) -> str:
    """Say which flywheel it is."""
    return f" with {flywheel.inertia:.4g} kg·m²" if flywheel.inertia else " without a flywheel"


def reduced_diagrams(flywheel: Flywheel, q: Float, ax: Any, over: Abscissa, style: Style) -> Any:
    """Draw the reduced moment of the loads, and the reduced inertia."""
    axes = chart.chart_axes(ax, style, 2, 1, 2.7)
    x, written = over.values, []
    for panel, curve, title, plain in zip(
        axes,
        (flywheel.reduced_moment, flywheel.reduced_inertia),
        ("Reduced moment of the loads", "Reduced inertia"),
        ("N·m", "kg·m²"),
        strict=True,
    ):
        values = np.asarray(curve(q))
        start(panel, over, style)
        panel.plot(x, values, color=style.ink, linewidth=chart.CURVE, gid=f"curve {title}")
        chart.headroom(panel, values)
        unit, power = chart.scaled(panel, plain, float(np.abs(values).max()))
        chart.title(panel, f"{title}, {unit}", style)
        chart.zero_line(panel, style)
        span = float(np.ptp(values)) / power
        notes = []
        for peak in peaks(q, values, again=curve):
            at = over.of(peak.x)
            text = f"{number(peak.y / power, span)} at {over.place(at)}"
            notes.append(Note(at, peak.y, text, style.ink, "extreme"))
        written.append(notes)
    axes[0].set_xlabel("")
    axes[0].tick_params(labelbottom=False)
    settle(axes[0])
    for panel, notes in zip(axes, written, strict=True):
        write_notes(panel, notes, style)
    return axes


def areas(flywheel: Flywheel, q: Float) -> list[tuple[float, float, float]]:
    """Return where the motor has a surplus or a deficit: start, end, energy of each, J."""
    sign = np.sign(np.asarray(flywheel.surplus(q)))
    at = np.flatnonzero(sign[:-1] * sign[1:] < 0.0)

    def has_sign(middle: Float) -> Any:
        return np.asarray(flywheel.surplus(middle)) * sign[at] > 0.0

    low, high = bisected(has_sign, q[at], q[at + 1], HALVINGS)
    ends = [float(q[0]), *((low + high) / 2.0).tolist(), float(q[-1])]
    work = np.asarray(flywheel.work(np.array(ends)))
    return [
        (first, last, float(gain))
        for first, last, gain in zip(ends[:-1], ends[1:], np.diff(work), strict=True)
    ]


def moment_diagram(flywheel: Flywheel, q: Float, ax: Any, over: Abscissa, style: Style) -> Any:
    """Draw motor and resistance; the areas between them are energies given and taken."""
    axes = chart.chart_axes(ax, style)
    start(axes, over, style)
    resistance = -np.asarray(flywheel.reduced_moment(q))
    motor = np.asarray(flywheel.surplus(q)) + resistance
    x = over.values
    for gid, colour, where in (
        ("surplus", style.driver, motor >= resistance),
        ("deficit", style.error, motor <= resistance),
    ):
        axes.fill_between(
            x, resistance, motor, where=where, interpolate=True, linewidth=0.0,
            color=blend(colour, style.canvas, 2.0 * TINT), zorder=0.5, gid=gid,
        )  # fmt: skip
    axes.plot(x, resistance, color=style.ink, linewidth=chart.CURVE, gid="curve resistance")
    axes.plot(x, motor, color=style.driver, linewidth=chart.CURVE, gid="curve motor")
    both = np.concatenate([resistance, motor])
    chart.headroom(axes, both)
    unit, _ = chart.scaled(axes, "N·m", float(np.abs(both).max()))
    chart.title(axes, f"Moment at the driver, {unit}", style, energies_text(flywheel, q))
    all_areas = areas(flywheel, q)
    chart.zero_line(axes, style)
    settle(axes)
    curves = [
        Named(x, resistance, "resistance", style.ink, italic=False),
        Named(x, motor, "motor", style.driver, italic=False),
    ]
    write_energies(axes, over, all_areas, (motor, resistance), q, style)
    name_lines(axes, curves)
    return axes


def energies_text(flywheel: Flywheel, q: Float) -> str:
    """Say how far the work of a turn goes up and down."""
    low, high = work_extremes(flywheel, q)
    motor = float(flywheel.motor_moment * (q[-1] - q[0]))
    return f"motor {number(motor)} J a turn; greatest change of energy {number(high[1] - low[1])} J"


def work_extremes(flywheel: Flywheel, q: Float) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the least and the greatest work of motor and loads since the start, with places."""
    ends = np.array([float(q[0]), *(area[1] for area in areas(flywheel, q))])
    work = np.asarray(flywheel.work(ends))
    low, high = int(np.argmin(work)), int(np.argmax(work))
    return (float(ends[low]), float(work[low])), (float(ends[high]), float(work[high]))


def write_energies(
    ax: Any,
    over: Abscissa,
    all_areas: list[tuple[float, float, float]],
    curves: tuple[Float, Float],
    q: Float,
    style: Style,
) -> None:
    """Write the energy of each area into it, or beside it where it is narrow."""
    motor, resistance = curves
    size = max((abs(gain) for *_, gain in all_areas), default=0.0)
    notes = []
    for first, last, gain in all_areas:
        inside = (q >= min(first, last)) & (q <= max(first, last))
        if abs(gain) < SMALL * size or not inside.any():
            continue
        # At the middle of the area.
        height = np.abs(motor - resistance)[inside]
        at = float((q[inside] * height).sum() / height.sum())
        y = float(np.interp(at, *_rising(q, (motor + resistance) / 2.0)))
        sign = "+" if gain > 0.0 else "−"
        text = f"{sign}{number(abs(gain))} J"
        notes.append(Note(over.of(at), y, text, style.ink, "energy", None, centred=True))
    write_notes(ax, notes, style)


def _rising(q: Float, y: Float) -> tuple[Float, Float]:
    return (q, y) if q[-1] > q[0] else (q[::-1], y[::-1])


def energy_diagram(flywheel: Flywheel, q: Float, ax: Any, over: Abscissa, style: Style) -> Any:
    """Draw the work of motor and loads, and the part of it that the flywheel stores."""
    axes = chart.chart_axes(ax, style)
    start(axes, over, style)
    x = over.values
    work = np.asarray(flywheel.work(q))
    speed = np.asarray(flywheel.speed(q))
    stored = flywheel.inertia * (np.square(speed) - flywheel.speed0**2) / 2.0
    axes.fill_between(
        x, stored, work, color=blend(style.driver, style.canvas, 2.0 * TINT), linewidth=0.0,
        zorder=0.5, gid="of the machine",
    )  # fmt: skip
    axes.plot(x, work, color=style.ink, linewidth=chart.CURVE, gid="curve work")
    axes.plot(x, stored, color=style.driver, linewidth=chart.CURVE, gid="curve flywheel")
    both = np.concatenate([work, stored])
    chart.headroom(axes, both)
    unit, power = chart.scaled(axes, "J", float(np.abs(both).max()))
    low, high = work_extremes(flywheel, q)
    change = high[1] - low[1]
    text = f"greatest change {number(change)} J; shaded: kinetic energy of the machine itself"
    chart.title(axes, f"Energy since the start, {unit}", style, text)
    chart.zero_line(axes, style)
    settle(axes)
    span = change / power
    notes = [
        Note(
            over.of(at), value,
            f"{number(value / power, span)} at {over.place(over.of(at))}", style.ink,
            "extreme work",
        )
        for at, value in (high, low)
    ]  # fmt: skip
    write_notes(axes, notes, style)
    name_lines(
        axes,
        [
            Named(x, work, "work of motor and loads", style.ink, italic=False),
            Named(x, stored, "flywheel", style.driver, italic=False),
        ],
    )
    return axes
