"""Reactions with Coulomb friction, by steps: the friction of the last reactions as loads.

Far from locking each step leaves about the coefficient of friction of the error.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import assur
from models.machines.friction_cases import Bearing, FrictionCase, Journal
from oracles.dynamics.body_places import GROUND, dot
from oracles.dynamics.multipliers import Reactions

if TYPE_CHECKING:
    from collections.abc import Iterator

STEPS = 60
CLOSE = 1e-13  # of the driver


class WithFriction:
    """The reactions of a case and what friction costs."""

    def __init__(self, case: FrictionCase) -> None:
        self.case = case
        self.found = self.ideal = self.solve([])
        for _ in range(STEPS):
            last = self.found.driver()
            self.found = self.solve(list(self.friction()))
            if abs(self.found.driver() - last) <= CLOSE * abs(last):
                return
        message = f"{case.name}: no solution in {STEPS} steps"
        raise ArithmeticError(message)

    def solve(self, friction: list[Any]) -> Reactions:
        machine, q, speed = self.case.machine, self.case.q, self.case.speed
        assert machine.mechanism is not None
        loads = [*machine.loads, *friction]
        return Reactions(
            assur.Machine(machine.mechanism, bodies=machine.bodies, loads=loads), q, speed
        )

    def friction(self) -> Iterator[Any]:
        for name, one in self.case.friction.items():
            if isinstance(one, Journal):
                yield assur.Torque(
                    one.link, -sign(self.turning(one)) * self.size(name), on=one.other
                )
            else:
                yield from self.pushes(name, -sign(self.sliding(name)) * self.size(name))

    def pushes(self, name: str, along: float) -> Iterator[Any]:
        """At the sliding point, along the guide; the guide's link gets the opposite there."""
        places = self.found.places
        slide = places.mechanism.slides[name]
        force = along * places.guide[name]
        for link, sense in ((slide.link, 1.0), (slide.on, -1.0)):
            at = places.sliding[name]
            if link != GROUND:
                at = (at - places.reference[link]) * places.frame[link].conjugate()
            push = sense * force
            yield assur.Force((link, (at.real, at.imag)), (push.real, push.imag))

    # -- of one pair --------------------------------------------------------------------------

    def size(self, name: str) -> float:
        one, found = self.case.friction[name], self.found
        if isinstance(one, Bearing):
            tilt = 2 * abs(found.moment(name)) / one.length
            return one.coefficient * max(abs(found.normal(name)), tilt)
        return one.coefficient * one.radius * abs(found.joint(name, one.link))

    def turning(self, one: Journal) -> float:
        return float(self.found.spin[one.link] - self.found.spin[one.other])

    def sliding(self, name: str) -> float:
        """Speed of the sliding point relative to the guide's link."""
        found, places = self.found, self.found.places
        slide = places.mechanism.slides[name]
        point = places.sliding[name]

        def velocity(link: str) -> Any:
            arm = point - places.reference[link]
            return found.velocity[link] + 1j * found.spin[link] * arm

        return float(dot(places.guide[name], velocity(slide.link) - velocity(slide.on)))

    # -- power --------------------------------------------------------------------------------

    @property
    def loss(self) -> float:
        total = 0.0
        for name, one in self.case.friction.items():
            rate = self.turning(one) if isinstance(one, Journal) else self.sliding(name)
            total += self.size(name) * abs(rate)
        return total

    @property
    def input(self) -> float:
        return self.found.driver() * self.case.speed

    @property
    def ideal_input(self) -> float:
        return self.ideal.driver() * self.case.speed

    @property
    def efficiency(self) -> float:
        """Of the drive, or with the load driving."""
        return 1.0 - self.loss / max(self.ideal_input + self.loss, -self.ideal_input)


def sign(value: float) -> float:
    return (value > 0) - (value < 0)
