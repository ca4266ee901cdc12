"""Machines with every kind of body, load, motor and friction, for files."""

from __future__ import annotations

import math
from typing import Any

import assur
from assur import Body, Table
from models.machines.machines import TURN, cylinder, five_bar, four_bar

THIRD = 1.0 / 3.0
WORK = Table([0.0, 3.5, 5.0, TURN], [0.0, -0.0, -1500.0 * THIRD, 0.0], spline="linear")
OPEN = Table([-1.0, 0.1, 1e22], [5e-324, THIRD, -0.0], spline="linear", periodic=False)

LOADS: dict[str, Any] = {
    "gravity": assur.Gravity(),
    "gravity along x": assur.Gravity((9.81 * THIRD, -0.0)),
    "force": assur.Force("C", (THIRD, -2.5)),
    "force on": assur.Force("C", (WORK, 0.0), on="rocker"),
    "force at a point": assur.Force(("coupler", (0.1, -THIRD)), (1.0, OPEN), axes="crank"),
    "torque": assur.Torque("rocker", WORK),
    "torque between": assur.Torque("rocker", -THIRD, on="coupler"),
    "spring": assur.Spring("C", "A", 100.0 * THIRD, 0.5),
    "spring of points": assur.Spring(
        ("ground", (1.0, -2.0)), ("coupler", (0.3, THIRD)), 100.0, 0.0, preload=7.0
    ),
    "torsion spring": assur.TorsionSpring("rocker", 3.0, angle=THIRD, on="crank", preload=-1.0),
    "damper": assur.Damper("P", "D", THIRD),
    "torsion damper": assur.TorsionDamper("rocker", THIRD, on="coupler"),
}

IN_PRACTICE: list[Any] = [
    assur.Pressure("ram", 0.01, assur.Gas(2e5 * THIRD, 0.003, 1.0, exponent=1.3), "forward"),
    assur.Pressure("ram", 0.01, assur.Gas(2e5, 0.03, 0.9), "backward", ambient=0.0),
    assur.Pressure("ram", THIRD, Table([0.1, 9.0], [1e5, 2e5], over="ram"), "forward"),
    assur.Pressure("ram", 0.01, 3e5, "forward", while_="backward", over="arm"),
    assur.Force(
        "P",
        (Table([0.1, 0.9, 0.9, 9.0], [1.0, 2.0, -0.0, THIRD], spline="linear", over="ram"), -THIRD),
    ),
    assur.Force("P", (0.0, -9.0), while_="forward", over="ram"),
    assur.Torque(
        "arm",
        Table([-9.0, 9.0, 9.5], [0.0, THIRD, 0.0], spline="linear", over="arm"),
        while_="backward",
    ),
]

MOTORS: dict[str, Any] = {
    "constant": assur.ConstantTorque(184.0 * THIRD),
    "constant of a table": assur.ConstantTorque(WORK, ratio=-THIRD, rotor_inertia=0.01),
    "linear": assur.LinearMotor(stall=40.0, no_load=150.0 * THIRD, ratio=10.0),
    "induction": assur.InductionMotor(60.0, 0.15, 157.1, ratio=7.5, rotor_inertia=THIRD),
    "table": Table(
        [0.0, 10.0, 20.0], [5.0, 4.0, -THIRD], spline="clamped", ratio=3.0, rotor_inertia=0.2
    ),
}


def one_part_machines() -> dict[str, assur.Machine]:
    """A machine for each load and motor."""
    m = four_bar()
    made = {
        name: assur.Machine(m, bodies={"rocker": Body(mass=2.0)}, loads=[load])
        for name, load in LOADS.items()
    }
    made |= {
        f"motor, {name}": assur.Machine(m, bodies={"crank": Body(inertia=1.0)}, motor=motor)
        for name, motor in MOTORS.items()
    }
    return made


def whole_machines() -> dict[str, assur.Machine]:
    """Machines with much together, and with nothing."""
    friction: dict[str, Any] = {
        "D": assur.JointFriction(0.1, THIRD),
        "B": assur.JointFriction(0.1, 0.0, viscous=-0.0, static_coefficient=0.2 * THIRD + 0.1),
    }
    bodies = {
        "crank": Body(inertia=-0.0),
        "coupler": Body(mass=THIRD, inertia=0.1, at="P"),
        "rocker": Body(mass=1e22, inertia=5e-324, at=(-0.0, THIRD)),
    }
    m = four_bar()
    guide = assur.SlideFriction(0.1, THIRD, viscous=2.0, static_coefficient=0.1)
    lengths: dict[str, Any] = {"coupler.length": [3.1, 3.2, math.nan], "ground.D.x": 4.0}
    return {
        "nothing": assur.Machine(m),
        "everything": assur.Machine(
            m,
            bodies=bodies,
            loads=list(LOADS.values()),
            motor=MOTORS["induction"],
            friction=friction,
        ),
        "cylinder": assur.Machine(
            cylinder(), bodies={"arm": Body(mass=3.0)}, friction={"ram": guide}
        ),
        "in practice": assur.Machine(cylinder(), bodies={"arm": Body(mass=3.0)}, loads=IN_PRACTICE),
        "two motors": assur.Machine(five_bar(), motor=[MOTORS["linear"], MOTORS["table"]]),
        "one motor of two": assur.Machine(five_bar(), motor=[None, MOTORS["constant"]]),
        "designs": assur.Machine(m.with_dimensions(lengths), bodies={"rocker": Body(mass=2.0)}),
    }
