"""The checks of a campaign on one motion.

Motions are checked against their own first analogues, ends of gaps against the Jacobian of the
bodies.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol, TypeAlias

import numpy as np

from oracles.kinematics.agreement import POSITION

if TYPE_CHECKING:
    from collections.abc import Callable

    import assur
    from campaigns.checks.campaign_geometry import Array, Bools, Sample

Solve: TypeAlias = "Callable[[Array], Sample]"
Test: TypeAlias = "Callable[[Array, Array, Array, Array, Array], Bools]"

# A closure equation is met by three numbers, each good to the law's 8 u κ of the size.
TERMS = 3.0
# What counts as a jump: 1/1000 of the drawing, or 1/1000 rad. Cells are halved until the analogues
# at both ends predict the motion between to that much, or nothing moves that far.
JUMP = 1e-3
# The trapezoid's own error where the second analogue is 0 within a cell.
TRAPEZOID = 1e-5
# What counts as a bend, in parts of the first analogue: where the motion does not go on smoothly at
# a change point analogues change by their own size, and those beside it are good to 64 u κ².
BEND = 0.05
# A cell of 1e-2 halved so often is a few spacings of q.
HALVINGS = 40
# Coordinates, in sizes of the drawing, beyond which a point is about to pass through infinity.
POLE = 1e6
# The same of groups above class II, whose branches end earlier: their condition grows with its
# square. That it is a pole must show in how it grows, v = A / (distance to the pole): two points so
# far apart give the distance (rad, or of the size), which must be small.
POLE_OF_GROUPS = 100.0
POLE_STEP = 1e-6
POLE_NEAR = 1e-2
# A narrow pole: steps from the end, and how many of them behind it infinity is at most.
POLE_STEPS = (1e-6, 1e-5)
POLE_BEHIND = 2.0
# At a fold the squared determinant falls linearly to 0: at four steps it is four times that at
# one; at a change point 16 times; where nothing is singular once. Steps in q, the best first: the
# next terms go with the root of the step, rounding with its inverse.
FOLD_STEPS = (1e-6, 1e-7, 1e-8, 1e-9, 1e-5, 1e-10, 1e-4, 1e-11, 1e-12)
FOLD_RATIO = 0.15
CROSSING_STEPS = (1e-5, 1e-4)
# Where two dyads fold together it falls faster, at the very same q as at a change point; but beyond
# that there would be an assembly beside the last one: as far off as the motion goes in that step.
BEYOND = 1e-6
BESIDE = 1e-4
# Of central differences of order 4: the step, and the greatest condition where they are asked for.
DIFFERENCE_STEP = 1e-3
DIFFERENCE_CONDITION = 50.0
DIFFERENCE_MARGIN = 4.0  # times the change when the step is halved (their error is 1/15 of it)
# Part of the change by the halving before, as much as it is of the next term of the error: where
# the first one passes through zero a single halving promises too much.
DIFFERENCE_NEXT = 1.0 / 64.0
DIFFERENCE_KNOWN = 1e-3  # where halving the step changes more (of the value), they are no evidence


class HasDeterminants(Protocol):
    """An oracle for the Jacobian of a mechanism's bodies."""

    def determinants(self, motion: assur.Motion) -> Array:
        """The Jacobian's determinant at every position."""


def broken(
    solve: Solve, sample: Sample, size: float, test: Test
) -> tuple[list[str], Array, dict[str, int]]:
    """Cells that fail a test however fine; edges of gaps (q reached, q not) as rows; counts."""
    a, b = np.arange(len(sample.q) - 1), np.arange(1, len(sample.q))
    q, value, rate, reached = sample.q, sample.value, sample.rate, sample.reached
    given, unit = sample.given, np.ones(value.shape[1])
    unit[: sample.lengths] = size
    edges: list[Array] = []
    found: list[tuple[float, str]] = []
    count = {"cells": 0, "halved": 0, "poles": 0}
    for halving in range(HALVINGS + 1):
        into, out = reached[a] & ~reached[b], ~reached[a] & reached[b]
        edges += [np.stack([q[a[into]], q[b[into]]], 1), np.stack([q[b[out]], q[a[out]]], 1)]
        both = given[a] & given[b]
        a, b = a[both], b[both]
        count["cells"] += len(a)
        here, there = np.abs(value[a]), np.abs(value[b])
        far = (np.minimum(here, there)[:, : sample.lengths] > POLE * size).any(axis=1)
        scale = np.maximum(np.maximum(here, there), unit)
        if test is jumps:  # angles count turns
            scale[:, sample.lengths :] = 1.0
        h = (q[b] - q[a])[:, np.newaxis]
        bad = ~test(h, value[b] - value[a], rate[a], rate[b], scale).all(axis=1)
        count["poles"] += int((bad & far).sum())
        a, b = a[bad & ~far], b[bad & ~far]
        middle = 0.5 * (q[a] + q[b])
        last = (middle == q[a]) | (middle == q[b]) | (halving == HALVINGS)
        for one, other in zip(a[last], b[last], strict=True):
            moved = float(np.abs(value[other] - value[one]).max())
            found.append((-moved, f"by {moved:.3g} at q = {q[one]!r} … {q[other]!r}"))
        a, b, middle = a[~last], b[~last], middle[~last]
        if not len(a):
            break
        n = len(middle)
        count["halved"] += n
        fine, keep = solve(middle), np.concatenate([a, b])
        q = np.concatenate([q[keep], middle])
        value = np.concatenate([value[keep], fine.value])
        rate = np.concatenate([rate[keep], fine.rate])
        reached = np.concatenate([reached[keep], fine.reached])
        given = np.concatenate([given[keep], fine.given])
        low, high, mid = np.arange(n), np.arange(n, 2 * n), np.arange(2 * n, 3 * n)
        a, b = np.concatenate([low, mid]), np.concatenate([mid, high])
    return [text for _, text in sorted(found)], np.concatenate(edges), count


