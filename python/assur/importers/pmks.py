"""PMKS: lines of text, addresses of its page with such lines, and ``.pmks`` files (JSON).

A line is a joint: the names of its links, its type (R, P, RP), x, y, for P and RP the direction of
the guide in degrees, and four letters t or f, the last of which marks the input. The first link
of a P or RP joint carries the guide. A joint of one link is a point of it.
"""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any
from urllib.parse import unquote

from assur._arrays import counted, short
from assur.importers.build import finish
from assur.importers.json_text import items_of, parse_json, words_of
from assur.importers.names import listed
from assur.importers.sketch import GROUND, Input, Sketch
from assur.importers.source import open_source

if TYPE_CHECKING:
    from collections.abc import Mapping

    from assur.importers.build import Imported
    from assur.importers.source import Source, SourceLike

__all__ = ["read"]

TYPES = ("R", "P", "RP", "G")
FLAGS = re.compile(r"[tf+-]{1,4}", re.IGNORECASE)
# So PMKS writes and reads the frame.
FRAME = re.compile(r"ground.*|0|gnd|grnd|grond|gound|groud", re.IGNORECASE | re.DOTALL)
SETTINGS = ("set=", "ts=")
RPM = math.tau / 60.0


def read(
    source: SourceLike, *, scale: float = 1.0, assembly: Mapping[str, int] | None = None
) -> Imported:
    """Read a linkage of PMKS.

    Parameters
    ----------
    source : str or path-like
        A file, or its text; an address of PMKS with ``mech=``.
    scale : float
        The file's unit of length, m.
    assembly : mapping of str to int, optional
        For dyads drawn with their links collinear: see `Mechanism`.

    Returns
    -------
    Imported
        Joints are J1, J2 and so on, in the order of the file.

    Raises
    ------
    InputError
        What is no such text, with its line; gears.
    StructureError
        What is no mechanism.

    Examples
    --------
    >>> from assur import importers
    >>> found = importers.pmks.read('''
    ... ground crank R 0 0 0 ffft
    ... crank rod R 0 1
    ... rod block R 3 0
    ... ground block P 3 0 0
    ... ''')
    >>> found.mechanism.structure.formula
    'I(crank) → II(rod, block)'
    """
    opened = open_source(source)
    sketch = Sketch()
    is_json = opened.text.lstrip().startswith("{")
    _read_json(opened, sketch) if is_json else _read_text(opened, sketch)
    return finish(opened, sketch, "pmks", scale, assembly)


def is_text(text: str) -> bool:
    """Whether the first line of a text is a joint of PMKS, or holds joints after mech=."""
    if "mech=" in text:
        return True
    lines = (line for line in re.split(r"[\n|]", text[:10_000]) if line.strip())
    joints = (line for line in lines if not line.startswith(SETTINGS))
    words = re.split(r"[,\s]+", next(joints, "").strip())
    kinds = [i for i, word in enumerate(words) if word.upper() in TYPES and i]
    return bool(kinds) and len(words) > kinds[-1] + 2


# -- text -----------------------------------------------------------------------------------------


def _read_text(source: Source, sketch: Sketch) -> None:
    lines, speed = _lines(source)
    inputs: list[tuple[str, str, str]] = []
    candidates: list[tuple[str, str, str]] = []
    source.require_few(len(lines))
    for count, (line, text) in enumerate(lines, 1):
        place, name = f"line {line}", f"J{count}"
        links, kind, (x, y, angle), is_input = _record(source, place, text)
        _add(source, sketch, place, name, kind, links, (x, y), math.radians(angle))
        if is_input:
            inputs.append((name, kind, place))
        if len(links) > 1 and kind in ("R", "P"):
            candidates.append((name, kind, place))
    if not inputs and candidates:
        inputs = candidates[:1]
        sketch.omitted.append(
            f"No joint is marked as the input: as in PMKS, it is the first of two links, "
            f"{inputs[0][0]}."
        )
    for name, kind, place in inputs[-1:]:
        _drive(source, sketch, name, kind, place, speed)
    if len(inputs) > 1:
        names = [name for name, _, _ in inputs]
        sketch.omitted.append(
            f"Joints {listed(names)} are marked as inputs: as in PMKS, the last one drives."
        )


def _lines(source: Source) -> tuple[list[tuple[int, str]], float | None]:
    """Return the joints' texts with their lines, and the speed that is set, rpm or lengths/s."""
    text = source.text
    first, count = 1, text.count("mech=")
    if count > 1:
        problem = f"{count} linkages (mech=): give one of them"
        raise source.error("", problem)
    head, mark, body = text.partition("mech=")
    if not mark:
        head, body = "", text
    first += head.count("\n")
    if "?" in head.rpartition("\n")[2]:
        body = unquote(body.partition("\n")[0].partition("&")[0])
        head = unquote(head)
    lines = []
    for number, line in enumerate(body.split("\n"), first):
        if line.startswith(SETTINGS):
            head += f"\n{line}"
            continue
        lines += [(number, part) for part in line.split("|") if part.strip(" ,\r\t")]
    if not lines:
        raise source.error("", "no line of a joint is there")
    speed = re.search(r"set=(?:[^&\s]{0,40}\|)?s([-+.0-9eE]{1,30})", head)
    return lines, None if speed is None else source.number(speed[1], "set=", "the speed")


