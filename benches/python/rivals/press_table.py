"""P3's press, and a slider-crank, as users of SciPy would write them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.optimize import fsolve, minimize_scalar

if TYPE_CHECKING:
    from assur.flywheel import Flywheel
    from subject import Float

PHI = np.linspace(0.0, 2 * np.pi, 9)
MOMENT = np.array([-0.23, -274.4, -950.5, 19.9, 1.26, -300.0, -23.9, -15.9, -0.23])
INERTIA = np.array([4.93, 5.07, 5.1, 5.1, 4.93, 5.05, 5.1, 5.14, 4.93])
DELTA, MEAN = 1 / 8, 15.0


def dop853(evened: Flywheel, time: float) -> tuple[float, float]:
    """Angle and speed after a time, over the time."""
    moment, inertia = (CubicSpline(PHI, v) for v in (MOMENT, INERTIA))
    slope = inertia.derivative()

    def motion(_: float, y: Any) -> list[float]:
        phi = y[0] % (2 * np.pi)
        force = moment(phi) + evened.motor_moment - slope(phi) * y[1] ** 2 / 2
        return [y[1], float(force / (inertia(phi) + evened.inertia))]

    start = [0.0, evened.speed0]
    made: Any = solve_ivp(motion, (0.0, time), start, "DOP853", rtol=1e-10, atol=1e-10)
    return float(made.y[0, -1]), float(made.y[1, -1])


def slider_crank(sizes: tuple[float, ...], speed: float, time: float) -> Float:
    """Angle and speed after a time; a slider-crank by its own closed formulas."""
    crank, rod, wheel, piston, push = sizes

    def motion(_: float, y: Any) -> list[float]:
        c, s = np.cos(y[0]), np.sin(y[0])
        root = np.sqrt(rod**2 - (crank * s) ** 2)
        first = -crank * s - crank**2 * s * c / root
        second = -crank * c - crank**2 * (c * c - s * s) / root - crank**4 * (s * c) ** 2 / root**3
        inertia = wheel + piston * first**2
        return [y[1], float((-push * first - piston * first * second * y[1] ** 2) / inertia)]

    made: Any = solve_ivp(motion, (0.0, time), [0.0, speed], "DOP853", rtol=1e-10, atol=1e-10)
    return np.array(made.y[:, -1])


def by_scipy() -> float:
    """Flywheel: splines, their integral, extremes by minimization around the greatest of a grid."""
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
            extreme = minimize_scalar(speed, bounds=around, args=(sign,), method="bounded")
            ends.append(sign * extreme.fun)
        return [ends[0] - MEAN * (1 + DELTA / 2), ends[1] - MEAN * (1 - DELTA / 2)]

    return float(fsolve(lacks, (20.0, MEAN))[0])
