"""Sensitivities: derivatives of all results of a motion by a dimension."""

from __future__ import annotations

from typing import TYPE_CHECKING

from assur._validate import checked_name
from assur.errors import InputError
from assur.kinematics.quantity import Analogues

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from assur.kinematics.motion_model import MotionModel
    from assur.kinematics.result_columns import Arrays

__all__ = ["Sensitivity"]


class Sensitivity:
    """Derivatives of a motion by one dimension; made by `Motion.sensitivity`.

    Attributes
    ----------
    dimension : str
        Name of the dimension.
    status : numpy.ndarray of uint8
        `Status` of each position, as for the motion.

    Examples
    --------
    >>> import assur
    >>> motion = assur.FourBar(1.0, 3.0, 2.5, 3.0).solve(1.0)
    >>> motion.sensitivity("coupler.length").link("rocker").value.round(6)  # rad per m
    np.float64(-0.485247)
    """

    def __init__(self, motion: MotionModel, dimension: str) -> None:
        index = motion.mechanism.core.dimension(checked_name(dimension, "sensitivity"))
        outputs = motion.held_indices
        self.dimension = dimension
        self._drivers = motion.mechanism.driver_count
        self._results, self.status = motion.request.derivatives(*outputs, dimension=index)

    def joint(self, name: str) -> Analogues:
        """Return derivatives of a joint's position and analogues, m/m or m/rad, S + (N, 2).

        Parameters
        ----------
        name : str
            The joint.

        Returns
        -------
        Analogues
            Values of shape S + (N, 2).

        Examples
        --------
        The pin B of the crank moves outward by as much as the crank grows:

        >>> import assur
        >>> motion = assur.FourBar(1.0, 3.0, 2.5, 3.0).solve(0.0)
        >>> motion.sensitivity("crank.length").joint("B").value
        array([1., 0.])
        """
        return Analogues(name, self._of("joint", self._results.joints, name), self._drivers, True)

    def link(self, name: str) -> Analogues:
        """Return derivatives of a link's angle and its analogues, rad/m or rad/rad.

        Parameters
        ----------
        name : str
            The link.

        Returns
        -------
        Analogues
            Values of shape S + (N,).

        Examples
        --------
        The crank's angle is q, whatever its length:

        >>> import assur
        >>> motion = assur.FourBar(1.0, 3.0, 2.5, 3.0).solve(1.0)
        >>> motion.sensitivity("crank.length").link("crank").value
        array(0.)
        """
        return Analogues(name, self._of("link", self._results.links, name), self._drivers, False)

    def slide(self, name: str) -> Analogues:
        """Return derivatives of a slide's value and its analogues, m/m or m/rad.

        Parameters
        ----------
        name : str
            The slide.

        Returns
        -------
        Analogues
            Values of shape S + (N,).

        Examples
        --------
        At its far dead point the piston is crank + rod from the centre:

        >>> import assur
        >>> motion = assur.SliderCrank(crank=0.1, rod=0.4).solve(0.0)
        >>> motion.sensitivity("rod.length").slide("bore").value
        array(1.)
        """
        return Analogues(name, self._of("slide", self._results.slides, name), self._drivers, False)

    def _of(self, kind: str, held: Arrays, name: str) -> tuple[npt.NDArray[np.float64], ...]:
        name = checked_name(name, kind)
        if name not in held:
            message = f"{kind} {name!r} was not among the outputs of this motion"
            raise InputError(message, **{kind: name})  # type: ignore[arg-type]
        return held[name]

    def __repr__(self) -> str:
        return f"<sensitivity by {self.dimension!r}, shape {self.status.shape}>"
