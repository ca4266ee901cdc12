"""Flywheels of machines: from refined tables, or from the motion with the machine's motor."""

from __future__ import annotations

import itertools
import math
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import finite_array, real_number
from assur._validate import one_of
from assur.dynamics.flywheel.designs import FlywheelOfDesigns
from assur.dynamics.flywheel.steady import SteadyFlywheel
from assur.dynamics.loads.motors import ConstantTorque
from assur.dynamics.loads.table import Table
from assur.dynamics.motion.discontinuities import BESIDE, jumps_between, stations_between
from assur.dynamics.motion.integrate import steady_state
from assur.dynamics.preconditions import (
    PERIOD_RTOL,
    require_rotary_driver,
    require_whole_periods,
    turn_count,
    without_arrays,
    without_friction,
)
from assur.dynamics.reduction.reduce import reduce
from assur.errors import AssurWarning, InputError, MotionError
from assur.flywheel.sizing import tabulated_flywheel

if TYPE_CHECKING:
    from assur.dynamics.model import MachineModel
    from assur.flywheel import Flywheel

# Options of the periodic motion: the defaults of `Machine.steady_state`.
STEADY_OPTIONS: dict[str, Any] = {
    "flywheel": 0.0,
    "rtol": 1e-12,
    "method": "DOP853",
    "breaks": (),
    "max_steps": 100_000,
    "max_seconds": 60.0,
}
# Warn if a constant motor misses the mean moment of the loads by more: torques are typed numbers.
TORQUE_RTOL = 1e-2
# Largest number of knots of loads in a cycle.
MAX_KNOTS = 100_000
# Inertia and moment must repeat after a turn to this relative accuracy.
PERIODIC_RTOL = 1e-7
# Rounding error of moments, relative to inertia times squared speed.
MOMENT_ROUNDING_RTOL = 1e-12
# Rows of the first and the last table; each table has twice as many as the one before.
FIRST_ROWS, LAST_ROWS = 96, 12288
# Least rows between two knots of a load's table.
MIN_ROWS_BETWEEN_KNOTS = 6
# The flywheel has converged when two tables agree to this fraction of the inertia.
CONVERGED_RTOL = 1e-9


def flywheel(
    machine: MachineModel, fluctuation: Any, mean_speed: Any, mean: Any, turns: Any, on_error: str
) -> Flywheel:
    """See `Machine.flywheel`."""
    without_arrays(machine, "flywheel")
    turns = turn_count(turns)
    without_friction(machine, "flywheel")
    require_rotary_driver(machine, "a flywheel")
    one_of(on_error, ("raise", "nan"), "on_error")
    torque: Any = 0.0 if machine.motor is None else getattr(machine.motor, "torque", None)
    constant = torque is not None and not callable(torque) and not isinstance(torque, Table)
    if mean_speed is None:
        if machine.motor is None:
            message = "mean_speed is needed: no motor sets the speed"
            raise InputError(message)
        if machine.shape:
            message = (
                "flywheel(fluctuation) with the machine's own motor is for one design, this is a "
                f"batch {machine.shape}: take one with design(i), or give mean_speed"
            )
            raise InputError(message)
        limit = real_number(fluctuation, "fluctuation")
        if not 0.0 < limit < 2.0:
            message = f"fluctuation = {limit:g}: it must be more than 0 and less than 2"
            raise InputError(message, kind="bad_fluctuation", value=limit)
        steady = steady_state(machine, None, turns, None, limit, mean=mean, **STEADY_OPTIONS)
        return SteadyFlywheel(machine, steady)
    if not constant:
        message = (
            f"{machine.motor!r} is not a constant motor, which mean_speed needs: omit "
            "mean_speed, or build the machine without a motor"
        )
        raise InputError(message)
    asked = fluctuation, mean_speed, mean, turns, on_error
    if machine.shape and machine.core.follows[0]:
        # Each design has its own coordinates at which the loads are not smooth.
        made: Flywheel = FlywheelOfDesigns.of(machine, asked, _from_tables)
    else:
        made = _from_tables(machine, *asked)
    if isinstance(machine.motor, ConstantTorque):
        motor_moment = float(machine.motor.ratio) * float(torque)
        off = np.abs(np.asarray(made.motor_moment) - motor_moment) > TORQUE_RTOL * abs(motor_moment)
        if off.any():
            needed = np.asarray(made.motor_moment).ravel()[int(np.argmax(off))]
            message = (
                f"the motor gives the driver {motor_moment:g} N·m, the loads take {needed:g} on "
                "average: the flywheel is sized for the loads"
            )
            warnings.warn(message, AssurWarning, stacklevel=3)
    return made


