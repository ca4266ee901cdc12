"""Vectors as arrows: velocities, accelerations and forces, with their sizes beside them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from matplotlib.patheffects import withStroke

from assur.pictures.axes import TEXT
from assur.pictures.numerals import number
from assur.pictures.text import write_names
from assur.pictures.vectors.symbols import formula_font, formula_size, symbol

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur._arrays import Float
    from assur.pictures.axes import Canvas

Kind: TypeAlias = Literal["velocity", "acceleration", "force"]

# Heads of shorter vectors shrink, points.
FULL_HEAD = 26.0
# The longest vector of a picture, points, unless a scale is given.
LONGEST = 60.0
# Arcs of moments: radius, px, and the angles of tail and tip, rad.
ARC_RADIUS, ARC_TAIL, ARC_TIP = 26.0, -0.9, 3.4


class Look(NamedTuple):
    """How vectors are drawn: sizes in px; without open heads they have a filled one."""

    line: float
    head: float
    width: float
    open_heads: int = 0


LOOKS: dict[str, Look] = {
    "velocity": Look(2.25, 11.0, 8.0),
    "acceleration": Look(2.25, 8.0, 9.0, open_heads=2),
    "force": Look(3.5, 13.0, 11.0),
    "part": Look(1.75, 10.0, 7.0),
}
SYMBOLS = {"velocity": ("v", "m/s"), "acceleration": ("a", "m/s²"), "force": ("F", "N")}


def arrow(
    on: Canvas,
    start: Float,
    end: Float,
    look: Look,
    colour: str,
    gid: str,
    dashed: bool = False,
    zorder: float = 3.0,
) -> list[Any]:
    """Draw a vector from a point to another: the shaft, then its heads, named ``gid head``.

    The first vertex of a filled head, the middle one of an open head, is the tip.
    """
    along = np.asarray(end) - start
    length = float(np.hypot(*along)) * on.scale
    if not np.isfinite(length) or length < 1e-9:
        return []
    unit = along * on.scale / length
    shrink = min(1.0, length / FULL_HEAD)
    head = shrink * look.head * on.size
    half = shrink * look.width * on.size / 2.0
    width = look.line * on.size * max(shrink, 0.5)
    # Within a filled head the shaft would blunt the tip.
    inside = end if look.open_heads else end - 0.8 * head / on.scale * unit
    shaft = Line2D(
        *np.array([start, inside]).T,
        color=colour,
        linewidth=width,
        linestyle=(0.0, (4.0, 2.5)) if dashed else "solid",
        solid_capstyle="butt",
        zorder=zorder,
        gid=gid,
    )
    artists: list[Any] = [shaft]
    left = np.array([-unit[1], unit[0]])
    for k in range(max(look.open_heads, 1)):
        tip = end - 0.6 * k * head / on.scale * unit
        back = tip - head / on.scale * unit
        sides = back + half / on.scale * left, back - half / on.scale * left
        if look.open_heads:
            path = Path([sides[0], tip, sides[1]])
            fill: dict[str, Any] = {"facecolor": "none", "capstyle": "round"}
        else:
            path = Path([tip, *sides, tip], closed=True)
            fill = {"facecolor": colour}
        wide = 0.8 * width if look.open_heads else 0.0
        artists.append(
            PathPatch(
                path, edgecolor=colour, linewidth=wide, zorder=zorder, gid=f"{gid} head", **fill
            )
        )
    for artist in artists:
        on.ax.add_artist(artist)
    return artists


def moment_arc(
    on: Canvas, centre: Float, sign: float, colour: str, gid: str, size: float = 1.0
) -> Float:
    """Draw a moment about a point as an arc, counter-clockwise if `sign` is positive.

    Returns the arc's line.
    """
    look = LOOKS["force"]
    per = size * on.size / on.scale
    tail, tip = (ARC_TAIL, ARC_TIP) if sign > 0.0 else (np.pi - ARC_TAIL, np.pi - ARC_TIP)
    turn = np.sign(tip - tail)
    neck = tip - turn * 0.8 * look.head / ARC_RADIUS
    angles = np.linspace(tail, neck, 33)
    line: Float = centre + ARC_RADIUS * per * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    end = centre + ARC_RADIUS * per * np.array([np.cos(tip), np.sin(tip)])
    chord = end - line[-1]
    unit = chord / np.hypot(*chord)
    back = end - look.head * per * unit
    left = look.width * per / 2.0 * np.array([-unit[1], unit[0]])
    artists = [
        Line2D(*line.T, color=colour, linewidth=size * look.line * on.size, zorder=3.4, gid=gid),
        PathPatch(
            Path([end, back + left, back - left, end], closed=True),
            facecolor=colour,
            linewidth=0.0,
            zorder=3.4,
            gid=f"{gid} head",
        ),
    ]
    for artist in artists:
        on.ax.add_artist(artist)
    return line


def vector_scale(vectors: Float, longest: float = LONGEST) -> float:
    """Return points to a unit, so that the longest of some vectors has a length in points."""
    sizes = np.hypot(*np.moveaxis(np.asarray(vectors), -1, 0))
    greatest = float(np.max(sizes[np.isfinite(sizes)], initial=0.0))
    return longest / greatest if greatest > 0.0 else 1.0


def tips(on: Canvas, points: Float, vectors: Float, scale: float) -> Float:
    """Return where arrows end, m; `scale` is points to a unit of the vectors."""
    ends: Float = np.asarray(points) + np.asarray(vectors) * (scale / on.scale)
    return ends


def path_vectors(
    on: Canvas,
    points: Float,
    vectors: Float,
    kind: Kind,
    gids: Sequence[str],
    scale: float | None = None,
    lines: Sequence[Float] = (),
    texts: bool = True,
    names: Sequence[str] = (),
    boxes: list[Float] | None = None,
) -> float:
    """Draw vectors at points, all to one scale, with texts such as "v 0.380 m/s" at their tips.

    Parameters
    ----------
    on : Canvas
        Where.
    points, vectors : ndarray
        (n, 2), m and m/s, m/s² or N; those that are NaN are left out.
    kind : {"velocity", "acceleration", "force"}
        What they are, for the colour and the head.
    gids : sequence of str
        Their names; those of the texts end in ``text``.
    scale : float, optional
        Points to a unit; by default the longest vector gets `LONGEST`.
    lines : sequence of ndarray
        Lines of the picture, m, which texts avoid.
    texts : bool
        Whether sizes are written.
    names : sequence of str
        Of the points, to be written with the symbols.
    boxes : list of ndarray, optional
        (k, 2, 2) each: middles and halves of texts that are there, points; those written are added.

    Returns
    -------
    float
        The scale.
    """
    scale = vector_scale(vectors) if scale is None else scale
    colour: str = getattr(on.style, kind)
    ends = tips(on, points, vectors, scale)
    known = [i for i, end in enumerate(ends) if np.isfinite(end).all()]
    shafts = []
    for i in known:
        arrow(on, np.asarray(points[i]), ends[i], LOOKS[kind], colour, gids[i])
        shafts.append(np.array([points[i], ends[i]]))
    if texts and known:
        letter, unit = SYMBOLS[kind]
        symbols = [symbol(letter, [names[i]] if names else []) for i in known]
        sizes = [float(np.hypot(*vectors[i])) for i in known]
        written = [
            f"{letters} {number(size)} {unit}" for letters, size in zip(symbols, sizes, strict=True)
        ]
        font = formula_font(TEXT)
        halves = np.array([formula_size(text, font) for text in written]) / 2.0
        artists = write_names(
            on,
            written,
            ends[known],
            np.full(len(known), 2.0),
            [*lines, *shafts],
            [f"{gids[i]} text" for i in known],
            np.concatenate(boxes) if boxes else None,
            font=font,
            sizes=[(2.0 * width, 2.0 * height) for width, height in halves.tolist()],
        )
        for artist in artists:
            # Where no place is free of lines.
            artist.set_path_effects([withStroke(linewidth=2.5, foreground=on.style.canvas)])
        if boxes is not None:
            middles = on.points([artist.get_position() for artist in artists])
            boxes.append(np.stack([middles, halves], axis=1))
    return scale
