"""Reduced inertia and moment by the core: checks of shapes, then its answer."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import numpy.typing as npt

from assur._arrays import Float, finite_array, real_array, short
from assur.dynamics.batch_results import dimensions, shape_of_results
from assur.dynamics.loads.load_values import function_values
from assur.errors import InputError
from assur.kinematics.solve_arguments import warn_if_degrees

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur.dynamics.model import MachineModel
    from assur.errors import AssurError


class Answer(NamedTuple):
    """Mass matrices, their derivatives, moments and potential energies, in a shape."""

    inertia: Float
    rates: Float
    moment: Float
    potential: Float
    shape: tuple[int, ...]
    # Of all positions, flat.
    q: Float
    speed: Float
    status: npt.NDArray[np.uint8]
    # The first position that does not exist.
    failure: AssurError | None


def answer(
    machine: MachineModel,
    q: npt.ArrayLike,
    speed: npt.ArrayLike | None,
    t: npt.ArrayLike = 0.0,
    sense: float | Sequence[float] | None = None,
) -> Answer:
    """Ask the core; without a speed no function is called, and the moments are not valid."""
    n = machine.driver_count
    x, v = real_array(q, "q"), finite_array(0.0 if speed is None else speed, "speed")
    if machine.mechanism is not None:
        warn_if_degrees(machine.mechanism, x)
    if n > 1 and (x.ndim == 0 or x.shape[-1] != n):
        message = f"q has the shape {x.shape}: with {n} drivers its last axis must be {n}"
        raise InputError(message)
    positions = x.shape if n == 1 else x.shape[:-1]
    shape = shape_of_results(machine, positions)
    full = shape if n == 1 else (*shape, n)
    try:
        x, v = np.broadcast_to(x, full), np.broadcast_to(v, full)
    except ValueError as error:
        message = f"speed has the shape {v.shape}, q {x.shape}: they do not fit"
        raise InputError(message) from error
    flat, speeds = np.ascontiguousarray(x).ravel(), np.ascontiguousarray(v).ravel()
    load_values, senses = np.empty(0), list[float]()
    if speed is not None:
        senses = checked_senses(machine, flat.reshape(-1, n), speeds.reshape(-1, n), sense)
        functions = machine.core.load_functions
        at = np.broadcast_to(np.asarray(t), shape).ravel()
        load_values = function_values(functions, flat.reshape(-1, n), speeds.reshape(-1, n), at)
    *arrays, status, failure = machine.core.reduce(
        dimensions(machine, each=True),
        flat,
        speeds,
        load_values,
        senses,
        None,
        list(machine.shape),
    )
    inertia, rates, moment, potential = arrays
    return Answer(
        inertia.reshape(*shape, n, n),
        rates.reshape(*shape, n, n, n),
        moment.reshape(*shape, n),
        potential.reshape(shape),
        shape,
        flat,
        speeds,
        status,
        failure,
    )


def checked_senses(
    machine: MachineModel, q: Float, speeds: Float, sense: float | Sequence[float] | None
) -> list[float]:
    """Return the sense in which each driver is about to move at rest, which some loads need."""
    if sense is not None:
        senses = real_array(sense, "sense").ravel()
        if senses.size != machine.driver_count or not np.isin(senses, (-1.0, 1.0)).all():
            needed = (
                "+1 or −1" if machine.driver_count == 1 else f"{machine.driver_count} of +1 or −1"
            )
            message = f"sense is {short(sense)}: {needed} is needed"
            raise InputError(message)
        listed: list[float] = senses.tolist()
        return listed
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
