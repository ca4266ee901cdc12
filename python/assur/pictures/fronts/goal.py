"""A goal as pictures show it: the values of all designs in the unit that suits."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from assur.pictures.numerals import length_unit, number

if TYPE_CHECKING:
    from assur._arrays import Float


class Goal(NamedTuple):
    """A goal with its values, (n,), and their unit: rad, m or nothing."""

    name: str
    values: Float
    unit: str
    is_maximized: bool
    degrees: bool

    @property
    def is_angle(self) -> bool:
        """Whether it is shown in degrees."""
        return self.degrees and self.unit == "rad"

    @property
    def shown_unit(self) -> tuple[str, float]:
        """The unit that suits, and its factor."""
        if self.is_angle:
            return "°", 180.0 / np.pi
        if self.unit == "m":
            return length_unit(float(np.abs(self.values).max(initial=0.0)) or 1.0)
        return self.unit, 1.0

    @property
    def shown(self) -> Float:
        """The values in that unit."""
        return self.values * self.shown_unit[1]

    @property
    def title(self) -> str:
        """Its name with the unit, and what is better."""
        unit = self.shown_unit[0]
        better = "maximize" if self.is_maximized else "minimize"
        return f"{self.name}{f', {unit}' if unit else ''} ({better})"

    def texts(self) -> list[str]:
        """Return the values as a table has them."""
        span = float(np.ptp(self.shown))
        return [number(value, span / 100.0) for value in self.shown.tolist()]


def range_of(values: Float, part: float) -> tuple[float, float]:
    """Return the ends of an axis: about the values, with a part of their range on each side."""
    low, high = float(values.min()), float(values.max())
    margin = part * (high - low)
    if margin <= 1e-12 * max(abs(low), abs(high)):
        margin = part * (abs(high) or 1.0)
    return low - margin, high + margin


def far_apart(points: Float, least: float) -> list[int]:
    """Return points (n, 2) that have room for a text each: no two are nearer than `least`."""
    chosen: list[int] = []
    for index, point in enumerate(points):
        if not chosen or (((points[chosen] - point) ** 2).sum(axis=1) >= least**2).all():
            chosen.append(index)
    return chosen
