"""PMKS+ (PMKSWeb): addresses that hold a linkage after their question mark."""

from __future__ import annotations

from typing import TYPE_CHECKING

from assur._arrays import short
from assur._trig import arctan2
from assur.importers import pmks_plus_older
from assur.importers import pmks_plus_records as records
from assur.importers.build import finish
from assur.importers.names import listed
from assur.importers.pmks_plus_records import RPM, Joint, Link
from assur.importers.sketch import GROUND, Input, Sketch
from assur.importers.source import open_source

if TYPE_CHECKING:
    from collections.abc import Mapping

    from assur.importers.build import Imported
    from assur.importers.source import Source, SourceLike

__all__ = ["read"]

# Half a thousandth: lengths and angles have three decimals.
RESOLUTION = 5e-4


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
        Text that is not in this format, or was cut; joints and links that do not exist.
    StructureError
        A linkage that is not a mechanism.

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
    sketch = Sketch(resolution=RESOLUTION, angle_resolution=RESOLUTION)
    if pmks_plus_older.is_text(opened.text):
        pmks_plus_older.read_fields(opened, sketch, scale)
        return finish(opened, sketch, "pmks_plus", scale, assembly)
    parts = records.parts(opened, sketch)
    speeds = records.settings(opened, sketch, parts, scale)
    sections = records.sections(opened, parts[4:])
    joints = [records.joint_of(opened, f"joint {i}", text) for i, text in enumerate(sections[0], 1)]
    links: list[Link] = []
    for count, text in enumerate(sections[1], 1):
        links += records.links_of(opened, f"link {count}", text)
    records.check(opened, joints, links)
    _connect(opened, sketch, joints, links)
    _drive(sketch, joints, links, speeds)
    if links:
        sketch.omitted.append("Masses, inertias and centres of mass are left out.")
    if sections[2]:
        names = [text.split(",")[0][1:] for text in sections[2]]
        sketch.omitted.append(f"Forces are left out: {listed(names)}.")
    return finish(opened, sketch, "pmks_plus", scale, assembly)


def _connect(source: Source, sketch: Sketch, joints: list[Joint], links: list[Link]) -> None:
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
    source: Source, sketch: Sketch, joint: Joint, known: dict[str, Joint], links: list[Link]
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
    sketch: Sketch,
    joints: list[Joint],
    links: list[Link],
    speeds: tuple[float, float | None],
) -> None:
    """Inputs: either joint of a block may be marked."""
    blocks = {name: link.joints for link in links if link.block for name in link.joints}
    driven: set[str] = set()
    for joint in joints:
        if not joint.is_input:
            continue
        names = {joint.id, *blocks.get(joint.id, ())}
        slides = [key for key, slot in sketch.slots.items() if slot.joint in names]
        speed: float | None
        if not slides:
            speed = speeds[0] if joint.speed is None else joint.speed * RPM
            sketch.inputs.append(Input(joint.place, joint=joint.id, speed=speed))
        elif slides[0] not in driven:
            driven.add(slides[0])
            speed = speeds[1] if joint.speed is None else joint.speed
            sketch.inputs.append(Input(joint.place, slide=slides[0], speed=speed))
