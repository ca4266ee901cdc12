"""One link as a part: outline, holes, slots, dimensions between the holes, in its own frame."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from assur.pictures.drawing.marks import (
    NAME_HEIGHT,
    Circle,
    Diameter,
    Distance,
    Mark,
    Outline,
    Text,
    bounds,
)
from assur.pictures.drawing.names import name_marks
from assur.pictures.drawing.outline import centre_mark, rectangle, rounded_hull
from assur.pictures.scene.cylinders import cylinder
from assur.pictures.scene.geometry import left_of, unit_vector

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.pictures.scene.axis import Axis
    from assur.pictures.scene.frames import Frames
    from assur.pictures.scene.slides import Slides

MM = 1000.0
# Blocks and slots, relative to the width of links; a barrel, a rod.
BLOCK_LENGTH, SLOT = 1.2, 0.6
BARREL, ROD = 1.0, 0.3
# From the outline to the first dimension line, and from line to line, mm of the paper.
FIRST, NEXT = 9.0, 8.0
# Distances below this fraction of the link's size are 0.
NEAR = 1e-9


@dataclass(frozen=True, eq=False)
class Workshop:
    """The settings by which parts are made.

    `width` and `hole` are mm, `per` is the length of a mm of the paper; `layers` has the layer of
    each link.
    """

    frames: Frames
    slides: Slides
    names: tuple[str, ...]
    pins: frozenset[str]
    width: float
    hole: float
    per: float
    layers: dict[str, str]
    dimensions: dict[str, float]
    origins: dict[str, str | None]


def joints_of(shop: Workshop, link: str) -> dict[str, Float]:
    """Return the joints of a link in its frame, mm; the ground's from its first joint."""
    places = shop.frames.local[link]
    base = next(iter(places.values()), np.zeros(2)) if link == "ground" else np.zeros(2)
    return {joint: MM * (at - base) for joint, at in places.items()}


def part_marks(shop: Workshop, link: str) -> list[Mark]:
    """Return the outline of a link with its holes and slots."""
    layer = shop.layers[link]
    joints = joints_of(shop, link)
    shapes, along = _slide_shapes(shop, link)
    corners = [*joints.values(), *along]
    barrels = [name for name in shop.names if _cylinder_role(shop, name, link) is not None]
    marks: list[Mark] = []
    blocks = [mark for mark in shapes if isinstance(mark, Outline)]
    # A block with one hole is that block; barrels and rods end in an eye.
    alone = len(corners) == 1 and bool(blocks) and not barrels
    if corners and not alone:
        marks.append(rounded_hull(layer, np.array(corners), shop.width / 2.0))
    marks += shapes
    for joint, at in joints.items():
        if joint in shop.pins:
            marks.append(Circle(layer, at, shop.hole / 2.0))
        marks += centre_mark("CENTRES", at, shop.hole / 2.0)
    return marks


def link_drawing(shop: Workshop, link: str) -> list[Mark]:
    """Return a part with its dimensions and names."""
    marks = part_marks(shop, link)
    joints = joints_of(shop, link)
    per = shop.per
    low, high = bounds(marks, per)
    middle = float(low[0] + high[0]) / 2.0
    if joints:
        marks += _hole_dimensions(joints, low, per)
    marks += _slide_dimensions(shop, link)
    holes = [at for joint, at in joints.items() if joint in shop.pins]
    if holes:
        corner = max(holes, key=lambda at: float(at.sum()))
        size = shop.hole / 2.0
        marks.append(Diameter("DIMENSIONS", corner, size, np.pi / 4.0, len(holes)))
    points = np.array(list(joints.values())).reshape(-1, 2)
    radii = np.full(len(points), shop.width / 2.0 / per)
    marks += name_marks(list(joints), points, radii, marks, per)
    low, _ = bounds(marks, per)
    under = np.array([middle, low[1] - 2.5 * NAME_HEIGHT * per])
    marks.append(Text("TEXT", under, link, NAME_HEIGHT, "below"))
    return marks


def _hole_dimensions(joints: dict[str, Float], low: Float, per: float) -> list[Mark]:
    """Return x of every hole below the outline and y on its left, the shortest nearest to it."""
    first, *further = joints.values()
    size = max((float(np.abs(at - first).max()) for at in further), default=0.0)
    marks: list[Mark] = []
    for axis, angle in ((0, 0.0), (1, np.pi / 2.0)):
        far = [at for at in further if abs(at[axis] - first[axis]) > NEAR * size]
        for i, at in enumerate(sorted(far, key=lambda at: abs(float(at[axis] - first[axis])))):
            base = low - (FIRST + NEXT * i) * per
            marks.append(Distance("DIMENSIONS", first, at, base, angle))
    return marks


