"""Paths of joints with the mechanism at one position: see `Motion.plot`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.lines import Line2D

from assur._validate import checked_index, checked_names
from assur.description.words import is_reached
from assur.errors import InputError
from assur.pictures.axes import scale_bar
from assur.pictures.linkage.path_arrows import PathArrows
from assur.pictures.linkage.position import draw_position
from assur.pictures.linkage.subject import Subject, assembly_of
from assur.pictures.style import style_of
from assur.pictures.text import name_boxes

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

    from assur._arrays import Float
    from assur._faces import Motion
    from assur.pictures.axes import Canvas

# Dots on a path stand at equal steps of q: far apart is fast.
DOTS = 24
PATH, DOT, NOW = 2.0, 2.4, 5.0
KINDS = ("velocity", "acceleration")
# Line styles of the first path, the second, and so on.
DASHES: tuple[Any, ...] = ("solid", (0.0, (5.0, 3.0)), (0.0, (5.0, 2.0, 1.0, 2.0)))


def path_picture(
    motion: Motion,
    joint: str | Sequence[str] | None,
    ax: Any,
    at: int | None,
    vectors: str | Sequence[str] | None,
    speeds: tuple[Any, Any],
    groups: bool,
    dark: bool,
) -> Axes:
    """See `Motion.plot`."""
    if motion.mechanism.shape or len(motion.shape) != 1:
        message = f"plot draws paths over q of one mechanism; this motion has shape {motion.shape}"
        raise InputError(message)

    joints = checked_names(joint, "joint")
    paths = [motion.joint(name).value for name in joints]
    row = _row(motion, at)
    # Solved again: the motion may hold some joints alone.
    at_row = motion.mechanism.solve(motion.coordinate(row), order=0, assembly=assembly_of(motion))
    subject = Subject(at_row)
    known = [path[np.isfinite(path).all(axis=1)] for path in paths]
    arrows = [
        PathArrows(motion, joints, kind, speeds, row, subject.size)
        for kind in _kinds(vectors, joints)
    ]
    seen = [*known, *(tips for arrow in arrows for tips in arrow.tips())]
    on = subject.canvas(ax, style_of(dark), seen, groups=groups)
    for i, (name, path) in enumerate(zip(joints, paths, strict=True)):
        draw_path(on, path, name, DASHES[i % len(DASHES)], path[row])
    draw_position(subject, on, subject.frames[0], groups=groups, lines=known)
    lines = [*known, *subject.lines(on, subject.frames[0])]
    lines += [shaft for arrow in arrows for shaft in arrow.shafts()]
    boxes = [name_boxes(on)]
    for arrow in arrows:
        arrow.draw(on, lines, boxes)
    scale_bar(on)
    return on.ax


def _kinds(vectors: str | Sequence[str] | None, joints: list[str]) -> list[str]:
    """Return the kinds of vectors to draw."""
    kinds = checked_names(vectors, "vectors")
    for kind in kinds:
        if kind not in KINDS:
            message = f'vectors has {kind!r}: "velocity" or "acceleration" is needed'
            raise InputError(message)
    if kinds and not joints:
        message = f"vectors={vectors!r} stand on the paths of joints: name a joint"
        raise InputError(message)
    return kinds


def _row(motion: Motion, at: int | None) -> int:
    """Return the position drawn: the first that exists, if none is chosen."""
    if at is not None:
        (row,) = checked_index(at, motion.shape, "at")
        if not is_reached(motion.status[row]):
            raise InputError(motion.explain(row))
        return row
    reached = np.flatnonzero(is_reached(motion.status))
    if not reached.size:
        raise InputError(f"there is no position to draw: {motion.explain(0)}")
    return int(reached[0])


def draw_path(on: Canvas, path: Float, name: str, dashes: Any = "solid", now: Any = None) -> None:
    """Draw a joint's path with dots at equal steps of q, and where the joint is now."""
    style, size = on.style, on.size
    line = Line2D(
        *path.T,
        color=style.path,
        linewidth=PATH * size,
        linestyle=dashes,
        zorder=1.6,
        gid=f"path {name}",
        solid_capstyle="round",
        dash_capstyle="butt",
    )
    step = max(1, (len(path) - 1) // DOTS)
    dots = Line2D(
        *path[::step].T,
        color=style.path,
        linestyle="none",
        marker="o",
        markersize=2.0 * DOT * size,
        markeredgewidth=0.0,
        zorder=1.7,
        gid=f"dots {name}",
    )
    for artist in (line, dots):
        on.ax.add_artist(artist)
    if now is not None:
        point = Line2D(
            [now[0]],
            [now[1]],
            color=style.path,
            linestyle="none",
            marker="o",
            markersize=2.0 * NOW * size,
            markeredgecolor=style.canvas,
            markeredgewidth=1.2 * size,
            zorder=3.0,
            gid=f"now {name}",
        )
        on.ax.add_artist(point)
