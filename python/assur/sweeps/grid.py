"""Grids of dimensions: every combination of their values."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from assur._arrays import short
from assur._summary import shortened
from assur._validate import checked_name, real_array
from assur.errors import InputError

__all__ = ["Grid"]

Float: TypeAlias = npt.NDArray[np.float64]


class Grid(Mapping[str, Float]):
    """Every combination of the values of some dimensions.

    Parameters
    ----------
    dimensions : mapping of str to array_like
        The values of each dimension, m or rad: one axis of the grid each, in this order.
    **by_name : array_like
        The same by keyword, for names without a dot.

    Notes
    -----
    A grid is a mapping of names to arrays that broadcast, read-only: ``with_dimensions`` takes
    it too. Names are looked up when it is used.

    Examples
    --------
    >>> import assur, numpy as np
    >>> grid = assur.Grid({"coupler.length": np.linspace(2, 4, 5), "rocker.length": [2.0, 3.0]})
    >>> grid.shape
    (5, 2)
    >>> assur.FourBar(1.0, 3.0, 2.5, 3.0).with_dimensions(grid).shape
    (5, 2)
    """

    def __init__(
        self, dimensions: Mapping[str, npt.ArrayLike] | None = None, **by_name: npt.ArrayLike
    ) -> None:
        mapping: Any = {} if dimensions is None else dimensions
        if not isinstance(mapping, Mapping):
            message = f"dimensions is {short(mapping)}: a mapping of names to values is needed"
            raise InputError(message)
        all_axes = {
            **{checked_name(name, "dimensions"): v for name, v in mapping.items()},
            **by_name,
        }
        self._axes: dict[str, Float] = {}
        for axis, (name, values) in enumerate(all_axes.items()):
            array = real_array(values, f"dimension {name!r}")
            if array.ndim != 1:
                message = f"dimension {name!r} has shape {array.shape}: an axis of a grid has (n,)"
                raise InputError(message)
            after = len(all_axes) - axis - 1
            self._axes[name] = array.reshape(-1, *(1,) * after)
            self._axes[name].flags.writeable = False

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of values of each dimension."""
        return tuple(len(axis) for axis in self._axes.values())

    def __getitem__(self, name: str) -> Float:
        return self._axes[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._axes)

    def __len__(self) -> int:
        return len(self._axes)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Grid):
            return NotImplemented
        return list(self) == list(other) and all(np.array_equal(self[n], other[n]) for n in self)

    def __hash__(self) -> int:
        return hash(tuple((name, *axis.ravel().tolist()) for name, axis in self._axes.items()))

    def __reduce__(self) -> tuple[Any, ...]:
        # A copy is read-only too.
        return Grid, ({name: axis.ravel() for name, axis in self._axes.items()},)

    def __repr__(self) -> str:
        sizes = ", ".join(f"{name!r}: {len(axis)}" for name, axis in self._axes.items())
        return shortened(f"<assur.Grid {{{sizes}}}>")
