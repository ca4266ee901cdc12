"""The machine of a file, and the results that it asks for, as text."""

from __future__ import annotations

import inspect
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import finite_array
from assur.dynamics.loads.pressure import Gas
from assur.dynamics.loads.table import Table
from assur.errors import InputError
from assur.files.limits import MOST_ITEMS
from assur.files.parts import PARTS, ROWS
from assur.files.ranges import Range
from assur.files.read_machine import NO_MOTOR
from assur.files.toml import key_text, table_text
from assur.files.wanted import RANGE, WANTED

if TYPE_CHECKING:
    from collections.abc import Mapping

    from assur.dynamics.loads.motors import Motor
    from assur.dynamics.model import MachineModel


def machine_sections(machine: MachineModel) -> list[str]:
    """Return the sections of a machine."""
    bodies = [(key_text(link), part(b, f"bodies[{link!r}]")) for link, b in machine.bodies.items()]
    sections = [table_text("[bodies]", bodies)]
    if len(machine.loads) > MOST_ITEMS:
        message = f"the machine has {len(machine.loads)} loads: a file may have {MOST_ITEMS}"
        raise InputError(message)
    for i, load in enumerate(machine.loads):
        sections.append(table_text("[[loads]]", _typed(load, f"loads[{i}]").items()))
    if isinstance(machine.motor, tuple):
        for i, motor in enumerate(machine.motor):
            sections.append(table_text("[[motor]]", _motor(motor, f"motor[{i}]").items()))
    elif machine.motor is not None:
        sections.append(table_text("[motor]", _motor(machine.motor, "motor").items()))
    if machine.friction:
        pairs = machine.friction.items()
        friction = [(key_text(name), part(one, f"friction[{name!r}]")) for name, one in pairs]
        sections.append(table_text("[friction]", friction))
    return sections


def _motor(motor: Motor | None, what: str) -> dict[str, Any]:
    return {"type": NO_MOTOR} if motor is None else _typed(motor, what)


def _typed(thing: Any, what: str) -> dict[str, Any]:
    name = type(thing).__name__
    return {"type": name, **part(thing, f"{what}, the {name}")}


def part(thing: Any, what: str) -> dict[str, Any]:
    """Return what a part was given, without what it has by default."""
    if type(thing) not in PARTS:
        message = f"{what} is of a class that a file cannot hold"
        raise InputError(message)
    parameters = inspect.signature(type(thing)).parameters
    given = {}
    for name in PARTS[type(thing)]:
        value = getattr(thing, name)
        if isinstance(thing, Table) and name == "periodic" and value == (thing.over is None):
            continue
        # By its repr: -0.0 is not 0.0.
        if repr(value) != repr(parameters[name].default):
            given[name] = _value(value, f"{what}: {name}")
    return given


def _value(value: Any, what: str) -> Any:
    if isinstance(value, Table):
        rows = part(value, what)
        if value.over is not None:
            rows["over"] = value.over
        return {name: one for name, one in rows.items() if name in ROWS}
    if isinstance(value, Gas):
        return part(value, what)
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, tuple):
        return [_value(one, what) for one in value]
    if callable(value):
        message = f"{what} is a function, which a file cannot hold: give a number or a Table"
        raise InputError(message)
    return value


def wanted_sections(wanted: Mapping[str, Mapping[str, Any]]) -> list[str]:
    """Return the sections of results that a file asks for."""
    sections = []
    for name, arguments in wanted.items():
        unknown = [key for key in arguments if key not in WANTED[name]]
        if unknown:
            message = f"wanted: a file has no {unknown[0]!r} of {name!r}"
            raise InputError(message)
        entries = [(key, _argument(value, f"{name}: {key}")) for key, value in arguments.items()]
        sections.append(table_text(f"[{name}]", entries))
    return sections


def _argument(value: Any, what: str) -> Any:
    if isinstance(value, Range):
        given = {name: getattr(value, name) for name in RANGE}
        if value.endpoint:
            given["endpoint"] = None
        return {k: _argument(one, f"{what}.{k}") for k, one in given.items() if one is not None}
    if isinstance(value, str | bool):
        return value
    if isinstance(value, list | tuple) and all(isinstance(one, str) for one in value):
        return value
    plain = finite_array(value, what).tolist()
    # Whole numbers stay whole: max_steps.
    return int(value) if isinstance(value, int) else plain
