"""Closed forms in NumPy.

Every form takes dimensions that broadcast with the coordinates: columns (designs, 1) make whole
arrays (designs, positions). Angles are as they come: not continuous.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

Float: TypeAlias = npt.NDArray[np.float64]
Form: TypeAlias = "Callable[..., Sequence[Float]]"


class FourBar(NamedTuple):
    """B and C, the coupler's and the rocker's angle, with analogues 1 and 2."""

    bx: Float
    by: Float
    bx1: Float
    by1: Float
    bx2: Float
    by2: Float
    cx: Float
    cy: Float
    cx1: Float
    cy1: Float
    cx2: Float
    cy2: Float
    coupler: Float
    coupler1: Float
    coupler2: Float
    rocker: Float
    rocker1: Float
    rocker2: Float


def textbook(crank: Float, coupler: Float, rocker: Float, ground: Float, q: Float) -> FourBar:
    """Four-bar by Freudenstein's equation, as in Norton, *Design of Machinery* (open).

    Angles by half-angle formulas, the rest by sines and cosines of the angles.
    """
    a, b, c, d = crank, coupler, rocker, ground
    k1, k2, k3 = d / a, d / c, (a * a - b * b + c * c + d * d) / (2 * a * c)
    k4, k5 = d / b, (c * c - d * d - a * a - b * b) / (2 * a * b)
    cos2, sin2 = np.cos(q), np.sin(q)
    A, B, C = cos2 - k1 - k2 * cos2 + k3, -2 * sin2, k1 - (k2 + 1) * cos2 + k3
    D, E, F = cos2 - k1 + k4 * cos2 + k5, -2 * sin2, k1 + (k4 - 1) * cos2 + k5
    angle4 = 2 * np.arctan2(-B - np.sqrt(B * B - 4 * A * C), 2 * A)
    angle3 = 2 * np.arctan2(-E - np.sqrt(E * E - 4 * D * F), 2 * D)
    w3 = a * np.sin(angle4 - q) / (b * np.sin(angle3 - angle4))
    w4 = a * np.sin(q - angle3) / (c * np.sin(angle4 - angle3))
    cos3, sin3, cos4, sin4 = np.cos(angle3), np.sin(angle3), np.cos(angle4), np.sin(angle4)
    A, B, D, E = c * sin4, b * sin3, c * cos4, b * cos3
    C = a * cos2 + b * w3 * w3 * cos3 - c * w4 * w4 * cos4
    F = c * w4 * w4 * sin4 - a * sin2 - b * w3 * w3 * sin3
    a3 = (C * D - A * F) / (A * E - B * D)
    a4 = (C * E - B * F) / (A * E - B * D)
    bx, by = a * cos2, a * sin2
    return FourBar(
        *(bx, by, -by, bx, -bx, -by),
        *(bx + b * cos3, by + b * sin3, -c * sin4 * w4, c * cos4 * w4),
        *(-c * sin4 * a4 - c * cos4 * w4 * w4, c * cos4 * a4 - c * sin4 * w4 * w4),
        *(angle3, w3, a3, angle4, w4, a4),
    )


def vectors(crank: Float, coupler: Float, rocker: Float, ground: Float, q: Float) -> FourBar:
    """Four-bar by the intersection of two circles, written to be quick (open).

    With sides u, v of the coupler and w, z of the rocker, analogues follow from two linear
    equations; trigonometry is left in the two angles only.
    """
    bx, by = crank * np.cos(q), crank * np.sin(q)
    u, v, kx = _coupler(bx, by, coupler, rocker, ground)
    w, z = u - kx, v + by
    r = 1 / (v * w - u * z)
    coupler1, rocker1 = (bx * z - by * w) * r, (bx * v - by * u) * r
    square3, square4 = coupler1 * coupler1, rocker1 * rocker1
    wx, wy = w * square4, z * square4
    fx, fy = wx - u * square3 - bx, wy - v * square3 - by
    coupler2, rocker2 = (fx * w + fy * z) * r, (fx * u + fy * v) * r
    return FourBar(
        *(bx, by, -by, bx, -bx, -by),
        *(bx + u, z, -z * rocker1, w * rocker1, -z * rocker2 - wx, w * rocker2 - wy),
        *(np.arctan2(v, u), coupler1, coupler2, np.arctan2(z, w), rocker1, rocker2),
    )


def angles(crank: Float, coupler: Float, rocker: Float, ground: Float, q: Float) -> list[Float]:
    """Coupler's and rocker's angle alone, each with two analogues, as `vectors` has them."""
    bx, by = crank * np.cos(q), crank * np.sin(q)
    u, v, kx = _coupler(bx, by, coupler, rocker, ground)
    w, z = u - kx, v + by
    r = 1 / (v * w - u * z)
    coupler1, rocker1 = (bx * z - by * w) * r, (bx * v - by * u) * r
    square3, square4 = coupler1 * coupler1, rocker1 * rocker1
    fx, fy = w * square4 - u * square3 - bx, z * square4 - v * square3 - by
    coupler2, rocker2 = (fx * w + fy * z) * r, (fx * u + fy * v) * r
    return [np.arctan2(v, u), coupler1, coupler2, np.arctan2(z, w), rocker1, rocker2]


def rocker(crank: Float, coupler: Float, rocker: Float, ground: Float, q: Float) -> Float:
    """Rocker's angle alone."""
    bx, by = crank * np.cos(q), crank * np.sin(q)
    u, v, kx = _coupler(bx, by, coupler, rocker, ground)
    return np.arctan2(v + by, u - kx)


