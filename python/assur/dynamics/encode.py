"""Bodies, loads, motors and tables of a machine: checked, and encoded for the core."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import Float, real_array, short
from assur._validate import checked_name
from assur.dynamics.loads import Body, Gravity
from assur.dynamics.motors import EncodedMotor
from assur.dynamics.motors import encode as encode_motor
from assur.errors import InputError

if TYPE_CHECKING:
    from assur.dynamics.callbacks import CallbackTable
    from assur.dynamics.loads import EncodedLoad, Load
    from assur.kinematics.mechanism import Mechanism


def loads(
    given: tuple[Load, ...], callbacks: CallbackTable
) -> tuple[list[float], list[EncodedLoad]]:
    """Return the sum of all gravity, and the other loads encoded."""
    gravity = np.zeros(2)
    encoded = []
    for load in given:
        if isinstance(load, Gravity):
            gravity = gravity + load.acceleration
        elif hasattr(load, "_encode"):
            encoded.append(load._encode(callbacks))
        else:
            message = f"{short(load)} is no load: Gravity, Force, Torque, Spring, Damper …"
            raise InputError(message)
    # Those of motors follow.
    callbacks.load_count = len(callbacks.functions)
    return gravity.tolist(), encoded


def motors(motor: Any, drivers: int, callbacks: CallbackTable) -> list[EncodedMotor]:
    """Encode the motors of the drivers, None for each without one."""
    if motor is None:
        return []
    many = [motor] if drivers == 1 and not isinstance(motor, list | tuple) else motor
    if not isinstance(many, list | tuple) or len(many) != drivers:
        wanted = f"{drivers} drivers need a sequence of as many (None: none)"
        message = f"motor is {short(motor)}: {wanted}"
        raise InputError(message)
    pairs = enumerate(many)
    return [encode_motor(one, driver, callbacks) for driver, one in pairs if one is not None]


def check_types(mechanism: Any, bodies: Any) -> None:
    """Raise InputError for a mechanism or bodies of a wrong type."""
    if not hasattr(mechanism, "q0"):
        message = f"{short(mechanism)} is no assur.Mechanism"
        raise InputError(message)
    if not isinstance(bodies, Mapping):
        message = f"bodies is {short(bodies)}: a mapping of links to assur.Body is needed"
        raise InputError(message)


def columns(phi: Any, moment: Any, inertia: Any) -> tuple[Float, dict[str, Float]]:
    """Check a table's coordinates, moments and inertias; one inertia holds for all rows."""
    x = real_array(phi, "phi")
    numbers = {"moment": real_array(moment, "moment"), "inertia": real_array(inertia, "inertia")}
    if x.ndim == 1 and numbers["inertia"].ndim == 0:
        numbers["inertia"] = np.full(x.shape, numbers["inertia"])
    for name, column in numbers.items():
        if x.ndim != 1 or x.shape != column.shape:
            message = f"phi has the shape {x.shape}, {name} {column.shape}: two lists are needed"
            raise InputError(message)
    if x.size < 2:
        message = f"the table has {x.size} rows: at least 2 are needed"
        raise InputError(message)
    row = int(np.argmin(numbers["inertia"]))
    least = float(numbers["inertia"][row])
    if least < 0.0:
        message = (
            f"the inertia is {least:g} kg·m² at phi = {x[row]:g} rad in the table, it must not be "
            "negative"
        )
        raise InputError(message, value=least)
    return x, numbers


def body(mechanism: Mechanism, link: Any, body: Any) -> tuple[str, Any, float, float]:
    """Encode a body: its link, where its centre of mass is, mass and inertia."""
    if not isinstance(link, str):
        message = f"bodies has {short(link)}: names of links are needed"
        raise InputError(message)
    checked_name(link, "bodies")
    if not isinstance(body, Body):
        message = f"bodies[{link!r}] is {short(body)}: an assur.Body is needed"
        raise InputError(message)
    joints = mechanism.links.get(link, ())
    at: Any = body.at
    if at is None and joints:
        at = joints[0]
    elif not isinstance(at, str):
        at = link, (0.0, 0.0) if at is None else at
    elif link in mechanism.links and at not in joints:
        message = f"bodies[{link!r}]: joint {at!r} is not one of its joints {', '.join(joints)}"
        raise InputError(message, joint=at, link=link)
    return link, at, body.mass, body.inertia
