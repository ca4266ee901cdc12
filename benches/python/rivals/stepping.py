"""Slider-crank and five-bar by hand: accelerations in closed form, steps of Runge and Kutta.

The functions take any module with sin, cos and sqrt: NumPy, and JAX in `stepping_jax`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

GRAVITY = 9.81
# Slider-crank: crank, rod, inertia of the crank, mass and inertia of the rod with its centre in the
# rod's frame, mass of the piston. Weights pull along +x.
SLIDER = (0.1, 0.4, 0.5, 4.0, 0.05, (0.2, 0.01), 20.0)
# Five-bar: ground, left and right crank, left and right rod; each body has this mass and inertia,
# and its centre there in the frame of its link. Weights pull along −y.
FIVE = (1.0, 0.6, 0.6, 1.1, 1.1)
BODY = (1.0, 0.02, (0.2, 0.03))


def slider_crank(module: Any, q: Any, speed: Any, effort: Any) -> Any:
    """The acceleration of the crank."""
    r, rod, wheel, m, inertia, (along, across), piston = SLIDER
    s, c = module.sin(q), module.cos(q)
    sp = -(r / rod) * s
    cp = module.sqrt(1.0 - sp * sp)
    p1 = -r * c / (rod * cp)
    p2 = (r * s + rod * sp * p1 * p1) / (rod * cp)
    armx, army = along * cp - across * sp, along * sp + across * cp
    x1, y1 = -r * s - army * p1, r * c + armx * p1
    x2 = -r * c - army * p2 - armx * p1 * p1
    y2 = -r * s + armx * p2 - army * p1 * p1
    b1 = -r * s - rod * sp * p1
    b2 = -r * c - rod * (cp * p1 * p1 + sp * p2)
    mass = wheel + m * (x1 * x1 + y1 * y1) + inertia * p1 * p1 + piston * b1 * b1
    half = m * (x1 * x2 + y1 * y2) + inertia * p1 * p2 + piston * b1 * b2
    weight = GRAVITY * (m * x1 + piston * b1)
    return (effort + weight - half * speed * speed) / mass


def five_bar(module: Any, q: Any, speed: Any, effort: Any) -> Any:
    """The accelerations of both cranks; q, speed and effort are pairs."""
    ground, r, t, rod, other = FIVE
    (q1, q2), (v1, v2) = q, speed
    s1, c1, s2, c2 = module.sin(q1), module.cos(q1), module.sin(q2), module.cos(q2)
    kx, ky = ground + t * c2 - r * c1, t * s2 - r * s1
    d2 = kx * kx + ky * ky
    x = (d2 + (rod - other) * (rod + other)) / (2.0 * d2)
    y = module.sqrt((d2 - (rod - other) ** 2) * ((rod + other) ** 2 - d2)) / (2.0 * d2)
    # Along both rods, to P: it is to the left of the ray from B to D.
    ux, uy = kx * x - ky * y, ky * x + kx * y
    wx, wy = ux - kx, uy - ky
    det = uy * wx - ux * wy
    b1x, b1y, d1x, d1y = -r * s1, r * c1, -t * s2, t * c2

    def turned(fx: Any, fy: Any) -> Any:
        """Rates of both rods' angles whose turning closes a gap: a i u − b i w = f."""
        return (fx * wx + fy * wy) / -det, (fx * ux + fy * uy) / -det

    l1, m1 = turned(-b1x, -b1y)
    l2, m2 = turned(d1x, d1y)

    def second(a: Any, b: Any, first: tuple[Any, Any]) -> Any:
        la, ma = a
        lb, mb = b
        return turned(
            first[0] + la * lb * ux - ma * mb * wx, first[1] + la * lb * uy - ma * mb * wy
        )

    l11, m11 = second((l1, m1), (l1, m1), (r * c1, r * s1))
    l22, m22 = second((l2, m2), (l2, m2), (-t * c2, -t * s2))
    l12, m12 = second((l1, m1), (l2, m2), (0.0, 0.0))
    v11, v12, v22 = v1 * v1, v1 * v2, v2 * v2
    la, ma = l11 * v11 + 2.0 * l12 * v12 + l22 * v22, m11 * v11 + 2.0 * m12 * v12 + m22 * v22
    lv, mv = l1 * v1 + l2 * v2, m1 * v1 + m2 * v2
    mass, inertia, (along, across) = BODY

    def arm(cos: Any, sin: Any) -> Any:
        return along * cos - across * sin, along * sin + across * cos

    left, right = arm(c1, s1), arm(c2, s2)
    lx, ly = arm(ux / rod, uy / rod)
    rx, ry = arm(wx / other, wy / other)
    # Centres by both cranks, and their accelerations at constant speeds.
    g1 = (b1x - ly * l1, b1y + lx * l1)
    g2 = (-ly * l2, lx * l2)
    ga = (-r * c1 * v11 - ly * la - lx * lv * lv, -r * s1 * v11 + lx * la - ly * lv * lv)
    h1 = (-ry * m1, rx * m1)
    h2 = (d1x - ry * m2, d1y + rx * m2)
    ha = (-t * c2 * v22 - ry * ma - rx * mv * mv, -t * s2 * v22 + rx * ma - ry * mv * mv)
    centre = mass * (along * along + across * across) + inertia

    def dot(a: Any, b: Any) -> Any:
        return a[0] * b[0] + a[1] * b[1]

    m11_ = centre + mass * (dot(g1, g1) + dot(h1, h1)) + inertia * (l1 * l1 + m1 * m1)
    m22_ = centre + mass * (dot(g2, g2) + dot(h2, h2)) + inertia * (l2 * l2 + m2 * m2)
    m12_ = mass * (dot(g1, g2) + dot(h1, h2)) + inertia * (l1 * l2 + m1 * m2)
    weight = -GRAVITY * mass
    f1 = weight * (left[0] + g1[1] + h1[1]) - mass * (dot(g1, ga) + dot(h1, ha))
    f2 = weight * (right[0] + g2[1] + h2[1]) - mass * (dot(g2, ga) + dot(h2, ha))
    f1 = effort[0] + f1 - inertia * (l1 * la + m1 * ma)
    f2 = effort[1] + f2 - inertia * (l2 * la + m2 * ma)
    full = m11_ * m22_ - m12_ * m12_
    return (m22_ * f1 - m12_ * f2) / full, (m11_ * f2 - m12_ * f1) / full


def steps(
    acceleration: Callable[[Any, Any], Any], q: Any, speed: Any, dt: float, count: int
) -> tuple[Any, Any]:
    """The classical Runge-Kutta method, on arrays (drivers, environments)."""
    for _ in range(count):
        a1 = acceleration(q, speed)
        v2 = speed + 0.5 * dt * a1
        a2 = acceleration(q + 0.5 * dt * speed, v2)
        v3 = speed + 0.5 * dt * a2
        a3 = acceleration(q + 0.5 * dt * v2, v3)
        v4 = speed + dt * a3
        a4 = acceleration(q + dt * v3, v4)
        q = q + dt / 6.0 * (speed + 2.0 * v2 + 2.0 * v3 + v4)
        speed = speed + dt / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4)
    return q, speed


def by_numpy(two: bool, q: Any, speed: Any, dt: float, count: int) -> tuple[Any, Any]:
    """Steps without efforts."""

    def acceleration(at: Any, rate: Any) -> Any:
        if two:
            return np.stack(five_bar(np, at, rate, (0.0, 0.0)))
        return slider_crank(np, at, rate, 0.0)

    return steps(acceleration, q, speed, dt, count)
