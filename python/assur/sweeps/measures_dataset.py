"""The metrics of a sweep as an xarray Dataset."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Any

import numpy as np

from assur.kinematics.table import dimension_column

if TYPE_CHECKING:
    import xarray as xr

    from assur.sweeps._measured import Measured
    from assur.sweeps.designs import Designs


def dataset(measures: Measured, degrees: bool) -> xr.Dataset:
    """See `Measures.to_xarray`."""
    try:
        import xarray as xr
    except ImportError as error:  # pragma: no cover
        message = "to_xarray needs xarray: pip install assur[xarray]"
        raise ImportError(message) from error
    designs, shape = measures._designs, measures.shape
    axes = {name: axes_of(designs, name) for name in designs.changed}
    names = axis_names(axes, len(shape))
    coordinates = {}
    for name, its_axes in axes.items():
        values = designs.values(name).reshape(shape)
        at = tuple(slice(None) if axis in its_axes else 0 for axis in range(len(shape)))
        column = dimension_column(name, values[at], degrees)
        own = [names[axis] for axis in its_axes]
        coordinates[name] = (own, column.values, {"units": column.unit})
    kept = np.isin(np.arange(measures.status.size), measures.kept).reshape(shape)
    variables: dict[str, Any] = {"status": (names, measures.status), "kept": (names, kept)}
    taken = {*names, *coordinates, *variables}
    for name, values in measures.items():
        shown = f"metric {name}" if name in taken else name
        column = measures._metric_column(name, shown, values, degrees)
        variables[shown] = (names, column.values, {"units": column.unit})
    return xr.Dataset(variables, coordinates)


def axes_of(designs: Designs, name: str) -> list[int]:
    """Return the axes of the designs along which a dimension was given."""
    column = np.asarray(designs._columns[designs.changed[name]])
    # Along the others it is broadcast.
    return [axis for axis, step in enumerate(column.strides) if step and column.shape[axis] > 1]


def axis_names(axes: dict[str, list[int]], count: int) -> list[str]:
    """Return the name of each axis: that of the dimension that changes along it alone."""
    along = Counter(axis for its_axes in axes.values() for axis in its_axes)
    names = ["design"] if count == 1 else [f"design{axis}" for axis in range(count)]
    for name, its_axes in axes.items():
        if len(its_axes) == 1 and along[its_axes[0]] == 1:
            names[its_axes[0]] = name
    return names
