"""The configuration curve of a mechanism with one freedom: branches, folds, circuits.

A branch is what an assembly reaches without a dead point of the driver. At a dead point two
branches meet in a fold. Branches joined by folds form a circuit: all positions that can be reached
without taking the mechanism apart (T. R. Chase and J. A. Mirth, J. Mech. Des. 115 (1993) 223).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import short
from assur._trig import sin_cos
from assur._validate import checked_index, real_number, whole_number
from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur._arrays import Float
    from assur.kinematics.assembly import Assembly
    from assur.kinematics.mechanism import Mechanism

__all__ = ["Branch", "Circuit", "CircuitMotion", "ConfigurationCurve", "Defects", "Fold"]

# How near (relative to the size) positions of one assembly are.
SAME = 1e-6
# How far from a dead point, as a part of the branch, positions are taken to extrapolate it; and how
# near (relative to the size) two extrapolations of one fold are.
BESIDE = 1e-6
SAME_FOLD = 1e-4
# Of positions and samples.
NEEDED = "a whole number of at least 2 is needed"
# Halvings of the fan where folds do not explain a change of the count.
MOST_HALVINGS = 12


@dataclass(frozen=True, slots=True, eq=False)
class Branch:
    """A stretch of the curve between two dead points of the driver.

    Attributes
    ----------
    assembly : Assembly
        Leads to every position of it: ``solve(q, assembly=branch.assembly)``.
    low, high : float
        Where it ends, rad (in counted turns) or m; infinite if the driver goes round.
    period : int or None
        Turns after which it closes, if the driver goes round.
    folds : tuple of int or None
        Indices of the folds at its low and its high end.
    """

    assembly: Assembly
    low: float
    high: float
    period: int | None
    folds: tuple[int | None, int | None] = (None, None)


@dataclass(frozen=True, slots=True, eq=False)
class Fold:
    """A dead point of the driver, where two branches meet.

    Attributes
    ----------
    q : float
        Coordinate of the driver, rad or m.
    group : str or None
        The dyad or group that is flat there.
    branches : tuple of int
        Indices of the branches.
    is_greatest : bool
        Whether q is greatest there on both branches, or least.
    """

    q: float
    group: str | None
    branches: tuple[int, int]
    is_greatest: bool


@dataclass(frozen=True, slots=True, eq=False)
class Circuit:
    """All positions that can be reached without taking the mechanism apart.

    Attributes
    ----------
    branches : tuple of (int, int)
        Indices of its branches in the order of the motion, each with the direction of q (+1 or −1).
    turns : int
        Turns of the driver when the motion closes: 0 if it swings between dead points.
    is_closed : bool
        Whether the motion closes; if not, it ends where a joint goes to infinity.
    """

    branches: tuple[tuple[int, int], ...]
    turns: int
    is_closed: bool


@dataclass(frozen=True, slots=True, eq=False)
class CircuitMotion:
    """Positions along a circuit, also past dead points of the driver.

    Attributes
    ----------
    q : ndarray
        Coordinate of the driver, shape (N,); it turns back at folds.
    branch : ndarray of int
        The branch of each position.
    joints : mapping of str to ndarray
        Positions of the joints, m, shape (N, 2).
    links : mapping of str to ndarray
        Angles of the links, rad, continuous.
    slides : mapping of str to ndarray
        Values of the slides, m.
    """

    q: Float
    branch: Float
    joints: dict[str, Float]
    links: dict[str, Float]
    slides: dict[str, Float]


@dataclass(frozen=True, slots=True)
class Defects:
    """What keeps a design from going through given positions (Chase and Mirth 1993).

    Attributes
    ----------
    circuit : bool
        Whether they lie on different circuits: it would have to be taken apart.
    branch : bool
        Whether they lie on different branches: the driver cannot lead from one to another.
    order : bool
        Whether one circuit goes through all of them, but in another order, whichever way round.
    branches : tuple of int
        The branch of each.
    """

    circuit: bool
    branch: bool
    order: bool
    branches: tuple[int, ...]


@dataclass(frozen=True, slots=True, eq=False)
class ConfigurationCurve:
    """All positions of a design, as a curve.

    Attributes
    ----------
    branches : tuple of Branch
        Stretches between dead points.
    folds : tuple of Fold
        Dead points.
    circuits : tuple of Circuit
        What is connected.
    fan : ndarray
        Coordinates at which all assemblies were found, rad or m. A circuit that turns back between
        two neighbours at both of its ends may have been missed.
    """

    branches: tuple[Branch, ...]
    folds: tuple[Fold, ...]
    circuits: tuple[Circuit, ...]
    fan: Float
    _mechanism: Mechanism

    def defects(self, places: Sequence[tuple[float, Assembly]]) -> Defects:
        """Return what keeps a design from going through given positions one after another.

        Parameters
        ----------
        places : sequence of (q, Assembly)
            The positions in the wanted order, as `Mechanism.find` gives them.

        Examples
        --------
        >>> import assur
        >>> four_bar = assur.FourBar(1.0, 3.0, 2.5, 3.2)
        >>> curve = four_bar.configuration_curve()
        >>> one, other = four_bar.assemblies(1.0)
        >>> curve.defects([(0.5, one), (1.0, other)]).circuit
        True
        >>> curve.defects([(0.5, one), (1.0, one), (2.0, one)])
        Defects(circuit=False, branch=False, order=False, branches=(0, 0, 0))
        """
        pairs: list[Any] = list(places)
        if not all(isinstance(one, tuple | list) and len(one) == 2 for one in pairs):
            message = f"places is {short(places)}: pairs (q, assembly) are needed, as find() gives"
            raise InputError(message)
        found = [_located(self, real_number(q, "q"), assembly) for q, assembly in pairs]
        homes = {number: i for i, c in enumerate(self.circuits) for number, _ in c.branches}
        branches = tuple(number for number, _ in found)
        on_one = len({homes[number] for number in branches}) <= 1
        order = on_one and bool(found) and not _is_in_order(self, homes[branches[0]], found)
        return Defects(not on_one, len(set(branches)) > 1, order, branches)

    def motion(self, circuit: int = 0, samples: int = 180) -> CircuitMotion:
        """Return positions along a circuit.

        Parameters
        ----------
        circuit : int
            Index of the circuit.
        samples : int
            Positions of each branch, closer together toward dead points.

        Examples
        --------
        >>> import assur
        >>> curve = assur.FourBar(3.0, 2.5, 2.0, 4.0).configuration_curve()
        >>> curve.motion(samples=3).q.round(6) + 0.0
        array([-1.371564,  0.      ,  1.371564,  0.      , -1.371564])
        """
        (index,) = checked_index(circuit, (len(self.circuits),), "circuit")
        samples = whole_number(samples, "samples", 2, needed=NEEDED)
        parts = []
        for number, direction in self.circuits[index].branches:
            branch = self.branches[number]
            low, high = _ends(branch, self._mechanism)
            part = 0.5 - 0.5 * sin_cos(np.linspace(0.0, np.pi, samples))[1]
            if not branch.folds[0] and not branch.folds[1] and branch.period:
                part = np.linspace(0.0, 1.0, samples)
            q = low + (high - low) * part
            parts.append((number, q if direction > 0 else q[::-1]))
        return _along(self._mechanism, self.branches, parts)


@dataclass(slots=True)
class _Search:
    """The branches known so far, with their joints at the fan's coordinates."""

    mechanism: Mechanism
    size: float
    is_angle: bool
    fan: list[float] = field(default_factory=list)
    found: list[list[Assembly]] = field(default_factory=list)
    branches: list[Branch] = field(default_factory=list)
    groups: list[tuple[str | None, str | None]] = field(default_factory=list)

    def joints(self, assembly: Assembly, q: Float) -> Float:
        motion = self.mechanism.solve(q, order=0, assembly=assembly, on_error="nan")
        names = self.mechanism._joint_names
        return np.stack([motion.joint(name).value for name in names], axis=-2)

    def at(self, branch: Branch, q: float) -> Float:
        """All positions of a branch at a coordinate, of an angle in any turn."""
        if not self.is_angle:
            inside = [q] if branch.low <= q <= branch.high else []
        elif branch.period is not None:
            inside = [q + math.tau * turn for turn in range(branch.period)]
        else:
            first = math.ceil((branch.low - q) / math.tau)
            last = math.floor((branch.high - q) / math.tau)
            inside = [q + math.tau * turn for turn in range(first, last + 1)]
        if not inside:
            return np.empty((0, len(self.mechanism._joint_names), 2))
        return self.joints(branch.assembly, np.array(inside))

    def is_known(self, assembly: Assembly, q: float) -> bool:
        own = _place(assembly)
        for branch in self.branches:
            there = self.at(branch, q)
            if len(there) and (np.abs(there - own).max(axis=(1, 2)) <= SAME * self.size).any():
                return True
        return False

    def add(self, assembly: Assembly, q: float) -> None:
        """Add the branch of an assembly, if it is a new one."""
        if self.is_known(assembly, q):
            return
        limits = self.mechanism.limits(assembly)
        for low, high in limits.intervals.tolist():
            turns = np.arange(-1, 2) * (math.tau if self.is_angle else 0.0)
            shifted = [q + turn for turn in turns.tolist() if low <= q + turn <= high]
            if shifted:
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


