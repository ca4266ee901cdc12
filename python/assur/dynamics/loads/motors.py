"""Motors: the torque on a driver as a function of its speed.

The core reads the fields of these classes by name (rust/py/src/convert).
"""

from __future__ import annotations

import math
from dataclasses import KW_ONLY, dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from assur._arrays import Float, real_number, short
from assur._summary import typed
from assur._units import rpm as speed_of
from assur._validate import whole_number
from assur.dynamics.loads.load_values import Value, checked_value
from assur.dynamics.loads.numbers import (
    ZERO,
    OfMachines,
    not_negative_numbers,
    numbers,
    require_each,
)
from assur.dynamics.loads.table import Table, checked_ratio, replace_fields
from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from assur._arrays import Number

# The default of such a field, see `ZERO`.
ONE: Any = 1.0
# No motor has more.
MOST_POLES = 1000

__all__ = ["ConstantTorque", "InductionMotor", "LinearMotor"]


@dataclass(frozen=True, eq=False)
class ConstantTorque(OfMachines):
    """A motor whose torque does not depend on its speed.

    Parameters
    ----------
    torque : float, array_like, Table or callable
        Torque of the motor, N·m (driven slide: N). Numbers of motors may be arrays, one for each
        machine of a batch: see `Body`. Also a `Table` over q or a function of
        (t, q, speed), with the driver's coordinate and speed.
    ratio : float or array_like
        Speed of the motor divided by that of the driver; negative if they turn in opposite
        directions.
    rotor_inertia : float or array_like
        Moment of inertia of the rotor, kg·m²; referred to the driver, times ratio².

    Examples
    --------
    >>> import assur
    >>> motor = assur.ConstantTorque(184.0)
    """

    __repr__ = typed

    torque: Value
    _: KW_ONLY
    ratio: float | Number = ONE
    rotor_inertia: float | Number = ZERO

    if TYPE_CHECKING:

        def __init__(
            self,
            torque: Value | Sequence[float],
            *,
            ratio: npt.ArrayLike = 1.0,
            rotor_inertia: npt.ArrayLike = 0.0,
        ) -> None: ...

    def __post_init__(self) -> None:
        _check_shaft(self)
        replace_fields(self, torque=checked_value(self.torque, "ConstantTorque torque"))


@dataclass(frozen=True, eq=False)
class LinearMotor(OfMachines):
    """A motor whose torque falls linearly from `stall` at rest to 0 at `no_load`.

    For example a direct-current motor at constant voltage: torque = stall · (1 − speed / no_load).

    Parameters
    ----------
    stall : float or array_like
        Torque at rest, N·m.
    no_load : float or array_like
        Speed at which the torque is 0, rad/s.
    ratio, rotor_inertia : float or array_like
        See `ConstantTorque`.

    Examples
    --------
    >>> import assur
    >>> motor = assur.LinearMotor(stall=40.0, no_load=150.0, ratio=10.0)
    """

    __repr__ = typed

    stall: float | Number
    no_load: float | Number
    _: KW_ONLY
    ratio: float | Number = ONE
    rotor_inertia: float | Number = ZERO

    if TYPE_CHECKING:

        def __init__(
            self,
            stall: npt.ArrayLike,
            no_load: npt.ArrayLike,
            *,
            ratio: npt.ArrayLike = 1.0,
            rotor_inertia: npt.ArrayLike = 0.0,
        ) -> None: ...

    def __post_init__(self) -> None:
        _check_shaft(self)
        _check_positive(self, "stall", "no_load")


