"""Points of links without a joint there."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur._arrays import real_array
from assur._trig import sin_cos
from assur.errors import InputError
from assur.kinematics.quantity import Analogues

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur._arrays import Float
    from assur.kinematics.motion_model import MotionModel


def point_of(motion: MotionModel, link: str, local: npt.ArrayLike) -> Analogues:
    """See `Motion.point`."""
    at = real_array(local, "local")
    if at.shape[-1:] != (2,) or at.ndim > 2 or not np.isfinite(at).all():
        message = f"local is {local!r}: (x, y) in the frame of {link!r}, or a list of such, m"
        raise InputError(message)
    angle = motion.link(link)
    # The ground's frame is the drawing's, whichever joint is listed first.
    origin = None if link == "ground" else motion.reference_points[link]
    sine, cosine = sin_cos(angle.value)
    # For each point; axes: points, those of the motion, components.
    points = at.reshape(-1, 2)
    lead = (len(points), *(1,) * angle.value.ndim)
    x, y = points[:, 0].reshape(lead), points[:, 1].reshape(lead)
    arm = np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=-1)
    drivers = motion.driver_count
    # Even with one driver each order has an axis, which is dropped again.
    rates = [
        rate.reshape(angle.value.shape + (drivers,) * order)
        for order, rate in enumerate(angle.arrays)
    ]
    arrays = []
    for order in range(motion.order + 1):
        turned = _derivative(arm, rates, order)
        turned = turned.reshape(arm.shape + ((drivers,) * order if drivers > 1 else ()))
        whole = turned if origin is None else origin.arrays[order] + turned
        whole = whole if at.ndim == 2 else whole[0]
        whole.flags.writeable = False
        arrays.append(whole)
    return Analogues(f"point of {link}", tuple(arrays), drivers, point=True)


def _derivative(arm: Float, rates: list[Float], order: int) -> Float:
    """Differentiate an arm r that turns by t: each order adds an axis of the drivers.

    With one driver i t1 r, (i t2 - t1²) r, (i t3 - 3 t1 t2 - i t1³) r.
    """
    if order == 0:
        return arm
    left = np.stack([-arm[..., 1], arm[..., 0]], axis=-1)
    first = rates[1]
    if order == 1:
        return _outer(left, first, 1, 1)
    second = rates[2]
    squares = _outer(first, first, 1, 1)
    if order == 2:
        return _outer(left, second, 1, 2) - _outer(arm, squares, 1, 2)
    twice = _outer(second, first, 2, 1)
    mixed = twice + np.swapaxes(twice, -1, -2) + np.moveaxis(twice, -1, -3)
    cubes = _outer(squares, first, 2, 1)
    return _outer(left, rates[3] - cubes, 1, 3) - _outer(arm, mixed, 1, 3)


def _outer(left: Float, right: Float, of_one: int, of_other: int) -> Float:
    """Multiply every entry of the last axes of one by every entry of those of the other."""
    product: Float = (
        left[(..., *(None,) * of_other)]
        * right[(..., *(None,) * of_one, *(slice(None),) * of_other)]
    )
    return product
