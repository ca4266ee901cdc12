"""Names of two parts with a dot between them: a coordinate "B.x", a dimension "crank.length".

No joint, link or slide has a dot in its name, so the last dot separates item and component.
"""

from __future__ import annotations

__all__ = ["is_angle", "split_name", "unit_of"]

# Components of dimensions in rad; all others are in m. "link_angle" turns a guide on its link.
ANGLES = ("angle", "link_angle")


def split_name(name: str) -> tuple[str, str]:
    """Return item and component: "B.x" is "B" and "x", "ground.D.x" is "ground.D" and "x".

    A name without a dot has the component "".
    """
    item, dot, component = name.rpartition(".")
    return (item, component) if dot else (name, "")


def is_angle(dimension: str) -> bool:
    """Whether a dimension is an angle, not a length."""
    return split_name(dimension)[1] in ANGLES


def unit_of(dimension: str) -> str:
    """Return the unit of a dimension."""
    return "rad" if is_angle(dimension) else "m"