def _record(
    source: Source, place: str, text: str
) -> tuple[list[str], str, tuple[float, float, float], bool]:
    """Return links, type, (x, y, angle in degrees) and whether it is the input."""
    words = [word for word in re.split(r"[,\s]+", text) if word]
    at = max((i for i, word in enumerate(words) if word.upper() in TYPES), default=0)
    if not at:
        problem = f"{short(text.strip())} is no joint: its links, R, P or RP, x and y are needed"
        raise source.error(place, problem)
    links, kind, rest = words[:at], words[at].upper(), words[at + 1 :]
    flags = ""
    if rest and FLAGS.fullmatch(rest[-1]):
        flags = rest.pop().lower()
    if not 2 <= len(rest) <= 3:
        numbers = counted(len(rest), "number")
        problem = f"joint of {listed(links)} has {numbers}: x, y and perhaps an angle are needed"
        raise source.error(place, problem)
    x, y = (source.number(word, place, what) for word, what in zip(rest, "xy", strict=False))
    angle = source.number(rest[2], place, "the angle") if len(rest) > 2 else 0.0
    return links, kind, (x, y, math.remainder(angle, 360.0)), flags[3:] in ("t", "+")


# -- JSON -----------------------------------------------------------------------------------------


def _read_json(source: Source, sketch: Sketch) -> None:
    data = parse_json(source)
    kinds: list[str] = []
    source.require_few(len(items_of(source, data, "Joints")))
    for count, joint in enumerate(items_of(source, data, "Joints"), 1):
        place, name = f"Joints[{count - 1}]", f"J{count}"
        links = words_of(source, joint, "Links", place)
        kind = joint.get("TypeOfJoint")
        if not isinstance(kind, str) or kind.upper() not in TYPES:
            problem = f"TypeOfJoint is {short(kind)}: R, P or RP is needed"
            raise source.error(place, problem)
        x, y = (source.number(joint.get(what), place, what) for what in "XY")
        kinds.append(kind.upper())
        angle = _json_angle(source, joint, place, links, kinds[-1])
        _add(source, sketch, place, name, kinds[-1], links, (x, y), angle)
    index = data.get("DrivingIndex", 0)
    if isinstance(index, bool) or not isinstance(index, int) or not 0 <= index < len(kinds):
        needed = f"the index of one of the {len(kinds)} joints is needed"
        raise source.error("", f"DrivingIndex is {short(index)}: {needed}")
    given = data.get("InputSpeed")
    speed = None if given is None else source.number(given, "", "InputSpeed")
    _drive(source, sketch, f"J{index + 1}", kinds[index], f"Joints[{index}]", speed, unit=1.0)


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


# -- both -----------------------------------------------------------------------------------------


def _add(
    source: Source,
    sketch: Sketch,
    place: str,
    name: str,
    kind: str,
    links: list[str],
    at: tuple[float, float],
    angle: float,
) -> None:
    links = list(dict.fromkeys(GROUND if FRAME.fullmatch(link) else link for link in links))
    if kind == "G":
        problem = f"joint {name} of {listed(links)} is a gear mesh: gears cannot be described"
        raise source.error(place, problem, joint=name)
    sketch.joints[name] = at
    if kind == "R" or len(links) == 1:
        for link in links:
            sketch.connect(name, link)
        return
    if kind == "P" and len(links) > 2:
        problem = f"sliding joint {name} has {len(links)} links, {listed(links)}: two are needed"
        raise source.error(place, problem, joint=name)
    sketch.links.setdefault(links[0], [])
    sketch.add_slot(name, links[0], links[1:], angle, turns=kind == "RP")


def _drive(
    source: Source,
    sketch: Sketch,
    name: str,
    kind: str,
    place: str,
    speed: float | None,
    unit: float = RPM,
) -> None:
    if kind == "RP":
        problem = f"input joint {name} is a pin in a slot: it has two freedoms, and cannot drive"
        raise source.error(place, problem, joint=name)
    if kind == "P":
        slide = next((key for key, slot in sketch.slots.items() if slot.joint == name), None)
        if slide is None:
            raise source.error(place, f"input joint {name} has one link", joint=name)
        sketch.inputs.append(Input(place, slide=slide, speed=speed))
        return
    turning = None if speed is None else speed * unit
    sketch.inputs.append(Input(place, joint=name, speed=turning))
