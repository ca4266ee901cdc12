"""Bodies and loads of machines: masses, weight, forces, torques, springs, dampers.

The core reads the fields of these classes by name (rust/py/src/convert).
"""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass, field
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from assur._arrays import real_array, short, two_numbers
from assur._summary import typed
from assur._validate import checked_name
from assur.dynamics.loads.load_values import Value, checked_value
from assur.dynamics.loads.numbers import (
    ZERO,
    OfMachines,
    not_negative_numbers,
    numbers,
)
from assur.dynamics.loads.one_way import Way, check_way
from assur.dynamics.loads.pressure import Gas, Pressure
from assur.dynamics.loads.table import Table, replace_fields
from assur.errors import InputError

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur._arrays import Number

__all__ = [
    "Body",
    "Damper",
    "Force",
    "Gas",
    "Gravity",
    "Pressure",
    "Spring",
    "Table",
    "Torque",
    "TorsionDamper",
    "TorsionSpring",
]

PointLike: TypeAlias = str | tuple[str, tuple[float, float]]


@dataclass(frozen=True, eq=False)
class Body(OfMachines):
    """Mass and moment of inertia of a link.

    Parameters
    ----------
    mass : float or array_like
        kg, not negative; of an array one for each machine of a batch (see `Machine`).
    inertia : float or array_like
        Moment of inertia about the centre of mass, kg·m², not negative; also an array.
    at : str or (x, y), optional
        Centre of mass: a joint, or coordinates in the link's frame (origin at its first joint, x
        toward its second), m. The link's first joint by default.
    drawn : (x, y), optional
        In place of `at`: the centre of mass in the drawing's coordinates, m, as a CAD program gives
        it. The drawing is that of the machine's mechanism, at its `q0`: the machine's own body has
        the place in the link's frame, as `at`, for a link keeps it where its dimensions change.

    Examples
    --------
    >>> import assur
    >>> assur.Body(mass=2.0, inertia=0.05, at=(0.2, 0.0))
    Body(mass=2.0, inertia=0.05, at=(0.2, 0.0))

    A rod that is drawn upright, from (1, 1) to (1, 3):

    >>> m = assur.Mechanism(
    ...     joints={"A": (1, 1), "B": (1, 3)}, links={"ground": "A", "rod": "AB"}, driver="rod"
    ... )
    >>> machine = assur.Machine(m, bodies={"rod": assur.Body(mass=2.0, drawn=(0.75, 2.0))})
    >>> machine.bodies["rod"]
    Body(mass=2.0, inertia=0.0, at=(1.0, 0.25))
    """

    _: KW_ONLY
    mass: float | Number = ZERO
    inertia: float | Number = ZERO
    at: str | tuple[float, float] | None = None
    drawn: tuple[float, float] | None = field(default=None, kw_only=True)

    def __repr__(self) -> str:
        return typed(self).replace(", drawn=None", "")

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            mass: npt.ArrayLike = 0.0,
            inertia: npt.ArrayLike = 0.0,
            at: str | tuple[float, float] | None = None,
            drawn: tuple[float, float] | None = None,
        ) -> None: ...

    def __post_init__(self) -> None:
        if self.drawn is not None:
            if self.at is not None:
                message = "Body: both at and drawn are given: the centre of mass is one of them"
                raise InputError(message)
            replace_fields(self, drawn=two_numbers(self.drawn, "Body drawn"))
        at: Any = self.at
        if at is not None:
            is_name = isinstance(at, str)
            at = checked_name(at, "Body at") if is_name else two_numbers(at, "Body at")
        replace_fields(
            self,
            mass=not_negative_numbers(self.mass, "Body: mass"),
            inertia=not_negative_numbers(self.inertia, "Body: inertia"),
            at=at,
        )


