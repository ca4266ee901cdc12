"""Extremes of a quantity along the driver's coordinate."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from assur._other_names import other_names
from assur._summary import summary

if TYPE_CHECKING:
    from assur._arrays import Number


@other_names(at="the place is q")
class Extreme(NamedTuple):
    """An extreme value and where it occurs.

    Attributes
    ----------
    value : float or array
        The value.
    q : float or array
        The driver's coordinate there, rad or m (of a slider-crank the crank's angle).

    Examples
    --------
    >>> import assur
    >>> assur.SliderCrank(1.0, 3.0).extremes("bore").max
    Extreme(value=4.0, q=0.0)
    """

    value: Number
    q: Number

    def __repr__(self) -> str:
        return summary(self)
