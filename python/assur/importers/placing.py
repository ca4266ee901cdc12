"""Points from distances, nearest to a place that is only sketched."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from assur._trig import arctan2, sin_cos

if TYPE_CHECKING:
    from assur.importers.sketch import Point

# Part of a length by which links that just reach each other may miss.
TOUCH = 1e-12


def polar(origin: Point, toward: Point, distance: float, angle: float) -> Point:
    """Return the point at a distance from an origin, at an angle from the direction to another."""
    (x, y), (u, v) = origin, toward
    sine, cosine = sin_cos(float(arctan2(v - y, u - x)) + math.remainder(angle, math.tau))
    return x + distance * float(cosine), y + distance * float(sine)


def on_circle(centre: Point, radius: float, hint: Point) -> Point:
    """Return the point of a circle in the direction of a place; on the x-axis for the centre."""
    if hint == centre:
        return centre[0] + radius, centre[1]
    return polar(centre, hint, radius, 0.0)


def on_two_circles(
    first: Point, second: Point, radii: tuple[float, float], hint: Point
) -> Point | float:
    """Return the crossing of two circles that is nearest to a place, or by how much they miss."""
    r, s = radii
    u, v = second[0] - first[0], second[1] - first[1]
    d = math.sqrt(u * u + v * v)
    miss = max(d - (r + s), abs(r - s) - d)
    if d == 0.0 or miss > TOUCH * max(r, s):
        return max(miss, 0.0)
    along = ((r - s) * (r + s) + d * d) / (2.0 * d)
    across = math.sqrt(max((r - along) * (r + along), 0.0))
    return _nearest(first, (u / d, v / d), along, across, hint)


def on_line(centre: Point, radius: float, line: tuple[Point, Point], hint: Point) -> Point | float:
    """Return the crossing of a circle and a line nearest to a place, or by how much they miss."""
    (x, y), (u, v) = line
    d = math.sqrt((u - x) ** 2 + (v - y) ** 2)
    ex, ey = (u - x) / d, (v - y) / d
    # The line is to the left of the centre at this distance.
    off = (x - centre[0]) * -ey + (y - centre[1]) * ex
    if abs(off) > radius * (1.0 + TOUCH):
        return abs(off) - radius
    along = math.sqrt(max((radius - off) * (radius + off), 0.0))
    return _nearest(centre, (-ey, ex), off, along, hint)


def _nearest(origin: Point, axis: Point, along: float, across: float, hint: Point) -> Point:
    """Return the nearer of two points that mirror each other in an axis."""
    (x, y), (ex, ey) = origin, axis
    foot = x + along * ex, y + along * ey
    left = (hint[0] - x) * -ey + (hint[1] - y) * ex >= 0.0
    side = across if left else -across
    return foot[0] - side * ey, foot[1] + side * ex
