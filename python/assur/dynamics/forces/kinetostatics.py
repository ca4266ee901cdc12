"""Kinetostatics: reactions and efforts from a motion, with friction, through the core."""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import real_array, short
from assur._validate import checked_threads, one_of
from assur.description.words import Status, has_analogues
from assur.dynamics.batch_results import shape_of_results
from assur.dynamics.forces.joint_places import links_at
from assur.dynamics.forces.reaction_key import RESIDUAL, SOLUTIONS, Key
from assur.dynamics.forces.reactions import Reactions
from assur.dynamics.loads.friction import SlideFriction
from assur.dynamics.loads.load_values import function_values
from assur.dynamics.loads.motors import ConstantTorque
from assur.dynamics.motion.motion_input import times
from assur.dynamics.preconditions import without_arrays
from assur.dynamics.reduction.reduce import reduce, single
from assur.dynamics.reduction.reduced import checked_senses
from assur.dynamics.reduction.undefined_load import Moment, without_value
from assur.errors import InputError
from assur.kinematics.solve_arguments import warn_if_degrees

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from assur._arrays import Float
    from assur.dynamics.model import MachineModel, OnError
    from assur.dynamics.motion.motion_input import DrivenMotion
    from assur.dynamics.motion.sense_at_rest import Senses
    from assur.kinematics.mechanism import Mechanism

# The core's codes for too many solutions to search for, and for a force that it cannot know.
UNSOLVED, UNDETERMINED = -1.0, -2.0


def _keys(mechanism: Mechanism) -> list[Key]:
    core = mechanism.core
    is_redundant = any(core.redundant)
    keys: list[Key] = []
    for joint, links in links_at(mechanism).items():
        index = core.index_of("joint", joint)
        # The force on the last link follows from the others, unless these are undetermined.
        asked = links if is_redundant and len(links) > 1 else links[:-1]
        keys += [Key("joint", index, core.index_of("link", link)) for link in asked]
    for slide in range(len(mechanism.slides)):
        keys += [Key(kind, slide) for kind in ("normal", "moment", "along")]
    keys += [Key("driver", driver) for driver in range(int(np.size(mechanism.q0)))]
    return [*keys, Key("shaking force"), Key("shaking moment")]


def _keys_of_friction(machine: MachineModel) -> list[Key]:
    mechanism = machine.mechanism
    assert mechanism is not None
    core, links_of = mechanism.core, links_at(mechanism)
    keys: list[Key] = []
    for name, friction in machine.friction.items():
        if isinstance(friction, SlideFriction):
            slide = core.index_of("slide", name)
            keys += [Key("friction", slide), Key("slide loss", slide)]
            continue
        joint = core.index_of("joint", name)
        links = [core.index_of("link", link) for link in links_of[name]]
        keys += [*(Key("joint moment", joint, link) for link in links), Key("joint loss", joint)]
    return [*keys, SOLUTIONS, RESIDUAL] if keys else []


def _require_solved(arrays: dict[Key, Float]) -> None:
    """Raise InputError where the core has not solved for the friction of a position."""
    counts = arrays[SOLUTIONS]
    if np.any(counts == UNDETERMINED):
        message = (
            "redundant links leave forces in a pair with friction undetermined, and its friction "
            "with them: remove the friction, or the redundant links"
        )
        raise InputError(message)
    if np.any(counts == UNSOLVED):
        message = (
            "too many pairs with friction depend on one another: their solutions are not "
            "searched for, and there may be several or none: leave out the friction that matters "
            "least"
        )
        raise InputError(message)


