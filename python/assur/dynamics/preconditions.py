"""Checks of the options of motions, and of machines that they require."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import finite_array, real_number, short
from assur._validate import whole_number
from assur.errors import InputError

if TYPE_CHECKING:
    from assur.dynamics.model import MachineModel

# Below it, errors drown in rounding (`assur::ode`).
MIN_RTOL = 2.3e-15
# Tables end with typed numbers: their period may differ by this fraction.
PERIOD_RTOL = 1e-9


def one_design(machine: MachineModel, what: str) -> None:
    """Raise InputError for a batch."""
    if machine.shape:
        message = (
            f"{what} is for one design, this is a batch {machine.shape}: take one with design(i)"
        )
        raise InputError(message)


def without_arrays(machine: MachineModel, what: str) -> None:
    """Raise InputError for a machine whose bodies, loads or motors have arrays."""
    if machine.varies:
        message = (
            f"{what} takes no arrays, and {machine.varies[0]} is one: take one machine with "
            "design(i)"
        )
        raise InputError(message)


def without_friction(machine: MachineModel, what: str) -> None:
    """Raise InputError for a machine with friction."""
    if machine.friction:
        pairs = ", ".join(machine.friction)
        message = (
            f"{what} has no friction yet, the machine has some in {pairs}: make one without "
            "friction=; reactions and effort have it"
        )
        raise InputError(message)


def without_followers(machine: MachineModel, what: str) -> None:
    """Raise InputError for loads that follow other coordinates than the driver's."""
    if machine.core.follows[0]:
        message = (
            f"{what} has no loads with over=, while_= or a Gas yet: make the machine with one "
            "driver, or without them; reactions and effort have them"
        )
        raise InputError(message)


def require_rotary_driver(machine: MachineModel, what: str) -> None:
    """Raise InputError unless the machine has one driver and that is an angle."""
    driver = None if machine.mechanism is None else machine.mechanism.driver
    slides = {} if machine.mechanism is None else machine.mechanism.slides
    if machine.driver_count > 1 or (isinstance(driver, str) and driver in slides):
        message = f"driver {driver!r}: {what} needs a single driver that turns"
        raise InputError(message)


def require_whole_periods(period: float | None, span: float) -> None:
    """Raise InputError unless a table repeats a whole number of times in the span."""
    if period is None:
        message = "a table that is not periodic is among the loads: there is no periodic motion"
        raise InputError(message)
    ratio = span / period
    if abs(ratio - round(ratio)) > PERIOD_RTOL * ratio or round(ratio) < 1:
        message = (
            f"a table's period of {period:g} rad does not fit {span:g} rad a whole number of "
            "times: pass turns= if the cycle is longer"
        )
        raise InputError(message, value=period)


def positive_number(value: Any, name: str) -> float:
    """Return a positive number; infinity is allowed."""
    number = real_number(value, name, finite=False)
    if not number > 0.0:
        message = f"{name} is {short(value)}: it must be positive"
        raise InputError(message, value=number)
    return number


def relative_tolerance(rtol: Any) -> float:
    """Return a relative tolerance."""
    number = real_number(rtol, "rtol")
    if not MIN_RTOL <= number < 1.0:
        message = f"rtol is {short(rtol)}: it must be from {MIN_RTOL} to below 1"
        raise InputError(message, value=number)
    return number


def tolerance_pair(atol: Any) -> list[float] | None:
    """Return absolute tolerances of coordinate and speed, or None."""
    if atol is None:
        return None
    array = finite_array(atol, "atol")
    if array.shape not in ((), (2,)):
        needed = "a number, or one for the coordinate and one for the speed"
        message = f"atol is {short(atol)}: {needed}"
        raise InputError(message)
    if (array <= 0.0).any():
        message = f"atol is {short(atol)}: positive numbers are needed"
        raise InputError(message)
    both: list[float] = np.broadcast_to(array, (2,)).tolist()
    return both


def checked_breaks(breaks: Any) -> list[float]:
    """Return the breaks in ascending order."""
    array = finite_array(() if breaks is None else breaks, "breaks")
    ordered: list[float] = sorted(array.ravel().tolist())
    return ordered


def turn_count(turns: Any) -> int:
    """Return the number of turns of a period."""
    return whole_number(turns, "turns", 1, 1024)


def step_count(steps: Any) -> int:
    """Return the largest number of steps."""
    return whole_number(steps, "max_steps", 1)


def checked_seconds(seconds: Any) -> float | None:
    """Return the limit of computing time, s, or None."""
    if seconds is None:
        return None
    number = real_number(seconds, "max_seconds")
    if number < 0.0:
        message = f"max_seconds is {short(seconds)}: 0 or more is needed"
        raise InputError(message, value=number)
    return min(number, 1e9)
