"""Transmission angles: the two lines that meet at a joint or slide, and their angle."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from assur import _core
from assur._arrays import Float, short
from assur._trig import sin_cos
from assur._validate import checked_name
from assur.errors import InputError
from assur.kinematics.derivatives.jacobian import jacobian, named_dimensions, vjp

if TYPE_CHECKING:
    from assur.kinematics.model import MechanismModel
    from assur.kinematics.motion_model import MotionModel


# Within this of 0 or π/2, rad, rounding decides on which side of its turning back an angle is.
TURNS_BACK = 1e-12


class JointLine(NamedTuple):
    """A line from joint to joint."""

    start: str
    end: str


class GuideLine(NamedTuple):
    """The guide of a slide, on a link."""

    link: str
    slide: str


Line: TypeAlias = JointLine | GuideLine


def angle(motion: MotionModel, name: str, between: tuple[str, ...] | None) -> Float:
    """See `Motion.transmission_angle`."""
    pair, complement = lines(motion.mechanism, name, between)
    first, second = (direction(motion, line) for line in pair)
    acute = _acute(motion, first, second)
    return 0.5 * np.pi - acute if complement else acute


def derivative(motion: MotionModel, name: str, by: Any, between: tuple[str, str] | None) -> Float:
    """See `Motion.d_transmission_angle`."""
    pair, complement = lines(motion.mechanism, name, between)
    directions = [direction(motion, line) for line in pair]
    if isinstance(by, str) and by == "q":
        rates = [_turning(motion, *of) for of in zip(pair, directions, strict=True)]
        signs = sense(directions, complement)
        turned: Float = signs[..., np.newaxis] * (rates[1] - rates[0])
        return turned
    weights = derivatives_by_places(pair, directions, complement)
    indices = named_dimensions(motion.mechanism, by)
    found = vjp(motion, weights, by, 0)
    found += of_guides(motion.mechanism, (pair, directions, complement), indices)
    found[np.isnan(sense(directions, complement))] = np.nan
    return found


def sense(directions: list[Float], complement: bool) -> Float:
    """Return whether the angle grows with that from the first line to the second: ±1, or NaN."""
    first, second = directions
    cross = first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]
    # An acute angle falls where the angle from one line to the other grows beyond a right one.
    # Lines along each other, or at right angles, have no derivative: there it turns back.
    sines = cross * np.sum(first * second, axis=-1)
    sizes = np.sum(first * first, axis=-1) * np.sum(second * second, axis=-1)
    grows: Float = np.where(np.abs(sines) <= TURNS_BACK * sizes, np.nan, np.sign(sines))
    return -grows if complement else grows


def derivatives_by_places(
    pair: list[Line], directions: list[Float], complement: bool
) -> dict[str, Float]:
    """Return the derivatives of the angle by joints and angles of links, by name."""
    grows = sense(directions, complement)
    weights: dict[str, Float] = {}

    def add(name: str, weight: Float) -> None:
        weights[name] = weights[name] + weight if name in weights else weight

    for line, along, sign in zip(pair, directions, (-1.0, 1.0), strict=True):
        if isinstance(line, GuideLine):
            add(line.link, sign * grows)
            continue
        weight = (sign * grows)[..., np.newaxis] * _across(along)
        add(line.end, weight)
        add(line.start, -weight)
    return weights


def of_guides(
    mechanism: MechanismModel, of: tuple[list[Line], list[Float], bool], by: list[int]
) -> Float:
    """Return the derivatives of the angle by the guides' own angles on their links."""
    pair, directions, complement = of
    grows = sense(directions, complement)
    found = np.zeros((*grows.shape, len(by)))
    for line, sign in zip(pair, (-1.0, 1.0), strict=True):
        if not isinstance(line, GuideLine):
            continue
        own = f"{line.slide}.angle"
        if own in mechanism.core.dimension_names:
            which = np.equal(by, mechanism.core.dimension(own))
            found[..., which] += (sign * grows)[..., np.newaxis]
    return found


def _across(along: Float) -> Float:
    """Return the derivative of a line's angle by its end."""
    left = np.stack([-along[..., 1], along[..., 0]], axis=-1)
    across: Float = left / np.sum(along * along, axis=-1)[..., np.newaxis]
    return across


def _turning(motion: MotionModel, line: Line, along: Float) -> Float:
    """Return the derivatives of a line's angle by the drivers."""
    if isinstance(line, GuideLine):
        angle = jacobian(motion, line.link, "q", 0)
        assert not isinstance(angle, dict)
        return angle
    ends = (jacobian(motion, joint, "q", 0) for joint in (line.end, line.start))
    end, start = (end for end in ends if not isinstance(end, dict))
    turned: Float = np.sum(_across(along)[..., np.newaxis] * (end - start), axis=-2)
    return turned


