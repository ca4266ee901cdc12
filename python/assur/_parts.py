"""A description as plain tuples: checked, hashable, ready for the core."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

from assur._core import Mechanism as Core
from assur.description import Drive, Slide
from assur.errors import InputError

DriverLike: TypeAlias = str | Drive
Parts: TypeAlias = tuple[
    tuple[tuple[str, float, float], ...],
    tuple[tuple[str, tuple[str, ...]], ...],
    tuple[tuple[str, Slide], ...],
    tuple[DriverLike, ...],
    tuple[tuple[str, int], ...],
]


def core_of(parts: Parts) -> Core:
    joints, links, slides, drivers, assembly = parts
    return Core(
        joints=list(joints),
        links=[(name, list(on)) for name, on in links],
        slides=[(name, s.link, s.on, s.angle, s.origin) for name, s in slides],
        drivers=[(d.link, d.relative_to) if isinstance(d, Drive) else (d, None) for d in drivers],
        assembly=list(assembly),
    )


def items(mapping: Any, what: str) -> list[tuple[str, Any]]:
    if not isinstance(mapping, Mapping):
        message = f"{what} must be a mapping of names, not {type(mapping).__name__}"
        raise InputError(message)
    for name in mapping:
        if not isinstance(name, str):
            message = f"{what}: the name {name!r} is not a string"
            raise InputError(message)
        if any("\ud800" <= letter <= "\udfff" for letter in name):
            message = f"{what}: the name {name!a} is no Unicode text"
            raise InputError(message)
    return list(mapping.items())


def joint(name: str, at: Sequence[float]) -> tuple[str, float, float]:
    try:
        x, y = (float(v) for v in at)
    except (TypeError, ValueError, OverflowError) as error:
        message = f"joint {name!r} is at {at!r}: two numbers (x, y) are needed"
        raise InputError(message, joint=name) from error
    return (name, x, y)


def slide(name: str, slide: Any) -> Slide:
    if not isinstance(slide, Slide):
        message = f"slide {name!r} is {slide!r}: an assur.Slide is needed"
        raise InputError(message, slide=name)
    try:
        checked = Slide(slide.link, slide.on, float(slide.angle), slide.origin)
    except (TypeError, ValueError, OverflowError) as error:
        message = f"slide {name!r} has angle {slide.angle!r}: a number (rad) is needed"
        raise InputError(message, slide=name) from error
    words: tuple[Any, ...] = (slide.link, slide.on, slide.origin or "")
    for word in words:
        if not isinstance(word, str):
            message = f"slide {name!r}: {word!r} is not a name"
            raise InputError(message, slide=name)
    return checked


def drivers(driver: DriverLike | Sequence[DriverLike]) -> tuple[DriverLike, ...]:
    drivers: tuple[Any, ...] = tuple(driver) if isinstance(driver, list | tuple) else (driver,)
    for d in drivers:
        words: tuple[Any, ...] = (d.link, d.relative_to) if isinstance(d, Drive) else (d,)
        if not all(isinstance(word, str) for word in words):
            message = f"driver {d!r}: the name of a link or slide, or an assur.Drive, is needed"
            raise InputError(message)
    return drivers


def members(name: str, joints: Any) -> tuple[str, ...]:
    try:
        members = tuple(joints)
    except TypeError as error:
        message = f"link {name!r} is {joints!r}: a list of names of joints is needed"
        raise InputError(message, link=name) from error
    for member in members:
        if not isinstance(member, str):
            message = f"link {name!r}: {member!r} is not the name of a joint"
            raise InputError(message, link=name)
    return members
