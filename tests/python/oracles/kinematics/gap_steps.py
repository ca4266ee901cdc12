"""By how much angles step across gaps, from a dense sample that knows nothing of knots.

By convention an angle beyond a gap is the one closest to that before it. So the ends of every gap
that the sample shows are bisected to neighbouring numbers, and the angles there compared.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

import assur

if TYPE_CHECKING:
    from collections.abc import Iterator

Array: TypeAlias = NDArray[np.float64]

# About half a turn counts as half: by so much, rad, the one way may be longer than the other.
ABOUT_HALF = math.tau / 1024
# To how much the core knows the angle at an end of a gap, rad: closer to a tie, either will do.
KNOWN = 2e-3
# The branch may miss islands narrower than 0.1° (conventions.md).
NARROW = math.radians(0.1)
# Links whose steps agree so well, rad, turn together, or with the driver between them.
TOGETHER = 1e-6
# Bits of a cell's part that one call bisects.
BITS = 4
# Positions of a gap that is looked at closely: so many, and no farther apart, rad. The branch may
# find islands that are much narrower than NARROW, and steps from one to the next: one of 243 016
# gaps had an island of 1.2e-6 rad in it.
CLOSE = 4001
APART = 5e-7


class Gap(NamedTuple):
    """The last coordinates that can be reached, and the step of every link between them."""

    before: float
    behind: float
    steps: Array


def is_nearest(steps: Array) -> NDArray[np.bool_]:
    """Whether no other step would be shorter; of two that are half a turn either will do."""
    return np.asarray(np.abs(steps) <= math.pi + ABOUT_HALF + KNOWN)


def slides(m: assur.Mechanism) -> bool:
    """Whether the driver is a slide."""
    return isinstance(m.driver, str) and m.driver in m.slides


def is_known(m: assur.Mechanism, gap: Gap) -> NDArray[np.bool_]:
    """Links that step no farther than they need, or turn with such a link, or from it by q."""
    near = is_nearest(gap.steps)
    return np.asarray((together(m, gap.steps, gap.behind - gap.before) & near).any(axis=1))


def together(m: assur.Mechanism, steps: Array, turn: Array | float) -> NDArray[np.bool_]:
    """Which links step together, or with the driver between them: `steps` has links last."""
    apart = np.abs(steps[..., np.newaxis] - steps[..., np.newaxis, :])
    both = apart < TOGETHER
    if not slides(m):
        both |= np.abs(apart - np.abs(turn)[..., np.newaxis, np.newaxis]) < TOGETHER
    return np.asarray(both)


def reached(m: assur.Mechanism, q: Array) -> NDArray[np.bool_]:
    """Whether a design can be assembled there."""
    return m.solve(q, order=0, outputs=[], on_error="nan").status <= assur.Status.SINGULAR


def angles(m: assur.Mechanism, q: Array) -> Array:
    """The angles of all links, a column each."""
    motion = m.solve(q, order=0, outputs=list(m.links), on_error="nan")
    return np.stack([motion.link(name).value for name in m.links], axis=-1)


def bisected(m: assur.Mechanism, inside: Array, outside: Array) -> Array:
    """The last coordinates that can be reached, from there towards those that cannot."""
    parts = np.arange(1, 2**BITS) / 2.0**BITS
    for _ in range(56 // BITS):
        grid = inside[:, np.newaxis] + parts * (outside - inside)[:, np.newaxis]
        good = reached(m, grid.reshape(-1)).reshape(grid.shape)
        first = np.where(good.all(axis=1), len(parts), np.argmin(good, axis=1))
        ends = np.concatenate([inside[:, np.newaxis], grid, outside[:, np.newaxis]], axis=1)
        row = np.arange(len(grid))
        inside, outside = ends[row, first], ends[row, first + 1]
    return inside


def stretches(m: assur.Mechanism, q: Array) -> Array:
    """First and last coordinate of every stretch that can be reached, in the order of q."""
    good = reached(m, q)
    begin = np.flatnonzero(good[1:] & ~good[:-1]) + 1
    end = np.flatnonzero(good[:-1] & ~good[1:])
    found = bisected(m, q[np.concatenate([begin, end])], q[np.concatenate([begin - 1, end + 1])])
    first, last = found[: len(begin)], found[len(begin) :]
    if good[0]:
        first = np.append(q[0], first)
    if good[-1]:
        last = np.append(last, q[-1])
    return np.stack([first, last], axis=1)


def across(m: assur.Mechanism, pieces: Array) -> list[Gap]:
    """The gaps between stretches that are not narrow, in the order of the way from the drawing."""
    wide = pieces[np.abs(np.diff(pieces, axis=1)[:, 0]) > NARROW]
    pairs = np.stack([wide[:-1, 1], wide[1:, 0]], axis=1)
    steps = np.diff(angles(m, pairs.reshape(-1)), axis=0)[::2]
    rows = zip(pairs, steps, strict=True)
    return [Gap(float(before), float(behind), own) for (before, behind), own in rows]


def gaps(m: assur.Mechanism, q: Array) -> list[Gap]:
    """The gaps of a design, in the order of q, which is the way from its drawing."""
    return across(m, stretches(m, q))


def gaps_between(m: assur.Mechanism, edges: Array, infinite: NDArray[np.bool_]) -> list[Gap]:
    """The same of edges that are bisected: each a coordinate that can be reached, one that cannot.

    A gap with an `infinite` edge is not among them: there an angle depends on the last bit of q.
    """
    ordered = edges[np.argsort(edges.min(axis=1))]
    # Stretches at the ends of the sample go on.
    ends = np.concatenate([[-np.inf], ordered[:, 0], [np.inf]])
    begins = np.append(True, ordered[:, 0] > ordered[:, 1])
    begin = np.flatnonzero(begins & ~np.append(begins[1:], False))
    pieces = np.stack([ends[begin], ends[begin + 1]], axis=1)
    ways = [pieces]
    if slides(m):
        # Both ways begin at the drawing.
        up, down = pieces[pieces[:, 1] >= m.q0], pieces[pieces[:, 0] <= m.q0]
        ways = [up, down[::-1, ::-1]]
    poles = set(edges[infinite, 0].tolist())
    found = (gap for way in ways for gap in across(m, way))
    return [gap for gap in found if poles.isdisjoint((gap.before, gap.behind))]


def may_follow(angles: Array, narrow: NDArray[np.bool_]) -> bool:
    """Whether a link's angles at first, middle and last coordinate of stretches keep to the rule.

    It steps to every stretch from the last one that the branch has found: all that are not narrow.
    Of a narrow one that it has missed the middle is as near as can be (conventions.md).
    """
    found = {0}
    for piece in range(1, len(angles)):
        steps = {i: angles[piece] - angles[i, -1] for i in found}
        missed = {i for i in found if narrow[piece] and is_nearest(steps[i][1])}
        found = missed | ({piece} if any(is_nearest(step[0]) for step in steps.values()) else set())
    return bool(found)


def too_far(m: assur.Mechanism, gap: Gap) -> Iterator[str]:
    """Links that step farther across it than they need, in words."""
    wrong = ~is_known(m, gap)
    if not wrong.any():
        return
    # A closer look: the sample may have missed islands, and the branch narrow ones.
    count = max(CLOSE, math.ceil(abs(gap.behind - gap.before) / APART) + 1)
    pieces = stretches(m, np.linspace(gap.before, gap.behind, count))
    narrow = np.abs(np.diff(pieces, axis=1)[:, 0]) <= NARROW
    narrow[[0, -1]] = False  # the ends of wider ones
    places = np.stack([pieces[:, 0], pieces.mean(axis=1), pieces[:, 1]], axis=1)
    own = angles(m, places.reshape(-1)).reshape(*places.shape, -1)
    across = np.diff(pieces.reshape(-1))[1::2]
    steps = np.diff(own[:, [0, 2]].reshape(-1, len(wrong)), axis=0)[1::2]
    with_others = together(m, steps, across).all(axis=0)
    follows = np.array([may_follow(own[:, :, link], narrow) for link in range(len(wrong))])
    for link in np.flatnonzero(wrong & ~(with_others & follows).any(axis=1)):
        name, step = list(m.links)[link], gap.steps[link]
        yield f"{name} steps by {step:.4f} at q = {gap.before!r} … {gap.behind!r}"


def far(m: assur.Mechanism, q: Array) -> Iterator[str]:
    """The same of all gaps."""
    for gap in gaps(m, q):
        yield from too_far(m, gap)
