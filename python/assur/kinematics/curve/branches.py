"""The branches of a configuration curve that are known so far."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from assur.kinematics.assemblies import assemblies
from assur.kinematics.configuration import nearest, place_of, places_along, size_of
from assur.kinematics.curve.elements import SAME, Branch, has_driven_angle
from assur.kinematics.limits import limits, period_of_one
from assur.kinematics.solve import solve

if TYPE_CHECKING:
    from collections.abc import Mapping

    from assur._arrays import Float
    from assur.kinematics.assembly import Assembly
    from assur.kinematics.limits import Limits
    from assur.kinematics.model import MechanismModel


@dataclass(slots=True)
class Branches:
    """The branches known so far, and the groups that fold at their ends.

    Each branch is solved once for all of `coordinates`, those that will be asked for.
    """

    mechanism: MechanismModel
    coordinates: list[float] = field(default_factory=list)
    branches: list[Branch] = field(default_factory=list)
    groups: list[tuple[str | None, str | None]] = field(default_factory=list)
    size: float = field(init=False)
    is_angle: bool = field(init=False)
    # Places of each branch at coordinates, and limits by the signs of class II.
    _solved: list[dict[float, Float]] = field(default_factory=list)
    _limits: dict[frozenset[tuple[str, int]], Limits] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.size = size_of(self.mechanism)
        self.is_angle = has_driven_angle(self.mechanism)

    @property
    def unit(self) -> float:
        """Unit of the driver's coordinate: rad, or for a slide the size."""
        return 1.0 if self.is_angle else self.size

    def places(self, assembly: Mapping[str, int], q: Float) -> Float:
        """Return the places of an assembly at coordinates, shape (N, n)."""
        motion = solve(self.mechanism, q, order=0, assembly=assembly, on_error="nan")
        return places_along(motion, self.size)

    def look_at(self, q: float) -> int:
        """Add the branches of all assemblies at a coordinate; return how many assemblies it has."""
        all_assemblies = list(assemblies(self.mechanism, q))
        for assembly in all_assemblies:
            self.add(assembly, q)
        return len(all_assemblies)

    def add(self, assembly: Assembly, q: float) -> None:
        """Add the branch of an assembly, if it is a new one."""
        assert assembly.place is not None
        place = place_of(assembly.place.numbers, self.size)
        if self.has(place, q):
            return
        own_limits = self.limits(assembly)
        dead = {point.q: point.group for point in own_limits.dead_points}
        intervals = [
            Branch(assembly, low, high, period_of_one(own_limits))
            for low, high in own_limits.intervals.tolist()
        ]
        # Several of them may contain an angle, each in other turns.
        there = [self._solve(branch, [q])[q] for branch in intervals]
        apart = [(nearest(places, place), index) for index, places in enumerate(there)]
        least, index = min(apart, default=(math.inf, 0))
        if math.isfinite(least):
            branch = intervals[index]
            self.branches.append(branch)
            self.groups.append((dead.get(branch.low), dead.get(branch.high)))
            self._solved.append({})

    def limits(self, assembly: Mapping[str, int]) -> Limits:
        """Return the limits of an assembly."""
        if self.mechanism.core.cls > 2:
            return limits(self.mechanism, assembly)
        signs = frozenset(assembly.items())
        if signs not in self._limits:
            self._limits[signs] = limits(self.mechanism, assembly)
        return self._limits[signs]

    def has(self, place: Float, q: float) -> bool:
        """Whether a known branch goes through a place at a coordinate; angles in any turn."""
        for branch, solved in zip(self.branches, self._solved, strict=True):
            if q not in solved:
                asked = [known for known in self.coordinates if known not in solved]
                solved.update(self._solve(branch, asked if q in asked else [q]))
            if nearest(solved[q], place) <= SAME:
                return True
        return False

    def _solve(self, branch: Branch, coordinates: list[float]) -> dict[float, Float]:
        """Return all places of a branch at each coordinate; angles in any turn."""
        turns = [self._turns(branch, q) for q in coordinates]
        inside = [coordinate for turn in turns for coordinate in turn]
        if not inside:
            return dict.fromkeys(coordinates, np.empty((0, 1)))
        places = self.places(branch.assembly, np.array(inside))
        parts = np.split(places, np.cumsum([len(turn) for turn in turns])[:-1])
        return dict(zip(coordinates, parts, strict=True))

    def _turns(self, branch: Branch, q: float) -> list[float]:
        """Return a coordinate in all the turns in which it is within a branch."""
        if not self.is_angle:
            return [q] if branch.low <= q <= branch.high else []
        if branch.period is not None:
            return [q + math.tau * turn for turn in range(branch.period)]
        first = math.ceil((branch.low - q) / math.tau)
        last = math.floor((branch.high - q) / math.tau)
        return [q + math.tau * turn for turn in range(first, last + 1)]
