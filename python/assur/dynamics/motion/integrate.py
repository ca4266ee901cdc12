"""The implementation of `Machine.run` and `Machine.steady_state`: checks, then the core."""

from __future__ import annotations

import math
import warnings
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import numpy as np

from assur import events as known_events
from assur import flywheel as flywheels
from assur._arrays import finite_array, real_number
from assur._validate import one_of
from assur.dynamics import components
from assur.dynamics.components import as_list
from assur.dynamics.loads.table import Table
from assur.dynamics.motion.run import Run
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
from assur.errors import AssurWarning, InputError
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
# Warn when the balancing moment exceeds this fraction of the motor's.
BALANCE_WARN_RTOL = 1e-6


def run(
    machine: MachineModel, t_end: Any, q0: Any, speed0: Any, q_end: Any, t0: Any, **options: Any
) -> Run:
    """See `Machine.run`."""
    one_design(machine, "run")
    if machine.driver_count > 1:
        without_friction(machine, "run with several drivers")
        without_followers(machine, "run with several drivers")
    along_q = q_end is not None
    if along_q == (t_end is not None):
        message = "run needs t_end or q_end" + (", not both" if along_q else "")
        raise InputError(message)
    watched = as_list(options["events"], "events")
    n = machine.driver_count
    checked = [known_events.checked(event, machine.mechanism, n) for event in watched]
    if along_q and any(isinstance(event, known_events.Obstacle) for event in watched):
        message = "q_end: over q a motion does not turn back at an Obstacle; give t_end"
        raise InputError(message)
    start, speeds = _start(machine, q0, "q0"), _start(machine, speed0, "speed0")
    if along_q and n > 1:
        message = f"q_end: a run over q needs a single driver, this mechanism has {n}"
        raise InputError(message)
    if along_q and speeds[0] == 0.0:
        message = "q_end: a run over q needs an initial speed, speed0 is 0"
        raise InputError(message, value=0.0)
    end = real_number(q_end if along_q else t_end, "q_end" if along_q else "t_end")
    if along_q and (end - start[0]) * speeds[0] < 0.0:
        message = f"q_end = {end:g} lies behind q0 = {start[0]:g} at speed0 = {speeds[0]:g}"
        raise InputError(message, value=end)
    with _naming_tables(machine, np.array(start), speeds):
        core = machine.core.run(
            _dimensions(machine),
            along_q,
            (real_number(t0, "t0"), start, speeds),
            end,
            options["method"],
            (relative_tolerance(options["rtol"]), tolerance_pair(options["atol"])),
            (
                positive_number(options["max_step"], "max_step"),
                step_count(options["max_steps"]),
                checked_seconds(options["max_seconds"]),
            ),
            checked_breaks(options["breaks"]),
            checked,
        )
    # The core numbers friction's events after those that were asked for.
    made = Run(core, machine.mechanism, n, [*watched, STICK, SLIP], along_q, table_names(machine))
    if made.end in EARLY_ENDS:
        warnings.warn(f"the run ended early: {made.message}", AssurWarning, stacklevel=3)
    # A machine from a table has no singular positions.
    allowed = max(IMBALANCE_WARN_FLOOR, IMBALANCE_WARN_RTOLS * float(options["rtol"]))
    if machine.mechanism is not None and made.energy._is_off(allowed):
        message = (
            f"the balance of energy is off by {made.energy.error:.1e} of the greatest energy: "
            "beside singular positions, or where a function jumps (breaks=), the motion is no more "
            "accurate"
        )
        warnings.warn(message, AssurWarning, stacklevel=3)
    return made


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
    if value is None and name == "q0":
        value = machine.core.tables[0][0][0] if machine.mechanism is None else machine.mechanism.q0
    array = finite_array(value, name)
    n = machine.driver_count
    if array.shape not in ((), (n,)):
        message = f"{name} has the shape {array.shape}: {n} numbers are needed"
        raise InputError(message)
    if name == "q0" and machine.mechanism is not None:
        warn_if_degrees(machine.mechanism, array)
    numbers: list[float] = array.tolist() if array.ndim else [float(array)] * n
    return numbers
