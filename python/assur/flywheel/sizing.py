"""Flywheels from tables: sized for a fluctuation, or the motion with a given one."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, overload

import numpy as np
import numpy.typing as npt

from assur import _core
from assur._arrays import Float, as_number, real_array
from assur._extreme import Extreme
from assur._splines import SPLINES, Spline
from assur._validate import checked_threads, one_of, require_rows
from assur.errors import AssurWarning, InputError
from assur.flywheel.result import MEANS, Curve, Flywheel, Mean

if TYPE_CHECKING:
    from assur._arrays import Number

# The requirement besides the mean or initial speed; "mean speed" and "initial speed": a flywheel.
Task: TypeAlias = Literal["fluctuation", "mean speed", "initial speed"]

# Tables are typed with four digits: their period may differ by this fraction from whole turns.
WHOLE_TURNS_RTOL = 1e-3


class TabulatedFlywheel(Flywheel):
    """A flywheel with a constant motor, or a batch of them; solved by the core from tables."""

    def __init__(self, arguments: tuple[Any, ...], shape: tuple[int, ...], mean: Mean) -> None:
        self._arguments = arguments
        self._core = _core.Flywheels(*arguments)
        phi = arguments[0]
        columns: Any = self._core.numbers()
        numbers = {name: _shaped(column, shape) for name, column in columns.items()}
        super().__init__(
            inertia=numbers["inertia"],
            speed0=numbers["speed0"],
            motor_moment=numbers["motor_moment"],
            extremes=(
                Extreme(numbers["greatest"], numbers["greatest_at"]),
                Extreme(numbers["least"], numbers["least_at"]),
            ),
            period=numbers["period"],
            mean=mean,
            turn=(float(phi[0]), float(phi[-1])),
            shape=shape,
        )

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._arguments, self.shape, self.mean)

    def _problem(self, entry: tuple[int, ...]) -> str | None:
        flat = int(np.ravel_multi_index(entry, self.shape)) if self.shape else 0
        return self._core.problem(flat)

    def _curve(self, what: Curve, x: Float) -> Number:
        shape = self.shape + x.shape
        flat = np.ascontiguousarray(np.broadcast_to(x, shape)).ravel()
        return _shaped(self._core.curve(what, flat), shape)


def _shaped(flat: Float, shape: tuple[int, ...]) -> Number:
    flat = flat.reshape(shape)
    flat.flags.writeable = False
    return as_number(flat if shape else float(flat))


@overload
def from_table(
    phi: npt.ArrayLike,
    moment: npt.ArrayLike,
    inertia: npt.ArrayLike,
    *,
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
    *,
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
        Coordinates of the driver over one period, rad, ascending, both ends included: (K,). One
        given twice is a jump of the moment, from its first value (before) to its second.
    moment : array_like
        Reduced moment of the loads there, N·m, the last row equal to the first: (K,), or S + (K,)
        for a batch of tables. A table with jumps may have one at its ends too: they may differ.
    inertia : array_like
        Reduced inertia of the machine without the flywheel, kg·m²: of the same shape, or one number
        for all rows. It does not jump. It may be 0, the default: all inertia is then the
        flywheel's.
    fluctuation : array_like
        Required coefficient of speed fluctuation δ, of shape S or a number.
    mean_speed : array_like
        Required mean speed, rad/s, of shape S or a number.
    mean : {"extremes", "period"}
        Definition of the mean speed, by which δ is divided: half the sum of the greatest and the
        least speed, or the period divided by its time.
    spline : {"not-a-knot", "pchip", "natural", "clamped", "periodic", "linear"}
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
    MotionError
        No finite flywheel gives the fluctuation.

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
    >>> print(f"{f.motor_moment:.3f} N·m, {f.max.value:.4f} rad/s at {f.max.q:.5f} rad")
    184.035 N·m, 15.9375 rad/s at 0.70933 rad

    A turning-moment diagram alone, for an engine whose parts are light against its flywheel:

    >>> phi = np.linspace(0.0, 2 * np.pi, 721)
    >>> moment = 20e3 + 9.5e3 * np.sin(2 * phi) - 5.7e3 * np.cos(2 * phi)
    >>> f = flywheel.from_table(phi, moment, fluctuation=0.01, mean_speed=6 * np.pi)
    >>> round(f.inertia, 3)
    3118.106

    A punch that takes 700 N·m within the first radian:

    >>> phi, moment = [0.0, 1.0, 1.0, 2 * np.pi], [-700.0, -700.0, 0.0, 0.0]
    >>> f = flywheel.from_table(phi, moment, fluctuation=0.1, mean_speed=20.0, spline="linear")
    >>> round(f.inertia, 6)
    14.714788
    """
    if fluctuation is None or mean_speed is None:
        missing = "fluctuation" if fluctuation is None else "mean_speed"
        message = f"{missing} is missing: both fluctuation and mean_speed are needed"
        raise InputError(message)
    asked = (fluctuation, "fluctuation"), (mean_speed, "mean_speed")
    return tabulated_flywheel(
        phi, moment, inertia, spline, "fluctuation", asked, mean, on_error, threads
    )


