"""What a batch gives to the core: the shape of its results, and its dimensions."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur.errors import InputError

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.dynamics.model import MachineModel

__all__ = ["dimensions", "shape_of_results"]


def shape_of_results(machine: MachineModel, positions: tuple[int, ...]) -> tuple[int, ...]:
    """Return the shape of results.

    q is a number, (N,) or S + (N,); of machines with arrays a number, S or S + (N,).
    """
    shape = machine.shape
    if not machine.varies:
        return _with_designs(positions, shape)
    leading = positions if len(positions) <= len(shape) else positions[:-1]
    try:
        if np.broadcast_shapes(leading, shape) == shape:
            return (*shape, *positions[len(shape) :]) if len(positions) > len(shape) else shape
    except ValueError:
        pass
    message = (
        f"q has the shape {positions}: with machines {shape} it is a number, {shape} or "
        f"{(*shape, 'N')}; for the same N states of every machine give it the shape "
        f"{(*(1 for _ in shape), 'N')}"
    ).replace("'N'", "N")
    raise InputError(message)


def dimensions(machine: MachineModel, each: bool = False) -> Float:
    """Return the dimensions of every design of a batch, or those of one design for all.

    `each`: of every machine.
    """
    mechanism = machine.mechanism
    if mechanism is None:
        return np.empty(0)
    values = mechanism.values
    designs = mechanism.shape
    if designs != machine.shape and (designs or each):
        axes = (1,) * (len(machine.shape) - len(designs))
        values = values.reshape(-1, *axes, *designs)
        values = np.broadcast_to(values, (len(values), *machine.shape))
    return np.ascontiguousarray(values).reshape(-1)


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