@dataclass(frozen=True)
class Gravity:
    """Gravitational acceleration (x, y), m/s²; gives every body its weight.

    Parameters
    ----------
    acceleration : (float, float)
        (x, y), m/s².

    Examples
    --------
    Along the drawing's −y by default; for a drawing that is turned by 30°:

    >>> import assur
    >>> assur.Gravity(), assur.Gravity((4.905, -8.496))
    (Gravity(acceleration=(0.0, -9.81)), Gravity(acceleration=(4.905, -8.496)))
    """

    acceleration: tuple[float, float] = (0.0, -9.81)

    def __post_init__(self) -> None:
        replace_fields(self, acceleration=two_numbers(self.acceleration, "Gravity"))


@dataclass(frozen=True, eq=False)
class Force(OfMachines):
    """A force at a point.

    Parameters
    ----------
    at : str or (link, (x, y))
        A joint, or a point in a link's frame, m.
    force : (fx, fy)
        N; each a number (or an array of them: see `Body`), a `Table` over q or another coordinate,
        or a function of (t, q, speed).
    axes : str, optional
        The link whose frame gives the directions of fx and fy, and turns with it; the drawing's
        axes by default.
    on : str, optional
        At a joint of several links the one that takes the force. By default the piston or block, if
        just one of the links is one (it slides, has this joint only, and the joint is not on the
        ground); otherwise the first of them in the description. The forces in the joint depend on
        it, and with friction all that follows from them: efforts, efficiency, self-locking, runs.
    while_ : {"forward", "backward"}, optional
        It acts only while a coordinate grows, or falls: a cutting force, the friction of a tool.
        While the coordinate rests, also where it turns back, it does not act.
    over : str, optional
        The slide or link whose value or angle is the coordinate of `while_`: that of its `Table`,
        if it has one, or else the (first) driver by default.

    Examples
    --------
    A shaper's tool cuts with 900 N along the middle of its way, on the forward stroke alone:

    >>> import assur
    >>> cut = assur.Table([0.3, 0.32, 0.32, 0.48, 0.48, 0.5], [0, 0, -900, -900, 0, 0], over="bore")
    >>> force = assur.Force("B", (cut, 0.0), while_="forward", over="bore")
    >>> shaper = assur.Machine(assur.SliderCrank(crank=0.1, rod=0.4), loads=[force])
    >>> shaper.reduced_moment([1.0, 5.0], speed=1.0).round(3)
    array([  0.   , -92.607])
    """

    __repr__ = typed

    at: PointLike
    force: tuple[Value, Value]
    _: KW_ONLY
    axes: str | None = None
    on: str | None = None
    while_: Way | None = None
    over: str | None = None

    def __post_init__(self) -> None:
        check_way(self)
        force: Any = self.force
        listed = isinstance(force, tuple | list) or (
            isinstance(force, np.ndarray) and force.ndim == 1
        )
        if not listed or len(force) != 2:
            message = f"Force: {short(force)} is not two components (fx, fy)"
            raise InputError(message)
        at = _checked_point(self.at, "Force at")
        where = repr(at) if isinstance(at, str) else f"a point of {at[0]!r}"
        components = zip(("fx", "fy"), force, strict=True)
        replace_fields(
            self,
            at=at,
            force=tuple(
                checked_value(component, f"Force at {where}: {name}")
                for name, component in components
            ),
            axes=None if self.axes is None else _link(self.axes, "Force axes"),
            on=None if self.on is None else _link(self.on, "Force on"),
        )


@dataclass(frozen=True, eq=False)
class Torque(OfMachines):
    """A torque on a link, N·m, counter-clockwise; its reaction acts on another (the frame).

    Parameters
    ----------
    link : str
        The link on which it acts.
    torque : float, array_like, Table or callable
        N·m: a number (or an array of them: see `Body`), a `Table` over q or another coordinate, or
        a function of (t, q, speed).
    on : str
        The link on which the reaction acts.
    while_, over
        See `Force`.

    Examples
    --------
    >>> import assur
    >>> load = assur.Torque("crank", lambda t, q, speed: -0.5 * speed)  # N·m
    >>> machine = assur.Machine(assur.SliderCrank(0.1, 0.35), loads=[load])
    >>> machine.reduced_moment(0.0, speed=10.0)
    np.float64(-5.0)
    """

    __repr__ = typed

    link: str
    torque: Value
    _: KW_ONLY
    on: str = "ground"
    while_: Way | None = None
    over: str | None = None

    def __post_init__(self) -> None:
        check_way(self)
        _check_links(self)
        replace_fields(self, torque=checked_value(self.torque, f"Torque on {self.link!r}: torque"))


