"""Random mechanisms of class III, IV and V, turning and sliding pairs mixed."""

from __future__ import annotations

import math
import random
from typing import TYPE_CHECKING

import assur
from models.mechanisms import dyad_models
from models.mechanisms.mechanism_data import GROUND, Description, SlideSpec, arguments

if TYPE_CHECKING:
    from collections.abc import Sequence

# Links by their joints: capitals are on the ground, "a" is the crank's pin.
TOPOLOGIES: dict[str, Sequence[str]] = {
    "triad": ("ab", "bcd", "cE", "dF"),
    "quadrilateral": ("abc", "Ede", "bd", "ce"),
    "four ternaries": ("abc", "bde", "cf", "fge", "Hd", "Ig"),  # P4
    "six ternaries": ("abc", "bde", "dfG", "cfh", "hI", "eJ"),
    "pentagon": ("apq", "pBr", "rCs", "sDt", "tEq"),
}
# How far joints are from one another, and how often a turning pair becomes a sliding one.
SPREAD = 3.0
LEAST_APART = 0.25
SLIDING = 0.25
TRIES = 200


def higher_case(seed: int) -> dyad_models.Case:
    """A random drawing; any drawing is an assembly."""
    rng = random.Random(f"higher {seed}")
    names = [n for n in TOPOLOGIES if n != "six ternaries" and n != "pentagon"]
    for _ in range(TRIES):
        kind = rng.choice(names)
        description = _draw(rng, TOPOLOGIES[kind])
        try:
            m = assur.Mechanism(**arguments(description))
        except assur.AssurError:
            continue
        if m.structure.cls > 2:
            return dyad_models.Case(description, kind, (), seed)
    message = f"no mechanism for seed {seed}"
    raise ValueError(message)


def _draw(rng: random.Random, topology: Sequence[str]) -> Description:
    letters = sorted(set("".join(topology)))
    crank = rng.uniform(0.2, 0.8)
    angle = rng.uniform(-math.pi, math.pi)
    joints = {"O": (0.0, 0.0), "a": (crank * math.cos(angle), crank * math.sin(angle))}
    for letter in letters:
        while letter not in joints:
            place = (rng.uniform(-SPREAD, SPREAD), rng.uniform(-SPREAD, SPREAD))
            if all(math.dist(place, other) > LEAST_APART for other in joints.values()):
                joints[letter] = place
    links = {GROUND: ["O", *(x for x in letters if x.isupper())], "crank": ["O", "a"]}
    links |= {f"L{i}": list(joint) for i, joint in enumerate(topology)}
    slides: dict[str, SlideSpec] = {}
    for letter in letters:
        both = [name for name, own in links.items() if letter in own and name != "crank"]
        if letter == "a" or len(both) != 2 or rng.random() > SLIDING:
            continue
        for name in both:
            links[name].remove(letter)
        del joints[letter]
        on, link = both
        slides[f"s{letter}"] = SlideSpec(link, on, rng.uniform(-math.pi, math.pi))
    return Description(joints, links, slides, [("angle", "crank", GROUND)])
