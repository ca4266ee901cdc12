"""The configuration of a mechanism as one vector, by which assemblies are compared."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur._trig import sin_cos
from assur.description.dotted_names import is_angle, split_name

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.kinematics.model import AssemblyNumbers, MechanismModel
    from assur.kinematics.motion_model import MotionModel


def place_vector(joints: Float, angles: Float, slides: Float, size: float) -> Float:
    """Return joints (…, J, 2), unit vectors of links (…, L) and slides (…, K), in sizes: (…, n).

    Joints alone do not distinguish assemblies: a link of one joint may point either way.
    """
    sine, cosine = sin_cos(angles)
    flat = joints.reshape((*joints.shape[:-2], -1)) / size
    return np.concatenate([flat, sine, cosine, slides / size], axis=-1)


def place_of(numbers: AssemblyNumbers, size: float) -> Float:
    """Return the place of an assembly as the core knows it."""
    joints, angles = np.array(numbers["joints"]), np.array(numbers["angles"])
    return place_vector(joints, angles, np.array(numbers["slides"]), size)


def places_along(motion: MotionModel, size: float) -> Float:
    """Return the places of a motion of one design, shape (…, n)."""
    mechanism = motion.mechanism
    shape = motion.shape

    def stacked(values: list[Float], axis: int, tail: tuple[int, ...] = ()) -> Float:
        return np.stack(values, axis=axis) if values else np.empty((*shape, 0, *tail))

    return place_vector(
        stacked([motion.joint(name).value for name in mechanism.joint_names], -2, (2,)),
        stacked([motion.link(name).value for name in mechanism.links], -1),
        stacked([motion.slide(name).value for name in mechanism.slides], -1),
        size,
    )


def nearest(places: Float, place: Float) -> float:
    """Return the distance to the nearest of some places, in sizes; infinite without any.

    What is farther away than a size, near a joint at infinity, is compared relative to its
    distance.
    """
    if not len(places):
        return float("inf")
    apart = (np.abs(places - place) / np.maximum(np.abs(place), 1.0)).max(axis=1)
    return float(np.where(np.isnan(apart), np.inf, apart).min())


def lengths(mechanism: MechanismModel, drawn: bool = False) -> list[float]:
    """Return the lengths of one design, wherever it stands: distances, not places on the ground.

    Or those of the drawing.
    """
    description = mechanism.description
    free = {
        name for name, slide in description.slides if slide.on == "ground" and slide.origin is None
    }
    sizes: list[float] = []
    fixed: dict[str, list[float]] = {"x": [], "y": []}
    values = mechanism.core.drawing if drawn else mechanism.values.tolist()
    for name, value in zip(mechanism.core.dimension_names, values, strict=True):
        item, component = split_name(name)
        if item.startswith("ground."):
            fixed[component].append(value)
        elif not is_angle(name) and not (component == "offset" and item in free):
            sizes.append(abs(value))
    return [*sizes, *(max(axis) - min(axis) for axis in fixed.values() if axis)]


def size_of(mechanism: MechanismModel, drawn: bool = False) -> float:
    """Return the size of one design, or of its drawing, as an order of magnitude, m."""
    known = [length for length in lengths(mechanism, drawn) if np.isfinite(length)]
    at = np.array([point for _, *point in mechanism.description.joints])
    width = float(np.ptp(at, axis=0).max()) if len(at) else 0.0
    return max(known, default=0.0) or width or 1.0