def _place(assembly: Assembly) -> Float:
    assert assembly.joints is not None
    return np.array(list(assembly.joints.values()))


def _ends(branch: Branch, mechanism: Mechanism) -> tuple[float, float]:
    if branch.period is None:
        return branch.low, branch.high
    q0 = float(np.ravel(mechanism.q0)[0])
    return q0, q0 + math.tau * branch.period


def configuration_curve(mechanism: Mechanism, positions: int) -> ConfigurationCurve:
    """See `Mechanism.configuration_curve`."""
    if mechanism.shape:
        message = f"configuration_curve() is for one design, this is a batch {mechanism.shape}"
        raise InputError(message)
    if mechanism._driver_count > 1:
        count = mechanism._driver_count
        message = f"configuration_curve() is for one driver; this mechanism has {count}"
        raise InputError(message)
    positions = whole_number(positions, "positions", 2, needed=NEEDED)
    driver = mechanism._description.drivers[0]
    is_angle = not isinstance(driver, str) or driver not in mechanism.slides
    names = mechanism._core.dimension_names
    lengths = [
        abs(value)
        for name, value in zip(names, mechanism._values.tolist(), strict=True)
        if not name.endswith("angle")
    ]
    corners = np.array(list(mechanism.joints.values()))
    size = float(max(np.nanmax(np.ptp(corners, axis=0)), *lengths))
    search = _Search(mechanism, size, is_angle)
    reach = math.pi if is_angle else sum(lengths)
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
    branches = list(search.branches)
    for index, fold in enumerate(folds):
        for number in fold.branches:
            branch = branches[number]
            low, high = branch.folds
            ends = (low, index) if fold.is_greatest else (index, high)
            branches[number] = Branch(branch.assembly, branch.low, branch.high, branch.period, ends)
    circuits = _circuits(branches, folds)
    return ConfigurationCurve(
        tuple(branches), tuple(folds), tuple(circuits), np.array(search.fan), mechanism
    )


