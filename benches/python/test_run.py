"""Twenty turns of P3's press to an error of 1e-9, beside numba and SciPy; and of a mechanism."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from press_table import (
    DELTA,
    INERTIA,
    MEAN,
    MOMENT,
    PHI,
    TURNS,
    coefficients,
    dop853,
    rk4,
)
from scipy.integrate import solve_ivp

import assur
from assur import flywheel

if TYPE_CHECKING:
    from pytest_benchmark.fixture import BenchmarkFixture

EVENED = flywheel.from_table(PHI, MOMENT, INERTIA, DELTA, MEAN)
TIME = TURNS * EVENED.period
MACHINE = assur.Machine.from_table(
    PHI, MOMENT, INERTIA + EVENED.inertia, assur.ConstantTorque(EVENED.motor_moment)
)
# Relative errors of speed and time (angle) after twenty turns: the motion is periodic.
ERROR = 1e-9


@pytest.mark.benchmark(group="20 turns of a table to 1e-9")
def test_assur_over_the_angle(benchmark: BenchmarkFixture) -> None:
    end = 2 * np.pi * TURNS
    run = benchmark(MACHINE.run, q_end=end, q0=0.0, speed0=EVENED.speed0, rtol=3e-10)
    assert abs(run.speed[-1] / EVENED.speed0 - 1.0) < ERROR
    assert abs(run.t[-1] / TIME - 1.0) < ERROR


@pytest.mark.benchmark(group="20 turns of a table to 1e-9")
def test_assur_over_the_time(benchmark: BenchmarkFixture) -> None:
    run = benchmark(MACHINE.run, TIME, q0=0.0, speed0=EVENED.speed0, rtol=1e-10)
    assert abs(run.speed[-1] / EVENED.speed0 - 1.0) < ERROR
    assert abs(run.q[-1] / (2 * np.pi * TURNS) - 1.0) < ERROR


@pytest.mark.benchmark(group="20 turns of a table to 1e-9")
def test_numba_rk4_from_knot_to_knot(benchmark: BenchmarkFixture) -> None:
    moment, inertia = coefficients(MOMENT), coefficients(INERTIA)
    arguments = (moment, inertia, EVENED.motor_moment, EVENED.inertia, EVENED.speed0)
    rk4(*arguments)
    speed, time = benchmark(rk4, *arguments)
    assert abs(speed / EVENED.speed0 - 1.0) < ERROR
    assert abs(time / TIME - 1.0) < ERROR


@pytest.mark.benchmark(group="20 turns of a table to 1e-9")
def test_scipy_dop853(benchmark: BenchmarkFixture) -> None:
    arguments = (EVENED.motor_moment, EVENED.inertia, EVENED.speed0, TIME)
    angle, speed = benchmark.pedantic(dop853, arguments, rounds=3)
    # Its steps do not know of the knots.
    benchmark.extra_info["error"] = abs(speed / EVENED.speed0 - 1.0)
    print(f"\nSciPy: speed {abs(speed / EVENED.speed0 - 1.0):.1e}, ", end="")
    print(f"angle {abs(angle / (2 * np.pi * TURNS) - 1.0):.1e}")


CRANK, ROD, WHEEL, PISTON, FORCE = 0.1, 0.4, 0.5, 20.0, 300.0


@pytest.mark.benchmark(group="20 s of a slider-crank at rtol 1e-10")
def test_assur_mechanism(benchmark: BenchmarkFixture) -> None:
    machine = assur.Machine(
        assur.SliderCrank(CRANK, ROD),
        {"crank": assur.Body(inertia=WHEEL), "piston": assur.Body(PISTON)},
        [assur.Force("B", (-FORCE, 0.0))],
    )
    run = benchmark(machine.run, 20.0, q0=0.0, speed0=20.0, rtol=1e-10)
    assert run.energy.error < 1e-8


@pytest.mark.benchmark(group="20 s of a slider-crank at rtol 1e-10")
def test_scipy_by_its_own_formulas(benchmark: BenchmarkFixture) -> None:
    def motion(_: float, y: Any) -> list[float]:
        c, s = np.cos(y[0]), np.sin(y[0])
        root = np.sqrt(ROD**2 - (CRANK * s) ** 2)
        first = -CRANK * s - CRANK**2 * s * c / root
        second = -CRANK * c - CRANK**2 * (c * c - s * s) / root - CRANK**4 * (s * c) ** 2 / root**3
        inertia = WHEEL + PISTON * first**2
        return [y[1], float((-FORCE * first - PISTON * first * second * y[1] ** 2) / inertia)]

    def whole() -> Any:
        return solve_ivp(motion, (0.0, 20.0), [0.0, 20.0], "DOP853", rtol=1e-10, atol=1e-10)

    benchmark.pedantic(whole, rounds=3)
