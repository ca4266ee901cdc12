"""What the solver says of a linkage: that it turns, how large it is, how well it transmits."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from assur._search import narrowed

if TYPE_CHECKING:
    from collections.abc import Callable

    from assur._arrays import Float
    from assur.fitting.target import PathTarget
    from assur.kinematics.mechanism import Mechanism
    from assur.kinematics.motion import Motion

# Positions of a whole turn; extremes are then narrowed between their neighbours.
TURN = 720
PLACES, CLOSEST = 9, 1e-6
# Positions of the path.
PATH = 1000


class Proof(NamedTuple):
    """What holds over the whole turn of the crank, by the solver.

    `apex` is the least angle between the bars of a dyad, rad, and `flattest` its inner joint (None
    without dyads); `extent` is the diameter of the circle about the path's centroid that no joint
    leaves, in the path's radii, and `farthest` the joint that comes nearest to leaving it.
    """

    apex: float
    flattest: str | None
    extent: float
    farthest: str


def prove(mechanism: Mechanism, target: PathTarget) -> Proof | None:
    """Return what holds over the whole turn; None if the crank does not go round."""
    limits = mechanism.limits()
    if not limits.full_rotation or limits.period != 1:
        return None
    q = mechanism.q0 + np.linspace(0.0, 2.0 * np.pi, TURN, endpoint=False)
    motion = mechanism.solve(q, order=0)
    away = [_distance(motion, joint, target) for joint in mechanism.joint_names]
    farthest = mechanism.joint_names[int(np.argmax([far.max() for far in away]))]

    def distance(motion: Motion) -> Float:
        return _distance(motion, farthest, target)

    apex, flattest = least_apex(mechanism, q, motion)
    return Proof(
        apex=apex,
        flattest=flattest,
        extent=2.0 * _greatest(mechanism, q, distance, distance(motion)),
        farthest=farthest,
    )


def least_apex(
    mechanism: Mechanism, q: Float, motion: Motion | None = None
) -> tuple[float, str | None]:
    """Return the least transmission angle of a dyad, and its inner joint; π/2 without dyads.

    Over equidistant positions, then narrowed between them.
    """
    motion = mechanism.solve(q, order=0) if motion is None else motion
    apexes = {joint: motion.transmission_angle(joint) for joint in mechanism.assembly}
    if not apexes:
        return 0.5 * np.pi, None
    flattest = min(apexes, key=lambda joint: float(apexes[joint].min()))

    def flatness(motion: Motion) -> Float:
        return -motion.transmission_angle(flattest)

    return -_greatest(mechanism, q, flatness, -apexes[flattest]), flattest


def path_coordinates(mechanism: Mechanism, arc: float, count: int = PATH) -> Float:
    """Return the crank's coordinates along the path, from its drawing on."""
    return np.asarray(mechanism.q0 + np.linspace(0.0, arc, count))


def _distance(motion: Motion, joint: str, target: PathTarget) -> Float:
    """Return how far a joint is from the path's centroid, in the path's radii."""
    away: Float = np.sqrt((target.framed(motion.joint(joint).value) ** 2).sum(axis=-1))
    return away


def _greatest(
    mechanism: Mechanism, q: Float, height: Callable[[Motion], Float], heights: Float
) -> float:
    """Return the greatest height over a travel: narrowed about the greatest of those at q."""
    best = int(heights.argmax())
    step = q[1] - q[0]

    def at(tried: Float) -> Float:
        return height(mechanism.solve(tried.ravel(), order=0)).reshape(tried.shape)

    low, high = np.array([q[best] - step]), np.array([q[best] + step])
    if not np.isclose(q[-1] + step - q[0], 2.0 * np.pi):
        # A travel that is no whole turn has ends.
        low, high = np.maximum(low, q[0]), np.minimum(high, q[-1])
    tried, _ = narrowed(at, low, high, PLACES, CLOSEST)
    return max(float(at(tried).max()), float(heights[best]))
