"""Numbers of bodies, loads and motors: one, or an array with one for each machine of a batch."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from assur._arrays import Float, not_negative, real_array, real_number
from assur._by_value import ByValue
from assur.errors import InputError

__all__ = ["ZERO", "OfMachines", "not_negative_numbers", "numbers", "require_each"]

# The default of a field that is read as a number or as an array: `assur._arrays.Number`.
ZERO: Any = 0.0


class OfMachines(ByValue):
    """A part of a machine, whose numbers may be arrays: compared by value, read-only."""

    __slots__ = ()

    def __setstate__(self, state: dict[str, Any]) -> None:
        # An array that was pickled or copied can be written to.
        for name, value in state.items():
            for entry in value if isinstance(value, tuple) else (value,):
                if isinstance(entry, np.ndarray):
                    entry.flags.writeable = False
            object.__setattr__(self, name, value)


def numbers(value: Any, what: str) -> float | Float:
    """Return a finite number, or a read-only copy of an array of them."""
    if isinstance(value, float) and math.isfinite(value):
        return float(value)
    array = real_array(value, what)
    if not array.ndim:
        return real_number(value, what)
    require_each(array, np.isfinite(array), what, "a finite number is needed")
    array.flags.writeable = False
    return array


def not_negative_numbers(value: Any, what: str) -> float | Float:
    """Return a finite number that is 0 or more, or a read-only copy of an array of them."""
    checked = numbers(value, what)
    if isinstance(checked, float):
        return not_negative(checked, what)
    require_each(checked, checked >= 0.0, what, "it must not be negative")
    return checked


def require_each(array: Float, is_good: Any, what: str, needed: str) -> None:
    """Raise InputError for the first number of an array that is not good."""
    bad = np.flatnonzero(~is_good)
    if bad.size:
        at = np.unravel_index(int(bad[0]), array.shape)
        wrong = float(array[at])
        message = f"{what}[{', '.join(str(int(i)) for i in at)}] is {wrong:g}: {needed}"
        raise InputError(message, value=wrong)
