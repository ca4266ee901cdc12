"""Fixed and moving centrode rolling on each other: see `assur.pictures.centrodes`."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.lines import Line2D

from assur._validate import checked_index, checked_name, require_one_driver
from assur.errors import InputError
from assur.pictures.axes import scale_bar
from assur.pictures.linkage.position import NamedPoint, draw_position, free_name
from assur.pictures.linkage.refine import checked_motion, refined
from assur.pictures.linkage.subject import Subject
from assur.pictures.scene.frames import frames_of
from assur.pictures.style import style_of
from assur.pictures.vectors.dots import dots
from assur.pictures.vectors.heading import LINE_HEIGHT, write_heading

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from assur._arrays import Float
    from assur._faces import Motion
    from assur.pictures.axes import Canvas

# Positions of a whole motion: the curves are smooth, and far branches end far off.
ROWS = 721
# Curves are cut off at this multiple of the mechanism's size; the picture shows less.
FAR, SIGHT = 25.0, 0.6
LINE = 1.8
DOT = 6.0


def centrodes(
    motion: Motion,
    link: str,
    other: str = "ground",
    *,
    at: int | tuple[int, ...] = (),
    ax: Axes | None = None,
    dark: bool = False,
) -> Axes:
    """Draw the centrodes of a link: its motion is the rolling of one on the other.

    The fixed centrode is the path of the instant centre as `other` sees it, the moving one as the
    link sees it, drawn where the link is. They touch at the instant centre.

    Parameters
    ----------
    motion : Motion
        A motion of one design and one driver: a row of positions over which the curves go, or one
        position, which stands for the whole motion of the mechanism.
    link, other : str
        The link, and the link relative to which it moves.
    at : int or tuple of int
        Index of the position drawn; by default the first of a row.
    ax : matplotlib.axes.Axes, optional
        Where to draw; a new figure by default.
    dark : bool
        Light lines on a dark ground.

    Returns
    -------
    matplotlib.axes.Axes
        The axes drawn on. Artists are named ``fixed centrode``, ``moving centrode``, ``pole``.

    Raises
    ------
    InputError
        An unknown link, the same link twice, several drivers, positions without analogues.

    Examples
    --------
    The coupler of an antiparallelogram rolls on the ground with an ellipse on an ellipse:

    >>> import assur
    >>> from assur.pictures import centrodes
    >>> crossed = assur.FourBar(1.0, 3.0, 1.0, 3.0, mode="crossed")
    >>> axes = centrodes(crossed.solve(1.0), "rocker", other="crank")
    >>> [line.get_gid() for line in axes.lines if "centrode" in (line.get_gid() or "")]
    ['fixed centrode', 'moving centrode']
    """
    motion = checked_motion(motion)
    require_one_driver(motion.driver_count, "centrodes")
    for name in (link, other):
        motion.mechanism.core.index_of("link", checked_name(name, "link"))
    if link == other:
        message = f"link and other are both {link!r}: give two links"
        raise InputError(message, link=link)
    index = (0,) * len(motion.shape) if isinstance(at, tuple) and not at else at
    position = motion[checked_index(index, motion.shape, "at")] if motion.shape else motion
    rows, _ = refined(motion, "centrodes", 1, ROWS)
    pole = position.instant_centre(link, other)
    if not np.isfinite(pole).all():
        reason = (
            position.explain() if np.isnan(pole).all() else f"{link} does not turn relative to it"
        )
        message = f"no instant centre of {link!r} and {other!r} there: {reason}"
        raise InputError(message, link=link)
    subject = Subject(position)
    fixed, moving = _curves(subject, rows, link, other)
    points = np.concatenate([fixed, moving, pole[None]])
    on = subject.canvas(
        ax,
        style_of(dark),
        [points[subject.sees(points, SIGHT)]],
        2.0 * LINE_HEIGHT,
    )
    in_sight = bool(((pole > on.low) & (pole < on.high)).all())
    lines = [
        _curve(on, fixed, "fixed centrode", on.style.path, False),
        _curve(on, moving, "moving centrode", on.style.driver, True),
    ]
    mark = NamedPoint(free_name(subject, "P", "I", "Π"), pole, DOT / 2.0 + 1.0, "pole name")
    draw_position(subject, on, subject.frames[0], lines=lines, marks=[mark] if in_sight else [])
    if in_sight:
        dots(on, pole, DOT, on.style.error, "pole", 4.5)
    beyond = "" if in_sight else "; they touch out of sight"
    relative = "" if other == "ground" else f" relative to {other}"
    write_heading(on, [f"Centrodes of {link}{relative}", f"fixed: solid, moving: dashed{beyond}"])
    scale_bar(on)
    return on.ax


def _curves(subject: Subject, rows: Motion, link: str, other: str) -> tuple[Float, Float]:
    """Return both centrodes where the links are at the position drawn, (N, 2)."""
    centres = rows.instant_centre(link, other)
    frames = frames_of(rows)
    size = float(np.ptp(np.array(list(subject.mechanism.joints.values())), axis=0).max())
    with np.errstate(invalid="ignore"):
        centres = np.where(np.isfinite(centres), centres, np.nan)
        curves = []
        for name in (other, link):
            seen = frames.seen_from(name, centres)
            x, y, angle = subject.frames[0][frames.links.index(name)]
            cosine, sine = np.cos(angle), np.sin(angle)
            curve = np.stack(
                [
                    x + cosine * seen[:, 0] - sine * seen[:, 1],
                    y + sine * seen[:, 0] + cosine * seen[:, 1],
                ],
                axis=-1,
            )
            middle = subject.frames[0, :, :2].mean(axis=0)
            far = np.abs(curve - middle).max(axis=1) > FAR * size
            curve[far] = np.nan
            curves.append(_once(curve))
    return curves[0], curves[1]


def _once(curve: Float) -> Float:
    """Return a curve without its second round if it is the first again: dashes would fill up."""
    half = len(curve) // 2
    first, second = curve[: half + 1], curve[half:]
    again = len(curve) % 2 == 1 and np.allclose(first, second, rtol=0.0, atol=1e-6, equal_nan=True)
    return first if again else curve


def _curve(on: Canvas, points: Float, gid: str, colour: str, dashed: bool) -> Float:
    line = Line2D(
        *points.T,
        color=colour,
        linewidth=LINE,
        linestyle=(0.0, (6.0, 3.0)) if dashed else "solid",
        zorder=1.6 if dashed else 1.5,
        gid=gid,
    )
    on.ax.add_artist(line)
    return points
