"""One position on a canvas: its symbols and the names of its joints."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from assur.pictures.linkage.artists import Drawn
from assur.pictures.linkage.structural_formula import write_formula
from assur.pictures.text import write_names

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur._arrays import Float
    from assur.pictures.axes import Canvas
    from assur.pictures.linkage.subject import Subject


class NamedPoint(NamedTuple):
    """A point beside the joints that has a name: where, m, and the radius of its dot, points."""

    text: str
    at: Float
    radius: float
    gid: str


def draw_position(
    subject: Subject,
    on: Canvas,
    frames: Float,
    names: bool = True,
    groups: bool = False,
    lines: list[Float] | None = None,
    boxes: Float | None = None,
    marks: Sequence[NamedPoint] = (),
) -> None:
    """Draw one position with its names, and those of marks.

    They stand clear of its lines and other texts, `boxes`, and then of light `lines`.
    """
    Drawn(on, subject.scene, frames, groups)
    if names:
        name_joints(subject, on, frames, (), boxes, lines, marks)
    if groups:
        write_formula(subject.mechanism, on)


def name_joints(
    subject: Subject,
    on: Canvas,
    frames: Float,
    lines: Sequence[Float] = (),
    boxes: Float | None = None,
    light: list[Float] | None = None,
    marks: Sequence[NamedPoint] = (),
) -> list[Any]:
    """Write the names of the joints and of marks."""
    names = subject.scene.names
    radii = [*(name.radius * on.size for name in names), *(mark.radius for mark in marks)]
    return write_names(
        on,
        [*(name.text for name in names), *(mark.text for mark in marks)],
        np.array([*subject.places(frames), *(mark.at for mark in marks)]).reshape(-1, 2),
        np.array(radii),
        [*subject.lines(on, frames), *lines],
        [*(f"name {name.text}" for name in names), *(mark.gid for mark in marks)],
        boxes,
        light,
    )


def free_name(subject: Subject, *names: str) -> str:
    """Return the first name that no joint has."""
    joints = {name.text for name in subject.scene.names}
    return next((name for name in names if name not in joints), names[0])
