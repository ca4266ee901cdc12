"""Flywheels: speed over one turn from moment and inertia, and the flywheel that smooths it.

The machine is referred to its driver: a reduced moment M (N·m) of all loads and a reduced inertia I
(kg·m²) over one period. A constant motor balances the mean moment of the loads; the speed follows
from the energy integral, ω² = (2 ∫(M + M_motor) dφ + (I(0) + I_f) ω0²) / (I + I_f).

References
----------
I. M. Matsyuk, E. M. Shlyakhov, *Dynamic synthesis of a lever mechanism by the coefficient of speed
fluctuation in Mathcad*, equations 1 to 6. F. Wittenbauer, *Graphische Dynamik* (1923).
"""

from __future__ import annotations

import csv
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias, overload

import numpy as np
import numpy.typing as npt

from assur import _core
from assur._arrays import real_array
from assur._validate import checked_index, checked_threads, one_of, whole_number
from assur.errors import AssurWarning, InputError

if TYPE_CHECKING:
    from os import PathLike

__all__ = ["Extremum", "Flywheel", "Table", "evaluate", "from_table", "read_table"]

Float: TypeAlias = npt.NDArray[np.float64]
Mean: TypeAlias = Literal["extremes", "period"]
Spline: TypeAlias = Literal["not-a-knot", "natural", "clamped", "periodic", "linear"]
# The requirement besides the mean or initial speed; "mean speed" and "initial speed": a flywheel.
Task: TypeAlias = Literal["fluctuation", "mean speed", "initial speed"]

MEANS = ("extremes", "period")
SPLINES = ("not-a-knot", "natural", "clamped", "periodic", "linear")
# Tables are typed with four digits: their period may differ by this fraction from whole turns.
WHOLE_TURNS_RTOL = 1e-3
# Points of a plotted curve.
PLOT_POINTS = 721


class Extremum(NamedTuple):
    """An extreme speed: its coordinate, rad, and its value, rad/s."""

    at: Any
    value: Any


class Table(NamedTuple):
    """Coordinates, rad, reduced moment, N·m, and reduced inertia, kg·m², of one period."""

    phi: Float
    moment: Float
    inertia: Float


