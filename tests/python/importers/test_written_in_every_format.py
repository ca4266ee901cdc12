"""Random linkages, written by independent writers in every format, are the same mechanism."""

from __future__ import annotations

import json
import math
import random
from dataclasses import dataclass, field

import numpy as np
import pytest

import assur
from assur import importers
from importers.pmks_plus_writer import Block, Joint, Link, written

Point = tuple[float, float]


@dataclass
class Guide:
    """A straight slot: the pin, the link that it is on, two of its joints or an angle, rad."""

    pin: str
    on: str
    between: tuple[str, str] | None
    angle: float


@dataclass
class Linkage:
    """A crank and dyads, each on what is there."""

    joints: dict[str, Point] = field(default_factory=dict)
    links: dict[str, list[str]] = field(default_factory=dict)
    guides: list[Guide] = field(default_factory=list)

    def direct(self) -> assur.Mechanism:
        """The mechanism, written directly."""
        links = dict(self.links)
        slides = {}
        for guide in self.guides:
            links[f"{guide.pin}_block"] = [guide.pin]
            slides[f"{guide.pin}_slide"] = assur.Slide(
                f"{guide.pin}_block", on=guide.on, angle=guide.angle
            )
        return assur.Mechanism(self.joints, links, "L1", slides=slides)


def random_linkage(seed: int) -> Linkage:
    """A crank and two to four dyads, with coordinates of three decimals."""
    rng = random.Random(seed)
    linkage = Linkage({"c0": (0.0, 0.0), "c1": (0.25, 0.5)}, {"ground": ["c0"], "L1": ["c0", "c1"]})

    def new(x: float, y: float) -> str:
        name = f"c{len(linkage.joints)}"
        linkage.joints[name] = (round(x, 3), round(y, 3))
        return name

    def near(start: Point, size: float) -> Point:
        angle = rng.uniform(-math.pi, math.pi)
        return start[0] + size * math.cos(angle), start[1] + size * math.sin(angle)

    last = "c1"
    for _ in range(rng.randrange(2, 5)):
        start = linkage.joints[last]
        guided = any(guide.pin == last for guide in linkage.guides)
        if not guided and rng.random() < 0.3:
            # The pin slides in a lever.
            pivot, end = new(*near(start, rng.uniform(1.5, 3.0))), new(*near(start, 2.0))
            lever = f"L{len(linkage.links)}"
            linkage.links["ground"].append(pivot)
            linkage.links[lever] = [pivot, end]
            (u, v), (s, t) = linkage.joints[pivot], linkage.joints[end]
            angle = math.atan2(t - v, s - u)
            linkage.guides.append(Guide(last, lever, (pivot, end), angle))
            last = end
            continue
        inner = new(*near(start, rng.uniform(2.0, 4.0)))
        linkage.links[f"L{len(linkage.links)}"] = [last, inner]
        if rng.random() < 0.3:
            angle = round(rng.uniform(-3.1, 3.1), 3)
            linkage.guides.append(Guide(inner, "ground", None, angle))
            last = inner
            continue
        pivot = new(*near(linkage.joints[inner], rng.uniform(1.5, 3.0)))
        tracer = new(*near(linkage.joints[inner], 2.0))
        linkage.links["ground"].append(pivot)
        linkage.links[f"L{len(linkage.links)}"] = [pivot, inner, tracer]
        last = tracer
    return linkage


def at(linkage: Linkage, joint: str) -> tuple[list[str], Guide | None]:
    """The links at a joint, and its guide."""
    links = [link for link, joints in linkage.links.items() if joint in joints]
    return links, next((guide for guide in linkage.guides if guide.pin == joint), None)


def pmks(linkage: Linkage) -> str:
    lines = []
    for joint, (x, y) in linkage.joints.items():
        links, guide = at(linkage, joint)
        words = [guide.on, *links, "RP"] if guide else [*links, "R"]
        angle = math.degrees(guide.angle) if guide else 0
        flags = "ffft" if joint == "c0" else "tfff"
        lines.append(",".join([*words, repr(x), repr(y), repr(angle), flags]))
    return "\n".join(lines)


def pyslvs(linkage: Linkage) -> str:
    parts = []
    for joint, (x, y) in linkage.joints.items():
        links, guide = at(linkage, joint)
        kind = f"RP, A[{math.degrees(guide.angle)!r}]" if guide else "R"
        words = ", ".join([guide.on, *links] if guide else links)
        parts.append(f"J[{kind}, color[Green], P[{x!r}, {y!r}], L[{words}]]")
    return f"M[{', '.join(parts)}]"


