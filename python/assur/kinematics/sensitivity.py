"""Derivatives of a motion: sensitivities by a dimension, Jacobians by drivers or dimensions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, TypeAlias

import numpy as np

from assur._arrays import short
from assur._validate import checked_name, whole_number
from assur.errors import InputError
from assur.kinematics.quantity import Analogues

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur._arrays import Float
    from assur.kinematics.motion_model import MotionModel
    from assur.kinematics.result_columns import Arrays

__all__ = ["Sensitivity", "jacobian"]

Kind: TypeAlias = Literal["joint", "link", "slide"]
# Letters that make a name of a dimension a pattern.
WILD = "*?["


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
        self._results, self.status, _ = motion.request.arrays(*outputs, dimension=index)

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


def jacobian(motion: MotionModel, of: str, by: Any, order: int) -> Float:
    """See `Motion.jacobian`."""
    kind = _kind(motion, checked_name(of, "jacobian"))
    order = whole_number(order, "order", 0, 3)
    if isinstance(by, str) and by == "q":
        analogues = getattr(motion, kind)(of)._order(order + 1)
        # One driver has no axis of its own.
        result: Float = analogues[..., np.newaxis] if motion.driver_count == 1 else analogues
        return result
    getattr(motion, kind)(of)._order(order)
    names = _dimensions(motion, by)
    columns = [_derivative(motion, kind, of, name)[order] for name in names]
    shape = getattr(motion, kind)(of).arrays[order].shape
    return np.stack(columns, axis=-1) if columns else np.empty((*shape, 0))


def _kind(motion: MotionModel, of: str) -> Kind:
    """Return what has this name among the outputs of the motion: a joint, a link or a slide."""
    results = motion._results
    if of in results.joints:
        return "joint"
    if of in results.links:
        return "link"
    if of in results.slides:
        return "slide"
    names = [*results.joints, *results.links, *results.slides]
    message = (
        f"jacobian of {of!r}: there is no such output of this motion; there are "
        f"{', '.join(map(repr, names))}"
    )
    raise InputError(message)


def _dimensions(motion: MotionModel, by: Any) -> list[str]:
    """Return the names that are given, with those that patterns stand for, in their order."""
    given = [by] if isinstance(by, str) else by
    if not isinstance(given, list | tuple):
        message = f'by is {short(by)}: "q", or names of dimensions such as ["coupler.length"]'
        raise InputError(message)
    from fnmatch import fnmatchcase

    known = motion.request.mechanism.core.dimension_names
    names: list[str] = []
    for name in given:
        if isinstance(name, str) and any(letter in name for letter in WILD):
            fitting = [dimension for dimension in known if fnmatchcase(dimension, name)]
            if not fitting:
                message = f"by: no dimension is like {name!r}; there are {', '.join(known)}"
                raise InputError(message)
            names += fitting
        else:
            checked = checked_name(name, "by")
            motion.request.mechanism.core.dimension(checked)
            names.append(checked)
    return names


def _derivative(motion: MotionModel, kind: Kind, of: str, dimension: str) -> tuple[Float, ...]:
    """Return the derivatives of the output's value and analogues by a dimension."""
    core = motion.request.mechanism.core
    index = {of: core.index_of(kind, of)}
    joints, links, slides = (index if kind == each else {} for each in ("joint", "link", "slide"))
    by = core.dimension(dimension)
    results, _, _ = motion.request.arrays(joints, links, slides, dimension=by)
    held = {"joint": results.joints, "link": results.links, "slide": results.slides}[kind]
    arrays: tuple[Float, ...] = held[of]
    return arrays
