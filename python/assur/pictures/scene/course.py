"""The whole motion of a mechanism: what fixes the frame of its pictures."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping

    from assur._arrays import Float
    from assur.kinematics.mechanism import Mechanism
    from assur.kinematics.motion import Motion

# Every five degrees of a turn.
ROWS = 73
# A slide that nothing limits is moved by this part of the mechanism's size both ways.
FREE_STROKE = 0.5
# Next to the ends of an interval parts may move infinitely fast: so near them, relative to it.
END_GAP = 1e-6


def course(
    mechanism: Mechanism,
    assembly: Mapping[str, int] | None = None,
    rows: int = ROWS,
    order: int = 0,
) -> Motion:
    """Solve the driver's turn, or what of it can be reached; of several drivers the drawing alone.

    Positions that do not exist are NaN.
    """
    q0 = mechanism._q0_array()
    if mechanism._driver_count > 1:
        return mechanism.solve(q0, order=order, assembly=assembly, on_error="nan")
    turns = mechanism.driver not in mechanism.slides
    if turns:
        q = float(q0) + np.linspace(0.0, 2.0 * np.pi, rows)
        motion = mechanism.solve(q, order=order, assembly=assembly, on_error="nan")
        if np.isfinite(motion.q).all() and not (motion.status > 2).any():
            return motion
    q = _reachable(mechanism, assembly, float(q0), rows, turns)
    return mechanism.solve(q, order=order, assembly=assembly, on_error="nan")


def _reachable(
    mechanism: Mechanism, assembly: Mapping[str, int] | None, q0: float, rows: int, turns: bool
) -> Float:
    """Return rows of q over the interval that holds q0."""
    intervals = mechanism.limits(assembly).intervals
    own = q0
    if turns and len(intervals):
        # Intervals lie about (−π, π], q0 wherever it was typed.
        middles = intervals.mean(axis=1)
        shift = 2.0 * np.pi * np.round((q0 - middles) / (2.0 * np.pi))
        intervals = intervals + np.where(np.isfinite(shift), shift, 0.0)[:, None]
    holding = [(low, high) for low, high in intervals if low <= own <= high]
    low, high = holding[0] if holding else (own, own)
    if np.isfinite(low) and np.isfinite(high):
        gap = END_GAP * (high - low)
        return np.linspace(low + gap, high - gap, rows)
    if turns:
        return own + np.linspace(0.0, 2.0 * np.pi, rows)
    points = np.array(list(mechanism.joints.values()))
    free = FREE_STROKE * float(np.ptp(points, axis=0).max()) or FREE_STROKE
    return np.linspace(max(low, own - free), min(high, own + free), rows)
