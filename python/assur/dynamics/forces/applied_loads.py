"""What acts on a link, and where: pairs, drivers and loads."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, NamedTuple, TypeAlias

import numpy as np

from assur import _trig
from assur.description.words import Drive
from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from assur._arrays import Float
    from assur.dynamics.forces._reactions import Reactions
    from assur.dynamics.forces.load_forces import LoadForce
    from assur.dynamics.model import MachineModel
    from assur.kinematics.mechanism import Mechanism
    from assur.kinematics.motion import Motion

Kind: TypeAlias = Literal["joint", "slide", "drive", "load"]


class Positions(NamedTuple):
    """A machine's motion, its reactions and the forces of its loads at P positions."""

    machine: MachineModel
    motion: Motion
    found: Reactions
    loads: list[LoadForce]


class Acting(NamedTuple):
    """A force at a point of a link, and a couple, at P positions.

    Attributes
    ----------
    kind : {"joint", "slide", "drive", "load"}
        What acts.
    name : str
        The joint or slide, the driven link, the class of the load.
    place : ndarray
        (P, 2), m, in the drawing's axes.
    force : ndarray
        (P, 2), N.
    couple : ndarray
        (P,), N·m.
    joint : str or None
        The joint where it acts.
    """

    kind: Kind
    name: str
    place: Float
    force: Float
    couple: Float
    joint: str | None

    @property
    def what(self) -> str:
        """The name of what acts, for messages."""
        if self.kind == "drive":
            return "the drive"
        return f"a {self.name}" if self.kind == "load" else f"{self.kind} {self.name!r}"


def acting_on(at: Positions, link: str, couples: bool = False) -> Iterator[Acting]:
    """Yield all that acts on a link but its weight and inertia.

    Couples whose place is unknown are refused, unless `couples` wants them at the link's origin.
    """
    yield from _pins(at, link)
    yield from _slides(at, link)
    yield from _drivers(at, link, couples)
    yield from _loads(at, link, couples)


def _mechanism(at: Positions) -> Mechanism:
    mechanism: Mechanism = at.motion.mechanism
    return mechanism


def _nothing(at: Positions) -> Float:
    return np.zeros(np.shape(at.found.status))


def _pins(at: Positions, link: str) -> Iterator[Acting]:
    for joint in _mechanism(at).links[link]:
        force = at.found.joint(joint, on=link)
        place = at.motion.joint(joint).value
        rubs = joint in at.machine.friction
        couple = at.found.joint_moment(joint, on=link) if rubs else _nothing(at)
        yield Acting("joint", joint, place, force, couple, joint)


def _slides(at: Positions, link: str) -> Iterator[Acting]:
    mechanism = _mechanism(at)
    drivers = mechanism.description.drivers
    for name, slide in mechanism.slides.items():
        if link not in (slide.link, slide.on):
            continue
        along = _guide(at, name)
        across = np.stack([-along[:, 1], along[:, 0]], axis=-1)
        pair = at.found.slide(name)
        force, moment = pair.normal[:, np.newaxis] * across, pair.moment
        if name in at.machine.friction:
            force = force + pair.friction[:, np.newaxis] * along
        if name in drivers:
            force = force + _effort(at, drivers.index(name))[:, np.newaxis] * along
        joints = mechanism.links[slide.link]
        place = _origin(at, slide.link)
        sign = 1.0 if link == slide.link else -1.0
        joint = joints[0] if joints and link == slide.link else None
        yield Acting("slide", name, place, sign * force, sign * moment, joint)


def _drivers(at: Positions, link: str, couples: bool) -> Iterator[Acting]:
    """Yield the torques of driven angles, which act where their two links meet."""
    mechanism = _mechanism(at)
    for index, driver in enumerate(mechanism.description.drivers):
        if driver in mechanism.slides:
            continue
        drive = driver if isinstance(driver, Drive) else Drive(driver)
        if link not in (drive.link, drive.relative_to):
            continue
        base = mechanism.links[drive.relative_to]
        shared = [joint for joint in mechanism.links[drive.link] if joint in base]
        if not shared and not couples:
            message = (
                f"the drive of {drive.link!r} acts on {link!r} with a torque, but the link shares "
                f"no joint with {drive.relative_to!r}: where it acts is unknown"
            )
            raise InputError(message, link=link)
        sign = 1.0 if link == drive.link else -1.0
        place = at.motion.joint(shared[0]).value if shared else _origin(at, link)
        torque = sign * _effort(at, index)
        joint = shared[0] if shared else None
        yield Acting("drive", drive.link, place, np.zeros(place.shape), torque, joint)


def _loads(at: Positions, link: str, couples: bool) -> Iterator[Acting]:
    for load in at.loads:
        if load.link != link:
            continue
        name = type(at.machine.loads[load.load]).__name__
        place = load.place
        if place is None:
            if not couples:
                message = (
                    f"a {name} acts on {link!r}, at no place that is known: loads inside the link "
                    "depend on it; replace it by two forces"
                )
                raise InputError(message, link=link)
            place = _origin(at, link)
        yield Acting("load", name, place, load.force, load.couple, load.joint)


def _origin(at: Positions, link: str) -> Float:
    """Return the place of a link's first joint, or of the origin of one without joints, (P, 2)."""
    joints = _mechanism(at).links[link]
    both = at.motion.joint(joints[0]) if joints else at.motion.reference_points[link]
    return both.value


def _guide(at: Positions, name: str) -> Float:
    """Return the direction of a guide, (P, 2)."""
    mechanism = _mechanism(at)
    angle = mechanism.dimensions.get(f"{name}.angle", 0.0)
    sine, cosine = _trig.sin_cos(at.motion.link(mechanism.slides[name].on).value + angle)
    return np.stack([cosine, sine], axis=-1)


def _effort(at: Positions, index: int) -> Float:
    effort = np.asarray(at.found.driver)
    every: Float = effort.reshape(np.size(at.found.status), -1)[:, index]
    return every
