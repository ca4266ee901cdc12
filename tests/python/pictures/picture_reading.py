"""What tests read of pictures: artists by name, texts as boxes, how many overlap."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.path import Path
from matplotlib.text import Text

from assur.pictures.text import text_size
from assur.pictures.vectors.symbols import formula_size


def named(ax: Any, gid: str) -> list[Any]:
    """Return the artists of a name."""
    return [artist for artist in ax.get_children() if artist.get_gid() == gid]


def one(ax: Any, gid: str) -> Any:
    """Return the only artist of a name."""
    (artist,) = named(ax, gid)
    return artist


def gids(ax: Any) -> set[str]:
    """Return all names."""
    return {artist.get_gid() for artist in ax.get_children() if artist.get_gid()}


def vector(ax: Any, gid: str) -> np.ndarray[Any, Any]:
    """Return start and tip of an arrow."""
    shaft = one(ax, gid)
    head = named(ax, f"{gid} head")[0].get_path().vertices
    x, y = shaft.get_data()
    # The tip comes first in a filled head, second in an open one.
    tip = head[1] if len(head) == 3 else head[0]
    return np.array([[x[0], y[0]], tip])


def texts(ax: Any) -> list[Text]:
    """Return the texts that are written."""
    found = [artist for artist in ax.get_children() if isinstance(artist, Text)]
    return [text for text in found if text.get_text() and text.get_gid()]


def box(text: Text) -> Path:
    """Return the outline of a text, px: of its letters, a point smaller on all sides."""
    dpi = text.axes.figure.dpi  # type: ignore[union-attr]
    is_formula = bool(text.get_parse_math()) and "$" in text.get_text()
    measure = formula_size if is_formula else text_size
    size = measure(text.get_text(), text.get_fontproperties())
    half = (np.array(size) / 2.0 - 1.0) * dpi / 72.0
    middle = text.get_transform().transform(text.get_position())
    if text.get_horizontalalignment() == "left":
        middle = middle + np.array([half[0], 0.0])
    angle = np.radians(float(text.get_rotation()))
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [-1, -1]]) * half @ turn
    return Path(middle + corners)


def overlapping(ax: Any, lines: set[str]) -> tuple[int, int]:
    """Return how many texts overlap another text or a line that is so named, and of how many."""
    own = [text for text in texts(ax) if text.get_gid() not in ("title", "heading", "scale")]
    boxes = [box(text) for text in own]
    drawn = [
        Path(line.get_transform().transform(line.get_xydata()))
        for line in ax.lines
        if any((line.get_gid() or "").startswith(name) for name in lines)
    ]
    bad = 0
    for i, one_box in enumerate(boxes):
        others = boxes[:i] + boxes[i + 1 :]
        bad += any(one_box.intersects_path(other) for other in (*others, *drawn))
    return bad, len(boxes)
