"""Input laws: how a driver moves over time from one coordinate to another.

Each is a motion from `start` to `end` within `duration`, at rest before and after. With x from 0 to
1 the part of the time, s(x) from 0 to 1 is the part of the way [1]_.

References
----------
.. [1] Norton, R. L., Cam Design and Manufacturing Handbook, 2nd ed., Industrial Press 2009, ch. 3.
"""

from __future__ import annotations

import itertools
import math
from abc import ABC, abstractmethod
from dataclasses import KW_ONLY, dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import Float, real_array, require_finite, short
from assur._by_value import ByValue
from assur._core import spline_pieces
from assur._other_names import refuse_attribute
from assur._splines import SPLINES, Spline
from assur._summary import typed
from assur._trig import sin_cos
from assur._validate import one_of, real_number, require_rows
from assur.errors import InputError

if TYPE_CHECKING:
    import numpy.typing as npt

__all__ = [
    "Cycloidal",
    "Harmonic",
    "Law",
    "ModifiedSine",
    "Polynomial345",
    "Polynomial4567",
    "Sequence",
    "Tabulated",
    "Trapezoidal",
    "Uniform",
]

# Shortest and longest duration, s: its cube divides the jerk.
SHORTEST, LONGEST = 1e-50, 1e100

# The part of the way and its first three derivatives by the part of the time.
Jet = tuple[Float, Float, Float, Float]


class Law(ABC):
    """A coordinate over time.

    Examples
    --------
    >>> import assur
    >>> assur.laws.Cycloidal(0.0, 1.0, duration=2.0).span  # s
    (0.0, 2.0)
    """

    @abstractmethod
    def at(self, t: npt.ArrayLike) -> tuple[Float, Float, Float, Float]:
        """Return the coordinate, its speed, acceleration and jerk at times, s.

        Parameters
        ----------
        t : array_like
            Times, s.

        Returns
        -------
        q, speed, acceleration, jerk : ndarray
            Each of the shape of t: rad or m, and so on per s.

        Examples
        --------
        >>> import assur
        >>> law = assur.laws.Uniform(0.0, 3.0, duration=2.0)
        >>> q, speed, acceleration, jerk = law.at([0.5, 1.0])
        >>> q, speed  # rad, rad/s
        (array([0.75, 1.5 ]), array([1.5, 1.5]))
        """

    @property
    @abstractmethod
    def span(self) -> tuple[float, float]:
        """When it begins and ends, s."""


@dataclass(frozen=True)
class Rise(Law):
    """A motion from rest to rest.

    Parameters
    ----------
    start, end : float
        Coordinates, rad or m.
    duration : float
        Time that it takes, s.
    begin : float
        Time at which it begins, s.
    """

    start: float
    end: float
    duration: float
    _: KW_ONLY
    begin: float = 0.0

    def __post_init__(self) -> None:
        for name in ("start", "end", "duration", "begin"):
            value = real_number(getattr(self, name), name)
            if not math.isfinite(value) or (name == "duration" and value <= 0.0):
                kind = "a positive number" if name == "duration" else "a finite number"
                message = f"{type(self).__name__}: {name} is {value!r}: {kind} is needed"
                raise InputError(message, value=value)
            object.__setattr__(self, name, value)
        if self.duration < SHORTEST:
            message = (
                f"{type(self).__name__}: duration is {self.duration!r} s: at least {SHORTEST:g} s "
                "is needed, else the jerk is beyond the greatest number"
            )
            raise InputError(message, value=self.duration)
        if self.duration > LONGEST:
            message = (
                f"{type(self).__name__}: duration is {self.duration!r} s: at most {LONGEST:g} s"
            )
            raise InputError(message, value=self.duration)

    @property
    def span(self) -> tuple[float, float]:
        """When it begins and ends, s."""
        return self.begin, self.begin + self.duration

    def at(self, t: npt.ArrayLike) -> tuple[Float, Float, Float, Float]:
        """Return the coordinate, its speed, acceleration and jerk at times, s.

        Before the beginning and after the end it is at rest.

        Parameters
        ----------
        t : array_like
            Times, s.

        Returns
        -------
        q, speed, acceleration, jerk : ndarray
            Each of the shape of t: rad or m, and so on per s.
        """
        times = _times(t)
        part = (times - self.begin) / self.duration
        x = np.clip(part, 0.0, 1.0)
        # At both ends the derivatives are those within.
        moves = (part >= 0.0) & (part <= 1.0)
        way = self.end - self.start
        s, *rates = self._jet(x)
        derivatives = [self.start + way * s]
        for order, rate in enumerate(rates, start=1):
            derivatives.append(np.where(moves, way / self.duration**order * rate, 0.0))
        return derivatives[0], derivatives[1], derivatives[2], derivatives[3]

    @abstractmethod
    def _jet(self, x: Float) -> Jet: ...


