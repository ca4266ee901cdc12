"""Polar diagrams of bearing loads: see `Bearing.plot`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.font_manager import FontProperties
from matplotlib.lines import Line2D
from matplotlib.patches import Circle
from matplotlib.text import Text

from assur.errors import InputError
from assur.pictures.axes import TEXT, canvas, listed_axes, nice_length, plain_figure
from assur.pictures.forces.placed import force_value
from assur.pictures.forces.polygon import bar_text
from assur.pictures.numerals import number, true_minus
from assur.pictures.scene.geometry import unit_vector
from assur.pictures.style import style_of
from assur.pictures.text import name_font, write_names
from assur.pictures.vectors.arrows import LOOKS, arrow
from assur.pictures.vectors.beside import Beside
from assur.pictures.vectors.dots import dots
from assur.pictures.vectors.heading import LINE_HEIGHT, write_heading
from assur.pictures.vectors.symbols import formula_font, formula_size, symbol

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from assur._arrays import Float
    from assur._faces import Bearing, Panels
    from assur.pictures.axes import Canvas
    from assur.pictures.style import Style

# One diagram, inches.
WIDTH, HEIGHT = 5.0, 5.2
# Circles of the grid, at most; positions with a dot, about.
RINGS, DOTS = 5, 12
# Half the width of a circle's text, points.
RING_TEXT = 11.0
LINE, DOT = 1.8, 4.0


def polar_load(bearing: Bearing, ax: Any, dark: bool) -> Axes | Panels:
    """See `Bearing.plot`."""
    if bearing.designs:
        message = (
            f"a load diagram is of one design, this is a batch {bearing.designs}: take the "
            "reactions of one with machine.of(mechanism.design(i))"
        )
        raise InputError(message)
    force = np.asarray(bearing.force).reshape(-1, 2)
    sizes = np.hypot(*force.T)
    if not np.nanmax(sizes, initial=0.0) > 0.0:
        joint, on = bearing.what
        message = f"there is no force on {on!r} at joint {joint!r}: there is nothing to draw"
        raise InputError(message, joint=joint)
    style = style_of(dark)
    link, angle = bearing.frame
    turn = np.broadcast_to(np.asarray(angle).reshape(-1), sizes.shape)
    cosine, sine = np.cos(turn), np.sin(turn)
    x, y = force.T
    fixed = np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=1)
    views = [("ground", fixed), (link, force)] if link != "ground" else [(link, force)]
    if ax is None:
        figure = plain_figure((WIDTH * len(views), HEIGHT), style)
        wide = 1.0 / len(views)
        axes = [
            figure.add_axes((i * wide, 0.0, wide, 1.0), facecolor=style.canvas)
            for i in range(len(views))
        ]
    else:
        axes = listed_axes(ax)
        views = views[-len(axes) :]
        if len(axes) != len(views):
            message = f"ax has {len(axes)} axes: the frame {link!r} has {len(views)}"
            raise InputError(message)
    for panel, (name, ends) in zip(axes, views, strict=True):
        _draw(panel, bearing, name, ends, style)
    return axes[0] if len(axes) == 1 else np.array(axes, dtype=object)


def _draw(ax: Any, bearing: Bearing, frame: str, ends: Float, style: Style) -> None:
    joint, on_link = bearing.what
    known = ends[np.isfinite(ends).all(axis=1)]
    radius = float(np.hypot(*known.T).max())
    corner = np.full(2, radius)
    on = canvas(ax, (-corner, corner), style, np.inf, 3.0 * LINE_HEIGHT)
    lines = _grid(on, radius, ends)
    curve = Line2D(*ends.T, color=style.force, linewidth=LINE, zorder=2.5, gid="force")
    on.ax.add_artist(curve)
    # From the sizes themselves: turning them rounds, and both diagrams mark the same position.
    best = int(np.nanargmax(np.asarray(bearing.size).reshape(-1)))
    arrow(on, np.zeros(2), ends[best], LOOKS["force"]._replace(line=2.0), style.ink, "greatest")
    shaft = np.array([np.zeros(2), ends[best]])
    marked = _marked(ends, on)
    for i in marked:
        dots(on, ends[i], DOT, style.force, f"position {i}", 3.5)
    beside = Beside(on, [ends, shaft, *lines])
    texts = _places(bearing)
    value = force_value(float(np.hypot(*ends[best])))
    written = beside.write(
        np.zeros(2),
        ends[best],
        (f"{symbol('R', [joint])} = {value}",),
        on.style.ink,
        "greatest text",
    )
    blocks = [] if written is None else [_outline(on, written)]
    write_names(
        on,
        [texts[i] for i in marked],
        ends[marked].reshape(-1, 2),
        np.full(len(marked), DOT / 2.0 + 1.0),
        [ends, shaft, *lines, *blocks],
        [f"number {i}" for i in marked],
        font=formula_font(TEXT - 1.0),
        colours=[style.second] * len(marked),
    )
    seen = "ground" if frame == "ground" else f"{frame}, x along it"
    greatest = f"greatest {value} at q = {texts[best]}"
    write_heading(on, [f"Force on {on_link} at {joint}", f"seen from {seen}", greatest])


def _grid(on: Canvas, radius: float, ends: Float) -> list[Float]:
    """Draw circles of equal force and the axes of the frame; return lines and texts' middles."""
    step = nice_length(radius / 2.5)
    while radius / step > RINGS:
        step *= 2.0
    rings = step * np.arange(1, int(radius / step * (1.0 + 1e-9)) + 1)
    # Where on the circles their texts are farthest from the curve.
    angles = np.radians([-45.0, 45.0, 135.0, -135.0, -60.0, -30.0, 60.0, 120.0, -120.0])
    units = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    known = ends[np.isfinite(ends).all(axis=1)]
    clear = [
        np.hypot(*np.moveaxis(rings[:, None, None] * unit - known, -1, 0)).min() for unit in units
    ]
    toward = units[int(np.argmax(np.minimum(clear, 30.0 / on.scale)))]
    lines = []
    for ring in rings.tolist():
        circle = Circle(
            (0.0, 0.0), ring, fill=False, edgecolor=on.style.grid, linewidth=0.9, zorder=1.0,
            gid="ring",
        )  # fmt: skip
        on.ax.add_artist(circle)
        x, y = ring * toward
        _level(on, x, y, bar_text(ring), FontProperties(size=TEXT - 1.5), "ring text")
        half = np.array([RING_TEXT / on.scale, 0.0])
        lines.append(np.array([ring * toward - half, ring * toward + half]))
    reach = radius + 10.0 / on.scale
    for unit, letter in zip(np.eye(2), "xy", strict=True):
        line = reach * np.array([-unit, unit])
        lines.append(line)
        on.ax.add_artist(
            Line2D(*line.T, color=on.style.second, linewidth=0.8, zorder=1.1, gid=f"axis {letter}")
        )
        x, y = line[1] * (1.0 + 7.0 / on.scale / reach)
        _level(on, x, y, letter, name_font(TEXT + 1.0), f"axis {letter} name")
    return lines


