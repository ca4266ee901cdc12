"""Counterweights for the shaking force of the four-bar and the slider-crank, in closed form."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from assur._arrays import real_number, short
from assur.balance.chains import find_four_bar, find_slider_crank
from assur.dynamics.forces.counterweight import counterweight
from assur.dynamics.forces.joint_places import joint_place, mass_centre
from assur.dynamics.machine import Machine
from assur.dynamics.preconditions import one_design, positive_number
from assur.errors import InputError

if TYPE_CHECKING:
    from assur.dynamics.forces.counterweight import Counterweight
    from assur.kinematics.mechanism import Mechanism

__all__ = ["four_bar", "slider_crank"]


class _Masses:
    """Masses of a machine's links, and mass moments in the links' frames."""

    def __init__(self, machine: Machine, what: str) -> None:
        self.mechanism = checked_mechanism(machine, what)
        self.bodies = machine.bodies

    def mass(self, link: str) -> float:
        return self.bodies[link].mass if link in self.bodies else 0.0

    def moment(self, link: str, about: str) -> complex:
        """Return mass × place of the centre from a joint, kg·m."""
        if link not in self.bodies:
            return 0j
        body = self.bodies[link]
        place = mass_centre(self.mechanism, link, body) - self.place(link, about)
        return body.mass * place

    def place(self, link: str, joint: str) -> complex:
        return joint_place(self.mechanism, link, joint)

    def arm(self, link: str, first: str, second: str) -> complex:
        """Return the vector between two joints in the link's frame, m."""
        return self.place(link, second) - self.place(link, first)


def checked_mechanism(machine: Any, what: str) -> Mechanism:
    """Return the mechanism of a machine of one design."""
    if not isinstance(machine, Machine):
        message = f"{short(machine)} is not an assur.Machine"
        raise InputError(message)
    if machine.mechanism is None:
        message = f"a machine of a table has no links: {what} needs a mechanism"
        raise InputError(message)
    one_design(machine, what)
    return machine.mechanism


def four_bar(machine: Machine) -> tuple[Counterweight, Counterweight]:
    """Return the two counterweights that take away the whole shaking force of a four-bar.

    Parameters
    ----------
    machine : Machine
        Of one design. Links and joints may have any names, and centres of mass may be anywhere.

    Returns
    -------
    (Counterweight, Counterweight)
        On the driven link (or the first that is pivoted on the ground) and on the other one, each
        about its pivot. `Machine.with_counterweights` adds them at any radius. A shaking moment
        remains, the same about every point.

    Raises
    ------
    InputError
        A linkage that is not a four-bar, a batch, a machine of a table.

    Notes
    -----
    The coupler moves the common centre of mass as the complex masses m (1 − p) and m p in its
    pins, p = (s − b)/(c − b) with s its centre and b, c its pins. With these the centres of crank
    and rocker must be on their pivots.

    References
    ----------
    R. S. Berkof and G. G. Lowen, *A new method for completely force balancing simple linkages*,
    J. Eng. Ind. 91 (1969) 21.

    Examples
    --------
    >>> import assur
    >>> linkage = assur.FourBar(0.05, 0.15, 0.12, 0.16)
    >>> machine = assur.Machine(
    ...     linkage, bodies={"coupler": assur.Body(mass=1.2, inertia=3e-3, at=(0.08, 0.01))}
    ... )
    >>> weights = assur.balance.four_bar(machine)
    >>> [(w.link, round(w.moment, 4), round(w.angle, 4)) for w in weights]
    [('crank', 0.0283, 2.9997), ('rocker', 0.0774, -3.0172)]
    >>> balanced = machine.with_counterweights(w.with_radius(0.04) for w in weights)
    >>> bool(abs(balanced.reactions([0.5, 2.0], speed=20.0).shaking_force).max() < 1e-12)
    True
    """
    masses = _Masses(machine, "balance.four_bar")
    crank, coupler, rocker, a, b, c, d = find_four_bar(masses.mechanism)
    at_c = masses.moment(coupler, b) / masses.arm(coupler, b, c)
    at_b = masses.mass(coupler) - at_c
    first = masses.moment(crank, a) + at_b * masses.arm(crank, a, b)
    second = masses.moment(rocker, d) + at_c * masses.arm(rocker, d, c)
    return counterweight(crank, a, -first), counterweight(rocker, d, -second)


