"""The position nearest to a given one, and positions that follow it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import as_number, real_array, short
from assur._validate import checked_threads
from assur.errors import InputError, PositionError
from assur.kinematics.assembly import Assembly, drawn_in
from assur.kinematics.inverse.driven_by import inverse_of
from assur.kinematics.inverse.solutions import InversePath, InverseSolution
from assur.kinematics.solve_arguments import checked_assembly

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.kinematics.inverse.request import InverseRequest
    from assur.kinematics.model import MechanismModel


def follow(request: InverseRequest, near: Any, threads: Any) -> InverseSolution | InversePath:
    """Return the position that is near another one, or those along values from there on."""
    mechanism, names = request.mechanism, request.names
    assembly: Assembly | None = None
    if isinstance(near, InverseSolution):
        near, assembly = near
    start = _start(mechanism, near)
    drawn, signs = mechanism, mechanism.signs
    if assembly is not None:
        drawn = drawn_in(mechanism, assembly)
        signs = checked_assembly(mechanism, assembly) if drawn is mechanism else drawn.signs
    q, status = inverse_of(mechanism, names).follow(
        drawn.core, signs, start.reshape(-1), request.rows, checked_threads(threads)
    )
    kept = assembly if assembly is not None else mechanism_assembly(mechanism)
    if request.is_single:
        if np.isnan(q).any():
            raise _not_reached(request, near)
        return InverseSolution(as_number(float(q[0]) if len(q) == 1 else q), kept)
    shape = request.shape
    tail = () if len(names) == 1 else (len(names),)
    return InversePath(q.reshape(*shape, *tail), status.reshape(shape), kept)


def mechanism_assembly(mechanism: MechanismModel) -> Assembly:
    """Return the assembly that the mechanism is drawn in."""
    if mechanism.place is not None and mechanism.place.is_traced:
        return Assembly._found(mechanism.place, ())
    return Assembly(dict(mechanism.core.assembly))


def _start(mechanism: MechanismModel, near: Any) -> Float:
    """Return the coordinates to start from: of all drivers, for all designs or for each."""
    start = real_array(near, "near")
    drivers, designs = mechanism.driver_count, mechanism.shape
    own = () if drivers == 1 else (drivers,)
    if start.shape not in (own, (*designs, *own)):
        one = "a number" if drivers == 1 else f"{drivers} numbers"
        of_each = f", or of each design: {(*designs, *own)}" if designs else ""
        message = f"near is {short(near)}: a coordinate of the drivers is needed, {one}{of_each}"
        raise InputError(message)
    if not np.isfinite(start).all():
        message = f"near is {short(near)}: finite coordinates are needed"
        raise InputError(message)
    return start


def _not_reached(request: InverseRequest, near: Any) -> PositionError:
    """Return the error for a value that the assembly does not reach."""
    given = zip(request.names, request.values.ravel().tolist(), strict=True)
    wanted = ", ".join(f"{name} = {value:.6g}" for name, value in given)
    message = (
        f"{wanted} is not reached in this assembly from near = {short(near)}: without near=, "
        "find() lists the positions of all assemblies"
    )
    return PositionError(message)
