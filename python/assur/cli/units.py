"""Numbers with units, ``120mm``, and lists and ranges of them, ``0:360:1deg``."""

from __future__ import annotations

import argparse
import math
import re
from typing import TYPE_CHECKING, NamedTuple, TypeVar

import numpy as np

from assur._arrays import short
from assur.description.dotted_names import is_angle
from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Callable

    from assur._arrays import Float

T = TypeVar("T")

LENGTH, ANGLE, LINEAR, ROTARY = "a length", "an angle", "a speed", "an angular speed"
# The kind of a unit, and its value in SI units: a factor, or (int) a power of ten.
UNITS: dict[str, tuple[str, float | int]] = {
    "m": (LENGTH, 0),
    "cm": (LENGTH, -2),
    "mm": (LENGTH, -3),
    "in": (LENGTH, 0.0254),
    "rad": (ANGLE, 0),
    "deg": (ANGLE, math.pi / 180.0),
    "m/s": (LINEAR, 0),
    "mm/s": (LINEAR, -3),
    "rad/s": (ROTARY, 0),
    "deg/s": (ROTARY, math.pi / 180.0),
    "rpm": (ROTARY, math.pi / 30.0),
}
NUMBER = re.compile(
    r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,6})?)\s*([^\d\s].*?)?\s*", re.ASCII
)
# A float has 24 letters at most.
MOST_LETTERS = 100


class Numbers(NamedTuple):
    """One number (``()``) or several (N,) in SI units, with the unit that was written."""

    values: Float
    unit: str | None

    def index_of(self, kind: str, what: str) -> None:
        """Refuse a unit of another kind; no kind ("") means no unit."""
        if self.unit is None or UNITS[self.unit][0] == kind:
            return
        known = ", ".join(name for name, (of, _) in UNITS.items() if of == kind)
        message = f"{what} is {kind}: its unit can be {known}, not {self.unit}"
        if not kind:
            message = f"{what} is written without a unit, not in {self.unit}"
        raise InputError(message)

    def pair(self, kind: str, what: str) -> tuple[float, float]:
        """Return the first and the last of the numbers."""
        self.index_of(kind, what)
        return float(self.values[0]), float(self.values[-1])

    def one(self, kind: str, what: str) -> float:
        """Return the one number."""
        self.index_of(kind, what)
        if self.values.ndim:
            message = f"{what} is {short(self.values.tolist())}: one number is needed"
            raise InputError(message)
        return float(self.values)


class Number(NamedTuple):
    """A number as it is written, and its unit, None if it has none."""

    text: str
    unit: str | None

    def si(self, unit: str | None) -> float:
        """Return it in SI units: 35.7mm is 35.7e-3, with the same bits."""
        scale = 0 if unit is None else UNITS[unit][1]
        if isinstance(scale, float):
            return float(self.text) * scale
        digits, _, power = self.text.lower().partition("e")
        return float(f"{digits}e{int(power or 0) + scale}")


def split_number(text: str) -> Number:
    """Return a number and its unit."""
    match = NUMBER.fullmatch(text) if len(text) < MOST_LETTERS else None
    if match is None or not math.isfinite(float(match[1])):
        message = f"{short(text)} is not a number, such as 0.12, 120mm or 30deg"
        raise InputError(message)
    if match[2] is not None and match[2] not in UNITS:
        message = f"{short(text)}: the unit {short(match[2])} is unknown; known: {', '.join(UNITS)}"
        raise InputError(message)
    return Number(match[1], match[2])


def numbers(text: str) -> Numbers:
    """Return ``1``, ``1,2,3mm`` or ``0:360:1deg`` (start, end, step; both ends included).

    The unit is that of all numbers: it is written after the last, or after each.
    """
    if ":" in text:
        parts, unit = _same_unit(text, text.split(":"))
        return Numbers(_steps(text, parts, unit), unit)
    parts, unit = _same_unit(text, text.split(","))
    values = [part.si(unit) for part in parts]
    return Numbers(np.array(values if len(values) > 1 else values[0]), unit)


def ratio(text: str) -> Numbers:
    """Return ``0.04`` or ``1/25``."""
    over, slash, under = text.partition("/")
    if not slash:
        return numbers(text)
    parts = [split_number(part) for part in (over, under)]
    if any(part.unit for part in parts) or float(parts[1].text) == 0.0:
        message = f"{short(text)} is not a ratio, such as 0.04 or 1/25"
        raise InputError(message)
    return Numbers(np.array(float(parts[0].text) / float(parts[1].text)), None)


def evenly(text: str) -> Numbers:
    """Return ``0.1:0.2:50`` (start, end, how many), a list or a number: at least one value (N,)."""
    if text.count(":") != 2:
        if ":" in text:
            message = f"{short(text)}: from:to:count is needed, such as 0.1:0.2:50"
            raise InputError(message)
        parsed = numbers(text)
        return Numbers(np.atleast_1d(parsed.values), parsed.unit)
    first, last, count = text.split(":")
    ends, unit = _same_unit(text, [first, last])
    if not re.fullmatch(r"\s*\d{1,8}\s*", count, re.ASCII) or int(count) < 1:
        message = f"{short(text)}: from:to:count needs a whole number as the count"
        raise InputError(message)
    from assur.files.ranges import Range

    start, stop = (end.si(unit) for end in ends)
    return Numbers(Range(start, stop, count=int(count)).values(), unit)


def _same_unit(text: str, parts: list[str]) -> tuple[list[Number], str | None]:
    parsed = [split_number(part) for part in parts]
    unit = parsed[-1].unit
    if any(number.unit not in (None, unit) for number in parsed):
        message = f"{short(text)}: write one unit, after the last number"
        raise InputError(message)
    return parsed, unit


def _steps(text: str, parts: list[Number], unit: str | None) -> Float:
    """Return a range, in steps of its unit as `Mechanism.solve` takes degrees."""
    from assur.files.ranges import Range

    if len(parts) != 3:
        message = f"{short(text)}: start:end:step is needed, such as 0:360:1deg"
        raise InputError(message)
    start, stop, step = (float(part.text) for part in parts)
    try:
        values = Range(start, stop, step=step).values()
    except InputError as error:
        message = f"{short(text)}: {error}"
        raise InputError(message) from error
    if len(values) == 1 and start != stop:
        message = f"{short(text)}: the step is longer than the way from start to end"
        raise InputError(message)
    scale = 0 if unit is None else UNITS[unit][1]
    return values * scale if isinstance(scale, float) else values / 10.0**-scale


def kind_of(dimension: str) -> str:
    """Return whether a dimension is a length or an angle."""
    return ANGLE if is_angle(dimension) else LENGTH


def argument(parse: Callable[[str], T]) -> Callable[[str], T]:
    """Return a parser of text whose errors argparse shows."""

    def parsed(text: str) -> T:
        try:
            return parse(text)
        except InputError as error:
            raise argparse.ArgumentTypeError(str(error)) from error

    return parsed
