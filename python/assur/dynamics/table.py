"""Functions given by points: over the driver's coordinate, or torque over a motor's speed."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import numpy as np
import numpy.typing as npt

from assur._arrays import Float, flag, not_negative, real_array, real_number
from assur._validate import one_of, require_rows
from assur.errors import InputError
from assur.flywheel import SPLINES, Spline

__all__ = ["Table", "checked_ratio", "replace_fields"]


def replace_fields(instance: Any, **values: Any) -> None:
    """Set checked values in a frozen dataclass under construction."""
    for name, value in values.items():
        object.__setattr__(instance, name, value)


@dataclass(frozen=True, eq=False, init=False)
class Table:
    """Values over the (first) driver's coordinate; as a motor, torque over the motor's own speed.

    Parameters
    ----------
    q : array_like
        Coordinates, ascending, rad or m; for a motor its speeds, rad/s. Stored as a read-only copy.
    value : array_like
        Values there, of the same length.
    spline : {"not-a-knot", "natural", "clamped", "periodic", "linear"}
        Interpolation between the rows.
    periodic : bool
        Whether the rows are one period, the last equal to the first (the default); otherwise the
        table has no value beyond its rows. Ignored for a motor, whose table is not periodic.
    ratio : float
        For a motor: its speed divided by that of the driver.
    rotor_inertia : float
        For a motor: moment of inertia of its rotor, kg·m².

    Raises
    ------
    InputError
        Fewer than two rows (three for a periodic spline), lists of different lengths, a number
        that is not finite, coordinates that do not ascend, an unknown spline.

    Examples
    --------
    >>> import assur
    >>> work = assur.Table([0.0, 3.0, 3.4, 6.283185307179586], [0.0, 0.0, 900.0, 0.0], "linear")
    >>> work.value
    array([  0.,   0., 900.,   0.])
    """

    q: Float
    value: Float
    spline: Spline
    periodic: bool
    ratio: float
    rotor_inertia: float

    def __init__(
        self,
        q: npt.ArrayLike,
        value: npt.ArrayLike,
        spline: Spline = "not-a-knot",
        periodic: bool = True,
        ratio: float = 1.0,
        rotor_inertia: float = 0.0,
    ) -> None:
        one_of(spline, SPLINES, "Table spline")
        x, y = real_array(q, "Table q"), real_array(value, "Table value")
        _check_rows(x, y, 3 if spline == "periodic" else 2)
        for column in (x, y):
            column.flags.writeable = False
        replace_fields(
            self,
            q=x,
            value=y,
            spline=spline,
            periodic=flag(periodic, "Table periodic"),
            ratio=checked_ratio(ratio, "Table: ratio"),
            rotor_inertia=not_negative(rotor_inertia, "Table: rotor_inertia"),
        )

    def __reduce__(self) -> tuple[Any, ...]:
        # Through the constructor, so that a copy is checked and read-only too.
        return type(self), tuple(getattr(self, one.name) for one in fields(self))


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
    back = np.flatnonzero(np.diff(q) <= 0.0)
    if back.size:
        row = int(back[0]) + 1
        message = (
            f"Table: q[{row}] = {q[row]!s} is not above q[{row - 1}] = {q[row - 1]!s}: "
            "coordinates must ascend without repeats"
        )
        raise InputError(message, kind="not_increasing", q=float(q[row]), value=float(q[row]))


def checked_ratio(value: Any, what: str) -> float:
    """Return the ratio of a motor's speed to its driver's; not 0."""
    ratio = real_number(value, what)
    if ratio == 0.0:
        message = f"{what} is 0, the motor would not turn"
        raise InputError(message, value=ratio)
    return ratio
