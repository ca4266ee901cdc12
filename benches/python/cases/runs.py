"""Motions in time: twenty turns of P3's press to an error of 1e-9, and 20 s of a slider-crank."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

import assur
from assur import flywheel
from rivals import press_table
from rivals.press_table import DELTA, INERTIA, MEAN, MOMENT, PHI
from subject import OURS, Case, Contender, Subject, installed

if TYPE_CHECKING:
    from collections.abc import Callable

    from subject import Float

# Relative errors of speed and time (angle) at the end: the motion is periodic.
ERROR = 1e-9


def case(quick: bool) -> Case:
    turns, seconds = (1, 0.5) if quick else (20, 20.0)
    subjects: dict[str | int, Callable[[], Subject]] = {
        f"{turns} turns of a press, from a table": lambda: press(turns),
        f"{seconds:g} s of a slider-crank": lambda: slider_crank(seconds),
    }
    return Case("runs", "call", subjects, plotted=False, every_level=False)


def press(turns: int) -> Subject:
    evened = flywheel.from_table(PHI, MOMENT, INERTIA, fluctuation=DELTA, mean_speed=MEAN)
    time, end, speed0 = turns * evened.period, 2 * np.pi * turns, evened.speed0
    motor = assur.ConstantTorque(evened.motor_moment)
    machine = assur.Machine.from_table(PHI, MOMENT, INERTIA + evened.inertia, motor=motor)

    def over_angle() -> assur.Run:
        return machine.run(q_end=end, q0=0.0, speed0=speed0, rtol=3e-10)

    def over_time() -> assur.Run:
        return machine.run(time, q0=0.0, speed0=speed0, rtol=1e-10)

    # Each answer: speed and time, or angle, at the end, of what they are at the beginning.
    contenders = {
        f"{OURS}, over the angle": Contender(
            over_angle, lambda run: [np.array([run.speed[-1] / speed0, run.t[-1] / time])]
        ),
        f"{OURS}, over the time": Contender(
            over_time, lambda run: [np.array([run.speed[-1] / speed0, run.q[-1] / end])]
        ),
    }
    if installed("numba"):
        from rivals import press_numba

        contenders["numba, fixed steps between knots"] = Contender(
            lambda: press_numba.run(evened, turns),
            lambda reached: [np.array([reached[0] / speed0, reached[1] / time])],
        )
    # Its steps do not know of the knots: an error of 1e-6.
    contenders["SciPy, DOP853"] = Contender(lambda: press_table.dop853(evened, time), None)
    return Subject(1, 1, contenders, tolerance=2 * ERROR)


CRANK, ROD, WHEEL, PISTON, FORCE, SPEED = 0.1, 0.4, 0.5, 20.0, 300.0, 20.0


def slider_crank(seconds: float) -> Subject:
    machine = assur.Machine(
        assur.SliderCrank(CRANK, ROD),
        bodies={"crank": assur.Body(inertia=WHEEL), "piston": assur.Body(mass=PISTON)},
        loads=[assur.Force("B", (-FORCE, 0.0))],
    )

    def run() -> assur.Run:
        return machine.run(seconds, q0=0.0, speed0=SPEED, rtol=1e-10)

    def by_scipy() -> Float:
        sizes = CRANK, ROD, WHEEL, PISTON, FORCE
        return press_table.slider_crank(sizes, SPEED, seconds)

    contenders = {
        f"{OURS}, over the time": Contender(
            run, lambda motion: [np.array([motion.q[-1], motion.speed[-1]])]
        ),
        "SciPy, DOP853": Contender(by_scipy, lambda end: [end]),
    }
    # Both keep 1e-10 a step, over some thousand steps.
    return Subject(1, 1, contenders, tolerance=1e-5)