def _slides_of(shop: Workshop, link: str) -> list[tuple[str, Axis]]:
    axes = [(name, shop.slides.axis(name)) for name in shop.names]
    return [(name, axis) for name, axis in axes if link in (axis.sliding, axis.guide)]


def _cylinder_role(shop: Workshop, name: str, link: str) -> str | None:
    """Return whether a link is the barrel or the rod of a slide."""
    if shop.slides.barrel_joint(name) is None:
        return None
    axis = shop.slides.axis(name)
    return "barrel" if link == axis.guide else "rod" if link == axis.sliding else None


def _slide_shapes(shop: Workshop, link: str) -> tuple[list[Mark], list[Float]]:
    """Return blocks, slots, barrels and rods of a link, and points that its outline goes round."""
    layer, width = shop.layers[link], shop.width
    shapes: list[Mark] = []
    around: list[Float] = []
    for name, axis in _slides_of(shop, link):
        role = _cylinder_role(shop, name, link)
        if role is not None:
            shapes.append(_cylinder_part(shop, name, axis, role, layer))
            continue
        half = BLOCK_LENGTH * width / 2.0
        if link == axis.sliding:
            unit = unit_vector(axis.angles[0])
            block, reach = MM * axis.block, half
            if not shop.frames.local[link]:
                # A rod without joints is as long as its stroke, and a block's length.
                reach += MM * (axis.high - axis.low) / 2.0
            shapes.append(
                rectangle(layer, block - reach * unit, block + reach * unit, SLOT * width)
            )
            continue
        unit = unit_vector(axis.angles[1])
        low, high = (MM * (axis.on_guide(at) - _base(shop, link)) for at in (axis.low, axis.high))
        low, high = low - half * unit, high + half * unit
        shapes.append(rectangle(layer, low, high, SLOT * width))
        around += [low, high]
    return shapes, around


def _base(shop: Workshop, link: str) -> Float:
    """Return the origin of a link's drawing in its frame, m."""
    places = shop.frames.local[link]
    return next(iter(places.values()), np.zeros(2)) if link == "ground" else np.zeros(2)


def _cylinder_part(shop: Workshop, name: str, axis: Axis, role: str, layer: str) -> Mark:
    joint = shop.slides.barrel_joint(name)
    assert joint is not None
    drawn = cylinder(axis, joint)
    if role == "barrel":
        start = MM * joint + drawn.forward * shop.width / 2.0
        end = MM * (joint + drawn.barrel * drawn.forward)
        return rectangle(layer, start, end, BARREL * shop.width)
    start = MM * axis.block - drawn.rod_forward * shop.width / 2.0
    return rectangle(
        layer, start, MM * (axis.block - drawn.rod * drawn.rod_forward), ROD * shop.width
    )


def _slide_dimensions(shop: Workshop, link: str) -> list[Mark]:
    """Return the stroke along a slot, and the distance of its line from the joint it is from."""
    marks: list[Mark] = []
    size = MM * float(np.ptp(np.concatenate(list(shop.frames.joints().values())), axis=0).max())
    for name, axis in _slides_of(shop, link):
        if link != axis.guide or _cylinder_role(shop, name, link) is not None:
            continue
        base, angle = _base(shop, link), axis.angles[1]
        low, far = (MM * (axis.on_guide(at) - base) for at in (axis.low, axis.high))
        left = left_of(angle)
        side = left if left @ np.array([0.1, 1.0]) >= 0.0 else -left
        beside = low + side * (shop.width / 2.0 + FIRST * shop.per)
        if MM * (axis.high - axis.low) > NEAR * size:
            marks.append(Distance("DIMENSIONS", low, far, beside, angle))
        origin = shop.origins.get(name)
        offset = MM * shop.dimensions.get(f"{name}.offset", 0.0)
        if origin is not None and abs(offset) > NEAR * size:
            at = joints_of(shop, link)[origin]
            # Beyond the joint, away from the slot.
            forward = unit_vector(angle)
            away = -forward if (low + far - 2.0 * at) @ forward > 0.0 else forward
            beyond = at + away * (shop.width / 2.0 + FIRST * shop.per)
            foot = at + left * float((low - at) @ left)
            marks.append(Distance("DIMENSIONS", at, foot, beyond, angle + np.pi / 2.0))
    return marks
