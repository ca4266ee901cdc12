"""Plane geometry of symbols."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur.pictures.scene.shapes import Vertex

if TYPE_CHECKING:
    from collections.abc import Iterable

    from assur._arrays import Float

# Points nearer to a line than this fraction of the link's size lie on it.
ON_LINE = 1e-6


def hull(points: Float) -> list[int]:
    """Return indices of the corners of the convex hull, turning left (Andrew's monotone chain)."""
    order = np.lexsort((points[:, 1], points[:, 0])).tolist()
    near = ON_LINE * float(np.ptp(points, axis=0).max()) ** 2

    def half(indices: Iterable[int]) -> list[int]:
        chain: list[int] = []
        for i in indices:
            while len(chain) > 1 and _turn(points, chain[-2], chain[-1], i) <= near:
                chain.pop()
            chain.append(i)
        return chain

    lower, upper = half(order), half(reversed(order))
    return lower[:-1] + upper[:-1]


def _turn(points: Float, a: int, b: int, c: int) -> float:
    """Return twice the area of a triangle, positive if it turns left."""
    (ax, ay), (bx, by), (cx, cy) = points[a], points[b], points[c]
    return float((bx - ax) * (cy - ay) - (by - ay) * (cx - ax))


def at(point: Float | tuple[float, float], dx: float = 0.0, dy: float = 0.0) -> Vertex:
    """Return a vertex at a point of the link, moved by px."""
    return Vertex(float(point[0]), float(point[1]), float(dx), float(dy))


def about(
    point: Float | tuple[float, float], angle: float, shape: Iterable[tuple[float, float]]
) -> tuple[Vertex, ...]:
    """Return a shape given in px about a point, turned by an angle."""
    cosine, sine = float(np.cos(angle)), float(np.sin(angle))
    return tuple(at(point, cosine * x - sine * y, sine * x + cosine * y) for x, y in shape)


def arc(radius: float, start: float, end: float, points: int = 17) -> list[tuple[float, float]]:
    """Return points of an arc in px, angles in rad."""
    angles = np.linspace(start, end, points)
    return [(radius * float(np.cos(a)), radius * float(np.sin(a))) for a in angles]


def unit_vector(angle: float) -> Float:
    """Return the unit vector at an angle."""
    return np.array([np.cos(angle), np.sin(angle)])


def left_of(angle: float) -> Float:
    """Return the unit vector to the left of a direction."""
    return np.array([-np.sin(angle), np.cos(angle)])