def _level(on: Canvas, x: float, y: float, text: str, font: FontProperties, gid: str) -> None:
    """Write a text of the grid on a piece of canvas."""
    artist = Text(
        x,
        y,
        text,
        fontproperties=font,
        color=on.style.second,
        horizontalalignment="center",
        verticalalignment="center",
        zorder=1.2,
        bbox={"facecolor": on.style.canvas, "edgecolor": "none", "pad": 1.0},
        gid=gid,
    )
    on.ax.add_artist(artist)


def _marked(ends: Float, on: Canvas) -> list[int]:
    """Return about a dozen positions, each far enough from the one before."""
    every = max(1, -(-(len(ends) - 1) // DOTS))
    marked: list[int] = []
    for i in range(0, len(ends), every):
        if not np.isfinite(ends[i]).all():
            continue
        if all(np.hypot(*(ends[i] - ends[k])) * on.scale > 3.0 * DOT for k in marked):
            marked.append(i)
    return marked


def _places(bearing: Bearing) -> list[str]:
    """Write the coordinates of all positions."""
    q = np.asarray(bearing.q, dtype=np.float64)
    several = q.ndim > np.ndim(bearing.size)
    rows = q.reshape(-1, q.shape[-1] if several else 1)
    texts = []
    for i, row in enumerate(rows):
        if several:
            texts.append(str(i))
        elif bearing.is_angle:
            texts.append(true_minus(f"{np.degrees(row[0]):.4g}°"))
        else:
            texts.append(f"{number(float(row[0]))} m")
    return texts


def _outline(on: Canvas, text: Any) -> Float:
    """Return the middle line of a text as an obstacle, m."""
    half = formula_size(text.get_text(), formula_font(TEXT))[0] / 2.0 / on.scale
    angle = np.radians(text.get_rotation())
    middle = np.array(text.get_position())
    along = half * unit_vector(angle)
    return np.array([middle - along, middle + along])
