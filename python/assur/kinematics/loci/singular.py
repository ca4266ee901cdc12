"""Singular loci of mechanisms with two drivers, and the workspace of a joint.

Positions of the second kind are those where the locked drivers do not hold the mechanism, of the
first kind those where a locked joint does not (C. Gosselin and J. Angeles, IEEE Trans. Robotics and
Automation 6 (1990) 281). Both are folds: of the assemblies over the plane of the drivers, and of
those over the plane of the joint, which drives in their place.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import short
from assur._validate import checked_name, real_array, whole_number
from assur.description.words import Drive
from assur.errors import AssurWarning, InputError
from assur.kinematics.configuration import lengths, size_of
from assur.kinematics.inverse.driven_by import driven_by_joint
from assur.kinematics.loci.chart import Surface
from assur.kinematics.loci.folds import (
    Grid,
    all_poses,
    changing_edges,
    crossings,
    grid_of,
    poses_beside_folds,
)
from assur.kinematics.loci.trace import start_beside, trace
from assur.kinematics.model import as_made

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    import numpy.typing as npt
    from matplotlib.axes import Axes

    from assur._arrays import Float
    from assur._later import Mechanism
    from assur.description.words import DriverLike
    from assur.kinematics.loci.trace import Traced
    from assur.kinematics.model import MechanismModel
    from assur.kinematics.pose import Pose

__all__ = ["SingularLocus", "Workspace"]

# Edges that are searched for folds before those curves are traced.
AT_ONCE = 8
# How near (as a fraction of the step) a position must be to a locus to lie on it.
ON_LOCUS = 0.05
# How far beyond the positions seen from the grid of drivers that of a joint goes.
MARGIN = 0.1
# Where, as a part of a step, the grid begins: off the values that people draw at.
OFF = 0.0123
# In sizes, a distance that no joint of a mechanism with turning pairs alone reaches.
FAR = 1000.0
# Fewest and most positions of a grid along an axis.
FEWEST = 4
MOST = 2000


@dataclass(frozen=True, slots=True, eq=False)
class SingularLocus:
    """A curve of singular positions.

    Attributes
    ----------
    kind : {1, 2}
        1: the joint, locked, does not hold the mechanism (the boundary of what it reaches).
        2: the drivers, locked, do not hold it (dead points).
    q : ndarray
        Coordinates of the drivers, rad (continuous) or m, shape (N, n).
    joints : mapping of str to ndarray
        Positions of the joints, m, shape (N, 2).
    is_closed : bool
        Whether its last position is its first.
    is_complete : bool
        Whether it is closed, or ends where the range of a slide does. If not, it could not be
        followed farther: it may have a point where it crosses itself.

    Examples
    --------
    The edge of what an arm of two links reaches, where they are in line:

    >>> import assur, numpy as np
    >>> arm = assur.Mechanism(
    ...     joints={"O": (0, 0), "A": (1, 0), "P": (1.5, 0.5)},
    ...     links={"ground": "O", "upper": "OA", "fore": "AP"},
    ...     driver=("upper", "fore"),
    ... )
    >>> locus = arm.workspace("P", positions=8).boundary[0]
    >>> locus.kind, locus.is_closed
    (1, True)
    >>> x, y = locus.joints["P"].T
    >>> np.hypot(x, y).round(6)[:3]  # m from O
    array([1.707107, 1.707107, 1.707107])
    """

    kind: int
    q: Float
    joints: Mapping[str, Float]
    is_closed: bool
    is_complete: bool
    # A `Mechanism`, whose file stands above.
    mechanism: Mechanism

    def plot(self, joint: str | None = None, *, ax: Axes | None = None, dark: bool = False) -> Axes:
        """Draw the curve of a joint, or of the drivers' coordinates (needs matplotlib).

        Parameters
        ----------
        joint : str, optional
            The joint whose places are drawn, with the mechanism; by default the coordinates of
            two drivers.
        ax : matplotlib.axes.Axes, optional
            Where to draw, also over a workspace or another curve; a new figure by default.
        dark : bool
            For dark backgrounds.

        Returns
        -------
        matplotlib.axes.Axes
            The axes drawn on; data are in m and rad.

        Raises
        ------
        InputError
            No such joint.

        Examples
        --------
        >>> import assur
        >>> five_bar = assur.Mechanism(
        ...     joints={"A": (0, 0), "B": (0, 1), "P": (0.7, 1.2), "D": (1.4, 0.6), "E": (1, 0)},
        ...     links={"ground": "AE", "left": "AB", "rod": "BP", "arm": "DP", "right": "ED"},
        ...     driver=("left", "right"),
        ... )
        >>> axes = five_bar.singular_loci(positions=16)[0].plot()
        >>> axes.get_xlabel(), axes.get_ylabel()
        ('left', 'right')
        """
        from assur.pictures.maps.loci import locus_picture

        if joint is not None:
            self.mechanism.core.index_of("joint", checked_name(joint, "plot"))
        return locus_picture(self, joint, ax, dark)

    def __repr__(self) -> str:
        form = "closed" if self.is_closed else "open"
        return f"<assur.SingularLocus of kind {self.kind}, {form}, {len(self.q)} positions>"


@dataclass(frozen=True, slots=True, eq=False)
class Workspace:
    """Where a joint of a mechanism with two drivers can be.

    Attributes
    ----------
    joint : str
        The joint.
    x, y : ndarray
        Coordinates of a grid, m.
    count : ndarray of int
        The number of ways (coordinates of the drivers and assemblies) to reach each node,
        shape (len(x), len(y)).
    boundary : tuple of SingularLocus
        The loci of the first kind: where that number changes.

    Examples
    --------
    >>> import assur
    >>> arm = assur.Mechanism(
    ...     joints={"O": (0, 0), "A": (1, 0), "P": (1.5, 0.5)},
    ...     links={"ground": "O", "upper": "OA", "fore": "AP"},
    ...     driver=("upper", "fore"),
    ... )
    >>> reach = arm.workspace("P", positions=8)
    >>> reach.joint, reach.count.shape == (len(reach.x), len(reach.y))
    ('P', True)
    """

    joint: str
    x: Float
    y: Float
    count: npt.NDArray[np.intp]
    boundary: tuple[SingularLocus, ...]
    _surface: Surface
    _base: tuple[float, float]
    # A `Mechanism`, whose file stands above.
    mechanism: Mechanism

    def plot(
        self, *, loci: Sequence[SingularLocus] = (), ax: Axes | None = None, dark: bool = False
    ) -> Axes:
        """Draw where the joint can be, and in how many ways (needs matplotlib).

        Regions are filled by the number of ways; curves are the boundary, where that changes. The
        mechanism is drawn in it, lightly, as in its drawing.

        Parameters
        ----------
        loci : sequence of SingularLocus
            From `Mechanism.singular_loci`: those of the second kind, dead points, are drawn too.
        ax : matplotlib.axes.Axes, optional
            Where to draw; a new figure by default.
        dark : bool
            For dark backgrounds.

        Returns
        -------
        matplotlib.axes.Axes
            The axes drawn on.

        Examples
        --------
        >>> import assur
        >>> arm = assur.Mechanism(
        ...     joints={"O": (0, 0), "A": (1, 0), "P": (1.5, 0.5)},
        ...     links={"ground": "O", "upper": "OA", "fore": "AP"},
        ...     driver=("upper", "fore"),
        ... )
        >>> axes = arm.workspace("P", positions=8).plot()
        >>> sorted(text.get_text() for text in axes.texts)
        ['0.5 m', '2 ways', 'A', 'O', 'P', 'limit of reach']
        """
        from assur.pictures.maps.loci import workspace_picture

        return workspace_picture(self, _checked_loci(loci, self.joint), ax, dark)

    def contains(self, points: npt.ArrayLike) -> bool | npt.NDArray[np.bool_]:
        """Return whether the joint reaches points, shape (…, 2), m: an array of bool (…).

        Parameters
        ----------
        points : array_like
            Shape (…, 2), m.

        Returns
        -------
        bool or ndarray of bool
            Shape (…).

        Examples
        --------
        An arm of 1 m and 0.7071 m reaches a ring:

        >>> import assur
        >>> arm = assur.Mechanism(
        ...     joints={"O": (0, 0), "A": (1, 0), "P": (1.5, 0.5)},
        ...     links={"ground": "O", "upper": "OA", "fore": "AP"},
        ...     driver=("upper", "fore"),
        ... )
        >>> arm.workspace("P", positions=8).contains([[0.1, 0.0], [1.0, 1.0], [1.5, 1.5]])
        array([False,  True, False])
        """
        array = real_array(points, "points")
        if array.shape[-1:] != (2,) or not np.isfinite(array).all():
            message = f"points is {short(points)}: finite (x, y) are needed, m"
            raise InputError(message)
        flat = (array - np.array(self._base)).reshape(-1, 2)
        # Farther than all lengths together; the core follows nothing that far.
        inside = np.abs(flat).max(axis=1, initial=0.0) <= FAR * self._surface.size
        if self._surface.mechanism.description.slides[2:]:
            inside[:] = True
        inside[inside] = [len(poses) > 0 for poses in all_poses(self._surface, flat[inside])]
        inside = inside.reshape(array.shape[:-1])
        return bool(inside) if array.ndim == 1 else inside

    def __repr__(self) -> str:
        return f"<assur.Workspace of {self.joint}, {len(self.boundary)} curves of boundary>"


def _checked_loci(loci: Any, joint: str) -> list[SingularLocus]:
    """Return loci that have the joint of a workspace."""
    try:
        listed = list(loci)
    except TypeError:
        listed = [loci]
    for locus in listed:
        if not isinstance(locus, SingularLocus) or joint not in locus.joints:
            message = (
                f"loci has {short(locus)}: loci of this mechanism's singular_loci() are needed"
            )
            raise InputError(message)
    return listed


def singular_loci(
    mechanism: MechanismModel,
    joint: str | None,
    drivers: Sequence[DriverLike] | None,
    positions: int,
) -> tuple[SingularLocus, ...]:
    """See `Mechanism.singular_loci`."""
    if joint is not None:
        mechanism.core.index_of("joint", checked_name(joint, "singular_loci"))
    surface, grid = _over_drivers(mechanism, "singular_loci", drivers, positions)
    loci = _loci(surface, mechanism, grid, 2)
    if joint is not None and grid.counts.any():
        loci += _workspace_of(surface, grid, joint).boundary
    return loci


def workspace(
    mechanism: MechanismModel, joint: str, drivers: Sequence[DriverLike] | None, positions: int
) -> Workspace:
    """See `Mechanism.workspace`."""
    mechanism.core.index_of("joint", checked_name(joint, "workspace"))
    surface, grid = _over_drivers(mechanism, "workspace", drivers, positions)
    return _workspace_of(surface, grid, joint)


def _workspace_of(surface: Surface, grid: Grid, joint: str) -> Workspace:
    """Return the workspace, given all assemblies over the drivers."""
    mechanism = surface.mechanism
    index = mechanism.joint_names.index(joint)
    seen = np.array([pose.joints[index] for row in grid.poses for poses in row for pose in poses])
    positions = len(grid.axes[0])
    if not len(seen):
        message = f"{joint!r}: none of {positions} x {positions} coordinates has an assembly"
        raise InputError(message)
    low, high = seen.min(axis=0), seen.max(axis=0)
    margin = MARGIN * np.maximum(high - low, 1e-3 * surface.size)
    axes = [np.linspace(a, b, positions) for a, b in zip(low - margin, high + margin, strict=True)]
    held = [i for i in range(mechanism.driver_count) if i not in surface.free]
    inverse_mechanism, base = driven_by_joint(
        mechanism, joint, [mechanism.description.drivers[i] for i in held]
    )
    at = (0.0, 0.0, *(surface.q[i] for i in held))
    inverse = Surface(inverse_mechanism, (0, 1), at, surface.size)
    over = grid_of(inverse, (axes[0] - base[0], axes[1] - base[1]), (False, False))
    boundary = _loci(inverse, mechanism, over, 1)
    return Workspace(
        joint, axes[0], axes[1], over.counts, boundary, inverse, base, as_made(mechanism)
    )


def _over_drivers(
    mechanism: MechanismModel, what: str, drivers: Sequence[DriverLike] | None, positions: int
) -> tuple[Surface, Grid]:
    if mechanism.shape:
        message = f"{what}() is for one design, this is a batch {mechanism.shape}: use design(i)"
        raise InputError(message)
    free = _free_drivers(mechanism, what, drivers)
    needed = f"from {FEWEST} to {MOST} are needed"
    positions = whole_number(positions, "positions", FEWEST, MOST, needed)
    all_drivers = mechanism.description.drivers
    is_angle = [
        not isinstance(all_drivers[i], str) or all_drivers[i] not in mechanism.slides for i in free
    ]
    axes = []
    for angle in is_angle:
        reach = np.pi if angle else sum(lengths(mechanism))
        axes.append(-reach + 2.0 * reach * (np.arange(positions) + OFF) / positions)
    q0 = tuple(np.atleast_1d(mechanism.q0).tolist())
    surface = Surface(mechanism, free, q0, size_of(mechanism))
    return surface, grid_of(surface, (axes[0], axes[1]), (is_angle[0], is_angle[1]))


def _free_drivers(
    mechanism: MechanismModel, what: str, drivers: Sequence[DriverLike] | None
) -> tuple[int, int]:
    """Return the indices of the two drivers that move."""
    all_drivers = mechanism.description.drivers
    if len(all_drivers) < 2:
        message = f"{what}() is for two drivers or more; this mechanism has one: see limits()"
        raise InputError(message)
    if drivers is None and len(all_drivers) == 2:
        return 0, 1
    named = list(drivers) if isinstance(drivers, list | tuple) else []
    indices = [
        all_drivers.index(driver)
        for driver in named
        if isinstance(driver, str | Drive) and driver in all_drivers
    ]
    if len(named) != 2 or len(set(indices)) != 2:
        message = f"drivers is {short(drivers)}: name the two of {short(all_drivers)} that move"
        raise InputError(message)
    return indices[0], indices[1]


def _loci(
    surface: Surface, mechanism: MechanismModel, grid: Grid, kind: int
) -> tuple[SingularLocus, ...]:
    """Return the loci of a surface, as positions of the mechanism."""
    traced, lost = _traced(surface, grid)
    lost += sum(not locus.is_complete for locus in traced)
    if lost:
        message = f"singular loci of kind {kind}: {lost} could not be followed to the end"
        warnings.warn(message, AssurWarning, stacklevel=4)
    return tuple(_named(mechanism, locus, kind) for locus in traced)


def _traced(surface: Surface, grid: Grid) -> tuple[list[Traced], int]:
    """Trace every locus that the grid shows; also return how many were not found again."""
    traced: list[Traced] = []
    lost = 0
    is_inside = _within(surface, grid)
    edges = changing_edges(grid)
    changes = np.array(
        [abs(len(edge.found[0]) - len(edge.found[1])) for edge in edges], dtype=np.intp
    )
    crossed = np.zeros_like(changes)
    untried = np.full(len(edges), fill_value=True)
    # At each crossing two assemblies meet: curves found before explain most edges.
    while len(left := np.flatnonzero(untried & (2 * crossed != changes))):
        some = left[:: max(1, len(left) // AT_ONCE)]
        untried[some] = False
        poses, left_open = poses_beside_folds(surface, [edges[i] for i in some])
        lost += left_open
        for pose in poses:
            if _is_known(surface, traced, pose):
                continue
            start = start_beside(surface, pose)
            if start is None:
                lost += 1
            elif not _is_known(surface, traced, start.pose):
                traced.append(trace(surface, start, is_inside))
                along = _coordinates(surface.mechanism, traced[-1])[:, surface.free]
                crossed += crossings(grid, edges, along)
    return traced, lost


def _within(surface: Surface, grid: Grid) -> Callable[[Pose], bool]:
    """Return whether a pose is within the grid's range of the slides, and no joint is far away."""
    reach = 100.0 * surface.size
    slides = list(surface.mechanism.slides)
    ranges = {}
    for i, axis, is_angle in zip(surface.free, grid.axes, grid.is_angle, strict=True):
        driver = surface.mechanism.description.drivers[i]
        if not is_angle and isinstance(driver, str):
            ranges[slides.index(driver)] = (float(axis[0]), float(axis[-1]))

    def is_inside(pose: Pose) -> bool:
        near = bool(np.ptp(np.array(pose.joints), axis=0).max() < reach)
        return near and all(a <= pose.slides[i] <= b for i, (a, b) in ranges.items())

    return is_inside


