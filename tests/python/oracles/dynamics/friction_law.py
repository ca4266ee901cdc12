"""The law of friction at one position, from forces in body coordinates with multipliers.

Forces are linear in friction, so the oracle's forces without friction, and with a unit of it in
each pair, give those with any.  A search from many starts finds solutions that a library should
know.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from oracles.dynamics.body_places import GROUND, dot
from oracles.dynamics.multipliers import Reactions

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

STILL = 1e-9  # relative speeds below it are not asked about


@dataclass(frozen=True)
class Rub:
    """Two links that rub: at a joint, or in a slide."""

    name: str
    link: str
    other: str
    friction: Any

    @property
    def is_slide(self) -> bool:
        return isinstance(self.friction, assur.SlideFriction)


class FrictionLaw:
    """All pairs with friction of a machine at one position, and how forces depend on them."""

    def __init__(self, plain: assur.Machine, friction: Any, where: tuple[Any, Any, Any]) -> None:
        self.plain, self.where = plain, where
        self.without = self.solve([])
        mechanism = plain.mechanism
        assert mechanism is not None
        self.rubs = list(self._rubs(mechanism, friction))
        self.rates = np.array([self._rate(rub) for rub in self.rubs])
        self.base = self._forces(self.without)
        unit = [self._forces(self.solve([*self.load(rub, 1.0)])) for rub in self.rubs]
        self.slopes = np.array([one - self.base for one in unit]).reshape(len(unit), -1, 2)

    def _rubs(self, mechanism: assur.Mechanism, friction: Any) -> Iterator[Rub]:
        for name, one in friction.items():
            if isinstance(one, assur.SlideFriction):
                slide = mechanism.slides[name]
                yield Rub(name, slide.link, slide.on, one)
                continue
            fast, *others = (link for link, joints in mechanism.links.items() if name in joints)
            for link in others:
                yield Rub(name, link, fast, one)

    def solve(self, loads: Sequence[Any]) -> Reactions:
        mechanism = self.plain.mechanism
        assert mechanism is not None
        machine = assur.Machine(
            mechanism, bodies=self.plain.bodies, loads=[*self.plain.loads, *loads]
        )
        return Reactions(machine, *self.where)

    def load(self, rub: Rub, size: float) -> Iterator[Any]:
        """Friction as loads: a torque, or forces along the guide at the sliding point."""
        if not rub.is_slide:
            yield assur.Torque(rub.link, size, on=rub.other)
            return
        places = self.without.places
        force = size * places.guide[rub.name]
        for link, push in ((rub.link, force), (rub.other, -force)):
            at = places.sliding[rub.name]
            if link != GROUND:
                at = (at - places.reference[link]) * places.frame[link].conjugate()
            yield assur.Force((link, (at.real, at.imag)), (push.real, push.imag))

    def loads(self, friction: Any) -> list[Any]:
        return [
            load
            for rub, size in zip(self.rubs, friction, strict=True)
            for load in self.load(rub, float(size))
        ]

    def _rate(self, rub: Rub) -> float:
        found, places = self.without, self.without.places
        if not rub.is_slide:
            return float(found.spin[rub.link] - found.spin[rub.other])
        point = places.sliding[rub.name]

        def velocity(link: str) -> Any:
            return found.velocity[link] + 1j * found.spin[link] * (point - places.reference[link])

        return float(dot(places.guide[rub.name], velocity(rub.link) - velocity(rub.other)))

    def _forces(self, found: Reactions) -> Any:
        """Of each pair the numbers that its friction depends on."""
        rows = []
        for rub in self.rubs:
            if rub.is_slide:
                rows.append((found.normal(rub.name), found.moment(rub.name)))
            else:
                force = found.joint(rub.name, rub.link)
                rows.append((force.real, force.imag))
        return np.array(rows).reshape(-1, 2)

    def sizes(self, forces: Any) -> Any:
        """The size of each friction, for forces (..., pairs, 2)."""
        out = np.empty(forces.shape[:-1])
        for k, rub in enumerate(self.rubs):
            x, y = forces[..., k, 0], forces[..., k, 1]
            if rub.is_slide:
                out[..., k] = rub.friction.coefficient * np.maximum(
                    abs(x), 2 * abs(y) / rub.friction.length
                )
            else:
                out[..., k] = rub.friction.coefficient * rub.friction.radius * np.hypot(x, y)
        return out

    def missed(self, friction: Any) -> Any:
        """By how much frictions (..., pairs) miss the law."""
        forces = self.base + np.einsum("...j,jkd->...kd", friction, self.slopes)
        return friction + np.sign(self.rates) * self.sizes(forces)

    def search(self, rng: Any, starts: int, steps: int = 40) -> list[Any]:
        """Frictions that Newton's iteration with differences finds from many starts."""
        n = len(self.rubs)
        scale = self.sizes(self.base).max()
        wide = scale * 10.0 ** rng.uniform(-1.0, 4.0, (starts, 1))
        friction = wide * rng.uniform(-1.0, 1.0, (starts, n))
        for _ in range(steps):
            missed = self.missed(friction)
            h = 1e-7 * (abs(friction).max(axis=-1, keepdims=True) + scale)
            moved = friction[:, None, :] + h[:, :, None] * np.eye(n)
            slope = (self.missed(moved) - missed[:, None, :]) / h[:, :, None]
            slope = np.swapaxes(slope, 1, 2)
            regular = abs(np.linalg.det(slope)) > 1e-300
            slope[~regular] = np.eye(n)
            friction = friction - np.linalg.solve(slope, missed[..., None])[..., 0]
            friction[~np.isfinite(friction).all(axis=-1)] = 0.0
        size = abs(friction).max(axis=-1) + scale
        good = abs(self.missed(friction)).max(axis=-1) <= 1e-9 * size
        found: list[Any] = []
        for one in friction[good & (size < 1e8 * scale)]:
            if not any(abs(one - other).max() <= 1e-5 * abs(other).max() for other in found):
                found.append(one)
        return found