@dataclass(frozen=True, slots=True)
class _End:
    branch: int
    side: int
    q: float
    place: Float


def _folds(search: _Search) -> list[Fold]:
    """Pair the ends of branches; a partner that is not known yet is found beside the fold."""
    ends: list[_End] = []
    seen = 0
    while seen < len(search.branches):
        branch = search.branches[seen]
        for side, q in enumerate((branch.low, branch.high)):
            if math.isfinite(q):
                ends.append(_end(search, seen, side, q))
                if not any(_meet(search, ends[-1], other) for other in ends[:-1]):
                    beside = q + (1 - 2 * side) * BESIDE * _length(branch)
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


def _length(branch: Branch) -> float:
    return min(branch.high - branch.low, 1.0)


def _end(search: _Search, number: int, side: int, q: float) -> _End:
    """Extrapolate the place of a fold: joints go as the square root of the distance from it."""
    branch = search.branches[number]
    step = (1 - 2 * side) * BESIDE * _length(branch)
    near, far = search.joints(branch.assembly, np.array([q + step, q + 4.0 * step]))
    return _End(number, side, q, 2.0 * near - far)


def _meet(search: _Search, one: _End, other: _End) -> bool:
    if one.side != other.side or one.branch == other.branch:
        return False
    gap = one.q - other.q
    gap = math.remainder(gap, math.tau) if search.is_angle else gap
    is_near = np.abs(one.place - other.place).max() <= SAME_FOLD * search.size
    return abs(gap) <= SAME and bool(is_near)


