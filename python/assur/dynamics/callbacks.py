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

# As the core takes a value: a number, or which table or function.
Encoded: TypeAlias = float | tuple[str, int]
# Called with floats; of a machine with several drivers q and speed are tuples of them.
Function: TypeAlias = Callable[[float, Any, Any], float]
# A number, a table over q, or a function of (t, q, speed).
Value: TypeAlias = float | Table | Function


def checked_value(value: Any, what: str = "the value of a load") -> Value:
    """A value that cannot change any more: a float, a table, or a function."""
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
    """The tables and functions among the values, in order."""

    tables: list[Rows] = field(default_factory=list)
    functions: list[Function] = field(default_factory=list)
    # How many of the functions are loads; those of motors come behind.
    load_count: int = 0

    def encode(self, value: Value) -> Encoded:
        """Encode a value for the core; tables and functions go to the lists."""
        if isinstance(value, Table):
            self.tables.append(value._rows())
            return "table", len(self.tables) - 1
        if callable(value):
            self.functions.append(value)
            return "function", len(self.functions) - 1
        return float(value)

    def load_values(self, q: Float, speed: Float) -> Float:
        """The loads' functions' values at positions (rows of coordinates), at the time 0."""
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
        # NaN has its own message, with the place.
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
