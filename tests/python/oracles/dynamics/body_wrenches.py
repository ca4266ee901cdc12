"""What loads and inertia do to each link, written from their definitions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import assur
from oracles.dynamics.body_places import GROUND, dot
from oracles.dynamics.machine_energy import spline

if TYPE_CHECKING:
    from collections.abc import Iterator

    from oracles.dynamics.multipliers import Reactions


@dataclass(frozen=True)
class Wrench:
    """A force at a place of a link and a couple on it."""

    link: str
    place: Any
    force: Any = 0.0j
    couple: Any = 0.0


def loaded_link(mechanism: assur.Mechanism, joint: str) -> str:
    """Of several links at a pin the only block takes the load, or else the first."""
    links = [name for name, own in mechanism.links.items() if joint in own]
    sliding = [name for slide in mechanism.slides.values() for name in (slide.link, slide.on)]
    blocks = [name for name in links if name in sliding and mechanism.links[name] == (joint,)]
    return blocks[0] if len(blocks) == 1 and GROUND not in links else links[0]


class Point:
    """A point of a link, with its velocity and acceleration."""

    def __init__(self, of: Reactions, at: Any, link: str | None = None) -> None:
        places = of.places
        if isinstance(at, str):
            self.link = link or loaded_link(places.mechanism, at)
            self.place = places.joints[at]
        else:
            self.link, (x, y) = at
            self.place = places.plane((x, y))
            if self.link != GROUND:
                self.place = places.reference[self.link] + places.frame[self.link] * self.place
        arm = self.place - places.reference[self.link]
        spin = of.spin[self.link]
        self.velocity = of.velocity[self.link] + 1j * spin * arm
        self.of, self.arm = of, arm

    def acceleration(self) -> Any:
        of, spin = self.of, self.of.spin[self.link]
        return of.second[self.link] + (1j * of.second_spin[self.link] - spin**2) * self.arm


def mass_centre(of: Reactions, link: str, body: assur.Body) -> Point:
    at = of.places.mechanism.links[link][0] if body.at is None else body.at
    return Point(of, at, link) if isinstance(at, str) else Point(of, (link, at))


def inertia_wrenches(of: Reactions) -> Iterator[Wrench]:
    """D'Alembert: −m a at the centre of mass and −I α."""
    for link, body in of.machine.bodies.items():
        if body.mass:
            centre = mass_centre(of, link, body)
            yield Wrench(link, centre.place, -of.places.real(body.mass) * centre.acceleration())
        place = of.places.reference[link]
        yield Wrench(link, place, couple=-of.places.real(body.inertia) * of.second_spin[link])


def load_wrenches(of: Reactions) -> Iterator[Wrench]:
    for load in of.machine.loads:
        if isinstance(load, assur.Gravity):
            pull = of.places.plane(load.acceleration)
            for link, body in of.machine.bodies.items():
                if body.mass:
                    place = mass_centre(of, link, body).place
                    yield Wrench(link, place, of.places.real(body.mass) * pull)
        elif isinstance(load, assur.Force):
            point = Point(of, load.at, getattr(load, "on", None))
            force = number(of, load.force[0]) + 1j * number(of, load.force[1])
            axes = 1.0 if load.axes is None else of.places.frame[load.axes]
            yield Wrench(point.link, point.place, force * axes)
        elif isinstance(load, assur.Spring | assur.Damper):
            yield from pulled(of, load)
        else:
            yield from twisted(of, load)


def pulled(of: Reactions, load: assur.Spring | assur.Damper) -> Iterator[Wrench]:
    """Both ends pull each other with the tension, along their line."""
    first, second = Point(of, load.first), Point(of, load.second)
    span = second.place - first.place
    length = abs(span)
    along = span / length
    if isinstance(load, assur.Spring):
        tension = load.stiffness * (length - load.length) + load.preload
    else:
        tension = load.damping * dot(along, second.velocity - first.velocity)
    yield Wrench(first.link, first.place, tension * along)
    yield Wrench(second.link, second.place, -tension * along)


def twisted(of: Reactions, load: Any) -> Iterator[Wrench]:
    """A torque on a link and its reaction on another."""
    link, on, places = load.link, load.on, of.places
    if isinstance(load, assur.Torque):
        torque = number(of, load.torque)
    elif isinstance(load, assur.TorsionSpring):
        turned = places.angle[link] - places.angle[on] - load.angle
        torque = -(load.stiffness * turned + load.preload)
    elif isinstance(load, assur.TorsionDamper):
        torque = -load.damping * (of.spin[link] - of.spin[on])
    else:
        message = f"the oracle does not know the load {load}"
        raise TypeError(message)
    yield Wrench(link, places.reference[link], couple=torque)
    yield Wrench(on, places.reference[on], couple=-torque)


def number(of: Reactions, value: Any) -> Any:
    """A number, a table over the first driver, or a function of (0, q, speed)."""
    if isinstance(value, assur.Table):
        value = spline(value, value.periodic)(of.q[0])
    elif callable(value):
        q, speed = tuple(of.q.tolist()), tuple(of.speed.tolist())
        value = value(0.0, q[0], speed[0]) if len(q) == 1 else value(0.0, q, speed)
    return of.places.real(value)
