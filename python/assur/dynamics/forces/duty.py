"""The effort of a drive over a cycle: extremes, rms, power, energy."""

from __future__ import annotations

import math
import warnings
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from assur._arrays import as_number, require_finite
from assur._extreme import Extreme
from assur._other_names import other_names
from assur._summary import summary
from assur.dynamics.forces import kinetostatics
from assur.dynamics.forces.piecewise_cubic import Pieces
from assur.dynamics.motion.discontinuities import BESIDE_REVERSAL, jumps_between
from assur.dynamics.motion.motion_input import DrivenMotion, times
from assur.dynamics.preconditions import without_arrays
from assur.errors import AssurWarning, InputError, MotionError

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur._arrays import Float, Number
    from assur.dynamics.model import MachineModel, OnError

__all__ = ["Duty"]

# Coordinates are evenly spaced, and cover whole turns, to this part of the step and of the turns:
# they may be typed with nine digits.
SPACING_RTOL = 1e-9
# The effort at the end of whole turns is that at their start, to this part of the greatest.
CLOSING_RTOL = 1e-9
# Columns of the table from which a duty is made.
NUMBERS = 13


@other_names(
    least="it is min",
    greatest="it is max",
    least_power="it is min_power",
    greatest_power="it is max_power",
)
class Duty(NamedTuple):
    """The effort of a drive over the positions of a cycle, by `Machine.duty`.

    For a batch of designs the numbers are arrays of its shape S, NaN for a design with a position
    that fails.

    Attributes
    ----------
    effort : ndarray
        Torque (driven slide: force) of the drive at q, N·m or N, S + (N,).
    max, min : Extreme
        Its extreme values and their q, also between the positions.
    rms : float or ndarray
        Root mean square of the effort over time, N·m or N.
    power : ndarray
        effort × speed, W, S + (N,): positive where the drive gives energy to the machine.
    mean_power : float or ndarray
        energy / time, W.
    max_power, min_power : Extreme
        Extreme values of the power, W, and q there.
    energy : float or ndarray
        Energy that the drive gives, ∫ effort dq, J: `work_in` − `work_out`.
    work_in, work_out : float or ndarray
        Energy that it gives, and that it takes back, J; neither is negative.
    time : float or ndarray
        Time that the motion takes, s.
    lost : float or ndarray
        Energy that friction takes, J: the drive's energy less that without friction.
    efficiency : float or ndarray
        1 − lost/max(energy, lost − energy): output over input, whichever way energy flows over the
        cycle; NaN if none flows.
    mean : float or ndarray
        Mean of the effort over q, N·m or N: energy / way.

    Examples
    --------
    A constant force takes as much on the way out as it gives on the way back:

    >>> import assur, numpy as np
    >>> force = assur.Force("B", (-1000.0, 0.0))
    >>> machine = assur.Machine(assur.SliderCrank(crank=0.1, rod=0.4), loads=[force])
    >>> duty = machine.duty(np.linspace(0, 2 * np.pi, 72, endpoint=False), speed=10.0)
    >>> round(float(duty.work_in), 2), round(float(duty.work_out), 2)  # J: 1000 N · 0.2 m
    (200.0, 200.0)
    """

    effort: Float
    max: Extreme
    min: Extreme
    rms: Number
    power: Float
    mean_power: Number
    max_power: Extreme
    min_power: Extreme
    energy: Number
    work_in: Number
    work_out: Number
    time: Number
    lost: Number
    efficiency: Number
    mean: Number

    def __repr__(self) -> str:
        return summary(self)