def reactions(
    machine: MachineModel,
    motion: DrivenMotion,
    threads: int | None,
    on_error: OnError,
    keys: list[Key] | None = None,
    sense: float | Sequence[float] | None = None,
    solution: int = 0,
) -> Reactions:
    """Return the reactions of a machine; see `Machine.reactions`.

    Some of them, if `keys` are given, without errors.
    """
    without_arrays(machine, "reactions")
    mechanism = machine.mechanism
    if mechanism is None:
        message = "a machine of a table has no joints: reactions need a mechanism"
        raise InputError(message)
    one_of(on_error, ("raise", "nan"), "on_error")
    drivers, is_complete = machine.driver_count, keys is None
    if keys is None:
        keys = [*_keys(mechanism), *_keys_of_friction(machine)]
    moving = broadcast_motion(machine, motion)
    x, v, a, shape = moving
    senses = _senses_needed(machine, motion, sense, shape)
    arrays, status, failure = _solved_in_senses(
        machine, moving, motion.t, threads, keys, senses, (sense, solution)
    )
    rests = np.zeros(status.size, np.bool_) if senses is None else senses.rests.ravel()
    if on_error == "raise" and failure is not None:
        raise failure
    if is_complete:
        drives = [arrays[keys.index(Key("driver", driver))] for driver in range(drivers)]
        each = drives[0][:, None] if drivers == 1 else np.stack(drives, axis=-1)
        is_locked = rests
        if SOLUTIONS in keys:
            is_locked = rests | (arrays[keys.index(SOLUTIONS)] <= 0.0)
        beyond = without_forces(each, status, is_locked)
        if on_error == "raise":
            _require_finite(machine, moving, motion.t, "the reactions are", each, beyond, sense)
        elif beyond.size:
            status = status.copy()
            status[beyond] = Status.NO_VALUE
    by_key: dict[Key, Float] = {}
    for key, array in zip(keys, arrays, strict=True):
        array.flags.writeable = False
        by_key[key] = array.reshape((*shape, 2) if key.has_two_axes else shape)
    if SOLUTIONS in by_key:
        _require_solved(by_key)
    full = shape if drivers == 1 else (*shape, drivers)
    given_motion = np.broadcast_to(x, full), np.broadcast_to(v, full), np.broadcast_to(a, full)

    # Not a closure, which could not be pickled.
    again = partial(_again, machine, motion, threads, sense)
    rubs = again if machine.friction and SOLUTIONS in by_key else None
    source = machine, again
    return Reactions(
        mechanism, given_motion, by_key, status.reshape(shape), rubs, source, rests.reshape(shape)
    )


def _senses_needed(
    machine: MachineModel, motion: DrivenMotion, sense: Any, shape: tuple[int, ...]
) -> Senses | None:
    """Return the senses of a motion with a speed of 0 somewhere, if the machine needs them."""
    asks = bool(machine.friction) or machine.core.follows[1]
    if motion.senses is None or sense is not None or not asks:
        return None
    senses = motion.senses.reshaped(shape)
    return senses if senses.sense.any() else None


def _solved_in_senses(
    machine: MachineModel,
    moving: tuple[Float, Float, Float, tuple[int, ...]],
    t: npt.ArrayLike,
    threads: int | None,
    keys: list[Key],
    senses: Senses | None,
    friction: tuple[float | Sequence[float] | None, int],
) -> tuple[list[Float], npt.NDArray[np.uint8], Any]:
    """Return what `_solved` does for a motion with these senses where its speed is 0."""
    if senses is None:
        return _solved(machine, moving, t, threads, keys, squares=False, friction=friction)
    x, v, a, shape = moving
    still = np.broadcast_to(v, shape)
    creeping = x, senses.creeping(still, with_begins=False), a, shape
    solution = friction[1]
    arrays, status, failure = _solved(machine, creeping, t, threads, keys, False, (1.0, solution))
    backward = (senses.begins & (senses.sense < 0.0)).reshape(-1)
    if backward.any():
        backward_arrays, _, _ = _solved(
            machine, creeping, t, threads, keys, False, (-1.0, solution)
        )
        for forward, backward_values in zip(arrays, backward_arrays, strict=True):
            rows = forward.reshape(backward.size, -1)
            rows[backward] = backward_values.reshape(rows.shape)[backward]
    for key, array in zip(keys, arrays, strict=True):
        rows = array.reshape(status.size, -1)
        if key.kind in ("joint loss", "slide loss"):
            rows[(senses.sense != 0.0).reshape(-1)] = 0.0
        # Inertia and loads are known whatever the pairs transmit.
        if not key.kind.startswith(("shaking", "load")):
            rows[senses.rests.reshape(-1)] = np.nan
    return arrays, status, failure


