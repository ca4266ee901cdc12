"""Shapes of batches: designs and machines with arrays go together."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur.dynamics.varied import Varied

__all__ = ["batch_shape", "design_index"]


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


def design_index(
    designs: tuple[int, ...], shape: tuple[int, ...], index: int | tuple[int, ...]
) -> tuple[int, ...]:
    """Return the design of one machine of a batch."""
    number = np.broadcast_to(np.arange(int(np.prod(designs))).reshape(designs), shape)[index]
    return tuple(int(i) for i in np.unravel_index(int(number), designs))
