"""A linkage that was found: its errors, its proof, the report."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from assur.fitting.condition import shown
from assur.fitting.proof import path_coordinates

if TYPE_CHECKING:
    from collections.abc import Mapping

    from matplotlib.axes import Axes

    from assur._arrays import Float
    from assur.fitting.condition import Condition
    from assur.fitting.target import PathTarget
    from assur.kinematics.mechanism import Mechanism

__all__ = ["Fit"]

# Lengths that a report names as the most sensitive.
NAMED = 3
# Positions of the path in a picture.
DRAWN = 361


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Fit:
    """A linkage for a task, measured and proved by the solver; made by `assur.search`.

    Lengths are over the target's root mean square radius, the mean being over its length.

    Attributes
    ----------
    mechanism : Mechanism
        The linkage, drawn where its path begins. The traced joint has the name of the target.
    error : float
        Chamfer distance as placed: the mean distance from the target to the nearest place of the
        path, plus that from the path to the target. Both are polylines.
    ordered_error : float
        2π times the mean squared distance of points at equal parts of both lengths, in order; of a
        closed path with the best start.
    q : ndarray
        For every target point the driver's coordinate at the nearest place of the path, (N,), rad.
    arc : float
        The crank's turn over the path, rad, positive counter-clockwise; the path begins at
        ``mechanism.q0``.
    full_rotation : bool
        Whether the crank goes round, by ``mechanism.limits()``. True of all that is returned.
    transmission_angle : float
        The least angle between the two bars of a dyad over the whole turn, rad.
    extent : float
        Diameter of the circle about the target's centroid that no joint leaves over the whole turn.
    sensitivity : float
        The greatest error after one length has changed by ±1e-3 of itself; infinite if the crank
        then does not go round.
    sensitivities : mapping of str to float
        That of each dimension, the most sensitive first.
    joints : int
        Number of joints.
    seed : int
        Seed of the search.
    elapsed : float
        Time of the search, s.
    evaluations : int
        Linkages that the search evaluated.

    Examples
    --------
    >>> import assur, numpy as np
    >>> hook = [(0.0, 2.0), (0.0, 0.5), (0.4, 0.0), (1.2, 0.2)]
    >>> fit = assur.search({"P": hook}, evaluations=1)[0]
    >>> fit.error < 0.1, fit.full_rotation, fit.joints <= 12
    (True, True, True)
    >>> motion = fit.mechanism.solve(fit.q)
    >>> motion.joint("P").value.shape
    (4, 2)
    """

    mechanism: Mechanism
    error: float
    ordered_error: float
    q: Float
    arc: float
    full_rotation: bool
    transmission_angle: float
    extent: float
    sensitivity: float
    sensitivities: Mapping[str, float]
    joints: int
    seed: int
    elapsed: float
    evaluations: int
    _conditions: tuple[Condition, ...]
    _target: PathTarget

    def report(self) -> str:
        """Return what was found in words: the error, which conditions bind, the proof.

        A condition binds where the linkage is within 3 % of it: relaxing it may lower the error.

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
        lines = [
            f"error {self.error:.3g} of the target's radius, in order {self.ordered_error:.3g}",
            *(condition.line() for condition in self._conditions),
            f"full turn              {'proved by limits()' if self.full_rotation else 'no'}",
            f"lengths ±0.1 % each    error at most {self.sensitivity:.3g}: {sensitive}",
            f"search                 {effort}, seed {self.seed}",
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
        >>> hook = [(0.0, 2.0), (0.0, 0.5), (0.4, 0.0), (1.2, 0.2)]
        >>> list(assur.search({"P": hook}, evaluations=1)[0].cells())
        ['error', 'joints', 'apex', 'extent', 'arc', '±0.1 %']
        """
        return {
            "error": f"{self.error:.3g}",
            "joints": str(self.joints),
            "apex": shown(self.transmission_angle, "°"),
            "extent": f"{self.extent:.3g}",
            "arc": shown(self.arc, "°"),
            "±0.1 %": f"{self.sensitivity:.3g}",
        }

    def plot(self, *, ax: Axes | None = None, dark: bool = False) -> Axes:
        """Draw the linkage where its path begins, the path, and the target (needs matplotlib).

        The target is a broad band: where the path is on it, it lies in its middle.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure by default.
        dark : bool
            For dark backgrounds.

        Returns
        -------
        matplotlib.axes.Axes
            The axes drawn on.

        Raises
        ------
        InputError
            No matplotlib axes.

        Examples
        --------
        >>> import assur
        >>> hook = [(0.0, 2.0), (0.0, 0.5), (0.4, 0.0), (1.2, 0.2)]
        >>> axes = assur.search({"P": hook}, evaluations=1)[0].plot()
        >>> [line.get_gid() for line in axes.lines if line.get_gid() == "target P"]
        ['target P']
        """
        from assur.pictures.linkage.fit import fit_picture

        target = self._target
        motion = self.mechanism.solve(path_coordinates(self.mechanism, self.arc, DRAWN), order=0)
        corners = target.centre + target.radius * target.corners
        return fit_picture(motion, target.joint, corners, ax, dark)

    def __repr__(self) -> str:
        parts = (
            f"error {self.error:.3g}",
            f"{self.joints} joints",
            f"apex {shown(self.transmission_angle, '°')}",
            f"extent {self.extent:.3g}",
            f"arc {shown(self.arc, '°')}",
            f"±0.1 %: {self.sensitivity:.3g}",
        )
        return f"<assur.Fit {', '.join(parts)}>"
