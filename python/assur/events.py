"""Events of a run: what is looked for on the way, and whether the run ends there."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from assur import transmission
from assur.errors import InputError
from assur.loads import Function, _number

if TYPE_CHECKING:
    from assur.mechanism import Mechanism

__all__ = ["Crossing", "Position", "Rest", "Speed", "TransmissionAngle"]

Direction: TypeAlias = Literal["either", "rising", "falling"]
SIGNS = {"either": 0, "rising": 1, "falling": -1}

# Kind, driver or function, value, lines, whether their complement, sign, whether it stops.
WatchParts: TypeAlias = tuple[str, int, float, list[Any], bool, int, bool]


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
        As of `Rest`.
    direction : {"either", "rising", "falling"}
        Which way it goes through.
    """

    q: float
    stop: bool = True
    driver: int = 0
    direction: Direction = "either"


@dataclass(frozen=True)
class Speed:
    """A driver's speed reaches a value, rad/s or m/s; otherwise as `Position`."""

    speed: float
    stop: bool = True
    driver: int = 0
    direction: Direction = "either"


@dataclass(frozen=True)
class TransmissionAngle:
    """A transmission angle reaches its limit.

    Parameters
    ----------
    name : str
        A joint or slide (`Motion.transmission_angle`).
    limit : float
        rad.
    between : (str, str), optional
        Joints on the two lines.
    stop : bool
        Whether the run ends there.
    direction : {"falling", "rising", "either"}
        Which way it goes through.
    """

    name: str
    limit: float
    between: tuple[str, str] | None = None
    stop: bool = True
    direction: Direction = "falling"


@dataclass(frozen=True, eq=False)
class Crossing:
    """A function of (t, q, speed) goes through zero.

    Parameters
    ----------
    function : callable
        Called with floats (with several drivers q and speed are tuples); smooth near its zeros.
    stop : bool
        Whether the run ends there.
    direction : {"either", "rising", "falling"}
        Which way it goes through.
    """

    function: Function
    stop: bool = False
    direction: Direction = "either"


Event: TypeAlias = Rest | Position | Speed | TransmissionAngle | Crossing


def parts(
    event: Any, mechanism: Mechanism | None, drivers: int, functions: list[Function]
) -> WatchParts:
    """What the core is told of an event; its function goes to the list."""
    if not isinstance(event, Event):
        message = (
            f"{event!r} is no event: Rest, Position, Speed, TransmissionAngle or Crossing of "
            "assur.events"
        )
        raise InputError(message)
    direction = "either" if isinstance(event, Rest) else event.direction
    if direction not in SIGNS:
        message = f"{event!r}: direction is one of {', '.join(SIGNS)}"
        raise InputError(message)
    ending = SIGNS[direction], bool(event.stop)
    if isinstance(event, Crossing):
        function: Any = event.function
        if not callable(function):
            message = f"{event!r}: a function of (t, q, speed) is needed"
            raise InputError(message)
        functions.append(function)
        return "function", len(functions) - 1, 0.0, [], False, *ending
    if isinstance(event, TransmissionAngle):
        if mechanism is None:
            message = f"{event!r}: this machine is a table and has no joints"
            raise InputError(message)
        lines, complement = transmission.lines(mechanism, event.name, event.between)
        limit = _number(event.limit, "the limit of a TransmissionAngle")
        told = [_line(mechanism, line) for line in lines]
        return "angle", 0, limit, told, complement, *ending
    if not 0 <= event.driver < drivers:
        message = f"{event!r}: there are {drivers} drivers, counted from 0"
        raise InputError(message)
    if isinstance(event, Position):
        return "coordinate", event.driver, _number(event.q, "Position q"), [], False, *ending
    value = 0.0 if isinstance(event, Rest) else _number(event.speed, "Speed speed")
    return "speed", event.driver, value, [], False, *ending


def _line(mechanism: Mechanism, line: transmission.Line) -> tuple[str, Any]:
    if line.end is not None:
        return line.start, line.end
    on = mechanism.slides[line.start].on
    return on, float(transmission.guide_angle(mechanism, line.start))
