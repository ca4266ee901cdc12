"""Normal force, shear and bending moment inside a link over a motion."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from assur._arrays import in_range
from assur._other_names import other_names
from assur._summary import summary
from assur._validate import MAX_POINTS, one_of, whole_number
from assur.dynamics.forces.kinetostatics import broadcast_motion
from assur.dynamics.internal.beam import QUANTITIES
from assur.dynamics.internal.load_extremes import MEASURES, Peak, find_peak
from assur.dynamics.internal.rod import straight_rod
from assur.dynamics.motion.motion_input import DrivenMotion, times
from assur.dynamics.preconditions import one_design
from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur._arrays import Float
    from assur.dynamics.internal.beam import Beam
    from assur.dynamics.internal.rod import Rod
    from assur.dynamics.model import MachineModel, OnError

__all__ = ["InternalLoads", "LoadExtremes"]


@other_names(
    least="it is min", greatest="it is max", least_x="it is min_x", greatest_x="it is max_x"
)
class LoadExtremes(NamedTuple):
    """The least and greatest value along a link at each position, and where on it.

    Attributes
    ----------
    min, max : ndarray
        N or N·m, (N,).
    min_x, max_x : ndarray
        Distance from the first joint, m, (N,).

    Examples
    --------
    >>> import assur, numpy as np
    >>> force = assur.Force("B", (-1000.0, 0.0), on="piston")
    >>> machine = assur.Machine(assur.SliderCrank(crank=0.3, rod=0.5), loads=[force])
    >>> machine.internal_loads("rod", np.pi / 2).extremes("axial").min.round(6)  # N
    np.float64(-1250.0)
    """

    min: Float
    min_x: Float
    max: Float
    max_x: Float

    def __repr__(self) -> str:
        return summary(self)


class InternalLoads:
    """The loads between the parts of a link, by `Machine.internal_loads`.

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

    Examples
    --------
    A rod that is pressed along its line carries neither shear nor bending:

    >>> import assur, numpy as np
    >>> force = assur.Force("B", (-1000.0, 0.0), on="piston")
    >>> machine = assur.Machine(assur.SliderCrank(crank=0.3, rod=0.5), loads=[force])
    >>> inside = machine.internal_loads("rod", np.pi / 2)
    >>> inside.axial[..., 0].round(6), inside.shear[..., 0].round(6)  # N: −1000 · 5/4
    (np.float64(-1250.0), np.float64(0.0))
    """

    def __init__(
        self,
        rod: Rod,
        beam: Beam,
        x: Float,
        motion: DrivenMotion,
        shape: tuple[int, ...],
    ) -> None:
        self._rod, self._beam, self._motion, self._shape = rod, beam, motion, shape
        self.x = x
        drivers = motion.q.shape[1]
        self.q = motion.q.reshape(shape if drivers == 1 else (*shape, drivers))
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
            Exact: not sampled at `x`, but found where the slope vanishes, or at a load.

        Examples
        --------
        >>> import assur, numpy as np
        >>> rod = assur.Body(mass=1.2, inertia=1.2 * 0.35**2 / 12, at=(0.175, 0.0))
        >>> machine = assur.Machine(assur.SliderCrank(0.1, 0.35), bodies={"rod": rod})
        >>> inside = machine.internal_loads("rod", np.pi / 2, speed=100.0)
        >>> found = inside.extremes("moment")
        >>> print(f"{found.min:.2f} N·m at {found.min_x:.3f} m")
        -23.77 N·m at 0.144 m
        """
        one_of(quantity, QUANTITIES, "quantity")
        extremes = (part.reshape(self._shape)[()] for part in self._beam.extremes(quantity))
        return LoadExtremes(*extremes)

    def peak(self, quantity: str, *, of: str = "size") -> Peak:
        """Return the extreme of a quantity over the link and all positions.

        Parameters
        ----------
        quantity : {"axial", "shear", "moment"}
            Which one.
        of : {"size", "max", "min"}
            The value of greatest size, the greatest (of `axial` the tension), or the least one.

        Returns
        -------
        Peak
            With one driver, one row of ascending or descending coordinates and one speed and
            acceleration for all, refined between the positions; otherwise at one of them. NaN is
            ignored.

        Raises
        ------
        InputError
            No position with a value.

        Examples
        --------
        >>> import assur, numpy as np
        >>> rod = assur.Body(mass=1.2, inertia=1.2 * 0.35**2 / 12, at=(0.175, 0.0))
        >>> machine = assur.Machine(assur.SliderCrank(0.1, 0.35), bodies={"rod": rod})
        >>> inside = machine.internal_loads("rod", np.linspace(0.0, np.pi, 37), speed=100.0)
        >>> peak = inside.peak("moment")
        >>> print(f"{peak.value:.2f} N·m at {peak.x:.3f} m, {np.degrees(peak.q):.1f}°")
        -28.12 N·m at 0.152 m, 61.4°
        """
        one_of(quantity, QUANTITIES, "quantity")
        one_of(of, MEASURES, "of")
        is_row = len(self._shape) == 1
        return find_peak(self._rod, self._beam, self._motion, is_row, quantity, of)


def internal_loads(
    machine: MachineModel,
    link: str,
    motion: DrivenMotion,
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
    whole_number(n, "n", 2, MAX_POINTS)
    rod = straight_rod(machine, machine.mechanism, link, along, density)
    *parts, shape = broadcast_motion(machine, motion)
    drivers = machine.driver_count
    full = shape if drivers == 1 else (*shape, drivers)
    q, speed, acceleration = (np.broadcast_to(part, full).reshape(-1, drivers) for part in parts)
    senses = motion.senses
    if senses is not None:
        senses = senses.reshaped(shape).flat()
    each = DrivenMotion(q, speed, acceleration, times(motion.t, shape).ravel(), senses)
    with in_range(f"a load inside {link!r}"):
        beam = rod.solve(each, on_error)
        x = np.linspace(0.0, rod.length, n)
        return InternalLoads(rod, beam, x, each, shape)
