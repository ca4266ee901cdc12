"""What a specialist writes with numba for one linkage: formulas fused by hand, no checks.

Every position of every design is computed, whether or not it can be reached (NaN), in parallel over
designs. Arc tangents are polynomials, so that the loops become vector instructions.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

import numba
import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from collections.abc import Callable

Float: TypeAlias = npt.NDArray[np.float64]

# (atan t − t) / t³ in t², 0 ≤ t ≤ 1, interpolated at Chebyshev's points: error 2.3e-14 rad.
ATAN = (
    -0.33333333333329, 0.19999999997779172, -0.1428571409522137, 0.11111104602822058,
    -0.09090791339508106, 0.07691006729583115, -0.06657116451458922, 0.05833142255809476,
    -0.05078238405735279, 0.04240573497965025, -0.03218975296582265, 0.02078811760821038,
    -0.010605869455534812, 0.003912875889690956, -0.0009141195416721525, 0.00010057727553740323,
)  # fmt: skip


def compiled(function: Callable[..., Any]) -> Any:
    """Compile with everything that a specialist turns on."""
    jit: Callable[..., Any] = numba.njit(
        parallel=True, fastmath=True, error_model="numpy", cache=True
    )
    return jit(function)


@numba.njit(fastmath=True, inline="always")
def atan2(y: float, x: float) -> float:
    """Arc tangent without branches."""
    ax, ay = abs(x), abs(y)
    t = min(ax, ay) / max(ax, ay)
    z = t * t
    p = ATAN[15]
    p = p * z + ATAN[14]
    p = p * z + ATAN[13]
    p = p * z + ATAN[12]
    p = p * z + ATAN[11]
    p = p * z + ATAN[10]
    p = p * z + ATAN[9]
    p = p * z + ATAN[8]
    p = p * z + ATAN[7]
    p = p * z + ATAN[6]
    p = p * z + ATAN[5]
    p = p * z + ATAN[4]
    p = p * z + ATAN[3]
    p = p * z + ATAN[2]
    p = p * z + ATAN[1]
    p = p * z + ATAN[0]
    a = t + t * z * p
    a = np.pi / 2 - a if ay > ax else a
    a = np.pi - a if x < 0.0 else a
    return -a if y < 0.0 else a


@compiled
def four_bar_point(lengths: Float, point: Float, cos: Float, sin: Float, out: Float) -> None:
    """Coupler point (x, y) of four-bars: crank, coupler, rocker, ground; the open assembly."""
    for d in numba.prange(lengths.shape[1]):
        a, b, c, g = lengths[0, d], lengths[1, d], lengths[2, d], lengths[3, d]
        px, py = point[0, d] / b, point[1, d] / b
        less, more, split = (b - c) ** 2, (b + c) ** 2, (b - c) * (b + c)
        for i in range(cos.size):
            bx, by = a * cos[i], a * sin[i]
            kx, ky = g - bx, -by
            d2 = kx * kx + ky * ky
            half = 0.5 / d2
            x, y = (d2 + split) * half, np.sqrt((d2 - less) * (more - d2)) * half
            ux, uy = kx * x - ky * y, ky * x + kx * y
            out[d, i, 0] = bx + ux * px - uy * py
            out[d, i, 1] = by + uy * px + ux * py


@compiled
def stephenson_point(
    lengths: Float, point: Float, second: Float, tip: Float, cos: Float, sin: Float, out: Float
) -> None:
    """A point of the fifth link of Stephenson III six-bars, driven at the four-bar's crank.

    second: lengths of links 5 and 6, and (x, y) of the fixed pivot of link 6.
    """
    for d in numba.prange(lengths.shape[1]):
        a, b, c, g = lengths[0, d], lengths[1, d], lengths[2, d], lengths[3, d]
        px, py = point[0, d] / b, point[1, d] / b
        less, more, split = (b - c) ** 2, (b + c) ** 2, (b - c) * (b + c)
        e, f, ex, ey = second[0, d], second[1, d], second[2, d], second[3, d]
        tx, ty = tip[0, d] / e, tip[1, d] / e
        less2, more2, split2 = (e - f) ** 2, (e + f) ** 2, (e - f) * (e + f)
        for i in range(cos.size):
            bx, by = a * cos[i], a * sin[i]
            kx, ky = g - bx, -by
            d2 = kx * kx + ky * ky
            half = 0.5 / d2
            x, y = (d2 + split) * half, np.sqrt((d2 - less) * (more - d2)) * half
            ux, uy = kx * x - ky * y, ky * x + kx * y
            sx, sy = bx + ux * px - uy * py, by + uy * px + ux * py
            kx, ky = ex - sx, ey - sy
            d2 = kx * kx + ky * ky
            half = 0.5 / d2
            x, y = (d2 + split2) * half, np.sqrt((d2 - less2) * (more2 - d2)) * half
            ux, uy = kx * x - ky * y, ky * x + kx * y
            out[d, i, 0] = sx + ux * tx - uy * ty
            out[d, i, 1] = sy + uy * tx + ux * ty


@compiled
def slider_crank(lengths: Float, cos: Float, sin: Float, slide: Any, rod: Any) -> None:
    """Slide and rod angle with two analogues each, of slider-cranks: crank, rod, offset."""
    for d in numba.prange(lengths.shape[1]):
        a, b, e = lengths[0, d], lengths[1, d], lengths[2, d]
        for i in range(cos.size):
            bx, by = a * cos[i], a * sin[i]
            y = e - by
            x = np.sqrt((b - y) * (b + y))
            per = 1.0 / x
            w = -bx * per
            v = (y * w * w + by) * per
            slide[0][d, i] = bx + x
            slide[1][d, i] = -by - y * w
            slide[2][d, i] = -bx - x * w * w - y * v
            rod[0][d, i] = atan2(y, x)
            rod[1][d, i] = w
            rod[2][d, i] = v


@compiled
def four_bar(lengths: Float, cos: Float, sin: Float, coupler: Any, rocker: Any) -> None:
    """Coupler and rocker angle with two analogues each, of four-bars; the open assembly."""
    for d in numba.prange(lengths.shape[1]):
        a, b, c, g = lengths[0, d], lengths[1, d], lengths[2, d], lengths[3, d]
        less, more, split = (b - c) ** 2, (b + c) ** 2, (b - c) * (b + c)
        for i in range(cos.size):
            bx, by = a * cos[i], a * sin[i]
            kx, ky = g - bx, -by
            d2 = kx * kx + ky * ky
            root = np.sqrt((d2 - less) * (more - d2))
            h = 1.0 / (d2 * root)
            half = 0.5 * root * h
            x, y = (d2 + split) * half, root * half
            ux, uy = kx * x - ky * y, ky * x + kx * y
            vx, vy = ux - kx, uy - ky
            per = 2.0 * d2 * h  # 1 / (u × v)
            w = (by * vx - bx * vy) * per
            z = (by * ux - bx * uy) * per
            kx = -bx - ux * w * w + vx * z * z
            ky = -by - uy * w * w + vy * z * z
            coupler[0][d, i] = atan2(uy, ux)
            coupler[1][d, i] = w
            coupler[2][d, i] = -(vx * kx + vy * ky) * per
            rocker[0][d, i] = atan2(vy, vx)
            rocker[1][d, i] = z
            rocker[2][d, i] = -(ux * kx + uy * ky) * per


@compiled
def chain_tip(
    crank: Float, start: Float, feet: Float, lengths: Float, cos: Float, sin: Float, out: Float
) -> None:
    """Last joint (x, y) of chains of dyads: to the right and to the left in turns.

    feet: fixed pivot of each rocker; lengths: of its coupler and of the rocker itself. A dyad at a
    time over all positions, which stay in the cache.
    """
    n = cos.size
    for d in numba.prange(crank.size):
        cx, cy = np.empty(n), np.empty(n)
        for i in range(n):
            cx[i], cy[i] = start[0] + crank[d] * cos[i], start[1] + crank[d] * sin[i]
        for k in range(feet.shape[0]):
            a, b = lengths[k, 0], lengths[k, 1]
            less, more, split = (a - b) ** 2, (a + b) ** 2, (a - b) * (a + b)
            side = lengths[k, 2]
            for i in range(n):
                kx, ky = feet[k, 0] - cx[i], feet[k, 1] - cy[i]
                d2 = kx * kx + ky * ky
                half = 0.5 / d2
                x, y = (d2 + split) * half, side * np.sqrt((d2 - less) * (more - d2)) * half
                cx[i], cy[i] = cx[i] + kx * x - ky * y, cy[i] + ky * x + kx * y
        for i in range(n):
            out[d, i, 0], out[d, i, 1] = cx[i], cy[i]


@compiled
def transmission_and_span(lengths: Float, cos: Float, sin: Float, out: Float) -> None:
    """Least transmission angle and span of the rocker of four-bars that turn; NaN for others."""
    for d in numba.prange(lengths.shape[1]):
        a, b, c, g = lengths[0, d], lengths[1, d], lengths[2, d], lengths[3, d]
        out[0, d] = out[1, d] = np.nan
        # The diagonal is shortest and longest on the line of the pivots.
        if g + a > b + c or abs(g - a) < abs(b - c):
            continue
        worst = 0.0
        low = high = last = 0.0
        for i in range(cos.size):
            bx, by = a * cos[i], a * sin[i]
            kx, ky = g - bx, -by
            d2 = kx * kx + ky * ky
            cosine = (b * b + c * c - d2) / (2.0 * b * c)
            worst = max(worst, abs(cosine))
            half = 0.5 / d2
            x = (d2 + (b - c) * (b + c)) * half
            y = np.sqrt(max(b * b / d2 - x * x, 0.0))
            angle = np.arctan2(by + ky * x + kx * y, bx + kx * x - ky * y - g)
            if i == 0:
                low = high = last = angle
            angle -= 2.0 * np.pi * np.round((angle - last) / (2.0 * np.pi))
            last = angle
            low, high = min(low, angle), max(high, angle)
        out[0, d] = np.arccos(min(worst, 1.0))
        out[1, d] = high - low


@compiled
def rocker(lengths: Float, cos: Float, sin: Float, out: Float) -> None:
    """Rocker angle of four-bars; the open assembly."""
    for d in numba.prange(lengths.shape[1]):
        a, b, c, g = lengths[0, d], lengths[1, d], lengths[2, d], lengths[3, d]
        less, more, split = (b - c) ** 2, (b + c) ** 2, (b - c) * (b + c)
        for i in range(cos.size):
            bx, by = a * cos[i], a * sin[i]
            kx, ky = g - bx, -by
            d2 = kx * kx + ky * ky
            half = 0.5 / d2
            x, y = (d2 + split) * half, np.sqrt((d2 - less) * (more - d2)) * half
            out[d, i] = atan2(ky * x + kx * y - ky, kx * x - ky * y - kx)


# For one design, where threads would cost more than they gain.
four_bar_alone = numba.njit(fastmath=True, error_model="numpy")(four_bar.py_func)


@numba.njit(parallel=True, cache=True)
def arithmetic(sums: Float) -> None:
    """Nothing but multiplications and additions, each waiting for the last: what a thread gains."""
    for i in numba.prange(sums.size):
        x = sums[i]
        for _ in range(10_000):
            x = x * 0.999 + 0.001
        sums[i] = x
