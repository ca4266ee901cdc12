"""Functions with exact Jacobians for SciPy's optimisers and integrators.

SciPy itself is not imported: what is here are functions that it calls.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import Float, counted, finite_array, real_array, short
from assur._validate import checked_name
from assur.errors import InputError
from assur.kinematics.derivatives.jacobian import named_dimensions, require_once
from assur.kinematics.solve_arguments import q_or_deg

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from assur.dynamics.machine import Machine
    from assur.kinematics.mechanism import Mechanism
    from assur.kinematics.motion import Motion

__all__ = ["Residuals", "StateEquations"]


class Residuals:
    """What a mechanism misses its targets by, over dimensions: for ``scipy.optimize``.

    Parameters
    ----------
    mechanism : Mechanism
        One design, in the assembly that is fitted.
    targets : dict of str to array_like
        For each joint its points, (N, 2), m; for each link or slide its angles or values, (N,), rad
        or m.
    q : array_like
        Coordinates of the drivers at these N positions, rad or m; with n drivers (N, n).
    by : str or sequence of str
        The dimensions that vary, also as patterns: ``"*.length"``.
    deg : array_like, optional
        The coordinates in degrees, in place of `q`.

    Attributes
    ----------
    names : tuple of str
        The dimensions that vary, in the order of x.
    x0 : numpy.ndarray
        Their values in the mechanism.

    Raises
    ------
    InputError
        Names that do not exist, shapes that do not fit, a batch of designs, redundant links.

    Notes
    -----
    A residual is NaN where a position does not exist, or no design has such a dimension: SciPy's
    ``least_squares`` then takes a shorter step.

    Examples
    --------
    The lengths of a four-bar from points that its coupler drew:

    >>> import assur, numpy as np
    >>> from scipy.optimize import least_squares
    >>> true, q = assur.examples.crank_rocker(), np.linspace(0.0, 6.0, 20)
    >>> points = true.solve(q).joint("P").value
    >>> lengths = {"coupler.length": 1.05 * float(true.dimensions["coupler.length"])}
    >>> missed = assur.adapters.scipy.Residuals(
    ...     true.with_dimensions(lengths), {"P": points}, q, by="*.length"
    ... )
    >>> found = least_squares(missed.fun, missed.x0, jac=missed.jac, xtol=1e-14, ftol=1e-14)
    >>> float(np.abs(missed.mechanism(found.x).solve(q).joint("P").value - points).max()) < 1e-9
    True
    """

    def __init__(
        self,
        mechanism: Mechanism,
        targets: Mapping[str, npt.ArrayLike],
        q: npt.ArrayLike | None = None,
        *,
        by: str | Sequence[str] = "*.length",
        deg: npt.ArrayLike | None = None,
    ) -> None:
        if mechanism.shape:
            message = (
                f"Residuals is of one design, this is a batch {mechanism.shape}: use design(i)"
            )
            raise InputError(message)
        given: Any = targets
        if not (isinstance(given, Mapping) and given):
            message = f'targets is {short(targets)}: a mapping such as {{"P": points}} is needed'
            raise InputError(message)
        known = mechanism.core.dimension_names
        self._by = [known[index] for index in named_dimensions(mechanism, by)]
        require_once(self._by)
        self.names = tuple(self._by)
        self.x0: Float = np.array([float(mechanism.dimensions[name]) for name in self._by])
        self._mechanism = mechanism
        self._q = finite_array(q_or_deg(mechanism, q, deg, "Residuals"), "q")
        self._outputs = [checked_name(name, "targets") for name in targets]
        motion = self._motion(self.x0)
        self._targets: list[Float] = []
        for name, given in targets.items():
            place = _values(motion, name)[0]
            target = finite_array(given, f"targets[{name!r}]")
            if target.shape != place.shape:
                message = (
                    f"targets[{name!r}] has the shape {target.shape}, and at these q it is "
                    f"{place.shape}"
                )
                raise InputError(message)
            self._targets.append(target)
        motion.jacobian(self._outputs[0], by=[])

    def mechanism(self, x: npt.ArrayLike) -> Mechanism:
        """Return the mechanism with these values of the dimensions.

        Parameters
        ----------
        x : array_like
            A value for each of `names`, m or rad.

        Returns
        -------
        Mechanism
            The other dimensions are as they were.

        Raises
        ------
        InputError
            Another number of values.
        DimensionError
            A value that no such dimension can have.

        Examples
        --------
        >>> import assur
        >>> m = assur.FourBar(1.0, 3.0, 2.5, 3.0)
        >>> missed = assur.adapters.scipy.Residuals(m, {"rocker": [1.5]}, [0.5])
        >>> missed.mechanism([1.0, 3.2, 2.5]).dimensions["coupler.length"]
        3.2
        """
        values = self._checked(x).tolist()
        return self._mechanism.with_dimensions(dict(zip(self._by, values, strict=True)))

    def fun(self, x: npt.ArrayLike) -> Float:
        """Return the residuals, found less wanted.

        Parameters
        ----------
        x : array_like
            A value for each of `names`, m or rad.

        Returns
        -------
        numpy.ndarray
            All targets' numbers, one after another; m or rad.

        Examples
        --------
        >>> import assur
        >>> m = assur.FourBar(1.0, 3.0, 2.5, 3.0)
        >>> missed = assur.adapters.scipy.Residuals(m, {"rocker": [1.5]}, [0.5])
        >>> missed.fun(missed.x0).round(4)  # rad
        array([0.0321])
        """
        motion = self._motion(x)
        pairs = zip(self._outputs, self._targets, strict=True)
        return np.concatenate(
            [(_values(motion, name)[0] - target).ravel() for name, target in pairs]
        )

    def jac(self, x: npt.ArrayLike) -> Float:
        """Return the derivatives of the residuals by x.

        Parameters
        ----------
        x : array_like
            A value for each of `names`, m or rad.

        Returns
        -------
        numpy.ndarray
            (residuals, dimensions).

        Examples
        --------
        >>> import assur
        >>> m = assur.FourBar(1.0, 3.0, 2.5, 3.0)
        >>> missed = assur.adapters.scipy.Residuals(m, {"rocker": [1.5]}, [0.5])
        >>> missed.names, missed.jac(missed.x0).round(4)  # rad/m
        (('crank.length', 'coupler.length', 'rocker.length'), array([[-0.5451, -0.5609,  0.3932]]))
        """
        every = self._motion(x).jacobian(self._outputs, by=self._by)
        return np.concatenate([every[name].reshape(-1, len(self._by)) for name in self._outputs])

    def _motion(self, x: npt.ArrayLike) -> Motion:
        # A batch of one: of what no design can be the residuals are NaN.
        values = zip(self._by, self._checked(x)[:, np.newaxis], strict=True)
        mechanism = self._mechanism.with_dimensions(dict(values))
        return mechanism.solve(self._q, order=0, outputs=self._outputs, on_error="nan")

    def _checked(self, x: npt.ArrayLike) -> Float:
        values = real_array(x, "x")
        if values.shape != self.x0.shape:
            message = f"x has the shape {values.shape}: {len(self._by)} values are needed"
            raise InputError(message)
        return values

    def __repr__(self) -> str:
        of = counted(len(self._outputs), "output")
        return f"<residuals of {of} by {counted(len(self._by), 'dimension')}>"


def _values(motion: Motion, name: str) -> Float:
    """Return what a joint, link or slide of this name does."""
    mechanism = motion.mechanism
    kind = "joint" if name in mechanism.joints else "link" if name in mechanism.links else "slide"
    values: Float = getattr(motion, kind)(name).value
    return values


class StateEquations:
    """The equations of a machine in first order, with their Jacobian: for ``scipy.integrate``.

    Parameters
    ----------
    machine : Machine
        One design, without friction and without functions of time.
    effort : array_like, optional
        What the drivers give throughout, N·m or N; by default what the machine's motors give.

    Raises
    ------
    InputError
        As in `Machine.linearize`.

    Notes
    -----
    The state y is the n coordinates of the drivers, then their speeds. Where a position does not
    exist the rates are NaN. `Machine.run` needs no such detour and hears events and jumps: this is
    for methods that it does not have, implicit ones for stiff springs.

    Examples
    --------
    A pendulum by an implicit method:

    >>> import assur
    >>> from scipy.integrate import solve_ivp
    >>> arm = assur.Mechanism({"O": (0, 0), "A": (1, 0)}, {"ground": "O", "arm": "OA"}, "arm")
    >>> mass = {"arm": assur.Body(mass=2.0, at="A")}
    >>> state = assur.adapters.scipy.StateEquations(
    ...     assur.Machine(arm, bodies=mass, loads=[assur.Gravity()])
    ... )
    >>> fallen = solve_ivp(state.fun, (0.0, 0.5), [0.0, 0.0], "Radau", jac=state.jac, rtol=1e-9)
    >>> fallen.y[:, -1].round(4)  # rad, rad/s
    array([-1.169 , -4.2494])
    """

    def __init__(self, machine: Machine, effort: npt.ArrayLike | None = None) -> None:
        if machine.shape:
            message = f"StateEquations is of one design, this is a batch {machine.shape}"
            raise InputError(message)
        self._machine = machine
        self._effort = None if effort is None else finite_array(effort, "effort")
        q0 = 0.0 if machine.mechanism is None else machine.mechanism.q0
        # Whatever cannot be linearised is refused here, not in the midst of an integration.
        # Moving: loads with `while_` have no value at rest.
        machine.linearize(q0, 1.0, self._effort, on_error="nan")

    def fun(self, t: float, y: npt.ArrayLike) -> Float:
        """Return the rates of a state.

        Parameters
        ----------
        t : float
            Time, s; nothing depends on it.
        y : array_like
            Coordinates and speeds, (2n,).

        Returns
        -------
        numpy.ndarray
            Speeds and accelerations, (2n,).

        Examples
        --------
        >>> import assur
        >>> machine = assur.Machine(
        ...     assur.SliderCrank(0.1, 0.4), bodies={"crank": assur.Body(inertia=0.5)}
        ... )
        >>> assur.adapters.scipy.StateEquations(machine, effort=2.0).fun(0.0, [0.3, 5.0])
        array([5., 4.])
        """
        del t
        q, speed = self._state(y)
        given = self._machine.acceleration(q, speed, self._effort, on_error="nan")
        return np.concatenate([np.atleast_1d(speed), np.atleast_1d(given)])

    def jac(self, t: float, y: npt.ArrayLike) -> Float:
        """Return the derivatives of the rates by the state.

        Parameters
        ----------
        t : float
            Time, s; nothing depends on it.
        y : array_like
            Coordinates and speeds, (2n,).

        Returns
        -------
        numpy.ndarray
            (2n, 2n): A of `Machine.linearize`.

        Examples
        --------
        >>> import assur
        >>> machine = assur.Machine(
        ...     assur.SliderCrank(0.1, 0.4), bodies={"crank": assur.Body(inertia=0.5)}
        ... )
        >>> assur.adapters.scipy.StateEquations(machine, effort=2.0).jac(0.0, [0.3, 5.0])
        array([[0., 1.],
               [0., 0.]])
        """
        del t
        q, speed = self._state(y)
        return self._machine.linearize(q, speed, self._effort, on_error="nan").A

    def _state(self, y: npt.ArrayLike) -> tuple[Any, Any]:
        state, n = real_array(y, "y", copy=False), self._machine.driver_count
        if state.shape != (2 * n,):
            message = f"y has the shape {state.shape}: {2 * n} numbers are needed, q then speed"
            raise InputError(message)
        return (state[0], state[1]) if n == 1 else (state[:n], state[n:])

    def __repr__(self) -> str:
        drivers = counted(self._machine.driver_count, "driver")
        return f"<state equations of {drivers}>"