@dataclass(frozen=True, eq=False)
class InductionMotor(OfMachines):
    """An induction motor: torque = 2 · breakdown / (s/slip + slip/s), s = 1 − speed/synchronous.

    Parameters
    ----------
    breakdown : float or array_like
        Greatest torque, N·m.
    slip : float or array_like
        Slip at that torque, as a fraction of the synchronous speed: above 0, at most 1.
    synchronous : float or array_like
        Speed of the rotating field, rad/s.
    ratio, rotor_inertia : float or array_like
        See `ConstantTorque`.

    References
    ----------
    M. Kloss, *Drehmoment und Schlüpfung des Drehstrommotors* (1908).

    Examples
    --------
    >>> import assur
    >>> motor = assur.InductionMotor(breakdown=60.0, slip=0.15, synchronous=157.1, ratio=10.0)
    """

    __repr__ = typed

    breakdown: float | Number
    slip: float | Number
    synchronous: float | Number
    _: KW_ONLY
    ratio: float | Number = ONE
    rotor_inertia: float | Number = ZERO

    if TYPE_CHECKING:

        def __init__(
            self,
            breakdown: npt.ArrayLike,
            slip: npt.ArrayLike,
            synchronous: npt.ArrayLike,
            *,
            ratio: npt.ArrayLike = 1.0,
            rotor_inertia: npt.ArrayLike = 0.0,
        ) -> None: ...

    def __post_init__(self) -> None:
        _check_shaft(self)
        _check_positive(self, "breakdown", "slip", "synchronous")
        slip: float | Float = self.slip
        if isinstance(slip, np.ndarray):
            needed = "a fraction of the synchronous speed is needed, at most 1"
            require_each(slip, slip <= 1.0, "InductionMotor slip", needed)
        elif slip > 1.0:
            message = (
                f"InductionMotor: slip is {slip:g}: a fraction of the synchronous speed is "
                f"needed, at most 1 (15 % is 0.15)"
            )
            raise InputError(message, value=slip)

    @classmethod
    def from_plate(
        cls,
        *,
        power: float,
        rpm: float,
        poles: int,
        breakdown: float,
        frequency: float = 50.0,
        ratio: float = 1.0,
        rotor_inertia: float = 0.0,
    ) -> InductionMotor:
        """Return the motor of a rating plate and a catalogue.

        With the rated slip s and λ = breakdown torque / rated torque Kloss's formula gives the slip
        at the greatest torque, s (λ + √(λ² − 1)).

        Parameters
        ----------
        power : float
            Rated power at the shaft, W.
        rpm : float
            Rated speed, revolutions a minute.
        poles : int
            Number of poles, an even number: 4 at 50 Hz have a field of 1500 rpm.
        breakdown : float
            Greatest torque over the rated one, more than 1.
        frequency : float
            Of the mains, Hz.
        ratio, rotor_inertia : float
            See `ConstantTorque`.

        Returns
        -------
        InductionMotor
            The motor; at its rated speed it gives its rated torque.

        Raises
        ------
        InputError
            A rated speed that is not below that of the field, an odd number of poles, a ratio of
            torques that is not above 1, a number that is not positive.

        Examples
        --------
        >>> import assur
        >>> motor = assur.InductionMotor.from_plate(power=7500.0, rpm=1450, poles=4, breakdown=2.5)
        >>> round(motor.breakdown, 1), round(motor.slip, 4), round(motor.synchronous, 2)
        (123.5, 0.1597, 157.08)
        """
        what = "InductionMotor.from_plate"
        rated: dict[str, float] = {}
        for name, value in (("power", power), ("rpm", rpm), ("frequency", frequency)):
            rated[name] = real_number(value, f"{what}: {name}")
            if not rated[name] > 0.0:
                message = f"{what}: {name} is {rated[name]:g}: a positive number is needed"
                raise InputError(message, value=rated[name])
        pairs = whole_number(poles, f"{what}: poles", 2, MOST_POLES) / 2
        if not pairs.is_integer():
            message = f"{what}: poles is {poles}: an even number is needed"
            raise InputError(message, value=float(poles))
        field = 60.0 * rated["frequency"] / pairs
        if not rated["rpm"] < field:
            message = (
                f"{what}: rpm is {rated['rpm']:g}: the rated speed is below that of the field, "
                f"{field:g} rpm with {poles} poles at {rated['frequency']:g} Hz"
            )
            raise InputError(message, value=rated["rpm"])
        times = real_number(breakdown, f"{what}: breakdown")
        if not times > 1.0:
            message = (
                f"{what}: breakdown is {times:g} times the rated torque: more than 1 is needed"
            )
            raise InputError(message, value=times)
        slip = (1.0 - rated["rpm"] / field) * (times + math.sqrt(times * times - 1.0))
        torque = rated["power"] / speed_of(rated["rpm"])
        return cls(times * torque, slip, speed_of(field), ratio=ratio, rotor_inertia=rotor_inertia)


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
        ratio=_checked_ratios(motor.ratio, f"{name}: ratio"),
        rotor_inertia=not_negative_numbers(motor.rotor_inertia, f"{name}: rotor_inertia"),
    )


def _checked_ratios(value: Any, what: str) -> float | Float:
    ratios = numbers(value, what)
    if isinstance(ratios, np.ndarray):
        require_each(ratios, ratios != 0.0, what, "the motor would not turn")
        return ratios
    return checked_ratio(value, what)


def _check_positive(motor: Any, *names: str) -> None:
    kind = type(motor).__name__
    for name in names:
        value = numbers(getattr(motor, name), f"{kind} {name}")
        if isinstance(value, np.ndarray):
            needed = "it must be positive (a negative ratio turns the driver the other way)"
            require_each(value, value > 0.0, f"{kind} {name}", needed)
        elif value <= 0.0:
            message = (
                f"{kind}: {name} is {value:g}, it must be positive (a negative ratio turns the "
                "driver the other way)"
            )
            raise InputError(message, value=value)
        replace_fields(motor, **{name: value})
