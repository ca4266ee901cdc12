"""Distances of paths and poses from targets, by all pairs and long sums in NumPy."""

from __future__ import annotations

from typing import Any

import numpy as np


def corners(points: Any, closed: bool) -> Any:
    """The corners of a polyline, the first again at the end of a closed one."""
    points = np.asarray(points, dtype=float)
    return np.vstack([points, points[:1]]) if closed else points


def nearest(points: Any, line: Any) -> Any:
    """The distance from each point to a line through corners."""
    start, along = line[:-1], np.diff(line, axis=0)
    from_start = np.asarray(points)[:, np.newaxis] - start
    square = np.maximum(np.sum(along**2, axis=-1), 1e-300)
    parts = np.clip(np.sum(from_start * along, axis=-1) / square, 0.0, 1.0)
    off = from_start - parts[..., np.newaxis] * along
    return np.sqrt(np.sum(off**2, axis=-1)).min(axis=1)


def along(line: Any, parts: Any) -> Any:
    """The points after parts of the length of a line."""
    lengths = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    return np.column_stack([np.interp(parts * lengths[-1], lengths, axis) for axis in line.T])


def radius_of_points(points: Any) -> float:
    """Their root mean square distance from their mean."""
    return float(np.sqrt(np.mean(np.sum((points - np.mean(points, axis=0)) ** 2, axis=1))))


def radius_of_line(line: Any) -> float:
    """The same of a line, as that of very many of its points."""
    return radius_of_points(along(line, (np.arange(400_000) + 0.5) / 400_000))


def points_error(path: Any, targets: Any) -> float:
    """The root mean square distance of targets from a path, over their radius."""
    return float(np.sqrt(np.mean(nearest(targets, path) ** 2))) / radius_of_points(targets)


def chamfer(path: Any, target: Any, count: int) -> float:
    """The mean distances from line to line and back, by length, over the target's radius."""
    middles = (np.arange(count) + 0.5) / count
    there = nearest(along(target, middles), path).mean()
    back = nearest(along(path, middles), target).mean()
    return float(there + back) / radius_of_line(target)


def chamfer_at_corners(path: Any, target: Any, count: int) -> float:
    """The same, with the path's distances at its corners by the trapezoidal rule."""
    there = nearest(along(target, (np.arange(count) + 0.5) / count), path).mean()
    lengths = np.hypot(*np.diff(path, axis=0).T)
    distances = nearest(path, target)
    back = np.sum(lengths * (distances[:-1] + distances[1:]) / 2.0) / lengths.sum()
    return float(there + back) / radius_of_line(target)


def ordered_square(path: Any, target: Any, count: int, closed: bool) -> float:
    """The mean square distance at equal parts of both lengths, by trying everything."""
    middles = (np.arange(count) + 0.5) / count
    mine, wanted = along(path, middles), along(target, middles)
    shifts = range(count) if closed else (0,)
    tried = (
        np.mean(np.sum((mine - np.roll(way, shift, axis=0)) ** 2, axis=1))
        for way in (wanted, wanted[::-1])
        for shift in shifts
    )
    return float(min(tried)) / radius_of_line(target) ** 2


def poses_error(motion: Any, poses: Any, length: float, between: int = 2000) -> float:
    """The root mean square of the least distances from poses to a motion (N, 3), finely divided."""
    parts = np.arange(between + 1) / between
    steps = np.diff(motion, axis=0)
    fine = (motion[:-1, np.newaxis] + parts[:, np.newaxis] * steps[:, np.newaxis]).reshape(-1, 3)
    squares = []
    for x, y, angle in poses:
        turned = np.angle(np.exp(1j * (fine[:, 2] - angle)))
        squares.append(min((fine[:, 0] - x) ** 2 + (fine[:, 1] - y) ** 2 + (length * turned) ** 2))
    return float(np.sqrt(np.mean(squares))) / length
