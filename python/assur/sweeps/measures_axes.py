"""The axes of a sweep that a picture shows, with the values of their dimensions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import real_number, short
from assur.errors import InputError
from assur.sweeps.measures_dataset import axes_of, axis_names

if TYPE_CHECKING:
    from collections.abc import Mapping

    from assur._arrays import Float
    from assur.sweeps._measured import Measured

# A value of `at` matches one of the sweep's within this fraction of the greatest.
SAME = 1e-9
# What a picture shows.
MOST = 2


def shown_axes(
    measures: Measured, at: Mapping[str, float] | None
) -> tuple[list[tuple[str, Float]], np.ndarray[tuple[int, ...], np.dtype[np.intp]]]:
    """Return one or two dimensions with ascending values, and the designs' indices over them.

    Other dimensions of a grid must be held by `at`.
    """
    designs, shape = measures._designs, measures.shape
    along = {name: axes_of(designs, name) for name in designs.changed}
    names = axis_names(along, len(shape))
    indices = np.arange(measures.status.size).reshape(shape)
    axes: list[tuple[str, Float]] = []
    held = _held(at, [name for name in names if name in designs.changed])
    where: list[Any] = []
    for axis, name in enumerate(names):
        if shape[axis] == 1 and name not in held:
            where.append(0)
            continue
        if name not in designs.changed:
            several = (
                ", ".join(changed for changed, its_axes in along.items() if axis in its_axes)
                or "nothing"
            )
            message = (
                f"plot: axis {axis} of the designs changes {several}, not one dimension: "
                "sweep an assur.Grid of one or two dimensions"
            )
            raise InputError(message)
        values = np.moveaxis(designs.values(name).reshape(shape), axis, 0).reshape(shape[axis], -1)
        values = values[:, 0]
        if name in held:
            where.append(_place(name, values, held[name]))
            continue
        order = np.unique(np.where(np.isfinite(values), values, np.nan), return_index=True)[1]
        order = order[np.isfinite(values[order])]
        where.append(order)
        axes.append((name, values[order]))
    if not 1 <= len(axes) <= MOST:
        raise InputError(_many(axes))
    kept = [index for index in where if not isinstance(index, int)]
    grid = iter(np.ix_(*kept))
    chosen = tuple(index if isinstance(index, int) else next(grid) for index in where)
    return axes, indices[chosen]


def _held(at: Any, names: list[str]) -> dict[str, float]:
    pairs = {} if at is None else at
    if not hasattr(pairs, "items"):
        message = f"at is {short(at)}: names of dimensions with a value each are needed"
        raise InputError(message)
    held = {}
    for name, value in pairs.items():
        if name not in names:
            known = ", ".join(map(repr, names)) or "none"
            message = f"at: {short(name)} is not a dimension of the sweep's grid; there are {known}"
            raise InputError(message)
        held[name] = real_number(value, f"at[{name!r}]")
    return held


def _place(name: str, values: Float, value: float) -> int:
    """Return the index of a value."""
    gaps = np.abs(values - value)
    place = int(np.argmin(np.where(np.isfinite(gaps), gaps, np.inf)))
    if not gaps[place] <= SAME * max(float(np.nanmax(np.abs(values))), 1e-300):
        message = f"at[{name!r}] = {value:g} is not a value of the sweep; the nearest is "
        raise InputError(message + f"{values[place]!r}")
    return place


def _many(axes: list[tuple[str, Float]]) -> str:
    if not axes:
        return "plot: the sweep has one design alone: nothing to draw it over"
    fix = ", ".join(f"{name!r}: {values[0]:.6g}" for name, values in axes[MOST:])
    names = ", ".join(name for name, _ in axes)
    return (
        f"plot: the sweep has {len(axes)} dimensions ({names}), a map has two: "
        f"fix the others, as at={{{fix}}}"
    )
