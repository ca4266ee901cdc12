"""Names of joints, clear of lines and dimensions."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur.pictures.drawing.marks import (
    LETTER,
    NAME_HEIGHT,
    TEXT_HEIGHT,
    Diameter,
    Distance,
    Filled,
    Mark,
    Outline,
    Text,
)
from assur.pictures.scene.labels import along, placed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur._arrays import Float

# A mm in points of print.
POINT = 72.0 / 25.4
# Between points that stand for lines, mm of the paper.
STEP = 1.5


def dimension_lines(marks: Sequence[Mark]) -> list[Float]:
    """Return the lines of dimensions."""
    return [np.stack(mark.feet()) for mark in marks if isinstance(mark, Distance)]


def name_marks(
    texts: Sequence[str], points: Float, radii: Float, marks: Sequence[Mark], per: float
) -> list[Mark]:
    """Return names beside points, mm; `radii` of what is drawn there are mm of the paper."""
    if not len(texts):
        return []
    boxes = np.array([(LETTER * NAME_HEIGHT * len(text), NAME_HEIGHT) for text in texts])
    lines = [mark.points for mark in marks if isinstance(mark, Outline | Filled)]
    lines += [np.vstack([line, line[:1]]) for line in lines if len(line) > 2]
    lines += dimension_lines(marks)
    for mark in marks:
        if isinstance(mark, Distance):
            first, second = mark.feet()
            lines += [np.stack([mark.start, first]), np.stack([mark.end, second])]
            middle, up = (first + second) / 2.0, np.array([0.0, TEXT_HEIGHT * per])
            lines.append(np.stack([middle - up, middle + up]))
        elif isinstance(mark, Diameter):
            end = mark.text_at(per)
            lines.append(np.stack([mark.centre, end]))
            across = np.array([9.0 * LETTER * TEXT_HEIGHT * per, 0.0])
            lines.append(np.stack([end, end + across]))
    # Names are placed in points of print.
    obstacles = POINT * along([line / per for line in lines], STEP)
    far = np.full(2, 1e12)
    middles = placed(POINT * points / per, POINT * boxes, POINT * radii, obstacles, (-far, far))
    return [
        Text("TEXT", middle * per / POINT, text, NAME_HEIGHT)
        for middle, text in zip(middles, texts, strict=True)
    ]
