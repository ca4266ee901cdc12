"""PMKS+ (PMKSWeb): addresses that hold a linkage after their question mark.

Parts are parted by dots: flags, decimals, whole numbers, units, then a record a joint, an empty
part, a record a link, an empty part, a record a force, and the selection with a letter that checks
the length.

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
from assur._trig import arctan2
from assur.importers.base64_numbers import DIGITS, decimal, is_checked, whole
from assur.importers.build import finish
from assur.importers.names import listed
from assur.importers.sketch import GROUND, Input, Sketch
from assur.importers.source import open_source

if TYPE_CHECKING:
    from collections.abc import Mapping

    from assur.importers.build import Imported
    from assur.importers.source import Source, SourceLike

__all__ = ["read"]

# First letters of a link's record: it is a link of its own, or one that is welded into another.
ROOTS, PARTS = "YAMG0123", "Namg4567"
UNITS = {0: ("inches", 0.0254), 1: ("cm", 0.01), 2: ("m", 1.0)}
RPM = math.tau / 60.0


@dataclass
class _Joint:
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
class _Link:
    id: str
    block: bool
    joints: list[str] = field(default_factory=list)


def read(
    source: SourceLike, *, scale: float = 1.0, assembly: Mapping[str, int] | None = None
) -> Imported:
    """Read a linkage of PMKS+.

    Parameters
    ----------
    source : str or path-like
        An address, or what follows its question mark, or a file with it.
    scale : float
        The file's unit of length, m.
    assembly : mapping of str to int, optional
        For dyads drawn with their links collinear: see `Mechanism`.

    Returns
    -------
    Imported
        Joints and links have their ids.

    Raises
    ------
    InputError
        What is no such text, or was cut; joints and links that do not exist.
    StructureError
        What is no mechanism.

    Examples
    --------
    >>> from assur import importers
    >>> found = importers.pmks_plus.read(
    ...     "0.Fe.A,0.2111.6A,,0,0,0.0B,,0,Fe,0.0C,,k_,VG,0.4D,,k_,0,0.."
    ...     "YRAB,,0,0,0,0,,A,B,,.YRBC,,0,0,0,0,,B,C,,.YRCD,,0,0,0,0,,C,D,,..N_1")
    >>> found.mechanism.structure.formula
    'I(AB) → II(BC, CD)'
    """
    opened = open_source(source)
    parts = _parts(opened)
    sketch = Sketch()
    speeds = _settings(opened, sketch, parts, scale)
    records = _sections(opened, parts[4:])
    joints = [_joint(opened, f"joint {i}", text) for i, text in enumerate(records[0], 1)]
    links = []
    for count, text in enumerate(records[1], 1):
        links += _link(opened, f"link {count}", text)
    _check(opened, joints, links)
    _connect(opened, sketch, joints, links)
    _drive(opened, sketch, joints, links, speeds)
    if links:
        sketch.omitted.append("Masses, inertias and centres of mass are left out.")
    if records[2]:
        names = [text.split(",")[0][1:] for text in records[2]]
        sketch.omitted.append(f"Forces are left out: {listed(names)}.")
    return finish(opened, sketch, "pmks_plus", scale, assembly)


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


def _parts(source: Source) -> list[str]:
    held = payload(source.text)
    if any(letter.isspace() for letter in held) and "\n" in held:
        raise source.error("", "an address is one line: give one linkage")
    if not is_checked(held):
        problem = "the last letter does not agree with the length: the address was cut or changed"
        raise source.error("", problem)
    parts = held[:-1].split(".")
    if len(parts) < 6:
        raise source.error("", f"{len(parts)} parts: settings, joints and links are needed")
    source.require_few(len(parts) // 3, "records")
    return parts


def _settings(
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


def _sections(source: Source, parts: list[str]) -> list[list[str]]:
    """Return the records of joints, links and forces, each ended by an empty part."""
    sections: list[list[str]] = []
    for what in ("joints", "links", "forces"):
        if "" not in parts:
            if what != "forces":
                raise source.error("", f"the records of {what} have no end")
            sections.append(parts[:-1])
            return sections
        end = parts.index("")
        sections.append(parts[:end])
        parts = parts[end + 1 :]
    return sections


def _joint(source: Source, place: str, text: str) -> _Joint:
    words = text.split(",")
    if len(words) < 5 or not words[0][1:]:
        needed = "flags, id, name, x, y and angle are needed"
        raise source.error(place, f"{short(text)} is no joint: {needed}")
    flags = DIGITS.find(words[0][0])
    if flags < 0:
        raise source.error(place, f"the flags {words[0][0]!r} are no digit")
    x, y, angle = (
        decimal(source, word, place, what)
        for word, what in zip(words[2:5], ("x", "y", "the angle"), strict=True)
    )
    slot = [word for word in words[5:8] if word]
    if slot and (len(slot) != 3 or slot[1] == slot[2] or flags & 4 or not flags & 1):
        problem = "the slot needs a link and two of its joints, and no place on the frame"
        raise source.error(place, f"{problem}: {listed(slot)}", joint=words[0][1:])
    own = decimal(source, words[8], place, "the speed") if words[8:9] not in ([], [""]) else 0.0
    bits = [bool(flags >> bit & 1) for bit in range(4)]
    angle = math.remainder(angle, math.tau)
    return _Joint(place, words[0][1:], (x, y), angle, *bits, slot, own or None)


def _link(source: Source, place: str, text: str) -> list[_Link]:
    """Return the link, or none if it is welded into another."""
    words = text.split(",")
    if len(words) < 8 or len(words[0]) < 3 or words[0][0] not in ROOTS + PARTS:
        needed = "kind, id, name, mass, inertia, centre, colour and joints are needed"
        raise source.error(place, f"{short(text)} is no link: {needed}")
    if words[0][1] not in "RP":
        raise source.error(place, f"the kind {words[0][1]!r} is neither R nor P")
    if words[0][0] in PARTS:
        return []
    joints = words[7:]
    joints = joints[: joints.index("")] if "" in joints else joints
    return [_Link(words[0][2:], words[0][1] == "P", joints)]


def _check(source: Source, joints: list[_Joint], links: list[_Link]) -> None:
    known = {joint.id: joint for joint in joints}
    if len(known) != len(joints) or len({link.id for link in links}) != len(links):
        twice = [one.id for one in (*joints, *links)]
        name = next(name for name in twice if twice.count(name) > 1)
        raise source.error("", f"two records have the id {short(name)}")
    for link in links:
        missing = [name for name in link.joints if name not in known]
        if missing:
            joint_id = short(missing[0])
            problem = f"link {short(link.id)} has the joint {joint_id}, which does not exist"
            raise source.error("", problem, link=link.id)
    carriers = {link.id: link for link in links if not link.block}
    for joint in joints:
        carrier = carriers.get(joint.slot[0]) if joint.slot else None
        if joint.slot and (carrier is None or not set(joint.slot[1:]) <= set(carrier.joints)):
            both = listed(joint.slot[1:])
            problem = f"slot of joint {short(joint.id)}: no link has both joints {both}"
            raise source.error(joint.place, problem, joint=joint.id)


def _connect(source: Source, sketch: Sketch, joints: list[_Joint], links: list[_Link]) -> None:
    known = {joint.id: joint for joint in joints}
    for joint in joints:
        if not joint.slides:
            sketch.joints[joint.id] = joint.at
    for link in links:
        if not link.block:
            for name in link.joints:
                sketch.joints.setdefault(name, known[name].at)
                sketch.connect(name, link.id)
    for joint in joints:
        if joint.slides:
            _slide(source, sketch, joint, known, links)
            continue
        if joint.fixed:
            sketch.connect(joint.id, GROUND)
        if joint.welded:
            sketch.welds.append((joint.id, [n for n in sketch.links_at(joint.id) if n != GROUND]))


def _slide(
    source: Source, sketch: Sketch, joint: _Joint, known: dict[str, _Joint], links: list[_Link]
) -> None:
    """A joint that slides: alone, or in a block with the pin that it guides."""
    block = next((link for link in links if link.block and joint.id in link.joints), None)
    pins = [name for name in block.joints if name != joint.id] if block else [joint.id]
    if len(pins) != 1 or (block and known[pins[0]].slides):
        problem = f"the block of joint {short(joint.id)} has {len(pins)} pins: one is needed"
        raise source.error(joint.place, problem, joint=joint.id)
    if not joint.slot and not joint.fixed:
        problem = f"joint {short(joint.id)} slides on nothing: the frame or a link is needed"
        raise source.error(joint.place, problem, joint=joint.id)
    pin, carrier, angle = pins[0], GROUND, joint.angle
    if joint.slot:
        carrier, start, end = joint.slot
        (x, y), (u, v) = known[start].at, known[end].at
        if (x, y) == (u, v):
            problem = f"joints {start} and {end} are at one place and give a slot no direction"
            raise source.error(joint.place, problem, joint=joint.id)
        angle = float(arctan2(v - y, u - x))
    sketch.joints.setdefault(pin, known[pin].at)
    riders = [name for name in sketch.links_at(pin) if name not in (carrier, GROUND)]
    welded = joint.welded or known[pin].welded
    sketch.add_slot(pin, carrier, riders, angle, turns=not (welded and riders))


def _drive(
    source: Source,
    sketch: Sketch,
    joints: list[_Joint],
    links: list[_Link],
    speeds: tuple[float, float | None],
) -> None:
    """Inputs: of a block either joint may be marked."""
    blocks = {name: link.joints for link in links if link.block for name in link.joints}
    driven: set[str] = set()
    for joint in joints:
        if not joint.is_input:
            continue
        names = {joint.id, *blocks.get(joint.id, ())}
        slides = [key for key, slot in sketch.slots.items() if slot.joint in names]
        if not slides:
            speed = speeds[0] if joint.speed is None else joint.speed * RPM
            sketch.inputs.append(Input(joint.place, joint=joint.id, speed=speed))
        elif slides[0] not in driven:
            driven.add(slides[0])
            speed = speeds[1] if joint.speed is None else joint.speed
            sketch.inputs.append(Input(joint.place, slide=slides[0], speed=speed))
    if not joints:
        raise source.error("", "no joint is there")