def _from_tables(
    machine: MachineModel, fluctuation: Any, mean_speed: Any, mean: Any, turns: int, on_error: str
) -> Flywheel:
    """Refine tables of moment and inertia until the flywheel converges."""
    cycle = 2.0 * math.pi * turns
    knots = _knots(machine, cycle)
    jumps = _jumps(machine, knots, cycle)
    speed = finite_array(mean_speed, "mean_speed")
    if speed.ndim and speed.shape != machine.shape:
        message = (
            f"mean_speed has the shape {speed.shape}, the designs {machine.shape}: a number, or "
            "one for each design"
        )
        raise InputError(message)
    last: Flywheel | None = None
    rows = FIRST_ROWS
    while True:
        phi, at, corners = _table_rows(knots, jumps, rows)
        own_speed = speed[..., np.newaxis] if speed.ndim else speed
        inertia, _, moment, _ = reduce(machine, at, own_speed, on_error)
        if last is None:
            aperiodic = _aperiodic_designs(
                machine, (at, cycle), own_speed, on_error, inertia, moment
            )
        inertia[aperiodic], moment[aperiodic] = math.nan, math.nan
        # The last row equals the first up to rounding: make it exact.
        moment[..., -1, :], inertia[..., -1, :, :] = moment[..., 0, :], inertia[..., 0, :, :]
        made = tabulated_flywheel(
            phi,
            moment[..., 0],
            inertia[..., 0, 0],
            "not-a-knot",
            "fluctuation",
            ((fluctuation, "fluctuation"), (speed, "mean_speed")),
            mean,
            on_error,
            None,
            corners,
        )
        if last is not None:
            size = np.asarray(made.inertia) + inertia[..., 0, 0].max(axis=-1)
            change = np.abs(np.asarray(made.inertia) - np.asarray(last.inertia)) / size
            if not (change > CONVERGED_RTOL).any():
                return made
        if rows == LAST_ROWS:
            message = (
                f"tables of {rows} rows still change the flywheel by {float(np.nanmax(change)):.1e}"
                ": a function among the loads is not smooth (a Table is cut at its knots)"
            )
            warnings.warn(message, AssurWarning, stacklevel=4)
            return made
        last, rows = made, 2 * rows


