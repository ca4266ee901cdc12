"""Many positions in one picture: the first bold, the others light and numbered."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.font_manager import FontProperties
from matplotlib.lines import Line2D
from matplotlib.text import Text

from assur.pictures.axes import TEXT, Canvas
from assur.pictures.mechanism import draw_position
from assur.pictures.scene.labels import along
from assur.pictures.scene.parts import Stroke
from assur.pictures.subject import outline
from assur.pictures.text import STEP, text_size

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.pictures.subject import Subject

FAINT_LINE, DOTTED = 0.8, (0.0, (1.0, 2.4))
# Between the circle of the driver and the numbers, points.
NUMBER_GAP = 9.0
# A number moves up to so far along the circle to get clear of lines, rad.
SHIFTS = np.radians([0.0, 6.0, -6.0, 12.0, -12.0, 18.0, -18.0])
LIMIT_TICK = 7.0


def draw_positions(subject: Subject, on: Canvas, labels: str, groups: bool) -> None:
    """Draw the first position with all symbols, the others as light lines."""
    light = [_light_lines(subject, on, frames) for frames in subject.frames[1:]]
    for lines in light:
        for line in lines:
            on.ax.add_artist(
                Line2D(
                    *line.T,
                    color=on.style.faint,
                    linewidth=FAINT_LINE,
                    zorder=1.0,
                    gid="position",
                    solid_capstyle="round",
                )
            )
    crank = _driven_joint(subject)
    traces = [*_traces(subject, on)]
    if labels != "none" and crank is not None:
        _write_numbers(subject, on, crank, [line for lines in light for line in lines], labels)
    draw_position(subject, on, subject.frames[0], labels != "none", groups, traces)


def _light_lines(subject: Subject, on: Canvas, frames: Float) -> list[Float]:
    """Return the lines of the links alone: no pivots, blocks and arrows."""
    return [
        line
        for part in subject.scene.parts
        if isinstance(part, Stroke) and part.name.startswith("link ") and part.link != "ground"
        if (line := outline(part, on, subject, frames)) is not None
    ]


def _driven_joint(subject: Subject) -> tuple[str, str, str] | None:
    """Return the driven link with its pivot and the joint farthest from it."""
    for link in subject.scene.driven:
        local = subject.whole.local[link]
        fixed = [joint for joint in local if joint in subject.whole.local.get("ground", {})]
        if fixed and len(local) > 1:
            pivot = local[fixed[0]]
            tip = max(local, key=lambda joint: float(np.hypot(*(local[joint] - pivot))))
            return link, fixed[0], tip
    return None


def _traces(subject: Subject, on: Canvas) -> list[Float]:
    """Draw where the joints of links that turn about the ground go, and where they turn back."""
    ground = subject.whole.local.get("ground", {})
    drawn = []
    for link, local in subject.whole.local.items():
        pivots = [joint for joint in local if joint in ground]
        if link == "ground" or len(pivots) != 1:
            continue
        pivot = ground[pivots[0]]
        angles = subject.whole.angle(link)
        swing = float(np.ptp(angles))
        for joint, at in local.items():
            if joint == pivots[0]:
                continue
            arm = at - local[pivots[0]]
            own = float(np.arctan2(arm[1], arm[0]))
            low, high = float(angles.min()) + own, float(angles.max()) + own
            turn = np.linspace(low, min(high, low + 2.0 * np.pi), 121)
            radius = float(np.hypot(*arm))
            points = pivot + radius * np.stack([np.cos(turn), np.sin(turn)], axis=1)
            on.ax.add_artist(
                Line2D(
                    *points.T,
                    color=on.style.second,
                    linewidth=0.9,
                    linestyle=DOTTED,
                    alpha=0.7,
                    zorder=1.2,
                    gid=f"trace {joint}",
                )
            )
            drawn.append(points)
            if swing < 2.0 * np.pi - 1e-6:
                for angle in (low, high):
                    radial = np.array([np.cos(angle), np.sin(angle)])
                    middle, tick = pivot + radius * radial, LIMIT_TICK / on.scale * radial
                    ends = np.array([middle - tick, middle + tick])
                    on.ax.add_artist(
                        Line2D(
                            *ends.T,
                            color=on.style.second,
                            linewidth=1.4,
                            zorder=1.3,
                            gid=f"limit {link}",
                        )
                    )
                    drawn.append(ends)
    return drawn


def _write_numbers(
    subject: Subject, on: Canvas, crank: tuple[str, str, str], lines: list[Float], labels: str
) -> None:
    """Write the positions' numbers outside the crank circle, shifted off the lines."""
    link, pivot, tip = crank
    local = subject.whole.local[link]
    centre = subject.whole.local["ground"][pivot]
    arm = local[tip] - local[pivot]
    radius = float(np.hypot(*arm)) * on.scale + NUMBER_GAP
    own = float(np.arctan2(arm[1], arm[0]))
    index = subject.scene.links.index(link)
    every = 3 if labels == "first" and len(subject.frames) > 4 else 1
    font = FontProperties(size=TEXT)
    bold = FontProperties(size=TEXT, weight="bold")
    obstacles = along([on.points(line) for line in lines], STEP)
    for i, frames in enumerate(subject.frames):
        if i % every:
            continue
        angles = float(frames[index, 2]) + own + SHIFTS
        half = np.array(text_size(str(i), font)) / 2.0
        directions = np.stack([np.cos(angles), np.sin(angles)], axis=1)
        middles = on.points(centre) + directions * (radius + directions.__abs__() @ half)[:, None]
        near = obstacles[(np.abs(obstacles - middles[0]) < 60.0).all(axis=1)]
        apart = np.abs(near[None] - middles[:, None]) - half
        clear = apart.max(axis=-1).min(axis=1, initial=np.inf)
        # The least shift that is clear of all lines.
        best = int(np.argmax(np.minimum(clear, 1.5) - 0.02 * np.arange(len(SHIFTS))))
        x, y = middles[best] / on.scale
        on.ax.add_artist(
            Text(
                x,
                y,
                str(i),
                fontproperties=bold if i == 0 else font,
                zorder=4.0,
                color=on.style.driver if i == 0 else on.style.second,
                horizontalalignment="center",
                verticalalignment="center",
                gid=f"number {i}",
            )
        )
