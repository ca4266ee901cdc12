"""Which load has no finite value at a position, and why."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from assur.dynamics.loads.load_values import function_values
from assur.dynamics.loads.loads import BetweenPoints, Force, Gravity, Pressure, named_values
from assur.dynamics.loads.motors import ConstantTorque
from assur.dynamics.loads.pressure import Gas
from assur.dynamics.loads.table import Table
from assur.dynamics.reduction.reduced import answer
from assur.errors import InputError, MotionError, with_subject

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from assur._arrays import Float
    from assur.dynamics.loads.loads import Load, PointLike
    from assur.dynamics.model import MachineModel
    from assur.errors import AssurError
    from assur.kinematics.mechanism import Mechanism

EXTEND = "extend the table"
START_WITHIN = "extend the table, or start within it"


class Moment(NamedTuple):
    """A coordinate of the drivers (n,), their speeds (n,), and a time."""

    q: Float
    speed: Float
    t: float
    sense: float | Sequence[float] | None = None

    @property
    def at(self) -> float | tuple[float, ...]:
        """The coordinate, for the fields of errors."""
        return float(self.q[0]) if self.q.size == 1 else tuple(self.q.tolist())

    @property
    def shown(self) -> str:
        """The coordinate, for messages."""
        numbers = ", ".join(f"{x:.15g}" for x in self.q.tolist())
        return numbers if self.q.size == 1 else f"({numbers})"


def without_value(machine: MachineModel, moment: Moment, what: str) -> AssurError:
    """Return the error of one design for which the quantity asked for is not finite."""
    mechanism = machine.mechanism
    assert mechanism is not None
    for name, load in named_loads(machine):
        bodies = machine.bodies if isinstance(load, Gravity) else {}
        alone = type(machine)(mechanism, bodies=bodies, loads=[load])
        if not _is_finite(alone, moment):
            return with_subject(_of_load(mechanism, name, load, moment), name)
    for link, body in machine.bodies.items():
        if not _is_finite(type(machine)(mechanism, bodies={link: body}), moment):
            body_name = f"bodies[{link!r}]"
            return with_subject(_too_great(f"{body_name}: its inertia", moment), body_name)
    for name, value in _motor_values(machine):
        error = _of_value(mechanism, name, value, moment)
        if error is not None:
            return with_subject(error, name)
    message = (
        f"{what} not finite at q = {moment.shown}: every load by itself has a value, a speed, an "
        "acceleration or a mass is too great there (on_error='nan' keeps the other positions)"
    )
    return MotionError(message, kind="not_finite", q=moment.at)


def named_loads(machine: MachineModel) -> Iterator[tuple[str, Load]]:
    """Yield the loads with their names in messages."""
    for index, load in enumerate(machine.loads):
        yield f"loads[{index}], {_described(load)}", load


def table_names(machine: MachineModel) -> tuple[str, ...]:
    """Return names of the tables in the order of the core: those over q, then those over others."""
    over_q, over_others = list[str](), list[str]()
    for name, value in _every_value(machine):
        if isinstance(value, Gas):
            over_others.append(name)
        elif isinstance(value, Table):
            text = f"{name}: a table over {'q' if value.over is None else repr(value.over)}"
            (over_q if value.over is None else over_others).append(text)
    return (*(over_q or ["a table over q"] * len(machine.core.tables)), *over_others)


def not_covered(machine: MachineModel, places: Float) -> AssurError | None:
    """Return the error of the first of the coordinates (P,) that a load's table does not cover."""
    mechanism = machine.mechanism
    assert mechanism is not None
    uncovered: list[tuple[int, str, Table, float]] = []
    for name, value in _every_value(machine):
        if not isinstance(value, Table):
            continue
        at = places
        if value.over is not None:
            motion = mechanism.solve(places, order=0, outputs=[value.over], on_error="nan")
            of = motion.slide if value.over in mechanism.slides else motion.link
            at = of(value.over).value
        outside = np.flatnonzero(~np.isfinite(value.at(at)) & np.isfinite(at))
        if outside.size:
            uncovered.append((int(outside[0]), name, value, float(at[outside[0]])))
    if not uncovered:
        return None
    row, name, table, value_there = min(uncovered, key=lambda entry: entry[0])
    moment = Moment(places[row : row + 1], np.zeros(1), 0.0)
    return table_ends(name, table, value_there, moment, START_WITHIN)


