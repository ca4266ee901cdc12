"""Where the number of assemblies changes over the plane of two drivers.

All assemblies are found on a grid. Between two neighbours whose numbers differ, folds are found by
bisection: the two assemblies that meet there lie beside each other.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from assur.kinematics.loci.bisection import Edge, bisected
from assur.kinematics.pose import Pose

if TYPE_CHECKING:
    import numpy.typing as npt

    from assur._arrays import Float
    from assur.kinematics.assembly import FoundAssemblies
    from assur.kinematics.loci.chart import Surface

# Halvings of an edge: the two assemblies are then about a thousandth of it apart.
HALVINGS = 20
# How far apart (rad, or sizes) two assemblies beside a fold may be.
NEAR = 0.05
# How often edges are searched again whose folds do not explain the change of the count.
MOST_PASSES = 4


@dataclass(frozen=True, slots=True)
class Grid:
    """All assemblies at the nodes of a grid.

    Attributes
    ----------
    axes : (ndarray, ndarray)
        Coordinates of the two drivers, rad or m.
    poses : list of list of list of Pose
        By both axes.
    is_angle : (bool, bool)
        Of each axis: its last value is a neighbour of its first.
    """

    axes: tuple[Float, Float]
    poses: list[list[list[Pose]]]
    is_angle: tuple[bool, bool]

    @property
    def counts(self) -> npt.NDArray[np.intp]:
        """Number of assemblies at each node."""
        return np.array([[len(poses) for poses in row] for row in self.poses], dtype=np.intp)


def all_poses(surface: Surface, places: Float) -> list[list[Pose]]:
    """Return all poses at coordinates of the two free drivers, shape (N, 2)."""
    mechanism = surface.mechanism
    q = np.tile(np.array(surface.q), (len(places), 1))
    q[:, surface.free] = places
    answers: list[FoundAssemblies] = mechanism.core.assemblies(
        mechanism.values.ravel(), q.ravel(), False, None
    )
    return [[Pose.found(numbers) for numbers in answer["assemblies"]] for answer in answers]


def grid_of(surface: Surface, axes: tuple[Float, Float], is_angle: tuple[bool, bool]) -> Grid:
    """Find all assemblies on a grid."""
    places = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 2)
    flat = all_poses(surface, places)
    width = len(axes[1])
    rows = [flat[i : i + width] for i in range(0, len(flat), width)]
    return Grid(axes, rows, is_angle)


def changing_edges(grid: Grid) -> list[Edge]:
    """Return the edges of the grid whose ends' counts differ."""
    return [edge for edge in _edges(grid) if _changes(edge)]


def crossings(grid: Grid, edges: list[Edge], along: Float) -> npt.NDArray[np.intp]:
    """Return how often a curve of coordinates, shape (N, 2), crosses each edge."""
    ends = np.array([edge.ends for edge in edges])
    counts = np.zeros(len(edges), dtype=np.intp)
    for axis in (0, 1):
        along_axis = np.flatnonzero(ends[:, 0, axis] != ends[:, 1, axis])

        def off(values: Float, of: int) -> Float:
            return (
                values - 2.0 * np.pi * np.round(values / (2.0 * np.pi))
                if grid.is_angle[of]
                else values
            )

        side = off(along[:, 1 - axis] - ends[along_axis, 0, 1 - axis, None], 1 - axis)
        before, after = side[:, :-1], side[:, 1:]
        # Half a turn away a wrapped angle changes its sign too.
        meets = ((before < 0.0) != (after < 0.0)) & (np.abs(after - before) < 0.5 * np.pi)
        part = np.where(meets, before / np.where(meets, before - after, 1.0), 0.0)
        step = np.diff(along[:, axis])
        middle, half = (
            ends[along_axis, :, axis].mean(axis=1),
            0.5 * np.abs(np.diff(ends[along_axis, :, axis])[:, 0]),
        )
        at = along[:-1, axis] + part * step - middle[:, None]
        counts[along_axis] = (meets & (np.abs(off(at, axis)) <= half[:, None])).sum(axis=1)
    return counts


def poses_beside_folds(surface: Surface, edges: list[Edge]) -> tuple[list[Pose], int]:
    """Return poses beside the folds on edges, and how many edges they do not explain."""
    starts: list[Pose] = []
    for _ in range(MOST_PASSES):
        if not edges:
            break
        edges, rest = bisected(edges, lambda at: all_poses(surface, at), len, HALVINGS)
        for edge in edges:
            starts.extend(_meetings(surface, edge))
        edges = [edge for edge in rest if _changes(edge)]
    return starts, len(edges)


def _changes(edge: Edge) -> bool:
    return len(edge.found[0]) != len(edge.found[1])


def _edges(grid: Grid) -> list[Edge]:
    edges = []
    counts = [len(axis) for axis in grid.axes]
    for along in (0, 1):
        for i, j in np.ndindex(counts[0], counts[1]):
            next_one = [i, j]
            next_one[along] += 1
            end = np.array([grid.axes[0][i], grid.axes[1][j]])
            far = end.copy()
            if next_one[along] == counts[along]:
                if not grid.is_angle[along]:
                    continue
                next_one[along] = 0
                far[along] = grid.axes[along][0] + 2.0 * np.pi
            else:
                far[along] = grid.axes[along][next_one[along]]
            poses = [grid.poses[i][j], grid.poses[next_one[0]][next_one[1]]]
            edges.append(Edge(np.array([end, far]), poses))
    return edges


def _meetings(surface: Surface, edge: Edge) -> list[Pose]:
    """Return one pose of every two that meet at a bisected edge."""
    fewer, more = (list(poses) for poses in sorted(edge.found, key=len))
    here = [surface.coordinates(pose) for pose in more]
    for pose in fewer:
        # The assembly that continues is the nearest one on the other side.
        there = surface.coordinates(pose)
        gaps = [float(np.abs(surface.difference(position, there)).max()) for position in here]
        nearest = int(np.argmin(gaps))
        here.pop(nearest)
        more = [meeting for i, meeting in enumerate(more) if i != nearest]
    starts = []
    while len(more) > 1:
        pose, place = more.pop(0), here.pop(0)
        gaps = [float(np.abs(surface.difference(position, place)).max()) for position in here]
        nearest = int(np.argmin(gaps))
        if gaps[nearest] > NEAR:
            continue
        more.pop(nearest)
        here.pop(nearest)
        starts.append(pose)
    return starts
