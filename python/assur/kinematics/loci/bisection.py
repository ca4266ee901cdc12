"""Bisection of edges between places where something is counted."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from assur._arrays import Float


@dataclass(slots=True)
class Edge:
    """Two places in a plane and what is there.

    Attributes
    ----------
    ends : ndarray
        The places, shape (2, 2).
    found : list
        What is at each.
    """

    ends: Float
    found: list[Any]

    def cut(self, end: int, place: Float, state: Any) -> Edge:
        """Return the edge with one end replaced by another place."""
        edge = Edge(self.ends.copy(), list(self.found))
        edge.ends[end], edge.found[end] = place, state
        return edge


def bisected(
    edges: Sequence[Edge],
    look_at: Callable[[Float], Sequence[Any]],
    count: Callable[[Any], Any],
    halvings: int,
) -> tuple[list[Edge], list[Edge]]:
    """Narrow every edge to one change of the count, all of them together.

    Returns
    -------
    list of Edge
        Each a part of its edge.
    list of Edge
        The rest of all edges, where there may be further changes.
    """
    narrow, rest = list(edges), []
    for _ in range(halvings if narrow else 0):
        middles = np.array([edge.ends.mean(axis=0) for edge in narrow])
        for i, (middle, state) in enumerate(zip(middles, look_at(middles), strict=True)):
            edge = narrow[i]
            far = 1 if count(state) != count(edge.found[0]) else 0
            narrow[i] = edge.cut(far, middle, state)
            rest.append(edge.cut(1 - far, middle, state))
    return narrow, rest
