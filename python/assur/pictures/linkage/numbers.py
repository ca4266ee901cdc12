"""Numbers of positions, outside the circle of the driver."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.font_manager import FontProperties
from matplotlib.text import Text

from assur.pictures.axes import TEXT
from assur.pictures.scene.labels import along, placed
from assur.pictures.scene.shapes import Vertex
from assur.pictures.text import STEP, text_size

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur._arrays import Float
    from assur.pictures.axes import Canvas
    from assur.pictures.linkage.subject import Subject

# Between the circle of the driver and the numbers, points.
GAP = 7.0
# How far a number may move along the circle to get clear of lines, rad.
SHIFTS = np.radians([0.0, 6.0, -6.0, 12.0, -12.0, 18.0, -18.0])
# At this distance from lines a number is clear of them, points; a shift must be worth it.
CLEAR, COST_OF_SHIFT = 2.0, 0.05


def write_numbers(subject: Subject, on: Canvas, lines: list[Float]) -> Float:
    """Number the positions from 0; return the boxes of the numbers, points, (n, 2, 2).

    Where positions are close only every second one has its number, or every third …
    """
    obstacles = along([on.points(line) for line in lines], STEP)
    plain = FontProperties(size=TEXT)
    crank = _crank(subject)
    place = _driven_point if crank is None else partial(_pin, crank=crank)
    points = on.points([place(subject, frames) for frames in subject.frames])
    halves = np.array([text_size(str(i), plain) for i in range(len(points))]) / 2.0
    chosen = _thinned(points, halves)
    points, halves = points[chosen], halves[chosen]
    if crank is not None:
        centre = on.points(subject.whole.local["ground"][crank[1]])
        middles = _around(centre, points, halves, obstacles)
    else:
        bounds = (on.points(on.low), on.points(on.high))
        radii = np.full(len(points), GAP)
        middles = placed(points, 2.0 * halves, radii, obstacles, bounds)
    bold = FontProperties(size=TEXT, weight="bold")
    for i, (x, y) in zip(chosen.tolist(), middles / on.scale, strict=True):
        on.ax.add_artist(
            Text(
                x,
                y,
                str(i),
                fontproperties=plain if i else bold,
                color=on.style.second if i else on.style.driver,
                horizontalalignment="center",
                verticalalignment="center",
                zorder=4.0,
                gid=f"number {i}",
            )
        )
    return np.stack([middles, halves], axis=1)


def _crank(subject: Subject) -> tuple[str, str, str] | None:
    """Return a driven link that turns about the ground, its pivot, and its farthest joint."""
    ground = subject.whole.local.get("ground", {})
    for link in subject.scene.links:
        local = subject.whole.local[link]
        fixed = [joint for joint in local if joint in ground]
        if link in subject.scene.driven and len(fixed) == 1 and len(local) > 1:
            pivot = local[fixed[0]]
            tip = max(local, key=lambda joint: float(np.hypot(*(local[joint] - pivot))))
            return link, fixed[0], tip
    return None


def _driven_point(subject: Subject, frames: Float) -> Float:
    """Return a joint that moves with the first driver, or any moving joint."""
    first = subject.mechanism.description.drivers[0]
    slide = subject.mechanism.slides.get(first) if isinstance(first, str) else None
    link = slide.link if slide is not None else str(getattr(first, "link", first))
    of_link = [name for name in subject.scene.names if name.text in subject.whole.local[link]]
    moving = [name for name in subject.scene.names if name.link != "ground"]
    name = (of_link or moving or list(subject.scene.names))[-1]
    return subject.world(frames, name.link, name.at)


def _pin(subject: Subject, frames: Float, crank: tuple[str, str, str]) -> Float:
    """Return the crank's farthest joint."""
    link, _, tip = crank
    x, y = subject.whole.local[link][tip]
    return subject.world(frames, link, Vertex(x, y))


def _thinned(points: Float, halves: Float) -> npt.NDArray[np.intp]:
    """Return every k-th index, k the least for which neighbours have room for their numbers."""
    count = len(points)
    for step in range(1, count):
        chosen = np.arange(0, count, step)
        apart = np.abs(np.diff(points[chosen], axis=0)) - halves[chosen[1:]] - halves[chosen[:-1]]
        if (apart.max(axis=1) > 0.0).all():
            return chosen
    return np.array([0])


def _around(centre: Float, points: Float, halves: Float, obstacles: Float) -> Float:
    """Return places outside the crank circle, shifted along it off the lines."""
    radius = float(np.hypot(*(points[0] - centre))) + GAP
    middles = np.empty_like(halves)
    arms = points - centre
    turns = np.unwrap(np.arctan2(arms[:, 1], arms[:, 0]))
    # A number stays nearer to its own position than to the next.
    room = np.abs(np.diff(turns)) / 2.0
    room = np.minimum(np.append(room, np.inf), np.append(np.inf, room))
    for i, half in enumerate(halves):
        angles = turns[i] + np.clip(SHIFTS, -room[i], room[i])
        directions = np.stack([np.cos(angles), np.sin(angles)], axis=1)
        places = centre + directions * (radius + np.abs(directions) @ half)[:, None]
        # No farther than a shift goes and beyond that a line matters.
        reach = SHIFTS.max() * (radius + half.max()) + half.max() + CLEAR
        near = obstacles[(np.abs(obstacles - places[0]) < reach).all(axis=1)]
        apart = (np.abs(near[None] - places[:, None]) - half).max(axis=-1)
        clear = apart.min(axis=1, initial=np.inf)
        for j in range(i):
            gap = (np.abs(middles[j] - places) - half - halves[j]).max(axis=-1)
            clear = np.minimum(clear, gap)
        best = int(np.argmax(np.minimum(clear, CLEAR) - COST_OF_SHIFT * np.arange(len(SHIFTS))))
        middles[i] = places[best]
    return middles
