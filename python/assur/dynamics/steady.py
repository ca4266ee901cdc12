"""Periodic motions of machines, as they come out of `Machine.steady_state`."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from assur import _core
from assur._arrays import real_array
from assur.dynamics.run import Run
from assur.errors import InputError
from assur.flywheel import Extremum

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur.dynamics.run import State
    from assur.kinematics.mechanism import Mechanism

__all__ = ["SteadyState"]


# What the events of a period are.
EXTREME = "extreme speed"


class SteadyState:
    """A machine in periodic motion.

    Made by `Machine.steady_state` and, with a motor, by `Machine.flywheel`.

    Attributes
    ----------
    run : Run
        One period, along the coordinate.
    q, speed : ndarray
        Coordinate and speed between its steps, rad and rad/s.
    period : float
        Time of a period, s.
    greatest, least : Extremum
        The extreme speeds (without their sign) and where they are.
    mean_speed : float
        By the definition chosen, rad/s; the speed asked for, where neither motor nor loads set one.
    delta : float
        Coefficient of speed fluctuation: (greatest − least) / `mean_speed`.
    multiplier : float
        What a small change of the energy at the beginning of a period has become at its end (the
        one entry of the monodromy matrix that is not 1): below 1 the motion is stable, the more
        quickly it is reached the smaller it is; 1 where nothing depends on the speed.
    energy : float
        Work of the motor in a period, J.
    power : float
        Its mean power, W.
    motor_moment : float
        Its mean moment on the driver, N·m.
    found_moment : float
        Constant moment that was found for the speed asked for; 0 where the motor told the speed.
    inertia : float
        Moment of inertia of the flywheel that was added, kg·m².
    """

    def __init__(
        self,
        core: _core.Run,
        numbers: list[float],
        mechanism: Mechanism | None,
        mean: Literal["extremes", "period"],
    ) -> None:
        self._init_args = core, numbers, mechanism, mean
        self.run = Run(core, mechanism, 1, [EXTREME], along_q=True)
        multiplier, found, work, inertia, least_at, least, greatest_at, greatest = numbers
        self.q, self.speed = self.run.q, self.run.speed
        self.period = float(self.run.t[-1] - self.run.t[0])
        self.greatest, self.least = Extremum(greatest_at, greatest), Extremum(least_at, least)
        span = abs(float(self.q[-1] - self.q[0]))
        self.mean = mean
        self.mean_speed = span / self.period if mean == "period" else 0.5 * (least + greatest)
        self.delta = (greatest - least) / self.mean_speed
        self.multiplier, self.found_moment, self.inertia = multiplier, found, inertia
        self.energy, self.power = work, work / self.period
        self.motor_moment = work / math.copysign(span, float(self.q[-1] - self.q[0]))

    def __reduce__(self) -> tuple[Any, ...]:
        core, *others = self._init_args
        return _rebuild, (core.to_bytes(), *others)

    def __repr__(self) -> str:
        flywheel = f", flywheel {self.inertia:.6g} kg·m²" if self.inertia else ""
        return (
            f"<assur.SteadyState mean {self.mean_speed:.6g} rad/s, δ = {self.delta:.4g}, "
            f"{self.power:.6g} W{flywheel}>"
        )

    def at(self, q: npt.ArrayLike) -> State:
        """Return time, speed and acceleration at coordinates, any number of periods on.

        Parameters
        ----------
        q : array_like
            Coordinates, rad.

        Returns
        -------
        State
            t (0 where the period begins), q, speed and acceleration, of the shape of q.
        """
        x = real_array(q, "q")
        if not np.isfinite(x).all():
            value = float(x[~np.isfinite(x)].flat[0])
            message = f"q has {value}: finite numbers are needed"
            raise InputError(message, value=value)
        first, last = float(self.q[0]), float(self.q[-1])
        low, high = min(first, last), max(first, last)
        # The remainder of a division is exact, whatever the size of q.
        rest = np.remainder(x - first, last - first)
        is_here = (x >= low) & (x <= high)
        whole = np.where(is_here, 0.0, np.round((x - first - rest) / (last - first)))
        state = self.run.at(q=np.where(is_here, x, np.clip(first + rest, low, high)))
        return state._replace(t=state.t + whole * self.period, q=x[()])

    def plot(self, ax: Any = None) -> Any:
        """Draw the speed over the coordinate.

        Parameters
        ----------
        ax : matplotlib axes, optional
            Where; new ones by default.

        Returns
        -------
        matplotlib axes
        """
        from assur.plot import steady_picture

        return steady_picture(self, ax)


def _rebuild(core: bytes, *others: Any) -> SteadyState:
    return SteadyState(_core.Run.from_bytes(core), *others)