class Flywheel:
    """A machine with its flywheel in steady motion; numbers have the shape of the batch.

    Made by `from_table` and `evaluate`.

    Attributes
    ----------
    inertia : float or array
        The flywheel's moment of inertia I_f, kg·m².
    speed0 : float or array
        Speed at the start of the table, rad/s.
    delta : float or array
        Coefficient of speed fluctuation: (greatest − least) / `mean_speed`.
    mean_speed : float or array
        Mean speed by the chosen definition (`mean`), rad/s.
    greatest, least : Extremum
        The extreme speeds and their coordinates.
    motor_moment : float or array
        Moment of the constant motor, N·m.
    period : float or array
        Time of one period of the table, s.
    shape : tuple of int
        Shape of the batch; () for one table.
    """

    def __init__(self, arguments: tuple[Any, ...], shape: tuple[int, ...], mean: Mean) -> None:
        self._arguments = arguments
        self._core = _core.Flywheels(*arguments)
        self.shape = shape
        self.mean = mean
        phi = arguments[0]
        self._span = float(phi[0]), float(phi[-1])
        numbers = [_shaped(one, shape) for one in self._core.numbers()]
        self.inertia, self.speed0, self.motor_moment = numbers[:3]
        self.greatest, self.least = Extremum(*numbers[3:5]), Extremum(*numbers[5:7])
        self.period = numbers[7]
        width = self._span[1] - self._span[0]
        half = (self.greatest.value + self.least.value) / 2.0
        self.mean_speed = half if mean == "extremes" else width / self.period
        self.delta = (self.greatest.value - self.least.value) / self.mean_speed

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._arguments, self.shape, self.mean)

    def __repr__(self) -> str:
        if self.shape:
            return f"<assur.flywheel.Flywheel of {self.shape} tables>"
        return (
            f"<assur.flywheel.Flywheel {self.inertia:.6g} kg·m², δ = {self.delta:.4g}, "
            f"mean {self.mean_speed:.6g} rad/s, speed0 {self.speed0:.6g} rad/s>"
        )

    def speed(self, q: npt.ArrayLike) -> Any:
        """Return the speed at coordinates of the driver, over any number of turns.

        Parameters
        ----------
        q : array_like
            Coordinates, rad: a number or (N,), the same for every table.

        Returns
        -------
        float or ndarray
            rad/s, of the batch's shape followed by that of q.

        Examples
        --------
        >>> from assur import flywheel
        >>> import numpy as np
        >>> phi = np.linspace(0.0, 2 * np.pi, 25)
        >>> f = flywheel.evaluate(phi, 10 * np.sin(phi), np.full(25, 2.0), speed0=10.0)
        >>> round(f.speed(np.pi), 3)
        10.954
        """
        return self._curve("speed", q, "q")

    def time(self, q: npt.ArrayLike) -> Any:
        """Return the time at which coordinates are reached, s; 0 at the start of the table."""
        return self._curve("time", q, "q")

    def angle(self, t: npt.ArrayLike) -> Any:
        """Return the coordinate at times t (s), rad; the inverse of `time`."""
        return self._curve("angle", t, "t")

    def speed_at(self, t: npt.ArrayLike) -> Any:
        """Return the speed at times t (s), rad/s."""
        if self.shape:
            message = "speed_at is for one table: take one of the batch by evaluating it by itself"
            raise InputError(message)
        return self.speed(self.angle(t))

    def moment(self, q: npt.ArrayLike) -> Any:
        """Return the reduced moment of the loads at coordinates, N·m, without the motor."""
        return self._curve("moment", q, "q")

    def reduced_inertia(self, q: npt.ArrayLike) -> Any:
        """Return the reduced inertia at coordinates, kg·m², without the flywheel."""
        return self._curve("inertia", q, "q")

    def work(self, q: npt.ArrayLike) -> Any:
        """Return the work of loads and motor since the start of the table, J."""
        return self._curve("work", q, "q")

    def explain(self, index: Any = ()) -> str:
        """Return why a table of a batch has no flywheel, or the flywheel it has.

        Parameters
        ----------
        index : int or tuple of int
            Index into the batch; omit it for one table.
        """
        entry = checked_index(index, self.shape, "explain")
        flat = int(np.ravel_multi_index(entry, self.shape)) if self.shape else 0
        problem = self._core.problem(flat)
        if problem is not None:
            return str(problem)
        inertia = np.asarray(self.inertia)[entry]
        return f"a flywheel of {inertia:.9g} kg·m², δ = {np.asarray(self.delta)[entry]:.6g}"

    def energy_mass(self, points: int = PLOT_POINTS) -> tuple[Float, Float]:
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
        """
        needed = "a whole number of at least 2 is needed"
        q = np.linspace(*self._span, whole_number(points, "points", 2, needed=needed))
        inertia = self.reduced_inertia(q)
        start = np.asarray(self.reduced_inertia(self._span[0]) * np.square(self.speed0) / 2.0)
        return inertia, self.work(q) + start[..., np.newaxis]

    def plot(self, what: Literal["speed", "time", "energy-mass"] = "speed", ax: Any = None) -> Any:
        """Draw the speed over the turn or over the time, or the energy-mass diagram.

        Parameters
        ----------
        what : {"speed", "time", "energy-mass"}
            ω(φ), ω(t), or Wittenbauer's diagram with the tangents at the extreme speeds.
        ax : matplotlib.axes.Axes, optional
            Axes to draw on; a new figure by default.

        Returns
        -------
        matplotlib.axes.Axes
            The axes drawn on.
        """
        from assur.plot import flywheel_picture

        if self.shape:
            message = "plot is for one table, this is a batch"
            raise InputError(message)
        one_of(what, ("speed", "time", "energy-mass"), "what")
        return flywheel_picture(self, what, self._span, PLOT_POINTS, ax)

    def _curve(self, quantity: str, points: npt.ArrayLike, name: str) -> Any:
        x = real_array(points, name)
        if not np.isfinite(x).all():
            value = float(x[~np.isfinite(x)][0])
            message = f"{name} has {value}: finite numbers are needed"
            raise InputError(message, value=value)
        shape = self.shape + x.shape
        flat = np.ascontiguousarray(np.broadcast_to(x, shape)).ravel()
        return _shaped(self._core.curve(quantity, flat), shape)


@overload
def from_table(
    phi: npt.ArrayLike,
    moment: npt.ArrayLike,
    inertia: npt.ArrayLike,
    fluctuation: npt.ArrayLike,
    mean_speed: npt.ArrayLike,
    mean: Mean = ...,
    spline: Spline = ...,
    on_error: Literal["raise", "nan"] = ...,
    threads: int | None = ...,
) -> Flywheel: ...


@overload
def from_table(
    phi: npt.ArrayLike,
    moment: npt.ArrayLike,
    inertia: npt.ArrayLike = ...,
    *,
    fluctuation: npt.ArrayLike,
    mean_speed: npt.ArrayLike,
    mean: Mean = ...,
    spline: Spline = ...,
    on_error: Literal["raise", "nan"] = ...,
    threads: int | None = ...,
) -> Flywheel: ...


def from_table(
    phi: npt.ArrayLike,
    moment: npt.ArrayLike,
    inertia: npt.ArrayLike = 0.0,
    fluctuation: npt.ArrayLike | None = None,
    mean_speed: npt.ArrayLike | None = None,
    mean: Mean = "extremes",
    spline: Spline = "not-a-knot",
    on_error: Literal["raise", "nan"] = "raise",
    threads: int | None = None,
) -> Flywheel:
    """Return the flywheel that limits the speed fluctuation to a given fraction of the mean.

    Parameters
    ----------
    phi : array_like
        Coordinates of the driver over one period, rad, ascending, both ends included: (K,).
    moment : array_like
        Reduced moment of the loads there, N·m, the last row equal to the first: (K,), or S + (K,)
        for a batch of tables.
    inertia : array_like
        Reduced inertia of the machine without the flywheel, kg·m²: of the same shape, or one number
        for all rows. It may be 0, the default: all inertia is then the flywheel's.
    fluctuation : array_like
        Required coefficient of speed fluctuation δ, of shape S or a number.
    mean_speed : array_like
        Required mean speed, rad/s, of shape S or a number.
    mean : {"extremes", "period"}
        Definition of the mean speed, by which δ is divided: half the sum of the greatest and the
        least speed, or the period divided by its time.
    spline : {"not-a-knot", "natural", "clamped", "periodic", "linear"}
        Interpolation between the rows (Mathcad's ``cspline`` is not-a-knot).
    on_error : {"raise", "nan"}
        For a table without a flywheel: raise an error, or return NaN (see `Flywheel.explain`).
    threads : int, optional
        Maximum number of threads for a batch; one per core by default.

    Returns
    -------
    Flywheel
        The flywheel and the resulting motion.

    Raises
    ------
    InputError
        A table that is short, not ascending, not periodic or of negative inertia; an impossible
        fluctuation or speed; a fluctuation that is already met without a flywheel.

    Warns
    -----
    AssurWarning
        The period is neither a number of turns nor a fraction of one: phi may be in degrees.

    Examples
    --------
    The paper's press, its speed kept within 1/8 of the mean:

    >>> from assur import flywheel
    >>> import numpy as np
    >>> moment = [-0.23, -274.4, -950.5, 19.9, 1.26, -300.0, -23.9, -15.9, -0.23]
    >>> inertia = [4.93, 5.07, 5.1, 5.1, 4.93, 5.05, 5.1, 5.14, 4.93]
    >>> phi = np.linspace(0.0, 2 * np.pi, 9)
    >>> f = flywheel.from_table(phi, moment, inertia, fluctuation=1 / 8, mean_speed=15.0)
    >>> f
    <assur.flywheel.Flywheel 19.9182 kg·m², δ = 0.125, mean 15 rad/s, speed0 15.5166 rad/s>
    >>> print(f"{f.motor_moment:.3f} N·m, {f.greatest.value:.4f} rad/s at {f.greatest.at:.5f} rad")
    184.035 N·m, 15.9375 rad/s at 0.70933 rad

    A turning-moment diagram alone, for an engine whose parts are light against its flywheel:

    >>> phi = np.linspace(0.0, 2 * np.pi, 721)
    >>> moment = 20e3 + 9.5e3 * np.sin(2 * phi) - 5.7e3 * np.cos(2 * phi)
    >>> f = flywheel.from_table(phi, moment, fluctuation=0.01, mean_speed=6 * np.pi)
    >>> round(f.inertia, 3)
    3118.106
    """
    if fluctuation is None or mean_speed is None:
        missing = "fluctuation" if fluctuation is None else "mean_speed"
        message = f"{missing} is missing: both fluctuation and mean_speed are needed"
        raise InputError(message)
    wanted = (fluctuation, "fluctuation"), (mean_speed, "mean_speed")
    return _flywheel(phi, moment, inertia, spline, "fluctuation", wanted, mean, on_error, threads)


def evaluate(
    phi: npt.ArrayLike,
    moment: npt.ArrayLike,
    inertia: npt.ArrayLike,
    flywheel: npt.ArrayLike = 0.0,
    speed0: npt.ArrayLike | None = None,
    mean_speed: npt.ArrayLike | None = None,
    mean: Mean = "extremes",
    spline: Spline = "not-a-knot",
    on_error: Literal["raise", "nan"] = "raise",
    threads: int | None = None,
) -> Flywheel:
    """Return the motion with a given flywheel, at a given speed or mean speed.

    Parameters
    ----------
    phi, moment, inertia, spline, on_error, threads
        See `from_table`; inertia plus flywheel must be positive everywhere.
    flywheel : array_like
        The flywheel's moment of inertia, kg·m²; none by default.
    speed0 : array_like, optional
        Speed at the start of the table, rad/s. Give either this or:
    mean_speed : array_like, optional
        Mean speed, rad/s.
    mean : {"extremes", "period"}
        Definition of the mean speed, also for the result's `delta`.

    Returns
    -------
    Flywheel
        The resulting motion.

    Raises
    ------
    InputError
        See `from_table`; also neither or both speeds given, or a speed at which the machine stops
        within the period.

    Examples
    --------
    >>> from assur import flywheel
    >>> import numpy as np
    >>> phi = np.linspace(0.0, 2 * np.pi, 49)
    >>> f = flywheel.evaluate(phi, 100 * np.sin(phi), np.full(49, 2.0), 8.0, mean_speed=10.0)
    >>> round(f.delta, 4)
    0.2
    """
    if (speed0 is None) == (mean_speed is None):
        message = "one of speed0 and mean_speed is needed, not both"
        raise InputError(message)
    task: Task = "initial speed" if mean_speed is None else "mean speed"
    second = (speed0, "speed0") if mean_speed is None else (mean_speed, "mean_speed")
    wanted = (flywheel, "flywheel"), second
    return _flywheel(phi, moment, inertia, spline, task, wanted, mean, on_error, threads)


def read_table(path: str | PathLike[str], degrees: bool = False) -> Table:
    """Read a table from a file of comma-separated values.

    Parameters
    ----------
    path : path-like
        The file: columns phi, moment and inertia, in any order under a header that names them, or
        in this order without one. Other columns and lines that begin with # are ignored.
    degrees : bool
        Whether phi is in degrees.

    Returns
    -------
    Table
        phi (rad), moment (N·m), inertia (kg·m²).

    Raises
    ------
    InputError
        A file that cannot be read or has fewer than two rows, or a row that is not three numbers
        (the message gives its line).
    """
    try:
        lines = Path(path).read_text(encoding="utf-8-sig").splitlines()
        kept = [(i, line) for i, line in enumerate(lines, 1) if line.strip() and line[:1] != "#"]
        cells = list(csv.reader(line for _, line in kept))
    except (OSError, ValueError, csv.Error) as error:
        message = f"{path}: the table cannot be read ({error})"
        raise InputError(message) from error
    columns = [0, 1, 2]
    if cells and _number(cells[0], 0) is None:
        names = [cell.strip().lower() for cell in cells[0]]
        missing = [name for name in Table._fields if name not in names]
        if missing:
            message = f"{path}: the header has no column {missing[0]!r}, it has {', '.join(names)}"
            raise InputError(message)
        columns = [names.index(name) for name in Table._fields]
        kept, cells = kept[1:], cells[1:]
    rows = [[_number(row, column) for column in columns] for row in cells]
    bad = next((i for i, row in enumerate(rows) if None in row), None)
    if bad is not None:
        line, text = kept[bad]
        message = f"{path}, line {line}: {text!r} is not three numbers phi, moment, inertia"
        raise InputError(message)
    if len(rows) < 2:
        message = f"{path}: the table has {len(rows)} rows: at least 2 are needed"
        raise InputError(message)
    phi, moment, inertia = np.array(rows, np.float64).reshape(-1, 3).T
    return Table(np.deg2rad(phi) if degrees else phi, moment, inertia)


def _number(row: list[str], column: int) -> float | None:
    try:
        return float(row[column])
    except (ValueError, IndexError):
        return None


def _flywheel(
    phi: npt.ArrayLike,
    moment: npt.ArrayLike,
    inertia: npt.ArrayLike,
    spline: Spline,
    task: Task,
    wanted: tuple[tuple[Any, str], tuple[Any, str]],
    mean: Mean,
    on_error: str,
    threads: int | None,
    corners: list[int] | None = None,
) -> Flywheel:
    one_of(mean, MEANS, "mean")
    one_of(spline, SPLINES, "spline")
    one_of(on_error, ("raise", "nan"), "on_error")
    x, m, i = real_array(phi, "phi"), real_array(moment, "moment"), real_array(inertia, "inertia")
    if x.ndim != 1:
        message = f"phi has the shape {x.shape}: one list of coordinates is needed"
        raise InputError(message)
    if x.size < 2:
        message = f"the table has {x.size} rows: at least 2 are needed"
        raise InputError(message)
    warn_if_degrees(float(x[-1] - x[0]))
    if i.ndim == 0:
        i = np.full(x.shape, i)
    for column, name in ((m, "moment"), (i, "inertia")):
        if column.ndim == 0 or column.shape[-1] != x.size:
            message = (
                f"{name} has the shape {column.shape}: its last axis must have the {x.size} of phi"
            )
            raise InputError(message)
    numbers = [real_array(value, name) for value, name in wanted]
    try:
        shape = np.broadcast_shapes(m.shape[:-1], i.shape[:-1], *(n.shape for n in numbers))
    except ValueError as error:
        shapes = ", ".join(str(a.shape) for a in (m, i, *numbers))
        message = f"the shapes {shapes} of moment, inertia and what is asked for do not fit"
        raise InputError(message) from error
    full = (*shape, x.size)
    flat = [np.ascontiguousarray(np.broadcast_to(a, full)).ravel() for a in (m, i)]
    first, second = (np.ascontiguousarray(np.broadcast_to(n, shape)).ravel() for n in numbers)
    arguments = (np.ascontiguousarray(x), *flat, spline, task, mean, first, second)
    result = Flywheel((*arguments, checked_threads(threads), corners), shape, mean)
    failed = np.flatnonzero(np.isnan(np.asarray(result.inertia)).ravel())
    if on_error == "raise" and failed.size:
        first_failed = int(failed[0])
        design, place = None, ""
        if shape:
            design = [int(k) for k in np.unravel_index(first_failed, shape)]
            more = f" (and {failed.size - 1} more)" if failed.size > 1 else ""
            place = f"table {tuple(design)}{more}: "
        raise result._core.failure(first_failed, place, design)
    return result


def warn_if_degrees(span: float, periodic: bool = True) -> None:
    """Warn if a period is neither a number of turns nor a fraction of one: likely degrees."""
    if not periodic:
        return
    turns = span / (2.0 * np.pi)
    ratio = max(turns, 1.0 / turns) if turns > 0.0 else 1.0
    if abs(ratio - round(ratio)) > WHOLE_TURNS_RTOL * ratio:
        message = (
            f"phi covers {span:g} rad, {turns:.6g} turns: a period is mostly a number of turns or "
            "a part of one. Is phi in degrees?"
        )
        warnings.warn(message, AssurWarning, stacklevel=4)


def _shaped(flat: Float, shape: tuple[int, ...]) -> Any:
    flat = flat.reshape(shape)
    flat.flags.writeable = False
    return flat if shape else float(flat)
