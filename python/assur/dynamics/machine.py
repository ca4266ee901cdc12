"""Machines: mechanisms with bodies, loads and motors, referred to their drivers."""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias, overload

import numpy as np
import numpy.typing as npt

from assur import _core
from assur._arrays import real_array, short
from assur._validate import checked_name, one_of
from assur.dynamics import integrate, reduce, size_flywheel
from assur.dynamics.loads import Body, checked_load
from assur.dynamics.motors import checked_motor
from assur.dynamics.options import as_list
from assur.errors import InputError
from assur.flywheel import SPLINES, warn_if_degrees

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur.dynamics.loads import Load
    from assur.dynamics.motors import Motor
    from assur.dynamics.run import Run
    from assur.dynamics.steady import SteadyState
    from assur.events import Event
    from assur.flywheel import Flywheel, Mean, Spline
    from assur.kinematics.mechanism import Mechanism

__all__ = ["Machine", "Reduced"]

Float: TypeAlias = npt.NDArray[np.float64]
OnError: TypeAlias = Literal["raise", "nan"]
Method: TypeAlias = Literal["DOP853", "RK45"]


class Reduced(NamedTuple):
    """The reduced inertia and its exact derivative.

    Attributes
    ----------
    value : ndarray
        kg·m² (driven slide: kg); for n drivers the mass matrix, (..., n, n).
    d1 : ndarray
        Its derivative by the coordinate; for n drivers (..., n, n, n), the last axis that of the
        coordinate.
    """

    value: Any
    d1: Any


