"""Designs of a population, measured side by side: what they cost, and what they miss."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from assur.sweeps.designs import Designs
from assur.sweeps.measuring import Measuring

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur._arrays import Float
    from assur.dynamics.machine import Machine
    from assur.fitting.pareto.objectives import Objective
    from assur.fitting.variables import Variables
    from assur.kinematics.mechanism import Mechanism
    from assur.sweeps.terms import Condition


class Scores(NamedTuple):
    """What a population is ranked by.

    Attributes
    ----------
    costs : ndarray
        Of each goal what is to be small, (n, M); 0 of designs that do not move.
    misses : ndarray
        How far a design is from keeping all conditions, (n,): 0 if it keeps them.
    """

    costs: Float
    misses: Float


@dataclass(slots=True)
class Candidates:
    """The space of designs: each is a point of the unit cube of its variables.

    Attributes
    ----------
    evaluations : int
        Designs measured so far.
    moving : int
        Those of them that move over all positions and have all metrics.
    nearest : ndarray
        By how much of its unit the nearest of these misses each condition, (C,).
    """

    mechanism: Mechanism
    machine: Machine | None
    objectives: list[Objective]
    # The goals, with the conditions that designs keep.
    measuring: Measuring
    variables: Variables
    evaluations: int = 0
    moving: int = 0
    nearest: Float = field(default_factory=lambda: np.full(0, np.inf))
    _search: Measuring = field(init=False)

    def __post_init__(self) -> None:
        # A condition drops a design; a search must know how near it is.
        asked = {f"goal {i}": goal.metric for i, goal in enumerate(self.objectives)}
        asked |= {f"condition {i}": one.metric for i, one in enumerate(self.conditions)}
        given = self.measuring
        self._search = Measuring(self.mechanism, self.machine, given.q, asked, None, given.threads)

    @property
    def conditions(self) -> list[Condition]:
        """What designs keep."""
        return self.measuring.conditions

    @property
    def size(self) -> int:
        """Number of variables."""
        return len(self.variables.each)

    def drawn(self) -> Float | None:
        """Return the design that was drawn, (1, D), if it is within the bounds."""
        values = list(self.mechanism.dimensions.values())
        place = []
        for moves, (low, high) in self.variables.each:
            value = float(values[moves[0][0]])
            if not low <= value <= high:
                return None
            place.append((value - low) / (high - low) if high > low else 0.0)
        return np.array([place])

    def dimensions(self, places: Float) -> dict[str, Float]:
        """Return the dimensions at places (n, D) of the cube."""
        known = list(self.mechanism.dimensions)
        found: dict[str, Float] = {}
        for place, (moves, (low, high)) in zip(places.T, self.variables.each, strict=True):
            # Rounding must not lead beyond a bound.
            value = np.clip(low + place * (high - low), low, high)
            found |= {known[index]: factor * value for index, factor in moves}
        return found

    def designs(self, places: Float) -> Designs:
        """Return the designs at places (n, D)."""
        return Designs(self.mechanism, self.dimensions(places))

    def measure(self, places: Float) -> Scores:
        """Measure the designs at places (n, D)."""
        values, _, moves, _ = self._search.measure(self.designs(places).all())
        columns = list(values.values())
        goals = len(self.objectives)
        costs = np.column_stack(
            [goal.cost(one) for goal, one in zip(self.objectives, columns[:goals], strict=True)]
        )
        misses = np.column_stack(
            [
                missed(condition, one)
                for condition, one in zip(self.conditions, columns[goals:], strict=True)
            ]
            or [np.zeros((len(places), 0))]
        )
        moves &= np.isfinite(costs).all(axis=1)
        self._count(moves, misses)
        # Each is at most 1: a design that moves is nearer than any that does not.
        parts = np.ones_like(misses)
        np.divide(misses, 1.0 + misses, out=parts, where=np.isfinite(misses))
        return Scores(
            np.where(moves[:, np.newaxis], costs, 0.0),
            np.where(moves, parts.sum(axis=1), 1.0 + len(self.conditions)),
        )

    def _count(self, moves: npt.NDArray[np.bool_], misses: Float) -> None:
        """Keep what is told where no design keeps all conditions."""
        self.evaluations += len(moves)
        self.moving += int(moves.sum())
        if moves.any() and len(self.conditions):
            best = misses[moves][misses[moves].sum(axis=1).argmin()]
            if not len(self.nearest) or best.sum() < self.nearest.sum():
                self.nearest = best


def unit_of(condition: Condition) -> float:
    """Return what counts as a miss of 1."""
    return abs(condition.limit) or 1.0


def missed(condition: Condition, values: Float) -> Float:
    """Return by how much of its unit values miss a condition: 0 where they meet it."""
    away = np.abs(values - condition.limit) / unit_of(condition)
    # At a limit that must not be met, too.
    missing = np.maximum(away, np.finfo(np.float64).tiny)
    return np.where(condition.holds(values), 0.0, np.where(np.isnan(away), np.inf, missing))
