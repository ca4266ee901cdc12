"""The text of PMKS: a line per joint; in an address after ``mech=``, separated by ``|``.

A line has the names of the joint's links, its type (R, P, RP), x, y, for P and RP the direction of
the guide in degrees, and four letters t or f, the last of which marks the input. The first link
of a P or RP joint carries the guide. A joint of one link is a point of it.
"""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING
from urllib.parse import unquote

from assur._arrays import counted, short
from assur.importers.names import listed
from assur.importers.pmks_joints import TYPES, add_input, add_joint

if TYPE_CHECKING:
    from assur.importers.sketch import Sketch
    from assur.importers.source import Source

FLAGS = re.compile(r"[tf+-]{1,4}", re.IGNORECASE)
SETTINGS = ("set=", "ts=")


def is_text(text: str) -> bool:
    """Whether the first line of a text is a joint of PMKS, or holds joints after mech=."""
    if "mech=" in text:
        return True
    lines = (line for line in re.split(r"[\n|]", text[:10_000]) if line.strip())
    joints = (line for line in lines if not line.startswith(SETTINGS))
    words = re.split(r"[,\s]+", next(joints, "").strip())
    kinds = [i for i, word in enumerate(words) if word.upper() in TYPES and i]
    return bool(kinds) and len(words) > kinds[-1] + 2


def read_text(source: Source, sketch: Sketch) -> None:
    """Add the joints and the input of a text."""
    lines, speed = _lines(source)
    inputs: list[tuple[str, str, str]] = []
    candidates: list[tuple[str, str, str]] = []
    source.require_few(len(lines))
    for count, (line, text) in enumerate(lines, 1):
        place, name = f"line {line}", f"J{count}"
        links, kind, (x, y, angle), is_input = _record(source, place, text)
        add_joint(source, sketch, place, name, kind, links, (x, y), math.radians(angle))
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
        add_input(source, sketch, name, kind, place, speed)
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
        problem = f"{short(text.strip())} is not a joint: its links, R, P or RP, x and y are needed"
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
