"""The older JSON of pylinkage: joints that are dyads, placed one after another.

Static
    a point of the frame, x and y
Crank
    turns about joint0 at a distance; angle is its step, rad
Revolute
    distance0 from joint0 and distance1 from joint1, at the crossing nearest to x and y
Fixed
    at a distance from joint0, at an angle from the direction to joint1
Prismatic (Linear)
    revolute_radius from joint0, on the line through joint1 and joint2
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from assur._arrays import short
from assur._trig import arctan2
from assur.importers.json_text import word_of
from assur.importers.placing import on_circle, on_line, on_two_circles, polar
from assur.importers.sketch import GROUND, Input

if TYPE_CHECKING:
    from assur.importers.sketch import Point, Sketch
    from assur.importers.source import Source

PARENTS = {
    "Static": (),
    "Crank": ("joint0",),
    "Revolute": ("joint0", "joint1"),
    "Fixed": ("joint0", "joint1"),
    "Prismatic": ("joint0", "joint1", "joint2"),
    "Linear": ("joint0", "joint1", "joint2"),
}


def is_dyads(joints: list[dict[str, Any]]) -> bool:
    """Whether the joints are of the older form."""
    kinds = [joint.get("type") for joint in joints]
    return any(isinstance(kind, str) and kind in PARENTS for kind in kinds)


def read_dyads(source: Source, sketch: Sketch, joints: list[dict[str, Any]]) -> None:
    """Place the dyads in an order in which each has its parents."""
    left = []
    names: set[str] = set()
    for index, joint in enumerate(joints):
        place = f"joints[{index}]"
        name = word_of(source, joint, "name", place)
        kind = joint.get("type")
        if not isinstance(kind, str) or kind not in PARENTS:
            known = f"one of {', '.join(PARENTS)}"
            raise source.wrong(place, f"the type of joint {short(name)}", kind, known, joint=name)
        if name in names:
            raise source.error(place, f"a second joint {short(name)}", joint=name)
        names.add(name)
        left.append((place, name, kind, joint))
    while left:
        waiting = []
        for item in left:
            dyad = _Dyad(source, sketch, *item)
            if dyad.is_ready(names):
                dyad.add()
            else:
                waiting.append(item)
        if len(waiting) == len(left):
            place, name, _, _ = waiting[0]
            problem = f"joint {short(name)} waits for parents that wait for it"
            raise source.error(place, problem, joint=name)
        left = waiting


class _Dyad:
    """One joint of the older form."""

    def __init__(
        self,
        source: Source,
        sketch: Sketch,
        place: str,
        name: str,
        kind: str,
        data: dict[str, Any],
    ) -> None:
        self._source, self._sketch = source, sketch
        self._place, self._name, self._kind, self._data = place, name, kind, data

    def is_ready(self, names: set[str]) -> bool:
        """Whether the parents are placed; inline parents are placed now."""
        ready = True
        for key in PARENTS[self._kind]:
            parent = self._parent(key)
            if parent not in self._sketch.joints:
                if parent not in names:
                    problem = f"joint {short(self._name)}: {key} {short(parent)} does not exist"
                    raise self._error(problem)
                ready = False
        return ready

    def add(self) -> None:
        """Place the joint and its links."""
        match self._kind:
            case "Static":
                self._sketch.joints[self._name] = self._number("x"), self._number("y")
                self._sketch.connect(self._name, GROUND)
            case "Crank":
                self._add_crank()
            case "Revolute":
                self._add_revolute()
            case "Fixed":
                self._add_fixed()
            case _:
                self._add_prismatic()

    def _add_crank(self) -> None:
        base = self._parent("joint0")
        at = on_circle(self._at(base), self._length("distance"), self._hint(base))
        link = self._bar(base, at)
        step = self._data.get("angle")
        speed = None if step is None else self._number("angle")
        where = self._sketch.links_at(base)
        on = GROUND if GROUND in where else next(name for name in where if name != link)
        driven = Input(self._place, joint=base, link=link, base=on, speed=speed)
        self._sketch.inputs.append(driven)

    def _add_revolute(self) -> None:
        first, second = self._parent("joint0"), self._parent("joint1")
        radii = self._length("distance0"), self._length("distance1")
        at = on_two_circles(self._at(first), self._at(second), radii, self._hint(first))
        if isinstance(at, float):
            problem = f"the links of joint {short(self._name)} miss each other by {at:g}"
            raise self._error(problem, at)
        self._bar(first, at)
        self._bar(second, at)

    def _add_fixed(self) -> None:
        origin, toward = self._parent("joint0"), self._parent("joint1")
        distance, angle = self._number("distance"), self._number("angle")
        link = self._through(origin, toward)
        points = self._at(origin), self._at(toward)
        self._sketch.joints[self._name] = polar(*points, distance, angle)
        self._sketch.connect(self._name, link)

    def _add_prismatic(self) -> None:
        base, start, end = (self._parent(key) for key in PARENTS["Prismatic"])
        line = self._at(start), self._at(end)
        radius = self._length("revolute_radius")
        carrier = self._through(start, end)
        at = on_line(self._at(base), radius, line, self._hint(base))
        if isinstance(at, float):
            problem = f"the link of joint {short(self._name)} is {at:g} too short for its line"
            raise self._error(problem, at)
        link = self._bar(base, at)
        (x, y), (u, v) = line
        angle = float(arctan2(v - y, u - x))
        self._sketch.add_slot(self._name, carrier, [link], angle, turns=True)

    def _through(self, first: str, second: str) -> str:
        """Return a link that turns with the line of two joints: one that has both, or a new one.

        The new link has the first joint, and a guide along which the second slides.
        """
        (x, y), (u, v) = self._at(first), self._at(second)
        if (x, y) == (u, v):
            raise self._error(f"joints {short(first)} and {short(second)} are at one place")
        links = self._sketch.links
        both = [link for link in links if first in links[link] and second in links[link]]
        if both:
            return both[0]
        link = f"{first}_{self._name}"
        self._sketch.connect(first, link)
        riders = self._sketch.links_at(second)
        angle = float(arctan2(v - y, u - x))
        self._sketch.add_slot(second, link, riders, angle, turns=True)
        return link

    def _bar(self, parent: str, at: Point) -> str:
        """Place the joint and link it with a parent."""
        link = f"{parent}_{self._name}"
        while link in self._sketch.links:
            link += "_"
        self._sketch.joints[self._name] = at
        self._sketch.connect(parent, link)
        self._sketch.connect(self._name, link)
        return link

    def _parent(self, key: str) -> str:
        """Return a parent's name; a parent that is written out here is a point of the frame."""
        data = self._data.get(key)
        if isinstance(data, str):
            return data
        if not isinstance(data, dict):
            what = f"{key} of joint {short(self._name)}"
            raise self._source.wrong(self._place, what, data, 'a parent {"ref": "..."}')
        if not data.get("inline"):
            return word_of(self._source, data, "ref", f"{self._place}, {key}")
        name = f"{self._name}_{key}"
        place = f"{self._place}, {key}"
        x, y = (self._source.number(data.get(what), place, what) for what in "xy")
        self._sketch.joints[name] = (x, y)
        self._sketch.connect(name, GROUND)
        return name

    def _at(self, joint: str) -> Point:
        return self._sketch.joints[joint]

    def _hint(self, parent: str) -> Point:
        """Return x and y, or the parent's place where they are null."""
        x, y = self._at(parent)
        written = (self._data.get("x"), self._data.get("y"))
        return (
            x if written[0] is None else self._number("x"),
            y if written[1] is None else self._number("y"),
        )

    def _number(self, key: str) -> float:
        return self._source.number(self._data.get(key), f"{self._place} ({self._name[:40]})", key)

    def _length(self, key: str) -> float:
        value = self._number(key)
        if not value > 0.0:
            problem = f"{key} of joint {short(self._name)} is {value:g}: it must be positive"
            raise self._error(problem, value)
        return value

    def _error(self, problem: str, value: float | None = None) -> Exception:
        finite = None if value is None or not math.isfinite(value) else value
        return self._source.error(self._place, problem, joint=self._name, value=finite)
