"""What all importers make of a file: joints, links, slots, cylinders, inputs."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TypeAlias

Point: TypeAlias = tuple[float, float]

GROUND = "ground"


@dataclass
class Slot:
    """A straight guide on a link.

    Attributes
    ----------
    joint : str
        The joint that slides along it.
    carrier : str
        The link that carries it.
    riders : list of str
        The links at the joint.
    angle : float
        Direction in the drawing, rad.
    turns : bool
        Whether the riders turn about the joint (a pin in a slot) or slide as a whole.
    """

    joint: str
    carrier: str
    riders: list[str]
    angle: float
    turns: bool


@dataclass
class Input:
    """A driven joint, or a driven slot or cylinder.

    Attributes
    ----------
    place : str
        The part of the file that says so, for messages.
    joint : str or None
        The joint at which `link` turns against `base`; where they are None, the links at the joint
        say which.
    slide : str or None
        The slot or cylinder.
    speed : float or None
        Counter-clockwise in rad/s, or lengths/s.
    """

    place: str
    joint: str | None = None
    slide: str | None = None
    link: str | None = None
    base: str | None = None
    speed: float | None = None


@dataclass
class Sketch:
    """A linkage in the file's own names and unit of length.

    Attributes
    ----------
    joints : dict of str to (x, y)
    links : dict of str to list of str
        The joints of every link; the frame is always there.
    slots : dict of str to Slot
    cylinders : dict of str to (base joint, end joint)
    welds : list of (joint, links)
        Links that are one.
    inputs : list of Input
    omitted : list of str
        Sentences about what does not carry over.
    resolution : float or None
        Error of a coordinate by its rounding, where the format has a fixed number of decimals.
    angle_resolution : float or None
        The same of the direction of a slot, rad.
    """

    joints: dict[str, Point] = field(default_factory=dict)
    links: dict[str, list[str]] = field(default_factory=lambda: {GROUND: []})
    slots: dict[str, Slot] = field(default_factory=dict)
    cylinders: dict[str, tuple[str, str]] = field(default_factory=dict)
    welds: list[tuple[str, list[str]]] = field(default_factory=list)
    inputs: list[Input] = field(default_factory=list)
    omitted: list[str] = field(default_factory=list)
    resolution: float | None = None
    angle_resolution: float | None = None

    def connect(self, joint: str, link: str) -> None:
        """Make a joint a member of a link, which may be new."""
        members = self.links.setdefault(link, [])
        if joint not in members:
            members.append(joint)

    def links_at(self, joint: str) -> list[str]:
        """Return the links that have a joint."""
        return [link for link, members in self.links.items() if joint in members]

    def add_slot(
        self, joint: str, carrier: str, riders: list[str], angle: float, turns: bool
    ) -> str:
        """Add a slot in which a joint slides; return its name."""
        name = f"{joint}_slide"
        while name in self.slots:
            name += "_"
        self.slots[name] = Slot(joint, carrier, list(dict.fromkeys(riders)), angle, turns)
        for rider in riders:
            self.connect(joint, rider)
        if not turns and len(riders) > 1:
            self.welds.append((joint, list(riders)))
        return name

    def rename_link(self, old: str, new: str) -> None:
        """Make two links one, under the new name."""
        for joint in self.links.pop(old):
            self.connect(joint, new)
        for slot in self.slots.values():
            slot.carrier = new if slot.carrier == old else slot.carrier
            slot.riders = list(dict.fromkeys(new if r == old else r for r in slot.riders))
        for driven in self.inputs:
            driven.link = new if driven.link == old else driven.link
            driven.base = new if driven.base == old else driven.base

    def rename_joint(self, old: str, new: str) -> None:
        """Make two joints one, under the new name."""
        del self.joints[old]
        for link, members in self.links.items():
            self.links[link] = list(dict.fromkeys(new if j == old else j for j in members))
        for slot in self.slots.values():
            slot.joint = new if slot.joint == old else slot.joint
        for name, ends in self.cylinders.items():
            base, end = (new if joint == old else joint for joint in ends)
            self.cylinders[name] = (base, end)
        for driven in self.inputs:
            driven.joint = new if driven.joint == old else driven.joint
