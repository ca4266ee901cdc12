"""The mechanism of a file, as a tree: the drawing, and what differs from it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import short
from assur.description import encode
from assur.description.words import Cylinder, Drive
from assur.errors import InputError
from assur.files.limits import MOST_PARTS
from assur.kinematics.model import at_place

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.description.encode import Description
    from assur.description.words import DriverLike
    from assur.kinematics.mechanism import Mechanism
    from assur.kinematics.model import MechanismModel, Place


def driver_value(mechanism: Mechanism) -> Any:
    """Return the driver as a value of a file."""
    driver = mechanism.driver
    if isinstance(driver, tuple):
        return [_one_driver(drive) for drive in driver]
    return _one_driver(driver)


def _one_driver(driver: DriverLike) -> Any:
    if isinstance(driver, Drive):
        return {"link": driver.link, "relative_to": driver.relative_to}
    return driver


def mechanism_tree(mechanism: Mechanism) -> dict[str, Any]:
    """Return the tables of a mechanism."""
    description = mechanism.description
    links, slides = with_cylinders(description)
    tree: dict[str, Any] = {
        "joints": {name: [x, y] for name, x, y in description.joints},
        "links": {name: list(on) for name, on in links},
    }
    if slides:
        tree["slides"] = dict(slides)
    if description.assembly:
        tree["assembly"] = dict(description.assembly)
    # The core of a mechanism that is drawn elsewhere has the drawing of that place.
    core = mechanism.core if mechanism.place is None else encode.core_of(description)
    drawing = np.array(core.drawing)
    if mechanism.shape or mechanism.values.tobytes() != drawing.tobytes():
        tree["dimensions"] = _dimensions(mechanism)
    if mechanism.place is not None:
        tree["drawn"] = _drawn(mechanism, mechanism.place)
    return tree


def with_cylinders(
    description: Description,
) -> tuple[list[tuple[str, tuple[str, ...]]], list[tuple[str, dict[str, Any]]]]:
    """Return links and slides, each slide between two links of its own as a cylinder."""
    links, slides = dict(description.links), []
    cylinders: list[tuple[str, tuple[str, ...]]] = []
    for name, slide in description.slides:
        barrel, rod = links.get(slide.on, ()), links.get(slide.link, ())
        short_form: dict[str, Any] | None = None
        if len(barrel) == len(rod) == 1 and slide.origin == barrel[0] and barrel != rod:
            names = (slide.on, slide.link)
            ends = [
                None if link == f"{name}_{part}" else link
                for link, part in zip(names, ("barrel", "rod"), strict=True)
            ]
            cylinder = Cylinder(barrel[0], rod[0], barrel=ends[0], rod=ends[1])
            short_form = _same_cylinder(name, cylinder, description, slide)
        if short_form is None:
            slides.append((name, _slide(slide)))
        else:
            slides.append((name, short_form))
            cylinders += [(slide.on, barrel), (slide.link, rod)]
    # A cylinder adds its links at the end; elsewhere they are written as links.
    rest = description.links[: len(description.links) - len(cylinders)]
    if (*rest, *cylinders) == description.links:
        return list(rest), slides
    return list(description.links), [(name, _slide(slide)) for name, slide in description.slides]


def _slide(slide: Any) -> dict[str, Any]:
    """Return a slide as a table."""
    length = {"length": True} if slide.length else {}
    return _present(slide, ("link", "on", "angle", "origin")) | length


def _same_cylinder(
    name: str, cylinder: Cylinder, description: Description, slide: Any
) -> dict[str, Any] | None:
    """Return a cylinder as a table, if it makes the same slide to the last bit."""
    try:
        made, _ = encode.cylinder(name, cylinder, description.joints)
    except InputError:
        return None
    same = made == slide and repr(made.angle) == repr(slide.angle)
    return _present(cylinder, ("base", "end", "barrel", "rod")) if same else None


def _present(thing: Any, names: tuple[str, ...]) -> dict[str, Any]:
    """Return the attributes that are not None."""
    values = {name: getattr(thing, name) for name in names}
    return {name: value for name, value in values.items() if value is not None}


def _dimensions(mechanism: MechanismModel) -> dict[str, Any]:
    """Return all dimensions; for a batch, lists of those that differ."""
    names, values = mechanism.core.dimension_names, mechanism.values
    if values.size == 0 and names:
        message = f"a batch {mechanism.shape} without designs cannot be saved"
        raise InputError(message)
    entries = [_same_or_all(column) for column in values]
    if mechanism.shape and not any(isinstance(entry, list) for entry in entries):
        entries = values.tolist()
    return dict(zip(names, entries, strict=True))


def _same_or_all(values: Float) -> Any:
    """Return one number if all designs have it, to the bit; otherwise lists."""
    first = values.flat[0]
    is_one = values.tobytes() == np.full(values.shape, first).tobytes() and np.isfinite(first)
    return float(first) if is_one else values.tolist()


def _drawn(mechanism: MechanismModel, place: Place, depth: int = 1) -> dict[str, Any]:
    """Return where an assembly was found, by the names of joints, links and slides."""
    if depth + 1 >= MOST_PARTS:
        message = "too many assemblies, each found from the one before: with_assembly() once, of "
        message += f"the assemblies of the mechanism as drawn, {short(mechanism)}"
        raise InputError(message)
    base, numbers = place.mechanism, place.numbers
    if not np.isfinite(np.array([*at_place(base, place, mechanism.core).joints.values()])).all():
        at = ", ".join(f"{q:.6g}" for q in place.q)
        message = (
            f"{short(mechanism)} cannot be saved: with its signs it does not exist at q = {at}, "
            "where its assembly was found: with_assembly() of one that assemblies() finds"
        )
        raise InputError(message)
    signs = dict(zip((n for n, _ in base.core.assembly), numbers["signs"], strict=True))
    entries: dict[str, Any] = {
        "q": list(place.q),
        "is_double": numbers["is_double"],
        "signs": signs,
        "class_angles": numbers["class_angles"],
        "slides": dict(zip(base.slides, numbers["slides"], strict=True)),
        "joints": dict(zip(base.joint_names, map(list, numbers["joints"]), strict=True)),
        "angles": dict(zip(base.links, numbers["angles"], strict=True)),
    }
    tree = {k: v for k, v in entries.items() if v or k in ("q", "joints", "angles")}
    if base.values.tobytes() != mechanism.values.tobytes():
        tree["dimensions"] = _dimensions(base)
    if base.place is not None:
        tree["drawn"] = _drawn(base, base.place, depth + 1)
    return tree
