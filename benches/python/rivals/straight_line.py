"""The search for a four-bar that draws a straight line, as a user writes it with numba.

Whole job: positions of the coupler point, least transmission angle, straightness over the best half
turn (the line of least squares, the greatest distance from it), a design at a time, with threads; a
design ends at its first gap or poor angle.
"""

from __future__ import annotations

import math
from typing import TypeAlias

import numba
import numpy as np
import numpy.typing as npt

Float: TypeAlias = npt.NDArray[np.float64]


@numba.njit(fastmath=True, cache=True)
def off_line(path: Float, count: int) -> float:
    """How far the straightest stretch of a closed path is from its line."""
    best = math.inf
    n = path.shape[0]
    for start in range(n):
        mx = my = 0.0
        for k in range(count):
            i = start + k if start + k < n else start + k - n
            mx += path[i, 0]
            my += path[i, 1]
        mx /= count
        my /= count
        xx = xy = yy = 0.0
        for k in range(count):
            i = start + k if start + k < n else start + k - n
            x, y = path[i, 0] - mx, path[i, 1] - my
            xx += x * x
            xy += x * y
            yy += y * y
        angle = 0.5 * math.atan2(2.0 * xy, xx - yy)
        c, s = math.cos(angle), math.sin(angle)
        most = 0.0
        for k in range(count):
            i = start + k if start + k < n else start + k - n
            most = max(most, abs(c * (path[i, 1] - my) - s * (path[i, 0] - mx)))
            if most >= best:
                break
        best = min(best, most)
    return best


@numba.njit(parallel=True, fastmath=True, error_model="numpy", cache=True)
def search(
    lengths: Float, point: Float, cos: Float, sin: Float, least_angle: float, off: Float
) -> None:
    """Crank, coupler, rocker, ground; the coupler point; the open assembly."""
    n = cos.size
    count = n // 2 + 1
    least = math.sin(least_angle)
    for d in numba.prange(lengths.shape[1]):
        a, b, c, g = lengths[0, d], lengths[1, d], lengths[2, d], lengths[3, d]
        px, py = point[0, d] / b, point[1, d] / b
        path = np.empty((n, 2))
        moves = True
        for i in range(n):
            bx, by = a * cos[i], a * sin[i]
            kx, ky = g - bx, -by
            d2 = kx * kx + ky * ky
            # The angle at C, by the law of cosines.
            cosine = (b * b + c * c - d2) / (2.0 * b * c)
            if not 1.0 - cosine * cosine > least * least:
                moves = False
                break
            x = (d2 + b * b - c * c) / (2.0 * d2)
            y = math.sqrt(b * b / d2 - x * x)
            ux, uy = kx * x - ky * y, ky * x + kx * y
            path[i, 0] = bx + ux * px - uy * py
            path[i, 1] = by + uy * px + ux * py
        off[d] = off_line(path, count) if moves else math.nan
