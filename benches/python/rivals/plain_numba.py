"""What most users write with numba: the textbook's formulas in two loops, in parallel."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numba

if TYPE_CHECKING:
    from subject import Float


@numba.njit(parallel=True, cache=True)
def four_bar(lengths: Float, q: Float, coupler: Any, rocker: Any) -> None:
    """Both angles with two analogues each, of four-bars (open)."""
    for d in numba.prange(lengths.shape[1]):
        a, b, c, g = lengths[0, d], lengths[1, d], lengths[2, d], lengths[3, d]
        for i in range(q.size):
            bx, by = a * math.cos(q[i]), a * math.sin(q[i])
            kx, ky = g - bx, -by
            k = math.sqrt(kx * kx + ky * ky)
            # The coupler's angle to the diagonal by the law of cosines.
            cosine = (b * b + k * k - c * c) / (2.0 * b * k)
            angle3 = math.atan2(ky, kx) + math.acos(cosine)
            cx, cy = bx + b * math.cos(angle3), by + b * math.sin(angle3)
            angle4 = math.atan2(cy, cx - g)
            w3 = a * math.sin(angle4 - q[i]) / (b * math.sin(angle3 - angle4))
            w4 = a * math.sin(q[i] - angle3) / (c * math.sin(angle4 - angle3))
            s3, c3, s4, c4 = math.sin(angle3), math.cos(angle3), math.sin(angle4), math.cos(angle4)
            fx = a * math.cos(q[i]) + b * w3 * w3 * c3 - c * w4 * w4 * c4
            fy = a * math.sin(q[i]) + b * w3 * w3 * s3 - c * w4 * w4 * s4
            sine = math.sin(angle4 - angle3)
            coupler[0][d, i], coupler[1][d, i] = angle3, w3
            coupler[2][d, i] = (fx * c4 + fy * s4) / (b * sine)
            rocker[0][d, i], rocker[1][d, i] = angle4, w4
            rocker[2][d, i] = (fx * c3 + fy * s3) / (c * sine)


@numba.njit(parallel=True, cache=True)
def slider_crank(lengths: Float, q: Float, slide: Any, rod: Any) -> None:
    """Slide and rod angle with two analogues each, of slider-cranks."""
    for d in numba.prange(lengths.shape[1]):
        a, b, e = lengths[0, d], lengths[1, d], lengths[2, d]
        for i in range(q.size):
            angle = math.asin((e - a * math.sin(q[i])) / b)
            w = -a * math.cos(q[i]) / (b * math.cos(angle))
            v = (a * math.sin(q[i]) + b * w * w * math.sin(angle)) / (b * math.cos(angle))
            slide[0][d, i] = a * math.cos(q[i]) + b * math.cos(angle)
            slide[1][d, i] = -a * math.sin(q[i]) - b * w * math.sin(angle)
            slide[2][d, i] = (
                -a * math.cos(q[i]) - b * w * w * math.cos(angle) - b * v * math.sin(angle)
            )
            rod[0][d, i], rod[1][d, i], rod[2][d, i] = angle, w, v


@numba.njit(parallel=True, error_model="numpy", cache=True)
def four_bar_point(lengths: Float, point: Float, q: Float, out: Float) -> None:
    """Coupler point of four-bars, NaN where they cannot be assembled (open)."""
    for d in numba.prange(lengths.shape[1]):
        a, b, c, g = lengths[0, d], lengths[1, d], lengths[2, d], lengths[3, d]
        reach, direction = (
            math.hypot(point[0, d], point[1, d]),
            math.atan2(point[1, d], point[0, d]),
        )
        for i in range(q.size):
            bx, by = a * math.cos(q[i]), a * math.sin(q[i])
            kx, ky = g - bx, -by
            k = math.sqrt(kx * kx + ky * ky)
            cosine = (b * b + k * k - c * c) / (2.0 * b * k)
            if abs(cosine) > 1.0:
                out[d, i, 0] = out[d, i, 1] = math.nan
                continue
            angle = math.atan2(ky, kx) + math.acos(cosine) + direction
            out[d, i, 0] = bx + reach * math.cos(angle)
            out[d, i, 1] = by + reach * math.sin(angle)


@numba.njit(parallel=True, error_model="numpy", cache=True)
def six_bar_point(
    lengths: Float, point: Float, second: Float, tip: Float, q: Float, out: Float
) -> None:
    """A point of the fifth link of Stephenson III six-bars, NaN where it does not exist."""
    for d in numba.prange(lengths.shape[1]):
        a, b, c, g = lengths[0, d], lengths[1, d], lengths[2, d], lengths[3, d]
        e, f, ex, ey = second[0, d], second[1, d], second[2, d], second[3, d]
        reach, direction = (
            math.hypot(point[0, d], point[1, d]),
            math.atan2(point[1, d], point[0, d]),
        )
        reach5, direction5 = math.hypot(tip[0, d], tip[1, d]), math.atan2(tip[1, d], tip[0, d])
        for i in range(q.size):
            out[d, i, 0] = out[d, i, 1] = math.nan
            bx, by = a * math.cos(q[i]), a * math.sin(q[i])
            kx, ky = g - bx, -by
            k = math.sqrt(kx * kx + ky * ky)
            cosine = (b * b + k * k - c * c) / (2.0 * b * k)
            if abs(cosine) > 1.0:
                continue
            angle = math.atan2(ky, kx) + math.acos(cosine) + direction
            px, py = bx + reach * math.cos(angle), by + reach * math.sin(angle)
            kx, ky = ex - px, ey - py
            k = math.sqrt(kx * kx + ky * ky)
            cosine = (e * e + k * k - f * f) / (2.0 * e * k)
            if abs(cosine) > 1.0:
                continue
            angle = math.atan2(ky, kx) + math.acos(cosine) + direction5
            out[d, i, 0] = px + reach5 * math.cos(angle)
            out[d, i, 1] = py + reach5 * math.sin(angle)
