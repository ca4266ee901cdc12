"""A mechanism of class III as a user would write it with numba: Newton's iteration, analogues."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numba
import numpy as np

if TYPE_CHECKING:
    from subject import Float

# Angles of rod and plate are the unknowns; both rockers keep their lengths. Each position starts
# from the line through the two before.
STEPS = 30
DONE = 2.0**-26


@numba.njit(parallel=True, error_model="numpy", cache=True)
def sweep(dimensions: Float, start: Float, q: Float, order: int, out: Float) -> None:
    """Joints B, C, D of all designs: out is (n, m, 3 · (order + 1), 2).

    dimensions: crank, rod, B to C, D in the plate's frame, both rockers, E, F.
    """
    for d in numba.prange(dimensions.shape[0]):
        crank, rod, bc, dx, dy, right, left = dimensions[d, :7]
        ex, ey, fx, fy = dimensions[d, 7:11]
        a0, b0, a1, b1 = start[0], start[1], start[0], start[1]
        for i in range(q.size):
            if i > 1:
                a0, b0, a1, b1 = 2.0 * a0 - a1, 2.0 * b0 - b1, a0, b0
            else:
                a1, b1 = a0, b0
            px, py = crank * math.cos(q[i]), crank * math.sin(q[i])
            moves = False
            for _ in range(STEPS):
                ax, ay = rod * math.cos(a0), rod * math.sin(a0)
                cb, sb = math.cos(b0), math.sin(b0)
                cx, cy = bc * cb, bc * sb
                tx, ty = dx * cb - dy * sb, dx * sb + dy * cb
                ux, uy = px + ax + cx - ex, py + ay + cy - ey
                vx, vy = px + ax + tx - fx, py + ay + ty - fy
                m00, m01 = uy * ax - ux * ay, uy * cx - ux * cy
                m10, m11 = vy * ax - vx * ay, vy * tx - vx * ty
                r0 = -0.5 * (ux * ux + uy * uy - right * right)
                r1 = -0.5 * (vx * vx + vy * vy - left * left)
                per = 1.0 / (m00 * m11 - m01 * m10)
                da, db = (r0 * m11 - r1 * m01) * per, (m00 * r1 - m10 * r0) * per
                a0 += da
                b0 += db
                if abs(da) < DONE and abs(db) < DONE:
                    moves = True
                    break
            if not moves:
                out[d, i:] = np.nan
                break
            ax, ay = rod * math.cos(a0), rod * math.sin(a0)
            cb, sb = math.cos(b0), math.sin(b0)
            cx, cy = bc * cb, bc * sb
            tx, ty = dx * cb - dy * sb, dx * sb + dy * cb
            out[d, i, 0, 0], out[d, i, 0, 1] = px + ax, py + ay
            out[d, i, 1, 0], out[d, i, 1, 1] = px + ax + cx, py + ay + cy
            out[d, i, 2, 0], out[d, i, 2, 1] = px + ax + tx, py + ay + ty
            if order == 0:
                continue
            ux, uy = px + ax + cx - ex, py + ay + cy - ey
            vx, vy = px + ax + tx - fx, py + ay + ty - fy
            m00, m01 = uy * ax - ux * ay, uy * cx - ux * cy
            m10, m11 = vy * ax - vx * ay, vy * tx - vx * ty
            per = 1.0 / (m00 * m11 - m01 * m10)
            r0, r1 = ux * py - uy * px, vx * py - vy * px
            wa, wb = (r0 * m11 - r1 * m01) * per, (m00 * r1 - m10 * r0) * per
            gx, gy = -py - wa * ay, px + wa * ax
            out[d, i, 3, 0], out[d, i, 3, 1] = gx, gy
            u1x, u1y = gx - wb * cy, gy + wb * cx
            v1x, v1y = gx - wb * ty, gy + wb * tx
            out[d, i, 4, 0], out[d, i, 4, 1] = u1x, u1y
            out[d, i, 5, 0], out[d, i, 5, 1] = v1x, v1y
            # What the first analogues make of the second, with the angles' own still zero.
            hx, hy = -px - wa * wa * ax, -py - wa * wa * ay
            u2x, u2y = hx - wb * wb * cx, hy - wb * wb * cy
            v2x, v2y = hx - wb * wb * tx, hy - wb * wb * ty
            r0 = -(ux * u2x + uy * u2y + u1x * u1x + u1y * u1y)
            r1 = -(vx * v2x + vy * v2y + v1x * v1x + v1y * v1y)
            za, zb = (r0 * m11 - r1 * m01) * per, (m00 * r1 - m10 * r0) * per
            gx, gy = -za * ay, za * ax
            out[d, i, 6, 0], out[d, i, 6, 1] = hx + gx, hy + gy
            out[d, i, 7, 0], out[d, i, 7, 1] = u2x + gx - zb * cy, u2y + gy + zb * cx
            out[d, i, 8, 0], out[d, i, 8, 1] = v2x + gx - zb * ty, v2y + gy + zb * tx
