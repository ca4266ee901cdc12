"""Folds of a configuration curve: which ends of branches meet at a dead point of the driver."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from assur.kinematics.curve.elements import SAME, Fold

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.kinematics.curve.branches import Branches
    from assur.kinematics.curve.elements import Branch

# Distance from a dead point, as a fraction of the branch, of positions that extrapolate to it …
BESIDE = 1e-6
# … and at least, in units of the coordinate: dead points are known to less.
NEAREST = 1e-11
# How far a place may go between these positions, as distances below: the extrapolation leaves out
# the cube of it.
STRAIGHT = 1e-3
# Distances from it, as squares, for the roots go as 1, 2 and 3; their weights at a distance of 0.
SQUARES = np.array([1.0, 4.0, 9.0])
WEIGHTS = np.array([3.0, -3.0, 1.0])
# Extrapolations nearer than this are those of one fold.
SAME_FOLD = 1e-4


@dataclass(frozen=True, slots=True)
class End:
    """An end of a branch: 0 the low one, 1 the high one; with its place."""

    branch: int
    side: int
    q: float
    place: Float


@dataclass(slots=True)
class Folds:
    """The ends of the known branches."""

    known: Branches
    _ends: list[End] = field(default_factory=list)
    # Numbers of branches whose ends are listed, and of ends whose partner has been looked for.
    _measured: int = 0
    _looked: int = 0

    def find(self) -> list[Fold]:
        """Pair the ends; a partner that is not known yet is found beside the fold."""
        known = self.known
        self._measure()
        while self._looked < len(self._ends):
            end = self._ends[self._looked]
            self._looked += 1
            if all(_apart(known, end, other) > SAME_FOLD for other in self._ends):
                length = _length(known, known.branches[end.branch])
                known.look_at(end.q + (1 - 2 * end.side) * BESIDE * length)
                self._measure()
        return [
            Fold(a.q, known.groups[a.branch][a.side], (a.branch, b.branch), a.side == 1)
            for a, b in self._pairs()
        ]

    def _measure(self) -> None:
        """Add the ends of branches that are new."""
        known = self.known
        for number in range(self._measured, len(known.branches)):
            sides = enumerate((known.branches[number].low, known.branches[number].high))
            self._ends += [_end(known, number, side, q) for side, q in sides if math.isfinite(q)]
        self._measured = len(known.branches)

    def _pairs(self) -> list[tuple[End, End]]:
        """Return the ends that meet: the nearest first, whatever the order of the branches."""
        near = []
        for i, j in combinations(range(len(self._ends)), 2):
            apart = _apart(self.known, self._ends[i], self._ends[j])
            if apart <= SAME_FOLD:
                near.append((apart, i, j))
        taken: set[int] = set()
        pairs = []
        for _, i, j in sorted(near):
            if taken.isdisjoint((i, j)):
                taken |= {i, j}
                pairs.append((i, j))
        return [(self._ends[i], self._ends[j]) for i, j in sorted(pairs)]


def _length(known: Branches, branch: Branch) -> float:
    return min(branch.high - branch.low, known.unit)


def _end(known: Branches, number: int, side: int, q: float) -> End:
    """Extrapolate the place of a fold: joints go as the square root of the distance from it."""
    branch = known.branches[number]
    inward = 1 - 2 * side
    step = BESIDE * _length(known, branch)
    least = NEAREST * max(known.unit, abs(q))
    places = known.places(branch.assembly, q + inward * step * SQUARES)
    # Where joints nearly coincide a link turns fast.
    while step > least and (far := _distance(places[0], places[1])) > STRAIGHT:
        step = max(least, step * min(0.5, (STRAIGHT / far) ** 2))
        places = known.places(branch.assembly, q + inward * step * SQUARES)
    return End(number, side, q, WEIGHTS @ places)


def _distance(place: Float, other: Float) -> float:
    """Return the distance of two places, in sizes; of joints farther away in their distance.

    Guides that are nearly parallel carry a joint far away, and fast.
    """
    return float((np.abs(place - other) / np.maximum(np.abs(place), 1.0)).max())


def _apart(known: Branches, end: End, other: End) -> float:
    """Return how far apart the places of two ends are; infinite if they cannot meet."""
    if end.side != other.side or end.branch == other.branch:
        return math.inf
    gap = end.q - other.q
    gap = math.remainder(gap, math.tau) if known.is_angle else gap
    apart = _distance(end.place, other.place)
    return apart if abs(gap) <= SAME * known.unit and apart <= SAME_FOLD else math.inf
