"""Arguments as arrays of float64; errors name the argument that is not numeric."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from contextlib import contextmanager
from types import EllipsisType
from typing import TYPE_CHECKING, Any, SupportsIndex, TypeAlias, cast

import numpy as np
import numpy.typing as npt

from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Iterator

# A result too: of one design at one position it is NumPy's number, which reads like an array.
Float: TypeAlias = npt.NDArray[np.float64]

if TYPE_CHECKING:

    class Number(float, npt.NDArray[np.float64]):  # type: ignore[misc]
        """Of one design a number, of a batch an array of its shape.

        No annotation can say which: type checkers accept both uses, and editors complete both.
        """

    class Point(tuple[float, float], npt.NDArray[np.float64]):  # type: ignore[misc]
        """Of one design (x, y), of a batch an array with a last axis of these: see `Number`."""


# Called with (t, q, speed): numbers, with several drivers q and speed are tuples.
Function: TypeAlias = (
    Callable[[float, float, float], float]
    | Callable[[float, tuple[float, ...], tuple[float, ...]], float]
)
# What chooses among designs or positions: an integer, a slice, a mask or indices for each axis.
OfAxis: TypeAlias = (
    SupportsIndex
    | slice
    | EllipsisType
    | Sequence[int]
    | npt.NDArray[np.bool_]
    | npt.NDArray[np.integer]
)
Index: TypeAlias = OfAxis | tuple[OfAxis, ...]

# NumPy converts these to float64 silently, though they are not real numbers.
NOT_NUMBERS = (
    type(None),
    str,
    bytes,
    bytearray,
    complex,
    np.complexfloating,
    np.datetime64,
    np.timedelta64,
    np.ndarray,
    np.void,
)


# The repr of a scalar of NumPy: np.str_('C').
OF_NUMPY = re.compile(r"\bnp\.\w+\(([^()]*)\)")


def as_number(value: float | npt.NDArray[Any]) -> Number:
    """Return it typed as what users read: see `Number`."""
    return cast("Number", value)


def real_array(value: Any, what: str, copy: bool = True) -> Float:
    """Copy to an array of float64 in C order; with `copy=False` an array that is one is returned.

    Raises InputError for masked entries, text, times, records and complex numbers.
    """
    if type(value) is float:
        return np.array(value)
    try:
        masked = _is_masked(value)
    except RecursionError as error:
        message = f"{what} is a list that contains itself: a number or an array is needed"
        raise InputError(message) from error
    if masked:
        message = f"{what} has masked entries: fill them, or leave them out"
        raise InputError(message)
    try:
        # NumPy would read the bytes of a buffer as numbers from 0 to 255.
        array = np.asarray(bytes(value) if isinstance(value, bytearray) else value)
        kind = array.dtype.kind
        if kind in "biuf" or (kind == "O" and _holds_numbers(array)):
            return array.astype(np.float64, order="C", copy=copy)
    except (TypeError, ValueError, OverflowError) as error:
        message = f"{what} is {short(value)}: a number or an array of numbers is needed"
        raise InputError(message) from error
    message = f"{what} is {short(value)}: real numbers are needed"
    raise InputError(message)


def finite_array(value: Any, what: str) -> Float:
    """Copy to an array of finite numbers."""
    array = real_array(value, what)
    require_finite(array, what)
    return array


def require_finite(array: Float, what: str) -> None:
    """Raise InputError for the first number that is not finite."""
    bad = ~np.isfinite(array)
    if bad.any():
        wrong = float(array[bad].flat[0])
        message = f"{what} {'has' if array.ndim else 'is'} {wrong}: finite numbers are needed"
        raise InputError(message, value=wrong)


def real_number(value: Any, what: str, finite: bool = True) -> float:
    """Return one number; errors name the argument."""
    # The usual case needs no array.
    if isinstance(value, float) and math.isfinite(value):
        return float(value)
    array = real_array(value, what)
    if array.ndim or np.isnan(array) or (finite and not np.isfinite(array)):
        message = f"{what} is {short(value)}: a finite number is needed"
        raise InputError(message)
    return float(array)


def flag(value: Any, what: str) -> bool:
    """Return True or False; errors name the argument."""
    if isinstance(value, bool | np.bool_):
        return bool(value)
    message = f"{what} is {short(value)}: True or False is needed"
    raise InputError(message)


def not_negative(value: Any, what: str) -> float:
    """Return one finite number that is 0 or more."""
    number = real_number(value, what)
    if number < 0.0:
        message = f"{what} is {number:g}, it must not be negative"
        raise InputError(message, value=number)
    return number


def two_numbers(value: Any, what: str) -> tuple[float, float]:
    """Return two finite numbers (x, y)."""
    array = real_array(value, what)
    if array.shape != (2,) or not np.isfinite(array).all():
        message = f"{what} is {short(value)}: two finite numbers (x, y) are needed"
        raise InputError(message)
    return float(array[0]), float(array[1])


@contextmanager
def in_range(what: str) -> Iterator[None]:
    """Raise InputError on overflow, where NumPy would warn and return infinities."""
    try:
        # Infinities in the arguments are allowed: their products may be NaN.
        with np.errstate(over="raise", invalid="ignore"):
            yield
    except FloatingPointError as error:
        message = f"{what} is beyond the greatest number, {np.finfo(np.float64).max:.3g}"
        raise InputError(message) from error


def counted(count: int, noun: str) -> str:
    """Return a number with its noun: "1 row", "2 rows"."""
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


def short(value: Any) -> str:
    """Return the repr of a value in one line, shortened for a message."""
    try:
        if isinstance(value, str):
            text = repr(str(value))
        else:
            # An array's repr has several lines; numbers and names of NumPy are shown as plain ones.
            text = OF_NUMPY.sub(r"\1", " ".join(repr(value).split()))
    except ValueError:
        # Python does not print integers of more than 4300 digits.
        return f"a {type(value).__name__} of very many digits"
    return text if len(text) < 80 else text[:77] + "..."


def _is_masked(value: Any) -> bool:
    """Whether an entry is masked, also in nested lists, where NumPy drops the mask."""
    if isinstance(value, np.ma.MaskedArray):
        return bool(np.ma.is_masked(value))
    if not isinstance(value, list | tuple):
        return False
    kinds = set(map(type, value))
    inside = (list, tuple, np.ma.MaskedArray)
    return any(issubclass(kind, inside) for kind in kinds) and any(map(_is_masked, value))


def _holds_numbers(array: npt.NDArray[Any]) -> bool:
    kinds = set(map(type, array.ravel().tolist()))
    return not any(issubclass(kind, NOT_NUMBERS) for kind in kinds)
