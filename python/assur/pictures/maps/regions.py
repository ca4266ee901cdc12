"""Hatched regions of a map, and where in them a text has room."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.patches import PathPatch
from matplotlib.path import Path

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur._arrays import Float
    from assur.pictures.style import Style

HATCHES = ("////", "\\\\\\\\", "xx", "...")
# Places along an axis among which to look for the roomiest.
NODES = 49


def hatched_region(
    ax: Any, x: Float, y: Float, inside: npt.NDArray[np.bool_], number: int, style: Style, gid: str
) -> Any:
    """Hatch the part of a map where a flag over its nodes holds; return the patch."""
    z = inside.T.astype(np.float64)
    contours = ax.contourf(x, y, z, levels=[0.5, 1.5])
    path = Path.make_compound_path(*contours.get_paths())
    contours.remove()
    patch = PathPatch(
        path,
        facecolor=style.canvas,
        edgecolor=style.faint,
        hatch=HATCHES[number % len(HATCHES)],
        linewidth=0.0,
        zorder=2.0,
        gid=gid,
    )
    ax.add_patch(patch)
    return patch


def roomiest(
    x: Float, y: Float, inside: npt.NDArray[np.bool_], box: Float
) -> tuple[float, float, float]:
    """Return where a box of a size has most room in a region, and how much of the box fits.

    The size is in the units of x and y; above 1 it fits.
    """
    # Between nodes the nearest counts, as for hatching.
    fine = [np.linspace(axis[0], axis[-1], NODES) for axis in (x, y)]
    nearest = [
        np.searchsorted((axis[1:] + axis[:-1]) / 2.0, nodes)
        for axis, nodes in zip((x, y), fine, strict=True)
    ]
    grid = inside[np.ix_(*nearest)]
    places = np.stack(np.meshgrid(*fine, indexing="ij"), axis=-1)
    inner, outer = places[grid], places[~grid]
    half = box / 2.0
    room = np.full(len(inner), np.inf)
    for part in np.array_split(outer, max(1, len(outer) // 256)):
        if len(part):
            apart = (np.abs(inner[:, None] - part[None]) / half).max(axis=-1)
            room = np.minimum(room, apart.min(axis=1))
    low, high = places[0, 0], places[-1, -1]
    room = np.minimum(room, (np.minimum(inner - low, high - inner) / half).min(axis=1))
    if not len(inner):
        return float(x[0]), float(y[0]), 0.0
    best = int(np.argmax(room))
    return float(inner[best, 0]), float(inner[best, 1]), float(room[best])
