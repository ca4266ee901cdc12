"""Scenes drawn by matplotlib: one artist per part, moved by the frame of its link."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.lines import Line2D
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from matplotlib.transforms import Affine2D

from assur.pictures import sizes
from assur.pictures.scene.hatching import DEPTH, hatched_area, hatched_line
from assur.pictures.scene.shapes import Disc, Hatching, Stroke
from assur.pictures.style import blend

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.pictures.axes import Canvas
    from assur.pictures.scene.shapes import Part, Scene, Vertex

TINT = 0.10
HATCH_INK = 0.38


class Drawn:
    """A scene on axes; `show` moves it to another position.

    Parameters
    ----------
    on : Canvas
        Where.
    scene : Scene
        What.
    frames : ndarray
        (links, 3), where it is first.
    groups : bool
        Whether links have the colours of their groups.
    ghost : bool
        Whether it is one of many positions: thin lines without symbols.
    """

    def __init__(
        self, on: Canvas, scene: Scene, frames: Float, groups: bool = False, zorder: float = 2.0
    ) -> None:
        self._on = on
        self._scene = scene
        self._groups = groups
        self._frames = {link: Affine2D() for link in scene.links}
        self.artists: list[Any] = []
        self._transforms = {link: frame + on.ax.transData for link, frame in self._frames.items()}
        self.show(frames)
        for part in scene.parts:
            for artist in self._draw(part):
                artist.set(zorder=zorder, gid=part.name)
                on.ax.add_artist(artist)
                self.artists.append(artist)

    def show(self, frames: Float) -> None:
        """Move every link to its frame; links without a position vanish."""
        for link, (x, y, angle) in zip(self._scene.links, frames.tolist(), strict=True):
            cosine, sine = np.cos(angle), np.sin(angle)
            matrix = np.array([[cosine, -sine, x], [sine, cosine, y], [0.0, 0.0, 1.0]])
            self._frames[link].set_matrix(matrix)

    def colour(self, part: Part) -> str:
        """Return the colour of a part."""
        style = self._on.style
        if part.colour != "link":
            colour: str = getattr(style, part.colour)
            return colour
        if part.link in self._scene.driven:
            return style.driver
        group = self._scene.groups.get(part.link) if self._groups else None
        return style.ink if group is None else style.group(group)

    def _at(self, vertex: Vertex) -> tuple[float, float]:
        per = self._on.size / self._on.scale
        return vertex.x + per * vertex.dx, vertex.y + per * vertex.dy

    def _draw(self, part: Part) -> list[Any]:
        transform = self._transforms[part.link]
        colour = self.colour(part)
        if isinstance(part, Disc):
            return [self._disc(part, colour, transform)]
        if isinstance(part, Hatching):
            return [self._hatching(part, colour, transform)]
        return self._stroke(part, colour, transform)

    def _stroke(self, part: Stroke, colour: str, transform: Any) -> list[Any]:
        points = np.array([self._at(vertex) for vertex in part.vertices])
        width = part.width * self._on.size
        faces: dict[Any, Any] = {
            None: "none",
            "canvas": self._on.style.canvas,
            "solid": colour,
            # Paths and other links are seen through plates.
            "tint": (*to_rgb(colour), TINT),
        }
        codes = None
        if part.closed:
            points = np.vstack([points, points[:1]])
            codes = np.full(len(points), Path.LINETO)
            codes[0], codes[-1] = Path.MOVETO, Path.CLOSEPOLY
        dashes = (0.0, tuple(d * self._on.size / max(width, 1e-9) for d in part.dashes))
        outline = PathPatch(
            Path(points, codes),
            facecolor=faces[part.fill],
            edgecolor=colour if width else "none",
            linewidth=width,
            capstyle="butt" if part.dashes else "round",
            joinstyle="round",
            linestyle=dashes if part.dashes else "solid",
            transform=transform,
        )
        if not part.hatched:
            return [outline]
        lines = hatched_area(points[:-1], sizes.PLATE_SPACING * self._on.size / self._on.scale)
        hatching = PathPatch(
            _segments(lines),
            edgecolor=blend(colour, self._on.style.canvas, HATCH_INK),
            facecolor="none",
            linewidth=0.8 * sizes.HATCH * self._on.size,
            transform=transform,
        )
        outline.set_facecolor("none")
        tint = PathPatch(
            Path(points, codes), facecolor=faces[part.fill], edgecolor="none", transform=transform
        )
        return [tint, hatching, outline]

    def _disc(self, part: Disc, colour: str, transform: Any) -> Any:
        face = colour if part.fill == "solid" else self._on.style.canvas
        x, y = self._at(part.centre)
        return Line2D(
            [x],
            [y],
            marker="o",
            markersize=2.0 * part.radius * self._on.size,
            markerfacecolor=face,
            markeredgecolor=colour,
            markeredgewidth=part.width * self._on.size,
            linestyle="none",
            transform=transform,
        )

    def _hatching(self, part: Hatching, colour: str, transform: Any) -> Any:
        lines = hatched_line(
            np.array(self._at(part.start)),
            np.array(self._at(part.end)),
            part.spacing * self._on.size / self._on.scale,
            DEPTH * self._on.size / self._on.scale,
        )
        return PathPatch(
            _segments(lines),
            edgecolor=colour,
            facecolor="none",
            linewidth=1.1 * self._on.size,
            transform=transform,
        )


def _segments(lines: Float) -> Path:
    """Return a path of separate segments, (n, 2, 2)."""
    codes = np.tile(np.array([Path.MOVETO, Path.LINETO], dtype=np.uint8), len(lines))
    return Path(lines.reshape(-1, 2), codes)
