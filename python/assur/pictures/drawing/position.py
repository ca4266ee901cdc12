"""A position: the symbols of the scene, or the links' outlines where they are, dimensioned."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur.pictures import sizes
from assur.pictures.drawing.hidden import outside_circle, outside_polygon
from assur.pictures.drawing.link_part import FIRST, MM, NEAR, NEXT, Workshop, part_marks
from assur.pictures.drawing.marks import (
    Circle,
    Distance,
    Filled,
    Mark,
    Outline,
    bounds,
    moved,
)
from assur.pictures.drawing.names import STEP, dimension_lines
from assur.pictures.scene.extent import usual_link, vertices
from assur.pictures.scene.geometry import left_of
from assur.pictures.scene.hatching import DEPTH, hatched_area, hatched_line
from assur.pictures.scene.labels import along
from assur.pictures.scene.shapes import Disc, Hatching, Stroke

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.pictures.linkage.subject import Subject
    from assur.pictures.scene.shapes import Part

# A px of the symbols, mm of the paper.
PX = 25.4 / 96.0
# Distances of a dimension from its link on either side, mm of the paper.
BESIDE = (8.0, -8.0, 14.0, -14.0, 20.0, -20.0)
# Number of points among which to look for the nearest to a dimension.
MOST = 4000


def schematic(subject: Subject, layers: dict[str, str], per: float) -> list[Mark]:
    """Return the symbols of a position, without the lines under joints and blocks."""
    size = PX * per * _density(subject, per)
    drawn: list[tuple[Part, Float]] = []
    for part in subject.scene.parts:
        at = vertices(part)
        places = [MM * subject.world(subject.frames[0], part.link, v, size / MM) for v in at]
        drawn.append((part, np.array(places)))
    marks: list[Mark] = []
    for i, (part, points) in enumerate(drawn):
        layer = _layer(part, layers)
        above = drawn[i + 1 :]
        if isinstance(part, Disc):
            radius = part.radius * size
            marks.append(Circle(layer, points[0], radius, part.width * PX, part.fill == "solid"))
        elif isinstance(part, Hatching):
            lines = hatched_line(points[0], points[1], part.spacing * size, DEPTH * size)
            marks += _pieces(layer, lines, 1.1 * PX, above, size)
        elif part.fill == "solid":
            marks.append(Filled(layer, points))
        else:
            marks += _stroke(part, points, layer, above, size)
    return marks


def _density(subject: Subject, per: float) -> float:
    """Return by how much symbols shrink where links are short on the paper."""
    usual = MM * usual_link(subject.whole) / per / PX
    return float(np.clip(usual / sizes.USUAL_LINK, sizes.LEAST_DENSITY, 1.0))


def _layer(part: Part, layers: dict[str, str]) -> str:
    if part.name == "driver":
        return "DRIVER"
    return "JOINTS" if isinstance(part, Disc) else layers[part.link]


def _stroke(
    part: Stroke, points: Float, layer: str, above: list[tuple[Part, Float]], size: float
) -> list[Mark]:
    weight = part.width * PX
    closed = np.vstack([points, points[:1]]) if part.closed else points
    segments = np.stack([closed[:-1], closed[1:]], axis=1)
    left = _visible(segments, above, size)
    if len(left) == len(segments) and np.array_equal(left, segments):
        marks: list[Mark] = [
            Outline(layer, points, None, part.closed, weight, dash_dotted=bool(part.dashes))
        ]
    else:
        marks = [
            Outline(layer, piece, weight=weight, dash_dotted=bool(part.dashes)) for piece in left
        ]
    if part.hatched:
        lines = hatched_area(points, sizes.PLATE_SPACING * size)
        marks += _pieces("HATCHING", lines, 0.6 * PX, above, size)
    return marks


def _pieces(
    layer: str, segments: Float, weight: float, above: list[tuple[Part, Float]], size: float
) -> list[Mark]:
    return [Outline(layer, piece, weight=weight) for piece in _visible(segments, above, size)]


def _visible(segments: Float, above: list[tuple[Part, Float]], size: float) -> Float:
    """Return segments without what lies under joints, blocks and pivots drawn later."""
    if not len(segments):
        return segments
    low, high = segments.min(axis=(0, 1)), segments.max(axis=(0, 1))
    for part, points in above:
        reach = part.radius * size if isinstance(part, Disc) else 0.0
        if (points.min(axis=0) - reach > high).any() or (points.max(axis=0) + reach < low).any():
            continue
        if isinstance(part, Disc):
            segments = outside_circle(segments, points[0], part.radius * size)
        elif isinstance(part, Stroke) and part.closed and part.fill == "canvas":
            segments = outside_polygon(segments, points)
    return segments


def outlines(subject: Subject, shop: Workshop) -> list[Mark]:
    """Return the outlines of all links where they are, with the ground's under the others."""
    marks: list[Mark] = []
    for link, (x, y, angle) in zip(subject.scene.links, subject.frames[0].tolist(), strict=True):
        part = part_marks(shop, link)
        shift = MM * np.array([x, y])
        if link == "ground":
            shift = shift + MM * next(iter(shop.frames.local[link].values()), np.zeros(2))
        marks += [moved(mark, shift, angle) for mark in part]
    return marks


