"""The inverse question: where coordinates have given values.

The coordinates drive in place of the drivers, locked at the values; all assemblies of that
mechanism are the answers. Near a position one of them is followed by Newton's iteration.
"""

from __future__ import annotations

import warnings
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import as_number, counted, real_number, short
from assur._callers import level_of_caller
from assur._validate import checked_name, checked_names, checked_threads, real_array
from assur.errors import AssurWarning, InputError
from assur.kinematics.assembly import Assembly
from assur.kinematics.inverse.driven_by import inverse_of
from assur.kinematics.inverse.near import follow
from assur.kinematics.inverse.request import InverseRequest
from assur.kinematics.inverse.solutions import InversePath, InverseSolution, InverseSolutions
from assur.kinematics.model import Place

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.kinematics.model import MechanismModel

__all__ = ["InversePath", "InverseSolution", "InverseSolutions", "find"]


def find(
    mechanism: MechanismModel,
    name: Any,
    value: Any,
    deg: Any,
    near: Any,
    threads: Any,
) -> list[InverseSolution] | InverseSolutions | InverseSolution | InversePath:
    """See `Mechanism.find`."""
    names = _coordinates(mechanism, name)
    if deg is not None:
        value = _angle(mechanism, name, value, deg)
    elif value is None:
        message = (
            f"find({name!r}): neither value nor deg is given: pass the value that it is to have"
        )
        raise InputError(message)
    request = InverseRequest.of(mechanism, names, value)
    if not request.is_single:
        request.warn_if_degrees()
        return follow(request, near, threads) if near is not None else _all(request, threads)
    checked_threads(threads)
    if not np.isfinite(request.values).all():
        drivers = mechanism.driver_count
        need = "a finite number" if drivers == 1 else "finite numbers"
        message = f"value is {short(value)}: with {counted(drivers, 'driver')} {need} is needed"
        raise InputError(message)
    request.warn_of_turns()
    if near is not None:
        return follow(request, near, threads)
    return _find_one(names, mechanism, request.values)


def _coordinates(mechanism: MechanismModel, name: Any) -> tuple[str, ...]:
    """Return the names of as many coordinates as there are drivers: "P" is those of a joint."""
    drivers = mechanism.driver_count
    if isinstance(name, str) or drivers == 1:
        known = checked_name(name, "find")
        if drivers == 1:
            return (known,)
        if drivers == 2:
            mechanism.core.index_of("joint", known)
            return (f"{known}.x", f"{known}.y")
    names = tuple(checked_names(name, "find"))
    if len(set(names)) != drivers or len(names) != drivers:
        message = (
            f"find({short(name)}): the {counted(drivers, 'driver')} of this mechanism need as many "
            f"different coordinates: a list of names"
        )
        raise InputError(message)
    return names


def _find_one(
    names: tuple[str, ...], mechanism: MechanismModel, values: Float
) -> list[InverseSolution]:
    """Return every position of one design for one value of each coordinate."""
    inverse = inverse_of(mechanism, names)
    found, failures, is_complete = inverse.find(
        mechanism.core, mechanism.values, values.ravel().tolist()
    )
    if not is_complete:
        given = zip(names, values.ravel().tolist(), strict=True)
        at = ", ".join(f"{name} = {value:.6g}" for name, value in given)
        message = f"find({at}): the list may be incomplete: {failures[0]}"
        warnings.warn(message, AssurWarning, stacklevel=level_of_caller())
    return [
        InverseSolution(
            as_number(q[0] if len(q) == 1 else np.array(q)),
            Assembly._found(Place(mechanism, tuple(at), numbers), ()),
        )
        for q, at, numbers in found
    ]


def _all(request: InverseRequest, threads: Any) -> InverseSolutions:
    """Return every position of designs, for arrays of values."""
    mechanism, names = request.mechanism, request.names
    q, most, count, status = inverse_of(mechanism, names).find_rows(
        mechanism.core, request.rows, checked_threads(threads)
    )
    shape = request.shape
    tail = (most,) if len(names) == 1 else (most, len(names))
    every = np.broadcast_to(request.values, (*shape, len(names)))
    return InverseSolutions(
        q.reshape(*shape, *tail),
        count.reshape(shape),
        status.reshape(shape),
        mechanism,
        every,
        partial(_find_one, names),
    )


def _angle(mechanism: MechanismModel, name: Any, value: Any, deg: Any) -> Float:
    """Return the angle that is given in degrees, rad."""
    if value is not None:
        message = f"find({name!r}): both value and deg are given: pass one of them"
        raise InputError(message)
    if not isinstance(name, str) or name not in mechanism.links:
        message = f"find({name!r}): deg is for the angle of a link; {name!r} is measured in m"
        raise InputError(message)
    degrees = real_array(deg, "deg")
    if not degrees.ndim:
        real_number(float(degrees), "deg")
    return degrees * (np.pi / 180.0)
