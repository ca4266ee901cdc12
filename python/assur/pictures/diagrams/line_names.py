"""Names of curves, written beside them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from matplotlib.font_manager import FontProperties

from assur.pictures.chart import TEXT
from assur.pictures.diagrams.obstacles import obstacles
from assur.pictures.points import bounds, in_data, in_points
from assur.pictures.scene.labels import along, clearance, within
from assur.pictures.text import STEP, name_font, printable, text_size

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur._arrays import Float

# Places tried along each line; beyond this distance from other lines, points, none is better.
PLACES, FAR = 48, 24.0
NAME = 11.0
# Between a line and its name, points; what a name that is beside its line costs.
GAP, ASIDE = 3.0, 6.0


class Named(NamedTuple):
    """A curve with its name, written beside it."""

    x: Float
    y: Float
    text: str
    colour: str
    italic: bool = True


def name_lines(ax: Any, named: Sequence[Named]) -> None:
    """Write the names of curves beside them, where they are far from the others."""
    for curve in named:
        font = name_font(NAME) if curve.italic else FontProperties(size=TEXT)
        rows = curve.text.split("\n")
        sizes = np.array([text_size(row, font) for row in rows])
        half = (sizes.max(axis=0) * (1.0, 1.4 * len(rows) - 0.4) + 2.0) / 2.0
        printed = in_points(ax, np.column_stack([curve.x, curve.y]))
        printed = printed[np.isfinite(printed).all(axis=1)]
        if len(printed) < 2:
            continue
        line = along([printed], STEP)
        other_curves = along(
            [in_points(ax, np.column_stack([o.x, o.y])) for o in named if o is not curve], STEP
        )
        every = obstacles(ax)
        at = line[np.linspace(0, len(line) - 1, PLACES).astype(int)]
        best, place = -np.inf, at[0]
        frame = bounds(ax)
        for axis, side in ((1, 1.0), (1, -1.0), (0, 1.0), (0, -1.0)):
            across = 1 - axis
            middles, slopes = at.copy(), np.empty(len(at))
            for i, point in enumerate(at):
                # As near as clears the line's own slope beside it.
                beside = line[np.abs(line[:, across] - point[across]) <= half[across], axis]
                middles[i, axis] = side * ((side * beside).max() + GAP + half[axis])
                slopes[i] = np.ptp(beside)
            apart = clearance(middles, half, other_curves).clip(max=FAR)
            clear = np.minimum(clearance(middles, half, every), within(middles, half, frame))
            worth = np.minimum(apart, 3.0 * clear) - 0.05 * slopes - ASIDE * across
            if worth.max() > best:
                best, place = float(worth.max()), middles[int(np.argmax(worth))]
        x, y = in_data(ax, place)
        written = ax.text(
            x, y, printable(curve.text), fontproperties=font, color=curve.colour,
            horizontalalignment="center", verticalalignment="center", zorder=5.0,
            gid=f"name {curve.text}", parse_math=False,
        )  # fmt: skip
        written.set_in_layout(False)
