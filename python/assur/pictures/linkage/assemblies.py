"""All assemblies of a position side by side: see `Assemblies.plot`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.errors import InputError
from assur.pictures.axes import FOOT, MARGIN, checked_axes, listed_axes, plain_figure
from assur.pictures.chart import TEXT
from assur.pictures.linkage.artists import Drawn
from assur.pictures.linkage.position import name_joints
from assur.pictures.linkage.subject import Subject
from assur.pictures.style import style_of
from assur.pictures.text import plain_size, printable

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur._faces import Assembly, Panels
    from assur.pictures.axes import Canvas

# Width of a picture, inches, and the limits of its height.
WIDTH, LEAST_HEIGHT, GREATEST_HEIGHT = 2.6, 1.8, 3.2
COLUMNS = 4
# More are not drawn in a figure of their own, which says how many there are.
MOST = 24
# Longer names of joints have no room.
LONGEST = 3


def assemblies_picture(assemblies: Sequence[Assembly], ax: Any, dark: bool) -> Panels:
    """See `Assemblies.plot`."""
    if not len(assemblies):
        message = "there is no assembly at this coordinate: nothing to draw"
        raise InputError(message)

    style = style_of(dark)
    subjects = []
    shown = list(assemblies)[: MOST if ax is None else None]
    for assembly in shown:
        place = assembly.place
        assert place is not None
        q = np.array(place.q) if len(place.q) > 1 else place.q[0]
        motion = place.mechanism.solve(q, order=0, assembly=assembly)
        subject = Subject(motion)
        # Here the position alone is seen.
        subject.whole = subject.at
        subjects.append(subject)
    corners = np.concatenate([subject.points() for subject in subjects])
    extent = np.stack([corners.min(axis=0), corners.max(axis=0)])
    axes: Panels = _axes(len(shown), extent, ax, style)
    for i, (panel, subject, assembly) in enumerate(zip(axes, subjects, shown, strict=True)):
        on = subject.canvas(panel, style, [extent])
        Drawn(on, subject.scene, subject.frames[0])
        if max(len(name.text) for name in subject.scene.names) <= LONGEST:
            name_joints(subject, on, subject.frames[0])
        panel.set_title(
            _title(i, assembly, on), color=style.second, fontsize=TEXT, y=0.0,
            pad=4.0, gid="title", parse_math=False,
        )  # fmt: skip
    if len(shown) < len(assemblies):
        axes[0].figure.suptitle(
            f"{len(shown)} of {len(assemblies)} assemblies", color=style.second, fontsize=TEXT
        )
    return axes


def _title(index: int, assembly: Assembly, on: Canvas) -> str:
    """Return its index in the list and the signs of dyads; higher groups have none."""
    signs = [(printable(name), "+" if sign > 0 else "−") for name, sign in assembly.items()]
    whole = "  ".join(f"{name} {sign}" for name, sign in signs)
    room = float(on.points(on.high - on.low)[0])
    if plain_size(whole, TEXT)[0] > 0.8 * room:
        # In the order of the dyads.
        whole = " ".join(sign for _, sign in signs)
    return f"[{index}]   {whole}".rstrip()


def _axes(count: int, extent: Any, ax: Any, style: Any) -> Any:
    if ax is not None:
        panels = listed_axes(ax)
        if len(panels) < count:
            message = f"ax has {len(panels)} axes, there are {count} assemblies: each needs its own"
            raise InputError(message)
        return np.array([checked_axes(panel) for panel in panels[:count]], dtype=object)
    columns = min(count, COLUMNS)
    rows = -(-count // columns)
    span = np.maximum(extent[1] - extent[0], 1e-300)
    tall = (WIDTH - 2.0 * MARGIN / 72.0) * span[1] / span[0] + (2.0 * MARGIN + FOOT) / 72.0
    height = float(np.clip(tall, LEAST_HEIGHT, GREATEST_HEIGHT))
    figure = plain_figure((WIDTH * columns, height * rows), style)
    axes = []
    for i in range(count):
        row, column = divmod(i, columns)
        box = (column / columns, 1.0 - (row + 1) / rows, 1.0 / columns, 1.0 / rows)
        axes.append(figure.add_axes(box, facecolor=style.canvas))
    return np.array(axes, dtype=object)
