"""A quantity along a motion: value, analogues, and velocities for given speeds."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from assur._arrays import Float, in_range, real_array
from assur._other_names import renamed_rates
from assur.errors import InputError

__all__ = ["Analogues"]


class Analogues:
    """A quantity and its analogues, the derivatives with respect to q.

    Arrays of shape S + (N,), points with a last axis of 2; with n drivers each
    order adds a last axis of n.

    Attributes
    ----------
    value, d1, d2, d3 : numpy.ndarray
        Value and analogues of orders 1 to 3, up to the order of the motion.

    Notes
    -----
    ``np.asarray`` of it is its value.

    Examples
    --------
    >>> import assur, numpy as np
    >>> pin = assur.FourBar(1.0, 3.0, 2.5, 3.0).solve([0.5, 1.0]).joint("C")
    >>> np.asarray(pin).shape, float(np.max(pin.d1) < 1.0)
    ((2, 2), 1.0)
    """

    __slots__ = ("_drivers", "_name", "_point", "arrays")

    def __init__(self, name: str, arrays: tuple[Float, ...], drivers: int, point: bool) -> None:
        self._name = name
        self.arrays = arrays
        self._drivers = drivers
        self._point = point

    def _order(self, order: int) -> Float:
        if order >= len(self.arrays):
            message = (
                f"{self._name!r}: this motion was solved to order {len(self.arrays) - 1}; "
                f"solve(q, order={order}) has d{order}"
            )
            raise InputError(message)
        return self.arrays[order]

    @property
    def value(self) -> Float:
        """The value: m, or rad for a link."""
        return self._order(0)

    @property
    def d1(self) -> Float:
        """First analogue (velocity analogue)."""
        return self._order(1)

    @property
    def d2(self) -> Float:
        """Second analogue (acceleration analogue)."""
        return self._order(2)

    @property
    def d3(self) -> Float:
        """Third analogue."""
        return self._order(3)

    def __array__(
        self, dtype: npt.DTypeLike | None = None, copy: bool | None = None
    ) -> npt.NDArray[Any]:
        return np.array(self.value, dtype=dtype, copy=copy)

    @renamed_rates
    def velocity(self, speed: npt.ArrayLike) -> Float:
        """Return the velocity for a driver's speed: ``d1 ω``.

        Parameters
        ----------
        speed : array_like
            dq/dt, rad/s or m/s; broadcasts against S + (N,). With n drivers the
            last axis is n.

        Returns
        -------
        numpy.ndarray
            m/s, or rad/s for a link; points with a last axis of 2. Further axes of the
            speed come before S + (N,).

        Examples
        --------
        >>> import assur
        >>> pin = assur.FourBar(1.0, 3.0, 2.5, 3.0).solve(1.0).joint("C")
        >>> pin.velocity([1.0, 2.0, 3.0]).shape
        (3, 2)
        """
        (w,) = self._speeds(speed=speed)
        with in_range("velocity"):
            return self._contract(self.d1, w)

    @renamed_rates
    def acceleration(self, speed: npt.ArrayLike, acceleration: npt.ArrayLike = 0.0) -> Float:
        """Return the acceleration for a driver's speed and acceleration: ``d2 ω² + d1 α``.

        Parameters
        ----------
        speed, acceleration : array_like
            Speed and acceleration of the driver, as for `velocity`: rad/s, rad/s² or m/s, m/s².

        Returns
        -------
        ndarray
            m/s² or rad/s².

        Examples
        --------
        At constant speed a crank's pin is drawn to the centre by r ω²:

        >>> import assur
        >>> pin = assur.SliderCrank(crank=0.1, rod=0.4).solve(0.0).joint("A")
        >>> pin.acceleration(speed=10.0)
        array([-10.,   0.])
        """
        w, a = self._speeds(speed=speed, acceleration=acceleration)
        with in_range("acceleration"):
            return self._contract(self.d2, w, w) + self._contract(self.d1, a)

    @renamed_rates
    def jerk(
        self, speed: npt.ArrayLike, acceleration: npt.ArrayLike = 0.0, jerk: npt.ArrayLike = 0.0
    ) -> Float:
        """Return the jerk: ``d3 ω³ + 3 d2 ω α + d1 β``, with β the driver's jerk.

        Parameters
        ----------
        speed, acceleration, jerk : array_like
            Speed, acceleration and jerk of the driver, as for `velocity`.

        Returns
        -------
        ndarray
            m/s³ or rad/s³.

        Examples
        --------
        >>> import assur
        >>> pin = assur.SliderCrank(crank=0.1, rod=0.4).solve(0.0, order=3).joint("A")
        >>> pin.jerk(speed=10.0)
        array([   0., -100.])
        """
        w, a, b = self._speeds(speed=speed, acceleration=acceleration, jerk=jerk)
        with in_range("jerk"):
            mixed = self._contract(self.d2, w, a)
            return self._contract(self.d3, w, w, w) + 3.0 * mixed + self._contract(self.d1, b)

    def _speeds(self, **given: npt.ArrayLike) -> list[Float]:
        """Return broadcastable arrays: axes of the motion, of a point, then of the drivers."""
        arrays = [self._drivers_last(value, name) for name, value in given.items()]
        shape = self.value.shape[:-1] if self._point else self.value.shape
        try:
            np.broadcast_shapes(shape, *(array.shape[:-1] for array in arrays))
        except ValueError as error:
            pairs = zip(given, arrays, strict=True)
            shapes = ", ".join(f"{name} {array.shape[:-1]}" for name, array in pairs)
            message = f"{shapes} does not broadcast to the motion's shape {shape}"
            raise InputError(message) from error
        return [array[..., np.newaxis, :] if self._point else array for array in arrays]

    def _drivers_last(self, value: npt.ArrayLike, name: str) -> Float:
        array = real_array(value, name)
        if self._drivers == 1:
            return array[..., np.newaxis]
        if array.ndim == 0 and array == 0.0:
            return np.zeros(self._drivers)
        if array.ndim == 0 or array.shape[-1] != self._drivers:
            message = (
                f"{name} has shape {array.shape}: the last axis must hold the "
                f"{self._drivers} drivers"
            )
            raise InputError(message)
        return array

    def _contract(self, derivative: Float, *speeds: Float) -> Float:
        array = derivative
        if self._drivers == 1:
            array = array.reshape(array.shape + (1,) * len(speeds))
        # Contract the last axis first. The axes of the remaining speeds stand before it; align
        # this speed with them.
        for to_come in range(len(speeds) - 1, -1, -1):
            speed = speeds[to_come]
            aligned = speed.reshape(speed.shape[:-1] + (1,) * to_come + speed.shape[-1:])
            array = (array * aligned).sum(axis=-1)
        return array

    def __repr__(self) -> str:
        return f"<{self._name}: shape {self.value.shape}, order {len(self.arrays) - 1}>"
