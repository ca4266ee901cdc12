"""Random machines for reactions: a body on every link, loads of all kinds, and where to ask.

Mechanisms of dyads and of higher groups with slides, cylinders and one or two drivers.  Every
centre of mass lies off the joints, every link without joints has a moment of inertia alone.
"""

from __future__ import annotations

import random
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from models.machines.machine_models import CONDITION, KINDS, Parts
from models.mechanisms import dyad_models, higher_models, mixed_models, redundant_models
from models.mechanisms.mechanism_data import GROUND, Description, arguments

if TYPE_CHECKING:
    from assur import Machine, Mechanism

SPEED, ACCELERATION = (0.5, 3.0), (-10.0, 10.0)
STEP = 0.3  # from the drawing to the second position, rad or m
POSITIONS = 2
SOURCES = {
    "dyads": (0.35, dyad_models.random_case),
    "mixed": (0.45, mixed_models.mixed_case),
    "higher": (0.2, higher_models.higher_case),
}


@dataclass(frozen=True)
class Case:
    """A machine, and where and how fast it is asked for its reactions."""

    description: Description
    machine: Machine
    q: Any  # (N,) or (N, n)
    speed: Any
    acceleration: Any
    seed: int

    @property
    def mechanism(self) -> Mechanism:
        assert self.machine.mechanism is not None
        return self.machine.mechanism

    def position(self, k: int) -> tuple[Any, Any, Any]:
        return self.q[k], self.speed[k], self.acceleration[k]


def reaction_case(seed: int) -> Case:
    """The machine of this seed."""
    rng = random.Random(f"reactions {seed}")
    weights = [weight for weight, _ in SOURCES.values()]
    while True:
        source = rng.choices([source for _, source in SOURCES.values()], weights)[0]
        case = drawn(source(rng.randrange(10**6)).description, rng, seed)
        if case is not None:
            return case


def redundant_reaction_case(seed: int) -> Case:
    """A machine with redundant links, its drawing as exact as float64."""
    rng = random.Random(f"redundant reactions {seed}")
    while True:
        case = drawn(redundant_models.redundant_case(rng.randrange(10**6)).exact, rng, seed)
        if case is not None:
            return case


def drawn(description: Description, rng: random.Random, seed: int) -> Case | None:
    """The machine of a drawing; None near dead points, which the campaigns check."""
    try:
        m = assur.Mechanism(**arguments(description))
    except assur.AssurError:
        return None
    q0 = np.atleast_1d(m.q0)
    steps = np.array([[rng.uniform(-STEP, STEP) for _ in q0] for _ in range(40)])
    steps[0] = 0.0
    q = q0 + steps if q0.size > 1 else (q0 + steps)[:, 0]
    motion = m.solve(q, order=1, on_error="nan")
    good = (motion.status == int(assur.Status.OK)) & (motion.condition < CONDITION)
    if not good[0] or good.sum() < POSITIONS:
        return None
    chosen = q[good][:POSITIONS]
    shape = chosen.shape
    sign = np.array([rng.choice((-1.0, 1.0)) for _ in range(chosen.size)])
    speed = sign * np.array([rng.uniform(*SPEED) for _ in sign])
    acceleration = np.array([rng.uniform(*ACCELERATION) for _ in sign])
    parts = Everywhere(rng, description)
    machine = assur.Machine(
        m,
        bodies=parts.bodies(),
        loads=[assur.Gravity((rng.uniform(-10, 10), rng.uniform(-10, 10))), *parts.loads()],
    )
    return Case(
        description, machine, chosen, speed.reshape(shape), acceleration.reshape(shape), seed
    )


class Everywhere(Parts):
    """A body on every link and a load of every kind."""

    def bodies(self) -> dict[str, assur.Body]:
        return {n: self.body(n) for n in self.description.links if n != GROUND}

    def body(self, link: str) -> assur.Body:
        rng = self.rng
        inertia = rng.uniform(0.05, 1.0)
        if not self.description.links[link]:
            return assur.Body(inertia=inertia)
        return assur.Body(
            mass=rng.uniform(0.2, 3.0), inertia=inertia, at=(rng.uniform(-1, 1), rng.uniform(-1, 1))
        )

    def loads(self) -> list[Any]:
        kinds = [*KINDS, *self.rng.choices(KINDS, k=self.rng.randint(0, 3))]
        return [getattr(self, kind.replace(" ", "_"))() for kind in kinds]
