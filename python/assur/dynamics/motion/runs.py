"""Motions of a machine from many initial states or designs: what `Machine.run` of arrays gives."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, overload

import numpy as np

from assur._arrays import as_number, counted, real_array, short
from assur.dynamics.motion.run import END_ULPS, Run, State, energies_are_infinite
from assur.errors import AssurError, InputError
from assur.kinematics.solve_arguments import in_radians

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur import _core
    from assur._arrays import Float, Number
    from assur.events import Event
    from assur.kinematics.mechanism import Mechanism

__all__ = ["Runs"]

FAILED = "failed"
# `Status.NO_VALUE`.
NO_VALUE = 8


class Outcomes(NamedTuple):
    """How the runs of a batch ended, all in a row."""

    # Time, coordinates and speeds at the ends.
    ends: list[Float]
    kinds: npt.NDArray[np.str_]
    status: npt.NDArray[np.uint8]
    # The times at which energies are infinite: there is no such run. NaN elsewhere.
    infinite: Float


class Made(NamedTuple):
    """What the runs of a batch have in common."""

    core: _core.Runs
    mechanism: Mechanism | None
    drivers: int
    # Of the events, those of friction last.
    events: list[Event | str]
    along_q: bool
    tables: tuple[str, ...]
    # Where each begins: its time, or over q its coordinate.
    starts: Float
    outcomes: Outcomes
    # Whether their motions between start and end are kept.
    whole: bool


class Runs(Sequence[Run]):
    """Motions of a machine, one for each initial state or design.

    Made by `Machine.run` where it is given arrays, or designs. A sequence of `Run`, each with the
    bits that it has alone: ``runs[3]`` is the fourth, ``runs[1, 0]`` that at a place of the shape.

    Attributes
    ----------
    shape : tuple of int
        S + (E,), that of the designs and states.
    t_end : ndarray
        Time at which each ended, s: of that shape. NaN where there is no run.
    q_end, speed_end : ndarray
        Coordinate and speed of the driver there, rad or m, and per s; with n drivers S + (E, n).
    end : ndarray of str
        Why each ended, as `Run.end`; "failed" where there is no run.
    status : ndarray of uint8
        `Status.OK`, or that of the initial position where there is none; `NO_VALUE` where the
        motion has no finite value, as without inertia.

    Examples
    --------
    >>> import assur, numpy as np
    >>> machine = assur.Machine(
    ...     assur.SliderCrank(0.1, 0.4),
    ...     bodies={"crank": assur.Body(inertia=0.5)},
    ...     loads=[assur.Torque("crank", 2.0)],
    ... )
    >>> runs = machine.run(t_end=1.0, q0=0.0, speed0=[0.0, 1.0, 2.0])
    >>> runs
    <assur.Runs of shape (3,): 3 reached>
    >>> runs.speed_end.round(6), runs.at(0.5).speed.round(6)  # rad/s: 4 rad/s² for t
    (array([4., 5., 6.]), array([2., 3., 4.]))
    >>> runs[1].energy.error < 1e-9
    True
    """

    def __init__(self, made: Made, indices: npt.NDArray[np.intp]) -> None:
        self._made, self._indices = made, indices
        self.shape: tuple[int, ...] = indices.shape
        ends, kinds, status, infinite_at = made.outcomes
        infinite = ~np.isnan(infinite_at)
        if infinite.any():
            status, kinds = (
                np.where(infinite, np.uint8(NO_VALUE), status),
                np.where(infinite, FAILED, kinds),
            )
            ends = [
                np.where(infinite[:, np.newaxis], np.nan, values.reshape(len(infinite), -1))
                for values in ends
            ]
        tail = () if made.drivers == 1 else (made.drivers,)

        def chosen(values: npt.NDArray[Any], tail: tuple[int, ...] = ()) -> Any:
            picked = values.reshape(-1, *tail)[indices]
            picked.flags.writeable = False
            return picked

        self.t_end: Float = chosen(ends[0])
        self.q_end: Float = chosen(ends[1], tail)
        self.speed_end: Float = chosen(ends[2], tail)
        self.end: npt.NDArray[np.str_] = chosen(kinds)
        self.status: npt.NDArray[np.uint8] = chosen(status)

    def __reduce__(self) -> tuple[Any, ...]:
        return Runs, (self._made, self._indices)

    def __len__(self) -> int:
        return self._indices.size

    @overload
    def __getitem__(self, index: int | tuple[int, ...]) -> Run: ...
    @overload
    def __getitem__(self, index: slice) -> Runs: ...
    def __getitem__(self, index: int | tuple[int, ...] | slice) -> Run | Runs:
        """Return a run, or raise its error where there is none; of a slice all its runs."""
        if isinstance(index, slice):
            return Runs(self._made, self._indices.reshape(-1)[index])
        made, outcome = self._made, self._outcome(index)
        if isinstance(outcome, AssurError):
            raise outcome
        return Run(outcome, made.mechanism, made.drivers, made.events, made.along_q, made.tables)

    def _place(self, index: int | tuple[int, ...]) -> int:
        """Return the index of a run among those of the core."""
        axes: tuple[Any, ...] = index if isinstance(index, tuple) else (index,)
        of = self._indices if isinstance(index, tuple) else self._indices.reshape(-1)
        is_whole = all(isinstance(i, int | np.integer) and not isinstance(i, bool) for i in axes)
        if not is_whole or len(axes) != of.ndim:
            message = (
                f"runs[{short(index)}]: an index is a whole number, or one for each axis of "
                f"{self.shape}"
            )
            raise InputError(message)
        return int(of[axes])

    def __repr__(self) -> str:
        kinds, counts = np.unique(self.end, return_counts=True)
        found = ", ".join(f"{count} {kind}" for kind, count in zip(kinds, counts, strict=True))
        return f"<assur.Runs of shape {self.shape}: {found or counted(0, 'run')}>"

    def explain(self, index: int | tuple[int, ...]) -> str:
        """Return why a run ended, or why there is none, as a sentence.

        Parameters
        ----------
        index : int or tuple of int
            As in ``runs[index]``.

        Returns
        -------
        str
            `Run.message`, or that of the error.

        Raises
        ------
        InputError
            An index that is not one; IndexError where there are fewer runs.

        Examples
        --------
        >>> import assur
        >>> machine = assur.Machine(
        ...     assur.SliderCrank(0.1, 0.4), bodies={"crank": assur.Body(inertia=0.5)}
        ... )
        >>> machine.run(t_end=1.0, q0=[0.0, 1.0], speed0=3.0).explain(1)
        'reached its end'
        """
        try:
            outcome = self._outcome(index)
        except IndexError as error:
            message = f"explain({short(index)}): there is no such run in {self.shape}"
            raise InputError(message) from error
        return str(outcome) if isinstance(outcome, AssurError) else self[index].message

    def _outcome(self, index: int | tuple[int, ...]) -> _core.Run | AssurError:
        """Return a run, or why there is none."""
        flat = self._place(index)
        infinite_at = float(self._made.outcomes.infinite[flat])
        if not np.isnan(infinite_at):
            return energies_are_infinite(infinite_at)
        return self._made.core.outcome(flat)

    def at(
        self,
        t: npt.ArrayLike | None = None,
        *,
        q: npt.ArrayLike | None = None,
        deg: npt.ArrayLike | None = None,
    ) -> State:
        """Return the motions at common times.

        Parameters
        ----------
        t : array_like
            Times, s: a number or (N,), the same for all runs.
        q : array_like
            Coordinates instead of times, for runs over q (`q_end`).
        deg : array_like, optional
            The coordinates in degrees, in place of `q`.

        Returns
        -------
        State
            t, q, speed and acceleration, S + (E,) + (N,), with n drivers (…, n); NaN before the
            start of a run and beyond its end. The bits are those of `Run.at`.

        Raises
        ------
        InputError
            Times of runs over q, or of more than one axis; runs of which only the ends are kept.

        Examples
        --------
        >>> import assur
        >>> machine = assur.Machine(
        ...     assur.SliderCrank(0.1, 0.4), bodies={"crank": assur.Body(inertia=0.5)}
        ... )
        >>> stop = assur.events.Position(1.5)
        >>> runs = machine.run(t_end=1.0, q0=0.0, speed0=[1.0, 2.0], events=[stop])
        >>> runs.at([0.5, 1.0]).q.round(6)
        array([[0.5, 1. ],
               [1. , nan]])
        """
        made = self._made
        if deg is not None:
            q = in_radians(made.mechanism, q, deg, "at")
        coordinate, unused, name = (q, t, "q") if made.along_q else (t, q, "t")
        if coordinate is None or unused is not None:
            message = f"these runs go along {name}: call at({name}=...)"
            raise InputError(message)
        if not made.whole:
            message = "only the ends of these runs are kept: run with keep='all'"
            raise InputError(message)
        x = real_array(coordinate, name)
        if x.ndim > 1:
            message = f"{name} has the shape {x.shape}: a number, or (N,) is needed"
            raise InputError(message)
        flat = self._indices.ravel()
        points = _clipped(x.ravel(), made.starts[flat], self._lasts().ravel())
        arrays = made.core.at(flat.tolist(), points.ravel(), made.drivers)
        shape = (*self.shape, *x.shape)
        tail = () if made.drivers == 1 else (made.drivers,)
        return State(
            _shaped(arrays[0], shape), *(_shaped(values, (*shape, *tail)) for values in arrays[1:4])
        )

    def _lasts(self) -> Float:
        return self.q_end if self._made.along_q else self.t_end


if TYPE_CHECKING:

    class RunOrRuns(Run, Runs):  # type: ignore[misc]
        """Of one state and design a `Run`, of arrays and designs `Runs`: see `Number`."""


def _shaped(values: Float, shape: tuple[int, ...]) -> Number:
    return as_number(values.reshape(shape)[()])


def _clipped(x: Float, first: Float, last: Float) -> Float:
    """Return the points of each run, NaN outside; a few ulps beyond an end count as the end."""
    low, high = (choice(first, last)[:, np.newaxis] for choice in (np.minimum, np.maximum))
    slack = END_ULPS * np.finfo(np.float64).eps * np.maximum(np.abs(low), np.abs(high))
    inside = (x >= low - slack) & (x <= high + slack)
    return np.where(inside, np.clip(x, low, high), np.nan)
