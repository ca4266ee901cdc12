"""A machine in other units of length, time and mass; friction in its pairs.

Every number is scaled by its dimension.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from models.mechanisms.mechanism_data import arguments

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from models.mechanisms.mechanism_data import Description


@dataclass(frozen=True)
class Units:
    """How many new units one old one is."""

    length: float = 1.0
    time: float = 1.0
    mass: float = 1.0

    @property
    def force(self) -> float:
        return self.mass * self.length / self.time**2

    @property
    def torque(self) -> float:
        return self.force * self.length

    @property
    def inertia(self) -> float:
        return self.mass * self.length**2

    def description(self, d: Description) -> Description:
        """The drawing in the unit of length."""
        joints = {n: (self.length * x, self.length * y) for n, (x, y) in d.joints.items()}
        return replace(d, joints=joints)

    def coordinate(self, d: Description) -> NDArray[np.float64]:
        """The unit of each driver."""
        return np.array([self.length if kind == "slide" else 1.0 for kind, *_ in d.drivers])


def in_units(d: Description, machine: assur.Machine, u: Units) -> assur.Machine:
    """The machine with every number in other units."""
    unit = u.coordinate(d)
    mechanism = assur.Mechanism(**arguments(u.description(d)))
    friction = {n: rubbed(one, u) for n, one in machine.friction.items()}
    bodies = {n: body(one, u) for n, one in machine.bodies.items()}
    loads = [load(one, u, unit) for one in machine.loads]
    return rubbing(mechanism, bodies, loads, motors(machine, u, unit), friction)


def rubbing(
    mechanism: assur.Mechanism, bodies: Any, loads: Any, motor: Any, friction: Any
) -> assur.Machine:
    """A machine whose loads at joints are on the links that the library chooses."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", ".*the friction depends on which", assur.AssurWarning)
        return assur.Machine(mechanism, bodies=bodies, loads=loads, motor=motor, friction=friction)


def body(one: assur.Body, u: Units) -> assur.Body:
    at = one.at
    if isinstance(at, tuple):
        at = (u.length * at[0], u.length * at[1])
    return assur.Body(mass=u.mass * one.mass, inertia=u.inertia * one.inertia, at=at)


def place(at: Any, u: Units) -> Any:
    if isinstance(at, str):
        return at
    link, (x, y) = at
    return link, (u.length * x, u.length * y)


def value(one: Any, unit: float, u: Units, q: NDArray[np.float64], over: float) -> Any:
    """A number, a table or a function of (t, q, speed), in other units."""
    if isinstance(one, assur.Table):
        x = one.q * (over if one.over else q[0])
        return assur.Table(
            x, one.value * unit, spline=one.spline, periodic=one.periodic, over=one.over
        )
    if callable(one):
        per = q if len(q) > 1 else q[0]
        return lambda t, x, v: unit * one(t / u.time, x / per, v / per * u.time)
    return unit * one


def load(one: Any, u: Units, q: NDArray[np.float64]) -> Any:
    if isinstance(one, assur.Gravity):
        x, y = one.acceleration
        unit = u.length / u.time**2
        return assur.Gravity((unit * x, unit * y))
    if isinstance(one, assur.Force):
        force = tuple(value(f, u.force, u, q, u.length) for f in one.force)
        return replace(one, at=place(one.at, u), force=force)
    if isinstance(one, assur.Torque):
        return replace(one, torque=value(one.torque, u.torque, u, q, u.length))
    if isinstance(one, assur.Spring):
        return replace(
            one,
            first=place(one.first, u),
            second=place(one.second, u),
            stiffness=u.force / u.length * one.stiffness,
            length=u.length * one.length,
            preload=u.force * one.preload,
        )
    if isinstance(one, assur.Damper):
        damping = u.mass / u.time * one.damping
        return replace(one, first=place(one.first, u), second=place(one.second, u), damping=damping)
    if isinstance(one, assur.TorsionDamper):
        return replace(one, damping=u.torque * u.time * one.damping)
    if isinstance(one, assur.TorsionSpring):
        return replace(one, stiffness=u.torque * one.stiffness, preload=u.torque * one.preload)
    message = f"no units for {one!r}"
    raise TypeError(message)


def motors(machine: assur.Machine, u: Units, q: NDArray[np.float64]) -> Any:
    own = machine.motor
    if isinstance(own, list | tuple):
        return [None if one is None else motor(one, u, q, k) for k, one in enumerate(own)]
    return None if own is None else motor(own, u, q, 0)


def motor(one: Any, u: Units, q: NDArray[np.float64], k: int) -> Any:
    """Of a driven slide the ratio is in rad/m: the motor itself still turns."""
    extra: dict[str, Any] = {
        "ratio": one.ratio / q[k],
        "rotor_inertia": u.inertia * one.rotor_inertia,
    }
    if isinstance(one, assur.ConstantTorque):
        torque = value(one.torque, u.torque, u, q, u.length)
        return replace(one, torque=torque, **extra)
    if isinstance(one, assur.LinearMotor):
        return replace(one, stall=u.torque * one.stall, no_load=one.no_load / u.time, **extra)
    if isinstance(one, assur.InductionMotor):
        return replace(
            one, breakdown=u.torque * one.breakdown, synchronous=one.synchronous / u.time, **extra
        )
    return assur.Table(
        one.q / u.time, u.torque * one.value, spline=one.spline, periodic=one.periodic, **extra
    )


def rubbed(one: Any, u: Units) -> Any:
    """Friction in other units."""
    if isinstance(one, assur.JointFriction):
        viscous = u.torque * u.time * one.viscous
        return replace(one, radius=u.length * one.radius, viscous=viscous)
    return replace(one, length=u.length * one.length, viscous=u.mass / u.time * one.viscous)


def with_friction(d: Description, machine: assur.Machine, rng: Any) -> assur.Machine:
    """Friction in most pairs: of all kinds, pairs that do not move among them.

    At a pin of three links or more which one it is fast in would follow the order of links: only
    pins of two links rub.
    """
    size = float(np.ptp(list(d.joints.values()), axis=0).max())
    part = 10.0 ** rng.uniform(-2.5, -0.7)
    friction: dict[str, Any] = {}
    for name in d.joints:
        links = [n for n, own in d.links.items() if name in own]
        if len(links) == 2 and rng.random() < 0.5:
            viscous = rng.choice((0.0, rng.uniform(0.01, 0.5)))
            friction[name] = assur.JointFriction(
                part * rng.uniform(0.3, 1.0), size * rng.uniform(0.01, 0.1), viscous=viscous
            )
    for name in d.slides:
        if rng.random() < 0.5:
            viscous = rng.choice((0.0, rng.uniform(0.01, 0.5)))
            friction[name] = assur.SlideFriction(
                part * rng.uniform(0.3, 1.0), size * rng.uniform(0.1, 0.5), viscous=viscous
            )
    mechanism = machine.mechanism
    assert mechanism is not None
    return rubbing(mechanism, machine.bodies, machine.loads, machine.motor, friction)
