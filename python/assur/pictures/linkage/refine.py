"""Motions at more positions than were asked for, for smooth curves."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import short
from assur.errors import InputError
from assur.pictures.scene.course import course

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur._faces import Motion

# Positions of a curve, at least.
ROWS = 361


def checked_motion(motion: Any) -> Motion:
    """Return a motion; refuse anything else."""
    if not hasattr(motion, "instant_centre"):
        message = f"motion is {short(motion)}: an assur.Motion is needed, as solve() gives"
        raise InputError(message)
    checked: Motion = motion
    return checked


def refined(motion: Motion, what: str, order: int, rows: int = ROWS) -> tuple[Motion, int]:
    """Return a motion of many positions, and how many of its steps go to one of those given.

    A motion of one position stands for the whole motion of its mechanism. Rows of several drivers
    are returned as they are.
    """
    mechanism = motion.mechanism
    if mechanism.shape or len(motion.shape) > 1:
        message = f"{what} of one design, this is a batch {motion.shape}: take one with motion[i]"
        raise InputError(message)
    if not motion.shape:
        return _solved(motion, course(mechanism, rows=rows).q, order), 1
    if motion.shape[0] < 1:
        message = f"{what} needs a position: this motion has none"
        raise InputError(message)
    count = motion.shape[0] - 1
    if motion.driver_count > 1 or not 0 < count < rows - 1 or not np.isfinite(motion.q).all():
        return motion, 1
    steps = -(-(rows - 1) // count)
    parts = np.arange(count * steps + 1) / steps
    return _solved(motion, np.interp(parts, np.arange(count + 1), motion.q), order), steps


def _solved(motion: Motion, q: Float, order: int) -> Motion:
    """Solve in the assembly of a motion; positions that do not exist are NaN."""
    drivers = motion.driver_count
    positions = q.shape if drivers == 1 else q.shape[:-1]
    request = replace(
        motion.request, q=q, positions=positions, per_design=False, order=max(order, motion.order)
    )
    results, status, _ = request.arrays(*motion.held_indices)
    return type(motion)(request, results, status)
