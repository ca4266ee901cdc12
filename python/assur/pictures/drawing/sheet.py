"""Sheets: the scale and the paper on which views have room, and their title."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from assur.errors import InputError
from assur.pictures.drawing.marks import THIN, Mark, Outline, Text, bounds, moved

if TYPE_CHECKING:
    from collections.abc import Callable

    from assur._arrays import Float

    # The views of a sheet, given the length of a mm of the paper.
    Views = Callable[[float], list[list[Mark]]]

# ISO 216, mm, on their long side.
PAPERS = {
    "A4": (297.0, 210.0),
    "A3": (420.0, 297.0),
    "A2": (594.0, 420.0),
    "A1": (841.0, 594.0),
    "A0": (1189.0, 841.0),
}
# From the edge of the paper to the frame, in it to the views, between them, the title's strip, mm.
EDGE, INSIDE, BETWEEN, STRIP = 10.0, 6.0, 12.0, 12.0
TITLE_HEIGHT, SMALL_HEIGHT = 5.0, 3.5
# Links narrower than this on the paper ask for a larger one, mm.
READABLE = 4.0
# Scales that are tried, down from one that is too large.
TRIED = 24


@dataclass(frozen=True, eq=False)
class Sheet:
    """A drawing ready to be written.

    Attributes
    ----------
    marks : list of Mark
        All marks, mm of the mechanism.
    origin : ndarray
        The lower left corner of the paper there.
    size : (float, float)
        Of the paper, mm.
    scale : float
        A length on the paper by that of the mechanism.
    """

    marks: list[Mark]
    origin: Float
    size: tuple[float, float]
    scale: float


def scale_text(scale: float) -> str:
    """Write a scale."""
    return f"{scale:.6g}:1" if scale >= 1.0 else f"1:{1.0 / scale:.6g}"


def lay_out(
    views: Views,
    size: float,
    thinnest: float,
    title: str,
    scale: float | None,
    paper: str | None,
) -> Sheet:
    """Put views on the smallest paper, or in the largest standard scale, that has room for them.

    Without either it is the smallest on which links, `thinnest` mm wide (infinite of symbols),
    are wide enough to be read. `size` is about that of the largest view, mm.
    """
    papers = [paper] if paper is not None else list(PAPERS)
    best = None
    for name in papers:
        edges = PAPERS[name]
        scales = _standard_scales(max(edges) / size) if scale is None else [scale]
        best = _best(views, size, title, scales, name) or best
        if best is not None and (scale is not None or thinnest * best.scale >= READABLE):
            return best
    if best is not None:
        return best
    assert scale is not None
    message = (
        f"scale is {scale_text(scale)}: the drawing has no room on {papers[-1]}; "
        "leave scale out for one that fits"
    )
    if paper is not None and paper != "A0":
        message += ', or pass paper="A0"'
    raise InputError(message)


def _best(views: Views, size: float, title: str, scales: list[float], name: str) -> Sheet | None:
    """Return the sheet in the first of some scales in which views have room on a paper."""
    for scale in scales:
        if size * scale > max(PAPERS[name]):
            continue
        marks = views(1.0 / scale)
        for edges in (PAPERS[name], PAPERS[name][::-1]):
            placed = _placed(marks, edges, 1.0 / scale)
            if placed is not None:
                return _finished(placed, edges, scale, title, name)
    return None


def _standard_scales(largest: float) -> list[float]:
    """Return scales of ISO 5455, 1, 2 and 5 times powers of ten, down from one too large."""
    power = int(np.ceil(np.log10(largest)))
    scales = []
    for exponent in range(power, power - TRIED // 3 - 1, -1):
        for step in (5, 2, 1):
            # Quotients of integers, so that 1:20 is 0.05 to the last bit.
            if exponent >= 0:
                scales.append(float(step * 10**exponent))
            else:
                scales.append({5: 0.5, 2: 0.2, 1: 0.1}[step] / 10.0 ** (-exponent - 1))
    return [scale for scale in scales if scale <= largest]


def _placed(
    views: list[list[Mark]], size: tuple[float, float], per: float
) -> tuple[list[Mark], Float] | None:
    """Return marks in rows, and where the paper's corner is; None if they have no room.

    The first view stays where it is.
    """
    room = np.array(size) - 2.0 * (EDGE + INSIDE) - (0.0, STRIP)
    room = room * per
    boxes = [bounds(view, per) for view in views]
    x, y, tall, wide = 0.0, 0.0, 0.0, 0.0
    corners = []
    for low, high in boxes:
        width, height = high - low
        if width > room[0]:
            return None
        if x > 0.0 and x + width > room[0]:
            x, y, tall = 0.0, y - tall - BETWEEN * per, 0.0
        corners.append((x, y - height))
        wide = max(wide, x + width)
        x += width + BETWEEN * per
        tall = max(tall, height)
    depth = tall - y
    if depth > room[1]:
        return None
    shifts = [np.array(at) - low for at, (low, _) in zip(corners, boxes, strict=True)]
    base = shifts[0]
    marks = [
        moved(mark, shift - base) if i else mark
        for i, (view, shift) in enumerate(zip(views, shifts, strict=True))
        for mark in view
    ]
    free = (room - np.array([wide, depth])) / 2.0
    corner = np.array([0.0, -depth]) - base - free
    return marks, corner - (np.array([0.0, STRIP]) + EDGE + INSIDE) * per


def _finished(
    placed: tuple[list[Mark], Float], size: tuple[float, float], scale: float, title: str, name: str
) -> Sheet:
    """Add the frame and the title."""
    marks, origin = placed
    per = 1.0 / scale

    def at(x: float, y: float) -> Float:
        there: Float = origin + np.array([x, y]) * per
        return there

    right, top, strip = size[0] - EDGE, size[1] - EDGE, EDGE + STRIP
    frame = np.stack([at(EDGE, EDGE), at(right, EDGE), at(right, top), at(EDGE, top)])
    middle = EDGE + STRIP / 2.0
    half = SMALL_HEIGHT / 2.0
    caption = f"{scale_text(scale)}    mm    {name}"
    extra: list[Mark] = [
        Outline("SHEET", frame, closed=True),
        Outline("SHEET", np.stack([at(EDGE, strip), at(right, strip)]), weight=THIN),
        Text("SHEET", at(EDGE + 4.0, middle - TITLE_HEIGHT / 2.0), title, TITLE_HEIGHT, "left"),
        Text("SHEET", at(right - 52.0, middle - half), caption, SMALL_HEIGHT, "left"),
    ]
    return Sheet([*marks, *extra], origin, size, scale)
