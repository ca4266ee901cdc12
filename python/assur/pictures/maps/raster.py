"""A number over a plane, known at nodes, that changes at curves alone: its value at finer nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from assur._arrays import Float

# Finer nodes per cell; with an even number none lies on a node.
FINER = 8
# Nodes about a finer one that are tried, nearest first.
NEAR = 2


def finer(
    x: Float, y: Float, values: npt.NDArray[np.intp], lines: Sequence[Float]
) -> tuple[Float, Float, npt.NDArray[np.intp]]:
    """Return the middles of a finer grid and the values there.

    A place has the value of the nearest node that no line parts it from.
    """
    along = [_finer_axis(axis) for axis in (x, y)]
    i, j = (
        np.clip(np.searchsorted(a, f) - 1, 0, len(a) - 2)
        for a, f in zip((x, y), along, strict=True)
    )
    u = (along[0] - x[i]) / (x[i + 1] - x[i])
    v = (along[1] - y[j]) / (y[j + 1] - y[j])
    fine = values[np.ix_(i + (u > 0.5), j + (v > 0.5))]
    segments = [np.stack([line[:-1], line[1:]], axis=1) for line in lines if len(line) > 1]
    all_segments = np.concatenate([np.zeros((0, 2, 2)), *segments])
    for cell in np.argwhere(_mixed(values)).tolist():
        rows, columns = (np.flatnonzero(k == c) for k, c in zip((i, j), cell, strict=True))
        places = np.stack(
            np.meshgrid(along[0][rows], along[1][columns], indexing="ij"), axis=-1
        ).reshape(-1, 2)
        block = _values_of_cell(x, y, values, cell, places, all_segments)
        known = block >= 0
        part = fine[np.ix_(rows, columns)].reshape(-1)
        part[known] = block[known]
        fine[np.ix_(rows, columns)] = part.reshape(len(rows), len(columns))
    return along[0], along[1], fine


def _finer_axis(axis: Float) -> Float:
    parts = (np.arange(FINER) + 0.5) / FINER
    fine: Float = (axis[:-1, None] + parts * np.diff(axis)[:, None]).reshape(-1)
    return fine


def _mixed(values: npt.NDArray[np.intp]) -> npt.NDArray[np.bool_]:
    """Whether the corners of each cell differ."""
    corners = [values[:-1, :-1], values[1:, :-1], values[:-1, 1:], values[1:, 1:]]
    differ: npt.NDArray[np.bool_] = np.ptp(np.stack(corners), axis=0) > 0
    return differ


def _values_of_cell(
    x: Float, y: Float, values: npt.NDArray[np.intp], cell: list[int], places: Float, lines: Float
) -> npt.NDArray[np.intp]:
    """Return the values at places of a cell, −1 where lines part them from all nodes about."""
    rows = np.arange(max(cell[0] - NEAR + 1, 0), min(cell[0] + NEAR + 1, len(x)))
    columns = np.arange(max(cell[1] - NEAR + 1, 0), min(cell[1] + NEAR + 1, len(y)))
    nodes = np.stack(np.meshgrid(x[rows], y[columns], indexing="ij"), axis=-1).reshape(-1, 2)
    numbers = values[np.ix_(rows, columns)].reshape(-1)
    low, high = nodes.min(axis=0), nodes.max(axis=0)
    near = lines[((lines.max(axis=1) >= low) & (lines.min(axis=1) <= high)).all(axis=1)]
    scale = np.array([x[cell[0] + 1] - x[cell[0]], y[cell[1] + 1] - y[cell[1]]])
    gaps = (((places[:, None] - nodes) / scale) ** 2).sum(axis=-1)
    parted = _cross(places[:, None, None], nodes[None, :, None], near[:, 0], near[:, 1])
    parted = np.any(parted, axis=-1)
    best = np.argmin(np.where(parted, np.inf, gaps), axis=1)
    nowhere: npt.NDArray[np.bool_] = np.all(parted, axis=1)
    return np.where(nowhere, -1, numbers[best])


def _cross(a: Float, b: Float, c: Float, d: Float) -> npt.NDArray[np.bool_]:
    """Whether the segments a-b and c-d cross."""

    def turn(p: Float, q: Float, r: Float) -> Float:
        left: Float = (q[..., 0] - p[..., 0]) * (r[..., 1] - p[..., 1]) - (
            q[..., 1] - p[..., 1]
        ) * (r[..., 0] - p[..., 0])
        return left

    across: npt.NDArray[np.bool_] = (turn(a, b, c) > 0) != (turn(a, b, d) > 0)
    both: npt.NDArray[np.bool_] = across & ((turn(c, d, a) > 0) != (turn(c, d, b) > 0))
    return both
