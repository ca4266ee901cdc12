"""The resolution of a file: half a unit of the last decimal that it writes."""

from __future__ import annotations

from decimal import Decimal
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from assur.importers.sketch import Sketch

Tolerance: TypeAlias = "float | tuple[float, float] | None"

# Numbers that are exactly between two decimals, and their own rounding.
MARGIN = 1.0 + 1e-6
# Coordinates with this many decimals have not been rounded by hand or by a program.
MOST_DECIMALS = 9
# A drawing in whole numbers, or with one decimal, is known better than that: part of its size.
COARSEST = 1e-3


def tolerance_of(sketch: Sketch, scale: float) -> Tolerance:
    """Return the length, m, and perhaps the angle, rad, to which the joints of a file are known.

    None where the file writes all digits.
    """
    length = sketch.resolution
    if length is None:
        decimals = max(map(_decimals, (x for at in sketch.joints.values() for x in at)), default=0)
        if decimals > MOST_DECIMALS:
            return None
        length = float(f"5e-{decimals + 1}")
    length = min(length, COARSEST * _size(sketch)) * scale * MARGIN
    if not length > 0.0:
        return None
    angle = sketch.angle_resolution
    return length if angle is None else (length, angle * MARGIN)


def _decimals(number: float) -> int:
    """Return the decimals of the shortest text that reads back as a number."""
    exponent = Decimal(repr(number)).normalize().as_tuple().exponent
    return max(-exponent, 0) if isinstance(exponent, int) else 0


def _size(sketch: Sketch) -> float:
    """Return the greater side of the rectangle around all joints."""
    spans = []
    for axis in (0, 1):
        along = [at[axis] for at in sketch.joints.values()]
        spans.append(max(along, default=0.0) - min(along, default=0.0))
    return max(spans)
