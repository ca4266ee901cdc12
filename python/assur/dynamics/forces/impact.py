"""Impacts: a link struck by an impulse, or stopped by an obstacle."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from assur._arrays import as_number, finite_array, in_range, short
from assur._summary import summary
from assur.dynamics.forces.kinetostatics import broadcast_motion, reactions
from assur.dynamics.loads.loads import Force, Torque
from assur.dynamics.motion.motion_input import DrivenMotion
from assur.dynamics.preconditions import without_arrays
from assur.dynamics.reduction.reduce import reduced_inertia, reduced_moment
from assur.errors import InputError

if TYPE_CHECKING:
    from assur._arrays import Number
    from assur.dynamics.forces.reactions import Reactions
    from assur.dynamics.model import MachineModel, OnError

__all__ = ["Impact"]


class Impact(NamedTuple):
    """What an impact does to a machine, by `Machine.impact`.

    Attributes
    ----------
    speed : ndarray
        Speeds of the drivers after it, rad/s or m/s.
    impulse : ndarray
        The impulse along the unit load, N·s (of a torque: N·m·s): along a force (2, 0) of 3 N·s it
        is 1.5. 0 where the machine moves away from the obstacle.
    energy_lost : ndarray
        Kinetic energy before less that after, J.
    reactions : Reactions
        Impulses in the pairs, N·s, and their moments, N·m·s. The drive gives only the impulse that
        turns the rotor of its motor.

    Examples
    --------
    A flywheel of 0.5 kg·m² strikes at 0.1 m and stops:

    >>> import assur, numpy as np
    >>> machine = assur.Machine(
    ...     assur.SliderCrank(0.1, 0.4), bodies={"crank": assur.Body(inertia=0.5)}
    ... )
    >>> stop = assur.Force("A", (-1.0, 0.0))
    >>> hit = machine.impact(stop, q=np.pi / 2, speed=-2.0)
    >>> hit.impulse.round(6), hit.energy_lost.round(6)  # N·s, J
    (np.float64(10.0), np.float64(1.0))
    """

    speed: Number
    impulse: Number
    energy_lost: Number
    reactions: Reactions

    def __repr__(self) -> str:
        return summary(self)


def impact(
    machine: MachineModel,
    load: Any,
    motion: DrivenMotion,
    restitution: Any,
    impulse: Any,
    on_error: OnError,
) -> Impact:
    """Return what an impact does; see `Machine.impact`."""
    without_arrays(machine, "impact")
    mechanism = machine.mechanism
    if mechanism is None:
        message = "a machine of a table has no links: an impact needs a mechanism"
        raise InputError(message)
    _check_load(load)
    n = machine.driver_count
    q, speed, _, shape = broadcast_motion(machine, motion)
    full = shape if n == 1 else (*shape, n)
    before = np.broadcast_to(speed, full).reshape(*shape, n)
    # The unit load's moments on the drivers are the derivatives of its path.
    unit_load = type(machine)(mechanism, loads=[load])
    path = np.asarray(reduced_moment(unit_load, q, on_error=on_error)).reshape(*shape, n)
    inertia = np.asarray(reduced_inertia(machine, q, on_error).value).reshape(*shape, n, n)
    with in_range("an impact"), np.errstate(divide="ignore"):
        answer = _solved(inertia, path)
        mobility = (path * answer).sum(axis=-1)
        approach = (path * before).sum(axis=-1)
        if impulse is None:
            e = _restitution(restitution, shape)
            size = np.where(approach < 0.0, -(1.0 + e) * approach / mobility, 0.0)
            size = np.where(np.isnan(mobility), np.nan, size)
        else:
            size = _of_positions(finite_array(impulse, "impulse"), "impulse", shape)
        change = answer * size[..., None]
        # ½ q̇ᵀ H q̇ before less after, without the difference of two large numbers.
        lost = -size * (approach + 0.5 * mobility * size)
    impulses = _impulses(machine, unit_load, q, (speed, change.reshape(full)), size, on_error)
    after = (before + change).reshape(full)
    speed_after, given, energy = (as_number(part[()]) for part in (after, size, lost))
    return Impact(speed_after, given, energy, impulses)


def _check_load(load: Any) -> None:
    parts: tuple[Any, ...]
    if isinstance(load, Force):
        parts = load.force
    elif isinstance(load, Torque):
        parts = (load.torque,)
    else:
        message = (
            f"{short(load)} says not where the impact acts: an assur.Force (its direction and "
            "point) or assur.Torque is needed"
        )
        raise InputError(message)
    if not all(isinstance(part, int | float) for part in parts):
        message = f"{short(load)}: an impact needs a direction in numbers"
        raise InputError(message)
    if load.while_ is not None:
        message = f"{short(load)}: an impact is not a motion in one direction; leave while_= out"
        raise InputError(message)
    if not any(parts):
        message = f"{short(load)} is zero: an impact needs a direction"
        raise InputError(message, value=0.0)


def _restitution(restitution: Any, shape: tuple[int, ...]) -> Any:
    e = finite_array(restitution, "restitution")
    if (e < 0.0).any() or (e > 1.0).any():
        message = f"restitution is {short(restitution)}: from 0 (it stays) to 1 (nothing is lost)"
        raise InputError(message)
    return _of_positions(e, "restitution", shape)


def _of_positions(numbers: Any, what: str, shape: tuple[int, ...]) -> Any:
    if numbers.size == 1:
        numbers = numbers.reshape(())
    try:
        return np.broadcast_to(numbers, shape)
    except ValueError as error:
        message = f"{what} has the shape {numbers.shape}, the positions {shape}: they do not fit"
        raise InputError(message) from error


def _solved(inertia: Any, path: Any) -> Any:
    """Return H⁻¹ g, by Gauss's elimination: H is positive definite."""
    matrix, right = inertia.copy(), path.copy()
    n = right.shape[-1]
    for pivot in range(n):
        least = matrix[..., pivot, pivot]
        if np.any(least <= 0.0):
            message = (
                "the machine has no inertia at some position, so an impact would make it "
                "infinitely fast: give its links bodies"
            )
            raise InputError(message)
        for row in range(pivot + 1, n):
            factor = matrix[..., row, pivot] / least
            matrix[..., row, :] -= factor[..., None] * matrix[..., pivot, :]
            right[..., row] -= factor * right[..., pivot]
    for row in reversed(range(n)):
        known = (matrix[..., row, row + 1 :] * right[..., row + 1 :]).sum(axis=-1)
        right[..., row] = (right[..., row] - known) / matrix[..., row, row]
    return right


