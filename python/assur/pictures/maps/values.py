"""The values of a metric: those that are marked, and how they are written."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur.pictures.numerals import number, true_minus

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur._arrays import Float

    # Why there is no value, and at which nodes.
    Reasons = list[tuple[str, npt.NDArray[np.bool_]]]

# Fraction of a map's greatest value below which values are rounding.
ROUNDING = 1e-12


def extremes(values: Float, best: str) -> list[tuple[str, int]]:
    """Return the extremes that are marked, with their flat indices."""
    if not np.isfinite(values).any():
        return []
    both = [("min", int(np.nanargmin(values))), ("max", int(np.nanargmax(values)))]
    return [extreme for extreme in both if best in (extreme[0], "both")]


def level_text(level: float) -> str:
    """Write a level of the contours."""
    return true_minus(f"{level:.6g}")


def value_text(value: float, values: Float) -> str:
    """Write a value of the map; mere rounding, compared with the others, becomes 0."""
    greatest = float(np.nanmax(np.abs(values)))
    return number(0.0 if abs(value) <= ROUNDING * greatest else value)
