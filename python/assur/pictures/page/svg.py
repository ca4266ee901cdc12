"""A static picture of a scene as SVG text, without any library."""

from __future__ import annotations

import html
from typing import TYPE_CHECKING

import numpy as np

from assur.pictures import sizes
from assur.pictures.scene.extent import line_vertices, usual_link
from assur.pictures.scene.hatching import DEPTH, hatched_area, hatched_line
from assur.pictures.scene.labels import along, placed
from assur.pictures.scene.shapes import Disc, Hatching
from assur.pictures.style import DARK, LIGHT

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.pictures.page.payload import Played
    from assur.pictures.scene.shapes import Part, Stroke, Vertex
    from assur.pictures.style import Style

WIDTH, LEAST_HEIGHT, GREATEST_HEIGHT, MARGIN = 640.0, 220.0, 480.0, 44.0
# A letter of a name, relative to its height; the height of its box.
LETTER, NAME, NAME_BOX = 0.62, 17.0, 16.0
STEP = 5.0


def svg_picture(played: Played, own_style: bool = True) -> str:
    """Return the mechanism where it begins, in the frame of its whole motion.

    With `own_style` it has the colours of both schemes itself; else the page around has them.
    """
    return _Picture(played).text(own_style)


class _Picture:
    """The picture while it is made; y goes down."""

    def __init__(self, played: Played) -> None:
        self._played = played
        low, high = played.bounds()
        span = np.maximum(high - low, 1e-300)
        inner = np.array([WIDTH, GREATEST_HEIGHT]) - 2.0 * MARGIN
        self._scale = float((inner / span).min())
        height = span[1] * self._scale + 2.0 * MARGIN
        self._height = float(np.clip(height, LEAST_HEIGHT, GREATEST_HEIGHT))
        self._middle = (low + high) / 2.0
        density = usual_link(played.frames) * self._scale / sizes.USUAL_LINK
        self._size = float(np.clip(density, sizes.LEAST_DENSITY, 1.0))
        self._links = played.frames.links
        self._frames = played.frames.values[0][played.row()]

    def text(self, own_style: bool) -> str:
        title = html.escape(self._played.mechanism.structure.formula)
        shapes = "".join(self._part(part) for part in self._played.scene.parts)
        style = f"<style>{_css()}</style>" if own_style else ""
        box = f"0 0 {WIDTH:g} {self._height:.0f}"
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" class="assur-static" viewBox="{box}" '
            f'width="{WIDTH:g}" height="{self._height:.0f}" role="img" aria-label="{title}" '
            'fill="none" stroke-linecap="round" stroke-linejoin="round">'
            f'{style}<rect width="100%" height="100%" fill="var(--canvas)"/>'
            f"{shapes}{''.join(self._names())}</svg>"
        )

    def _place(self, link: str, vertex: Vertex) -> Float:
        """Return a vertex in px."""
        x, y, angle = self._frames[self._links.index(link)]
        cosine, sine = np.cos(angle), np.sin(angle)
        per = self._size / self._scale
        px, py = vertex.x + per * vertex.dx, vertex.y + per * vertex.dy
        point = np.array([x + cosine * px - sine * py, y + sine * px + cosine * py])
        shown = (point - self._middle) * self._scale
        return np.array([WIDTH / 2.0 + shown[0], self._height / 2.0 - shown[1]])

    def _colour(self, part: Part) -> str:
        driven = part.link in self._played.scene.driven
        return part.colour if part.colour != "link" else "driver" if driven else "ink"

    def _part(self, part: Part) -> str:
        colour = f"var(--{self._colour(part)})"
        if isinstance(part, Disc):
            x, y = self._place(part.link, part.centre)
            fill = colour if part.fill == "solid" else "var(--canvas)"
            stroke = f'stroke="{colour}" stroke-width="{part.width * self._size:.3g}"'
            return (
                f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{part.radius * self._size:.3g}" '
                f'fill="{fill}" {stroke if part.width else ""}/>'
            )
        if isinstance(part, Hatching):
            start, end = (self._place(part.link, v) * (1.0, -1.0) for v in (part.start, part.end))
            lines = hatched_line(start, end, part.spacing * self._size, DEPTH * self._size)
            return self._lines(lines * (1.0, -1.0), colour, 1.1)
        return self._stroke(part, colour)

    def _stroke(self, part: Stroke, colour: str) -> str:
        points = np.array([self._place(part.link, vertex) for vertex in part.vertices])
        d = _path(points) + ("Z" if part.closed else "")
        drawn = ""
        if part.fill == "canvas" or (part.fill == "tint" and part.floor > 1):
            drawn += f'<path d="{d}" fill="var(--canvas)"/>'
        if part.fill in ("tint", "solid"):
            opacity = ' fill-opacity="0.1"' if part.fill == "tint" else ""
            drawn += f'<path d="{d}" fill="{colour}"{opacity}/>'
        if part.hatched:
            lines = hatched_area(points * (1.0, -1.0), sizes.PLATE_SPACING * self._size)
            drawn += self._lines(lines * (1.0, -1.0), colour, 0.8, ' stroke-opacity="0.38"')
        if part.width:
            dashes = " ".join(f"{dash * self._size:.3g}" for dash in part.dashes)
            dashed = f' stroke-dasharray="{dashes}" stroke-linecap="butt"' if dashes else ""
            width = f"{part.width * self._size:.3g}"
            drawn += f'<path d="{d}" stroke="{colour}" stroke-width="{width}"{dashed}/>'
        return drawn

    def _lines(self, lines: Float, colour: str, width: float, more: str = "") -> str:
        d = "".join(_path(line) for line in lines)
        return f'<path d="{d}" stroke="{colour}" stroke-width="{width * self._size:.3g}"{more}/>'

    def _names(self) -> list[str]:
        """Write the names of the joints, clear of lines."""
        names = self._played.scene.names
        points = np.array([self._place(name.link, name.at) for name in names]).reshape(-1, 2)
        boxes = np.array([(LETTER * NAME * len(name.text) + 2.0, NAME_BOX) for name in names])
        radii = np.array([name.radius * self._size for name in names])
        lines = [
            np.array([self._place(part.link, vertex) for vertex in line_vertices(part)])
            for part in self._played.scene.parts
            if not isinstance(part, Disc)
        ]
        bounds = (np.zeros(2), np.array([WIDTH, self._height]))
        # Above is where y is less.
        up = np.array([1.0, -1.0])
        low, high = bounds
        flipped = (low * up - (0.0, high[1]), high * up + (0.0, high[1]))
        places = placed(
            points * up,
            boxes.reshape(-1, 2),
            radii,
            along([line * up for line in lines], STEP),
            flipped,
        )
        return [
            f'<text x="{x:.1f}" y="{-y + 5.0:.1f}" fill="var(--ink)" text-anchor="middle" '
            f'font-family="Times New Roman, Georgia, serif" font-style="italic" '
            f'font-size="{NAME:g}">{html.escape(name.text)}</text>'
            for name, (x, y) in zip(names, places, strict=True)
        ]


def _path(points: Float) -> str:
    return "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points.tolist())


def _css() -> str:
    light, dark = (_variables(style) for style in (LIGHT, DARK))
    rule = f".assur-static{{{light}max-width:100%;height:auto}}"
    return f"{rule}@media (prefers-color-scheme:dark){{.assur-static{{{dark}}}}}"


def _variables(style: Style) -> str:
    return "".join(
        f"--{name}:{getattr(style, name)};" for name in ("canvas", "ink", "second", "driver")
    )
