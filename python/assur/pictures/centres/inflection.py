"""Inflection circle with pole tangent and normal: see `assur.pictures.inflection_circle`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Circle

from assur._arrays import flag
from assur._validate import checked_index, checked_name, require_one_driver
from assur.errors import InputError
from assur.pictures.axes import scale_bar
from assur.pictures.linkage.position import NamedPoint, draw_position, free_name
from assur.pictures.linkage.refine import checked_motion
from assur.pictures.linkage.subject import Subject
from assur.pictures.numerals import length_unit, number
from assur.pictures.style import style_of
from assur.pictures.vectors.dots import dots
from assur.pictures.vectors.heading import LINE_HEIGHT, write_heading

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from assur._arrays import Float
    from assur._faces import Motion
    from assur.pictures.axes import Canvas

DOT = 5.5
# The pole of a crank rests: rounding moves it by less than this fraction of the mechanism's size.
AT_REST = 1e-9
LINE = 1.8
# How far the dash-dotted pole tangent and normal reach beyond the circle, points.
BEYOND = 24.0
# A circle greater than this multiple of the mechanism is drawn only where it is in sight.
SIGHT = 1.2


def inflection_circle(
    motion: Motion,
    link: str,
    *,
    at: int | tuple[int, ...] = (),
    bresse: bool = False,
    ax: Axes | None = None,
    dark: bool = False,
) -> Axes:
    """Draw the inflection circle of a link: its points there go straight for a moment.

    With it the pole P, the pole tangent t along which P moves, the normal n, and the inflection
    pole W: PW is the diameter.

    Parameters
    ----------
    motion : Motion
        Of one design and one driver, of order 2 or more.
    link : str
        The link; its motion is relative to the ground.
    at : int or tuple of int
        Index of the position into the shape of the motion.
    bresse : bool
        Also the second of Bresse's circles, for a driver at constant speed: the speed of points
        there does not change. Both meet at the pole and at the acceleration pole G.
    ax : matplotlib.axes.Axes, optional
        Where to draw; a new figure by default.
    dark : bool
        Light lines on a dark ground.

    Returns
    -------
    matplotlib.axes.Axes
        The axes drawn on. Artists are named ``inflection circle``, ``pole``, ``inflection pole``,
        ``pole tangent``, ``pole normal``, ``second circle``, ``acceleration pole``.

    Raises
    ------
    InputError
        An unknown link, several drivers, a link that does not turn, a position without analogues.

    Examples
    --------
    The bar of an elliptic trammel is its diameter: all points of the circle go straight, not for a
    moment but always.

    >>> import assur
    >>> from assur.pictures import inflection_circle
    >>> trammel = assur.examples.trammel()
    >>> axes = inflection_circle(trammel.solve(0.5), "bar")
    >>> circle = next(a for a in axes.patches if a.get_gid() == "inflection circle")
    >>> round(2.0 * circle.radius - float(trammel.dimensions["bar.length"]), 12)
    0.0
    """
    motion, second = checked_motion(motion), flag(bresse, "bresse")
    require_one_driver(motion.driver_count, "inflection_circle")
    motion.mechanism.core.index_of("link", checked_name(link, "link"))
    index = checked_index(at, motion.shape, "at")
    position = motion[index] if index else motion
    pole, change, ratio = _pole_motion(position, link)
    diameter = float(np.hypot(*change))
    joints = np.array(list(position.mechanism.joints.values()))
    if not diameter > AT_REST * float(np.ptp(joints, axis=0).max()):
        message = f"the pole of {link!r} rests: its inflection circle is a point"
        raise InputError(message, link=link)
    # The change of the pole turned by −90°.
    normal = np.array([change[1], -change[0]])
    subject = Subject(position)
    drawn = [(pole + normal / 2.0, diameter / 2.0)]
    if second and ratio:
        drawn.append((pole + change / (2.0 * ratio), diameter / (2.0 * abs(ratio))))
    points = np.concatenate([pole[None], *(_round(*circle) for circle in drawn)])
    seen = points[subject.sees(points, SIGHT)]
    on = subject.canvas(ax, style_of(dark), [seen], 2.0 * LINE_HEIGHT)
    drawing = _Drawing(subject, on)
    drawing.axis(pole, change / diameter, diameter, "pole tangent")
    drawing.axis(pole, normal / diameter, diameter, "pole normal")
    for (centre, radius), gid in zip(drawn, ("inflection circle", "second circle"), strict=False):
        drawing.circle(centre, radius, gid)
    drawing.mark(pole, ("P", "I", "Π"), "pole")
    drawing.mark(pole + normal, ("W", "J"), "inflection pole")
    if len(drawn) > 1:
        # Where both circles meet again.
        meeting = pole + (normal + ratio * change) / (1.0 + ratio * ratio)
        drawing.mark(meeting, ("G", "Γ"), "acceleration pole")
    draw_position(subject, on, subject.frames[0], lines=drawing.lines, marks=drawing.marks)
    beyond = "" if subject.sees(pole, SIGHT) else ", its pole is out of sight"
    write_heading(on, [f"Inflection circle of {link}", f"diameter {_length(diameter)}{beyond}"])
    scale_bar(on)
    return on.ax


def _pole_motion(position: Motion, link: str) -> tuple[Float, Float, float]:
    """Return the pole, its derivative by the link's angle, and φ″/φ′² of the link's angle φ(q)."""
    point, angle = position.reference_points[link], position.link(link)
    rate, second = float(angle.d1), float(angle.d2)
    if not (np.isfinite(rate) and np.isfinite(second)):
        message = f"no inflection circle: {position.explain()}"
        raise InputError(message)
    if link == "ground" or abs(rate) < 1e-12:
        message = f"{link!r} does not turn there: it has no pole and no inflection circle"
        raise InputError(message, link=link)

    def left(vector: Float) -> Float:
        return np.array([-vector[1], vector[0]])

    pole = point.value + left(point.d1) / rate
    change = point.d1 / rate + left(point.d2 * rate - point.d1 * second) / rate**3
    return pole, change, second / rate**2


def _round(centre: Float, radius: float) -> Float:
    """Return points of a circle."""
    turn = np.linspace(0.0, 2.0 * np.pi, 91)
    points: Float = centre + radius * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    return points


def _length(length: float) -> str:
    unit, factor = length_unit(length)
    return f"{number(length * factor)} {unit}"


class _Drawing:
    def __init__(self, subject: Subject, on: Canvas) -> None:
        self._subject, self._on = subject, on
        self.lines: list[Float] = []
        self.marks: list[NamedPoint] = []

    def axis(self, pole: Float, unit: Float, length: float, gid: str) -> None:
        """Draw a line through the pole."""
        reach = length + BEYOND / self._on.scale
        ends = np.array([pole - 0.5 * reach * unit, pole + reach * unit])
        self._on.ax.add_artist(
            Line2D(
                *ends.T,
                color=self._on.style.second,
                linewidth=0.9,
                linestyle=(0.0, (9.0, 3.0, 1.5, 3.0)),
                zorder=1.3,
                gid=gid,
            )
        )
        self.lines.append(ends)
        if (ends[1] > self._on.low).all() and (ends[1] < self._on.high).all():
            letter = gid.split()[1][0]
            self.marks.append(NamedPoint(letter, ends[1], 2.0, f"{gid} name"))

    def circle(self, centre: Float, radius: float, gid: str) -> None:
        """Draw a circle."""
        second = gid == "second circle"
        self._on.ax.add_artist(
            Circle(
                (float(centre[0]), float(centre[1])),
                radius,
                fill=False,
                edgecolor=self._on.style.acceleration if second else self._on.style.path,
                linewidth=LINE,
                linestyle=(0.0, (6.0, 3.0)) if second else "solid",
                zorder=1.5,
                gid=gid,
            )
        )
        self.lines.append(_round(centre, radius))

    def mark(self, at: Float, names: tuple[str, ...], gid: str) -> None:
        """Mark a point with the first of some names that no joint has."""
        if not ((at > self._on.low).all() and (at < self._on.high).all()):
            return
        dots(self._on, at, DOT, self._on.style.error, gid, 4.5)
        name = free_name(self._subject, *names)
        self.marks.append(NamedPoint(name, at, DOT / 2.0 + 1.0, f"{gid} name"))
