"""What `Machine` does in time: arguments checked, the core called."""

from __future__ import annotations

import itertools
import math
import operator
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

from assur import events as known_events
from assur import flywheel as flywheels
from assur._checks import real_array
from assur.errors import AssurWarning, InputError, PositionError
from assur.loads import Table
from assur.motors import ConstantTorque
from assur.run import Run
from assur.steady import SteadyState

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur.flywheel import Flywheel
    from assur.loads import Function
    from assur.machine import Machine

METHODS = ("DOP853", "RK45")
# Errors below cannot be told from rounding (`assur::ode`).
LEAST_RTOL = 2.3e-15
# A period that is less accurate tells no speed.
LOOSEST = 1e-4
# Ends of a run that nobody asked for.
CUT_SHORT = ("lost", "table ends", "motor table ends", "stalled", "step limit", "time limit")
# Part of a period by which a table's may differ from it: tables end with typed numbers.
FITS = 1e-9
# Part by which a constant motor may differ from what the loads take: torques are typed too.
GIVEN = 1e-2
# Knots of loads in a turn, at most.
MOST_KNOTS = 100_000
# Part by which inertia and moment may differ a turn on.
SAME = 1e-7
# Part of the motor's moment from which on it is told that it was mended.
MENDED = 1e-6
# Rows of the first table of `flywheel`, and of the last; each has twice those before.
FIRST_ROWS, LAST_ROWS = 96, 12288
# The fewest rows between two knots of a load's table.
LEAST_ROWS = 6
# Change of the flywheel between two tables after which it is known.
SETTLED = 1e-9


def run(
    machine: Machine, t_end: Any, q0: Any, speed0: Any, q_end: Any, t0: Any, **options: Any
) -> Run:
    """See `Machine.run`."""
    one_design(machine, "run")
    along_q = q_end is not None
    if along_q == (t_end is not None):
        message = "one of t_end and q_end is needed, not both"
        raise InputError(message)
    functions: list[Function] = []
    watched = listed(options["events"], "events")
    n = machine._drivers
    watches = [known_events.parts(one, machine.mechanism, n, functions) for one in watched]
    start, speeds = _start(machine, q0, "q0"), _start(machine, speed0, "speed0")
    if along_q and n > 1:
        message = f"q_end: there are {n} drivers, a run over q is of one"
        raise InputError(message)
    if along_q and speeds[0] == 0.0:
        message = "q_end: a run over q begins with a motion, speed0 is 0"
        raise InputError(message, value=0.0)
    end = _number(q_end if along_q else t_end, "q_end" if along_q else "t_end")
    if along_q and (end - start[0]) * speeds[0] < 0.0:
        message = f"q_end = {end:g} lies behind q0 = {start[0]:g} at speed0 = {speeds[0]:g}"
        raise InputError(message, value=end)
    try:
        core = machine._core.run(
            _dimensions(machine),
            along_q,
            (_number(t0, "t0"), start, speeds),
            end,
            _is_low(options["method"]),
            (_relative(options["rtol"]), _pair(options["atol"])),
            (
                _positive(options["max_step"], "max_step"),
                _count(options["max_steps"]),
                _seconds(options["max_seconds"]),
            ),
            _breaks(options["breaks"]),
            watches,
            (machine._outside.functions, functions),
        )
    except PositionError as error:
        q = start[0] if n == 1 else np.array(start)
        why = (
            ""
            if machine.mechanism is None
            else machine.mechanism.solve(q, order=1, on_error="nan").explain()
        )
        if " is solved" in why:
            why = f"{why}, but a dead point is beside it"
        message = f"{why or error}: a run cannot begin there (q0)"
        raise PositionError(message, q=start[0] if n == 1 else tuple(start)) from error
    made = Run(core, machine.mechanism, n, watched, along_q)
    if made.end in CUT_SHORT:
        warnings.warn(f"the run ended early: {made.message}", AssurWarning, stacklevel=3)
    return made


