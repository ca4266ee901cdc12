"""The whole motion of a mechanism: what fixes the frame of its pictures."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur.description.words import is_reached

if TYPE_CHECKING:
    from collections.abc import Mapping

    from assur._arrays import Float
    from assur._faces import Limits, Mechanism, Motion

# Every five degrees of a turn.
ROWS = 73
# A slide that nothing limits is moved by this fraction of the mechanism's size both ways.
FREE_STROKE = 0.5
# Distance from the ends of an interval, relative to it: at them parts may move infinitely fast.
END_GAP = 1e-6
# A coordinate beyond an interval by no more than this is at its end.
ROUNDING = 1e-9
TURN = 2.0 * np.pi


def course(
    mechanism: Mechanism,
    assembly: Mapping[str, int] | None = None,
    rows: int = ROWS,
    order: int = 0,
) -> Motion:
    """Solve the driver's turn, or the part of it in reach; with several drivers the drawing alone.

    Positions that do not exist are NaN.
    """
    q0 = mechanism.q0_array
    if mechanism.driver_count > 1:
        return mechanism.solve(q0, order=order, assembly=assembly, on_error="nan")
    turns = mechanism.driver not in mechanism.slides
    if turns:
        q = float(q0) + np.linspace(0.0, TURN, rows)
        motion = mechanism.solve(q, order=order, assembly=assembly, on_error="nan")
        if np.isfinite(motion.q).all() and is_reached(motion.status).all():
            return motion
    q = _reachable(mechanism, assembly, float(q0), rows, turns)
    return mechanism.solve(q, order=order, assembly=assembly, on_error="nan")


def _reachable(
    mechanism: Mechanism, assembly: Mapping[str, int] | None, q0: float, rows: int, turns: bool
) -> Float:
    """Return rows of q over the interval that holds q0."""
    low, high = interval_at(mechanism.limits(assembly=assembly), q0, turns)
    if np.isfinite(low) and np.isfinite(high):
        gap = END_GAP * (high - low)
        return np.linspace(low + gap, high - gap, rows)
    if turns:
        return q0 + np.linspace(0.0, TURN, rows)
    free = free_stroke(mechanism)
    return np.linspace(max(low, q0 - free), min(high, q0 + free), rows)


def interval_at(limits: Limits, q0: float, turns: bool) -> tuple[float, float]:
    """Return the interval that holds q0; for an angle, at the turn of q0."""
    for first, last in limits.intervals.tolist():
        # Intervals lie about the drawing's coordinate, q0 wherever it was typed.
        middle = (first + last) / 2.0
        shift = TURN * round((q0 - middle) / TURN) if turns and np.isfinite(middle) else 0.0
        low, high = first + shift, last + shift
        if low - ROUNDING <= q0 <= high + ROUNDING:
            return low, high
    return q0, q0


def free_stroke(mechanism: Mechanism) -> float:
    """Return how far a slide is moved where nothing limits it, m."""
    points = np.array(list(mechanism.joints.values()))
    return FREE_STROKE * float(np.ptp(points, axis=0).max()) or FREE_STROKE
