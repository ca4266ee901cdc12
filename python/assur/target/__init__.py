"""Targets of `assur.fit`: what a motion is to be.

A path through points, a function of the driver, poses of a link, and values of metrics. Arrays
alone stand for them where nothing else is said:

>>> import numpy as np
>>> from assur import target
>>> square = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
>>> target.Path(square, closed=True)
Path(4 points, closed)
"""

from __future__ import annotations

from dataclasses import KW_ONLY, dataclass
from typing import TYPE_CHECKING, Literal

from assur._summary import shortened

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur.sweeps.terms import Metric

__all__ = ["Function", "Near", "Path", "Poses"]

# Of a metric that is a long sum.
MOST_LETTERS = 90


@dataclass(frozen=True, eq=False, repr=False)
class Path:
    """Points through which a joint is to pass.

    Parameters
    ----------
    points : array_like
        (N, 2), m.
    timing : array_like, optional
        The driver's coordinate at each point, (N,), rad or m. Without it each point is met wherever
        that is best.
    phase : bool
        Whether the timing holds up to a phase that is free.
    ordered : bool
        Whether points without timing are met in their order, in either direction of the driver.
    closed : bool, optional
        Whether the path leads from the last point to the first; by default if these are the same.
    similarity : bool or "place"
        Whether the path may be moved, turned and scaled; ``"place"`` moves and turns the mechanism.
    weight : float
        How much its residuals count beside those of other targets.
    weights : array_like, optional
        How much each point counts, (N,).

    Examples
    --------
    >>> from assur import target
    >>> target.Path([(0, 0), (1, 0.2), (2, 0)], timing=[0.1, 0.4, 0.7], phase=True)
    Path(3 points, with timing)
    """

    points: npt.ArrayLike
    _: KW_ONLY
    timing: npt.ArrayLike | None = None
    phase: bool = False
    ordered: bool = True
    closed: bool | None = None
    similarity: bool | Literal["place"] = False
    weight: float = 1.0
    weights: npt.ArrayLike | None = None

    def __repr__(self) -> str:
        closed = ", closed" if self.closed is True else ""
        timing = ", with timing" if self.timing is not None else ""
        return f"Path({_count(self.points)} points{closed}{timing})"


@dataclass(frozen=True, eq=False, repr=False)
class Function:
    """Values that a link's angle, a slide or a joint's coordinate is to have.

    Parameters
    ----------
    coordinate : array_like
        Coordinates of the driver, (N,), rad or m.
    value : array_like
        What the output is to be there, (N,), rad (but for whole turns) or m.
    phase : bool
        Whether the driver may begin anywhere.
    offset : bool
        Whether a constant may be added to the output.
    scale : bool
        Whether the output may be multiplied by a constant.
    weight : float
        How much its residuals count beside those of other targets.
    weights : array_like, optional
        How much each position counts, (N,).

    Examples
    --------
    >>> from assur import target
    >>> target.Function([0.0, 0.5, 1.0], [0.0, 0.25, 1.0], offset=True)
    Function(3 positions)
    """

    coordinate: npt.ArrayLike
    value: npt.ArrayLike
    _: KW_ONLY
    phase: bool = False
    offset: bool = False
    scale: bool = False
    weight: float = 1.0
    weights: npt.ArrayLike | None = None

    def __repr__(self) -> str:
        return f"Function({_count(self.coordinate)} positions)"


@dataclass(frozen=True, eq=False, repr=False)
class Poses:
    """Poses that a link is to pass.

    Parameters
    ----------
    poses : array_like
        (N, 3): x and y of the link's first joint, m, and the link's angle, rad, from the first
        joint to the second.
    timing : array_like, optional
        The driver's coordinate at each pose, (N,), rad or m.
    phase : bool
        Whether the timing holds up to a phase that is free.
    turned : bool
        Whether the body may be fixed to the link at any angle: angles then are up to a constant.
    length : float, optional
        What an angle of 1 rad counts, m; by default the root mean square distance of the places
        from their centroid.
    weight : float
        How much its residuals count beside those of other targets.
    weights : array_like, optional
        How much each pose counts, (N,).

    Examples
    --------
    >>> from assur import target
    >>> target.Poses([(0, 0, 0), (1, 0.5, 0.3), (1.5, 1.5, 0.8)])
    Poses(3 poses)
    """

    poses: npt.ArrayLike
    _: KW_ONLY
    timing: npt.ArrayLike | None = None
    phase: bool = False
    turned: bool = False
    length: float | None = None
    weight: float = 1.0
    weights: npt.ArrayLike | None = None

    def __repr__(self) -> str:
        return f"Poses({_count(self.poses)} poses)"


@dataclass(frozen=True, eq=False, repr=False)
class Near:
    """A value that a metric is to be near.

    Parameters
    ----------
    metric : Metric
        The metric.
    value : float
        What it is to be, in its unit.
    unit : float, optional
        What counts as a miss of 1; by default the value's size.

    Examples
    --------
    >>> from assur import metric, target
    >>> target.Near(metric.span("B.x"), 0.1)
    Near(span('B.x'), 0.1)
    """

    metric: Metric
    value: float
    _: KW_ONLY
    unit: float | None = None

    def __repr__(self) -> str:
        return f"Near({shortened(repr(self.metric), MOST_LETTERS)}, {self.value!r})"


def _count(rows: object) -> int | str:
    """Return how many rows an array has, as far as it is one."""
    try:
        return len(rows)  # type: ignore[arg-type]
    except TypeError:
        return "?"
