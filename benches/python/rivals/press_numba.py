"""P3's press as a user of numba would write it: splines by coefficients, loops by hand."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numba import njit
from scipy.interpolate import CubicSpline

from rivals.press_table import DELTA, INERTIA, MEAN, MOMENT, PHI

if TYPE_CHECKING:
    from assur.flywheel import Flywheel

WIDTH = float(PHI[1])
# Steps of the fourth order between two knots, enough for an error below 1e-9.
STEPS = 24
# Places of a turn among which extremes are looked for.
GRID = 181


def coefficients(values: Any) -> Any:
    """Rows of the not-a-knot spline, highest power first."""
    return np.ascontiguousarray(CubicSpline(PHI, values).c.T)


def flywheel() -> float:
    """Inertia of the flywheel."""
    return float(sized(coefficients(MOMENT), coefficients(INERTIA), DELTA, MEAN)[0])


def run(evened: Flywheel, turns: int) -> Any:
    """Speed and time after some turns."""
    moment, inertia = coefficients(MOMENT), coefficients(INERTIA)
    return rk4(moment, inertia, evened.motor_moment, evened.inertia, evened.speed0, turns)


@njit(cache=True)
def horner(row: Any, x: float) -> float:
    return float(((row[0] * x + row[1]) * x + row[2]) * x + row[3])


@njit(cache=True)
def rates(moment: Any, inertia: Any, motor: float, wheel: float, x: float, w: float) -> Any:
    """d(ω²)/dφ and dt/dφ in a piece."""
    slope = (3.0 * inertia[0] * x + 2.0 * inertia[1]) * x + inertia[2]
    change = 2.0 * (horner(moment, x) + motor) - slope * w
    return change / (horner(inertia, x) + wheel), 1.0 / math.sqrt(w)


@njit(cache=True)
def rk4(moment: Any, inertia: Any, motor: float, wheel: float, speed0: float, turns: int) -> Any:
    """Speed and time after some turns, over φ from knot to knot."""
    w, t, h = speed0 * speed0, 0.0, WIDTH / STEPS
    for _ in range(turns):
        for piece in range(moment.shape[0]):
            m, i = moment[piece], inertia[piece]
            for step in range(STEPS):
                x = step * h
                a, p = rates(m, i, motor, wheel, x, w)
                b, q = rates(m, i, motor, wheel, x + h / 2, w + h / 2 * a)
                c, r = rates(m, i, motor, wheel, x + h / 2, w + h / 2 * b)
                d, s = rates(m, i, motor, wheel, x + h, w + h * c)
                w += h / 6 * (a + 2 * b + 2 * c + d)
                t += h / 6 * (p + 2 * q + 2 * r + s)
    return math.sqrt(w), t


@njit(cache=True)
def extremes(moment: Any, inertia: Any, motor: float, wheel: float, speed0: float) -> Any:
    """Least and greatest speed: the best of a grid, then a parabola through its neighbours."""
    pieces = moment.shape[0]
    ends = np.zeros(pieces + 1)
    for k in range(pieces):
        c = moment[k]
        area = (((c[0] / 4 * WIDTH + c[1] / 3) * WIDTH + c[2] / 2) * WIDTH + c[3]) * WIDTH
        ends[k + 1] = ends[k] + area + motor * WIDTH
    start = (inertia[0, 3] + wheel) * speed0 * speed0
    h = 2 * np.pi / (GRID - 1)
    values = np.empty(GRID)
    for g in range(GRID):
        phi = g * h
        k = min(int(phi / WIDTH), pieces - 1)
        x, c = phi - k * WIDTH, moment[k]
        area = (((c[0] / 4 * x + c[1] / 3) * x + c[2] / 2) * x + c[3]) * x + motor * x
        values[g] = math.sqrt((2 * (ends[k] + area) + start) / (horner(inertia[k], x) + wheel))
    speeds = np.empty(2)
    for which in range(2):
        g = values.argmin() if which == 0 else values.argmax()
        a, b, c = (
            values[g - 1 if g > 0 else GRID - 2],
            values[g],
            values[g + 1 if g < GRID - 1 else 1],
        )
        speeds[which] = b - (c - a) ** 2 / (8 * (a - 2 * b + c))
    return speeds


@njit(cache=True)
def sized(moment: Any, inertia: Any, delta: float, mean: float) -> Any:
    """Flywheel and speed at the beginning, by Newton's steps with differences."""
    motor = 0.0
    for k in range(moment.shape[0]):
        c = moment[k]
        motor -= (((c[0] / 4 * WIDTH + c[1] / 3) * WIDTH + c[2] / 2) * WIDTH + c[3]) * WIDTH
    motor /= 2 * np.pi
    x, y = 20.0, mean
    low, high = mean * (1 - delta / 2), mean * (1 + delta / 2)
    for _ in range(30):
        a = extremes(moment, inertia, motor, x, y)
        b = extremes(moment, inertia, motor, x * (1 + 1e-6), y)
        c = extremes(moment, inertia, motor, x, y * (1 + 1e-6))
        f, g = a[0] - low, a[1] - high
        fx, gx = (b[0] - a[0]) / (x * 1e-6), (b[1] - a[1]) / (x * 1e-6)
        fy, gy = (c[0] - a[0]) / (y * 1e-6), (c[1] - a[1]) / (y * 1e-6)
        d = fx * gy - fy * gx
        dx, dy = (fy * g - gy * f) / d, (gx * f - fx * g) / d
        x, y = x + dx, y + dy
        if abs(dx) < 1e-10 * x and abs(dy) < 1e-10 * y:
            break
    return x, y