def pylinkage(linkage: Linkage) -> str:
    joints = []
    for joint, place in linkage.joints.items():
        links, guide = at(linkage, joint)
        one: dict[str, object] = {"id": joint, "position": place}
        one["type"] = "ground" if "ground" in links else "prismatic" if guide else "revolute"
        if guide:
            one |= {"axis": [math.cos(guide.angle), math.sin(guide.angle)], "line_point": place}
        joints.append(one)
    bars = [
        {"id": name, "type": "driver" if name == "L1" else "link", "joints": members}
        | ({"motor_joint": "c0"} if name == "L1" else {})
        for name, members in linkage.links.items()
        if name != "ground"
    ]
    return json.dumps({"joints": joints, "links": bars})


def linkage2(linkage: Linkage) -> str:
    lines = []
    extra = len(linkage.joints)
    for joint, (x, y) in linkage.joints.items():
        links, guide = at(linkage, joint)
        limits = ""
        if guide:
            ends = [end[1:] for end in guide.between or ()]
            if not ends:
                ends = [str(extra), str(extra + 1)]
                extra += 2
                for end, step in zip(ends, (-5.0, 5.0), strict=True):
                    u, v = step * math.cos(guide.angle), step * math.sin(guide.angle)
                    lines.append(
                        f'<connector id="{end}" x="{x + u!r}" y="{y + v!r}" anchor="true"/>'
                    )
            limits = "".join(f'<slidelimit id="{end}"/>' for end in ends)
        flags = ' anchor="true"' if "ground" in links else ""
        flags += ' input="true" rpm="15"' if joint == "c0" else ""
        flags += ' slider="true"' if guide else ""
        lines.append(f'<connector id="{joint[1:]}" x="{x!r}" y="{y!r}"{flags}>{limits}</connector>')
    for name, members in linkage.links.items():
        if name != "ground":
            inside = "".join(f'<connector id="{member[1:]}"/>' for member in members)
            lines.append(f'<Link id="{name[1:]}">{inside}</Link>')
    return "\n".join(["<linkage2>", *lines, "</linkage2>"])


def pmks_plus(linkage: Linkage) -> str:
    joints, blocks = [], []
    for joint, place in linkage.joints.items():
        at_joint, guide = at(linkage, joint)
        flags = ("frame " if "ground" in at_joint else "") + ("input" if joint == "c0" else "")
        joints.append(Joint(joint, place, flags))
        if guide:
            slot = (guide.on, *guide.between) if guide.between else ()
            flags = "slides" if slot else "slides frame"
            joints.append(Joint(f"{joint}s", place, flags, 0.0 if slot else guide.angle, slot))
            blocks.append(Block(f"{joint}b", (joint, f"{joint}s")))
    links = [Link(name, tuple(on)) for name, on in linkage.links.items() if name != "ground"]
    return written(joints, [*links, *blocks])


WRITERS = (pmks, pyslvs, pylinkage, linkage2, pmks_plus)


def test_every_format_has_a_writer() -> None:
    assert {write.__name__ for write in WRITERS} == set(importers.FORMATS)


@pytest.mark.parametrize("seed", range(40))
def test_the_same_motion_from_every_format(seed: int) -> None:
    linkage = random_linkage(seed)
    direct = linkage.direct()
    q = direct.q0 + 0.3 * np.linspace(-1.0, 1.0, 25) ** 5
    wanted = direct.solve(q, order=1, on_error="nan")
    # Some dyads end within the span.
    assert (wanted.status == 0).sum() > 3
    order = list(linkage.joints)
    moving_guides = any(guide.between for guide in linkage.guides)
    for write in WRITERS:
        if write is pylinkage and moving_guides:
            # Its sliders are on the frame.
            continue
        text = write(linkage)
        assert importers.detect(None, text) == write.__name__
        drivers = [(0, 1)] if write is pyslvs else None
        found = importers.read(text, drivers=drivers, scale=1.0).mechanism
        assert found.structure.formula.count("II(") == direct.structure.formula.count("II(")
        names = {joint: joint for joint in order}
        if write is pmks:
            names = {joint: f"J{i + 1}" for i, joint in enumerate(order)}
        if write is pyslvs:
            names = {joint: f"P{i}" for i, joint in enumerate(order)}
        motion = found.solve(q, order=1, on_error="nan")
        assert np.array_equal(motion.status == 3, wanted.status == 3)
        for joint in order:
            own, theirs = motion.joint(names[joint]), wanted.joint(joint)
            # Near a dead point rounding of an angle in degrees counts for more.
            near = 1e-13 * np.maximum(wanted.condition, 1.0)[:, None]
            for ours, other in ((own.value, theirs.value), (own.d1, theirs.d1)):
                off = np.abs(ours - other)
                assert not (off > np.maximum(1e-12, near) * (1.0 + np.abs(other))).any()
