"""Mechanisms driven otherwise from a position on: the position and its assembly are kept."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from assur import _core
from assur.description.words import Status
from assur.errors import InputError, StructureError
from assur.kinematics.assembly import Place

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur.description.encode import Description, DriverLike
    from assur.kinematics.assembly import AssemblyNumbers
    from assur.kinematics.mechanism import Mechanism


@dataclass(frozen=True, slots=True)
class Pose:
    """Where everything is at one position: joints, m, angles of links, rad, values of slides, m."""

    joints: list[tuple[float, float]]
    angles: list[float]
    slides: list[float]

    @classmethod
    def of(cls, mechanism: Mechanism, q: npt.ArrayLike) -> Pose:
        """Return the pose of one design at a coordinate."""
        if mechanism.shape:
            message = (
                f"with_driver(q=...) is for one design, this is a batch {mechanism.shape}: "
                "take one with design(i)"
            )
            raise InputError(message)
        motion = mechanism.solve(q, order=0)
        if motion.shape:
            message = f"q has shape {motion.shape}: one position is needed"
            raise InputError(message)
        joints = [motion.joint(name).value.tolist() for name in mechanism.joint_names]
        return cls(
            [(x, y) for x, y in joints],
            [float(motion.link(name).value) for name in mechanism.links],
            [float(motion.slide(name).value) for name in mechanism.slides],
        )

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


def drawn_at(mechanism: Mechanism, description: Description, pose: Pose) -> Mechanism:
    """Return a design with another description (of its drivers), drawn in a pose."""
    bare = bare_core(description)
    q, numbers = bare.at_pose(pose.joints, pose.angles, pose.slides)
    names = (name for name, _ in bare.assembly)
    signs = tuple(zip(names, numbers["signs"], strict=True))
    plain = mechanism._make(description._replace(assembly=signs), np.array(mechanism.values))
    core = plain.core.drawn_in(plain.values.tolist(), q, numbers)
    return plain._drawn_at(Place(plain, tuple(q), numbers), core)


def with_signs(mechanism: Mechanism, place: Place, signs: list[int]) -> Mechanism:
    """Return a mechanism that is drawn at a place, with other signs of its dyads there."""
    own = place.mechanism
    q, values = list(place.q), own.values.tolist()
    numbers: AssemblyNumbers = {**place.numbers, "signs": signs, "is_double": False}
    core = own.core.drawn_in(values, q, numbers)
    found = Place(own, place.q, numbers)
    motion = own._drawn_at(found, core).solve(q[0] if len(q) == 1 else q, order=0, on_error="nan")
    if motion.status < Status.UNREACHABLE:
        # The joints of the place move with the signs.
        joints = [motion.joint(name).value.tolist() for name in own.joint_names]
        numbers["joints"] = [(x, y) for x, y in joints]
        numbers["angles"] = [float(motion.link(name).value) for name in own.links]
    return mechanism._drawn_at(found, core)


def redrive(
    mechanism: Mechanism,
    drivers: tuple[DriverLike, ...],
    signs: tuple[tuple[str, int], ...],
    q: npt.ArrayLike | None,
) -> Mechanism:
    """See `Mechanism.with_driver`."""
    description = mechanism.description._replace(drivers=drivers, assembly=signs)
    if q is None and mechanism.place is None:
        try:
            return mechanism._make(description, np.array(mechanism.values))
        except StructureError as error:
            # The drawing of a named mechanism has other dimensions than its design.
            if mechanism.shape or error.kind != "flat_dyad" or mechanism._is_as_drawn:
                raise
    if q is None:
        q = mechanism.q0
    return drawn_at(mechanism, description, Pose.of(mechanism, q))
