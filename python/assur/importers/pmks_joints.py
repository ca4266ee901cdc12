"""Joints and inputs of PMKS, from its text or its JSON."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING

from assur.importers.names import listed
from assur.importers.sketch import GROUND, Input

if TYPE_CHECKING:
    from assur.importers.sketch import Sketch
    from assur.importers.source import Source

TYPES = ("R", "P", "RP", "G")
# So PMKS writes and reads the frame.
FRAME = re.compile(r"ground.*|0|gnd|grnd|grond|gound|groud", re.IGNORECASE | re.DOTALL)
RPM = math.tau / 60.0


def add_joint(
    source: Source,
    sketch: Sketch,
    place: str,
    name: str,
    kind: str,
    links: list[str],
    at: tuple[float, float],
    angle: float,
) -> None:
    """Add a joint; the first link of a sliding one carries its guide."""
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


def add_input(
    source: Source,
    sketch: Sketch,
    name: str,
    kind: str,
    place: str,
    speed: float | None,
    unit: float = RPM,
) -> None:
    """Add the input; `unit` is that of the speed of a turning joint, rad/s."""
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
