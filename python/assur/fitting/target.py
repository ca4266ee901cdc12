"""A path to draw: a polyline through the user's points, and its own size."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import counted, flag, real_array, short
from assur.errors import AssurWarning, InputError

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur._arrays import Float

# More corners slow every evaluation down and say no more about a path.
MOST_POINTS = 2000
# Sizes with which the solver works, m.
LEAST_SIZE, MOST_SIZE = 1e-140, 1e140
# A path of so many points whose ends are as near as so many of its steps may be meant to be closed.
MANY_POINTS, NEAR = 12, 1.5


@dataclass(frozen=True, slots=True, eq=False)
class PathTarget:
    """A path that a joint is to draw.

    Attributes
    ----------
    joint : str
        Name of the traced joint.
    points : ndarray
        As the user gave them, (N, 2), m.
    corners : ndarray
        The same without repetitions, from `centre` and over `radius`, (K, 2); a closed path ends
        where it begins.
    closed : bool
        Whether the path leads back to its first point.
    centre : ndarray
        Centroid of the line, (2,), m.
    radius : float
        Root mean square distance of the line from it, m.
    unit : float
        A power of two near the path's size, m: what the search takes as its unit of length.
    """

    joint: str
    points: Float
    corners: Float
    closed: bool
    centre: Float
    radius: float
    unit: float

    @property
    def reach(self) -> float:
        """The greatest distance of the path from its centroid, in its radii."""
        return float(np.sqrt((self.corners**2).sum(axis=1).max()))

    def framed(self, places: npt.ArrayLike) -> Float:
        """Return places from the centroid and over the radius."""
        framed: Float = (np.asarray(places) - self.centre) / self.radius
        return framed


def checked_target(joint: str, points: Any, closed: Any) -> PathTarget:
    """Return the path through points; errors say what is wrong with which of them."""
    what = f"targets[{joint!r}]"
    listed = real_array(points, what)
    if listed.ndim != 2 or listed.shape[1] != 2:
        message = f"{what} has the shape {listed.shape}: points (N, 2) are needed, x and y in m"
        raise InputError(message, joint=joint)
    if not 2 <= len(listed) <= MOST_POINTS:
        has = counted(len(listed), "point")
        message = f"{what} has {has}: from 2 to {MOST_POINTS} are needed"
        if len(listed) > MOST_POINTS:
            message += f"; points[::{-(-len(listed) // MOST_POINTS)}] will do"
        raise InputError(message, joint=joint, value=float(len(listed)))
    if not (is_finite := np.isfinite(listed).all(axis=1)).all():
        wrong = int(is_finite.argmin())
        message = (
            f"{what}, point {wrong} of {len(listed)} is {short(tuple(listed[wrong].tolist()))}: "
            "finite numbers are needed; leave it out"
        )
        raise InputError(message, joint=joint)
    unit = _unit(listed, what, joint)
    is_closed = _leads_back(listed / unit, unit, what) if closed is None else flag(closed, "closed")
    centre, radius = _size(_line(listed / unit, is_closed))
    corners = _line((listed / unit - centre) / radius, is_closed)
    centre, radius = centre * unit, radius * unit
    for array in (listed, corners, centre):
        array.flags.writeable = False
    return PathTarget(joint, listed, corners, is_closed, centre, radius, unit)


def _unit(points: Float, what: str, joint: str) -> float:
    """Return a power of two near the size of a path."""
    with np.errstate(over="ignore"):
        size = float(np.ptp(points, axis=0).max())
    if size == 0.0:
        first = short(tuple(points[0].tolist()))
        message = f"{what}: all {len(points)} points are {first}: a path goes from place to place"
        raise InputError(message, joint=joint)
    if not LEAST_SIZE < size < MOST_SIZE:
        message = (
            f"{what}: the path is {size:g} m long or high; from {LEAST_SIZE:g} to {MOST_SIZE:g} m "
            "is needed"
        )
        raise InputError(message, joint=joint, value=size)
    return float(np.ldexp(1.0, np.frexp(size)[1]))


def _leads_back(points: Float, unit: float, what: str) -> bool:
    """Whether the last point is the first; a warning where it nearly is."""
    if (points[0] == points[-1]).all():
        return True
    steps = np.sqrt((np.diff(points, axis=0) ** 2).sum(axis=1))
    gap = float(np.sqrt(((points[0] - points[-1]) ** 2).sum()))
    if len(points) >= MANY_POINTS and gap <= NEAR * float(np.median(steps)):
        message = (
            f"{what} ends {unit * gap:.3g} m from its first point, as near as its points are to "
            "each other: closed=True closes it, closed=False leaves it open without this warning"
        )
        warnings.warn(message, AssurWarning, stacklevel=4)
    return False


def _line(points: Float, is_closed: bool) -> Float:
    """Return the corners without repetitions one after another; a closed path with its way back."""
    line = np.concatenate([points, points[:1]]) if is_closed else points
    is_new = np.concatenate([[True], (np.diff(line, axis=0) != 0.0).any(axis=1)])
    kept: Float = line[is_new]
    return kept


def _size(line: Float) -> tuple[Float, float]:
    """Return the centroid and the root mean square radius of a line, not of its corners."""
    start, along = line[:-1], np.diff(line, axis=0)
    lengths = np.sqrt((along**2).sum(axis=1))
    middles = start + 0.5 * along - line[0]
    mean = (lengths[:, np.newaxis] * middles).sum(axis=0) / lengths.sum()
    # The mean square over a segment: that of its middle, and a twelfth of its length's.
    squares = ((middles - mean) ** 2).sum(axis=1) + lengths**2 / 12.0
    return line[0] + mean, float(np.sqrt((lengths * squares).sum() / lengths.sum()))
