"""Wittenbauer's diagram: energy over reduced inertia, with the tangents at the extreme speeds."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.pictures import chart
from assur.pictures.diagrams.line_names import Named, name_lines
from assur.pictures.diagrams.notes import Note, write_notes
from assur.pictures.diagrams.obstacles import obstacles
from assur.pictures.numerals import degrees_text, number
from assur.pictures.points import in_points, settle
from assur.pictures.scene.labels import clearance
from assur.pictures.text import plain_size

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur._faces import Flywheel
    from assur.pictures.style import Style

# Beside the loop, relative to it: left for the intercept, right, and above and below.
LEFT, RIGHT, ABOVE = 0.42, 0.22, 0.16
# Tangents are steep if they rise by this multiple of the loop's height from the side to it.
STEEP = 1.5
# From the frame to the intercept, relative to the picture.
INSET = 0.02
# A loop without width is drawn as wide as this fraction of the inertia.
THIN = 0.2
# The angle between dots; every second dot has its name.
DOTS, NAMES = np.pi / 6.0, 2
# From the intercept to its text, points.
GAP = 6.0


def wittenbauer_diagram(flywheel: Flywheel, q: Float, ax: Any, style: Style) -> Any:
    """Draw the loop of one turn and both tangents; they meet at minus the flywheel."""
    axes = chart.chart_axes(ax, style)
    inertia, energy = flywheel.energy_mass(points=len(q))
    axes.plot(inertia, energy, color=style.ink, linewidth=chart.CURVE, gid="curve loop", zorder=2.0)
    corner = -flywheel.inertia, -flywheel.inertia * flywheel.speed0**2 / 2.0
    low, high, steep = _width(inertia, energy, float(flywheel.max.value))
    reach = np.array([low, high])
    tangents = []
    for name, extreme, colour in (
        ("greatest", flywheel.max, style.driver),
        ("least", flywheel.min, style.error),
    ):
        line = corner[1] + float(extreme.value) ** 2 / 2.0 * (reach - corner[0])
        axes.plot(reach, line, color=colour, linewidth=1.4, gid=f"tangent {name}", zorder=1.8)
        tangents.append((line, extreme, colour))
    lines = [line for line, *_ in tangents]
    axes.set(xlim=(low, high), ylim=_height(energy, [] if steep else lines))
    unit, _ = chart.scaled(axes, "J", float(np.abs(axes.get_ylim()).max()))
    title = f"Wittenbauer: energy, {unit}, over inertia, kg·m²"
    chart.title(axes, title, style, _sentence(flywheel, corner))
    axes.set_xlabel("reduced inertia, kg·m²", color=style.second, fontsize=chart.TEXT)
    settle(axes)
    _intercept(axes, lines, steep, style)
    notes = []
    for _, extreme, colour in tangents:
        at = np.array([extreme.q])
        point = _point(flywheel, at)
        notes.append(Note(float(point[0][0]), float(point[1][0]), "", colour, "contact"))
    write_notes(axes, [note._replace(gid="contact") for note in notes], style)
    _dots(axes, flywheel, q, style)
    span = float(flywheel.max.value - flywheel.min.value)
    gap = "\n" if steep else " "
    named = [
        Named(
            np.linspace(low, high, 200),
            np.linspace(line[0], line[1], 200),
            f"slope ω²/2{gap}at {number(float(extreme.value), span)} rad/s",
            colour,
            italic=False,
        )
        for line, extreme, colour in tangents
    ]
    name_lines(axes, named)
    return axes


def _width(inertia: Float, energy: Float, speed: float) -> tuple[float, float, bool]:
    """Return the limits of the abscissa, and whether tangents are too steep to meet its left end.

    For a flat loop they may be much steeper than it is high.
    """
    low, high = float(inertia.min()), float(inertia.max())
    span = high - low
    if span <= 1e-9 * abs(high):
        span = THIN * (abs(high) or 1.0)
    rise = speed**2 / 2.0 * LEFT * span
    steep = float(np.ptp(energy)) < rise / STEEP
    return low - LEFT * span, high + (LEFT if steep else RIGHT) * span, steep


def _sentence(flywheel: Flywheel, corner: tuple[float, float]) -> str:

    start = f"δ = {flywheel.delta:.3g}"
    if not flywheel.inertia:
        return f"{start} without a flywheel: the tangents meet at I = 0, E = 0"
    inertia = f"{flywheel.inertia:.4g}"
    return f"{start}; the tangents meet at I = −{inertia} kg·m², E = {number(corner[1])} J"


def _point(flywheel: Flywheel, q: Float) -> tuple[Float, Float]:
    first = float(flywheel.reduced_inertia(flywheel.turn[0]))
    energy = np.asarray(flywheel.work(q)) + first * flywheel.speed0**2 / 2.0
    return np.asarray(flywheel.reduced_inertia(q)), energy


def _height(energy: Float, tangents: list[Float]) -> tuple[float, float]:
    """Return the limits of the ordinate, with what the tangents cut off the left side."""
    shown = np.array([*energy, *(float(line[0]) for line in tangents)])
    bottom, top = float(shown.min()), float(shown.max())
    room = ABOVE * (top - bottom or 1.0)
    # Steep tangents are measured at the bottom.
    return bottom - (room if tangents else 2.5 * room), top + room


def _intercept(ax: Any, tangents: list[Float], steep: bool, style: Style) -> None:
    """Draw what the tangents cut off the frame as a length with its value.

    On the left side it is an energy; for steep tangents it is an inertia at the bottom.
    """
    (x0, x1), (y0, y1) = ax.get_xlim(), ax.get_ylim()
    ends = np.array([float(line[0]) for line in tangents])
    if not steep:
        x = x0 + INSET * (x1 - x0)
        points = np.column_stack([np.full(11, x), np.linspace(ends[0], ends[1], 11)])
        text, aside = f"{number(ends[0] - ends[1])} J\nat the frame", np.array([1.0, 0.0])
    else:
        y = y0 + 2.0 * INSET * (y1 - y0)
        ends = np.array([x0 + (y - a) / (b - a) * (x1 - x0) for a, b in tangents])
        points = np.column_stack([np.linspace(ends[0], ends[1], 11), np.full(11, y)])
        text, aside = f"{number(abs(ends[1] - ends[0]))} kg·m²\nat the frame", np.array([0.0, 1.0])
    arrow = {
        "arrowstyle": "<|-|>", "color": style.second, "linewidth": 1.1, "shrinkA": 0.0,
        "shrinkB": 0.0, "mutation_scale": 9.0,
    }  # fmt: skip
    ax.annotate("", points[0], xytext=points[-1], gid="intercept", arrowprops=arrow).set_in_layout(
        False
    )
    width, height = plain_size("at the frame", chart.TEXT)
    half = np.array([width + 2.0, 2.6 * height + 2.0]) / 2.0
    near = in_points(ax, points)[1:-1]
    middles = near + aside * (GAP + half)
    clear = clearance(middles, half, obstacles(ax))
    # The middle, if that is clear.
    best = int(np.argmax(np.minimum(clear, 8.0) - 0.5 * np.abs(np.arange(9) - 4.0)))
    ax.annotate(
        text, points[1 + best], xytext=middles[best] - near[best], textcoords="offset points",
        horizontalalignment="center", verticalalignment="center", color=style.second,
        fontsize=chart.TEXT, gid="intercept text", zorder=5.0,
    ).set_in_layout(False)  # fmt: skip


def _dots(ax: Any, flywheel: Flywheel, q: Float, style: Style) -> None:
    """Put a dot on the loop at every 30°, with the angle at some."""
    first, last = float(q[0]), float(q[-1])
    sign = float(np.copysign(1.0, last - first))
    start = int(np.ceil(sign * first / DOTS - 1e-6))
    numbers = np.arange(start, start + int(np.floor(abs(last - first) / DOTS + 1e-6)))
    places: Float = sign * DOTS * numbers.astype(np.float64)
    inertia, energy = _point(flywheel, places)
    ax.plot(
        inertia, energy, "o", color=style.ink, markersize=3.5, zorder=2.5, gid="dots",
        scalex=False, scaley=False,
    )  # fmt: skip
    notes = [
        Note(
            float(inertia[i]), float(energy[i]),
            degrees_text(float(np.degrees(places[i])), 360.0), style.second, "angle", None,
            optional=True,
        )
        for i in np.flatnonzero(numbers % NAMES == 0).tolist()
    ]  # fmt: skip
    write_notes(ax, notes, style)
