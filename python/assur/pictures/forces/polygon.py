"""The force polygon of links cut free: see `Reactions.polygon`."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from assur.pictures.axes import canvas, scale_bar
from assur.pictures.forces.placed import (
    force_colour,
    force_gid,
    force_texts,
    require_forces,
)
from assur.pictures.style import style_of
from assur.pictures.vectors.arrows import LOOKS, arrow
from assur.pictures.vectors.beside import Beside
from assur.pictures.vectors.dots import dots
from assur.pictures.vectors.heading import LINE_HEIGHT, place_text, write_heading

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from assur._faces import ForceSystem, PlacedForce

# The order of the sides; forces smaller than this fraction of the greatest are not drawn.
ORDER, LEAST = ("load", "weight", "inertia", "drive", "reaction"), 1e-9
DOT = 4.0


def force_polygon(system: ForceSystem, ax: Any, dark: bool) -> Axes:
    """See `Reactions.polygon`."""
    require_forces(system)
    forces = polygon_sides(system)
    corners = np.vstack([np.zeros(2), np.cumsum([force.force for force in forces], axis=0)])
    on = canvas(
        ax,
        (corners.min(axis=0), corners.max(axis=0)),
        style_of(dark),
        np.inf,
        2.0 * LINE_HEIGHT,
    )
    sides = [np.array(pair) for pair in pairwise(corners)]
    for force, side in zip(forces, sides, strict=True):
        arrow(
            on,
            side[0],
            side[1],
            LOOKS["force"]._replace(line=2.5),
            force_colour(on, force),
            force_gid(force),
            dashed=force.kind == "inertia",
        )
    dots(on, corners[:-1], DOT, on.style.ink, "corners")
    beside = Beside(on, sides)
    for force, side in sorted(
        zip(forces, sides, strict=True), key=lambda pair: -float(np.hypot(*pair[0].force))
    ):
        texts, gid = force_texts(force), f"{force_gid(force)} text"
        beside.write(side[0], side[1], texts, on.style.ink, gid)
    write_heading(on, [f"Force polygon of {', '.join(system.links)}", place_text(system.motion)])
    scale_bar(on, bar_text)
    return on.ax


def bar_text(force: float) -> str:
    """Write a round force with its unit."""
    return f"{force / 1e3:.6g} kN" if force >= 1e3 else f"{force:.6g} N"


def polygon_sides(system: ForceSystem) -> list[PlacedForce]:
    """Return the outer forces in their order; on pins of several links cut free their sum."""
    outer: dict[tuple[str, str], Any] = {}
    for force in system.forces:
        if force.inner:
            continue
        name = force.name if force.kind == "reaction" else str(len(outer))
        before = outer.get((force.kind, name))
        total = force.force if before is None else before.force + force.force
        first: Any = before or force
        outer[force.kind, name] = first._replace(force=total)
    greatest = max(float(np.hypot(*force.force)) for force in outer.values())
    kept = [f for f in outer.values() if np.hypot(*f.force) > LEAST * greatest]
    return sorted(kept, key=lambda force: ORDER.index(force.kind))
