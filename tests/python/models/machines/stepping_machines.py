"""Machines whose environments step in time: one, two or three drivers, with loads and without."""

from __future__ import annotations

from typing import Any

import assur


def five_bar() -> assur.Machine:
    mechanism = assur.examples.five_bar()
    bodies = {
        name: assur.Body(mass=1.0 + 0.2 * i, inertia=0.03, at=(0.1, 0.05 * i))
        for i, name in enumerate(name for name in mechanism.links if name != "ground")
    }
    loads: list[Any] = [assur.Gravity(), assur.Damper("P", "A", 0.5)]
    return assur.Machine(mechanism, bodies=bodies, loads=loads)


def engine(**parts: Any) -> assur.Machine:
    bodies = {
        "crank": assur.Body(inertia=0.5),
        "rod": assur.Body(mass=4.0, inertia=0.05, at=(0.2, 0.01)),
        "piston": assur.Body(mass=20.0),
    }
    return assur.Machine(assur.SliderCrank(0.1, 0.4), **({"bodies": bodies} | parts))


def flywheel() -> assur.Machine:
    """The crank alone has inertia: its steps read no point and no angle but the coordinate."""
    bodies = {"crank": assur.Body(inertia=0.5)}
    motor = assur.LinearMotor(stall=5.0, no_load=15.0)
    return engine(bodies=bodies, motor=motor)


def pulled() -> assur.Machine:
    """Links with loads have no mass, and links with mass have no loads."""
    bodies = {"crank": assur.Body(mass=1.5, inertia=0.1, at=(0.05, 0.02))}
    loads = [
        assur.Gravity(),
        assur.Force("B", (-30.0, 0.0)),
        assur.Torque("rod", 2.0),
        assur.TorsionSpring("rod", 4.0, on="crank"),
        assur.Damper("B", "A", 3.0),
    ]
    return engine(bodies=bodies, loads=loads)


def arm() -> assur.Machine:
    """Three drivers."""
    mechanism = assur.Mechanism(
        joints={"O": (0, 0), "A": (0.5, 0), "B": (0.9, 0.1), "C": (1.2, 0.0)},
        links={"ground": "O", "upper": "OA", "fore": "AB", "hand": "BC"},
        driver=[
            "upper",
            assur.Drive("fore", relative_to="upper"),
            assur.Drive("hand", relative_to="fore"),
        ],
    )
    bodies = {
        "upper": assur.Body(mass=2.0, inertia=0.1, at=(0.2, 0.03)),
        "fore": assur.Body(mass=1.0, inertia=0.05, at=(0.1, -0.02)),
        "hand": assur.Body(mass=0.3, inertia=0.01, at="C"),
    }
    return assur.Machine(mechanism, bodies=bodies, loads=[assur.Gravity()])


def pendulum(length: float = 0.5) -> assur.Machine:
    arm = assur.Mechanism(
        joints={"O": (0, 0), "A": (length, 0)},
        links={"ground": "O", "arm": "OA"},
        driver="arm",
    )
    body = assur.Body(mass=2.0, at=(length, 0.0))
    return assur.Machine(arm, bodies={"arm": body}, loads=[assur.Gravity()])


def dead_ends() -> assur.Machine:
    rocker = assur.Body(mass=1.0, inertia=0.1)
    return assur.Machine(assur.FourBar(3.0, 2.5, 2.0, 4.0), bodies={"rocker": rocker})
