"""`Machine.dynamics`: mass matrix, bias, gravity and Jacobians at positions and speeds."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur._other_names import other_names
from assur._validate import checked_name
from assur.description.words import Status, has_analogues
from assur.dynamics.equations.terms import State, Term, terms_of
from assur.dynamics.reduction.undefined_load import Moment, without_value
from assur.errors import InputError

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur._arrays import Float
    from assur.dynamics.model import MachineModel, OnError

__all__ = ["Dynamics"]

TERMS: list[Term] = [("mass matrix", 0), ("mass rates", 0), ("bias", 0), ("gravity", 0)]


@other_names(
    M="it is mass_matrix",
    coriolis="bias has it, with gravity and loads",
    nonlinear_effects="it is bias",
    acceleration="machine.acceleration(q, speed, effort)",
)
class Dynamics:
    """The equations of motion at positions and speeds: effort = mass_matrix @ acceleration + bias.

    Made by `Machine.dynamics`. With n drivers every array ends with axes of n, also with one.

    Attributes
    ----------
    mass_matrix : numpy.ndarray
        kg·m² (kg for slides), S + (N, n, n); the rotors of the machine's motors count, which
        `Machine.effort` leaves out.
    d_mass_matrix : numpy.ndarray
        Its derivatives by the coordinates, S + (N, n, n, n), the last axis that of the coordinate.
    bias : numpy.ndarray
        What the drivers give without accelerations, N·m or N, S + (N, n): against Coriolis and
        centrifugal forces, weights and loads.
    gravity : numpy.ndarray
        The part of it that holds the weights, S + (N, n).
    status : numpy.ndarray of uint8
        `Status` of each position; NaN where it has none. ``BAD_INPUT`` where only the bias is NaN
        or infinite: a load without a value there, a speed too great.

    Examples
    --------
    >>> import assur, numpy as np
    >>> machine = assur.Machine(
    ...     assur.SliderCrank(0.1, 0.4), bodies={"piston": assur.Body(mass=20.0)}
    ... )
    >>> now = machine.dynamics(np.pi / 2, speed=10.0)
    >>> now.mass_matrix.round(6), now.bias.round(6)  # kg·m², N·m
    (array([[0.2]]), array([-5.163978]))
    >>> float((now.mass_matrix @ [3.0] + now.bias)[0] - machine.effort(np.pi / 2, 10.0, 3.0))
    0.0
    """

    def __init__(
        self, machine: MachineModel, state: State, on_error: OnError, threads: int | None
    ) -> None:
        mechanism = machine.mechanism
        assert mechanism is not None
        n = machine.driver_count
        self._mechanism = mechanism
        joints = len(mechanism.description.joints)
        jacobians: list[Term] = [("jacobian", joint) for joint in range(joints)]
        found = terms_of(machine, state, TERMS + jacobians, threads)
        if on_error == "raise":
            if found.failure is not None:
                raise found.failure
            require_values(machine, state, found.arrays[2].reshape(-1, n), found.status, "bias is")
        shape = found.shape
        mass, rates, bias, gravity, *each = found.arrays
        status = found.status
        if not np.isfinite(bias).all():
            # A load without a value, or a speed too great for squares.
            lost = ~np.isfinite(bias).reshape(-1, n).all(axis=1) & has_analogues(status)
            status = np.where(lost, np.uint8(Status.BAD_INPUT), status)
        self.status = status.reshape(shape)
        self.mass_matrix = mass.reshape(*shape, n, n)
        self.d_mass_matrix = rates.reshape(*shape, n, n, n)
        self.bias = bias.reshape(*shape, n)
        self.gravity = gravity.reshape(*shape, n)
        self._jacobians = each

    def jacobian(self, joint: str) -> Float:
        """Return the derivatives of a joint's place by the drivers' coordinates.

        Parameters
        ----------
        joint : str
            The joint.

        Returns
        -------
        numpy.ndarray
            m/rad (m/m for slides), S + (N, 2, n).

        Raises
        ------
        InputError
            An unknown joint.

        Examples
        --------
        >>> import assur
        >>> machine = assur.Machine(assur.SliderCrank(0.1, 0.4))
        >>> machine.dynamics(0.0).jacobian("A")
        array([[0. ],
               [0.1]])
        """
        name = checked_name(joint, "jacobian")
        index = self._mechanism.core.index_of("joint", name)
        shape = self.bias.shape
        return self._jacobians[index].reshape(*shape[:-1], 2, shape[-1])

    def __repr__(self) -> str:
        drivers = self.bias.shape[-1]
        many = f"{drivers} drivers" if drivers > 1 else "one driver"
        return f"<assur.Dynamics of {many}, shape {self.status.shape}>"


def acceleration(
    machine: MachineModel, state: State, on_error: OnError, threads: int | None
) -> Float:
    """See `Machine.acceleration`."""
    n = machine.driver_count
    found = terms_of(machine, state, [("acceleration", 0)], threads)
    if on_error == "raise":
        if found.failure is not None:
            raise found.failure
        solved = found.arrays[0].reshape(-1, n)
        if not np.isfinite(solved).all():
            why = terms_of(machine, state, [("mass matrix", 0), ("bias", 0)], threads)
            bias = why.arrays[1].reshape(-1, n)
            require_values(machine, state, bias, found.status, "the acceleration is")
            _require_inertia(machine, why.arrays[0].reshape(-1, n, n), solved, found.q)
    else:
        rows = found.arrays[0].reshape(-1, n)
        # An infinite effort has no acceleration either, in none of the drivers.
        rows[~np.isfinite(rows).all(axis=1)] = np.nan
    full = found.shape if n == 1 else (*found.shape, n)
    result: Float = found.arrays[0].reshape(full)[()]
    return result


def require_values(
    machine: MachineModel,
    state: State,
    values: Float,
    status: npt.NDArray[np.uint8],
    what: str,
) -> None:
    """Raise the error of the first position that exists where a load has no finite value."""
    if np.isfinite(values).all():
        return
    missing = np.flatnonzero(~np.isfinite(values).all(axis=1) & has_analogues(status))
    if not missing.size:
        return
    n, row = values.shape[1], int(missing[0])
    full = (status.size, n)
    q, speed = (
        np.broadcast_to(np.asarray(rates, np.float64).reshape(-1, n), full)
        if np.size(rates) in (n, status.size * n)
        else np.full(full, rates)
        for rates in (state.q, state.speed)
    )
    time = float(np.broadcast_to(np.asarray(state.t), status.size).ravel()[row])
    if machine.varies:
        each = status.size // int(np.prod(machine.shape))
        at = np.unravel_index(row // each, machine.shape)
        machine = machine.design(tuple(int(i) for i in at))
    raise without_value(machine, Moment(q[row], speed[row], time, state.sense), what)


def _require_inertia(machine: MachineModel, mass: Float, solved: Float, q: Float) -> None:
    """Name the drivers whose motion no inertia resists at the first position without a solution."""
    mechanism = machine.mechanism
    assert mechanism is not None
    missing = np.flatnonzero(~np.isfinite(solved).all(axis=1) & np.isfinite(mass).all(axis=(1, 2)))
    if not missing.size:
        return
    row, n = int(missing[0]), machine.driver_count
    drivers = [str(driver) for driver in mechanism.description.drivers]
    place = np.ravel(q)[row * n : row * n + n] if q.size >= (row + 1) * n else np.ravel(q)[:n]
    at = ", ".join(f"{x:.9g}" for x in place.tolist())
    message = (
        f"the mass matrix is singular at q = {at}: {mass[row].tolist()}: give bodies with mass or "
        f"inertia to what {' and '.join(map(repr, drivers))} move"
    )
    raise InputError(message)
