"""Random overconstrained mechanisms that move, with the rounded data in which they come.

Parallel cranks on one rod (a locomotive), several rods between two wheels, a crosshead with a shoe
on a guide of its own; then up to two groups.  The drawing is turned by any angle and its numbers
are rounded to 6 to 15 digits, so that the redundant links fit only roughly.
"""

from __future__ import annotations

import cmath
import math
import random
from dataclasses import dataclass, replace

from models.mechanisms import dyad_models
from models.mechanisms.mechanism_data import GROUND, Description
from models.mechanisms.mixed_models import REGULAR, TRIES, Builder
from oracles.kinematics.pair_jacobian import regularity

KINDS = ("locomotive", "rods", "guides")
DIGITS = (6, 15)
FURTHER = (*dyad_models.KINDS, "triad", "quadrilateral")


@dataclass(frozen=True)
class Rounded:
    """An overconstrained mechanism as drawn and as typed in."""

    kind: str
    everywhere: bool  # parallel cranks with nothing hung on them reach every position
    exact: Description
    typed: Description
    digits: int
    seed: int


def redundant_case(seed: int) -> Rounded:
    """The mechanism of this seed."""
    rng = random.Random(f"redundant {seed}")
    kind = KINDS[seed % len(KINDS)]
    for _ in range(TRIES):
        builder = RedundantBuilder(rng)
        getattr(builder, kind)()
        further = [rng.choice(FURTHER) for _ in range(rng.choice((0, 0, 1, 2)))]
        for name in further:
            builder.dyad(name) if name in dyad_models.KINDS else builder.group(name)
        exact = builder.finish()
        if regularity(exact, overconstrained=True) > REGULAR:
            angle, digits = rng.uniform(-math.pi, math.pi), rng.randint(*DIGITS)
            exact = turned(exact, angle)
            everywhere = kind != "guides" and not further
            return Rounded(kind, everywhere, exact, rounded(exact, digits), digits, seed)
    message = f"no overconstrained mechanism for seed {seed}"
    raise ValueError(message)


class RedundantBuilder(Builder):
    """Overconstrained mechanisms on a crank."""

    # Links of which one can be left out: nothing may be attached to them.
    spare: tuple[str, ...] = ()

    def two_links(self) -> tuple[str, str]:
        while True:
            found = super().two_links()
            if not set(found) & set(self.spare):
                return found

    def hosts(self, count: int) -> list[str]:
        while True:
            found = super().hosts(count)
            if not set(found) & set(self.spare):
                return found

    def wheels(self, count: int, pins: int) -> list[list[str]]:
        """Wheels with pins at the same places: the pins' names by wheel. The first drives."""
        pivots = [complex(*self.near())]
        while len(pivots) < count:
            place = complex(*self.near())
            if all(abs(place - other) > 0.5 for other in pivots):
                pivots.append(place)
        places = [cmath.rect(self.leg() / 2, self.angle()) for _ in range(pins)]
        names: list[list[str]] = []
        for pivot in pivots:
            centre = self.joint((pivot.real, pivot.imag), GROUND)
            own = [pivot + place for place in places]
            names.append([self.joint((p.real, p.imag)) for p in own])
            wheel = self.link(centre, *names[-1])
            if len(names) == 1:
                self.drivers.append(("angle", wheel, GROUND))
        return names

    def locomotive(self) -> None:
        """Three or four parallel cranks on one rod."""
        pins = self.wheels(self.rng.choice((3, 3, 4)), 1)
        self.spare = tuple(list(self.links)[2:])  # all but the ground and the driver
        self.link(*(own[0] for own in pins))

    def rods(self) -> None:
        """Two wheels with two or three rods between them."""
        first, second = self.wheels(2, self.rng.choice((2, 2, 3)))
        self.spare = tuple(self.link(a, b) for a, b in zip(first, second, strict=True))

    def guides(self) -> None:
        """A slider-crank whose crosshead has a shoe on a second guide, parallel to the first."""
        self.drive_crank()
        pin = list(self.joints)[-1]
        alpha = self.angle()
        head = self.joint(self.beyond(self.joints[pin], alpha))
        shoe = self.joint(self.beyond(self.joints[head], self.angle()))
        self.link(pin, head)
        along = alpha + math.pi / 2 + self.corner()
        self.slide(self.link(head, shoe), GROUND, along)
        self.spare = (self.link(shoe),)
        self.slide(self.spare[0], GROUND, along + self.rng.choice((0.0, math.pi)))


def turned(description: Description, angle: float) -> Description:
    """The whole drawing turned about the origin."""
    turn = cmath.rect(1.0, angle)
    places = {n: complex(*p) * turn for n, p in description.joints.items()}
    return replace(
        description,
        joints={n: (p.real, p.imag) for n, p in places.items()},
        slides={n: replace(s, angle=s.angle + angle) for n, s in description.slides.items()},
    )


def rounded(description: Description, digits: int) -> Description:
    """Every number to so many significant digits."""

    def short(value: float) -> float:
        return float(f"{value:.{digits - 1}e}")

    return replace(
        description,
        joints={n: (short(x), short(y)) for n, (x, y) in description.joints.items()},
        slides={n: replace(s, angle=short(s.angle)) for n, s in description.slides.items()},
    )
