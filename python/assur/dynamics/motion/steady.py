"""Periodic motions of machines: the results of `Machine.steady_state`."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from assur._arrays import as_number, finite_array, flag
from assur._extreme import Extreme
from assur._other_names import other_names
from assur._table import Column, Tabular
from assur._validate import one_of
from assur.dynamics.motion.run import Run
from assur.kinematics.solve_arguments import q_or_deg

if TYPE_CHECKING:
    import numpy.typing as npt
    from matplotlib.axes import Axes

    from assur import _core
    from assur._records import SteadyNumbers
    from assur.dynamics.motion.run import State
    from assur.kinematics.mechanism import Mechanism

__all__ = ["SteadyState"]


# The events recorded in a period.
EXTREME = "extreme speed"


@other_names(least="it is min", greatest="it is max")
class SteadyState(Tabular):
    """A machine in periodic motion.

    Made by `Machine.steady_state`; a flywheel with the machine's own motor has its motion as
    `steady`.

    Attributes
    ----------
    run : Run
        One period, integrated over the coordinate.
    q, speed : ndarray
        Coordinate and speed at the ends of its steps, rad and rad/s.
    period : float
        Time of a period, s.
    max, min : Extreme
        The extreme speeds (absolute values) and their coordinates.
    mean_speed : float
        Mean speed by the chosen definition, rad/s; the speed passed to `Machine.steady_state` if
        neither motor nor loads set one.
    delta : float
        Coefficient of speed fluctuation: (greatest − least) / `mean_speed`.
    multiplier : float
        Floquet multiplier: factor by which a perturbation of the energy changes each period;
        stable below 1, and reached the faster the smaller it is; 1 if nothing depends on the speed.
    motor_work : float
        Work of the motor in a period, J.
    power : float
        Mean power of the motor, W.
    motor_moment : float
        Mean moment of the motor on the driver, N·m.
    found_moment : float
        Constant moment added to keep the required speed, N·m; 0 if the motor sets the speed.
    inertia : float
        Moment of inertia of the flywheel added, kg·m².

    Examples
    --------
    >>> import assur
    >>> driven = assur.Machine(
    ...     assur.SliderCrank(0.1, 0.4),
    ...     bodies={"piston": assur.Body(mass=20.0), "crank": assur.Body(inertia=0.5)},
    ...     loads=[assur.Torque("crank", -20.0)],
    ...     motor=assur.LinearMotor(stall=50.0, no_load=15.0),
    ... )
    >>> steady = driven.steady_state()
    >>> print(f"{steady.mean_speed:.4f} rad/s, δ = {steady.delta:.4f}, {steady.period:.4f} s")
    9.0317 rad/s, δ = 0.1743, 0.7006 s
    """

    def __init__(
        self,
        core: _core.Run,
        numbers: SteadyNumbers,
        mechanism: Mechanism | None,
        mean: Literal["extremes", "period"],
    ) -> None:
        self._init_args = core, numbers, mechanism, mean
        self.run = Run(core, mechanism, 1, [EXTREME], along_q=True)
        self.q, self.speed = self.run.q, self.run.speed
        self.period = float(self.run.t[-1] - self.run.t[0])
        self.max, self.min = (
            Extreme(as_number(numbers[end]["value"]), as_number(numbers[end]["at"]))
            for end in ("greatest", "least")
        )
        greatest, least = self.max.value, self.min.value
        span = abs(float(self.q[-1] - self.q[0]))
        self.mean = mean
        self.mean_speed = span / self.period if mean == "period" else 0.5 * (least + greatest)
        self.delta = (greatest - least) / self.mean_speed
        self.multiplier, self.found_moment = numbers["multiplier"], numbers["found_moment"]
        self.inertia, self.motor_work = numbers["inertia"], numbers["motor_work"]
        self.power = self.motor_work / self.period
        self.motor_moment = self.motor_work / math.copysign(span, float(self.q[-1] - self.q[0]))

    def __reduce__(self) -> tuple[Any, ...]:
        return SteadyState, self._init_args

    def __repr__(self) -> str:
        flywheel = f", flywheel {self.inertia:.6g} kg·m²" if self.inertia else ""
        return (
            f"<assur.SteadyState mean {self.mean_speed:.6g} rad/s, δ = {self.delta:.4g}, "
            f"{self.power:.6g} W{flywheel}>"
        )

    def at(self, q: npt.ArrayLike | None = None, *, deg: npt.ArrayLike | None = None) -> State:
        """Return time, speed and acceleration at coordinates, over any number of periods.

        Parameters
        ----------
        q : array_like
            Coordinates, rad.
        deg : array_like, optional
            The coordinates in degrees, in place of `q`.

        Returns
        -------
        State
            t (0 at the start of the period), q, speed and acceleration, of the shape of q.

        Examples
        --------
        >>> import assur, numpy as np
        >>> driven = assur.Machine(
        ...     assur.SliderCrank(0.1, 0.4),
        ...     bodies={"piston": assur.Body(mass=20.0), "crank": assur.Body(inertia=0.5)},
        ...     loads=[assur.Torque("crank", -20.0)],
        ...     motor=assur.LinearMotor(stall=50.0, no_load=15.0),
        ... )
        >>> steady = driven.steady_state()
        >>> steady.at([0.0, 2 * np.pi]).speed.round(6)  # rad/s: the same a period later
        array([9.79407, 9.79407])
        """
        x = finite_array(q_or_deg(None, q, deg, "at"), "q")
        first, last = float(self.q[0]), float(self.q[-1])
        low, high = min(first, last), max(first, last)
        # The remainder is exact however large q is.
        rest = np.remainder(x - first, last - first)
        is_here = (x >= low) & (x <= high)
        whole = np.where(is_here, 0.0, np.round((x - first - rest) / (last - first)))
        state = self.run.at(q=np.where(is_here, x, np.clip(first + rest, low, high)))
        return state._replace(t=state.t + whole * self.period, q=x[()])

    def _columns(self, degrees: bool) -> list[Column]:
        """Return one period, as its `run`."""
        return self.run._columns(degrees)

    def plot(
        self,
        what: Literal["speed", "time", "energy"] = "speed",
        *,
        ax: Axes | None = None,
        degrees: bool = False,
        dark: bool = False,
    ) -> Axes:
        """Draw one period (needs matplotlib).

        Parameters
        ----------
        what : {"speed", "time", "energy"}
            The speed over q or over the time, with the band of its fluctuation; or the energies.
        ax : matplotlib axes, optional
            Axes to draw on; new ones by default.
        degrees : bool
            Whether q is in degrees.
        dark : bool
            Colours for a dark canvas.

        Returns
        -------
        matplotlib axes
            The axes drawn on.

        Examples
        --------
        >>> import assur
        >>> driven = assur.Machine(
        ...     assur.SliderCrank(0.1, 0.4),
        ...     bodies={"piston": assur.Body(mass=20.0), "crank": assur.Body(inertia=0.5)},
        ...     loads=[assur.Torque("crank", -20.0)],
        ...     motor=assur.LinearMotor(stall=50.0, no_load=15.0),
        ... )
        >>> axes = driven.steady_state().plot(degrees=True)
        >>> axes.get_title(loc="left"), axes.get_xlabel()
        ('Speed, rad/s: δ = 0.174', 'q')
        """
        from assur.pictures.diagrams.steady import steady_picture

        one_of(what, ("speed", "time", "energy"), "what")
        return steady_picture(self, what, ax, flag(degrees, "degrees"), dark)
