"""What a fit may change: dimensions by name, bounds, ties between them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fnmatch import fnmatchcase
from typing import TYPE_CHECKING, Any, TypeAlias

from assur._arrays import real_number, short, two_numbers
from assur._validate import checked_name, checked_names
from assur.errors import InputError

if TYPE_CHECKING:
    from assur.kinematics.mechanism import Mechanism

# Lengths without bounds, over the size of the target.
LENGTHS = (1e-3, 40.0)

# Indices of dimensions with their changes per unit, and the bounds.
Variable: TypeAlias = tuple[list[tuple[int, float]], tuple[float, float]]


@dataclass(frozen=True, slots=True)
class Variables:
    """The numbers that a fit chooses.

    Attributes
    ----------
    base : list of float
        The dimensions where all variables are 0.
    each : list of Variable
        The variables.
    names : tuple of str
        Names of the dimensions that move.
    bounds : dict of str to (float, float)
        The bounds of each of them.
    """

    base: list[float]
    each: list[Variable]
    names: tuple[str, ...]
    bounds: dict[str, tuple[float, float]]


def checked_variables(m: Mechanism, vary: Any, bounds: Any, ties: Any, size: float) -> Variables:
    """Return the variables; errors name the dimension and say what to do."""
    known = list(m.dimensions)
    tied = _ties(m, ties)
    names = [name for name in matching_names(known, vary, "vary", "*") if name not in tied]
    for name, (leader, _) in tied.items():
        if leader not in names:
            message = f"ties: {name!r} follows {leader!r}, which does not vary: add it to vary"
            raise InputError(message)
    if not names:
        message = "vary: no dimension is left to vary"
        raise InputError(message)
    limits = _bounds(known, bounds, size)
    base = [float(m.dimensions[name]) for name in known]
    each: list[Variable] = []
    for name in names:
        low, high = limits[name]
        moves = [(known.index(name), 1.0)]
        for follower, (leader, factor) in tied.items():
            if leader == name:
                moves.append((known.index(follower), factor))
                ends = sorted(end / factor for end in limits[follower])
                low, high = max(low, ends[0]), min(high, ends[1])
        if not low <= high:
            message = (
                f"bounds: those of what is tied to {name!r} leave it nothing: {low:g} to {high:g}"
            )
            raise InputError(message)
        each.append((moves, (low, high)))
        for index, _ in moves:
            base[index] = 0.0
    moving = tuple(known[index] for moves, _ in each for index, _ in moves)
    return Variables(base, each, moving, {name: limits[name] for name in moving})


def matching_names(known: list[str], patterns: Any, what: str, default: str) -> list[str]:
    """Return the names that match one of some patterns."""
    chosen: list[str] = []
    for pattern in checked_names(default if patterns is None else patterns, what):
        matching = [name for name in known if fnmatchcase(name, pattern)]
        if not matching:
            message = (
                f"{what}: {pattern!r} is not a dimension, nor a pattern of any: {short(known)}"
            )
            raise InputError(message)
        chosen += [name for name in matching if name not in chosen]
    return chosen


def _ties(m: Mechanism, ties: Any) -> dict[str, tuple[str, float]]:
    """Return for every dimension that follows another one its leader and the factor."""
    found: dict[str, tuple[str, float]] = {}
    try:
        listed = list(ties)
    except TypeError as error:
        message = f"ties is {short(ties)}: a list of ('follower', 'leader') is needed"
        raise InputError(message) from error
    for tie in listed:
        if not isinstance(tie, tuple | list) or len(tie) not in (2, 3):
            message = (
                f"ties: {short(tie)}: ('follower', 'leader') or ('follower', 'leader', factor)"
            )
            raise InputError(message)
        follower, leader = (checked_name(name, "ties") for name in tie[:2])
        for name in (follower, leader):
            m.core.dimension(name)
        factor = real_number(tie[2], "ties: the factor") if len(tie) == 3 else 1.0
        if factor == 0.0:
            message = f"ties: {follower!r} follows {leader!r} by the factor 0: leave it out of vary"
            raise InputError(message)
        if follower in found or follower == leader:
            message = f"ties: {follower!r} follows two dimensions, or itself: one tie is enough"
            raise InputError(message)
        found[follower] = (leader, factor)
    for follower, (leader, _) in found.items():
        if leader in found:
            message = (
                f"ties: {follower!r} follows {leader!r}, which follows another: tie it to that"
            )
            raise InputError(message)
    return found


def _bounds(known: list[str], bounds: Any, size: float) -> dict[str, tuple[float, float]]:
    """Return the bounds of every dimension: those of the last pattern that matches it."""
    least, most = (size * part for part in LENGTHS)
    limits = {name: _default(name, least, most) for name in known}
    if bounds is None:
        return limits
    if not isinstance(bounds, Mapping):
        message = f"bounds is {short(bounds)}: a mapping of names to (least, greatest) is needed"
        raise InputError(message)
    for pattern, ends in bounds.items():
        low, high = two_numbers(ends, f"bounds[{pattern!r}]")
        if not low <= high:
            message = f"bounds[{pattern!r}] is ({low:g}, {high:g}): the least comes first"
            raise InputError(message)
        for name in matching_names(known, pattern, "bounds", "*"):
            if name.endswith(".length") and high <= 0.0:
                message = f"bounds[{pattern!r}] is ({low:g}, {high:g}): {name!r} must be positive"
                raise InputError(message)
            is_bar = name.endswith(".length") and low <= 0.0
            limits[name] = (limits[name][0] if is_bar else low, high)
    return limits


def _default(name: str, least: float, most: float) -> tuple[float, float]:
    if name.endswith(".length"):
        return least, most
    if name.endswith("angle") or name.startswith("ground."):
        return -float("inf"), float("inf")
    return -most, most
