"""The inverse question: where a coordinate has a value.

The coordinate drives in place of the driver, locked at the value; all assemblies of that mechanism
are the answers. Of a joint's x and y, sliders are added that carry it.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur._validate import real_array
from assur.description import encode
from assur.description.words import Slide
from assur.errors import InputError
from assur.kinematics.assembly import Assembly, Place
from assur.kinematics.extremes import coordinate
from assur.kinematics.pose import Pose, bare_core

if TYPE_CHECKING:
    from assur.description.encode import Description, DriverLike
    from assur.kinematics.assembly import AssemblyNumbers
    from assur.kinematics.mechanism import Mechanism

# Positions of the same assembly found in two ways, relative to the size.
SAME = 1e-6


def find(mechanism: Mechanism, name: str, value: Any) -> list[tuple[Any, Assembly]]:
    """See `Mechanism.find`."""
    if mechanism.shape:
        message = f"find() is for one design, this is a batch {mechanism.shape}: use design(i)"
        raise InputError(message)
    wanted = np.atleast_1d(real_array(value, "value"))
    drivers = mechanism._driver_count
    if drivers > 2 or wanted.shape != (drivers,) or not np.isfinite(wanted).all():
        need = "a finite number" if drivers == 1 else "finite numbers (x, y) of a joint"
        message = f"value is {value!r}: with {drivers} drivers {need} is needed"
        raise InputError(message)
    other, coordinates = _driven_by(mechanism, name, wanted)
    found = []
    for assembly in other.assemblies(coordinates):
        place = assembly._place
        assert place is not None
        found.append(_of_original(mechanism, place.numbers))
    known = [one for one in found if one is not None]
    return sorted(known, key=lambda one: np.ravel(one[0]).tolist())


def driven_by_joint(
    mechanism: Mechanism, joint: str, held: list[DriverLike]
) -> tuple[Mechanism, tuple[float, float]]:
    """Return the design driven by a joint's x and y before other drivers, and both in the drawing.

    They are measured from there, m.
    """
    description, drawn = _with_cross_slide(mechanism._description, joint, "xy")
    description = description._replace(drivers=(*description.drivers, *held))
    return _redriven(mechanism, description), (drawn[0], drawn[1])


def _driven_by(
    mechanism: Mechanism, name: str, wanted: Any
) -> tuple[Mechanism, float | list[float]]:
    """Return the design driven by a coordinate, and the driver's coordinate of the value."""
    own = mechanism._description
    if mechanism._driver_count == 1 and "." not in name:
        coordinate(mechanism, name)
        description = own._replace(drivers=encode.drivers(name), assembly=())
        return _redriven(mechanism, description), float(wanted[0])
    joint, dot, axis = name.rpartition(".")
    if mechanism._driver_count == 1:
        coordinate(mechanism, name)
    else:
        joint, axis = name if not dot else joint, "xy"
        mechanism._core.require("joint", joint)
    description, drawn = _with_cross_slide(own, joint, axis)
    steps = [float(value - start) for value, start in zip(wanted, drawn, strict=False)]
    return _redriven(mechanism, description), steps[0] if len(steps) == 1 else steps


def _redriven(mechanism: Mechanism, description: Description) -> Mechanism:
    """Return the design with another description, whose drawing need not show an assembly."""
    core = bare_core(description)
    own = dict(zip(mechanism._core.dimension_names, mechanism._values.tolist(), strict=True))
    drawn = zip(core.dimension_names, core.drawing, strict=True)
    values = np.array([own.get(name, value) for name, value in drawn])
    return mechanism._make(description, values, core)


def _with_cross_slide(
    own: Description, joint: str, axes: str
) -> tuple[Description, tuple[float, ...]]:
    """Return a description driven by a joint's x, y or both, and their values in the drawing."""
    at = {key: (x, y) for key, x, y in own.joints}[joint]
    taken = {one[0] for kind in (own.joints, own.links, own.slides) for one in kind}
    words = ("cross", "block", "along", "across", "centre")
    cross, block, along, across, centre = (_free(word, taken) for word in words)
    # A cross-slide moves along x, and a block on it along y, pinned at the joint.
    first = axes != "y"
    way, other = (0.0, 0.5 * np.pi) if first else (0.5 * np.pi, 0.0)
    slides = (
        (along, Slide(cross, on="ground", angle=way)),
        (across, Slide(block, on=cross, angle=other, origin=centre)),
    )
    links = ((cross, (centre,)), (block, (joint,)))
    drawn = (at[0], at[1]) if first else (at[1], at[0])
    drivers = (along,) if len(axes) == 1 else (along, across)
    description = own._replace(
        joints=(*own.joints, (centre, *at)),
        links=(*own.links, *links),
        slides=(*own.slides, *slides),
        drivers=drivers,
        assembly=(),
    )
    return description, drawn


def _free(word: str, taken: set[str]) -> str:
    while word in taken:
        word += "_"
    taken.add(word)
    return word


def _of_original(mechanism: Mechanism, numbers: AssemblyNumbers) -> tuple[Any, Assembly] | None:
    """Return the coordinate and assembly of a pose that was found with another driver."""
    links, slides = len(mechanism.links), len(mechanism.slides)
    pose = Pose.found(numbers)
    core = bare_core(mechanism._description)
    joints = pose.joints[: len(mechanism._joint_names)]
    q, own = core.at_pose(joints, pose.angles[:links], pose.slides[:slides])
    drivers = mechanism._description.drivers
    is_angle = [not isinstance(one, str) or one not in mechanism.slides for one in drivers]
    reduced = [
        float(x - np.ceil((x - np.pi) / (2.0 * np.pi)) * 2.0 * np.pi) if angle else x
        for x, angle in zip(q, is_angle, strict=True)
    ]
    place = Place(mechanism, tuple(reduced), own)
    coordinates = reduced[0] if len(reduced) == 1 else np.array(reduced)
    if place.is_traced:
        return coordinates, Assembly._found(place, ())
    size = float(np.ptp(np.array(own["joints"]), axis=0).max())
    for assembly in mechanism.assemblies(coordinates):
        assert assembly._place is not None
        there = np.array(assembly._place.numbers["joints"])
        if np.abs(there - np.array(own["joints"])).max() <= SAME * size:
            return coordinates, assembly
    return None
