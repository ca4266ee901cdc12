"""Motions of machines in time: the results of `Machine.run`."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from assur._arrays import Float, counted, real_array
from assur._other_names import renamed
from assur._summary import listed, summary
from assur._table import Column, Tabular, coordinate_columns
from assur._validate import one_of
from assur.errors import InputError, MotionError
from assur.kinematics.solve_arguments import in_radians
from assur.kinematics.table import driven_angles

if TYPE_CHECKING:
    from collections.abc import Sequence
    from os import PathLike

    from matplotlib.axes import Axes
    from typing_extensions import Self

    from assur import _core
    from assur._arrays import Number
    from assur.events import Event
    from assur.kinematics.mechanism import Mechanism

__all__ = ["Energy", "EventRecord", "NearChangePoint", "Run", "State", "Statistics"]


# `Run.at` accepts points this many ulps beyond an end: sums of steps are off by as much.
END_ULPS = 4.0


class State(NamedTuple):
    """The motion at one or more times: time, coordinate, speed and acceleration of the driver.

    Attributes
    ----------
    t : float or ndarray
        Time, s.
    q, speed, acceleration : float or ndarray
        Of the driver, rad or m, and so on per s; with n drivers (..., n).

    Examples
    --------
    >>> import assur
    >>> machine = assur.Machine(
    ...     assur.SliderCrank(0.1, 0.4), bodies={"crank": assur.Body(inertia=0.5)}
    ... )
    >>> run = machine.run(t_end=1.0, q0=0.0, speed0=3.0)
    >>> run.at(0.5).q.round(6), run.at(0.5).speed  # rad, rad/s
    (np.float64(1.5), np.float64(3.0))
    """

    t: Float
    q: Float
    speed: Float
    acceleration: Float

    def __repr__(self) -> str:
        if np.ndim(self.t):
            return f"<State at {np.size(self.t)} times>"
        values = (f"{name}={_short_number(x)}" for name, x in self._asdict().items())
        return f"<State {', '.join(values)}>"


def _short_number(x: Any) -> str:
    return f"{x:.6g}" if np.ndim(x) == 0 else "(" + ", ".join(f"{number:.6g}" for number in x) + ")"


class NearChangePoint(str):
    """The event "near_change_point": a run reached a dyad that almost folds.

    The lengths of the dyad miss a change point by so little that the motion turns too sharply to
    be integrated. Draw the change point exactly, or choose lengths clear of it.

    Attributes
    ----------
    dyad : str
        The dyad, by its inner joint or slide.
    miss : float
        Distance by which its lengths miss the change point, m.
    q : float
        Coordinate of the driver at which the dyad is closest to folding.

    Examples
    --------
    This rocker is 1e-10 m too long for a change point at half a turn:

    >>> import assur
    >>> linkage = assur.FourBar(1.0, 3.0, 2.0 + 1e-10, 4.0)
    >>> machine = assur.Machine(linkage, bodies={"rocker": assur.Body(inertia=1.0)})
    >>> run = machine.run(q_end=4.0, q0=1.0, speed0=1.0)
    >>> run.end, run.events[-1].event.dyad, f"{run.events[-1].event.miss:.1e} m"
    ('near_change_point', 'C', '1.0e-10 m')
    """

    dyad: str
    miss: float
    q: float

    def __new__(cls, dyad: str, miss: float, q: float) -> Self:
        """Make the event of a dyad whose lengths miss by `miss` at `q`."""
        event = super().__new__(cls, "near_change_point")
        event.dyad, event.miss, event.q = dyad, miss, q
        return event


class EventRecord(NamedTuple):
    """An event of a run.

    Attributes
    ----------
    event : object
        The event as passed to `Machine.run`; "stick" where friction (or loads with ``while_``)
        stops a machine, "slip" where it no longer holds it; or "dead point", "rest" or
        "near_change_point" (`NearChangePoint`) if the mechanism itself ended the run.
    t, q, speed
        Time, s, and the driver's coordinate and speed.

    Examples
    --------
    >>> import assur
    >>> machine = assur.Machine(
    ...     assur.SliderCrank(0.1, 0.4), bodies={"crank": assur.Body(inertia=0.5)}
    ... )
    >>> run = machine.run(t_end=1.0, q0=0.0, speed0=3.0, events=[assur.events.Position(1.5)])
    >>> event = run.events[0]
    >>> event.event, round(event.t, 6), event.speed
    (Position(q=1.5, stop=True, driver=0, direction='either'), 0.5, 3.0)
    """

    event: Event | NearChangePoint | str
    t: float
    q: Number
    speed: Number

    def __repr__(self) -> str:
        return summary(self)


class Events(list[EventRecord]):
    """The events of a run, printed shortly where they are many."""

    __repr__ = listed


class Energy(NamedTuple):
    """Energies at the ends of the steps, J.

    Attributes
    ----------
    kinetic, potential : ndarray
        Of the bodies, rotors included; of weights, springs and closed gases.
    work : ndarray
        Work since the start of all other loads, of motors and dampers.
    balance : ndarray
        kinetic + potential − work, minus its initial value: 0 but for integration errors.

    Examples
    --------
    >>> import assur
    >>> machine = assur.Machine(
    ...     assur.SliderCrank(0.1, 0.4), bodies={"crank": assur.Body(inertia=0.5)}
    ... )
    >>> energy = machine.run(t_end=1.0, q0=0.0, speed0=3.0).energy
    >>> energy.kinetic[-1].round(6), bool(abs(energy.balance).max() < 1e-12)  # J
    (np.float64(2.25), True)
    """

    kinetic: Float
    potential: Float
    work: Float
    balance: Float

    def __repr__(self) -> str:
        return summary(self)

    @property
    def error(self) -> float:
        """Greatest imbalance, relative to the greatest kinetic energy (or change of the others)."""
        size = self._size()
        worst = float(np.nanmax(np.abs(self.balance)))
        return worst / size if size > 0.0 else worst

    def _size(self) -> float:
        changes = [self.kinetic, self.potential - self.potential[:1], self.work]
        return max(float(np.nanmax(np.abs(change))) for change in changes)


def energies_are_infinite(t: float) -> MotionError:
    """Return the error of a run whose energies are infinite at a time."""
    message = (
        f"energies of the run are infinite at t = {t:g} s: its speeds, masses or loads are too "
        "great"
    )
    return MotionError(message, kind="not_finite", t=t)


class Statistics(NamedTuple):
    """The computing effort of a run.

    Attributes
    ----------
    steps, rejected : int
        Accepted and rejected steps.
    evaluations : int
        Evaluations of the equation of motion.
    restarts : int
        Restarts at knots of tables, breaks and corners.
    smallest_step, largest_step : float or None
        Step sizes, s (over q: rad or m).

    Examples
    --------
    >>> import assur
    >>> machine = assur.Machine(
    ...     assur.SliderCrank(0.1, 0.4), bodies={"crank": assur.Body(inertia=0.5)}
    ... )
    >>> statistics = machine.run(t_end=1.0, q0=0.0, speed0=3.0).statistics
    >>> statistics.steps > 0, statistics.rejected, statistics.restarts
    (True, 0, 0)
    """

    steps: int
    rejected: int
    evaluations: int
    restarts: int
    smallest_step: float | None
    largest_step: float | None

    def __repr__(self) -> str:
        return summary(self)


class Run(Tabular):
    """A motion of a machine.

    Made by `Machine.run`. Arrays have one row per step: (N,), with several drivers (N, n).

    Attributes
    ----------
    t : ndarray
        Times at the ends of the steps, s.
    q, speed, acceleration : ndarray
        Coordinate, speed and acceleration of the driver at these times. Where the acceleration
        jumps (a load, friction that reverses, a stop) it is that before the jump; in the first row
        that after it.
    events : list of EventRecord
        The events detected, in order.
    end : str
        Why it ended: "reached", "event", "rest", "dead point", "near_change_point", "zero length"
        (of a cylinder), "locked", "lost", "table ends", "stalled", "step limit" or "time limit".
    statistics : Statistics
        Computing effort.

    Examples
    --------
    >>> import assur
    >>> wheel = assur.FourBar(1.0, 3.0, 3.0, 3.0)
    >>> bodies = {"crank": assur.Body(inertia=0.3), "rocker": assur.Body(inertia=2.0)}
    >>> run = assur.Machine(wheel, bodies=bodies).run(t_end=10.0, q0=0.0, speed0=2.0)
    >>> run.at(10.0).q.round(6)
    np.float64(26.665873)
    >>> run.energy.error < 1e-9
    True
    """

    def __init__(
        self,
        core: _core.Run,
        mechanism: Mechanism | None,
        drivers: int,
        events: list[Any],
        along_q: bool,
        tables: tuple[str, ...] = (),
    ) -> None:
        self._init_args = core, mechanism, drivers, events, along_q, tables
        self._core, self.along_q, self._drivers = core, along_q, drivers
        self._tables = tables
        self.mechanism = mechanism
        self.t, *arrays = core.arrays()
        for array in (self.t, *arrays):
            array.flags.writeable = False
        self.q, self.speed, self.acceleration = (self._shaped(column) for column in arrays[:3])
        self._energies = arrays[3:]
        self.statistics = Statistics(**core.statistics)
        self.events: list[EventRecord] = Events(
            EventRecord(
                events[record["event"]],
                record["t"],
                self._per_driver(record["q"]),
                self._per_driver(record["speed"]),
            )
            for record in core.events
        )
        self._ending = core.ending
        self.end: str = self._ending["kind"]
        if self.end in ("dead point", "rest", "near_change_point"):
            near = self._ending["near_change_point"]
            event = self.end if near is None else NearChangePoint(**near)
            self.events.append(EventRecord(event, float(self.t[-1]), self.q[-1], self.speed[-1]))

    def __reduce__(self) -> tuple[Any, ...]:
        return Run, self._init_args

    def __repr__(self) -> str:
        return (
            f"<assur.Run t = {self.t[0]:g} … {self.t[-1]:g} s, "
            f"{counted(self.statistics.steps, 'step')}, "
            f"{counted(len(self.events), 'event')}, {self.end}{self._rest()}>"
        )

    @cached_property
    def at_rest_from(self) -> float | None:
        """The time from which the machine stands still until the end, s, or None.

        Friction holds it, or it is in balance. None if it moves to the end, or only comes to rest
        there.
        """
        # What rests has no acceleration either, to the last bit.
        moves = np.reshape((self.speed != 0.0) | (self.acceleration != 0.0), (len(self.t), -1))
        moving = np.flatnonzero(moves.any(axis=1))
        # It comes to rest at the end of a step, which still has an acceleration.
        first = int(moving[-1]) if moving.size else 0
        return float(self.t[first]) if first < len(self.t) - 1 else None

    def _rest(self) -> str:
        start = self.at_rest_from
        return "" if start is None else f", stands still from t = {start:g} s on"

    def at(
        self,
        t: npt.ArrayLike | None = None,
        *,
        q: npt.ArrayLike | None = None,
        deg: npt.ArrayLike | None = None,
    ) -> State:
        """Return the motion at any time within the run.

        Parameters
        ----------
        t : array_like
            Times, s: a number or an array.
        q : array_like
            Coordinates instead of times, for a run over q (`q_end`).
        deg : array_like, optional
            The coordinates in degrees, in place of `q`.

        Returns
        -------
        State
            t, q, speed and acceleration, of the shape of t (with n drivers (..., n)). Acceleration
            comes from the dense output: within a step it is less accurate than the speed.

        Raises
        ------
        InputError
            A time (or coordinate) outside the run; the run may have ended early.

        Examples
        --------
        >>> import assur
        >>> machine = assur.Machine(
        ...     assur.SliderCrank(0.1, 0.4),
        ...     bodies={"crank": assur.Body(inertia=0.5)},
        ...     loads=[assur.Torque("crank", 2.0)],
        ... )
        >>> run = machine.run(t_end=1.0, q0=0.0)
        >>> run.at([0.5, 1.0]).speed.round(6)  # rad/s: 4 rad/s² for t
        array([2., 4.])
        """
        if deg is not None:
            q = in_radians(self.mechanism, q, deg, "at")
        coordinate, unused, name = (q, t, "q") if self.along_q else (t, q, "t")
        if coordinate is None or unused is not None:
            message = f"this run goes along {name}: call at({name}=...)"
            raise InputError(message)
        x = self._clip_to_run(real_array(coordinate, name), name)
        arrays = self._core.at(x.ravel())
        tail = () if self._drivers == 1 else (self._drivers,)
        return State(
            arrays[0].reshape(x.shape)[()],
            *(array.reshape((*x.shape, *tail))[()] for array in arrays[1:4]),
        )

    def _clip_to_run(self, x: Float, name: str) -> Float:
        """Raise InputError outside the run; a few ulps beyond an end count as the end."""
        first, last = (float(end) for end in (self.q if self.along_q else self.t)[[0, -1]])
        low, high = min(first, last), max(first, last)
        slack = END_ULPS * np.finfo(np.float64).eps * max(abs(low), abs(high))
        # Written so that NaN counts as outside.
        outside = ~((x >= low - slack) & (x <= high + slack))
        if outside.any():
            value = float(x[outside].flat[0])
            unit = " s" if name == "t" else ""
            early = "" if self.end == "reached" else f": {self.message}"
            message = (
                f"{name} = {value!r}{unit} is outside the run: it goes from {name} = {first!r} "
                f"to {last!r}{unit}{early}"
            )
            raise InputError(message, value=value)
        return np.clip(x, low, high)

    @cached_property
    def energy(self) -> Energy:
        """Kinetic and potential energy, work and their balance at the ends of the steps, J.

        Raises MotionError if one of them is infinite.
        """
        work, kinetic, potential = self._energies
        with np.errstate(over="ignore", invalid="ignore"):
            total = kinetic + potential - work
        infinite = np.isinf([kinetic, potential, work, total]).any(axis=0)
        if infinite.any():
            raise energies_are_infinite(float(self.t[np.argmax(infinite)]))
        return Energy(kinetic, potential, work, total - total[0])

    def _columns(self, degrees: bool) -> list[Column]:
        """Return the ends of the steps: time, coordinates, speeds, energies."""
        angles = driven_angles(self.mechanism) if self.mechanism else [True] * self._drivers
        columns = [
            Column("t", self.t, "s", None),
            *coordinate_columns(self.q, angles, self.t.shape, degrees),
        ]
        for k, is_angle in enumerate(angles):
            tail, unit = f"{k}" if len(angles) > 1 else "", "rad" if is_angle else "m"
            speed, acceleration = (
                values_of[:, k] if len(angles) > 1 else values_of
                for values_of in (self.speed, self.acceleration)
            )
            columns.append(Column(f"speed{tail}", speed, f"{unit}/s", "motion"))
            columns.append(Column(f"acceleration{tail}", acceleration, f"{unit}/s2", "motion"))
        for name, values in self.energy._asdict().items():
            columns.append(Column(name, values, "J", "energy"))
        return columns

    def plot(self, what: str = "speed", *, ax: Axes | None = None, dark: bool = False) -> Axes:
        """Draw a quantity over time, with the events (needs matplotlib).

        Parameters
        ----------
        what : {"speed", "q", "acceleration", "energy"}
            The quantity of every driver; or the energies with their sum, which is constant.
        ax : matplotlib axes, optional
            Axes to draw on; new ones by default.
        dark : bool
            Colours for a dark canvas.

        Returns
        -------
        matplotlib axes
            The axes drawn on.

        Examples
        --------
        >>> import assur
        >>> machine = assur.Machine(
        ...     assur.SliderCrank(0.1, 0.4), bodies={"crank": assur.Body(inertia=0.5)}
        ... )
        >>> axes = machine.run(t_end=1.0, q0=0.0, speed0=3.0).plot("q")
        >>> axes.get_xlabel(), axes.get_title(loc="left")
        ('t, s', 'Coordinate, rad')
        """
        from assur.pictures.diagrams.run import run_picture

        one_of(what, ("speed", "q", "acceleration", "energy"), "what")
        return run_picture(self, what, ax, dark)

    @renamed(paths="joint")
    def to_html(
        self,
        path: str | PathLike[str],
        *,
        joint: str | Sequence[str] | None = None,
        diagrams: Sequence[str] | None = None,
        title: str | None = None,
        dark: bool | None = None,
    ) -> None:
        """Write one self-contained page that plays the run in a browser, as it goes in time.

        Parameters
        ----------
        path : path-like
            The file; one that exists is replaced.
        joint, diagrams, title, dark
            As for `Mechanism.to_html`.

        Raises
        ------
        InputError
            A machine of tables, a run without duration, an unknown name, a file that cannot be
            written.

        Examples
        --------
        >>> import assur, pathlib, tempfile
        >>> wheel = assur.FourBar(1.0, 3.0, 3.0, 3.0)
        >>> bodies = {"crank": assur.Body(inertia=0.3), "rocker": assur.Body(inertia=2.0)}
        >>> run = assur.Machine(wheel, bodies=bodies).run(t_end=5.0, q0=0.5, speed0=2.0)
        >>> page = pathlib.Path(tempfile.mkdtemp()) / "run.html"
        >>> run.to_html(page, joint="C")
        >>> page.read_text(encoding="utf-8")[:15]
        '<!doctype html>'
        """
        from assur.pictures.page.html import write_page
        from assur.pictures.page.turn_in_time import turn_of_run

        turn = turn_of_run(self)
        write_page(turn, path, joint=joint, diagrams=diagrams, title=title, dark=dark)

    def _repr_html_(self) -> str | None:
        """Return what a notebook shows; None for a machine of tables."""
        from assur.pictures.page.html import notebook_html
        from assur.pictures.page.turn_in_time import turn_of_run

        try:
            return notebook_html(turn_of_run(self))
        except InputError:
            return None

    def _shaped(self, array: Float) -> Float:
        return array if self._drivers == 1 else array.reshape(-1, self._drivers)

    def _per_driver(self, numbers: list[float]) -> Any:
        return numbers[0] if self._drivers == 1 else np.array(numbers)

    @cached_property
    def message(self) -> str:
        """Why the run ended, as a sentence."""
        ending = self._ending
        kind, which, near = ending["kind"], ending["event"], ending["near_change_point"]
        place = f"t = {self.t[-1]:.9g} s, q = {self.q[-1]}"
        if near is not None:
            return (
                f"nearly a change point of dyad {near['dyad']!r} at {place}: near q = "
                f"{near['q']:.9g} its lengths miss one by {near['miss']:.1e} m, and the motion "
                "turns within less than can be integrated; draw the change point exactly, or "
                "lengths clear of it"
            )
        event = None if which is None else self._init_args[3][which]
        index = ending["table"]
        table = "a table" if index is None or index >= len(self._tables) else self._tables[index]
        sentences = {
            "reached": f"reached its end{self._rest()}",
            "event": f"{event} at {place}",
            "dead point": f"a dead point at {place}: this assembly has no motion beyond it; "
            "another driver (with_driver) may lead past it",
            "zero length": f"the length of {ending['slide']!r} goes to 0 at {place}: it turns "
            "round there within less than can be integrated",
            "locked": f"friction locks the machine at {place}: no acceleration agrees with it",
            "lost": f"the branch cannot be tracked beyond {place}: {ending['why']}",
            "rest": f"the machine came to rest at {place}",
            "table ends": f"{table} ends at {place}",
            "motor table ends": f"the motor's table ends at {place}",
            "stalled": f"the tolerance cannot be met with any step beyond {place}",
            "step limit": f"max_steps was reached at {place}"
            + (": the equation is stiff there" if ending["stiff"] else ""),
            "time limit": f"max_seconds was reached at {place}",
        }
        return sentences[kind]
