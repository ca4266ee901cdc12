"""The inverse question: where a coordinate has a value.

The coordinate drives in place of the driver, locked at the value; all assemblies of that mechanism
are the answers. For a joint's x or y, added sliders carry the joint.
"""

from __future__ import annotations

import warnings
from dataclasses import astuple
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from assur._arrays import as_number, counted, real_number, short
from assur._callers import level_of_caller
from assur._summary import summary
from assur._validate import checked_name, real_array
from assur.description import encode
from assur.description.dotted_names import split_name
from assur.description.words import Slide
from assur.errors import AssurWarning, InputError, StructureError
from assur.kinematics.assembly import Assembly, assemblies
from assur.kinematics.configuration import place_of, place_vector, size_of
from assur.kinematics.extremes import checked_coordinate
from assur.kinematics.model import Place
from assur.kinematics.pose import Pose, bare_core
from assur.kinematics.solve import solve

if TYPE_CHECKING:
    from assur._arrays import Float, Number
    from assur.description.encode import Description
    from assur.description.words import DriverLike
    from assur.kinematics.model import AssemblyNumbers, MechanismModel

# Places of the same assembly found in two ways, in sizes. Beside a fold half of the digits are
# lost; there the assemblies at this distance (rad, or in sizes) from it decide.
SAME = 1e-6
AT_FOLD = 1e-3
BESIDE = 1e-9


class InverseSolution(NamedTuple):
    """A position at which a coordinate of the motion has a value, by `Mechanism.find`.

    Attributes
    ----------
    q : float or ndarray
        The driver's coordinate, rad or m; an array of two with two drivers.
    assembly : Assembly
        The assembly, for ``m.solve(q, assembly=assembly)``.

    Examples
    --------
    >>> import assur
    >>> _, second = assur.SliderCrank(1.0, 3.0).find("bore", 3.0)
    >>> round(second.q, 6), dict(second.assembly)
    (1.403348, {'B': 1})
    """

    q: Number
    assembly: Assembly

    def __repr__(self) -> str:
        return summary(self)


def find(mechanism: MechanismModel, name: str, value: Any, deg: Any) -> list[InverseSolution]:
    """See `Mechanism.find`."""
    name = checked_name(name, "find")
    drivers = mechanism.driver_count
    if mechanism.shape:
        message = f"find() is for one design, this is a batch {mechanism.shape}: use design(i)"
        raise InputError(message)
    if drivers > 2:
        message = f"find() is for one driver or two; this mechanism has {drivers}"
        raise InputError(message)
    if deg is not None:
        value = _angle(mechanism, name, value, deg)
    elif value is None:
        message = (
            f"find({name!r}): neither value nor deg is given: pass the value that it is to have"
        )
        raise InputError(message)
    target = np.atleast_1d(real_array(value, "value"))
    if target.shape != (drivers,) or not np.isfinite(target).all():
        need = "a finite number" if drivers == 1 else "finite numbers (x, y) of a joint"
        message = f"value is {short(value)}: with {counted(drivers, 'driver')} {need} is needed"
        raise InputError(message)
    if drivers == 1 and name in mechanism.links and abs(float(target[0])) > 4.0 * np.pi:
        given, turns = f"{target[0]:g}", abs(float(target[0])) / (2.0 * np.pi)
        message = (
            f"{name} = {given} is in rad, {turns:.3g} turns; for degrees: deg=… or np.radians()"
        )
        warnings.warn(message, AssurWarning, stacklevel=level_of_caller())
    inverse, coordinates = _driven_by(mechanism, name, target)
    size = size_of(mechanism)
    answers: list[InverseSolution] = []
    for assembly in assemblies(inverse, coordinates):
        place = assembly.place
        assert place is not None
        answer = _of_original(mechanism, place.numbers, size)
        if answer is not None and not any(_is_same(answer, known) for known in answers):
            answers.append(answer)
    return sorted(answers, key=lambda answer: np.ravel(answer.q).tolist())


def _angle(mechanism: MechanismModel, name: str, value: Any, deg: Any) -> Float:
    """Return the angle that is given in degrees, rad."""
    if value is not None:
        message = f"find({name!r}): both value and deg are given: pass one of them"
        raise InputError(message)
    if name not in mechanism.links:
        message = f"find({name!r}): deg is for the angle of a link; {name!r} is measured in m"
        raise InputError(message)
    return np.asarray(real_number(deg, "deg") * (np.pi / 180.0))


def _is_same(answer: InverseSolution, known: InverseSolution) -> bool:
    """Whether two answers are the same: a double one is found twice."""
    gap = np.abs(np.ravel(answer.q) - np.ravel(known.q)).max()
    return bool(gap == 0.0) and answer.assembly == known.assembly


def driven_by_joint(
    mechanism: MechanismModel, joint: str, held: list[DriverLike]
) -> tuple[MechanismModel, tuple[float, float]]:
    """Return the design driven by a joint's x and y before other drivers, and where both are 0."""
    description = _with_cross_slide(_to_size(mechanism), joint, "xy")
    description = description._replace(drivers=(*description.drivers, *held))
    inverse = _redriven(mechanism, description, joint)
    x, y = _base(inverse)
    return inverse, (x, y)


