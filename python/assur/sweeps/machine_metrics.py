"""Metrics of machines: forces, efforts, inertia and flywheels of designs, one number each."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np

from assur._arrays import finite_array
from assur._by_value import ByValue
from assur._validate import checked_name, one_of, real_number
from assur.dynamics.forces.kinetostatics import reaction_squares, reactions
from assur.dynamics.forces.reaction_key import Key
from assur.dynamics.forces.reactions import key_of_joint
from assur.dynamics.loads.load_coordinate import jump_over
from assur.dynamics.motion.motion_input import motion_of
from assur.errors import AssurError, AssurWarning, InputError
from assur.kinematics.model import with_values
from assur.sweeps.terms import OfMachine

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from assur.dynamics.machine import Machine
    from assur.flywheel import Mean
    from assur.sweeps.terms import Float, Metric

__all__ = [
    "flywheel_inertia",
    "max_inertia",
    "peak_effort",
    "peak_reaction",
    "rms_effort",
    "rms_reaction",
    "warn_of_jumps",
]

Measure = Literal["peak", "rms"]
# Shapes and bytes of speeds and accelerations.
MotionKey: TypeAlias = tuple[tuple[tuple[int, ...], bytes], ...]


def _root(measure: Measure, squares: Float) -> Float:
    """Return peaks or root mean squares, given the greatest and the mean squares (designs, 2)."""
    return np.asarray(np.sqrt(squares[:, 0 if measure == "peak" else 1]))


@dataclass(frozen=True, repr=False, eq=False)
class Driven(ByValue, OfMachine):
    """What follows from the reactions over a motion of the drivers."""

    measure: Measure
    speed: Any
    acceleration: Any

    @property
    def motion(self) -> MotionKey:
        """Equal for metrics of the same motion."""
        both = np.asarray(self.speed), np.asarray(self.acceleration)
        return tuple((rates.shape, rates.tobytes()) for rates in both)

    def keys(self, machine: Machine) -> list[Key]:
        """The reactions it needs."""
        raise NotImplementedError

    def of_squares(self, machine: Machine, q: Float, squares: dict[Key, Float]) -> Float:
        """Its values for the designs of a machine."""
        raise NotImplementedError

    def values(self, machine: Machine, q: Float, threads: int | None) -> Float:
        """Its values for the designs of a machine."""
        return together([self], machine, q, threads)[0]

    def why(self, machine: Machine, q: Float) -> AssurError | str:
        """Why a design has no value: the error of its first position without one."""
        try:
            solved = reactions(
                machine, motion_of(q, self.speed, self.acceleration, 0.0), None, "raise"
            )
        except AssurError as error:
            return error
        if np.any(solved.locked):
            at = np.ravel(q)[int(np.argmax(solved.locked))]
            return f"friction locks the machine at q = {at:.9g}"
        return "redundant links leave it undetermined"


def warn_of_jumps(metrics: Sequence[Any], machine: Machine) -> None:
    """Warn if loads may jump: forces and efforts are those of the positions; `sweep` calls it."""
    driven = next((metric for metric in metrics if isinstance(metric, Driven)), None)
    if driven is not None and (any(machine.core.jumps) or jump_over(machine.loads)):
        message = (
            f"{driven!r} is over the positions alone, and loads may jump between them: take "
            "positions close to the jumps, or see machine.duty of one design"
        )
        warnings.warn(message, AssurWarning, stacklevel=3)


def together(
    metrics: Sequence[OfMachine], machine: Machine, q: Float, threads: int | None
) -> list[Float]:
    """Return the values of metrics for the designs of a machine: one motion is solved once."""
    keys: dict[MotionKey, list[Key]] = {}
    for metric in metrics:
        if isinstance(metric, Driven):
            keys.setdefault(metric.motion, []).extend(metric.keys(machine))
    solved: dict[MotionKey, dict[Key, Float]] = {}
    values = []
    for metric in metrics:
        if not isinstance(metric, Driven):
            values.append(metric.values(machine, q, threads))
            continue
        if metric.motion not in solved:
            motion = motion_of(q, metric.speed, metric.acceleration, 0.0)
            asked = list(dict.fromkeys(keys[metric.motion]))
            solved[metric.motion] = reaction_squares(machine, motion, threads, asked)
        values.append(metric.of_squares(machine, q, solved[metric.motion]))
    return values


@dataclass(frozen=True, repr=False, eq=False)
class JointForce(Driven):
    """The force in a joint."""

    joint: str
    on: str | None

    def check(self, machine: Machine) -> None:
        """Raise InputError for a joint or link that the machine does not have."""
        self.keys(machine)

    def keys(self, machine: Machine) -> list[Key]:
        """The force in the joint."""
        assert machine.mechanism is not None
        return [key_of_joint(machine.mechanism, self.joint, self.on)]

    def of_squares(self, machine: Machine, _q: Float, squares: dict[Key, Float]) -> Float:
        """Its values for the designs of a machine."""
        return _root(self.measure, squares[self.keys(machine)[0]])

    def __repr__(self) -> str:
        on = "" if self.on is None else f", on={self.on!r}"
        return f"{self.measure}_reaction({self.joint!r}{on})"


@dataclass(frozen=True, repr=False, eq=False)
class Effort(Driven):
    """The torque or force of the drive."""

    def keys(self, machine: Machine) -> list[Key]:
        """The efforts of all drivers."""
        return [Key("driver", driver) for driver in range(machine.driver_count)]

    def of_squares(self, machine: Machine, q: Float, squares: dict[Key, Float]) -> Float:
        """Its values for the designs of a machine; with several drivers of the greatest."""
        sizes = [_root(self.measure, squares[key]) for key in self.keys(machine)]
        greatest = np.asarray(np.max(sizes, axis=0))
        missing = np.flatnonzero(np.isnan(greatest))
        if missing.size:
            assert machine.mechanism is not None
            few = with_values(machine.mechanism, machine.mechanism.values[:, missing])
            greatest[missing] = self._by_power(machine.of(few), q)
        return greatest

    def _by_power(self, machine: Machine, q: Float) -> Float:
        """Its values where a position has no forces: at a change point the effort has a value."""
        motion, keys = motion_of(q, self.speed, self.acceleration, 0.0), self.keys(machine)
        forces = reactions(machine, motion, None, "nan", keys).by_key
        known = machine.effort(q, self.speed, self.acceleration, on_error="nan")
        every = [known] if machine.driver_count == 1 else list(np.moveaxis(known, -1, 0))
        each = [
            np.where(np.isnan(forces[key]), b, forces[key])
            for key, b in zip(keys, every, strict=True)
        ]
        with np.errstate(over="ignore"):
            squares = [effort * effort for effort in each]
        reduce = np.max if self.measure == "peak" else np.mean
        return np.asarray(np.max([np.sqrt(reduce(square, axis=-1)) for square in squares], axis=0))

    def __repr__(self) -> str:
        return f"{self.measure}_effort()"


@dataclass(frozen=True, repr=False, eq=False)
class Inertia(ByValue, OfMachine):
    """The reduced inertia."""

    def check(self, machine: Machine) -> None:
        """Raise InputError with several drivers, which have a matrix."""
        if machine.driver_count > 1:
            message = f"{self!r}: with {machine.driver_count} drivers the inertia is a matrix"
            raise InputError(message)

    def why(self, _machine: Machine, _q: Float) -> str:
        """Why a design has no value."""
        return "the inertia is not finite"

    def values(self, machine: Machine, q: Float, _threads: int | None) -> Float:
        """Its greatest values for the designs of a machine."""
        return np.asarray(machine.reduced_inertia(q, on_error="nan").value.max(axis=-1))

    def __repr__(self) -> str:
        return "max_inertia()"


@dataclass(frozen=True, repr=False, eq=False)
class FlywheelInertia(ByValue, OfMachine):
    """The inertia of a flywheel."""

    fluctuation: float
    mean_speed: float | None
    mean: Mean

    def why(self, machine: Machine, _q: Float) -> AssurError | str:
        """Why a design has no such flywheel."""
        try:
            machine.flywheel(self.fluctuation, mean_speed=self.mean_speed, mean=self.mean)
        except AssurError as error:
            return error
        return "there is no such flywheel"

    def values(self, machine: Machine, _q: Float, _threads: int | None) -> Float:
        """Its values for the designs of a machine."""
        flywheel = machine.flywheel(
            self.fluctuation, mean_speed=self.mean_speed, mean=self.mean, on_error="nan"
        )
        return np.asarray(flywheel.inertia)

    def __repr__(self) -> str:
        return f"flywheel_inertia({self.fluctuation!r})"


def _motion(speed: npt.ArrayLike, acceleration: npt.ArrayLike) -> tuple[Any, Any]:
    rates = (("speed", speed), ("acceleration", acceleration))
    first, second = (finite_array(value, what)[()] for what, value in rates)
    return first, second


def _joint_force(measure: Measure, joint: str, on: str | None, *motion: npt.ArrayLike) -> Metric:
    name = None if on is None else checked_name(on, "on")
    return JointForce(measure, *_motion(*motion), checked_name(joint, "joint"), name)


def peak_reaction(
    joint: str,
    *,
    on: str | None = None,
    speed: npt.ArrayLike = 0.0,
    acceleration: npt.ArrayLike = 0.0,
) -> Metric:
    """The greatest force in a joint over the positions, N.

    Parameters
    ----------
    joint : str
        The joint.
    on : str, optional
        The link that the force acts on; needed where three or more links meet.
    speed, acceleration : array_like
        Of the drivers, rad/s and rad/s² (slides: m/s and m/s²), the same for all designs: a
        number, or one for each driver or position. Zero: statics.

    Returns
    -------
    Metric
        N, for ``assur.sweep(machine, ...)``. NaN for a design in which a load is not finite, or
        redundant links leave the force undetermined.

    Raises
    ------
    InputError
        Here for wrong arguments; by `assur.sweep` for a name that is unknown, and without a
        machine.

    Examples
    --------
    >>> import assur, numpy as np
    >>> gas = assur.Force("B", (-800.0, 0.0), on="piston")
    >>> engine = assur.Machine(assur.SliderCrank(0.1, 0.35), loads=[gas])
    >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    >>> asked = {"A": assur.metric.peak_reaction("A")}
    >>> assur.sweep(engine, {"rod.length": [0.3, 0.4]}, q, metrics=asked)["A"].round(1)
    array([848.5, 826.2])
    """
    return _joint_force("peak", joint, on, speed, acceleration)


def rms_reaction(
    joint: str,
    *,
    on: str | None = None,
    speed: npt.ArrayLike = 0.0,
    acceleration: npt.ArrayLike = 0.0,
) -> Metric:
    """The root of the mean square of the force in a joint over the positions, N.

    See `peak_reaction`.

    Parameters
    ----------
    joint, on, speed, acceleration
        As for `peak_reaction`.

    Returns
    -------
    Metric
        For ``assur.sweep(machine, ...)``.

    Examples
    --------
    >>> import assur, numpy as np
    >>> gas = assur.Force("B", (-800.0, 0.0), on="piston")
    >>> engine = assur.Machine(assur.SliderCrank(0.1, 0.35), loads=[gas])
    >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    >>> asked = {"A": assur.metric.rms_reaction("A")}
    >>> assur.sweep(engine, {"rod.length": [0.3, 0.4]}, q, metrics=asked)["A"].round(1)  # N
    array([823.9, 813. ])
    """
    return _joint_force("rms", joint, on, speed, acceleration)


def peak_effort(*, speed: npt.ArrayLike = 0.0, acceleration: npt.ArrayLike = 0.0) -> Metric:
    """The greatest size of the torque or force of the drive, N·m or N, over the positions.

    With several drivers it is the greatest of all, regardless of their units. Where a load jumps,
    a greater one may be between two positions: `Machine.duty` of one design finds it.

    Parameters
    ----------
    speed, acceleration : array_like
        See `peak_reaction`.

    Returns
    -------
    Metric
        For ``assur.sweep(machine, ...)``.

    Examples
    --------
    >>> import assur, numpy as np
    >>> gas = assur.Force("B", (-800.0, 0.0), on="piston")
    >>> engine = assur.Machine(assur.SliderCrank(0.1, 0.35), loads=[gas])
    >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    >>> asked = {"torque": assur.metric.peak_effort()}
    >>> assur.sweep(engine, {"crank.length": [0.1, 0.12]}, q, metrics=asked)["torque"].round(2)
    array([ 83.22, 101.45])
    """
    return Effort("peak", *_motion(speed, acceleration))


def rms_effort(*, speed: npt.ArrayLike = 0.0, acceleration: npt.ArrayLike = 0.0) -> Metric:
    """The root of the mean square of the torque or force of the drive over the positions, N·m or N.

    See `peak_effort`.

    Parameters
    ----------
    speed, acceleration
        As for `peak_effort`.

    Returns
    -------
    Metric
        For ``assur.sweep(machine, ...)``.

    Examples
    --------
    >>> import assur, numpy as np
    >>> gas = assur.Force("B", (-800.0, 0.0), on="piston")
    >>> engine = assur.Machine(assur.SliderCrank(0.1, 0.35), loads=[gas])
    >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    >>> asked = {"torque": assur.metric.rms_effort()}
    >>> found = assur.sweep(engine, {"crank.length": [0.1, 0.2]}, q, metrics=asked)
    >>> found["torque"].round(2)  # N·m
    array([ 57.17, 118.58])
    """
    return Effort("rms", *_motion(speed, acceleration))


def max_inertia() -> Metric:
    """The greatest reduced inertia, kg·m² (driven slide: kg), of a machine with one driver.

    Returns
    -------
    Metric
        For ``assur.sweep(machine, ...)``.

    Examples
    --------
    >>> import assur, numpy as np
    >>> press = assur.Machine(
    ...     assur.SliderCrank(0.1, 0.4), bodies={"crank": assur.Body(inertia=0.5)}
    ... )
    >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    >>> asked = {"J": assur.metric.max_inertia()}
    >>> assur.sweep(press, {"rod.length": [0.3, 0.4]}, q, metrics=asked)["J"]  # kg·m²
    array([0.5, 0.5])
    """
    return Inertia()


def flywheel_inertia(
    fluctuation: float, *, mean_speed: float | None = None, mean: Mean = "extremes"
) -> Metric:
    """The inertia of the flywheel that limits the speed fluctuation, kg·m².

    The turn is solved at the flywheel's own positions, not at those of the sweep.

    Parameters
    ----------
    fluctuation, mean_speed, mean
        As for `Machine.flywheel`.

    Returns
    -------
    Metric
        For ``assur.sweep(machine, ...)``; NaN for a design without such a flywheel.

    Raises
    ------
    InputError
        Here for wrong arguments; by `assur.sweep` for what `Machine.flywheel` refuses.

    Examples
    --------
    >>> import assur, numpy as np
    >>> press = assur.Machine(
    ...     assur.SliderCrank(0.1, 0.4), loads=[assur.Force("B", (-1000.0, 0.0))]
    ... )
    >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    >>> asked = {"J": assur.metric.flywheel_inertia(0.1, mean_speed=10.0)}
    >>> found = assur.sweep(press, {"crank.length": [0.1, 0.2]}, q, metrics=asked)
    >>> found["J"].round(3)  # kg·m²: 1000 N · stroke / (0.1 · (10 rad/s)²)
    array([20., 40.])
    """
    one_of(mean, ("extremes", "period"), "mean")
    speed = None if mean_speed is None else real_number(mean_speed, "mean_speed")
    return FlywheelInertia(real_number(fluctuation, "fluctuation"), speed, mean)
