"""Choosing designs and positions: what stands in brackets behind a batch or a motion."""

from __future__ import annotations

import operator
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import short
from assur.errors import InputError
from assur.kinematics.model import with_values

if TYPE_CHECKING:
    from assur.kinematics.model import AnyMechanism
    from assur.kinematics.motion_model import AnyMotion

FORMS = "an integer, a slice, a mask or indices are needed for each axis"


def designs_of(mechanism: AnyMechanism, index: Any) -> AnyMechanism:
    """See `Mechanism.__getitem__`."""
    if not mechanism.shape:
        message = f"[{short(index)}]: this is one mechanism, not a batch of designs"
        raise InputError(message)
    designs = np.moveaxis(mechanism.values, 0, -1)
    if isinstance(index, np.ndarray) and index.dtype == np.bool_ and index.ndim > 1:
        if index.shape != mechanism.shape:
            message = f"a mask of shape {index.shape} for designs {mechanism.shape}"
            raise InputError(message)
        values = designs[index]
    else:
        values = _taken(designs, _entries(index, mechanism.shape))
    if values.ndim == 1:
        mechanism.core.check_dimensions(values.tolist())
    return with_values(mechanism, np.array(np.moveaxis(values, -1, 0)))


def part_of(motion: AnyMotion, index: Any) -> AnyMotion:
    """See `Motion.__getitem__`."""
    entries = _entries(index, motion.shape)
    request = motion.request
    mechanism = request.mechanism
    designs = entries[: len(mechanism.shape)]
    positions = entries[len(designs) :]
    if designs:
        values = _taken(np.moveaxis(mechanism.values, 0, -1), designs)
        mechanism = with_values(mechanism, np.array(np.moveaxis(values, -1, 0)))

    def part(array: Any) -> Any:
        return _own(_taken(array, entries))

    q = part(motion.q) if request.per_design else _own(_taken(motion.q, positions))
    is_one = not positions or isinstance(positions[0], int)
    count = () if is_one else q.shape[len(mechanism.shape) * request.per_design :][:1]
    request = replace(request, mechanism=mechanism, q=q, positions=count)
    if not mechanism.shape:
        request = replace(request, per_design=False)
    chosen = object.__new__(type(motion))
    chosen._replace_with(request, motion._results.each(part), part(motion.status))
    if motion.kept is not None:
        chosen.kept = _taken(motion.kept, designs)
    return chosen


def _own(array: Any) -> Any:
    """Return a read-only copy: the core needs contiguous arrays."""
    copied = np.array(array, order="C")
    copied.flags.writeable = False
    return copied


def _entries(index: Any, shape: tuple[int, ...]) -> tuple[Any, ...]:
    """Return an integer, a slice or an array of indices for each axis."""
    entries = list(index) if isinstance(index, tuple) else [index]
    dots = [i for i, entry in enumerate(entries) if entry is Ellipsis]
    if len(dots) > 1 or len(entries) - len(dots) > len(shape):
        message = f"[{short(index)}] has more entries than the shape {shape} has axes"
        raise InputError(message)
    at = dots[0] if dots else len(entries)
    entries[at : at + 1] = [slice(None)] * (len(shape) - len(entries) + len(dots))
    return tuple(_entry(entry, size, shape) for entry, size in zip(entries, shape, strict=True))


def _entry(entry: Any, size: int, shape: tuple[int, ...]) -> Any:
    if isinstance(entry, slice):
        return entry
    try:
        array = np.asarray(entry)
    except ValueError as error:  # lists of different lengths
        message = f"[{short(entry)}]: {FORMS}"
        raise InputError(message) from error
    if array.dtype == np.bool_:
        if array.shape != (size,):
            message = f"a mask of shape {array.shape} for an axis of {size} of the shape {shape}"
            raise InputError(message)
        return np.flatnonzero(array)
    if array.size == 0:
        array = array.astype(np.intp)
    if array.ndim > 1 or array.dtype.kind not in "ui":
        message = f"[{short(entry)}]: {FORMS}"
        raise InputError(message)
    outside = array[(array < -size) | (array >= size)]
    if outside.size:
        message = f"[{short(entry)}]: {outside.flat[0]} is outside the shape {shape}"
        raise InputError(message)
    return operator.index(array[()]) if array.ndim == 0 else array


def _taken(array: Any, entries: tuple[Any, ...]) -> Any:
    """Index axes one after another, each by its own entry: a product, not NumPy's pairing."""
    axis = 0
    for entry in entries:
        array = array[(*(slice(None),) * axis, entry)]
        axis += not isinstance(entry, int)
    return array
