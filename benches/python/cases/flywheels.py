"""P3's flywheel from its table of nine rows, and from many such tables."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from assur import flywheel
from rivals import press_table
from rivals.press_table import DELTA, INERTIA, MEAN, MOMENT, PHI
from subject import OURS, Case, Contender, Subject, installed

if TYPE_CHECKING:
    from subject import Float

# SciPy's and numba's steps end when the inertia changes by less than about this, kg·m².
TOLERANCE = 1e-3


def case(quick: bool) -> Case:
    many = 50 if quick else 10_000
    subjects = {"one table": one, f"{many} tables": partial(tables, many)}
    return Case("flywheels", "design", subjects, plotted=False, every_level=False)


def one() -> Subject:
    def answer(inertia: float) -> list[Float]:
        return [np.array([inertia])]

    def run() -> float:
        return float(
            flywheel.from_table(PHI, MOMENT, INERTIA, fluctuation=DELTA, mean_speed=MEAN).inertia
        )

    contenders = {
        OURS: Contender(run, answer),
        "SciPy: splines, minimize_scalar, fsolve": Contender(press_table.by_scipy, answer),
    }
    if installed("numba"):
        from rivals import press_numba

        contenders["numba, Newton with differences"] = Contender(press_numba.flywheel, answer)
    return Subject(1, 1, contenders, tolerance=TOLERANCE)


def tables(count: int) -> Subject:
    moments = MOMENT * np.random.default_rng(1).uniform(0.9, 1.1, (count, 1))

    def run(mean: Any) -> Float:
        return flywheel.from_table(
            PHI, moments, INERTIA, fluctuation=DELTA, mean_speed=MEAN, mean=mean
        ).inertia

    contenders = {
        OURS: Contender(partial(run, "extremes"), lambda inertias: [inertias]),
        f"{OURS}, mean of the period": Contender(partial(run, "period"), None),
    }
    return Subject(count, 1, contenders, count)
