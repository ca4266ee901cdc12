"""What a controller asks: the equations of motion at one state, accelerations at ten thousand."""

from __future__ import annotations

import shutil
from typing import TYPE_CHECKING, Any

import numpy as np

from cases.steps import five_bar_machine
from rivals import stepping
from subject import OURS, Case, Contender, Subject, installed

if TYPE_CHECKING:
    from collections.abc import Callable

# So many calls are timed together: one takes microseconds.
CALLS = 200


def case(quick: bool) -> Case:
    states = 100 if quick else 10_000
    subjects: dict[str | int, Callable[[], Subject]] = {
        "one state": lambda: one_state(3 if quick else CALLS),
        "accelerations": lambda: accelerations(states),
    }
    return Case("control", "call", subjects, plotted=False)


def one_state(calls: int) -> Subject:
    """Mass matrix, its derivatives, bias, gravity and the Jacobian of P."""
    machine, q0 = five_bar_machine()
    q, speed = q0 + np.array([0.1, -0.05]), np.array([0.4, -0.7])

    def ours() -> Any:
        for _ in range(calls):
            now = machine.dynamics(q, speed)
        return [now.mass_matrix, now.d_mass_matrix, now.bias, now.gravity, now.jacobian("P")]

    contenders = {OURS: Contender(ours, list)}
    if installed("casadi") and shutil.which("cc"):
        from rivals.equations_casadi import Buffered, compiled

        function = compiled()
        buffered = Buffered(function)

        def with_arrays() -> Any:
            for _ in range(calls):
                found = [np.asarray(part) for part in function(q, speed)]
            return found

        def with_buffer() -> Any:
            for _ in range(calls):
                found = buffered(q, speed)
            return found

        contenders["CasADi, compiled"] = Contender(with_arrays, _by_rows)
        contenders["CasADi, compiled, its buffers"] = Contender(with_buffer, None)
    return Subject(1, calls, contenders, units=calls)


def _by_rows(found: Any) -> list[Any]:
    """CasADi's columns as our arrays."""
    matrix, rates, bias, gravity, of_point = found
    # Row a + 2 b of the rates is the entry (a, b) of the matrix.
    each = rates.reshape(2, 2, 2).transpose(1, 0, 2)
    return [matrix, each, bias[:, 0], gravity[:, 0], of_point]


def accelerations(states: int) -> Subject:
    """Forward dynamics of many states at once."""
    machine, q0 = five_bar_machine()
    rng = np.random.default_rng(3)
    q = q0 + rng.uniform(-0.3, 0.3, (states, 2))
    speed, effort = rng.normal(size=(2, *q.shape))
    rows = tuple(np.ascontiguousarray(each.T) for each in (q, speed, effort))
    contenders = {
        OURS: Contender(lambda: machine.acceleration(q, speed, effort), lambda found: [found.T])
    }
    if installed("numba"):
        import numba

        from rivals.stepping_numba import accelerations as by_numba

        def on_one_thread() -> np.ndarray:
            threads = numba.get_num_threads()
            numba.set_num_threads(1)
            found = by_numba(*rows)
            numba.set_num_threads(threads)
            return found

        contenders["numba by hand, in parallel"] = Contender(
            lambda: by_numba(*rows), lambda found: [found]
        )
        contenders["numba by hand, one thread"] = Contender(on_one_thread, lambda found: [found])
    contenders["NumPy by hand"] = Contender(
        lambda: stepping.five_bar(np, *rows), lambda found: [np.stack(found)]
    )
    return Subject(states, 1, contenders, units=states)
