"""Events that a run detects, and whether they end it."""

from __future__ import annotations

import math
from dataclasses import KW_ONLY, dataclass
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from assur._arrays import counted, flag, real_number, short
from assur._summary import typed
from assur._validate import one_of
from assur.errors import InputError
from assur.kinematics import transmission

if TYPE_CHECKING:
    from assur._arrays import Function
    from assur.kinematics.mechanism import Mechanism

__all__ = ["Crossing", "Obstacle", "Position", "Rest", "Speed", "TransmissionAngle"]

Direction: TypeAlias = Literal["either", "rising", "falling"]
DIRECTIONS = ("either", "rising", "falling")


@dataclass(frozen=True)
class Rest:
    """A driver comes to rest.

    Parameters
    ----------
    stop : bool
        Whether the run ends there.
    driver : int
        Which driver, if there are several.

    Examples
    --------
    >>> import assur
    >>> assur.events.Rest()
    Rest(stop=True, driver=0)
    """

    _: KW_ONLY
    stop: bool = True
    driver: int = 0


@dataclass(frozen=True)
class Position:
    """A driver's coordinate reaches a value.

    Parameters
    ----------
    q : float
        rad or m; angles count turns.
    stop, driver
        See `Rest`.
    direction : {"either", "rising", "falling"}
        Direction of the crossing.

    Examples
    --------
    >>> import assur
    >>> machine = assur.Machine(
    ...     assur.SliderCrank(0.1, 0.4), bodies={"crank": assur.Body(inertia=0.5)}
    ... )
    >>> run = machine.run(t_end=9.0, q0=0.0, speed0=2.0, events=[assur.events.Position(3.0)])
    >>> round(run.events[0].t, 6)  # s
    1.5
    """

    q: float
    _: KW_ONLY
    stop: bool = True
    driver: int = 0
    direction: Direction = "either"


@dataclass(frozen=True)
class Speed:
    """A driver's speed reaches a value, rad/s or m/s; other parameters as for `Position`.

    Parameters
    ----------
    speed : float
        rad/s or m/s.
    stop, driver
        See `Rest`.
    direction : {"either", "rising", "falling"}
        Direction of the crossing.

    Examples
    --------
    >>> import assur
    >>> machine = assur.Machine(
    ...     assur.SliderCrank(0.1, 0.4),
    ...     bodies={"crank": assur.Body(inertia=0.5)},
    ...     loads=[assur.Torque("crank", 2.0)],
    ... )
    >>> run = machine.run(t_end=9.0, q0=0.0, events=[assur.events.Speed(10.0)])
    >>> round(run.events[0].t, 6)  # s: 4 rad/s² from rest
    2.5
    """

    speed: float
    _: KW_ONLY
    stop: bool = True
    driver: int = 0
    direction: Direction = "either"


@dataclass(frozen=True)
class TransmissionAngle:
    """A transmission angle reaches a limit.

    Parameters
    ----------
    name : str
        A joint or slide (`Motion.transmission_angle`).
    limit : float
        rad.
    between : (str, str), optional
        Joints on the two lines (`Motion.transmission_angle`).
    stop : bool
        Whether the run ends there.
    direction : {"falling", "rising", "either"}
        Direction of the crossing.

    Examples
    --------
    >>> import assur
    >>> linkage = assur.FourBar(1.0, 4.5, 1.5, 4.8)
    >>> machine = assur.Machine(linkage, bodies={"crank": assur.Body(inertia=0.5)})
    >>> event = assur.events.TransmissionAngle("C", limit=0.7)
    >>> run = machine.run(t_end=9.0, q0=1.0, speed0=1.0, events=[event])
    >>> linkage.solve(run.q[-1]).transmission_angle("C").round(6)  # rad
    np.float64(0.7)
    """

    name: str
    limit: float
    _: KW_ONLY
    between: tuple[str, str] | None = None
    stop: bool = True
    direction: Direction = "falling"


@dataclass(frozen=True)
class Crossing:
    """A function of (t, q, speed) crosses zero.

    Parameters
    ----------
    function : callable
        Called with floats (with several drivers q and speed are tuples); smooth near its zeros. A
        run samples it about six times per step: if it changes faster, set `max_step`.
    stop : bool
        Whether the run ends there.
    direction : {"either", "rising", "falling"}
        Direction of the crossing.

    Examples
    --------
    Where the piston is 0.45 m from the crank's centre:

    >>> import assur
    >>> press = assur.SliderCrank(0.1, 0.4)
    >>> def height(t, q, speed):
    ...     return float(press.solve(q).slide("bore").value) - 0.45
    >>> machine = assur.Machine(press, bodies={"crank": assur.Body(inertia=0.5)})
    >>> event = assur.events.Crossing(height, stop=True)
    >>> run = machine.run(t_end=9.0, q0=0.0, speed0=1.0, events=[event])
    >>> press.solve(run.q[-1]).slide("bore").value.round(6)  # m
    np.float64(0.45)
    """

    __repr__ = typed

    function: Function
    _: KW_ONLY
    stop: bool = False
    direction: Direction = "either"


