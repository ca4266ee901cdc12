"""Plans of velocities and accelerations: images of points, and the vectors between them.

Points are the joints, the reference points of links without joints, and of each guide that moves
the point under the sliding one: joint A slides on a lever whose point there is "A of lever".
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur._faces import Analogues, Motion

Part = Literal["absolute", "relative", "normal", "tangential", "sliding", "coriolis"]
# Vectors shorter than this fraction of the greatest are not drawn.
SHORT = 4e-3


class Vector(NamedTuple):
    """A vector of a plan: of a point, relative to another one or absolute, in m/s or m/s²."""

    part: Part
    point: str
    other: str | None
    start: Float
    end: Float


class Under(NamedTuple):
    """A point of a guide: the name of the sliding point, the sliding link, and the guide."""

    point: str
    sliding: str
    guide: str


class State(NamedTuple):
    """Place, velocity and acceleration of a point; or the angle of a link and its rates."""

    value: Any
    rate: Any
    second: Any


@dataclass(frozen=True)
class Plan:
    """A plan of velocities or accelerations at one position.

    Attributes
    ----------
    images : dict of str to ndarray
        Image of each point, from the pole at (0, 0).
    links : dict of str to list of str
        Points of each moving link; those of its joints that are fixed too.
    fixed, driven : frozenset of str
        Points of the ground, and of the driven links.
    under : dict of str to Under
        Points of guides under sliding points.
    vectors : list of Vector
        In the order in which they are found.
    """

    images: dict[str, Float]
    links: dict[str, list[str]]
    fixed: frozenset[str]
    driven: frozenset[str]
    under: dict[str, Under]
    vectors: list[Vector]


def plan_of(motion: Motion, what: str, speed: Any, acceleration: Any) -> Plan:
    """Return the plan of a motion of one position."""
    return _Builder(motion, what, speed, acceleration).plan()


class _Builder:
    def __init__(self, motion: Motion, what: str, speed: Any, acceleration: Any) -> None:
        self._motion = motion
        self._m = motion.mechanism
        self._what = what
        self._omega, self._alpha = speed, acceleration
        self._states: dict[str, State] = {}
        self._links: dict[str, list[str]] = {}
        self._under: dict[str, Under] = {}
        self._vectors: list[Vector] = []
        ground = self._m.links["ground"]
        self._fixed = frozenset(ground)
        for link, joints in self._m.links.items():
            if link == "ground":
                continue
            self._links[link] = list(joints) or [link]
            for joint in joints:
                self._states[joint] = self._state(motion.joint(joint))
            if not joints:
                self._states[link] = self._state(motion.reference_points[link])
        for slide in self._m.slides.values():
            if slide.on != "ground" and slide.link != "ground":
                self._add_under(slide.link, slide.on)

    def plan(self) -> Plan:
        """Return the plan."""
        groups = [group.links for group in self._m.structure.groups]
        rest = tuple(link for link in self._links if not any(link in members for members in groups))
        driven = self._driven()
        known = set(self._fixed)
        for links in (rest, *groups):
            for link in links:
                self._link(link, known)
            known.update(point for link in links for point in self._links[link])
        self._slides()
        images = {name: self._image(state) for name, state in self._states.items()}
        for name, image in images.items():
            if name not in self._fixed and name not in self._under:
                self._add("absolute", name, None, np.zeros(2), image)
        greatest = max((float(np.hypot(*image)) for image in images.values()), default=0.0)
        kept = [v for v in self._vectors if np.hypot(*(v.end - v.start)) > SHORT * greatest]
        return Plan(images, self._links, self._fixed, driven, self._under, kept)

    def _driven(self) -> frozenset[str]:
        drivers = self._m.description.drivers
        points: set[str] = set()
        for driver in drivers:
            if isinstance(driver, str):
                link = self._m.slides[driver].link if driver in self._m.slides else driver
                points.update(self._links.get(link, ()))
        return frozenset(points)

    def _state(self, of: Analogues) -> State:
        second = of.acceleration(self._omega, self._alpha) if self._is_second else None
        return State(of.value, of.velocity(self._omega), second)

    @property
    def _is_second(self) -> bool:
        return self._what == "acceleration"

    def _image(self, state: State) -> Float:
        image: Float = state.second if self._is_second else state.rate
        return image

    def _add_under(self, sliding: str, guide: str) -> None:
        """Add the point of a guide where another link slides."""
        point = self._links[sliding][0]
        place = self._states[point].value
        origin = self._state(self._motion.reference_points[guide])
        turn = self._state(self._motion.link(guide))
        arm = place - origin.value
        left = np.array([-arm[1], arm[0]])
        second = None
        if self._is_second:
            second = origin.second + turn.second * left - turn.rate**2 * arm
        name = f"{point} of {guide}"
        self._states[name] = State(place, origin.rate + turn.rate * left, second)
        self._under[name] = Under(point, sliding, guide)
        self._links[guide].append(name)

    def _link(self, link: str, known: set[str]) -> None:
        """Add the vectors from a known point of a link to another; similarity gives the others."""
        points = self._links[link]
        if len(points) < 2:
            return
        base = next((p for p in points if p in self._fixed), None)
        base = base or next((p for p in points if p in known), points[0])
        targets = [p for p in points if p != base and p not in self._fixed]
        if not targets:
            return
        pairs = [p for p in targets if self._is_pair(p)] or targets
        target = next((p for p in pairs if p in self._under), pairs[0])
        start, end = self._image(self._states[base]), self._image(self._states[target])
        if base in self._fixed:
            start = np.zeros(2)
        base_name = None if base in self._fixed else base
        if not self._is_second:
            if base_name or target in self._under:
                self._add("relative" if base_name else "absolute", target, base_name, start, end)
            return
        turn = self._state(self._motion.link(link))
        arm = self._states[target].value - self._states[base].value
        middle = start - turn.rate**2 * arm
        size = max(float(np.hypot(*(end - start))), 1e-300)
        if (
            base_name is None
            and np.hypot(*(end - middle)) < SHORT * size
            and target not in self._under
        ):
            # It is the whole acceleration.
            return
        self._add("normal", target, base_name, start, middle)
        self._add("tangential", target, base_name, middle, end)

    def _is_pair(self, point: str) -> bool:
        return point in self._under or sum(point in points for points in self._links.values()) > 1

    def _slides(self) -> None:
        """Add the motion of sliding points relative to their guides."""
        for slide in self._m.slides.values():
            if slide.on == "ground" or slide.link == "ground":
                continue
            point = self._links[slide.link][0]
            under = f"{point} of {slide.on}"
            start, end = (self._image(self._states[p]) for p in (under, point))
            if not self._is_second:
                self._add("sliding", point, under, start, end)
                continue
            turn = self._state(self._motion.link(slide.on))
            relative = self._states[point].rate - self._states[under].rate
            coriolis = 2.0 * turn.rate * np.array([-relative[1], relative[0]])
            self._add("coriolis", point, under, start, start + coriolis)
            self._add("sliding", point, under, start + coriolis, end)

    def _add(self, part: Part, point: str, base: str | None, start: Float, end: Float) -> None:
        self._vectors.append(Vector(part, point, base, start, end))
