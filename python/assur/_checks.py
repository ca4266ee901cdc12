"""Arguments checked once, with errors that name them."""

from __future__ import annotations

import math
import operator
from collections.abc import Mapping
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from assur.errors import InputError

Float: TypeAlias = npt.NDArray[np.float64]

# More would only take memory; no machine has them.
MOST_THREADS = 4096


def real_array(value: Any, what: str) -> Float:
    """An array of float64, or an error that names what it should have been."""
    try:
        array = np.asarray(value)
        if not np.iscomplexobj(array):
            return array.astype(np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        message = f"{what} is {_short(value)}: a number or an array of numbers is needed"
        raise InputError(message) from error
    message = f"{what} is {_short(value)}: real numbers are needed"
    raise InputError(message)


def real_number(value: Any, what: str, finite: bool = True) -> float:
    """One number, or an error that names it."""
    # Nearly all are.
    if isinstance(value, float) and math.isfinite(value):
        return float(value)
    array = real_array(value, what)
    if array.ndim or np.isnan(array) or (finite and not np.isfinite(array)):
        message = f"{what} is {_short(value)}: a finite number is needed"
        raise InputError(message)
    return float(array)


def _short(value: Any) -> str:
    text = f"{str(value)[:12]}…" if isinstance(value, int) else repr(value)
    return text if len(text) < 80 else text[:77] + "..."


def checked_signs(assembly: Any, strict: bool = True) -> tuple[tuple[str, int], ...]:
    """Names and signs of an assembly; whole numbers, if `strict` +1 or −1."""
    if assembly is None:
        return ()
    if not isinstance(assembly, Mapping):
        message = f"assembly is {assembly!r}: a mapping of inner joints or slides to +1 or -1"
        raise InputError(message)
    return tuple((_name(name), _sign(name, sign, strict)) for name, sign in assembly.items())


def _name(name: Any) -> str:
    if not isinstance(name, str):
        message = f"assembly: the name {name!r} is not a string"
        raise InputError(message)
    return name


def _sign(name: str, sign: Any, strict: bool) -> int:
    try:
        whole = operator.index(sign) if not isinstance(sign, float) else int(sign)
    except (TypeError, ValueError, OverflowError):
        whole = 0
    if whole == sign and (whole in (1, -1) or not strict):
        return whole
    message = f"assembly[{name!r}] is {sign!r}: it must be +1 or -1"
    raise InputError(message, joint=name)


def checked_order(order: Any) -> int:
    """An order of analogues, 0 to 3."""
    try:
        number = operator.index(order)
    except TypeError:
        number = -1
    if isinstance(order, bool) or not 0 <= number <= 3:
        message = f"order is {order!r}: 0, 1, 2 or 3"
        raise InputError(message)
    return number


def checked_index(index: Any, shape: tuple[int, ...], what: str) -> tuple[int, ...]:
    """One whole index into a shape, negative ones counted from the end."""
    given = index if isinstance(index, tuple) else (index,)
    try:
        place = tuple(operator.index(i) for i in given if not isinstance(i, bool))
    except TypeError:
        place = ()
    if len(place) != len(shape) or len(place) != len(given):
        message = f"{what} {index!r}: one index into the shape {shape} is needed"
        raise InputError(message)
    for i, size in zip(place, shape, strict=True):
        if not -size <= i < size:
            message = f"{what} {index!r} is outside the shape {shape}"
            raise InputError(message)
    return tuple(i % size for i, size in zip(place, shape, strict=True))


def checked_threads(threads: Any) -> int | None:
    """A number of threads, or none."""
    if threads is None:
        return None
    try:
        number = operator.index(threads)
    except TypeError:
        number = 0
    if isinstance(threads, bool) or not 1 <= number <= MOST_THREADS:
        message = f"threads is {threads!r}: a whole number from 1 to {MOST_THREADS} is needed"
        raise InputError(message)
    return number
