"""A motion is the same in all units: its numbers to the bit where new units are powers of 2."""

from __future__ import annotations

import math
import random
from typing import Any, NamedTuple

import numpy as np
import pytest

import assur
from assur import (
    Body,
    Damper,
    Force,
    Gravity,
    JointFriction,
    LinearMotor,
    Machine,
    SlideFriction,
    Spring,
    Table,
    Torque,
    TorsionDamper,
    TorsionSpring,
    events,
)
from models.machines.machine_models import machine_case
from models.machines.machines import cylinder, five_bar, four_bar
from models.machines.units import Units, differences
from models.mechanisms.higher_drawings import triad_press

TURN = math.tau
BODIES = {
    "crank": Body(mass=3.0, inertia=0.4, at=(0.3, 0.2)),
    "coupler": Body(mass=2.0, inertia=0.5, at=(1.1, 0.4)),
    "rocker": Body(mass=4.0, inertia=0.6, at=(0.7, -0.3)),
}
LOADS: list[Any] = [
    Gravity(),
    Spring("P", ("ground", (2.0, 4.5)), 40.0, 0.8, preload=3.0),
    # At C, of the coupler: there is friction, which depends on whose it is.
    Damper(("coupler", (math.hypot(3.0, 1.3), 0.0)), ("ground", (3.0, 1.0)), 0.7),
    TorsionSpring("rocker", 20.0, angle=0.3, on="coupler"),
    TorsionDamper("coupler", 0.4),
    Force("P", (Table([0.0, 1.0, 2.5, 4.0, TURN], [0.0, 9.0, -7.0, 3.0, 0.0]), 2.0)),
    Torque("crank", lambda t, q, v: 3.0 * t - q + 0.1 * v),
]
PINS = {
    "B": JointFriction(0.1, 0.06, viscous=0.02),
    "C": JointFriction(0.2, 0.05),
    "D": JointFriction(0.1, 0.1),
}


class Case(NamedTuple):
    machine: Machine
    q0: Any
    speed0: Any
    options: dict[str, Any]


def block(*loads: Any, **friction: float) -> Machine:
    """A block on a level guide. Its length is the only one of the machine."""
    way = assur.Mechanism(
        joints={"O": (0, 0), "B": (0.5, 0), "C": (0.7, 0)},
        links={"ground": "O", "block": "BC"},
        slides={"way": assur.Slide("block", "ground", angle=0.0, origin="O")},
        driver="way",
    )
    own = {"way": SlideFriction(**friction)}
    return Machine(way, bodies={"block": Body(mass=2.0)}, loads=[Gravity(), *loads], friction=own)


def crank_press(*loads: Any, **parts: Any) -> Machine:
    bodies = {
        "crank": Body(inertia=0.2),
        "rod": Body(mass=1.2, inertia=0.015, at=(0.12, 0.0)),
        "piston": Body(mass=2.0),
    }
    return Machine(assur.SliderCrank(0.1, 0.35), bodies=bodies, loads=[Gravity(), *loads], **parts)