@dataclass(frozen=True)
class Obstacle:
    """A stop that throws the machine back: its speed is multiplied by −restitution.

    With one driver that is so wherever the obstacle is; `Machine.impact` gives the impulses there.

    Parameters
    ----------
    at : Position, TransmissionAngle or Crossing
        Where it is, and from which side the machine comes: `direction` "rising" or "falling". What
        this says of stopping does not count.
    restitution : float
        0 to 1. Where the machine stays at the obstacle the run ends: with 0 at once, else when it
        hits with less than a thousandth of the greatest speed, or would rebound by less than 1e4
        tolerances of the coordinate (1e-6 rad, or of the size).

    Examples
    --------
    A pendulum falls against a wall, and back:

    >>> import assur
    >>> pendulum = assur.Mechanism(
    ...     joints={"O": (0, 0), "A": (1, 0)},
    ...     links={"ground": ["O"], "rod": ["O", "A"]},
    ...     driver="rod",
    ... )
    >>> machine = assur.Machine(
    ...     pendulum, bodies={"rod": assur.Body(mass=1.0, at="A")}, loads=[assur.Gravity()]
    ... )
    >>> wall = assur.events.Obstacle(assur.events.Position(-1.5, direction="falling"), 0.5)
    >>> hit = machine.run(t_end=1.0, q0=0.0, events=[wall]).events[0]
    >>> round(hit.t, 6), round(hit.speed, 6)
    (0.575971, -4.423896)
    """

    at: Position | TransmissionAngle | Crossing
    restitution: float


Watched: TypeAlias = Rest | Position | Speed | TransmissionAngle | Crossing
Event: TypeAlias = Watched | Obstacle


@dataclass(frozen=True)
class AngleLimit:
    """A `TransmissionAngle` of a mechanism: the acute angle of two lines, or its complement."""

    lines: list[transmission.Line]
    complement: bool
    limit: float
    stop: bool
    direction: Direction


def checked(
    event: Any, mechanism: Mechanism | None, drivers: int
) -> Rest | Position | Speed | AngleLimit | Crossing | Obstacle:
    """Return the event with checked fields, which the core reads by name."""
    if isinstance(event, Obstacle):
        return _obstacle(event, mechanism, drivers)
    if not isinstance(event, Watched):
        message = (
            f"{short(event)} is not an event: Rest, Position, Speed, TransmissionAngle, Crossing "
            "or Obstacle of assur.events"
        )
        raise InputError(message)
    direction = "either" if isinstance(event, Rest) else _direction(event, event.direction)
    stop = flag(event.stop, f"{type(event).__name__} stop")
    if isinstance(event, Crossing):
        return Crossing(_function(event, event.function), stop=stop, direction=direction)
    if isinstance(event, TransmissionAngle):
        limit, lines, complement = _angle(event, event.name, mechanism)
        return AngleLimit(lines, complement, limit, stop, direction)
    driver = _driver(event, event.driver, drivers)
    if isinstance(event, Rest):
        return Rest(stop=stop, driver=driver)
    if isinstance(event, Position):
        return Position(
            real_number(event.q, "Position q"), stop=stop, driver=driver, direction=direction
        )
    return Speed(
        real_number(event.speed, "Speed speed"), stop=stop, driver=driver, direction=direction
    )


def _obstacle(event: Obstacle, mechanism: Mechanism | None, drivers: int) -> Obstacle:
    if drivers > 1:
        message = f"{event!r}: the machine has {drivers} drivers, an Obstacle is for one"
        raise InputError(message)
    at: Any = event.at
    if not isinstance(at, Position | TransmissionAngle | Crossing):
        message = f"Obstacle at: {short(at)} is not a Position, TransmissionAngle or Crossing"
        raise InputError(message)
    if at.direction == "either":
        message = f"{event!r}: direction= says from which side, 'rising' or 'falling'"
        raise InputError(message)
    restitution = real_number(event.restitution, "Obstacle restitution")
    if not 0.0 <= restitution <= 1.0:
        message = f"Obstacle restitution is {restitution:g}: from 0 (it stays) to 1 is needed"
        raise InputError(message, value=restitution)
    event_at: Any = checked(at, mechanism, drivers)
    return Obstacle(event_at, restitution)


def _direction(event: Any, direction: Any) -> Direction:
    known: Any = one_of(direction, DIRECTIONS, f"{type(event).__name__} direction")
    return known  # type: ignore[no-any-return]


def _function(event: Any, function: Any) -> Function:
    if not callable(function):
        message = f"{event!r}: a function of (t, q, speed) is needed"
        raise InputError(message)
    checked_function: Function = function
    return checked_function


def _driver(event: Any, driver: Any, drivers: int) -> int:
    if not isinstance(driver, int) or not 0 <= driver < drivers:
        message = f"{event!r}: the machine has {counted(drivers, 'driver')}, numbered from 0"
        raise InputError(message)
    return driver


def _angle(
    event: TransmissionAngle, name: Any, mechanism: Mechanism | None
) -> tuple[float, list[transmission.Line], bool]:
    if mechanism is None:
        message = f"{event!r}: this machine is a table and has no joints"
        raise InputError(message)
    if not isinstance(name, str):
        message = f"{event!r}: the name of a joint or slide is needed"
        raise InputError(message)
    limit = real_number(event.limit, "the limit of a TransmissionAngle")
    if not 0.0 < limit <= 0.5 * math.pi:
        message = f"{event!r}: a transmission angle is acute: more than 0 and up to π/2 rad"
        raise InputError(message, value=limit)
    try:
        lines, complement = transmission.lines(mechanism, name, event.between)
    except InputError as error:
        message = f"event TransmissionAngle of {short(name)}: {error}"
        raise InputError(
            message, kind=error.kind, hint=error.hint, joint=error.joint, link=error.link
        ) from error
    return limit, lines, complement