def lines(mechanism: MechanismModel, name: str, between: Any) -> tuple[list[Line], bool]:
    """Return the two lines, and whether the complement of their angle is wanted."""
    name = checked_name(name, "transmission_angle")
    if between is not None:
        listed = (name, *between) if isinstance(between, tuple | list) else ()
        joints = [checked_name(joint, "between") for joint in listed]
        if len(set(joints)) != 3 or len(joints) != 3:
            message = f"between={short(between)}: two joints are needed, neither of them {name!r}"
            raise InputError(message, joint=name)
        for joint in joints:
            mechanism.core.index_of("joint", joint)
        return [JointLine(name, end) for end in joints[1:]], False
    slide = name if name in mechanism.slides else _slide_at(mechanism, name)
    if slide is not None:
        return _at_slide(mechanism, slide), True
    mechanism.core.index_of("joint", name)
    outer = _of_dyad(mechanism, name)
    if outer:
        return [JointLine(name, end) for end in outer], False
    meeting = [link for link, on in mechanism.links.items() if name in on]
    if len(meeting) == 1:
        message = f"joint {name!r} is on link {meeting[0]!r} alone: pass between=(joint, joint)"
        raise InputError(message, joint=name, link=meeting[0])
    if len(meeting) != 2:
        message = f"{len(meeting)} links meet at joint {name!r}: pass between=(joint, joint)"
        raise InputError(message, joint=name)
    return [JointLine(name, _other_joint(mechanism, link, name)) for link in meeting], False


def _acute(motion: MotionModel, a: Float, b: Float) -> Float:
    shape = (*motion.shape, 2)
    flat = [np.ascontiguousarray(np.broadcast_to(x, shape)).reshape(-1) for x in (a, b)]
    return _core.acute(flat[0], flat[1]).reshape(motion.shape)


def direction(motion: MotionModel, line: Line) -> Float:
    """Return the direction of a line, S + (N, 2), not normalised."""
    mechanism = motion.mechanism
    if isinstance(line, JointLine):
        along: Float = motion.joint(line.end).value - motion.joint(line.start).value
        return along
    angle = np.asarray(mechanism.dimensions.get(f"{line.slide}.angle", 0.0))
    if motion.shape[len(mechanism.shape) :]:
        angle = angle[..., np.newaxis]
    direction = motion.link(line.link).value + angle
    sine, cosine = sin_cos(direction)
    return np.stack([cosine, sine], axis=-1)


def _pairs(mechanism: MechanismModel, joint: str) -> int:
    return sum(joint in on for on in mechanism.links.values())


def _of_dyad(mechanism: MechanismModel, inner: str) -> list[str]:
    """Return the outer joints of the dyad whose inner joint this is, whatever its links carry."""
    for group in mechanism.structure.groups:
        if group.cls != 2 or inner not in group.joints:
            continue
        on = [set(mechanism.links[link]) & set(group.joints) for link in group.links]
        if all(inner in joints and len(joints) == 2 for joints in on):
            return [joint for joints in on for joint in joints if joint != inner]
    return []


def _other_joint(mechanism: MechanismModel, link: str, joint: str) -> str:
    """Return the only other joint at which the link meets other links."""
    others = [j for j in mechanism.links[link] if j != joint]
    joined = [j for j in others if _pairs(mechanism, j) > 1]
    if len(joined) == 1:
        return joined[0]
    if not joined and len(others) == 1:
        return others[0]
    what = "several other joints" if others else "no other joint"
    message = f"link {link!r} has {what} besides {joint!r}: pass between=(joint, joint)"
    raise InputError(message, link=link, joint=joint)


def _slide_at(mechanism: MechanismModel, joint: str) -> str | None:
    """Return the slide of a link that has this joint only, or None."""
    for name, slide in mechanism.slides.items():
        if tuple(mechanism.links[slide.link]) == (joint,):
            return name
    return None


def _at_slide(mechanism: MechanismModel, name: str) -> list[Line]:
    """Return the lines whose acute angle is the pressure angle.

    Fixed guide: the pushing link and the guide. Turning guide: the block pushes
    along the guide's normal, and the point of the guide moves at right angles to
    the line from its pivot, so the lines are that line and the guide.
    """
    slide = mechanism.slides[name]
    joints = tuple(mechanism.links[slide.link])
    if not joints:
        message = f"slide {name!r}: link {slide.link!r} has no joint to push it"
        raise InputError(message, slide=name)
    at = joints[0]
    if slide.on != "ground":
        return [JointLine(at, _pivot(mechanism, slide.on)), GuideLine(slide.on, name)]
    pushing = [k for k, on in mechanism.links.items() if at in on and k != slide.link]
    if len(pushing) != 1:
        message = f"slide {name!r}: {len(pushing)} links push joint {at!r}: pass between="
        raise InputError(message, slide=name, joint=at)
    return [JointLine(at, _other_joint(mechanism, pushing[0], at)), GuideLine(slide.on, name)]


def _pivot(mechanism: MechanismModel, link: str) -> str:
    """Return the joint about which a guide's link turns: the one on the ground, or its only one."""
    joined = [j for j in mechanism.links[link] if _pairs(mechanism, j) > 1]
    fixed = [j for j in joined if j in mechanism.links["ground"]]
    pivots = fixed or joined
    if len(pivots) != 1:
        message = f"link {link!r} turns about {len(pivots)} joints: no pressure angle is defined"
        raise InputError(message, link=link)
    return pivots[0]
