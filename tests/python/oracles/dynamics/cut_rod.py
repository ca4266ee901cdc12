"""Normal force, shear and bending moment at a cut of a rod, by quadrature over the oracle's motion.

Everything on the part before the cut is summed: what the multipliers say of pins, slides and
drives, loads where they act, and mass by mass the inertia and weight of the part.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from oracles.dynamics.body_places import cross
from oracles.dynamics.body_wrenches import Point, load_wrenches
from oracles.dynamics.multipliers import Reactions

if TYPE_CHECKING:
    from collections.abc import Iterator

Density = tuple[Any, Any]
NODES, WEIGHTS = np.polynomial.legendre.leggauss(8)


class CutRod:
    """One link at one position."""

    def __init__(self, machine: assur.Machine, link: str, along: tuple[str, str], *where: Any):
        self.of = Reactions(machine, *where)
        m = self.of.places.mechanism
        self.link, self.mechanism = link, m
        places = self.of.places
        self.first = complex(places.joints[along[0]])
        span = complex(places.joints[along[1]]) - self.first
        self.length, self.e = abs(span), span / abs(span)
        self.g = sum(complex(*one.acceleration) for one in machine.loads if is_weight(one))
        self.acting = list(self.wrenches(machine))

    def wrenches(self, machine: assur.Machine) -> Iterator[tuple[complex, complex, float]]:
        """Place, force and couple of all but weight and inertia."""
        of, m, link = self.of, self.mechanism, self.link
        places = of.places
        for joint in m.links[link]:
            if len(of.links_at[joint]) > 1:
                yield complex(places.joints[joint]), of.joint(joint, link), 0.0
        for name, slide in m.slides.items():
            sign = (link == slide.link) - (link == slide.on)
            normal = of.normal(name) * 1j * complex(places.guide[name])
            yield complex(places.sliding[name]), sign * normal, sign * of.moment(name)
        for k, (kind, a, b) in enumerate(places.drivers):
            sign = (link == a) - (link == b)
            if kind == "angle" and sign:
                (pin,) = set(m.links[a]) & set(m.links[b])
                yield complex(places.joints[pin]), 0j, sign * of.driver(k)
            elif sign:
                along = of.driver(k) * complex(places.guide[kind])
                yield complex(places.sliding[kind]), sign * along, 0.0
        loads = [one for one in machine.loads if not is_weight(one)]
        of.machine = assur.Machine(m, bodies=machine.bodies, loads=loads)
        for one in load_wrenches(of):
            if one.link == link:
                yield complex(one.place), complex(one.force), float(one.couple)
        of.machine = machine

    def at(self, x: float, density: Density) -> tuple[float, float, float]:
        """N, V and M just beyond x; at the far end just before it."""
        end = x >= self.length * (1 - 1e-12)
        cut = self.first + x * self.e
        force, couple = 0j, 0.0
        for place, f, c in self.acting:
            foot = ((place - self.first) * self.e.conjugate()).real
            if foot < x - 1e-12 or (foot <= x + 1e-12 and not end):
                force += f
                couple += c + cross(place - cut, f)
        frame = complex(self.of.places.frame[self.link])
        origin = complex(self.of.places.reference[self.link])
        xs, mu = density
        for a, b, left, right in zip(xs, xs[1:], mu, mu[1:], strict=False):
            top = min(b, x)
            for t, w in zip(NODES, WEIGHTS, strict=True):
                if top <= a:
                    continue
                s = a + (top - a) * (t + 1) / 2
                mass = (left + (right - left) * (s - a) / (b - a)) * w * (top - a) / 2
                place = self.first + s * self.e
                own = (place - origin) / frame
                away = complex(Point(self.of, (self.link, (own.real, own.imag))).acceleration())
                force -= mass * (away - self.g)
                couple -= mass * cross(place - cut, away - self.g)
        inside = -force * self.e.conjugate()
        return inside.real, inside.imag, -couple


def is_weight(load: Any) -> bool:
    return isinstance(load, assur.Gravity)
