"""Metrics that compare a motion with a target: a path, a function or poses."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from assur import _core
from assur._arrays import counted, flag, real_array, real_number, require_finite, short
from assur._by_value import ByValue
from assur._validate import checked_name, one_of
from assur.errors import InputError
from assur.kinematics.table import driven_angles
from assur.sweeps.terms import Leaf

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur.kinematics.mechanism import Mechanism
    from assur.sweeps.terms import Float, Metric

__all__ = ["TARGETS", "function_error", "path_error", "placed", "pose_error"]

TARGETS = ("path_error", "function_error", "pose_error")
# Coordinates with ten digits are those of q.
SAME = 1e-9


@dataclass(frozen=True, repr=False, eq=False)
class Numbers(ByValue):
    """The array of a target."""

    array: Float

    def __repr__(self) -> str:
        return short(self.array.tolist())


def path_error(
    of: str,
    points: npt.ArrayLike,
    *,
    kind: Literal["points", "chamfer", "ordered"] = "points",
    closed: bool | None = None,
) -> Metric:
    """How far a joint's path is from a target path, as it is placed, over the target's size.

    The path is the polyline C through the positions in the order of q. It is closed where q goes
    once round in even steps, without its end, and the joint is then where it was. R is the root
    mean square distance of the target from its centroid.

    ``"points"``: √(Σ d(Tᵢ, C)² / N) / R, with d(Tᵢ, C) the least distance of target point Tᵢ
    from C.

    ``"chamfer"``: (mean of d(t, C) for t along T + mean of d(c, T) for c along C) / R, with T the
    polyline through the target points: the Chamfer distance. Means are by length: of T over the
    middles of 256 equal parts, of C over its corners, each for half of both segments there.

    ``"ordered"``: ``√(mean of |T(s) − C(s)|²) / R`` at the middles of 256 equal parts s of both
    lengths, in the better direction; of a closed target from its best start. For an open target
    the path goes from the first position to the last. 2π times its square is the ordered distance
    (OD) by which learned methods are compared.

    Parameters
    ----------
    of : str
        A joint.
    points : array_like
        Target points, (N, 2), m, in the drawing's frame; at least two of them different.
    kind : {"points", "chamfer", "ordered"}
        How distances are measured. Only "ordered" sees how often and in which order the path
        passes the target.
    closed : bool, optional
        Whether the target's polyline goes back from its last point to the first; by default if
        these are the same point. Not for "points", which no line joins.

    Returns
    -------
    Metric
        Without a unit; 0 for a perfect path. It has a gradient, but of 0 (NaN, as of an ``rms``;
        of "chamfer" a single distance of 0 adds none).

    Raises
    ------
    InputError
        Here for wrong arguments; by `assur.sweep` for a joint that is unknown.

    Examples
    --------
    The crank pin's circle against one of twice its radius:

    >>> import assur, numpy as np
    >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    >>> circle = 2.0 * np.column_stack([np.cos(q), np.sin(q)])
    >>> asked = {"a": assur.metric.path_error("A", circle, kind="chamfer", closed=True)}
    >>> engine, cranks = assur.SliderCrank(1.0, 3.0), {"crank.length": [1.0, 1.5, 2.0]}
    >>> assur.sweep(engine, cranks, q, metrics=asked)["a"].round(3).tolist()
    [1.0, 0.5, 0.0]
    """
    name = checked_name(of, "path_error")
    array = _rows(points, "path_error: points", "x and y of each, m", 2)
    one_of(kind, ("points", "chamfer", "ordered"), "kind")
    if closed is not None:
        closed = flag(closed, "closed")
        if kind == "points":
            message = f"closed={closed} is for kind='chamfer' or 'ordered': no line joins points"
            raise InputError(message)
    _refuse("path_error: points", _core.refusal_of_path(array, kind, closed))
    return Leaf("path_error", name, options=(Numbers(array), kind, closed))


def function_error(
    of: str,
    theta: npt.ArrayLike,
    value: npt.ArrayLike,
    *,
    offset: Literal["fixed", "free"] = "fixed",
    scale: Literal["fixed", "free"] = "fixed",
) -> Metric:
    """How far a coordinate is from a function of the driver's coordinate: an error of rms.

    √(Σ (x(θᵢ) − vᵢ)² / N). With ``offset="free"`` x − v is compared with its mean: only the shape
    of the function counts. With ``scale="free"``, too, it is √(Σ (a x(θᵢ) + b − vᵢ)² / N) with the
    best a and b.

    Parameters
    ----------
    of : str
        The coordinate, for instance ``"B.x"``, ``"rocker"``, ``"bore"``.
    theta : array_like
        Coordinates of the driver, (N,), rad (modulo a turn) or m. Each is one of q, to ten digits:
        nothing is interpolated. Pass ``q=theta``, or a q that includes it.
    value : array_like
        What the coordinate is to be there, (N,), rad or m. Angles count modulo whole turns: from
        one theta to the next x − v changes by less than half a turn (with a free scale x).
    offset : {"fixed", "free"}
        Free: one constant may be added to all values.
    scale : {"fixed", "free"}
        Free: the coordinate may be multiplied by a constant; needs ``offset="free"``.

    Returns
    -------
    Metric
        rad or m, as the coordinate; with a free scale in the unit of `value`. It has a gradient,
        but of 0 (NaN, as of an ``rms``).

    Raises
    ------
    InputError
        Here for wrong arguments; by `assur.sweep` for a name that is unknown, several drivers, or
        a theta that is not one of q.

    Examples
    --------
    >>> import assur, numpy as np
    >>> theta = np.radians([0, 60, 120, 180])
    >>> engine, cranks = assur.SliderCrank(1.0, 3.0), {"crank.length": [1.0, 1.1]}
    >>> stroke = 3.0 + np.cos(theta)
    >>> asked = {
    ...     "a": assur.metric.function_error("bore", theta, stroke),
    ...     "b": assur.metric.function_error("A.x", theta, stroke, offset="free", scale="free"),
    ... }
    >>> found = assur.sweep(engine, cranks, theta, metrics=asked)
    >>> found["a"].round(4), found["b"].round(12)
    (array([0.0903, 0.1353]), array([0., 0.]))
    """
    name = checked_name(of, "function_error")
    one_of(offset, ("fixed", "free"), "offset")
    one_of(scale, ("fixed", "free"), "scale")
    if scale == "free" and offset == "fixed":
        message = "scale='free' needs offset='free'"
        raise InputError(message)
    thetas, values = (
        _finite_row(numbers, f"function_error: {what}")
        for what, numbers in (("theta", theta), ("value", value))
    )
    if len(thetas) != len(values):
        message = f"function_error: theta has {len(thetas)} entries, value {len(values)}"
        raise InputError(message)
    least = 1 + (offset == "free") + (scale == "free")
    if len(thetas) < least:
        free = "" if least == 1 else ": with what is free fewer fit any motion"
        message = (
            f"function_error: theta has {counted(len(thetas), 'number')}, at least {least} are "
            f"needed{free}"
        )
        raise InputError(message)
    return Leaf("function_error", name, options=(Numbers(thetas), Numbers(values), offset, scale))


def pose_error(link: str, poses: npt.ArrayLike, *, length: float | None = None) -> Metric:
    """How far a link passes from poses that it is to take.

    √(Σ Dᵢ² / N) with Dᵢ the least ``√(|Δp|² / ℓ² + Δφ²)`` along the motion: Δp from pose i to the
    origin of the link's frame, Δφ to its angle (within half a turn). Between positions both change
    in proportion; from the last position to the first where q goes once round in even steps,
    without its end, and the link is then where it was.

    Parameters
    ----------
    link : str
        A link.
    poses : array_like
        (N, 3): x and y, m, of the origin of the link's frame (its first joint), and its angle, rad
        (that of the line from its first joint to its second).
    length : float, optional
        ℓ, m: the distance that counts as much as 1 rad. By default the root mean square distance
        of the poses' positions from their centroid.

    Returns
    -------
    Metric
        Without a unit: 0.01 is 1 % of ℓ, or 0.01 rad. It has a gradient, but of 0 (NaN, as of an
        ``rms``).

    Raises
    ------
    InputError
        Here for wrong arguments; by `assur.sweep` for a link that is unknown.

    Examples
    --------
    The poses of a coupler, and the same 0.1 m higher:

    >>> import assur, numpy as np
    >>> four_bar, q = assur.FourBar(1.0, 3.0, 2.5, 3.0), np.linspace(0, 2 * np.pi, 72)
    >>> motion = four_bar.solve(q[:36:6], outputs=["B", "coupler"])
    >>> poses = np.column_stack([motion.joint("B").value, motion.link("coupler").value])
    >>> asked = {
    ...     "a": assur.metric.pose_error("coupler", poses),
    ...     "b": assur.metric.pose_error("coupler", poses + [0.0, 0.1, 0.0], length=1.0),
    ... }
    >>> found = assur.sweep(four_bar, {}, q, metrics=asked)
    >>> round(float(found["a"]), 9), bool(0.01 < found["b"] <= 0.1)
    (0.0, True)
    """
    name = checked_name(link, "pose_error")
    meaning = "x, y and the angle of each, m and rad"
    array = _rows(poses, "pose_error: poses", meaning, 3)
    size = None if length is None else real_number(length, "length")
    _refuse("pose_error: poses", _core.refusal_of_poses(array, size))
    return Leaf("pose_error", name, options=(Numbers(array), size))


def _rows(value: Any, what: str, meaning: str, width: int) -> Float:
    array = real_array(value, what)
    if array.shape == (0,):
        array = array.reshape(0, width)
    if array.ndim != 2 or array.shape[1] != width:
        message = f"{what} has shape {array.shape}: (N, {width}) is needed, {meaning}"
        raise InputError(message)
    return array


def _finite_row(value: Any, what: str) -> Float:
    array = real_array(value, what)
    if array.ndim != 1:
        message = f"{what} has shape {array.shape}: (N,) is needed"
        raise InputError(message)
    require_finite(array, what)
    return array


def _refuse(what: str, refusal: str | None) -> None:
    if refusal is not None:
        message = f"{what}: {refusal}"
        raise InputError(message)


def placed(leaf: Leaf, mechanism: Mechanism, q: Float) -> Leaf:
    """Return a function's error with the indices of its positions in place of its coordinates.

    Raises InputError for one that is not among q.
    """
    theta, value, offset, scale = leaf.options
    assert isinstance(theta, Numbers)
    assert isinstance(value, Numbers)
    if mechanism.driver_count > 1:
        message = f"{leaf!r}: it is for one driver; this mechanism has {mechanism.driver_count}"
        raise InputError(message)
    period = 2.0 * np.pi if driven_angles(mechanism)[0] else None
    size = max(np.abs(q).max(), np.abs(theta.array).max(), period or 0.0)
    places, off = _nearest(q, theta.array)
    if period is not None and (off > SAME * size).any():
        turned, off_turned = _nearest(q % period, theta.array % period, period)
        places = np.where(off > SAME * size, turned, places)
        off = np.minimum(off, off_turned)
    missing = np.flatnonzero(off > SAME * size)
    if missing.size:
        at = missing[0]
        message = (
            f"function_error({leaf.of!r}): theta[{at}] = {theta.array[at]:.10g} is not one of the "
            "positions of q: pass q=theta, or add it to q"
        )
        raise InputError(message)
    # In this order angles are continuous.
    order = np.argsort(theta.array, kind="stable")
    fitted = "scale and offset" if scale == "free" else "offset" if offset == "free" else "nothing"
    options = tuple(places[order].tolist()), Numbers(value.array[order]), fitted
    return replace(leaf, options=options)


def _nearest(
    q: Float, theta: Float, period: float | None = None
) -> tuple[npt.NDArray[np.intp], Float]:
    """Return for each theta the index of the nearest of q, modulo a period, and how far it is."""
    order = np.argsort(q, kind="stable")
    after = np.searchsorted(q[order], theta)
    both = np.stack([order[after % len(q)], order[after - 1]])
    off = np.abs(q[both] - theta)
    if period is not None:
        off = np.minimum(off, period - off)
    nearer = np.argmin(off, axis=0)[np.newaxis]
    return (
        np.take_along_axis(both, nearer, axis=0)[0],
        np.take_along_axis(off, nearer, axis=0)[0],
    )
