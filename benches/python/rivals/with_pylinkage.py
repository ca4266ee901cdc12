"""What a user of pylinkage writes: a linkage of its parts, stepped; or an ensemble of variants."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from pylinkage.actuators import Crank
from pylinkage.components import Ground
from pylinkage.dyads import FixedDyad, RRRDyad
from pylinkage.population import Ensemble
from pylinkage.simulation import Linkage

if TYPE_CHECKING:
    from subject import Float


def four_bar(lengths: Float, point: Float, positions: int) -> Linkage:
    """One four-bar with a coupler point, its crank one step before q = 0 (open)."""
    a, b, c, g = (float(x) for x in lengths)
    step = 2 * np.pi / positions
    pivots = Ground(0.0, 0.0, name="A"), Ground(g, 0.0, name="D")
    crank = Crank(pivots[0], radius=a, angular_velocity=step, initial_angle=-step, name="B")
    start = _start(np.array([a, b, c, g])[:, None], -step)[:, 0]
    rocker = RRRDyad(crank.output, pivots[1], b, c, *(float(x) for x in start), name="C")
    reach, angle = float(np.hypot(*point)), float(np.arctan2(point[1], point[0]))
    tracer = FixedDyad(crank.output, rocker, reach, angle, name="P")
    return Linkage([*pivots, crank, rocker, tracer], name="four-bar")


def step(linkage: Linkage, positions: int) -> Any:
    """Places of all joints over a turn: a list of tuples."""
    return list(linkage.step(positions))


def ensemble(lengths: Float, point: Float, positions: int) -> Ensemble:
    """Variants with these dimensions, one step before q = 0."""
    linkage = four_bar(lengths[:, 0], point[:, 0], positions)
    before = -2 * np.pi / positions
    a, b, c, g = lengths
    reach, angle = np.hypot(*point), np.arctan2(point[1], point[0])
    zero = np.zeros_like(a)
    crank = np.stack([a * np.cos(before), a * np.sin(before)])
    tip = _start(lengths, before)
    ux, uy = (tip - crank) / b
    traced = crank + np.stack([ux * point[0] - uy * point[1], uy * point[0] + ux * point[1]])
    places = np.stack([[zero, zero], [g, zero], crank, tip, traced], axis=1)
    dimensions = np.stack([a, b, c, reach, angle], axis=1)
    return Ensemble(linkage, dimensions, np.ascontiguousarray(places.T))


def _start(lengths: Float, q: float) -> Float:
    """C of the open assembly at q."""
    a, b, c, g = lengths
    bx, by = a * np.cos(q), a * np.sin(q)
    kx, ky = g - bx, -by
    d2 = kx * kx + ky * ky
    x = (d2 + (b - c) * (b + c)) / (2 * d2)
    y = np.sqrt(b * b / d2 - x * x)
    return np.stack([bx + kx * x - ky * y, by + ky * x + kx * y])
