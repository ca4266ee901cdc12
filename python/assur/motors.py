"""Motors: what turns a driver, and how its torque falls with the speed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TypeAlias

from assur._checks import real_number
from assur.errors import InputError
from assur.loads import Outside, Rows, Table, Told, Value

__all__ = ["ConstantTorque", "InductionMotor", "LinearMotor"]

# Driver, ratio, rotor's inertia, kind, numbers, values, table over the speed.
MotorParts: TypeAlias = tuple[int, float, float, str, list[float], list[Told], Rows | None]


@dataclass(frozen=True, eq=False)
class ConstantTorque:
    """A motor of one torque at any speed.

    Parameters
    ----------
    torque : float, Table or callable
        Of the motor, N·m (on a driven slide N); also a `Table` over q or a function of
        (t, q, speed), with the driver's coordinate and speed.
    ratio : float
        Speed of the motor by that of the driver; negative if they turn opposite ways.
    rotor_inertia : float
        Moment of inertia of the rotor, kg·m²; on the driver it counts times ratio².

    Examples
    --------
    >>> import assur
    >>> motor = assur.ConstantTorque(184.0)
    """

    torque: Value
    ratio: float = 1.0
    rotor_inertia: float = 0.0


@dataclass(frozen=True)
class LinearMotor:
    """A motor whose torque falls from `stall` at rest to none at `no_load`.

    A direct-current motor at constant voltage: torque = stall · (1 − speed / no_load).

    Parameters
    ----------
    stall : float
        Torque at rest, N·m.
    no_load : float
        Speed without torque, rad/s.
    ratio, rotor_inertia : float
        As of `ConstantTorque`.

    Examples
    --------
    >>> import assur
    >>> motor = assur.LinearMotor(stall=40.0, no_load=150.0, ratio=10.0)
    """

    stall: float
    no_load: float
    ratio: float = 1.0
    rotor_inertia: float = 0.0


@dataclass(frozen=True)
class InductionMotor:
    """An induction motor: torque = 2 · breakdown / (s/slip + slip/s), s = 1 − speed/synchronous.

    Parameters
    ----------
    breakdown : float
        The greatest torque, N·m.
    slip : float
        Slip at that torque.
    synchronous : float
        Speed of the field, rad/s.
    ratio, rotor_inertia : float
        As of `ConstantTorque`.

    References
    ----------
    M. Kloss, *Drehmoment und Schlüpfung des Drehstrommotors* (1908).

    Examples
    --------
    >>> import assur
    >>> motor = assur.InductionMotor(breakdown=60.0, slip=0.15, synchronous=157.1, ratio=10.0)
    """

    breakdown: float
    slip: float
    synchronous: float
    ratio: float = 1.0
    rotor_inertia: float = 0.0


Motor: TypeAlias = ConstantTorque | LinearMotor | InductionMotor | Table


def parts(motor: Any, driver: int, outside: Outside) -> MotorParts:
    """What the core is told of a motor."""
    if not isinstance(motor, Motor):
        message = (
            f"{motor!r} is no motor: ConstantTorque, LinearMotor, InductionMotor, or a Table of "
            "torque over speed"
        )
        raise InputError(message)
    name = type(motor).__name__
    ratio = real_number(motor.ratio, f"{name} ratio")
    inertia = real_number(motor.rotor_inertia, f"{name} rotor_inertia")
    if ratio == 0.0:
        message = f"{name}: ratio is 0, the motor would not turn"
        raise InputError(message, value=ratio)
    if inertia < 0.0:
        message = f"{name}: rotor_inertia is {inertia:g}, it must not be negative"
        raise InputError(message, value=inertia)
    common = driver, ratio, inertia
    if isinstance(motor, ConstantTorque):
        return (*common, "value", [], [outside.tell(motor.torque)], None)
    if isinstance(motor, Table):
        return (*common, "table", [], [], motor._rows(periodic=False))
    if isinstance(motor, LinearMotor):
        numbers = [_positive(motor, "stall"), _positive(motor, "no_load")]
        return (*common, "linear", numbers, [], None)
    numbers = [_positive(motor, "breakdown"), _positive(motor, "slip")]
    return (*common, "induction", [*numbers, _positive(motor, "synchronous")], [], None)


def _positive(motor: Any, name: str) -> float:
    value = real_number(getattr(motor, name), f"{type(motor).__name__} {name}")
    if value <= 0.0:
        message = (
            f"{type(motor).__name__}: {name} is {value:g}, it must be positive (a negative ratio "
            "turns the driver the other way)"
        )
        raise InputError(message, value=value)
    return value
