"""Random mechanisms of dyads and higher groups in any order, driven anywhere.

A tree: drivers, then one to five groups, each hung on links and joints that are already there.
"""

from __future__ import annotations

import math
import random
from collections import Counter
from dataclasses import replace
from typing import TYPE_CHECKING

from hypothesis import strategies as st

from models.mechanisms import dyad_models
from models.mechanisms.mechanism_data import GROUND
from oracles.kinematics.pair_jacobian import regularity

if TYPE_CHECKING:
    from collections.abc import Sequence

    from models.mechanisms.mechanism_data import DriverSpec

# Groups above class II, links by their joints: capitals are outer joints. The figure is how often
# one is drawn.
GROUPS: dict[str, tuple[int, Sequence[str]]] = {
    "triad": (5, ("Ab", "bcd", "cE", "dF")),
    "two ternaries": (2, ("Ab", "Cc", "bcd", "def", "eG", "fH")),
    "three ternaries": (1, ("Ab", "Cc", "bcd", "def", "eG", "fgh", "gI", "hJ")),
    "quadrilateral": (4, ("Abc", "Ede", "bd", "ce")),
    "four ternaries": (2, ("Abc", "bde", "cf", "fge", "Hd", "Ig")),  # P4
    "quadrilateral with legs": (
        1,
        ("pqa", "qrb", "rsc", "spd", "aA", "bB", "cC", "dD"),
    ),
    "six ternaries": (1, ("Abc", "bde", "dfG", "cfh", "hI", "eJ")),
    "pentagon": (1, ("pqa", "qrb", "rsc", "std", "tpe", "aA", "bB", "cC", "dD", "eE")),
}
ONE = tuple(kind for kind in dyad_models.DRIVERS if kind != "two_cranks")
TWO = ("two_cranks", "arm")
SLIDING = 0.25  # of the turning pairs become sliding ones
TWICE = 0.1  # of the mechanisms have two drivers
HIGHER = 0.85  # of the mechanisms have a group above class II of their own
MOVED = 0.25  # of the mechanisms are driven by another pair, link or two links
LEAST_APART = 0.2
# The least singular value of the drawing's Jacobian: no drawing is near a dead point.
REGULAR = 2e-3
TRIES = 400


class Builder(dyad_models._Builder):
    """Drivers, dyads and higher groups."""

    def drive_arm(self) -> None:
        """A crank on the ground, and on its pin another, driven relative to it."""
        self.drive_crank()
        upper = str(self.drivers[0][1])
        elbow = self.links[upper][1]
        tip = self.joint(self.beyond(self.joints[elbow], self.angle()))
        self.drivers.append(("angle", self.link(elbow, tip), upper))

    def group(self, kind: str) -> None:
        """A group above class II, its outer joints on at least two links."""
        topology = GROUPS[kind][1]
        letters = sorted(set("".join(topology)))
        outer = [x for x in letters if x.isupper()]
        hosts = self.hosts(len(outer))
        joints = {x: self.outer_joint(host) for x, host in zip(outer, hosts, strict=True)}
        for x in letters:
            if x not in joints:
                joints[x] = self.joint(self.apart())
        own = [self.link(*(joints[x] for x in link)) for link in topology]
        for x in letters:
            both = [n for n, there in self.links.items() if joints[x] in there]
            needed = any(len(self.links[n]) < 2 for n in both)
            needed |= any(slide.origin == joints[x] for slide in self.slides.values())
            if len(both) == 2 and not needed and self.rng.random() < SLIDING:
                self.become_slide(joints[x], *both)
        if self.rng.random() < 0.4:  # a coupler point
            link = self.rng.choice(own)
            self.joint(self.beyond(self.joints[self.links[link][0]], self.angle()), link)

    def hosts(self, count: int) -> list[str]:
        """Links to hang on: a third of the time the ground, otherwise any."""
        there = list(self.links)
        while True:
            found = [
                GROUND if self.rng.random() < 1 / 3 else self.rng.choice(there)
                for _ in range(count)
            ]
            if len(set(found)) > 1:
                return found

    def outer_joint(self, host: str) -> str:
        """A joint that is already there (more than two links then meet), or a new one."""
        taken = Counter(j for own in self.links.values() for j in own)
        there = [j for j in self.links[host] if taken[j] < 3]
        if there and self.rng.random() < 0.35:
            return self.rng.choice(there)
        return self.joint(self.apart(), host)

    def apart(self) -> dyad_models.Place:
        """A point about the middle, not too near to any joint."""
        while True:
            place = self.near()
            if all(math.dist(place, other) > LEAST_APART for other in self.joints.values()):
                return place

    def become_slide(self, joint: str, first: str, second: str) -> None:
        """A sliding pair in place of a turning one, anywhere along its guide."""
        for name in (first, second):
            self.links[name].remove(joint)
        del self.joints[joint]
        a, b = (first, second) if second == GROUND else (second, first)
        self.slide(a, b, self.angle())

    def joint(self, place: dyad_models.Place, *links: str) -> str:
        """As names of joints that became slides are free again, they are not counted."""
        self.named = getattr(self, "named", 0) + 1
        name = f"J{self.named}"
        self.joints[name] = place
        for link in links:
            self.links[link].append(name)
        return name

    def move_driver(self) -> None:
        """Drive another slide or angle in place of one of the drivers."""
        k = self.rng.randrange(len(self.drivers))
        moving = [n for n in self.links if n != GROUND]
        link = self.rng.choice(moving)
        other = [n for n in moving if n != link]
        choices: list[DriverSpec] = [("angle", link, GROUND)]
        choices += [("angle", link, self.rng.choice(other))] if other else []
        choices += [("slide", self.rng.choice(list(self.slides)))] if self.slides else []
        self.drivers[k] = self.rng.choice(choices)


def mixed_case(seed: int) -> dyad_models.Case:
    """The mechanism of this seed, whose drawing is an assembly and far from dead points."""
    rng = random.Random(f"mixed {seed}")
    for _ in range(TRIES):
        builder = Builder(rng)
        driver = rng.choice(TWO if rng.random() < TWICE else ONE)
        builder.driver(driver)
        kinds = draw_kinds(rng)
        for kind in kinds:
            if kind in GROUPS:
                builder.group(kind)
            else:
                builder.dyad(kind)
        description = builder.finish()
        if rng.random() < MOVED:
            builder.move_driver()
            description, driver = replace(description, drivers=list(builder.drivers)), "moved"
        if regularity(description) > REGULAR:
            return dyad_models.Case(description, driver, tuple((k, ("", "")) for k in kinds), seed)
    message = f"no mechanism for seed {seed}"
    raise ValueError(message)


def draw_kinds(rng: random.Random) -> list[str]:
    """One to five groups in any order, mostly with a higher one among them."""
    count = rng.randint(1, 5)
    kinds = [rng.choice(dyad_models.KINDS) for _ in range(count)]
    if rng.random() < HIGHER:
        weights = [weight for weight, _ in GROUPS.values()]
        for k in rng.sample(range(count), rng.choice((1, 1, 2)) if count > 1 else 1):
            kinds[k] = rng.choices(list(GROUPS), weights)[0]
    return kinds


def mixed() -> st.SearchStrategy[dyad_models.Case]:
    """Dyads and higher groups in any order."""
    return st.builds(mixed_case, st.integers(0, 2**32 - 1))
