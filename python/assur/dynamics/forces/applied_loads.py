"""What acts on a link, and where: pairs, drivers and loads."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from assur import _core, _trig
from assur.description.words import Drive
from assur.dynamics.loads.load_values import values_at
from assur.dynamics.loads.loaded_link import taker
from assur.dynamics.loads.loads import (
    Damper,
    Force,
    Gas,
    Gravity,
    Pressure,
    Spring,
    Torque,
    TorsionDamper,
    TorsionSpring,
)
from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from assur._arrays import Float
    from assur.dynamics.forces._reactions import Reactions
    from assur.dynamics.loads.loads import Load, PointLike
    from assur.dynamics.model import MachineModel
    from assur.kinematics.mechanism import Mechanism
    from assur.kinematics.motion import Motion


# A coordinate slower than this part of the drivers rests, in the core too.
AT_REST = 1e-12


class Positions(NamedTuple):
    """A machine's motion and reactions at P positions: q and speeds (P, n), times (P,)."""

    machine: MachineModel
    motion: Motion
    found: Reactions
    q: Float
    speed: Float
    t: Float


class Acting(NamedTuple):
    """A force at a point of a link, and a couple, at P positions.

    Attributes
    ----------
    what : str
        What acts, for messages.
    place : ndarray
        (P, 2), m, in the drawing's axes.
    force : ndarray
        (P, 2), N.
    couple : ndarray
        (P,), N·m.
    joint : str or None
        The joint where it acts.
    """

    what: str
    place: Float
    force: Float
    couple: Float
    joint: str | None


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
    return np.zeros(at.q.shape[0])


def _pins(at: Positions, link: str) -> Iterator[Acting]:
    for joint in _mechanism(at).links[link]:
        force = at.found.joint(joint, on=link)
        place = at.motion.joint(joint).value
        rubs = joint in at.machine.friction
        couple = at.found.joint_moment(joint, on=link) if rubs else _nothing(at)
        yield Acting(f"joint {joint!r}", place, force, couple, joint)


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
        sliding = mechanism.links[slide.link]
        place = _place(at, slide.link, sliding[0] if sliding else (slide.link, (0.0, 0.0)))[0]
        sign = 1.0 if link == slide.link else -1.0
        joint = sliding[0] if sliding and link == slide.link else None
        yield Acting(f"slide {name!r}", place, sign * force, sign * moment, joint)


def _drivers(at: Positions, link: str, couples: bool) -> Iterator[Acting]:
    """Yield the torques of driven angles, which act where their two links meet."""
    mechanism = _mechanism(at)
    for index, driver in enumerate(mechanism.description.drivers):
        if driver in mechanism.slides:
            continue
        drive = driver if isinstance(driver, Drive) else Drive(driver)
        if link not in (drive.link, drive.relative_to):
            continue
        other = mechanism.links[drive.relative_to]
        shared = [joint for joint in mechanism.links[drive.link] if joint in other]
        if not shared and not couples:
            message = (
                f"the drive of {drive.link!r} acts on {link!r} with a torque, but the link shares "
                f"no joint with {drive.relative_to!r}: where it acts is unknown"
            )
            raise InputError(message, link=link)
        sign = 1.0 if link == drive.link else -1.0
        pivot = at.motion.joint(shared[0]) if shared else at.motion.reference_points[link]
        place = pivot.value
        torque = sign * _effort(at, index)
        joint = shared[0] if shared else None
        yield Acting("the drive", place, np.zeros(place.shape), torque, joint)


def _loads(at: Positions, link: str, couples: bool) -> Iterator[Acting]:
    for load in at.machine.loads:
        yield from load_on(at, load, link, couples)


def load_on(at: Positions, load: Load, link: str, couples: bool = True) -> Iterator[Acting]:
    """Yield what one load does to a link; weight is not among it."""
    if isinstance(load, Gravity):
        return
    what = f"a {type(load).__name__}"
    if isinstance(load, Torque | TorsionSpring | TorsionDamper):
        if link in (load.link, load.on):
            yield _torque(at, load, link, couples)
    elif isinstance(load, Pressure):
        yield from _pressure(at, load, link)
    elif isinstance(load, Force):
        if (load.on or taker(_mechanism(at), load.at)) == link:
            place, _ = _place(at, link, load.at)
            force = _force(at, load)
            yield Acting(what, place, force, _nothing(at), _joint(load.at))
    else:
        ends = load.first, load.second
        for end, other in (ends, ends[::-1]):
            if taker(_mechanism(at), end) == link:
                place, force = _pull(at, load, end, other)
                yield Acting(what, place, force, _nothing(at), _joint(end))


def _torque(
    at: Positions, load: Torque | TorsionSpring | TorsionDamper, link: str, couples: bool
) -> Acting:
    """Return a couple on a link, at its origin."""
    what = f"a {type(load).__name__}"
    if not couples:
        message = (
            f"{what} acts on {link!r}, at no place that is known: loads inside the link "
            "depend on it; replace it by two forces"
        )
        raise InputError(message, link=link)
    place = at.motion.reference_points[link].value
    sign = 1.0 if link == load.link else -1.0
    return Acting(what, place, np.zeros(place.shape), sign * _couple(at, load), None)


def _couple(at: Positions, load: Torque | TorsionSpring | TorsionDamper) -> Float:
    """Return the moment of a load on its first link."""
    if isinstance(load, Torque):
        torque = values_at(load.torque, at.q, at.speed, at.t, lambda name: _measure(at, name))
        return np.asarray(np.where(_acts(at, load, None), torque, 0.0))
    own, other = at.motion.link(load.link), at.motion.link(load.on)
    if isinstance(load, TorsionSpring):
        twist = own.value - other.value - load.angle
        return np.asarray(-load.stiffness * twist - load.preload)
    speeds = at.speed if at.speed.shape[1] > 1 else at.speed[:, 0]
    return np.asarray(-load.damping * (own.velocity(speeds) - other.velocity(speeds)))


