"""Draw mechanisms, paths and curves with matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.errors import InputError

if TYPE_CHECKING:
    from assur.kinematics.assembly import Assembly
    from assur.kinematics.mechanism import Mechanism
    from assur.kinematics.motion import Motion

# Okabe and Ito's colours (2008): distinct in print and for colour-blind readers.
_COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")


def _axes(ax: Any) -> Any:
    if ax is not None:
        return ax
    try:
        import matplotlib.pyplot as plt
    except ImportError as error:  # pragma: no cover
        message = "drawing needs matplotlib: pip install matplotlib"
        raise ImportError(message) from error
    return plt.subplots(layout="constrained")[1]


def mechanism_picture(
    mechanism: Mechanism, q: float | None, ax: Any, assembly: Assembly | None
) -> Any:
    """See `Mechanism.plot`."""
    if mechanism.shape:
        message = (
            f"plot draws one mechanism, this is a batch {mechanism.shape}: take one with design(i)"
        )
        raise InputError(message)
    found = getattr(assembly, "q", None)
    places = (q, found, mechanism._q0_array())
    at = next(place for place in places if place is not None)
    motion = mechanism.solve(at, order=0, assembly=assembly)
    if motion.shape:
        message = f"plot draws one position: q has shape {motion.shape}"
        raise InputError(message)
    return _draw(motion, (), _axes(ax))


def path_picture(motion: Motion, joint: str, ax: Any) -> Any:
    """See `Motion.plot`."""
    if motion.mechanism.shape or not motion.shape:
        message = f"plot draws a path over q of one mechanism; this motion has shape {motion.shape}"
        raise InputError(message)
    ax = _axes(ax)
    points = motion.joint(joint).value
    reached = np.flatnonzero(np.isfinite(points[:, 0]))
    if reached.size:
        _draw(motion, (int(reached[0]),), ax)
    ax.plot(points[:, 0], points[:, 1], color="0.35", linewidth=1.2, zorder=1)
    return ax


def _draw(motion: Motion, index: tuple[int, ...], ax: Any) -> Any:
    """Draw one position: links, slides, joints, ground."""
    mechanism = motion.mechanism
    at = {name: motion.joint(name).value[index] for name in mechanism._joint_names}
    size = _size(list(at.values()))
    for name, slide in mechanism.slides.items():
        _guide(motion, index, name, slide.on, size, ax)
    for name in (name for name in mechanism.links if name != "ground"):
        points = np.array([at[j] for j in mechanism.links[name]])
        colour = _colour(mechanism, name)
        if len(points) > 2:
            corners = _hull(points)
            ax.fill(corners[:, 0], corners[:, 1], color=colour, alpha=0.18, linewidth=0)
            ax.plot(*np.vstack([corners, corners[:1]]).T, color=colour, linewidth=2, label=name)
        elif len(points) == 2:
            ax.plot(*points.T, color=colour, linewidth=3, solid_capstyle="round", label=name)
    for name, point in at.items():
        ax.plot(*point, "o", color="black", markerfacecolor="white", markersize=6, zorder=4)
        ax.annotate(name, point, xytext=(5, 5), textcoords="offset points", zorder=5)
    for joint in mechanism.links["ground"]:
        x, y = at[joint]
        ax.fill(
            [x, x - 0.03 * size, x + 0.03 * size],
            [y, y - 0.05 * size, y - 0.05 * size],
            color="0.75",
            zorder=0,
        )
    ax.set_aspect("equal", adjustable="datalim")
    ax.set_xlabel("x, m")
    ax.set_ylabel("y, m")
    return ax


def _colour(mechanism: Mechanism, link: str) -> str:
    moving = [name for name in mechanism.links if name != "ground"]
    return _COLOURS[moving.index(link) % len(_COLOURS)]


def _size(points: list[Any]) -> float:
    array = np.array(points)
    return float(np.ptp(array, axis=0).max()) or 1.0


def _hull(points: Any) -> Any:
    """Return the corners in order around their middle: links are drawn as polygons."""
    middle = points.mean(axis=0)
    order = np.argsort(np.arctan2(*(points - middle).T[::-1]))
    return points[order]


def _guide(
    motion: Motion, index: tuple[int, ...], name: str, on: str, size: float, ax: Any
) -> None:
    """Draw a guide through the sliding point, and the block on it."""
    slide = motion.mechanism.slides[name]
    joints = motion.mechanism.links[slide.link]
    point = motion.joint(joints[0]) if joints else motion._reference_point(slide.link)
    middle = point.value[index]
    own = motion.mechanism.dimensions.get(f"{name}.angle", 0.0)
    angle = float(motion.link(on).value[index]) + float(own)
    along = np.array([np.cos(angle), np.sin(angle)])
    across = np.array([-along[1], along[0]])
    # The guide reaches to its origin, or to the joint that carries it.
    carriers = motion.mechanism.links[on]
    base = slide.origin or (carriers[0] if carriers and on != "ground" else None)
    to_base = 0.0 if base is None else float(along @ (motion.joint(base).value[index] - middle))
    reach = 0.3 * size
    low, high = min(-reach, to_base), max(reach, to_base)
    ends = np.array([middle + low * along, middle + high * along])
    colour = "0.6" if on == "ground" else _colour(motion.mechanism, on)
    ax.plot(*ends.T, color=colour, linewidth=1.2, linestyle=(0, (6, 3)), zorder=0)
    a, b = 0.05 * size * along, 0.03 * size * across
    block = np.array([middle - a - b, middle + a - b, middle + a + b, middle - a + b])
    ax.fill(*block.T, facecolor="0.9", edgecolor="0.3", zorder=1)