def _described(load: Load) -> str:
    kind = type(load).__name__
    if isinstance(load, Force):
        return f"the {kind} at {_point(load.at)}"
    if isinstance(load, Pressure):
        return f"the {kind} in {load.slide!r}"
    if isinstance(load, BetweenPoints):
        return f"the {kind} from {_point(load.first)} to {_point(load.second)}"
    return "Gravity" if isinstance(load, Gravity) else f"the {kind} on {load.link!r}"


def _point(point: PointLike) -> str:
    return repr(point) if isinstance(point, str) else f"a point of {point[0]!r}"


def _every_value(machine: MachineModel) -> Iterator[tuple[str, Any]]:
    """Yield what loads and motors read, with the names of the loads."""
    for name, load in named_loads(machine):
        yield from ((name, value) for value in named_values(load).values())
    yield from _motor_values(machine)


def _motor_values(machine: MachineModel) -> Iterator[tuple[str, Any]]:
    motors = machine.motor if isinstance(machine.motor, tuple) else (machine.motor,)
    for motor in motors:
        if isinstance(motor, ConstantTorque):
            yield "the motor", motor.torque


def _is_finite(machine: MachineModel, moment: Moment) -> bool:
    """Whether inertia and moment have values."""
    q, speed = (x if x.size > 1 else x[0] for x in (moment.q, moment.speed))
    reduced = answer(machine, q, speed, moment.t, moment.sense)
    numbers = reduced.inertia, reduced.rates, reduced.moment
    return all(bool(np.isfinite(array).all()) for array in numbers)


def _of_load(mechanism: Mechanism, name: str, load: Load, moment: Moment) -> AssurError:
    """Return the error of a load without a value."""
    if isinstance(load, Pressure) and isinstance(load.pressure, Gas):
        at = _coordinate(mechanism, load.slide, moment)
        message = f"{name}: its gas has no volume at {load.slide} = {at:.9g} m, q = {moment.shown}"
        return MotionError(message, kind="not_finite", q=moment.at, value=at)
    for value in named_values(load).values():
        error = _of_value(mechanism, name, value, moment)
        if error is not None:
            return error
    if isinstance(load, BetweenPoints):
        what = "has length zero, and so no direction, or is too great"
        message = f"{name} {what} at q = {moment.shown}"
        return MotionError(message, kind="not_finite", q=moment.at)
    return _too_great(name, moment)


def _too_great(name: str, moment: Moment) -> AssurError:
    message = f"{name} is too great at q = {moment.shown}: it is beyond what numbers can hold"
    return MotionError(message, kind="not_finite", q=moment.at)


def _of_value(mechanism: Mechanism, name: str, value: Any, moment: Moment) -> AssurError | None:
    """Return the error of a table that ends before the position, or of a function there."""
    if isinstance(value, Table):
        at = float(moment.q[0])
        if value.over is not None:
            at = _coordinate(mechanism, value.over, moment)
        return None if np.isfinite(value.at(at)) else table_ends(name, value, at, moment)
    if not callable(value):
        return None
    gave = function_values([value], moment.q[None], moment.speed[None], np.array([moment.t]))
    if np.isfinite(gave).all():
        return None
    message = f"{name}: at q = {moment.shown} its function gave {gave[0]}, it must be finite"
    return InputError(message, kind="not_finite", q=moment.at, value=float(gave[0]))


def table_ends(
    name: str, table: Table, at: float, moment: Moment, hint: str = EXTEND
) -> AssurError:
    """Return the error of a table that does not reach a position."""
    first, last = float(table.q[0]), float(table.q[-1])
    over, place = "q", ""
    if table.over is not None:
        over, place = repr(table.over), f", at q = {moment.shown},"
    message = (
        f"{name}: a table over {over} covers {first:.9g} to {last:.9g}: {at:.9g}{place} is not "
        f"in it; {hint}"
    )
    return InputError(message, kind="table_ends", hint=hint, q=moment.at, value=at)


def _coordinate(mechanism: Mechanism, name: str, moment: Moment) -> float:
    """Return the value of a slide, or the angle of a link."""
    q = moment.q if moment.q.size > 1 else moment.q[0]
    motion = mechanism.solve(q, order=0, outputs=[name], on_error="nan")
    return float((motion.slide if name in mechanism.slides else motion.link)(name).value)
