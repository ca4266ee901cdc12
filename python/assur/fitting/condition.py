"""Conditions that a linkage keeps, and which of them bind."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

# A value within this part of its limit binds: barriers begin at 3 % before the frame.
BINDS = 0.03


class Condition(NamedTuple):
    """A condition and what a linkage has of it."""

    name: str
    value: float
    limit: float
    is_least: bool
    # "°" for angles, which are shown in degrees.
    unit: str = ""

    @property
    def binds(self) -> bool:
        """Whether the value is next to its limit."""
        margin = self.value - self.limit if self.is_least else self.limit - self.value
        return margin <= BINDS * abs(self.limit)

    def line(self) -> str:
        """Return the condition in a line."""
        least = "at least" if self.is_least else "at most"
        value, limit = (shown(number, self.unit) for number in (self.value, self.limit))
        line = f"{self.name:<22} {value:<8} {least} {limit:<8}"
        return f"{line} binds" if self.binds else line.rstrip()


def shown(number: float, unit: str = "") -> str:
    """Return a number as texts show it, an angle in degrees."""
    return f"{np.rad2deg(number):.3g}°" if unit == "°" else f"{number:.4g}"
