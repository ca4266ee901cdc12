"""A link as a straight rod with mass along it, and the loads on it at positions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from assur._arrays import finite_array, short
from assur._validate import checked_name
from assur.dynamics.forces.applied_loads import Positions, acting_on
from assur.dynamics.forces.joint_places import joint_place, mass_centre
from assur.dynamics.forces.kinetostatics import reactions
from assur.dynamics.forces.load_forces import loads_of
from assur.dynamics.internal.beam import Density, PointLoad, solve_beam
from assur.dynamics.loads.loads import Body, Gravity
from assur.dynamics.motion.motion_input import DrivenMotion
from assur.errors import InputError

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.dynamics.forces.applied_loads import Acting
    from assur.dynamics.internal.beam import Beam
    from assur.dynamics.model import MachineModel, OnError
    from assur.kinematics.mechanism import Mechanism

# The body and its distribution may differ by this fraction: they are typed numbers.
AGREE = 1e-9


class Rod(NamedTuple):
    """A link seen as a beam: its line from one joint to another, and its mass along it."""

    machine: MachineModel
    link: str
    along: tuple[str, str]
    length: float
    density: Density

    def solve(self, motion: DrivenMotion, on_error: OnError) -> Beam:
        """Return the loads at P positions: coordinates and rates (P, n), times (P,)."""
        machine, first = self.machine, self.along[0]
        is_single = motion.q.shape[1] == 1
        parts = [part[:, 0] if is_single else part for part in motion[:3]]
        q, speed, acceleration = parts
        driven = DrivenMotion(q, speed, acceleration, motion.t, motion.senses)
        solved_forces = reactions(machine, driven, None, on_error)
        solved = solved_forces.mechanism.solve(parts[0], order=2, on_error=on_error)
        a, b = (solved.joint(joint).value for joint in self.along)
        e = (b - a) / self.length
        n = np.stack([-e[:, 1], e[:, 0]], axis=-1)
        pull = solved.joint(first).acceleration(*parts[1:]) - _gravity(machine)
        angle = solved.link(self.link)
        spin, second = angle.velocity(parts[1]), angle.acceleration(*parts[1:])
        axial = np.stack([(pull * e).sum(axis=1), -spin * spin], axis=-1)
        across = np.stack([(pull * n).sum(axis=1), second], axis=-1)
        at = Positions(machine, solved, solved_forces, loads_of(solved_forces))
        loads = [self._on_line(load, a, e, n) for load in acting_on(at, self.link)]
        return solve_beam(self.length, self.density, axial, across, loads)

    def _on_line(self, load: Acting, a: Float, e: Float, n: Float) -> PointLoad:
        """Return a load at its foot on the line: the arm between turns it into a couple too."""
        away = load.place - a
        x, y = (away * e).sum(axis=1), (away * n).sum(axis=1)
        if load.joint in self.along:
            x = np.full(x.shape, 0.0 if load.joint == self.along[0] else self.length)
            y = np.zeros(y.shape)
        along, across = (load.force * e).sum(axis=1), (load.force * n).sum(axis=1)
        tiny = AGREE * self.length
        outside = (x < -tiny) | (x > self.length + tiny)
        acts = (load.force != 0.0).any(axis=1) | (load.couple != 0.0)
        if (outside & acts).any():
            where = float(x[outside & acts][0])
            first, second = self.along
            message = (
                f"{load.what} acts on {self.link!r} at {where:g} m along {first}–{second}, outside "
                f"its length of {self.length:g} m: name its outer joints as along"
            )
            raise InputError(message, link=self.link, value=where)
        # A foot that is at an end but for rounding moves there; its couple stays the same.
        at_end = np.where(x > self.length - tiny, self.length, x)
        foot = np.where(x < tiny, 0.0, at_end)
        return PointLoad(foot, along, across, load.couple - y * along + (x - foot) * across)


def _gravity(machine: MachineModel) -> Float:
    accelerations = [load.acceleration for load in machine.loads if isinstance(load, Gravity)]
    return np.sum(accelerations, axis=0) if accelerations else np.zeros(2)


def straight_rod(
    machine: MachineModel, mechanism: Mechanism, link: Any, along: Any, density: Any
) -> Rod:
    """Return a link of a machine of one design as a rod, checked; see `Machine.internal_loads`."""
    link = checked_name(link, "link")
    mechanism.core.index_of("link", link)
    joints = mechanism.links[link]
    if link == "ground" or len(joints) < 2:
        message = f"link {link!r} is not a rod: loads inside it need a moving link of two joints"
        raise InputError(message, link=link)
    ends = joints[:2] if along is None else along
    if not isinstance(ends, tuple | list | str) or len(ends) != 2:
        message = f"along is {short(along)}: two joints of {link!r} are needed, {', '.join(joints)}"
        raise InputError(message, link=link)
    for joint in ends:
        if not isinstance(joint, str) or joint not in joints:
            message = (
                f"along: {short(joint)} is not one of the joints of {link!r}, {', '.join(joints)}"
            )
            raise InputError(message, link=link)
    # The same joint twice also has no length.
    first, second = (joint_place(mechanism, link, joint) for joint in ends)
    span = second - first
    length = float(np.sqrt(span.real * span.real + span.imag * span.imag))
    if length == 0.0:
        message = f"along: {ends[0]!r} and {ends[1]!r} are at the same place of {link!r}"
        raise InputError(message, link=link)
    body = machine.bodies.get(link, Body())
    spread = _density(density, length, body.mass)
    _require_agreement(mechanism, link, body, spread, (first, span / length))
    return Rod(machine, link, (ends[0], ends[1]), length, spread)


def _density(given: Any, length: float, mass: float) -> Density:
    """Return a checked density; uniform by default."""
    if given is None:
        return Density(np.array([0.0, length]), np.full(2, mass / length))
    is_pair = isinstance(given, tuple | list) or (isinstance(given, np.ndarray) and given.ndim)
    if not is_pair or len(given) != 2:
        message = f"density is {short(given)}: two lists (x, kg/m) are needed"
        raise InputError(message)
    x, value = finite_array(given[0], "density: x"), finite_array(given[1], "density: kg/m")
    if x.ndim != 1 or x.shape != value.shape or x.size < 2:
        message = f"density: x has the shape {x.shape}, kg/m {value.shape}: two lists are needed"
        raise InputError(message)
    if (np.diff(x) < 0.0).any() or (value < 0.0).any():
        message = "density: x must ascend (a place twice makes a step), kg/m must not be negative"
        raise InputError(message)
    if abs(x[0]) > AGREE * length or abs(x[-1] - length) > AGREE * length:
        message = f"density covers {x[0]:g} to {x[-1]:g} m: the link's line is 0 to {length:g} m"
        raise InputError(message)
    x[0], x[-1] = 0.0, length
    return Density(x, value)


def _require_agreement(
    mechanism: Mechanism, link: str, body: Body, density: Density, line: tuple[complex, complex]
) -> None:
    """Raise InputError unless a body is what the mass along its line makes it."""
    mass, middle, inertia = density.integrals()
    first, direction = line
    length = float(density.x[-1])
    centre = first + middle * direction
    body_centre = mass_centre(mechanism, link, body)
    off = body_centre - centre if mass > 0.0 else 0j
    agrees = (
        abs(body.mass - mass) <= AGREE * mass
        and max(abs(off.real), abs(off.imag)) <= AGREE * length
        and abs(body.inertia - inertia) <= AGREE * mass * length * length
    )
    if not agrees:
        message = (
            f"the body of {link!r} has {body.mass:.9g} kg at "
            f"({body_centre.real:.9g}, {body_centre.imag:.9g}) and "
            f"{body.inertia:.9g} kg·m², the mass along its line {mass:.9g} kg at "
            f"({centre.real:.9g}, {centre.imag:.9g}) and {inertia:.9g} kg·m²: change the body or "
            "give another density"
        )
        raise InputError(message, link=link)
