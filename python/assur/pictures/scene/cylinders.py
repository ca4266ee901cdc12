"""Cylinders: a barrel on one joint, a rod with its piston on the other."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from assur.pictures import sizes
from assur.pictures.scene.geometry import at, unit_vector
from assur.pictures.scene.shapes import Colour, Line, Stroke

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.pictures.scene.axis import Axis

# The barrel, relative to the least length; how far the piston stays from its ends.
BARREL_OF_LEAST, CLEARANCE = 0.86, 0.07
# Between the joint and the barrel, px.
EYE = 9.0


@dataclass(frozen=True, eq=False)
class Cylinder:
    """Barrel and rod, true to length: within the stroke the piston stays in the barrel.

    `forward` is the direction from the barrel's joint to the rod's in the barrel's frame,
    `rod_forward` in the rod's; `barrel` and `rod` are lengths, m.
    """

    forward: Float
    rod_forward: Float
    barrel: float
    rod: float


def cylinder(axis: Axis, base: Float) -> Cylinder:
    """Return the barrel and the rod of a slide; `base` is the joint of the barrel."""
    angle = axis.angles[1]
    along = unit_vector(angle)
    start = float(base @ along)
    # From the barrel's joint to the rod's: forward or backward along the guide.
    low, high = sorted((abs(axis.low - start), abs(axis.high - start)))
    if (axis.low - start) * (axis.high - start) < 0.0:
        low = 0.0
    forward = along if axis.low + axis.high > 2.0 * start else -along
    rod_forward = _same_way(axis, forward, along)
    barrel = BARREL_OF_LEAST * (low or high)
    # Within a stroke longer than the barrel the piston leaves it at the far end.
    rod = min(high - (1.0 - CLEARANCE) * barrel, max(low - CLEARANCE * barrel, 0.0))
    return Cylinder(forward, rod_forward, barrel, rod)


def cylinder_parts(axis: Axis, base: Float, driven: bool) -> list[Line]:
    """Draw a cylinder."""
    drawn = cylinder(axis, base)
    forward, rod_forward, barrel, rod = drawn.forward, drawn.rod_forward, drawn.barrel, drawn.rod
    colour: Colour = "driver" if driven else "link"
    left = np.array([-forward[1], forward[0]])
    name = f"slide {axis.name}"
    half = sizes.BARREL / 2.0
    ends = [(0.0, EYE, -half), (barrel, 0.0, -half), (barrel, 0.0, half), (0.0, EYE, half)]
    outline = tuple(
        at(base + length * forward, *(px * forward + across * left)) for length, px, across in ends
    )
    eye = (at(base), at(base, *(EYE * forward)))
    rod_left = np.array([-rod_forward[1], rod_forward[0]])
    piston = axis.block - rod * rod_forward
    reach = half - 2.0
    return [
        Stroke(axis.guide, name, eye, sizes.BAR, colour),
        Stroke(axis.guide, name, outline, sizes.OUTLINE, colour, closed=True, fill="tint", floor=2),
        Stroke(axis.sliding, name, (at(piston), at(axis.block)), sizes.ROD, colour, floor=3),
        Stroke(
            axis.sliding,
            name,
            (at(piston, *(-reach * rod_left)), at(piston, *(reach * rod_left))),
            sizes.PISTON,
            colour,
            floor=3,
        ),
    ]


def _same_way(axis: Axis, forward: Float, along: Float) -> Float:
    """Return the direction from barrel to rod in the rod's frame."""
    angle = axis.angles[0]
    sign = 1.0 if float(forward @ along) > 0.0 else -1.0
    return sign * unit_vector(angle)
