"""``drag``: the dimensions with which a joint is where the pointer holds it.

The mechanism is drawn again at the present position, with that joint moved and all others where
they are; its dimensions have the same names. They go into the document, whose drawing stays. Where
they do not lead there from its drawing (the joint passed through the line of its dyad, a slide
without origin was moved across its guide), the document gets the new drawing instead.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.description.dotted_names import is_angle
from assur.errors import AssurError
from assur.kinematics.table import driven_angles
from assur.pictures.scene.course import TURN
from assur.studio import document
from assur.studio.kinds.turn import SHOWN, turn_answer
from assur.studio.request import Fields
from assur.studio.session import Answer

if TYPE_CHECKING:
    from collections.abc import Iterator

    from assur._arrays import Float
    from assur.kinematics.mechanism import Mechanism
    from assur.kinematics.motion import Motion
    from assur.studio.session import Session

# A dimension that differs by less, relative to the size, keeps its digits; a joint is in place.
SAME, IN_PLACE = 1e-9, 1e-7
OWN = ("document", "q", "joint", "to")


def drag(data: dict[str, Any], session: Session) -> Answer:
    """Return the document of the dragged mechanism with its turn."""
    del session
    fields = Fields(data, (*OWN, *SHOWN), ("document", "joint", "to"))
    mechanism = document.read_mechanism(fields["document"])
    joint = fields.word("joint", mechanism.joints)
    q = fields.drivers("q", mechanism)
    motion = mechanism.solve(q, order=0)
    targets = {name: motion.joint(name).value for name in mechanism.joints}
    targets[joint] = np.array(fields.pair("to"))
    again = redrawn(fields["document"], mechanism, motion, targets)
    drawn = document.read_mechanism(again)
    shown, place, made = again, drawn.q0, drawn
    changed = _changed(mechanism, drawn)
    for dimensions, near in _ways(mechanism, drawn, changed, q):
        sized = _led_there(mechanism, dimensions, near, targets)
        if sized is not None:
            shown, changed = _with_dimensions(fields["document"], dimensions), dimensions
            place, made = near, sized
            break
    document.remember(shown, made)
    answer = turn_answer(made, place, fields)
    header = {"document": shown, "q": place, "changed": list(changed)}
    return Answer({**header, **answer.header}, answer.arrays)


def _with_dimensions(data: dict[str, Any], changed: dict[str, float]) -> dict[str, Any]:
    dimensions = dict(document.flat(data.get("dimensions", {})))
    return {**data, "dimensions": {**dimensions, **changed}} if dimensions or changed else data


def redrawn(
    data: dict[str, Any], mechanism: Mechanism, motion: Motion, joints: dict[str, Float]
) -> dict[str, Any]:
    """Return the document with another drawing: joints as given, guides as they are there."""
    moved = {k: v for k, v in data.items() if k not in ("dimensions", "assembly", "drawn")}
    moved["joints"] = {name: joints[name].tolist() for name in data["joints"]}
    if "slides" not in data:
        return moved
    moved["slides"], dimensions = {}, mechanism.dimensions
    for name, slide in data["slides"].items():
        moved["slides"][name] = slide
        if "angle" in slide:
            carrier = 0.0 if slide["on"] == "ground" else float(motion.link(slide["on"]).value)
            angle = carrier + float(dimensions.get(f"{name}.angle", 0.0))
            moved["slides"][name] = {**slide, "angle": angle}
    return moved


def _changed(mechanism: Mechanism, drawn: Mechanism) -> dict[str, float]:
    """Return the dimensions that another drawing has and the mechanism has not."""
    size = float(np.ptp(np.array(list(drawn.joints.values())), axis=0).max())
    dimensions, changed = mechanism.dimensions, {}
    for name, value in drawn.dimensions.items():
        difference, scale = float(value) - float(dimensions[name]), size
        if is_angle(name):
            difference, scale = difference - TURN * round(difference / TURN), 1.0
        if abs(difference) > SAME * scale:
            changed[name] = float(value)
    return changed


def _ways(
    mechanism: Mechanism, drawn: Mechanism, changed: dict[str, float], q: Any
) -> Iterator[tuple[dict[str, float], Any]]:
    """Yield dimensions and the coordinate to try with them.

    A slide without origin has its zero where it is drawn; first as if that had not moved.
    """
    slides = mechanism.slides
    zeros = {f"{name}.origin.{axis}" for name in slides for axis in ("x", "y")}
    floating = [
        isinstance(driver, str) and driver in slides and slides[driver].origin is None
        for driver in mechanism.description.drivers
    ]
    redrawn_q, present = np.atleast_1d(drawn.q0), np.atleast_1d(q)
    angles = np.array(driven_angles(drawn))
    # Angles are those of the turn that the present one is in.
    near = np.where(angles, redrawn_q + TURN * np.round((present - redrawn_q) / TURN), redrawn_q)
    several = drawn.driver_count > 1
    if any(floating) or zeros & set(changed):
        kept = np.where(floating, present, near)
        lengths = {name: value for name, value in changed.items() if name not in zeros}
        yield lengths, kept if several else float(kept[0])
    yield changed, near if several else float(near[0])


def _led_there(
    mechanism: Mechanism, changed: dict[str, float], q: Any, targets: dict[str, Float]
) -> Mechanism | None:
    """Return the mechanism with other dimensions if its joints are at their targets at q."""
    try:
        sized = mechanism.with_dimensions(changed)
        motion = sized.solve(q, order=0)
    except AssurError:
        return None
    there = np.array([motion.joint(name).value for name in targets])
    target = np.array(list(targets.values()))
    size = float(np.ptp(target, axis=0).max())
    return sized if bool((np.abs(there - target) <= IN_PLACE * size).all()) else None