def _times(t: npt.ArrayLike) -> Float:
    times = real_array(t, "t")
    if not np.isfinite(times).all():
        message = "t: finite times are needed"
        raise InputError(message)
    return times


class Uniform(Rise):
    """A constant speed, with a jump of it at both ends.

    Parameters
    ----------
    start, end : float
        Coordinates, rad or m.
    duration : float
        Time that it takes, s.
    begin : float
        Time at which it begins, s.

    Examples
    --------
    >>> import assur
    >>> [float(one) for one in assur.laws.Uniform(0.0, 2.0, 4.0).at(1.0)]
    [0.5, 0.5, 0.0, 0.0]
    """

    def _jet(self, x: Float) -> Jet:
        zero = np.zeros_like(x)
        return x, zero + 1.0, zero, zero


class Harmonic(Rise):
    """Simple harmonic: s = (1 − cos πx)/2; the acceleration jumps at both ends.

    Parameters
    ----------
    start, end : float
        Coordinates, rad or m.
    duration : float
        Time that it takes, s.
    begin : float
        Time at which it begins, s.

    Examples
    --------
    >>> import assur
    >>> float(assur.laws.Harmonic(0.0, 1.0, 1.0).at(0.5)[0].round(12))
    0.5
    """

    def _jet(self, x: Float) -> Jet:
        sine, cosine = sin_cos(math.pi * x)
        half = 0.5 * math.pi
        return 0.5 - 0.5 * cosine, half * sine, math.pi * half * cosine, -(math.pi**2) * half * sine


class Cycloidal(Rise):
    """s = x − sin(2πx)/2π: the acceleration begins and ends at 0.

    Parameters
    ----------
    start, end : float
        Coordinates, rad or m.
    duration : float
        Time that it takes, s.
    begin : float
        Time at which it begins, s.

    Examples
    --------
    >>> import assur
    >>> law = assur.laws.Cycloidal(0.0, 1.0, duration=2.0)
    >>> [round(float(one), 6) for one in law.at(0.5)]
    [0.090845, 0.5, 1.570796, 0.0]
    """

    def _jet(self, x: Float) -> Jet:
        turn = 2.0 * math.pi
        sine, cosine = sin_cos(turn * x)
        return x - sine / turn, 1.0 - cosine, turn * sine, turn**2 * cosine


class _Polynomial(Rise):
    """A polynomial in x, by its coefficients, the highest first."""

    _coefficients: tuple[float, ...] = ()

    def _jet(self, x: Float) -> Jet:
        coefficients = np.array(self._coefficients)
        derivatives = []
        for _ in range(4):
            value = np.zeros_like(x)
            for coefficient in coefficients:
                value = value * x + coefficient
            derivatives.append(value)
            coefficients = coefficients[:-1] * np.arange(len(coefficients) - 1, 0, -1)
        return derivatives[0], derivatives[1], derivatives[2], derivatives[3]


class Polynomial345(_Polynomial):
    """s = 10x³ − 15x⁴ + 6x⁵: the acceleration begins and ends at 0.

    Parameters
    ----------
    start, end : float
        Coordinates, rad or m.
    duration : float
        Time that it takes, s.
    begin : float
        Time at which it begins, s.

    Examples
    --------
    >>> import assur
    >>> float(assur.laws.Polynomial345(0.0, 1.0, 1.0).at(0.5)[1])
    1.875
    """

    _coefficients = (6.0, -15.0, 10.0, 0.0, 0.0, 0.0)


