"""Text above pictures: what they show, and what their numbers mean."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.font_manager import FontProperties
from matplotlib.text import Text

from assur._arrays import finite_array
from assur.errors import InputError
from assur.pictures.axes import TEXT
from assur.pictures.numerals import number
from assur.pictures.text import printable, text_size

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur._faces import Mechanism, Motion
    from assur.pictures.axes import Canvas

# Height of a line of the heading, points.
LINE_HEIGHT = 14.0


def link_numbers(mechanism: Mechanism) -> dict[str, int]:
    """Return the numbers of links as mechanicians count them: the ground is 1."""
    moving = [link for link in mechanism.links if link != "ground"]
    return {"ground": 1, **{link: i for i, link in enumerate(moving, 2)}}


def checked_rates(value: Any, what: str, mechanism: Mechanism) -> Any:
    """Return finite rates of the drivers: a number, or one for each of several drivers."""
    drivers = mechanism.driver
    count = len(drivers) if isinstance(drivers, tuple) else 0
    shape = (count,) if count else ()
    rates = finite_array(value, what)
    if rates.shape not in (shape, ()):
        needed = f"{count} numbers, one a driver, are" if count else "one number is"
        message = f"{what} has shape {rates.shape}: {needed} needed for one position"
        raise InputError(message)
    return rates


def place_text(position: Motion) -> str:
    """Write the coordinates of a position."""
    mechanism = position.mechanism
    drivers = mechanism.description.drivers
    q = np.atleast_1d(np.asarray(position.coordinate(())))
    places = [
        f"{number(float(x))} m"
        if driver in mechanism.slides
        else f"{number(float(np.degrees(x)))}°"
        for x, driver in zip(q, drivers, strict=True)
    ]
    return f"q = {listed(places)}"


def listed(texts: Sequence[str]) -> str:
    """Write one text, or several in brackets."""
    return texts[0] if len(texts) == 1 else f"({', '.join(texts)})"


def write_heading(on: Canvas, lines: Sequence[str]) -> None:
    """Write lines in the upper left corner, the first bold."""
    x = on.low[0] + 10.0 / on.scale
    for i, line in enumerate(lines):
        y = on.high[1] - (8.0 + LINE_HEIGHT * i) / on.scale
        first = FontProperties(size=TEXT + 1.5, weight="bold")
        text = Text(
            x,
            y,
            printable(line),
            fontproperties=FontProperties(size=TEXT) if i else first,
            color=on.style.second if i else on.style.ink,
            verticalalignment="top",
            parse_math=False,
            zorder=6.0,
            # Curves go on behind it.
            bbox={"facecolor": on.style.canvas, "edgecolor": "none", "pad": 1.5, "alpha": 0.85},
            gid="title" if i == 0 else "heading",
        )
        on.ax.add_artist(text)


def wrapped(on: Canvas, text: str) -> list[str]:
    """Break a list with commas into lines that fit a picture's width."""
    font = FontProperties(size=TEXT)
    room = (on.high[0] - on.low[0]) * on.scale - 20.0
    lines: list[str] = []
    for word in printable(text).split(", "):
        longer = f"{lines[-1]}, {word}" if lines else word
        if lines and text_size(longer, font)[0] <= room:
            lines[-1] = longer
        else:
            lines.append(word)
    return lines
