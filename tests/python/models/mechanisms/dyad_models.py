"""Random mechanisms that are assembled by construction.

A random mechanism is drawn place by place: a driver, then dyads hung on links already there.
Nothing is rejected: every choice of the random numbers is a mechanism whose drawing closes exactly
and in which no dyad is flat (the sine of the angle between its legs is at least 0.05).
"""

from __future__ import annotations

import math
import random
from dataclasses import dataclass, field
from typing import TypeVar

from hypothesis import strategies as st

from models.mechanisms.mechanism_data import GROUND, Description, DriverSpec, SlideSpec

T = TypeVar("T")
Place = tuple[float, float]
KINDS = ("RRR", "RRP", "RPR", "PRP", "RPP")
DRIVERS = ("crank", "slide", "cylinder", "elbow", "coupler", "two_cranks")
LEAST_SINE = 0.05


@dataclass(frozen=True)
class Case:
    """A random mechanism and what it was built of (its driver may bring a dyad of its own)."""

    description: Description
    driver: str
    dyads: tuple[tuple[str, tuple[str, str]], ...]  # kind, its two links; in order of building
    seed: int


@dataclass
class _Builder:
    rng: random.Random
    joints: dict[str, Place] = field(default_factory=dict)
    links: dict[str, list[str]] = field(default_factory=lambda: {GROUND: []})
    slides: dict[str, SlideSpec] = field(default_factory=dict)
    drivers: list[DriverSpec] = field(default_factory=list)
    dyads: list[tuple[str, tuple[str, str]]] = field(default_factory=list)

    # -- numbers ------------------------------------------------------------------------------

    def angle(self) -> float:
        """Any direction, now and then exactly along an axis."""
        if self.rng.random() < 0.15:
            return self.rng.choice((0.0, math.pi / 2, math.pi, -math.pi / 2))
        return self.rng.uniform(-math.pi, math.pi)

    def corner(self) -> float:
        """An angle between legs: |sine| from 0.05 (one in six below 0.15) to 1, either side."""
        bad = self.rng.random() < 1 / 6
        sine = self.rng.uniform(LEAST_SINE, 0.15) if bad else self.rng.uniform(0.15, 1.0)
        corner = math.asin(sine)
        corner = math.pi - corner if self.rng.random() < 0.5 else corner
        return corner * self.rng.choice((-1, 1))

    def leg(self) -> float:
        return math.exp(self.rng.uniform(math.log(0.3), math.log(3.0)))

    def beyond(self, place: Place, angle: float) -> Place:
        length = self.leg()
        return place[0] + length * math.cos(angle), place[1] + length * math.sin(angle)

    # -- parts --------------------------------------------------------------------------------

    def joint(self, place: Place, *links: str) -> str:
        name = f"J{len(self.joints)}"
        self.joints[name] = place
        for link in links:
            self.links[link].append(name)
        return name

    def link(self, *joints: str) -> str:
        name = f"L{len(self.links)}"
        self.links[name] = list(joints)
        return name

    def slide(self, a: str, b: str, angle: float) -> str:
        """A sliding pair; either link may carry the guide, with or without an origin on it."""
        swap = b != GROUND and bool(self.links[a]) and self.rng.random() < 0.4
        link, on = (b, a) if swap else (a, b)
        marks = self.links[on]
        needs = not self.links[link]  # a link without joints is placed by its guides' origins
        if needs and not marks:
            link, on, marks = on, link, self.links[link]
        origin = self.rng.choice(marks) if marks and (needs or self.rng.random() < 0.6) else None
        name = f"s{len(self.slides)}"
        self.slides[name] = SlideSpec(link, on, angle, origin)
        return name

    def two_links(self) -> tuple[str, str]:
        """Two links to hang a dyad on: half of the time one is the ground."""
        moving = [n for n in self.links if n != GROUND]
        a = self.rng.choice(moving)
        b = self.rng.choice([n for n in self.links if n != a])
        b = GROUND if self.rng.random() < 0.4 else b
        return (a, b) if self.rng.random() < 0.5 else (b, a)

    def shared(self, link: str, other: str) -> str | None:
        """Sometimes a joint of `link`, not of `other`: three or more links then meet there."""
        free = [j for j in self.links[link] if j not in self.links[other]]
        return self.rng.choice(free) if free and self.rng.random() < 0.4 else None

    def near(self) -> Place:
        """A point about the middle of the drawing, so that links do not grow without end."""
        n = max(len(self.joints), 1)
        x, y = (sum(p[i] for p in self.joints.values()) / n for i in (0, 1))
        return x + self.rng.uniform(-2, 2), y + self.rng.uniform(-2, 2)

    # -- dyads --------------------------------------------------------------------------------

    def dyad(self, kind: str) -> None:
        a, b = self.two_links()
        old = self.shared(a, b)
        first, second = getattr(self, kind.lower())(a, b, old)
        self.dyads.append((kind, (first, second)))
        for link in (first, second):  # coupler points, for later dyads and for looking at
            if self.links[link] and self.rng.random() < 0.3:
                self.joint(self.beyond(self.joints[self.links[link][0]], self.angle()), link)

    def rrr(self, a: str, b: str, old: str | None) -> tuple[str, str]:
        other = self.shared(b, a) if old else None
        d = math.dist(self.joints[old], self.joints[other]) if old and other else 0.0
        if old and other and 0.5 < d < 4:  # both ends given: the sine is at least d h/(l1 l2)
            (x, y), (u, v) = self.joints[old], self.joints[other]
            along, up = self.rng.uniform(0.25, 0.75), self.rng.uniform(0.05, 0.8)
            up *= self.rng.choice((-1, 1))
            inner = (x + along * (u - x) - up * (v - y), y + along * (v - y) + up * (u - x))
            end = other
        else:
            alpha = self.angle()
            if old is None:
                inner = self.near()
                old = self.joint(self.beyond(inner, alpha), a)
            else:
                inner = self.beyond(self.joints[old], alpha + math.pi)
            end = self.joint(self.beyond(inner, alpha + self.corner()), b)
        middle = self.joint(inner)
        return self.link(old, middle), self.link(middle, end)

    def rrp(self, a: str, b: str, old: str | None) -> tuple[str, str]:
        alpha, inner, old = self.swinging_leg(a, old)
        middle = self.joint(inner)
        rod, block = self.link(old, middle), self.link(middle)
        self.slide(block, b, alpha + math.pi / 2 + self.corner())
        return rod, block

    def swinging_leg(self, a: str, old: str | None) -> tuple[float, Place, str]:
        alpha = self.angle()
        if old is not None:
            return alpha, self.beyond(self.joints[old], alpha), old
        inner = self.near()
        return alpha, inner, self.joint(self.beyond(inner, alpha + math.pi), a)

    def rpr(self, a: str, b: str, old: str | None) -> tuple[str, str]:
        alpha, place, old = self.swinging_leg(a, old)
        first, second = self.link(old), self.link(self.joint(place, b))
        self.slide(second, first, alpha + math.pi / 2 + self.corner())
        return first, second

    def prp(self, a: str, b: str, _old: str | None) -> tuple[str, str]:
        middle = self.joint(self.near())
        first, second = self.link(middle), self.link(middle)
        alpha = self.angle()
        self.slide(first, a, alpha)
        self.slide(second, b, alpha + self.corner())
        return first, second

    def rpp(self, a: str, b: str, old: str | None) -> tuple[str, str]:
        first = self.link(old or self.joint(self.near(), a))
        second = self.link(self.joint(self.near())) if self.rng.random() < 0.5 else self.link()
        if not self.links[b]:
            self.joint(self.near(), b)
        alpha = self.angle()
        self.slide(second, b, alpha)
        self.slide(first, second, alpha + self.corner())
        return first, second

    # -- drivers ------------------------------------------------------------------------------

    def driver(self, kind: str) -> None:
        """Ground, driven links and, where the driven pair is not on the ground, their dyad."""
        getattr(self, "drive_" + kind)()

    def ground_joint(self) -> str:
        return self.joint(self.near(), GROUND)

    def drive_crank(self) -> None:
        pivot = self.ground_joint()
        pin = self.joint(self.beyond(self.joints[pivot], self.angle()))
        self.drivers.append(("angle", self.link(pivot, pin), GROUND))

    def drive_two_cranks(self) -> None:
        self.drive_crank()
        self.drive_crank()

    def drive_slide(self) -> None:
        self.ground_joint()
        carriage = self.link(self.joint(self.near()))
        self.drivers.append(("slide", self.slide(carriage, GROUND, self.angle())))

    def drive_cylinder(self) -> None:
        """Barrel on a ground pivot, rod pinned to a boom on another: the slide drives."""
        alpha, pivot = self.angle(), self.ground_joint()
        tip = self.joint(self.beyond(self.joints[pivot], alpha))
        root = self.joint(self.beyond(self.joints[tip], alpha + math.pi + self.corner()), GROUND)
        barrel, rod = self.link(pivot), self.link(tip)
        self.link(root, tip)
        # nearly along the line of the pins: a guide across it could not change their distance
        tilt = alpha + self.rng.choice((0.0, math.pi)) + self.rng.uniform(-1, 1)
        self.drivers.append(("slide", self.slide(rod, barrel, tilt)))

    def drive_elbow(self) -> None:
        """Two links of a four-bar that share a moving joint: their angle drives."""
        pivot = self.ground_joint()
        alpha = self.angle()
        elbow = self.joint(self.beyond(self.joints[pivot], alpha))
        # bent at the elbow (else its angle could not change pivot-to-wrist) and at the wrist
        wrist = self.joint(self.beyond(self.joints[elbow], alpha + self.corner()))
        (x, y), (u, v) = self.joints[pivot], self.joints[wrist]
        back = math.atan2(y - v, x - u)
        root = self.joint(self.beyond(self.joints[wrist], back + self.corner()), GROUND)
        upper, fore = self.link(pivot, elbow), self.link(elbow, wrist)
        self.link(wrist, root)
        self.drivers.append(("angle", fore, upper))

    def drive_coupler(self) -> None:
        """A four-bar driven by the angle of its coupler, which is not on the ground."""
        pivot, alpha = self.ground_joint(), self.angle()
        b = self.joint(self.beyond(self.joints[pivot], alpha))
        c = self.joint(self.beyond(self.joints[b], self.angle()))
        root = self.joint(self.beyond(self.joints[c], alpha + self.corner()), GROUND)
        self.link(pivot, b)
        coupler = self.link(b, c)
        self.link(c, root)
        self.drivers.append(("angle", coupler, GROUND))

    # -- the whole ----------------------------------------------------------------------------

    def finish(self) -> Description:
        """Any order of joints, links and slides; no link whose first two joints nearly meet."""
        rng = self.rng
        for joints in self.links.values():
            rng.shuffle(joints)
            if len(joints) > 2:
                reach = [math.dist(self.joints[joints[0]], self.joints[j]) for j in joints]
                far = reach.index(max(reach))
                if reach[1] < 0.3 * reach[far]:
                    joints[1], joints[far] = joints[far], joints[1]
        return Description(
            self.shuffled(self.joints),
            self.shuffled(self.links),
            self.shuffled(self.slides),
            self.drivers,
        )

    def shuffled(self, table: dict[str, T]) -> dict[str, T]:
        items = list(table.items())
        self.rng.shuffle(items)
        return dict(items)