def _is_known(surface: Surface, traced: list[Traced], pose: Pose) -> bool:
    there = surface.coordinates(pose)
    return any(_passes(surface, locus, there) for locus in traced)


def _passes(surface: Surface, traced: Traced, there: Float) -> bool:
    """Whether a locus goes through coordinates."""
    along = traced.coordinates
    if traced.is_closed:
        along = np.vstack([along, along[:1]])
    if len(along) < 2:
        return False
    steps = surface.difference(along[1:], along[:-1])
    gaps = surface.difference(there[np.newaxis], along[:-1])
    lengths2 = np.maximum((steps * steps).sum(axis=1), 1e-300)
    parts = np.clip((gaps * steps).sum(axis=1) / lengths2, 0.0, 1.0)
    beside2 = ((gaps - parts[:, np.newaxis] * steps) ** 2).sum(axis=1)
    return bool((beside2 <= ON_LOCUS**2 * lengths2).any())


def _round(traced: Traced) -> list[Pose]:
    """Return the poses of a locus; a closed one has the first again at the end."""
    return [*traced.poses, traced.poses[0]] if traced.is_closed else traced.poses


def _coordinates(mechanism: MechanismModel, traced: Traced) -> Float:
    """Return the coordinates of a mechanism's drivers along a locus, angles continuous."""
    poses = _round(traced)
    angles = np.unwrap([pose.angles for pose in poses], axis=0)
    slides = np.array([pose.slides for pose in poses])
    links = {name: angles[:, i] for i, name in enumerate(mechanism.links)}
    values = {name: slides[:, i] for i, name in enumerate(mechanism.slides)}

    def coordinate(driver: Any) -> Float:
        if isinstance(driver, str):
            return values[driver] if driver in values else links[driver]
        relative: Float = links[driver.link] - links[driver.relative_to]
        return relative

    return np.stack([coordinate(drive) for drive in mechanism.description.drivers], axis=-1)


def _named(mechanism: MechanismModel, traced: Traced, kind: int) -> SingularLocus:
    """Return a locus with the coordinates of the mechanism's drivers and its joints."""
    q = _coordinates(mechanism, traced)
    joints = np.array([pose.joints for pose in _round(traced)])
    named = {name: joints[:, i] for i, name in enumerate(mechanism.joint_names)}
    return SingularLocus(kind, q, named, traced.is_closed, traced.is_complete, as_made(mechanism))
