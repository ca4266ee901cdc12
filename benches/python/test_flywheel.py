"""P3's flywheel from its table beside SciPy and numba as users would write it: one and many."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from press_table import DELTA, INERTIA, MEAN, MOMENT, PHI, coefficients, sized
from scipy.interpolate import CubicSpline
from scipy.optimize import fsolve, minimize_scalar

from assur import flywheel

if TYPE_CHECKING:
    from collections.abc import Callable

    from pytest_benchmark.fixture import BenchmarkFixture

MANY = 100_000


def by_scipy() -> float:
    """Splines, their integral, extremes by minimization around the greatest of a grid."""
    moment, inertia = CubicSpline(PHI, MOMENT), CubicSpline(PHI, INERTIA)
    work = moment.antiderivative()
    motor = -work(2 * np.pi) / (2 * np.pi)
    grid = np.linspace(0.0, 2 * np.pi, 181)
    excess, mass, first = 2 * (work(grid) + motor * grid), inertia(grid), inertia(0.0)

    def lacks(x: Any) -> list[float]:
        def speed(q: Any, sign: float = 1.0) -> Any:
            energy = 2 * (work(q) + motor * q) + (first + x[0]) * x[1] ** 2
            return sign * np.sqrt(energy / (inertia(q) + x[0]))

        rough = (excess + (first + x[0]) * x[1] ** 2) / (mass + x[0])
        ends = []
        for sign, place in ((-1.0, rough.argmax()), (1.0, rough.argmin())):
            around = grid[max(place - 1, 0)], grid[min(place + 1, 180)]
            found = minimize_scalar(speed, bounds=around, args=(sign,), method="bounded")
            ends.append(sign * found.fun)
        return [ends[0] - MEAN * (1 + DELTA / 2), ends[1] - MEAN * (1 - DELTA / 2)]

    return float(fsolve(lacks, (20.0, MEAN))[0])


def by_assur() -> float:
    return float(flywheel.from_table(PHI, MOMENT, INERTIA, DELTA, MEAN).inertia)


def by_numba() -> float:
    return float(sized(coefficients(MOMENT), coefficients(INERTIA), DELTA, MEAN)[0])


@pytest.mark.benchmark(group="flywheel from a table")
@pytest.mark.parametrize("way", [by_assur, by_numba, by_scipy])
def test_one_table(benchmark: BenchmarkFixture, way: Callable[[], float]) -> None:
    assert abs(benchmark(way) - 19.91815) < 1e-3


@pytest.mark.benchmark(group=f"flywheels from {MANY} tables")
@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("mean", flywheel.MEANS)
def test_many_tables(benchmark: BenchmarkFixture, mean: Any, threads: int) -> None:
    moments = MOMENT * np.random.default_rng(1).uniform(0.9, 1.1, (MANY, 1))
    found = benchmark.pedantic(
        flywheel.from_table,
        (PHI, moments, INERTIA, DELTA, MEAN),
        {"mean": mean, "threads": threads},
        rounds=3,
    )
    assert found.shape == (MANY,)
