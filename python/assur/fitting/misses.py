"""What a mechanism misses of targets, by its own motion."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur.fitting.distance import nearest

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur._arrays import Float
    from assur.fitting.goals import Goal, Number
    from assur.kinematics.mechanism import Mechanism
    from assur.kinematics.motion import Motion

# Positions among which the nearest to a pose is sought.
POSES = 1440


def misses(m: Mechanism, goal: Goal, q: Float, free: Sequence[float]) -> Float:
    """Return what a mechanism misses at coordinates (N,): S + (N,), m or rad, weights apart."""
    numbers, _, when, _, _, freedom = goal.parts
    motion = m.solve(q, order=0, on_error="nan")
    values = [_read(m, motion, number) for number in numbers]
    rest = list(free[1:] if when == "phase" else free)
    if freedom == "similarity":
        a, b, x, y = rest
        values = [a * values[0] - b * values[1] + x, b * values[0] + a * values[1] + y]
    elif freedom == "turned":
        values[2] = values[2] + rest[0]
    elif freedom != "place":
        if freedom.startswith("scale"):
            values[0] = values[0] * rest.pop(0)
        if freedom.endswith("offset"):
            values[0] = values[0] + rest[0]
    square = np.zeros(np.shape(values[0]))
    for value, (_, _, _, weight, wanted, is_angle) in zip(values, numbers, strict=True):
        missed = value - np.asarray(wanted)
        if is_angle:
            missed = missed - 2.0 * np.pi * np.round(missed / (2.0 * np.pi))
        square = square + (weight * missed) ** 2
    return np.sqrt(square)


def _read(m: Mechanism, motion: Motion, number: Number) -> Float:
    """Return a number of a motion."""
    kind, name, axis, _, _, _ = number
    if kind == "slide":
        return np.asarray(motion.slide(name).value)
    if kind == "angle":
        return np.asarray(motion.link(name).value)
    joint = name if kind == "joint" else m.links[name][0]
    return np.asarray(motion.joint(joint).value[..., axis])


def nearest_misses(designs: Mechanism, goal: Goal, travel: Float, free: Sequence[float]) -> Float:
    """Return the same of points met wherever that is best on a travel: designs (D,) → (D, N)."""
    numbers, _, _, _, _, freedom = goal.parts
    motion = designs.solve(travel, order=0, on_error="nan")
    if numbers[0][0] == "joint":
        curves = motion.joint(numbers[0][1]).value
        if freedom == "similarity":
            a, b, x, y = free
            turn = np.array([[a, b], [-b, a]])
            curves = curves @ turn + (x, y)
        points = np.column_stack([number[4] for number in numbers])
        return np.array([nearest(points, curve).distance for curve in curves])
    first = designs.links[numbers[0][1]][0]
    place, angle = motion.joint(first).value, motion.link(numbers[0][1]).value
    length = numbers[2][3]
    turned = free[0] if freedom == "turned" else 0.0
    found = []
    for x, y, direction in zip(*(number[4] for number in numbers), strict=True):
        off = angle + turned - direction
        off = length * (off - 2.0 * np.pi * np.round(off / (2.0 * np.pi)))
        away = (place[..., 0] - x) ** 2 + (place[..., 1] - y) ** 2 + off**2
        found.append(np.sqrt(away.min(axis=-1)))
    return np.stack(found, axis=-1)
