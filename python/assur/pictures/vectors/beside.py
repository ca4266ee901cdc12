"""Texts along lines: each on the free side of its line, clear of lines and other texts."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.text import Text

from assur.pictures.axes import TEXT
from assur.pictures.scene.labels import along, clearance, within
from assur.pictures.text import STEP
from assur.pictures.vectors.symbols import formula_font, formula_size

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur._arrays import Float
    from assur.pictures.axes import Canvas

# Between the line and the text, points; texts nearer to others than the second are left out.
GAP, LEAST = 3.0, 0.8
# Where on its line a text stands, as parts of it; the first is the best.
PARTS = np.array([0.5, 0.42, 0.58, 0.34, 0.66, 0.26, 0.74, 0.18, 0.82, 0.1, 0.9, 0.0, 1.0])


class Beside:
    """Writes texts along lines of a picture.

    Parameters
    ----------
    on : Canvas
        Where.
    lines : sequence of ndarray
        All lines that texts keep clear of, m.
    """

    def __init__(self, on: Canvas, lines: Sequence[Float]) -> None:
        self._on = on
        self._font = formula_font(TEXT)
        bounds = on.points(on.low), on.points(on.high)
        self._taken = along([on.points(line) for line in lines], STEP / 2.0, bounds)

    def block(self, middle: Float, half: Float, angle: float = 0.0) -> None:
        """Keep clear of a box about a point, m; its halves are in points."""
        x, y = (np.linspace(-h, h, max(int(2.0 * h / STEP) + 1, 2)) for h in half)
        grid = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
        cosine, sine = np.cos(angle), np.sin(angle)
        turned = grid @ np.array([[cosine, sine], [-sine, cosine]])
        self._taken = np.concatenate([self._taken, self._on.points(middle) + turned])

    def write(
        self, start: Float, end: Float, texts: Sequence[str], colour: str, gid: str
    ) -> Text | None:
        """Write the first of some texts, long ones first, that has room along a line, m.

        A text without room there may stand level beside the line's end.
        """
        first, last = self._on.points(start), self._on.points(end)
        length = float(np.hypot(*(last - first)))
        if length < 1e-9:
            return None
        x, y = (last - first) / length
        for text in texts:
            written = self._along(text, first, length, (x, y), colour, gid)
            written = written or self._about(text, last, (x, y), colour, gid)
            if written is not None:
                return written
        return None

    def _along(
        self,
        text: str,
        first: Float,
        length: float,
        direction: tuple[float, float],
        colour: str,
        gid: str,
    ) -> Text | None:
        x, y = direction
        half = np.array(formula_size(text, self._font)) / 2.0
        # In the frame of the line, x along it.
        to_line = np.array([[x, -y], [y, x]])
        obstacles = (self._taken - first) @ to_line
        reach = half[1] + GAP
        parts = np.repeat(PARTS * length, 2)
        sides = np.tile([reach, -reach], len(PARTS))
        middles = np.stack([parts, sides], axis=1)
        near = obstacles[
            (np.abs(obstacles[:, 1]) < 2.0 * reach + GAP)
            & (obstacles[:, 0] > -half[0] - GAP)
            & (obstacles[:, 0] < length + half[0] + GAP)
        ]
        clear = np.minimum(clearance(middles, half, near), self._border(first, x, y, middles, half))
        habit = 0.4 * np.abs(parts / length - 0.5)
        best = int(np.argmax(np.minimum(clear, 0.9 * GAP) - habit))
        if clear[best] >= LEAST:
            return self._put(text, first + middles[best] @ to_line.T, (x, y), half, colour, gid)
        return None

    def _about(
        self, text: str, tip: Float, direction: tuple[float, float], colour: str, gid: str
    ) -> Text | None:
        """Write level text about the end of a line, rather ahead than behind."""
        half = np.array(formula_size(text, self._font)) / 2.0
        angles = np.arange(16) * (np.pi / 8.0) + np.arctan2(direction[1], direction[0])
        units = np.stack([np.cos(angles), np.sin(angles)], axis=1)
        middles = tip + units * (2.0 * GAP + np.abs(units) @ half)[:, None]
        near = self._taken[(np.abs(self._taken - tip) < 3.0 * half.max() + 4.0 * GAP).all(axis=1)]
        clear = np.minimum(
            clearance(middles, half, near), self._border(np.zeros(2), 1.0, 0.0, middles, half)
        )
        best = int(np.argmax(np.minimum(clear, GAP) + 0.5 * (units @ np.array(direction))))
        if clear[best] < LEAST:
            return None
        return self._put(text, middles[best], (1.0, 0.0), half, colour, gid)

    def _border(self, first: Float, x: float, y: float, middles: Float, half: Float) -> Float:
        """Return the distance of boxes from the frame of the picture."""
        centres = first + middles @ np.array([[x, y], [-y, x]])
        box = np.array([abs(x) * half[0] + abs(y) * half[1], abs(y) * half[0] + abs(x) * half[1]])
        return within(centres, box, (self._on.points(self._on.low), self._on.points(self._on.high)))

    def _put(
        self,
        text: str,
        middle: Float,
        direction: tuple[float, float],
        half: Float,
        colour: str,
        gid: str,
    ) -> Text:
        angle = float(np.arctan2(direction[1], direction[0]))
        # Never upside down.
        if not -np.pi / 2.0 + 1e-6 < angle <= np.pi / 2.0 + 1e-6:
            angle += np.pi
        at = middle / self._on.scale
        artist = Text(
            float(at[0]),
            float(at[1]),
            text,
            fontproperties=self._font,
            color=colour,
            rotation=float(np.degrees(angle)),
            rotation_mode="anchor",
            horizontalalignment="center",
            verticalalignment="center",
            zorder=5.0,
            gid=gid,
        )
        self._on.ax.add_artist(artist)
        self.block(at, half, angle)
        return artist
