"""What was found for a task: a mechanism with its error, its proof, and a report."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from assur.fitting.condition import shown

if TYPE_CHECKING:
    from collections.abc import Mapping

    from assur._arrays import Float
    from assur.fitting.condition import Condition
    from assur.kinematics.mechanism import Mechanism

__all__ = ["Fit"]

# Lengths that a report names as the most sensitive.
NAMED = 3


def angle_cell(angle: float) -> str:
    """Return an angle as texts show it; a dash for none."""
    return "–" if math.isnan(angle) else shown(angle, "°")


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Fit:
    """A mechanism for a task, measured and proved by the solver.

    `assur.fit` makes each as a `DesignFit`, `assur.search` as a `LinkageFit`.

    Attributes
    ----------
    mechanism : Mechanism
        The mechanism.
    error : float
        How far it is from its target.
    q : ndarray
        The driver's coordinate at each point of the target, (N,), rad or m: of a path without
        timing at the nearest place.
    full_rotation : bool
        Whether the driver goes round, by ``mechanism.limits()``.
    transmission_angle : float
        The least transmission angle of a dyad over the travel, rad: over the whole turn, or from
        the first position to the last; NaN of a mechanism without dyads.
    sensitivity : float
        The greatest error after one length has changed by ±1e-3 of itself; infinite if the
        mechanism then does not move as it must.
    sensitivities : mapping of str to float
        That of each dimension, the most sensitive first.
    seed : int
        Seed of the random numbers.
    elapsed : float
        Time that finding it took, s.
    evaluations : int
        Mechanisms that were evaluated.

    Examples
    --------
    >>> import assur
    >>> m = assur.FourBar(1.0, 3.0, 2.5, 3.0, point=(1.5, 1.0))
    >>> arch = [(0.0, 0.0), (0.5, 0.4), (1.0, 0.5), (1.5, 0.4), (2.0, 0.0)]
    >>> fit = assur.fit(m, {"P": arch}, evaluations=1)[0]
    >>> isinstance(fit, assur.Fit), fit.error < 0.01, fit.full_rotation
    (True, True, True)
    """

    mechanism: Mechanism
    error: float
    q: Float
    full_rotation: bool
    transmission_angle: float
    sensitivity: float
    sensitivities: Mapping[str, float]
    seed: int
    elapsed: float
    evaluations: int
    _conditions: tuple[Condition, ...]

    def report(self) -> str:
        """Return what was found in words: the error, which conditions bind, the proof.

        A condition binds where the mechanism is within 3 % of it, a bound where a dimension is at
        it: relaxing it may lower the error.

        Returns
        -------
        str
            A few lines.

        Examples
        --------
        >>> import assur
        >>> hook = [(0.0, 2.0), (0.0, 0.5), (0.4, 0.0), (1.2, 0.2)]
        >>> print(assur.search({"P": hook}, evaluations=1)[0].report())
        error ...
        """
        worst = list(self.sensitivities.items())[:NAMED]
        sensitive = ", ".join(f"{name} {error:.3g}" for name, error in worst)
        effort = f"{self.elapsed:.3g} s, {self.evaluations} evaluated"
        turn = "proved by limits()" if self.full_rotation else "no; the travel is, by limits()"
        lines = [
            self._first_line(),
            *(condition.line() for condition in self._conditions),
            f"{'least transmission':<22} {angle_cell(self.transmission_angle)}",
            f"{'full turn':<22} {turn}",
            f"{'lengths ±0.1 % each':<22} error at most {self.sensitivity:.3g}: {sensitive}",
            f"{'found in':<22} {effort}, seed {self.seed}",
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
            "transmission": angle_cell(self.transmission_angle),
            "full turn": "yes" if self.full_rotation else "no",
            "±0.1 %": f"{self.sensitivity:.3g}",
        }

    def _first_line(self) -> str:
        return f"error {self.error:.4g}"

    def __repr__(self) -> str:
        cells = ", ".join(f"{head} {cell}" for head, cell in self.cells().items())
        return f"<assur.{type(self).__name__} {cells}>"
