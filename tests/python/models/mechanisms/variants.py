"""Other descriptions of the same mechanism: shuffled, renamed, drawn elsewhere, in another frame.

Each says how results follow: names, the frame, and the coordinate at which it is drawn. All else is
a constant that the two drawings give: the order of joints turns a link's own direction, the first
joint of a link that slides is where its value is measured.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from models.mechanisms.frames import Frame
from models.mechanisms.mechanism_data import GROUND, Description, SlideSpec

if TYPE_CHECKING:
    import random

    from numpy.typing import NDArray

    import assur

T = TypeVar("T")
# A link whose first two joints are nearer to each other than this part of its extent has an angle
# that is poorly known: no user draws one.
SHORT = 0.3
KINDS = ("joint", "link", "slide")


@dataclass(frozen=True)
class Variant:
    """A description, what its names were, its frame, and the first's coordinate at its drawing."""

    description: Description
    names: dict[str, dict[str, str]]  # by kind: name before -> name now
    frame: Frame = field(default_factory=Frame)
    drawn: NDArray[np.float64] | None = None  # None: at the drawing of the first
    steps: tuple[str, ...] = ()

    @staticmethod
    def same(d: Description) -> Variant:
        names = {kind: {n: n for n in own} for kind, own in _names(d).items()}
        return Variant(d, names)

    def then(self, step: str, description: Description) -> Variant:
        return replace(self, description=description, steps=(*self.steps, step))


def _names(d: Description) -> dict[str, list[str]]:
    """All names, by kind."""
    return dict(zip(KINDS, (list(d.joints), list(d.links), list(d.slides)), strict=True))


def shuffled(v: Variant, rng: random.Random, within: bool = True) -> Variant:
    """Every list in another order; `within=False` leaves what gives links their own frames.

    That is the order of a link's joints; of a link with one joint or none, that of slides.
    """
    d = v.description
    own = {n: _order(joints, d, rng) if within else joints for n, joints in d.links.items()}
    slides = _mixed(d.slides, rng) if within else d.slides
    after = Description(_mixed(d.joints, rng), _mixed(own, rng), slides, d.drivers)
    return v.then("shuffled", after)


def _mixed(table: dict[str, T], rng: random.Random) -> dict[str, T]:
    items = list(table.items())
    rng.shuffle(items)
    return dict(items)


def _order(joints: list[str], d: Description, rng: random.Random) -> list[str]:
    """Another order of a link's joints, the first two well apart."""
    places = [d.joints[n] for n in joints]
    extent = max((math.dist(p, q) for p in places for q in places), default=0.0)
    mixed = list(joints)
    for _ in range(20):
        rng.shuffle(mixed)
        if len(mixed) < 2 or math.dist(*(d.joints[n] for n in mixed[:2])) >= SHORT * extent:
            return mixed
    return list(joints)


def renamed(v: Variant, rng: random.Random) -> Variant:
    """Other names, in no alphabetical order; the ground keeps its own."""
    d = v.description
    new: dict[str, dict[str, str]] = {}
    for kind, own in _names(d).items():
        others = [f"{kind[0]}{k}" for k in range(len(own))]
        rng.shuffle(others)
        new[kind] = {n: GROUND if n == GROUND else o for n, o in zip(own, others, strict=True)}
    joint, link, slide = (new[kind] for kind in KINDS)
    after = Description(
        {joint[n]: place for n, place in d.joints.items()},
        {link[n]: [joint[j] for j in own] for n, own in d.links.items()},
        {
            slide[n]: SlideSpec(link[s.link], link[s.on], s.angle, s.origin and joint[s.origin])
            for n, s in d.slides.items()
        },
        [
            (kind, slide[name]) if kind == "slide" else (kind, link[name], link[other[0]])
            for kind, name, *other in d.drivers
        ],
    )
    names = {kind: {n: new[kind][now] for n, now in v.names[kind].items()} for kind in v.names}
    return replace(v.then("renamed", after), names=names)


def framed(v: Variant, frame: Frame) -> Variant:
    """In another frame; only one frame can follow."""
    assert v.frame == Frame()
    return replace(v.then("framed", frame.of(v.description)), frame=frame)


def drawn_angle(d: Description, link: str, solved: float) -> float:
    """The angle of a link as it is drawn: what is solved there may have fewer digits."""
    if len(d.links[link]) > 1:
        (ax, ay), (bx, by) = (d.joints[name] for name in d.links[link][:2])
        angles = [math.atan2(by - ay, bx - ax)]
    else:
        angles = [slide.angle for slide in d.slides.values() if link in (slide.link, slide.on)]
    near = [angle + math.tau * round((solved - angle) / math.tau) for angle in angles]
    return min(near, key=lambda angle: abs(angle - solved))


def redrawn(d: Description, m: assur.Mechanism, q: NDArray[np.float64]) -> Variant:
    """Drawn at another position of the same motion."""
    motion = m.solve(q if q.size > 1 else float(q[0]), order=0)
    drawn = m.solve(m.q0, order=0)
    joints = {
        n: (float(x), float(y)) for n, (x, y) in ((n, motion.joint(n).value) for n in d.joints)
    }

    def turned(link: str) -> float:
        if link == GROUND:
            return 0.0
        return float(motion.link(link).value) - drawn_angle(d, link, float(drawn.link(link).value))

    slides = {n: replace(s, angle=s.angle + turned(s.on)) for n, s in d.slides.items()}
    same = Variant.same(d)
    after = Description(joints, d.links, slides, d.drivers)
    return replace(same.then("redrawn", after), drawn=np.asarray(q, np.float64))
