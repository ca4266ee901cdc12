"""Extremes of a coordinate of the motion."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from assur._arrays import as_number, short
from assur._extreme import Extreme
from assur._other_names import other_names
from assur._validate import checked_name, real_number, whole_number
from assur.errors import InputError, PositionError
from assur.kinematics.assembly import Assembly, drawn_in
from assur.kinematics.configuration import size_of
from assur.kinematics.limits import limits, period_of_one
from assur.kinematics.solve_arguments import checked_assembly

if TYPE_CHECKING:
    from collections.abc import Mapping

    from assur.kinematics.model import MechanismModel

__all__ = ["Extremes"]


# A coordinate that changes by less than this (rad, or sizes) stands still.
STANDS = 1e-13
# Least tolerance of a dwell, relative to the greatest value: twice the core's noise.
FINEST = 2e-11


@other_names(least="it is min", greatest="it is max", swing="it is stroke")
@dataclass(frozen=True, slots=True)
class Extremes:
    """The least and the greatest value of a coordinate, or of a derivative of it.

    Attributes
    ----------
    min, max : Extreme
        The value (m or rad, per unit of the driver's coordinate to the power of the order) and
        its place q. Derivatives are infinite at dead points. Turns of q and of angles count as in
        the intervals of `limits`: in the one that `q0` is in they are those of the motion from the
        drawing.
    time_ratio : float or None
        Time from one extreme to the other over the time back at constant speed, the longer over the
        shorter; None if the driver does not go round.

    Examples
    --------
    The stroke of an offset slider-crank, and how much quicker it returns:

    >>> import assur
    >>> bore = assur.SliderCrank(1.0, 3.0, 0.5).extremes("bore")
    >>> round(bore.stroke, 6), round(bore.time_ratio, 6)
    (2.032135, 1.084501)
    """

    min: Extreme
    max: Extreme
    time_ratio: float | None
    # The design in its assembly, the coordinate and its order, turns after which the motion closes:
    # for `dwells`.
    _of: tuple[MechanismModel, list[int], str, int, int | None] = field(repr=False, compare=False)

    def __repr__(self) -> str:
        if self.min.value == self.max.value:
            return f"<assur.Extremes {self.min.value:.6g} everywhere{self._slides()}>"
        ends = (f"{end.value:.6g} at q = {end.q:.6g}" for end in (self.min, self.max))
        ratio = "" if self.time_ratio is None else f", time ratio {self.time_ratio:.6g}"
        return f"<assur.Extremes {' … '.join(ends)}{ratio}>"

    def _slides(self) -> str:
        """Name the slides of a link that does not turn."""
        mechanism, _, name, order, _ = self._of
        if order or name not in mechanism.links:
            return ""
        names = [key for key, slide in mechanism.slides.items() if slide.link == name]
        return f"; it slides along {' and '.join(map(repr, names))}" if names else ""

    @property
    def stroke(self) -> float:
        """Difference of both: the stroke of a slide, the swing of a link."""
        stroke: float = self.max.value - self.min.value
        return stroke

    def dwells(self, tolerance: float) -> tuple[list[list[float]], list[list[float]]]:
        """Return where the coordinate rests: stretches of q near its extremes.

        Parameters
        ----------
        tolerance : float
            How far the value may be from the extreme, m or rad.

        Returns
        -------
        least, greatest : list of [float, float]
            Stretches of q over which it stays that near to the least and to the greatest value; if
            the driver goes round, within half a period of the place of that value.

        Examples
        --------
        >>> import assur
        >>> least, greatest = assur.SliderCrank(1.0, 3.0).extremes("bore").dwells(0.01)
        >>> [[round(q, 4) for q in stretch] for stretch in greatest]
        [[-0.1226, 0.1226]]
        """
        size = real_number(tolerance, "tolerance")
        if not size > 0.0:
            message = f"tolerance is {tolerance!r}: a positive number is needed"
            raise InputError(message, value=size)
        known = [abs(end.value) for end in (self.min, self.max) if math.isfinite(end.value)]
        finest = FINEST * max(known, default=0.0)
        if size < finest:
            message = f"tolerance is {size!r}: rounding decides below {finest:.3g}"
            raise InputError(message, value=size)
        mechanism, signs, name, order, turns = self._of
        ends = ((self.min.value + size, False), (self.max.value - size, True))
        values = mechanism.values.tolist()
        least, greatest = (
            mechanism.core.stretches_beyond(values, signs, name, order, end)
            if math.isfinite(end[0])
            else []
            for end in ends
        )
        period = None if turns is None else turns * math.tau
        return _near(least, self.min.q, period), _near(greatest, self.max.q, period)


def _near(stretches: list[list[float]], place: float, period: float | None) -> list[list[float]]:
    """Shift stretches to the turn about a place: one that has it modulo a turn contains it."""
    if period is None:
        return stretches
    shifted = []
    for low, high in stretches:
        turns = round((place - 0.5 * (low + high)) / period)
        shifted.append([low + turns * period, high + turns * period] if turns else [low, high])
    return sorted(shifted)


def checked_coordinate(mechanism: MechanismModel, name: Any) -> str:
    """Return the name of a coordinate: "B.x", "rocker", "bore"."""
    if not isinstance(name, str):
        message = f"coordinate {short(name)}: a name is needed"
        raise InputError(message)
    known = checked_name(name, "coordinate")
    mechanism.core.check_coordinate(known)
    return known


def extremes(
    mechanism: MechanismModel, name: str, order: int, assembly: Mapping[str, int] | None
) -> Extremes:
    """See `Mechanism.extremes`."""
    if mechanism.shape:
        message = (
            f"extremes() is for one design, this is a batch {mechanism.shape}: use design(i) (or "
            "assur.sweep, whose metrics are those of the positions alone)"
        )
        raise InputError(message)
    if mechanism.driver_count > 1:
        message = f"extremes() is for one driver; this mechanism has {mechanism.driver_count}"
        raise InputError(message)
    order = whole_number(order, "order", 0, 3, needed="0, 1, 2 or 3 is needed")
    name = checked_coordinate(mechanism, name)
    if isinstance(assembly, Assembly):
        drawn = drawn_in(mechanism, assembly)
        mechanism, assembly = (drawn, None) if drawn is not mechanism else (mechanism, assembly)
    signs = checked_assembly(mechanism, assembly)
    values = mechanism.values.tolist()
    ends = mechanism.core.extremes(values, signs, name, order)
    if ends is None:
        message = "this assembly does not exist at any coordinate: other dimensions are needed"
        raise PositionError(message)
    least, greatest = (Extreme(as_number(value), as_number(q)) for value, q in ends)
    if math.isnan(least.q):
        message = (
            f"extremes({name!r}): the link turns fully with the driver, so its angle has no "
            f"extremes; its analogues have: extremes({name!r}, order=1)"
        )
        raise InputError(message, link=name)
    own_limits = limits(mechanism, assembly)
    ratio = None
    unit = 1.0 if name in mechanism.links else size_of(mechanism)
    moves = greatest.value - least.value > STANDS * unit
    if order == 0 and moves and own_limits.period == 1 and math.isfinite(greatest.q - least.q):
        there = (greatest.q - least.q) % math.tau
        back = math.tau - there
        ratio = max(there, back) / min(there, back) if min(there, back) > 0.0 else None
    return Extremes(
        least, greatest, ratio, (mechanism, signs, name, order, period_of_one(own_limits))
    )
