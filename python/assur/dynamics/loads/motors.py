"""Motors: the torque on a driver as a function of its speed.

The core reads the fields of these classes by name (rust/py/src/convert).
"""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass
from typing import Any, TypeAlias

from assur._arrays import not_negative, real_number, short
from assur._summary import typed
from assur.dynamics.loads.load_values import Value, checked_value
from assur.dynamics.loads.table import Table, checked_ratio, replace_fields
from assur.errors import InputError

__all__ = ["ConstantTorque", "InductionMotor", "LinearMotor"]


@dataclass(frozen=True)
class ConstantTorque:
    """A motor whose torque does not depend on its speed.

    Parameters
    ----------
    torque : float, Table or callable
        Torque of the motor, N·m (driven slide: N); also a `Table` over q or a function of
        (t, q, speed), with the driver's coordinate and speed.
    ratio : float
        Speed of the motor divided by that of the driver; negative if they turn in opposite
        directions.
    rotor_inertia : float
        Moment of inertia of the rotor, kg·m²; referred to the driver, times ratio².

    Examples
    --------
    >>> import assur
    >>> motor = assur.ConstantTorque(184.0)
    """

    __repr__ = typed

    torque: Value
    _: KW_ONLY
    ratio: float = 1.0
    rotor_inertia: float = 0.0

    def __post_init__(self) -> None:
        _check_shaft(self)
        replace_fields(self, torque=checked_value(self.torque, "ConstantTorque torque"))


@dataclass(frozen=True)
class LinearMotor:
    """A motor whose torque falls linearly from `stall` at rest to 0 at `no_load`.

    For example a direct-current motor at constant voltage: torque = stall · (1 − speed / no_load).

    Parameters
    ----------
    stall : float
        Torque at rest, N·m.
    no_load : float
        Speed at which the torque is 0, rad/s.
    ratio, rotor_inertia : float
        See `ConstantTorque`.

    Examples
    --------
    >>> import assur
    >>> motor = assur.LinearMotor(stall=40.0, no_load=150.0, ratio=10.0)
    """

    stall: float
    no_load: float
    _: KW_ONLY
    ratio: float = 1.0
    rotor_inertia: float = 0.0

    def __post_init__(self) -> None:
        _check_shaft(self)
        _check_positive(self, "stall", "no_load")


@dataclass(frozen=True)
class InductionMotor:
    """An induction motor: torque = 2 · breakdown / (s/slip + slip/s), s = 1 − speed/synchronous.

    Parameters
    ----------
    breakdown : float
        Greatest torque, N·m.
    slip : float
        Slip at that torque, as a fraction of the synchronous speed: above 0, at most 1.
    synchronous : float
        Speed of the rotating field, rad/s.
    ratio, rotor_inertia : float
        See `ConstantTorque`.

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
    _: KW_ONLY
    ratio: float = 1.0
    rotor_inertia: float = 0.0

    def __post_init__(self) -> None:
        _check_shaft(self)
        _check_positive(self, "breakdown", "slip", "synchronous")
        if self.slip > 1.0:
            message = (
                f"InductionMotor: slip is {self.slip:g}: a fraction of the synchronous speed is "
                f"needed, at most 1 (15 % is 0.15)"
            )
            raise InputError(message, value=self.slip)


Motor: TypeAlias = ConstantTorque | LinearMotor | InductionMotor | Table


def checked_motor(motor: Any) -> Motor:
    """Return a motor."""
    if not isinstance(motor, Motor):
        message = (
            f"{short(motor)} is not a motor: ConstantTorque, LinearMotor, InductionMotor, "
            "or a Table of torque over speed"
        )
        raise InputError(message)
    if isinstance(motor, Table):
        if motor.over is not None:
            message = (
                f"motor: its Table has over={motor.over!r}: a motor's table is over its own speed"
            )
            raise InputError(message)
        if motor._jumps.size:
            at = float(motor._jumps[0])
            message = f"motor: its torque jumps at {at:g} rad/s: over speed it must be continuous"
            raise InputError(message, value=at)
    over = getattr(getattr(motor, "torque", None), "over", None)
    if over is not None:
        message = (
            f"motor: its torque is a Table over {over!r}: motors follow q; give such a torque as a "
            "load (assur.Torque)"
        )
        raise InputError(message)
    return motor


def _check_shaft(motor: Any) -> None:
    name = type(motor).__name__
    replace_fields(
        motor,
        ratio=checked_ratio(motor.ratio, f"{name}: ratio"),
        rotor_inertia=not_negative(motor.rotor_inertia, f"{name}: rotor_inertia"),
    )


def _check_positive(motor: Any, *names: str) -> None:
    kind = type(motor).__name__
    for name in names:
        value = real_number(getattr(motor, name), f"{kind} {name}")
        if value <= 0.0:
            message = (
                f"{kind}: {name} is {value:g}, it must be positive (a negative ratio turns the "
                "driver the other way)"
            )
            raise InputError(message, value=value)
        replace_fields(motor, **{name: value})
