"""Poses, and mechanisms that are drawn in them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from assur import _core
from assur.description.words import is_reached
from assur.kinematics.model import Place, at_place
from assur.kinematics.request import at_position

if TYPE_CHECKING:
    from assur.description.encode import Description
    from assur.kinematics.model import AnyMechanism, AssemblyNumbers


@dataclass(frozen=True, slots=True)
class Pose:
    """Where everything is at one position: joints, m, angles of links, rad, values of slides, m."""

    joints: list[tuple[float, float]]
    angles: list[float]
    slides: list[float]

    @classmethod
    def found(cls, numbers: AssemblyNumbers) -> Pose:
        """Return the pose in which an assembly was found."""
        return cls(numbers["joints"], numbers["angles"], numbers["slides"])


def bare_core(description: Description) -> _core.Mechanism:
    """Compile a description whose drawing need not show the assembly."""
    return _core.Mechanism.for_pose(
        list(description.joints),
        [(name, list(on)) for name, on in description.links],
        list(description.slides),
        list(description.drivers),
    )


def drawn_at(mechanism: AnyMechanism, description: Description, pose: Pose) -> AnyMechanism:
    """Return a design with another description (of its drivers), drawn in a pose."""
    bare = bare_core(description)
    q, numbers = bare.at_pose(pose.joints, pose.angles, pose.slides)
    names = (name for name, _ in bare.assembly)
    signs = tuple(zip(names, numbers["signs"], strict=True))
    plain = mechanism._make(description._replace(assembly=signs), np.array(mechanism.values))
    core = plain.core.drawn_in(plain.values.tolist(), q, numbers)
    return at_place(plain, Place(plain, tuple(q), numbers), core)


def with_signs(mechanism: AnyMechanism, place: Place, signs: list[int]) -> AnyMechanism:
    """Return a mechanism that is drawn at a place, with other signs of its dyads there."""
    drawn = place.mechanism
    numbers: AssemblyNumbers = {**place.numbers, "signs": signs, "is_double": False}
    core = drawn.core.drawn_in(drawn.values.tolist(), list(place.q), numbers)
    turned = Place(drawn, place.q, numbers)
    arrays, status = at_position(at_place(drawn, turned, core), place.q)
    if is_reached(status):
        # The joints of the place move with the signs.
        joints = [arrays.joints[name][0].tolist() for name in drawn.joint_names]
        numbers["joints"] = [(x, y) for x, y in joints]
        numbers["angles"] = [float(arrays.links[name][0]) for name in drawn.links]
    return at_place(mechanism, turned, core)


def in_signs(mechanism: AnyMechanism, signs: list[int]) -> AnyMechanism:
    """Return a mechanism drawn with these signs of all its dyads."""
    if signs == mechanism.signs:
        return mechanism
    if mechanism.place is not None:
        return with_signs(mechanism, mechanism.place, signs)
    named = zip((name for name, _ in mechanism.core.assembly), signs, strict=True)
    description = mechanism.description._replace(assembly=tuple(named))
    return mechanism._make(description, np.array(mechanism.values))._moved_as(mechanism)
