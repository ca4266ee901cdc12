"""Extremes of a quantity along the driver's coordinate."""

from __future__ import annotations

from typing import Any, NamedTuple


class Extreme(NamedTuple):
    """An extreme value and where it occurs.

    Attributes
    ----------
    at : float or array
        The driver's coordinate (of a slider-crank the crank's angle), rad.
    value : float or array
        The value there.

    Examples
    --------
    >>> import assur
    >>> assur.slider_crank.greatest_speed(3.0).at.round(6)  # rad
    np.float64(1.27715)
    """

    at: Any
    value: Any
