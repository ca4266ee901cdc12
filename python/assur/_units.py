"""Numbers in other units."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from assur._arrays import as_number, real_array

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur._arrays import Number

__all__ = ["rpm"]


def rpm(turns: npt.ArrayLike) -> Number:
    """Return a speed that is given in revolutions a minute, rad/s.

    Parameters
    ----------
    turns : array_like
        Revolutions a minute.

    Returns
    -------
    float or ndarray
        The speed, rad/s.

    Raises
    ------
    InputError
        What is not a number.

    Examples
    --------
    >>> import assur, numpy as np
    >>> round(assur.rpm(1500), 3)
    157.08
    >>> assur.rpm([40, 60]).round(4)
    array([4.1888, 6.2832])
    """
    speed = real_array(turns, "rpm") * (math.pi / 30.0)
    return as_number(float(speed) if np.ndim(turns) == 0 else speed)