def _coupler(
    bx: Float, by: Float, coupler: Float, rocker: Float, ground: Float
) -> tuple[Float, Float, Float]:
    """From B to C as x and y, and from B to D along the ground."""
    kx = ground - bx
    r = 1 / (kx * kx + by * by)
    along = 0.5 + (0.5 * (coupler * coupler - rocker * rocker)) * r
    up = np.sqrt(coupler * coupler * r - along * along)
    return along * kx + up * by, up * kx - along * by, kx


def slider_crank(crank: Float, rod: Float, offset: Float, q: Float) -> tuple[Float, ...]:
    """Slide and rod angle with two analogues each; the guide is the x axis."""
    bx, by = crank * np.cos(q), crank * np.sin(q)
    y = offset - by
    x = np.sqrt((rod - y) * (rod + y))
    per = 1 / x
    w = -bx * per
    v = (y * w * w + by) * per
    return bx + x, -by - y * w, -bx - x * w * w - y * v, np.arctan2(y, x), w, v


Point: TypeAlias = tuple[Float, Float]


def _meet(a: Point, from_a: Float, b: Point, from_b: Float, sign: float) -> Point:
    """Return the place with these distances; +1: to the left of the ray a → b."""
    x, y = b[0] - a[0], b[1] - a[1]
    r = 1 / (x * x + y * y)
    along = 0.5 + (0.5 * (from_a * from_a - from_b * from_b)) * r
    up = sign * np.sqrt(from_a * from_a * r - along * along)
    return a[0] + along * x - up * y, a[1] + along * y + up * x


def _third(a: Point, b: Point, length: Float, x: Float, y: Float) -> Point:
    """Return the place x, y in the frame at a with x toward b."""
    x, y = x / length, y / length
    s, t = b[0] - a[0], b[1] - a[1]
    return a[0] + x * s - y * t, a[1] + x * t + y * s


def four_bar_point(
    crank: Float, coupler: Float, rocker: Float, ground: Float, x: Float, y: Float, q: Float
) -> Point:
    """Coupler point of four-bars, NaN where they cannot be assembled (open)."""
    b = crank * np.cos(q), crank * np.sin(q)
    c = _meet(b, coupler, (ground, np.zeros_like(ground)), rocker, +1)
    return _third(b, c, coupler, x, y)


def stephenson_point(
    four_bar: Sequence[Float],
    fifth: Float,
    sixth: Float,
    ex: Float,
    ey: Float,
    x: Float,
    y: Float,
    q: Float,
) -> Point:
    """A point of the fifth link of Stephenson III six-bars: a dyad on the coupler point."""
    p = four_bar_point(*four_bar, q)
    s = _meet(p, fifth, (ex, ey), sixth, +1)
    return _third(p, s, fifth, x, y)


def jansen(
    ox: Float,
    oy: Float,
    bx: Float,
    by: Float,
    crank: Float,
    upper_rod: Float,
    upper: Float,
    upper_x: Float,
    upper_y: Float,
    lower_rod: Float,
    lower_rocker: Float,
    link: Float,
    foot: Float,
    foot_x: Float,
    foot_y: Float,
    q: Float,
) -> tuple[Float, ...]:
    """Jansen's leg by intersections of circles: M, T, W, L, K, F, each as x and y.

    The dimensions are those of `assur.examples.jansen_leg`, in their order.
    """
    b = bx, by
    m = ox + crank * np.cos(q), oy + crank * np.sin(q)
    t = _meet(m, upper_rod, b, upper, -1)
    w = _third(b, t, upper, upper_x, upper_y)
    l_ = _meet(m, lower_rod, b, lower_rocker, +1)
    k = _meet(w, link, l_, foot, -1)
    f = _third(l_, k, foot, foot_x, foot_y)
    return (*m, *t, *w, *l_, *k, *f)


def blocked(
    form: Form,
    dimensions: Sequence[Float],
    q: Float,
    out: Sequence[Float],
    threads: int = 1,
    block: int = 64,
) -> Sequence[Float]:
    """Do blocks of designs that stay in the cache, into arrays that are there already."""

    def part(start: int, end: int) -> None:
        for i in range(start, end, block):
            rows = slice(i, min(i + block, end))
            for whole, values in zip(out, form(*(x[rows] for x in dimensions), q), strict=True):
                whole[rows] = values

    designs = len(out[0])
    if threads == 1:
        part(0, designs)
    else:
        ends = [designs * i // threads for i in range(threads + 1)]
        with ThreadPoolExecutor(threads) as pool:
            list(pool.map(part, ends[:-1], ends[1:]))
    return out
