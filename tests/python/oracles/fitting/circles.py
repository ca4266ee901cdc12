"""Paths by intersecting circles, and distances by many points: nothing of the package is used.

A linkage of one crank and dyads is its drawing: joint places, and the joints of each link.
"""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.spatial import cKDTree

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

# Points on each polyline, for distances.
DENSE = 60_000


def places(
    drawing: Mapping[str, Sequence[float]], links: Mapping[str, Sequence[str]], turns: Any
) -> dict[str, Any]:
    """Return every joint as complex numbers, after the crank has turned from its drawing."""
    at = {name: complex(x, y) for name, (x, y) in drawing.items()}
    found = {name: np.full(np.shape(turns), at[name]) for name in links["ground"]}
    pivot = links["crank"][0]
    for name in links["crank"][1:]:
        found[name] = at[pivot] + (at[name] - at[pivot]) * np.exp(1j * np.asarray(turns))
    while len(found) < len(at):
        before = len(found)
        for on in links.values():
            known = [name for name in on if name in found]
            if len(known) >= 2:
                # A link is a triangle that keeps its form.
                i, j = known[:2]
                for name in set(on) - set(known):
                    part = (at[name] - at[i]) / (at[j] - at[i])
                    found[name] = found[i] + part * (found[j] - found[i])
        for one, other in combinations(links.values(), 2):
            for name in set(one) & set(other) - set(found):
                ends = [next((k for k in on if k in found), None) for on in (one, other)]
                if ends[0] is not None and ends[1] is not None:
                    found[name] = _meet(at, found, name, (ends[0], ends[1]))
        assert len(found) > before, "no linkage of dyads"
    return found


def _meet(
    at: Mapping[str, complex], found: Mapping[str, Any], name: str, ends: tuple[str, str]
) -> Any:
    """Return where two circles meet, on the side of the drawing; NaN where they do not."""
    i, j = ends
    a, b = abs(at[name] - at[i]), abs(at[name] - at[j])
    side = np.sign(((at[j] - at[i]).conjugate() * (at[name] - at[i])).imag)
    chord = found[j] - found[i]
    length = np.abs(chord)
    along = (a * a - b * b + length**2) / (2.0 * length)
    with np.errstate(invalid="ignore"):
        across = np.sqrt(a * a - along**2)
    return found[i] + (along + 1j * side * across) * chord / length


def line(points: Any) -> Any:
    """Return points (N, 2) as complex numbers."""
    return np.asarray(points)[:, 0] + 1j * np.asarray(points)[:, 1]


def dense(corners: Any, count: int = DENSE) -> Any:
    """Return middles of equal parts of a polyline's length."""
    along = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(corners)))])
    at = (np.arange(count) + 0.5) / count * along[-1]
    return np.interp(at, along, corners.real) + 1j * np.interp(at, along, corners.imag)


def radius(corners: Any) -> tuple[complex, float]:
    """Return the centroid of a polyline and its root mean square radius."""
    points = dense(corners)
    centre = points.mean()
    return complex(centre), float(np.sqrt((np.abs(points - centre) ** 2).mean()))


def chamfer(curve: Any, target: Any) -> float:
    """Return the mean nearest distances of two polylines, added, over the target's radius."""
    one, two = (dense(corners) for corners in (curve, target))
    means = distances(one, two).mean() + distances(two, one).mean()
    return float(means / radius(target)[1])


def distances(points: Any, others: Any) -> Any:
    """Return the distance from each point to the nearest of others."""
    one, two = (np.stack([z.real, z.imag], axis=-1) for z in (points, others))
    return cKDTree(two).query(one)[0]