def _aperiodic_designs(
    machine: MachineModel,
    cycle: tuple[Any, float],
    speed: Any,
    on_error: str,
    inertia: Any,
    moment: Any,
) -> Any:
    """Find designs whose inertia or moment does not repeat after a cycle; raise if asked to.

    The cycle is given by its coordinates and its length.
    """
    phi, length = cycle
    aperiodic = np.zeros(machine.shape, bool)
    later, _, later_moment, _ = reduce(machine, phi + length, speed, on_error)
    # Inertia times squared speed is the scale of a moment's rounding error.
    of_inertia = np.nanmax(np.abs(_flat(machine, inertia)), axis=-1, initial=0.0)
    floor = (
        MOMENT_ROUNDING_RTOL
        * of_inertia
        * np.square(np.max(speed, axis=-1) if np.ndim(speed) else speed)
    )
    for name, kind, first_rows, second_rows, least in (
        ("inertia", "inertia_not_periodic", inertia, later, 0.0),
        ("moment", "not_periodic", moment, later_moment, floor),
    ):
        first, second = _flat(machine, first_rows), _flat(machine, second_rows)
        size = np.nanmax(np.abs(first), axis=-1, initial=0.0)
        off = np.nanmax(np.abs(second - first), axis=-1, initial=0.0)
        differ = off > PERIODIC_RTOL * size + least
        if not differ.any():
            continue
        aperiodic |= differ
        if on_error == "nan":
            continue
        design = tuple(int(i) for i in np.argwhere(differ)[0])
        row = int(np.nanargmax(np.abs(second - first)[design]))
        q, value = float(phi[row]), float(first[design][row])
        unit = "kg·m²" if name == "inertia" else "N·m"
        over = "a turn" if length < 7.0 else f"{length:g} rad"
        message = (
            f"{f'design {design}: ' if design else ''}the reduced {name} is not periodic over "
            f"{over}: it is {value:g} {unit} at q = {q:g}, but {second[design][row]:g} {over} on; "
            "pass turns= if its cycle is longer"
        )
        raise MotionError(message, kind=kind, design=design or None, q=q, value=value)
    return aperiodic


def _flat(machine: MachineModel, array: Any) -> Any:
    """Reshape to one row per design."""
    return array.reshape(*machine.shape, -1)


def _jumps(machine: MachineModel, knots: list[float], cycle: float) -> list[bool]:
    """Return at which of the knots of a cycle loads may jump."""
    jumps = jumps_between(machine, -PERIOD_RTOL, cycle + PERIOD_RTOL)
    # The seam is at both ends.
    every = np.concatenate([jumps, jumps + cycle, jumps - cycle, [math.inf]])
    return [bool(np.abs(every - q).min() <= PERIOD_RTOL) for q in knots]


def _knots(machine: MachineModel, cycle: float) -> list[float]:
    """Return the coordinates of a cycle at which loads are not smooth, its ends included."""
    places = {0.0, cycle, *stations_between(machine, 0.0, cycle)}
    tables = zip(machine.core.tables, machine.core.rows, strict=True)
    for ((first, last), periodic), rows in tables:
        period = last - first
        require_whole_periods(period if periodic else None, cycle)
        within = rows[: MAX_KNOTS + 1].tolist()
        steps = range(math.floor(-first / period) - 1, math.ceil((cycle - first) / period) + 1)
        for shift in steps:
            places |= {q + shift * period for q in within}
            if len(places) > MAX_KNOTS:
                message = f"a table's period of {period:g} rad has too many knots in a cycle"
                raise InputError(message, value=period)
    knots = sorted(q for q in places if 0.0 <= q <= cycle)
    # Knots closer than this are the same but for rounding.
    kept = [q for q, before in zip(knots, [-1.0, *knots], strict=False) if q - before > PERIOD_RTOL]
    return [*(q for q in kept if q < cycle - PERIOD_RTOL), cycle]


def _table_rows(knots: list[float], jumps: list[bool], rows: int) -> tuple[Any, Any, list[int]]:
    """Return coordinates with a row at every knot, two at a jump, and the indices of the knots.

    The second array has the coordinates at which loads are evaluated: beside a jump, not at it.
    """
    parts, places, corners = [], [], [0]
    for index, (low, high) in enumerate(itertools.pairwise(knots)):
        count = max(MIN_ROWS_BETWEEN_KNOTS, math.ceil(rows * (high - low) / (2.0 * math.pi)))
        piece = np.linspace(low, high, count, endpoint=False)
        if jumps[index + 1]:
            piece = np.append(piece, high)
        at = piece.copy()
        at[0] += BESIDE * jumps[index]
        at[-1] -= BESIDE * jumps[index + 1]
        parts.append(piece)
        places.append(at)
        corners.append(corners[-1] + piece.size)
    last = knots[-1] + BESIDE * jumps[-1]
    return (
        np.append(np.concatenate(parts), knots[-1]),
        np.append(np.concatenate(places), last),
        corners,
    )