def steady_state(
    machine: Machine, speed: Any, turns: Any, q0: Any, wanted: float | None, **options: Any
) -> SteadyState:
    """See `Machine.steady_state`; `wanted`: the fluctuation that a flywheel gives."""
    one_design(machine, "steady_state")
    turning(machine, "a periodic motion")
    mean = flywheels._one_of(options["mean"], flywheels.MEANS, "mean")
    guess = None if speed is None else _number(speed, "speed")
    if guess == 0.0:
        message = "speed is 0: a periodic motion has none at rest"
        raise InputError(message, value=0.0)
    ratio = 1.0 if machine.motor is None else float(getattr(machine.motor, "ratio", 1.0))
    span = math.copysign(2.0 * math.pi * _whole(turns), ratio if guess is None else guess)
    for q, _, _, periodic in machine._outside.tables:
        _fits(q[-1] - q[0] if periodic else None, abs(span))
    flywheel = _number(options["flywheel"], "flywheel")
    if flywheel < 0.0:
        message = f"flywheel = {flywheel:g} kg·m²: it must be 0 or more"
        raise InputError(message, value=flywheel)
    if _relative(options["rtol"]) > LOOSEST:
        message = f"rtol is {options['rtol']!r}: a period is found with {LOOSEST} or less"
        raise InputError(message)
    core, numbers = machine._core.steady(
        _dimensions(machine),
        [_start(machine, q0, "q0")[0], span],
        guess,
        _is_low(options["method"]),
        _relative(options["rtol"]),
        (_count(options["max_steps"]), _seconds(options["max_seconds"])),
        _breaks(options["breaks"]),
        flywheel,
        None if wanted is None else (wanted, mean),
        machine._outside.functions,
    )
    made = SteadyState(core, numbers, machine.mechanism, options["mean"])
    if machine.motor is not None and abs(made.found_moment) > MENDED * abs(made.motor_moment):
        message = (
            f"nothing depends on the speed: {made.found_moment:.3g} N·m more than the motor gives "
            "keep the machine in balance"
        )
        warnings.warn(message, AssurWarning, stacklevel=3)
    return made


def flywheel(
    machine: Machine, fluctuation: Any, mean_speed: Any, mean: Any, on_error: str
) -> Flywheel | SteadyState:
    """See `Machine.flywheel`."""
    turning(machine, "a flywheel")
    flywheels._one_of(on_error, ("raise", "nan"), "on_error")
    torque: Any = 0.0 if machine.motor is None else getattr(machine.motor, "torque", None)
    constant = torque is not None and not callable(torque) and not isinstance(torque, Table)
    if mean_speed is None:
        if machine.motor is None:
            message = "without a motor that tells the speed mean_speed is needed"
            raise InputError(message)
        wanted = _number(fluctuation, "fluctuation")
        if not 0.0 < wanted < 2.0:
            message = f"fluctuation = {wanted:g}: it must be more than 0 and less than 2"
            raise InputError(message, value=wanted)
        return machine.steady_state(mean=mean, _wanted=wanted)
    if not constant:
        message = (
            f"{machine.motor!r} is no constant motor, its own torque counts: leave mean_speed out, "
            "or build the machine without a motor"
        )
        raise InputError(message)
    made = _from_rows(machine, fluctuation, mean_speed, mean, on_error)
    if isinstance(machine.motor, ConstantTorque):
        own = float(machine.motor.ratio) * float(torque)
        off = np.abs(np.asarray(made.motor_moment) - own) > GIVEN * abs(own)
        if off.any():
            needed = np.asarray(made.motor_moment).ravel()[int(np.argmax(off))]
            message = (
                f"the motor gives the driver {own:g} N·m, the loads take {needed:g} on average: "
                "the flywheel is that of the latter"
            )
            warnings.warn(message, AssurWarning, stacklevel=3)
    return made


