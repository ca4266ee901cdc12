"""Functions given for loads and motors, tried once when a machine is made."""

from __future__ import annotations

import inspect
import math
from typing import TYPE_CHECKING, Any

from assur._arrays import real_number, short
from assur.dynamics.loads.loads import named_values
from assur.dynamics.loads.motors import ConstantTorque
from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from assur.dynamics.loads.loads import Load

# Speeds to try where a function has no value at rest, like a load of constant power.
SPEEDS = 0.0, 1.0


def check_functions(loads: Iterable[Load], motors: Iterable[Any], q0: list[float]) -> None:
    """Call every function at q0, at rest: raise InputError unless it gives a finite number."""
    for name, function in _functions(loads, motors):
        _try(name, function, q0)


def _functions(loads: Iterable[Load], motors: Iterable[Any]) -> Iterator[tuple[str, Any]]:
    for load in loads:
        yield from ((name, value) for name, value in named_values(load).items() if callable(value))
    for motor in motors:
        if isinstance(motor, ConstantTorque) and callable(motor.torque):
            yield "ConstantTorque: torque", motor.torque


def _try(name: str, function: Any, q0: list[float]) -> None:
    for speed in SPEEDS:
        arguments = (0.0, q0[0], speed) if len(q0) == 1 else (0.0, tuple(q0), (speed,) * len(q0))
        _require_arguments(name, function, arguments)
        place = f"t = 0, q = {arguments[1]}, speed = {arguments[2]}"
        try:
            value = function(*arguments)
        except ArithmeticError as error:
            problem = f"raises {error!r}"
            continue
        except Exception as error:
            message = f"{name}(t, q, speed) raises {error!r} at {place}"
            raise InputError(message) from error
        try:
            number = real_number(value, "it", finite=False)
        except InputError:
            number = None
        if number is None and not _is_nan(value):
            message = f"{name}(t, q, speed) gives {short(value)} at {place}: a number is needed"
            raise InputError(message)
        if number is not None and math.isfinite(number):
            return
        problem = f"gives {short(value)}"
    message = (
        f"{name}(t, q, speed) {problem} at {place}, and has no finite value at rest either: a "
        "finite number is needed"
    )
    raise InputError(message)


def _is_nan(value: Any) -> bool:
    return isinstance(value, float) and math.isnan(value)


def _require_arguments(name: str, function: Any, arguments: tuple[Any, ...]) -> None:
    """Raise InputError unless a function takes (t, q, speed), as far as that is known."""
    try:
        signature = inspect.signature(function)
    except (TypeError, ValueError):
        return
    try:
        signature.bind(*arguments)
    except TypeError as error:
        message = (
            f"{name} is a function with the arguments {signature}: it is called with (t, q, "
            "speed), the time, s, and the driver's coordinate and speed (of several drivers tuples)"
        )
        raise InputError(message) from error
