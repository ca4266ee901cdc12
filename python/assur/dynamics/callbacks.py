"""Values of loads and motors: numbers, tables over the coordinate, functions of (t, q, speed)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, TypeAlias

import numpy as np

from assur._arrays import Float, real_array, real_number, short
from assur.dynamics.table import Rows, Table
from assur.errors import InputError

__all__ = ["CallbackTable", "Function", "Value", "checked_value"]

# A value for the core: a number, or ("table" or "function", index).
Encoded: TypeAlias = float | tuple[str, int]
# Called with floats (t, q, speed); with several drivers q and speed are tuples.
Function: TypeAlias = Callable[[float, Any, Any], float]
# A number, a table over q, or a function of (t, q, speed).
Value: TypeAlias = float | Table | Function


def checked_value(value: Any, what: str = "the value of a load") -> Value:
    """Check a value: a table, a function, or a number, returned as float."""
    if isinstance(value, Table):
        if value.ratio != 1.0 or value.rotor_inertia != 0.0:
            message = "Table: ratio and rotor_inertia are for a table that is a motor"
            raise InputError(message)
        return value
    if callable(value):
        function: Function = value
        return function
    return real_number(value, what)


@dataclass
class CallbackTable:
    """The tables and functions of a machine, in the order of the core's indices."""

    tables: list[Rows] = field(default_factory=list)
    functions: list[Function] = field(default_factory=list)
    # The first functions are those of loads; those of motors follow.
    load_count: int = 0

    def encode(self, value: Value) -> Encoded:
        """Encode a constant, Table or callable for the core; the latter two are stored here."""
        if isinstance(value, Table):
            self.tables.append(value._rows())
            return "table", len(self.tables) - 1
        if callable(value):
            self.functions.append(value)
            return "function", len(self.functions) - 1
        return float(value)

    def load_values(self, q: Float, speed: Float) -> Float:
        """Evaluate the functions of loads at rows of coordinates and speeds, at t = 0."""
        functions = self.functions[: self.load_count]
        if not functions:
            return np.empty(0)
        one = q.shape[1] == 1
        rows = zip(q.tolist(), speed.tolist(), strict=True)
        pairs = ((a[0], b[0]) if one else (tuple(a), tuple(b)) for a, b in rows)
        table = [[_called(f, a, b) for f in functions] for a, b in pairs]
        return np.array(table, np.float64).ravel()


def _called(function: Function, q: Any, speed: Any) -> float:
    value: Any = function(0.0, q, speed)
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