def _from_rows(
    machine: Machine, fluctuation: Any, mean_speed: Any, mean: Any, on_error: str
) -> Flywheel:
    """The flywheel from tables of moment and inertia, dense enough."""
    knots = _knots(machine)
    speed = real_array(mean_speed, "mean_speed")
    if speed.ndim and speed.shape != machine.shape:
        message = (
            f"mean_speed has the shape {speed.shape}, the designs {machine.shape}: a number, or "
            "one for each design"
        )
        raise InputError(message)
    if not np.isfinite(speed).all():
        message = f"mean_speed is {mean_speed!r}: finite numbers are needed"
        raise InputError(message)
    last: Flywheel | None = None
    rows = FIRST_ROWS
    while True:
        phi, corners = _rows(knots, rows)
        own_speed = speed[..., np.newaxis] if speed.ndim else speed
        inertia, _, moment, _ = machine._reduce(phi, own_speed, on_error)
        if last is None:
            _same_a_turn_on(machine, phi, own_speed, on_error, inertia, moment)
        own = flywheels._flywheel(
            phi,
            moment[..., 0],
            inertia[..., 0, 0],
            "not-a-knot",
            f"sized {flywheels._one_of(mean, flywheels.MEANS, 'mean')}",
            ((fluctuation, "fluctuation"), (speed, "mean_speed")),
            mean,
            on_error,
            None,
            corners,
        )
        if last is not None:
            size = np.asarray(own.inertia) + inertia[..., 0, 0].max(axis=-1)
            change = np.abs(np.asarray(own.inertia) - np.asarray(last.inertia)) / size
            if not (change > SETTLED).any():
                return own
        if rows == LAST_ROWS:
            message = (
                f"tables of {rows} rows still change the flywheel by {float(np.nanmax(change)):.1e}"
                ": a function among the loads is not smooth (a Table is cut at its knots)"
            )
            warnings.warn(message, AssurWarning, stacklevel=4)
            return own
        last, rows = own, 2 * rows


def _same_a_turn_on(
    machine: Machine, phi: Any, speed: Any, on_error: str, inertia: Any, moment: Any
) -> None:
    """Refuse a motion or a load that is another one after a turn."""
    later, _, other, _ = machine._reduce(phi + 2.0 * math.pi, speed, on_error)
    for name, one, two in (("inertia", inertia, later), ("moment", moment, other)):
        size = np.nanmax(np.abs(one), initial=0.0)
        off = np.abs(two - one)
        if (off > SAME * size).any():
            message = (
                f"the reduced {name} is another one after a turn (by {np.nanmax(off):.3g}): there "
                "is no flywheel of one turn"
            )
            raise InputError(message)


def _knots(machine: Machine) -> list[float]:
    """Where loads are not smooth within a turn, its ends included."""
    turn = 2.0 * math.pi
    found = {0.0, turn}
    for rows, _, _, periodic in machine._outside.tables:
        first, period = rows[0], rows[-1] - rows[0]
        _fits(period if periodic else None, turn)
        steps = range(math.floor(-first / period) - 1, math.ceil((turn - first) / period) + 1)
        for shift in steps:
            found |= {q + shift * period for q in rows}
            if len(found) > MOST_KNOTS:
                message = f"a table's period of {period:g} rad has too many knots in a turn"
                raise InputError(message, value=period)
    knots = sorted(q for q in found if 0.0 <= q <= turn)
    # What is nearer is rounding.
    kept = [q for q, before in zip(knots, [-1.0, *knots], strict=False) if q - before > FITS]
    return [*(q for q in kept if q < turn - FITS), turn]


def _rows(knots: list[float], rows: int) -> tuple[Any, list[int]]:
    """Coordinates with rows at all knots, and which these are."""
    parts, corners = [], [0]
    for low, high in itertools.pairwise(knots):
        count = max(LEAST_ROWS, math.ceil(rows * (high - low) / (2.0 * math.pi)))
        parts.append(np.linspace(low, high, count, endpoint=False))
        corners.append(corners[-1] + count)
    return np.append(np.concatenate(parts), knots[-1]), corners


def one_design(machine: Machine, what: str) -> None:
    """Refuse a batch."""
    if machine.shape:
        message = f"{what} is for one design, this is a batch {machine.shape}: design(i)"
        raise InputError(message)


def turning(machine: Machine, what: str) -> None:
    """Refuse what does not turn."""
    driver = None if machine.mechanism is None else machine.mechanism.driver
    slides = {} if machine.mechanism is None else machine.mechanism.slides
    if machine._drivers > 1 or (isinstance(driver, str) and driver in slides):
        message = f"driver {driver!r}: {what} is of one driver that turns"
        raise InputError(message)


