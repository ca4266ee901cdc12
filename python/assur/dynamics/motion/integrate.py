"""The implementation of `Machine.run` and `Machine.steady_state`: checks, then the core."""

from __future__ import annotations

import math
import warnings
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

from assur import events as known_events
from assur import flywheel as flywheels
from assur._arrays import finite_array, real_number
from assur._validate import one_of
from assur.dynamics import components
from assur.dynamics.batch_results import dimensions, shape_of_results
from assur.dynamics.components import as_list
from assur.dynamics.loads.table import Table
from assur.dynamics.motion.run import Run, energies_are_infinite
from assur.dynamics.motion.runs import FAILED, Made, Outcomes, Runs
from assur.dynamics.motion.steady import SteadyState
from assur.dynamics.preconditions import (
    checked_breaks,
    checked_seconds,
    one_design,
    positive_number,
    relative_tolerance,
    require_rotary_driver,
    require_whole_periods,
    step_count,
    tolerance_pair,
    turn_count,
    without_followers,
    without_friction,
)
from assur.dynamics.reduction.undefined_load import not_covered, table_names
from assur.errors import AssurError, AssurWarning, InputError
from assur.kinematics.solve_arguments import warn_if_degrees

if TYPE_CHECKING:
    from collections.abc import Iterator

    import numpy.typing as npt

    from assur._arrays import Float
    from assur.dynamics.model import MachineModel

# Less accurate periods do not determine the speed.
LOOSEST_RTOL = 1e-4
# Ends of a run that the user did not ask for: they warn.
EARLY_ENDS = (
    "locked",
    "lost",
    "table ends",
    "motor table ends",
    "stalled",
    "step limit",
    "time limit",
)
# Places of a period at which tables are tried, to name the load whose table does not cover it.
PLACES = 721
# Events of friction.
STICK, SLIP = "stick", "slip"
# Warn of an energy imbalance above both: relative to the greatest energy, and in units of rtol.
IMBALANCE_WARN_FLOOR, IMBALANCE_WARN_RTOLS = 1e-6, 1e3
# Rounding of the sum of the energies: a machine that has hardly moved has a potential far greater
# than all changes.
ROUNDING = 64.0 * float(np.finfo(np.float64).eps)
# Of an error, passed on with the index of the run.
FIELDS = (
    *("kind", "hint", "joint", "link", "slide", "driver", "dimension", "names", "group"),
    *("design", "q", "t", "value"),
)
# Warn when the balancing moment exceeds this fraction of the motor's.
BALANCE_WARN_RTOL = 1e-6


class Inputs(NamedTuple):
    """The checked arguments of runs: what all have in common."""

    along_q: bool
    t0: float
    method: Literal["DOP853", "RK45"]
    tolerances: tuple[float, list[float] | None]
    limits: tuple[float, int, float | None]
    breaks: list[float]
    events: list[Any]
    # The events as the core reads them.
    checked: list[Any]


def run(
    machine: MachineModel,
    t_end: Any,
    q0: Any,
    speed0: Any,
    q_end: Any,
    t0: Any,
    many: tuple[str, str, int | None],
    **options: Any,
) -> Run | Runs:
    """See `Machine.run`; `many`: what to keep of many runs, how to report errors, and threads."""
    if machine.driver_count > 1:
        without_friction(machine, "run with several drivers")
        without_followers(machine, "run with several drivers")
    along_q = q_end is not None
    if along_q == (t_end is not None):
        message = "run needs t_end or q_end" + (", not both" if along_q else "")
        raise InputError(message)
    inputs = _inputs(machine, along_q, t0, options)
    q, speed = _states(machine, q0, "q0"), _states(machine, speed0, "speed0")
    name = "q_end" if along_q else "t_end"
    end = finite_array(q_end if along_q else t_end, name)
    tail = 0 if machine.driver_count == 1 else 1
    if machine.shape or q.ndim > tail or speed.ndim > tail or end.ndim:
        return _many(machine, inputs, (q, speed, end), many)
    return _one(machine, inputs, (q, speed, float(end)))


