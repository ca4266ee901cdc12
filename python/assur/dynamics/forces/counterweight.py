"""Counterweights on links, and bodies with them."""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from assur import _trig
from assur._arrays import not_negative, real_number, short
from assur._validate import checked_name
from assur.dynamics.components import as_list
from assur.dynamics.forces.joint_places import joint_place, mass_centre
from assur.dynamics.loads.loads import Body
from assur.dynamics.loads.table import replace_fields
from assur.dynamics.preconditions import one_design, positive_number
from assur.errors import InputError

if TYPE_CHECKING:
    from assur.dynamics.model import AnyMachine
    from assur.kinematics.mechanism import Mechanism

__all__ = ["Counterweight"]


@dataclass(frozen=True)
class Counterweight:
    """A weight on a link, a point mass: its mass times radius, and its direction.

    Parameters
    ----------
    link : str
        The link that carries it.
    moment : float
        Mass × radius, kg·m, not negative.
    angle : float
        Direction from the joint `about`, counter-clockwise in the link's frame (x from its first
        joint toward its second), rad.
    about : str, optional
        The joint that the radius is measured from; the link's first by default.
    mass : float, optional
        kg. Without it the weight is known by its moment alone; `with_mass` or `with_radius` sets
        it.

    Examples
    --------
    >>> import assur
    >>> weight = assur.balance.Counterweight("crank", moment=0.06, angle=3.0)
    >>> weight.with_radius(0.04).mass, weight.with_mass(2.0).radius
    (1.5, 0.03)
    """

    link: str
    moment: float
    _: KW_ONLY
    angle: float = 0.0
    about: str | None = None
    mass: float | None = None

    def __post_init__(self) -> None:
        mass = None if self.mass is None else not_negative(self.mass, "Counterweight: mass")
        moment = not_negative(self.moment, "Counterweight: moment")
        if mass == 0.0 and moment > 0.0:
            message = f"Counterweight: mass is 0, a moment of {moment:g} kg·m needs a positive one"
            raise InputError(message, value=0.0)
        replace_fields(
            self,
            link=checked_name(self.link, "Counterweight link"),
            moment=moment,
            angle=real_number(self.angle, "Counterweight: angle"),
            about=None if self.about is None else checked_name(self.about, "Counterweight about"),
            mass=mass,
        )

    @property
    def radius(self) -> float | None:
        """Distance from the joint `about`, m; None without a mass."""
        if self.mass is None:
            return None
        return self.moment / self.mass if self.mass > 0.0 else 0.0

    def with_radius(self, radius: float) -> Counterweight:
        """Return this weight with the mass needed at a radius, m.

        Parameters
        ----------
        radius : float
            Distance from `about`, m.

        Returns
        -------
        Counterweight
            A new one.

        Examples
        --------
        >>> import assur
        >>> machine = assur.Machine(
        ...     assur.SliderCrank(0.1, 0.4), bodies={"piston": assur.Body(mass=20.0)}
        ... )
        >>> (weight,) = assur.balance.slider_crank(machine, fraction=0.5)
        >>> weight.with_radius(0.2).mass  # kg
        5.0
        """
        at = real_number(positive_number(radius, "radius"), "radius")
        return replace(self, mass=self.moment / at)

    def with_mass(self, mass: float) -> Counterweight:
        """Return this weight with a mass, kg, at the radius then needed.

        Parameters
        ----------
        mass : float
            Its mass, kg.

        Returns
        -------
        Counterweight
            A new one.

        Examples
        --------
        >>> import assur
        >>> machine = assur.Machine(
        ...     assur.SliderCrank(0.1, 0.4), bodies={"piston": assur.Body(mass=20.0)}
        ... )
        >>> (weight,) = assur.balance.slider_crank(machine, fraction=0.5)
        >>> weight.with_mass(10.0).radius  # m
        0.1
        """
        return replace(self, mass=real_number(positive_number(mass, "mass"), "mass"))


def counterweight(link: str, about: str | None, moment: complex) -> Counterweight:
    """Return the weight of a mass moment, kg·m, in the link's frame."""
    # Not −0, whose angle would be −π.
    x, y = moment.real + 0.0, moment.imag + 0.0
    size = float(np.sqrt(x * x + y * y))
    return Counterweight(link, size, angle=float(_trig.arctan2(y, x)), about=about)


def with_counterweights(machine: AnyMachine, weights: Any) -> AnyMachine:
    """Return a machine with counterweights; see `Machine.with_counterweights`."""
    mechanism = machine.mechanism
    if mechanism is None:
        message = "a machine of a table has no links: counterweights need a mechanism"
        raise InputError(message)
    one_design(machine, "with_counterweights")
    bodies = dict(machine.bodies)
    for weight in as_list(weights, "weights"):
        if not isinstance(weight, Counterweight):
            message = f"{short(weight)} is not an assur.balance.Counterweight"
            raise InputError(message)
        link = weight.link
        mechanism.core.index_of("link", link)
        if weight.mass is None:
            message = (
                f"the counterweight on {link!r} has a moment of {weight.moment:g} kg·m but no "
                "mass: use with_radius or with_mass"
            )
            raise InputError(message, link=link)
        place = _place(mechanism, weight)
        bodies[link] = _with_point_mass(mechanism, link, bodies.get(link), weight.mass, place)
    return machine._made(mechanism, bodies, machine.loads, machine.motor, machine.friction)


def _place(mechanism: Mechanism, weight: Counterweight) -> complex:
    """Return a counterweight's place in its link's frame."""
    link, about = weight.link, weight.about
    joints = mechanism.links[link]
    if about is not None and about not in joints:
        message = (
            f"the counterweight on {link!r} is about {about!r}, which is not one of its joints"
        )
        raise InputError(message, joint=about, link=link)
    from_joint = about or (joints[0] if joints else None)
    pivot = 0j if from_joint is None else joint_place(mechanism, link, from_joint)
    sine, cosine = _trig.sin_cos(weight.angle)
    return pivot + (weight.radius or 0.0) * complex(float(cosine), float(sine))


def _with_point_mass(
    mechanism: Mechanism, link: str, body: Body | None, mass: float, place: complex
) -> Body:
    """Return a body and a point mass as one, by the theorem of parallel axes."""
    if body is None:
        return Body(mass=mass, inertia=0.0, at=(place.real, place.imag))
    total = body.mass + mass
    if mass == 0.0 or total == 0.0:
        return body
    centre = mass_centre(mechanism, link, body)
    share = mass / total
    away = place - centre
    middle = centre + share * away
    squared = away.real * away.real + away.imag * away.imag
    return Body(
        mass=total,
        inertia=body.inertia + body.mass * share * squared,
        at=(middle.real, middle.imag),
    )
