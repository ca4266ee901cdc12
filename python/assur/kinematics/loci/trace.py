"""Tracing a singular locus over a surface of positions, by arc length.

The locus is where the determinant of the drivers' derivatives by a chart's coordinates is zero. A
step goes along its tangent; Newton's iteration along the gradient comes back to it (E. L. Allgower
and K. Georg, Numerical Continuation Methods, Springer 1990, chapters 2 and 3). The chart is
changed where two other coordinates lead better.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING

import numpy as np

from assur.errors import AssurError
from assur.kinematics.loci.chart import Chart, best_pair, chart_at, dot, length_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from assur._arrays import Float
    from assur.kinematics.loci.chart import Point, Surface
    from assur.kinematics.pose import Pose

# Steps (rad, or sizes, of all coordinates together).
FIRST_STEP = 0.02
LEAST_STEP = 1e-5
GREATEST_STEP = 0.1
# Cosine of the greatest turn of the tangent in a step; a step that turns less than a third of it is
# lengthened.
GREATEST_TURN = 0.99
SMALL_TURN = 0.999
# Tolerance of Newton's iteration along the gradient, and its greatest number of steps.
ARRIVED = 1e-11
MOST_ITERATIONS = 6
# How many times better another pair of coordinates leads before the chart is changed.
MUCH_BETTER = 2.0
# Positions of one locus.
MOST_POINTS = 20_000


@dataclass(frozen=True, slots=True)
class Traced:
    """A locus as it was traced.

    Attributes
    ----------
    poses : list of Pose
        Positions along it.
    coordinates : ndarray
        Their coordinates (see `Surface`), shape (N, number of coordinates).
    is_closed : bool
        Whether the last leads to the first.
    is_complete : bool
        Whether it is closed, or both ends are outside.
    """

    poses: list[Pose]
    coordinates: Float
    is_closed: bool
    is_complete: bool


def start_beside(surface: Surface, pose: Pose) -> Point | None:
    """Return the position of the locus near a pose beside it."""
    # On the locus itself the drivers do not lead: two other coordinates may.
    pairs = itertools.chain([None], itertools.combinations(range(len(surface.names)), 2))
    for pair in pairs:
        try:
            drivers = Chart(surface, pose, pair)
        except AssurError:
            continue
        beside = drivers.at(drivers.start)
        chart = chart_at(surface, beside) if beside is not None else None
        if chart is not None:
            return onto_locus(chart, chart.start)
    return None


def onto_locus(chart: Chart, where: Float) -> Point | None:
    """Return the position of the locus near two coordinates of a chart."""
    for _ in range(MOST_ITERATIONS):
        point = chart.at(where)
        if point is None:
            return None
        length2 = dot(point.gradient, point.gradient)
        if length2 == 0.0:
            return None
        step = -point.determinant / length2 * point.gradient
        if np.abs(step).max() <= ARRIVED:
            return point
        where = where + step
    return None


def trace(surface: Surface, start: Point, is_inside: Callable[[Pose], bool]) -> Traced:
    """Return the locus through a position of it, both ways to its ends."""
    poses, coordinates, end = _one_way(surface, start, 1.0, is_inside)
    if end == End.CLOSED:
        return Traced(poses, np.array(coordinates), is_closed=True, is_complete=True)
    behind, theirs, other_end = _one_way(surface, start, -1.0, is_inside)
    coordinates = [*theirs[:0:-1], *coordinates]
    is_complete = end == other_end == End.OUTSIDE
    return Traced([*behind[:0:-1], *poses], np.array(coordinates), False, is_complete)


class End(Enum):
    """Why a trace ended."""

    CLOSED = 0
    OUTSIDE = 1
    LOST = 2


def _one_way(
    surface: Surface, start: Point, way: float, is_inside: Callable[[Pose], bool]
) -> tuple[list[Pose], list[Float], End]:
    poses, coordinates = [start.pose], [surface.coordinates(start.pose)]
    chart, point = _newly_drawn(surface, start)
    if chart is None or point is None:
        return poses, coordinates, End.LOST
    tangent = _tangent(point, None) * way
    first, step = tangent, FIRST_STEP
    while len(poses) < MOST_POINTS:
        stepped = _step(surface, chart, point, tangent, step)
        if stepped is None:
            # The chart may end here; a shorter step may do.
            chart, again = _newly_drawn(surface, point)
            step *= 0.5
            if chart is None or again is None or step < LEAST_STEP:
                return poses, coordinates, End.LOST
            point = again
            continue
        point, turned, cosine = stepped
        here = surface.coordinates(point.pose)
        # How far ahead the start is, and how far beside.
        back = surface.difference(coordinates[0], here)
        last = surface.difference(coordinates[0], coordinates[-1])
        if len(poses) > 2 and _is_between(last, back, first, turned):
            return poses, coordinates, End.CLOSED
        poses.append(point.pose)
        coordinates.append(here)
        if not is_inside(point.pose):
            return poses, coordinates, End.OUTSIDE
        tangent = turned
        if cosine > SMALL_TURN:
            step = min(1.5 * step, GREATEST_STEP)
        if best_pair(point)[1] > MUCH_BETTER or np.abs(point.at - chart.start).max() > 0.25:
            better, again = _newly_drawn(surface, point)
            if better is not None and again is not None:
                chart, point = better, again
    return poses, coordinates, End.LOST


def _newly_drawn(surface: Surface, point: Point) -> tuple[Chart | None, Point | None]:
    chart = chart_at(surface, point)
    return chart, chart.at(chart.start) if chart is not None else None


def _tangent(point: Point, before: Float | None) -> Float:
    """Return the unit vector along the locus, in all coordinates, on the side of `before`."""
    across = point.gradient
    direction = point.rates @ np.array([-across[1], across[0]])
    length = length_of(direction)
    unit: Float = direction / length if length > 0.0 else direction
    return -unit if before is not None and dot(unit, before) < 0.0 else unit


def _step(
    surface: Surface, chart: Chart, point: Point, tangent: Float, step: float
) -> tuple[Point, Float, float] | None:
    """Step along the locus; return the position, its tangent, and the cosine of the turn."""
    along = np.array([-point.gradient[1], point.gradient[0]])
    direction = point.rates @ along
    ahead = step / dot(direction, tangent) * along
    reached = onto_locus(chart, point.at + ahead)
    if reached is None:
        return None
    turned = _tangent(reached, tangent)
    cosine = dot(turned, tangent)
    moved = surface.difference(surface.coordinates(reached.pose), surface.coordinates(point.pose))
    ahead_by = dot(moved, tangent)
    beside = length_of(moved - ahead_by * tangent)
    if cosine < GREATEST_TURN or beside > 0.15 * step or ahead_by < 0.5 * step:
        return None
    return reached, turned, cosine


def _is_between(last: Float, now: Float, first: Float, tangent: Float) -> bool:
    """Whether the start was passed: it was ahead and is behind, near, and passed the same way."""
    behind = dot(now, tangent)
    beside = length_of(now - behind * tangent)
    was_passed = dot(last, tangent) > 0.0 and behind <= 0.0
    is_near = beside <= 0.15 * length_of(last - now)
    return was_passed and is_near and dot(first, tangent) > 0.9