def duty(
    machine: MachineModel,
    motion: DrivenMotion,
    on_error: OnError,
) -> Duty:
    """Return the duty of a drive; see `Machine.duty`."""
    without_arrays(machine, "duty")
    if machine.driver_count > 1:
        message = (
            f"the machine has {machine.driver_count} drivers: a duty is that of one, whose "
            "coordinate and speed give the time; machine.effort gives the efforts of all"
        )
        raise InputError(message)
    x, v, a, shape = kinetostatics.broadcast_motion(machine, motion)
    t = times(motion.t, shape)
    require_finite(x, "q")
    x, v, a = (np.broadcast_to(part, shape) for part in (x, v, a))
    senses = None if motion.senses is None else motion.senses.reshaped(shape)
    # Without a speed only the times of a run say how long it takes.
    is_timed = senses is not None and bool(senses.sense.any())
    _check_path(x, v if senses is None else senses.creeping(v, with_begins=True))
    jumps = _jumps(machine, x) if senses is None else np.empty(0)
    effort = np.asarray(kinetostatics.effort(machine, DrivenMotion(x, v, a, t, senses), on_error))
    rows = [part.reshape(-1, shape[-1]) for part in (x, v, effort)]
    if is_timed:
        rows.append(t.reshape(-1, shape[-1]))
    numbers = np.empty((len(rows[0]), NUMBERS))
    is_closed, lacks_end, turn = _closing(machine, rows[0])
    way = rows[0][:, -1] - rows[0][:, 0]
    lacks_end &= (t == t[..., :1]).all(axis=-1).reshape(-1)
    is_turn = lacks_end.copy()
    way = np.where(lacks_end, turn, way)
    if lacks_end.any():
        # The first position again, whole turns later, with its speed and acceleration.
        ends = rows[0][:, :1] + turn[:, None]
        after = np.where(lacks_end[:, None], ends, rows[0][:, :1]).reshape(*shape[:-1], 1)
        effort_after = kinetostatics.effort(
            machine, DrivenMotion(after, v[..., :1], a[..., :1], t[..., :1]), "nan"
        )
        last = [ends, rows[1][:, :1], np.reshape(effort_after, (-1, 1))]
        longer = [np.concatenate(pair, axis=1) for pair in zip(rows, last, strict=True)]
        lacks_end &= _ends_agree(longer[2])
        numbers[lacks_end] = _numbers([row[lacks_end] for row in longer], closed=True)
    is_closed &= _ends_agree(rows[2])
    for chosen, closed in ((is_closed, True), (~(is_closed | lacks_end), False)):
        if chosen.any():
            numbers[chosen] = _numbers([row[chosen] for row in rows], closed=closed)
    with np.errstate(over="ignore", invalid="ignore"):
        power = effort * v
    paths = [part.reshape(-1, shape[-1]) for part in (x, v, a, t)]
    for row in np.flatnonzero(np.isfinite(rows[2]).all(axis=1)) if jumps.size else ():
        path = [part[row] for part in paths]
        if is_turn[row]:
            path = [np.append(part, part[0]) for part in path]
            path[0][-1] += turn[row]
        if ((jumps >= path[0].min()) & (jumps <= path[0].max())).any():
            numbers[row] = _across(machine, jumps, path)
    _require_finite(numbers, effort, on_error)
    columns = [as_number(numbers[:, k].reshape(shape[:-1])[()]) for k in range(NUMBERS)]
    greatest, least, most, fewest = (Extreme(columns[k], columns[k + 1]) for k in (0, 2, 4, 6))
    rms, energy, work_in, work_out, time = columns[8:]
    lost = 0.0 * energy
    if machine.friction and machine.mechanism is not None:
        free = type(machine)(
            machine.mechanism, bodies=machine.bodies, loads=machine.loads, motor=machine.motor
        )
        lost = energy - duty(free, DrivenMotion(x, v, a, t, senses), on_error).energy
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        mean_power = energy / time
        efficiency = 1.0 - lost / np.maximum(energy, lost - energy)
    return Duty(
        effort,
        greatest,
        least,
        rms,
        power,
        as_number(mean_power),
        most,
        fewest,
        energy,
        work_in,
        work_out,
        time,
        as_number(lost),
        as_number(efficiency),
        as_number(np.asarray(energy / way.reshape(shape[:-1]))[()]),
    )


