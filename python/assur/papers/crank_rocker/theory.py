"""Positions, rates and zones of the crank-rocker of the paper."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from assur import _core
from assur._arrays import Float, as_number, finite_array, flag, real_array, real_number
from assur._summary import summary
from assur._validate import one_of
from assur.errors import DimensionError, InputError
from assur.kinematics.grashof import CHANGE_TOLERANCE, types_of

if TYPE_CHECKING:
    from assur._arrays import Number
    from assur.papers.crank_rocker.jamming import Side

__all__ = [
    "Solution",
    "Table1",
    "blocked",
    "crank_turns",
    "grashof",
    "ground_range",
    "least_transmission_angle",
    "solve",
    "table1",
    "transmission_extremes",
]

LENGTHS = ("l1", "l2", "l3", "l4")
# The value of π in the paper, and the lengths of its Table 1.
PRINTED_PI = 3.14
TABLE = (1.0, 4.5, 1.5)
TABLE_GROUNDS = (4.8, 4.85, 4.9, 4.95, 4.995)


@dataclass(frozen=True, eq=False, repr=False)
class Solution:
    """Positions and rates of section 1; made by `solve`.

    Attributes
    ----------
    S : numpy.ndarray
        Distance BD, m.
    phi3_first, phi3_second : numpy.ndarray
        Angle φ₃′ of DB, and φ₃″ from DB to the rocker, rad.
    beta, phi2, phi3, gamma23, gamma : numpy.ndarray
        Angle DBC, angles of coupler and rocker, angle DCB and the transmission angle (the acute
        one of γ₂₃ and π − γ₂₃), rad.
    dS, dphi3_first, dphi3_second, dbeta, dphi2, dphi3, dgamma23, dgamma : numpy.ndarray
        Their time derivatives.
    v_B, v_C, v_C_relative : numpy.ndarray
        Speeds of the crank's pin, of C, and of C relative to D (the paper's v_C), m/s.
    pushes : numpy.ndarray of bool
        Whether the coupler pushes the rocker (figure 4a), its angle growing, or pulls it (4b).

    Examples
    --------
    >>> import assur
    >>> found = assur.crank_rocker.solve(2.1, 1, 4.5, 1.5, 4.9)
    >>> found.S.round(6), found.gamma.round(6)  # m, rad
    (np.float64(4.479119), np.float64(1.389246))
    """

    S: Float  # the paper's letters
    phi3_first: Float
    phi3_second: Float
    beta: Float
    phi2: Float
    phi3: Float
    gamma23: Float
    gamma: Float
    dS: Float  # noqa: N815
    dphi3_first: Float
    dphi3_second: Float
    dbeta: Float
    dphi2: Float
    dphi3: Float
    dgamma23: Float
    dgamma: Float
    v_C_relative: Float  # noqa: N815
    v_C: Float  # noqa: N815
    v_B: Float  # noqa: N815
    pushes: npt.NDArray[np.bool_]

    def __repr__(self) -> str:
        return f"<assur.crank_rocker.Solution, shape {self.S.shape}>"


class Table1(NamedTuple):
    """Table 1: crank angles, degrees; grounds; transmission angles, rad (angles × grounds).

    Attributes
    ----------
    phi1_deg : ndarray
        Crank angles, degrees, (13,).
    l4 : ndarray
        Grounds, in crank lengths, (5,).
    printed, true : ndarray
        Transmission angles, rad, (13, 5): as printed, and with the true π.

    Examples
    --------
    >>> import assur
    >>> table = assur.crank_rocker.table1()
    >>> table.true.shape, abs(table.printed - table.true).max().round(4)  # rad
    ((13, 5), np.float64(0.0022))
    """

    phi1_deg: Float
    l4: Float
    printed: Float
    true: Float

    def __repr__(self) -> str:
        return summary(self)


def solve(
    phi1: npt.ArrayLike,
    l1: npt.ArrayLike,
    l2: npt.ArrayLike,
    l3: npt.ArrayLike,
    l4: npt.ArrayLike,
    *,
    speed: npt.ArrayLike = 1.0,
    ground_speed: npt.ArrayLike = 0.0,
    assembly: Literal["printed", "other"] = "printed",
) -> Solution:
    """Return positions and rates in the paper's convention; all arguments broadcast.

    Parameters
    ----------
    phi1 : array_like
        Crank angle, rad; 0 where the pin is farthest from D.
    l1, l2, l3, l4 : array_like
        Crank, coupler, rocker and ground, m.
    speed, ground_speed : array_like
        dφ₁/dt, rad/s, and dl₄/dt, m/s.
    assembly : {"printed", "other"}
        The printed assembly (φ₃″ and β positive), or the mirror image about BD.

    Returns
    -------
    Solution
        NaN where the coupler does not reach.

    Examples
    --------
    >>> import assur
    >>> found = assur.crank_rocker.solve(2.1, 1, 4.5, 1.5, 4.9, speed=3.0, ground_speed=0.7)
    >>> found.dS.round(8), found.v_C.round(8)
    (np.float64(-2.14608491), np.float64(2.38405545))
    """
    one_of(assembly, ("printed", "other"), "assembly")
    named = [("phi1", phi1), *zip(LENGTHS, (l1, l2, l3, l4), strict=True)]
    named += [("speed", speed), ("ground_speed", ground_speed)]
    arrays = [finite_array(value, name) for name, value in named]
    for name, array in zip(LENGTHS, arrays[1:5], strict=True):
        _positive(array, name)
    flat, shape = _broadcast(*arrays)
    rows = _core.crank_rocker_solve(flat[0], flat[1:5], flat[5:], assembly == "printed")
    parts = rows.reshape((18, *shape))
    v_b = np.where(np.isnan(parts[0]), np.nan, np.abs(flat[1] * flat[5]).reshape(shape))
    pushes = np.asarray(parts[13] > 0.0)
    names = list(Solution.__dataclass_fields__)[:19]
    held: dict[str, Any] = dict(zip(names, map(np.asarray, (*parts, v_b)), strict=True))
    return Solution(**held, pushes=pushes)


def grashof(
    l1: npt.ArrayLike,
    l2: npt.ArrayLike,
    l3: npt.ArrayLike,
    l4: npt.ArrayLike,
    *,
    tolerance: float = CHANGE_TOLERANCE,
) -> str | npt.NDArray[np.str_]:
    """Return Grashof's type of four-bars with crank l1, coupler l2, rocker l3 and ground l4.

    Parameters
    ----------
    l1, l2, l3, l4 : array_like
        Lengths, m; they broadcast.
    tolerance : float
        The two sums make a change point if they agree to this fraction of the longest length.

    Returns
    -------
    str or numpy.ndarray of str
        "crank-rocker", "rocker-crank" (l3 turns), "double-crank", "double-rocker" (the coupler
        turns), "triple-rocker" (none turns) or "change-point".

    Examples
    --------
    >>> import assur
    >>> assur.crank_rocker.grashof(1, 4.5, 1.5, 4.8)
    'crank-rocker'
    >>> assur.crank_rocker.grashof([1, 2], 4.5, [1.5, 1], 4.8)
    array(['crank-rocker', 'rocker-crank'], dtype='<U12')
    """
    flat, shape = _designs(l1, l2, l3, l4)
    return types_of(flat, shape, real_number(tolerance, "tolerance"))


def crank_turns(
    l1: npt.ArrayLike, l2: npt.ArrayLike, l3: npt.ArrayLike, l4: npt.ArrayLike
) -> tuple[bool | npt.NDArray[np.bool_], Float]:
    """Return whether the crank turns fully, and the margins of the inequalities.

    The margins (a last axis of 3) are l2 + l3 − l1 − l4, l3 + l4 − l1 − l2 and l2 + l4 − l1 − l3:
    for a ground longer than the crank it turns if and only if all are positive. The paper prints
    the first two.

    Parameters
    ----------
    l1, l2, l3, l4 : array_like
        Lengths of crank, coupler, rocker and ground, m.

    Returns
    -------
    turns : bool or ndarray of bool
        Whether it turns.
    margins : ndarray
        By how much each inequality holds, m, (..., 3).

    Examples
    --------
    >>> import assur
    >>> turns, margins = assur.crank_rocker.crank_turns(1, 1.5, 4, 3.2)
    >>> turns, margins.round(6)
    (False, array([ 1.3,  4.7, -0.3]))
    """
    flat, shape = _designs(l1, l2, l3, l4)
    margins, turns = _core.crank_rocker_turns(flat)
    return turns.reshape(shape) if shape else bool(turns[0]), margins.reshape((*shape, 3))


def ground_range(
    coupler: npt.ArrayLike,
    rocker: npt.ArrayLike,
    *,
    margin: float | tuple[float, float] = 0.05,
    gamma_min: npt.ArrayLike = 0.0,
) -> tuple[Number, Number]:
    """Return the least and the greatest ground for which the crank turns.

    Parameters
    ----------
    coupler, rocker : array_like
        Lengths relative to the crank.
    margin : float or (float, float)
        Margin to the least and to the greatest ground (equation 6).
    gamma_min : array_like
        Least transmission angle, rad, see `least_transmission_angle`; 0 without friction.

    Returns
    -------
    (float, float) or arrays
        Relative to the crank; NaN in arrays where the range is empty.

    Raises
    ------
    InputError
        If the range is empty (for a single pair of lengths).

    Examples
    --------
    >>> import assur
    >>> [round(x, 6) for x in assur.crank_rocker.ground_range(4.0, 2.0)]
    [3.05, 4.95]
    >>> [round(x, 8) for x in assur.crank_rocker.ground_range(4.5, 1.5, margin=0.0, gamma_min=0.2)]
    [4.04451986, 4.97753284]
    """
    margins = real_array(margin, "margin")
    if margins.shape not in ((), (2,)) or not np.isfinite(margins).all() or (margins < 0.0).any():
        message = f"margin is {margin!r}: one or two numbers, not negative, are needed"
        raise InputError(message)
    named = {"coupler": coupler, "rocker": rocker, "gamma_min": gamma_min}
    arrays = {name: finite_array(value, name) for name, value in named.items()}
    for name in ("coupler", "rocker"):
        _positive(arrays[name], name)
    _angle(arrays["gamma_min"], "gamma_min")
    flat, shape = _broadcast(*arrays.values())
    both = np.broadcast_to(margins, (2,)).tolist()
    ends = _core.crank_rocker_ground_range(flat[0], flat[1], both, flat[2]).reshape((*shape, 2))
    least, greatest = ends[..., 0], ends[..., 1]
    if shape:
        nothing = least > greatest
        least, greatest = (np.where(nothing, np.nan, end) for end in (least, greatest))
        return as_number(least), as_number(greatest)
    if least > greatest:
        message = (
            f"no length of the ground fits: with coupler {coupler!r}, rocker {rocker!r}, "
            f"margin {margin!r} and gamma_min {gamma_min!r} it would be from {least:.6g} "
            f"to {greatest:.6g}"
        )
        raise InputError(message)
    return as_number(float(least)), as_number(float(greatest))


def least_transmission_angle(
    f_c: npt.ArrayLike,
    r_c: npt.ArrayLike,
    f_d: npt.ArrayLike,
    r_d: npt.ArrayLike,
    rocker: npt.ArrayLike,
    *,
    f_b: npt.ArrayLike = 0.0,
    r_b: npt.ArrayLike = 0.0,
    coupler: npt.ArrayLike | None = None,
    exact: bool = False,
    side: Side = "outer",
) -> Number:
    """Return the least transmission angle at which friction lets the rocker move, rad.

    sin γ = (f_C r_C + f_D r_D) / l₃ (equation 8), with coefficients of friction and radii of the
    joints C and D. The paper neglects that friction at B and C also turns the coupler's force off
    its line; `exact` is without this approximation, for links without mass and a crank that
    drives. NaN in arrays where the rocker does not move at any angle.

    Parameters
    ----------
    f_c, r_c, f_d, r_d : array_like
        Coefficients of friction and radii of the pins at C and D; they broadcast.
    rocker : array_like
        Its length, in the unit of the radii.
    f_b, r_b : array_like
        The same of B; for `exact`.
    coupler : array_like
        Its length; needed with `exact`.
    exact : bool
        Whether the exact limit is returned.
    side : {"outer", "inner"}
        For `exact`: the extreme at which coupler and rocker are nearly stretched, or nearly folded.
        Radii ρ of the friction circles, on one side of the extreme with s = 1, on the other with
        s = −1: arcsin((ρ_D + s ρ_C)/l₃) + arcsin((ρ_B ± s ρ_C)/l₂), + on the outer side. The crank
        passes if γ at the extreme is greater than both.

    Returns
    -------
    float
        The angle, rad.

    Raises
    ------
    InputError
        If the rocker does not move at any angle (for a single mechanism); negative numbers; `exact`
        without the coupler.

    Examples
    --------
    >>> import assur
    >>> round(assur.crank_rocker.least_transmission_angle(0.1, 0.5, 0.1, 1.5, 1.5), 7)
    0.1337316
    >>> exact = assur.crank_rocker.least_transmission_angle(
    ...     0.1, 1.0, 0.1, 1.0, 1.5, f_b=0.1, r_b=1.0, coupler=4.5, exact=True
    ... )
    >>> round(exact, 7)
    0.1781907
    """
    named = {"f_c": f_c, "r_c": r_c, "f_d": f_d, "r_d": r_d, "rocker": rocker}
    if flag(exact, "exact"):
        if coupler is None:
            message = "coupler is None: the exact limit needs its length"
            raise InputError(message)
        named |= {"f_b": f_b, "r_b": r_b, "coupler": coupler}
    one_of(side, ("outer", "inner"), "side")
    arrays = {name: finite_array(value, name) for name, value in named.items()}
    for name, array in arrays.items():
        if (array < 0.0).any():
            wrong = float(array[array < 0.0].flat[0])
            message = f"{name} is {wrong!r}: it must not be negative"
            raise InputError(message, value=wrong)
    for name in ("rocker", "coupler") if exact else ("rocker",):
        _positive(arrays[name], name)
    flat, shape = _broadcast(*arrays.values())
    if exact:
        circles = [flat[5] * flat[6], flat[0] * flat[1], flat[2] * flat[3]]
        angles = _core.crank_rocker_exact_least_gamma(circles, [flat[7], flat[4]], side == "outer")
    else:
        angles = _core.crank_rocker_least_gamma(flat[:4], flat[4])
    if shape:
        return as_number(angles.reshape(shape))
    if np.isnan(angles[0]):
        a, b, c, d, length = (float(column[0]) for column in flat[:5])
        reduced = (a * b + c * d) / length
        if exact:
            message = "friction is so great that the rocker does not move at any angle"
            raise InputError(message)
        message = f"f_p = {reduced:.6g} is not below 1: the rocker does not move at any angle"
        raise InputError(message, value=reduced)
    return as_number(float(angles[0]))


def transmission_extremes(
    l1: npt.ArrayLike, l2: npt.ArrayLike, l3: npt.ArrayLike, l4: npt.ArrayLike
) -> tuple[Number, Number]:
    """Return the least and the greatest transmission angle over a turn of the crank, rad.

    It is the acute one, γ = min(γ₂₃, π − γ₂₃). In closed form: the angle γ₂₃ between coupler and
    rocker is extreme where crank and ground are collinear (φ₁ = 0 and π), and γ is least at one of
    these; if γ₂₃ passes π/2 between them, the greatest γ is π/2. NaN in arrays where the crank does
    not turn fully.

    Parameters
    ----------
    l1, l2, l3, l4 : array_like
        Lengths of crank, coupler, rocker and ground, m.

    Returns
    -------
    least, greatest : float or ndarray
        The transmission angles, rad.

    Raises
    ------
    InputError
        If the crank does not turn fully (for a single mechanism).

    Examples
    --------
    >>> import assur
    >>> [round(x, 6) for x in assur.crank_rocker.transmission_extremes(1, 4.5, 1.5, 4.8)]
    [0.600266, 1.570796]
    """
    flat, shape = _designs(l1, l2, l3, l4)
    ends = _core.crank_rocker_extremes(flat).reshape((*shape, 2))
    if not shape and np.isnan(ends).any():
        _, margins = crank_turns(l1, l2, l3, l4)
        message = f"the crank does not turn: margins {margins.tolist()}"
        raise InputError(message)
    least, greatest = ends[..., 0], ends[..., 1]
    if shape:
        return as_number(least), as_number(greatest)
    return as_number(float(least)), as_number(float(greatest))


def blocked(
    l1: float, l2: float, l3: float, l4: float, gamma_min: float
) -> list[tuple[float, float]]:
    """Return the crank angles at which friction blocks the rocker, as intervals of φ₁, rad.

    There γ < γ_min: around φ₁ = 0 (γ₂₃ near π; the interval begins below 0) and around φ₁ = π
    (γ₂₃ near 0). The list is empty if the mechanism is never blocked.

    Parameters
    ----------
    l1, l2, l3, l4 : float
        Lengths of crank, coupler, rocker and ground, m.
    gamma_min : float
        Least transmission angle at which the rocker still moves, rad.

    Returns
    -------
    list of (float, float)
        Where each interval begins and ends, rad.

    Examples
    --------
    >>> import assur, numpy as np
    >>> np.degrees(assur.crank_rocker.blocked(1, 4.5, 1.5, 4.995, 0.2)).round(6)
    array([[-11.744097,  11.744097]])
    """
    least = real_number(gamma_min, "gamma_min")
    _angle(np.asarray(least), "gamma_min")
    flat, shape = _designs(l1, l2, l3, l4)
    if shape:
        message = f"blocked has intervals of one mechanism, not of {shape}"
        raise InputError(message)
    intervals = _core.crank_rocker_blocked([float(column[0]) for column in flat], least)
    return [(start, end) for start, end in intervals]


def table1() -> Table1:
    """Return Table 1, as printed (with π = 3.14) and with the true π.

    Transmission angles for l1 = 1, l2 = 4.5, l3 = 1.5, every 30°.

    Returns
    -------
    Table1
        Both, with the angles and grounds that they are of.

    Examples
    --------
    >>> import assur
    >>> assur.crank_rocker.table1().printed[0, :2].round(6)
    array([0.598674, 0.517372])
    """
    degrees = np.arange(0.0, 361.0, 30.0)
    grounds = np.array(TABLE_GROUNDS)
    rough = solve(degrees[:, np.newaxis] * PRINTED_PI / 180.0, *TABLE, grounds).gamma23
    printed = np.where(rough < PRINTED_PI / 2, rough, PRINTED_PI - rough)
    true = solve(np.radians(degrees)[:, np.newaxis], *TABLE, grounds).gamma
    return Table1(degrees, grounds, printed, true)


def _positive(array: Float, name: str) -> None:
    if (array <= 0.0).any():
        wrong = float(array[array <= 0.0].flat[0])
        message = f"{name} is {wrong!r}: a length must be positive"
        raise DimensionError(message, dimension=name, value=wrong)


def _angle(value: Any, name: str) -> None:
    array = finite_array(value, name)
    bad = ~((array >= 0.0) & (array < np.pi / 2))
    if bad.any():
        wrong = float(array[bad].flat[0])
        message = f"{name} is {wrong!r}: an angle from 0 to below π/2 rad is needed"
        raise InputError(message, value=wrong)


def _broadcast(*arrays: Float) -> tuple[list[Float], tuple[int, ...]]:
    """Return the arrays, broadcast and flattened, and their shape."""
    try:
        wide = np.broadcast_arrays(*arrays)
    except ValueError as error:
        shapes = ", ".join(str(array.shape) for array in arrays)
        message = f"shapes {shapes} do not broadcast"
        raise InputError(message) from error
    return [np.ascontiguousarray(array).reshape(-1) for array in wide], wide[0].shape


def _designs(*lengths: Any) -> tuple[list[Float], tuple[int, ...]]:
    arrays = [finite_array(value, name) for name, value in zip(LENGTHS, lengths, strict=True)]
    for name, array in zip(LENGTHS, arrays, strict=True):
        _positive(array, name)
    return _broadcast(*arrays)
