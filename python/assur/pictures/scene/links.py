"""Links as they are drawn: bars, plates, joints that a bar runs through."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur.pictures import sizes
from assur.pictures.scene.geometry import ON_LINE, about, arc, at, hull
from assur.pictures.scene.shapes import Stroke

if TYPE_CHECKING:
    from assur._arrays import Float


def link_parts(link: str, joints: dict[str, Float], driven: bool) -> list[Stroke]:
    """Return a bar between two joints, a plate for more, nothing for a link of one joint."""
    points = np.array(list(joints.values()))
    if len(points) < 2 or not np.ptp(points, axis=0).any():
        return []
    width = sizes.DRIVEN_BAR if driven else sizes.BAR
    corners = hull(points)
    if len(corners) > 2:
        vertices = tuple(at(points[i]) for i in corners)
        plate = sizes.PLATE * width / sizes.BAR
        return [
            Stroke(
                link,
                f"link {link}",
                vertices,
                plate,
                closed=True,
                fill="tint",
                hatched=True,
                floor=0,
            )
        ]
    ends = points[corners]
    bar = Stroke(link, f"link {link}", tuple(at(end) for end in ends), width)
    along = ends[1] - ends[0]
    angle = float(np.arctan2(along[1], along[0]))
    bridges: list[Stroke] = []
    inner = [p for i, p in enumerate(points) if i not in corners]
    for point in inner:
        # Through a joint inside it a bar goes on under a bridge.
        if min(np.hypot(*(point - end)) for end in ends) > ON_LINE * np.hypot(*along):
            shape = about(point, angle, arc(sizes.BRIDGE, 0.0, np.pi))
            bridges.append(Stroke(link, f"link {link}", shape, 2.0))
    return [bar, *bridges]
