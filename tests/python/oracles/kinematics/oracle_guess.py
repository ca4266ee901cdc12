"""Poses for the oracle to start from: the drawing's, from joint positions, or followed to q."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from oracles.kinematics.oracle_system import System, as_tuple, inverted

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from models.mechanisms.mechanism_data import Description
    from oracles.kinematics.oracle_system import Pose, Vec

FLOAT_TOL = 1e-13  # residual of `follow`: some hundred roundoffs
LEAST_STEP = 1e-8  # of `follow`, part of the path: below it roundoff hides that the path bends


class StuckError(ArithmeticError):
    """`follow` met a fold or a change point; `q` and `pose` are the last ones reached."""

    def __init__(self, q: tuple[float, ...], pose: Pose) -> None:
        super().__init__(f"cannot be followed beyond q = {q}")
        self.q, self.pose = q, pose


def drawing_pose(description: Description) -> Pose:
    """The pose of the drawing: a guess for q near `drawing_q`."""
    system = System(description)
    system.drawing()
    return system.pose()


def drawing_q(description: Description) -> tuple[float, ...]:
    """q of the drawing, one entry a driver."""
    system = System(description)
    _, q = system.drawing()
    return tuple(float(v * unit) for v, unit in zip(q, system.unit, strict=True))


def guess_from_joints(
    description: Description,
    joints: Mapping[str, Any],
    angles: Mapping[str, Any] | None = None,
) -> Pose:
    """A pose from approximate joint positions and, where known, link angles (with their turns).

    Rotations not given are found from two joints, or from the links slid on; where only the
    distance along a guide between two single joints is left, it keeps the drawing's sign.
    """
    system = System(description, exact=False)
    names, given = system.names, angles or {}
    place: dict[int, Any] = {0: np.zeros(2)}
    turn = {0: 0.0}
    for i, own in enumerate(system.joint_lists):
        if i and own:
            place[i] = np.asarray(joints[own[0]], float) / system.size
        if names[i] in given:
            turn[i] = float(given[names[i]]) - system.angle0[i]
        elif i and len(own) > 1:
            turn[i] = _rotation(description.joints, joints, own)
    for _ in names:
        _spread(system, turn, place)
    for i in range(1, len(names)):
        if i not in place:
            place[i] = _crossing(system, i, turn, place)
    size = system.size
    return {
        n: (float(place[i][0]) * size, float(place[i][1]) * size, turn.get(i, 0.0))
        for i, n in enumerate(names)
        if i
    }


def _rotation(drawn: Mapping[str, Any], now: Mapping[str, Any], own: Sequence[str]) -> float:
    """Rotation of the line from the first joint to the one farthest from it."""
    far = max(own[1:], key=lambda n: math.dist(drawn[n], drawn[own[0]]))
    new, old = (np.asarray(p[far], float) - np.asarray(p[own[0]], float) for p in (now, drawn))
    return math.atan2(new[1], new[0]) - math.atan2(old[1], old[0])


def _spread(system: System, turn: dict[int, float], place: dict[int, Any]) -> None:
    """Rotations of links that slide on links of known rotation; if none, of one RPR pair."""
    for r in system.guides * len(system.names):  # often enough for any chain of slides
        if r.a in turn or r.b in turn:
            turn.setdefault(r.a, turn.get(r.b, 0.0))
            turn.setdefault(r.b, turn[r.a])
    for r in system.guides:
        if r.a not in turn and r.a in place and r.b in place:
            (nx, ny), (wx, wy), (x, y) = r.d, r.w, place[r.a] - place[r.b]
            across, along = nx * wx + ny * wy, ny * wx - nx * wy  # of the drawing
            along = math.copysign(math.sqrt(max(x * x + y * y - across**2, 0.0)), along)
            drawn = math.atan2(across, along) + math.atan2(-nx, ny)
            turn[r.a] = turn[r.b] = math.atan2(y, x) - drawn
            return


def _crossing(
    system: System, i: int, turn: dict[int, float], place: dict[int, Any]
) -> NDArray[np.float64]:
    """Position of a link without joints: where its guides intersect."""

    def spin(body: int, u: Vec) -> NDArray[np.float64]:
        c, s = math.cos(turn.get(body, 0.0)), math.sin(turn.get(body, 0.0))
        return np.array([c * u[0] - s * u[1], s * u[0] + c * u[1]])

    rows, rhs = [], []
    for r in system.guides:
        other = r.b if r.a == i else r.a
        if i in (r.a, r.b) and other in place:
            u, w = (r.u, r.w) if r.a == i else (r.w, r.u)
            rows.append(spin(r.b, r.d))
            rhs.append(rows[-1] @ (place[other] + spin(other, w) - spin(i, u)))
    return np.asarray(np.linalg.lstsq(np.array(rows), np.array(rhs), rcond=None)[0], np.float64)


def follow(description: Description, q_target: Any, steps: int = 100) -> Pose:
    """float64 continuation from the drawing straight to q_target; the pose there.

    `steps` bounds the step; it shrinks where the path bends.  Raises StuckError at a fold.
    """
    system = System(description, exact=False)
    z_list, start_list = system.drawing()
    z, start = np.array(z_list), np.array(start_list)
    unit = np.array(system.unit)
    delta = np.array([float(v) for v in as_tuple(q_target)]) / unit - start
    drive = np.zeros(2 * len(system.pins) + len(system.turns) + len(system.reaches))
    drive[system._driver_rows()] = delta
    t, h = 0.0, 1.0 / steps
    jacobian = system.jacobian()
    square = jacobian.shape[0] == jacobian.shape[1]
    sign = np.linalg.slogdet(jacobian)[0] if square else 1.0
    while t < 1.0:
        h = min(h, 1.0 - t)
        predictor = inverted(jacobian) @ drive * h
        trial, fine = z + predictor, False
        for _ in range(6):
            system.put(0, trial.tolist())
            rows = np.array(system.residual(0, (start + (t + h) * delta).tolist()))
            here = system.jacobian()
            fine = bool(np.max(np.abs(rows)) < FLOAT_TOL)
            if fine or np.max(np.abs(rows)) > 1e3:
                break
            trial = trial - inverted(here) @ rows
        length = np.max(np.abs(predictor))
        fine = fine and bool(np.max(np.abs(trial - z - predictor)) <= 0.1 * length + FLOAT_TOL)
        if fine and length < 0.3 and (not square or np.linalg.slogdet(here)[0] == sign):
            t, z, jacobian = (1.0 if h >= 1.0 - t else t + h), trial, here
            h = min(2 * h, 1.0 / steps)
        else:
            h /= 2
        if h < LEAST_STEP and t < 1.0:
            system.put(0, z.tolist())
            raise StuckError(tuple(((start + t * delta) * unit).tolist()), system.pose())
    system.put(0, z.tolist())
    return system.pose()