def dimensioned(subject: Subject, marks: list[Mark], per: float) -> list[Mark]:
    """Return each link's length beside it, and outside x and y of the ground's joints."""
    at = {joint: MM * path[0] for joint, path in subject.at.joints().items()}
    joints = np.array(list(at.values()))
    middle = joints.mean(axis=0)
    lines = [mark.points for mark in marks if isinstance(mark, Outline)]
    distances: list[Mark] = []
    for link, joints_on in subject.at.local.items():
        if link == "ground" or len(joints_on) < 2:
            continue
        start, end = (at[joint] for joint in list(joints_on)[:2])
        distances.append(_beside(start, end, middle, [*lines, *dimension_lines(distances)], per))
    low, _ = bounds([*marks, *distances], per)
    ground = [at[joint] for joint in subject.at.local.get("ground", {})]
    size = float(np.ptp(joints, axis=0).max())
    for axis, angle in ((0, 0.0), (1, np.pi / 2.0)):
        far = [
            joint_at
            for joint_at in ground[1:]
            if abs(joint_at[axis] - ground[0][axis]) > NEAR * size
        ]
        far.sort(key=lambda joint_at: abs(float(joint_at[axis] - ground[0][axis])))
        for i, end_at in enumerate(far):
            base = low - (FIRST / 2.0 + NEXT * i) * per
            distances.append(Distance("DIMENSIONS", ground[0], end_at, base, angle))
    return distances


def _beside(start: Float, end: Float, middle: Float, lines: list[Float], per: float) -> Distance:
    """Return the length of a link on the side where its line is clearest of others."""
    direction = end - start
    angle = float(np.arctan2(direction[1], direction[0]))
    left = left_of(angle)
    if (middle - start) @ left > 0.0:
        # Outside first.
        left = -left
    step = STEP * per
    obstacles = along(lines, step)
    obstacles = obstacles[:: max(1, len(obstacles) // MOST)]
    best, most = None, -np.inf
    for i, reach in enumerate(BESIDE):
        distance = Distance("DIMENSIONS", start, end, start + reach * per * left, angle)
        line = along([np.stack(distance.feet())], step)
        inner = line[len(line) // 5 : len(line) - len(line) // 5] if len(line) > 5 else line
        gaps = np.hypot(*np.moveaxis(inner[:, None] - obstacles[None], -1, 0))
        room = min(float(gaps.min(initial=np.inf)) / per, 6.0) - 0.3 * i
        if room > most:
            best, most = distance, room
    assert best is not None
    return best
