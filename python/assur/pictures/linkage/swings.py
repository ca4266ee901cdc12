"""Links that swing about the ground: the arcs of their joints and where they turn back."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from matplotlib.font_manager import FontProperties
from matplotlib.lines import Line2D
from matplotlib.text import Text

from assur.errors import AssurError
from assur.pictures.axes import FOOT, TEXT
from assur.pictures.numerals import angle_text
from assur.pictures.text import printable, text_size

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur._faces import Mechanism
    from assur.pictures.axes import Canvas
    from assur.pictures.linkage.subject import Subject

DOTTED = (0.0, (1.0, 2.4))
LIMIT_TICK = 7.0
# More swings than these are not written, but drawn.
WRITTEN = 2


class Swing(NamedTuple):
    """A link that turns about the ground: its pivot, its extreme angles unless it goes round."""

    link: str
    pivot: str
    extremes: tuple[float, float] | None


def swings(mechanism: Mechanism, assembly: dict[str, int]) -> list[Swing]:
    """Return the links that turn about the ground; with several drivers none is known."""
    if mechanism.driver_count > 1:
        return []
    ground = set(mechanism.links.get("ground", ()))
    listed = []
    for link, joints in mechanism.links.items():
        pivots = [joint for joint in joints if joint in ground]
        if link != "ground" and len(pivots) == 1 and len(joints) > 1:
            signs = [assembly[name] for name, _ in mechanism.core.assembly]
            try:
                ends = mechanism.core.extremes(mechanism.values.tolist(), signs, link, 0)
            except AssurError:
                # Not every assembly of a higher group can be followed to its ends.
                continue
            if ends is not None:
                limits = ends[0][0], ends[1][0]
                listed.append(Swing(link, pivots[0], limits if np.isfinite(limits).all() else None))
    return listed


def draw_traces(subject: Subject, on: Canvas, listed: list[Swing]) -> list[Float]:
    """Draw the arcs of joints dotted, with ticks where they turn back; return their lines, m."""
    drawn = []
    for swing in listed:
        local = subject.whole.local[swing.link]
        centre = subject.whole.local["ground"][swing.pivot]
        low, high = swing.extremes or (0.0, 2.0 * np.pi)
        for joint, place in local.items():
            arm = place - local[swing.pivot]
            if not arm.any():
                continue
            radius, start = float(np.hypot(*arm)), float(np.arctan2(arm[1], arm[0]))
            turn = start + np.linspace(low, min(high, low + 2.0 * np.pi), 121)
            arc = centre + radius * np.stack([np.cos(turn), np.sin(turn)], axis=1)
            drawn.append(_line(on, arc, f"trace {joint}", 0.9, DOTTED))
            for angle in swing.extremes or ():
                radial = np.array([np.cos(angle + start), np.sin(angle + start)])
                middle, tick = centre + radius * radial, LIMIT_TICK / on.scale * radial
                ends = np.array([middle - tick, middle + tick])
                drawn.append(_line(on, ends, f"limit {joint}", 1.4, "solid"))
    return drawn


def _line(on: Canvas, points: Float, gid: str, width: float, dashes: object) -> Float:
    on.ax.add_artist(
        Line2D(
            *points.T,
            color=on.style.second,
            linewidth=width,
            linestyle=dashes,  # type: ignore[arg-type]
            alpha=0.8,
            zorder=1.2,
            gid=gid,
        )
    )
    return points


def write_swings(subject: Subject, on: Canvas, listed: list[Swing]) -> Float:
    """Write the limits of what swings and the step of the positions; return their box, points."""
    parts = [
        f"{swing.link} from {' to '.join(angle_text(limit, 1) for limit in swing.extremes)}"
        for swing in listed
        if swing.extremes is not None
    ][:WRITTEN]
    step = _even_step(subject)
    if step is not None:
        parts.append(f"positions every {step}")
    parts = [printable(part) for part in parts]
    font = FontProperties(size=TEXT)
    # The scale bar is on the left.
    room = float((on.high[0] - on.low[0]) * on.scale) - 140.0
    while parts and text_size(", ".join(parts), font)[0] > room:
        parts.pop()
    text = ", ".join(parts)
    x, y = on.high[0] - 10.0 / on.scale, on.low[1] + 0.45 * FOOT / on.scale
    if text:
        on.ax.add_artist(
            Text(
                x,
                y,
                text,
                fontproperties=font,
                color=on.style.second,
                horizontalalignment="right",
                verticalalignment="center_baseline",
                zorder=5.0,
                gid="limits",
                parse_math=False,
            )
        )
    width, height = text_size(text, font) if text else (0.0, 0.0)
    middle = on.points((x, y)) - (width / 2.0, 0.0)
    return np.array([[middle, (width / 2.0, height / 2.0)]])


def _even_step(subject: Subject) -> str | None:
    """Return the step of the driven link if all are equal."""
    driven = sorted(subject.scene.driven)
    if len(driven) != 1 or len(subject.frames) < 3:
        return None
    steps = np.diff(subject.frames[:, subject.scene.links.index(driven[0]), 2])
    even = np.ptp(steps) <= 1e-9 * float(np.abs(steps).max())
    return f"{abs(np.degrees(steps[0])):.4g}°" if even and steps[0] else None