def _joint(point: PointLike) -> str | None:
    return point if isinstance(point, str) else None


def _measure(at: Positions, name: str) -> Float:
    """Return the value of a slide, or the angle of a link."""
    motion = at.motion
    both: Float = (motion.slide if name in _mechanism(at).slides else motion.link)(name).value
    return both


def _acts(at: Positions, load: Force | Pressure | Torque, default: str | None) -> Any:
    """Return where a load acts: everywhere, or where its coordinate moves in its direction."""
    if load.while_ is None:
        return np.True_
    name, slides = load.over or default, _mechanism(at).slides
    speeds = at.speed if at.speed.shape[1] > 1 else at.speed[:, 0]
    if name is None:
        rate = at.speed[:, 0]
    elif name in slides:
        rate = at.motion.slide(name).velocity(speeds)
    else:
        rate = at.motion.link(name).velocity(speeds)
    # A rate that is rounding beside the drivers' speeds is no direction.
    size = _size(_mechanism(at))
    units = [size if driver in slides else 1.0 for driver in _mechanism(at).description.drivers]
    still = AT_REST * (abs(at.speed) / units).sum(axis=-1) * (size if name in slides else 1.0)
    return rate > still if load.while_ == "forward" else rate < -still


def _size(mechanism: Mechanism) -> float:
    """Return the larger side of the drawing, m."""
    places = np.array([(x, y) for _, x, y in mechanism.description.joints])
    size = float(np.ptp(places, axis=0).max())
    return size if size > 0.0 else 1.0


def _pressure(at: Positions, load: Pressure, link: str) -> Iterator[Acting]:
    """Yield the force of a pressure on the sliding link, or its reaction on the other."""
    slide = _mechanism(at).slides[load.slide]
    if link not in (slide.link, slide.on):
        return
    area = load.area if load.expands == "forward" else -load.area
    if isinstance(load.pressure, Gas):
        value = at.motion.slide(load.slide).value
        pressure = _core.gas_pressures(load.pressure, area, value)
    else:
        pressure = values_at(load.pressure, at.q, at.speed, at.t, lambda name: _measure(at, name))
    size = np.where(_acts(at, load, load.slide), area * (pressure - load.ambient), 0.0)
    sliding = _mechanism(at).links[slide.link]
    place = _place(at, slide.link, sliding[0] if sliding else (slide.link, (0.0, 0.0)))[0]
    sign = 1.0 if link == slide.link else -1.0
    joint = sliding[0] if sliding and link == slide.link else None
    force = sign * size[:, np.newaxis] * _guide(at, load.slide)
    yield Acting(f"the pressure in {load.slide!r}", place, force, _nothing(at), joint)


def _force(at: Positions, load: Force) -> Float:
    x, y = (
        np.where(
            _acts(at, load, None),
            values_at(value, at.q, at.speed, at.t, lambda name: _measure(at, name)),
            0.0,
        )
        for value in load.force
    )
    if load.axes is None:
        return np.stack([x, y], axis=-1)
    sine, cosine = _trig.sin_cos(at.motion.link(load.axes).value)
    return np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=-1)


def _pull(
    at: Positions, load: Spring | Damper, end: PointLike, other: PointLike
) -> tuple[Float, Float]:
    """Return where a spring or damper pulls at its end, and how."""
    (place, speed), (far, far_speed) = (_place(at, None, one) for one in (end, other))
    span = far - place
    length = np.sqrt((span * span).sum(axis=-1))
    with np.errstate(divide="ignore", invalid="ignore"):
        unit = span / length[:, np.newaxis]
    if isinstance(load, Spring):
        tension = load.stiffness * (length - load.length) + load.preload
    else:
        tension = load.damping * (unit * (far_speed - speed)).sum(axis=-1)
    # Without tension it has no direction at length zero.
    tension = tension[:, np.newaxis]
    return place, np.where(tension == 0.0, 0.0, tension * unit)


def _place(at: Positions, link: str | None, point: PointLike) -> tuple[Float, Float]:
    """Return a point's place and velocity, (P, 2) each."""
    mechanism, speeds = _mechanism(at), at.speed if at.speed.shape[1] > 1 else at.speed[:, 0]
    if isinstance(point, str):
        joint = at.motion.joint(point)
        return joint.value, joint.velocity(speeds)
    link, (x, y) = point
    if link == "ground":
        fixed = np.broadcast_to(np.array([x, y]), (at.q.shape[0], 2))
        return fixed, np.zeros(fixed.shape)
    joints = mechanism.links[link]
    origin = at.motion.joint(joints[0]) if joints else at.motion.reference_points[link]
    angle = at.motion.link(link)
    sine, cosine = _trig.sin_cos(angle.value)
    arm = np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=-1)
    turned = np.stack([-arm[:, 1], arm[:, 0]], axis=-1)
    velocity = origin.velocity(speeds) + angle.velocity(speeds)[:, np.newaxis] * turned
    return origin.value + arm, velocity


def _guide(at: Positions, name: str) -> Float:
    """Return the direction of a guide, (P, 2)."""
    mechanism = _mechanism(at)
    own = mechanism.dimensions.get(f"{name}.angle", 0.0)
    sine, cosine = _trig.sin_cos(at.motion.link(mechanism.slides[name].on).value + own)
    return np.stack([cosine, sine], axis=-1)


def _effort(at: Positions, index: int) -> Float:
    effort = np.asarray(at.found.driver)
    every: Float = effort.reshape(at.q.shape)[:, index]
    return every
