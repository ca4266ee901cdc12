"""Mechanisms and machines that several tests share."""

from __future__ import annotations

import math
from typing import Any

import assur
from assur import Body, Force, Gravity

TURN = math.tau


def four_bar() -> assur.Mechanism:
    return assur.Mechanism(
        joints={"A": (0, 0), "B": (0.4, 0.9), "C": (3.4, 2.2), "D": (4.1, 0.1), "P": (1.6, 2.9)},
        links={"ground": "AD", "crank": "AB", "coupler": "BCP", "rocker": "DC"},
        driver="crank",
    )


def five_bar() -> assur.Mechanism:
    return assur.Mechanism(
        joints={"A": (0, 0), "B": (1, 0.4), "C": (2.2, 1.5), "D": (3.6, 0.9), "E": (3, 0)},
        links={"ground": "AE", "c1": "AB", "b1": "BC", "b2": "CD", "c2": "ED"},
        driver=["c1", "c2"],
    )


def cylinder() -> assur.Mechanism:
    """A rocker lifted by a slide: the coordinate is a length."""
    return assur.Mechanism(
        joints={"A": (0, 0), "B": (1.1, 0.9), "P": (2.0, 1.2), "R": (0.9, 0.0)},
        links={"ground": "AR", "arm": "ABP", "rod": "B", "barrel": "R"},
        slides={"ram": assur.Slide("rod", on="barrel", angle=1.351, origin="R")},
        driver="ram",
    )


def pendulum() -> assur.Machine:
    """A crank of a parallel four-bar with all of the mass in it: a mathematical pendulum of 1 m."""
    m = assur.FourBar(1.0, 4.0, 3.0, 3.5)
    return assur.Machine(m, bodies={"crank": Body(mass=2.0, at="B")}, loads=[Gravity((-1.0, 0.0))])


def press(motor: Any = None, **more: Any) -> assur.Machine:
    work = assur.Table([0.0, 3.5, 5.0, TURN], [0.0, 0.0, -1500.0, 0.0], spline="linear")
    return assur.Machine(
        assur.SliderCrank(0.1, 0.4),
        bodies={
            "crank": Body(inertia=0.5),
            "rod": Body(mass=5.0, inertia=0.1, at=(0.15, 0.0)),
            "piston": Body(mass=20.0),
        },
        loads=[assur.Gravity(), Force("B", (work, 0.0)), *more.get("loads", [])],
        motor=motor,
    )


def wheel(*loads: Any, inertia: float = 2.0) -> assur.Machine:
    """A crank with an inertia; nothing else has mass."""
    return assur.Machine(
        assur.SliderCrank(0.1, 0.4), bodies={"crank": Body(inertia=inertia)}, loads=loads
    )
