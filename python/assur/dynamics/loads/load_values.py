"""Values of loads and motors: numbers, tables over a coordinate, functions of (t, q, speed)."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np

from assur._arrays import Float, Function, real_array, short
from assur.dynamics.loads.numbers import numbers
from assur.dynamics.loads.table import Table
from assur.errors import InputError

__all__ = ["Function", "Value", "checked_value", "function_values"]

# A number (or one for each machine of a batch), a table over q or another coordinate, or a
# function of (t, q, speed).
Value: TypeAlias = float | Float | Table | Function


def checked_value(value: Any, what: str) -> Value:
    """Check a value: a table, a function, or numbers, returned as float or array."""
    if isinstance(value, Table):
        if value.ratio != 1.0 or value.rotor_inertia != 0.0:
            message = "Table: ratio and rotor_inertia are for a table that is a motor"
            raise InputError(message)
        return value
    if callable(value):
        function: Function = value
        return function
    return numbers(value, what)


def function_values(functions: list[Function], q: Float, speed: Float, t: Float) -> Float:
    """Evaluate functions at rows of coordinates and speeds, at times."""
    if not functions:
        return np.empty(0)
    is_single = q.shape[1] == 1
    rows = zip(t.tolist(), q.tolist(), speed.tolist(), strict=True)
    all_given = ((at, a[0], b[0]) if is_single else (at, tuple(a), tuple(b)) for at, a, b in rows)
    table = [[_called(f, *arguments) for f in functions] for arguments in all_given]
    return np.array(table, np.float64).ravel()


def _called(function: Function, t: float, q: Any, speed: Any) -> float:
    value: Any = function(t, q, speed)
    if type(value) is float:
        # NaN is reported later, with the coordinate.
        return value
    name = getattr(function, "__name__", repr(function))
    try:
        array = real_array(value, "it")
    except InputError:
        array = np.empty(0)
    if array.ndim:
        message = f"the load {name}(t, q, speed) gave {short(value)} at q = {q}: a number is needed"
        raise InputError(message)
    return float(array)
