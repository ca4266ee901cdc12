"""The coordinates at which a configuration curve looks for all assemblies."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from itertools import pairwise, product
from typing import TYPE_CHECKING

import numpy as np

from assur.kinematics.configuration import lengths
from assur.kinematics.curve.elements import SAME

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur._arrays import Float
    from assur.kinematics.curve.branches import Branches
    from assur.kinematics.model import MechanismModel

# Distance, in steps, of the first coordinates on both sides from the drawing's: off the values that
# people draw at, which may be special, and the same for a mirror image.
OFF = 0.4877
# Most combinations of signs whose intervals are looked at.
MOST_SIGNS = 512
# The fraction of the fan that suffices within the branches.
ENOUGH = 0.5
# Where in an interval to look, as a fraction of it: change points are often in its middle.
WITHIN = 0.3813


@dataclass(slots=True)
class Fan:
    """Coordinates at which all assemblies were found, in order, with their number."""

    known: Branches
    q: list[float] = field(default_factory=list)
    counts: list[int] = field(default_factory=list)

    def look_at(self, coordinates: list[float]) -> None:
        """Find all assemblies at more coordinates."""
        self.known.coordinates = coordinates
        for q in coordinates:
            index = int(np.searchsorted(self.q, q))
            self.q.insert(index, q)
            self.counts.insert(index, self.known.look_at(q))

    def look_where_known(self, positions: int) -> None:
        """Look at as many coordinates again within the branches, if few of the fan lie there."""
        if not all(math.isfinite(branch.high - branch.low) for branch in self.known.branches):
            return
        stretches = self._stretches()
        total = sum(high - low for low, high in stretches)
        there = sum(int(self._is_between(np.array(self.q), *ends).sum()) for ends in stretches)
        if there >= ENOUGH * positions:
            return
        more = []
        for low, high in stretches:
            count = math.ceil(positions * (high - low) / total)
            more += [low + (k + 0.5) / count * (high - low) for k in range(count)]
        first, is_angle = self.q[0], self.known.is_angle
        self.look_at([first + (q - first) % math.tau if is_angle else q for q in more])

    def _stretches(self) -> list[tuple[float, float]]:
        """Return the ranges that the branches cover together, angles within a turn."""
        known = self.known
        ends = [(branch.low, branch.high) for branch in known.branches]
        if known.is_angle:
            ends = [(low % math.tau, low % math.tau + high - low) for low, high in ends]
        merged: list[tuple[float, float]] = []
        for low, high in sorted(ends):
            if merged and low <= merged[-1][1]:
                merged[-1] = merged[-1][0], max(high, merged[-1][1])
            else:
                merged.append((low, high))
        # Over the end of a turn the last goes on in the first.
        while known.is_angle and len(merged) > 1 and merged[0][0] + math.tau <= merged[-1][1]:
            merged[-1] = merged[-1][0], max(merged[-1][1], merged.pop(0)[1] + math.tau)
        return merged

    def gaps(self) -> list[float]:
        """Return middles of neighbours whose counts differ by other than the ends between them."""
        known = self.known
        begins = np.array([branch.low for branch in known.branches])
        ends = np.array([branch.high for branch in known.branches])
        middles = []
        for i, (low, high) in enumerate(pairwise(self.q)):
            change = sum(
                sign * int(np.count_nonzero(self._is_between(at[np.isfinite(at)], low, high)))
                for sign, at in ((1, begins), (-1, ends))
            )
            if change != self.counts[i + 1] - self.counts[i] and high - low > SAME * known.unit:
                middles.append(0.5 * (low + high))
        return middles

    def _is_between(self, at: Float, low: float, high: float) -> npt.NDArray[np.bool_]:
        """Whether coordinates are between two; angles in any turn."""
        turned = low + np.mod(at - low, math.tau) if self.known.is_angle else at
        return (low < turned) & (turned < high)


def around_drawing(mechanism: MechanismModel, positions: int, is_angle: bool) -> list[float]:
    """Return coordinates over a turn, or as far as all lengths together, about the drawing's."""
    q0 = float(np.ravel(mechanism.q0)[0])
    step = 2.0 * (math.pi if is_angle else sum(lengths(mechanism))) / positions
    below = [q0 - (k + OFF) * step for k in range((positions + 1) // 2)]
    return [*below[::-1], *(q0 + (k + OFF) * step for k in range(positions // 2))]


def look_within_intervals(known: Branches) -> bool:
    """Look for circuits between two coordinates of the fan; return whether all intervals are known.

    In class II they are.
    """
    mechanism = known.mechanism
    drawn = dict(mechanism.core.assembly)
    slides = mechanism.slides
    free = [name for name in drawn if not (name in slides and slides[name].length)]
    if mechanism.core.cls > 2 or 2 ** len(free) > MOST_SIGNS:
        return False
    for signs in product((1, -1), repeat=len(free)):
        assembly = drawn | dict(zip(free, signs, strict=True))
        ends = known.limits(assembly).intervals.tolist()
        if not ends:
            continue
        within = [_within(known, low, high) for low, high in ends]
        for q, place in zip(within, known.places(assembly, np.array(within)), strict=True):
            if np.isfinite(place).all() and not known.has(place, q):
                known.look_at(q)
    return True


def _within(known: Branches, low: float, high: float) -> float:
    """Return a coordinate within an interval."""
    if math.isfinite(high - low):
        return low + WITHIN * (high - low)
    if math.isfinite(low):
        return low + known.unit
    q0 = float(np.ravel(known.mechanism.q0)[0])
    return high - known.unit if math.isfinite(high) else q0 + WITHIN * known.unit
