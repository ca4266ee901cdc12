"""Checks of arguments; errors name the argument."""

from __future__ import annotations

import math
import operator
from collections.abc import Mapping
from itertools import islice
from typing import Any

from assur._arrays import counted, real_array, real_number, short
from assur.errors import InputError

__all__ = [
    "checked_entries",
    "checked_index",
    "checked_name",
    "checked_names",
    "checked_order",
    "checked_signs",
    "checked_threads",
    "one_of",
    "real_array",
    "real_number",
    "refuse_without_speed",
    "require_rows",
    "whole_number",
]

# No machine has more; a greater number would only take memory.
MAX_THREADS = 4096
# The core takes 64-bit integers, and quotes a wrong sign in its own error.
MAX_SIGN = 2**53
# The core counts with 64 bits.
MAX_COUNT = 2**63 - 1
# Points of one array, 80 MB of each quantity: more only take memory.
MAX_POINTS = 10_000_000


def one_of(value: Any, known: tuple[str, ...], what: str) -> str:
    """Return a word that is one of those known."""
    if isinstance(value, str) and value in known:
        return str(value)
    message = f"{what} is {short(value)}: one of {', '.join(map(repr, known))} is needed"
    raise InputError(message)


def checked_entries(value: Any, what: str, most: int) -> list[Any]:
    """Return one value as a list, or the entries of a sequence, from 1 to `most` of them."""
    is_one = isinstance(value, str | bytes | Mapping) or getattr(value, "ndim", 1) == 0
    try:
        entries = [value] if is_one else list(islice(value, most + 1))
    except TypeError:
        entries = [value]
    if not 1 <= len(entries) <= most:
        problem = f"has more than {most} entries" if entries else "is empty"
        message = f"{what} {problem}: from 1 to {most} are needed"
        raise InputError(message)
    return entries


def refuse_without_speed(speed: Any, name: str, **rates: Any) -> None:
    """Raise InputError for rates that would have no effect, as their speed is not given."""
    for what, rate in rates.items() if speed is None else ():
        if real_array(rate, what).any():
            message = (
                f"{what} is {short(rate)} and {name} is not given: analogues have no speed; give "
                f"{name}, too"
            )
            raise InputError(message)


def require_rows(count: int, least: int, what: str) -> None:
    """Raise InputError for a table of too few rows, as the core does (`TableError::TooShort`)."""
    if count < least:
        message = f"{what} has {counted(count, 'row')}: at least {least} are needed"
        raise InputError(message, kind="too_short", value=float(count))


def checked_name(name: Any, what: str) -> str:
    """Return a name: a string that is Unicode text; one of NumPy (of an array) becomes plain."""
    if not isinstance(name, str):
        message = f"{what}: the name {short(name)} is not a string"
        raise InputError(message)
    # A lone surrogate cannot be encoded.
    if not name.isascii() and any("\ud800" <= letter <= "\udfff" for letter in name):
        message = f"{what}: the name {name!a} is not Unicode text"
        raise InputError(message)
    return name if type(name) is str else str(name)


def checked_names(names: Any, what: str) -> list[str]:
    """Return names given as one or as a sequence; none for None."""
    listed = [] if names is None else [names] if isinstance(names, str | bytes) else names
    try:
        return [checked_name(name, what) for name in listed]
    except TypeError:
        message = f"{what} is {short(names)}: a name or a list of names is needed"
        raise InputError(message) from None


def checked_signs(assembly: Any, strict: bool = True) -> tuple[tuple[str, int], ...]:
    """Return names and signs of an assembly: integers; with `strict`, +1 or −1 only."""
    if assembly is None:
        return ()
    if not isinstance(assembly, Mapping):
        message = f"assembly is {short(assembly)}: a mapping of inner joints or slides to +1 or -1"
        raise InputError(message)
    named = ((checked_name(name, "assembly"), sign) for name, sign in assembly.items())
    return tuple((name, _sign(name, sign, strict)) for name, sign in named)


def _sign(name: str, sign: Any, strict: bool) -> int:
    try:
        number = real_number(sign, f"assembly[{name!r}]")
    except InputError:
        number = math.nan
    whole = number.is_integer() and abs(number) <= MAX_SIGN
    if whole and (number in (1.0, -1.0) or not strict):
        return int(number)
    message = f"assembly[{name!r}] is {short(sign)}: it must be +1 or -1"
    raise InputError(message, joint=name)


def whole_number(
    value: Any, what: str, least: int, most: int = MAX_COUNT, needed: str | None = None
) -> int:
    """Return a whole number within limits, not a bool; `needed` ends the error message."""
    try:
        number = operator.index(value)
    except TypeError:
        number = least - 1
    if isinstance(value, bool) or not least <= number <= most:
        needed = needed or f"a whole number from {least} to {most} is needed"
        message = f"{what} is {short(value)}: {needed}"
        raise InputError(message)
    return number


def checked_order(order: Any) -> int:
    """Return an order of analogues, 0 to 3."""
    if type(order) is int and 0 <= order <= 3:
        return order
    return whole_number(order, "order", 0, 3, needed="0, 1, 2 or 3")


def checked_index(index: Any, shape: tuple[int, ...], what: str) -> tuple[int, ...]:
    """Return a full index into a shape; negative entries count from the end."""
    listed = index if isinstance(index, tuple) else (index,)
    try:
        entries = tuple(operator.index(i) for i in listed if not isinstance(i, bool))
    except TypeError:
        entries = ()
    if len(entries) != len(shape) or len(entries) != len(listed):
        message = f"{what} {short(index)}: one index into the shape {shape} is needed"
        if not listed and shape[1:] == ():
            message = f"{message}: {what}=0 is the first"
        raise InputError(message)
    for i, size in zip(entries, shape, strict=True):
        if not -size <= i < size:
            message = f"{what} {index!r}: an index is needed, and it is outside the shape {shape}"
            raise InputError(message)
    return tuple(i % size for i, size in zip(entries, shape, strict=True))


def checked_threads(threads: Any) -> int | None:
    """Return the number of threads, or None."""
    return None if threads is None else whole_number(threads, "threads", 1, MAX_THREADS)


def require_one_driver(drivers: int, what: str) -> None:
    """Refuse several drivers where only one is defined."""
    if drivers > 1:
        message = f"{what} is defined for one driver; this mechanism has {drivers}"
        raise InputError(message)
