"""Harmonics over a turn of the driver, and the rotating parts of a force."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from assur import _trig
from assur._arrays import finite_array, in_range, real_array
from assur._summary import summary
from assur._validate import whole_number
from assur.errors import InputError

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur._arrays import Float

__all__ = ["Harmonics", "RotatingParts", "harmonics", "rotating_parts"]

# Steps of q may differ by this fraction: coordinates of a turn are rounded, or typed to ten digits.
EVEN = 1e-9


@dataclass(frozen=True)
class Harmonics:
    """A quantity as a sum of cosines and sines of the driver's angle.

    Attributes
    ----------
    cosine, sine : ndarray
        Coefficients of cos n q and sin n q, (..., count + 1), in the quantity's unit; the mean is
        `cosine[..., 0]`.

    Examples
    --------
    >>> import assur, numpy as np
    >>> q = np.linspace(0, 2 * np.pi, 36, endpoint=False)
    >>> found = assur.balance.harmonics(q, 5.0 + 3.0 * np.cos(q) + 4.0 * np.sin(q), count=2)
    >>> found.amplitude.round(6)
    array([5., 5., 0.])
    """

    __repr__ = summary

    cosine: Float
    sine: Float

    @property
    def amplitude(self) -> Float:
        """Greatest value of each harmonic, 0 or more; for n = 0 the mean without its sign."""
        return _size(self.cosine, self.sine)

    @property
    def phase(self) -> Float:
        """The angle n q at which each harmonic is greatest, rad."""
        return _trig.arctan2(self.sine, self.cosine)


@dataclass(frozen=True)
class RotatingParts:
    """A force in a plane as a sum of forces that rotate, at n times the driver's speed.

    Attributes
    ----------
    forward, backward : ndarray
        Sizes of the parts that rotate with the driver and against it, (..., count + 1); `forward`
        of n = 0 is the mean force, `backward` of n = 0 is 0.
    forward_angle, backward_angle : ndarray
        Their directions at q = 0, rad.

    Examples
    --------
    A force that rotates with the driver, like that of a weight on the crank:

    >>> import assur, numpy as np
    >>> q = np.linspace(0, 2 * np.pi, 36, endpoint=False)
    >>> force = 7.0 * np.stack([np.cos(q), np.sin(q)], axis=-1)
    >>> found = assur.balance.rotating_parts(q, force, count=2)
    >>> found.forward.round(6), found.backward.round(6)
    (array([0., 7., 0.]), array([0., 0., 0.]))
    """

    __repr__ = summary

    forward: Float
    forward_angle: Float
    backward: Float
    backward_angle: Float


def harmonics(q: npt.ArrayLike, values: npt.ArrayLike, *, count: int = 6) -> Harmonics:
    """Return the harmonics of a quantity over a turn, such as the shaking moment.

    Parameters
    ----------
    q : array_like
        One turn of the driver in N even steps, without its end, rad, (N,).
    values : array_like
        The quantity there, (..., N): one, or one for each design. At constant speed, if its
        harmonics are to be those in time.
    count : int
        Highest harmonic; N must be more than twice this.

    Returns
    -------
    Harmonics
        Coefficients (..., count + 1). A design with a value that is not finite has NaN.

    Raises
    ------
    InputError
        Coordinates that are not one turn in even steps, shapes that do not fit, too few positions,
        no series of finite values.

    Notes
    -----
    The trapezoidal rule, exact if harmonics of order N − count and above are absent: coefficients
    of smooth motions fall quickly, so a few dozen positions give all digits.

    Examples
    --------
    The force of a piston of 1 kg at 1 rad/s, a rod three cranks long:

    >>> import assur
    >>> import numpy as np
    >>> machine = assur.Machine(
    ...     assur.SliderCrank(1.0, 3.0), bodies={"piston": assur.Body(mass=1.0)}
    ... )
    >>> q = np.arange(64) * (2 * np.pi / 64)
    >>> force = machine.reactions(q, speed=1.0).shaking_force
    >>> assur.balance.harmonics(q, force[:, 0], count=4).amplitude.round(6)
    array([0.      , 1.      , 0.343109, 0.      , 0.010099])
    """
    series = real_array(values, "values")
    first, step, n = _turn(q, count)
    if series.ndim == 0 or series.shape[-1] != n:
        message = f"values has the shape {series.shape}: with {n} coordinates its last axis is {n}"
        raise InputError(message)
    with in_range("a harmonic of values"):
        return _harmonics(first, step, series, count, "values")


def rotating_parts(q: npt.ArrayLike, force: npt.ArrayLike, *, count: int = 6) -> RotatingParts:
    """Return the forward and backward rotating parts of a force over a turn.

    Parameters
    ----------
    q : array_like
        One turn of the driver in N even steps, without its end, rad, (N,).
    force : array_like
        Such as `Reactions.shaking_force` at constant speed, N, (..., N, 2).
    count : int
        Highest harmonic; N must be more than twice this.

    Returns
    -------
    RotatingParts
        Sizes and directions (..., count + 1): F_x + i F_y is the sum of forward e^{i(angle + n q)}
        and backward e^{i(angle − n q)}.

    Raises
    ------
    InputError
        See `harmonics`.

    Notes
    -----
    Each harmonic draws an ellipse with the semi-axes forward + backward and
    ``|forward − backward|``. A rotating counterweight can take away a forward part;
    backward ones take shafts that turn against the driver (F. W. Lanchester's).

    Examples
    --------
    A piston's first harmonic is half forward and half backward:

    >>> import assur
    >>> import numpy as np
    >>> machine = assur.Machine(
    ...     assur.SliderCrank(1.0, 3.0), bodies={"piston": assur.Body(mass=1.0)}
    ... )
    >>> q = np.arange(64) * (2 * np.pi / 64)
    >>> parts = assur.balance.rotating_parts(q, machine.reactions(q, 1.0).shaking_force, count=2)
    >>> parts.forward.round(6), parts.backward.round(6)
    (array([0.      , 0.5     , 0.171554]), array([0.      , 0.5     , 0.171554]))
    """
    vectors = real_array(force, "force")
    first, step, n = _turn(q, count)
    if vectors.ndim < 2 or vectors.shape[-2:] != (n, 2):
        message = f"force has the shape {vectors.shape}: with {n} coordinates it ends with ({n}, 2)"
        raise InputError(message)
    with in_range("a harmonic of force"):
        x, y = (_harmonics(first, step, vectors[..., k], count, "force") for k in (0, 1))
        return _rotating(x, y)


def _rotating(x: Harmonics, y: Harmonics) -> RotatingParts:
    # (cosine − i sine)/2 turns forward, its conjugate backward; y counts i times.
    ahead = x.cosine + y.sine, y.cosine - x.sine
    back = x.cosine - y.sine, y.cosine + x.sine
    for part in back:
        part[..., 0] = 0.0
    forward = 0.5 * _size(*ahead)
    forward[..., 0] *= 2.0
    return RotatingParts(
        forward,
        _trig.arctan2(ahead[1], ahead[0]),
        0.5 * _size(*back),
        _trig.arctan2(back[1], back[0]),
    )


def _size(x: Float, y: Float) -> Float:
    size: Float = np.sqrt(x * x + y * y)
    return size


def _turn(q: npt.ArrayLike, count: int) -> tuple[float, float, int]:
    """Return the start, the direction and the number of positions of a turn in even steps."""
    whole_number(count, "count", 0)
    x = finite_array(q, "q")
    if x.ndim != 1 or x.size == 0:
        message = f"q has the shape {x.shape}: a list of coordinates of one turn is needed"
        raise InputError(message)
    n = x.size
    if n <= 2 * count:
        message = f"q has {n} coordinates: {count} harmonics need more than {2 * count}"
        raise InputError(message, value=float(n))
    step = math.tau / n if n == 1 or x[1] > x[0] else -math.tau / n
    off = np.abs(x - (x[0] + step * np.arange(n)))
    worst = int(np.argmax(off))
    if off[worst] > EVEN * (math.tau + abs(float(x[0]))):
        last = n > 1 and abs(abs(float(x[-1] - x[0])) - math.tau) <= EVEN * math.tau
        hint = "leave out its end" if last else "np.arange(N) * (2 * np.pi / N) is one"
        message = (
            f"q[{worst}] = {x[worst]:.15g} is not in a turn of {n} even steps from {x[0]:.15g}: "
            f"{hint}"
        )
        raise InputError(message, q=float(x[worst]), value=float(x[worst]))
    return float(x[0]), step, n


def _harmonics(first: float, step: float, series: Float, count: int, what: str) -> Harmonics:
    finite = np.asarray(np.isfinite(series).all(axis=-1))
    if not finite.any():
        wrong = series[~np.isfinite(series)]
        number = float(wrong.flat[0]) if wrong.size else math.nan
        message = f"{what} has {number}: a series of finite numbers is needed"
        raise InputError(message, value=number)
    known = np.where(finite[..., np.newaxis], series, 0.0)
    n = series.shape[-1]
    shape = (*series.shape[:-1], count + 1)
    cosine, sine = np.zeros(shape), np.zeros(shape)
    # Sines of exact fractions of a turn, then the turn's start: no large angles.
    table = _trig.sin_cos(np.arange(n) * (math.tau / n))
    for k in range(count + 1):
        row = k * np.arange(n) % n
        even, odd = ((known * part[row]).sum(axis=-1) * (2.0 / n) for part in reversed(table))
        odd = odd if step > 0.0 else -odd
        s, c = _trig.sin_cos(k * first)
        cosine[..., k], sine[..., k] = c * even - s * odd, s * even + c * odd
    cosine[..., 0] *= 0.5
    cosine[~finite], sine[~finite] = np.nan, np.nan
    return Harmonics(cosine, sine)
