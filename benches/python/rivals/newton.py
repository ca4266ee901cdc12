"""P4's mechanism as a user would write it with numba: Newton's iteration on its closures."""

from __future__ import annotations

import math

import numpy as np
from numba import njit, prange

# Angles of 2-3-4, 3-6-5, 4-8 and 8-7-6 are the unknowns; each position starts from the line
# through the two before.
STEPS = 30
DONE = 2.0**-26


@njit(inline="always", error_model="numpy")
def _eliminate(m, r):  # noqa: C901 (written out, as for speed)
    """Gauss with partial pivoting, 4 × 4, in place."""
    for k in range(4):
        p = k
        for i in range(k + 1, 4):
            if abs(m[i, k]) > abs(m[p, k]):
                p = i
        if p != k:
            for j in range(4):
                m[k, j], m[p, j] = m[p, j], m[k, j]
            for n in range(r.shape[0]):
                r[n, k], r[n, p] = r[n, p], r[n, k]
        inv = 1.0 / m[k, k]
        for i in range(k + 1, 4):
            f = m[i, k] * inv
            for j in range(k + 1, 4):
                m[i, j] -= f * m[k, j]
            for n in range(r.shape[0]):
                r[n, i] -= f * r[n, k]
    for n in range(r.shape[0]):
        for k in range(3, -1, -1):
            s = r[n, k]
            for j in range(k + 1, 4):
                s -= m[k, j] * r[n, j]
            r[n, k] = s / m[k, k]


