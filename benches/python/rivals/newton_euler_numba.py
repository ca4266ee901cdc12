"""The nine equations of `newton_euler` in two loops, in parallel."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, TypeAlias

import numba
import numpy as np

from rivals.newton_euler import COUPLER, CRANK, FORCE, GRAVITY, ROCKER, SPEED

if TYPE_CHECKING:
    from subject import Float

Two: TypeAlias = tuple[float, float]
Four: TypeAlias = tuple[float, float, float, float]
# The column of a force, its sign, and where it acts.
Acting: TypeAlias = tuple[int, float, float, float]


@numba.njit(cache=True)
def balance(
    matrix: Float,
    right: Float,
    row: int,
    body: Four,
    at: Two,
    moving: Two,
    turning: Four,
    first: Acting,
    second: Acting,
) -> Two:
    """Write the three equations of a link, with a force at each of two places."""
    mass, inertia, along, across = body
    ex, ey, spin, rate = turning
    rx, ry = along * ex - across * ey, along * ey + across * ex
    gx, gy = at[0] + rx, at[1] + ry
    right[row] = mass * (moving[0] - rate * ry - spin * spin * rx)
    right[row + 1] = mass * (moving[1] + rate * rx - spin * spin * ry + GRAVITY)
    right[row + 2] = inertia * rate
    for column, sign, px, py in (first, second):
        matrix[row, column] = matrix[row + 1, column + 1] = sign
        matrix[row + 2, column] = -sign * (py - gy)
        matrix[row + 2, column + 1] = sign * (px - gx)
    return gx, gy


@numba.njit(parallel=True, cache=True)
def solve(lengths: Float, q: Float, forces: Float) -> None:
    """Forces and torque, (designs, positions, 9), of four-bars (open) at constant speed."""
    w = SPEED
    for k in numba.prange(lengths.shape[1]):
        a, b, c, g = lengths[0, k], lengths[1, k], lengths[2, k], lengths[3, k]
        matrix, right = np.zeros((9, 9)), np.zeros(9)
        for i in range(q.size):
            bx, by = a * math.cos(q[i]), a * math.sin(q[i])
            kx = g - bx
            r = 1.0 / (kx * kx + by * by)
            part = 0.5 + (0.5 * (b * b - c * c)) * r
            up = math.sqrt(b * b * r - part * part)
            u, v = part * kx + up * by, up * kx - part * by
            x, y = u - kx, v + by
            r = 1.0 / (v * x - u * y)
            n3, n4 = (bx * y - by * x) * r, (bx * v - by * u) * r
            fx, fy = x * n4 * n4 - u * n3 * n3 - bx, y * n4 * n4 - v * n3 * n3 - by
            m3, m4 = (fx * x + fy * y) * r, (fx * u + fy * v) * r
            cx, cy = bx + u, by + v
            matrix[:] = 0.0
            fixed, pin = (0.0, 0.0), (-w * w * bx, -w * w * by)
            turn1 = (bx / a, by / a, w, 0.0)
            turn2 = (u / b, v / b, w * n3, w * w * m3)
            turn3 = (x / c, y / c, w * n4, w * w * m4)
            on_a, on_b = (0, 1.0, 0.0, 0.0), (2, -1.0, bx, by)
            balance(matrix, right, 0, CRANK, fixed, fixed, turn1, on_a, on_b)
            matrix[2, 8] = 1.0
            on_b, on_c = (2, 1.0, bx, by), (4, -1.0, cx, cy)
            balance(matrix, right, 3, COUPLER, (bx, by), pin, turn2, on_b, on_c)
            on_c, on_d = (4, 1.0, cx, cy), (6, 1.0, g, 0.0)
            gx, gy = balance(matrix, right, 6, ROCKER, (g, 0.0), fixed, turn3, on_c, on_d)
            right[6] -= FORCE[0]
            right[7] -= FORCE[1]
            right[8] -= (cx - gx) * FORCE[1] - (cy - gy) * FORCE[0]
            forces[k, i] = np.linalg.solve(matrix, right)
