"""The core's trigonometry: the same bits on every platform, unlike NumPy's."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from assur import _core

if TYPE_CHECKING:
    from assur._arrays import Float


def sin_cos(angle: npt.ArrayLike) -> tuple[Float, Float]:
    """Return sines and cosines of angles in rad, in the shape of the angles."""
    angles = np.asarray(angle, float)
    sine, cosine = _core.sin_cos(np.ascontiguousarray(angles).reshape(-1))
    return sine.reshape(angles.shape), cosine.reshape(angles.shape)


def arctan2(y: npt.ArrayLike, x: npt.ArrayLike) -> Float:
    """Return the angles of points (x, y) in (−π, π]; the coordinates broadcast."""
    ys, xs = np.broadcast_arrays(np.asarray(y, float), np.asarray(x, float))
    flat = (np.ascontiguousarray(part).reshape(-1) for part in (ys, xs))
    return _core.atan2(*flat).reshape(ys.shape)
