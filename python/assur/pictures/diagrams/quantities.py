"""Quantities of a motion by name, and their curves."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import in_range, short
from assur.description.dotted_names import split_name
from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur._arrays import Float
    from assur._faces import Motion

AXES = ("x", "y")
KINDS = ("joint", "link", "slide")
# Attributes of analogues, by their order.
ORDERS = ("value", "d1", "d2", "d3")


@dataclass(frozen=True)
class Quantity:
    """A joint, link or slide of a motion.

    Attributes
    ----------
    kind : {"joint", "link", "slide"}
        What it is of.
    name : str
        Its name.
    axis : int or None
        The component of a joint that was asked for; None: both, and the magnitude.
    """

    kind: str
    name: str
    axis: int | None = None

    @property
    def shown(self) -> str:
        """The name as it was asked for."""
        return self.name if self.axis is None else f"{self.name}.{AXES[self.axis]}"


@dataclass(frozen=True)
class Line:
    """A curve of a diagram, for each of D designs.

    Attributes
    ----------
    part : str
        "x", "y", "v" (a magnitude), or "" for a number.
    values, slopes : ndarray
        (D, N); slopes are their derivatives by the abscissa, None if unknown.
    """

    part: str
    values: Float
    slopes: Float | None


def quantities(motion: Motion, name: Any) -> list[Quantity]:
    """Return what names are of; they must be of one kind."""
    names = [name] if isinstance(name, str) else name
    if not isinstance(names, list | tuple) or not names:
        message = f"diagram: {short(name)} is not a name or a list of names"
        raise InputError(message)
    listed = [_quantity(motion, item) for item in names]
    units = {"rad" if quantity.kind == "link" else "m" for quantity in listed}
    if len(units) > 1:
        kinds = ", ".join(f"{quantity.kind} {quantity.name!r}" for quantity in listed)
        message = f"diagram: {kinds} have different units: draw links by themselves"
        raise InputError(message)
    return listed


def _quantity(motion: Motion, name: Any) -> Quantity:
    if isinstance(name, str):
        for kind, names in zip(KINDS, motion.mechanism.indices, strict=True):
            if name in names:
                return Quantity(kind, name)
        joint, axis = split_name(name)
        if axis in AXES and joint in motion.mechanism.joint_names:
            return Quantity("joint", joint, AXES.index(axis))
    # This raises the error that lists the names.
    motion[name if isinstance(name, str) else short(name)]
    raise AssertionError(name)  # pragma: no cover


def components(of: Quantity, order: int, values: Float, slopes: Float | None) -> list[Line]:
    """Return the components, and the magnitude of a joint's derivatives."""
    if of.kind != "joint":
        return [Line("", values, slopes)]
    axes: Sequence[int] = (0, 1) if of.axis is None else (of.axis,)
    lines = [
        Line(AXES[i], values[..., i], None if slopes is None else slopes[..., i]) for i in axes
    ]
    if order and of.axis is None:
        rate = None
        with in_range(f"the square of a derivative of {of.name!r}"), np.errstate(divide="ignore"):
            size = np.sqrt((values * values).sum(axis=-1))
            if slopes is not None:
                rate = (values * slopes).sum(axis=-1) / size
        lines.append(Line("v", size, rate))
    return lines
