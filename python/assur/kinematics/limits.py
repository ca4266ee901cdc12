"""Where an assembly exists: intervals of the driver's coordinate, dead points, closing."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import zip_longest
from typing import TYPE_CHECKING, Any, TypedDict

import numpy as np

from assur._summary import summary
from assur._table import Column, Tabular, design_columns, in_degrees
from assur._validate import checked_index, checked_threads
from assur.errors import InputError
from assur.kinematics.assembly import Assembly, drawn_in
from assur.kinematics.select import designs_of
from assur.kinematics.solve_arguments import checked_assembly
from assur.kinematics.table import dimension_columns, driven_angles

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    import numpy.typing as npt

    from assur._arrays import Float
    from assur.kinematics.model import MechanismModel

__all__ = ["DeadPoint", "Limits"]

# Error of an end of an interval.
END = 1e-10


class FoundLimits(TypedDict):
    """What the core found: see `Limits`.

    `folds` are indices of `names`, −1 for none; beyond these where the length of a cylinder is 0.
    """

    count: int
    intervals: Float
    folds: npt.NDArray[np.int32]
    period: Float
    names: list[str]


@dataclass(frozen=True, slots=True)
class DeadPoint:
    """A position beyond which the driver cannot turn an assembly.

    Attributes
    ----------
    q : float
        Coordinate of the driver, rad or m.
    group : str or None
        The dyad or group that is flat there; None where two guides become parallel.
    inner : str or None
        The joint or slide between the two links of that dyad, as in `Mechanism.assembly`; None of
        a group above class II.

    Examples
    --------
    >>> import assur
    >>> for point in assur.FourBar(3.0, 2.5, 2.0, 4.0).limits().dead_points:
    ...     print(f"{point.q:.5f} rad, {point.group} at {point.inner}")
    -1.37156 rad, II(coupler, rocker) at C
    1.37156 rad, II(coupler, rocker) at C
    """

    __repr__ = summary

    q: float
    group: str | None
    inner: str | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Limits(Tabular):
    """Where an assembly of one design, or of each of a batch, exists.

    Attributes
    ----------
    intervals : ndarray
        Intervals of q, shape S + (K, 2), rad or m; NaN where a design has fewer than K. In class
        II all within a turn (or the period of the motion), each with its middle within half of
        that of the mechanism's `q0`: the interval that `q0` is in holds `q0` itself, the others are
        next to it. With a group above class II the one that holds `q0`, in counted turns.
        (−inf, inf) where nothing ends it.
    interval : ndarray
        The one of these that holds the mechanism's `q0`, shape S + (2,); NaN where none does.
    full_rotation : bool or ndarray of bool
        Whether the driver goes round and the motion closes.
    period : int or None, or ndarray
        Turns until the motion closes; None (NaN in a batch) if it does not.

    Examples
    --------
    >>> import assur
    >>> assur.FourBar(3.0, 2.5, 2.0, 4.0).limits().intervals.round(5)
    array([[-1.37156,  1.37156]])
    >>> four_bar = assur.FourBar(1.9, 3.6, 2.4, 2.7)
    >>> below = four_bar.solve(-1.5)
    >>> joints = {name: below[name].value for name in four_bar.joints}
    >>> drawn = assur.Mechanism(joints, four_bar.links, "crank")
    >>> round(drawn.q0, 9), drawn.limits().intervals.round(5).tolist()
    (-1.5, [[-5.88567, -0.39751]])
    >>> drawn.limits().interval.round(5)
    array([-5.88567, -0.39751])
    >>> turning = assur.FourBar(1.0, 3.0, 2.5, 3.0).limits()
    >>> turning.full_rotation, turning.period
    (True, 1)
    """

    intervals: Float
    full_rotation: bool | npt.NDArray[np.bool_]
    period: int | Float | None
    _folds: npt.NDArray[np.int32]
    # What may fold: its name, and the inner pair of a dyad.
    _names: tuple[tuple[str, str | None], ...]
    # The design or batch, and which part of it these limits are of.
    _of: MechanismModel
    _entry: tuple[int, ...] = ()

    @property
    def interval(self) -> Float:
        """The interval that holds the drawing's coordinate; NaN where none does."""
        low, high = self.intervals[..., 0], self.intervals[..., 1]
        # An end is known to 1e-10.
        q0 = float(self._of.q0)
        holds: Any = (low - END <= q0) & (q0 <= high + END)
        if not self.intervals.shape[-2]:
            return np.full((*self.intervals.shape[:-2], 2), np.nan)
        which = holds.argmax(axis=-1)[..., np.newaxis, np.newaxis]
        held = np.take_along_axis(self.intervals, which, axis=-2)[..., 0, :]
        found: Float = np.where(holds.any(axis=-1)[..., np.newaxis], held, np.nan)
        return found

    def _columns(self, degrees: bool) -> list[Column]:
        """Return a row for each design: its dimensions, whether it turns fully, its interval."""
        is_angle = driven_angles(self._of)[0]
        of = designs_of(self._of, self._entry) if self._entry else self._of
        columns = [
            *design_columns(of.shape, len(of.shape)),
            *dimension_columns(of, of.shape, degrees),
        ]

        def add(name: str, values: Any, unit: str) -> None:
            columns.append(Column(name, np.reshape(values, -1), unit, "limits"))

        add("full_rotation", self.full_rotation, "")
        add("period", np.nan if self.period is None else self.period, "turns")
        add("intervals", (~np.isnan(self.intervals[..., 0])).sum(axis=-1), "")
        interval = self.interval
        if is_angle and degrees:
            interval = in_degrees(interval)
        for name, k in (("q_min", 0), ("q_max", 1)):
            add(name, interval[..., k], "m" if not is_angle else "deg" if degrees else "rad")
        return columns

    @property
    def dead_points(self) -> list[DeadPoint]:
        """Where the assembly ends, by q: a list of `DeadPoint`, nested in the shape of a batch.

        None where it ends because a cylinder has length 0: nothing folds there.
        """
        shape = self.intervals.shape[:-2]
        if shape:
            # Typed as those of one design, which limits[i] has.
            nested: list[Any] = [self[index].dead_points for index in range(shape[0])]
            return nested
        ends = zip(self.intervals.ravel().tolist(), self._folds.ravel().tolist(), strict=True)
        known = len(self._names)
        finite = sorted({(q, fold) for q, fold in ends if np.isfinite(q) and fold < known})
        return [DeadPoint(q, *(self._names[fold] if fold >= 0 else (None,))) for q, fold in finite]

    def __getitem__(self, index: int | tuple[int, ...]) -> Limits:
        """Return the limits of one design of a batch, or of some of it."""
        shape = self.intervals.shape[:-2]
        entry = index if isinstance(index, tuple) else (index,)
        if entry or isinstance(self.full_rotation, bool):
            # Fewer indices than axes choose a part of the batch.
            entry = checked_index(entry, shape[: len(entry)], "limits")
        rotation, period = np.asarray(self.full_rotation)[entry], np.asarray(self.period)[entry]
        intervals, folds = self.intervals[entry], self._folds[entry]
        if intervals.ndim == 2:
            is_row = ~np.isnan(intervals[:, 0])
            intervals, folds = intervals[is_row], folds[is_row]
            rotation, period = bool(rotation), None if np.isnan(period) else int(period)
        place = (*self._entry, *entry)
        return Limits(intervals, rotation, period, folds, self._names, self._of, place)

    def __len__(self) -> int:
        shape = self.intervals.shape[:-2]
        if not shape:
            message = "the limits of one design have no length"
            raise TypeError(message)
        return int(shape[0])

    def __bool__(self) -> bool:
        return True

    def __iter__(self) -> Iterator[Limits]:
        return (self[i] for i in range(len(self)))

    def __repr__(self) -> str:
        if self.intervals.ndim > 2:
            return f"<assur.Limits of {self.intervals.shape[:-2]} designs>"
        intervals = " ".join(f"[{low:.6g}, {high:.6g}]" for low, high in self.intervals.tolist())
        closing = {None: "does not close", 1: "closes in 1 turn"}
        turns = period_of_one(self)
        period = closing.get(turns, f"closes in {turns} turns")
        return f"<assur.Limits {intervals or 'nowhere'}, {period}>"


