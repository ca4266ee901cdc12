"""The curves through the points of a table."""

from __future__ import annotations

from typing import Literal, TypeAlias

__all__ = ["SPLINES", "Spline"]

Spline: TypeAlias = Literal["pchip", "not-a-knot", "natural", "clamped", "periodic", "linear"]
SPLINES = ("pchip", "not-a-knot", "natural", "clamped", "periodic", "linear")
