"""A mechanism at one position or at many: see `Mechanism.plot`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur._validate import one_of
from assur.errors import InputError
from assur.pictures.axes import scale_bar
from assur.pictures.linkage.position import draw_position
from assur.pictures.linkage.positions import draw_positions
from assur.pictures.linkage.subject import Subject
from assur.pictures.style import style_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.axes import Axes

    from assur._faces import Mechanism

LABELS = ("first", "all", "none")


def mechanism_picture(
    mechanism: Mechanism,
    q: Any,
    ax: Any,
    assembly: Mapping[str, int] | None,
    labels: str,
    groups: bool,
    dark: bool,
) -> Axes:
    """See `Mechanism.plot`."""
    if mechanism.shape:
        message = (
            f"plot draws one mechanism, this is a batch {mechanism.shape}: take one with design(i)"
        )
        raise InputError(message)
    one_of(labels, LABELS, "labels")
    assembly_q = getattr(assembly, "q", None)
    places = (q, assembly_q, mechanism.q0_array)
    at = next(place for place in places if place is not None)
    motion = mechanism.solve(at, order=0, assembly=assembly)
    if 0 in motion.shape:
        message = f"q has shape {np.shape(at)}: there is no position to draw"
        raise InputError(message)
    subject = Subject(motion)
    on = subject.canvas(ax, style_of(dark), groups=groups)
    if motion.shape:
        draw_positions(subject, on, labels, groups)
    else:
        draw_position(subject, on, subject.frames[0], labels != "none", groups)
    scale_bar(on)
    return on.ax
