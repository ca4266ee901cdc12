"""What diagrams show: quantities of a motion by name, over the driver's coordinate or time."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from assur._arrays import Float
    from assur.kinematics.motion import Motion
    from assur.kinematics.timed import TimedMotion

AXES = ("x", "y")
TITLES = {
    "joint": ("Position", "Velocity", "Acceleration", "Jerk"),
    "link": ("Angle", "Angular velocity", "Angular acceleration", "Angular jerk"),
    "slide": ("Displacement", "Velocity", "Acceleration", "Jerk"),
}
ANALOGUES = ("", "Velocity analogue", "Acceleration analogue", "Third analogue")
POWERS = ("", "", "²", "³")


@dataclass(frozen=True)
class Quantity:
    """A joint, link or slide of a motion.

    Attributes
    ----------
    kind : {"joint", "link", "slide"}
        What it is of.
    name : str
        Its name.
    axis : int or None
        The component of a joint that was asked for; None: both, and the magnitude.
    """

    kind: str
    name: str
    axis: int | None = None

    @property
    def shown(self) -> str:
        """The name as it was asked for."""
        return self.name if self.axis is None else f"{self.name}.{AXES[self.axis]}"


@dataclass(frozen=True)
class Line:
    """A curve of a diagram, for each of D designs.

    Attributes
    ----------
    part : str
        "x", "y", "v" (a magnitude), or "" for a number.
    values, slopes : ndarray
        (D, N); slopes are their derivatives by the abscissa, None if unknown.
    """

    part: str
    values: Float
    slopes: Float | None


def quantities(motion: Motion, name: Any) -> list[Quantity]:
    """Return what names are of; they must be of one kind."""
    names = [name] if isinstance(name, str) else name
    if not isinstance(names, list | tuple) or not names:
        message = f"diagram: {name!r} is not a name or a list of names"
        raise InputError(message)
    found = [_quantity(motion, one) for one in names]
    units = {"rad" if one.kind == "link" else "m" for one in found}
    if len(units) > 1:
        kinds = ", ".join(f"{one.kind} {one.name!r}" for one in found)
        message = f"diagram: {kinds} have different units: draw links by themselves"
        raise InputError(message)
    return found


def _quantity(motion: Motion, name: Any) -> Quantity:
    if isinstance(name, str):
        for kind, names in zip(TITLES, motion.mechanism._indices, strict=True):
            if name in names:
                return Quantity(kind, name)
        joint, dot, axis = name.rpartition(".")
        if dot and axis in AXES and joint in motion.mechanism._joint_names:
            return Quantity("joint", joint, AXES.index(axis))
    # It says what there is.
    motion[name if isinstance(name, str) else repr(name)]
    raise AssertionError(name)  # pragma: no cover


class Source(Protocol):
    """What diagrams are drawn of.

    Attributes
    ----------
    x : ndarray
        The abscissa, (N,), in degrees if `in_degrees`.
    label : str
        Its name and unit.
    orders : int
        The highest order.
    in_degrees : bool
        Whether the abscissa has ticks in degrees.
    """

    x: Float
    label: str
    orders: int
    in_degrees: bool

    def place(self, x: float) -> str:
        """Write a place on the abscissa."""

    def title(self, kind: str, order: int) -> tuple[str, str]:
        """Return what a diagram shows, and its unit."""

    def lines(self, of: Quantity, order: int) -> list[Line]:
        """Return the curves of a quantity."""

    def again(self, of: Quantity, order: int, part: str, design: int) -> Any:
        """Return a function that evaluates a line at other places, if there is one."""


class AlongDriver:
    """A motion over the driver's coordinate.

    Parameters
    ----------
    motion : Motion
        Its positions and analogues.
    speeds : tuple or None
        Speed, acceleration and jerk of the driver; None: analogues are shown.
    """

    def __init__(self, motion: Motion, speeds: tuple[Any, Any, Any] | None, degrees: bool) -> None:
        self.motion, self.degrees, self._speeds = motion, degrees, speeds
        if motion._drivers > 1:
            message = (
                f"diagram is over one driver's coordinate, this mechanism has {motion._drivers}: "
                "follow() gives its motion over time, with a diagram"
            )
            raise InputError(message)
        designs = len(motion.mechanism.shape)
        if len(motion.shape) - designs != 1 or motion.shape[-1] < 2:
            message = f"diagram needs positions (N,), at least two; this motion has {motion.shape}"
            raise InputError(message)
        if motion.q.ndim > 1:
            message = (
                f"each design has its own q {motion.q.shape}: a diagram of a batch needs the same "
                "q for all; take one design with motion[i]"
            )
            raise InputError(message)
        if not motion.status.size:
            message = f"diagram: this batch {motion.shape} has no designs"
            raise InputError(message)
        self.turns = motion.mechanism.driver not in motion.mechanism.slides
        self.orders = motion.order
        self.in_degrees = degrees and self.turns
        self.x = np.degrees(motion.q) if self.in_degrees else np.asarray(motion.q)
        self.label = "q" if self.in_degrees else f"q, {'rad' if self.turns else 'm'}"
        self._steady = speeds is not None and all(np.ndim(one) == 0 for one in speeds)

    def place(self, x: float) -> str:
        """Write a place on the abscissa."""
        from assur.pictures.chart import number

        if self.in_degrees:
            return degrees_text(x, float(np.ptp(self.x)))
        return f"{x + 0.0:.2f} rad".replace("-", "−") if self.turns else f"{number(x)} m"

    def title(self, kind: str, order: int) -> tuple[str, str]:
        """Return what a diagram shows, and its unit."""
        own = "rad" if kind == "link" else "m"
        if order == 0:
            return TITLES[kind][0], "°" if self.degrees and own == "rad" else own
        if self._speeds is None:
            per = "rad" if self.turns else "m"
            return ANALOGUES[order], f"{own}/{per}{POWERS[order]}"
        return TITLES[kind][order], f"{own}/s{POWERS[order]}"

    def lines(self, of: Quantity, order: int) -> list[Line]:
        """Return the curves of a quantity."""
        return self._of(self.motion, of, order)

    def again(self, of: Quantity, order: int, part: str, design: int) -> Any:
        """Return a function that solves a line of a design at other places."""
        if not (self._speeds is None or self._steady):
            return None

        def solved(x: Float) -> Float:
            q = np.radians(x) if self.in_degrees else x
            motion = _at(self.motion, design, q)
            lines = self._of(motion, of, order)
            return next(line.values[0] for line in lines if line.part == part)

        return solved

    def _of(self, motion: Motion, of: Quantity, order: int) -> list[Line]:
        rates = [self._rate(motion, of, k) for k in (order, order + 1) if k <= motion.order]
        designs = int(np.prod(motion.mechanism.shape, dtype=int))
        tail = (motion.shape[-1], 2) if of.kind == "joint" else (motion.shape[-1],)
        flat = [rate.reshape(designs, *tail) for rate in rates]
        values = flat[0]
        slopes = flat[1] if len(flat) > 1 and self._speeds is None else None
        if of.kind == "link" and order == 0 and self.degrees:
            values = np.degrees(values)
            slopes = None if slopes is None else np.degrees(slopes)
        if slopes is not None and self.in_degrees:
            slopes = np.radians(slopes)
        return _parts(of, order, values, slopes)

    def _rate(self, motion: Motion, of: Quantity, order: int) -> Float:
        analogues = getattr(motion, of.kind)(of.name)
        if order == 0 or self._speeds is None:
            rate: Float = analogues._order(order)
            return rate
        omega, alpha, beta = self._speeds
        shown: list[Callable[[], Float]] = [
            lambda: analogues.velocity(omega),
            lambda: analogues.acceleration(omega, alpha),
            lambda: analogues.jerk(omega, alpha, beta),
        ]
        rate = shown[order - 1]()
        if rate.shape != analogues.value.shape:
            message = (
                f"omega and alpha give the shape {rate.shape}: a diagram has one speed at each "
                f"position {motion.shape}"
            )
            raise InputError(message)
        return rate


class OverTime:
    """A motion over time."""

    def __init__(self, timed: TimedMotion, degrees: bool) -> None:
        self.motion, self._timed, self.degrees = timed.motion, timed, degrees
        self.x = timed.t
        self.orders, self.label, self.in_degrees = 3, "t, s", False
        if len(self.x) < 2:
            message = "diagram needs at least two times; this motion has one"
            raise InputError(message)

    def place(self, x: float) -> str:
        """Write a time."""
        from assur.pictures.chart import number

        return f"{number(x)} s"

    def title(self, kind: str, order: int) -> tuple[str, str]:
        """Return what a diagram shows, and its unit."""
        own = "rad" if kind == "link" else "m"
        if order == 0:
            return TITLES[kind][0], "°" if self.degrees and own == "rad" else own
        return TITLES[kind][order], f"{own}/s{POWERS[order]}"

    def lines(self, of: Quantity, order: int) -> list[Line]:
        """Return the curves of a quantity."""
        found = getattr(self._timed, of.kind)(of.name)
        values = found[order][None]
        slopes = found[order + 1][None] if order < self.orders else None
        if of.kind == "link" and order == 0 and self.degrees:
            values, slopes = np.degrees(values), None if slopes is None else np.degrees(slopes)
        return _parts(of, order, values, slopes)

    def again(self, of: Quantity, order: int, part: str, design: int) -> Any:
        """Return None: between the times the laws are unknown."""
        del of, order, part, design


def _parts(of: Quantity, order: int, values: Float, slopes: Float | None) -> list[Line]:
    """Return the components, and of a joint's derivatives the magnitude."""
    if of.kind != "joint":
        return [Line("", values, slopes)]
    axes: Sequence[int] = (0, 1) if of.axis is None else (of.axis,)
    lines = [
        Line(AXES[i], values[..., i], None if slopes is None else slopes[..., i]) for i in axes
    ]
    if order and of.axis is None:
        size = np.sqrt((values * values).sum(axis=-1))
        rate = None
        if slopes is not None:
            with np.errstate(invalid="ignore", divide="ignore"):
                rate = (values * slopes).sum(axis=-1) / size
        lines.append(Line("v", size, rate))
    return lines


def _at(motion: Motion, design: int, q: Float) -> Motion:
    """Solve one design of a motion at other coordinates, in the same assembly."""
    mechanism = motion.mechanism
    if mechanism.shape:
        mechanism = mechanism.design(np.unravel_index(design, mechanism.shape))  # type: ignore[arg-type]
    request = replace(
        motion._request, mechanism=mechanism, q=q, positions=q.shape, per_design=False, threads=1
    )
    results, status, _ = request.arrays(*motion._held_indices())
    return type(motion)(request, results, status)


def degrees_text(x: float, span: float) -> str:
    """Write an angle: whole degrees, over small spans with digits."""
    digits = 0 if span >= 60.0 else 1 if span >= 6.0 else 3
    return f"{round(x, digits) + 0.0:.{digits}f}°".replace("-", "−")
