"""A mechanism to draw: its scene, its positions, and the frame they fit into."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import flag
from assur.description.words import is_reached
from assur.pictures.axes import MARGIN, WIDTH, Canvas, canvas
from assur.pictures.linkage.structural_formula import LINE, formula_lines
from assur.pictures.scene.build import scene_of
from assur.pictures.scene.course import course
from assur.pictures.scene.extent import corners, line_vertices, usual_link
from assur.pictures.scene.frames import Frames, frames_of, nearby
from assur.pictures.scene.shapes import Disc
from assur.pictures.text import name_font, printable, text_size

if TYPE_CHECKING:
    from collections.abc import Iterable

    import numpy.typing as npt

    from assur._arrays import Float
    from assur._faces import Mechanism, Motion
    from assur.pictures.scene.shapes import Part, Scene, Vertex
    from assur.pictures.style import Style

# Between names and the border, points.
ROOM = 8.0


class Subject:
    """A mechanism to draw.

    Attributes
    ----------
    scene : Scene
        Its symbols.
    frames : ndarray
        (N, links, 3), the positions asked for.
    assembly : dict of str to int
        The signs of the dyads.
    at : Frames
        The same with the joints.
    whole : Frames
        Those of the whole motion, which fix the frame of the picture, then those of `at`.
    is_all_seen : bool
        Whether no part of the whole motion is out of sight.
    """

    def __init__(self, motion: Motion) -> None:
        self.mechanism: Mechanism = motion.mechanism
        self.assembly = assembly_of(motion)
        self.at: Frames = frames_of(motion)
        at = self.at
        self.frames = at.values[0]
        whole = course(self.mechanism, self.assembly)
        drawing = np.array(list(self.mechanism.joints.values()))
        drawn = np.isfinite(drawing).all() and is_reached(whole.status).any()
        course_frames = frames_of(whole) if drawn else at
        self.whole: Frames = nearby(course_frames, at, drawing) if drawn else at
        known = int(course_frames.is_known.sum()) + int(at.is_known.sum())
        self.is_all_seen = bool(drawn) and len(self.whole.values[0]) == known
        self.scene: Scene = scene_of(self.mechanism, self.whole)

    def canvas(
        self,
        ax: Any,
        style: Style,
        further: Iterable[Float] = (),
        head: float = 0.0,
        groups: bool = False,
    ) -> Canvas:
        """Return axes that show the whole motion, other points, and the formula of the groups.

        `head`: points for other text above.
        """
        flag(groups, "groups")
        points = np.concatenate([self.points(), *further])
        points = points[np.isfinite(points).all(axis=1)]
        extent = points.min(axis=0), points.max(axis=0)
        font = name_font()
        longest = max(
            (text_size(printable(name.text), font)[0] for name in self.scene.names), default=0.0
        )
        # A long name that stands above its joint goes half its length beyond.
        sides = max(MARGIN, longest / 2.0 + ROOM)
        # New figures may be narrower.
        lines = len(formula_lines(self.mechanism, 0.75 * 72.0 * WIDTH)) if groups else 0
        top = head + lines * LINE
        return canvas(ax, extent, style, usual_link(self.whole), top, sides)

    def points(self) -> Float:
        """Return where the points of the scene are over the whole motion, (N, 2)."""
        paths = [self.whole.world(link, (x, y)) for link, x, y in corners(self.scene)]
        points = np.concatenate(paths)
        known: Float = points[np.isfinite(points).all(axis=1)]
        return known

    @property
    def size(self) -> float:
        """The greatest extent of the mechanism at the first position, m."""
        joints = np.array([self.world(self.frames[0], *name[1:3]) for name in self.scene.names])
        return float(np.ptp(joints, axis=0).max())

    def sees(self, points: Float, part: float) -> npt.NDArray[np.bool_]:
        """Whether points are near the whole motion: within a part of its size."""
        low, high = self._reach
        reach = part * float((high - low).max())
        with np.errstate(invalid="ignore"):
            return np.asarray(((points > low - reach) & (points < high + reach)).all(axis=-1))

    @cached_property
    def _reach(self) -> tuple[Float, Float]:
        """Corners about all joints over the whole motion, m."""
        joints = np.concatenate(list(self.whole.joints().values()))
        return np.nanmin(joints, axis=0), np.nanmax(joints, axis=0)

    def lines(self, on: Canvas, frames: Float) -> list[Float]:
        """Return all lines of the scene at one position, m."""
        return [
            line
            for part in self.scene.parts
            if (line := outline(part, on, self, frames)) is not None
        ]

    def places(self, frames: Float) -> Float:
        """Return where the named joints are, (names, 2)."""
        return np.array([self.world(frames, name.link, name.at) for name in self.scene.names])

    def world(self, frames: Float, link: str, vertex: Vertex, per: float = 0.0) -> Float:
        """Return a vertex in the drawing's axes; `per` is the length of a px, m."""
        x, y, angle = frames[self.scene.links.index(link)]
        cosine, sine = np.cos(angle), np.sin(angle)
        px, py = vertex.x + per * vertex.dx, vertex.y + per * vertex.dy
        return np.array([x + cosine * px - sine * py, y + sine * px + cosine * py])


def assembly_of(motion: Motion) -> dict[str, int]:
    """Return the assembly in which a motion was solved."""
    names = (name for name, _ in motion.mechanism.core.assembly)
    return dict(zip(names, motion.request.signs, strict=True))


def outline(part: Part, on: Canvas, subject: Subject, frames: Float) -> Float | None:
    """Return a part's line in the drawing's axes; None for a disc."""
    if isinstance(part, Disc):
        return None
    per = on.size / on.scale
    return np.array(
        [subject.world(frames, part.link, vertex, per) for vertex in line_vertices(part)]
    )
