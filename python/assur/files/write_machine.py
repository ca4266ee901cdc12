"""The machine of a file, and the results that it asks for, as trees."""

from __future__ import annotations

import inspect
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import finite_array
from assur.dynamics.loads.pressure import Gas
from assur.dynamics.loads.table import Table
from assur.dynamics.preconditions import without_arrays
from assur.errors import InputError
from assur.files.limits import MOST_ITEMS
from assur.files.parts import PARTS, ROWS
from assur.files.ranges import Range
from assur.files.read_machine import NO_MOTOR
from assur.files.wanted import RANGE, WANTED

if TYPE_CHECKING:
    from collections.abc import Mapping

    from assur.dynamics.loads.motors import Motor
    from assur.dynamics.model import MachineModel


def machine_tree(machine: MachineModel) -> dict[str, Any]:
    """Return the tables of a machine."""
    without_arrays(machine, "a file")
    bodies = {link: part(body, f"bodies[{link!r}]") for link, body in machine.bodies.items()}
    tree: dict[str, Any] = {"bodies": bodies}
    if len(machine.loads) > MOST_ITEMS:
        message = f"the machine has {len(machine.loads)} loads: a file may have {MOST_ITEMS}"
        raise InputError(message)
    if machine.loads:
        tree["loads"] = [_typed(load, f"loads[{i}]") for i, load in enumerate(machine.loads)]
    if isinstance(machine.motor, tuple):
        tree["motor"] = [_motor(motor, f"motor[{i}]") for i, motor in enumerate(machine.motor)]
    elif machine.motor is not None:
        tree["motor"] = _motor(machine.motor, "motor")
    if machine.friction:
        pairs = machine.friction.items()
        tree["friction"] = {name: part(friction, f"friction[{name!r}]") for name, friction in pairs}
    return tree


def _motor(motor: Motor | None, what: str) -> dict[str, Any]:
    return {"type": NO_MOTOR} if motor is None else _typed(motor, what)


def _typed(thing: Any, what: str) -> dict[str, Any]:
    name = type(thing).__name__
    return {"type": name, **part(thing, f"{what}, the {name}")}


def part(thing: Any, what: str) -> dict[str, Any]:
    """Return the arguments of a part that differ from their defaults."""
    if type(thing) not in PARTS:
        message = f"{what} is of a class that a file cannot hold"
        raise InputError(message)
    parameters = inspect.signature(type(thing)).parameters
    arguments = {}
    for name in PARTS[type(thing)]:
        value = getattr(thing, name)
        if isinstance(thing, Table) and name == "periodic" and value == (thing.over is None):
            continue
        # By its repr: -0.0 is not 0.0.
        if repr(value) != repr(parameters[name].default):
            arguments[name] = _value(value, f"{what}: {name}")
    return arguments


def _value(value: Any, what: str) -> Any:
    if isinstance(value, Table):
        rows = part(value, what)
        if value.over is not None:
            rows["over"] = value.over
        return {name: column for name, column in rows.items() if name in ROWS}
    if isinstance(value, Gas):
        return part(value, what)
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, tuple):
        return [_value(item, what) for item in value]
    if callable(value):
        message = f"{what} is a function, which a file cannot hold: give a number or a Table"
        raise InputError(message)
    return value


def wanted_tree(wanted: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    """Return the tables of results that a file asks for."""
    tree = {}
    for name, arguments in wanted.items():
        unknown = [key for key in arguments if key not in WANTED[name]]
        if unknown:
            message = f"wanted: a file has no {unknown[0]!r} of {name!r}"
            raise InputError(message)
        tree[name] = {key: _argument(value, f"{name}: {key}") for key, value in arguments.items()}
    return tree


def _argument(value: Any, what: str) -> Any:
    if isinstance(value, Range):
        fields = {name: getattr(value, name) for name in RANGE}
        if value.endpoint:
            fields["endpoint"] = None
        return {
            k: _argument(field, f"{what}.{k}") for k, field in fields.items() if field is not None
        }
    if isinstance(value, str | bool):
        return value
    if isinstance(value, list | tuple) and all(isinstance(item, str) for item in value):
        return value
    plain = finite_array(value, what).tolist()
    # Whole numbers stay whole: max_steps.
    return int(value) if isinstance(value, int) else plain
