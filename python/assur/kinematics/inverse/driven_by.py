"""A mechanism driven by a coordinate of it, in place of its drivers.

For a joint's x or y, added slides carry the joint.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur._core import Inverse
from assur.description import encode
from assur.description.dotted_names import split_name
from assur.description.words import Slide
from assur.errors import InputError, StructureError
from assur.kinematics.configuration import size_of
from assur.kinematics.extremes import checked_coordinate
from assur.kinematics.pose import bare_core
from assur.kinematics.solve import solve

if TYPE_CHECKING:
    from assur._core import Mechanism as Core
    from assur.description.encode import Description
    from assur.description.words import DriverLike
    from assur.kinematics.model import MechanismModel

# Most inverses that a mechanism keeps.
MOST_KEPT = 64


def inverse_of(mechanism: MechanismModel, names: tuple[str, ...]) -> Inverse:
    """Return what a mechanism is when coordinates drive it: made once for all its designs."""
    known = mechanism.inverses.get(names)
    if known is None:
        known = _inverse(mechanism, names)
        if len(mechanism.inverses) >= MOST_KEPT:
            mechanism.inverses.clear()
        mechanism.inverses[names] = known
    return known


def _inverse(mechanism: MechanismModel, names: tuple[str, ...]) -> Inverse:
    description = mechanism.description
    axes_of: dict[str, str] = {}
    for name in names:
        checked_coordinate(mechanism, name)
        if "." in name:
            joint, axis = split_name(name)
            axes_of[joint] = "".join(sorted(axes_of.get(joint, "") + axis))
    # What drives instead, by the coordinate's name.
    drivers: dict[str, DriverLike] = {}
    bases: dict[str, str] = {}
    for joint, axes in axes_of.items():
        description = _with_cross_slide(description, joint, axes)
        base = _base(description)
        for axis, driver in zip(axes, description.drivers, strict=True):
            drivers[f"{joint}.{axis}"] = driver
            bases[f"{joint}.{axis}"] = f"ground.{base}.{axis}"
    for name in names:
        if "." not in name:
            (drivers[name],) = encode.drivers(name)
    description = description._replace(drivers=tuple(drivers[name] for name in names), assembly=())
    core = _compiled(mechanism, description, names)
    return Inverse(mechanism.core, core, list(names), [bases.get(name) for name in names])


def driven_by_joint(
    mechanism: MechanismModel, joint: str, held: list[DriverLike]
) -> tuple[MechanismModel, tuple[float, float]]:
    """Return the design driven by a joint's x and y before other drivers, and where both are 0."""
    description = _with_cross_slide(_to_size(mechanism), joint, "xy")
    description = description._replace(drivers=(*description.drivers, *held))
    inverse = _redriven(mechanism, description, (f"{joint}.x", f"{joint}.y"))
    base, values = _base(description), inverse.dimensions
    return inverse, (float(values[f"ground.{base}.x"]), float(values[f"ground.{base}.y"]))


def _redriven(
    mechanism: MechanismModel, description: Description, names: tuple[str, ...]
) -> MechanismModel:
    """Return the design with another description, whose drawing need not show an assembly."""
    core = _compiled(mechanism, description, names)
    known = dict(zip(mechanism.core.dimension_names, mechanism.values.tolist(), strict=True))
    drawn = zip(core.dimension_names, core.drawing, strict=True)
    values = np.array([known.get(name, value) for name, value in drawn])
    return mechanism._make(description, values, core)


def _compiled(mechanism: MechanismModel, description: Description, names: tuple[str, ...]) -> Core:
    """Compile a description that coordinates drive."""
    try:
        return bare_core(description)
    except StructureError as error:
        joints = list(dict.fromkeys(split_name(name)[0] for name in names if "." in name))
        if len(names) == 1 and not joints:
            if error.kind != "cannot_drive":
                raise
            raise _does_not_change(mechanism, names[0]) from error
        shown = joints[0] if len(joints) == 1 and len(names) == 2 else " and ".join(names)
        why = "they do not determine the position"
        if len(joints) == 1:
            why = "the joint moves along a curve only, or not without other drivers"
        for joint in joints:
            if joint in mechanism.links.get("ground", ()):
                why = f"joint {joint!r} is on the ground and does not move"
        raise InputError(f"{shown!r} cannot be set: {why}") from error


def _does_not_change(mechanism: MechanismModel, name: str) -> InputError:
    """Return the error for a link's angle or a slide's value that is the same in all positions."""
    motion = solve(mechanism, mechanism.q0, order=0, on_error="nan")
    is_slide = name in mechanism.slides
    value = float((motion.slide(name) if is_slide else motion.link(name)).value)
    what, unit = ("value of slide", "m") if is_slide else ("angle of link", "rad")
    kept = f" (it is {value:.6g} {unit})" if np.isfinite(value) else ""
    message = f"{name!r} cannot be set: the {what} {name!r} does not change{kept}"
    return InputError(message, slide=name) if is_slide else InputError(message, link=name)


def _to_size(mechanism: MechanismModel) -> Description:
    """Return the drawing in the size of the design: positions are followed from there."""
    drawing = mechanism.description
    ratio = size_of(mechanism) / size_of(mechanism, drawn=True)
    if 0.5 <= ratio <= 2.0:
        return drawing
    return drawing._replace(
        joints=tuple((name, x * ratio, y * ratio) for name, x, y in drawing.joints)
    )


def _base(description: Description) -> str:
    """Return the ground's joint from which a cross-slide is measured."""
    origins = (slide.origin for _, slide in description.slides[-2:] if slide.on == "ground")
    return next(origin for origin in origins if origin is not None)


def _with_cross_slide(drawing: Description, joint: str, axes: str) -> Description:
    """Return a description driven by a joint's x, y or both, from a joint of the ground on.

    The slide of the first axis carries that of the other.
    """
    at = {key: (x, y) for key, x, y in drawing.joints}
    taken = {item[0] for kind in (drawing.joints, drawing.links, drawing.slides) for item in kind}
    words = ("cross", "block", "along", "across", "centre", "base")
    cross, block, along, across, centre, base = (_free(word, taken) for word in words)
    joints, links = list(drawing.joints), dict(drawing.links)
    grounded = links.setdefault("ground", ())
    if grounded:
        base = grounded[0]
    else:
        joints.append((base, 0.0, 0.0))
        at[base], links["ground"] = (0.0, 0.0), (base,)
    # A cross-slide moves along x from the base, and a block on it along y, pinned at the joint.
    first = axes != "y"
    way, square = (0.0, 0.5 * np.pi) if first else (0.5 * np.pi, 0.0)
    middle = (at[joint][0], at[base][1]) if first else (at[base][0], at[joint][1])
    joints.append((centre, *middle))
    links[cross], links[block] = (centre,), (joint,)
    slides = (
        (along, Slide(cross, on="ground", angle=way, origin=base)),
        (across, Slide(block, on=cross, angle=square, origin=centre)),
    )
    return drawing._replace(
        joints=tuple(joints),
        links=tuple(links.items()),
        slides=(*drawing.slides, *slides),
        drivers=(along,) if len(axes) == 1 else (along, across),
        assembly=(),
    )


def _free(word: str, taken: set[str]) -> str:
    while word in taken:
        word += "_"
    taken.add(word)
    return word