def period_of_one(of: Limits) -> int | None:
    """Return the period of the limits of one design."""
    assert not isinstance(of.period, np.ndarray)
    return of.period


def limits(
    mechanism: MechanismModel,
    assembly: Mapping[str, int] | None = None,
    threads: int | None = None,
) -> Limits:
    """See `Mechanism.limits`."""
    if mechanism.driver_count > 1:
        count = mechanism.driver_count
        message = f"limits() is for one driver; this mechanism has {count}: see workspace()"
        raise InputError(message)
    if isinstance(assembly, Assembly):
        drawn = drawn_in(mechanism, assembly)
        mechanism, assembly = (drawn, None) if drawn is not mechanism else (mechanism, assembly)
    signs = checked_assembly(mechanism, assembly)
    values = mechanism.values.ravel()
    answer = mechanism.core.limits(values, signs, checked_threads(threads))
    shape = (*mechanism.shape, answer["count"], 2)
    period = answer["period"].reshape(mechanism.shape)
    # Dyads in the order of their signs, then groups.
    inner = [name for name, _ in mechanism.core.assembly]
    names = tuple(zip_longest(answer["names"], inner))
    batch = Limits(
        _frozen(answer["intervals"].reshape(shape)),
        ~np.isnan(period),
        period,
        answer["folds"].reshape(shape),
        names,
        mechanism,
    )
    return batch if mechanism.shape else batch[()]


def _frozen(array: Float) -> Float:
    array.flags.writeable = False
    return array
