"""Machines whose bodies, loads or motors have arrays: a machine for each of their numbers."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np

from assur.dynamics.loads.loads import Force, Gravity
from assur.dynamics.loads.table import Table

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from assur._arrays import Float
    from assur.dynamics.loads.loads import Body, Load
    from assur.dynamics.loads.motors import Motor

__all__ = ["Parts", "Varied", "for_core"]

AnyPart = TypeVar("AnyPart")


class Varied(NamedTuple):
    """An array among the numbers of a machine, as the core names it."""

    # "body", "load" or "motor", and its index there.
    part: str
    place: int
    field: str
    # What messages call it.
    name: str
    values: Float


class Parts(NamedTuple):
    """Bodies, loads and motors of a machine."""

    bodies: Mapping[str, Body]
    loads: Sequence[Load]
    motors: Sequence[Motor | None]

    def varied(self) -> list[Varied]:
        """Return all arrays among the numbers."""
        found: list[Varied] = []
        for index, (link, body) in enumerate(self.bodies.items()):
            found += _varied("body", index, f"bodies[{link!r}]", body)
        # The core counts loads besides gravity, and motors besides drivers that have none.
        others = [(i, load) for i, load in enumerate(self.loads) if not isinstance(load, Gravity)]
        for index, (place, load) in enumerate(others):
            found += _varied("load", index, f"loads[{place}], {type(load).__name__}", load)
        motors = [(i, motor) for i, motor in enumerate(self.motors) if motor is not None]
        for index, (driver, motor) in enumerate(motors):
            name = f"motor[{driver}]" if len(self.motors) > 1 else "motor"
            found += _varied("motor", index, f"{name}, {type(motor).__name__}", motor)
        return found

    def single(self) -> Parts:
        """Return parts with one number for each array, which is 0 only if all of them are."""

        def one(part: AnyPart) -> AnyPart:
            return _with_numbers(part, {name: _greatest(a) for name, a in _arrays(part).items()})

        return self._each(one)

    def at(self, index: int | tuple[int, ...], shape: tuple[int, ...]) -> Parts:
        """Return the parts of one machine of a batch."""

        def one(part: AnyPart) -> AnyPart:
            arrays = _arrays(part).items()
            return _with_numbers(
                part, {name: float(np.broadcast_to(array, shape)[index]) for name, array in arrays}
            )

        return self._each(one)

    def _each(self, one: Any) -> Parts:
        return Parts(
            {link: one(body) for link, body in self.bodies.items()},
            [one(load) for load in self.loads],
            [one(motor) for motor in self.motors],
        )


def for_core(
    varied: Sequence[Varied], shape: tuple[int, ...]
) -> list[tuple[str, int, str, Float, str]]:
    """Return arrays with a number for every machine of a batch."""
    return [
        (
            of.part,
            of.place,
            of.field,
            np.ascontiguousarray(np.broadcast_to(of.values, shape)).reshape(-1),
            f"{of.name}: {of.field}",
        )
        for of in varied
    ]


def _varied(part: str, index: int, name: str, of: Any) -> list[Varied]:
    return [Varied(part, index, field, name, array) for field, array in _arrays(of).items()]


def _arrays(part: Any) -> dict[str, Float]:
    """Return the arrays of a part by the names of their numbers."""
    if part is None or isinstance(part, Table):
        return {}
    numbers = {field.name: getattr(part, field.name) for field in fields(part)}
    if isinstance(part, Force):
        numbers = dict(zip(("fx", "fy"), part.force, strict=True))
    return {name: value for name, value in numbers.items() if isinstance(value, np.ndarray)}


def _with_numbers(part: AnyPart, numbers: dict[str, float]) -> AnyPart:
    if not numbers:
        return part
    of: Any = part
    if isinstance(part, Force):
        x, y = part.force
        of = replace(part, force=(numbers.get("fx", x), numbers.get("fy", y)))
    else:
        of = replace(of, **numbers)
    result: AnyPart = of
    return result


def _greatest(array: Float) -> float:
    return float(array.flat[int(np.argmax(np.abs(array)))]) if array.size else 1.0
