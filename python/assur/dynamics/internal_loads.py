"""Normal force, shear and bending moment inside a link over a motion."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from assur._arrays import in_range
from assur._validate import one_of, whole_number
from assur.dynamics.beam import QUANTITIES
from assur.dynamics.options import one_design
from assur.dynamics.reactions import broadcast_motion
from assur.dynamics.rod import straight_rod
from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from assur._arrays import Float
    from assur.dynamics.beam import Beam
    from assur.dynamics.machine import Machine
    from assur.dynamics.model import OnError
    from assur.dynamics.rod import Rod

__all__ = ["InternalLoads", "LoadExtremes", "Peak"]

# Positions tried at a time between two neighbours of the greatest one, and the last distance, in
# parts of the step: a maximum is known to the square of that.
TRIED = 9
CLOSEST = 1e-8


class LoadExtremes(NamedTuple):
    """The least and greatest value along a link at each position, and where on it.

    Attributes
    ----------
    least, greatest : ndarray
        N or N·m, (N,).
    least_x, greatest_x : ndarray
        Distance from the first joint, m, (N,).
    """

    least: Any
    least_x: Any
    greatest: Any
    greatest_x: Any


class Peak(NamedTuple):
    """The value of greatest size over all positions.

    Attributes
    ----------
    value : float
        With its sign, N or N·m.
    x : float
        Distance from the first joint, m.
    q : float or ndarray
        The driver's coordinate; with n drivers (n,).
    """

    value: float
    x: float
    q: Any


class InternalLoads:
    """What the parts of a link do to each other, by `Machine.internal_loads`.

    Attributes
    ----------
    x : ndarray
        Places along the link from its first joint, m, (n,).
    axial : ndarray
        Normal force, N, (N, n): tension is positive.
    shear : ndarray
        N, (N, n): along the normal to the left of the line, on the part toward the first joint.
    moment : ndarray
        Bending moment on that part, N·m, (N, n), counter-clockwise; its slope is −shear. At a place
        where a load acts, all three are those just beyond it (at the end just before it).
    q : ndarray
        Coordinates of the positions.
    """

    def __init__(
        self,
        rod: Rod,
        beam: Beam,
        x: Float,
        motion: tuple[Float, Float, Float],
        shape: tuple[int, ...],
    ) -> None:
        self._rod, self._beam, self._motion, self._shape = rod, beam, motion, shape
        self.x = x
        drivers = motion[0].shape[1]
        self.q = motion[0].reshape(shape if drivers == 1 else (*shape, drivers))
        self.axial, self.shear, self.moment = (
            beam.at(name, x).reshape(*shape, x.size) for name in QUANTITIES
        )

    def __repr__(self) -> str:
        first, second = self._rod.along
        return f"<assur.InternalLoads of {self._rod.link} along {first}-{second}, {self._shape}>"

    def extremes(self, quantity: str) -> LoadExtremes:
        """Return the least and greatest value along the link at each position.

        Parameters
        ----------
        quantity : {"axial", "shear", "moment"}
            Which one.

        Returns
        -------
        LoadExtremes
            Exact: not of the places `x`, but where the slope vanishes, or at a load.
        """
        one_of(quantity, QUANTITIES, "quantity")
        found = (part.reshape(self._shape)[()] for part in self._beam.extremes(quantity))
        return LoadExtremes(*found)

    def peak(self, quantity: str) -> Peak:
        """Return the value of greatest size over the link and all positions.

        Parameters
        ----------
        quantity : {"axial", "shear", "moment"}
            Which one.

        Returns
        -------
        Peak
            With one driver, one row of ascending or descending coordinates and one speed and
            acceleration for all, refined between the positions; else at one of them. NaN counts
            for nothing.

        Raises
        ------
        InputError
            No position with a value.
        """
        one_of(quantity, QUANTITIES, "quantity")
        value, x = _largest(self._beam, quantity)
        if np.isnan(value).all():
            message = f"no position has a value of {quantity}"
            raise InputError(message)
        size = np.where(np.isnan(value), -1.0, np.abs(value))
        at = int(np.argmax(size))
        q = self._motion[0]
        best = Peak(float(value[at]), float(x[at]), float(q[at, 0]) if q.shape[1] == 1 else q[at])
        steps = np.diff(q[:, 0])
        even = all((part == part[0]).all() for part in self._motion[1:])
        ordered = (steps > 0.0).all() or (steps < 0.0).all()
        if q.shape[1] > 1 or len(self._shape) != 1 or q.size < 2 or not (even and ordered):
            return best
        # Every peak of the row that could be the greatest is refined.
        beside = np.concatenate([[-1.0], size, [-1.0]])
        peaks = np.flatnonzero(
            (size >= beside[:-2]) & (size >= beside[2:]) & (size > 0.8 * size[at])
        )
        # Not toward a position without a value, where loads may grow without a limit.
        before = np.where(beside[peaks] < 0.0, peaks, peaks - 1)
        after = np.where(beside[peaks + 2] < 0.0, peaks, peaks + 1)
        low, high = q[before, 0], q[after, 0]
        return max([best, *self._refined(quantity, low, high)], key=lambda one: abs(one.value))

    def _refined(self, quantity: str, low: Float, high: Float) -> list[Peak]:
        """Return the peaks between positions: the best of a few in between, again and again."""
        first = np.abs(high - low)
        rows = np.arange(low.size)
        part = np.arange(TRIED + 2) / (TRIED + 1.0)
        while True:
            q = low[:, np.newaxis] + part * (high - low)[:, np.newaxis]
            flat = q.reshape(-1, 1)
            speed, acceleration = (np.full(flat.shape, one[0, 0]) for one in self._motion[1:])
            beam = self._rod.solve(flat, speed, acceleration, "nan")
            value, x = (found.reshape(q.shape) for found in _largest(beam, quantity))
            size = np.where(np.isnan(value), -1.0, np.abs(value))
            best = np.argmax(size, axis=1)
            if (np.abs(high - low) <= CLOSEST * first).all():
                known = zip(value[rows, best], x[rows, best], q[rows, best], strict=True)
                return [Peak(float(a), float(b), float(c)) for a, b, c in known if not np.isnan(a)]
            low, high = q[rows, np.maximum(best - 1, 0)], q[rows, np.minimum(best + 1, TRIED + 1)]


def internal_loads(
    machine: Machine,
    link: str,
    q: npt.ArrayLike,
    speed: npt.ArrayLike,
    acceleration: npt.ArrayLike,
    along: Sequence[str] | None,
    density: Any,
    n: int,
    on_error: OnError,
) -> InternalLoads:
    """Return the loads inside a link; see `Machine.internal_loads`."""
    if machine.mechanism is None:
        message = "a machine of a table has no links: internal_loads needs a mechanism"
        raise InputError(message)
    one_design(machine, "internal_loads")
    one_of(on_error, ("raise", "nan"), "on_error")
    whole_number(n, "n", 2)
    rod = straight_rod(machine, machine.mechanism, link, along, density)
    *given, shape = broadcast_motion(machine, q, speed, acceleration)
    drivers = machine._drivers
    full = shape if drivers == 1 else (*shape, drivers)
    flat = [np.broadcast_to(part, full).reshape(-1, drivers) for part in given]
    motion = flat[0], flat[1], flat[2]
    with in_range(f"a load inside {link!r}"):
        beam = rod.solve(*motion, on_error)
        x = np.linspace(0.0, rod.length, n)
        return InternalLoads(rod, beam, x, motion, shape)


def _largest(beam: Beam, quantity: str) -> tuple[Float, Float]:
    """Return the value of greatest size at each position, with its sign, and where it is."""
    least, least_x, greatest, greatest_x = beam.extremes(quantity)
    up = np.abs(greatest) >= np.abs(least)
    return np.where(up, greatest, least), np.where(up, greatest_x, least_x)
