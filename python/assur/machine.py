"""Machines: a mechanism with bodies and loads, referred to its drivers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from assur import _core
from assur import flywheel as flywheels
from assur._checks import real_array
from assur.errors import InputError, PositionError
from assur.loads import Body, Gravity, Outside

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from assur.flywheel import Flywheel, Mean
    from assur.loads import Load
    from assur.mechanism import Mechanism

__all__ = ["Machine", "Reduced"]

Float: TypeAlias = npt.NDArray[np.float64]
OnError: TypeAlias = Literal["raise", "nan"]

# Rows of the first table of `Machine.flywheel`, and of the last; each has twice those before.
FIRST_ROWS, LAST_ROWS = 96, 12288
# Change of the flywheel between two tables after which it is known.
SETTLED = 1e-9


class Reduced(NamedTuple):
    """The reduced inertia and its exact derivative.

    Attributes
    ----------
    value : ndarray
        kg·m² (a driven slide: kg); of n drivers the mass matrix, (..., n, n).
    d1 : ndarray
        Its derivative by the coordinate; of n drivers (..., n, n, n), the last axis that of the
        coordinate.
    """

    value: Any
    d1: Any


class Machine:
    """A mechanism with what it carries and what acts on it.

    Parameters
    ----------
    mechanism : Mechanism
        One design (not a batch).
    bodies : mapping of str to Body
        The masses of links, by name.
    loads : sequence of Gravity, Force, Torque, Spring, TorsionSpring, Damper, TorsionDamper
        What acts on it; several of a kind are added.

    Raises
    ------
    InputError
        Something that is no body or load, a negative mass, a name that the mechanism does not have.

    Examples
    --------
    A crank press: at 90° all of the piston's speed is the crank's.

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

    def __init__(
        self, mechanism: Mechanism, bodies: Mapping[str, Body], loads: Sequence[Load] = ()
    ) -> None:
        if mechanism.shape:
            message = f"a machine has one design, not a batch {mechanism.shape}: design(i)"
            raise InputError(message)
        self.mechanism = mechanism
        self.bodies = dict(bodies)
        self.loads = tuple(loads)
        self._outside = Outside()
        gravity = np.zeros(2)
        parts = []
        for load in self.loads:
            if isinstance(load, Gravity):
                gravity = gravity + _gravity(load)
            elif hasattr(load, "_parts"):
                parts.append(load._parts(self._outside.tell))
            else:
                message = f"{load!r} is no load: Gravity, Force, Torque, Spring, Damper …"
                raise InputError(message)
        told = [self._body(link, body) for link, body in self.bodies.items()]
        self._core = _core.Machine(mechanism._core, told, parts, gravity.tolist(), 0.0)

    def __reduce__(self) -> tuple[Any, ...]:
        return Machine, (self.mechanism, self.bodies, self.loads)

    def __repr__(self) -> str:
        formula = self.mechanism.structure.formula
        return f"<assur.Machine {formula}, {len(self.bodies)} bodies, {len(self.loads)} loads>"

    def reduced_inertia(self, q: npt.ArrayLike, on_error: OnError = "raise") -> Reduced:
        """Return the reduced inertia Σ m (dS/dq)² + I (dθ/dq)² and its exact derivative.

        Parameters
        ----------
        q : array_like
            Coordinates, rad or m: a number or (N,); of n drivers (..., n).
        on_error : {"raise", "nan"}
            Whether a place without a position or analogues is an error, or NaN.

        Returns
        -------
        Reduced
            `value` and `d1`.

        Examples
        --------
        >>> import assur
        >>> wheel = assur.FourBar(1.0, 3.0, 3.0, 3.0)
        >>> machine = assur.Machine(wheel, {"rocker": assur.Body(inertia=2.0)})
        >>> value, d1 = machine.reduced_inertia([0.0, 1.0])
        >>> value.round(6)
        array([0.5     , 0.015382])
        """
        inertia, rates, _, _ = self._reduce(q, 0.0, on_error)
        if self._drivers == 1:
            return Reduced(inertia[..., 0, 0][()], rates[..., 0, 0, 0][()])
        return Reduced(inertia, np.moveaxis(rates, -3, -1))

    def reduced_moment(
        self, q: npt.ArrayLike, speed: npt.ArrayLike = 0.0, on_error: OnError = "raise"
    ) -> Any:
        """Return the reduced moment of all loads (no motor is in it).

        Parameters
        ----------
        q : array_like
            Coordinates as of `reduced_inertia`.
        speed : array_like
            Speeds of the drivers, rad/s or m/s, broadcast to q; dampers and functions ask for it.
            (Functions of time are asked at t = 0.)
        on_error : {"raise", "nan"}
            As of `reduced_inertia`.

        Returns
        -------
        ndarray
            N·m (a driven slide: N), of the shape of q.
        """
        moment = self._reduce(q, speed, on_error)[2]
        return moment[..., 0][()] if self._drivers == 1 else moment

    def potential(self, q: npt.ArrayLike, on_error: OnError = "raise") -> Any:
        """Return the potential energy of weights and springs, J."""
        return self._reduce(q, 0.0, on_error)[3][()]

    def flywheel(self, fluctuation: float, mean_speed: float, mean: Mean = "extremes") -> Flywheel:
        """Return the flywheel that keeps the speed of a turn within a part of its mean.

        A constant motor gives the mean of what the loads take. Loads that ask for the speed have
        the mean speed.

        Parameters
        ----------
        fluctuation : float
            Coefficient of speed fluctuation wanted.
        mean_speed : float
            Mean speed wanted, rad/s.
        mean : {"extremes", "period"}
            What that mean is (`assur.flywheel.from_table`).

        Returns
        -------
        Flywheel
            Of tables so dense that the flywheel does not change by 1e-9 of its inertia.

        Raises
        ------
        InputError
            A driver that is no angle or does not turn fully, a motion that is another after a
            turn, and what `assur.flywheel.from_table` refuses.

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
        driver = self.mechanism.driver
        if self._drivers > 1 or (isinstance(driver, str) and driver in self.mechanism.slides):
            message = f"driver {driver!r}: a flywheel turns with a driven angle"
            raise InputError(message)
        last: Flywheel | None = None
        rows = FIRST_ROWS
        while True:
            phi = np.linspace(0.0, 2.0 * np.pi, rows + 1)
            inertia, _, moment, _ = self._reduce(phi, mean_speed, "raise")
            own = flywheels.from_table(
                phi, moment[:, 0], inertia[:, 0, 0], fluctuation, mean_speed, mean=mean
            )
            size = own.inertia + float(inertia.max())
            if last is not None and abs(own.inertia - last.inertia) <= SETTLED * size:
                return own
            if rows == LAST_ROWS:
                # Tables with corners never settle so far: this is what the densest one gives.
                return own
            last, rows = own, 2 * rows

    @property
    def _drivers(self) -> int:
        return int(np.size(self.mechanism.q0))

    def _body(self, link: str, body: Any) -> tuple[str, Any, float, float]:
        if not isinstance(body, Body):
            message = f"bodies[{link!r}] is {body!r}: an assur.Body is needed"
            raise InputError(message)
        joints = self.mechanism.links.get(link, ())
        at: Any = body.at
        if at is None and joints:
            at = joints[0]
        elif not isinstance(at, str):
            x, y = (0.0, 0.0) if at is None else real_array(at, f"at of the body {link!r}")
            at = link, [float(x), float(y)]
        elif link in self.mechanism.links and at not in joints:
            message = f"bodies[{link!r}]: joint {at!r} is not one of its joints {', '.join(joints)}"
            raise InputError(message, joint=at, link=link)
        return link, at, float(body.mass), float(body.inertia)

    def _reduce(
        self, q: npt.ArrayLike, speed: npt.ArrayLike, on_error: str
    ) -> tuple[Float, Float, Float, Float]:
        if on_error not in ("raise", "nan"):
            message = f"on_error is {on_error!r}: 'raise' or 'nan'"
            raise InputError(message)
        n = self._drivers
        x, v = real_array(q, "q"), real_array(speed, "speed")
        if n > 1 and (x.ndim == 0 or x.shape[-1] != n):
            message = f"q has the shape {x.shape}: with {n} drivers its last axis must be {n}"
            raise InputError(message)
        try:
            v = np.broadcast_to(v, x.shape)
        except ValueError as error:
            message = f"speed has the shape {v.shape}, q {x.shape}: they do not fit"
            raise InputError(message) from error
        shape = x.shape if n == 1 else x.shape[:-1]
        flat, speeds = np.ascontiguousarray(x).ravel(), np.ascontiguousarray(v).ravel()
        given = self._outside.numbers(flat[::n], speeds[::n])
        *arrays, status = self._core.reduce(
            np.ascontiguousarray(self.mechanism._values), flat, speeds, given
        )
        failed = np.flatnonzero(status)
        if on_error == "raise" and failed.size:
            self._refuse(x, shape, int(failed[0]))
        inertia, rates, moment, potential = arrays
        beyond = np.flatnonzero(np.isnan(moment).reshape(-1, n).any(axis=1) & (status == 0))
        if on_error == "raise" and beyond.size:
            at = flat.reshape(-1, n)[beyond[0]]
            message = (
                f"q = {at[0]:g}: a load has no value there (a table ends, or a function gave nan)"
            )
            raise InputError(message, q=x[np.unravel_index(int(beyond[0]), shape) if shape else ()])
        return (
            inertia.reshape(*shape, n, n),
            rates.reshape(*shape, n, n, n),
            moment.reshape(*shape, n),
            potential.reshape(shape),
        )

    def _refuse(self, q: Float, shape: tuple[int, ...], flat: int) -> None:
        place = np.unravel_index(flat, shape) if shape else ()
        one = self.mechanism.solve(q[place], order=1, on_error="nan")
        message = f"{one.explain()}; nothing can be referred to the driver there"
        raise PositionError(message, q=q[place])


def _gravity(load: Gravity) -> Float:
    gravity = real_array(load.acceleration, "Gravity")
    if gravity.shape != (2,) or not np.isfinite(gravity).all():
        message = f"Gravity is {load.acceleration!r}: two finite components (x, y) are needed"
        raise InputError(message)
    return gravity
