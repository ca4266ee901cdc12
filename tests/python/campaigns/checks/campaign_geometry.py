"""Motions in arrays, and the description's own geometry to judge them by.

`oracle_system` and `agreement.Tracer` share no code with assur.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import NDArray

from assur import Status
from models.mechanisms.mechanism_data import GROUND, Description
from oracles.kinematics.agreement import POSITION, Tracer, U

if TYPE_CHECKING:
    import assur

Array: TypeAlias = NDArray[np.float64]
Bools: TypeAlias = NDArray[np.bool_]


class Sample:
    """A motion in arrays, one row a position; the columns are joints, slides, then links.

    Values and their rates are those of order 0, or first analogues and the second. With several
    drivers q is the parameter of a straight path, and rates are by it: the second and third
    arguments are its values and the path's direction.
    """

    def __init__(
        self,
        motion: assur.Motion,
        order: int = 0,
        parameter: Array | None = None,
        direction: Array | None = None,
    ) -> None:
        self.motion, self.order, m = motion, order, motion.mechanism
        # Of a design `joints` would solve it at the drawing's coordinate.
        joints = dict.fromkeys(n for own in m.links.values() for n in own)
        tracks = [motion.joint(n) for n in joints] + [motion.slide(n) for n in m.slides]
        self.lengths = 2 * len(joints) + len(m.slides)
        tracks += [motion.link(n) for n in m.links]
        n = motion.status.size
        self.q = motion.q.reshape(n) if parameter is None else parameter
        self.status = motion.status.reshape(n)
        names = ("value", "d1") if order == 0 else ("d1", "d2")
        values, rates = ([getattr(t, name) for t in tracks] for name in names)
        if direction is not None:
            rates = [rate @ direction for rate in rates]
        self.value, self.rate = (
            np.concatenate([one.reshape(n, -1) for one in both], axis=1) for both in (values, rates)
        )

        self.reached: Bools = self.status <= Status.SINGULAR
        self.given: Bools = self.status <= Status.NEAR_SINGULAR
        finite = [np.isfinite(a).all(axis=1) for a in (self.value, self.rate)]
        self.wrong: Bools = (finite[0] != self.reached) | (self.given & ~finite[1])
        self.given &= finite[0] & finite[1]

    def differs(self, other: Sample, step: int) -> Bools:
        """Rows of the other that are not, to the bit, every `step`-th of this one."""
        rows = slice(0, step * len(other.q), step)
        apart: Bools = self.status[rows] != other.status
        for a, b in ((self.value, other.value), (self.rate, other.rate)):
            apart |= (a[rows].view(np.uint64) != b.view(np.uint64)).any(axis=1)
        return apart


class Geometry:
    """The description as bodies, pins and guides."""

    def __init__(self, description: Description) -> None:
        self.description = description
        self.tracer = Tracer(description)
        self.system = system = self.tracer.system
        self.base = complex(*description.joints[description.links[GROUND][0]])
        drawn = np.array([complex(*p) for p in description.joints.values()])
        self.drawn = float(np.max(np.abs(drawn - self.base)))
        self.order = {n: i for i, n in enumerate(description.joints)}
        tied = {i: {i} for i in range(len(system.names))}
        for turn in system.turns:
            if turn.q is None:
                both = tied[turn.a] | tied[turn.b]
                for i in both:
                    tied[i] = both
        self.tied = [
            [self.order[j] for b in sorted(tied[i]) for j in system.joint_lists[b]] for i in tied
        ]

    def poses(self, motion: assur.Motion) -> Array:
        """Coordinates of the bodies (N, bodies, 3) as the oracle counts them, ground included."""
        system = self.system
        out = np.zeros((motion.q.size, len(system.names), 3))
        for i, (name, own) in enumerate(zip(system.names, system.joint_lists, strict=True)):
            if i:
                place = motion.joint(own[0]) if own else motion.reference_points[name]
                out[:, i, :2] = place.value.reshape(-1, 2) / system.size
                out[:, i, 2] = motion.link(name).value.reshape(-1) - system.angle0[i]
        return out

    def misfit(self, sample: Sample) -> tuple[Array, Array]:
        """Greatest misfit of every position in the law's 8 u κ of the size, and κ."""
        motion, system = sample.motion, self.system
        pose = self.poses(motion)
        at = (pose[:, :, 0] + 1j * pose[:, :, 1]).T
        turned = np.exp(1j * pose[:, :, 2]).T
        joints = np.array([motion.joint(n).value.reshape(-1, 2) for n in self.order])
        places = (joints[:, :, 0] + 1j * joints[:, :, 1]) / system.size
        far = np.abs(places * system.size - self.base).max(axis=0)
        slides = [np.abs(motion.slide(n).value.reshape(-1)) for n in system.values]
        size = np.max([far, np.full_like(far, self.drawn), *slides], axis=0) / system.size

        def point(body: int, u: tuple[float, float]) -> NDArray[np.complex128]:
            where: NDArray[np.complex128] = at[body] + turned[body] * complex(*u)
            return where

        worst = np.zeros(len(pose))
        for name, (body, u) in system.points.items():
            np.maximum(worst, np.abs(point(body, u) - places[self.order[name]]), out=worst)
        for a, u, b, w in system.pins:
            np.maximum(worst, np.abs(point(a, u) - point(b, w)), out=worst)
        for turn in system.turns:
            angle = pose[:, turn.a, 2] - pose[:, turn.b, 2] + float(turn.shift)
            angle = angle if turn.q is None else angle - sample.q
            arm = np.min([self._arm(turn.a, places, size), self._arm(turn.b, places, size)], axis=0)
            np.maximum(worst, np.abs(np.angle(np.exp(1j * angle))) * arm, out=worst)
        asked = [(r, 0.0 if r.q is None else sample.q) for r in system.reaches]
        asked += [(r, motion.slide(n).value.reshape(-1)) for n, r in system.values.items()]
        for r, value in asked:
            along = np.conj(turned[r.b] * complex(*r.d)) * (point(r.a, r.u) - point(r.b, r.w))
            np.maximum(worst, np.abs(along.real - value / system.size), out=worst)
        condition = motion.condition.reshape(-1)
        # Angles count turns, and are rounded as such.
        rounded = U * np.abs(pose[:, :, 2]).max(axis=1)
        return worst / ((POSITION * condition + rounded) * size), condition

    def _arm(self, body: int, places: NDArray[np.complex128], size: Array) -> Array:
        """Extent of what turns with a body; the size if that is one point."""
        own = self.tied[body]
        if body == 0 or len(own) < 2:
            return size
        arm: Array = np.abs(places[own[1:]] - places[own[0]]).max(axis=0)
        return np.where(arm > 0.0, arm, size)

    def determinants(self, motion: assur.Motion) -> Array:
        """The Jacobian's determinant at every position, NaN where there is none."""
        rows = self.poses(motion)[:, 1:].reshape(motion.q.size, -1)
        matrices = np.array([self.tracer.equations(z, self.tracer.q0)[1] for z in rows])
        return np.asarray(np.linalg.det(matrices), np.float64)
