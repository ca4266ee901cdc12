"""How far a scene reaches, and how long its links usually are."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur.pictures.scene.shapes import Disc, Hatching, Stroke

if TYPE_CHECKING:
    from assur.pictures.scene.frames import Frames
    from assur.pictures.scene.shapes import Part, Scene, Vertex


def corners(scene: Scene) -> set[tuple[str, float, float]]:
    """Return every point of a scene, with the link it is fixed to."""
    return {(part.link, vertex.x, vertex.y) for part in scene.parts for vertex in vertices(part)}


def usual_link(frames: Frames) -> float:
    """Return the median length of the links, m."""
    lengths = [
        float(np.hypot(*(first - second)))
        for link, joints in frames.local.items()
        if link != "ground"
        for i, first in enumerate(joints.values())
        for second in list(joints.values())[:i]
    ]
    if lengths:
        return float(np.median(lengths))
    joints = np.concatenate(list(frames.joints().values()))
    return float(np.ptp(joints, axis=0).max())


def vertices(part: Part) -> tuple[Vertex, ...]:
    """Return the points of a part."""
    if isinstance(part, Disc):
        return (part.centre,)
    return (part.start, part.end) if isinstance(part, Hatching) else part.vertices


def line_vertices(part: Part) -> tuple[Vertex, ...]:
    """Return the points of a part's line; a closed one ends where it begins."""
    points = vertices(part)
    return (*points, points[0]) if isinstance(part, Stroke) and part.closed else points
