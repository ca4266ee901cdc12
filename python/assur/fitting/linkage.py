"""A linkage that a search has found: its errors, what it looks like."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from assur.fitting.condition import shown
from assur.fitting.found import Fit
from assur.fitting.proof import path_coordinates

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from assur.fitting.target import PathTarget

__all__ = ["LinkageFit"]

# Positions of the path in a picture.
DRAWN = 361


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class LinkageFit(Fit):
    """A linkage that draws a path; made by `assur.search`.

    Beside what every `Fit` has. Its `error` is the Chamfer distance as placed: the mean distance
    from the target to the nearest place of the path, plus that from the path to the target, both
    polylines, over the target's root mean square radius. It is drawn where its path begins.

    Attributes
    ----------
    ordered_error : float
        2π times the mean squared distance of points at equal parts of both lengths, in order; of a
        closed path with the best start.
    arc : float
        The crank's turn over the path, rad, positive counter-clockwise; the path begins at
        ``mechanism.q0``.
    extent : float
        Diameter of the circle about the target's centroid that no joint leaves over the whole turn.
    joints : int
        Number of joints.

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

    ordered_error: float
    arc: float
    extent: float
    joints: int
    _target: PathTarget

    def _first_line(self) -> str:
        return f"error {self.error:.3g} of the target's radius, in order {self.ordered_error:.3g}"

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
