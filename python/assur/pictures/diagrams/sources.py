"""The abscissas of diagrams, and their titles: the driver's coordinate, or time."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from assur.errors import InputError
from assur.pictures.diagrams.quantities import ORDERS, components
from assur.pictures.numerals import degrees_text, number, radians_text

if TYPE_CHECKING:
    from collections.abc import Callable

    from assur._arrays import Float
    from assur._faces import Motion, TimedMotion
    from assur.pictures.diagrams.quantities import Line, Quantity

TITLES = {
    "joint": ("Position", "Velocity", "Acceleration", "Jerk"),
    "link": ("Angle", "Angular velocity", "Angular acceleration", "Angular jerk"),
    "slide": ("Displacement", "Velocity", "Acceleration", "Jerk"),
}
ANALOGUES = ("", "Velocity analogue", "Acceleration analogue", "Third analogue")
POWERS = ("", "", "²", "³")


class Source(Protocol):
    """The source of a diagram's curves.

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
    speeds : tuple of ndarray or None
        Speed, acceleration and jerk of the driver; None: analogues are shown.
    """

    def __init__(
        self, motion: Motion, speeds: tuple[Float, Float, Float] | None, degrees: bool
    ) -> None:
        self.motion, self.degrees, self._speeds = motion, degrees, speeds
        if motion.driver_count > 1:
            message = (
                f"diagram is over one driver's coordinate, this mechanism has "
                f"{motion.driver_count}: follow() gives its motion over time, with a diagram"
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
        self._steady = speeds is not None and all(speed.ndim == 0 for speed in speeds)

    def place(self, x: float) -> str:
        """Write a place on the abscissa."""
        if self.in_degrees:
            return degrees_text(x, float(np.ptp(self.x)))
        return radians_text(x) if self.turns else f"{number(x)} m"

    def title(self, kind: str, order: int) -> tuple[str, str]:
        """Return what a diagram shows, and its unit."""
        if order == 0 or self._speeds is not None:
            return title_in_time(kind, order, self.degrees)
        unit, per = "rad" if kind == "link" else "m", "rad" if self.turns else "m"
        return ANALOGUES[order], f"{unit}/{per}{POWERS[order]}"

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
        return components(of, order, values, slopes)

    def _rate(self, motion: Motion, of: Quantity, order: int) -> Float:
        analogues = getattr(motion, of.kind)(of.name)
        if order == 0 or self._speeds is None:
            rate: Float = getattr(analogues, ORDERS[order])
            return rate
        speed, acceleration, jerk = self._speeds
        shown: list[Callable[[], Float]] = [
            lambda: analogues.velocity(speed),
            lambda: analogues.acceleration(speed, acceleration),
            lambda: analogues.jerk(speed, acceleration, jerk),
        ]
        rate = shown[order - 1]()
        if rate.shape != analogues.value.shape:
            message = (
                f"speed and acceleration give the shape {rate.shape}: a diagram has one speed at "
                f"each position {motion.shape}"
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
        return f"{number(x)} s"

    def title(self, kind: str, order: int) -> tuple[str, str]:
        """Return what a diagram shows, and its unit."""
        return title_in_time(kind, order, self.degrees)

    def lines(self, of: Quantity, order: int) -> list[Line]:
        """Return the curves of a quantity."""
        found: Any = getattr(self._timed, of.kind)(of.name)
        derivatives = (lambda: found.value, found.velocity, found.acceleration, found.jerk)
        values = derivatives[order]()[None]
        slopes = derivatives[order + 1]()[None] if order < self.orders else None
        if of.kind == "link" and order == 0 and self.degrees:
            values, slopes = np.degrees(values), None if slopes is None else np.degrees(slopes)
        return components(of, order, values, slopes)

    def again(self, of: Quantity, order: int, part: str, design: int) -> Any:
        """Return None: between the times the laws are unknown."""
        del of, order, part, design


def title_in_time(kind: str, order: int, degrees: bool) -> tuple[str, str]:
    """Return the title of a derivative by time, or of the value, and its unit."""
    unit = "rad" if kind == "link" else "m"
    if order == 0:
        return TITLES[kind][0], "°" if degrees and unit == "rad" else unit
    return TITLES[kind][order], f"{unit}/s{POWERS[order]}"


def _at(motion: Motion, design: int, q: Float) -> Motion:
    """Solve one design of a motion at other coordinates, in the same assembly."""
    mechanism = motion.mechanism
    if mechanism.shape:
        mechanism = mechanism.design(np.unravel_index(design, mechanism.shape))  # type: ignore[arg-type]
    request = replace(
        motion.request, mechanism=mechanism, q=q, positions=q.shape, per_design=False, threads=1
    )
    results, status, _ = request.arrays(*motion.held_indices)
    return type(motion)(request, results, status)
