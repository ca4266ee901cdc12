"""Slides and drives of a description, and the statuses of positions."""

from __future__ import annotations

import math
from dataclasses import KW_ONLY, dataclass, field
from enum import IntEnum
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

__all__ = ["Cylinder", "Drive", "Slide", "Status"]

Flags: TypeAlias = npt.NDArray[np.bool_]


class Status(IntEnum):
    """Result of solving one position; the codes of `Motion.status` and other statuses.

    Examples
    --------
    >>> import assur
    >>> motion = assur.FourBar(3.0, 2.5, 2.0, 4.0).solve([0.0, 2.0], on_error="nan")
    >>> [assur.Status(code).name for code in motion.status]
    ['OK', 'UNREACHABLE']
    """

    OK = 0
    """Solved."""
    NEAR_SINGULAR = 1
    """Solved; fewer than six digits of the first analogues may remain.

    Beside a change point second and third analogues lose theirs at lower conditions, while the
    status is `OK`: see `Motion.condition`.
    """
    SINGULAR = 2
    """The position is given; its analogues are NaN, except at a change point.

    Where the joints of a cylinder coincide, its own analogues alone are NaN.
    """
    UNREACHABLE = 3
    """This assembly does not exist at this coordinate (NaN).

    Or the length of a cylinder would be negative there.
    """
    LOST = 4
    """The assembly cannot be followed from the drawing to this q (NaN).

    A group above class II folds before, or a joint passes through infinity; or the assembly of a
    driven angle does not repeat within 64 turns.
    """
    NOT_CONVERGED = 5
    """The iteration of a group above class II did not converge (NaN).

    Or steps of `Machine.step` do not meet their tolerance.
    """
    BAD_DIMENSION = 6
    """A dimension is not finite, not positive, or outside 1e-153 to 1e153 m (NaN)."""
    BAD_INPUT = 7
    """The coordinate is not finite, or several drivers are too far from the drawing (NaN)."""
    NO_VALUE = 8
    """The position is solved, but the quantity asked for has no finite value there (NaN).

    Of reactions: a load has none, as where its table ends. Of a design in a sweep: one of the
    metrics; `Measures.explain` says which and why.
    """


# As plain numbers: NumPy takes ten microseconds to make one of a member.
_UNREACHABLE, _SINGULAR = Status.UNREACHABLE.value, Status.SINGULAR.value


def is_reached(status: npt.ArrayLike) -> Flags:
    """Return whether positions exist, with analogues or without."""
    return np.asarray(status) < _UNREACHABLE


def has_analogues(status: npt.ArrayLike) -> Flags:
    """Return whether positions have analogues, and so results derived from them."""
    return np.asarray(status) < _SINGULAR


@dataclass(frozen=True)
class Slide:
    """A sliding pair: `link` slides along a guide that is fixed to `on`.

    Parameters
    ----------
    link : str
        The sliding link. The slide's value is the distance of its first joint
        along the guide (of its reference point if it has no joint).
    on : str
        The link that carries the guide; the guide turns with it.
    angle : float
        Direction of the guide in the drawing, rad. The guide passes through the sliding point as it
        is drawn.
    origin : str, optional
        The joint of `on` from which the value is measured; without it the value
        is 0 in the drawing.
    along : (str, str), optional
        In place of `angle`: the direction from one joint of the drawing to another.
    length : bool
        Whether the value is a length, which is never negative: that of a `Cylinder` is. Positions
        in which it would be negative do not exist.

    Examples
    --------
    >>> import assur
    >>> assur.Slide("piston", on="ground", angle=0.0, origin="O")
    Slide(link='piston', on='ground', angle=0.0, origin='O', length=False)

    A block in a slot along a lever:

    >>> slot = assur.Slide("block", on="lever", along=("D", "E"), origin="D")
    """

    link: str
    on: str
    _: KW_ONLY
    angle: float = math.nan
    origin: str | None = None
    along: tuple[str, str] | None = field(default=None, repr=False)
    length: bool = False


@dataclass(frozen=True)
class Cylinder:
    """A cylinder between two joints: a barrel on the one, a rod on the other, and their slide.

    Given among the slides of a `Mechanism`; the slide's value is the distance of the joints, m. It
    is never negative: a driven cylinder begins at length 0, and one that is not driven points from
    its base to its end in every assembly.

    Parameters
    ----------
    base : str
        The joint of the barrel.
    end : str
        The joint of the rod.
    barrel, rod : str, optional
        Names of the two links; by default the cylinder's with ``_barrel`` and ``_rod``.

    Notes
    -----
    Where both joints coincide the direction of the cylinder is not determined: the position is
    `Status.SINGULAR`. A motion through that point goes on with a length that grows again; the
    cylinder has then turned by half a turn at once, counter-clockwise as q grows (by convention).

    Examples
    --------
    A boom that a cylinder lifts:

    >>> import assur
    >>> boom = assur.Mechanism(
    ...     joints={"foot": (0, 0), "eye": (2, 1), "base": (1, -1)},
    ...     links={"ground": ["foot", "base"], "boom": ["foot", "eye"]},
    ...     slides={"lift": assur.Cylinder("base", "eye")},
    ...     driver="lift",
    ... )
    >>> boom.q0 == 5**0.5, boom.links["lift_rod"]
    (True, ('eye',))
    >>> boom.limits()
    <assur.Limits [0.821854, 3.65028], does not close>
    """

    base: str
    end: str
    _: KW_ONLY
    barrel: str | None = None
    rod: str | None = None


@dataclass(frozen=True)
class Drive:
    """A driven angle between any two links: q is the difference of their angles.

    Parameters
    ----------
    link : str
        The driven link.
    relative_to : str, optional
        The link relative to which the angle is measured; they need not share a joint.

    Examples
    --------
    >>> import assur
    >>> assur.Drive("forearm", relative_to="upper_arm")
    Drive(link='forearm', relative_to='upper_arm')
    """

    link: str
    _: KW_ONLY
    relative_to: str = "ground"


# What drives: a link or a slide by its name, or an angle between two links.
DriverLike: TypeAlias = str | Drive
