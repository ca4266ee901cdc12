"""Reductions, runs, steady states and flywheels, of mechanisms and of tables."""

from __future__ import annotations

import math
import random
import warnings
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from assur import events, flywheel
from models.machines import machine_models
from models.mechanisms import dyad_models, mixed_models, named_drawings
from net.digest_kinematics import again, made

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

TURN = math.tau
RANDOM = range(24)
# Bodies and loads of a random machine rest on lengths near one.
T_END, STEPS = 0.3, 300


class Parts(machine_models.Parts):
    """With functions of the four operations alone, whose bits every platform has."""

    def function(self, size: float) -> Any:
        a, b, c = (self.rng.uniform(-size, size) / 3 for _ in range(3))
        if self.drivers > 1:
            return lambda t, q, v: a * t / (1.0 + t * t) + b * (q[0] - q[1]) - c * v[1] / 5.0
        return lambda t, q, v: a * t / (1.0 + t * t) + b / (2.0 + q * q) - c * v / 5.0

    def motor_torque(self) -> Any:
        a = self.rng.uniform(-10, 10)
        return self.rng.choice((a, self.table(10.0), lambda t, _q, _v: a / (1.0 + t * t)))


def random_machine(seed: int) -> tuple[assur.Machine, Any]:
    rng = random.Random(f"digest {seed}")
    source = dyad_models.random_case if seed % 2 else mixed_models.mixed_case
    description = source(seed).description
    parts = Parts(rng, description)
    drivers = len(description.drivers)
    motors = [parts.motor() if rng.random() < 0.5 else None for _ in range(drivers)]
    machine = assur.Machine(
        made(description),
        bodies=parts.bodies(),
        loads=[assur.Gravity((rng.uniform(-10, 10), rng.uniform(-10, 10))), *parts.loads()],
        motor=motors if any(motors) else None,
    )
    speeds = [rng.uniform(0.5, 3.0) for _ in range(drivers)]
    return machine, speeds[0] if drivers == 1 else np.array(speeds)


def of_run(run: Any, over_q: bool = False) -> list[Any]:
    """Steps, balance, dense output, how it ended and what happened."""
    found: list[Any] = [run.t, run.q, run.speed, run.acceleration, run.end]
    found += [run.energy.kinetic, run.energy.potential, run.energy.work]
    along, ask = (run.q, "q") if over_q else (run.t, "t")
    between = along[0] + (along[-1] - along[0]) * np.arange(1, 10) / 10.0
    found += list(run.at(**{ask: between})) if len(run.t) > 1 else []
    found += [list(run.statistics)]
    for event in run.events:
        found += [type(event.event).__name__, event.t, event.q, event.speed]
    return found


def ends(own: Any) -> list[Any]:
    """The greatest and the least speed, and where they are."""
    return [own.max.q, own.max.value, own.min.q, own.min.value]


def of_steady(own: Any) -> list[Any]:
    numbers = [own.period, *ends(own), own.mean_speed, own.delta, own.multiplier]
    numbers += [own.motor_work, own.power, own.motor_moment, own.found_moment, own.inertia]
    return [np.array(numbers), own.q, own.speed, *own.at(np.arange(-3, 9) * 0.9)]


def of_flywheel(own: Any) -> list[Any]:
    numbers = [own.inertia, own.speed0, own.delta, own.mean_speed, *ends(own)]
    numbers += [own.motor_moment, own.period]
    found: list[Any] = [np.array(numbers)]
    if not own.shape:
        phi = np.arange(13) * (TURN / 12.0)
        found += [
            own.speed(phi),
            own.time(phi),
            own.coordinate(own.time(phi)),
            own.reduced_moment(phi),
        ]
        found += [own.work(phi), own.reduced_inertia(phi), *own.energy_mass(points=20)]
    return found


