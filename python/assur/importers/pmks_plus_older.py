"""Older addresses of PMKS+: ``?j=...&l=...&f=...&pp=...&tp=...&s=...``, a record a line (%0A).

j
    id, x, y, its links (parted by |), R or P, on the frame, angle, friction, input: t or f
l
    id, mass, inertia, centre of mass x, y, its joints (parted by |), forces, shape
f
    id, link, ...
s
    rpm, clockwise, gravity, unit of length
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING
from urllib.parse import unquote

from assur._arrays import counted, short
from assur.importers.names import listed
from assur.importers.sketch import GROUND, Input

if TYPE_CHECKING:
    from assur.importers.sketch import Sketch
    from assur.importers.source import Source

FIELDS = frozenset(("j", "l", "f", "pp", "tp", "s"))
UNITS = {"m": 1.0, "cm": 0.01, "mm": 0.001, "in": 0.0254, "inch": 0.0254, "km": 1000.0}
RPM = math.tau / 60.0


@dataclass
class Joint:
    """A record of a joint."""

    place: str
    id: str
    links: list[str]
    slides: bool
    fixed: bool
    angle: float
    is_input: bool


def is_text(text: str) -> bool:
    """Whether a text has the fields j= and l= of an address."""
    fields = _fields(text[:100_000])
    return "j" in fields and "l" in fields


def read_fields(source: Source, sketch: Sketch, scale: float) -> None:
    """Add the joints, links and inputs of an address."""
    # Numbers are written out: their digits show the resolution.
    sketch.resolution = sketch.angle_resolution = None
    fields = _fields(source.text)
    rows = {name: _rows(source, fields.get(name, "")) for name in ("j", "l", "f")}
    joints = [_joint(source, sketch, f"joint {n}", row) for n, row in enumerate(rows["j"], 1)]
    if not joints:
        raise source.error("", "no joint is there")
    for number, row in enumerate(rows["l"], 1):
        _add_link(source, sketch, f"link {number}", row)
    speed, unit = _settings(source, sketch, fields.get("s", ""))
    for joint in joints:
        _connect(source, sketch, joint)
    for joint in joints:
        if joint.is_input:
            _drive(sketch, joint, speed)
    if unit not in (None, 1.0) and scale == 1.0:
        sketch.omitted.append(f"Lengths are read as they stand: scale={unit:g} makes them m.")
    if rows["l"]:
        sketch.omitted.append("Masses, inertias and centres of mass are left out.")
    if rows["f"]:
        sketch.omitted.append(f"Forces are left out: {listed([row[0] for row in rows['f']])}.")


def _fields(text: str) -> dict[str, str]:
    """Return the fields behind the question mark, each name once and in lower case."""
    _, mark, query = text.strip().partition("?")
    fields: dict[str, str] = {}
    for part in query.partition("#")[0].split("&") if mark else ():
        name, equals, value = part.partition("=")
        if equals and name in FIELDS:
            fields.setdefault(name, unquote(value))
    return fields


def _rows(source: Source, text: str) -> list[list[str]]:
    rows = [row.split(",") for row in text.splitlines() if row.strip(", \t")]
    source.require_few(len(rows), "records")
    return [[word.strip() for word in row] for row in rows]


def _joint(source: Source, sketch: Sketch, place: str, row: list[str]) -> Joint:
    if len(row) < 6 or not row[0]:
        needed = "id, x, y, links, R or P and t or f are needed"
        raise source.error(place, f"{counted(len(row), 'word')}, {short(','.join(row))}: {needed}")
    name, kind = row[0], row[4]
    if name in sketch.joints:
        raise source.error(place, f"a second joint {short(name)}", joint=name)
    if kind not in ("R", "P"):
        raise source.wrong(place, f"the type of joint {short(name)}", kind, "R or P", joint=name)
    x, y = (source.number(word, place, what) for word, what in zip(row[1:3], "xy", strict=True))
    angle_text = row[6] if row[6:] and row[6] else "0"
    angle = source.number(angle_text, place, "the angle") if kind == "P" else 0.0
    fixed = _flag(source, place, row[5], "on the frame")
    is_input = _flag(source, place, row[8] if row[8:] else "f", "the input")
    sketch.joints[name] = (x, y)
    links = list(dict.fromkeys(word for word in row[3].split("|") if word))
    return Joint(place, name, links, kind == "P", fixed, angle, is_input)


def _flag(source: Source, place: str, word: str, what: str) -> bool:
    if word.lower() not in ("t", "f", "true", "false", ""):
        raise source.wrong(place, what, word, "t or f")
    return word.lower() in ("t", "true")


def _add_link(source: Source, sketch: Sketch, place: str, row: list[str]) -> None:
    name = row[0]
    members = [word for word in row[5].split("|") if word] if row[5:] else []
    if not name or not members:
        needed = "id, mass, inertia, centre of mass and joints are needed"
        raise source.error(place, f"{short(','.join(row))} is not a link: {needed}")
    # A link with the frame's name is not the frame.
    key = f"{name} " if name == GROUND else name
    if key in sketch.links:
        raise source.error(place, f"a second link {short(name)}", link=name)
    for joint in members:
        if joint not in sketch.joints:
            problem = f"link {short(name)} has the joint {short(joint)}, which does not exist"
            raise source.error(place, problem, link=name)
        sketch.connect(joint, key)


def _connect(source: Source, sketch: Sketch, joint: Joint) -> None:
    """Fix a joint to the frame, or let it slide there."""
    links = {f"{name} " if name == GROUND else name for name in joint.links}
    missing = sorted(links - set(sketch.links_at(joint.id)))
    if missing:
        problem = f"joint {short(joint.id)} is on link {short(missing[0])}, which does not have it"
        raise source.error(joint.place, problem, joint=joint.id)
    if not joint.slides:
        if joint.fixed:
            sketch.connect(joint.id, GROUND)
        return
    if not joint.fixed:
        problem = (
            f"joint {short(joint.id)} slides on a moving link, and the address does not say on "
            "which: open it in PMKS+ and share it anew"
        )
        raise source.error(joint.place, problem, joint=joint.id)
    riders = sketch.links_at(joint.id)
    # PMKS+ shows degrees, and keeps them here.
    angle = math.radians(math.remainder(joint.angle, 360.0))
    sketch.add_slot(joint.id, GROUND, riders, angle, turns=True)
    sketch.omitted.append(
        f"Joint {joint.id} slides on the frame, and its links turn about it: "
        f"its angle {joint.angle:g} is read in degrees."
    )


def _drive(sketch: Sketch, joint: Joint, speed: float | None) -> None:
    if not joint.slides:
        sketch.inputs.append(Input(joint.place, joint=joint.id, speed=speed))
        return
    slide = next(key for key, slot in sketch.slots.items() if slot.joint == joint.id)
    sketch.inputs.append(Input(joint.place, slide=slide))
    if speed is not None:
        sketch.omitted.append(f"Input {joint.id} slides: the speed, in rpm, is left out.")


def _settings(source: Source, sketch: Sketch, text: str) -> tuple[float | None, float | None]:
    """Return the speed in rad/s and the unit of length in m, where they are known."""
    words = [word.strip() for word in text.split(",")]
    speed = source.number(words[0], "s=", "the speed") * RPM if words[0] else None
    if speed and _flag(source, "s=", words[1] if words[1:] else "f", "clockwise"):
        speed = -speed
    if _flag(source, "s=", words[2] if words[2:] else "f", "gravity"):
        sketch.omitted.append("Gravity is left out.")
    unit = words[3].lower() if words[3:] and words[3] else "m"
    if unit not in UNITS:
        sketch.omitted.append(f"The unit of length {unit[:20]} is not known: read as they stand.")
    return speed, UNITS.get(unit)
