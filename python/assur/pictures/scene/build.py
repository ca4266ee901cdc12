"""The scene of a mechanism: its links, pairs and drivers as symbols."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur.pictures import sizes
from assur.pictures.scene.geometry import at
from assur.pictures.scene.links import link_parts
from assur.pictures.scene.pairs import joint_part, pivot_parts, sliding_arrow, turning_arrow
from assur.pictures.scene.shapes import Line, Name, Part, Scene, Stroke
from assur.pictures.scene.slides import Slides

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur._faces import Mechanism
    from assur.pictures.scene.frames import Frames


def scene_of(mechanism: Mechanism, frames: Frames) -> Scene:
    """Return the scene of a mechanism; `frames` are those of its whole motion."""
    angles, sliding = _drivers(mechanism)
    driven = frozenset(link for link, _ in angles)
    slides = Slides(mechanism, frames, driven, frozenset(sliding))
    moving = [link for link in frames.links if link != "ground"]
    at_joint: dict[str, list[str]] = {}
    for link in frames.links:
        for joint in frames.local[link]:
            at_joint.setdefault(joint, []).append(link)
    pivots = [
        part
        for joint, point in frames.local.get("ground", {}).items()
        if len(at_joint[joint]) > 1
        for part in pivot_parts(joint, point)
    ]
    bodies: list[Line] = [
        part for link in moving for part in link_parts(link, frames.local[link], link in driven)
    ]
    lines = [*bodies, *slides.parts()]
    arrows = [part for link, relative_to in angles for part in _turning(frames, link, relative_to)]
    arrows += [part for name in sliding for part in sliding_arrow(slides.axis(name))]
    blocks = {
        (part.link, *part.vertices[0][:2])
        for part in lines
        if isinstance(part, Stroke) and part.fill == "canvas"
    }
    joints, names = [], []
    for joint, links in at_joint.items():
        point = frames.local[links[0]][joint]
        joints.append(joint_part(joint, links[0], point, len(links), "ground" in links))
        centres = [(link, *frames.local[link][joint].tolist()) for link in links]
        radius = sizes.BLOCK_LENGTH / 2.0 if blocks.intersection(centres) else sizes.PIVOT
        names.append(Name(joint, links[0], at(point), radius))
    return Scene(
        frames.links,
        # Plates lie under bars, guides under blocks, everything under the joints.
        (*sorted(lines, key=lambda part: part.floor), *pivots, *arrows, *joints),
        tuple(names),
        driven,
        {link: i for i, group in enumerate(mechanism.structure.groups) for link in group.links},
    )


def _drivers(mechanism: Mechanism) -> tuple[list[tuple[str, str]], list[str]]:
    """Return the driven links, each with the one it is measured from, and the driven slides."""
    drivers = mechanism.description.drivers
    sliding = [
        driver for driver in drivers if isinstance(driver, str) and driver in mechanism.slides
    ]
    angles = [
        (driver, "ground") if isinstance(driver, str) else (driver.link, driver.relative_to)
        for driver in drivers
        if driver not in sliding
    ]
    return angles, sliding


def _turning(frames: Frames, link: str, relative_to: str) -> list[Part]:
    """Draw the arrow of a driven angle: about the joint of both links if they share one."""
    places = frames.local[link]
    shared = [joint for joint in places if joint in frames.local.get(relative_to, {})]
    pivot: Float = places[shared[0]] if shared else next(iter(places.values()), np.zeros(2))
    arms = [point - pivot for point in places.values()]
    longest = max(arms, key=lambda arm: float(np.hypot(*arm)), default=np.zeros(2))
    toward = float(np.arctan2(longest[1], longest[0])) if longest.any() else 0.0
    return turning_arrow(link, pivot, toward)
