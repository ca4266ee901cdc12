"""Arguments from bytes: valid ones, and ones that nobody should pass."""

from __future__ import annotations

import datetime as dt
import decimal
import fractions
import inspect
from typing import TYPE_CHECKING, Any

import numpy as np

import assur

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

ODD_NUMBERS = (
    float("nan"),
    float("inf"),
    -float("inf"),
    0.0,
    -0.0,
    5e-324,
    1e-320,
    1e-150,
    1e16,
    1e150,
    1e300,
    -1e300,
    1e308,
    -1.0,
)
ODD_STRINGS = (
    *("", " ", "ground", "A", "B", "crank", "1.0", "nan", "a.b", "a\0b"),
    *("\ud800", "é", "x" * 300, "y" * 3000),
)


class Anything:
    """A class that can be called with any arguments, as a function of a load is: what Python's own
    raise is theirs, and goes through."""

    def __init__(self, *_: object) -> None:
        pass


def _looped() -> list[Any]:
    looped: list[Any] = []
    looped.append(looped)
    return looped


# Made anew for each call: some of them can be changed, or used up.
ODD_OBJECTS: tuple[Callable[[], Any], ...] = (
    lambda: None,
    lambda: True,
    lambda: 0,
    lambda: -1,
    lambda: 2**62,
    lambda: 2**70,
    lambda: 10**18,
    lambda: 1j,
    lambda: b"12",
    lambda: bytearray(8),
    lambda: (),
    list,
    lambda: [[1.0], [1.0, 2.0]],
    dict,
    lambda: {"A": 1},
    lambda: {5: 3},
    lambda: {1.0, 2.0},
    lambda: (x for x in (1.0, 2.0)),
    object,
    lambda: Anything,
    lambda: lambda *_: 1.0,
    lambda: lambda *_: "1",
    lambda: lambda *_: None,
    lambda: lambda *_: np.nan,
    lambda: assur.FourBar(1.0, 3.0, 2.5, 3.0),
    lambda: np.str_("C"),
    lambda: np.datetime64("2020-01-01"),
    lambda: ["C", "C"],
    lambda: ["C", "D"],
    lambda: {"C": 1, "D": 2},
    lambda: [1, 2, 3],
    _looped,
    lambda: fractions.Fraction(1, 3),
    lambda: decimal.Decimal("0.1"),
    lambda: dt.datetime(2020, 1, 1, tzinfo=dt.timezone.utc),
    lambda: range(3),
    lambda: slice(0, 1),
    lambda: Ellipsis,
    lambda: memoryview(b"abc"),
    lambda: np.float32(0.5),
    lambda: np.int8(3),
    lambda: np.array(0.5),
    lambda: np.zeros(0),
    lambda: np.zeros((0, 2)),
    lambda: np.zeros((2, 0)),
    lambda: np.zeros((2, 3)),
    lambda: np.ones((2, 3, 1)),
    lambda: np.zeros((1, 2, 1, 2)),
    lambda: np.arange(6.0)[::-2],
    lambda: np.arange(6.0).astype(">f8"),
    lambda: np.array([1, 2, 3], dtype=np.uint8),
    lambda: np.array([True, False]),
    lambda: np.array(["1", "2"]),
    lambda: np.array([b"1"]),
    lambda: np.array([None, 1.0], dtype=object),
    lambda: np.array([1j]),
    lambda: np.array(["2020-01-01"], dtype="datetime64[D]"),
    lambda: np.array([(1, 2.0)], dtype="i4,f8"),
    lambda: np.ma.array([1.0, 2.0], mask=[True, False]),
    lambda: np.array([np.nan, 1.0]),
    lambda: np.full((3,), 1e300),
)


class Choices:
    """Bytes read one after another; after the end zeros."""

    def __init__(self, data: bytes) -> None:
        self._data = data
        self._at = 0

    def byte(self) -> int:
        self._at += 1
        return self._data[self._at - 1] if self._at <= len(self._data) else 0

    def among(self, values: Sequence[Any]) -> Any:
        return values[self.byte() % len(values)]

    def either(self, *makers: Callable[[], Any]) -> Any:
        return self.among(makers)()

    def number(self) -> float:
        """Mostly a number on a coarse grid within 4 of 0."""
        byte = self.byte()
        if byte >= 240:
            return float(self.among(ODD_NUMBERS))
        return (byte - 120) / 30.0

    def positive(self) -> float:
        return 0.05 * (1 + self.byte() % 100)

    def small(self) -> int:
        """A count or an index."""
        return self.byte() % 12

    def numbers(self) -> Any:
        """One number, or an array of a few, of one or two axes."""
        shape = self.among(((), (), (1,), (3,), (9,), (2, 1), (2, 3)))
        values = [self.number() for _ in range(int(np.prod(shape)))]
        return values[0] if shape == () else np.reshape(values, shape)

    def odd(self) -> Any:
        """Anything at all."""
        kind = self.byte() % 8
        if kind == 0:
            return self.among(ODD_NUMBERS)
        if kind == 1:
            return self.among(ODD_STRINGS)
        if kind == 2:
            return [self.odd() for _ in range(self.byte() % 4)]
        if kind == 3:
            return {self.among(ODD_STRINGS): self.odd() for _ in range(self.byte() % 3)}
        if kind == 4:
            return tuple(self.odd() for _ in range(self.byte() % 4))
        return self.among(ODD_OBJECTS)()

    def argument(self, fitting: Callable[[], Any]) -> Any:
        """What fits; one time in sixteen anything at all."""
        return self.odd() if self.byte() % 16 == 15 else fitting()

    def call(self, function: Callable[..., Any], **fitting: Any) -> Any:
        """Call with keyword arguments, one in four left out where it can be.

        What is not made by a function is given as it is.
        """
        parameters = inspect.signature(function).parameters
        named = {}
        for name, make in fitting.items():
            if not callable(make):
                named[name] = make
                continue
            needed = parameters[name].default is inspect.Parameter.empty
            if needed or self.byte() % 4:
                named[name] = self.argument(make)
        return function(**named)

    def spoiled(self, value: Any) -> Any:
        """The same, one entry of it (or of its entries) replaced by anything at all."""
        if isinstance(value, dict) and value and self.byte() % 6:
            key = self.among(list(value))
            if self.byte() % 6 == 0:
                rest = {k: v for k, v in value.items() if k != key}
                return {self.among(ODD_STRINGS): value[key], **rest}
            return {**value, key: self.spoiled(value[key])}
        if isinstance(value, (list, tuple)) and value and self.byte() % 6:
            index = self.byte() % len(value)
            return [*value[:index], self.spoiled(value[index]), *value[index + 1 :]]
        return self.odd()