class Machine:
    """A mechanism with its bodies, loads and motors.

    Parameters
    ----------
    mechanism : Mechanism
        One design, or a batch of designs (not for motions in time).
    bodies : mapping of str to Body, optional
        Masses of links, by name. Statics needs none.
    loads : sequence of Gravity, Force, Torque, Spring, TorsionSpring, Damper, TorsionDamper
        Loads; several of a kind add up.
    motor : ConstantTorque, LinearMotor, InductionMotor or Table, optional
        Motor of the driver; with several drivers a sequence, None for each without one. Its rotor
        counts as inertia; its torque is not a load.

    Raises
    ------
    InputError
        An object that is not a body, load or motor, a negative mass, or a name that the mechanism
        does not have.

    Examples
    --------
    A crank press: at 90° the piston is as fast as the crank's pin.

    >>> import assur
    >>> import numpy as np
    >>> press = assur.SliderCrank(crank=0.1, rod=0.4)
    >>> machine = assur.Machine(
    ...     press,
    ...     bodies={"piston": assur.Body(mass=20.0), "crank": assur.Body(inertia=0.5)},
    ...     loads=[assur.Force("B", (-1000.0, 0.0))],
    ... )
    >>> machine.reduced_inertia(np.pi / 2).value.round(6)
    np.float64(0.7)
    >>> machine.reduced_moment(np.pi / 2).round(6)
    np.float64(100.0)
    """

    mechanism: Mechanism | None

    def __init__(
        self,
        mechanism: Mechanism,
        bodies: Mapping[str, Body] = MappingProxyType({}),
        loads: Sequence[Load] = (),
        motor: Motor | Sequence[Motor | None] | None = None,
    ) -> None:
        _check(mechanism, bodies)
        self.mechanism = mechanism
        self.bodies = MappingProxyType(dict(bodies))
        self.loads = tuple(as_list(loads, "loads"))
        self._drivers = int(np.size(mechanism.q0))
        # With one driver, the motor itself.
        self.motor: Any = tuple(motor) if isinstance(motor, list | tuple) else motor
        if isinstance(self.motor, tuple) and len(self.motor) == 1 == self._drivers:
            self.motor = self.motor[0]
        self._rebuild_with: tuple[Any, ...] = (
            Machine,
            (mechanism, dict(bodies), self.loads, self.motor),
        )
        self._core = _core.Machine(
            mechanism._core,
            loads=[checked_load(load) for load in self.loads],
            bodies=[_body(mechanism, link, body) for link, body in self.bodies.items()],
            motors=_motors(self.motor, self._drivers),
        )
        if mechanism.driver not in mechanism.slides:
            for rows, periodic in self._core.tables:
                warn_if_degrees(rows[-1] - rows[0], periodic)

    @classmethod
    def from_table(
        cls,
        phi: npt.ArrayLike,
        moment: npt.ArrayLike,
        inertia: npt.ArrayLike = 0.0,
        motor: Motor | None = None,
        spline: Spline = "not-a-knot",
        periodic: bool = True,
    ) -> Machine:
        """Return a machine given only by its reduced moment and inertia.

        Parameters
        ----------
        phi : array_like
            Coordinates of the driver, rad, ascending, both ends of the period included: (K,).
        moment : array_like
            Reduced moment of the loads there, N·m: (K,).
        inertia : array_like
            Reduced inertia there, kg·m²: (K,), or one number; not negative. Where it is 0, a rotor
            or flywheel must add some.
        motor : ConstantTorque, LinearMotor, InductionMotor or Table, optional
            Motor of the driver.
        spline : {"not-a-knot", "natural", "clamped", "periodic", "linear"}
            Interpolation between the rows.
        periodic : bool
            Whether the table is one period; otherwise motions end where the table ends.

        Returns
        -------
        Machine
            A machine without a mechanism.

        Examples
        --------
        >>> import assur
        >>> import numpy as np
        >>> phi = np.linspace(0.0, 2 * np.pi, 25)
        >>> machine = assur.Machine.from_table(phi, -10 * np.sin(phi), np.full(25, 2.0))
        >>> machine.run(t_end=3.0, q0=0.1).energy.error < 1e-9
        True
        """
        self = cls.__new__(cls)
        self.mechanism, self.loads, self.motor = None, (), motor
        self.bodies = MappingProxyType({})
        self._drivers = 1
        x, columns = _columns(phi, moment, inertia)
        one_of(spline, SPLINES, "spline")
        warn_if_degrees(float(x[-1] - x[0]), periodic)
        table = x, columns["moment"], columns["inertia"]
        self._rebuild_with = Machine.from_table, (*table, motor, spline, periodic)
        motors = _motors(motor, 1)
        self._core = _core.Machine.from_table(
            x, columns["moment"], columns["inertia"], spline, bool(periodic), *motors
        )
        return self

    def __setattr__(self, name: str, value: object) -> None:
        # The core has copied everything: a change here would have no effect.
        if "_core" in self.__dict__:
            message = f"Machine is immutable ({name!r}): make another one"
            raise AttributeError(message)
        super().__setattr__(name, value)

    def __delattr__(self, name: str) -> None:
        message = f"Machine is immutable ({name!r}): make another one"
        raise AttributeError(message)

    def __reduce__(self) -> tuple[Any, ...]:
        return self._rebuild_with

    def __repr__(self) -> str:
        if self.mechanism is None:
            return "<assur.Machine of a table>"
        formula = self.mechanism.structure.formula
        return f"<assur.Machine {formula}, {len(self.bodies)} bodies, {len(self.loads)} loads>"

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the batch of designs; () for one design."""
        return () if self.mechanism is None else self.mechanism.shape

    def design(self, index: Any) -> Machine:
        """Return one design of a batch as a single machine."""
        if self.mechanism is None:
            message = "this machine is a table: there is no batch"
            raise InputError(message)
        return Machine(self.mechanism.design(index), self.bodies, self.loads, self.motor)

    def reduced_inertia(self, q: npt.ArrayLike, on_error: OnError = "raise") -> Reduced:
        """Return the reduced inertia Σ m (dS/dq)² + I (dθ/dq)² and its exact derivative.

        Parameters
        ----------
        q : array_like
            Coordinates, rad or m: a number, (N,) or, for a batch of shape S, S + (N,); for n
            drivers (..., n).
        on_error : {"raise", "nan"}
            Where there is no position or no analogue: raise an error, or return NaN.

        Returns
        -------
        Reduced
            `value` and `d1`, of shape S + (N,), rotors of motors included.

        Examples
        --------
        >>> import assur
        >>> wheel = assur.FourBar(1.0, 3.0, 3.0, 3.0)
        >>> machine = assur.Machine(wheel, {"rocker": assur.Body(inertia=2.0)})
        >>> value, d1 = machine.reduced_inertia([0.0, 1.0])
        >>> value.round(6)
        array([0.5     , 0.015382])
        """
        inertia, rates, _, _ = self._reduce(q, None, on_error)
        if self._drivers == 1:
            return Reduced(inertia[..., 0, 0][()], rates[..., 0, 0, 0][()])
        return Reduced(inertia, np.moveaxis(rates, -3, -1))

    def reduced_moment(
        self, q: npt.ArrayLike, speed: npt.ArrayLike = 0.0, on_error: OnError = "raise"
    ) -> Any:
        """Return the reduced moment of all loads, without the motor.

        Parameters
        ----------
        q : array_like
            Coordinates, see `reduced_inertia`.
        speed : array_like
            Speeds of the drivers, rad/s or m/s, broadcast to q; dampers and functions need them.
            (Functions of time are evaluated at t = 0.)
        on_error : {"raise", "nan"}
            See `reduced_inertia`.

        Returns
        -------
        ndarray
            N·m (driven slide: N), of shape S + (N,); for n drivers (..., n).
        """
        moment = self._reduce(q, real_array(speed, "speed"), on_error)[2]
        return moment[..., 0][()] if self._drivers == 1 else moment

    def potential(self, q: npt.ArrayLike, on_error: OnError = "raise") -> Any:
        """Return the potential energy of weights and springs, J."""
        return self._reduce(q, None, on_error)[3][()]

    @overload
    def flywheel(
        self,
        fluctuation: npt.ArrayLike,
        mean_speed: npt.ArrayLike,
        mean: Mean = ...,
        on_error: OnError = ...,
    ) -> Flywheel: ...

    @overload
    def flywheel(
        self,
        fluctuation: float,
        mean_speed: None = None,
        mean: Mean = ...,
        on_error: OnError = ...,
    ) -> SteadyState: ...

    def flywheel(
        self,
        fluctuation: npt.ArrayLike,
        mean_speed: npt.ArrayLike | None = None,
        mean: Mean = "extremes",
        on_error: OnError = "raise",
    ) -> Flywheel | SteadyState:
        """Return the flywheel that limits the speed fluctuation to a given fraction of the mean.

        Parameters
        ----------
        fluctuation : float
            Required coefficient of speed fluctuation; for a batch of shape S a number or an array
            of shape S.
        mean_speed : float, optional
            Required mean speed, rad/s. A constant motor then balances the mean moment of the
            loads, which are evaluated at the mean speed. Without it the machine's own motor sets
            the speed, and loads are evaluated at the true speed.
        mean : {"extremes", "period"}
            Definition of the mean speed (`assur.flywheel.from_table`).
        on_error : {"raise", "nan"}
            For a design of a batch without a flywheel: raise an error, or return NaN.

        Returns
        -------
        Flywheel or SteadyState
            With a mean speed a `Flywheel`, from tables refined until it changes by less than 1e-9
            of the inertia. With the machine's own motor the periodic motion, whose `inertia` is the
            flywheel's.

        Raises
        ------
        InputError
            A driver that is not an angle or does not turn fully, a motion that does not repeat
            after one turn, and all errors of `assur.flywheel.from_table` and `steady_state`.

        Warns
        -----
        AssurWarning
            A `ConstantTorque` that does not balance the loads; functions that are not smooth.

        Examples
        --------
        >>> import assur
        >>> press = assur.SliderCrank(crank=0.1, rod=0.4)
        >>> work = assur.Table([0, 5.5, 6.0, 6.283185307179586], [0, 0, 9000.0, 0], "linear")
        >>> machine = assur.Machine(
        ...     press,
        ...     bodies={"piston": assur.Body(mass=20.0), "crank": assur.Body(inertia=0.5)},
        ...     loads=[assur.Force("B", (work, 0.0))],
        ... )
        >>> machine.flywheel(fluctuation=0.05, mean_speed=20.0).delta.__round__(6)
        0.05
        """
        return size_flywheel.flywheel(self, fluctuation, mean_speed, mean, on_error)

    def run(
        self,
        t_end: float | None = None,
        q0: npt.ArrayLike | None = None,
        speed0: npt.ArrayLike = 0.0,
        *,
        q_end: float | None = None,
        t0: float = 0.0,
        rtol: float = 1e-10,
        atol: float | tuple[float, float] | None = None,
        method: Method = "DOP853",
        events: Sequence[Event] = (),
        breaks: npt.ArrayLike = (),
        max_step: float = math.inf,
        max_steps: int = 1_000_000,
        max_seconds: float | None = None,
    ) -> Run:
        """Integrate the motion under loads and motor: J q̈ + ½ J′ q̇² = M.

        Parameters
        ----------
        t_end : float
            Final time, s. Give either this or:
        q_end : float
            Final coordinate: integrates over q instead of t (one driver, not at rest). Suits
            periodic motions, because over q the knots of all tables are known beforehand.
        q0, speed0 : array_like
            Initial coordinate and speed of the driver; for n drivers (n,). The default coordinate
            is that of the drawing (for a table its first row).
        t0 : float
            Initial time, s.
        rtol : float
            Relative tolerance per step of the speed; absolute tolerance of the coordinate in rad
            (slide: times the mechanism's size).
        atol : float or (float, float), optional
            Absolute tolerances of coordinate and speed. The default for the speed is rtol / 1000
            times a typical initial speed.
        method : {"DOP853", "RK45"}
            Dormand and Prince's pair of order 8(5, 3), or that of order 5(4).
        events : sequence of events
            Events to detect (`assur.events`).
        breaks : array_like
            Times (over q: coordinates) at which functions among the loads are not smooth.
        max_step : float
            Largest step, s (over q: rad or m).
        max_steps : int
            Largest number of attempted steps.
        max_seconds : float, optional
            Limit of computing time, s.

        Returns
        -------
        Run
            The motion; it ends early at an event that stops it, at a dead point (also an event), or
            at a limit.

        Raises
        ------
        InputError
            Wrong arguments, a position without inertia, a function that does not return a number.
            Exceptions raised by functions are passed on.
        PositionError
            No valid position at q0.

        Warns
        -----
        AssurWarning
            The run ended early without an event: the tolerance cannot be met, a table ends, or a
            limit of steps or seconds is reached. Or the energy balance is off by more than 1000
            rtol (and by more than 1e-6).

        Notes
        -----
        Steps end at the knots of all tables. Functions among the loads are called with floats, once
        per evaluation; list in `breaks` where they are not smooth.

        References
        ----------
        E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I* (1993).

        Examples
        --------
        A direct-current motor starts a press:

        >>> import assur
        >>> press = assur.SliderCrank(crank=0.1, rod=0.4)
        >>> machine = assur.Machine(
        ...     press,
        ...     bodies={"piston": assur.Body(mass=20.0), "crank": assur.Body(inertia=0.5)},
        ...     motor=assur.LinearMotor(stall=50.0, no_load=15.0),
        ... )
        >>> run = machine.run(t_end=1.0, q0=0.0)
        >>> run.at(1.0).speed.round(4)
        np.float64(16.1541)
        """
        return integrate.run(
            self,
            t_end,
            q0,
            speed0,
            q_end,
            t0,
            rtol=rtol,
            atol=atol,
            method=method,
            events=events,
            breaks=breaks,
            max_step=max_step,
            max_steps=max_steps,
            max_seconds=max_seconds,
        )

    def steady_state(
        self,
        speed: float | None = None,
        *,
        turns: int = 1,
        q0: float | None = None,
        mean: Mean = "extremes",
        flywheel: float = 0.0,
        rtol: float = 1e-12,
        method: Method = "DOP853",
        breaks: npt.ArrayLike = (),
        max_steps: int = 100_000,
        max_seconds: float | None = 60.0,
    ) -> SteadyState:
        """Return the periodic motion under loads and motor, found by shooting.

        Parameters
        ----------
        speed : float, optional
            With a motor whose torque falls with the speed, a first guess (by default the motor's
            speed without load). Without a motor, or if neither motor nor loads set the speed, the
            mean speed as defined by `mean`: a constant moment that keeps it is added. Negative if
            the driver turns backward.
        turns : int
            Turns of the driver in a period.
        q0 : float, optional
            Coordinate at the start of the period, rad; that of the drawing by default.
        mean : {"extremes", "period"}
            Definition of the mean speed, for `speed` and for the δ of the result: half the sum of
            the greatest and the least speed, or the period divided by its time.
        flywheel : float
            Moment of inertia added to the driver's, kg·m².
        rtol, method, breaks, max_steps, max_seconds
            See `run`.

        Returns
        -------
        SteadyState
            One period, its δ, mean speed, power and work, and its stability.

        Raises
        ------
        InputError
            A motor that cannot carry the load or does not balance it, a mean speed so low that the
            machine would stop within the turn, a dead point, tables that do not fit the period, or
            a motion that does not repeat after the period.

        Warns
        -----
        AssurWarning
            A constant motor that is out of balance by up to 1 %: the missing moment is added.

        Notes
        -----
        Shooting integrates the square of the speed over a period, with its derivative by the
        initial value, and corrects that value by Newton steps. Of several periodic motions it
        finds the one with the highest speed below the first guess, which is stable.

        Examples
        --------
        >>> import assur
        >>> press = assur.SliderCrank(crank=0.1, rod=0.4)
        >>> machine = assur.Machine(
        ...     press,
        ...     bodies={"piston": assur.Body(mass=20.0), "crank": assur.Body(inertia=0.5)},
        ...     loads=[assur.Torque("crank", -20.0)],
        ...     motor=assur.LinearMotor(stall=50.0, no_load=15.0),
        ... )
        >>> steady = machine.steady_state(mean="period")
        >>> print(f"{steady.mean_speed:.4f} rad/s, δ = {steady.delta:.4f}, {steady.power:.3f} W")
        8.9681 rad/s, δ = 0.1755, 179.363 W
        """
        return integrate.steady_state(
            self,
            speed,
            turns,
            q0,
            None,
            mean=mean,
            flywheel=flywheel,
            rtol=rtol,
            method=method,
            breaks=breaks,
            max_steps=max_steps,
            max_seconds=max_seconds,
        )

    def _reduce(
        self, q: npt.ArrayLike, speed: npt.ArrayLike | None, on_error: str
    ) -> tuple[Float, Float, Float, Float]:
        return reduce.reduce(self, q, speed, on_error)


def _motors(motor: Any, drivers: int) -> list[Motor | None]:
    """Return a motor or None for each driver."""
    if motor is None:
        return [None] * drivers
    many = [motor] if drivers == 1 and not isinstance(motor, list | tuple) else motor
    if not isinstance(many, list | tuple) or len(many) != drivers:
        wanted = f"{drivers} drivers need a sequence of as many (None: none)"
        message = f"motor is {short(motor)}: {wanted}"
        raise InputError(message)
    return [None if one is None else checked_motor(one) for one in many]


def _check(mechanism: Any, bodies: Any) -> None:
    if not hasattr(mechanism, "q0"):
        message = f"{short(mechanism)} is no assur.Mechanism"
        raise InputError(message)
    if not isinstance(bodies, Mapping):
        message = f"bodies is {short(bodies)}: a mapping of links to assur.Body is needed"
        raise InputError(message)


def _columns(phi: Any, moment: Any, inertia: Any) -> tuple[Float, dict[str, Float]]:
    """Check a table's coordinates, moments and inertias; one inertia holds for all rows."""
    x = real_array(phi, "phi")
    columns = {"moment": real_array(moment, "moment"), "inertia": real_array(inertia, "inertia")}
    if x.ndim == 1 and columns["inertia"].ndim == 0:
        columns["inertia"] = np.full(x.shape, columns["inertia"])
    for name, column in columns.items():
        if x.ndim != 1 or x.shape != column.shape:
            message = f"phi has the shape {x.shape}, {name} {column.shape}: two lists are needed"
            raise InputError(message)
    if x.size < 2:
        message = f"the table has {x.size} rows: at least 2 are needed"
        raise InputError(message)
    row = int(np.argmin(columns["inertia"]))
    least = float(columns["inertia"][row])
    if least < 0.0:
        message = (
            f"the inertia is {least:g} kg·m² at phi = {x[row]:g} rad in the table, it must not be "
            "negative"
        )
        raise InputError(message, value=least)
    return x, columns


def _body(mechanism: Mechanism, link: Any, body: Any) -> tuple[str, Body]:
    if not isinstance(link, str):
        message = f"bodies has {short(link)}: names of links are needed"
        raise InputError(message)
    checked_name(link, "bodies")
    if not isinstance(body, Body):
        message = f"bodies[{link!r}] is {short(body)}: an assur.Body is needed"
        raise InputError(message)
    joints = mechanism.links.get(link, ())
    at = body.at
    if isinstance(at, str) and link in mechanism.links and at not in joints:
        message = f"bodies[{link!r}]: joint {at!r} is not one of its joints {', '.join(joints)}"
        raise InputError(message, joint=at, link=link)
    return link, body
