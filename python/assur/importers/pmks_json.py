"""The ``.pmks`` files of PMKS: JSON of joints, each with the names of its links."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from assur._arrays import short
from assur.importers.json_text import items_of, parse_json, words_of
from assur.importers.pmks_joints import FRAME, TYPES, add_input, add_joint

if TYPE_CHECKING:
    from assur.importers.sketch import Sketch
    from assur.importers.source import Source


def read_json(source: Source, sketch: Sketch) -> None:
    """Add the joints and the input of a file."""
    data = parse_json(source)
    kinds: list[str] = []
    source.require_few(len(items_of(source, data, "Joints")))
    for count, joint in enumerate(items_of(source, data, "Joints"), 1):
        place, name = f"Joints[{count - 1}]", f"J{count}"
        links = words_of(source, joint, "Links", place)
        kind = joint.get("TypeOfJoint")
        if not isinstance(kind, str) or kind.upper() not in TYPES:
            raise source.wrong(place, "TypeOfJoint", kind, "R, P or RP")
        x, y = (source.number(joint.get(what), place, what) for what in "XY")
        kinds.append(kind.upper())
        angle = _json_angle(source, joint, place, links, kinds[-1])
        add_joint(source, sketch, place, name, kinds[-1], links, (x, y), angle)
    index = data.get("DrivingIndex", 0)
    if isinstance(index, bool) or not isinstance(index, int) or not 0 <= index < len(kinds):
        needed = f"the index of one of the {len(kinds)} joints is needed"
        raise source.error("", f"DrivingIndex is {short(index)}: {needed}")
    input_speed = data.get("InputSpeed")
    speed = None if input_speed is None else source.number(input_speed, "", "InputSpeed")
    add_input(source, sketch, f"J{index + 1}", kinds[index], f"Joints[{index}]", speed, unit=1.0)


def _json_angle(
    source: Source, joint: dict[str, Any], place: str, links: list[str], kind: str
) -> float:
    """Return the angle of a guide: PMKS keeps it in rad, against its link's own angle."""
    if kind not in ("P", "RP") or len(links) < 2:
        return 0.0
    angle = source.number(joint.get("Angle"), place, "Angle")
    if not FRAME.fullmatch(links[0]):
        problem = (
            f"the guide is on the moving link {links[0]!r}: PMKS keeps its angle against an axis "
            "that the file does not have; save the linkage as text or as an address"
        )
        raise source.error(place, problem, link=links[0])
    return math.remainder(angle, math.tau)
