"""Check a description and keep it as tuples: hashable, ready for the core."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, NamedTuple, TypeVar

import numpy as np

from assur._arrays import real_array, short
from assur._callers import level_of_caller
from assur._core import Mechanism as Core
from assur._trig import arctan2
from assur._validate import checked_name
from assur.description.remedy import find
from assur.description.words import Cylinder, Drive, DriverLike, Slide
from assur.errors import AssurWarning, InputError, StructureError, offer_remedies

T = TypeVar("T")

# Guides beyond two turns are probably in degrees.
LIKE_DEGREES = 4.0 * np.pi


class Description(NamedTuple):
    """A checked description: names with coordinates, members, slides; drivers; signs."""

    joints: tuple[tuple[str, float, float], ...]
    links: tuple[tuple[str, tuple[str, ...]], ...]
    slides: tuple[tuple[str, Slide], ...]
    drivers: tuple[DriverLike, ...]
    assembly: tuple[tuple[str, int], ...]


def core_of(description: Description) -> Core:
    """Compile a description. The error that refuses it can find remedies."""
    return _with_remedies(Core, _parts(description))


def fitted(description: Description, tolerance: Any) -> tuple[Description, float]:
    """Adjust a drawing for its redundant links; return it and how far joints were moved, m."""
    length, angle = _known_to(tolerance)
    parts = _parts(description)
    fit = partial(Core.fit, tolerance=(length, angle))
    places, angles, moved = _with_remedies(fit, parts)
    joints = tuple(
        (name, x, y) for (name, *_), (x, y) in zip(description.joints, places, strict=True)
    )
    slides = tuple(
        (name, replace(slide, angle=direction))
        for (name, slide), direction in zip(description.slides, angles, strict=True)
    )
    return description._replace(joints=joints, slides=slides), moved


def _known_to(tolerance: Any) -> tuple[float, float | None]:
    """Return the length, and perhaps the angle, to which a drawing is known."""
    try:
        known = real_array(tolerance, "tolerance")
    except InputError:
        known = np.empty(0)
    if known.shape not in ((), (2,)) or not bool(((known > 0.0) & np.isfinite(known)).all()):
        message = (
            f"tolerance is {short(tolerance)}: a positive length (m) is needed, or a length and "
            "an angle (rad)"
        )
        raise InputError(message)
    if known.ndim:
        return float(known[0]), float(known[1])
    return float(known), None


def _parts(description: Description) -> dict[str, Any]:
    """Return a description as the core takes it."""
    return {
        "joints": list(description.joints),
        "links": [(name, list(on)) for name, on in description.links],
        "slides": list(description.slides),
        "drivers": list(description.drivers),
        "assembly": list(description.assembly),
    }


def _with_remedies(make: Callable[..., T], parts: dict[str, Any]) -> T:
    """Make something of the parts; a StructureError can find remedies."""
    try:
        return make(**parts)
    except StructureError as error:
        offer_remedies(error, partial(find, parts))
        raise


def items(mapping: Any, what: str) -> list[tuple[str, Any]]:
    """Return the items of a mapping whose keys are names."""
    if not isinstance(mapping, Mapping):
        message = f"{what} must be a mapping of names, not {type(mapping).__name__}"
        raise InputError(message)
    return [(checked_name(name, what), value) for name, value in mapping.items()]


def joint(name: str, at: Sequence[float]) -> tuple[str, float, float]:
    """Return a joint for the core: its name and coordinates."""
    try:
        point = real_array(at, f"joint {name!r}")
    except InputError as error:
        message = f"joint {name!r} is at {short(at)}: two numbers (x, y) are needed"
        raise InputError(message, joint=name) from error
    if point.shape != (2,):
        message = f"joint {name!r} is at {short(at)}: two numbers (x, y) are needed"
        raise InputError(message, joint=name)
    return (name, float(point[0]), float(point[1]))


def slide(name: str, slide: Any, joints: Sequence[tuple[str, float, float]]) -> Slide:
    """Check a slide: link, guide and origin are names; its angle is a number or along joints."""
    if not isinstance(slide, Slide):
        message = f"slide {name!r} is {short(slide)}: an assur.Slide is needed"
        raise InputError(message, slide=name)
    words = {"link": slide.link, "on": slide.on}
    words |= {} if slide.origin is None else {"origin": slide.origin}
    names = {
        what: _checked(word, f"slide {name!r}, {what}", slide=name) for what, word in words.items()
    }
    link, on, origin = names["link"], names["on"], names.get("origin")
    length: Any = slide.length
    if not isinstance(length, bool | np.bool_):
        message = f"slide {name!r} has length {short(length)}: True or False is needed"
        raise InputError(message, slide=name)
    if slide.along is not None:
        if slide.angle == slide.angle:
            message = f"slide {name!r} has both angle and along: give one"
            raise InputError(message, slide=name)
        way = _direction(name, slide.along, joints)
        return Slide(link, on, angle=way, origin=origin, length=bool(length))
    try:
        angle = real_array(slide.angle, "angle")
    except InputError:
        angle = np.empty(0)
    if angle.ndim:
        message = (
            f"slide {name!r} has angle {short(slide.angle)}: a number (rad) is needed, or "
            'along=("A", "B")'
        )
        raise InputError(message, slide=name)
    if abs(float(angle)) > LIKE_DEGREES:
        message = f"slide {name!r} has an angle of {float(angle):g} rad: is it in degrees?"
        warnings.warn(message, AssurWarning, stacklevel=level_of_caller())
    return Slide(link, on, angle=float(angle), origin=origin, length=bool(length))


def _direction(name: str, ends: Any, joints: Sequence[tuple[str, float, float]]) -> float:
    """Return the direction from one joint of the drawing to another."""
    at = {joint: (x, y) for joint, x, y in joints}
    is_pair = isinstance(ends, tuple | list) and len(ends) == 2
    if not is_pair or any(not isinstance(end, str) or end not in at for end in ends):
        message = (
            f"slide {name!r} is along {short(ends)}: two joints of the drawing are needed, "
            '("A", "B")'
        )
        raise InputError(message, slide=name)
    (x, y), (u, v) = at[ends[0]], at[ends[1]]
    if (x, y) == (u, v):
        message = f"slide {name!r}: {short(ends[0])} and {short(ends[1])} are in one place"
        raise InputError(message, slide=name)
    return float(arctan2(v - y, u - x))


def cylinder(
    name: str, cylinder: Cylinder, joints: Sequence[tuple[str, float, float]]
) -> tuple[Slide, list[tuple[str, tuple[str, ...]]]]:
    """Return the slide of a cylinder, and its two links."""
    at = {joint: (x, y) for joint, x, y in joints}
    words = {
        "base": cylinder.base,
        "end": cylinder.end,
        "barrel": f"{name}_barrel" if cylinder.barrel is None else cylinder.barrel,
        "rod": f"{name}_rod" if cylinder.rod is None else cylinder.rod,
    }
    names = {
        what: _checked(word, f"cylinder {name!r}, {what}", slide=name)
        for what, word in words.items()
    }
    base, end, barrel, rod = names.values()
    for what in ("base", "end"):
        if names[what] not in at:
            message = f"cylinder {name!r}: its {what} {names[what]!r} is not a joint"
            raise InputError(message, slide=name)
    (x, y), (u, v) = at[base], at[end]
    if (x, y) == (u, v):
        message = f"cylinder {name!r}: {base!r} and {end!r} are in one place"
        raise InputError(message, slide=name)
    slide = Slide(rod, barrel, angle=float(arctan2(v - y, u - x)), origin=base, length=True)
    return slide, [(barrel, (base,)), (rod, (end,))]


def _checked(word: Any, what: str, **field: str) -> str:
    """Return a name; the error carries the joint, link or slide it belongs to."""
    try:
        return checked_name(word, what)
    except InputError as error:
        raise InputError(str(error), **field) from error  # type: ignore[arg-type]


def drivers(driver: DriverLike | Sequence[DriverLike]) -> tuple[DriverLike, ...]:
    """Return the drivers as a tuple."""
    listed: tuple[Any, ...] = tuple(driver) if isinstance(driver, list | tuple) else (driver,)
    checked: list[DriverLike] = []
    for d in listed:
        words: tuple[Any, ...] = (d.link, d.relative_to) if isinstance(d, Drive) else (d,)
        if not all(isinstance(word, str) for word in words):
            message = (
                f"driver {short(d)}: the name of a link or slide, or an assur.Drive, is needed"
            )
            raise InputError(message)
        names = [checked_name(word, "driver") for word in words]
        if isinstance(d, Drive):
            checked.append(Drive(names[0], relative_to=names[1]))
        else:
            checked.append(names[0])
    return tuple(checked)


def members(name: str, joints: Any) -> tuple[str, ...]:
    """Return the joints of a link as a tuple of names."""
    try:
        members: tuple[Any, ...] = tuple(joints)
    except TypeError as error:
        message = f"link {name!r} is {short(joints)}: a list of names of joints is needed"
        raise InputError(message, link=name) from error
    return tuple(_checked(member, f"link {name!r}, joints", link=name) for member in members)
