"""`Machine.linearize`: the state equations beside a state, in continuous time or for steps."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from assur._arrays import real_array, real_number
from assur._summary import summary
from assur._validate import whole_number
from assur.description.words import Status, has_analogues
from assur.dynamics.equations.derivatives import refuse_functions
from assur.dynamics.equations.step import MOST_STEPS
from assur.dynamics.equations.terms import Direction, State, require_equations, terms_of
from assur.errors import InputError

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur._arrays import Float
    from assur.dynamics.model import MachineModel, OnError

__all__ = ["Linearized"]


class Linearized(NamedTuple):
    """A machine beside states: d(δx)/dt = A δx + B δu, or δx after steps = A δx + B δu.

    The state x is the n coordinates of the drivers, then their speeds; u is their n efforts.

    Attributes
    ----------
    A : numpy.ndarray
        S + (N, 2n, 2n).
    B : numpy.ndarray
        S + (N, 2n, n).
    status : numpy.ndarray of uint8
        `Status` of each state; NaN where it has no derivatives.

    Examples
    --------
    >>> import assur
    >>> arm = assur.Mechanism({"O": (0, 0), "A": (1, 0)}, {"ground": "O", "arm": "OA"}, "arm")
    >>> pendulum = assur.Machine(
    ...     arm, bodies={"arm": assur.Body(mass=2.0, at="A")}, loads=[assur.Gravity()]
    ... )
    >>> upright = pendulum.linearize(deg=90.0)
    >>> upright.A.round(3)
    array([[0.  , 1.  ],
           [9.81, 0.  ]])
    """

    A: Float
    B: Float
    status: npt.NDArray[np.uint8]

    def __repr__(self) -> str:
        return summary(self)


class _Slope(NamedTuple):
    """Accelerations, (rows, n), and their derivatives by states, (rows, n, 2n), and efforts."""

    acceleration: Float
    by_state: Float
    by_effort: Float
    status: npt.NDArray[np.uint8]


def linearize(
    machine: MachineModel,
    state: State,
    steps: tuple[float | None, int],
    on_error: OnError,
    threads: int | None,
) -> Linearized:
    """See `Machine.linearize`."""
    require_equations(machine, "linearize")
    refuse_functions(machine, "linearize")
    dt, count = steps[0], whole_number(steps[1], "n", 1, MOST_STEPS)
    n = machine.driver_count
    asked = terms_of(machine, state, [("acceleration", 0)], threads)
    if on_error == "raise" and asked.failure is not None:
        raise asked.failure
    if dt is None:
        if count != 1:
            message = f"linearize: n = {count} steps need dt, the time of a step, s"
            raise InputError(message)
        slope = _slope(machine, state, threads)
        a, b, status = *_first_order(slope, n), slope.status
    else:
        seconds = real_number(dt, "dt")
        if seconds == 0.0:
            message = "dt is 0: a time is needed, s"
            raise InputError(message, value=seconds)
        # Steps that are far too long end beyond all numbers.
        with np.errstate(over="ignore", invalid="ignore"):
            a, b, status = _of_steps(machine, state, asked.shape, (seconds, count), threads)
    missing = ~np.isfinite(a).all(axis=(1, 2))
    if on_error == "raise" and (missing & has_analogues(status)).any():
        row = int(np.flatnonzero(missing)[0])
        message = f"linearize: state {row} has no acceleration, or none that is differentiable"
        raise InputError(message)
    a[missing], b[missing] = np.nan, np.nan
    status = np.where(missing & has_analogues(status), np.uint8(Status.NO_VALUE), status)
    return Linearized(
        a.reshape(*asked.shape, 2 * n, 2 * n),
        b.reshape(*asked.shape, 2 * n, n),
        status.reshape(asked.shape)[()],
    )


def _slope(machine: MachineModel, state: State, threads: int | None) -> _Slope:
    n = machine.driver_count
    ways = ("q", "speed", "effort")
    by: list[Direction] = [(way, driver) for way in ways for driver in range(n)]
    term = [("acceleration", 0)]
    values = terms_of(machine, state, term, threads)
    found = terms_of(machine, state, term, threads, by)
    rows = found.status.size
    each = found.arrays[0].reshape(rows, n, 3 * n)
    return _Slope(
        values.arrays[0].reshape(rows, n), each[..., : 2 * n], each[..., 2 * n :], found.status
    )


def _first_order(slope: _Slope, n: int) -> tuple[Float, Float]:
    """Return the matrices of the state equations: speeds are the rates of coordinates."""
    rows = len(slope.status)
    a, b = np.zeros((rows, 2 * n, 2 * n)), np.zeros((rows, 2 * n, n))
    a[:, :n, n:] = np.eye(n)
    a[:, n:], b[:, n:] = slope.by_state, slope.by_effort
    return a, b


def _of_steps(
    machine: MachineModel,
    state: State,
    shape: tuple[int, ...],
    steps: tuple[float, int],
    threads: int | None,
) -> tuple[Float, Float, npt.NDArray[np.uint8]]:
    """Return the derivatives of steps: each stage of the Runge-Kutta method differentiated."""
    (dt, count), n = steps, machine.driver_count
    full = shape if n == 1 else (*shape, n)
    q, speed = (
        np.broadcast_to(real_array(values, name), full).reshape(-1, n).copy()
        for values, name in ((state.q, "q"), (state.speed, "speed"))
    )
    rows = len(q)
    whole_a, whole_b = np.tile(np.eye(2 * n), (rows, 1, 1)), np.zeros((rows, 2 * n, n))
    worst = np.zeros(rows, np.uint8)
    for _ in range(count):
        sum_x, sum_a, sum_b = (
            np.zeros((rows, 2 * n)),
            np.zeros(whole_a.shape),
            np.zeros(whole_b.shape),
        )
        x = np.concatenate([q, speed], axis=1)
        here = x
        by_x, by_u = np.tile(np.eye(2 * n), (rows, 1, 1)), np.zeros(whole_b.shape)
        # Way to the next stage, and the weight of this one (W. Kutta 1901).
        for way, weight in ((0.5, 1.0), (0.5, 2.0), (1.0, 2.0), (0.0, 1.0)):
            # A state that has no next stage is not finite: it has no derivatives, the others go on.
            at = state._replace(
                q=here[:, :n].reshape(full), speed=here[:, n:].reshape(full), is_checked=False
            )
            slope = _slope(machine, at, threads)
            # Of failures the first, which causes the others.
            worst = np.where(has_analogues(worst), np.maximum(worst, slope.status), worst)
            a, b = _first_order(slope, n)
            rates = np.concatenate([here[:, n:], slope.acceleration], axis=1)
            d_x, d_u = _product(a, by_x), _product(a, by_u) + b
            sum_x += weight * rates
            sum_a += weight * d_x
            sum_b += weight * d_u
            here = x + way * dt * rates
            by_x, by_u = np.eye(2 * n) + way * dt * d_x, way * dt * d_u
        x = x + dt / 6.0 * sum_x
        step_a, step_b = np.eye(2 * n) + dt / 6.0 * sum_a, dt / 6.0 * sum_b
        whole_b = _product(step_a, whole_b) + step_b
        whole_a = _product(step_a, whole_a)
        q, speed = x[:, :n], x[:, n:]
    return whole_a, whole_b, worst


def _product(a: Float, b: Float) -> Float:
    """Multiply small matrices; the same bits on every machine."""
    product: Float = (a[..., :, :, np.newaxis] * b[..., np.newaxis, :, :]).sum(axis=-2)
    return product