def _impulses(
    machine: MachineModel,
    unit_load: MachineModel,
    q: Any,
    speeds: tuple[Any, Any],
    impulse: Any,
    on_error: OnError,
) -> Reactions:
    """Return the impulses in all pairs: those of the change of speed, and of the impact itself.

    `unit_load` is the machine with the unit load alone. Impulses balance like forces that
    accelerate the bodies, from rest, by the change of speed.
    """
    mechanism = machine.mechanism
    assert mechanism is not None
    before, change = speeds
    bodies = type(machine)(mechanism, bodies=machine.bodies)
    known = np.nan_to_num(change)
    of_change = reactions(bodies, DrivenMotion(q, 0.0, known, 0.0), None, on_error)
    of_unit = reactions(unit_load, DrivenMotion(q, 0.0, 0.0, 0.0), None, on_error)
    impulses = {}
    for key, values in of_change.by_key.items():
        factor = impulse[..., None] if values.ndim > np.ndim(impulse) else impulse
        with np.errstate(invalid="ignore"):
            # The place of a guide's force may be at infinity.
            impulses[key] = np.asarray(values + factor * of_unit.by_key[key])
        impulses[key].flags.writeable = False
    if mechanism.slides:
        places = mechanism.solve(q, order=0, outputs=list(mechanism.slides), on_error=on_error)
        for key in [key for key in impulses if key.kind == "along"]:
            name = list(mechanism.slides)[key.index]
            normal, moment = (impulses[replace(key, kind=kind)] for kind in ("normal", "moment"))
            with np.errstate(invalid="ignore", divide="ignore"):
                impulses[key] = np.asarray(places.slide(name).value + moment / normal)
    motion = of_change.q, np.broadcast_to(before, of_change.q.shape), change
    return type(of_change)(mechanism, motion, impulses, of_change.status)
