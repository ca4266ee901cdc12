"""Random machines of which a part moves as one body with the crank, with friction in its pairs.

Dyads hang with both ends on links that turn with the crank, so that none of their pairs moves; then
up to two dyads hang anywhere. Of the rates in pairs at rest only rounding is left: more of it where
a dyad is nearly flat.
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import assur
from models.machines.machine_models import Parts
from models.machines.machine_units import with_friction
from models.mechanisms import dyad_models
from models.mechanisms.flat_models import Builder as FlatBuilder
from models.mechanisms.mechanism_data import GROUND, Description, arguments

if TYPE_CHECKING:
    from collections.abc import Iterator

SPEED = (0.5, 3.0)
T_END = 0.1
# Above this condition of the drawing forces themselves are too poorly known.
CONDITION = 1e5


class Builder(FlatBuilder):
    """Dyads on the crank's own body until `free`."""

    free = False

    def two_links(self) -> tuple[str, str]:
        if self.free:
            return super().two_links()
        moving = [n for n in self.links if n != GROUND]
        return self.rng.choice(moving), self.rng.choice(moving)

    def corner(self) -> float:
        self.flat = self.rng.random() < 0.3
        return max(abs(super().corner()), 1e-4) if self.flat else super().corner()


@dataclass(frozen=True)
class Case:
    """A machine, the pairs at rest in it, and a run."""

    description: Description
    machine: assur.Machine
    resting: tuple[tuple[str, str], ...]  # joints with a link, slides with ""
    speed0: float
    t_end: float
    seed: int


def resting_case(seed: int) -> Case:
    """The machine of this seed."""
    rng = random.Random(f"resting {seed}")
    while True:
        builder = Builder(rng)
        builder.driver("crank")
        for _ in range(rng.randint(1, 3)):
            builder.dyad(rng.choice(dyad_models.KINDS))
        body = {n for n in builder.links if n != GROUND}
        builder.free = True
        for _ in range(rng.randint(0, 2)):
            builder.dyad(rng.choice(dyad_models.KINDS))
        d = builder.finish()
        try:
            m = assur.Mechanism(**arguments(d))
        except assur.AssurError:
            continue
        if m.solve(m.q0, order=1, on_error="nan").condition < CONDITION:
            break
    parts = Parts(rng, d)
    loads: list[Any] = [assur.Gravity((rng.uniform(-10, 10), rng.uniform(-10, 10)))]
    for _ in range(rng.randint(1, 3)):
        force = rng.uniform(-100, 100), rng.uniform(-100, 100)
        link = rng.choice([n for n in parts.links if n != GROUND])
        loads.append(assur.Force((link, (rng.uniform(-1, 1), rng.uniform(-1, 1))), force))
    plain = assur.Machine(m, bodies=parts.bodies(), loads=loads)
    machine = with_friction(d, plain, rng)
    speed = rng.choice((-1, 1)) * rng.uniform(*SPEED)
    return Case(d, machine, tuple(_resting(d, machine, body)), speed, T_END, seed)


def _resting(d: Description, machine: assur.Machine, body: set[str]) -> Iterator[tuple[str, str]]:
    """Pairs with friction between links of the one body."""
    for name in machine.friction:
        if name in d.slides:
            if {d.slides[name].link, d.slides[name].on} <= body:
                yield name, ""
        else:
            links = [n for n, own in d.links.items() if name in own]
            if set(links) <= body:
                yield name, links[1]
