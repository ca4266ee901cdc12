"""Reduced inertia and moment at many coordinates: checks of shapes, then the core."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np
import numpy.typing as npt

from assur._arrays import real_array
from assur._validate import one_of
from assur.description.words import Status
from assur.dynamics.values import function_values
from assur.errors import InputError

if TYPE_CHECKING:
    from assur.dynamics.model import MachineModel

Float: TypeAlias = npt.NDArray[np.float64]


def reduce(
    machine: MachineModel, q: npt.ArrayLike, speed: npt.ArrayLike | None, on_error: str
) -> tuple[Float, Float, Float, Float]:
    """Return mass matrices, their derivatives, moments and potential energies.

    Without a speed no function is called, and the moments are not valid.
    """
    one_of(on_error, ("raise", "nan"), "on_error")
    n, designs = machine._drivers, machine.shape
    x, v = real_array(q, "q"), real_array(0.0 if speed is None else speed, "speed")
    if n > 1 and (x.ndim == 0 or x.shape[-1] != n):
        message = f"q has the shape {x.shape}: with {n} drivers its last axis must be {n}"
        raise InputError(message)
    positions = x.shape if n == 1 else x.shape[:-1]
    shape = with_designs(positions, designs)
    full = shape if n == 1 else (*shape, n)
    if not np.isfinite(v).all():
        message = f"speed is {speed!r}: finite numbers are needed"
        raise InputError(message)
    try:
        x, v = np.broadcast_to(x, full), np.broadcast_to(v, full)
    except ValueError as error:
        message = f"speed has the shape {v.shape}, q {x.shape}: they do not fit"
        raise InputError(message) from error
    flat, speeds = np.ascontiguousarray(x).ravel(), np.ascontiguousarray(v).ravel()
    given = np.empty(0)
    if speed is not None:
        functions = machine._core.load_functions
        given = function_values(functions, flat.reshape(-1, n), speeds.reshape(-1, n))
    values = np.empty(0) if machine.mechanism is None else machine.mechanism._values
    *arrays, status, failure = machine._core.reduce(
        values.reshape(-1), flat, speeds, given, None, list(designs)
    )
    if on_error == "raise":
        if failure is not None:
            raise failure
        _require_within_table(machine, flat, status)
    inertia, rates, moment, potential = arrays
    beyond = np.flatnonzero(np.isnan(moment).reshape(-1, n).any(axis=1) & (status < 2))
    if speed is not None and on_error == "raise" and beyond.size:
        at = flat.reshape(-1, n)[beyond[0]].tolist()
        shown = ", ".join(f"{number:.15g}" for number in at)
        message = (
            f"q = {shown if n == 1 else f'({shown})'}: a load has no value there (a table ends, a "
            "function gave nan, or a damper or spring has length zero)"
        )
        raise InputError(message, q=at[0] if n == 1 else tuple(at))
    return (
        inertia.reshape(*shape, n, n),
        rates.reshape(*shape, n, n, n),
        moment.reshape(*shape, n),
        potential.reshape(shape),
    )


def _require_within_table(machine: MachineModel, q: Float, status: npt.NDArray[np.uint8]) -> None:
    beyond = np.flatnonzero(status > Status.NEAR_SINGULAR)
    if machine.mechanism is None and beyond.size:
        first = float(q[beyond[0]])
        message = f"q = {first:g} is beyond the table"
        raise InputError(message, q=first, value=first)


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