def _unexplained(search: _Search, folds: list[Fold]) -> list[float]:
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
        if change != counts[i + 1] - counts[i] and high - low > SAME * search.size:
            middles.append(0.5 * (low + high))
    return middles


def _located(curve: ConfigurationCurve, q: float, assembly: Assembly) -> tuple[int, float]:
    """Return the branch of a position, and its q in the branch's counted turns."""
    mechanism = curve._mechanism
    names = mechanism._joint_names
    motion = mechanism.solve(q, order=0, assembly=assembly)
    own = np.array([motion.joint(name).value for name in names])
    size = float(np.ptp(own, axis=0).max())
    driver = mechanism._description.drivers[0]
    is_angle = not isinstance(driver, str) or driver not in mechanism.slides
    for number, branch in enumerate(curve.branches):
        low, high = _ends(branch, mechanism)
        turns = range(math.ceil((low - q) / math.tau), math.floor((high - q) / math.tau) + 1)
        for turn in turns if is_angle else [0]:
            there = q + math.tau * turn
            if not low <= there <= high:
                continue
            motion = mechanism.solve(there, order=0, assembly=branch.assembly, on_error="nan")
            at = np.array([motion.joint(name).value for name in names])
            if np.abs(at - own).max() <= SAME * size:
                return number, there
    message = f"no branch goes through q = {q!r} in {assembly!r}: give the curve more positions"
    raise InputError(message, value=q)


def _is_in_order(curve: ConfigurationCurve, circuit: int, found: list[tuple[int, float]]) -> bool:
    """Whether a circuit goes through positions in their order, one way round or the other."""
    ways = curve.circuits[circuit].branches
    places = []
    for number, q in found:
        step = next(i for i, (own, _) in enumerate(ways) if own == number)
        low, high = _ends(curve.branches[number], curve._mechanism)
        part = (q - low) / (high - low)
        places.append(step + (part if ways[step][1] > 0 else 1.0 - part))
    # Rounded, so that the same place twice is no step backward by a whole round.
    steps = np.diff(np.array([*places, places[0]]).round(9))
    if len(places) < 3 or not steps.any():
        return True
    if not curve.circuits[circuit].is_closed:
        steps = steps[:-1]
        return bool((steps > 0.0).all() or (steps < 0.0).all())
    # Round the circuit once: the steps, each in the direction of the motion, make one round.
    around = len(ways)
    return any(
        abs(float((np.sign(way) * steps % around).sum()) - around) < 0.5 for way in (1.0, -1.0)
    )


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


def _along(
    mechanism: Mechanism, branches: tuple[Branch, ...], parts: list[tuple[int, Float]]
) -> CircuitMotion:
    names = mechanism._joint_names, tuple(mechanism.links), tuple(mechanism.slides)
    rows: list[tuple[Float, Float, list[list[Float]]]] = []
    for index, (number, part) in enumerate(parts):
        # The end of one branch is the beginning of the next.
        q = part if index == 0 else part[1:]
        branch = branches[number]
        inside = q
        if branch.period is None:
            # Beside a dead point, not on it: there rounding decides whether the position exists.
            margin = 1e-13 * max(abs(branch.low), abs(branch.high), 1.0)
            inside = np.clip(q, branch.low + margin, branch.high - margin)
        motion = mechanism.solve(inside, order=0, assembly=branch.assembly, on_error="nan")
        values = [
            [motion.joint(name).value for name in names[0]],
            [motion.link(name).value for name in names[1]],
            [motion.slide(name).value for name in names[2]],
        ]
        rows.append((q, np.full(len(q), number), values))

    def joined(kind: int) -> dict[str, Float]:
        own = names[kind]
        return {
            name: np.concatenate([values[kind][i] for _, _, values in rows])
            for i, name in enumerate(own)
        }

    return CircuitMotion(
        np.concatenate([q for q, _, _ in rows]),
        np.concatenate([number for _, number, _ in rows]),
        joined(0),
        {name: np.unwrap(angle) for name, angle in joined(1).items()},
        joined(2),
    )
