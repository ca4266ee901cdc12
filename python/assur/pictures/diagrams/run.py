"""Pictures of a run: coordinate, speed, acceleration and energies over time, with its events."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.pictures import chart
from assur.pictures.diagrams.line_names import Named, name_lines
from assur.pictures.diagrams.notes import Note, write_notes
from assur.pictures.diagrams.peaks import peaks
from assur.pictures.numerals import number, ten, true_minus
from assur.pictures.points import settle
from assur.pictures.style import style_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from assur._arrays import Float
    from assur._faces import EventRecord, Mechanism, Run
    from assur.pictures.style import Style

# Points of a curve over a run.
POINTS = 1001
# Energies whose range is less than that of the greatest are not drawn.
STILL = 1e-9
# How far the names of events lie below the upper side, relative to the diagram.
EVENTS = 0.07
SUM, DASHED = "sum", (0.0, (5.0, 3.0))
# Above the curves, relative to their range, for the names of events.
ROOM = 0.3
TITLES = {"q": "Coordinate", "speed": "Speed", "acceleration": "Acceleration"}


def run_picture(run: Run, what: str, ax: Any, dark: bool, named: bool = True) -> Axes:
    """See `Run.plot`; `named`: with the events."""
    style = style_of(dark)
    axes: Axes = chart.chart_axes(ax, style)
    if what == "energy":
        t, curves, unit, title = *_energies(run, style), "J", "Energy"
    else:
        t, curves, unit = _motions(run, what, style)
        title = TITLES[what]
    for curve in curves:
        axes.plot(
            t, curve.y, color=curve.colour, linewidth=chart.CURVE,
            linestyle=DASHED if curve.text == SUM else "solid", gid=f"curve {curve.text}",
            zorder=1.9 if curve.text == SUM else 2.0,
        )  # fmt: skip
    values = np.concatenate([curve.y for curve in curves])
    axes.set_xlim(float(t[0]), float(t[-1]) if t[-1] > t[0] else float(t[0]) + 1.0)
    chart.headroom(axes, values)
    events = run.events if named else []
    if events:
        low, high = axes.get_ylim()
        axes.set_ylim(low, high + (ROOM - chart.HEADROOM) * (high - low))
    known = values[np.isfinite(values)]
    unit, power = chart.scaled(axes, unit, float(np.abs(known).max(initial=0.0)))
    chart.title(axes, f"{title}, {unit}", style, _sentence(run, what))
    axes.set_xlabel("t, s", color=style.second, fontsize=chart.TEXT)
    chart.zero_line(axes, style)
    _event_lines(axes, events, style)
    settle(axes)
    notes = _extremes(run, what, t, curves, power)
    write_notes(axes, [*notes, *_event_notes(axes, events, style)], style)
    if len(curves) > 1:
        name_lines(axes, [Named(t, *curve[1:]) for curve in curves])
    return axes


def _sentence(run: Run, what: str) -> str:
    """Say how well the energies balance."""
    if what != "energy":
        return ""
    text, _, power = f"{run.energy.error:.0e}".partition("e")
    return f"sum = kinetic + potential − work, constant to {text}·{ten(int(power))}"


def _energies(run: Run, style: Style) -> tuple[Float, list[Any]]:
    """Return the energies at the ends of the steps, and their sum."""
    energy, t = run.energy, np.asarray(run.t)
    size = max(float(np.nanmax(np.abs(values))) for values in energy[:3])
    curves = [Named(t, energy.kinetic, "kinetic", style.driver, italic=False)]
    for name, colour in (("potential", style.path), ("work", style.force)):
        values = getattr(energy, name)
        if float(np.ptp(values)) > STILL * size:
            curves.append(Named(t, values, name, colour, italic=False))
    if len(curves) > 1:
        total = energy.kinetic + energy.potential - energy.work
        curves.append(Named(t, total, SUM, style.second, italic=False))
    return t, curves


def _motions(run: Run, what: str, style: Style) -> tuple[Float, list[Any], str]:
    """Return a quantity of every driver over the time, and its unit."""
    if run.along_q:
        state: Any = run
        t = np.asarray(run.t)
    else:
        t = np.linspace(run.t[0], run.t[-1], POINTS)
        state = run.at(t)
    values = np.asarray(getattr(state, what)).reshape(len(t), -1)
    names, units = drivers(run.mechanism, values.shape[1])
    per = {"q": "", "speed": "/s", "acceleration": "/s²"}[what]
    mixed = len(set(units)) > 1
    alone = values.shape[1] == 1
    curves = [
        Named(
            t,
            values[:, k],
            f"{name}, {unit}{per}" if mixed else name,
            style.driver if alone else style.group(k),
            italic=False,
        )
        for k, (name, unit) in enumerate(zip(names, units, strict=True))
    ]
    return t, curves, " or ".join(f"{unit}{per}" for unit in dict.fromkeys(units))


def drivers(mechanism: Mechanism | None, count: int) -> tuple[list[str], list[str]]:
    """Return the names of the drivers and the units of their coordinates."""
    if mechanism is None:
        return ["driver"] * count, ["rad"] * count
    names, units = [], []
    for drive in mechanism.description.drivers:
        name = drive if isinstance(drive, str) else f"{drive.link} on {drive.relative_to}"
        names.append(name)
        units.append("m" if name in mechanism.slides else "rad")
    return names, units


def _extremes(run: Run, what: str, t: Float, curves: list[Any], power: float) -> list[Any]:
    """Return notes at the greatest and the least speed or acceleration."""
    if what not in ("speed", "acceleration"):
        return []
    slopes = None
    if what == "speed":
        state: Any = run if run.along_q else run.at(t)
        slopes = np.asarray(state.acceleration).reshape(len(t), -1)
    notes = []
    for k, curve in enumerate(curves):
        for peak in peaks(t, curve.y, None if slopes is None else slopes[:, k]):
            span = float(np.ptp(curve.y)) / power
            text = f"{number(peak.y / power, span)} at {number(peak.x)} s"
            notes.append(Note(peak.x, peak.y, text, curve.colour, "extreme"))
    return notes


def _event_lines(ax: Any, events: list[EventRecord], style: Style) -> None:
    for event in events:
        gid = f"event {event_text(event)}"
        ax.axvline(event.t, color=style.faint, linewidth=0.9, zorder=0.8, gid=gid)


def _event_notes(ax: Any, events: list[EventRecord], style: Style) -> list[Any]:
    """Return the names of the events at the upper side; the first of many alike is named."""
    bottom, top = ax.get_ylim()
    y = top - EVENTS * (top - bottom)
    counts: dict[str, int] = {}
    first: dict[str, float] = {}
    for event in events:
        text = event_text(event)
        counts[text] = counts.get(text, 0) + 1
        first.setdefault(text, float(event.t))
    return [
        Note(
            t, y, text if counts[text] == 1 else f"{text} ({counts[text]} times)", style.second,
            "event text", None,
        )
        for text, t in first.items()
    ]  # fmt: skip


def event_text(record: Any) -> str:
    """Return an event's name: a word, with what it is of."""
    event = record.event
    if isinstance(event, str):
        return event.replace("_", " ")
    if hasattr(event, "restitution"):
        return "impact"
    kind = type(event).__name__
    words = {
        "Rest": "rest",
        "Position": f"q = {getattr(event, 'q', 0.0):.4g}",
        "Speed": f"speed {getattr(event, 'speed', 0.0):.4g}",
        "TransmissionAngle": f"transmission angle at {getattr(event, 'name', '')}",
        "Crossing": "crossing",
    }
    return true_minus(words.get(kind, kind))
