"""What a machine carries and what acts on it: bodies, weight, forces, springs, dampers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from assur._checks import real_array, real_number
from assur.errors import InputError

__all__ = [
    "Body",
    "Damper",
    "Force",
    "Gravity",
    "Spring",
    "Table",
    "Torque",
    "TorsionDamper",
    "TorsionSpring",
]

Place: TypeAlias = str | tuple[str, tuple[float, float]]
# What the core is told of a value (a number, or which table or function), of a table, of a load.
Told: TypeAlias = float | tuple[str, int]
Rows: TypeAlias = tuple[list[float], list[float], str, bool]
Parts: TypeAlias = tuple[str, list[Any], list[str], list[float], list[Told]]


@dataclass(frozen=True, eq=False)
class Table:
    """Values over the (first) driver's coordinate; as a motor, torque over the motor's own speed.

    Parameters
    ----------
    q : array_like
        Coordinates, growing, rad or m; of a motor its speeds, rad/s.
    value : array_like
        Values there.
    spline : {"not-a-knot", "natural", "clamped", "periodic", "linear"}
        What is laid through the rows.
    periodic : bool
        Whether this is one period, its end the same as its beginning (the default); otherwise
        there is no value beyond the rows. A motor's table never is.
    ratio : float
        As a motor: its speed by that of the driver.
    rotor_inertia : float
        As a motor: moment of inertia of its rotor, kg·m².

    Examples
    --------
    >>> import assur
    >>> work = assur.Table([0.0, 3.0, 3.4, 6.283185307179586], [0.0, 0.0, 900.0, 0.0], "linear")
    """

    q: npt.ArrayLike
    value: npt.ArrayLike
    spline: str = "not-a-knot"
    periodic: bool = True
    ratio: float = 1.0
    rotor_inertia: float = 0.0

    def _rows(self, periodic: bool | None = None) -> Rows:
        q, value = real_array(self.q, "Table q"), real_array(self.value, "Table value")
        if q.ndim != 1 or q.shape != value.shape:
            message = f"Table: q has the shape {q.shape}, value {value.shape}: two lists are needed"
            raise InputError(message)
        whole = self.periodic if periodic is None else periodic
        return q.tolist(), value.tolist(), str(self.spline), bool(whole)


# Called with floats; of a machine with several drivers q and speed are tuples of them.
Function: TypeAlias = Callable[[float, Any, Any], float]
# A number, a table over q, or a function of (t, q, speed).
Value: TypeAlias = float | Table | Function


@dataclass(frozen=True)
class Body:
    """Mass of a link.

    Parameters
    ----------
    mass : float
        kg, not negative.
    inertia : float
        Moment of inertia about the centre of mass, kg·m², not negative.
    at : str or (x, y), optional
        Centre of mass: a joint, or a place in the link's frame (origin at its first joint, x
        toward its second), m. The link's first joint by default.

    Examples
    --------
    >>> import assur
    >>> assur.Body(mass=2.0, inertia=0.05, at=(0.2, 0.0))
    Body(mass=2.0, inertia=0.05, at=(0.2, 0.0))
    """

    mass: float = 0.0
    inertia: float = 0.0
    at: str | tuple[float, float] | None = None

    def __post_init__(self) -> None:
        for name in ("mass", "inertia"):
            value = real_number(getattr(self, name), f"Body {name}")
            if value < 0.0:
                message = f"Body: {name} is {value:g}, it must not be negative"
                raise InputError(message, value=value)


@dataclass(frozen=True)
class Gravity:
    """Free fall, (x, y), m/s²; bodies have weight by it."""

    acceleration: tuple[float, float] = (0.0, -9.81)


@dataclass(frozen=True)
class Force:
    """A force at a point.

    Parameters
    ----------
    at : str or (link, (x, y))
        A joint, or a place in a link's frame, m.
    force : (fx, fy)
        N; each a number, a `Table` over q, or a function of (t, q, speed).
    axes : str, optional
        The link along whose frame fx and fy are; the drawing's axes by default.
    """

    at: Place
    force: tuple[Value, Value]
    axes: str | None = None

    def _parts(self, tell: Any) -> Parts:
        force: Any = self.force
        if not isinstance(force, tuple | list) or len(force) != 2:
            message = f"Force: {self.force!r} is not two components (fx, fy)"
            raise InputError(message)
        links = [] if self.axes is None else [_name(self.axes, "Force axes")]
        return "force", [_place(self.at)], links, [], [tell(value) for value in self.force]


@dataclass(frozen=True)
class Torque:
    """A torque on a link, N·m, counter-clockwise; its reaction is on another (the frame).

    Parameters
    ----------
    link : str
        The link.
    torque : float, Table or callable
        N·m: a number, a `Table` over q, or a function of (t, q, speed).
    on : str
        The link that has the reaction.
    """

    link: str
    torque: Value
    on: str = "ground"

    def _parts(self, tell: Any) -> Parts:
        return "torque", [], _links(self), [], [tell(self.torque)]


@dataclass(frozen=True)
class Spring:
    """A spring between two points.

    Parameters
    ----------
    first, second : str or (link, (x, y))
        Its ends.
    stiffness : float
        N/m.
    length : float
        Free length, m.
    preload : float
        Tension at that length, N.
    """

    first: Place
    second: Place
    stiffness: float
    length: float
    preload: float = 0.0

    def _parts(self, _: Any) -> Parts:
        numbers = _numbers(self, "stiffness", "length", "preload")
        return "spring", _ends(self), [], numbers, []


@dataclass(frozen=True)
class TorsionSpring:
    """A spring between two links.

    Parameters
    ----------
    link : str
        The link that it turns back.
    stiffness : float
        N·m/rad.
    angle : float
        Difference of the two links' angles without load, rad.
    on : str
        The other link.
    preload : float
        Torque back at that angle, N·m.
    """

    link: str
    stiffness: float
    angle: float = 0.0
    on: str = "ground"
    preload: float = 0.0

    def _parts(self, _: Any) -> Parts:
        numbers = _numbers(self, "stiffness", "angle", "preload")
        return "torsion spring", [], _links(self), numbers, []


@dataclass(frozen=True)
class Damper:
    """A damper between two points, N·s/m."""

    first: Place
    second: Place
    damping: float

    def _parts(self, _: Any) -> Parts:
        numbers = _numbers(self, "damping")
        return "damper", _ends(self), [], numbers, []


@dataclass(frozen=True)
class TorsionDamper:
    """A damper between two links, N·m·s/rad."""

    link: str
    damping: float
    on: str = "ground"

    def _parts(self, _: Any) -> Parts:
        return "torsion damper", [], _links(self), _numbers(self, "damping"), []


Load: TypeAlias = Gravity | Force | Torque | Spring | TorsionSpring | Damper | TorsionDamper


@dataclass
class Outside:
    """The tables and functions among the values, in order."""

    tables: list[Rows] = field(default_factory=list)
    functions: list[Function] = field(default_factory=list)
    # How many of the functions are loads; those of motors come behind.
    loads: int = 0

    def tell(self, value: Value) -> Told:
        """What the core is told of a value."""
        if isinstance(value, Table):
            if value.ratio != 1.0 or value.rotor_inertia != 0.0:
                message = "Table: ratio and rotor_inertia are for a table that is a motor"
                raise InputError(message)
            self.tables.append(value._rows())
            return "table", len(self.tables) - 1
        if callable(value):
            self.functions.append(value)
            return "function", len(self.functions) - 1
        return real_number(value, "the value of a load")

    def numbers(
        self, q: npt.NDArray[np.float64], speed: npt.NDArray[np.float64]
    ) -> npt.NDArray[np.float64]:
        """The loads' functions' values at positions (rows of coordinates), at the time 0."""
        functions = self.functions[: self.loads]
        if not functions:
            return np.empty(0)
        one = q.shape[1] == 1
        rows = zip(q.tolist(), speed.tolist(), strict=True)
        pairs = ((a[0], b[0]) if one else (tuple(a), tuple(b)) for a, b in rows)
        table = [[_called(f, a, b) for f in functions] for a, b in pairs]
        return np.array(table, np.float64).ravel()


def _called(function: Function, q: Any, speed: Any) -> float:
    value: Any = function(0.0, q, speed)
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError) as error:
        name = getattr(function, "__name__", repr(function))
        message = f"the load {name}(t, q, speed) gave {value!r} at q = {q}: a number is needed"
        raise InputError(message) from error


def _numbers(load: Any, *names: str) -> list[float]:
    return [real_number(getattr(load, name), f"{type(load).__name__} {name}") for name in names]


def _name(name: Any, what: str) -> str:
    if isinstance(name, str):
        return name
    message = f"{what} is {name!r}: the name of a link is needed"
    raise InputError(message)


def _links(load: Any) -> list[str]:
    kind = type(load).__name__
    if load.link == load.on:
        message = f"{kind}: link and on are both {load.link!r}: between them nothing turns"
        raise InputError(message, link=load.link)
    return [_name(load.link, f"{kind} link"), _name(load.on, f"{kind} on")]


def _ends(load: Any) -> list[Any]:
    if load.first == load.second:
        message = f"{type(load).__name__}: both ends are {load.first!r}: it has no length"
        raise InputError(message)
    return [_place(load.first), _place(load.second)]


def _place(at: Any) -> Any:
    if isinstance(at, str):
        return at
    try:
        link, (x, y) = at
        if isinstance(link, str):
            return link, [real_number(x, "a place's x"), real_number(y, "a place's y")]
    except (TypeError, ValueError):
        pass
    message = f"{at!r} is no place: a joint's name, or (link, (x, y)) in the link's frame"
    raise InputError(message)