def press(motor: Any = None, *loads: Any) -> assur.Machine:
    work = assur.Table([0.0, 3.5, 5.0, TURN], [0.0, 0.0, -1500.0, 0.0], spline="linear")
    return assur.Machine(
        assur.SliderCrank(0.1, 0.4),
        bodies={
            "crank": assur.Body(inertia=0.5),
            "rod": assur.Body(mass=5.0, inertia=0.1, at=(0.15, 0.0)),
            "piston": assur.Body(mass=20.0),
        },
        loads=[assur.Gravity(), assur.Force("B", (work, 0.0)), *loads],
        motor=motor,
    )


def pumped() -> assur.Machine:
    """A mechanism of class III with bodies."""
    m = again(named_drawings.HIGHER["triad"]())
    bodies = {name: assur.Body(mass=1.0, inertia=0.2) for name in m.links if name != "ground"}
    return assur.Machine(m, bodies=bodies, loads=[assur.Gravity()])


PAPER_PHI = np.arange(9) * (TURN / 8.0)
PAPER_MOMENT = [-0.23, -274.4, -950.5, 19.9, 1.26, -300.0, -23.9, -15.9, -0.23]
PAPER_INERTIA = [4.93, 5.07, 5.1, 5.1, 4.93, 5.05, 5.1, 5.14, 4.93]
LINEAR = assur.LinearMotor(90.0, 30.0)
INDUCTION = assur.InductionMotor(30.0, 0.3, 300.0, ratio=10.0, rotor_inertia=0.05)


def table(spline: Any = "not-a-knot", motor: Any = None) -> assur.Machine:
    return assur.Machine.from_table(
        PAPER_PHI, PAPER_MOMENT, PAPER_INERTIA, motor=motor, spline=spline
    )


def four_bar(loads: Any = ()) -> assur.Machine:
    bodies = {
        "crank": assur.Body(inertia=0.3),
        "rocker": assur.Body(mass=2.0, inertia=2.0, at=(0.5, 0.2)),
    }
    return assur.Machine(assur.FourBar(1.0, 3.0, 3.0, 3.0), bodies=bodies, loads=loads)


def sprung() -> assur.Machine:
    return four_bar([assur.TorsionSpring("crank", 4.0)])


def parallelogram() -> assur.Machine:
    bodies = {"crank": assur.Body(inertia=1.0), "rocker": assur.Body(inertia=2.0)}
    return assur.Machine(assur.FourBar(1.0, 3.0, 1.0, 3.0), bodies=bodies, loads=[assur.Gravity()])


RUNS: dict[str, Callable[[], Any]] = {
    "press": lambda: press(LINEAR).run(2.0, q0=0.0),
    "press by RK45": lambda: press(INDUCTION).run(1.0, q0=0.0, rtol=1e-7, method="RK45"),
    "four-bar": lambda: four_bar().run(10.0, q0=0.0, speed0=2.0),
    "backward": lambda: four_bar().run(-3.0, q0=0.0, speed0=2.0),
    "class III": lambda: pumped().run(1.0, speed0=1.0),
    "table": lambda: table(motor=LINEAR).run(3.0, speed0=10.0),
    "through change points": lambda: parallelogram().run(4.0, q0=1.0, speed0=2.0),
    "dead point": lambda: assur.Machine(
        assur.FourBar(1.0, 3.0, 3.0, 3.0).with_driver("rocker"),
        bodies={"crank": assur.Body(inertia=1.0), "rocker": assur.Body(inertia=1.0)},
    ).run(50.0, q0=2.0, speed0=1.0),
    "near change point": lambda: assur.Machine(
        assur.FourBar(1.0, 3.0, 1.0, 3.0 + 1e-11),
        bodies={"crank": assur.Body(inertia=1.0), "rocker": assur.Body(inertia=1.0)},
    ).run(9.0, q0=1.0, speed0=1.0),
    "events": lambda: press(LINEAR).run(
        3.0,
        q0=0.0,
        events=[
            events.Position(1.0, stop=False),
            events.Speed(12.0, stop=False),
            events.TransmissionAngle("A", 1.4, stop=False),
            events.Crossing(lambda t, _q, v: v - 3.0 - t),
        ],
    ),
}
OVER_Q: dict[str, Callable[[], Any]] = {
    "press": lambda: press(LINEAR).run(q_end=9.0, q0=0.1, speed0=25.0),
    "rest": lambda: sprung().run(q_end=9.0, q0=0.5, speed0=0.5),
}
STEADY: dict[str, Callable[[], Any]] = {
    "linear": lambda: press(LINEAR).steady_state(),
    "induction": lambda: press(INDUCTION).steady_state(mean="period"),
    "by speed": lambda: press().steady_state(11.0),
    "two turns": lambda: table().steady_state(15.0, turns=2, mean="period", flywheel=19.9),
    "with a flywheel": lambda: press(LINEAR).flywheel(0.05).steady,
}
SPLINES: tuple[flywheel.Spline, ...] = ("not-a-knot", "natural", "clamped", "periodic", "linear")


