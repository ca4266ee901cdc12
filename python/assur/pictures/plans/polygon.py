"""Plans of velocities and accelerations as mechanicians draw them: see `Motion.polygon`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import PathPatch
from matplotlib.path import Path

from assur._validate import checked_index, one_of, real_array
from assur.errors import InputError
from assur.pictures.axes import canvas, scale_bar
from assur.pictures.numerals import number
from assur.pictures.plans.plan import Plan, Vector, plan_of
from assur.pictures.plans.plan_names import heading, image_names, numbered, point_names, pole_name
from assur.pictures.scene.geometry import hull
from assur.pictures.style import blend, style_of
from assur.pictures.text import name_font, text_size, write_names
from assur.pictures.vectors.arrows import LOOKS, SYMBOLS, arrow
from assur.pictures.vectors.beside import Beside
from assur.pictures.vectors.dots import dots
from assur.pictures.vectors.heading import LINE_HEIGHT, checked_rates, link_numbers, write_heading
from assur.pictures.vectors.symbols import symbol

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from assur._arrays import Float
    from assur._faces import Motion
    from assur.pictures.axes import Canvas
    from assur.pictures.style import Style

UPPER = {"normal": "n", "tangential": "t", "sliding": "r", "coriolis": "k"}
TINT = 0.07
DOT = 4.0
# Images nearer than this, points, have one name.
TOGETHER = 4.0


def _of_one(position: Motion, values: Any, name: str) -> Any:
    """Return a speed or acceleration of one position: a number, or one for each driver."""
    rates, drivers = real_array(values, name), position.mechanism.driver_count
    if rates.size not in (1, drivers) or rates.ndim > 1:
        message = f"{name} has shape {rates.shape}: a plan is of one position, with one {name}"
        raise InputError(message)
    return float(rates.reshape(-1)[0]) if rates.size == 1 else rates


def polygon_picture(
    motion: Motion, what: str, at: Any, speed: Any, acceleration: Any, ax: Any, dark: bool
) -> Axes:
    """See `Motion.polygon`."""
    one_of(what, ("velocity", "acceleration"), "what")
    index = checked_index(at, motion.shape, "at")
    position = motion[index] if index else motion
    speed = checked_rates(speed, "speed", position.mechanism)
    acceleration = checked_rates(acceleration, "acceleration", position.mechanism)
    plan = plan_of(position, what, speed, acceleration)
    images = np.array(list(plan.images.values()))
    if not np.isfinite(images).all():
        message = f"no plan: {position.explain()}"
        raise InputError(message)
    if not images.any():
        message = f"every {what} is zero at speed = {speed}: there is no plan to draw"
        raise InputError(message)
    ends = [point for vector in plan.vectors for point in (vector.start, vector.end)]
    corners = np.array([np.zeros(2), *images, *ends])
    style = style_of(dark)
    lines = heading(position, plan, what, speed, acceleration)
    on = canvas(
        ax,
        (corners.min(axis=0), corners.max(axis=0)),
        style,
        np.inf,
        head=LINE_HEIGHT * len(lines),
    )
    _Drawing(on, plan, what, link_numbers(position.mechanism)).draw()
    write_heading(on, lines)
    unit = SYMBOLS[what][1]
    scale_bar(on, lambda length: f"{length:.6g} {unit}")
    return on.ax


class _Drawing:
    def __init__(self, on: Canvas, plan: Plan, what: str, numbers: dict[str, int]) -> None:
        self._on, self._plan, self._what, self._numbers = on, plan, what, numbers
        self._letter = SYMBOLS[what][0]
        self._images = image_names(plan, numbers)
        self._points_names = point_names(plan, numbers)

    def draw(self) -> None:
        outlines = self._links()
        vectors = self._plan.vectors
        for vector in vectors:
            self._vector(vector)
        lines = [*outlines, *(np.array([v.start, v.end]) for v in vectors)]
        beside = Beside(self._on, lines)
        self._name_images(lines, beside)
        # Whole vectors first: names without room are left out.
        order = sorted(vectors, key=lambda v: (v.part not in ("absolute", "sliding"), -_size(v)))
        for vector in order:
            colour = self._colour(vector)
            if colour in (self._style.velocity, self._style.acceleration):
                colour = self._style.ink
            short, gid = self._symbol(vector), f"{self._gid(vector)} text"
            value = f"{short} = {number(_size(vector))}"
            beside.write(vector.start, vector.end, (value, short), colour, gid)

    @property
    def _style(self) -> Style:
        return self._on.style

    def _links(self) -> list[Float]:
        """Draw the image of every link: an area, or the line between two points."""
        outlines = []
        face = blend(self._style.ink, self._style.canvas, TINT)
        for link, points in self._plan.links.items():
            images = np.array([self._image(point) for point in points])
            gid = f"image {link}"
            if len(points) < 2 or not np.ptp(images, axis=0).any():
                continue
            corners = images[hull(images)]
            closed = np.vstack([corners, corners[:1]])
            outlines.append(closed)
            if len(corners) > 2:
                area = PathPatch(
                    Path(closed, closed=True), facecolor=face, edgecolor="none", zorder=1.0, gid=gid
                )
                self._on.ax.add_artist(area)
            if len(corners) > 2 or self._what == "acceleration":
                edge = Line2D(
                    *closed.T, color=self._style.second, linewidth=0.8, zorder=1.5, gid=gid
                )
                self._on.ax.add_artist(edge)
        return outlines

    def _image(self, point: str) -> Float:
        return np.zeros(2) if point in self._plan.fixed else self._plan.images[point]

    def _colour(self, vector: Vector) -> str:
        if vector.part != "absolute" or vector.point in self._plan.under:
            return self._style.path if vector.part == "sliding" else self._style.second
        if vector.point in self._plan.driven:
            return self._style.driver
        colour: str = getattr(self._style, self._what)
        return colour

    def _gid(self, vector: Vector) -> str:
        what = self._what if vector.part in ("absolute", "relative") else vector.part
        return f"{what} {vector.point}" + (f" relative to {vector.other}" if vector.other else "")

    def _vector(self, vector: Vector) -> None:
        whole = vector.part == "absolute" and vector.point not in self._plan.under
        look = LOOKS["velocity" if whole else "part"]
        if whole and self._what == "acceleration":
            look = LOOKS["acceleration"]._replace(open_heads=1)
        dashed = vector.part == "tangential" or (
            vector.part == "sliding" and self._what == "acceleration"
        )
        arrow(
            self._on,
            vector.start,
            vector.end,
            look,
            self._colour(vector),
            self._gid(vector),
            dashed=dashed,
            zorder=3.0 if whole else 2.5,
        )

    def _symbol(self, vector: Vector) -> str:
        names = [self._points_names[p] for p in (vector.point, vector.other) if p is not None]
        if vector.part in ("sliding", "coriolis"):
            # Motion of the sliding link relative to its guide.
            under = self._plan.under[vector.other or ""]
            names[0] = numbered(under.point, self._numbers[under.sliding])
        is_whole = vector.part == "sliding" and self._what == "velocity"
        return symbol(self._letter, names, "" if is_whole else UPPER.get(vector.part, ""))

    def _name_images(self, lines: list[Float], beside: Beside) -> None:
        """Mark pole and images, each with its name."""
        texts: list[list[str]] = [[pole_name(self._images, self._plan.fixed)]]
        places = [np.zeros(2)]
        for point, image in self._plan.images.items():
            if point in self._plan.fixed:
                continue
            apart = [float(np.hypot(*(image - place))) * self._on.scale for place in places]
            near = int(np.argmin(apart))
            if apart[near] < TOGETHER:
                texts[near].append(self._images[point])
            else:
                texts.append([self._images[point]])
                places.append(image)
        at = np.array(places)
        dots(self._on, at, DOT, self._style.ink, "images")
        written = write_names(
            self._on,
            [", ".join(names) for names in texts],
            at,
            np.full(len(at), DOT / 2.0 + 1.0),
            lines,
            [f"image {', '.join(names)}" for names in texts],
        )
        for text in written:
            half = np.array(text_size(text.get_text(), name_font())) / 2.0
            beside.block(np.array(text.get_position()), half)


def _size(vector: Vector) -> float:
    return float(np.hypot(*(vector.end - vector.start)))
