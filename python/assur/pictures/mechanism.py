"""A mechanism at one position or at many: see `Mechanism.plot`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.errors import InputError
from assur.pictures import style as sizes
from assur.pictures.axes import Canvas, pyplot, scale_bar

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.kinematics.assembly import Assembly
    from assur.kinematics.mechanism import Mechanism
    from assur.pictures.subject import Subject

LABELS = ("all", "first", "none")


def mechanism_picture(
    mechanism: Mechanism,
    q: Any,
    ax: Any,
    assembly: Assembly | None,
    labels: str,
    groups: bool,
    dark: bool,
) -> Any:
    """See `Mechanism.plot`."""
    if mechanism.shape:
        message = (
            f"plot draws one mechanism, this is a batch {mechanism.shape}: take one with design(i)"
        )
        raise InputError(message)
    if labels not in LABELS:
        message = f'labels is {labels!r}: "all" names the joints, "first" numbers positions, "none"'
        raise InputError(message)
    pyplot()
    from assur.pictures.positions import draw_positions
    from assur.pictures.subject import Subject

    found = getattr(assembly, "q", None)
    places = (q, found, mechanism._q0_array())
    at = next(place for place in places if place is not None)
    motion = mechanism.solve(at, order=0, assembly=assembly)
    subject = Subject(motion, assembly)
    on = subject.canvas(ax, sizes.style(dark))
    if motion.shape:
        draw_positions(subject, on, labels, groups)
    else:
        draw_position(subject, on, subject.frames[0], labels != "none", groups)
    scale_bar(on)
    return on.ax


def draw_position(
    subject: Subject,
    on: Canvas,
    frames: Float,
    names: bool = True,
    groups: bool = False,
    lines: list[Float] | None = None,
) -> None:
    """Draw one position with its names clear of its lines and of others."""
    from assur.pictures.artists import Drawn
    from assur.pictures.formula import write_formula

    Drawn(on, subject.scene, frames, groups)
    if names:
        name_joints(subject, on, frames, lines or [])
    if groups:
        write_formula(subject, on)


def name_joints(subject: Subject, on: Canvas, frames: Float, lines: list[Float]) -> list[Any]:
    """Write the names of the joints."""
    from assur.pictures.text import write_names

    names = subject.scene.names
    radii = np.array([name.radius * on.size for name in names])
    return write_names(
        on,
        [name.text for name in names],
        subject.places(frames),
        radii,
        [*subject.lines(on, frames), *lines],
        [f"name {name.text}" for name in names],
    )
