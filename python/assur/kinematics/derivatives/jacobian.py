"""Derivatives of a motion by drivers or dimensions, and their products with vectors."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import flag, short
from assur._validate import checked_name, real_array, whole_number
from assur.errors import InputError

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.kinematics.model import MechanismModel
    from assur.kinematics.motion_model import MotionModel
    from assur.kinematics.request import Kind, ResultKey

__all__ = ["jacobian", "jvp", "vjp"]

# Letters that make a name of a dimension a pattern.
WILD = "*?["
# Derivatives of the highest order that is solved need the next.
HIGHEST = 3


def jacobian(motion: MotionModel, of: Any, by: Any, order: Any) -> Float | dict[str, Float]:
    """See `Motion.jacobian`."""
    names = _names(of, "jacobian")
    order = whole_number(order, "order", 0, HIGHEST)
    if isinstance(by, str) and by == "q":
        found = {name: _by_drivers(motion, name, order) for name in names}
    else:
        keys = [_key(motion, name, order, "jacobian") for name in names]
        dimensions = named_dimensions(motion.request.mechanism, by)
        arrays, _ = motion.request.sensitivities(keys, dimensions)
        shapes = [(*_shape(motion, key), len(dimensions)) for key in keys]
        found = {
            name: array.reshape(shape)
            for name, array, shape in zip(names, arrays, shapes, strict=True)
        }
    return found[of] if isinstance(of, str) else found


def jvp(motion: MotionModel, of: Any, rates: Any, order: Any) -> Float | dict[str, Float]:
    """See `Motion.jvp`."""
    names = _names(of, "jvp")
    order = whole_number(order, "order", 0, HIGHEST)
    keys = [_key(motion, name, order, "jvp") for name in names]
    arrays, _ = motion.request.sensitivities(keys, [], rates=_rates(motion, rates))
    found = {
        name: array.reshape(_shape(motion, key))
        for name, array, key in zip(names, arrays, keys, strict=True)
    }
    return found[of] if isinstance(of, str) else found


def vjp(motion: MotionModel, weights: Any, by: Any, order: Any, total: bool = False) -> Float:
    """See `Motion.vjp`."""
    if not isinstance(weights, Mapping):
        message = f'weights is {short(weights)}: a mapping such as {{"P": array}} is needed'
        raise InputError(message)
    order = whole_number(order, "order", 0, HIGHEST)
    dimensions = named_dimensions(motion.request.mechanism, by)
    keys = [_key(motion, name, order, "vjp") for name in weights]
    flat = []
    for key, (name, given) in zip(keys, weights.items(), strict=True):
        shape = _shape(motion, key)
        values = real_array(given, f"weights of {name!r}")
        try:
            flat.append(np.ascontiguousarray(np.broadcast_to(values, shape)).reshape(-1))
        except ValueError:
            message = f"weights of {name!r} have the shape {values.shape}: {shape} is needed"
            raise InputError(message) from None
    total = flag(total, "total")
    designs = motion.request.mechanism.shape if total else motion.shape
    shape = (*designs, len(dimensions))
    if not keys:
        return np.zeros(shape)
    arrays, _ = motion.request.sensitivities(keys, dimensions, weights=flat, total=total)
    return arrays[0].reshape(shape)


def named_dimensions(mechanism: MechanismModel, by: Any) -> list[int]:
    """Return the indices of dimensions that are named, or stand for patterns, in their order."""
    given = [by] if isinstance(by, str) else by
    if not isinstance(given, list | tuple):
        message = f'by is {short(by)}: "q", or names of dimensions such as ["coupler.length"]'
        raise InputError(message)
    from fnmatch import fnmatchcase

    core = mechanism.core
    known = core.dimension_names
    indices: list[int] = []
    for name in given:
        if isinstance(name, str) and any(letter in name for letter in WILD):
            fitting = [i for i, dimension in enumerate(known) if fnmatchcase(dimension, name)]
            if not fitting:
                message = f"by: no dimension is like {name!r}; there are {', '.join(known)}"
                raise InputError(message)
            indices += fitting
        else:
            indices.append(core.dimension(checked_name(name, "by")))
    return indices


def require_once(names: list[str]) -> None:
    """Refuse a dimension that is given twice: only one of its values could count."""
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        message = f"by: {twice!r} is named twice"
        raise InputError(message)


def _by_drivers(motion: MotionModel, name: str, order: int) -> Float:
    """Return the derivatives by the drivers' coordinates: one driver has an axis, too."""
    kind = _kind(motion, checked_name(name, "jacobian"), "jacobian")
    analogues: Float = getattr(motion, kind)(name)._order(order + 1)
    return analogues[..., np.newaxis] if motion.driver_count == 1 else analogues


def _names(of: Any, call: str) -> list[str]:
    """Return the names of the results: one, or several."""
    if isinstance(of, str):
        return [of]
    if not isinstance(of, list | tuple):
        message = f"{call}: name is {short(of)}: a name, or a list of names, is needed"
        raise InputError(message)
    return [checked_name(name, call) for name in of]


def _key(motion: MotionModel, name: Any, order: int, call: str) -> ResultKey:
    """Return what the core knows a result by."""
    kind = _kind(motion, checked_name(name, call), call)
    getattr(motion, kind)(name)._order(order)
    return kind, motion.request.mechanism.core.index_of(kind, name), order


def _kind(motion: MotionModel, of: str, call: str) -> Kind:
    """Return what has this name among the outputs of the motion: a joint, a link or a slide."""
    results = motion._results
    if of in results.joints:
        return "joint"
    if of in results.links:
        return "link"
    if of in results.slides:
        return "slide"
    names = [*results.joints, *results.links, *results.slides]
    message = (
        f"{call} of {of!r}: there is no such output of this motion; there are "
        f"{', '.join(map(repr, names))}"
    )
    raise InputError(message)


def _shape(motion: MotionModel, key: ResultKey) -> tuple[int, ...]:
    """Return the shape of a result: components, then an axis of the drivers for each order."""
    kind, _, order = key
    components = (2,) if kind == "joint" else ()
    drivers = motion.driver_count
    return (*motion.shape, *components, *((drivers,) * order if drivers > 1 else ()))


def _rates(motion: MotionModel, rates: Any) -> Float:
    """Return the rates of all dimensions, flat: one for all designs, or design after design."""
    if not isinstance(rates, Mapping):
        message = f'rates is {short(rates)}: a mapping such as {{"crank.length": 1.0}} is needed'
        raise InputError(message)
    mechanism = motion.request.mechanism
    given = {name: real_array(value, f"rate of {name!r}") for name, value in rates.items()}
    each = any(value.ndim for value in given.values())
    shape = mechanism.shape if each else ()
    flat = np.zeros((*shape, len(mechanism.core.dimension_names)))
    for name, value in given.items():
        index = mechanism.core.dimension(checked_name(name, "jvp"))
        try:
            flat[..., index] = np.broadcast_to(value, shape)
        except ValueError:
            message = (
                f"rate of {name!r} has the shape {value.shape}: a number, or the shape of the "
                f"designs, {mechanism.shape}, is needed"
            )
            raise InputError(message) from None
    return flat.reshape(-1)
