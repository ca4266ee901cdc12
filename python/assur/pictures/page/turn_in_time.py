"""Frames of all links over time: of a run, or of a motion by input laws."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur.errors import InputError
from assur.pictures.page.turn import Turn, frames_in_time, require_one

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur._faces import Mechanism, Run, TimedMotion

# Rows to a turn of the driver, and in all.
ROWS_PER_TURN, LEAST_ROWS, MOST_ROWS = 48, 181, 721
# Places at which the times of a run over q are looked up.
PLACES = 4001


def turn_of_run(run: Run) -> Turn:
    """Return the positions of a run at equal steps of time."""
    mechanism = run.mechanism
    if mechanism is None:
        message = "the machine of this run is given by tables: it has no mechanism to play"
        raise InputError(message)
    return turn_over_time(mechanism, *course_of_run(run))


def course_of_run(run: Run, rows: int | None = None) -> tuple[Float, Float, Float, Float]:
    """Return t, q, speed and acceleration of a run at equal steps of time."""
    if run.t[-1] < run.t[0]:
        message = f"this run goes back, from t = {run.t[0]:g} s to {run.t[-1]:g} s: a page plays "
        message += "forward; run it from its end"
        raise InputError(message)
    if not run.t[-1] > run.t[0]:
        message = f"this run ends where it begins, at t = {run.t[0]:g} s: nothing moves"
        raise InputError(message)
    if rows is None:
        turns = float(np.abs(run.q[-1] - run.q[0]).max()) / (2.0 * np.pi)
        rows = int(np.clip(ROWS_PER_TURN * turns, LEAST_ROWS, MOST_ROWS))
    t = np.linspace(run.t[0], run.t[-1], rows)
    if run.along_q:
        fine = run.at(q=np.linspace(run.q[0], run.q[-1], PLACES))
        q, speed, acceleration = (
            np.interp(t, fine.t, values) for values in (fine.q, fine.speed, fine.acceleration)
        )
        return t, q, speed, acceleration
    state = run.at(t)
    return t, state.q, state.speed, state.acceleration


def turn_of_timed(timed: TimedMotion) -> Turn:
    """Return the positions of a motion by input laws, whose times must be evenly spaced."""
    mechanism, t = timed.motion.mechanism, timed.t
    require_one(mechanism)
    if t.ndim != 1 or len(t) < 2:
        message = f"to_html plays times (N,), at least 2; these have shape {t.shape}"
        raise InputError(message)
    steps = np.diff(t)
    if not (steps > 0.0).all() or np.ptp(steps) > 1e-6 * float(t[-1] - t[0]):
        message = (
            "to_html plays evenly spaced times: follow() the law at np.linspace(first, last, N)"
        )
        raise InputError(message)
    return turn_over_time(mechanism, t, timed.q, timed.speed, timed.acceleration)


def turn_over_time(
    mechanism: Mechanism, t: Float, q: Float, speed: Float, acceleration: Float
) -> Turn:
    """Return the positions at equal steps of time for this motion of the driver."""
    motion = mechanism.solve(q, order=2, on_error="nan")
    frames = frames_in_time(motion, np.asarray(speed), np.asarray(acceleration))
    grid = {"kind": "linear", "low": float(t[0]), "high": float(t[-1])}
    return Turn(mechanism, frames, grid, False, "time", float(t[0]))
