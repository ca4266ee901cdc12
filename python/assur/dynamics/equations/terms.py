"""Terms of the equations of motion, asked of the core for all designs and positions at once."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from assur._arrays import Float, finite_array, real_array, require_finite
from assur._validate import checked_threads
from assur.dynamics.batch_results import dimensions, shape_of_results
from assur.dynamics.loads.load_values import function_values
from assur.dynamics.reduction.reduced import checked_senses
from assur.errors import InputError
from assur.kinematics.solve_arguments import warn_if_degrees

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from assur.dynamics.model import MachineModel
    from assur.errors import AssurError

# A term as the core names it: its kind, and the index of the joint of a Jacobian.
Term = tuple[str, int]
# A direction as the core names it: "q", "speed", "acceleration", "effort" or "dimension", with its
# index.
Direction = tuple[str, int]
NOTHING = np.empty(0)
# No acceleration is asked for: a call takes microseconds, of which one would be this.
NONE = 0.0


class State(NamedTuple):
    """Coordinates and speeds of the drivers, with what is asked for there."""

    q: npt.ArrayLike
    speed: npt.ArrayLike
    effort: npt.ArrayLike | None = None
    t: npt.ArrayLike = 0.0
    sense: float | Sequence[float] | None = None
    # Whether speeds and efforts must be finite; those of later stages of a step need not be, nor
    # those of a batch where each row fails alone.
    is_checked: bool = True
    acceleration: npt.ArrayLike = NONE


class Terms(NamedTuple):
    """An array for each term, (rows, width), in the shape of designs and positions."""

    arrays: list[Float]
    shape: tuple[int, ...]
    status: npt.NDArray[np.uint8]
    # The first position that does not exist.
    failure: AssurError | None
    # Of all positions, (rows, drivers).
    q: Float
    speed: Float


def require_equations(machine: MachineModel, call: str) -> None:
    """Refuse machines of tables, and friction."""
    if machine.mechanism is None:
        message = f"{call}() is of a mechanism: a machine of a table has reduced_inertia and run"
        raise InputError(message)
    if machine.friction:
        message = (
            f"{call}() is without friction, which this machine has in "
            f"{', '.join(map(repr, machine.friction))}: use effort or reactions, or run in time"
        )
        raise InputError(message)


def terms_of(
    machine: MachineModel,
    state: State,
    terms: list[Term],
    threads: int | None = None,
    by: list[Direction] | None = None,
) -> Terms:
    """Ask the core for terms, or for their derivatives; `effort` of None is that of the motors."""
    mechanism = machine.mechanism
    assert mechanism is not None
    n, designs = machine.driver_count, machine.shape
    x = real_array(state.q, "q", copy=False)
    warn_if_degrees(mechanism, x)
    if n > 1 and (x.ndim == 0 or x.shape[-1] != n):
        message = f"q has the shape {x.shape}: with {n} drivers its last axis must be {n}"
        raise InputError(message)
    positions = x.shape if n == 1 else x.shape[:-1]
    varies = bool(machine.varies)
    shape = shape_of_results(machine, positions)
    full = shape if n == 1 else (*shape, n)
    speed = _rates(state.speed, "speed", full, n, x, state.is_checked)
    # Without efforts the motors act alone.
    effort = acceleration = np.zeros(n)
    if state.acceleration is not NONE:
        acceleration = _rates(state.acceleration, "acceleration", full, n, x)
    if state.effort is not None:
        effort = _rates(state.effort, "effort", full, n, x, state.is_checked)
    per_design = varies or (bool(designs) and x.ndim > (1 if n == 1 else 2))
    if per_design:
        x = np.broadcast_to(x, full)
    rows = math.prod(shape)
    every_q: Float
    every_speed: Float
    functions, follows_ways = machine.core.functions, machine.core.follows[1]
    values, senses = NOTHING, list[float]()
    t = state.t if type(state.t) is float else finite_array(state.t, "t")
    if functions or follows_ways:
        every_q = np.broadcast_to(x, full).reshape(-1, n)
        every_speed = speed if speed.size == rows * n else np.broadcast_to(speed, (rows, n))
        every_speed = every_speed.reshape(-1, n)
        senses = checked_senses(machine, every_q, every_speed, state.sense)
        at = np.broadcast_to(t, shape).ravel()
        values = function_values(functions, every_q, every_speed, at)
    arrays, status, failure = machine.core.equations(
        dimensions(machine),
        flat(x),
        per_design,
        (speed, acceleration, effort),
        state.effort is None,
        values,
        terms,
        rows,
        senses,
        checked_threads(threads),
        list(designs if mechanism.shape else ()),
        by,
    )
    return Terms(arrays, shape, status, failure, x, speed)


def flat(values: Float) -> Float:
    """Return the numbers in a row, where they are if the core can read them there."""
    flags = values.flags
    if not (flags.c_contiguous and flags.aligned):
        values = np.require(values, requirements=("C", "A"))
    return values.reshape(-1)


def _rates(
    given: Any, name: str, full: tuple[int, ...], n: int, x: Float, is_checked: bool = True
) -> Float:
    """Return numbers of the drivers, flat: n for all rows, or n for each row."""
    values = real_array(given, name, copy=False)
    if is_checked:
        require_finite(values, name)
    if values.ndim == 0 or (n > 1 and values.shape == (n,)):
        if n > 1 and values.ndim == 0:
            return np.full(n, float(values))
        return flat(values)
    if values.shape == full:
        return flat(values)
    try:
        return flat(np.broadcast_to(values, full))
    except ValueError as error:
        machines = "" if full == x.shape else f" (with its designs {full})"
        message = f"{name} has the shape {values.shape}, q {x.shape}{machines}: they do not fit"
        raise InputError(message) from error
