"""Functions given by points: over a coordinate, or torque over a motor's speed."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, fields
from functools import partial
from typing import Any

import numpy as np
import numpy.typing as npt

from assur import _core
from assur._arrays import Float, flag, not_negative, real_array, real_number
from assur._by_value import ByValue
from assur._callers import level_of_caller
from assur._summary import typed
from assur._validate import checked_name, one_of, require_rows
from assur.errors import AssurWarning, InputError
from assur.flywheel import SPLINES, Spline

__all__ = ["Table", "checked_ratio", "replace_fields"]

# Warn if a spline leaves the range of its rows by more than this multiple of the range; the points
# at which to look.
OVERSHOOT = 3.0
CHECKED_BETWEEN_ROWS = 8


def replace_fields(instance: Any, **values: Any) -> None:
    """Set checked values in a frozen dataclass under construction."""
    for name, value in values.items():
        object.__setattr__(instance, name, value)


@dataclass(frozen=True, eq=False, init=False)
class Table(ByValue):
    """Values over the (first) driver's coordinate, or over that of another link or slide.

    As a motor: torque over the motor's own speed.

    Parameters
    ----------
    q : array_like
        Coordinates, ascending, rad or m; for a motor its speeds, rad/s. A coordinate given twice is
        a jump, from its first value (before) to its second (from there on): a separate curve goes
        through the rows on each side, and integration restarts there. Stored as a read-only copy.
    value : array_like
        Values there, of the same length.
    spline : {"pchip", "linear", "not-a-knot", "natural", "clamped", "periodic"}
        Interpolation between the rows. By default a smooth curve that never goes beyond its two
        neighbouring rows, and is monotone where they are; ``"linear"`` joins them by straight
        lines; the others are cubic splines, also smooth in their second derivative, which swing
        beyond rows with corners.
    periodic : bool, optional
        Whether the rows are one period, the last equal to the first: the default over q. Then the
        first coordinate or the last may be given twice, for a jump there. Otherwise, by default
        with `over`, the table has no value beyond its rows. Ignored for a motor, whose table is not
        periodic.
    ratio : float
        For a motor: its speed divided by that of the driver.
    rotor_inertia : float
        For a motor: moment of inertia of its rotor, kg·m².
    over : str, optional
        For a load: the slide over whose value (m), or the link over whose angle (rad), the
        coordinates are, instead of q.

    Raises
    ------
    InputError
        Fewer than two rows (three for a periodic spline), lists of different lengths, a number
        that is not finite, coordinates that do not ascend or that come three times, a jump at an
        end of a table that is not periodic, an unknown spline.

    References
    ----------
    F. N. Fritsch and R. E. Carlson, *Monotone Piecewise Cubic Interpolation*, SIAM J. Numer. Anal.
    17 (1980) 238; as SciPy's ``PchipInterpolator``, which periodic tables close smoothly.

    Examples
    --------
    A step, and a force over the stroke of a slide:

    >>> import assur
    >>> q = [0.0, 2.0, 2.0, 3.0, 3.0, 6.0]
    >>> work = assur.Table(q, [0.0, 0.0, 90.0, 90.0, 0.0, 0.0], spline="linear")
    >>> work.at([1.0, 2.0, 2.5, 3.0])
    array([ 0., 90., 90.,  0.])
    >>> cut = assur.Table([0.3, 0.5], [0.0, -900.0], spline="linear", over="bore")
    >>> cut.over, cut.periodic
    ('bore', False)

    A press's force, which the curve does not exceed:

    >>> force = assur.Table([0.0, 4.0, 5.0, 5.5, 6.0, 6.28], [0.0, 0.0, 5e5, 1e6, 0.0, 0.0])
    >>> float(force.at([1.0, 5.4, 5.5, 5.6]).max())
    1000000.0
    """

    __repr__ = typed

    q: Float
    value: Float
    spline: Spline
    periodic: bool
    ratio: float
    rotor_inertia: float
    over: str | None

    def __init__(
        self,
        q: npt.ArrayLike,
        value: npt.ArrayLike,
        *,
        spline: Spline = "pchip",
        periodic: bool | None = None,
        ratio: float = 1.0,
        rotor_inertia: float = 0.0,
        over: str | None = None,
    ) -> None:
        one_of(spline, SPLINES, "Table spline")
        x, y = real_array(q, "Table q"), real_array(value, "Table value")
        coordinate = None if over is None else checked_name(over, "Table over")
        repeats = coordinate is None if periodic is None else flag(periodic, "Table periodic")
        _check_rows(x, y, 3 if spline == "periodic" else 2)
        _check_jumps(x, spline, repeats)
        for column in (x, y):
            column.flags.writeable = False
        replace_fields(
            self,
            q=x,
            value=y,
            spline=spline,
            periodic=repeats,
            ratio=checked_ratio(ratio, "Table: ratio"),
            rotor_inertia=not_negative(rotor_inertia, "Table: rotor_inertia"),
            over=coordinate,
        )
        _warn_of_overshoot(self)

    def at(self, x: npt.ArrayLike) -> Float:
        """Return the value at coordinates, of their shape; at a jump the value behind it.

        Parameters
        ----------
        x : array_like
            Coordinates, rad or m.

        Returns
        -------
        float or ndarray
            NaN beyond a table that is not periodic.

        Raises
        ------
        InputError
            A periodic table whose last value is not its first.

        Examples
        --------
        >>> import assur
        >>> table = assur.Table([0.0, 1.0, 1.0, 2.0], [0.0, 4.0, 6.0, 0.0], spline="linear")
        >>> table.at([0.5, 1.0, 2.5])
        array([2., 6., 2.])
        """
        points = real_array(x, "x")
        values: Float = _core.table_values(self, points.ravel()).reshape(points.shape)
        found: Float = values[()]
        return found

    @property
    def _jumps(self) -> Float:
        jumps: Float = self.q[1:][np.diff(self.q) == 0.0]
        return jumps

    def __reduce__(self) -> tuple[Any, ...]:
        # Through the constructor, so that a copy is checked and read-only too.
        options = {field.name: getattr(self, field.name) for field in fields(self)}
        rows = options.pop("q"), options.pop("value")
        return partial(type(self), **options), rows


def _check_rows(q: Float, value: Float, least: int) -> None:
    if q.ndim != 1 or q.shape != value.shape:
        message = f"Table: q has the shape {q.shape}, value {value.shape}: two lists are needed"
        raise InputError(message)
    require_rows(q.size, least, "Table: it")
    for name, column in (("q", q), ("value", value)):
        bad = np.flatnonzero(~np.isfinite(column))
        if bad.size:
            wrong = float(column[bad[0]])
            message = f"Table: {name}[{bad[0]}] is {wrong}, it must be finite"
            raise InputError(message, kind="not_finite", value=wrong)
    with np.errstate(over="ignore"):
        is_too_wide = not np.isfinite(q[-1] - q[0])
    if is_too_wide:
        message = f"Table: q from {q[0]!s} to {q[-1]!s} is wider than the greatest number"
        raise InputError(message, value=float(q[-1]))
    back = np.flatnonzero(np.diff(q) < 0.0)
    if back.size:
        row = int(back[0]) + 1
        message = (
            f"Table: q[{row}] = {q[row]!s} is below q[{row - 1}] = {q[row - 1]!s}: coordinates "
            "must ascend (one given twice is a jump)"
        )
        raise InputError(message, kind="not_increasing", q=float(q[row]), value=float(q[row]))


def _check_jumps(q: Float, spline: str, periodic: bool) -> None:
    steps = np.diff(q)
    thrice = np.flatnonzero((steps[1:] == 0.0) & (steps[:-1] == 0.0))
    if thrice.size:
        at = float(q[thrice[0]])
        message = (
            f"Table: q = {at!s} comes three times: two rows there are a jump, from the value "
            "before to the one behind"
        )
        raise InputError(message, kind="tripled", q=at, value=at)
    jumps = q[1:][steps == 0.0]
    if not jumps.size:
        return
    at = float(jumps[0])
    require_rows(q.size - jumps.size, 2, "Table: between jumps it")
    ends = [float(jump) for jump in jumps if jump in (q[0], q[-1])]
    if ends and not periodic:
        message = (
            f"Table: it jumps at its end, q = {ends[0]!s}, and is not periodic: nothing is beyond; "
            "leave one of the two rows out"
        )
        raise InputError(message, kind="jump_at_end", q=ends[0], value=ends[0])
    if spline == "periodic":
        message = (
            f'Table: it jumps at q = {at!s}: spline="periodic" is one curve without jumps; choose '
            '"pchip", "linear", "not-a-knot", "natural" or "clamped"'
        )
        raise InputError(message, kind="periodic_jump", q=at, value=at)


def checked_ratio(value: Any, what: str) -> float:
    """Return the ratio of a motor's speed to its driver's; not 0."""
    ratio = real_number(value, what)
    if ratio == 0.0:
        message = f"{what} is 0, the motor would not turn"
        raise InputError(message, value=ratio)
    return ratio


def _warn_of_overshoot(table: Table) -> None:
    """Warn if the curve leaves the range of its rows by far: their values are not meant then."""
    if table.spline in ("pchip", "linear") or (
        table.periodic and table.value[0] != table.value[-1]
    ):
        return
    parts = np.linspace(0.0, 1.0, CHECKED_BETWEEN_ROWS, endpoint=False)[1:]
    values = table.at((table.q[:-1, None] + np.diff(table.q)[:, None] * parts).ravel())
    if not np.isfinite(values).all():
        # Its numbers are too great to compute with: whatever reads it says so.
        return
    least, most = float(table.value.min()), float(table.value.max())
    low, high = float(values.min()), float(values.max())
    beyond = max(least - low, high - most)
    if beyond > OVERSHOOT * (most - least):
        worst = high if high - most == beyond else low
        message = (
            f"the {table.spline} spline reaches {worst:.6g} between rows of {least:g} … {most:g}: "
            'spline="pchip" stays between them'
        )
        warnings.warn(message, AssurWarning, stacklevel=level_of_caller())
