"""`Machine.step`: environments in a loop, one or many steps at a time."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from assur._arrays import Float, as_number, real_array, real_number, short
from assur._validate import checked_threads, whole_number
from assur.description.words import Status, has_analogues
from assur.dynamics.batch_results import dimensions, shape_of_results
from assur.dynamics.equations.terms import flat
from assur.errors import InputError

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur._arrays import Number
    from assur.dynamics.model import MachineModel

__all__ = ["Stepped"]

# More are no loop's single call; it goes on for years.
MOST_STEPS = 10**15


class Stepped(NamedTuple):
    """Environments after some steps.

    Attributes
    ----------
    q, speed : float or numpy.ndarray
        Coordinates and speeds of the drivers, in the shape in which they were given.
    status : int or numpy.ndarray of uint8
        The worst `Status` on the way: `UNREACHABLE` beyond a dead point, `BAD_INPUT` where a driver
        would go more than 1 rad (or the size of the mechanism) in a step or a state is not finite,
        `NO_VALUE` where a load, an effort or the inertia gives no acceleration.

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


def step(
    machine: MachineModel,
    environments: Environments,
    dt: float,
    n: int,
    on_error: str,
    threads: int | None,
) -> Stepped:
    """See `Machine.step`."""
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
        (seconds, steps),
        on_error == "hold",
        checked_threads(threads),
    )
    if on_error == "raise":
        _require_good(machine, status, states, shape, seconds)
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
    states: list[Float],
    shape: tuple[int, ...],
    dt: float,
) -> None:
    """Raise the error of the first environment that could not make all steps."""
    bad = np.flatnonzero(~has_analogues(status))
    if not bad.size:
        return
    row, drivers = int(bad[0]), machine.driver_count
    q, speed = (state[row * drivers : (row + 1) * drivers].tolist() for state in states)
    at = tuple(int(i) for i in np.unravel_index(row, shape)) if shape else ()
    where = f"environment {at[0] if len(at) == 1 else at}: " if at else ""
    name = Status(int(status[row])).name
    why = {
        "BAD_INPUT": f"it goes too far in a step of {dt:g} s, or its state is not finite: take "
        "shorter steps",
        "NO_VALUE": "a load has no finite value there, or no inertia resists a driver",
        "SINGULAR": "it reaches a singular position",
        "BAD_DIMENSION": "its design has a dimension that is not valid",
    }.get(name, "it reaches a position that does not exist")
    message = f"{where}{name} within these steps from q = {q}, speed = {speed}: {why}"
    raise InputError(message, q=q if drivers > 1 else q[0])
