"""Dimensions by name, from a mapping or from a table of pandas or xarray."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from assur._arrays import short
from assur._validate import checked_name, real_array
from assur.errors import InputError
from assur.kinematics.model import with_values

if TYPE_CHECKING:
    import numpy.typing as npt
    import pandas as pd
    import xarray as xr

    from assur.kinematics.model import AnyMechanism

    # What names and values of dimensions may come in; a `Grid` is a mapping.
    DimensionsLike: TypeAlias = (
        Mapping[str, npt.ArrayLike] | pd.DataFrame | pd.Series[float] | xr.Dataset
    )

__all__ = ["columns_of_designs", "dimensions_by_name", "with_dimensions"]

# Columns of this package's own tables of results that are not dimensions.
LABELS = re.compile(r"design\d*|status|kept")
# A column of row numbers, as pandas writes and reads it.
UNNAMED = re.compile(r"(Unnamed: 0)?")
# A name with one of these is meant to be a dimension.
ENDINGS = (".length", ".angle", ".offset")


def dimensions_by_name(dimensions: Any, known: Collection[str]) -> Mapping[Any, Any]:
    """Return dimensions by name from a mapping, a DataFrame, a Series or a Dataset.

    A DataFrame has a design in each row, a Series is one of them. Variables of a Dataset
    broadcast by the names of their axes, coordinates that are named like dimensions too.
    """
    if dimensions is None:
        return {}
    # pandas and xarray need not be installed; a Dataset is a mapping, of its coordinates too.
    if hasattr(dimensions, "data_vars"):
        import xarray as xr

        # Dimensions of a grid are coordinates.
        axes = [name for name in known if name in dimensions.coords]
        names = _of_table([*axes, *dimensions.data_vars], known)

        arrays = xr.broadcast(*(dimensions[name] for name in names))
        return {name: array.to_numpy() for name, array in zip(names, arrays, strict=True)}
    if hasattr(dimensions, "columns") and hasattr(dimensions, "itertuples"):
        names = _of_table(dimensions.columns, known)
        return {name: dimensions[name].to_numpy() for name in names}
    if hasattr(dimensions, "index") and hasattr(dimensions, "to_dict"):
        return {name: dimensions[name] for name in _of_table(dimensions.index, known)}
    if isinstance(dimensions, Mapping):
        return dimensions
    message = (
        f"dimensions is {short(dimensions)}: a mapping of names to values, a DataFrame, a Series "
        "or a Dataset is needed"
    )
    raise InputError(message)


def _of_table(names: Iterable[Any], known: Collection[str]) -> list[Any]:
    """Return the names that are dimensions; refuse a table without any."""
    listed = list(names)
    chosen = columns_of_designs(listed, known)
    if listed and not chosen:
        message = f"dimensions: no column is a dimension: {short(listed)}"
        raise InputError(message)
    return chosen


def columns_of_designs(names: Iterable[Any], known: Iterable[str]) -> list[Any]:
    """Return the names of a table's columns that are dimensions, or are meant to be.

    In a table of results, the metrics stand behind the columns ``status`` and ``kept``.
    """
    listed, dimensions = list(names), set(known)
    if len(set(listed)) < len(listed):
        twice = next(name for name in listed if listed.count(name) > 1)
        message = f"dimensions: the table has {short(twice)} twice"
        raise InputError(message)
    ends = [listed.index(word) for word in ("status", "kept") if word in listed]
    metrics = max(ends) if len(ends) == 2 else len(listed)
    return [
        name
        for place, name in enumerate(listed)
        if name in dimensions
        or not (
            (isinstance(name, str) and LABELS.fullmatch(name))
            or (place == 0 and UNNAMED.fullmatch("" if name is None else str(name)))
            or (place > metrics and not str(name).endswith(ENDINGS))
        )
    ]


def with_dimensions(
    mechanism: AnyMechanism,
    dimensions: Any = None,
    by_name: Mapping[str, npt.ArrayLike] = MappingProxyType({}),
) -> AnyMechanism:
    """See `Mechanism.with_dimensions`."""
    mapping = dimensions_by_name(dimensions, mechanism.core.dimension_names)
    changed = {**{checked_name(name, "dimensions"): v for name, v in mapping.items()}, **by_name}
    indices = [mechanism.core.dimension(name) for name in changed]
    new = [real_array(v, f"dimension {name!r}", copy=False) for name, v in changed.items()]
    try:
        shape = np.broadcast_shapes(mechanism.shape, *(array.shape for array in new))
    except ValueError as error:
        shapes = ", ".join(f"{n!r} {a.shape}" for n, a in zip(changed, new, strict=True))
        message = f"dimensions do not broadcast: {shapes}, designs {mechanism.shape}"
        raise InputError(message) from error
    replaced = dict(zip(indices, new, strict=True))
    values = np.empty((len(mechanism.values), *shape))
    for index, old in enumerate(mechanism.values):
        values[index] = replaced.get(index, old)
    if not shape:
        mechanism.core.check_dimensions(values.tolist())
    return with_values(mechanism, values)
