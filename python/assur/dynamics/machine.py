"""Machines and their motions in time: the face of the core's solvers."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Literal, TypeAlias, overload

from assur._arrays import real_number
from assur._other_names import other_names, renamed_rates
from assur._validate import checked_threads, one_of
from assur.dynamics.equations import dynamics as equations
from assur.dynamics.equations import step as steps
from assur.dynamics.equations.derivatives import derivatives, weights
from assur.dynamics.equations.linearize import linearize
from assur.dynamics.equations.step import Environments
from assur.dynamics.equations.terms import State, require_equations
from assur.dynamics.flywheel import size as flywheel_size
from assur.dynamics.forces import counterweight, duty, impact, kinetostatics
from assur.dynamics.forces import self_locking as locking
from assur.dynamics.internal import internal_loads as inside
from assur.dynamics.model import MachineModel
from assur.dynamics.motion import equilibria, integrate
from assur.dynamics.motion.discontinuities import driven_motion
from assur.dynamics.motion.motion_input import motion_of
from assur.dynamics.motion.run import Run
from assur.dynamics.motion.steady import SteadyState
from assur.dynamics.reduction import reduce
from assur.kinematics.solve_arguments import in_radians, q_or_deg

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    import numpy.typing as npt

    from assur._arrays import Float
    from assur.dynamics.equations.dynamics import Dynamics
    from assur.dynamics.equations.linearize import Linearized
    from assur.dynamics.equations.step import Stepped
    from assur.dynamics.forces.counterweight import Counterweight
    from assur.dynamics.forces.duty import Duty
    from assur.dynamics.forces.impact import Impact
    from assur.dynamics.forces.reactions import Reactions
    from assur.dynamics.forces.self_locking import SelfLocking
    from assur.dynamics.internal.internal_loads import InternalLoads
    from assur.dynamics.loads.loads import Body, Force, Torque
    from assur.dynamics.model import OnError
    from assur.dynamics.motion.equilibria import Equilibria
    from assur.dynamics.motion.motion_input import MotionLike
    from assur.dynamics.motion.runs import RunOrRuns, Runs
    from assur.dynamics.reduction.reduce import Reduced
    from assur.events import Event
    from assur.flywheel import Flywheel, Mean

__all__ = ["Machine"]

Method: TypeAlias = Literal["DOP853", "RK45"]


@other_names(
    plot="mechanism.plot(q), reactions(q, speed).plot(), run(t_end).plot()",
    mass_matrix="dynamics(q, speed).mass_matrix",
    inverse_dynamics="effort(q, speed, acceleration), or reactions for all forces",
    forward_dynamics="acceleration(q, speed, effort), run(t_end, q0, speed0)",
    simulate="run(t_end, q0, speed0)",
    torque="effort(q, speed, acceleration)",
    jacobian="dynamics(q).jacobian(joint), mechanism.solve(q).jacobian(name, by=…)",
    solve="mechanism.solve(q), or run(t_end, q0, speed0)",
    kinetic_energy="run(t_end).energy",
    driving_torque="effort(q, speed, acceleration)",
    forces="reactions(q, speed, acceleration)",
    efficiency="reactions(q, speed).efficiency, duty(q, speed).efficiency",
    power="duty(q, speed).power",
    balance="with_counterweights(weights), weights by assur.balance",
)
class Machine(MachineModel):
    """A mechanism with its bodies, loads and motors.

    Parameters
    ----------
    mechanism : Mechanism
        One design, or a batch of designs (not for motions in time).
    bodies : mapping of str to Body, optional
        Masses of links, by name. Statics needs none.
    loads : sequence of load, optional
        `Gravity`, `Force`, `Torque`, `Pressure`, `Spring`, `TorsionSpring`, `Damper`,
        `TorsionDamper`; several of a kind add up. Each function of (t, q, speed) among them is
        called once when the machine is made, at t = 0, the drawing's q and rest.
    motor : ConstantTorque, LinearMotor, InductionMotor or Table, optional
        Motor of the driver; with several drivers a sequence, None for each without one. Its rotor
        counts as inertia; its torque is not a load.
    friction : mapping of str to JointFriction or SlideFriction, optional
        Friction in joints and slides, by name. It counts in `reactions`, `effort` and what follows
        from them, and in `run` with one driver; `steady_state`, `flywheel` and `equilibria` refuse
        it.

    Raises
    ------
    InputError
        An object that is not a body, load or motor, a negative mass, a name that the mechanism does
        not have, or a function that does not take (t, q, speed) or gives no finite number.

    Warns
    -----
    AssurWarning
        A load at a joint with friction names no link, and the default is a guess: see `Force`.

    Notes
    -----
    Numbers of bodies, loads and motors may be arrays: then it is a batch of machines, each with its
    own numbers. Arrays go together with each other and with designs by NumPy's rules, to `shape`.
    `dynamics`, `acceleration`, `d_effort`, `d_acceleration`, `linearize`, `step`, `run`, `effort`,
    `reduced_inertia`, `reduced_moment` and `potential` take such batches; q is there a number, of
    that shape S (one for each machine) or S + (N,). Other calls take one machine, `design(i)`.

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

    Three presses with pistons of their own:

    >>> presses = assur.Machine(press, bodies={"piston": assur.Body(mass=[15.0, 20.0, 25.0])})
    >>> presses.shape, presses.dynamics(np.pi / 2).mass_matrix.ravel().round(3)  # kg·m²
    ((3,), array([0.15, 0.2 , 0.25]))
    """

    def reduced_inertia(
        self,
        q: npt.ArrayLike | None = None,
        *,
        on_error: OnError = "raise",
        deg: npt.ArrayLike | None = None,
    ) -> Reduced:
        """Return the reduced inertia Σ m (dS/dq)² + I (dθ/dq)² and its exact derivative.

        Parameters
        ----------
        q : array_like
            Coordinates, rad or m: a number, (N,) or, for a batch of shape S, S + (N,); for n
            drivers (..., n).
        on_error : {"raise", "nan"}
            Where there is no position or no analogue: raise an error, or return NaN.
        deg : array_like, optional
            The coordinates in degrees, in place of `q`.

        Returns
        -------
        Reduced
            `value` and `d1`, of shape S + (N,), rotors of motors included.

        Raises
        ------
        PositionError
            A position that the assembly does not reach, or without analogues.
        InputError
            Wrong arguments, or coordinates beyond a table.

        Examples
        --------
        >>> import assur
        >>> wheel = assur.FourBar(1.0, 3.0, 3.0, 3.0)
        >>> machine = assur.Machine(wheel, bodies={"rocker": assur.Body(inertia=2.0)})
        >>> value, d1 = machine.reduced_inertia([0.0, 1.0])
        >>> value.round(6)
        array([0.5     , 0.015382])
        """
        q = q_or_deg(self.mechanism, q, deg, "reduced_inertia")
        return reduce.reduced_inertia(self, q, on_error)

    @renamed_rates
    def reduced_moment(
        self,
        q: npt.ArrayLike | None = None,
        speed: npt.ArrayLike = 0.0,
        *,
        on_error: OnError = "raise",
        deg: npt.ArrayLike | None = None,
    ) -> Float:
        """Return the reduced moment of all loads, without the motor.

        Parameters
        ----------
        q : array_like
            Coordinates, see `reduced_inertia`.
        speed : array_like
            Speeds of the drivers, rad/s or m/s, broadcast to q; dampers, functions and loads with
            ``while_`` need them. (Functions of time are evaluated at t = 0.)
        on_error : {"raise", "nan"}
            See `reduced_inertia`.
        deg : array_like, optional
            The coordinates in degrees, in place of `q`.

        Returns
        -------
        ndarray
            N·m (driven slide: N), of shape S + (N,); for n drivers (..., n).

        Raises
        ------
        PositionError
            See `reduced_inertia`.
        InputError
            Wrong arguments, coordinates beyond a table, a function that gives no finite number; a
            load with ``while_`` at rest.
        MotionError
            A damper or spring of length zero, or a load too great.

        Examples
        --------
        1000 N on a piston that at π/2 moves as fast as the crank's pin, at 0.1 m:

        >>> import assur, numpy as np
        >>> force = assur.Force("B", (-1000.0, 0.0))
        >>> machine = assur.Machine(assur.SliderCrank(0.1, 0.4), loads=[force])
        >>> machine.reduced_moment([0.0, np.pi / 2]).round(6)  # N·m
        array([  0., 100.])
        """
        q = q_or_deg(self.mechanism, q, deg, "reduced_moment")
        return reduce.reduced_moment(self, q, speed, on_error)

    def potential(
        self,
        q: npt.ArrayLike | None = None,
        *,
        on_error: OnError = "raise",
        deg: npt.ArrayLike | None = None,
    ) -> Float:
        """Return the potential energy of weights, springs and closed gases.

        Parameters
        ----------
        q : array_like
            Coordinates, see `reduced_inertia`.
        on_error : {"raise", "nan"}
            See `reduced_inertia`.
        deg : array_like, optional
            The coordinates in degrees, in place of `q`.

        Returns
        -------
        ndarray
            J, of shape S + (N,). A weight has −m g·r, r from the drawing's origin; a spring
            k e²/2 + preload · e, e its elongation (or twist) from the free length (or angle); a
            `Gas` in a `Pressure` without ``while_`` −∫ (p − p_ambient) dV from its `at`. Other
            loads have none here, constant forces and torques included; so `reduced_moment` is
            −dV/dq if there are only such weights, springs and gases.

        Raises
        ------
        PositionError
            See `reduced_inertia`.
        InputError
            Wrong arguments, or coordinates beyond a table.

        See Also
        --------
        Machine.equilibria : positions of rest, where this is extreme (constant loads count too).

        Examples
        --------
        >>> import assur
        >>> press = assur.SliderCrank(crank=0.1, rod=0.4)
        >>> spring = assur.Spring("O", "B", stiffness=200.0, length=0.4)
        >>> assur.Machine(press, loads=[spring]).potential([0.0, 3.141592653589793]).round(9)
        array([1., 1.])
        """
        q = q_or_deg(self.mechanism, q, deg, "potential")
        return reduce.potential(self, q, on_error)

    @renamed_rates
    def reactions(
        self,
        q: MotionLike | None = None,
        speed: npt.ArrayLike = 0.0,
        acceleration: npt.ArrayLike = 0.0,
        *,
        t: npt.ArrayLike = 0.0,
        sense: float | Sequence[float] | None = None,
        threads: int | None = None,
        on_error: OnError = "raise",
        deg: npt.ArrayLike | None = None,
    ) -> Reactions:
        """Return the forces in all pairs, and the torque or force of the drive (kinetostatics).

        Parameters
        ----------
        q : array_like, Run, SteadyState, State or TimedMotion
            Coordinates, rad or m: a number, (N,) or, for a batch of shape S, S + (N,); for n
            drivers (..., n). Or a motion with its times, speeds and accelerations: a run or
            steady state at the ends of its steps, what its `at` returns, or what
            `Mechanism.follow` returns.
        speed, acceleration : array_like
            Of the drivers, rad/s and rad/s² (slides: m/s and m/s²), broadcast to q. Zero by
            default: statics.
        t : array_like
            Times for functions among the loads, s, broadcast to the positions.
        sense : int, optional
            +1 or −1 (one for each driver): the direction in which the drive is about to move where
            the speed is 0. Friction needs it. A run or state has its own: at the start, and where
            it leaves its rest, that of the motion that follows; where it comes to rest or turns
            back, that of the motion before, like its acceleration there. Where it stays at rest all
            forces are NaN (`Reactions.at_rest`).
        threads : int, optional
            Largest number of threads; all cores by default.
        on_error : {"raise", "nan"}
            Where there is no position or no analogue: raise an error, or return NaN.
        deg : array_like, optional
            The coordinates in degrees, in place of `q`.

        Returns
        -------
        Reactions
            Forces in joints and slides, driver, shaking force and moment. At a change point, where
            analogues exist, all are NaN (status SINGULAR): beside it forces grow beyond all
            limits. Only the torque of the drive stays finite, and `effort` gives it.

        Raises
        ------
        PositionError
            No position at some q (`on_error="nan"` gives NaN there).
        MotionError
            A load or an inertia force that is not finite.
        InputError
            Shapes that do not fit, numbers that are not finite.

        Notes
        -----
        Every Assur group is statically determinate: its pair forces follow from its loads by the
        transposed matrix of its position, the last group first (I. I. Artobolevsky, *Theory of
        Mechanisms and Machines* (1988), chapter 13). The torque of the machine's
        motor is not a load; the driver replaces it.

        Examples
        --------
        The gas force on a piston at 60°, without masses:

        >>> import assur
        >>> import numpy as np
        >>> engine = assur.Machine(
        ...     assur.SliderCrank(crank=0.1, rod=0.35),
        ...     loads=[assur.Force("B", (-800.0, 0.0), on="piston")],
        ... )
        >>> found = engine.reactions(np.radians(60))
        >>> found.driver.round(6), found.slide("bore").normal.round(4)
        (np.float64(-79.497111), np.float64(204.3016))
        >>> found.joint("B", on="piston").round(4)
        array([ 800.    , -204.3016])
        """
        q = q_or_deg(self.mechanism, q, deg, "reactions")
        motion = driven_motion(self, q, speed, acceleration, t)
        return kinetostatics.reactions(self, motion, threads, on_error, sense=sense)

    @renamed_rates
    def effort(
        self,
        q: MotionLike | None = None,
        speed: npt.ArrayLike = 0.0,
        acceleration: npt.ArrayLike = 0.0,
        *,
        t: npt.ArrayLike = 0.0,
        sense: float | Sequence[float] | None = None,
        on_error: OnError = "raise",
        deg: npt.ArrayLike | None = None,
    ) -> Float:
        """Return the torque or force of the drive, by virtual power alone.

        Parameters
        ----------
        q, speed, acceleration, t, sense
            See `reactions`. With friction the effort is that of `reactions`.
        on_error : {"raise", "nan"}
            See `reactions`.
        deg : array_like, optional
            The coordinates in degrees, in place of `q`.

        Returns
        -------
        ndarray
            N·m (driven slide: N), S + (N,); with n drivers (..., n). Equal to
            `reactions(...).driver`.

        Notes
        -----
        Lagrange's equations of the reduced machine: J q̈ + ½ J′ q̇² − M. The rotor of the machine's
        motor is not in it.

        Examples
        --------
        >>> import assur
        >>> press = assur.SliderCrank(crank=0.1, rod=0.4)
        >>> machine = assur.Machine(press, bodies={"piston": assur.Body(mass=20.0)})
        >>> machine.effort([0.5, 1.5], speed=10.0).round(4)
        array([11.9002, -3.753 ])
        """
        q = q_or_deg(self.mechanism, q, deg, "effort")
        motion = driven_motion(self, q, speed, acceleration, t)
        return kinetostatics.effort(self, motion, on_error, sense)

    @renamed_rates
    def dynamics(
        self,
        q: npt.ArrayLike | None = None,
        speed: npt.ArrayLike = 0.0,
        *,
        t: npt.ArrayLike = 0.0,
        sense: float | Sequence[float] | None = None,
        on_error: OnError = "raise",
        deg: npt.ArrayLike | None = None,
        threads: int | None = None,
    ) -> Dynamics:
        """Return mass matrix, its derivatives, bias, gravity and Jacobians in one call.

        They are the terms of ``effort = mass_matrix @ acceleration + bias``. No path is followed
        from the drawing for angles that no load reads.

        Parameters
        ----------
        q : array_like
            Coordinates of the drivers, rad or m: a number, (N,) or S + (N,); with n drivers a last
            axis of n.
        speed : array_like
            Their speeds, rad/s or m/s; broadcasts against q.
        t, sense
            See `reactions`.
        on_error : {"raise", "nan"}
            Whether a position without a value raises, or has NaN and a status.
        deg : array_like, optional
            The coordinates in degrees, in place of `q`.
        threads : int, optional
            Most threads; all cores by default.

        Returns
        -------
        Dynamics
            Arrays whose last axes are those of the drivers, also of one.

        Raises
        ------
        InputError
            A machine of a table, friction, shapes that do not fit, a load without a value.
        PositionError
            A position that cannot be reached.

        Notes
        -----
        Σ m ∂S·∂S + I ∂Θ ∂Θ, and by virtual work the loads, weights and inertia forces without
        accelerations of the drivers (Uicker, Pennock and Shigley 2017, chapters 12 and 15).

        Examples
        --------
        Two drivers of a five-bar in a control loop, with computed torque:

        >>> import assur, numpy as np
        >>> five_bar = assur.examples.five_bar()
        >>> bodies = {name: assur.Body(mass=1.0, inertia=0.02) for name in ("left", "right")}
        >>> machine = assur.Machine(five_bar, bodies=bodies, loads=[assur.Gravity()])
        >>> now = machine.dynamics(five_bar.q0, speed=[1.0, -0.5])
        >>> now.mass_matrix.shape, now.jacobian("P").shape
        ((2, 2), (2, 2))
        >>> wanted = [2.0, 0.0]
        >>> effort = now.mass_matrix @ wanted + now.bias
        >>> machine.acceleration(five_bar.q0, [1.0, -0.5], effort).round(9)
        array([2., 0.])
        """
        require_equations(self, "dynamics")
        q = q_or_deg(self.mechanism, q, deg, "dynamics")
        one_of(on_error, ("raise", "nan"), "on_error")
        return equations.Dynamics(self, State(q, speed, t=t, sense=sense), on_error, threads)

    @renamed_rates
    def acceleration(
        self,
        q: npt.ArrayLike | None = None,
        speed: npt.ArrayLike = 0.0,
        effort: npt.ArrayLike | None = None,
        *,
        t: npt.ArrayLike = 0.0,
        sense: float | Sequence[float] | None = None,
        on_error: OnError = "raise",
        deg: npt.ArrayLike | None = None,
        threads: int | None = None,
    ) -> Float:
        """Return the accelerations of the drivers under efforts: forward dynamics.

        Parameters
        ----------
        q, speed, t, sense, on_error, deg, threads
            See `dynamics`.
        effort : array_like, optional
            What the drivers give, N·m (driven slide: N); broadcasts against q. By default what the
            machine's motors give at this speed, or nothing.

        Returns
        -------
        ndarray
            rad/s² (driven slide: m/s²), S + (N,); with n drivers (..., n). With ``on_error="nan"``
            NaN where a position does not exist, or a speed or an effort is not finite.

        Raises
        ------
        InputError
            See `dynamics`; a mass matrix that is singular, as without bodies.
        PositionError
            A position that cannot be reached.

        Notes
        -----
        `M q̈ = τ − b` with the terms of `dynamics`. The rotors of the machine's motors count as
        inertia, also where efforts are given.

        Examples
        --------
        >>> import assur, numpy as np
        >>> machine = assur.Machine(
        ...     assur.SliderCrank(0.1, 0.4), bodies={"piston": assur.Body(mass=20.0)}
        ... )
        >>> machine.acceleration([0.5, 1.5], speed=10.0, effort=4.0).round(3)
        array([-115.277,   37.575])
        """
        require_equations(self, "acceleration")
        q = q_or_deg(self.mechanism, q, deg, "acceleration")
        one_of(on_error, ("raise", "nan"), "on_error")
        state = State(q, speed, effort, t, sense, is_checked=on_error == "raise")
        return equations.acceleration(self, state, on_error, threads)

    @renamed_rates
    def d_effort(
        self,
        q: npt.ArrayLike | None = None,
        speed: npt.ArrayLike = 0.0,
        acceleration: npt.ArrayLike = 0.0,
        *,
        by: str | Sequence[str] = "q",
        t: npt.ArrayLike = 0.0,
        sense: float | Sequence[float] | None = None,
        on_error: OnError = "raise",
        deg: npt.ArrayLike | None = None,
        threads: int | None = None,
    ) -> Float:
        """Return exact derivatives of the drive's torque or force.

        Parameters
        ----------
        q, speed, acceleration, t, sense, on_error, deg
            See `effort`.
        by : str or sequence of str
            ``"q"``, ``"speed"`` or ``"acceleration"``, a column for each driver; dimensions, also
            as patterns (``"*.length"``); ``"rod.mass"`` and ``"rod.inertia"`` of links. Columns
            come in this order.
        threads : int, optional
            Most threads; all cores by default.

        Returns
        -------
        ndarray
            S + (N, D); with n drivers (..., n, D).

        Raises
        ------
        InputError
            See `dynamics`; loads that are Python functions; names that do not exist.
        PositionError
            A position that cannot be reached.

        Notes
        -----
        The equations of `dynamics` in dual numbers, on derivatives of the positions of one order
        more. At jumps of loads the derivative is that of the piece that counts there.

        Examples
        --------
        How the torque of a press changes with the crank's angle and the piston's mass:

        >>> import assur
        >>> press = assur.SliderCrank(crank=0.1, rod=0.4)
        >>> machine = assur.Machine(press, bodies={"piston": assur.Body(mass=20.0)})
        >>> machine.d_effort(0.5, speed=10.0, by=["q", "piston.mass"]).round(4)
        array([10.2198,  0.595 ])
        """
        q = q_or_deg(self.mechanism, q, deg, "d_effort")
        one_of(on_error, ("raise", "nan"), "on_error")
        state = State(q, speed, t=t, sense=sense, acceleration=acceleration)
        return derivatives(self, "effort", state, by, on_error, threads, self._with_mass)

    @renamed_rates
    def d_acceleration(
        self,
        q: npt.ArrayLike | None = None,
        speed: npt.ArrayLike = 0.0,
        effort: npt.ArrayLike | None = None,
        *,
        by: str | Sequence[str] = "q",
        t: npt.ArrayLike = 0.0,
        sense: float | Sequence[float] | None = None,
        on_error: OnError = "raise",
        deg: npt.ArrayLike | None = None,
        threads: int | None = None,
    ) -> Float:
        """Return exact derivatives of the drivers' accelerations under efforts.

        Parameters
        ----------
        q, speed, effort, t, sense, on_error, deg, threads
            See `acceleration`.
        by : str or sequence of str
            ``"q"``, ``"speed"`` or ``"effort"``, a column for each driver; dimensions, also as
            patterns (``"*.length"``); ``"rod.mass"`` and ``"rod.inertia"`` of links. Columns come
            in this order.

        Returns
        -------
        ndarray
            S + (N, D); with n drivers (..., n, D).

        Raises
        ------
        InputError
            See `d_effort`.
        PositionError
            A position that cannot be reached.

        See Also
        --------
        linearize : The state equations, also of steps.

        Examples
        --------
        >>> import assur
        >>> press = assur.SliderCrank(crank=0.1, rod=0.4)
        >>> machine = assur.Machine(press, bodies={"piston": assur.Body(mass=20.0)})
        >>> machine.d_acceleration(0.5, 10.0, effort=4.0, by=["q", "effort"]).round(3)
        array([251.221,  14.592])
        """
        q = q_or_deg(self.mechanism, q, deg, "d_acceleration")
        one_of(on_error, ("raise", "nan"), "on_error")
        state = State(q, speed, effort=effort, t=t, sense=sense)
        return derivatives(self, "acceleration", state, by, on_error, threads, self._with_mass)

    def _with_mass(self, link: str, body: Body) -> Machine:
        """Return the machine that has this body alone, and the same weights."""
        assert self.mechanism is not None
        return Machine(self.mechanism, bodies={link: body}, loads=weights(self))

    @renamed_rates
    def linearize(
        self,
        q: npt.ArrayLike | None = None,
        speed: npt.ArrayLike = 0.0,
        effort: npt.ArrayLike | None = None,
        *,
        dt: float | None = None,
        n: int = 1,
        t: npt.ArrayLike = 0.0,
        sense: float | Sequence[float] | None = None,
        on_error: OnError = "raise",
        deg: npt.ArrayLike | None = None,
        threads: int | None = None,
    ) -> Linearized:
        """Return the state equations beside a state: A and B, exact.

        Parameters
        ----------
        q, speed, effort, t, sense, on_error, deg, threads
            See `acceleration`.
        dt : float, optional
            Time of a step, s: then A and B are the derivatives of what `step` returns with its
            method "rk4". Without it they are those of the rates.
        n : int
            Number of steps.

        Returns
        -------
        Linearized
            ``A, B, status`` for the states (q, speed): S + (N, 2n, 2n) and S + (N, 2n, n) of n
            drivers.

        Raises
        ------
        InputError
            See `d_effort`; a singular mass matrix; dt of 0.
        PositionError
            A position that cannot be reached.

        Notes
        -----
        Of steps each stage of the Runge-Kutta method is differentiated: A and B belong to `step`
        itself, not to the exact motion.

        Examples
        --------
        A pendulum held level; SciPy's ``solve_continuous_are`` takes A and B as they are.

        >>> import assur
        >>> arm = assur.Mechanism({"O": (0, 0), "A": (1, 0)}, {"ground": "O", "arm": "OA"}, "arm")
        >>> mass = {"arm": assur.Body(mass=2.0, at="A")}
        >>> pendulum = assur.Machine(arm, bodies=mass, loads=[assur.Gravity()])
        >>> pendulum.linearize(0.0, effort=19.62).B.T
        array([[0. , 0.5]])
        >>> pendulum.linearize(0.0, effort=19.62, dt=0.1).A.round(6)
        array([[1. , 0.1],
               [0. , 1. ]])
        """
        q = q_or_deg(self.mechanism, q, deg, "linearize")
        one_of(on_error, ("raise", "nan"), "on_error")
        state = State(q, speed, effort=effort, t=t, sense=sense)
        return linearize(self, state, (dt, n), on_error, threads)

    def step(
        self,
        q: npt.ArrayLike,
        speed: npt.ArrayLike,
        effort: npt.ArrayLike | None,
        dt: float,
        n: int = 1,
        *,
        method: Literal["rk4", "RK45", "DOP853"] = "rk4",
        rtol: float | None = None,
        atol: float | tuple[float, float] | None = None,
        on_error: Literal["nan", "hold", "raise"] = "nan",
        threads: int | None = None,
    ) -> Stepped:
        """Step environments in time: a state of the machine each, in lanes and threads.

        Parameters
        ----------
        q, speed : array_like
            Coordinates and speeds of the drivers, rad or m: a number, (E,) or S + (E,); with n
            drivers a last axis of n.
        effort : array_like or None
            What the drivers give during all these steps, N·m or N; broadcasts against q. None:
            what the machine's motors give, or nothing.
        dt : float
            Time of a step, s; negative steps go back.
        n : int
            Number of steps.
        method : {"rk4", "RK45", "DOP853"}
            The classical Runge-Kutta method of order 4, with even steps; or a pair with error
            control, as in `run`: each environment has steps of its own within the time n·dt, as
            wide as the tolerance allows. It tries dt first, and goes at most 1 rad (the size of the
            mechanism) in a step.
        rtol : float, optional
            Of the pairs, relative tolerance per step of the speed; absolute tolerance of the
            coordinate in rad (slide: times its greatest length). 1e-10 by default.
        atol : float or (float, float), optional
            Of the pairs, absolute tolerances of coordinate and speed. The default for the speed is
            rtol / 1000 times a typical speed, that at the start of the call.
        on_error : {"nan", "hold", "raise"}
            What an environment has that cannot make a step: NaN; its state before that step (of
            its own with a pair: where it is nearest to a dead point); or an error. The others go
            on.
        threads : int, optional
            Most threads; all cores by default.

        Returns
        -------
        Stepped
            ``q, speed, status`` in the shape of q. An environment has the bits that it has alone.

        Raises
        ------
        InputError
            A machine of a table, friction, loads or motors that are Python functions, shapes that
            do not fit, dt of 0, tolerances that are not positive or given to even steps.

        Notes
        -----
        Loads with `while_` do not act while their coordinate is at rest. Steps do not end where
        loads jump: `run` does. Nor does it compare energies, or look for events.

        At a dead point drivers turn back, and a mechanism goes on in another assembly. Where they
        may turn back in a step, coordinates beside its way are tried: if one does not exist, the
        step fails, and a pair tries a narrower one. Even steps do not resolve how drivers turn:
        they also fail where they turn nearer to a dead point than half the change of speed times
        dt.

        References
        ----------
        J. R. Dormand, P. J. Prince, "A family of embedded Runge-Kutta formulae", J. Comp. Appl.
        Math. 6 (1980); E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential
        Equations I* (1993).

        Examples
        --------
        >>> import assur, numpy as np
        >>> pendulum = assur.Mechanism(
        ...     joints={"O": (0, 0), "A": (0.5, 0)},
        ...     links={"ground": "O", "arm": "OA"},
        ...     driver="arm",
        ... )
        >>> mass = {"arm": assur.Body(mass=2.0, at=(0.5, 0.0))}
        >>> machine = assur.Machine(pendulum, bodies=mass, loads=[assur.Gravity()])
        >>> q, speed = np.linspace(-1.5, -0.5, 4), np.zeros(4)
        >>> for _ in range(3):
        ...     q, speed, status = machine.step(q, speed, effort=0.0, dt=0.01, n=10)
        >>> q.round(4), status.tolist()
        (array([-1.5538, -1.4683, -1.3598, -1.2089]), [0, 0, 0, 0])

        Control steps of a tenth of a second, too long for even steps, to nine digits:

        >>> q, speed, status = machine.step(q, speed, 0.0, dt=0.1, n=5, method="RK45", rtol=1e-9)
        >>> q.round(4), status.tolist()
        (array([-1.636 , -1.9483, -2.2798, -2.6303]), [0, 0, 0, 0])
        """
        require_equations(self, "step")
        pair = steps.pair_of(method, rtol, atol)
        one_of(on_error, ("nan", "hold", "raise"), "on_error")
        return steps.step(self, Environments(q, speed, effort), (dt, n), pair, on_error, threads)

    @renamed_rates
    def internal_loads(
        self,
        link: str,
        q: MotionLike | None = None,
        speed: npt.ArrayLike = 0.0,
        acceleration: npt.ArrayLike = 0.0,
        *,
        t: npt.ArrayLike = 0.0,
        along: Sequence[str] | None = None,
        density: tuple[npt.ArrayLike, npt.ArrayLike] | None = None,
        n: int = 101,
        on_error: OnError = "raise",
        deg: npt.ArrayLike | None = None,
    ) -> InternalLoads:
        """Return normal force, shear and bending moment inside a link.

        Parameters
        ----------
        link : str
            A moving link of two joints or more, a straight rod between two of them.
        q, speed, acceleration, t
            The motion, as in `reactions`, for one design.
        along : (str, str), optional
            The joints at the ends of the rod; the link's first two by default.
        density : (x, kg/m), optional
            Mass per length at distances from the first of these joints, (K,) each, linear between
            them; the first distance is 0, the last the rod's length, and one given twice makes a
            step. By default the mass of the link's body, uniform. The body must agree with this
            mass: its centre, and its moment of inertia as a thin rod.
        n : int
            Places along the rod at which the loads are given, ends included.
        on_error : {"raise", "nan"}
            See `reactions`.
        deg : array_like, optional
            The coordinates in degrees, in place of `q`.

        Returns
        -------
        InternalLoads
            The loads, their extremes along the rod, and their peak over the motion. NaN where
            redundant links leave a pin's force undetermined (`Reactions.undetermined`).

        Raises
        ------
        PositionError, MotionError
            See `reactions`.
        InputError
            A link that is not a rod, joints that it does not have, a body that does not fit the
            density, a load on the link without a place (torques and torsion springs), a load
            beyond the rod's ends; a batch of designs, a machine of a table.

        Notes
        -----
        Cut at x from the first joint, e along the rod and n to its left: the part beyond acts with
        N e + V n and M on the part before it, N′ = μ (a − g)·e, V′ = μ (a − g)·n, M′ = −V. All
        that acts on the link is taken where it acts: pins, slides, weight, forces, springs, the
        torque of the drive at the pin that the driven link shares with the other. What acts beside
        the line acts at its foot through a rigid arm without mass, with a couple.

        Examples
        --------
        The rod of an engine at 300 rad/s:

        >>> import assur
        >>> import numpy as np
        >>> bodies = {"rod": assur.Body(mass=1.2, inertia=1.2 * 0.35**2 / 12, at=(0.175, 0.0))}
        >>> engine = assur.Machine(assur.SliderCrank(0.1, 0.35), bodies=bodies)
        >>> inside = engine.internal_loads("rod", np.linspace(0.0, np.pi, 37), speed=300.0)
        >>> peak = inside.peak("moment")
        >>> print(f"{peak.value:.4f} N·m at {peak.x:.4f} m, {np.degrees(peak.q):.3f}°")
        -253.0759 N·m at 0.1517 m, 61.356°
        """
        q = q_or_deg(self.mechanism, q, deg, "internal_loads")
        motion = driven_motion(self, q, speed, acceleration, t)
        return inside.internal_loads(self, link, motion, along, density, n, on_error)

    def with_counterweights(self, weights: Iterable[Counterweight]) -> Machine:
        """Return the machine with counterweights as point masses on its links.

        Parameters
        ----------
        weights : iterable of Counterweight
            Such as `assur.balance.four_bar` gives, each with a mass (`with_radius`, `with_mass`).

        Returns
        -------
        Machine
            Its bodies have the masses, centres and moments of inertia of links and weights
            together.

        Raises
        ------
        InputError
            A weight without a mass, an unknown link or joint, a batch of designs, a machine of a
            table.

        Examples
        --------
        >>> import assur
        >>> machine = assur.Machine(
        ...     assur.SliderCrank(0.1, 0.4), bodies={"piston": assur.Body(mass=20.0)}
        ... )
        >>> weights = assur.balance.slider_crank(machine, fraction=0.5)
        >>> machine.with_counterweights(w.with_radius(0.2) for w in weights).bodies["crank"].mass
        5.0
        """
        return counterweight.with_counterweights(self, weights)

    @renamed_rates
    def duty(
        self,
        q: MotionLike | None = None,
        speed: npt.ArrayLike = 0.0,
        acceleration: npt.ArrayLike = 0.0,
        *,
        t: npt.ArrayLike = 0.0,
        on_error: OnError = "raise",
        deg: npt.ArrayLike | None = None,
    ) -> Duty:
        """Return extremes, rms, power and energy of the drive's effort over a cycle.

        Parameters
        ----------
        q : array_like, Run, SteadyState or State
            Coordinates in the order of the motion, ascending or descending: (N,) or, for a batch of
            shape S, S + (N,), N at least 2. Or a motion with its speeds: a run or steady state at
            the ends of its steps, or what its `at` returns.
        speed : array_like
            Speed of the driver there, rad/s or m/s, broadcast to q; not 0, and in the direction in
            which q goes.
        acceleration : array_like
            Its acceleration, broadcast to q; that of a constant speed by default.
        t : array_like
            Times for functions among the loads, s, broadcast to the positions.
        on_error : {"raise", "nan"}
            For a position that fails: raise an error, or return NaN for its design.
        deg : array_like, optional
            The coordinates in degrees, in place of `q`.

        Returns
        -------
        Duty
            The effort with its extremes, rms, power, energy and work in both directions.

        Raises
        ------
        InputError
            Several drivers, fewer than two positions, q that turns back, a speed that is 0 (but at
            the ends of a run) or against q, shapes that do not fit, numbers that are not finite.
        PositionError, MotionError
            See `effort`.

        Notes
        -----
        The effort between positions is the cubic through the four nearest; so are its square over
        the speed, for the rms, and 1/speed, for the time. Means are over time. With steps h an
        extreme is off by up to ``h⁴ |f⁗|/42`` (in the first and last step of an open range
        ``h⁴ |f⁗|/24``), and by up to ``h |f′|`` where loads of a batch are not smooth. Where
        loads jump and friction reverses, the path of one design is cut: its numbers go from jump to
        jump, whatever the positions. If the positions cover
        whole turns and the effort ends as it began, the cubics go on across the ends; with even
        steps the energy is then that of the trapezoidal rule, which for smooth periodic functions
        converges faster than any power of h (L. N. Trefethen and J. A. C. Weideman, SIAM Review 56
        (2014) 385). Even steps may leave out the end of the turn, as `np.linspace(0, 2 * np.pi, n,
        endpoint=False)` does: its position is added. Otherwise all numbers are over the range of
        the positions.
        The steps of a run or steady state are uneven and long: the energy has about four digits. It
        has more at closer positions: ``machine.duty(run.at(times))``, or
        ``machine.duty(steady.at(angles))``.

        Examples
        --------
        A weight of 10 N on a crank of 0.5 m: the work of lifting it comes back.

        >>> import assur
        >>> import numpy as np
        >>> swing = assur.Mechanism(
        ...     joints={"O": (0, 0), "A": (0.5, 0)},
        ...     links={"ground": ["O"], "crank": ["O", "A"]},
        ...     driver="crank",
        ... )
        >>> machine = assur.Machine(swing, loads=[assur.Force("A", (0.0, -10.0))])
        >>> duty = machine.duty(np.linspace(0, 2 * np.pi, 360, endpoint=False), speed=2.0)
        >>> duty.max.value.round(6), duty.rms.round(6), duty.work_in.round(6)
        (np.float64(5.0), np.float64(3.535534), np.float64(10.0))
        >>> duty.max_power.value.round(6), abs(duty.energy) < 1e-12
        (np.float64(10.0), np.True_)
        """
        q = q_or_deg(self.mechanism, q, deg, "duty")
        motion = driven_motion(self, q, speed, acceleration, t)
        if not isinstance(q, Run | SteadyState):
            duty.warn_of_jumps(self)
        return duty.duty(self, motion, on_error)

    def equilibria(self, *, between: npt.ArrayLike | None = None) -> Equilibria:
        """Return the positions of rest under weights, springs and constant loads.

        Parameters
        ----------
        between : (least, greatest), optional
            The range of the coordinate to search, rad or m, ends included. By default the full turn
            around the drawing's coordinate, q0 − π to q0 + π (of `from_table`, its rows). A driven
            slide needs a range.

        Returns
        -------
        Equilibria
            Every q, whether it is stable, its natural frequency in rad/s and its stiffness; and
            intervals of indifferent rest.

        Raises
        ------
        InputError
            Several drivers, a batch of designs, a load that is a function, a wrong range.
        PositionError
            No position in the whole range.
        MotionError
            No finite moment in the whole range, one that changes its sign in a jump (a spring whose
            length goes through zero), or one that varies too quickly for a complete search.

        Notes
        -----
        Rest is where `reduced_moment` is zero at speed 0. That is −dV/dq, with V the potential of
        weights and springs (`potential`) and of constant forces and torques; tables over q count
        too. Dampers exert nothing at rest. Motors are off: only their rotors count, in the
        frequency. A motor's constant torque can be given as a `Torque`.

        The moment is compared with the cubic through its exact values and slopes at the ends of
        256 intervals of a turn (or of a slide's range), which end at the rows of tables too. An
        interval is halved until the cubic shows, by more than its error in the middle, that it has
        no root or one (J. M. Lane and R. F. Riesenfeld, *Bounds on a polynomial*, BIT 21 (1981)
        112). Each root is then bracketed to rounding (I. F. D. Oliveira and R. H. C. Takahashi, ACM
        TOMS 47 (2020)). The search misses pairs of roots between two samples (1/512 of a turn) of
        which values and slopes show nothing, and roots within 1e-6 of a dead point; three within
        1e-7 rad count as one. Gaps, also those of tables, are left out; what the drawing's branch
        reaches beyond them is searched, if it is wider than 1/4096 of a turn.

        Examples
        --------
        A disc with a weight 0.2 m from its axis hangs still at the bottom; it swings around that as
        √(m g r/J):

        >>> import assur
        >>> swing = assur.Mechanism(
        ...     joints={"O": (0, 0), "A": (0.2, 0)},
        ...     links={"ground": ["O"], "disc": ["O", "A"]},
        ...     driver="disc",
        ... )
        >>> weight = assur.Body(mass=3.0, inertia=0.05, at="A")
        >>> rest = assur.Machine(
        ...     swing, bodies={"disc": weight}, loads=[assur.Gravity()]
        ... ).equilibria()
        >>> rest.q.round(6), rest.stable, rest.frequency.round(6)
        (array([-1.570796,  1.570796]), array([ True, False]), array([5.884176,      nan]))
        """
        return equilibria.equilibria(self, between)

    def self_locking(
        self,
        *,
        sense: int = 1,
        speed: float = 0.0,
        acceleration: float = 0.0,
        between: tuple[float, float] | None = None,
        n: int = 720,
    ) -> SelfLocking:
        """Return where friction locks the machine, or holds its loads.

        Parameters
        ----------
        sense : int
            +1 or −1: the direction in which the drive moves, or is about to move.
        speed, acceleration : float
            Of the driver, rad/s and rad/s² (slides: m/s and m/s²); at rest by default.
        between : (float, float), optional
            The range of q; a driven angle has a whole turn by default.
        n : int
            Number of steps over the range; an interval shorter than a step may be missed.

        Returns
        -------
        SelfLocking
            Intervals of q, their ends to rounding.

        Raises
        ------
        InputError
            No friction, several drivers, a batch of designs (`reactions(...).locked` has its
            shape), a wrong range.

        Examples
        --------
        A rocker that drives a crank cannot start it near the dead points:

        >>> import assur
        >>> import numpy as np
        >>> pins = {name: assur.JointFriction(0.1, 0.4) for name in "ABCD"}
        >>> linkage = assur.FourBar(1.0, 4.5, 1.5, 4.9)
        >>> pushed = assur.Machine(linkage, loads=[assur.Torque("rocker", 100.0)], friction=pins)
        >>> np.degrees(pushed.self_locking().holding).round(2)
        array([[ 15.22,  19.83],
               [181.7 , 187.46]])
        """
        return locking.self_locking(self, sense, speed, acceleration, between, n)

    @renamed_rates
    def impact(
        self,
        load: Force | Torque,
        q: npt.ArrayLike | None = None,
        speed: npt.ArrayLike = 0.0,
        *,
        restitution: npt.ArrayLike = 0.0,
        impulse: npt.ArrayLike | None = None,
        on_error: OnError = "raise",
        deg: npt.ArrayLike | None = None,
    ) -> Impact:
        """Return speeds and impulses when a link hits an obstacle, or is struck.

        Parameters
        ----------
        load : Force or Torque
            Where the impact acts, and the direction in which the obstacle pushes: a unit force at a
            point (along a link's axes with `axes=`), or a unit torque for a link that is stopped
            from turning.
        q : array_like
            Coordinates, see `reduced_inertia`.
        speed : array_like
            Speeds of the drivers before it, rad/s or m/s, broadcast to q.
        restitution : array_like
            Of the obstacle: from 0, the point stays with it, to 1, it leaves as fast as it came.
        impulse : array_like, optional
            A given impulse along `load` instead of an obstacle, N·s.
        on_error : {"raise", "nan"}
            See `reduced_inertia`.
        deg : array_like, optional
            The coordinates in degrees, in place of `q`.

        Returns
        -------
        Impact
            Speeds after it, the impulse, the energy lost, and the impulses in all pairs.

        Raises
        ------
        PositionError
            A position that the assembly does not reach, or without analogues.
        InputError
            A load without a direction, a restitution not from 0 to 1, a machine without inertia.

        Notes
        -----
        With H the reduced inertia and g the derivatives of the point's displacement along the
        force, H Δq̇ = gᵀ P. An obstacle asks for g q̇⁺ = −e g q̇⁻, so P = −(1 + e) g q̇⁻ / (g H⁻¹
        gᵀ), and the energy ½ (1 − e²) (g q̇⁻)² / (g H⁻¹ gᵀ) is lost; with one driver all speeds are
        multiplied by −e. Nothing happens where the point moves away. Loads, springs and friction
        are finite forces and have no impulse; the drives are free (J. Wittenburg, *Dynamics of
        Multibody Systems*, 2008, ch. 8).

        Examples
        --------
        A rocker is stopped by an elastic buffer:

        >>> import assur
        >>> linkage = assur.FourBar(0.05, 0.15, 0.12, 0.16)
        >>> machine = assur.Machine(
        ...     linkage, bodies={"rocker": assur.Body(mass=0.8, inertia=1.5e-3, at=(0.06, 0.0))}
        ... )
        >>> stop = assur.Force(("rocker", (0.1, 0.0)), (0.0, -1.0), axes="rocker")
        >>> hit = machine.impact(stop, q=2.0, speed=20.0, restitution=0.4)
        >>> hit.speed.round(6), hit.energy_lost.round(6)
        (np.float64(-8.0), np.float64(0.12814))
        """
        q = q_or_deg(self.mechanism, q, deg, "impact")
        return impact.impact(
            self, load, motion_of(q, speed, 0.0, 0.0), restitution, impulse, on_error
        )

    def flywheel(
        self,
        fluctuation: npt.ArrayLike,
        *,
        mean_speed: npt.ArrayLike | None = None,
        mean: Mean = "extremes",
        on_error: OnError = "raise",
        turns: int = 1,
    ) -> Flywheel:
        """Return the flywheel that limits the speed fluctuation to a given fraction of the mean.

        Parameters
        ----------
        fluctuation : float
            Required coefficient of speed fluctuation; for a batch of shape S a number or an array
            of shape S.
        mean_speed : float, optional
            Required mean speed, rad/s. A constant motor then balances the mean moment of the
            loads, which are evaluated at the mean speed. Without it the machine's own motor sets
            the speed, and loads are evaluated at the true speed: for one design, not a batch.
        mean : {"extremes", "period"}
            Definition of the mean speed (`assur.flywheel.from_table`).
        on_error : {"raise", "nan"}
            For a design of a batch without a flywheel: raise an error, or return NaN.
        turns : int
            Turns of the driver after which the loads repeat: 2 for a four-stroke engine.

        Returns
        -------
        Flywheel
            The same attributes and methods whatever the motor. With a mean speed from tables,
            refined until the inertia changes by less than 1e-9; with the machine's own motor from
            the integrated motion, which is its `steady`.

        Raises
        ------
        InputError
            A driver that is not an angle, wrong arguments, a table that does not fit a turn, a
            fluctuation that is already met without a flywheel.
        PositionError
            A driver that does not turn fully.
        MotionError
            A motion that does not repeat after these turns, a mean speed too low for the machine to
            keep turning, a motor that cannot carry the load, no finite flywheel.

        Warns
        -----
        AssurWarning
            A `ConstantTorque` that does not balance the loads; functions that are not smooth.

        Examples
        --------
        >>> import assur
        >>> press = assur.SliderCrank(crank=0.1, rod=0.4)
        >>> work = assur.Table([0, 5.5, 6.0, 6.283185307179586], [0, 0, 9000.0, 0], spline="linear")
        >>> machine = assur.Machine(
        ...     press,
        ...     bodies={"piston": assur.Body(mass=20.0), "crank": assur.Body(inertia=0.5)},
        ...     loads=[assur.Force("B", (work, 0.0))],
        ... )
        >>> machine.flywheel(fluctuation=0.05, mean_speed=20.0).delta.__round__(6)
        0.05
        """
        return flywheel_size.flywheel(self, fluctuation, mean_speed, mean, turns, on_error)

    @overload
    def run(
        self,
        t_end: float | None = ...,
        q0: float | None = ...,
        speed0: float = ...,
        *,
        q_end: float | None = ...,
        t0: float = ...,
        rtol: float = ...,
        atol: float | tuple[float, float] | None = ...,
        method: Method = ...,
        events: Sequence[Event] = ...,
        breaks: npt.ArrayLike = ...,
        max_step: float = ...,
        max_steps: int = ...,
        max_seconds: float | None = ...,
        deg0: float | None = ...,
        deg_end: float | None = ...,
    ) -> Run: ...
    @overload
    def run(
        self,
        t_end: npt.ArrayLike | None = ...,
        q0: npt.ArrayLike | None = ...,
        speed0: npt.ArrayLike = ...,
        *,
        q_end: npt.ArrayLike | None = ...,
        t0: float = ...,
        rtol: float = ...,
        atol: float | tuple[float, float] | None = ...,
        method: Method = ...,
        events: Sequence[Event] = ...,
        breaks: npt.ArrayLike = ...,
        max_step: float = ...,
        max_steps: int = ...,
        max_seconds: float | None = ...,
        deg0: npt.ArrayLike | None = ...,
        deg_end: npt.ArrayLike | None = ...,
        keep: Literal["all", "ends"] = ...,
        on_error: Literal["raise", "nan"] = ...,
        threads: int | None = ...,
    ) -> RunOrRuns: ...
    def run(
        self,
        t_end: npt.ArrayLike | None = None,
        q0: npt.ArrayLike | None = None,
        speed0: npt.ArrayLike = 0.0,
        *,
        q_end: npt.ArrayLike | None = None,
        t0: float = 0.0,
        rtol: float = 1e-10,
        atol: float | tuple[float, float] | None = None,
        method: Method = "DOP853",
        events: Sequence[Event] = (),
        breaks: npt.ArrayLike = (),
        max_step: float = math.inf,
        max_steps: int = 1_000_000,
        max_seconds: float | None = None,
        deg0: npt.ArrayLike | None = None,
        deg_end: npt.ArrayLike | None = None,
        keep: Literal["all", "ends"] = "all",
        on_error: Literal["raise", "nan"] = "raise",
        threads: int | None = None,
    ) -> Run | Runs:
        """Integrate the motion under loads and motor: J q̈ + ½ J′ q̇² = M.

        Arrays of initial states, and designs, are a run each, all in one call.

        Parameters
        ----------
        t_end : array_like
            Final time, s. Give either this or:
        q_end : array_like
            Final coordinate: integrates over q instead of t (one driver, not at rest). Suits
            periodic motions, because over q the knots of all tables are known beforehand.
        q0, speed0 : array_like
            Initial coordinate and speed of the driver, rad or m and per s; for n drivers (n,). The
            default coordinate is that of the drawing (for a table its first row). For many runs
            (E,) or S + (E,), with n drivers a last axis of n; they broadcast against each other and
            the end.
        t0 : float
            Initial time, s.
        rtol : float
            Relative tolerance per step of the speed; absolute tolerance of the coordinate in rad
            (slide: times its greatest length).
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
            Limit of computing time, s; of many runs that of each.
        deg0, deg_end : array_like, optional
            Initial and final coordinate in degrees, in place of `q0` and `q_end`.
        keep : {"all", "ends"}
            Of many runs: whole motions (of order 8 about 300 bytes a step with one driver), or only
            their ends and events.
        on_error : {"raise", "nan"}
            Of many runs: what one has that cannot start or be computed. An error that names it, or
            NaN and its `status` in its place.
        threads : int, optional
            Most threads for many runs; all cores by default. Where loads, motors or events are
            Python functions, one run follows another.

        Returns
        -------
        Run or Runs
            The motion; it ends early at an event that stops it, at a dead point (also an event), or
            at a limit. Of arrays or designs S: `Runs` of the shape S + (E,), each with the bits
            that it has alone.

        Raises
        ------
        InputError
            Wrong arguments, a position without inertia, a function that does not return a number, a
            table that does not cover the start. Exceptions raised by functions are passed on.
        PositionError
            No valid position at q0.
        MotionError
            A motion that is not finite: a load, a speed or a mass is too great, or a damper or
            spring has length zero.

        Warns
        -----
        AssurWarning
            The run ended early without an event: the tolerance cannot be met, a table ends, or a
            limit of steps or seconds is reached. Or the energy balance is off by more than 1000
            rtol (and by more than 1e-6). Of many runs one warning counts them.

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

        From four positions, each until 10 rad/s:

        >>> fast = assur.events.Speed(10.0)
        >>> runs = machine.run(t_end=1.0, q0=[0.0, 1.5, 3.0, 4.5], events=[fast])
        >>> runs.t_end.round(4), runs.end.tolist()  # s
        (array([0.2225, 0.1875, 0.2065, 0.2041]), ['event', 'event', 'event', 'event'])
        """
        one_of(keep, ("all", "ends"), "keep")
        one_of(on_error, ("raise", "nan"), "on_error")
        if deg0 is not None:
            q0 = in_radians(self.mechanism, q0, deg0, "run", "q0")
        if deg_end is not None:
            q_end = in_radians(self.mechanism, q_end, deg_end, "run", "q_end")
        return integrate.run(
            self,
            t_end,
            q0,
            speed0,
            q_end,
            t0,
            (keep, on_error, checked_threads(threads)),
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
        deg0: float | None = None,
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
        deg0 : float, optional
            Coordinate at the start of the period in degrees, in place of `q0`.

        Returns
        -------
        SteadyState
            One period, its δ, mean speed, power and work, and its stability.

        Raises
        ------
        InputError
            Wrong arguments, a position without inertia, no speed to begin with, tables that do not
            fit the period, a motor's table that ends.
        PositionError
            A dead point, or lengths that nearly have a change point; no valid position at q0.
        MotionError
            A motor that cannot carry the load or does not balance it, a machine that runs away, a
            mean speed so low that it would stop within the turn, a motion that does not repeat
            after the period or is not finite, a limit of steps or seconds that is reached.

        Warns
        -----
        AssurWarning
            A constant motor that is out of balance by up to 1 %: the missing moment is added.

        Notes
        -----
        Shooting integrates the square of the speed over a period, with its derivative by the
        initial value, and corrects that value by Newton steps. If there are several periodic
        motions, it finds the one with the highest speed below the first guess, which is stable.

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
        if deg0 is not None:
            deg0 = real_number(deg0, "deg0")
            q0 = float(in_radians(self.mechanism, q0, deg0, "steady_state", "q0"))
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