def evaluate(
    phi: npt.ArrayLike,
    moment: npt.ArrayLike,
    inertia: npt.ArrayLike,
    *,
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
        See `from_table`; also neither or both speeds given, no positive inertia, or an infinite
        energy.
    MotionError
        A speed at which the machine stalls within the period, or no motion with the mean speed.

    Examples
    --------
    >>> from assur import flywheel
    >>> import numpy as np
    >>> phi = np.linspace(0.0, 2 * np.pi, 49)
    >>> f = flywheel.evaluate(
    ...     phi, 100 * np.sin(phi), np.full(49, 2.0), flywheel=8.0, mean_speed=10.0
    ... )
    >>> round(f.delta, 4)
    0.2
    """
    if (speed0 is None) == (mean_speed is None):
        message = "one of speed0 and mean_speed is needed, not both"
        raise InputError(message)
    task: Task = "initial speed" if mean_speed is None else "mean speed"
    second = (speed0, "speed0") if mean_speed is None else (mean_speed, "mean_speed")
    asked = (flywheel, "flywheel"), second
    return tabulated_flywheel(phi, moment, inertia, spline, task, asked, mean, on_error, threads)


def tabulated_flywheel(
    phi: npt.ArrayLike,
    moment: npt.ArrayLike,
    inertia: npt.ArrayLike,
    spline: Spline,
    task: Task,
    asked: tuple[tuple[Any, str], tuple[Any, str]],
    mean: Mean,
    on_error: str,
    threads: int | None,
    corners: list[int] | None = None,
) -> Flywheel:
    """See `from_table` and `evaluate`."""
    one_of(mean, MEANS, "mean")
    one_of(spline, SPLINES, "spline")
    one_of(on_error, ("raise", "nan"), "on_error")
    x, m, i = real_array(phi, "phi"), real_array(moment, "moment"), real_array(inertia, "inertia")
    if x.ndim != 1:
        message = f"phi has the shape {x.shape}: one list of coordinates is needed"
        raise InputError(message)
    require_rows(x.size, 2, "the table")
    warn_if_degrees(float(x[-1] - x[0]))
    if i.ndim == 0:
        i = np.full(x.shape, i)
    for column, name in ((m, "moment"), (i, "inertia")):
        if column.ndim == 0 or column.shape[-1] != x.size:
            message = (
                f"{name} has the shape {column.shape}: its last axis must have the {x.size} of phi"
            )
            raise InputError(message)
    numbers = [real_array(value, name) for value, name in asked]
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
    result = TabulatedFlywheel((*arguments, checked_threads(threads), corners), shape, mean)
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
    # Rows that are not finite are refused by the core.
    if not periodic or not np.isfinite(span):
        return
    turns = span / (2.0 * np.pi)
    ratio = max(turns, 1.0 / turns) if turns > 0.0 else 1.0
    if abs(ratio - round(ratio)) > WHOLE_TURNS_RTOL * ratio:
        message = (
            f"phi covers {span:g} rad, {turns:.6g} turns: a period is usually a whole number of "
            "turns or a part of one. Is phi in degrees?"
        )
        warnings.warn(message, AssurWarning, stacklevel=4)