class Polynomial4567(_Polynomial):
    """s = 35x⁴ − 84x⁵ + 70x⁶ − 20x⁷: the jerk too begins and ends at 0.

    Parameters
    ----------
    start, end : float
        Coordinates, rad or m.
    duration : float
        Time that it takes, s.
    begin : float
        Time at which it begins, s.

    Examples
    --------
    >>> import assur
    >>> float(assur.laws.Polynomial4567(0.0, 1.0, 1.0).at(0.5)[1])
    2.1875
    """

    _coefficients = (-20.0, 70.0, -84.0, 35.0, 0.0, 0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Trapezoidal(Rise):
    """A trapezoid of the speed: constant acceleration, constant speed, constant deceleration.

    Parameters
    ----------
    start, end, duration, begin
        As of every law.
    ramp : float
        Part of the time of each ramp, above 0 and at most 0.5.

    Examples
    --------
    >>> import assur
    >>> float(assur.laws.Trapezoidal(0.0, 1.0, 1.0, ramp=0.25).at(0.5)[1].round(12))
    1.333333333333
    """

    _: KW_ONLY
    ramp: float = 1.0 / 3.0

    def __post_init__(self) -> None:
        super().__post_init__()
        ramp = real_number(self.ramp, "ramp")
        if not 0.0 < ramp <= 0.5:
            message = f"Trapezoidal: ramp is {ramp!r}: a part above 0 and at most 0.5 is needed"
            raise InputError(message, value=ramp)

    def _jet(self, x: Float) -> Jet:
        ramp, zero = self.ramp, np.zeros_like(x)
        speed = 1.0 / (1.0 - ramp)
        left = 1.0 - x
        first, last = x < ramp, left < ramp
        way = np.where(
            first,
            0.5 * speed / ramp * x * x,
            np.where(last, 1.0 - 0.5 * speed / ramp * left * left, speed * (x - 0.5 * ramp)),
        )
        rate = speed * np.minimum(1.0, np.minimum(x, left) / ramp)
        second = np.where(first, speed / ramp, np.where(last, -speed / ramp, 0.0))
        return way, rate, second, zero


class ModifiedSine(Rise):
    """An acceleration of sines of two frequencies, joined at an eighth of the time from both ends.

    The greatest acceleration is 4π²/(4 + π) = 5.528, the greatest speed 4π/(4 + π) = 1.760.

    Parameters
    ----------
    start, end : float
        Coordinates, rad or m.
    duration : float
        Time that it takes, s.
    begin : float
        Time at which it begins, s.

    Examples
    --------
    >>> import assur
    >>> float(assur.laws.ModifiedSine(0.0, 1.0, 1.0).at(0.125)[2].round(6))
    5.527957
    """

    def _jet(self, x: Float) -> Jet:
        pi = math.pi
        inside = (x > 0.125) & (x < 0.875)
        # Inside, the frequency is a third of that at both ends.
        slower = np.where(inside, 3.0, 1.0)
        sine, cosine = sin_cos((4.0 * pi * x + np.where(inside, pi, 0.0)) / slower)
        unit = 1.0 / (4.0 + pi)
        base = np.where(inside, 2.0, np.where(x >= 0.875, 4.0, 0.0))
        way = unit * (base + pi * x - 0.25 * slower**2 * sine)
        rate = unit * pi * (1.0 - slower * cosine)
        second = unit * 4.0 * pi**2 * sine
        third = unit * 16.0 * pi**3 / slower * cosine
        return way, rate, second, third


@dataclass(frozen=True, eq=False, init=False)
class Tabulated(ByValue, Law):
    """A coordinate given at times: a cubic spline through the points.

    Before the first point and after the last one it is at rest.

    Parameters
    ----------
    t : array_like
        Times, s, ascending, shape (N,).
    value : array_like
        Coordinates there, rad or m, shape (N,).
    spline : {"clamped", "natural", "not-a-knot", "periodic", "pchip", "linear"}
        How the curve ends: with "clamped" at rest, with the others the speed jumps there. "pchip"
        does not overshoot, but its acceleration jumps at every point; "linear" joins the points by
        straight lines.

    Examples
    --------
    >>> import assur
    >>> law = assur.laws.Tabulated([0.0, 1.0, 2.0], [0.0, 0.5, 1.0])
    >>> [round(float(one), 6) for one in law.at(1.0)]
    [0.5, 0.75, 0.0, -1.5]
    """

    __repr__ = typed

    t: Float
    value: Float
    spline: Spline
    _pieces: Float = field(repr=False, compare=False)

    def __init__(
        self, t: npt.ArrayLike, value: npt.ArrayLike, *, spline: Spline = "clamped"
    ) -> None:
        one_of(spline, SPLINES, "Tabulated spline")
        t, value = real_array(t, "Tabulated t"), real_array(value, "Tabulated value")
        if t.ndim != 1 or t.shape != value.shape:
            message = f"Tabulated: t has shape {t.shape}, value {value.shape}: two lists are needed"
            raise InputError(message)
        require_rows(t.size, 3 if spline == "periodic" else 2, "Tabulated: it")
        require_finite(t, "Tabulated t")
        require_finite(value, "Tabulated value")
        back = np.flatnonzero(np.diff(t) <= 0.0)
        if back.size:
            row = int(back[0]) + 1
            message = f"Tabulated: t[{row}] = {t[row]!s} is not above t[{row - 1}] = {t[row - 1]!s}"
            raise InputError(message, value=float(t[row]))
        with np.errstate(over="ignore", invalid="ignore"):
            pieces = spline_pieces(t, value, spline).reshape(-1, 4)
        if not np.isfinite(pieces).all():
            message = "Tabulated: the speed is beyond the greatest number: are times in seconds?"
            raise InputError(message)
        for column in (t, value, pieces):
            column.flags.writeable = False
        fields = {"t": t, "value": value, "spline": spline, "_pieces": pieces}
        for name, part in fields.items():
            object.__setattr__(self, name, part)

    def __reduce__(self) -> tuple[Any, ...]:
        return partial(type(self), spline=self.spline), (self.t, self.value)

    @property
    def span(self) -> tuple[float, float]:
        """When it begins and ends, s."""
        return float(self.t[0]), float(self.t[-1])

    def at(self, t: npt.ArrayLike) -> tuple[Float, Float, Float, Float]:
        """Return the coordinate, its speed, acceleration and jerk at times, s.

        Parameters
        ----------
        t : array_like
            Times, s.

        Returns
        -------
        q, speed, acceleration, jerk : ndarray
            Each of the shape of t: rad or m, and so on per s.
        """
        times = _times(t)
        first, last = self.span
        within = np.clip(times, first, last)
        piece = np.clip(np.searchsorted(self.t, within, side="right") - 1, 0, len(self.t) - 2)
        x = within - self.t[piece]
        a, b, c, d = (self._pieces[piece, k] for k in range(4))
        moves = (times >= first) & (times <= last)
        value = np.where(times >= last, self.value[-1], ((d * x + c) * x + b) * x + a)
        rates = ((3.0 * d * x + 2.0 * c) * x + b, 6.0 * d * x + 2.0 * c, 6.0 * d)
        speed, acceleration, jerk = (np.where(moves, rate, 0.0) for rate in rates)
        return value, speed, acceleration, jerk


@dataclass(frozen=True)
class Sequence(Law):
    """Laws one after another, with dwells where there is time between them.

    Parameters
    ----------
    laws : tuple of Law
        Ascending in time; each begins where the previous one ends.

    Examples
    --------
    Up, a dwell, and back:

    >>> import assur
    >>> up = assur.laws.Cycloidal(0.0, 1.0, 0.5)
    >>> down = assur.laws.Cycloidal(1.0, 0.0, 0.5, begin=1.0)
    >>> [round(float(assur.laws.Sequence((up, down)).at(t)[0]), 6) for t in (0.25, 0.7, 1.25)]
    [0.5, 1.0, 0.5]
    """

    __repr__ = typed

    laws: tuple[Law, ...]

    def __post_init__(self) -> None:
        listed: Any = self.laws
        laws = tuple(listed) if isinstance(listed, list | tuple) else ()
        if not laws or not all(isinstance(law, Law) for law in laws):
            message = f"Sequence: {short(listed)}: one law or more are needed, in a list"
            raise InputError(message)
        for law, following in itertools.pairwise(laws):
            if following.span[0] < law.span[1]:
                message = (
                    f"Sequence: a law begins at {following.span[0]:g} s, before {law.span[1]:g} s"
                )
                raise InputError(message)
            gap = float(following.at(following.span[0])[0] - law.at(law.span[1])[0])
            if abs(gap) > 1e-12 * (1.0 + abs(float(law.at(law.span[1])[0]))):
                message = f"Sequence: the coordinate jumps by {gap:g} at {following.span[0]:g} s"
                raise InputError(message, value=gap)
        object.__setattr__(self, "laws", laws)

    @property
    def span(self) -> tuple[float, float]:
        """When it begins and ends, s."""
        return self.laws[0].span[0], self.laws[-1].span[1]

    def at(self, t: npt.ArrayLike) -> tuple[Float, Float, Float, Float]:
        """Return the coordinate, its speed, acceleration and jerk at times, s.

        Parameters
        ----------
        t : array_like
            Times, s.

        Returns
        -------
        q, speed, acceleration, jerk : ndarray
            Each of the shape of t: rad or m, and so on per s.
        """
        times = _times(t)
        derivatives = [np.array(array) for array in self.laws[0].at(times)]
        for law in self.laws[1:]:
            here = times >= law.span[0]
            for earlier, later in zip(derivatives, law.at(times), strict=True):
                earlier[here] = later[here]
        return derivatives[0], derivatives[1], derivatives[2], derivatives[3]


if not TYPE_CHECKING:

    def __getattr__(name):
        other = {"Dwell": "laws.Sequence rests between its laws", "Rest": "laws.Sequence rests"}
        refuse_attribute(None, "'assur.laws'", name, other)

    def __dir__():
        return sorted(__all__)
