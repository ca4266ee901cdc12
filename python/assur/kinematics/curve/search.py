"""Finding the branches of a configuration curve, the folds between them and the circuits."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from assur._validate import whole_number
from assur.errors import InputError
from assur.kinematics.curve.curve import NEEDED, ConfigurationCurve
from assur.kinematics.curve.parts import SAME, Branch, Circuit, Fold, has_driven_angle
from assur.kinematics.place import lengths, place_of, places_along, size_of

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.kinematics.assembly import Assembly
    from assur.kinematics.mechanism import Mechanism

# How far from a dead point, as a part of the branch, positions are taken to extrapolate it; and how
# near (relative to the size) two extrapolations of one fold are.
BESIDE = 1e-6
SAME_FOLD = 1e-4
# Halvings of the fan where folds do not explain a change of the count.
MOST_HALVINGS = 12


@dataclass(slots=True)
class Search:
    """The branches known so far, with their joints at the fan's coordinates."""

    mechanism: Mechanism
    size: float
    is_angle: bool
    fan: list[float] = field(default_factory=list)
    found: list[list[Assembly]] = field(default_factory=list)
    branches: list[Branch] = field(default_factory=list)
    groups: list[tuple[str | None, str | None]] = field(default_factory=list)

    @property
    def unit(self) -> float:
        """What the driver's coordinate is measured in: rad, or for a slide the size."""
        return 1.0 if self.is_angle else self.size

    def places(self, assembly: Assembly, q: Float) -> Float:
        """Return the places of an assembly at coordinates, shape (N, n)."""
        motion = self.mechanism.solve(q, order=0, assembly=assembly, on_error="nan")
        return places_along(motion, self.size)

    def at(self, branch: Branch, q: float) -> Float:
        """Return all positions of a branch at a coordinate, of an angle in any turn."""
        if not self.is_angle:
            inside = [q] if branch.low <= q <= branch.high else []
        elif branch.period is not None:
            inside = [q + math.tau * turn for turn in range(branch.period)]
        else:
            first = math.ceil((branch.low - q) / math.tau)
            last = math.floor((branch.high - q) / math.tau)
            inside = [q + math.tau * turn for turn in range(first, last + 1)]
        if not inside:
            return np.empty((0, 1))
        return self.places(branch.assembly, np.array(inside))

    def is_known(self, assembly: Assembly, q: float) -> bool:
        """Whether a known branch goes through an assembly."""
        own = _place(assembly, self.size)
        for branch in self.branches:
            there = self.at(branch, q)
            if len(there) and (np.abs(there - own).max(axis=1) <= SAME).any():
                return True
        return False

    def add(self, assembly: Assembly, q: float) -> None:
        """Add the branch of an assembly, if it is a new one."""
        if self.is_known(assembly, q):
            return
        limits = self.mechanism.limits(assembly)
        for low, high in limits.intervals.tolist():
            # The first q from the low end on, of an angle in any turn.
            goes_round = not self.is_angle or math.isinf(low)
            first = q if goes_round else q + math.tau * math.ceil((low - q) / math.tau)
            if low <= first <= high:
                dead = {one.q: one.group for one in limits.dead_points}
                self.branches.append(Branch(assembly, low, high, limits.period))
                self.groups.append((dead.get(low), dead.get(high)))
                return

    def look_at(self, q: float) -> None:
        """Find all assemblies at one more coordinate."""
        found = list(self.mechanism.assemblies(q))
        index = int(np.searchsorted(self.fan, q))
        self.fan.insert(index, q)
        self.found.insert(index, found)
        for assembly in found:
            self.add(assembly, q)


def _place(assembly: Assembly, size: float) -> Float:
    assert assembly._place is not None
    return place_of(assembly._place.numbers, size)


def configuration_curve(mechanism: Mechanism, positions: int) -> ConfigurationCurve:
    """See `Mechanism.configuration_curve`."""
    if mechanism.shape:
        message = f"configuration_curve() is for one design, this is a batch {mechanism.shape}"
        raise InputError(message)
    require_one_driver(mechanism, "configuration_curve")
    positions = whole_number(positions, "positions", 2, needed=NEEDED)
    search = _search_of(mechanism)
    reach = math.pi if search.is_angle else sum(lengths(mechanism))
    # The drawing's own circuit may be narrower than the fan.
    for assembly in mechanism.assemblies(mechanism.q0):
        search.add(assembly, float(np.array(mechanism.q0)))
    # Off the values that people draw at, where things may be special.
    for q in np.linspace(-reach, reach, positions, endpoint=False) + 0.0123 * reach:
        search.look_at(float(q))
    folds = _folds(search)
    for _ in range(MOST_HALVINGS):
        gaps = _unexplained(search, folds)
        if not gaps:
            break
        for q in gaps:
            search.look_at(q)
        folds = _folds(search)
    return _curve_of(search, folds)