def _inputs(machine: MachineModel, along_q: bool, t0: Any, options: dict[str, Any]) -> Inputs:
    n = machine.driver_count
    watched = as_list(options["events"], "events")
    checked = [known_events.checked(event, machine.mechanism, n) for event in watched]
    if along_q and any(isinstance(event, known_events.Obstacle) for event in watched):
        message = "q_end: over q a motion does not turn back at an Obstacle; give t_end"
        raise InputError(message)
    if along_q and n > 1:
        message = f"q_end: a run over q needs a single driver, this mechanism has {n}"
        raise InputError(message)
    return Inputs(
        along_q,
        real_number(t0, "t0"),
        options["method"],
        (relative_tolerance(options["rtol"]), tolerance_pair(options["atol"])),
        (
            positive_number(options["max_step"], "max_step"),
            step_count(options["max_steps"]),
            checked_seconds(options["max_seconds"]),
        ),
        checked_breaks(options["breaks"]),
        watched,
        checked,
    )


def _refused_end(q: float, speed: float, end: float) -> InputError | None:
    """Return the error of a run over q that cannot reach its end."""
    if speed == 0.0:
        message = "q_end: a run over q needs an initial speed, speed0 is 0"
        return InputError(message, value=0.0)
    if (end - q) * speed < 0.0:
        message = f"q_end = {end:g} lies behind q0 = {q:g} at speed0 = {speed:g}"
        return InputError(message, value=end)
    return None


def _one(machine: MachineModel, inputs: Inputs, state: tuple[Float, Float, float]) -> Run:
    n = machine.driver_count
    q, speeds = (np.broadcast_to(values, (n,)).tolist() for values in state[:2])
    end = state[2]
    if inputs.along_q and (refused := _refused_end(q[0], speeds[0], end)) is not None:
        raise refused
    with _naming_tables(machine, np.array(q), speeds):
        core = machine.core.run(
            _dimensions(machine),
            inputs.along_q,
            (inputs.t0, q, speeds),
            end,
            inputs.method,
            inputs.tolerances,
            inputs.limits,
            inputs.breaks,
            inputs.checked,
        )
    # The core numbers friction's events after those that were asked for.
    events = [*inputs.events, STICK, SLIP]
    tables = table_names(machine) if core.ending["kind"] == "table ends" else ()
    made = Run(core, machine.mechanism, n, events, inputs.along_q, tables)
    if made.end in EARLY_ENDS:
        warnings.warn(f"the run ended early: {made.message}", AssurWarning, stacklevel=4)
    # A machine from a table has no singular positions.
    if machine.mechanism is None:
        return made
    worst, size, potential, infinite_at = core.imbalance()
    if infinite_at is not None:
        raise energies_are_infinite(infinite_at)
    if worst > max(_allowed(inputs) * size, ROUNDING * potential):
        warnings.warn(_imbalance_text("", worst / size if size else worst), AssurWarning, 4)
    return made


def _many(
    machine: MachineModel,
    inputs: Inputs,
    states: tuple[Float, Float, Float],
    many: tuple[str, str, int | None],
) -> Runs:
    n, (keep, on_error, threads) = machine.driver_count, many
    shape, (q, speed, end) = _broadcast(states, n, machine)
    if inputs.along_q:
        for flat, state in enumerate(zip(q.tolist(), speed.tolist(), end.tolist(), strict=True)):
            if (refused := _refused_end(*state)) is not None:
                raise _of_run(refused, flat, shape, 0)
    core = machine.core.runs(
        (dimensions(machine, each=True), math.prod(machine.shape)),
        inputs.along_q,
        (inputs.t0, q, speed, end),
        (inputs.method, inputs.tolerances),
        inputs.limits,
        inputs.breaks,
        inputs.checked,
        (keep == "ends", threads),
    )
    ends, (worst, size, potential, infinite), kinds, status = core.outcomes(n)
    # A machine from a table has no energies of its own to check.
    if machine.mechanism is None:
        infinite = np.full_like(infinite, np.nan)
    made = Made(
        core,
        machine.mechanism,
        n,
        [*inputs.events, STICK, SLIP],
        inputs.along_q,
        table_names(machine),
        q if inputs.along_q else np.full(end.size, inputs.t0),
        Outcomes(ends[:3], np.array(kinds, np.str_), status, infinite),
        keep == "all",
    )
    runs = Runs(made, np.arange(end.size).reshape(shape))
    failed = np.flatnonzero(runs.end == FAILED)
    if on_error == "raise" and failed.size:
        first = int(failed[0])
        raise _failure(machine, runs, first, failed.size - 1, (q, speed))
    _warn_of(runs, inputs, machine.mechanism is not None, (worst, size, potential))
    return runs


