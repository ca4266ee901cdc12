"""Letters as paths to draw: the single-stroke capitals of a Hershey font, each in one stroke.

Strokes that meet are one graph. A route of least length passes every line of it, and goes back over
some where it must. Corners stay sharp; nothing is smoothed or left out.
"""

from __future__ import annotations

import json
from itertools import combinations, pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from scipy.sparse.csgraph import dijkstra

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
# A stroke that ends so near to another, in units of the font (a letter is 21 high), ends on it.
GAP = 0.6
# Places nearer than that are one.
SAME = 1e-6


class Graph(NamedTuple):
    """Places, and the pairs of them that a line joins."""

    places: Any
    lines: list[tuple[int, int]]


def strokes() -> dict[str, list[Any]]:
    """The strokes of all letters: arrays of points."""
    read = json.loads(Path(__file__).with_name("letters.json").read_text(encoding="utf-8"))
    return {
        letter: [np.array(stroke, dtype=float) for stroke in own]
        for letter, own in read["strokes"].items()
    }


def path(letter: str) -> Any:
    """The corners of a letter drawn in one stroke, (K, 2); a closed one ends where it starts."""
    own = graph(strokes()[letter])
    return own.places[route(own)]


def graph(own: Sequence[Any]) -> Graph:
    """Lines between the corners, ends and crossings of strokes."""
    lines = [pair for stroke in own for pair in pairwise(stroke)]
    lines += list(_gaps(own, lines))
    places: list[Any] = []
    pairs: list[tuple[int, int]] = []

    def index(point: Any) -> int:
        for known, place in enumerate(places):
            if np.hypot(*(place - point)) < SAME:
                return known
        places.append(point)
        return len(places) - 1

    for a, b in lines:
        parts = [0.0, 1.0]
        parts += [part for c, d in lines for part in _meetings(a, b, c, d)]
        along = [index(a + part * (b - a)) for part in sorted(parts)]
        pairs += [pair for pair in pairwise(along) if pair[0] != pair[1]]
    return Graph(np.array(places), pairs)


def _gaps(own: Sequence[Any], lines: Sequence[tuple[Any, Any]]) -> Iterator[tuple[Any, Any]]:
    """The short lines from ends of strokes to the strokes that they all but touch."""
    for stroke in own:
        for end in (stroke[0], stroke[-1]):
            feet = []
            for a, b in lines:
                part = np.clip((end - a) @ (b - a) / ((b - a) @ (b - a)), 0.0, 1.0)
                feet.append(a + part * (b - a))
            distances = np.hypot(*(np.array(feet) - end).T)
            touches = np.count_nonzero(distances < SAME) > 1
            near = np.where(distances < SAME, np.inf, distances).argmin()
            if not touches and SAME <= distances[near] < GAP:
                yield end, feet[near]


def _meetings(a: Any, b: Any, c: Any, d: Any) -> list[float]:
    """Where a line from c to d meets one from a to b: parts of its length from a."""
    u, v, w = b - a, d - c, c - a
    across = u[0] * v[1] - u[1] * v[0]
    if abs(across) < SAME:
        return []
    part, other = (w[0] * v[1] - w[1] * v[0]) / across, (w[0] * u[1] - w[1] * u[0]) / across
    inside = -SAME <= part <= 1.0 + SAME and -SAME <= other <= 1.0 + SAME
    return [min(max(part, 0.0), 1.0)] if inside else []


def route(own: Graph) -> list[int]:
    """The shortest way over all lines: places in order (C. Hierholzer 1873, M.-K. Kuan 1962)."""
    count = len(own.places)
    lengths = np.zeros((count, count))
    for i, j in own.lines:
        lengths[i, j] = lengths[j, i] = np.hypot(*(own.places[i] - own.places[j]))
    distances, before = dijkstra(lengths, return_predecessors=True)
    degrees = np.bincount(np.ravel(own.lines), minlength=count)
    odd = np.flatnonzero(degrees % 2).tolist()
    start = odd[0] if odd else 0
    again: list[tuple[int, int]] = []
    if odd:
        choices = []
        for ends in combinations(odd, 2):
            rest = [place for place in odd if place not in ends]
            length, pairs = _matching(rest, distances)
            choices.append((length, ends, pairs))
        _, (start, _), again = min(choices)
    lines = list(own.lines)
    for i, j in again:
        place = j
        while place != i:
            lines.append((int(before[i, place]), place))
            place = int(before[i, place])
    return _in_one_stroke(lines, start)


def _matching(places: list[int], distances: Any) -> tuple[float, list[tuple[int, int]]]:
    """Pair places so that the sum of the distances is least."""
    if not places:
        return 0.0, []
    first, *rest = places
    choices = []
    for other in rest:
        length, pairs = _matching([place for place in rest if place != other], distances)
        choices.append((length + float(distances[first, other]), [(first, other), *pairs]))
    return min(choices)


def _in_one_stroke(lines: list[tuple[int, int]], start: int) -> list[int]:
    """Go over every line once."""
    left, stack, found = list(lines), [start], []
    while stack:
        here = stack[-1]
        onward = next((line for line in left if here in line), None)
        if onward is None:
            found.append(stack.pop())
        else:
            left.remove(onward)
            stack.append(onward[1] if onward[0] == here else onward[0])
    return found[::-1]
