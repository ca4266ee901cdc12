"""Hodographs: the ends of velocities or accelerations drawn from one pole."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.lines import Line2D

from assur._arrays import finite_array
from assur._other_names import renamed_rates
from assur._validate import checked_name, whole_number
from assur.errors import InputError
from assur.pictures.axes import TEXT, canvas, scale_bar
from assur.pictures.linkage.refine import checked_motion, refined
from assur.pictures.numerals import angle_text, number
from assur.pictures.style import style_of
from assur.pictures.text import write_names
from assur.pictures.vectors.arrows import LOOKS, SYMBOLS, arrow
from assur.pictures.vectors.beside import Beside
from assur.pictures.vectors.dots import dots
from assur.pictures.vectors.heading import LINE_HEIGHT, write_heading
from assur.pictures.vectors.symbols import formula_font, formula_size, symbol

if TYPE_CHECKING:
    import numpy.typing as npt
    from matplotlib.axes import Axes

    from assur._arrays import Float
    from assur._faces import Motion
    from assur.pictures.axes import Canvas

# About this many positions of a curve have a dot.
DOTS = 12
LINE, DOT = 1.8, 4.0


@renamed_rates
def hodograph(
    motion: Motion,
    joint: str,
    *,
    speed: npt.ArrayLike = 1.0,
    order: int = 1,
    acceleration: npt.ArrayLike = 0.0,
    ax: Axes | None = None,
    dark: bool = False,
) -> Axes:
    """Draw the hodograph of a joint: the ends of its velocities drawn from one pole.

    Parameters
    ----------
    motion : Motion
        Of one design: a row of positions, or one position, which stands for the whole motion of
        the mechanism.
    joint : str
        The joint.
    speed, acceleration : array_like
        Speed and acceleration of the driver, as for `Analogues.velocity`.
    order : {1, 2}
        Velocities or accelerations.
    ax : matplotlib.axes.Axes, optional
        Where to draw; a new figure by default.
    dark : bool
        Light lines on a dark ground.

    Returns
    -------
    matplotlib.axes.Axes
        The axes drawn on. Artists are named ``hodograph C``, ``position 3`` with its number, and
        ``greatest`` for the vector of greatest size.

    Raises
    ------
    InputError
        An unknown joint, a batch of designs, an order that is not 1 or 2, a joint at rest.

    Examples
    --------
    A crank's pin at 10 rad/s on 0.1 m: a circle of 1 m/s.

    >>> import assur, numpy as np
    >>> from assur.pictures import hodograph
    >>> axes = hodograph(assur.SliderCrank(0.1, 0.4).solve(0.0), "A", speed=10.0)
    >>> curve = next(a for a in axes.lines if a.get_gid() == "hodograph A")
    >>> bool(np.allclose(np.hypot(*curve.get_data()), 1.0))
    True
    """
    motion = checked_motion(motion)
    motion.mechanism.core.index_of("joint", checked_name(joint, "joint"))
    order = whole_number(order, "order", 1, 2, needed="1 for velocities, 2 for accelerations")
    speed, acceleration = finite_array(speed, "speed"), finite_array(acceleration, "acceleration")
    rows, steps = refined(motion, "a hodograph", order)
    point = rows.joint(joint)
    ends = point.velocity(speed) if order == 1 else point.acceleration(speed, acceleration)
    ends = ends.reshape(-1, 2)
    sizes = np.hypot(*ends.T)
    if not np.nanmax(sizes, initial=0.0) > 0.0:
        message = f"joint {joint!r} rests at speed = {speed}: it has no hodograph"
        raise InputError(message, joint=joint)
    known = np.vstack([ends[np.isfinite(sizes)], np.zeros(2)])
    on = canvas(
        ax, (known.min(axis=0), known.max(axis=0)), style_of(dark), np.inf, 2.0 * LINE_HEIGHT
    )
    what = ("velocity", "acceleration")[order - 1]
    marked = _marked(on, ends, steps)
    names = [str(i // steps) for i in marked]
    if (
        not motion.shape
        and rows.q.ndim == 1
        and motion.mechanism.driver not in rows.mechanism.slides
    ):
        names = [angle_text(rows.q[i], 0) for i in marked]
    _draw(on, joint, what, ends, dict(zip(marked, names, strict=True)))
    noun = ("velocities", "accelerations")[order - 1]
    letter, unit = SYMBOLS[what]
    least, greatest = (number(float(x)) for x in (np.nanmin(sizes), np.nanmax(sizes)))
    write_heading(
        on, [f"Hodograph of {joint}: {noun}", f"{letter} from {least} to {greatest} {unit}"]
    )
    scale_bar(on, lambda length: f"{length:.6g} {unit}")
    return on.ax


def _marked(on: Canvas, ends: Float, steps: int) -> list[int]:
    """Return the positions that have a dot: about a dozen of those given."""
    positions = range(0, len(ends), steps)
    every = max(1, -(-(len(positions) - 1) // DOTS))
    marked = [i for i in positions[::every] if np.isfinite(ends[i]).all()]
    # The last position of a turn is the first again.
    if len(marked) > 1 and np.hypot(*(ends[marked[-1]] - ends[marked[0]])) * on.scale < DOT:
        marked.pop()
    return marked


def _draw(on: Canvas, joint: str, what: str, ends: Float, marked: dict[int, str]) -> None:
    sizes = np.hypot(*ends.T)
    colour: str = getattr(on.style, what)
    curve = Line2D(*ends.T, color=colour, linewidth=LINE, zorder=2.0, gid=f"hodograph {joint}")
    on.ax.add_artist(curve)
    for i in marked:
        dots(on, ends[i], DOT, colour, f"position {i}", 3.5)
        if sizes[i] > 0.0:
            ray = np.array([np.zeros(2), ends[i]])
            on.ax.add_artist(
                Line2D(*ray.T, color=on.style.faint, linewidth=0.8, zorder=1.0, gid=f"ray {i}")
            )
    best = int(np.nanargmax(sizes))
    look = LOOKS["velocity"]
    if what == "acceleration":
        look = LOOKS["acceleration"]
    arrow(on, np.zeros(2), ends[best], look, colour, "greatest")
    dots(on, np.zeros(2), DOT, on.style.ink, "pole")
    shaft = np.array([np.zeros(2), ends[best]])
    places = np.array([np.zeros(2), *ends[list(marked)]])
    names, font = ["$o$", *marked.values()], formula_font(TEXT)
    written = write_names(
        on,
        names,
        places,
        np.full(len(places), DOT / 2.0 + 1.0),
        [ends, shaft],
        ["pole name", *(f"number {i}" for i in marked)],
        font=font,
        colours=[on.style.ink, *[on.style.second] * len(marked)],
        sizes=[formula_size(name, font) for name in names],
    )
    beside = Beside(on, [ends, shaft])
    for text in written:
        beside.block(np.array(text.get_position()), np.array([4.0, 5.0]))
    letter, unit = SYMBOLS[what]
    value = f"{symbol(letter, [joint])} = {number(float(sizes[best]))} {unit}"
    beside.write(np.zeros(2), ends[best], (value,), on.style.ink, "greatest text")
