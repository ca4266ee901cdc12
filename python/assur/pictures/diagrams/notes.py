"""Texts on diagrams, kept clear of curves and of each other."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from assur.pictures.chart import MARK, TEXT, dot
from assur.pictures.diagrams.obstacles import obstacles, outline
from assur.pictures.points import bounds, in_points
from assur.pictures.scene.labels import along, clearance, within
from assur.pictures.text import STEP, plain_size, printable

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur._arrays import Float
    from assur.pictures.style import Style

# Gaps between a point and its text that are tried, points; beyond ENOUGH from curves no place is
# better; what a point of gap costs, and a text that is beside its point and not above or below.
REACHES, ENOUGH, FARTHER, HABIT = (2.0, 8.0, 16.0, 28.0), 7.0, 0.35, 2.0
# An optional text nearer to others than this, points, is left out.
LEAST = 0.5
# Gap from its point for a text that may lie on it.
SHIFTS = (0.0, 8.0, -8.0, 16.0, -16.0, 24.0, -24.0)


class Note(NamedTuple):
    """A text that belongs to a point of a diagram, in the units of its data."""

    x: float
    y: float
    text: str
    colour: str
    gid: str = "mark text"
    marker: str | None = "o"
    size: float = TEXT
    # Where there is no room, nothing is written.
    optional: bool = False
    # Whether it may lie on its point, in an area.
    centred: bool = False


def write_notes(ax: Any, notes: Sequence[Note], style: Style) -> None:
    """Mark points and write beside them, on a settled figure."""
    for note in notes:
        if note.marker:
            dot(ax, note.x, note.y, note.colour, style, note.marker)
    if not notes:
        return
    points = in_points(ax, np.array([(note.x, note.y) for note in notes]))
    middles = _placed(ax, points, notes)
    for note, point, middle in zip(notes, points, middles, strict=True):
        if middle is None:
            continue
        written = ax.annotate(
            printable(note.text), (note.x, note.y), xytext=middle - point,
            textcoords="offset points",
            horizontalalignment="center", verticalalignment="center", color=style.ink,
            fontsize=note.size, zorder=5.0, gid=note.gid, parse_math=False,
        )  # fmt: skip
        if not note.centred:
            # The grid stops at the text.
            written.set_bbox({"facecolor": style.canvas, "edgecolor": "none", "pad": 0.6})
        written.set_in_layout(False)


def _placed(ax: Any, points: Float, notes: Sequence[Note]) -> list[Any]:
    """Return the middles of the texts, the nearest to their points that are clear."""
    frame, blocked = bounds(ax), obstacles(ax)
    placed: list[Any] = []
    for note, point in zip(notes, points, strict=True):
        half = (np.array(plain_size(note.text, note.size)) + 2.0) / 2.0
        middles, costs = _places(note, point, half)
        apart, border = clearance(middles, half, blocked), within(middles, half, frame)
        # Texts may come closer to the border than to curves.
        worth = np.minimum(np.minimum(apart, ENOUGH), 3.0 * border - 2.0) - costs
        best = int(np.argmax(worth))
        if note.optional and min(apart[best], border[best]) < LEAST:
            placed.append(None)
            continue
        placed.append(middles[best])
        blocked = np.concatenate([blocked, along([outline(middles[best], half)], STEP)])
    return placed


def _places(note: Note, point: Float, half: Float) -> tuple[Float, Float]:
    """Return the middles that a text may have, and what each costs."""
    angles = np.arange(16) * (np.pi / 8.0) + np.pi / 2.0
    directions = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    reaches = np.array(REACHES[:2] if note.optional else REACHES)
    gaps = reaches[:, None] + (MARK / 2.0 if note.marker else 0.0) + np.abs(directions) @ half
    middles = (point + directions * gaps[..., None]).reshape(-1, 2)
    costs = (FARTHER * reaches[:, None] + HABIT * (1.0 - np.abs(directions[:, 1]))).reshape(-1)
    if not note.centred:
        return middles, costs
    shifts = np.array([(x, y) for x in SHIFTS for y in (0.0, 3.0, -3.0)])
    nearby = 0.05 * np.abs(shifts).sum(axis=1)
    return np.concatenate([middles, point + shifts]), np.concatenate([costs, nearby])