def from_table(spline: flywheel.Spline) -> Any:
    return flywheel.from_table(
        PAPER_PHI, PAPER_MOMENT, PAPER_INERTIA, fluctuation=0.05, mean_speed=15.0, spline=spline
    )


FLYWHEELS: dict[str, Callable[[], Any]] = {
    **{f"from a table, {spline}": partial(from_table, spline) for spline in SPLINES},
    "batch": lambda: flywheel.from_table(
        PAPER_PHI,
        PAPER_MOMENT,
        PAPER_INERTIA,
        fluctuation=np.array([0.02, 0.1, 1e-4]),
        mean_speed=15.0,
        mean="period",
    ),
    "evaluated": lambda: flywheel.evaluate(
        PAPER_PHI, PAPER_MOMENT, PAPER_INERTIA, flywheel=19.918150, mean_speed=15.0, mean="period"
    ),
    "of a machine": lambda: press().flywheel(0.05, mean_speed=15.0),
    "of machines": lambda: assur.Machine(
        assur.SliderCrank(np.array([0.1, 0.12, 5.0]), 0.4),
        bodies={"crank": assur.Body(inertia=0.5), "piston": assur.Body(mass=20.0)},
        loads=[assur.Force("B", (assur.Table([0.0, 3.5, 5.0, TURN], [0.0, 0.0, -9e3, 0.0]), 0.0))],
    ).flywheel(0.05, mean_speed=15.0, on_error="nan"),
}


def answered(ask: Callable[[], Any], write: Callable[[Any], list[Any]]) -> Any:
    """What is computed and said; or which error, with its fields."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            found: Any = write(ask())
        except assur.AssurError as error:
            # What has a name of its own alone is no result.
            kept = [name for name in error.__dict__ if name != "hint" and name[0] != "_"]
            fields = {name: error.__dict__[name] for name in kept}
            found = [type(error).__name__, repr(sorted(fields.items()))]
    return [found, [one.category.__name__ for one in caught]]


def run(machine: assur.Machine, speed: Any) -> Any:
    return machine.run(T_END, speed0=speed, rtol=1e-9, max_steps=STEPS)


def results() -> Iterator[tuple[str, Any]]:
    for seed in RANDOM:
        machine, speed = random_machine(seed)
        assert machine.mechanism is not None
        steps = np.reshape([-0.3, 0.0, 0.2], (3, *[1] * np.ndim(speed)))
        q = np.asarray(machine.mechanism.q0) + steps
        yield (
            f"reduced {seed}",
            [
                *machine.reduced_inertia(q, on_error="nan"),
                machine.reduced_moment(q, np.broadcast_to(speed, q.shape), on_error="nan"),
                machine.potential(q, on_error="nan"),
            ],
        )
        yield f"run {seed}", answered(partial(run, machine, speed), of_run)
    sections: tuple[tuple[str, dict[str, Callable[[], Any]], Any], ...] = (
        ("run", RUNS, of_run),
        ("run over q", OVER_Q, partial(of_run, over_q=True)),
        ("steady", STEADY, of_steady),
        ("flywheel", FLYWHEELS, of_flywheel),
    )
    for section, cases, write in sections:
        for name, ask in cases.items():
            yield f"{section}, {name}", answered(ask, write)
