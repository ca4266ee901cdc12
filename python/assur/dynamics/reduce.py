"""Reduced inertia and moment at many coordinates: checks of shapes, then the core."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from assur._arrays import Float, finite_array, real_array, short
from assur._validate import one_of
from assur.description.words import Status
from assur.dynamics.no_value import EXTEND, Moment, without_value
from assur.dynamics.values import function_values
from assur.errors import InputError
from assur.kinematics.solve_arguments import warn_if_degrees

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur.dynamics.model import MachineModel


def reduce(
    machine: MachineModel,
    q: npt.ArrayLike,
    speed: npt.ArrayLike | None,
    on_error: str,
    t: npt.ArrayLike = 0.0,
    sense: float | Sequence[float] | None = None,
) -> tuple[Float, Float, Float, Float]:
    """Return mass matrices, their derivatives, moments and potential energies.

    Without a speed no function is called, and the moments are not valid.
    """
    one_of(on_error, ("raise", "nan"), "on_error")
    n, designs = machine.driver_count, machine.shape
    x, v = real_array(q, "q"), finite_array(0.0 if speed is None else speed, "speed")
    if machine.mechanism is not None:
        warn_if_degrees(machine.mechanism, x)
    if n > 1 and (x.ndim == 0 or x.shape[-1] != n):
        message = f"q has the shape {x.shape}: with {n} drivers its last axis must be {n}"
        raise InputError(message)
    positions = x.shape if n == 1 else x.shape[:-1]
    shape = with_designs(positions, designs)
    full = shape if n == 1 else (*shape, n)
    try:
        x, v = np.broadcast_to(x, full), np.broadcast_to(v, full)
    except ValueError as error:
        message = f"speed has the shape {v.shape}, q {x.shape}: they do not fit"
        raise InputError(message) from error
    flat, speeds = np.ascontiguousarray(x).ravel(), np.ascontiguousarray(v).ravel()
    given, senses = np.empty(0), list[float]()
    if speed is not None:
        senses = checked_senses(machine, flat.reshape(-1, n), speeds.reshape(-1, n), sense)
        functions = machine.core.load_functions
        at = np.broadcast_to(np.asarray(t), shape).ravel()
        given = function_values(functions, flat.reshape(-1, n), speeds.reshape(-1, n), at)
    values = np.empty(0) if machine.mechanism is None else machine.mechanism.values
    *arrays, status, failure = machine.core.reduce(
        values.reshape(-1), flat, speeds, given, senses, None, list(designs)
    )
    if on_error == "raise":
        if failure is not None:
            raise failure
        _require_within_table(machine, flat, status)
    inertia, rates, moment, potential = arrays
    if speed is not None and on_error == "raise":
        missing = np.flatnonzero(~np.isfinite(moment).reshape(-1, n).any(axis=1) & (status < 2))
        if missing.size:
            row = int(missing[0])
            if machine.mechanism is None:
                raise _beyond_table(float(flat[row]), machine.core.tables[0][0])
            one, design = single(machine, row, status.size)
            own = flat.reshape(-1, n)[row], speeds.reshape(-1, n)[row]
            time = float(np.broadcast_to(np.asarray(t), shape).ravel()[row])
            failed = without_value(one, Moment(*own, time, sense), "the moment is")
            failed.design = design
            raise failed
    return (
        inertia.reshape(*shape, n, n),
        rates.reshape(*shape, n, n, n),
        moment.reshape(*shape, n),
        potential.reshape(shape),
    )


def require_potential(machine: MachineModel, q: npt.ArrayLike, potential: Float) -> None:
    """Raise the error of the first position without a potential energy: beyond a load's table."""
    missing = np.flatnonzero(np.isnan(potential))
    if not missing.size:
        return
    n, row = machine.driver_count, int(missing[0])
    x = real_array(q, "q")
    places = np.broadcast_to(x, potential.shape if n == 1 else (*potential.shape, n))
    one, design = single(machine, row, potential.size)
    # At no speed the loads of one sense only need none.
    moment = Moment(places.reshape(-1, n)[row], np.zeros(n), 0.0, [1.0] * n if n > 1 else 1.0)
    failed = without_value(one, moment, "the potential energy is")
    failed.design = design
    raise failed


def checked_senses(
    machine: MachineModel, q: Float, speeds: Float, sense: float | Sequence[float] | None
) -> list[float]:
    """Return in which sense each driver is about to move at rest, which some loads need."""
    if sense is not None:
        senses = real_array(sense, "sense").ravel()
        if senses.size != machine.driver_count or not np.isin(senses, (-1.0, 1.0)).all():
            wanted = (
                "+1 or −1" if machine.driver_count == 1 else f"{machine.driver_count} of +1 or −1"
            )
            message = f"sense is {short(sense)}: {wanted} is needed"
            raise InputError(message)
        found: list[float] = senses.tolist()
        return found
    rests = ~speeds.any(axis=1)
    has_ways = machine.core.follows[1]
    if (machine.friction or has_ways) and rests.any():
        shown = ", ".join(f"{number:.9g}" for number in q[np.argmax(rests)])
        what = "friction needs" if machine.friction else "a load with while_= needs a speed, or"
        message = (
            f"speed is 0 at q = {shown}: {what} sense=+1 or −1, the way in which the drive is "
            "about to move"
        )
        raise InputError(message, value=0.0)
    return []


def single(machine: MachineModel, row: int, positions: int) -> tuple[MachineModel, Any]:
    """Return the machine of one design, and the design's index in a batch, of a flat position."""
    if not machine.shape or machine.mechanism is None:
        return machine, None
    design = row // max(1, positions // math.prod(machine.shape))
    index = tuple(int(i) for i in np.unravel_index(design, machine.shape))
    own = machine.mechanism.design(index)
    return type(machine)(own, machine.bodies, machine.loads, machine.motor), index


def _require_within_table(machine: MachineModel, q: Float, status: npt.NDArray[np.uint8]) -> None:
    beyond = np.flatnonzero(status > Status.NEAR_SINGULAR)
    if machine.mechanism is None and beyond.size:
        raise _beyond_table(float(q[beyond[0]]), machine.core.tables[0][0])


def _beyond_table(q: float, knots: list[float]) -> InputError:
    hint = EXTEND
    message = (
        f"a table over q covers {knots[0]:.9g} to {knots[-1]:.9g}: {q:.9g} is not in it; {hint}"
    )
    return InputError(message, kind="table_ends", hint=hint, q=q, value=q)


def with_designs(positions: tuple[int, ...], designs: tuple[int, ...]) -> tuple[int, ...]:
    """Return the shape of the result: q is a number, (N,) or S + (N,)."""
    if not designs:
        return positions
    if len(positions) <= 1:
        return (*designs, *positions)
    try:
        np.broadcast_to(np.empty(positions[:-1]), designs)
    except ValueError as error:
        message = (
            f"q has the shape {positions}: with designs {designs} it is a number, (N,) or S + (N,)"
        )
        raise InputError(message) from error
    return (*designs, positions[-1])
