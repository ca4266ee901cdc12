"""What all generations have found: a front of a size asked for, from end to end.

A population keeps its designs apart, so that it comes no nearer to the front than about their
distance; of all designs measured ever far more are undominated, and these are nearer.

Source: H. Ishibuchi, L. M. Pang, K. Shang, "A new framework of evolutionary multi-objective
algorithms with an unbounded external archive", ECAI 2020; the choice of designs far from each
other is that of T. F. Gonzalez, "Clustering to minimize the maximum intercluster distance",
Theoretical Computer Science 38 (1985) 293-306.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assur.fitting.pareto.objectives import undominated

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur._arrays import Float

# Designs that are held before those dominated go, and of the others the nearest to each other; and
# how many stay, over the size of the front.
MOST, KEPT = 20_000, 10


class Archive:
    """Designs that keep all conditions, by their places and costs, for a front of some size."""

    def __init__(self, size: int) -> None:
        self._size = size
        self._parts: list[tuple[Float, Float]] = []
        self._count = 0

    def add(self, places: Float, costs: Float) -> None:
        """Add designs: places (n, D) and costs (n, M)."""
        self._parts.append((places, costs))
        self._count += len(places)
        if self._count > MOST:
            self._parts = [self._front(min(KEPT * self._size, MOST // 2))]
            self._count = len(self._parts[0][0])

    def front(self) -> Float:
        """Return the places (n, D) of designs that no other dominates, at most the size."""
        return self._front(self._size)[0] if self._count else np.zeros((0, 0))

    def _front(self, count: int) -> tuple[Float, Float]:
        places, costs = (np.concatenate(part) for part in zip(*self._parts, strict=True))
        best = undominated(costs)
        best = best[far_apart(costs[best], count)]
        return places[best], costs[best]


def far_apart(costs: Float, count: int) -> npt.NDArray[np.intp]:
    """Return at most so many rows, ascending: the least of each column, then the farthest each.

    Distances are over the range of each column.
    """
    if len(costs) <= count:
        return np.arange(len(costs))
    size = np.ptp(costs, axis=0)
    points = costs / np.where(size > 0.0, size, 1.0)
    chosen = list(dict.fromkeys(points.argmin(axis=0).tolist()))[:count]
    away = np.min([_squares(points, row) for row in chosen], axis=0)
    while len(chosen) < count:
        row = int(away.argmax())
        chosen.append(row)
        away = np.minimum(away, _squares(points, row))
    return np.sort(np.array(chosen, dtype=np.intp))


def _squares(points: Float, row: int) -> Float:
    """Return the squares of the distances from a row."""
    squares: Float = ((points - points[row]) ** 2).sum(axis=1)
    return squares
