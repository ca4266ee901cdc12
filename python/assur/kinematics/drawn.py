"""Mechanisms drawn elsewhere: in another assembly, at another position with other drivers."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur.errors import InputError, StructureError
from assur.kinematics.assembly import drawn_in
from assur.kinematics.pose import Pose, drawn_at, in_signs
from assur.kinematics.solve import solve
from assur.kinematics.solve_arguments import checked_assembly

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy.typing as npt

    from assur.description.words import DriverLike
    from assur.kinematics.model import AnyMechanism, MechanismModel


def in_assembly(mechanism: AnyMechanism, assembly: Mapping[str, int] | None) -> AnyMechanism:
    """Return a mechanism drawn in an assembly, itself in its own."""
    if assembly is None:
        return mechanism
    drawn = drawn_in(mechanism, assembly)
    if drawn is not mechanism:
        return drawn
    return in_signs(mechanism, checked_assembly(mechanism, assembly))


def redrive(
    mechanism: AnyMechanism,
    drivers: tuple[DriverLike, ...],
    signs: tuple[tuple[str, int], ...],
    q: npt.ArrayLike | None,
) -> AnyMechanism:
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
    return drawn_at(mechanism, description, _pose_at(mechanism, q))


def _pose_at(mechanism: MechanismModel, q: npt.ArrayLike) -> Pose:
    """Return the pose of one design at a coordinate."""
    if mechanism.shape:
        message = (
            f"with_driver(q=...) is for one design, this is a batch {mechanism.shape}: "
            "take one with design(i)"
        )
        raise InputError(message)
    motion = solve(mechanism, q, order=0, from_user=True)
    if motion.shape:
        message = f"q has shape {motion.shape}: one position is needed"
        raise InputError(message)
    joints = [motion.joint(name).value.tolist() for name in mechanism.joint_names]
    return Pose(
        [(x, y) for x, y in joints],
        [float(motion.link(name).value) for name in mechanism.links],
        [float(motion.slide(name).value) for name in mechanism.slides],
    )