def _fits(period: float | None, span: float) -> None:
    """Refuse a table that is another one a period on."""
    if period is None:
        message = "a table that is not periodic is among the loads: there is no periodic motion"
        raise InputError(message)
    ratio = span / period
    if abs(ratio - round(ratio)) > FITS * ratio or round(ratio) < 1:
        message = (
            f"a table's period of {period:g} rad does not fit {span:g} rad a whole number of times"
        )
        raise InputError(message, value=period)


def _dimensions(machine: Machine) -> list[float]:
    dimensions: list[float] = (
        [] if machine.mechanism is None else machine.mechanism._values.tolist()
    )
    return dimensions


def listed(value: Any, name: str) -> list[Any]:
    """A sequence as a list, or an error that names it."""
    if isinstance(value, str | bytes) or not hasattr(value, "__iter__"):
        message = f"{name} is {value!r}: a sequence of them is needed"
        raise InputError(message)
    return list(value)


def _start(machine: Machine, value: npt.ArrayLike | None, name: str) -> list[float]:
    if value is None and name == "q0":
        value = (
            machine._outside.tables[0][0][0] if machine.mechanism is None else machine.mechanism.q0
        )
    array = real_array(value, name)
    n = machine._drivers
    if array.shape not in ((), (n,)):
        message = f"{name} has the shape {array.shape}: {n} numbers are needed"
        raise InputError(message)
    if not np.isfinite(array).all():
        message = f"{name} is {value!r}: finite numbers are needed"
        raise InputError(message)
    numbers: list[float] = np.broadcast_to(array, (n,)).tolist()
    return numbers


def _number(value: Any, name: str, finite: bool = True) -> float:
    array = real_array(value, name)
    if array.ndim or np.isnan(array) or (finite and not np.isfinite(array)):
        message = f"{name} is {value!r}: a finite number is needed"
        raise InputError(message)
    return float(array)


def _positive(value: Any, name: str) -> float:
    number = _number(value, name, finite=False)
    if not number > 0.0:
        message = f"{name} is {value!r}: it must be positive"
        raise InputError(message, value=number)
    return number


def _relative(rtol: Any) -> float:
    number = _number(rtol, "rtol")
    if not LEAST_RTOL <= number < 1.0:
        message = f"rtol is {rtol!r}: it must be from {LEAST_RTOL} to below 1"
        raise InputError(message, value=number)
    return number


def _is_low(method: Any) -> bool:
    if not isinstance(method, str) or method not in METHODS:
        message = f"method is {method!r}: one of {', '.join(map(repr, METHODS))}"
        raise InputError(message)
    return bool(method == "RK45")


def _pair(atol: Any) -> list[float] | None:
    if atol is None:
        return None
    array = real_array(atol, "atol")
    if array.shape not in ((), (2,)):
        message = f"atol is {atol!r}: a number, or one for the coordinate and one for the speed"
        raise InputError(message)
    if not (np.isfinite(array).all() and (array > 0.0).all()):
        message = f"atol is {atol!r}: positive and finite numbers are needed"
        raise InputError(message)
    pair: list[float] = np.broadcast_to(array, (2,)).tolist()
    return pair


def _breaks(breaks: Any) -> list[float]:
    array = real_array(() if breaks is None else breaks, "breaks")
    if not np.isfinite(array).all():
        message = f"breaks is {breaks!r}: finite numbers are needed"
        raise InputError(message)
    ordered: list[float] = sorted(array.ravel().tolist())
    return ordered


def _whole(turns: Any) -> int:
    try:
        number = operator.index(turns)
    except TypeError:
        number = 0
    if not 1 <= number <= 1024:
        message = f"turns is {turns!r}: a whole number from 1 to 1024 is needed"
        raise InputError(message)
    return number


def _count(steps: Any) -> int:
    try:
        number = operator.index(steps)
    except TypeError:
        number = 0
    if not 1 <= number < 2**63:
        message = f"max_steps is {steps!r}: a whole number above 0 is needed"
        raise InputError(message)
    return number


def _seconds(seconds: Any) -> float | None:
    if seconds is None:
        return None
    number = _number(seconds, "max_seconds")
    if number < 0.0:
        message = f"max_seconds is {seconds!r}: 0 or more is needed"
        raise InputError(message, value=number)
    return min(number, 1e9)
