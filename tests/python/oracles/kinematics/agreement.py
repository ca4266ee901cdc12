"""Agreement of `assur` with the oracle, in the terms of the design's "Numbers".

The law: "A position is good to about 8 u κ of the size, an analogue of any order to about
64 u κ² of its own size."  Here κ is `motion.condition`, u = 2.2e-16, and

- the size is the greatest extent: of joints (drawn and as they stand) from the ground's first
  joint, of links, of slides' values;
- an angle is measured by what it displaces: it may be wrong by 8 u κ times size over arm, the
  arm being the extent of what turns with that angle (see `_arms`);
- the size of an analogue of order k is the greatest of all outputs' partials of order k, an
  angle's taken times its arm: a single component near zero has no relative error.
"""

from __future__ import annotations

import random
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from models.mechanisms.mechanism_data import GROUND, Description
from oracles.kinematics import oracle
from oracles.kinematics.oracle_system import MP, Pose, System

if TYPE_CHECKING:
    from collections.abc import Sequence

    import assur


Array: TypeAlias = NDArray[np.float64]
Q: TypeAlias = tuple[float, ...]
U = 2.220446049250313e-16
POSITION = 8 * U
ANALOGUE = 64 * U
ORACLE = 1e-40  # sizes: what the oracle gives for an analogue that is 0
LEAST_STEP = 3e-3  # along the path: a fold is then met to its square
GUESS = 1e-9  # residual of a pose that the oracle then refines
FAR = 1e2  # sizes: a pole