def build(seed: int, driver: str, kinds: list[str] | tuple[str, ...]) -> Case:
    """The mechanism of this seed: a driver of DRIVERS, then dyads of KINDS; always the same."""
    builder = _Builder(random.Random(f"{seed} {driver}"))
    builder.driver(driver)
    for kind in kinds:
        builder.dyad(kind)
    return Case(builder.finish(), driver, tuple(builder.dyads), seed)


def random_case(seed: int, max_dyads: int = 6) -> Case:
    """As `sequences`, without hypothesis."""
    rng = random.Random(seed)
    kinds = [rng.choice(KINDS) for _ in range(rng.randint(1, max_dyads))]
    return build(seed, rng.choice(DRIVERS), kinds)


_seeds = st.integers(0, 2**32 - 1)


def dyads(kind: str) -> st.SearchStrategy[Case]:
    """One dyad of this kind on a crank."""
    return st.builds(build, _seeds, st.just("crank"), st.just((kind,)))


def driven_by(driver: str) -> st.SearchStrategy[Case]:
    """This driver, then one or two dyads."""
    kinds = st.lists(st.sampled_from(KINDS), min_size=1, max_size=2)
    return st.builds(build, _seeds, st.just(driver), kinds)


def sequences(max_dyads: int = 6) -> st.SearchStrategy[Case]:
    """Any driver, then 1 to max_dyads dyads of any kinds."""
    kinds = st.lists(st.sampled_from(KINDS), min_size=1, max_size=max_dyads)
    return st.builds(build, _seeds, st.sampled_from(DRIVERS), kinds)