def _driven_by(
    mechanism: MechanismModel, name: str, target: Any
) -> tuple[MechanismModel, float | list[float]]:
    """Return the design driven by a coordinate, and the driver's coordinate of the value."""
    drawing = mechanism.description
    if mechanism.driver_count == 1 and "." not in name:
        checked_coordinate(mechanism, name)
        description = drawing._replace(drivers=encode.drivers(name), assembly=())
        return _redriven(mechanism, description, name), float(target[0])
    if mechanism.driver_count == 1:
        joint, axes = split_name(name)
        checked_coordinate(mechanism, name)
    else:
        joint, axes = name, "xy"
        mechanism.core.index_of("joint", joint)
    inverse = _redriven(mechanism, _with_cross_slide(_to_size(mechanism), joint, axes), name)
    base = dict(zip("xy", _base(inverse), strict=True))
    steps = [float(value - base[axis]) for value, axis in zip(target, axes, strict=True)]
    return inverse, steps[0] if len(steps) == 1 else steps


def _redriven(mechanism: MechanismModel, description: Description, name: str) -> MechanismModel:
    """Return the design with another description, whose drawing need not show an assembly."""
    try:
        core = bare_core(description)
    except StructureError as error:
        if "." not in name and name not in mechanism.joint_names:
            if error.kind != "cannot_drive":
                raise
            raise _does_not_change(mechanism, name) from error
        joint, _ = split_name(name)
        why = "the joint moves along a curve only, or not without other drivers"
        if joint in mechanism.links.get("ground", ()):
            why = f"joint {joint!r} is on the ground and does not move"
        raise InputError(f"{name!r} cannot be set: {why}") from error
    known = dict(zip(mechanism.core.dimension_names, mechanism.values.tolist(), strict=True))
    drawn = zip(core.dimension_names, core.drawing, strict=True)
    values = np.array([known.get(name, value) for name, value in drawn])
    return mechanism._make(description, values, core)


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


def _base(mechanism: MechanismModel) -> tuple[float, float]:
    """Return the ground's joint from which a cross-slide is measured."""
    joint = next(slide.origin for _, slide in mechanism.description.slides[-2:])
    values = mechanism.dimensions
    return float(values[f"ground.{joint}.x"]), float(values[f"ground.{joint}.y"])


def _with_cross_slide(drawing: Description, joint: str, axes: str) -> Description:
    """Return a description driven by a joint's x, y or both, from a joint of the ground on."""
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


def _of_original(
    mechanism: MechanismModel, numbers: AssemblyNumbers, size: float
) -> InverseSolution | None:
    """Return the coordinate and assembly of a pose that was found with another driver."""
    links, slides = len(mechanism.links), len(mechanism.slides)
    pose = Pose.found(numbers)
    joints = pose.joints[: len(mechanism.joint_names)]
    pose = Pose(joints, pose.angles[:links], pose.slides[:slides])
    q = _coordinates(mechanism, pose)
    coordinates = as_number(q[0] if len(q) == 1 else np.array(q))
    if mechanism.core.cls > 2:
        try:
            _, drawn_numbers = bare_core(mechanism.description).at_pose(*astuple(pose))
        except StructureError:
            pass  # at a fold: the assembly is one of those beside it
        else:
            assembly = Assembly._found(Place(mechanism, tuple(q), drawn_numbers), ())
            return InverseSolution(coordinates, assembly)
    there = place_vector(np.array(pose.joints), np.array(pose.angles), np.array(pose.slides), size)
    unit = size if mechanism.description.drivers[0] in mechanism.slides else 1.0
    for beside, far in ((0.0, SAME), *((side * BESIDE * unit, AT_FOLD) for side in (1.0, -1.0))):
        near = list(assemblies(mechanism, np.array(coordinates) + beside))
        gaps = [
            float(np.abs(place_of(_numbers(assembly), size) - there).max()) for assembly in near
        ]
        if gaps and min(gaps) <= far:
            return InverseSolution(coordinates, near[int(np.argmin(gaps))])
    return None


def _numbers(assembly: Assembly) -> AssemblyNumbers:
    assert assembly.place is not None
    return assembly.place.numbers


def _coordinates(mechanism: MechanismModel, pose: Pose) -> list[float]:
    """Return the drivers' coordinates in a pose, of angles in (−π, π]."""
    angles = dict(zip(mechanism.links, pose.angles, strict=True))
    values = dict(zip(mechanism.slides, pose.slides, strict=True))
    coordinates = []
    for driver in mechanism.description.drivers:
        if isinstance(driver, str) and driver in values:
            coordinates.append(values[driver])
            continue
        link, base = (
            (driver, None) if isinstance(driver, str) else (driver.link, driver.relative_to)
        )
        angle = angles[link] - (angles[base] if base is not None else 0.0)
        coordinates.append(float(angle - np.ceil((angle - np.pi) / (2.0 * np.pi)) * 2.0 * np.pi))
    return coordinates
