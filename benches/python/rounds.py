"""Times of contenders, interleaved: A B C A B C …, each level of `assur` after the other."""

from __future__ import annotations

import statistics
from dataclasses import dataclass
from time import perf_counter
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from levels import About, Side

# Rounds at least and at most, and the time after which there are enough, s.
LEAST, MOST, ENOUGH = 7, 31, 4.0

Key: TypeAlias = tuple[str, str]  # a contender's name and its level


@dataclass(frozen=True)
class Timing:
    """Medians over the rounds: seconds of a call, and its ratio to the first contender's.

    spread: between the quarters of the seconds, of their median.
    """

    name: str
    level: str
    seconds: float
    ratio: float
    spread: float
    designs: int
    rounds: int


def measure(
    sides: Sequence[Side], label: str | int, rounds: int | None = None
) -> tuple[About, list[Timing]]:
    """Return what a subject is, and the times of its contenders, which are known to agree.

    sides: the processes of all levels, the best one first. rounds: this many of them, instead of as
    many as there is time for.
    """
    abouts = [side.open(label) for side in sides]
    pairs = list(zip(sides, abouts, strict=True))
    first = abouts[0]
    keys = [(name, side) for name in first.run for side, about in pairs if name in about.run]
    times: dict[Key, list[float]] = {(name, side.level): [] for name, side in keys}
    start = perf_counter()
    for done in range(1, (rounds or MOST) + 1):
        for name, side in keys:
            times[name, side.level].append(side.seconds(name))
        if rounds is None and done >= LEAST and perf_counter() - start > ENOUGH:
            break
    return first, list(_medians(times, first.run))


def _medians(times: dict[Key, list[float]], designs: dict[str, int]) -> Iterator[Timing]:
    first = next(iter(times.values()))
    for (name, level), seconds in times.items():
        middle = statistics.median(seconds)
        low, _, high = statistics.quantiles(seconds) if len(seconds) > 1 else [middle] * 3
        yield Timing(
            name=name,
            level=level,
            seconds=middle,
            ratio=statistics.median(a / b for a, b in zip(seconds, first, strict=True)),
            spread=(high - low) / middle,
            designs=designs[name],
            rounds=len(seconds),
        )
