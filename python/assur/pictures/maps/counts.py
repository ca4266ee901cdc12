"""Regions of a plane by a whole number: design maps and workspaces."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch

from assur.description.dotted_names import is_angle
from assur.pictures.chart import TEXT, chart_axes, title
from assur.pictures.maps.quantity_axis import name_axis
from assur.pictures.maps.raster import finer
from assur.pictures.maps.regions import hatched_region, roomiest
from assur.pictures.points import point_in_data, settle
from assur.pictures.style import blend, style_of
from assur.pictures.text import plain_size

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    import numpy.typing as npt
    from matplotlib.axes import Axes

    from assur._arrays import Float
    from assur._faces import DesignMap
    from assur.pictures.style import Style

# Hues of the least number that is not 0, and of the greatest.
PALEST, STRONGEST = 0.16, 0.62
LINE = 1.6
NAMES: dict[str, Mapping[int, str]] = {
    "full_rotation": {0: "stops", 1: "goes round"},
    "assemblies": {0: "cannot be assembled", 1: "1 assembly"},
}


def fill_counts(
    ax: Any,
    x: Float,
    y: Float,
    values: npt.NDArray[np.intp],
    lines: Sequence[Float],
    style: Style,
    name: Callable[[int], str],
    below: float = -0.18,
    hatched: bool = False,
) -> None:
    """Fill regions between lines by the number in them, and write `name(number)` there.

    A legend this far below the axes, relative to their height, explains what has no room.
    With `hatched` regions of 0 are hatched as those that are not feasible.
    """
    fine_x, fine_y, fine = finer(x, y, values, lines)
    kinds = np.unique(values)
    positive = kinds[kinds > 0]
    steps = np.linspace(PALEST, STRONGEST, max(len(positive), 2))
    shades = dict(zip(positive.tolist(), steps.tolist(), strict=False))
    colours = [blend(style.path, style.canvas, shades.get(int(kind), 0.0)) for kind in kinds]
    ax.pcolormesh(
        np.append(_starts(x, len(fine_x)), x[-1]),
        np.append(_starts(y, len(fine_y)), y[-1]),
        np.searchsorted(kinds, fine).T,
        cmap=ListedColormap(colours),
        vmin=-0.5,
        vmax=len(kinds) - 0.5,
        zorder=0.5,
        rasterized=True,
        gid="regions",
    )
    if hatched and (fine == 0).any():
        hatched_region(ax, fine_x, fine_y, fine == 0, 0, style, "region 0").set_zorder(0.6)
    settle(ax)
    point = point_in_data(ax)
    left = []
    for kind, colour in zip(kinds.tolist(), colours, strict=True):
        text = name(kind)
        if not text:
            continue
        box = (np.array(plain_size(text, TEXT)) + 6.0) * point
        at_x, at_y, room = roomiest(fine_x, fine_y, fine == kind, box)
        if room >= 1.0:
            ax.text(
                at_x, at_y, text, ha="center", va="center", color=style.ink, fontsize=TEXT,
                zorder=4.0, gid=f"region {kind}",
                bbox={"facecolor": colour, "edgecolor": "none", "pad": 2.5},
            )  # fmt: skip
        elif (fine == kind).any():
            left.append(Patch(facecolor=colour, edgecolor=style.second, label=text))
    if left:
        ax.legend(
            handles=left, loc="upper center", bbox_to_anchor=(0.5, below), ncols=3,
            frameon=False, fontsize=TEXT, labelcolor=style.ink,
        ).set_gid("regions")  # fmt: skip


def _starts(axis: Float, count: int) -> Float:
    per = count // (len(axis) - 1)
    starts: Float = (axis[:-1, None] + np.arange(per) / per * np.diff(axis)[:, None]).reshape(-1)
    return starts


def design_map_picture(design_map: DesignMap, ax: Any, dark: bool) -> Axes:
    """See `DesignMap.plot`."""
    style = style_of(dark)
    ax = chart_axes(ax, style)
    ax.grid(visible=False)
    ax.set(xlim=(design_map.x[0], design_map.x[-1]), ylim=(design_map.y[0], design_map.y[-1]))
    for axis, name, values in zip(
        (ax.xaxis, ax.yaxis), design_map.names, (design_map.x, design_map.y), strict=True
    ):
        name_axis(axis, name, values, is_angle(name), style)
    title(ax, design_map.of.replace("_", " "), style)
    lines = [boundary.points for boundary in design_map.boundaries]

    def named(number: int) -> str:
        return NAMES[design_map.of].get(number, f"{number} assemblies")

    fill_counts(
        ax, design_map.x, design_map.y, design_map.values, lines, style, named, hatched=True
    )
    for boundary in design_map.boundaries:
        ax.plot(
            *boundary.points.T, color=style.ink, linewidth=LINE, gid=f"boundary {boundary.level}",
            solid_capstyle="round",
        )  # fmt: skip
    drawn: Axes = ax
    return drawn
