"""A machine with its flywheel in steady motion, with any motor."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Literal, TypeAlias, overload

import numpy as np
import numpy.typing as npt

from assur._arrays import Float, finite_array, flag
from assur._other_names import other_names
from assur._table import Column, Tabular, angle_column, design_columns
from assur._validate import MAX_POINTS, checked_index, one_of, whole_number
from assur.errors import InputError
from assur.kinematics.solve_arguments import q_or_deg

if TYPE_CHECKING:
    from collections.abc import Callable

    from matplotlib.axes import Axes

    from assur._arrays import Number
    from assur._extreme import Extreme
    from assur._faces import AxesLike, Panels
    from assur._later import SteadyState

Mean: TypeAlias = Literal["extremes", "period"]
Curve: TypeAlias = Literal["speed", "time", "coordinate", "moment", "inertia", "work"]

MEANS = ("extremes", "period")
# Points of a plotted curve.
PLOT_POINTS = 721


@other_names(least="it is min", greatest="it is max")
class Flywheel(Tabular, ABC):
    """A machine with its flywheel in steady motion, with any motor.

    Made by `from_table` and `evaluate` (with a constant motor) and by `Machine.flywheel`. Numbers
    and curves have the shape of the batch.

    Attributes
    ----------
    inertia : float or array
        The flywheel's moment of inertia I_f, kg·m².
    speed0 : float or array
        Speed at the start of the turn, rad/s: at the first row of a table, at q = 0 of a
        `Machine`. As `speed`, negative if the motor turns the driver backward.
    delta : float or array
        Coefficient of speed fluctuation: (greatest − least) / `mean_speed`.
    mean_speed : float or array
        Mean speed by the chosen definition (`mean`), rad/s; positive.
    mean : {"extremes", "period"}
        Definition of the mean speed.
    max, min : Extreme
        The extreme speeds (absolute values) and their coordinates in the turn.
    motor_moment : float or array
        Mean moment of the motor on the driver, N·m; a constant motor has it everywhere.
    power : float or array
        Mean power of the motor, W.
    period : float or array
        Time of one period (of a `Machine` one turn), s.
    shape : tuple of int
        Shape of the batch; () for one table or machine.
    steady : SteadyState or None
        The integrated motion, if the machine's own motor sets the speed.

    Examples
    --------
    >>> import numpy as np
    >>> from assur import flywheel
    >>> phi = np.linspace(0.0, 2 * np.pi, 49)
    >>> f = flywheel.from_table(phi, 100.0 * np.sin(phi), fluctuation=0.1, mean_speed=10.0)
    >>> round(f.inertia, 3), round(f.delta, 6)  # kg·m²: 200 J / (0.1 · (10 rad/s)²)
    (20.0, 0.1)
    """

    def __init__(
        self,
        *,
        inertia: Number,
        speed0: Number,
        motor_moment: Number,
        extremes: tuple[Extreme, Extreme],
        period: Number,
        mean: Mean,
        turn: tuple[float, float],
        shape: tuple[int, ...] = (),
        steady: SteadyState | None = None,
    ) -> None:
        self.shape, self.mean, self.steady = shape, mean, steady
        self.turn = turn
        self.inertia, self.speed0, self.motor_moment = inertia, speed0, motor_moment
        self.max, self.min = extremes
        self.period = period
        width = turn[1] - turn[0]
        half = (self.max.value + self.min.value) / 2.0
        self.mean_speed = half if mean == "extremes" else abs(width) / period
        self.delta = (self.max.value - self.min.value) / self.mean_speed
        self.power = motor_moment * width / period

    @abstractmethod
    def _curve(self, what: Curve, x: Float) -> Number:
        """Return a curve at finite coordinates or times, of the batch's shape and that of x."""

    @abstractmethod
    def _problem(self, entry: tuple[int, ...]) -> str | None:
        """Return why an entry of the batch has no flywheel; None if it has one."""

    def __repr__(self) -> str:
        if self.shape:
            return f"<assur.flywheel.Flywheel of {self.shape} tables>"
        return (
            f"<assur.flywheel.Flywheel {self.inertia:.6g} kg·m², δ = {self.delta:.4g}, "
            f"mean {self.mean_speed:.6g} rad/s, speed0 {self.speed0:.6g} rad/s>"
        )

    def speed(self, q: npt.ArrayLike | None = None, *, deg: npt.ArrayLike | None = None) -> Number:
        """Return the speed at coordinates of the driver, over any number of turns.

        Parameters
        ----------
        q : array_like
            Coordinates, rad: a number or (N,), the same for every table.
        deg : array_like, optional
            The coordinates in degrees, in place of `q`.

        Returns
        -------
        float or ndarray
            rad/s, of the batch's shape followed by that of q; negative if the motor turns the
            driver backward.

        Examples
        --------
        >>> from assur import flywheel
        >>> import numpy as np
        >>> phi = np.linspace(0.0, 2 * np.pi, 25)
        >>> f = flywheel.evaluate(phi, 10 * np.sin(phi), np.full(25, 2.0), speed0=10.0)
        >>> round(f.speed(np.pi), 3)
        10.954
        """
        q = q_or_deg(None, q, deg, "speed")
        return self._curve("speed", finite_array(q, "q"))

    def time(self, q: npt.ArrayLike | None = None, *, deg: npt.ArrayLike | None = None) -> Number:
        """Return the time at which coordinates are reached, s; 0 at the start of the turn.

        Parameters
        ----------
        q : array_like
            Coordinates, rad.
        deg : array_like, optional
            The coordinates in degrees, in place of `q`.

        Returns
        -------
        float or ndarray
            Times, s, of the shape of the batch + that of q.

        Examples
        --------
        >>> import numpy as np
        >>> from assur import flywheel
        >>> phi = np.linspace(0.0, 2 * np.pi, 49)
        >>> f = flywheel.from_table(phi, 100.0 * np.sin(phi), fluctuation=0.1, mean_speed=10.0)
        >>> f.time([0.0, 2 * np.pi]).round(6), round(f.period, 6)  # s
        (array([0.      , 0.628712]), 0.628712)
        """
        q = q_or_deg(None, q, deg, "time")
        return self._curve("time", finite_array(q, "q"))

    def coordinate(self, t: npt.ArrayLike) -> Number:
        """Return the coordinate at times t (s), rad; the inverse of `time`.

        Parameters
        ----------
        t : array_like
            Times, s.

        Returns
        -------
        float or ndarray
            Coordinates, rad, of the shape of the batch + that of t.

        Examples
        --------
        >>> import numpy as np
        >>> from assur import flywheel
        >>> phi = np.linspace(0.0, 2 * np.pi, 49)
        >>> f = flywheel.from_table(phi, 100.0 * np.sin(phi), fluctuation=0.1, mean_speed=10.0)
        >>> f.coordinate(f.time([1.0, 2.0])).round(6)  # rad
        array([1., 2.])
        """
        return self._curve("coordinate", finite_array(t, "t"))

    def speed_at(self, t: npt.ArrayLike) -> Number:
        """Return the speed at times t (s), rad/s.

        Parameters
        ----------
        t : array_like
            Times, s.

        Returns
        -------
        float or ndarray
            Speeds, rad/s, of the shape of the batch + that of t.

        Examples
        --------
        >>> import numpy as np
        >>> from assur import flywheel
        >>> phi = np.linspace(0.0, 2 * np.pi, 49)
        >>> f = flywheel.from_table(phi, 100.0 * np.sin(phi), fluctuation=0.1, mean_speed=10.0)
        >>> f.speed_at(f.time([0.0, np.pi])).round(4)  # rad/s: least and greatest
        array([ 9.5, 10.5])
        """
        if self.shape:
            message = "speed_at is for one table: take one of the batch by evaluating it by itself"
            raise InputError(message)
        return self.speed(self.coordinate(t))

    def reduced_moment(
        self, q: npt.ArrayLike | None = None, *, deg: npt.ArrayLike | None = None
    ) -> Number:
        """Return the reduced moment of the loads at coordinates, N·m, without the motor.

        For a `Machine` the loads are those at the mean speed, or with its own motor at `speed(q)`.

        Parameters
        ----------
        q : array_like
            Coordinates, rad.
        deg : array_like, optional
            The coordinates in degrees, in place of `q`.

        Returns
        -------
        float or ndarray
            Moments, N·m, of the shape of the batch + that of q.

        Examples
        --------
        >>> import numpy as np
        >>> from assur import flywheel
        >>> phi = np.linspace(0.0, 2 * np.pi, 49)
        >>> f = flywheel.from_table(phi, 100.0 * np.sin(phi), fluctuation=0.1, mean_speed=10.0)
        >>> round(f.reduced_moment(np.pi / 2), 6)  # N·m
        100.0
        """
        q = q_or_deg(None, q, deg, "reduced_moment")
        return self._curve("moment", finite_array(q, "q"))

    def reduced_inertia(
        self, q: npt.ArrayLike | None = None, *, deg: npt.ArrayLike | None = None
    ) -> Number:
        """Return the reduced inertia at coordinates, kg·m², without the flywheel.

        Parameters
        ----------
        q : array_like
            Coordinates, rad.
        deg : array_like, optional
            The coordinates in degrees, in place of `q`.

        Returns
        -------
        float or ndarray
            Inertias, kg·m², of the shape of the batch + that of q.

        Examples
        --------
        >>> import numpy as np
        >>> from assur import flywheel
        >>> phi = np.linspace(0.0, 2 * np.pi, 49)
        >>> f = flywheel.evaluate(
        ...     phi, 100 * np.sin(phi), np.full(49, 2.0), flywheel=8.0, mean_speed=10.0
        ... )
        >>> round(f.reduced_inertia(1.0), 6)  # kg·m², without the flywheel's 8
        2.0
        """
        q = q_or_deg(None, q, deg, "reduced_inertia")
        return self._curve("inertia", finite_array(q, "q"))

    def work(self, q: npt.ArrayLike | None = None, *, deg: npt.ArrayLike | None = None) -> Number:
        """Return the work of loads and motor since the start of the turn, J.

        Parameters
        ----------
        q : array_like
            Coordinates, rad.
        deg : array_like, optional
            The coordinates in degrees, in place of `q`.

        Returns
        -------
        float or ndarray
            Work, J, of the shape of the batch + that of q.

        Examples
        --------
        >>> import numpy as np
        >>> from assur import flywheel
        >>> phi = np.linspace(0.0, 2 * np.pi, 49)
        >>> f = flywheel.from_table(phi, 100.0 * np.sin(phi), fluctuation=0.1, mean_speed=10.0)
        >>> round(f.work(np.pi), 2)  # J
        200.0
        """
        q = q_or_deg(None, q, deg, "work")
        return self._curve("work", finite_array(q, "q"))

    def explain(self, index: int | tuple[int, ...] = ()) -> str:
        """Return why one of a batch has no flywheel, or the flywheel it has.

        Parameters
        ----------
        index : int or tuple of int
            Index into the batch; omit it for one flywheel.

        Returns
        -------
        str
            A sentence.

        Examples
        --------
        >>> import numpy as np
        >>> from assur import flywheel
        >>> phi = np.linspace(0.0, 2 * np.pi, 49)
        >>> f = flywheel.from_table(phi, 100.0 * np.sin(phi), fluctuation=0.1, mean_speed=10.0)
        >>> f.explain()
        'a flywheel of 19.9999925 kg·m², δ = 0.1'
        """
        entry = checked_index(index, self.shape, "explain")
        problem = self._problem(entry)
        if problem is not None:
            return problem
        inertia = np.asarray(self.inertia)[entry]
        return f"a flywheel of {inertia:.9g} kg·m², δ = {np.asarray(self.delta)[entry]:.6g}"

    def energy_mass(self, *, points: int = PLOT_POINTS) -> tuple[Float, Float]:
        """Return Wittenbauer's diagram of one turn.

        Parameters
        ----------
        points : int
            Number of points, equally spaced along the turn.

        Returns
        -------
        inertia, energy : ndarray
            Reduced inertia without the flywheel, kg·m², and the kinetic energy minus that of the
            flywheel at the start, J. The tangents with slopes ω²/2 at the extreme speeds meet at
            (−I_f, −I_f ω0²/2).

        Examples
        --------
        >>> import numpy as np
        >>> from assur import flywheel
        >>> phi = np.linspace(0.0, 2 * np.pi, 49)
        >>> f = flywheel.evaluate(
        ...     phi, 100 * np.sin(phi), np.full(49, 2.0), flywheel=8.0, mean_speed=10.0
        ... )
        >>> inertia, energy = f.energy_mass(points=5)
        >>> inertia.round(6), (energy - energy[0]).round(2)  # kg·m², J
        (array([2., 2., 2., 2., 2.]), array([  0., 100., 200., 100.,   0.]))
        """
        q = np.linspace(*self.turn, whole_number(points, "points", 2, MAX_POINTS))
        inertia = self.reduced_inertia(q)
        start = np.asarray(self.reduced_inertia(self.turn[0]) * np.square(self.speed0) / 2.0)
        return inertia, self.work(q) + start[..., np.newaxis]

    def _columns(self, degrees: bool) -> list[Column]:
        """Return one turn of one flywheel; of a batch a row for each."""
        if self.shape:
            return self._row_columns(degrees)
        q = np.linspace(*self.turn, PLOT_POINTS)
        columns = [angle_column("q", q, degrees)]
        for name, curve, unit in (
            ("time", self.time, "s"),
            ("speed", self.speed, "rad/s"),
            ("reduced_moment", self.reduced_moment, "N m"),
            ("reduced_inertia", self.reduced_inertia, "kg m2"),
            ("work", self.work, "J"),
        ):
            columns.append(Column(name, np.broadcast_to(curve(q), q.shape), unit, name))
        return columns

    def _row_columns(self, degrees: bool) -> list[Column]:
        columns = design_columns(self.shape, len(self.shape))
        for name, values, unit in (
            ("inertia", self.inertia, "kg m2"),
            ("speed0", self.speed0, "rad/s"),
            ("delta", self.delta, ""),
            ("mean_speed", self.mean_speed, "rad/s"),
            ("max", self.max.value, "rad/s"),
            ("max.q", self.max.q, "rad"),
            ("min", self.min.value, "rad/s"),
            ("min.q", self.min.q, "rad"),
            ("motor_moment", self.motor_moment, "N m"),
            ("power", self.power, "W"),
            ("period", self.period, "s"),
        ):
            shown = np.broadcast_to(values, self.shape).reshape(-1)
            column = Column(name, shown, unit, "flywheel")
            if unit == "rad":
                column = angle_column(name, shown, degrees)._replace(quantity="flywheel")
            columns.append(column)
        return columns

    @property
    def surplus(self) -> Callable[[Float], Float]:
        """The motor's moment less the resistance at coordinates, N·m.

        :meta private:
        """
        return self._surplus

    def _surplus(self, q: Float) -> Float:
        """Return the moment of motor and loads together at coordinates, N·m."""
        return np.asarray(self.reduced_moment(q) + self.motor_moment)[()]

    @overload
    def plot(
        self,
        what: Literal["reduced"],
        *,
        ax: AxesLike | None = ...,
        degrees: bool = ...,
        dark: bool = ...,
    ) -> Panels: ...
    @overload
    def plot(
        self,
        what: Literal["speed", "time", "moment", "energy", "energy-mass"] = ...,
        *,
        ax: AxesLike | None = ...,
        degrees: bool = ...,
        dark: bool = ...,
    ) -> Axes: ...
    def plot(
        self,
        what: Literal["speed", "time", "moment", "energy", "energy-mass", "reduced"] = "speed",
        *,
        ax: AxesLike | None = None,
        degrees: bool = False,
        dark: bool = False,
    ) -> Axes | Panels:
        """Draw the motion over a turn, the moments and energies behind it (needs matplotlib).

        Parameters
        ----------
        what : {"speed", "time", "moment", "energy", "energy-mass", "reduced"}
            The speed over q or over the time, with the band of its fluctuation; the moments of
            motor and resistance, the areas of surplus and deficit with their energies; the work
            since the start, and what the flywheel stores of it; Wittenbauer's diagram with the
            tangents at the extreme speeds; reduced moment and inertia (two axes).
        ax : matplotlib.axes.Axes, optional
            Axes to draw on; a new figure by default.
        degrees : bool
            Whether q is in degrees.
        dark : bool
            Colours for a dark canvas.

        Returns
        -------
        matplotlib.axes.Axes, or a pair of them
            The axes drawn on.

        Examples
        --------
        >>> import numpy as np
        >>> from assur import flywheel
        >>> phi = np.linspace(0.0, 2 * np.pi, 49)
        >>> f = flywheel.from_table(phi, 100.0 * np.sin(phi), fluctuation=0.1, mean_speed=10.0)
        >>> axes = f.plot("speed", degrees=True)
        >>> axes.get_title(loc="left"), [text.get_text() for text in axes.texts]
        ('Speed, rad/s: δ = 0.1 with 20 kg·m²', ['10.50 at 180°', '9.50 at 0°', 'mean 10.00'])
        """
        from assur.pictures.diagrams.flywheel import flywheel_picture

        if self.shape:
            message = f"plot is for one flywheel, this is a batch {self.shape}: evaluate one alone"
            raise InputError(message)
        kinds = ("speed", "time", "moment", "energy", "energy-mass", "reduced")
        one_of(what, kinds, "what")
        shown = flag(degrees, "degrees")
        axes: Axes | Panels = flywheel_picture(self, what, self.turn, PLOT_POINTS, ax, shown, dark)
        return axes


def problem_of(flywheel: Flywheel, entry: tuple[int, ...]) -> str | None:
    """Return why an entry of a batch has no flywheel; None if it has one."""
    return flywheel._problem(entry)


def curve_of(flywheel: Flywheel, what: Curve, x: Float) -> Number:
    """Return a curve at finite coordinates or times, of the batch's shape and that of x."""
    return flywheel._curve(what, x)
