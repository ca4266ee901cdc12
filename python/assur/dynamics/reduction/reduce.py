"""Reduced inertia and moment at many coordinates, and the error of the first without a value."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from assur._arrays import Float, real_array
from assur._summary import summary
from assur._validate import one_of
from assur.description.words import has_analogues
from assur.dynamics.reduction.reduced import answer
from assur.dynamics.reduction.undefined_load import EXTEND, Moment, without_value
from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur.dynamics.model import MachineModel


class Reduced(NamedTuple):
    """The reduced inertia and its exact derivative.

    Attributes
    ----------
    value : ndarray
        kg·m² (driven slide: kg); for n drivers the mass matrix, (..., n, n).
    d1 : ndarray
        Its derivative by the coordinate; for n drivers (..., n, n, n), the last axis that of the
        coordinate.

    Examples
    --------
    >>> import assur, numpy as np
    >>> machine = assur.Machine(
    ...     assur.SliderCrank(0.1, 0.4), bodies={"piston": assur.Body(mass=20.0)}
    ... )
    >>> reduced = machine.reduced_inertia(np.pi / 2)  # the piston moves as fast as the pin
    >>> reduced.value.round(6), reduced.d1.round(6)  # kg·m², kg·m²/rad
    (np.float64(0.2), np.float64(-0.10328))
    """

    value: Float
    d1: Float

    def __repr__(self) -> str:
        return summary(self)


def reduce(
    machine: MachineModel,
    q: npt.ArrayLike,
    speed: npt.ArrayLike | None,
    on_error: str,
    t: npt.ArrayLike = 0.0,
    sense: float | Sequence[float] | None = None,
) -> tuple[Float, Float, Float, Float]:
    """Return mass matrices, their derivatives, moments and potential energies.

    Without a speed no function is called, and the moments are not valid.
    """
    one_of(on_error, ("raise", "nan"), "on_error")
    reduced = answer(machine, q, speed, t, sense)
    if on_error == "raise":
        if reduced.failure is not None:
            raise reduced.failure
        _require_within_table(machine, reduced.q, reduced.status)
    if speed is not None and on_error == "raise":
        n = machine.driver_count
        has_value = np.isfinite(reduced.moment).reshape(-1, n).all(axis=1)
        missing = np.flatnonzero(~has_value & has_analogues(reduced.status))
        if missing.size:
            row = int(missing[0])
            if machine.mechanism is None:
                raise _beyond_table(float(reduced.q[row]), machine.core.tables[0][0])
            single_machine, design = single(machine, row, reduced.status.size)
            place = reduced.q.reshape(-1, n)[row], reduced.speed.reshape(-1, n)[row]
            time = float(np.broadcast_to(np.asarray(t), reduced.shape).ravel()[row])
            failed = without_value(single_machine, Moment(*place, time, sense), "the moment is")
            failed.design = design
            raise failed
    return reduced.inertia, reduced.rates, reduced.moment, reduced.potential


def reduced_inertia(machine: MachineModel, q: npt.ArrayLike, on_error: str = "raise") -> Reduced:
    """See `Machine.reduced_inertia`."""
    inertia, rates, _, _ = reduce(machine, q, None, on_error)
    if machine.driver_count == 1:
        return Reduced(inertia[..., 0, 0][()], rates[..., 0, 0, 0][()])
    return Reduced(inertia, np.moveaxis(rates, -3, -1))


def reduced_moment(
    machine: MachineModel, q: npt.ArrayLike, speed: npt.ArrayLike = 0.0, on_error: str = "raise"
) -> Float:
    """See `Machine.reduced_moment`."""
    moment = reduce(machine, q, real_array(speed, "speed"), on_error)[2]
    return moment[..., 0][()] if machine.driver_count == 1 else moment


def potential(machine: MachineModel, q: npt.ArrayLike, on_error: str = "raise") -> Float:
    """See `Machine.potential`."""
    energies = reduce(machine, q, None, on_error)[3]
    if on_error == "raise":
        _require_potential(machine, q, energies)
    return energies[()]


def _require_potential(machine: MachineModel, q: npt.ArrayLike, energies: Float) -> None:
    """Raise the error of the first position without a potential energy: beyond a load's table."""
    missing = np.flatnonzero(np.isnan(energies))
    if not missing.size:
        return
    n, row = machine.driver_count, int(missing[0])
    x = real_array(q, "q")
    places = np.broadcast_to(x, energies.shape if n == 1 else (*energies.shape, n))
    single_machine, design = single(machine, row, energies.size)
    # At no speed the loads of one sense only need none.
    moment = Moment(places.reshape(-1, n)[row], np.zeros(n), 0.0, [1.0] * n if n > 1 else 1.0)
    failed = without_value(single_machine, moment, "the potential energy is")
    failed.design = design
    raise failed


def single(machine: MachineModel, row: int, positions: int) -> tuple[MachineModel, Any]:
    """Return the machine of the design of a flat position, and the design's index in a batch."""
    if not machine.shape or machine.mechanism is None:
        return machine, None
    design = row // max(1, positions // math.prod(machine.shape))
    index = tuple(int(i) for i in np.unravel_index(design, machine.shape))
    if machine.varies:
        return machine.design(index), index
    mechanism = machine.mechanism.design(index)
    one = type(machine)(mechanism, bodies=machine.bodies, loads=machine.loads, motor=machine.motor)
    return one, index


def _require_within_table(machine: MachineModel, q: Float, status: npt.NDArray[np.uint8]) -> None:
    if machine.mechanism is not None:
        return
    beyond = np.flatnonzero(~has_analogues(status))
    if beyond.size:
        raise _beyond_table(float(q[beyond[0]]), machine.core.tables[0][0])


def _beyond_table(q: float, knots: list[float]) -> InputError:
    hint = EXTEND
    message = (
        f"a table over q covers {knots[0]:.9g} to {knots[-1]:.9g}: {q:.9g} is not in it; {hint}"
    )
    return InputError(message, kind="table_ends", hint=hint, q=q, value=q)