@njit(inline="always", error_model="numpy")
def _one(d, angles, phi, m, r, p, order, out):
    """Positions of joints 2 … 8, and analogues; -1 if it does not converge."""
    crank, l23, x4, y4, l36, x5, y5, l48, l87, x6, y6, l95, l107 = d[:13]
    x9, y9, x10, y10 = d[13:17]
    p2x, p2y = crank * math.cos(phi), crank * math.sin(phi)
    for _step in range(STEPS):
        ca, sa = math.cos(angles[0]), math.sin(angles[0])
        cb, sb = math.cos(angles[1]), math.sin(angles[1])
        cc, sc = math.cos(angles[2]), math.sin(angles[2])
        cd, sd = math.cos(angles[3]), math.sin(angles[3])
        a3x, a3y = l23 * ca, l23 * sa
        a4x, a4y = x4 * ca - y4 * sa, x4 * sa + y4 * ca
        b6x, b6y = l36 * cb, l36 * sb
        b5x, b5y = x5 * cb - y5 * sb, x5 * sb + y5 * cb
        c8x, c8y = l48 * cc, l48 * sc
        d7x, d7y = l87 * cd, l87 * sd
        d6x, d6y = x6 * cd - y6 * sd, x6 * sd + y6 * cd
        ux, uy = p2x + a3x + b5x - x9, p2y + a3y + b5y - y9
        vx, vy = p2x + a4x + c8x + d7x - x10, p2y + a4y + c8y + d7y - y10
        r[0, 0] = -(a4x + c8x + d6x - a3x - b6x)
        r[0, 1] = -(a4y + c8y + d6y - a3y - b6y)
        r[0, 2] = -0.5 * (ux * ux + uy * uy - l95 * l95)
        r[0, 3] = -0.5 * (vx * vx + vy * vy - l107 * l107)
        m[0, 0], m[0, 1], m[0, 2], m[0, 3] = a3y - a4y, b6y, -c8y, -d6y
        m[1, 0], m[1, 1], m[1, 2], m[1, 3] = a4x - a3x, -b6x, c8x, d6x
        m[2, 0], m[2, 1] = uy * a3x - ux * a3y, uy * b5x - ux * b5y
        m[2, 2], m[2, 3] = 0.0, 0.0
        m[3, 0], m[3, 1] = vy * a4x - vx * a4y, 0.0
        m[3, 2], m[3, 3] = vy * c8x - vx * c8y, vy * d7x - vx * d7y
        _eliminate(m, r[:1])
        most = 0.0
        for k in range(4):
            angles[k] += r[0, k]
            most = max(most, abs(r[0, k]))
        if most < DONE:
            break
    else:
        return -1
    ca, sa = math.cos(angles[0]), math.sin(angles[0])
    cb, sb = math.cos(angles[1]), math.sin(angles[1])
    cc, sc = math.cos(angles[2]), math.sin(angles[2])
    cd, sd = math.cos(angles[3]), math.sin(angles[3])
    a3x, a3y = l23 * ca, l23 * sa
    a4x, a4y = x4 * ca - y4 * sa, x4 * sa + y4 * ca
    b6x, b6y = l36 * cb, l36 * sb
    b5x, b5y = x5 * cb - y5 * sb, x5 * sb + y5 * cb
    c8x, c8y = l48 * cc, l48 * sc
    d7x, d7y = l87 * cd, l87 * sd
    d6x, d6y = x6 * cd - y6 * sd, x6 * sd + y6 * cd
    out[0, 0], out[0, 1] = p2x, p2y
    out[1, 0], out[1, 1] = p2x + a3x, p2y + a3y
    out[2, 0], out[2, 1] = p2x + a4x, p2y + a4y
    out[3, 0], out[3, 1] = out[1, 0] + b5x, out[1, 1] + b5y
    out[4, 0], out[4, 1] = out[1, 0] + b6x, out[1, 1] + b6y
    out[6, 0], out[6, 1] = out[2, 0] + c8x, out[2, 1] + c8y
    out[5, 0], out[5, 1] = out[6, 0] + d7x, out[6, 1] + d7y
    if order == 0:
        return 0
    ux, uy = out[3, 0] - x9, out[3, 1] - y9
    vx, vy = out[5, 0] - x10, out[5, 1] - y10
    for k in range(1, 3):
        # Second analogues: what the first make of the arms, on the right-hand side.
        m[0, 0], m[0, 1], m[0, 2], m[0, 3] = a3y - a4y, b6y, -c8y, -d6y
        m[1, 0], m[1, 1], m[1, 2], m[1, 3] = a4x - a3x, -b6x, c8x, d6x
        m[2, 0], m[2, 1] = uy * a3x - ux * a3y, uy * b5x - ux * b5y
        m[2, 2], m[2, 3] = 0.0, 0.0
        m[3, 0], m[3, 1] = vy * a4x - vx * a4y, 0.0
        m[3, 2], m[3, 3] = vy * c8x - vx * c8y, vy * d7x - vx * d7y
        if k == 1:
            p2dx, p2dy = -p2y, p2x
            r[0, 0], r[0, 1] = 0.0, 0.0
            r[0, 2] = -(ux * p2dx + uy * p2dy)
            r[0, 3] = -(vx * p2dx + vy * p2dy)
            a2, b2, c2, d2 = 0.0, 0.0, 0.0, 0.0
        else:
            p2dx, p2dy = -p2x, -p2y
            a2, b2, c2, d2 = p[0] * p[0], p[1] * p[1], p[2] * p[2], p[3] * p[3]
            r[0, 0] = a4x * a2 + c8x * c2 + d6x * d2 - a3x * a2 - b6x * b2
            r[0, 1] = a4y * a2 + c8y * c2 + d6y * d2 - a3y * a2 - b6y * b2
            udx = out[7 + 3, 0]
            udy = out[7 + 3, 1]
            vdx = out[7 + 5, 0]
            vdy = out[7 + 5, 1]
            u2x, u2y = p2dx - a3x * a2 - b5x * b2, p2dy - a3y * a2 - b5y * b2
            v2x = p2dx - a4x * a2 - c8x * c2 - d7x * d2
            v2y = p2dy - a4y * a2 - c8y * c2 - d7y * d2
            r[0, 2] = -(ux * u2x + uy * u2y + udx * udx + udy * udy)
            r[0, 3] = -(vx * v2x + vy * v2y + vdx * vdx + vdy * vdy)
        _eliminate(m, r[:1])
        a1, b1, c1, d1 = r[0, 0], r[0, 1], r[0, 2], r[0, 3]
        p[0], p[1], p[2], p[3] = a1, b1, c1, d1
        o = 7 * k
        out[o, 0], out[o, 1] = p2dx, p2dy
        out[o + 1, 0] = p2dx - a3y * a1 - a3x * a2
        out[o + 1, 1] = p2dy + a3x * a1 - a3y * a2
        out[o + 2, 0] = p2dx - a4y * a1 - a4x * a2
        out[o + 2, 1] = p2dy + a4x * a1 - a4y * a2
        out[o + 3, 0] = out[o + 1, 0] - b5y * b1 - b5x * b2
        out[o + 3, 1] = out[o + 1, 1] + b5x * b1 - b5y * b2
        out[o + 4, 0] = out[o + 1, 0] - b6y * b1 - b6x * b2
        out[o + 4, 1] = out[o + 1, 1] + b6x * b1 - b6y * b2
        out[o + 6, 0] = out[o + 2, 0] - c8y * c1 - c8x * c2
        out[o + 6, 1] = out[o + 2, 1] + c8x * c1 - c8y * c2
        out[o + 5, 0] = out[o + 6, 0] - d7y * d1 - d7x * d2
        out[o + 5, 1] = out[o + 6, 1] + d7x * d1 - d7y * d2
    return 0


def _sweep(dimensions, start, q, order, out):
    """All designs (n, 17), from angles (4,), at q (m,): out is (n, m, 7 · (order + 1), 2)."""
    for i in prange(dimensions.shape[0]):
        m, r, p = np.empty((4, 4)), np.empty((1, 4)), np.empty(4)
        angles, last, next_ = start.copy(), start.copy(), start.copy()
        for j in range(q.shape[0]):
            for k in range(4):
                next_[k] = angles[k] if j < 2 else 2.0 * angles[k] - last[k]
                last[k] = angles[k]
                angles[k] = next_[k]
            if _one(dimensions[i], angles, q[j], m, r, p, order, out[i, j]) < 0:
                out[i, j:] = np.nan
                break


sweep = njit(parallel=True, error_model="numpy", cache=True)(_sweep)