@dataclass(frozen=True, eq=False)
class Spring(OfMachines):
    """A spring between two points.

    Parameters
    ----------
    first, second : str or (link, (x, y))
        Its ends: joints, or points in links' frames, m. At a joint of several links the same one
        takes the pull as for a `Force` without ``on``; a point in a link's frame names its link.
    stiffness : float or array_like
        N/m. This and the following may be arrays, see `Body`.
    length : float or array_like
        Free length, m.
    preload : float or array_like
        Tension at the free length, N.

    Examples
    --------
    >>> import assur
    >>> spring = assur.Spring("O", "B", stiffness=1e4, length=0.4)
    >>> machine = assur.Machine(assur.SliderCrank(0.1, 0.4), loads=[spring])
    >>> machine.potential(0.0).round(6)  # J: 1e4 · 0.1² / 2
    np.float64(50.0)
    """

    __repr__ = typed

    first: PointLike
    second: PointLike
    stiffness: float | Number
    length: float | Number
    _: KW_ONLY
    preload: float | Number = ZERO

    if TYPE_CHECKING:

        def __init__(
            self,
            first: PointLike,
            second: PointLike,
            stiffness: npt.ArrayLike,
            length: npt.ArrayLike,
            *,
            preload: npt.ArrayLike = 0.0,
        ) -> None: ...

    def __post_init__(self) -> None:
        _check_ends(self)
        _check_numbers(self, "stiffness", "length", "preload")


@dataclass(frozen=True, eq=False)
class TorsionSpring(OfMachines):
    """A torsion spring between two links.

    Parameters
    ----------
    link : str
        The link on which its torque acts.
    stiffness : float or array_like
        N·m/rad. This, `angle` and `preload` may be arrays, see `Body`.
    angle : float or array_like
        Difference of the two links' angles at which the torque is `preload`, rad.
    on : str
        The other link.
    preload : float or array_like
        Restoring torque at that angle, N·m.

    Examples
    --------
    >>> import assur
    >>> spring = assur.TorsionSpring("crank", stiffness=20.0, angle=0.5)
    >>> machine = assur.Machine(assur.SliderCrank(0.1, 0.4), loads=[spring])
    >>> machine.reduced_moment([0.5, 1.0])  # N·m
    array([  0., -10.])
    """

    __repr__ = typed

    link: str
    stiffness: float | Number
    _: KW_ONLY
    angle: float | Number = ZERO
    on: str = "ground"
    preload: float | Number = ZERO

    if TYPE_CHECKING:

        def __init__(
            self,
            link: str,
            stiffness: npt.ArrayLike,
            *,
            angle: npt.ArrayLike = 0.0,
            on: str = "ground",
            preload: npt.ArrayLike = 0.0,
        ) -> None: ...

    def __post_init__(self) -> None:
        _check_links(self)
        _check_numbers(self, "stiffness", "angle", "preload")


@dataclass(frozen=True, eq=False)
class Damper(OfMachines):
    """A damper between two points, N·s/m.

    Parameters
    ----------
    first, second : str or (link, (x, y))
        Its ends, as for a `Spring`.
    damping : float or array_like
        N·s/m; of an array one for each machine of a batch, see `Body`.

    Examples
    --------
    >>> import assur, numpy as np
    >>> damper = assur.Damper("O", "B", damping=50.0)
    >>> machine = assur.Machine(assur.SliderCrank(0.1, 0.4), loads=[damper])
    >>> machine.reduced_moment(np.pi / 2, speed=10.0).round(6)  # N·m: −50 · (1 m/s) · 0.1 m
    np.float64(-5.0)
    """

    __repr__ = typed

    first: PointLike
    second: PointLike
    damping: float | Number

    if TYPE_CHECKING:

        def __init__(
            self,
            first: PointLike,
            second: PointLike,
            damping: npt.ArrayLike,
        ) -> None: ...

    def __post_init__(self) -> None:
        _check_ends(self)
        _check_numbers(self, "damping")


