"""Bodies, motors and tables of a machine, checked before the core reads them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from assur import _trig
from assur._arrays import Float, real_array, short
from assur._validate import checked_name, require_rows
from assur.dynamics.loads.loads import Body, Force, Load
from assur.dynamics.loads.motors import checked_motor
from assur.errors import InputError

if TYPE_CHECKING:
    from assur.dynamics.loads.motors import Motor
    from assur.kinematics.mechanism import Mechanism


def check_types(mechanism: Any, bodies: Any) -> None:
    """Raise InputError for a mechanism or bodies of a wrong type."""
    if not hasattr(mechanism, "q0"):
        message = f"{short(mechanism)} is not an assur.Mechanism"
        raise InputError(message)
    if not isinstance(bodies, Mapping):
        message = f"bodies is {short(bodies)}: a mapping of links to assur.Body is needed"
        raise InputError(message)


def motors(motor: Any, drivers: int) -> list[Motor | None]:
    """Return a motor or None for each driver."""
    if motor is None:
        return [None] * drivers
    many = [motor] if drivers == 1 and not isinstance(motor, list | tuple) else motor
    if not isinstance(many, list | tuple) or len(many) != drivers:
        needed = f"{drivers} drivers need a sequence of {drivers} motors (None: no motor)"
        message = f"motor is {short(motor)}: {needed}"
        raise InputError(message)
    return [None if item is None else checked_motor(item) for item in many]


def body(mechanism: Mechanism, link: Any, body: Any) -> tuple[str, Body]:
    """Return a link and its body, if they fit the mechanism."""
    if not isinstance(link, str):
        message = f"bodies has {short(link)}: names of links are needed"
        raise InputError(message)
    link = checked_name(link, "bodies")
    if not isinstance(body, Body):
        message = f"bodies[{link!r}] is {short(body)}: an assur.Body is needed"
        raise InputError(message)
    joints = mechanism.links.get(link, ())
    at = body.at
    if isinstance(at, str) and link in mechanism.links and at not in joints:
        message = f"bodies[{link!r}]: joint {at!r} is not one of its joints {', '.join(joints)}"
        raise InputError(message, joint=at, link=link)
    return link, body if body.drawn is None else _in_its_frame(mechanism, link, body)


def _in_its_frame(mechanism: Mechanism, link: str, body: Body) -> Body:
    """Return a body whose centre of mass is given in the drawing, with its place in the link."""
    mechanism.core.index_of("link", link)
    if mechanism.shape:
        message = (
            f"bodies[{link!r}]: drawn is in the drawing of one design, this is a batch "
            f"{mechanism.shape}: make the machine of one, then machine.of(batch); or give at"
        )
        raise InputError(message, link=link)
    assert body.drawn is not None
    x, y = body.drawn
    if link != "ground":
        origin, axis = _frame(mechanism, link)
        local = (complex(x, y) - origin) * axis.conjugate()
        x, y = local.real, local.imag
    if not np.isfinite([x, y]).all():
        message = (
            f"bodies[{link!r}]: drawn needs the mechanism's drawing, but this design cannot be "
            "assembled at its q0: give at"
        )
        raise InputError(message, link=link)
    return Body(mass=body.mass, inertia=body.inertia, at=(x, y))


def _frame(mechanism: Mechanism, link: str) -> tuple[complex, complex]:
    """Return the origin and the direction of x of a moving link's frame, at `q0`."""
    at = [complex(*mechanism.joints[joint]) for joint in mechanism.links[link][:2]]
    if len(at) == 2:
        span = at[1] - at[0]
        length = math.sqrt(span.real * span.real + span.imag * span.imag)
        return at[0], span / length
    motion = mechanism.solve(mechanism.q0_array, order=0, on_error="nan")
    sine, cosine = _trig.sin_cos(motion.link(link).value)
    return complex(*motion.reference_points[link].value), complex(cosine, sine)


def load(mechanism: Mechanism, load: Load) -> Load:
    """Return a load, if the link that takes it has the point where it acts."""
    if not isinstance(load, Force) or load.on is None or load.on not in mechanism.links:
        return load
    at, on = load.at, load.on
    if isinstance(at, str) and at in mechanism.joint_names and at not in mechanism.links[on]:
        message = f'Force on: link "{on}" has no joint "{at}": name a link that has it'
        raise InputError(message, joint=at, link=on)
    if isinstance(at, tuple) and at[0] != on:
        message = (
            f'Force on: its point is on link "{at[0]}", which takes it, not "{on}": leave on out'
        )
        raise InputError(message, link=on)
    return load


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
    require_rows(x.size, 2, "the table")
    row = int(np.argmin(numbers["inertia"]))
    least = float(numbers["inertia"][row])
    if least < 0.0:
        message = f"the inertia is {least:g} kg·m² at phi = {x[row]:g} rad: it must not be negative"
        raise InputError(message, kind="negative", q=float(x[row]), value=least)
    return x, numbers


def as_list(value: Any, name: str) -> list[Any]:
    """Return a sequence as a list."""
    if isinstance(value, str | bytes) or not hasattr(value, "__iter__"):
        message = f"{name} must be a sequence, got {short(value)}"
        raise InputError(message)
    if getattr(value, "ndim", 1) == 0:
        message = f"{name} must be a sequence, got {short(value)}"
        raise InputError(message)
    try:
        return list(value)
    except TypeError as error:  # A single mechanism is not a batch of designs.
        message = f"{name} must be a sequence, got {short(value)}"
        raise InputError(message) from error
