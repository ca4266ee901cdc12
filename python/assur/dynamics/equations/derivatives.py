"""Derivatives of efforts and accelerations: by states, dimensions and masses."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import short
from assur._validate import checked_name
from assur.dynamics.equations.terms import State, Terms, require_equations, terms_of
from assur.dynamics.loads.loads import Body, Gravity
from assur.errors import InputError
from assur.kinematics.derivatives.jacobian import named_dimensions

if TYPE_CHECKING:
    from collections.abc import Callable

    from assur._arrays import Float
    from assur.dynamics.equations.terms import Direction
    from assur.dynamics.model import MachineModel, OnError

__all__ = ["derivatives"]

# What the drivers do, which derivatives of efforts and of accelerations may be by.
WAYS = {"effort": ("q", "speed", "acceleration"), "acceleration": ("q", "speed", "effort")}
MASS, INERTIA = ".mass", ".inertia"


def derivatives(
    machine: MachineModel,
    term: str,
    state: State,
    by: Any,
    on_error: OnError,
    threads: int | None,
    with_mass: Callable[[str, Body], MachineModel],
) -> Float:
    """See `Machine.d_effort` and `d_acceleration`.

    `with_mass` makes the machine that has one body alone, and the same weights.
    """
    call = f"d_{term}"
    require_equations(machine, call)
    refuse_functions(machine, call)
    given = [by] if isinstance(by, str) else by
    if not isinstance(given, list | tuple):
        message = f'by is {short(by)}: "q", "speed" or names such as ["rod.length", "rod.mass"]'
        raise InputError(message)
    parts = [_part(machine, call, WAYS[term], name) for name in given]
    n = machine.driver_count
    directions = [direction for part in parts if isinstance(part, list) for direction in part]
    found = terms_of(machine, state, [(term, 0)], threads, directions)
    if on_error == "raise" and found.failure is not None:
        raise found.failure
    values = found.arrays[0].reshape(*found.shape, n, len(directions))
    columns: list[Float] = []
    used = 0
    for part in parts:
        if isinstance(part, list):
            columns.append(values[..., used : used + len(part)])
            used += len(part)
        else:
            only = with_mass(*part)
            columns.append(_by_mass(machine, only, term, state, found, threads)[..., np.newaxis])
    joined = np.concatenate(columns, axis=-1) if columns else values
    return joined[..., 0, :] if n == 1 else joined


def refuse_functions(machine: MachineModel, call: str) -> None:
    """Refuse loads and motors that are functions of Python: nobody knows their derivatives."""
    functions = machine.core.functions
    if functions:
        name = getattr(functions[0], "__name__", repr(functions[0]))
        message = (
            f"{call}: the load or motor {short(name)} is a Python function, whose derivatives are "
            "not known: give it as a Table"
        )
        raise InputError(message)


def _part(
    machine: MachineModel, call: str, ways: tuple[str, ...], name: Any
) -> list[Direction] | tuple[str, Body]:
    """Return the directions that a name stands for, or the link with the unit of its body."""
    mechanism = machine.mechanism
    assert mechanism is not None
    if name in ways:
        return [(name, driver) for driver in range(machine.driver_count)]
    if isinstance(name, str):
        for ending, mass, inertia in ((MASS, 1.0, 0.0), (INERTIA, 0.0, 1.0)):
            link = name.removesuffix(ending)
            if link != name and link in mechanism.links:
                body = machine.bodies.get(link)
                at = None if body is None else body.at
                # As many machines as there are.
                each = np.ones(machine.shape) if machine.varies else 1.0
                return link, Body(mass=mass * each, inertia=inertia * each, at=at)
    name = checked_name(name, call)
    try:
        return [("dimension", index) for index in named_dimensions(mechanism, name)]
    except InputError as error:
        message = (
            f"{error}; by is also {', '.join(map(repr, ways))}, or a link's mass or inertia as in "
            f'"{next(iter(machine.bodies), "rod")}.mass"'
        )
        raise InputError(message, hint=error.hint) from None


def _by_mass(
    machine: MachineModel,
    only: MachineModel,
    term: str,
    state: State,
    found: Terms,
    threads: int | None,
) -> Float:
    """Return derivatives by a mass or an inertia, in which the equations are linear.

    Those of the effort are the efforts of the machine that has this body alone, of unit mass. Those
    of the acceleration are the accelerations that undo them.
    """
    n = machine.driver_count
    if term == "effort":
        unit = terms_of(only, state, [("effort", 0)], threads)
        return unit.arrays[0].reshape(*found.shape, n)
    solved = terms_of(machine, state, [("acceleration", 0)], threads)
    full = found.shape if n == 1 else (*found.shape, n)
    acceleration = solved.arrays[0].reshape(full)
    # Where there is none, there is no derivative either.
    known = np.nan_to_num(acceleration)
    unit = terms_of(only, state._replace(acceleration=known, effort=0.0), [("effort", 0)], threads)
    against = -unit.arrays[0].reshape(full)
    # M q̈ = τ − b of the machine at rest without loads: its bias is subtracted.
    bias = terms_of(machine, state, [("bias", 0)], threads).arrays[0].reshape(full)
    undone = terms_of(
        machine, state._replace(effort=against + bias), [("acceleration", 0)], threads
    )
    result: Float = undone.arrays[0].reshape(*found.shape, n)
    result[~np.isfinite(acceleration.reshape(*found.shape, n))] = np.nan
    return result


def weights(machine: MachineModel) -> list[Gravity]:
    """Return the loads that act on masses."""
    return [load for load in machine.loads if isinstance(load, Gravity)]
