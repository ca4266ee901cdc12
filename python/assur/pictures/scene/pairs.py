"""Turning pairs, fixed pivots, and the arrows of drivers."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur.pictures import sizes
from assur.pictures.scene.geometry import about, arc, at, unit_vector
from assur.pictures.scene.shapes import Disc, Hatching, Part, Stroke

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.pictures.scene.axis import Axis

# From the driven link to the arrow's tail and to its head, rad.
ARROW_TAIL, ARROW_TIP = 0.44, 1.5


def pivot_parts(joint: str, point: Float) -> list[Part]:
    """Draw a fixed pivot: a triangle on hatched ground; the joint's circle comes on top."""
    name = f"pivot {joint}"
    half, base, height = sizes.PIVOT_WIDTH / 2.0, sizes.PIVOT_BASE / 2.0, -sizes.PIVOT_HEIGHT
    triangle = (at(point), at(point, -half, height), at(point, half, height))
    left, right = at(point, -base, height), at(point, base, height)
    return [
        Stroke("ground", name, triangle, sizes.GUIDE, "ink", closed=True, fill="canvas"),
        Stroke("ground", name, (left, right), sizes.GUIDE, "ink"),
        Hatching("ground", name, left, right, sizes.GROUND_SPACING),
    ]


def joint_part(joint: str, link: str, point: Float, links: int, fixed: bool) -> Part:
    """Draw a turning pair as a circle; a point of one link is a dot."""
    name = f"joint {joint}"
    if links < 2:
        return Disc(link, name, at(point), 0.64 * sizes.JOINT, 0.0, fill="solid")
    return Disc(link, name, at(point), sizes.PIVOT if fixed else sizes.JOINT, sizes.OUTLINE)


def turning_arrow(link: str, about_point: Float, toward: float) -> list[Part]:
    """Draw the sense of +q about a pivot; `toward` is the link's direction in its frame, rad."""
    radius = sizes.ARROW_RADIUS
    # The arc ends within the head.
    inside = ARROW_TIP - 0.8 * sizes.ARROW_HEAD / radius
    shaft = arc(radius, ARROW_TAIL, inside)
    tip = unit_vector(ARROW_TIP) * radius
    chord = tip - unit_vector(inside) * radius
    head = _head(tip, float(np.arctan2(chord[1], chord[0])))
    return _arrow(link, about_point, toward, shaft, head)


def sliding_arrow(axis: Axis) -> list[Part]:
    """Draw the sense of +q beside a driven slide."""
    half, side = sizes.DRIVE_LENGTH / 2.0, sizes.DRIVE_DISTANCE + sizes.BLOCK_WIDTH / 2.0
    shaft = [(-half, side), (half - 0.8 * sizes.ARROW_HEAD, side)]
    head = _head(np.array([half, side]), 0.0)
    return _arrow(axis.sliding, axis.block, axis.angles[0], shaft, head)


def _arrow(
    link: str,
    point: Float,
    angle: float,
    shaft: list[tuple[float, float]],
    head: list[tuple[float, float]],
) -> list[Part]:
    return [
        Stroke(link, "driver", about(point, angle, shaft), sizes.ARROW, "driver"),
        Stroke(link, "driver", about(point, angle, head), 0.0, "driver", closed=True, fill="solid"),
    ]


def _head(tip: Float, angle: float) -> list[tuple[float, float]]:
    """Return a filled arrow head in px."""
    back, half = sizes.ARROW_HEAD, sizes.ARROW_HEAD_WIDTH / 2.0
    along = unit_vector(angle)
    left = np.array([-along[1], along[0]])
    points = (tip, tip - back * along + half * left, tip - back * along - half * left)
    return [(float(x), float(y)) for x, y in points]