def _again(
    machine: MachineModel,
    motion: DrivenMotion,
    threads: int | None,
    sense: float | Sequence[float] | None,
    keys: list[Key],
    solution: int,
) -> Reactions:
    """Return some reactions of the same motion, in one of the solutions."""
    return reactions(machine, motion, threads, "nan", keys, sense, solution)


def reaction_squares(
    machine: MachineModel, motion: DrivenMotion, threads: int | None, keys: list[Key]
) -> dict[Key, Float]:
    """Return the greatest and the mean square of reactions over all positions, (designs, 2).

    NaN where a position of a design has no value. Positions are not kept.
    """
    without_arrays(machine, "a metric of reactions")
    moving = broadcast_motion(machine, motion)
    arrays, _, _ = _solved(machine, moving, motion.t, threads, keys, squares=True)
    return {key: array.reshape(-1, 2) for key, array in zip(keys, arrays, strict=True)}


def _solved(
    machine: MachineModel,
    moving: tuple[Float, Float, Float, tuple[int, ...]],
    t: npt.ArrayLike,
    threads: int | None,
    keys: list[Key],
    squares: bool,
    friction: tuple[float | Sequence[float] | None, int] = (None, 0),
) -> tuple[list[Float], npt.NDArray[np.uint8], Any]:
    """Return an array for each key, the statuses, and the exception of the first failure."""
    mechanism = machine.mechanism
    assert mechanism is not None
    drivers, designs = machine.driver_count, machine.shape
    x, v, a, shape = moving
    per_design = bool(designs) and x.ndim > (1 if drivers == 1 else 2)
    full = shape if drivers == 1 else (*shape, drivers)
    everywhere, functions = np.broadcast_to(x, full), machine.core.load_functions
    # One speed for all positions is not repeated; (2, 1) of two drivers are two positions.
    given_once = ((),) if drivers == 1 else ((drivers,),)
    speeds, accelerations = (
        np.ascontiguousarray(
            part if part.shape in given_once else np.broadcast_to(part, full)
        ).ravel()
        for part in (v, a)
    )
    coordinates = np.ascontiguousarray(everywhere if per_design else x).ravel()
    rows = everywhere.reshape(-1, drivers), np.broadcast_to(v, full).reshape(-1, drivers)
    senses = checked_senses(machine, *rows, friction[0])
    at = times(t, shape)
    load_values = np.empty(0)
    if functions:
        load_values = function_values(functions, *rows, at.ravel())
    answer: tuple[list[Float], npt.NDArray[np.uint8], Any] = machine.core.reactions(
        mechanism.values.reshape(-1),
        coordinates,
        per_design,
        speeds,
        accelerations,
        load_values,
        keys,
        math.prod(designs if squares else shape),
        squares,
        (senses, friction[1]),
        checked_threads(threads),
        list(designs),
    )
    return answer


def _require_finite(
    machine: MachineModel,
    moving: tuple[Float, Float, Float, tuple[int, ...]],
    t: npt.ArrayLike,
    what: str,
    drives: Float,
    beyond: npt.NDArray[np.intp],
    sense: float | Sequence[float] | None,
) -> None:
    """Raise the error of a load or an inertia force that is not finite, though the position is.

    `drives`: torques or forces of the drivers, (positions, drivers); `beyond`: those in question.
    """
    if beyond.size:
        (x, v, _, shape), row, drivers = moving, int(beyond[0]), drives.shape[1]
        full = shape if drivers == 1 else (*shape, drivers)
        q, speed = (np.broadcast_to(part, full).reshape(drives.shape)[row] for part in (x, v))
        single_machine, design = single(machine, row, len(drives))
        moment = Moment(q, speed, float(times(t, shape).ravel()[row]), sense)
        failed = without_value(single_machine, moment, what)
        failed.design = design
        raise failed


def without_forces(
    drives: Float, status: npt.NDArray[np.uint8], is_locked: npt.NDArray[np.bool_]
) -> npt.NDArray[np.intp]:
    """Return the positions that are solved, but whose forces are not finite."""
    finite = np.isfinite(drives).all(axis=-1)
    return np.flatnonzero(~finite & has_analogues(status) & ~is_locked)


