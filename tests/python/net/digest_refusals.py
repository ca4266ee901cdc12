"""Refusals: the type of the error and its fields, not its words."""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from assur import Body, Machine, flywheel
from models.errors.refusals import APART, BATCH, MOTION, TWO, M, build
from models.errors.refused_structures import REFUSED
from net.digest_dynamics import (
    LINEAR,
    PAPER_INERTIA,
    PAPER_MOMENT,
    PAPER_PHI,
    answered,
    press,
    table,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

WRONG: Any = "wrong"
ROCKER = assur.FourBar(1.0, 3.0, 3.0, 3.0).with_driver("rocker")
CASES: dict[str, Callable[[], object]] = {
    "length": lambda: M.with_dimensions({"coupler.length": -1.0}),
    "unknown dimension": lambda: M.with_dimensions({"cupler.length": 1.0}),
    "four-bar": lambda: assur.FourBar(1.0, 3.0, 2.5, math.nan),
    "batch": lambda: BATCH.solve(1.0),
    "opens": lambda: APART.solve([0.0, 1.0, math.pi, 4.0]),
    "rocker too far": lambda: ROCKER.solve([2.0, 5.0]),
    "coordinate": lambda: M.solve([1.0, math.nan]),
    "two drivers": lambda: TWO.solve(1.0),
    "two drivers apart": lambda: TWO.solve([3.1, 0.0]),
    "order": lambda: M.solve(1.0, order=4),
    "outputs": lambda: M.solve(1.0, outputs=["C", "Q"]),
    "assembly": lambda: M.solve(1.0, assembly={"X": 1}),
    "no joint": lambda: MOTION.joint("Q"),
    "no link": lambda: MOTION.link("C"),
    "no slide": lambda: MOTION.slide("crank"),
    "design": lambda: BATCH.design(9),
    "driver": lambda: M.with_driver("cranck"),
    "body": lambda: Machine(M, bodies={"cranck": Body(mass=1.0)}),
    "mass": lambda: Body(mass=-1.0),
    "force": lambda: Machine(M, loads=[assur.Force("cranck", (1.0, 0.0))]),
    "spring": lambda: assur.Spring("A", "A", 1.0, 0.5),
    "motor": lambda: Machine(M, motor=WRONG),
    "no inertia": lambda: Machine(M).run(1.0),
    "run without an end": lambda: press(LINEAR).run(),
    "run from nowhere": lambda: Machine(ROCKER, bodies={"rocker": Body(inertia=1.0)}).run(
        1.0, q0=5.0
    ),
    "run outside": lambda: press(LINEAR).run(0.1, q0=0.0).at(5.0),
    "reduced": lambda: Machine(ROCKER, bodies={"rocker": Body(mass=1.0)}).reduced_inertia(
        [2.0, 5.0]
    ),
    "steady over a dead point": lambda: Machine(
        ROCKER, bodies={"rocker": Body(inertia=1.0)}
    ).steady_state(3.0),
    "steady without a speed": lambda: press().steady_state(),
    "overloaded": lambda: press(assur.LinearMotor(5.0, 30.0)).steady_state(),
    "too slow": lambda: press().steady_state(0.1),
    "half a mechanism": lambda: press().flywheel(0.05, mean_speed=-3.0),
    "table": lambda: flywheel.from_table(
        PAPER_PHI[:2], PAPER_MOMENT[:2], PAPER_INERTIA[:2], fluctuation=1, mean_speed=1
    ),
    "falling table": lambda: flywheel.from_table(
        PAPER_PHI[::-1], PAPER_MOMENT, PAPER_INERTIA, fluctuation=0.05, mean_speed=15.0
    ),
    "fluctuation": lambda: flywheel.from_table(
        PAPER_PHI, PAPER_MOMENT, PAPER_INERTIA, fluctuation=3.0, mean_speed=15.0
    ),
    "fluctuations": lambda: flywheel.from_table(
        PAPER_PHI, PAPER_MOMENT, PAPER_INERTIA, fluctuation=np.array([0.05, -1.0]), mean_speed=15.0
    ),
    "table without a motor": lambda: table().steady_state(),
    "crank-rocker": lambda: assur.crank_rocker.run(1, 4.5, 1.5, 4.995, gamma_min=0.2, phi0=0.0),
    "ratio": lambda: assur.slider_crank.greatest_speed(0.5),
}


def not_refused(_: object) -> list[Any]:
    return ["not refused"]


def results() -> Iterator[tuple[str, Any]]:
    for name, ask in CASES.items():
        yield name, answered(ask, not_refused)
    for name, (parts, _, _) in REFUSED.items():
        yield f"structure, {name}", answered(partial(build, **parts), not_refused)
