"""The designs of a sweep, block by block."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

from assur._arrays import short
from assur._validate import checked_name, real_array
from assur.errors import InputError
from assur.kinematics.drawn import in_assembly
from assur.kinematics.mechanism import Mechanism
from assur.kinematics.model import with_values
from assur.kinematics.named_dimensions import dimensions_by_name
from assur.sweeps.grid import Grid

if TYPE_CHECKING:
    from collections.abc import Mapping

Float: TypeAlias = npt.NDArray[np.float64]


class Designs:
    """Designs of a mechanism with dimensions that broadcast: no dimension is repeated."""

    def __init__(
        self, mechanism: Any, dimensions: Any, assembly: Mapping[str, int] | None = None
    ) -> None:
        if not isinstance(mechanism, Mechanism):
            message = f"mechanism is {short(mechanism)}: an assur.Mechanism is needed"
            raise InputError(message)
        # From here on it is drawn in the assembly, and so is what is returned.
        self.mechanism = mechanism = in_assembly(mechanism, assembly)
        by_name = dimensions_by_name(dimensions, mechanism.core.dimension_names)
        names = [checked_name(name, "dimensions") for name in by_name]
        indices = [mechanism.core.dimension(name) for name in names]
        new = [real_array(by_name[n], f"dimension {n!r}", copy=False) for n in names]
        # Designs are read later, when the caller may have changed their arrays (a grid's cannot
        # change).
        if not isinstance(dimensions, Grid):
            new = _copied(new)
        batch = mechanism.shape
        try:
            self.shape = np.broadcast_shapes(batch, *(array.shape for array in new))
        except ValueError as error:
            shapes = ", ".join(f"{n!r} {a.shape}" for n, a in zip(names, new, strict=True))
            message = f"dimensions do not broadcast: {shapes}, designs {batch}"
            raise InputError(message) from error
        columns: list[Float] = list(mechanism.values)
        for index, array in zip(indices, new, strict=True):
            columns[index] = array
        # One number, or one of each design.
        self._columns = [np.broadcast_to(c, self.shape) if np.ndim(c) else c for c in columns]
        self.changed = dict(zip(names, indices, strict=True))
        self.count = int(np.prod(self.shape, dtype=np.int64))
        if not self.shape:
            mechanism.core.check_dimensions([float(column) for column in columns])

    def some(self, which: slice | npt.NDArray[np.intp], memory: Float | None = None) -> Mechanism:
        """Return a batch of some of them, by their indices in C order.

        A block that the next one may overwrite needs no new `memory`.
        """
        places: Any = which
        count = len(range(*which.indices(self.count))) if isinstance(which, slice) else len(which)
        if len(self.shape) > 1:
            indices = np.arange(*which.indices(self.count)) if isinstance(which, slice) else which
            places = np.unravel_index(indices, self.shape)
        size = len(self._columns)
        if memory is None:
            memory = np.empty(size * count)
        values = memory[: size * count].reshape(size, count)
        for row, column in zip(values, self._columns, strict=True):
            row[:] = column[places] if np.ndim(column) else column
        return with_values(self.mechanism, values)

    @property
    def size(self) -> int:
        """Number of dimensions."""
        return len(self._columns)

    def all(self) -> Mechanism:
        """Return all of them."""
        values = np.empty((len(self._columns), *self.shape))
        for index, column in enumerate(self._columns):
            values[index] = column
        return with_values(self.mechanism, values)

    def values(self, name: str) -> Float:
        """Return a dimension that the sweep changes, for all designs in C order."""
        column = self._columns[self.changed[name]]
        values: Float = np.broadcast_to(column, self.shape).reshape(-1)
        return values


def _copied(arrays: list[Float]) -> list[Float]:
    """Copy arrays into one: a large one gets large pages, which are ten times as fast."""
    memory = np.empty(sum(array.size for array in arrays))
    copies, start = [], 0
    for array in arrays:
        copy = memory[start : start + array.size].reshape(array.shape)
        copy[...] = array
        copies.append(copy)
        start += array.size
    return copies