def slider_crank(
    machine: Machine, *, fraction: float = 1.0, rod_radius: float | None = None
) -> tuple[Counterweight, ...]:
    """Return the counterweights of a slider-crank.

    Parameters
    ----------
    machine : Machine
        Of one design. Links and joints may have any names, and centres of mass may be anywhere.
    fraction : float
        Part of the reciprocating mass that the crank's counterweight balances, 0 or more. One half
        leaves the least mean square of force, whatever the length of the rod (guide through the
        crank's axis).
    rod_radius : float, optional
        Radius, m, of a second weight on the rod, beyond the crankpin. Both weights then take away
        the whole shaking force, and `fraction` must be 1.

    Returns
    -------
    tuple of Counterweight
        On the crank, about its pivot; with `rod_radius` also on the rod, about the crankpin, with
        its mass.

    Raises
    ------
    InputError
        A linkage that is not a slider-crank, a batch, a machine of a table; a fraction or radius
        that does not fit.

    Notes
    -----
    A rod of mass m acts as m (1 − p) at the crankpin, which rotates, and m p at the piston, which
    reciprocates (complex where its centre is off its line: p = (s − a)/(b − a)). A weight on the
    crank can balance the rotating mass wholly. It takes the fraction c of the reciprocating mass's
    first harmonic along the guide and adds as much across it. See `docs/explanation/reactions.md`.

    References
    ----------
    J. J. Uicker, G. R. Pennock, J. E. Shigley, *Theory of Machines and Mechanisms*, on balancing of
    single-cylinder engines. For two weights: R. S. Berkof and G. G. Lowen, J. Eng. Ind. 91 (1969)
    21.

    Examples
    --------
    An engine with 50 kg reciprocating and 37 kg rotating, two thirds balanced at 0.4 m:

    >>> import assur
    >>> engine = assur.Machine(
    ...     assur.SliderCrank(0.15, 0.6),
    ...     bodies={"piston": assur.Body(mass=50.0), "crank": assur.Body(mass=37.0, at="A")},
    ... )
    >>> (weight,) = assur.balance.slider_crank(engine, fraction=2 / 3)
    >>> round(weight.with_radius(0.4).mass, 3), round(weight.angle, 4)
    (26.375, 3.1416)
    """
    masses = _Masses(machine, "balance.slider_crank")
    c = real_number(fraction, "fraction")
    if c < 0.0:
        message = f"fraction is {c:g}: 0 or more is needed"
        raise InputError(message, value=c)
    crank, rod, piston, o, a, b = find_slider_crank(masses.mechanism)
    sliding = masses.mass(piston)
    crank_moment, throw = masses.moment(crank, o), masses.arm(crank, o, a)
    if rod_radius is None:
        at_b = masses.moment(rod, a) / masses.arm(rod, a, b)
        at_a = masses.mass(rod) - at_b
        return (counterweight(crank, o, -crank_moment - (at_a + c * (at_b + sliding)) * throw),)
    if c != 1.0:
        message = f"fraction is {c:g}: with rod_radius the whole force is balanced, leave it out"
        raise InputError(message, value=c)
    # All that the rod carries has its centre at the crankpin, and then all on the crank's axis.
    beyond = -masses.moment(rod, a) - sliding * masses.arm(rod, a, b)
    radius = real_number(positive_number(rod_radius, "rod_radius"), "rod_radius")
    second = counterweight(rod, a, beyond).with_radius(radius)
    carried = masses.mass(rod) + sliding + (second.mass or 0.0)
    return counterweight(crank, o, -crank_moment - carried * throw), second
