"""The curves through the points of a table."""

from __future__ import annotations

from typing import Literal, TypeAlias

__all__ = ["SPLINES", "Spline"]

Spline: TypeAlias = Literal["not-a-knot", "natural", "clamped", "periodic", "pchip", "linear"]
SPLINES = ("not-a-knot", "natural", "clamped", "periodic", "pchip", "linear")
