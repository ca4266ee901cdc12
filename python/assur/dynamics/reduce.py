"""Reduced inertia and moment at many coordinates: checks of shapes, then the core."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np
import numpy.typing as npt

from assur._arrays import real_array
from assur._validate import one_of
from assur.errors import InputError, PositionError

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
    shape = _with_designs(positions, designs)
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
        given = machine._callbacks.load_values(flat.reshape(-1, n), speeds.reshape(-1, n))
    values = np.empty(0) if machine.mechanism is None else machine.mechanism._values
    dimensions = np.ascontiguousarray(values).ravel()
    *arrays, status = machine._core.reduce(dimensions, flat, speeds, given, None)
    # Above NEAR_SINGULAR, which still has analogues.
    failed = np.flatnonzero(status > 1)
    if on_error == "raise" and failed.size:
        _refuse(machine, x, shape, int(failed[0]))
    inertia, rates, moment, potential = arrays
    beyond = np.flatnonzero(np.isnan(moment).reshape(-1, n).any(axis=1) & (status < 2))
    if speed is not None and on_error == "raise" and beyond.size:
        at = flat.reshape(-1, n)[beyond[0]]
        message = f"q = {at[0]:g}: a load has no value there (a table ends, or a function gave nan)"
        raise InputError(message, q=x[np.unravel_index(int(beyond[0]), shape) if shape else ()])
    return (
        inertia.reshape(*shape, n, n),
        rates.reshape(*shape, n, n, n),
        moment.reshape(*shape, n),
        potential.reshape(shape),
    )


def _refuse(machine: MachineModel, q: Float, shape: tuple[int, ...], flat: int) -> None:
    entry = tuple(int(k) for k in np.unravel_index(flat, shape)) if shape else ()
    if machine.mechanism is None:
        message = f"q = {q[entry]:g} is beyond the table"
        raise InputError(message, q=q[entry])
    design = entry[: len(machine.shape)]
    one = machine.mechanism.design(design) if design else machine.mechanism
    why = one.solve(q[entry], order=1, on_error="nan").explain()
    where = f"design {design}: " if design else ""
    message = f"{where}{why}; reduced inertia and moment are undefined there"
    raise PositionError(message, q=q[entry], design=design or None)


def _with_designs(positions: tuple[int, ...], designs: tuple[int, ...]) -> tuple[int, ...]:
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
