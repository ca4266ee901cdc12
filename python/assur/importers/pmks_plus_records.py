"""Records of PMKS+: what an address holds after its question mark.

Parts are separated by dots: flags, decimals, whole numbers, units, then a record for each joint, an
empty part, a record for each link, an empty part, a record for each force, and the selection with a
letter that checks the length. Newer addresses go on behind an asterisk, which the letter does not
count.

joint
    a digit of flags (slides, input, frame, welded, path, cylinder), its id, name, x, y, angle in
    rad; if it slides on a link also that link and two joints that give the direction; a speed
link
    Y or N, R or P (a block of a slide), its id, name, mass, inertia, centre of mass, colour,
    joints, an empty word, the links that it is welded of
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING
from urllib.parse import unquote

from assur._arrays import short
from assur.importers.base64_numbers import DIGITS, decimal, is_checked, whole
from assur.importers.names import listed

if TYPE_CHECKING:
    from assur.importers.sketch import Sketch
    from assur.importers.source import Source

# First letters of a link's record: it is a link of its own, or one that is welded into another.
ROOTS, PARTS = "YAMG0123", "Namg4567"
UNITS = {0: ("inches", 0.0254), 1: ("cm", 0.01), 2: ("m", 1.0)}
RPM = math.tau / 60.0


@dataclass
class Joint:
    """A record of a joint."""

    place: str
    id: str
    at: tuple[float, float]
    angle: float
    slides: bool
    is_input: bool
    fixed: bool
    welded: bool
    slot: list[str]
    speed: float | None


@dataclass
class Link:
    """A record of a link, or of the block of a slide."""

    id: str
    block: bool
    joints: list[str] = field(default_factory=list)
    parts: list[str] = field(default_factory=list)


def payload(text: str) -> str:
    """Return what an address holds."""
    text = text.strip()
    if "?" in text:
        text = text.partition("?")[2]
    return unquote(text.partition("#")[0])


def is_text(text: str) -> bool:
    """Whether a text is a linkage of PMKS+."""
    held = payload(text[:100_000])
    return bool(re.match(r"[0-9A-Za-z_-]{1,4}\.[0-9A-Za-z_,-]+\.[0-9A-Za-z_,-]+\.\d", held))


def parts(source: Source, sketch: Sketch) -> list[str]:
    """Return the parts of an address that is whole."""
    held, _, rest = payload(source.text).partition("*")
    if rest:
        sketch.omitted.append("What the address holds behind its * is left out.")
    if any(letter.isspace() for letter in held) and "\n" in held:
        raise source.error("", "an address is one line: give one linkage")
    if not is_checked(held):
        problem = "the last letter does not agree with the length: the address was cut or changed"
        raise source.error("", problem)
    records = held[:-1].split(".")
    if len(records) < 6:
        raise source.error("", f"{len(records)} parts: settings, joints and links are needed")
    source.require_few(len(records) // 3, "records")
    return records


def settings(
    source: Source, sketch: Sketch, parts: list[str], scale: float
) -> tuple[float, float | None]:
    """Return the speed of a crank, rad/s, and of a slide; say the unit of length."""
    clockwise = whole(source, parts[0], "settings", "the flags") & 1
    decimals = parts[1].split(",")
    speed = whole(source, parts[2].split(",")[0], "settings", "the input speed")
    unit = UNITS.get(DIGITS.find(parts[3][:1]))
    if unit is not None and unit[1] != 1.0 and scale == 1.0:
        sketch.omitted.append(
            f"Lengths are in {unit[0]} and read as they stand: scale={unit[1]:g} makes them m."
        )
    linear = decimal(source, decimals[1], "settings", "the speed of a slide") if decimals[1:] else 0
    return (-speed if clockwise else speed) * RPM, linear or None


def sections(source: Source, parts: list[str]) -> list[list[str]]:
    """Return the records of joints, links and forces, each ended by an empty part."""
    records: list[list[str]] = []
    for what in ("joints", "links", "forces"):
        if "" not in parts:
            if what != "forces":
                raise source.error("", f"the records of {what} have no end")
            records.append(parts[:-1])
            return records
        end = parts.index("")
        records.append(parts[:end])
        parts = parts[end + 1 :]
    return records


def joint_of(source: Source, place: str, text: str) -> Joint:
    """Return a joint from its record."""
    words = text.split(",")
    if len(words) < 5 or not words[0][1:]:
        needed = "flags, id, name, x, y and angle are needed"
        raise source.error(place, f"{short(text)} is not a joint: {needed}")
    flags = DIGITS.find(words[0][0])
    if flags < 0:
        raise source.error(place, f"the flags {words[0][0]!r} are not a digit")
    x, y, angle = (
        decimal(source, word, place, what)
        for word, what in zip(words[2:5], ("x", "y", "the angle"), strict=True)
    )
    slot = [word for word in words[5:8] if word]
    if slot and (len(slot) != 3 or slot[1] == slot[2] or flags & 4 or not flags & 1):
        problem = "the slot needs a link and two of its joints, and no place on the frame"
        raise source.error(place, f"{problem}: {listed(slot)}", joint=words[0][1:])
    speed = decimal(source, words[8], place, "the speed") if words[8:9] not in ([], [""]) else 0.0
    return Joint(
        place=place,
        id=words[0][1:],
        at=(x, y),
        angle=math.remainder(angle, math.tau),
        slides=bool(flags & 1),
        is_input=bool(flags & 2),
        fixed=bool(flags & 4),
        welded=bool(flags & 8),
        slot=slot,
        speed=speed or None,
    )


def links_of(source: Source, place: str, text: str) -> list[Link]:
    """Return the link, or none if it is welded into another."""
    words = text.split(",")
    if len(words) < 8 or len(words[0]) < 3 or words[0][0] not in ROOTS + PARTS:
        needed = "kind, id, name, mass, inertia, centre, colour and joints are needed"
        raise source.error(place, f"{short(text)} is not a link: {needed}")
    if words[0][1] not in "RP":
        raise source.error(place, f"the kind {words[0][1]!r} is neither R nor P")
    if words[0][0] in PARTS:
        return []
    joints, parts = words[7:], []
    if "" in joints:
        end = joints.index("")
        joints, parts = joints[:end], joints[end + 1 :]
    return [Link(words[0][2:], words[0][1] == "P", joints, parts)]


def check(source: Source, joints: list[Joint], links: list[Link]) -> None:
    """Refuse records of one id, and references to what does not exist."""
    if not joints:
        raise source.error("", "no joint is there")
    known = {joint.id: joint for joint in joints}
    twice: list[str] = []
    if len(known) != len(joints) or len({link.id for link in links}) != len(links):
        for names in ([joint.id for joint in joints], [link.id for link in links]):
            twice += [name for name in names if names.count(name) > 1]
        name = twice[0]
        raise source.error("", f"two records have the id {short(name)}")
    for link in links:
        missing = [name for name in link.joints if name not in known]
        if missing:
            joint_id = short(missing[0])
            problem = f"link {short(link.id)} has the joint {joint_id}, which does not exist"
            raise source.error("", problem, link=link.id)
    carriers = {link.id: link for link in links if not link.block}
    whole_of = {part: link.id for link in links for part in link.parts}
    for joint in joints:
        # A slot may be on a link that is now part of another.
        joint.slot[:1] = [whole_of.get(name, name) for name in joint.slot[:1]]
        carrier = carriers.get(joint.slot[0]) if joint.slot else None
        if joint.slot and (carrier is None or not set(joint.slot[1:]) <= set(carrier.joints)):
            both = listed(joint.slot[1:])
            problem = f"slot of joint {short(joint.id)}: no link has both joints {both}"
            raise source.error(joint.place, problem, joint=joint.id)