def broadcast_motion(
    machine: MachineModel, motion: DrivenMotion
) -> tuple[Float, Float, Float, tuple[int, ...]]:
    """Return coordinates, speeds, accelerations, and the shape of the positions of all designs."""
    n = machine.driver_count
    q, speed, acceleration = motion[:3]
    x = real_array(q, "q")
    if machine.mechanism is not None:
        warn_if_degrees(machine.mechanism, x)
    v, a = real_array(speed, "speed"), real_array(acceleration, "acceleration")
    if n > 1 and (x.ndim == 0 or x.shape[-1] != n):
        message = f"q has the shape {x.shape}: with {n} drivers its last axis must be {n}"
        raise InputError(message)
    for name, values, given in (("speed", v, speed), ("acceleration", a, acceleration)):
        if not np.isfinite(values).all():
            message = f"{name} is {short(given)}: finite numbers are needed"
            raise InputError(message)
    shape = shape_of_results(machine, x.shape if n == 1 else x.shape[:-1])
    full = shape if n == 1 else (*shape, n)
    for name, values in (("speed", v), ("acceleration", a)):
        if not _broadcasts(values, full):
            message = f"{name} has the shape {values.shape}, q {x.shape}: they do not fit"
            raise InputError(message)
    return x, v, a, shape


def _broadcasts(values: Float, shape: tuple[int, ...]) -> bool:
    try:
        return np.broadcast_shapes(values.shape, shape) == shape
    except ValueError:
        return False


def effort(
    machine: MachineModel,
    motion: DrivenMotion,
    on_error: OnError,
    sense: float | Sequence[float] | None = None,
) -> Float:
    """Return the effort of the drivers by virtual power; see `Machine.effort`."""
    n = machine.driver_count
    if machine.friction:
        # The power that friction takes depends on the forces in its pairs.
        keys = [*(Key("driver", driver) for driver in range(n)), SOLUTIONS]
        return reactions(machine, motion, None, on_error, keys, sense).driver
    x, v, a, shape = broadcast_motion(machine, motion)
    full = shape if n == 1 else (*shape, n)
    # A motor's rotor belongs to the drive.
    bare = machine
    if machine.motor is not None and machine.mechanism is not None:
        # Of as many machines, if they differ by their motors.
        idle = [ConstantTorque(np.zeros(machine.shape)), *[None] * (n - 1)]
        motor = idle if machine.varies else None
        bare = type(machine)(
            machine.mechanism, bodies=machine.bodies, loads=machine.loads, motor=motor
        )
    senses = _senses_needed(machine, motion, sense, shape)
    rests, going = np.zeros(shape, np.bool_), v
    if senses is not None:
        rests, sense = senses.rests, 1.0
        going = senses.creeping(np.broadcast_to(v, shape), with_begins=True)
    inertia, rates, moment, _ = reduce(bare, x, going, on_error, times(motion.t, shape), sense)
    speeds = np.broadcast_to(v, full).reshape(*shape, n)
    accelerations = np.broadcast_to(a, full).reshape(*shape, n)
    out = -moment
    with np.errstate(over="ignore", invalid="ignore"):
        for i in range(n):
            for j in range(n):
                out[..., i] += inertia[..., i, j] * accelerations[..., j]
                for k in range(n):
                    # Lagrange's equations: Σ (∂Mᵢⱼ/∂k − ½ ∂Mⱼₖ/∂i) q̇ⱼ q̇ₖ.
                    rate = rates[..., k, i, j] - 0.5 * rates[..., i, j, k]
                    out[..., i] += rate * speeds[..., j] * speeds[..., k]
    if on_error == "raise":
        solved = np.full(out.size // n, Status.OK, dtype=np.uint8)
        drives, moving = out.reshape(-1, n), (x, v, a, shape)
        beyond = without_forces(drives, solved, rests.ravel())
        _require_finite(machine, moving, motion.t, "the effort is", drives, beyond, sense)
    out[np.isinf(out)] = np.nan
    out[rests] = np.nan
    return out[..., 0][()] if n == 1 else out
