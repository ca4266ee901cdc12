"""The steps of `stepping` in a loop over environments, in parallel: the same formulas, compiled."""

from __future__ import annotations

import inspect
import math
from typing import TYPE_CHECKING, Any

import numba
import numpy as np

from rivals import stepping

if TYPE_CHECKING:
    from collections.abc import Callable

    from subject import Float


def _compiled(function: Callable[..., Any]) -> Any:
    """A function of `stepping` with the module of numbers in it: numba takes no modules."""
    source = inspect.getsource(function).replace("module: Any, ", "").replace("module.", "math.")
    names: dict[str, Any] = {**vars(stepping), "math": math}
    exec(compile(source, inspect.getfile(function), "exec"), names)
    return numba.njit(fastmath=True, error_model="numpy")(names[function.__name__])


_slider_crank = _compiled(stepping.slider_crank)
_five_bar = _compiled(stepping.five_bar)


@numba.njit(parallel=True, fastmath=True, error_model="numpy")
def slider_crank(q: Float, speed: Float, dt: float, count: int) -> tuple[Float, Float]:
    """Steps without an effort."""
    after_q, after_speed = np.empty_like(q), np.empty_like(q)
    for i in numba.prange(q.size):
        x, v = q[i], speed[i]
        for _ in range(count):
            a1 = _slider_crank(x, v, 0.0)
            v2 = v + 0.5 * dt * a1
            a2 = _slider_crank(x + 0.5 * dt * v, v2, 0.0)
            v3 = v + 0.5 * dt * a2
            a3 = _slider_crank(x + 0.5 * dt * v2, v3, 0.0)
            v4 = v + dt * a3
            a4 = _slider_crank(x + dt * v3, v4, 0.0)
            x += dt / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4)
            v += dt / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4)
        after_q[i], after_speed[i] = x, v
    return after_q, after_speed


@numba.njit(parallel=True, fastmath=True, error_model="numpy")
def five_bar(q: Float, speed: Float, dt: float, count: int) -> tuple[Float, Float]:
    """Steps without efforts; arrays (2, environments)."""
    after_q, after_speed = np.empty_like(q), np.empty_like(q)
    half = 0.5 * dt
    none = (0.0, 0.0)
    for i in numba.prange(q.shape[1]):
        x, y, v, w = q[0, i], q[1, i], speed[0, i], speed[1, i]
        for _ in range(count):
            a1, b1 = _five_bar((x, y), (v, w), none)
            v2, w2 = v + half * a1, w + half * b1
            a2, b2 = _five_bar((x + half * v, y + half * w), (v2, w2), none)
            v3, w3 = v + half * a2, w + half * b2
            a3, b3 = _five_bar((x + half * v2, y + half * w2), (v3, w3), none)
            v4, w4 = v + dt * a3, w + dt * b3
            a4, b4 = _five_bar((x + dt * v3, y + dt * w3), (v4, w4), none)
            x += dt / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4)
            y += dt / 6.0 * (w + 2.0 * w2 + 2.0 * w3 + w4)
            v += dt / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4)
            w += dt / 6.0 * (b1 + 2.0 * b2 + 2.0 * b3 + b4)
        after_q[0, i], after_q[1, i] = x, y
        after_speed[0, i], after_speed[1, i] = v, w
    return after_q, after_speed


def by_numba(two: bool, q: Float, speed: Float, dt: float, count: int) -> tuple[Float, Float]:
    """Steps without efforts."""
    found: tuple[Float, Float] = (five_bar if two else slider_crank)(q, speed, dt, count)
    return found


@numba.njit(parallel=True, fastmath=True, error_model="numpy")
def accelerations(q: Float, speed: Float, effort: Float) -> Float:
    """Of the five-bar; arrays (2, states)."""
    found = np.empty_like(q)
    for i in numba.prange(q.shape[1]):
        found[0, i], found[1, i] = _five_bar(
            (q[0, i], q[1, i]), (speed[0, i], speed[1, i]), (effort[0, i], effort[1, i])
        )
    return found
