"""Shapes of batches: designs, machines with arrays, and their results."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur._arrays import Float
    from assur.dynamics.model import MachineModel
    from assur.dynamics.varied import Varied

__all__ = ["batch_shape", "design_index", "dimensions", "shape_of_results"]


def batch_shape(designs: tuple[int, ...], varied: Sequence[Varied]) -> tuple[int, ...]:
    """Return the shape of the machines: arrays and designs go together by NumPy's rules."""
    shape, names = designs, [f"designs {designs}"] if designs else []
    for of in varied:
        try:
            shape = np.broadcast_shapes(shape, of.values.shape)
        except ValueError as error:
            message = (
                f"{of.name}: {of.field} has the shape {of.values.shape}, which does not go with "
                f"{', '.join(names)}"
            )
            raise InputError(message) from error
        names.append(f"{of.name}: {of.field} {of.values.shape}")
    return shape


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


def design_index(
    designs: tuple[int, ...], shape: tuple[int, ...], index: int | tuple[int, ...]
) -> tuple[int, ...]:
    """Return the design of one machine of a batch."""
    number = np.broadcast_to(np.arange(int(np.prod(designs))).reshape(designs), shape)[index]
    return tuple(int(i) for i in np.unravel_index(int(number), designs))


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
