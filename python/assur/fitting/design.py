"""A design that a fit has found: its errors, its proof, the report."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Mapping

    from assur._arrays import Float
    from assur.fitting.condition import Condition
    from assur.kinematics.mechanism import Mechanism

__all__ = ["DesignFit"]

# Lengths that a report names as the most sensitive.
NAMED = 3


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class DesignFit:
    """A design for a task, measured and proved by the solver; made by `assur.fit`.

    Attributes
    ----------
    mechanism : Mechanism
        The mechanism with the dimensions and the assembly that were found.
    error : float
        Root mean square of what is missed: of a path the distance of its points over their root
        mean square radius, of poses the same with angles times their length, of a function in rad
        or m, of a metric in units. Of several targets the root mean square of all errors.
    errors : mapping of str to float
        That of each target.
    q : ndarray
        The driver's coordinate at each position of the first target, (N,), rad or m.
    positions : mapping of str to ndarray
        The same of each target.
    full_rotation : bool
        Whether the driver goes round, by ``mechanism.limits()``.
    transmission_angle : float
        The least transmission angle of all dyads over the travel, rad: the whole turn, or from the
        first position to the last.
    sensitivity : float
        The greatest error after one length has changed by ±1e-3 of itself; infinite if the
        mechanism then does not move as it must.
    sensitivities : mapping of str to float
        That of each dimension, the most sensitive first.
    placement : tuple of float or None
        Of a path up to similarity: (a, b, x, y), which take a point p of the mechanism, as a
        complex number, to the target: (a + ib) p + x + iy.
    seed : int
        Seed of the fit.
    elapsed : float
        Time of the fit, s.
    evaluations : int
        Designs that the fit evaluated.

    Examples
    --------
    >>> import assur, numpy as np
    >>> m = assur.FourBar(1.0, 3.0, 2.5, 3.0, point=(1.5, 1.0))
    >>> arch = [(0.0, 0.0), (0.5, 0.4), (1.0, 0.5), (1.5, 0.4), (2.0, 0.0)]
    >>> fit = assur.fit(m, {"P": arch}, evaluations=1)[0]
    >>> fit.error < 0.01, fit.full_rotation
    (True, True)
    >>> fit.mechanism.solve(fit.q).joint("P").value.shape
    (5, 2)
    """

    mechanism: Mechanism
    error: float
    errors: Mapping[str, float]
    q: Float
    positions: Mapping[str, Float]
    full_rotation: bool
    transmission_angle: float
    sensitivity: float
    sensitivities: Mapping[str, float]
    placement: tuple[float, ...] | None
    seed: int
    elapsed: float
    evaluations: int
    _conditions: tuple[Condition, ...]

    def report(self) -> str:
        """Return what was found in words: errors, which conditions bind, the proof.

        A condition or a bound binds where the design is within 3 % of it, or at it: relaxing it
        may lower the error.

        Returns
        -------
        str
            A few lines.

        Examples
        --------
        >>> import assur
        >>> m = assur.FourBar(1.0, 3.0, 2.5, 3.0, point=(1.5, 1.0))
        >>> arch = [(0.0, 0.0), (0.5, 0.4), (1.0, 0.5), (1.5, 0.4), (2.0, 0.0)]
        >>> print(assur.fit(m, {"P": arch}, evaluations=1)[0].report())
        error ...
        """
        worst = list(self.sensitivities.items())[:NAMED]
        sensitive = ", ".join(f"{name} {error:.3g}" for name, error in worst)
        by_target = ", ".join(f"{name} {error:.4g}" for name, error in self.errors.items())
        turn = "proved by limits()" if self.full_rotation else "no; the travel is, by limits()"
        effort = f"{self.elapsed:.3g} s, {self.evaluations} evaluated"
        lines = [
            f"error {self.error:.4g}" + (f" ({by_target})" if len(self.errors) > 1 else ""),
            *(condition.line() for condition in self._conditions),
            f"{'least transmission':<22} {np.rad2deg(self.transmission_angle):.3g}°",
            f"{'full turn':<22} {turn}",
            f"lengths ±0.1 % each    error at most {self.sensitivity:.3g}: {sensitive}",
            f"fit                    {effort}, seed {self.seed}",
        ]
        return "\n".join(lines)

    def cells(self) -> dict[str, str]:
        """Return the cells of a table, by their heads.

        Returns
        -------
        dict of str to str
            What is found in words and numbers.

        Examples
        --------
        >>> import assur
        >>> m = assur.FourBar(1.0, 3.0, 2.5, 3.0, point=(1.5, 1.0))
        >>> arch = [(0.0, 0.0), (0.5, 0.4), (1.0, 0.5), (1.5, 0.4), (2.0, 0.0)]
        >>> list(assur.fit(m, {"P": arch}, evaluations=1)[0].cells())
        ['error', 'transmission', 'full turn', '±0.1 %']
        """
        return {
            "error": f"{self.error:.4g}",
            "transmission": f"{np.rad2deg(self.transmission_angle):.3g}°",
            "full turn": "yes" if self.full_rotation else "no",
            "±0.1 %": f"{self.sensitivity:.3g}",
        }

    def __repr__(self) -> str:
        parts = (
            f"error {self.error:.4g}",
            f"transmission {np.rad2deg(self.transmission_angle):.3g}°",
            "full turn" if self.full_rotation else "no full turn",
            f"±0.1 %: {self.sensitivity:.3g}",
        )
        return f"<assur.DesignFit {', '.join(parts)}>"