def curve_through(mechanism: Mechanism, places: list[tuple[float, Assembly]]) -> ConfigurationCurve:
    """Return the circuits of a design that go through positions, as they were found."""
    search = _search_of(mechanism)
    for q, assembly in places:
        search.add(assembly, q)
    return _curve_of(search, _folds(search))


def require_one_driver(mechanism: Mechanism, what: str) -> None:
    """Refuse a mechanism with several drivers."""
    if mechanism._driver_count > 1:
        message = f"{what}() is for one driver; this mechanism has {mechanism._driver_count}"
        raise InputError(message)


def _search_of(mechanism: Mechanism) -> Search:
    return Search(mechanism, size_of(mechanism), has_driven_angle(mechanism))


def _curve_of(search: Search, folds: list[Fold]) -> ConfigurationCurve:
    branches = list(search.branches)
    for index, fold in enumerate(folds):
        for number in fold.branches:
            branch = branches[number]
            low, high = branch.folds
            ends = (low, index) if fold.is_greatest else (index, high)
            branches[number] = Branch(branch.assembly, branch.low, branch.high, branch.period, ends)
    circuits = _circuits(branches, folds)
    return ConfigurationCurve(
        tuple(branches), tuple(folds), tuple(circuits), np.array(search.fan), search.mechanism
    )


@dataclass(frozen=True, slots=True)
class _End:
    branch: int
    side: int
    q: float
    place: Float


def _folds(search: Search) -> list[Fold]:
    """Pair the ends of branches; a partner that is not known yet is found beside the fold."""
    ends: list[_End] = []
    seen = 0
    while seen < len(search.branches):
        branch = search.branches[seen]
        for side, q in enumerate((branch.low, branch.high)):
            if math.isfinite(q):
                ends.append(_end(search, seen, side, q))
                if not any(_meet(search, ends[-1], other) for other in ends[:-1]):
                    beside = q + (1 - 2 * side) * BESIDE * _length(search, branch)
                    for assembly in search.mechanism.assemblies(beside):
                        search.add(assembly, beside)
        seen += 1
    folds = []
    free = list(range(len(ends)))
    while free:
        own = ends[free.pop(0)]
        partner = next((i for i in free if _meet(search, own, ends[i])), None)
        if partner is None:
            continue
        free.remove(partner)
        group = search.groups[own.branch][own.side]
        branches = (own.branch, ends[partner].branch)
        folds.append(Fold(own.q, group, branches, own.side == 1))
    return folds


def _length(search: Search, branch: Branch) -> float:
    return min(branch.high - branch.low, search.unit)


def _end(search: Search, number: int, side: int, q: float) -> _End:
    """Extrapolate the place of a fold: joints go as the square root of the distance from it."""
    branch = search.branches[number]
    step = (1 - 2 * side) * BESIDE * _length(search, branch)
    near, far = search.places(branch.assembly, np.array([q + step, q + 4.0 * step]))
    return _End(number, side, q, 2.0 * near - far)


def _meet(search: Search, one: _End, other: _End) -> bool:
    if one.side != other.side or one.branch == other.branch:
        return False
    gap = one.q - other.q
    gap = math.remainder(gap, math.tau) if search.is_angle else gap
    is_near = np.abs(one.place - other.place).max() <= SAME_FOLD
    return abs(gap) <= SAME * search.unit and bool(is_near)


def _unexplained(search: Search, folds: list[Fold]) -> list[float]:
    """Middles of neighbours whose counts differ by other than the folds between them."""
    middles = []
    counts = [len(found) for found in search.found]
    for i in range(len(search.fan) - 1):
        low, high = search.fan[i], search.fan[i + 1]
        change = 0
        for fold in folds:
            q = fold.q
            if search.is_angle:
                q = low + (q - low) % math.tau
            if low < q < high:
                change += -2 if fold.is_greatest else 2
        if change != counts[i + 1] - counts[i] and high - low > SAME * search.unit:
            middles.append(0.5 * (low + high))
    return middles


def _circuits(branches: list[Branch], folds: list[Fold]) -> list[Circuit]:
    circuits = []
    free = set(range(len(branches)))
    while free:
        start = min(free)
        way, number, direction = [], start, 1
        is_closed = True
        while True:
            way.append((number, direction))
            free.discard(number)
            if branches[number].period is not None:
                break
            fold = branches[number].folds[1 if direction > 0 else 0]
            if fold is None:
                is_closed = False
                break
            one, other = folds[fold].branches
            number, direction = (other if one == number else one), -direction
            if (number, direction) == way[0]:
                break
        turns = branches[start].period or 0
        circuits.append(Circuit(tuple(way), turns, is_closed))
    return circuits
