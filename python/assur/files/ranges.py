"""Evenly spaced coordinates."""

from __future__ import annotations

import math
from dataclasses import KW_ONLY, dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import finite_array, flag, real_number, short
from assur._validate import whole_number
from assur.dynamics.loads.table import replace_fields
from assur.errors import InputError
from assur.files.limits import MOST_POSITIONS

if TYPE_CHECKING:
    from assur._arrays import Float

__all__ = ["Range"]

# A last step of a range that misses its end by this fraction of a step is not left out.
ROUNDING = 1e-9


@dataclass(frozen=True)
class Range:
    """Evenly spaced coordinates; an argument wherever an array is one.

    Parameters
    ----------
    start, stop : float or tuple of float
        The ends, both included; with several drivers one number for each.
    step : float, optional
        The distance of two coordinates (one driver). Give either this or:
    count : int, optional
        Number of coordinates.
    endpoint : bool
        With `count`: whether `stop` is one of them.

    Examples
    --------
    >>> import assur
    >>> assur.files.Range(0.0, 90.0, step=30.0).values()
    array([ 0., 30., 60., 90.])
    >>> assur.files.Range(0.0, 360.0, count=4, endpoint=False).values()
    array([  0.,  90., 180., 270.])
    """

    start: float | tuple[float, ...]
    stop: float | tuple[float, ...]
    _: KW_ONLY
    step: float | None = None
    count: int | None = None
    endpoint: bool = True

    def __post_init__(self) -> None:
        count = self.count
        replace_fields(
            self,
            start=_ends(self.start, "start"),
            stop=_ends(self.stop, "stop"),
            step=None if self.step is None else real_number(self.step, "a range: step"),
            count=None
            if count is None
            else whole_number(count, "a range: count", 1, MOST_POSITIONS),
            endpoint=flag(self.endpoint, "a range: endpoint"),
        )
        if (self.step is None) == (count is None):
            message = "a range needs either step or count"
            raise InputError(message)
        if np.shape(self.start) != np.shape(self.stop):
            message = "a range needs the same number of numbers for start and stop"
            raise InputError(message)
        if self.step is not None and (np.shape(self.start) or not self.endpoint):
            message = "a range with several drivers, or without its end, needs count, not step"
            raise InputError(message)
        if not all(map(math.isfinite, self._lengths())):
            message = "a range from start to stop must have a finite length"
            raise InputError(message)
        if not self._size() <= MOST_POSITIONS:
            message = (
                f"a range must have from 1 to {MOST_POSITIONS} positions: its step must lead from "
                "start to stop"
            )
            raise InputError(message)

    def _lengths(self) -> list[float]:
        ends = np.atleast_1d(self.start).tolist(), np.atleast_1d(self.stop).tolist()
        return [stop - start for start, stop in zip(*ends, strict=True)]

    def _size(self) -> float:
        if self.count is not None:
            return self.count
        assert self.step is not None
        steps = self._lengths()[0] / self.step if self.step else math.inf
        return math.floor(steps + ROUNDING) + 1 if 0.0 <= steps < MOST_POSITIONS else math.inf

    def values(self) -> Float:
        """Return the coordinates.

        Returns
        -------
        ndarray
            (N,), or (N, n) of n drivers.

        Examples
        --------
        >>> import assur
        >>> assur.files.Range((0.0, 1.0), (1.0, 3.0), count=3).values()
        array([[0. , 1. ],
               [0.5, 2. ],
               [1. , 3. ]])
        """
        if self.count is not None:
            return np.linspace(self.start, self.stop, self.count, endpoint=self.endpoint)
        steps: Any = np.arange(self._size())
        return np.asarray(self.start + steps * self.step)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Float:
        return np.asarray(self.values(), dtype)


def _ends(value: Any, what: str) -> float | tuple[float, ...]:
    array = finite_array(value, f"a range: {what}")
    if array.ndim > 1:
        message = f"a range: {what} is {short(value)}: one number for each driver is needed"
        raise InputError(message)
    return tuple(array.tolist()) if array.ndim else float(array)