class Tracer:
    """`oracle_guess.follow` in arrays: the same equations, ten times as fast."""

    def __init__(self, description: Description) -> None:
        self.system = system = System(description, exact=False)
        z, q = system.drawing()
        self.z0, self.q0, self.unit = np.array(z), np.array(q), np.array(system.unit)
        self.pin_a = np.array([p[0] for p in system.pins], int)
        self.pin_b = np.array([p[2] for p in system.pins], int)
        self.pin_u = np.array([p[1] for p in system.pins]).reshape(-1, 2)
        self.pin_w = np.array([p[3] for p in system.pins]).reshape(-1, 2)
        self.turn_a = np.array([t.a for t in system.turns], int)
        self.turn_b = np.array([t.b for t in system.turns], int)
        self.shift = np.array([t.shift for t in system.turns])
        self.reach_a = np.array([r.a for r in system.reaches], int)
        self.reach_b = np.array([r.b for r in system.reaches], int)
        self.reach_u = np.array([r.u for r in system.reaches]).reshape(-1, 2)
        self.reach_w = np.array([r.w for r in system.reaches]).reshape(-1, 2)
        self.reach_d = np.array([r.d for r in system.reaches]).reshape(-1, 2)
        pins, turns, reaches = len(system.pins), len(system.turns), len(system.reaches)
        self.rows = 2 * pins + turns + reaches
        self.at = (2 * np.arange(pins), 2 * pins + np.arange(turns))
        self.at_reach = 2 * pins + turns + np.arange(reaches)
        self.driver_rows = system._driver_rows()
        self.upward = np.append(0 * self.z0, 1.0)  # direction of t in (coordinates, t)

    def equations(self, z: Array, q: Array) -> tuple[Array, Array]:
        """Residuals and Jacobian at z (scaled)."""
        x, y, t = np.concatenate([np.zeros(3), z]).reshape(-1, 3).T
        c, s = np.cos(t), np.sin(t)
        out, jac = np.empty(self.rows), np.zeros((self.rows, 3 * len(x)))
        row, turn = self.at
        sides: list[Any] = []
        for body, u, sign in ((self.pin_a, self.pin_u, 1.0), (self.pin_b, self.pin_w, -1.0)):
            ax, ay = c[body] * u[:, 0] - s[body] * u[:, 1], s[body] * u[:, 0] + c[body] * u[:, 1]
            sides.append((x[body] + ax, y[body] + ay))
            jac[row, 3 * body] = jac[row + 1, 3 * body + 1] = sign
            jac[row, 3 * body + 2], jac[row + 1, 3 * body + 2] = -sign * ay, sign * ax
        out[row], out[row + 1] = sides[0][0] - sides[1][0], sides[0][1] - sides[1][1]
        out[turn] = t[self.turn_a] - t[self.turn_b] + self.shift
        jac[turn, 3 * self.turn_a + 2], jac[turn, 3 * self.turn_b + 2] = 1.0, -1.0
        a, b, u, w, d = self.reach_a, self.reach_b, self.reach_u, self.reach_w, self.reach_d
        dx, dy = c[b] * d[:, 0] - s[b] * d[:, 1], s[b] * d[:, 0] + c[b] * d[:, 1]
        px, py = c[a] * u[:, 0] - s[a] * u[:, 1], s[a] * u[:, 0] + c[a] * u[:, 1]
        wx, wy = c[b] * w[:, 0] - s[b] * w[:, 1], s[b] * w[:, 0] + c[b] * w[:, 1]
        gx, gy = x[a] + px - x[b], y[a] + py - y[b]
        row = self.at_reach
        out[row] = dx * (gx - wx) + dy * (gy - wy)
        jac[row, 3 * a], jac[row, 3 * a + 1], jac[row, 3 * a + 2] = dx, dy, dy * px - dx * py
        jac[row, 3 * b], jac[row, 3 * b + 1], jac[row, 3 * b + 2] = -dx, -dy, dx * gy - dy * gx
        out[self.driver_rows] -= q
        return out, jac[:, 3:]

    def orientation(self, pose: Pose) -> float:
        """Sign of the Jacobian's determinant at a pose."""
        scale = np.array([self.system.size, self.system.size, 1.0])
        z = np.concatenate([np.array(pose[n]) / scale for n in self.system.names[1:]])
        return float(np.linalg.slogdet(self.equations(z, self.q0)[1])[0])

    def follow(self, move: Sequence[float]) -> Path:
        """From the drawing along q0 + t move to t = 1, or to the fold before it.

        By arc length, so that a fold (or a pole, where something runs to infinity) is met in a
        few steps; the determinant's sign says that it was not stepped over.
        """
        delta = np.array(move) / self.unit
        knots = [np.append(self.z0, 0.0)]
        w, tangent, sign = self.refine(knots[0], self.upward, delta)
        h = 0.2
        while w[-1] < 1.0:
            h = min(h, 0.3 * max(1.0, float(np.max(np.abs(w)))))
            onto = bool(w[-1] + h * tangent[-1] >= 1.0)
            step = float((1.0 - w[-1]) / tangent[-1]) if onto else h
            there = w + step * tangent
            trial, ahead, its_sign = self.refine(there, self.upward if onto else tangent, delta)
            good = np.max(np.abs(trial - there)) <= 0.1 * step and ahead @ tangent > 0.9
            good = good and ahead[-1] > 0 and its_sign == sign
            if good and (onto or trial[-1] < 1.0):
                w, tangent, h = trial, ahead, 1.5 * h
                w[-1] = 1.0 if onto else w[-1]
                knots.append(w)
                continue
            h = step / 2
            if h < LEAST_STEP or np.max(np.abs(w)) > FAR:
                return Path(self, delta, knots, float(w[-1]), sign)
        return Path(self, delta, knots, None, sign)

    def refine(self, start: Array, across: Array, delta: Array) -> tuple[Array, Array, float]:
        """Newton in the plane across a direction; the tangent there (0: none), sign of det."""
        w = start
        for _ in range(6):
            rows, jacobian = self.equations(w[:-1], self.q0 + w[-1] * delta)
            drive = np.zeros((self.rows, 1))
            drive[self.driver_rows, 0] = -delta
            matrix = np.vstack([np.hstack([jacobian, drive]), across])
            if np.max(np.abs(rows)) < GUESS:
                along = np.linalg.solve(matrix, self.upward)
                sign = float(np.linalg.slogdet(jacobian)[0])
                return w, np.asarray(along / np.linalg.norm(along), np.float64), sign
            w = w - np.linalg.solve(matrix, np.append(rows, across @ (w - start)))
        return start, 0 * start, 0.0


@dataclass(frozen=True)
class Path:
    """A ray from the drawing: knots (coordinates, t) that were passed, and t of the fold if any."""

    tracer: Tracer
    delta: Array
    knots: list[Array]
    fold: float | None
    sign: float  # of the determinant, along the whole path

    def pose(self, t: float) -> Pose:
        """The pose at t, which the path passed."""
        i = next(i for i, w in enumerate(self.knots) if w[-1] >= t)
        after, before = self.knots[i], self.knots[max(i - 1, 0)]
        part = (t - before[-1]) / (after[-1] - before[-1]) if i else 0.0
        guess = before + part * (after - before)
        guess[-1] = t
        w, _, sign = self.tracer.refine(guess, self.tracer.upward, self.delta)
        assert sign == self.sign
        assert np.max(np.abs(w - guess)) <= 0.5 * np.linalg.norm(after - before)
        self.tracer.system.put(0, w[:-1].tolist())
        return self.tracer.system.pose()


