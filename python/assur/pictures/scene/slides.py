"""Sliding pairs as they are drawn: a block on a guide, a rod in a sleeve, a cylinder.

Which of the two links is the block and which the guide does not matter to the motion. The block
is the link whose one joint lies on the axis; a link without joints is a rod.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from assur.pictures import sizes
from assur.pictures.scene.axis import Axis
from assur.pictures.scene.cylinders import cylinder_parts
from assur.pictures.scene.geometry import ON_LINE, about, at, left_of, unit_vector
from assur.pictures.scene.shapes import Hatching, Line, Stroke, Vertex

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from assur._arrays import Float
    from assur._faces import Mechanism
    from assur.pictures.scene.frames import Frames

# Length of a guide beyond the block at the ends of its stroke, px.
BEYOND = 8.0
# Length of a driven slide whose stroke is not known both ways, relative to the mechanism's size.
FREE_STROKE = 0.15


def _axis(
    frames: Frames,
    name: str,
    sliding: str,
    guide: str,
    block: Float,
    angle: Float,
    stroke: tuple[float, float] | None = None,
) -> Axis:
    """Follow the block along the guide; `angle` is the axis's at each position.

    `stroke`: how far it goes back and forth from the last position, if that is known.
    """
    row = int(np.flatnonzero(frames.is_known)[0])
    angles = tuple(float((angle - frames.angle(link))[row]) for link in (sliding, guide))
    seen = frames.seen_from(guide, frames.world(sliding, block))
    along = seen @ unit_vector(angles[1])
    off = float((seen @ left_of(angles[1]))[row])
    low, high = float(np.nanmin(along)), float(np.nanmax(along))
    if stroke is not None:
        low, high = (float(along[-1]) + end for end in stroke)
    return Axis(name, sliding, guide, block, (angles[0], angles[1]), low, high, off)


class Slides:
    """The sliding pairs of a mechanism."""

    def __init__(
        self,
        mechanism: Mechanism,
        frames: Frames,
        turning: frozenset[str],
        sliding: frozenset[str],
        strokes: Mapping[str, tuple[float, float]] | None = None,
    ) -> None:
        self._strokes = strokes or {}
        self._mechanism = mechanism
        self._frames = frames
        self._turning = turning
        self._sliding = sliding
        self._axes: dict[str, Axis] = {}

    @cached_property
    def _size(self) -> float:
        points = np.concatenate(list(self._frames.joints().values()))
        return float(np.ptp(points[np.isfinite(points[:, 0])], axis=0).max())

    @property
    def _near(self) -> float:
        return ON_LINE * self._size

    def parts(self) -> list[Line]:
        """Return the lines to draw."""
        return [part for name in self._mechanism.slides for part in self._of(name)]

    def axis(self, name: str) -> Axis:
        """Return the axis of a slide, with its sliding link as the block."""
        if name not in self._axes:
            self._axes[name] = self._found_axis(name)
        return self._axes[name]

    def _found_axis(self, name: str) -> Axis:
        slide = self._mechanism.slides[name]
        places = list(self._joints(slide.link).values())
        block = places[0] if places else np.zeros(2)
        stroke = self._strokes.get(name)
        axis = _axis(self._frames, name, slide.link, slide.on, block, self._angle(name), stroke)
        if name not in self._sliding or axis.low < axis.high:
            return axis
        # With several drivers the drawing shows no stroke.
        free = FREE_STROKE * self._size
        return replace(axis, low=axis.low - free, high=axis.high + free)

    def barrel_joint(self, name: str) -> Float | None:
        """Return the joint of the barrel if a slide is a cylinder."""
        axis = self.axis(name)
        held = self._joint_on(axis)
        return held if held is not None and self._is_cylinder(name, axis) else None

    def _angle(self, name: str) -> Float:
        """Return the direction of the guide at every position, rad."""
        guide_angle = float(self._mechanism.dimensions.get(f"{name}.angle", 0.0))
        return self._frames.angle(self._mechanism.slides[name].on) + guide_angle

    def _joints(self, link: str) -> dict[str, Float]:
        return self._frames.local[link]

    def _of(self, name: str) -> list[Line]:
        axis = self.axis(name)
        held = self._joint_on(axis)
        barrel = self.barrel_joint(name)
        if barrel is not None:
            return cylinder_parts(axis, barrel, name in self._sliding)
        if self._joints(axis.sliding):
            return self._block(axis)
        if axis.guide == "ground":
            return self._sleeve(axis)
        if held is not None:
            # The block is the link that has the joint; the other one is the rod through it.
            return self._block(
                _axis(self._frames, name, axis.guide, axis.sliding, held, self._angle(name))
            )
        return self._block(axis)

    def _joint_on(self, axis: Axis) -> Float | None:
        """Return the guide's only joint if it lies on the axis."""
        joints = list(self._joints(axis.guide).values())
        if axis.guide == "ground" or len(joints) != 1:
            return None
        off = float(joints[0] @ left_of(axis.angles[1])) - axis.off
        return joints[0] if abs(off) <= self._near else None

    def _is_cylinder(self, name: str, axis: Axis) -> bool:
        """Whether barrel and rod have a joint each, and nothing else."""
        pair = {axis.sliding, axis.guide}
        slides = [s for n, s in self._mechanism.slides.items() if n != name]
        return (
            len(self._joints(axis.sliding)) == 1
            and not any(pair & {s.link, s.on} for s in slides)
            and not pair & self._turning
        )

    def _block(self, axis: Axis) -> list[Line]:
        half = sizes.BLOCK_LENGTH / 2.0
        shape = _rectangle(sizes.BLOCK_LENGTH, sizes.BLOCK_WIDTH)
        name = f"slide {axis.name}"
        block = Stroke(
            axis.sliding,
            name,
            about(axis.block, axis.angles[0], shape),
            sizes.OUTLINE,
            closed=True,
            fill="canvas",
            floor=2,
        )
        beyond = half + BEYOND
        if axis.guide == "ground":
            return [*_ground_guide(axis, name, beyond, -sizes.BLOCK_WIDTH / 2.0), block]
        inside = about(axis.block, axis.angles[0], [(-half, 0.0), (half, 0.0)])
        middle = Stroke(axis.sliding, name, inside, 1.0, "second", dashes=(4.0, 3.0), floor=3)
        return [*self._moving_guide(axis, beyond), block, middle]

    def _moving_guide(self, axis: Axis, beyond: float) -> Iterator[Line]:
        """Draw a line along the axis, and what carries it."""
        angle = axis.angles[1]
        low, high = (axis.low, -beyond), (axis.high, beyond)
        off_axis: list[tuple[float, Float]] = []
        for joint in self._joints(axis.guide).values() or [np.zeros(2)]:
            along, off = float(joint @ unit_vector(angle)), float(joint @ left_of(angle)) - axis.off
            if abs(off) <= self._near:
                low, high = min(low, (along, 0.0)), max(high, (along, 0.0))
            else:
                off_axis.append((along, joint))
        name = f"link {axis.guide}"
        forward = unit_vector(angle)
        ends = tuple(at(axis.on_guide(along), *(forward * px)) for along, px in (low, high))
        driven = axis.guide in self._turning
        yield Stroke(axis.guide, name, ends, sizes.DRIVEN_BAR if driven else sizes.BAR)
        if off_axis and len(off_axis) == len(self._joints(axis.guide) or "1"):
            along, joint = min(
                off_axis, key=lambda aside: max(low[0] - aside[0], aside[0] - high[0], 0.0)
            )
            foot = axis.on_guide(min(max(along, low[0]), high[0]))
            yield Stroke(axis.guide, name, (at(joint), at(foot)), sizes.BAR)

    def _sleeve(self, axis: Axis) -> list[Line]:
        """Draw a rod of a link without joints in a sleeve on the ground."""
        name = f"slide {axis.name}"
        along = self._free_place(axis)
        middle = axis.on_guide(along)
        half = sizes.SLEEVE_LENGTH / 2.0
        parts: list[Line] = []
        for side in (1.0, -1.0):
            gap = side * sizes.SLEEVE_GAP / 2.0
            ends = about(middle, axis.angles[1], [(side * half, gap), (-side * half, gap)])
            parts.append(Stroke("ground", name, ends, 2.0, "ink"))
            # The wall is beyond the line.
            parts.append(Hatching("ground", name, ends[0], ends[1], sizes.GROUND_SPACING))
        direction = unit_vector(axis.angles[0])
        # The rod reaches from its reference point through the sleeve in every position.
        reaches = (min(along - axis.high, 0.0), max(along - axis.low, 0.0))
        rod = tuple(
            at(axis.block + reach * direction, *(sign * (half + 2.0 * BEYOND) * direction))
            for sign, reach in zip((-1.0, 1.0), reaches, strict=True)
        )
        return [*parts, Stroke(axis.sliding, f"link {axis.sliding}", rod, sizes.BAR)]

    def _free_place(self, axis: Axis) -> float:
        """Return where on its line a sleeve is clear of the ground's joints, if anywhere."""
        middle, stroke = (axis.low + axis.high) / 2.0, axis.high - axis.low
        joints = list(self._joints("ground").values())
        for along in (middle, axis.high, axis.low):
            if all(np.hypot(*(axis.on_guide(along) - joint)) > stroke / 4.0 for joint in joints):
                return along
        return middle


def _rectangle(length: float, width: float) -> list[tuple[float, float]]:
    a, b = length / 2.0, width / 2.0
    return [(-a, -b), (a, -b), (a, b), (-a, b)]


def _ground_guide(axis: Axis, name: str, beyond: float, below: float) -> list[Line]:
    """Draw a hatched line under the block: on the side that is down, or right if it is upright."""
    angle = axis.angles[1]
    left = left_of(angle)
    down = left[1] > 1e-9 or (abs(left[1]) <= 1e-9 and left[0] < 0.0)
    side = below if down else -below
    along = unit_vector(angle)

    def end(of: float, px: float) -> Vertex:
        return at(axis.on_guide(of), *(px * along + side * left))

    ends = [end(axis.low, -beyond), end(axis.high, beyond)]
    # Hatching lies on the right of its line.
    run = ends if side < 0.0 else ends[::-1]
    return [
        Stroke("ground", name, tuple(ends), sizes.GUIDE, "ink"),
        Hatching("ground", name, run[0], run[1], sizes.GUIDE_SPACING),
    ]
