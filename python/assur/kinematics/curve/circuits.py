"""Circuits of a configuration curve: branches joined by folds, in the order of the motion."""

from __future__ import annotations

from typing import TYPE_CHECKING

from assur.kinematics.curve.elements import Circuit

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur.kinematics.curve.elements import Branch, Fold

# Index of a branch, and the direction of q along it.
Step = tuple[int, int]


def circuits_of(branches: Sequence[Branch], folds: Sequence[Fold]) -> list[Circuit]:
    """Return the circuits, each with the first of its branches along increasing q."""
    circuits = []
    free = set(range(len(branches)))
    while free:
        start = min(free)
        way, is_closed = _way(branches, folds, (start, 1))
        if not is_closed:
            # Open at both ends: what is ahead of the first branch, and what is behind it.
            behind, _ = _way(branches, folds, (start, -1))
            way = [(number, -direction) for number, direction in reversed(behind[1:])] + way
        free.difference_update(number for number, _ in way)
        circuits.append(Circuit(tuple(way), branches[start].period or 0, is_closed))
    return circuits


def _way(branches: Sequence[Branch], folds: Sequence[Fold], start: Step) -> tuple[list[Step], bool]:
    """Return the branches one after another, and whether they lead back to the first."""
    way = [start]
    while True:
        number, direction = way[-1]
        if branches[number].period is not None:
            return way, True
        fold = branches[number].folds[1 if direction > 0 else 0]
        if fold is None:
            return way, False
        first, second = folds[fold].branches
        following = (second if first == number else first), -direction
        if following == start:
            return way, True
        way.append(following)