def arms(description: Description, solution: oracle.Solution, size: float) -> dict[str, float]:
    """Extent of what turns with each link: of its joints and of those of links it slides on."""
    tied = {name: {name} for name in description.links}
    for slide in description.slides.values():
        both = tied[slide.link] | tied[slide.on]
        for name in both:
            tied[name] = both
    out = {}
    for name, links in tied.items():
        joints = {j for n in links for j in description.links[n]}
        places = np.array([solution.joints[j].value for j in joints]).reshape(-1, 2)
        gaps = np.linalg.norm(places[:, None] - places[None], axis=-1)
        out[name] = float(np.max(gaps, initial=0.0)) or size
    return out


def extent(description: Description, solution: oracle.Solution) -> float:
    """Greatest coordinate from the ground's first joint, drawn or now; greatest slide value."""
    base = np.array(description.joints[description.links[GROUND][0]])
    places = [*description.joints.values(), *(j.value for j in solution.joints.values())]
    values = [abs(float(s.value)) for s in solution.slides.values()]
    return float(max(np.max(np.abs(np.array(places) - base)), *values, 0.0))


@dataclass(frozen=True)
class Gap:
    """Greatest errors of one position, as fractions of what the law allows (1: just so)."""

    q: Q
    condition: float
    position: float
    analogues: tuple[float, ...]
    worst: tuple[str, ...]  # whose error it is, for each order
    errors: tuple[float, ...]  # themselves


def compare(
    description: Description,
    motion: assur.Motion,
    index: tuple[int, ...],
    solution: oracle.Solution,
    order: int,
    turns: dict[str, float] | None = None,
) -> Gap:
    """Errors of `motion` at an index; `turns` are the whole turns to take from its angles."""
    size, kappa = extent(description, solution), float(motion.condition[index])
    arm = arms(description, solution, size)
    found: list[float] = []
    worst: list[str] = []
    greatest: list[float] = []
    for k in range(order + 1):
        errors: dict[str, float] = {}
        own = 0.0
        for kind in ("joint", "link", "slide"):
            for name, jet in getattr(solution, kind + "s").items():
                want = jet.tensor(k)
                got = getattr(
                    getattr(motion, kind)(name), "d" * (k > 0) + (str(k) if k else "value")
                )
                unit = arm[name] if kind == "link" else 1.0
                less = turns[name] if turns and kind == "link" and k == 0 else 0.0
                error = float(np.max(np.abs(got[index] - less - want)))
                errors[f"{kind} {name}"] = error * unit
                own = max(own, float(np.max(np.abs(want))) * unit)
        worst.append(max(errors, key=lambda n: errors[n]))
        most = errors[worst[-1]]
        greatest.append(most)
        allowed = ANALOGUE * kappa**2 * own if k else POSITION * kappa * size
        found.append(most / (allowed + ORACLE * size))
    q = motion.coordinate(index)
    q = (q,) if isinstance(q, float) else q
    return Gap(q, kappa, found[0], tuple(found[1:]), tuple(worst), tuple(greatest))


def inherent(description: Description, q: Q, solution: oracle.Solution, order: int) -> float:
    """Change of the exact outputs of an order when the drawing moves by half a u of the size.

    No program that takes the drawing as doubles can be better: it tells a bound that is missed
    by assur from one that nobody can keep.
    """
    mp, size = MP.mpf, extent(description, solution)
    arm, most, bit = arms(description, solution, size), 0.0, U / 2
    for seed in range(4):
        rng = random.Random(seed)
        joints: dict[str, Any] = {
            n: tuple(mp(v) + rng.choice((-1, 1)) * mp(bit * size) for v in p)
            for n, p in description.joints.items()
        }
        slides = {
            n: replace(s, angle=mp(s.angle) + rng.choice((-1, 1)) * mp(bit))
            for n, s in description.slides.items()
        }
        moved = Description(joints, description.links, slides, description.drivers)
        other = oracle.solve(moved, q, solution.pose, order)
        for kind in ("joints", "links", "slides"):
            for name, jet in getattr(solution, kind).items():
                change = getattr(other, kind)[name].tensor(order) - jet.tensor(order)
                unit = arm[name] if kind == "links" else 1.0
                most = max(most, float(np.max(np.abs(change))) * unit)
    return most
