"""Random machines: bodies, loads and motors at random points of random mechanisms."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from models.machines import every_load
from models.mechanisms import dyad_models, mixed_models
from models.mechanisms.mechanism_data import GROUND, Description, arguments

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur import Machine
    from assur.flywheel import Spline

T_END = (0.1, 0.6)
SPEED = (0.5, 3.0)
KINDS = ("force", "torque", "spring", "torsion spring", "damper", "torsion damper")
# Pressures need a slide; test_pressures.py has them.
DRAWN = tuple(kind.__name__ for kind in every_load.KINDS if kind is not assur.Pressure)
SPLINES: tuple[Spline, ...] = ("not-a-knot", "natural", "clamped", "periodic", "linear")
# The greatest condition at the drawing: a run that begins beside a dead point is soon over.
CONDITION = 200.0
CARRIED = 0.6  # of the links have a body
WITH_MOTOR = 0.5


@dataclass(frozen=True)
class Case:
    """A machine and the run to be made with it."""

    description: Description
    machine: Machine
    speed0: Any
    t_end: float
    seed: int


def machine_case(seed: int) -> Case:
    """The machine of this seed."""
    rng = random.Random(f"machine {seed}")
    source = dyad_models.random_case if rng.random() < 0.4 else mixed_models.mixed_case
    while True:
        description = source(rng.randrange(10**6)).description
        try:
            m = assur.Mechanism(**arguments(description))
        except assur.AssurError:  # a singular drawing, which the campaign of mechanisms checks
            continue
        if m.solve(m.q0, order=1, on_error="nan").condition < CONDITION:
            break
    parts = Parts(rng, description)
    drivers = len(description.drivers)
    motors = [parts.motor() if rng.random() < WITH_MOTOR else None for k in range(drivers)]
    machine = assur.Machine(
        m,
        bodies=parts.bodies(),
        loads=[assur.Gravity((rng.uniform(-10, 10), rng.uniform(-10, 10))), *parts.loads()],
        motor=motors if any(motors) else None,
    )
    speeds = [rng.choice((-1, 1)) * rng.uniform(*SPEED) for _ in range(drivers)]
    speed0 = speeds[0] if drivers == 1 else np.array(speeds)
    return Case(description, machine, speed0, rng.uniform(*T_END), seed)


class Parts:
    """Bodies and loads of a machine."""

    def __init__(self, rng: random.Random, description: Description) -> None:
        self.rng, self.description = rng, description
        self.links = [n for n, own in description.links.items() if own]
        self.drivers = len(description.drivers)

    # -- bodies -------------------------------------------------------------------------------

    def bodies(self) -> dict[str, assur.Body]:
        """Some links have one; every driver moves one at least."""
        rng = self.rng
        moving = [n for n in self.description.links if n != GROUND]
        slides = self.description.slides
        carried = {n for n in moving if rng.random() < CARRIED}
        for kind, name, *other in self.description.drivers:
            both = (name, *other) if kind == "angle" else (slides[name].link, slides[name].on)
            carried |= {n for n in both if n != GROUND}
        return {n: self.body(n) for n in moving if n in carried}

    def body(self, link: str) -> assur.Body:
        rng, own = self.rng, self.description.links[link]
        inertia = rng.uniform(0.05, 1.0)
        if not own:
            return assur.Body(inertia=inertia)
        at = rng.choice((None, rng.choice(own), (rng.uniform(-1, 1), rng.uniform(-1, 1))))
        return assur.Body(mass=rng.uniform(0.2, 3.0), inertia=inertia, at=at)

    # -- loads --------------------------------------------------------------------------------

    def loads(self) -> list[Any]:
        """Two to six of any kinds."""
        kinds = self.rng.choices(KINDS, k=self.rng.randint(2, 6))
        return [getattr(self, kind.replace(" ", "_"))() for kind in kinds]

    def place(self) -> Any:
        """A joint, or a point in the frame of a link or of the ground."""
        rng = self.rng
        if rng.random() < 0.4:
            return rng.choice(list(self.description.joints))
        link = GROUND if rng.random() < 0.25 else rng.choice(self.links)
        return link, (rng.uniform(-2, 2), rng.uniform(-2, 2))

    def two_links(self) -> tuple[str, str]:
        first, second = self.rng.sample(list(self.description.links), 2)
        return first, second

    def force(self) -> assur.Force:
        axes = self.rng.choice((None, self.rng.choice(self.links)))
        return assur.Force(self.place(), (self.value(20.0), self.value(20.0)), axes=axes)

    def torque(self) -> assur.Torque:
        link, on = self.two_links()
        return assur.Torque(link, self.value(20.0), on=on)

    def two_places(self) -> tuple[Any, Any]:
        first, second = self.place(), self.place()
        while first == second:
            second = self.place()
        return first, second

    def spring(self) -> assur.Spring:
        rng = self.rng
        stiffness, length, preload = rng.uniform(1, 50), rng.uniform(0, 2), rng.uniform(-5, 5)
        return assur.Spring(*self.two_places(), stiffness, length, preload=preload)

    def torsion_spring(self) -> assur.TorsionSpring:
        rng, (link, on) = self.rng, self.two_links()
        angle, preload = rng.uniform(-3, 3), rng.uniform(-5, 5)
        return assur.TorsionSpring(link, rng.uniform(1, 30), angle=angle, on=on, preload=preload)

    def damper(self) -> assur.Damper:
        return assur.Damper(*self.two_places(), self.rng.uniform(0.1, 5.0))

    def torsion_damper(self) -> assur.TorsionDamper:
        link, on = self.two_links()
        return assur.TorsionDamper(link, self.rng.uniform(0.1, 5.0), on=on)

    # -- values -------------------------------------------------------------------------------

    def value(self, size: float) -> Any:
        """A number, a table over the first driver, or a function of (t, q, speed)."""
        kind = self.rng.choice(("number", "table", "function"))
        if kind == "number":
            return self.rng.uniform(-size, size)
        return self.table(size) if kind == "table" else self.function(size)

    def table(self, size: float) -> assur.Table:
        """Over a turn, a part of one or several; or not periodic, over the range of a run."""
        rng = self.rng
        periodic = rng.random() < 0.7
        widths = np.array([rng.uniform(0.3, 1.2) for _ in range(rng.randint(5, 9))])
        span = math.tau * rng.choice((1 / 3, 1 / 2, 1, 1, 2)) if periodic else 30.0
        start = rng.uniform(-3, 3) if periodic else -15.0
        knots = np.append(start, start + np.cumsum(widths) * span / widths.sum())
        knots[-1] = start + span
        values = np.array([rng.uniform(-size, size) for _ in knots])
        if periodic:
            values[-1] = values[0]
        kinds: Sequence[Spline] = SPLINES
        if not periodic:
            kinds = [kind for kind in SPLINES if kind != "periodic"]
        return assur.Table(knots, values, spline=rng.choice(kinds), periodic=periodic)

    def function(self, size: float) -> Any:
        a, b, c = (self.rng.uniform(-size, size) / 3 for _ in range(3))
        w = self.rng.uniform(1, 10)
        if self.drivers > 1:
            return lambda t, q, v: a * math.sin(w * t) + b * math.cos(q[0] - q[1]) - c * v[1] / 5
        return lambda t, q, v: a * math.sin(w * t) + b * math.cos(q) - c * v / 5

    def motor(self) -> Any:
        rng = self.rng
        ratio = rng.choice((-1, 1)) * rng.uniform(0.5, 5.0)
        kind = rng.choice(("constant", "linear", "induction", "table"))
        if kind == "constant":
            return assur.ConstantTorque(
                self.motor_torque(), ratio=ratio, rotor_inertia=rng.uniform(0, 0.1)
            )
        if kind == "linear":
            stall, no_load = rng.uniform(1, 10), rng.uniform(5, 30)
            return assur.LinearMotor(stall, no_load, ratio=ratio, rotor_inertia=rng.uniform(0, 0.1))
        if kind == "induction":
            breakdown, slip = rng.uniform(1, 10), rng.uniform(0.1, 0.4)
            return assur.InductionMotor(breakdown, slip, rng.uniform(20, 60), ratio=ratio)
        speeds = np.linspace(-500.0, 500.0, rng.randint(6, 12))
        torques = [rng.uniform(-10, 10) for _ in speeds]
        return assur.Table(speeds, torques, spline="not-a-knot", ratio=ratio, rotor_inertia=0.02)

    def motor_torque(self) -> Any:
        a, w = self.rng.uniform(-10, 10), self.rng.uniform(1, 10)
        return self.rng.choice((a, self.table(10.0), lambda t, _q, _v: a * math.cos(w * t)))