def warn_of_jumps(machine: MachineModel) -> None:
    """Warn if loads of a batch may jump between the positions of a motion given by numbers."""
    if machine.shape and (machine.core.follows[0] or any(machine.core.jumps)):
        message = (
            "loads may jump between positions: the duties of a batch are no more accurate than "
            "these are close there; that of one design, design(i).duty, goes from jump to jump"
        )
        warnings.warn(message, AssurWarning, stacklevel=3)


def _jumps(machine: MachineModel, x: Float) -> Float:
    """Return where the loads of one design may jump and its friction reverses along paths."""
    if machine.shape or not x.size:
        return np.empty(0)
    # Whole turns may lack their end.
    low, high = float(x.min()), float(x.max())
    step = (high - low) / (x.shape[-1] - 1)
    return jumps_between(machine, low - step, high + step, friction=True)


def _across(machine: MachineModel, jumps: Float, motion: list[Float]) -> Float:
    """Return the numbers of a path that is cut where the effort jumps: it is smooth between."""
    x = motion[0]
    order = slice(None, None, 1 if x[-1] > x[0] else -1)
    way = float(order.step)
    inner = jumps[(jumps > min(x[0], x[-1])) & (jumps < max(x[0], x[-1]))]
    cuts = [x[0], *inner[order].tolist(), x[-1]]
    places, nodes = [], []
    for first, last in pairwise(cuts):
        # The ends of the path may be at a jump, too.
        low, high = (
            cut + sign * way * BESIDE_REVERSAL * max(1.0, abs(cut))
            for cut, sign in ((first, 1.0), (last, -1.0))
        )
        if way * (high - low) > 0.0:
            within = x[(way * (x - low) > 0.0) & (way * (high - x) > 0.0)]
            places.append(np.array([low, *within, high]))
            nodes.append(np.array([first, *within, last]))
    every = np.concatenate(places)
    states = [np.interp(every, x[order], part[order]) for part in motion[1:]]
    effort = np.asarray(kinetostatics.effort(machine, DrivenMotion(every, *states), "nan"))
    ends = np.cumsum([len(piece) for piece in places])[:-1]
    pieces = zip(nodes, np.split(states[0], ends), np.split(effort, ends), strict=True)
    return _joined(np.array([_numbers([row[None] for row in piece], False)[0] for piece in pieces]))


def _joined(parts: Float) -> Float:
    """Return the numbers of a path from those of its parts, in the order of `_numbers`."""
    whole = parts.sum(axis=0)
    for value, sign in ((0, 1.0), (2, -1.0), (4, 1.0), (6, -1.0)):
        best = int(np.argmax(sign * parts[:, value]))
        whole[value : value + 2] = parts[best, value : value + 2]
    rms, time = parts[:, 8], parts[:, 12]
    whole[8] = np.sqrt((rms * rms * time).sum() / time.sum())
    return np.asarray(whole)


def _check_path(x: Float, speed: Float) -> None:
    """Raise InputError unless q goes one way, with the speed."""
    if x.ndim == 0 or x.shape[-1] < 2:
        message = f"q has the shape {x.shape}: a duty needs two positions or more along the motion"
        raise InputError(message)
    steps = np.diff(x, axis=-1)
    direction = np.sign(steps[..., :1])
    back = np.argwhere(~(steps * direction > 0.0))
    if back.size:
        index = tuple(back[0])
        here, there = float(x[index]), float(x[(*index[:-1], index[-1] + 1)])
        message = (
            f"q goes from {here:.15g} to {there:.15g}: it must ascend, or descend, without "
            "repeats; give one stroke at a time"
        )
        raise InputError(message, q=there, value=there)
    against = np.argwhere(~(speed * direction > 0.0))
    if against.size:
        index = tuple(against[0])
        here, value = float(x[index]), float(speed[index])
        way = "ascends" if direction[(*index[:-1], 0)] > 0.0 else "descends"
        message = (
            f"speed is {value:g} at q = {here:.15g}, though q {way}: give q in the order of the "
            "motion, with a speed that is not 0 (machine.effort gives efforts at rest)"
        )
        raise InputError(message, q=here, value=value)


