"""The flywheel of a machine whose own motor sets the speed, from its integrated motion."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import as_number
from assur._extreme import Extreme
from assur.dynamics.reduction.reduce import reduced_inertia, reduced_moment
from assur.flywheel.result import Flywheel

if TYPE_CHECKING:
    from collections.abc import Callable

    from assur._arrays import Float, Number
    from assur.dynamics.model import MachineModel
    from assur.dynamics.motion.steady import SteadyState
    from assur.flywheel.result import Curve

TURN = 2.0 * math.pi
# A coordinate is found when Newton's iteration changes it by less: two ulps of a turn.
COORDINATE_ATOL = 2.0 * float(np.spacing(TURN))
# More than bisection alone needs to halve a turn down to an ulp.
MAX_ITERATIONS = 64


class SteadyFlywheel(Flywheel):
    """A flywheel with the machine's own motor.

    The integrated motion begins at the drawing's coordinate; times and work count from q = 0, as
    with a constant motor.
    """

    def __init__(self, machine: MachineModel, steady: SteadyState) -> None:
        self._machine = machine
        # A turn as the motion counts it, rounded.
        self._width = float(steady.q[-1] - steady.q[0])
        turn = math.copysign(TURN, self._width)
        start = steady.at(0.0)
        self._time0 = float(start.t)
        super().__init__(
            inertia=as_number(steady.inertia),
            speed0=as_number(float(start.speed)),
            motor_moment=as_number(steady.motor_moment),
            extremes=(_in_turn(steady.max, turn), _in_turn(steady.min, turn)),
            period=as_number(steady.period),
            mean=steady.mean,
            turn=(0.0, turn),
            steady=steady,
        )
        self._motion = steady
        self._energy0 = float(self._kinetic_energy(np.zeros(())))

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._machine, self._motion)

    def _problem(self, entry: tuple[int, ...]) -> None:
        """Return None: without a flywheel the machine is refused."""

    def _curve(self, what: Curve, x: Float) -> Number:
        curves: dict[Curve, Callable[[], Float]] = {
            "speed": lambda: self._motion.at(x).speed,
            "time": lambda: self._motion.at(x).t - self._time0,
            "coordinate": lambda: self._coordinate(x),
            "moment": lambda: self._moment(x),
            "inertia": lambda: self._machine_inertia(x),
            "work": lambda: self._kinetic_energy(x) - self._energy0,
        }
        values = np.array(curves[what](), np.float64)
        values.flags.writeable = False
        return as_number(values if x.shape else float(values))

    def _moment(self, q: Float) -> Any:
        return reduced_moment(self._machine, self._remainder(q), self._motion.at(q).speed)

    def _surplus(self, q: Float) -> Any:
        """Return the moment that changes the kinetic energy, of loads and motor."""
        state = self._motion.at(q)
        inertia = reduced_inertia(self._machine, self._remainder(q))
        whole = inertia.value + self.inertia
        return whole * state.acceleration + 0.5 * inertia.d1 * np.square(state.speed)

    def _machine_inertia(self, q: Float) -> Any:
        return reduced_inertia(self._machine, self._remainder(q)).value

    def _kinetic_energy(self, q: Float) -> Any:
        """Return the kinetic energy; it changes by the work of loads and motor."""
        inertia = self._machine_inertia(q) + self.inertia
        return inertia * np.square(self._motion.at(q).speed) / 2.0

    def _remainder(self, q: Float) -> Any:
        """Return the coordinates in the first turn; the remainder is exact however large q is."""
        return np.remainder(q, self._width)

    def _coordinate(self, t: Float) -> Any:
        """Return coordinates at times: Newton's iteration within a step, or bisection."""
        since = t + self._time0
        rest = np.remainder(since, self.period)
        whole = np.round((since - rest) / self.period)
        times, q = self._motion.run.t, self._motion.q
        step = np.clip(np.searchsorted(times, rest, side="right") - 1, 0, len(times) - 2)
        early, late = q[step], q[step + 1]
        part = (rest - times[step]) / (times[step + 1] - times[step])
        x = early + part * (late - early)
        for _ in range(MAX_ITERATIONS):
            state = self._motion.run.at(q=x)
            is_late = state.t > rest
            early, late = np.where(is_late, early, x), np.where(is_late, x, late)
            better = x - (state.t - rest) * state.speed
            is_between = (better - early) * (better - late) <= 0.0
            better = np.where(is_between, better, 0.5 * (early + late))
            change, x = np.abs(better - x), better
            if (change <= COORDINATE_ATOL).all():
                break
        return x + whole * self._width


def _in_turn(extreme: Extreme, turn: float) -> Extreme:
    return Extreme(extreme.value, as_number(float(np.remainder(extreme.q, turn))))