@dataclass(frozen=True, eq=False)
class TorsionDamper(OfMachines):
    """A torsion damper between two links, N·m·s/rad.

    Parameters
    ----------
    link : str
        The link on which its torque acts.
    damping : float or array_like
        N·m·s/rad; of an array one for each machine of a batch, see `Body`.
    on : str
        The other link.

    Examples
    --------
    >>> import assur
    >>> damper = assur.TorsionDamper("crank", damping=0.5)
    >>> machine = assur.Machine(assur.SliderCrank(0.1, 0.4), loads=[damper])
    >>> machine.reduced_moment(0.0, speed=10.0)  # N·m
    np.float64(-5.0)
    """

    __repr__ = typed

    link: str
    damping: float | Number
    _: KW_ONLY
    on: str = "ground"

    if TYPE_CHECKING:

        def __init__(
            self,
            link: str,
            damping: npt.ArrayLike,
            *,
            on: str = "ground",
        ) -> None: ...

    def __post_init__(self) -> None:
        _check_links(self)
        _check_numbers(self, "damping")


# Those that act along the line of their ends, `first` and `second`.
BetweenPoints: TypeAlias = Spring | Damper
Load: TypeAlias = (
    Gravity | Force | Torque | Pressure | Spring | TorsionSpring | Damper | TorsionDamper
)


def checked_load(load: Any) -> Load:
    """Return a load."""
    if not isinstance(load, Load):
        message = f"{short(load)} is not a load: Gravity, Force, Torque, Spring, Damper …"
        raise InputError(message)
    return load


def named_values(load: Load) -> dict[str, Value | Gas]:
    """Return what may be a table or a function, by its name in messages."""
    match load:
        case Force():
            fx, fy = load.force
            at = f"Force at {load.at!r}"
            return {f"{at}: fx": fx, f"{at}: fy": fy}
        case Torque():
            return {f"Torque on {load.link!r}: torque": load.torque}
        case Pressure():
            return {f"Pressure in {load.slide!r}: pressure": load.pressure}
        case Gravity() | Spring() | TorsionSpring() | Damper() | TorsionDamper():
            return {}


def _check_numbers(load: Any, *names: str) -> None:
    kind = type(load).__name__
    replace_fields(load, **{n: numbers(getattr(load, n), f"{kind} {n}") for n in names})


def _link(name: Any, what: str) -> str:
    if not isinstance(name, str):
        message = f"{what} is {short(name)}: the name of a link is needed"
        raise InputError(message)
    return checked_name(name, what)


def _check_links(load: Any) -> None:
    kind = type(load).__name__
    link, on = _link(load.link, f"{kind} link"), _link(load.on, f"{kind} on")
    if link == on:
        message = f"{kind}: link and on are both {link!r}: give two links"
        raise InputError(message, link=link)


def _check_ends(load: Any) -> None:
    kind = type(load).__name__
    first, second = (
        _checked_point(load.first, f"{kind} first"),
        _checked_point(load.second, f"{kind} second"),
    )
    if first == second:
        message = f"{kind}: both ends are {first!r}: it has no length"
        raise InputError(message)
    replace_fields(load, first=first, second=second)


def _checked_point(at: Any, what: str) -> PointLike:
    if isinstance(at, str):
        return checked_name(at, what)
    if isinstance(at, tuple | list) and len(at) == 2 and isinstance(at[0], str):
        point = real_array(at[1], f"{what}, in the frame of {at[0]!a}")
        if point.shape == (2,) and np.isfinite(point).all():
            return checked_name(at[0], what), (float(point[0]), float(point[1]))
    message = (
        f"{what}: {short(at)} is not a location: a joint's name, or (link, (x, y)) in its frame"
    )
    raise InputError(message)
