"""Closure equations of designs, from the table of dimensions in conventions.md.

Every joint of a link must stand where the link's frame and dimensions put it, every guide and
driver must hold.  Works on whole batches, with any number of drivers, and with redundant links;
shares no code with `assur`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import NDArray

from models.mechanisms.mechanism_data import GROUND
from oracles.kinematics.agreement import POSITION, U
from oracles.kinematics.pair_jacobian import jacobian

if TYPE_CHECKING:
    import assur
    from models.mechanisms.mechanism_data import Description

Array: TypeAlias = NDArray[np.float64]
Complex: TypeAlias = NDArray[np.complex128]


@dataclass
class Places:
    """Positions as complex numbers, each of the shape S + (N,)."""

    joints: dict[str, Complex]
    angles: dict[str, Array]
    references: dict[str, Complex]  # of links without joints
    values: dict[str, Array]  # of slides

    @classmethod
    def of(cls, motion: assur.Motion, description: Description) -> Places:
        bare = [n for n, own in description.links.items() if n != GROUND and not own]

        def point(value: Array) -> Complex:
            where: Complex = value[..., 0] + 1j * value[..., 1]
            return where

        return cls(
            {n: point(motion.joint(n).value) for n in description.joints},
            {n: motion.link(n).value for n in description.links if n != GROUND},
            {n: point(motion.reference_points[n].value) for n in bare},
            {n: motion.slide(n).value for n in description.slides},
        )


class Closures:
    """The equations of a description with the dimensions of a mechanism or batch."""

    def __init__(self, description: Description, dimensions: dict[str, Array]) -> None:
        self.description = description
        self.dimensions = dimensions
        drawn = [complex(*p) for p in description.joints.values()]
        self.base = complex(*description.joints[description.links[GROUND][0]])
        self.drawn = max(abs(p - self.base) for p in drawn)
        rigid = {name: {name} for name in description.links}
        for slide in description.slides.values():
            both = rigid[slide.link] | rigid[slide.on]
            for name in both:
                rigid[name] = both
        self.rigid = rigid  # links that turn together

    def __getitem__(self, name: str) -> Array:
        """A dimension, to broadcast against S + (N,); 0 where the frame leaves it out."""
        return np.asarray(self.dimensions.get(name, 0.0))[..., np.newaxis]

    def directions(self, places: Places) -> dict[str, Complex]:
        """Unit vectors of the guides."""
        return {
            name: self.frame(places, slide.on) * np.exp(1j * self[f"{name}.angle"])
            for name, slide in self.description.slides.items()
        }

    def frame(self, places: Places, link: str) -> Complex:
        """The x axis of a link's frame."""
        angle = np.zeros(1) if link == GROUND else places.angles[link]
        return np.asarray(np.exp(1j * angle), np.complex128)

    def sliding_point(self, places: Places, link: str) -> Complex:
        own = self.description.links[link]
        return places.joints[own[0]] if own else places.references[link]

    def size(self, places: Places) -> Array:
        """The law's size: greatest extent from the ground's first joint, slides' values too."""
        far = [np.abs(p - self.base) for p in places.joints.values()]
        far += [np.abs(v) for v in places.values.values()]
        return np.asarray(np.maximum(np.max(far, axis=0), self.drawn))

    def misfit(self, motion: assur.Motion) -> tuple[Array, Array]:
        """Greatest misfit at every position in the law's 8 u κ of the size, and κ."""
        places = Places.of(motion, self.description)
        size, worst = self.size(places), np.zeros(motion.status.shape)
        for error in self._joints(places):
            np.maximum(worst, np.abs(error), out=worst)
        arms = self._arms(places, size)
        for error, arm in self._slides(places, arms):
            np.maximum(worst, np.abs(error) * arm, out=worst)
        for apart, arm in self._drivers(places, arms, motion):
            np.maximum(worst, np.abs(apart) * arm, out=worst)
        turned = [np.abs(angle) for angle in places.angles.values()]
        condition = np.asarray(motion.condition)
        # Angles count turns, and are rounded as such.
        law = POSITION * condition + U * np.max(turned, axis=0)
        return np.asarray(worst / (law * size)), condition

    def _joints(self, places: Places) -> list[Complex]:
        """Joints of links against the links' frames."""
        errors: list[Complex] = []
        for link, own in self.description.links.items():
            if link == GROUND:
                errors += [
                    places.joints[n] - (self[f"ground.{n}.x"] + 1j * self[f"ground.{n}.y"])
                    for n in own
                ]
                continue
            x = self.frame(places, link)
            for k, name in enumerate(own[1:]):
                at = self[f"{link}.{name}.x"] + 1j * self[f"{link}.{name}.y"]
                at = at if k else self[f"{link}.length"] + 0j
                errors.append(places.joints[name] - places.joints[own[0]] - x * at)
        return errors

    def _slides(self, places: Places, arms: dict[str, Array]) -> list[tuple[Complex, Array]]:
        """Guides: the sliding point's offset and value, and that the links turn together."""
        errors = []
        one = np.ones(1)
        along = self.directions(places)
        for name, slide in self.description.slides.items():
            base = places.joints[slide.origin] if slide.origin else self._origin(places, name)
            reach = np.conj(along[name]) * (self.sliding_point(places, slide.link) - base)
            errors.append((reach - places.values[name] - 1j * self[f"{name}.offset"], one))
            turned = along[name] * np.exp(-1j * self[f"{name}.link_angle"])
            apart = np.conj(turned) * self.frame(places, slide.link)
            arm = np.minimum(arms[slide.link], arms[slide.on])
            errors.append((np.angle(apart) + 0j, arm))
        return errors

    def _origin(self, places: Places, slide: str) -> Complex:
        """Where the value is 0, of a slide without a named origin."""
        on = self.description.slides[slide].on
        at = self[f"{slide}.origin.x"] + 1j * self[f"{slide}.origin.y"]
        if on == GROUND:
            return np.asarray(at, np.complex128)
        return self.sliding_point(places, on) + self.frame(places, on) * at

    def _drivers(
        self, places: Places, arms: dict[str, Array], motion: assur.Motion
    ) -> list[tuple[Array, Array]]:
        errors = []
        q = motion.q if np.ndim(motion.mechanism.q0) else motion.q[..., np.newaxis]
        for k, (kind, name, *other) in enumerate(self.description.drivers):
            if kind == "slide":
                errors.append((places.values[name] - q[..., k], np.ones(1)))
                continue
            relative = other[0] if other else GROUND
            apart = self.frame(places, name) * np.conj(self.frame(places, relative))
            error = np.angle(apart * np.exp(-1j * q[..., k]))
            errors.append((error, np.minimum(arms[name], arms[relative])))
        return errors

    def _arms(self, places: Places, size: Array) -> dict[str, Array]:
        """Extent of what turns with a link; the size if that is one point."""
        arms = {}
        for name, links in self.rigid.items():
            own = list(dict.fromkeys(j for n in sorted(links) for j in self.description.links[n]))
            gaps = [np.abs(places.joints[j] - places.joints[own[0]]) for j in own[1:]]
            arm = np.max(gaps, axis=0) if gaps and GROUND not in links else size
            arms[name] = np.where(arm > 0.0, arm, size)
        return arms

    def determinants(self, motion: assur.Motion) -> Array:
        """The Jacobian's determinant at every position; the size of it with redundant links."""
        places = Places.of(motion, self.description)
        rows = jacobian(self.description, places.joints, self.directions(places))
        if rows.shape[-1] == rows.shape[-2]:
            return np.asarray(np.linalg.det(rows))
        values = np.linalg.svd(np.nan_to_num(rows), compute_uv=False)
        return np.asarray(np.where(np.isnan(rows).any(axis=(-2, -1)), np.nan, values.prod(axis=-1)))