def cases() -> dict[str, Case]:
    rubbing = {
        "A": JointFriction(0.1, 0.025, viscous=0.01),
        "B": JointFriction(0.08, 0.012),
        "bore": SlideFriction(0.1, 0.06, viscous=0.3),
    }
    motor = LinearMotor(30.0, 200.0, ratio=8.0, rotor_inertia=0.01)
    cut = Force("B", (-300.0, 0.0), on="piston", while_="backward", over="bore")
    wall = events.Obstacle(events.Position(2.0, direction="rising"), 0.6)
    push = Force("B", (lambda t, _q, _v: 10.0 * t, 0.0), on="block")
    spring = Spring("O", "B", 800.0, 0.4)
    dead = assur.FourBar(3.0, 2.5, 2.0, 4.0)
    bars = {name: Body(mass=1.0, inertia=0.5) for name in ("crank", "coupler", "rocker")}
    light = {"C": JointFriction(0.1, 0.1)}
    five = Machine(
        five_bar(),
        bodies={n: Body(mass=1.0, inertia=0.3, at=(0.4, 0.1)) for n in ("c1", "b1", "b2", "c2")},
    )
    ram = Machine(
        cylinder(),
        bodies={
            "arm": Body(mass=3.0, inertia=0.5, at=(0.8, 0.1)),
            "rod": Body(mass=0.5, inertia=0.1),
            "barrel": Body(mass=1.0, inertia=0.2),
        },
        loads=[Gravity(), Damper("P", ("ground", (2.0, 0.0)), 3.0)],
        friction={"B": JointFriction(0.1, 0.03), "ram": SlideFriction(0.1, 0.2, viscous=2.0)},
    )
    mixed = assur.Mechanism(
        joints={"A": (0, 0), "B": (1, 0.4), "C": (2.2, 1.5), "E": (3, 0)},
        links={"ground": "A", "c1": "AB", "b1": "BC", "b2": "CE", "s": "E"},
        slides={"way": assur.Slide("s", on="ground", angle=0.1, origin="A")},
        driver=["c1", "way"],
    )
    triad = triad_press()
    heavy = {
        name: Body(mass=1.0, inertia=0.2)
        for name, own in triad.links.items()
        if name != "ground" and own
    }
    pins = {name: JointFriction(0.1, 0.03) for name in list(triad.joints)[1:4]}
    return {
        "loads": Case(Machine(four_bar(), bodies=BODIES, loads=LOADS), 0.3, 5.0, {"t_end": 2.0}),
        "loads and friction": Case(
            Machine(four_bar(), bodies=BODIES, loads=LOADS, friction=PINS), 0.3, 5.0, {"t_end": 2.0}
        ),
        "from rest at zero": Case(
            Machine(four_bar(), bodies=BODIES, loads=LOADS), 0.0, 0.0, {"t_end": 1.0}
        ),
        "over the coordinate": Case(
            Machine(four_bar(), bodies=BODIES, loads=LOADS, friction=PINS), 0.3, 5.0, {"q_end": 9.0}
        ),
        "motor": Case(
            crank_press(motor=motor, friction=rubbing), 0.3, 0.0, {"t_end": 2.0, "rtol": 1e-8}
        ),
        "one way": Case(
            crank_press(cut, friction=rubbing), 0.3, 40.0, {"t_end": 0.6, "max_step": 0.05}
        ),
        "obstacle": Case(
            crank_press(Torque("crank", 6.0), friction=rubbing),
            0.3,
            0.0,
            {"t_end": 3.0, "events": [wall, events.Speed(1.5, stop=False)]},
        ),
        "angle": Case(
            Machine(four_bar(), bodies=BODIES, loads=LOADS),
            0.3,
            5.0,
            {"t_end": 1.0, "events": [events.TransmissionAngle("C", 0.9, stop=False)]},
        ),
        "it sticks": Case(block(spring, coefficient=0.3, length=0.1), 0.55, 0.0, {"t_end": 2.0}),
        "it slips": Case(
            block(push, coefficient=0.3, length=0.1, static_coefficient=0.5),
            0.5,
            0.0,
            {"t_end": 2.0},
        ),
        "dead point": Case(
            Machine(dead, bodies=bars, loads=[Torque("crank", -20.0)], friction=light),
            0.5,
            1.0,
            {"t_end": 5.0},
        ),
        "dead point of a slide": Case(ram, ram.mechanism.q0, 0.5, {"t_end": 20.0}),  # type: ignore[union-attr]
        "over a driven slide": Case(
            Machine(
                cylinder(),
                bodies={"arm": Body(mass=3.0, inertia=0.5, at=(0.8, 0.1))},
                loads=[Gravity()],
            ),
            ram.mechanism.q0,  # type: ignore[union-attr]
            5.0,
            {"q_end": ram.mechanism.q0 + 0.2},  # type: ignore[union-attr]
        ),
        "slide and angle": Case(
            Machine(
                mixed,
                bodies={n: Body(mass=1.0, inertia=0.3, at=(0.4, 0.1)) for n in ("c1", "b1", "b2")},
            ),
            mixed.q0,
            [0.6, 0.01],
            {"t_end": 0.5},
        ),
        "two drivers": Case(five, five.mechanism.q0, [0.6, -0.6], {"t_end": 0.9}),  # type: ignore[union-attr]
        "two drivers to a dead point": Case(
            five,
            five.mechanism.q0,  # type: ignore[union-attr]
            [0.6, -0.6],
            {"t_end": 20.0, "rtol": 1e-8},
        ),
        "at rest in balance": Case(
            crank_press(Torque("crank", lambda t, _q, _v: 5.0 * t**3)), 0.0, 0.0, {"t_end": 1.0}
        ),
        "class III": Case(
            Machine(triad, bodies=heavy, loads=[Gravity()], friction=pins),
            triad.q0,
            2.0,
            {"t_end": 0.5},
        ),
    }


