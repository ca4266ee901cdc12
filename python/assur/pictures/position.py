"""One position on a canvas: its symbols and the names of its joints."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.pictures.artists import Drawn
from assur.pictures.formula import write_formula
from assur.pictures.text import write_names

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.pictures.axes import Canvas
    from assur.pictures.subject import Subject


def draw_position(
    subject: Subject,
    on: Canvas,
    frames: Float,
    names: bool = True,
    groups: bool = False,
    lines: list[Float] | None = None,
    boxes: Float | None = None,
) -> None:
    """Draw one position with its names clear of its lines and other texts, then of light lines."""
    Drawn(on, subject.scene, frames, groups)
    if names:
        name_joints(subject, on, frames, boxes, lines)
    if groups:
        write_formula(subject.mechanism, on)


def name_joints(
    subject: Subject,
    on: Canvas,
    frames: Float,
    boxes: Float | None = None,
    light: list[Float] | None = None,
) -> list[Any]:
    """Write the names of the joints."""
    names = subject.scene.names
    radii = np.array([name.radius * on.size for name in names])
    return write_names(
        on,
        [name.text for name in names],
        subject.places(frames),
        radii,
        subject.lines(on, frames),
        [f"name {name.text}" for name in names],
        boxes,
        light,
    )
