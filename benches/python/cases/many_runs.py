"""Ten thousand motions of 1 s from random states: a slider-crank with three bodies and a motor."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.integrate import solve_ivp

import assur
from rivals import stepping
from subject import OURS, Case, Contender, Subject

if TYPE_CHECKING:
    from collections.abc import Callable

    from subject import Float

STALL, NO_LOAD = 50.0, 15.0
RTOL = 1e-10
# Those of a loop that are timed; its time is scaled.
OF_LOOP, OF_SCIPY = 500, 20


def case(quick: bool) -> Case:
    count, seconds = (40, 0.1) if quick else (10_000, 1.0)
    subjects: dict[str | int, Callable[[], Subject]] = {
        f"{seconds:g} s of a slider-crank": lambda: slider_crank(count, seconds)
    }
    return Case("many_runs", "run", subjects, plotted=False, every_level=False)


def slider_crank(count: int, seconds: float) -> Subject:
    r, rod, wheel, mass, inertia, at, piston = stepping.SLIDER
    bodies = {
        "crank": assur.Body(inertia=wheel),
        "rod": assur.Body(mass=mass, inertia=inertia, at=at),
        "piston": assur.Body(mass=piston),
    }
    machine = assur.Machine(
        assur.SliderCrank(r, rod),
        bodies=bodies,
        loads=[assur.Gravity((stepping.GRAVITY, 0.0))],
        motor=assur.LinearMotor(stall=STALL, no_load=NO_LOAD),
    )
    rng = np.random.default_rng(1)
    q, speed = rng.uniform(0.0, 2.0 * np.pi, count), rng.normal(size=count)

    def looped() -> list[assur.Run]:
        states = zip(q[:OF_LOOP].tolist(), speed[:OF_LOOP].tolist(), strict=True)
        return [machine.run(seconds, *state) for state in states]

    def motion(_: float, y: Any) -> list[float]:
        effort = STALL * (1.0 - y[1] / NO_LOAD)
        return [y[1], float(stepping.slider_crank(np, y[0], y[1], effort))]

    def by_scipy() -> Float:
        ends = []
        for state in zip(q[:OF_SCIPY], speed[:OF_SCIPY], strict=True):
            made: Any = solve_ivp(
                motion, (0.0, seconds), list(state), "DOP853", rtol=RTOL, atol=RTOL
            )
            ends.append(made.y[:, -1])
        return np.array(ends)

    contenders = {
        OURS: Contender(lambda: machine.run(seconds, q, speed), ends_of),
        f"{OURS}, their ends": Contender(
            lambda: machine.run(seconds, q, speed, keep="ends"), ends_of
        ),
        f"{OURS}, a loop": Contender(
            looped,
            lambda runs: [
                np.array([run.q[-1] for run in runs]),
                np.array([run.speed[-1] for run in runs]),
            ],
            designs=min(OF_LOOP, count),
        ),
        "SciPy, DOP853": Contender(
            by_scipy, lambda ends: list(ends.T), designs=min(OF_SCIPY, count)
        ),
    }
    # Both keep 1e-10 a step.
    return Subject(count, 1, contenders, units=count, tolerance=1e-6)


def ends_of(runs: assur.Runs) -> list[Any]:
    return [runs.q_end, runs.speed_end]
