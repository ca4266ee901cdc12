"""Frames of a moving picture: parts at rest are drawn once."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.pictures.axes import pyplot, scale_bar
from assur.pictures.linkage.artists import Drawn
from assur.pictures.linkage.path import DASHES, draw_path
from assur.pictures.linkage.structural_formula import write_formula
from assur.pictures.linkage.subject import Subject, assembly_of
from assur.pictures.scene.frames import frames_of
from assur.pictures.text import Names

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from assur._faces import Motion
    from assur.pictures.style import Style

DOTS_PER_INCH = 100
# A motion closes if its last position is the first, to this fraction of its size.
CLOSES = 1e-6


class Film:
    """A mechanism on a canvas of its own, shown at one position after another."""

    def __init__(self, motion: Motion, joints: Sequence[str], groups: bool, style: Style) -> None:
        # Solved again: the motion may hold some joints alone.
        self._groups = groups
        whole = motion.mechanism.solve(
            motion.q, order=0, assembly=assembly_of(motion), on_error="nan"
        )
        self._subject = Subject(whole)
        frames = frames_of(whole)
        self._frames = frames.values[0]
        self.rows = np.flatnonzero(frames.is_known)
        paths = {name: motion.joint(name).value for name in joints}
        known = [path[np.isfinite(path).all(axis=1)] for path in paths.values()]
        self._on = self._subject.canvas(None, style, known, groups=groups)
        self.figure: Any = self._on.ax.figure
        self.figure.set_dpi(DOTS_PER_INCH)
        for i, (name, path) in enumerate(paths.items()):
            draw_path(self._on, path, name, DASHES[i % len(DASHES)])
        if groups:
            write_formula(self._subject.mechanism, self._on)
        scale_bar(self._on)
        self.figure.canvas.draw()
        canvas: Any = self.figure.canvas
        self._background = canvas.copy_from_bbox(self.figure.bbox)
        first = self._frames[self.rows[0]]
        self._drawn = Drawn(self._on, self._subject.scene, first, groups)
        names = self._subject.scene.names
        radii = np.array([name.radius * self._on.size for name in names])
        texts = [name.text for name in names]
        self._names = Names(self._on, texts, radii, [f"name {text}" for text in texts])
        self._lines = known

    @property
    def closes(self) -> bool:
        """Whether the last position is the first."""
        first, last = self._frames[self.rows[[0, -1]]]
        ends = (self._subject.places(first), self._subject.places(last))
        return bool(np.abs(ends[0] - ends[1]).max() <= CLOSES * float(np.ptp(ends[0])))

    @property
    def colours(self) -> list[tuple[int, ...]]:
        """The ground and the colours on it: red, green and blue from 0 to 255."""
        style = self._on.style
        used = [style.canvas, style.ink, style.driver, style.second, style.path]
        if self._groups:
            count = len(self._subject.mechanism.structure.groups)
            used += [style.group(i) for i in range(min(count, len(style.groups)))]
        return [tuple(int(colour[i : i + 2], 16) for i in (1, 3, 5)) for colour in used]

    def show(self, row: int) -> npt.NDArray[np.uint8]:
        """Draw a position; return its pixels, (height, width, 4)."""
        frames = self._frames[row]
        self._drawn.show(frames)
        places = self._subject.places(frames)
        self._names.place(places, self._subject.lines(self._on, frames), None, self._lines)
        canvas: Any = self.figure.canvas
        canvas.restore_region(self._background)
        for artist in (*self._drawn.artists, *self._names.artists):
            self._on.ax.draw_artist(artist)
        return np.array(canvas.buffer_rgba())

    def close(self) -> None:
        """Forget the figure."""
        pyplot().close(self.figure)
