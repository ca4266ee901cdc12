"""Numbers with units, ``120mm``, and lists and ranges of them, ``0:360:1deg``."""

from __future__ import annotations

import argparse
import math
import re
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np

from assur._arrays import short
from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Callable

    from assur._arrays import Float

T = TypeVar("T")

LENGTH, ANGLE, LINEAR, ROTARY = "a length", "an angle", "a speed", "an angular speed"
# What a unit is of, what multiplies a number of it, and what divides it: 35 mm are 0.035 m to the
# last bit only if it is divided.
UNITS = {
    "m": (LENGTH, 1.0, 1.0),
    "cm": (LENGTH, 1.0, 100.0),
    "mm": (LENGTH, 1.0, 1000.0),
    "in": (LENGTH, 0.0254, 1.0),
    "rad": (ANGLE, 1.0, 1.0),
    "deg": (ANGLE, math.pi / 180.0, 1.0),
    "m/s": (LINEAR, 1.0, 1.0),
    "mm/s": (LINEAR, 1.0, 1000.0),
    "rad/s": (ROTARY, 1.0, 1.0),
    "deg/s": (ROTARY, math.pi / 180.0, 1.0),
    "rpm": (ROTARY, math.pi / 30.0, 1.0),
}
NUMBER = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*([^\d\s].*?)?\s*", re.ASCII)
# Longer texts are mistakes; their message would be as long.
MOST_LETTERS = 100_000


class Numbers(NamedTuple):
    """One number (``()``) or several (N,) in SI units, with the unit that was written."""

    values: Float
    unit: str | None

    def require(self, kind: str, what: str) -> None:
        """Refuse a unit of another kind."""
        if self.unit is not None and UNITS[self.unit][0] != kind:
            known = ", ".join(name for name, (of, *_) in UNITS.items() if of == kind)
            message = f"{what} is {kind}: its unit can be {known}, not {self.unit}"
            raise InputError(message)

    def one(self, kind: str, what: str) -> float:
        """Return the one number."""
        self.require(kind, what)
        if self.values.ndim:
            message = f"{what} is {short(self.values.tolist())}: one number is needed"
            raise InputError(message)
        return float(self.values)


def split_number(text: str) -> tuple[float, str | None]:
    """Return a number and its unit, None if it has none."""
    found = NUMBER.fullmatch(text) if len(text) < MOST_LETTERS else None
    value = float(found[1]) if found else math.nan
    if found is None or not math.isfinite(value):
        message = f"{short(text)} is not a number, such as 0.12, 120mm or 30deg"
        raise InputError(message)
    if found[2] is not None and found[2] not in UNITS:
        message = f"{short(text)}: the unit {short(found[2])} is unknown; known: {', '.join(UNITS)}"
        raise InputError(message)
    return value, found[2]


def numbers(text: str) -> Numbers:
    """Return ``1``, ``1,2,3mm`` or ``0:360:1deg`` (start, end, step; both ends included).

    The unit is that of all numbers: it is written after the last, or after each.
    """
    separator = ":" if ":" in text else ","
    values, unit = _same_unit(text, [split_number(part) for part in text.split(separator)])
    if separator == ":":
        return Numbers(_si(_steps(text, values), unit), unit)
    return Numbers(_si(np.array(values if len(values) > 1 else values[0]), unit), unit)


def evenly(text: str) -> Numbers:
    """Return ``0.1:0.2:50`` (start, end, how many), a list or a number: at least one value (N,)."""
    if text.count(":") != 2:
        if ":" in text:
            message = f"{short(text)}: from:to:count is needed, such as 0.1:0.2:50"
            raise InputError(message)
        found = numbers(text)
        return Numbers(np.atleast_1d(found.values), found.unit)
    first, last, count = text.split(":")
    ends, unit = _same_unit(text, [split_number(first), split_number(last)])
    if not re.fullmatch(r"\s*\d{1,8}\s*", count, re.ASCII) or int(count) < 1:
        message = f"{short(text)}: from:to:count needs a whole number as the count"
        raise InputError(message)
    from assur.files.ranges import Range

    return Numbers(_si(Range(ends[0], ends[1], count=int(count)).values(), unit), unit)


def _same_unit(text: str, parts: list[tuple[float, str | None]]) -> tuple[list[float], str | None]:
    unit = parts[-1][1]
    if any(other not in (None, unit) for _, other in parts):
        message = f"{short(text)}: write one unit, after the last number"
        raise InputError(message)
    return [value for value, _ in parts], unit


def _steps(text: str, values: list[float]) -> Any:
    from assur.files.ranges import Range

    if len(values) != 3:
        message = f"{short(text)}: start:end:step is needed, such as 0:360:1deg"
        raise InputError(message)
    try:
        return Range(values[0], values[1], step=values[2]).values()
    except InputError as error:
        message = f"{short(text)}: {error}"
        raise InputError(message) from error


def _si(values: Any, unit: str | None) -> Any:
    if unit is None:
        return np.asarray(values)
    _, factor, divisor = UNITS[unit]
    return np.asarray(values) * factor / divisor


def argument(parse: Callable[[str], T]) -> Callable[[str], T]:
    """Return a parser of text whose errors argparse shows."""

    def parsed(text: str) -> T:
        try:
            return parse(text)
        except InputError as error:
            raise argparse.ArgumentTypeError(str(error)) from error

    return parsed
