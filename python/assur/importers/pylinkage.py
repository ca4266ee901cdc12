"""pylinkage: JSON of joints and links, or of dyads (before 0.7).

joint
    id, type (ground, revolute, prismatic, tracker), position; prismatic: axis, line_point;
    tracker: two reference joints of its link, distance, angle
link
    id, type (ground, driver, arc_driver, link), joints; drivers: motor_joint, angular_velocity
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from assur._arrays import short
from assur._trig import arctan2
from assur.importers.build import finish
from assur.importers.json_text import items_of, parse_json, point_of, word_of, words_of
from assur.importers.placing import polar
from assur.importers.pylinkage_dyads import is_dyads, read_dyads
from assur.importers.sketch import GROUND, Input, Sketch
from assur.importers.source import open_source

if TYPE_CHECKING:
    from collections.abc import Mapping

    from assur.importers.build import Imported
    from assur.importers.source import Source, SourceLike

__all__ = ["read"]

TYPES = ("ground", "revolute", "prismatic", "tracker")
# Part of the coordinates by which a rounded slider may be off its line.
ON_LINE = 1e-9


def read(
    source: SourceLike, *, scale: float = 1.0, assembly: Mapping[str, int] | None = None
) -> Imported:
    """Read a linkage of pylinkage.

    Parameters
    ----------
    source : str or path-like
        A file, or its text.
    scale : float
        The file's unit of length, m.
    assembly : mapping of str to int, optional
        For dyads drawn with their links collinear: see `Mechanism`.

    Returns
    -------
    Imported
        Its speed is in rad per step: pylinkage has no time.

    Raises
    ------
    InputError
        Text that is not in this format; joints that do not exist; dyads whose links do not meet.
    StructureError
        A linkage that is not a mechanism.

    Examples
    --------
    >>> from assur import importers
    >>> found = importers.pylinkage.read('''{
    ...   "joints": [
    ...     {"id": "O", "type": "ground", "position": [0, 0]},
    ...     {"id": "A", "type": "revolute", "position": [0, 1]},
    ...     {"id": "S", "type": "prismatic", "position": [3, 0], "axis": [1, 0]}],
    ...   "links": [
    ...     {"id": "crank", "type": "driver", "joints": ["O", "A"], "motor_joint": "O"},
    ...     {"id": "rod", "type": "link", "joints": ["A", "S"]}]}''')
    >>> found.mechanism.structure.formula
    'I(crank) → II(rod, S_block)'
    """
    opened = open_source(source)
    data = parse_json(opened)
    joints = items_of(opened, data, "joints")
    opened.require_few(len(joints))
    sketch = Sketch()
    if is_dyads(joints):
        read_dyads(opened, sketch, joints)
    else:
        _read_links(opened, sketch, data, joints)
    if any(driven.speed is not None for driven in sketch.inputs):
        sketch.omitted.append("The speed is in rad a step: pylinkage has no time.")
    return finish(opened, sketch, "pylinkage", scale, assembly)


def _read_links(
    source: Source, sketch: Sketch, data: dict[str, Any], joints: list[dict[str, Any]]
) -> None:
    kinds = _add_joints(source, sketch, joints)
    links = items_of(source, data, "links")
    source.require_few(len(links), "links")
    seen: set[str] = set()
    for index, link in enumerate(links):
        place = f"links[{index}]"
        name = word_of(source, link, "id", place)
        if name in seen:
            raise source.error(place, f"a second link {short(name)}", link=name)
        seen.add(name)
        _add_link(source, sketch, place, name, link, kinds)
    for index, (name, joint) in enumerate(kinds.items()):
        if joint.get("type") == "prismatic":
            _add_slider(source, sketch, f"joints[{index}]", name, joint)
        if joint.get("type") == "tracker":
            _add_tracker(source, sketch, f"joints[{index}]", name, joint)


def _add_joints(
    source: Source, sketch: Sketch, joints: list[dict[str, Any]]
) -> dict[str, dict[str, Any]]:
    """Place the joints; return them by name."""
    kinds: dict[str, dict[str, Any]] = {}
    for index, joint in enumerate(joints):
        place = f"joints[{index}]"
        name = word_of(source, joint, "id", place)
        kind = joint.get("type", "revolute")
        if kind not in TYPES:
            known = f"one of {', '.join(TYPES)}"
            raise source.wrong(place, f"the type of joint {short(name)}", kind, known, joint=name)
        if name in kinds:
            raise source.error(place, f"a second joint {short(name)}", joint=name)
        kinds[name] = joint
        if kind != "tracker":
            sketch.joints[name] = point_of(source, joint, "position", place)
        if kind == "ground":
            sketch.connect(name, GROUND)
    return kinds


def _add_link(
    source: Source,
    sketch: Sketch,
    place: str,
    name: str,
    link: dict[str, Any],
    kinds: dict[str, dict[str, Any]],
) -> None:
    kind = link.get("type", "link")
    if kind not in ("ground", "driver", "arc_driver", "link"):
        known = "ground, driver, arc_driver or link"
        raise source.wrong(place, f"the type of link {short(name)}", kind, known, link=name)
    key = GROUND if kind == "ground" else f"{name} " if name == GROUND else name
    for joint in words_of(source, link, "joints", place):
        if joint not in kinds:
            problem = f"link {short(name)} has the joint {short(joint)}, which does not exist"
            raise source.error(place, problem, link=name)
        if kinds[joint].get("type") != "tracker":
            sketch.connect(joint, key)
    if kind not in ("driver", "arc_driver"):
        return
    motor = word_of(source, link, "motor_joint", place)
    if motor not in sketch.links.get(key, ()) or motor not in sketch.links[GROUND]:
        problem = f"motor joint {short(motor)} of link {short(name)} must be a ground joint of it"
        raise source.error(place, problem, link=name)
    velocity = link.get("angular_velocity")
    speed = None if velocity is None else source.number(velocity, place, "angular_velocity")
    sketch.inputs.append(Input(place, joint=motor, link=key, base=GROUND, speed=speed))
    if kind == "arc_driver":
        sketch.omitted.append(f"Driver {name} turns to and fro: its limits are left out.")


def _add_slider(
    source: Source, sketch: Sketch, place: str, name: str, joint: dict[str, Any]
) -> None:
    x, y = sketch.joints[name]
    u, v = point_of(source, {"axis": [1.0, 0.0], **joint}, "axis", place)
    size = math.sqrt(u * u + v * v)
    if not size > 0.0:
        raise source.error(place, f"the axis of joint {short(name)} has no direction", joint=name)
    if joint.get("line_point") is not None:
        a, b = point_of(source, joint, "line_point", place)
        off = abs((x - a) * v - (y - b) * u) / size
        if off > ON_LINE * max(abs(x), abs(y), abs(a), abs(b)):
            problem = f"joint {short(name)} is {off:g} off its line: put it on the line"
            raise source.error(place, problem, joint=name, value=off)
    riders = [link for link in sketch.links_at(name) if link != GROUND]
    sketch.add_slot(name, GROUND, riders, float(arctan2(v, u)), turns=True)


def _add_tracker(
    source: Source, sketch: Sketch, place: str, name: str, joint: dict[str, Any]
) -> None:
    """A tracker is a point of the link that has both of its reference joints."""
    first = word_of(source, joint, "ref_joint1_id", place)
    second = word_of(source, joint, "ref_joint2_id", place)
    both = [link for link in sketch.links_at(first) if second in sketch.links[link]]
    if not both or first == second:
        problem = f"tracker {short(name)}: no link has both {short(first)} and {short(second)}"
        raise source.error(place, problem, joint=name)
    distance = source.number(joint.get("distance", 0.0), place, "distance")
    angle = source.number(joint.get("angle", 0.0), place, "angle")
    sketch.joints[name] = polar(sketch.joints[first], sketch.joints[second], distance, angle)
    sketch.connect(name, both[0])
