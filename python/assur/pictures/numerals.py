"""Numbers, lengths and angles as pictures write them."""

from __future__ import annotations

import numpy as np


def true_minus(text: str) -> str:
    """Return a number's text with the minus of print."""
    return text.replace("-", "−")


def number(x: float, span: float = 0.0) -> str:
    """Write three digits, with a true minus; more where a range between near values needs them."""
    size = abs(x)
    if 0.0 < span < 0.5 * size < 1e5:
        text = f"{x:.{max(int(np.ceil(1.7 - np.log10(span))), 0)}f}"
    elif 100.0 <= size < 1e5:
        text = f"{x:.0f}"
    elif 1e-3 <= size < 1e5:
        text = f"{x:#.3g}"
    else:
        text, _, power = f"{x:.3g}".partition("e")
        text += f"·{ten(int(power))}" if power else ""
    return true_minus(text)


def ten(power: int) -> str:
    """Write a power of ten."""
    return "10" + str(power).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))


def length_unit(length: float) -> tuple[str, float]:
    """Return the unit that suits a length in m, and how many of it a metre has."""
    units = (("km", 1e3, 1e-3), ("m", 0.2, 1.0), ("mm", 2e-4, 1e3), ("µm", 0.0, 1e6))
    return next((unit, factor) for unit, least, factor in units if length >= least)


def length_text(length: float) -> str:
    """Write a length in m with the unit that suits it."""
    unit, factor = length_unit(length)
    return f"{length * factor:.6g} {unit}"


def angle_text(angle: float, digits: int) -> str:
    """Write an angle in rad as degrees."""
    return true_minus(f"{round(float(np.degrees(angle)), digits) + 0.0:.{digits}f}°")


def degrees_text(x: float, span: float) -> str:
    """Write an angle in degrees: whole ones, over small spans with digits."""
    digits = 0 if span >= 60.0 else 1 if span >= 6.0 else 3
    return true_minus(f"{round(x, digits) + 0.0:.{digits}f}°")


def radians_text(x: float) -> str:
    """Write an angle in rad."""
    return true_minus(f"{x + 0.0:.2f} rad")