def jumps(h: Array, moved: Array, u: Array, v: Array, scale: Array) -> Bools:
    """Where the rates u and v at both ends of cells predict the motion between them."""
    error = np.abs(moved - 0.5 * h * (u + v))
    bend = h * np.abs(v - u)
    # A rate that does not turn back keeps the motion within half its change.
    carried = error <= 0.5 * bend + TRAPEZOID * scale
    return np.asarray(carried & (np.minimum(bend, np.abs(moved)) <= JUMP * scale))


def bends(h: Array, moved: Array, u: Array, v: Array, scale: Array) -> Bools:
    """The same of first analogues, by the second: a bend in the path, roughly."""
    return np.asarray(np.abs(moved - 0.5 * h * (u + v)) <= BEND * scale)


def bisected(solve: Solve, edges: Array, bits: int = 4) -> Array:
    """Edges with their two ends neighbouring numbers, or nearly so; so many bits in a call."""
    inside, outside = edges[:, 0].copy(), edges[:, 1].copy()
    parts = np.arange(1, 2**bits) / 2.0**bits
    for _ in range(56 // bits):  # 2^-56 of a cell
        grid = inside[:, np.newaxis] + parts * (outside - inside)[:, np.newaxis]
        reached = solve(grid.reshape(-1)).reached.reshape(grid.shape)
        first = np.where(reached.all(axis=1), len(parts), np.argmin(reached, axis=1))
        row = np.arange(len(grid))
        ends = np.concatenate([inside[:, np.newaxis], grid, outside[:, np.newaxis]], axis=1)
        inside, outside = ends[row, first], ends[row, first + 1]
        if (np.abs(outside - inside) <= 4 * np.spacing(np.abs(inside))).all():
            break
    return np.stack([inside, outside], axis=1)


def poles(solve: Solve, edges: Array, size: float, higher: bool) -> Bools:
    """Whether a point goes to infinity just beyond the ends (bisected)."""
    direction = np.sign(edges[:, 1] - edges[:, 0])
    inside, before = solve(edges[:, 0]), solve(edges[:, 0] - direction * POLE_STEP)
    near, far = (np.abs(sample.value[:, : sample.lengths]) for sample in (inside, before))
    if not higher:
        return np.asarray(near.max(axis=1) > POLE * size)
    place = np.arange(len(near)), near.argmax(axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        distance = POLE_STEP * far[place] / (near[place] - far[place])
    is_near = (distance > 0.0) & (distance < POLE_NEAR)
    return np.asarray((near[place] > POLE_OF_GROUPS * size) & is_near)


def narrow_poles(solve: Solve, edges: Array) -> Bools:
    """Whether a joint goes to infinity just beyond ends (bisected), though not far away there.

    Its rate grows like the inverse square of the distance from infinity: the inverse root of it
    falls linearly to zero. (At a fold its fourth power does, at other ends it stays.)
    """
    direction = np.sign(edges[:, 0] - edges[:, 1])
    found = np.zeros(len(edges), dtype=np.bool_)
    for step in POLE_STEPS:
        sample = solve(
            np.concatenate([edges[:, 0] + direction * reach * step for reach in (1, 4, 10)])
        )
        rates = np.abs(sample.rate[:, : sample.lengths]).reshape(3, len(edges), -1)
        place = rates[0].argmax(axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            root = 1.0 / np.sqrt(rates[:, np.arange(len(edges)), place])
            near, far = (root[1] - root[0]) / 3.0, (root[2] - root[1]) / 6.0
            linear = np.abs(near / far - 1.0) <= FOLD_RATIO
            found |= linear & (near > 0.0) & (root[0] / near <= 1.0 + POLE_BEHIND)
    return found


def crossings(solve: Solve, geometry: HasDeterminants, edges: Array) -> Bools:
    """Whether two branches cross at ends (bisected).

    The determinant itself falls linearly there, and first analogues stay (at a fold they grow like
    1/√distance: twofold here).
    """
    direction = np.sign(edges[:, 0] - edges[:, 1])
    found = np.zeros(len(edges), dtype=np.bool_)
    for step in CROSSING_STEPS:
        sample = solve(np.concatenate([edges[:, 0] + direction * reach * step for reach in (1, 4)]))
        near, far = geometry.determinants(sample.motion).reshape(2, -1)
        slow, fast = sample.rate.reshape(2, len(edges), -1)
        with np.errstate(divide="ignore", invalid="ignore"):
            linear = np.abs(far / near / 4.0 - 1.0) <= FOLD_RATIO
            change = np.abs(slow - fast).max(axis=1) / np.abs(fast).max(axis=1)
        found |= linear & (change <= FOLD_RATIO)
    return found


def unreal(solve: Solve, geometry: HasDeterminants, edges: Array) -> tuple[list[str], float]:
    """Ends of gaps (bisected) that are no folds, and the worst ratio of those that are."""
    if not len(edges):
        return [], 0.0
    ratio = np.full(len(edges), np.nan)
    direction = np.sign(edges[:, 0] - edges[:, 1])
    left = np.arange(len(edges))
    for step in FOLD_STEPS:
        near = edges[left, 0] + direction[left] * step
        far = edges[left, 0] + direction[left] * 4 * step
        sample = solve(np.concatenate([near, far]))
        d = geometry.determinants(sample.motion).reshape(2, -1)
        with np.errstate(divide="ignore", invalid="ignore"):
            # The steps as they are, after rounding.
            ratio[left] = (d[1] / d[0]) ** 2 * (near - edges[left, 0]) / (far - edges[left, 0])
        left = left[~(np.abs(ratio[left] - 1.0) <= FOLD_RATIO)]
        if not len(left):
            break
    if len(left):
        ends = [goes_on(solve, edges[i, 0], edges[i, 0] - direction[i] * BEYOND) for i in left]
        left = left[~((ratio[left] > 1.0) & ~np.array(ends, dtype=np.bool_))]
    found = [f"no fold at q = {edges[i, 0]!r} | {edges[i, 1]!r}: {ratio[i]:.3g}" for i in left]
    good = np.abs(ratio - 1.0) <= FOLD_RATIO
    return found, float(np.max(np.abs(ratio[good] - 1.0), initial=0.0))


def goes_on(solve: Solve, last: float, beyond: float) -> bool:
    """Whether some assembly beyond the last position of a motion is close to it."""
    motion = solve(np.array([last])).motion
    if motion.mechanism.structure.cls > 2:  # their assemblies are not found yet
        return True
    here = np.array([motion.joint(name).value[0] for name in motion.mechanism.joints])
    size = np.abs(here).max()
    for assembly in motion.mechanism.assemblies(beyond):
        other = motion.mechanism.solve(beyond, order=0, assembly=assembly)
        there = np.array([other.joint(name).value for name in other.mechanism.joints])
        if np.abs(there - here).max() <= BESIDE * size:
            return True
    return False


def differences(
    solve: Solve, sample: Sample, condition: Array, rng: np.random.Generator
) -> tuple[list[str], int, float]:
    """Analogues that are not central differences of positions; how many were; the worst part."""
    fit = np.flatnonzero(sample.reached & (condition < DIFFERENCE_CONDITION))
    if not len(fit):
        return [], 0, 0.0
    rows = rng.choice(fit, 4)
    offsets = np.array([-8, -4, -2, -1, 1, 2, 4, 8]) * (0.5 * DIFFERENCE_STEP)
    q = sample.q[rows][:, np.newaxis] + offsets
    x = solve(q.reshape(-1)).value.reshape(*q.shape, -1)
    # As rounded: q is taken from the grid itself.
    spans = [x[:, 4 + k] - x[:, 3 - k] for k in range(4)]
    fine, rough, rougher = (
        (8.0 * spans[k] - spans[k + 1]) / (6.0 * 2.0**k * DIFFERENCE_STEP) for k in range(3)
    )
    own, scale = sample.rate[rows], np.abs(x[:, 1:-1]).max(axis=(1, 2))[:, np.newaxis]
    kappa = condition[rows][:, np.newaxis]
    change, before = np.abs(fine - rough), np.abs(rough - rougher)
    allowed = DIFFERENCE_MARGIN * np.fmax(change, DIFFERENCE_NEXT * before)
    # Positions are good to 8 u κ of the size, q to its spacing times the rate.
    noise = 3 * POSITION * kappa * scale + 4 * np.spacing(np.abs(q).max()) * np.abs(own)
    allowed += noise / DIFFERENCE_STEP
    known = allowed <= DIFFERENCE_KNOWN * np.maximum(scale, np.abs(own))
    error = np.abs(fine - own)
    worst = float(np.max((error / allowed)[known], initial=0.0))
    bad = (known & (error > allowed)).any(axis=1)
    found = [f"no difference at q = {sample.q[r]!r}" for r in rows[bad]]
    return found, int(known.any(axis=1).sum()), worst