def _broadcast(
    states: tuple[Float, Float, Float], n: int, machine: MachineModel
) -> tuple[tuple[int, ...], tuple[Float, Float, Float]]:
    """Return the shape of the runs, and states and ends of all of them, flat."""
    tail = 0 if n == 1 else 1
    shapes = {
        name: values.shape[: values.ndim - cut] if values.ndim else ()
        for name, values, cut in zip(
            ("q0", "speed0", "the end"), states, (tail, tail, 0), strict=True
        )
    }
    try:
        shape = np.broadcast_shapes(*shapes.values())
        shape = shape_of_results(machine, shape)
        full = [(*shape, *(() if n == 1 else (n,)))] * 2 + [shape]
        flat = [
            np.ascontiguousarray(np.broadcast_to(values, to)).reshape(-1)
            for values, to in zip(states, full, strict=True)
        ]
    except ValueError as error:
        sizes = ", ".join(f"{name} {size}" for name, size in shapes.items())
        message = f"the shapes of the runs do not fit: {sizes}, designs {machine.shape}"
        raise InputError(message) from error
    return shape, (flat[0], flat[1], flat[2])


def _failure(
    machine: MachineModel, runs: Runs, flat: int, more: int, states: tuple[Float, Float]
) -> AssurError:
    """Return the error of the first run that there is not, with its index."""
    n = machine.driver_count
    q, speed = (values[flat * n : (flat + 1) * n].tolist() for values in states)
    index = tuple(int(i) for i in np.unravel_index(flat, runs.shape)) if runs.shape else ()
    one = machine.design(index[: len(machine.shape)]) if machine.shape else machine
    try:
        with _naming_tables(one, np.array(q), speed):
            runs[index]
    except AssurError as error:
        return _of_run(error, flat, runs.shape, more)
    message = "there is a run"
    raise AssertionError(message)


def _of_run(error: AssurError, flat: int, shape: tuple[int, ...], more: int) -> AssurError:
    """Return the error of a run with its index, and how many more there are."""
    index = tuple(int(i) for i in np.unravel_index(flat, shape)) if shape else ()
    where = f"run {index[0] if len(index) == 1 else index}: " if index else ""
    rest = f" (and {more} more of {math.prod(shape)}; on_error='nan' keeps the others)"
    message = f"{where}{error}{rest if more else ''}"
    return type(error)(message, **{name: getattr(error, name) for name in FIELDS})


def _warn_of(
    runs: Runs, inputs: Inputs, is_mechanism: bool, balance: tuple[Float, Float, Float]
) -> None:
    """Warn once of all that ended early, and once of all whose energy is out of balance."""
    kinds, counts = np.unique(runs.end[np.isin(runs.end, EARLY_ENDS)], return_counts=True)
    total = runs.end.size
    if kinds.size:
        ends = ", ".join(f"{count} {kind}" for kind, count in zip(kinds, counts, strict=True))
        message = f"{counts.sum()} of {total} runs ended early: {ends}; explain(index) says where"
        warnings.warn(message, AssurWarning, stacklevel=5)
    if not is_mechanism:
        return
    worst, size, potential = balance
    # NaN where there is no run.
    off = np.flatnonzero(worst > np.maximum(_allowed(inputs) * size, ROUNDING * potential))
    if off.size:
        parts = worst[off] / np.where(size[off] > 0.0, size[off], 1.0)
        text = _imbalance_text(f"of {off.size} of {total} runs ", float(parts.max()))
        warnings.warn(text, AssurWarning, stacklevel=5)


def _allowed(inputs: Inputs) -> float:
    """Return the imbalance above which to warn, relative to the greatest energy."""
    return max(IMBALANCE_WARN_FLOOR, IMBALANCE_WARN_RTOLS * inputs.tolerances[0])


def _imbalance_text(of_runs: str, part: float) -> str:
    return (
        f"the balance of energy {of_runs}is off by {part:.1e} of the greatest energy: "
        "beside singular positions, or where a function jumps (breaks=), the motion is no more "
        "accurate"
    )


