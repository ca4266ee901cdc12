"""The inverse question of a four-bar and of a five-bar, as a user would write it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import brentq, root

if TYPE_CHECKING:
    from subject import Float

# Samples of a turn, between which roots are bracketed.
SAMPLES = 73


def four_bar(bars: tuple[float, ...], point: tuple[float, ...], q: Float, sign: int) -> Float:
    """Return the rocker's angle and the coupler point's x, (2, …): NaN where it is open."""
    crank, coupler, rocker, ground = bars
    bx, by = crank * np.cos(q), crank * np.sin(q)
    dx, dy = ground - bx, -by
    d2 = dx * dx + dy * dy
    along = (coupler**2 - rocker**2 + d2) / (2.0 * d2)
    across = sign * np.sqrt(coupler**2 / d2 - along**2)
    cx, cy = bx + along * dx - across * dy, by + along * dy + across * dx
    ux, uy = (cx - bx) / coupler, (cy - by) / coupler
    return np.array([np.arctan2(cy, cx - ground), bx + point[0] * ux - point[1] * uy])


def four_bar_by_brentq(
    bars: tuple[float, ...], point: tuple[float, ...], name: str, value: float
) -> Float:
    """Return every crank's angle at which the rocker's angle or the point's x has a value."""
    which = 0 if name == "rocker" else 1
    q = np.linspace(-math.pi, math.pi, SAMPLES)
    found: list[float] = []
    for sign in (1, -1):

        def misfit(at: Float, sign: int = sign) -> Float:
            gap = four_bar(bars, point, at, sign)[which] - value
            return np.asarray(gap - 2.0 * np.pi * np.round(gap / (2.0 * np.pi)) * (which == 0))

        gaps = misfit(q)
        is_crossed = (gaps[:-1] * gaps[1:] < 0.0) & (np.abs(gaps[1:]) < 1.0)
        found += [
            brentq(lambda at, of=misfit: float(of(np.asarray(at))), q[k], q[k + 1], xtol=1e-14)
            for k in np.flatnonzero(is_crossed)
        ]
    return np.array(sorted(found))


def five_bar_joints(bars: tuple[float, ...], q: Float) -> tuple[Float, Float, Float]:
    """Return the ends of both cranks, and the point."""
    base, left, right, rod, arm = bars
    b = left * np.array([np.cos(q[0]), np.sin(q[0])])
    d = np.array([base, 0.0]) + right * np.array([np.cos(q[1]), np.sin(q[1])])
    span = d - b
    along = (span @ span + rod**2 - arm**2) / (2.0 * span @ span)
    across = np.sqrt(rod**2 / (span @ span) - along**2)
    return b, d, b + along * span + across * np.array([-span[1], span[0]])


def five_bar_closed(bars: tuple[float, ...], point: Float) -> Float:
    """Return both cranks' angles of all four positions, sorted."""
    base, left, right, rod, arm = bars
    angles = []
    for foot, crank, bar in ((0.0, left, rod), (base, right, arm)):
        x, y = point[0] - foot, point[1]
        r2 = x * x + y * y
        away = np.arccos((crank**2 + r2 - bar**2) / (2.0 * crank * np.sqrt(r2)))
        angles.append(np.arctan2(y, x) + np.array([-away, away]))
    pairs = np.stack(np.meshgrid(*angles, indexing="ij"), axis=-1).reshape(-1, 2)
    pairs -= 2.0 * np.pi * np.ceil((pairs - np.pi) / (2.0 * np.pi))
    return np.array(sorted(pairs.tolist()))


def five_bar_by_root(bars: tuple[float, ...], point: Float, start: Float) -> Float:
    """Return both cranks' angles near a start."""
    solution = root(lambda q: five_bar_joints(bars, q)[2] - point, start, tol=1e-13)
    return np.asarray(solution.x)
