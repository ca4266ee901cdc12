"""Formulas of the central slider-crank: exact motion, cosine series, continued fraction."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from assur import _core
from assur._arrays import (
    Float,
    as_number,
    finite_array,
    in_range,
    real_array,
    real_number,
    require_finite,
)
from assur._extreme import Extreme
from assur._summary import summary
from assur._trig import arctan2
from assur._validate import one_of, whole_number
from assur.errors import DimensionError, InputError
from assur.kinematics.quantity import Analogues

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = [
    "Deviation",
    "Extreme",
    "contour",
    "coordinate",
    "deviation",
    "fourier",
    "greatest_acceleration",
    "greatest_speed",
    "rod_angle",
    "rod_point",
    "stroke",
]

# More terms change no digit of any approximation (k = 1.001 needs some 400).
MAX_TERMS = 100_000


class Deviation(NamedTuple):
    """Largest deviations of an approximation, each with its crank angle, rad.

    `relative` is a fraction of the exact value (undefined for the acceleration analogue, which
    passes through zero), `absolute` is per crank length.

    Attributes
    ----------
    relative, relative_at : float or ndarray
        Fraction of the exact value, and where, rad.
    absolute, absolute_at : float or ndarray
        Per crank length, and where, rad.

    Examples
    --------
    >>> import assur
    >>> assur.slider_crank.deviation(1 / 3, 1).relative.round(6)
    np.float64(0.004725)
    """

    relative: Float
    relative_at: Float
    absolute: Float
    absolute_at: Float

    def __repr__(self) -> str:
        return summary(self)


def fourier(k: npt.ArrayLike, *, harmonics: int = 6, terms: int | None = None) -> Float:
    """Return the coefficients of the stroke's cosine series, per crank length.

    s / crank = A0 + A1 cos φ + A2 cos 2φ + A4 cos 4φ + …; A1 = −1, other odd coefficients are 0.

    Parameters
    ----------
    k : array_like
        Rod length over crank length, above 1.
    harmonics : int
        The last harmonic, even.
    terms : int, optional
        Terms kept of each coefficient's own series in 1/k: powers up to sin^(2 terms) φ, hence
        `terms` besides the 1 in A0 and one fewer for each further coefficient. None: all that
        change the last bit.

    Returns
    -------
    numpy.ndarray
        A0, A1, A2, A4 … A_harmonics; shape k.shape + (2 + harmonics/2,). Each is accurate to 0.51
        units in the last place (below 1e-300, to two), for any number of terms.

    Raises
    ------
    InputError
        A k that is not above 1, or so close to it that a series needs too many terms.

    References
    ----------
    Chernysh et al. (2021), equations 11 and 12.

    Examples
    --------
    >>> import assur
    >>> assur.slider_crank.fourier(3.0, harmonics=4).round(6)
    array([ 1.085155, -1.      , -0.085777,  0.000631])
    """
    ratios = real_array(k, "k")
    _ratio(ratios, "k")
    last, kept = _harmonics(harmonics), _terms(terms)
    coefficients = _core.slider_crank_fourier(np.ascontiguousarray(ratios).reshape(-1), last, kept)
    return coefficients.reshape((*ratios.shape, 2 + last // 2))


def stroke(
    phi: npt.ArrayLike,
    crank: npt.ArrayLike,
    rod: npt.ArrayLike,
    *,
    method: Literal["exact", "series", "fraction"] = "exact",
    n: int = 2,
    harmonics: int = 2,
    terms: int | None = 1,
) -> Analogues:
    """Return the stroke from the outer dead point, m, with two analogues.

    Parameters
    ----------
    phi, crank, rod : array_like
        Crank angle, rad, and lengths, m; they broadcast.
    method : {"exact", "series", "fraction"}
        The exact motion; the cosine series (its first three terms by default: equations 14 to 16
        of Chernysh et al.); or the continued fraction of Ambarcumyanc and Subbotina.
    n : int
        Number of the fraction's approximation, from 1 on.
    harmonics, terms : int
        Parameters of the series, see `fourier`.

    Returns
    -------
    Analogues
        ``value``, ``d1`` and ``d2``, each the exact derivative of the one before; also
        ``velocity(speed)`` and ``acceleration(speed, acceleration)``.

    Raises
    ------
    DimensionError
        A length that is not positive, or a rod not longer than its crank.
    InputError
        An argument that is not a number, or an unknown method.

    Examples
    --------
    >>> import assur, numpy as np
    >>> s = assur.slider_crank.stroke(np.pi / 2, 1.0, 3.0)
    >>> s.value.round(6), s.d1, s.d2.round(6)
    (np.float64(1.171573), array(1.), np.float64(-0.353553))
    """
    one_of(method, ("exact", "series", "fraction"), "method")
    angles, cranks, rods = _lengths(phi, crank, rod)
    with in_range("rod / crank"):
        flat, ratios, inverse = _flat(angles, cranks / rods, rods / cranks)
    if method == "exact":
        arrays = _core.slider_crank_stroke(flat, ratios)
    elif method == "fraction":
        arrays = _core.slider_crank_fraction(flat, ratios, whole_number(n, "n", 1, MAX_TERMS))
    else:
        last, kept = _harmonics(harmonics), _terms(terms)
        arrays = _core.slider_crank_series(flat, inverse, last, kept)
    return _scaled("stroke", cranks, arrays)


def coordinate(phi: npt.ArrayLike, crank: npt.ArrayLike, rod: npt.ArrayLike) -> Analogues:
    """Return the slider's coordinate from the crank's pivot, m, with two analogues.

    The papers' other convention: x = crank + rod − stroke, so analogues have the opposite sign.

    Parameters
    ----------
    phi : array_like
        Crank angles, rad.
    crank, rod : array_like
        Lengths, m, broadcast to phi.

    Returns
    -------
    Analogues
        The coordinate, m, and its derivatives by phi.

    Examples
    --------
    >>> import assur
    >>> assur.slider_crank.coordinate(0.0, 1.0, 3.0).value
    array(4.)
    """
    angles, cranks, rods = _lengths(phi, crank, rod)
    displacement = stroke(angles, cranks, rods)
    with in_range("coordinate"):
        arrays = tuple(
            map(
                np.asarray, (cranks + rods - displacement.value, -displacement.d1, -displacement.d2)
            )
        )
    return Analogues("coordinate", arrays, 1, point=False)


def rod_angle(phi: npt.ArrayLike, crank: npt.ArrayLike, rod: npt.ArrayLike) -> Analogues:
    """Return the angle of the rod to the slider's axis, rad, with two analogues.

    φ₂ = −δ, sin δ = (crank / rod) sin φ: negative while the crank's pin is above the axis.

    Parameters
    ----------
    phi : array_like
        Crank angles, rad.
    crank, rod : array_like
        Lengths, m, broadcast to phi.

    Returns
    -------
    Analogues
        The angle, rad, and its derivatives by phi.

    References
    ----------
    Chernysh et al. (2021), equations 2, 3, 33, 39.

    Examples
    --------
    >>> import assur, numpy as np
    >>> assur.slider_crank.rod_angle(np.pi / 2, 1.0, 2.0).value.round(6)
    np.float64(-0.523599)
    """
    angles, cranks, rods = _lengths(phi, crank, rod)
    arrays = _core.slider_crank_rod_angle(*_flat(angles, cranks / rods))
    return _scaled("rod_angle", np.ones_like(cranks), arrays)


def rod_point(
    phi: npt.ArrayLike,
    crank: npt.ArrayLike,
    rod: npt.ArrayLike,
    along: npt.ArrayLike,
    across: npt.ArrayLike = 0.0,
) -> Analogues:
    """Return the position of a point of the rod, m, with two analogues.

    Parameters
    ----------
    phi, crank, rod : array_like
        Crank angle, rad, and lengths, m.
    along, across : array_like
        The point's coordinates, m: along the rod from the crank's pin, and to the left of the rod.

    Returns
    -------
    Analogues
        Points with a last axis (x, y), x along the slider's axis, from the crank's pivot. The speed
        is ``np.linalg.norm(point.velocity(speed), axis=-1)``.

    References
    ----------
    Chernysh et al. (2021), equations 30 and 31, with x and y as in the paper's figure.

    Examples
    --------
    >>> import assur, numpy as np
    >>> middle = assur.slider_crank.rod_point(0.0, 1.0, 3.0, along=1.5)
    >>> middle.value, middle.velocity(speed=10.0)
    (array([2.5, 0. ]), array([0., 5.]))
    """
    angles, cranks, rods = _lengths(phi, crank, rod)
    a, b = real_array(along, "along"), real_array(across, "across")
    for name, array in (("along", a), ("across", b)):
        require_finite(array, name)
    angles, cranks, rods, a, b = _broadcast(angles, cranks, rods, a, b)
    with in_range("place / crank"):
        flat = _flat(angles, cranks / rods, a / cranks, b / cranks)
    parts = _core.slider_crank_rod_point(*flat)
    shape = (*cranks.shape, 2)
    with in_range("rod_point"):
        arrays = [part.reshape(shape) * cranks[..., np.newaxis] for part in parts]
    return Analogues("rod_point", tuple(arrays), 1, point=True)


def greatest_speed(
    k: npt.ArrayLike, *, method: Literal["exact", "series", "perpendicular"] = "exact"
) -> Extreme:
    """Return the slider's greatest speed in the first half turn, and the crank angle there.

    Parameters
    ----------
    k : array_like
        Rod length over crank length, above 1.
    method : {"exact", "series", "perpendicular"}
        The exact maximum; that of the series' first three terms (cos φ = (−k + √(k² + 8))/4, with
        their speed); or the position with crank and rod perpendicular (φ = arctan k).

    Returns
    -------
    Extreme
        The slider's speed per crank length and crank speed, and the crank angle, rad.

    Examples
    --------
    >>> import assur, numpy as np
    >>> fastest = assur.slider_crank.greatest_speed(3.0)
    >>> np.rad2deg(fastest.q).round(6), fastest.value.round(9)
    (np.float64(73.175297), np.float64(1.054639547))
    """
    ratios = real_array(k, "k")
    _ratio(ratios, "k")
    one_of(method, ("exact", "series", "perpendicular"), "method")
    if method == "perpendicular":
        at = arctan2(ratios, 1.0)
        return Extreme(as_number(stroke(at, 1.0, ratios).d1), as_number(at))
    flat = np.ascontiguousarray(ratios).reshape(-1)
    at, value = _core.slider_crank_greatest_speed(flat, method == "exact")
    return Extreme(as_number(value.reshape(ratios.shape)), as_number(at.reshape(ratios.shape)))


def greatest_acceleration(k: npt.ArrayLike) -> Extreme:
    """Return the most negative acceleration of the stroke, and the crank angle there.

    The crank speed is constant. For k ≥ (3 + √21)/2 = 3.791 it is the inner dead point (φ = π); a
    shorter rod has two such angles; the one below π is returned.

    Parameters
    ----------
    k : array_like
        Rod length over crank length, above 1.

    Returns
    -------
    Extreme
        Acceleration per crank length and crank speed squared, and the crank angle, rad.

    Examples
    --------
    >>> import assur, numpy as np
    >>> least = assur.slider_crank.greatest_acceleration(3.0)
    >>> np.rad2deg(least.q).round(6), least.value.round(9)
    (np.float64(137.612519), np.float64(-0.697525367))
    """
    ratios = real_array(k, "k")
    _ratio(ratios, "k")
    flat = np.ascontiguousarray(ratios).reshape(-1)
    at, value = _core.slider_crank_greatest_acceleration(flat)
    return Extreme(as_number(value.reshape(ratios.shape)), as_number(at.reshape(ratios.shape)))


def deviation(
    lam: npt.ArrayLike, n: int, *, quantity: Literal["stroke", "d1", "d2"] = "stroke"
) -> Deviation:
    """Return the largest deviations of the continued fraction from the exact motion.

    Parameters
    ----------
    lam : array_like
        λ = crank / rod, below 1.
    n : int
        Number of the approximation, from 1 on.
    quantity : {"stroke", "d1", "d2"}
        Stroke, velocity analogue or acceleration analogue.

    Returns
    -------
    Deviation
        Greatest deviations between the dead points and their crank angles, found by optimisation.

    References
    ----------
    Ambarcumyanc and Subbotina (2017), figures 2 and 3.

    Examples
    --------
    >>> import assur
    >>> largest = assur.slider_crank.deviation(1 / 3, 1)
    >>> (100 * largest.relative).round(6)                         # per cent
    np.float64(0.472502)
    """
    ratios = finite_array(lam, "lam")
    bad = ~((ratios > 0.0) & (ratios < 1.0))
    if bad.any():
        value = float(ratios[bad].flat[0])
        message = f"lam is {value!r}: crank over rod must be above 0 and below 1"
        raise InputError(message, value=value)
    orders = {"stroke": 0, "d1": 1, "d2": 2}
    one_of(quantity, tuple(orders), "quantity")
    number = whole_number(n, "n", 1, MAX_TERMS)
    flat = np.ascontiguousarray(ratios).reshape(-1)
    parts = _core.slider_crank_deviation(flat, number, orders[quantity])
    return Deviation(*(part.reshape(ratios.shape) for part in parts))


def contour(phi: float, crank: float, rod: float) -> Float:
    """Return the closed vector contour at one position: O, A, B and O again, m, shape (4, 2).

    Parameters
    ----------
    phi : float
        Crank angle, rad.
    crank, rod : float
        Lengths, m.

    Returns
    -------
    ndarray
        Points, m, (4, 2).

    References
    ----------
    Chernysh et al. (2021), figure 2 and equations 17 and 18: l₁ + l₂ = l₃.

    Examples
    --------
    >>> import assur
    >>> assur.slider_crank.contour(0.0, 1.0, 3.0)
    array([[0., 0.],
           [1., 0.],
           [4., 0.],
           [0., 0.]])
    """
    at = real_number(phi, "phi (contour draws one position)")
    lengths = real_number(crank, "crank"), real_number(rod, "rod")
    pin = rod_point(at, *lengths, along=0.0).value
    return np.array([[0.0, 0.0], pin, [float(coordinate(at, *lengths).value), 0.0], [0.0, 0.0]])


def _ratio(k: Float, name: str) -> None:
    require_finite(k, name)
    if (k <= 1.0).any():
        value = float(k[k <= 1.0].flat[0])
        message = f"{name} is {value!r}: the rod must be longer than the crank, {name} > 1"
        raise InputError(message, value=value)


def _lengths(phi: Any, crank: Any, rod: Any) -> tuple[Float, Float, Float]:
    """Return angles and lengths, broadcast; the rod must be longer than its crank."""
    angles = real_array(phi, "phi")
    cranks, rods = real_array(crank, "crank"), real_array(rod, "rod")
    for name, array in (("phi", angles), ("crank", cranks), ("rod", rods)):
        require_finite(array, name)
    for name, array in (("crank", cranks), ("rod", rods)):
        if (array <= 0.0).any():
            value = float(array[array <= 0.0].flat[0])
            message = f"{name} is {value!r}: a length must be positive"
            raise DimensionError(message, dimension=name, value=value)
    angles, cranks, rods = _broadcast(angles, cranks, rods)
    short = rods <= cranks
    if short.any():
        length, longer = float(rods[short].flat[0]), float(cranks[short].flat[0])
        message = (
            f"rod is {length!r}, not longer than its crank {longer!r} (k = {length / longer:.6g}): "
            f"the crank cannot turn"
        )
        raise DimensionError(message, dimension="rod", value=length)
    return angles, cranks, rods


def _broadcast(*arrays: Float) -> tuple[Any, ...]:
    try:
        return tuple(np.broadcast_arrays(*arrays))
    except ValueError as error:
        shapes = ", ".join(str(array.shape) for array in arrays)
        message = f"shapes {shapes} do not broadcast"
        raise InputError(message) from error


def _flat(*arrays: Float) -> tuple[Any, ...]:
    return tuple(np.ascontiguousarray(array).reshape(-1) for array in arrays)


def _scaled(name: str, lengths: Float, parts: Sequence[Float]) -> Analogues:
    with in_range(name):
        arrays = tuple(np.asarray(part.reshape(lengths.shape) * lengths) for part in parts)
    return Analogues(name, arrays, 1, point=False)


def _harmonics(harmonics: Any) -> int:
    number = whole_number(harmonics, "harmonics", 0, MAX_TERMS)
    if number % 2:
        message = f"harmonics is {harmonics!r}: an even number is needed (odd ones are 0 but A1)"
        raise InputError(message)
    return number


def _terms(terms: Any) -> int | None:
    return None if terms is None else whole_number(terms, "terms", 0, MAX_TERMS)