def steady_state(
    machine: MachineModel,
    speed: Any,
    turns: Any,
    q0: Any,
    fluctuation: float | None,
    **options: Any,
) -> SteadyState:
    """See `Machine.steady_state`; with a `fluctuation`, size a flywheel for it."""
    one_design(machine, "steady_state")
    without_friction(machine, "steady_state")
    require_rotary_driver(machine, "a periodic motion")
    one_of(options["mean"], flywheels.MEANS, "mean")
    guess = None if speed is None else real_number(speed, "speed")
    if guess == 0.0:
        message = "speed is 0: a periodic motion needs a speed"
        raise InputError(message, value=0.0)
    ratio = 1.0 if machine.motor is None else float(getattr(machine.motor, "ratio", 1.0))
    span = math.copysign(2.0 * math.pi * turn_count(turns), ratio if guess is None else guess)
    for q, periodic in machine.core.tables:
        require_whole_periods(q[-1] - q[0] if periodic else None, abs(span))
    flywheel = real_number(options["flywheel"], "flywheel")
    if flywheel < 0.0:
        message = f"flywheel = {flywheel:g} kg·m²: it must be 0 or more"
        raise InputError(message, value=flywheel)
    if relative_tolerance(options["rtol"]) > LOOSEST_RTOL:
        message = f"rtol is {options['rtol']!r}: it must be at most {LOOSEST_RTOL}"
        raise InputError(message)
    start = _start(machine, q0, "q0")[0]
    # The core does not know which load has a table that does not cover the period.
    places = start + np.linspace(0.0, span, PLACES)
    with _naming_tables(machine, places, [0.0 if guess is None else guess]):
        core, numbers = machine.core.steady(
            _dimensions(machine),
            start,
            span,
            guess,
            options["mean"],
            options["method"],
            relative_tolerance(options["rtol"]),
            (step_count(options["max_steps"]), checked_seconds(options["max_seconds"])),
            checked_breaks(options["breaks"]),
            flywheel,
            fluctuation,
        )
    made = SteadyState(core, numbers, machine.mechanism, options["mean"])
    if machine.motor is not None and abs(made.found_moment) > BALANCE_WARN_RTOL * abs(
        made.motor_moment
    ):
        message = (
            f"nothing depends on the speed: {made.found_moment:.3g} N·m more than the motor gives "
            "keep the machine in balance"
        )
        warnings.warn(message, AssurWarning, stacklevel=3)
    return made


@contextmanager
def _naming_tables(machine: MachineModel, places: Float, speeds: list[float]) -> Iterator[None]:
    """Name the load or the driver whose table does not cover these, where the core refuses one."""
    try:
        yield
    except InputError as error:
        if error.kind != "table_ends" or machine.mechanism is None:
            raise
        driver = _driver_beyond(machine, float(places[0]), speeds, error.value)
        if driver is not None:
            raise _of_driver(driver, error) from None
        if machine.driver_count > 1:
            raise
        named = not_covered(machine, places)
        if named is None:
            raise
        raise named from None


def _driver_beyond(
    machine: MachineModel, q: float, speeds: list[float], value: float | None
) -> str | None:
    """Return the driver whose motor's table over its speed does not cover this value.

    The core looks up the tables over q first: where one ends, no motor is to blame.
    """
    if not all(periodic or rows[0] <= q <= rows[-1] for rows, periodic in machine.core.tables):
        return None
    assert machine.mechanism is not None
    drivers = machine.mechanism.description.drivers
    motors = components.motors(machine.motor, len(drivers))
    for driver, motor, speed in zip(drivers, motors, speeds, strict=True):
        if not isinstance(motor, Table) or speed * motor.ratio != value:
            continue
        if not motor.q[0] <= value <= motor.q[-1]:
            return driver if isinstance(driver, str) else driver.link
    return None


def _of_driver(driver: str, error: InputError) -> InputError:
    """Return the error of a motor's table with the name of the driver."""
    message = f"driver {driver!r}: {error}"
    return InputError(
        message, kind=error.kind, hint=error.hint, driver=driver, q=error.q, value=error.value
    )


def _dimensions(machine: MachineModel) -> list[float]:
    dimensions: list[float] = [] if machine.mechanism is None else machine.mechanism.values.tolist()
    return dimensions


def _start(machine: MachineModel, value: npt.ArrayLike | None, name: str) -> list[float]:
    n = machine.driver_count
    array = _states(machine, value, name)
    if array.shape not in ((), (n,)):
        message = f"{name} has the shape {array.shape}: {n} numbers are needed"
        raise InputError(message)
    numbers: list[float] = np.broadcast_to(array, (n,)).tolist()
    return numbers


def _states(machine: MachineModel, value: npt.ArrayLike | None, name: str) -> Float:
    """Return initial coordinates or speeds: with n drivers a number, or a last axis of n."""
    if value is None and name == "q0":
        value = machine.core.tables[0][0][0] if machine.mechanism is None else machine.mechanism.q0
    array = finite_array(value, name)
    n = machine.driver_count
    if n > 1 and array.ndim and array.shape[-1] != n:
        message = f"{name} has the shape {array.shape}: its last axis must be {n}, one per driver"
        raise InputError(message)
    if name == "q0" and machine.mechanism is not None:
        warn_if_degrees(machine.mechanism, array)
    return array