CASES = cases()


@pytest.mark.parametrize("name", CASES)
def test_powers_of_two_change_no_bit(name: str) -> None:
    machine, q0, speed0, options = CASES[name]
    given = Units().run(machine, q0, speed0, **options)
    own = Units().numbers(given)
    assert given.end != "stalled"
    for units in (
        Units(time=2.0),
        Units(time=2.0**-20),
        Units(time=2.0**20),
        Units(length=2.0),
        Units(length=2.0**-20),
        Units(length=2.0**20, mass=2.0**8),
        Units(length=2.0**-9, time=2.0**-13),
    ):
        other = units.numbers(units.run(machine, q0, speed0, **options))
        assert differences(own, other) == [], units


@pytest.mark.parametrize("name", CASES)
def test_other_units_change_rounding_alone(name: str) -> None:
    machine, q0, speed0, options = CASES[name]
    given = Units().run(machine, q0, speed0, **options)
    own = Units().numbers(given)
    for units in (Units(time=1e-4, length=1e-3), Units(time=60.0, length=0.0254, mass=0.4536)):
        run = units.run(machine, q0, speed0, **options)
        other = units.numbers(run)
        assert run.end == given.end
        assert (
            abs(run.statistics.steps - given.statistics.steps) <= 2 + 0.05 * given.statistics.steps
        )
        for what in ("t", "q", "speed"):
            size = np.abs(own[what]).max()
            assert np.abs(own[what][-1] - other[what][-1]).max() <= 1e-7 * size, what


@pytest.mark.filterwarnings("ignore::assur.AssurWarning")
@pytest.mark.parametrize("seed", range(12))
def test_random_machines_in_other_units(seed: int) -> None:
    case, rng = machine_case(seed), random.Random(f"units {seed}")
    machine = case.machine
    mechanism = machine.mechanism
    assert mechanism is not None
    options: dict[str, Any] = {"t_end": case.t_end, "max_steps": 2000}
    own = Units().numbers(Units().run(machine, mechanism.q0, case.speed0, **options))
    for units in (
        Units(time=2.0 ** rng.randint(-20, 20)),
        # Even powers of the mass alone: the factor of a mass matrix has their roots.
        Units(2.0 ** rng.randint(-20, 20), 2.0 ** rng.randint(-20, 20), 4.0 ** rng.randint(-5, 5)),
    ):
        other = units.numbers(units.run(machine, mechanism.q0, case.speed0, **options))
        assert differences(own, other) == [], units


@pytest.mark.parametrize("length", [0.55, 0.7, 1.3, 1.9])
def test_a_bouncing_block_comes_to_rest_after_as_many_hits_in_all_units(length: float) -> None:
    """Where it stays is a number of tolerances, which belong to the greatest length."""
    way = assur.Mechanism(
        joints={"O": (0, 0), "B": (0, 2.0), "C": (0.7, 2.0)},
        links={"ground": "O", "block": "BC"},
        slides={"way": assur.Slide("block", "ground", angle=math.pi / 2, origin="O")},
        driver="way",
    )
    machine = Machine(way, bodies={"block": Body(mass=3.0)}, loads=[Gravity()])
    floor = events.Obstacle(events.Position(0.0, direction="falling"), 0.95)
    hits = [
        len(units.run(machine, 2.0, 0.0, t_end=99.0, rtol=1e-6, events=[floor]).events)
        for units in (Units(), Units(length=length))
    ]
    assert hits[0] == hits[1]
