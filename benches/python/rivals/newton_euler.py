"""Joint forces of four-bars as textbooks find them: nine equations at each position.

Unknown are the forces on the crank at A and on the coupler at B, on the rocker at C and D, and the
torque on the crank (R. L. Norton, *Design of Machinery*, on dynamic force analysis).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from rivals import closed_form

if TYPE_CHECKING:
    from subject import Float

SPEED = 10.0
GRAVITY = 9.81
# Mass, moment of inertia and centre (x, y), from the first joint along the link and to its left.
CRANK = (2.0, 0.1, 0.3, 0.1)
COUPLER = (3.0, 0.4, 1.4, -0.2)
ROCKER = (2.5, 0.3, 1.2, 0.15)
# On the rocker at C, N.
FORCE = (30.0, -50.0)


def solve(lengths: Float, q: Float) -> Float:
    """Forces and torque, (designs, positions, 9), of four-bars (open) at constant speed."""
    crank, coupler, rocker, ground = (row[:, None] for row in lengths)
    m = closed_form.vectors(crank, coupler, rocker, ground, q)
    w = SPEED
    shape = m.cx.shape
    matrix, right = np.zeros((*shape, 9, 9)), np.zeros((*shape, 9))
    none = np.zeros(shape)
    b = (m.bx, m.by)
    # Direction of each link, its speed and acceleration.
    turning = (
        (CRANK, (none, none), (none, none), m.bx / crank, m.by / crank, w, 0.0),
        (
            COUPLER,
            b,
            (-w * w * m.bx, -w * w * m.by),
            (m.cx - m.bx) / coupler,
            (m.cy - m.by) / coupler,
            w * m.coupler1,
            w * w * m.coupler2,
        ),
        (
            ROCKER,
            (ground + none, none),
            (none, none),
            (m.cx - ground) / rocker,
            m.cy / rocker,
            w * m.rocker1,
            w * w * m.rocker2,
        ),
    )
    # Which forces act on each link, with their sign, and where.
    a, c, d = (none, none), (m.cx, m.cy), (ground + none, none)
    acting = (
        ((0, 1.0, a), (1, -1.0, b)),
        ((1, 1.0, b), (2, -1.0, c)),
        ((2, 1.0, c), (3, 1.0, d)),
    )
    for link, (body, (x, y), moving, ex, ey, spin, rate) in enumerate(turning):
        mass, inertia, along, across = body
        rx, ry = along * ex - across * ey, along * ey + across * ex
        gx, gy = x + rx, y + ry
        ax = moving[0] - rate * ry - spin * spin * rx
        ay = moving[1] + rate * rx - spin * spin * ry
        row = 3 * link
        right[..., row], right[..., row + 1] = mass * ax, mass * (ay + GRAVITY)
        right[..., row + 2] = inertia * rate
        for force, sign, (px, py) in acting[link]:
            column = 2 * force
            matrix[..., row, column] = matrix[..., row + 1, column + 1] = sign
            matrix[..., row + 2, column] = -sign * (py - gy)
            matrix[..., row + 2, column + 1] = sign * (px - gx)
        if link == 0:
            matrix[..., row + 2, 8] = 1.0
        if link == 2:
            fx, fy = FORCE
            right[..., row] -= fx
            right[..., row + 1] -= fy
            right[..., row + 2] -= (m.cx - gx) * fy - (m.cy - gy) * fx
    return np.linalg.solve(matrix, right[..., None])[..., 0]
