"""`Machine.step`: environments in a loop, one or many steps at a time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias

import numpy as np

from assur._arrays import Float, as_number, real_array, real_number, short
from assur._validate import checked_threads, one_of, whole_number
from assur.description.words import Status, has_analogues
from assur.dynamics.batch_results import dimensions, shape_of_results
from assur.dynamics.equations.terms import flat
from assur.dynamics.preconditions import relative_tolerance, tolerance_pair
from assur.errors import InputError

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur._arrays import Number
    from assur.dynamics.model import MachineModel

__all__ = ["Stepped"]

# More are no loop's single call; it goes on for years.
MOST_STEPS = 10**15
# The method with even steps, and those that keep a tolerance.
EVEN, PAIRS = "rk4", ("RK45", "DOP853")
# Of those, where it is not given.
RTOL = 1e-10

# A method with its relative tolerance, and absolute ones.
Pair: TypeAlias = tuple[Literal["DOP853", "RK45"], tuple[float, list[float] | None]]


class Stepped(NamedTuple):
    """Environments after some steps.

    Attributes
    ----------
    q, speed : float or numpy.ndarray
        Coordinates and speeds of the drivers, in the shape in which they were given.
    status : int or numpy.ndarray of uint8
        The worst `Status` on the way: `UNREACHABLE` beyond a dead point, `BAD_INPUT` where a driver
        would go more than 1 rad (or the size of the mechanism) in a step or a state is not finite,
        `NO_VALUE` where a load, an effort or the inertia gives no acceleration. Of methods with
        error control `NOT_CONVERGED` where the tolerance is not met, or only by more than 10000
        steps of their own in a dt.

    Examples
    --------
    >>> import assur
    >>> machine = assur.Machine(
    ...     assur.SliderCrank(0.1, 0.4), bodies={"crank": assur.Body(inertia=0.5)}
    ... )
    >>> after = machine.step(0.0, 2.0, 1.0, dt=0.01, n=10)  # N·m, s; ten steps
    >>> round(after.q, 6), round(after.speed, 6), after.status
    (np.float64(0.21), np.float64(2.2), np.uint8(0))
    """

    q: Number
    speed: Number
    status: npt.NDArray[np.uint8]


class Environments(NamedTuple):
    """States and efforts as users give them."""

    q: npt.ArrayLike
    speed: npt.ArrayLike
    effort: npt.ArrayLike | None


def pair_of(method: Any, rtol: Any, atol: Any) -> Pair | None:
    """Return a method with error control and its tolerances, None for even steps."""
    one_of(method, (EVEN, *PAIRS), "method")
    if method != EVEN:
        relative = RTOL if rtol is None else relative_tolerance(rtol)
        return method, (relative, tolerance_pair(atol))
    for name, given in (("rtol", rtol), ("atol", atol)):
        if given is not None:
            message = (
                f"{name} is {short(given)}, but {EVEN!r} has even steps: give method="
                f"{PAIRS[0]!r} or {PAIRS[1]!r}, which keep a tolerance, or leave {name} out"
            )
            raise InputError(message)
    return None


def step(
    machine: MachineModel,
    environments: Environments,
    times: tuple[float, int],
    pair: Pair | None,
    on_error: str,
    threads: int | None,
) -> Stepped:
    """See `Machine.step`; `times`: of a step, and how many."""
    dt, n = times
    mechanism = machine.mechanism
    assert mechanism is not None
    _refuse_functions(machine)
    drivers = machine.driver_count
    seconds = real_number(dt, "dt")
    if seconds == 0.0:
        message = "dt is 0: a time is needed, s"
        raise InputError(message, value=seconds)
    steps = whole_number(n, "n", 1, MOST_STEPS)
    q, speed = real_array(environments.q, "q", copy=False), _rates(environments.speed, "speed")
    if drivers > 1 and (q.ndim == 0 or q.shape[-1] != drivers):
        message = (
            f"q has the shape {q.shape}: with {drivers} drivers its last axis must be {drivers}"
        )
        raise InputError(message)
    positions = q.shape if drivers == 1 else q.shape[:-1]
    shape = shape_of_results(machine, positions)
    full = shape if drivers == 1 else (*shape, drivers)
    states = [_in_shape(values, name, full, q) for values, name in ((q, "q"), (speed, "speed"))]
    if environments.effort is None:
        effort = np.zeros(drivers)
    else:
        effort = _rates(environments.effort, "effort")
        each = effort.ndim == 0 or (drivers > 1 and effort.shape == (drivers,))
        if each:
            effort = np.broadcast_to(effort, (drivers,)) if effort.ndim == 0 else effort
        else:
            effort = _in_shape(effort, "effort", full, q)
    rows = int(np.prod(shape)) if shape else 1
    (after_q, after_speed), status = machine.core.step(
        dimensions(machine),
        (states[0], states[1], flat(effort)),
        environments.effort is None,
        rows,
        (seconds, steps, pair),
        on_error == "hold",
        checked_threads(threads),
    )
    if on_error == "raise":
        _require_good(machine, status, (states[0], states[1], shape), (seconds, pair))
    return Stepped(
        as_number(after_q.reshape(full)[()]),
        as_number(after_speed.reshape(full)[()]),
        status.reshape(shape)[()],
    )


def _rates(values: npt.ArrayLike, name: str) -> Float:
    return real_array(values, name, copy=False)


def _in_shape(values: Float, name: str, full: tuple[int, ...], q: Float) -> Float:
    try:
        return flat(np.broadcast_to(values, full))
    except ValueError as error:
        message = f"{name} has the shape {values.shape}, q {q.shape}: they do not fit"
        raise InputError(message) from error


def _refuse_functions(machine: MachineModel) -> None:
    functions = machine.core.functions
    if functions:
        name = getattr(functions[0], "__name__", repr(functions[0]))
        message = (
            f"step() calls no Python functions, and this machine has {short(name)}: give such a "
            "load as effort, or as a Table, or use run"
        )
        raise InputError(message)


def _require_good(
    machine: MachineModel,
    status: npt.NDArray[np.uint8],
    states: tuple[Float, Float, tuple[int, ...]],
    method: tuple[float, Pair | None],
) -> None:
    """Raise the error of the first environment that could not make all steps."""
    bad = np.flatnonzero(~has_analogues(status))
    if not bad.size:
        return
    row, drivers = int(bad[0]), machine.driver_count
    (*both, shape), (dt, pair) = states, method
    q, speed = (state[row * drivers : (row + 1) * drivers].tolist() for state in both)
    at = tuple(int(i) for i in np.unravel_index(row, shape)) if shape else ()
    where = f"environment {at[0] if len(at) == 1 else at}: " if at else ""
    name = Status(int(status[row])).name
    why = {
        "BAD_INPUT": f"it goes too far in a step of {dt:g} s, or its state is not finite: take "
        "shorter steps",
        "NO_VALUE": "a load has no finite value there, or no inertia resists a driver",
        "SINGULAR": "it reaches a singular position",
        "BAD_DIMENSION": "its design has a dimension that is not valid",
    }
    if pair is not None:
        why["BAD_INPUT"] = "its state is not finite, or its speed beyond all steps"
        why["NOT_CONVERGED"] = (
            f"rtol = {pair[1][0]:g} is not met, or by too many steps of its own in dt = {dt:g} s: "
            "take a greater tolerance or a shorter dt"
        )
    reason = why.get(name, "it reaches a position that does not exist")
    message = f"{where}{name} within these steps from q = {q}, speed = {speed}: {reason}"
    raise InputError(message, q=q if drivers > 1 else q[0])
