"""Many positions in one picture: the first bold, the others light and numbered."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.text import Text

from assur.pictures.axes import TEXT
from assur.pictures.linkage.numbers import write_numbers
from assur.pictures.linkage.position import draw_position
from assur.pictures.linkage.subject import outline
from assur.pictures.linkage.swings import draw_traces, swings, write_swings
from assur.pictures.scene.labels import along, placed
from assur.pictures.scene.shapes import Stroke
from assur.pictures.text import STEP, name_font, printable, text_size

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.pictures.axes import Canvas
    from assur.pictures.linkage.subject import Subject

FAINT_LINE = 0.8
SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


def draw_positions(subject: Subject, on: Canvas, labels: str, groups: bool) -> None:
    """Draw the first position with all symbols, the others as light lines."""
    light = [line for frames in subject.frames[1:] for line in _light_lines(subject, on, frames)]
    for line in light:
        on.ax.add_artist(
            Line2D(
                *line.T,
                color=on.style.faint,
                linewidth=FAINT_LINE,
                zorder=1.0,
                gid="position",
                solid_capstyle="round",
            )
        )
    known_swings = swings(subject.mechanism, subject.assembly)
    traces = draw_traces(subject, on, known_swings)
    if labels == "none":
        draw_position(subject, on, subject.frames[0], names=False, groups=groups)
        return
    solid = subject.lines(on, subject.frames[0])
    boxes = write_numbers(subject, on, [*light, *solid])
    boxes = np.concatenate([boxes, write_swings(subject, on, known_swings)])
    draw_position(
        subject, on, subject.frames[0], groups=groups, lines=[*traces, *light], boxes=boxes
    )
    if labels == "all":
        _name_others(subject, on, [*solid, *traces], boxes, light)


def _light_lines(subject: Subject, on: Canvas, frames: Float) -> list[Float]:
    """Return the lines of the links alone: no pivots, blocks and arrows."""
    return [
        line
        for part in subject.scene.parts
        if isinstance(part, Stroke) and part.name.startswith("link ") and part.link != "ground"
        if (line := outline(part, on, subject, frames)) is not None
    ]


def _name_others(
    subject: Subject, on: Canvas, lines: list[Float], boxes: Float, light: list[Float]
) -> None:
    """Name the moving joints of the other positions by their numbers, as B₁."""
    font = name_font(TEXT)
    moving = [i for i, name in enumerate(subject.scene.names) if name.link != "ground"]
    texts, points = [], []
    for number, frames in enumerate(subject.frames[1:], start=1):
        places = subject.places(frames)
        for i in moving:
            suffix = str(number).translate(SUBSCRIPTS)
            texts.append(printable(f"{subject.scene.names[i].text}{suffix}"))
            points.append(places[i])
    if not texts:
        return
    sizes = np.array([text_size(text, font) for text in texts])
    faint = along([on.points(line) for line in light], STEP)
    obstacles = along([on.points(line) for line in lines], STEP)
    bounds = (on.points(on.low), on.points(on.high))
    middles = placed(on.points(points), sizes, np.ones(len(texts)), obstacles, bounds, boxes, faint)
    middles = middles / on.scale
    for text, (x, y) in zip(texts, middles, strict=True):
        on.ax.add_artist(
            Text(
                x,
                y,
                text,
                fontproperties=font,
                color=on.style.second,
                horizontalalignment="center",
                verticalalignment="center",
                zorder=4.0,
                gid=f"name {text}",
                parse_math=False,
            )
        )
