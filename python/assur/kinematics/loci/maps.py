"""Maps over two dimensions: where a mechanism turns fully, and in how many ways it assembles."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import short
from assur._validate import one_of, real_array
from assur.errors import InputError
from assur.kinematics.assemblies import assemblies
from assur.kinematics.limits import limits
from assur.kinematics.loci.bisection import Edge, bisected
from assur.kinematics.named_dimensions import with_dimensions

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt
    from matplotlib.axes import Axes

    from assur._arrays import Float
    from assur.kinematics.model import MechanismModel

__all__ = ["Boundary", "DesignMap"]

# Halvings of the distance of two neighbours, until boundaries are found to a billionth of it.
HALVINGS = 30
# Most values of a dimension, and beyond the greatest length that the core takes.
MOST = 2000
HUGE = 1e160


@dataclass(frozen=True, slots=True, eq=False)
class Boundary:
    """A line between designs of different kinds.

    Attributes
    ----------
    points : ndarray
        Values of both dimensions along it, shape (N, 2), m or rad.
    level : int
        On one side the number is at least this, on the other less.
    is_closed : bool
        Whether the last point is the first; it ends at the edge of the map otherwise.

    Examples
    --------
    >>> import assur, numpy as np
    >>> lengths = np.linspace(1.5, 3.5, 5)
    >>> over = {"rocker.length": lengths, "ground.D.x": lengths}
    >>> edge = assur.FourBar(1.0, 3.0, 2.5, 3.0).map("full_rotation", over).boundaries[0]
    >>> edge.points.shape[1], edge.level, edge.is_closed
    (2, 1, False)
    """

    points: Float
    level: int
    is_closed: bool

    def __repr__(self) -> str:
        form = "closed" if self.is_closed else "open"
        return f"<assur.Boundary at {self.level}, {form}, {len(self.points)} points>"


@dataclass(frozen=True, slots=True, eq=False)
class DesignMap:
    """A number of every design over two dimensions.

    Attributes
    ----------
    of : str
        What was counted: ``"full_rotation"`` (1 or 0) or ``"assemblies"``.
    names : (str, str)
        The two dimensions.
    x, y : ndarray
        Their values, m or rad.
    values : ndarray of int
        Shape (len(x), len(y)).
    boundaries : tuple of Boundary
        Where the values change, each point to a billionth of the distance of two neighbours.

    Examples
    --------
    Where a four-bar's crank goes round, by Grashof's rule:

    >>> import assur
    >>> over = {"rocker.length": [1.5, 2.5, 3.5], "ground.D.x": [1.5, 3.0]}
    >>> found = assur.FourBar(1.0, 3.0, 2.5, 3.0).map("full_rotation", over)
    >>> found.values
    array([[0, 1],
           [1, 1],
           [1, 1]])
    """

    of: str
    names: tuple[str, str]
    x: Float
    y: Float
    values: npt.NDArray[np.intp]
    boundaries: tuple[Boundary, ...]

    def plot(self, *, ax: Axes | None = None, dark: bool = False) -> Axes:
        """Draw regions by their number, with names, and the boundaries (needs matplotlib).

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure by default.
        dark : bool
            For dark backgrounds.

        Returns
        -------
        matplotlib.axes.Axes
            The axes drawn on. Data are in m and rad; the ticks are written in the units that suit.

        Examples
        --------
        >>> import assur, numpy as np
        >>> lengths = np.linspace(0.5, 5.5, 11)
        >>> over = {"rocker.length": lengths, "ground.D.x": lengths}
        >>> axes = assur.FourBar(1.0, 3.0, 2.5, 3.0).map("full_rotation", over).plot()
        >>> sorted(text.get_text() for text in axes.texts)
        ['goes round', 'stops']
        """
        from assur.pictures.maps.counts import design_map_picture

        return design_map_picture(self, ax, dark)

    def __repr__(self) -> str:
        shape = " x ".join(str(n) for n in self.values.shape)
        return f"<assur.DesignMap of {self.of}, {shape}, {len(self.boundaries)} boundaries>"


def design_map(
    mechanism: MechanismModel, of: str, dimensions: Mapping[str, npt.ArrayLike], q: Any
) -> DesignMap:
    """See `Mechanism.map`."""
    one_of(of, ("assemblies", "full_rotation"), "of")
    if mechanism.shape:
        message = f"map() is over dimensions of one design, this is a batch {mechanism.shape}"
        raise InputError(message)
    mapping: Any = dimensions
    if not isinstance(mapping, Mapping) or len(mapping) != 2:
        message = f"{short(mapping)}: two dimensions, each with ascending values, are needed"
        raise InputError(message)
    where = _checked_place(mechanism, of, q)
    (first, second), (x, y) = (
        dimensions,
        [_checked_axis(name, values) for name, values in dimensions.items()],
    )

    def look_at(places: Float) -> list[int]:
        batch = with_dimensions(mechanism, {first: places[:, 0], second: places[:, 1]})
        if of == "full_rotation":
            return [int(whole) for whole in np.asarray(limits(batch).full_rotation).tolist()]
        return [len(found) for found in assemblies(batch, where)]

    places = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1)
    values = np.array(look_at(places.reshape(-1, 2)), dtype=np.intp).reshape(len(x), len(y))
    boundaries = [
        boundary
        for level in np.unique(values)[1:].tolist()
        for boundary in _boundaries(places, values, level, look_at)
    ]
    return DesignMap(of, (first, second), x, y, values, tuple(boundaries))


def _checked_place(mechanism: MechanismModel, of: str, q: Any) -> Any:
    """Return the coordinate at which assemblies are counted."""
    if q is None:
        return mechanism.q0
    if of != "assemblies":
        message = f"q is {short(q)}: full rotation is about all coordinates, q is for assemblies"
        raise InputError(message)
    where, drivers = real_array(q, "q"), mechanism.driver_count
    if where.shape != ((drivers,) if drivers > 1 else ()) or not np.isfinite(where).all():
        message = f"q is {short(q)}: one finite position is needed"
        raise InputError(message)
    return where


def _checked_axis(name: str, values: npt.ArrayLike) -> Float:
    axis = real_array(values, str(name))
    is_axis = axis.ndim == 1 and 2 <= len(axis) <= MOST and bool((np.abs(axis) < HUGE).all())
    if not is_axis or not (np.diff(axis) > 0.0).all():
        message = f"{name} is {short(values)}: from 2 to {MOST} ascending values are needed"
        raise InputError(message)
    return axis


def _boundaries(
    places: Float,
    values: npt.NDArray[np.intp],
    level: int,
    look_at: Callable[[Float], list[int]],
) -> list[Boundary]:
    """Return the lines around designs whose number is at least a level: marching squares."""
    inside = values >= level
    sides, edges = [], []
    for along in (0, 1):
        here, there = (slice(None, -1), slice(1, None))
        low = inside[here] if along == 0 else inside[:, here]
        high = inside[there] if along == 0 else inside[:, there]
        for i, j in np.argwhere(low != high).tolist():
            end = (i + 1, j) if along == 0 else (i, j + 1)
            sides.append((i, j, along))
            edges.append(Edge(np.array([places[i, j], places[end]]), [values[i, j], values[end]]))
    narrow, _ = bisected(edges, look_at, lambda value: value >= level, HALVINGS)
    points = {side: edge.ends.mean(axis=0) for side, edge in zip(sides, narrow, strict=True)}
    joined: dict[Any, list[Any]] = {side: [] for side in sides}
    saddles = []
    for i, j in np.ndindex(inside.shape[0] - 1, inside.shape[1] - 1):
        around = [(i, j, 0), (i + 1, j, 1), (i, j + 1, 0), (i, j, 1)]
        crossed = [side for side in around if side in points]
        if len(crossed) == 4:
            saddles.append((i, j, around))
        elif crossed:
            _join(joined, *crossed)
    if saddles:
        # Opposite corners are alike: the middle shows which of them are connected.
        middles = np.array([places[i : i + 2, j : j + 2].mean(axis=(0, 1)) for i, j, _ in saddles])
        for (i, j, around), value in zip(saddles, look_at(middles), strict=True):
            bottom, right, top, left = around
            if (value >= level) == inside[i, j]:
                _join(joined, bottom, right)
                _join(joined, top, left)
            else:
                _join(joined, bottom, left)
                _join(joined, top, right)
    return _lines(points, joined, level)


def _join(joined: dict[Any, list[Any]], first: Any, second: Any) -> None:
    joined[first].append(second)
    joined[second].append(first)


def _lines(points: dict[Any, Float], joined: dict[Any, list[Any]], level: int) -> list[Boundary]:
    """Chain sides that are joined, open lines from their ends first."""
    lines = []
    free = dict.fromkeys(sorted(points, key=lambda side: len(joined[side])))
    while free:
        side = next(iter(free))
        chain = [side]
        del free[side]
        while True:
            side = next((next_side for next_side in joined[chain[-1]] if next_side in free), None)
            if side is None:
                break
            chain.append(side)
            del free[side]
        is_closed = len(chain) > 2 and chain[0] in joined[chain[-1]]
        along = [points[crossed] for crossed in chain]
        lines.append(
            Boundary(np.array([*along, along[0]] if is_closed else along), level, is_closed)
        )
    return lines