def _closing(
    machine: MachineModel, x: Float
) -> tuple[npt.NDArray[np.bool_], npt.NDArray[np.bool_], Float]:
    """Return which rows of q cover whole turns, which lack only their end, and these turns."""
    nothing = np.zeros(len(x), dtype=bool)
    mechanism = machine.mechanism
    if mechanism is None:
        knots, is_periodic = machine.core.tables[0]
        turn = knots[-1] - knots[0] if is_periodic else 0.0
    else:
        turn = 0.0 if mechanism.driver in mechanism.slides else math.tau
    if turn == 0.0:
        return nothing, nothing.copy(), np.zeros(len(x))
    span, steps = x[:, -1] - x[:, 0], np.diff(x, axis=1)
    mean = span / steps.shape[1]
    whole, wider = np.round(span / turn) * turn, np.round((span + mean) / turn) * turn
    covers = (whole != 0.0) & (np.abs(span - whole) <= CLOSING_RTOL * np.abs(whole))
    is_even = (np.abs(steps - mean[:, None]) <= SPACING_RTOL * np.abs(mean)[:, None]).all(axis=1)
    lacks = np.abs(span + mean - wider) <= CLOSING_RTOL * np.abs(wider)
    return covers, is_even & lacks & (wider != 0.0) & ~covers, wider


def _ends_agree(effort: Float) -> npt.NDArray[np.bool_]:
    """Return for which rows the effort ends as it began."""
    with np.errstate(over="ignore", invalid="ignore"):
        most = np.abs(effort).max(axis=1)
        agree: npt.NDArray[np.bool_] = np.abs(effort[:, -1] - effort[:, 0]) <= CLOSING_RTOL * most
    return agree


def _numbers(samples: list[Float], closed: bool) -> Float:
    """Return the numbers of each row, in the order in which `duty` reads them.

    If times follow the efforts, means are over these times.
    """
    x, speed, effort, *clock = samples
    with np.errstate(all="ignore"):
        curve, power = Pieces(x, effort, closed), Pieces(x, effort * speed, closed)
        time = Pieces(x, 1.0 / speed, closed).integral()
        for t in clock:
            time = t[:, -1] - t[:, 0]
        # The squares are of ratios to the greatest, and so stay within range.
        most = np.abs(effort).max(axis=1)
        parts = np.where(most > 0.0, most, 1.0)[:, None]
        squares = Pieces(x, (effort / parts) ** 2 / speed, closed).integral()
        for t in clock:
            squares = Pieces(t, (effort / parts) ** 2, closed).integral()
        rms = parts[:, 0] * np.sqrt(np.maximum(squares / time, 0.0))
        energy, size = curve.integral(), curve.integral_of_size()
        # Where the effort has one sign, the difference is rounding, perhaps negative.
        work_in = np.maximum(0.5 * (size + energy), 0.0)
        taken = np.maximum(0.5 * (size - energy), 0.0)
        extremes = [*curve.extreme(1.0), *curve.extreme(-1.0)]
        extremes += [*power.extreme(1.0), *power.extreme(-1.0)]
    numbers = np.stack([*extremes, rms, energy, work_in, taken, time], axis=1)
    numbers[np.isnan(effort).any(axis=1)] = np.nan
    return numbers


def _require_finite(numbers: Float, effort: Float, on_error: OnError) -> None:
    if on_error == "raise" and not np.isfinite(numbers).all():
        message = (
            f"the work or power of efforts up to {np.abs(effort).max():.3g} is beyond the greatest "
            "number: a load, a speed or a mass is too great, or a speed too near 0"
        )
        raise MotionError(message, kind="not_finite")
