"""How answers to questions follow from those of another description: limits, extremes, curve, find.

As in `variant_results`, each comparison returns what does not agree.
"""

from __future__ import annotations

import math
import re
from contextlib import suppress
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from oracles.kinematics.agreement import ANALOGUE, POSITION

if TYPE_CHECKING:
    from collections.abc import Iterator

    from oracles.kinematics.variant_results import Array, Pairing

# Ends are bisected or solved for: q to this part of a radian (or of the drawing's size).
CLOSE_Q = 1e-7
# Values at extremes, relative to the greater of both and to the drawing. At a dead point, good to
# 1e-11 or so, values change with the square root.
CLOSE_VALUE = 1e-5
# Gaps and islands narrower than this may be there or not, by rounding.
NARROW = 1e-6
# An analogue below this (at the second's drawing) is that of a link that does not turn.
RESTS = 1e-6
# Where a joint of a group above class II is as far away at an end, in sizes, the condition has
# grown with the square of that, and the end is where following is given up.
FAR = 100.0
# Places of assemblies, in parts of the size.
CLOSE_PLACE = 1e-6


def same_limits(p: Pairing) -> Iterator[str]:
    """Intervals, dead points with their groups, full rotation and turns."""
    a, b = p.one.limits(), p.two.limits()
    if (a.full_rotation, a.period) != (b.full_rotation, b.period):
        yield f"rotation {a.full_rotation}, {a.period} turns; {b.full_rotation}, {b.period}"
        return
    want, have = np.sort(p.q(a.intervals), axis=1), np.asarray(b.intervals)
    unit, higher = _unit(p), p.one.structure.cls > 2
    if _in_other_interval(p, a) or _runs_far(p, a):
        return
    around = p.turning[0] and (not higher or _goes_on(p, a))
    if not _same_ends(_gaps(want, around), _gaps(have, around), unit, around):
        yield f"limits {have.tolist()}, from the other description {want.tolist()}"
        return
    groups = [
        sorted(_links(p, point, here) for point in m.dead_points) for here, m in enumerate((a, b))
    ]
    if groups[0] != groups[1] and len(a.dead_points) == len(b.dead_points):
        yield f"dead points of {groups[1]}, by the other description of {groups[0]}"


def _goes_on(p: Pairing, limits: assur.Limits) -> bool:
    """Whether every interval is met in other turns, too: the drawing says which are listed."""
    if not np.isfinite(limits.intervals).all():
        return False
    middles = limits.intervals.mean(axis=1)
    turned = np.concatenate([middles - math.tau, middles + math.tau])
    motion = p.one.solve(turned, order=0, on_error="nan", threads=1)
    return bool((np.asarray(motion.status) <= assur.Status.SINGULAR).all())


def _in_other_interval(p: Pairing, limits: assur.Limits) -> bool:
    """Whether the second, with a group above class II, is drawn in another interval."""
    return p.one.structure.cls > 2 and not _holds(limits.intervals, float(p.drawn_q[0]))


def _runs_far(p: Pairing, limits: assur.Limits) -> bool:
    """Whether a joint or slide is far away at an end, with a group above class II."""
    ends = limits.intervals[np.isfinite(limits.intervals)]
    if p.one.structure.cls <= 2 or not len(ends):
        return False
    low, high = limits.intervals[0]
    inward = np.where(ends == low, 1.0, -1.0) * NARROW * min(high - low, 1.0)
    motion = p.one.solve(ends + inward, order=0, on_error="nan", threads=1)
    places = [np.abs(motion.joint(name).value).ravel() for name in p.d.joints]
    places += [np.abs(motion.slide(name).value).ravel() for name in p.d.slides]
    size = float(np.ptp(list(p.d.joints.values()), axis=0).max())
    return bool((np.nan_to_num(np.concatenate(places)) > FAR * size).any())


def _links(p: Pairing, point: assur.DeadPoint, second: int) -> tuple[str, ...]:
    """The links of the group of a dead point, by the second's names."""
    found = re.findall(r"\w+", (point.group or "").partition("(")[2])
    return tuple(sorted(n if second else p.name("link", n) for n in found))


def _unit(p: Pairing) -> float:
    if p.turning[0]:
        return 1.0
    return p.frame.scale * float(np.ptp(list(p.d.joints.values()), axis=0).max())


def _holds(intervals: Array, q: float) -> bool:
    return bool(((intervals[:, 0] - NARROW <= q) & (q <= intervals[:, 1] + NARROW)).any())


def _gaps(intervals: Array, around: bool) -> Array:
    """What is between intervals, where that is not narrow; `around` a turn."""
    ends = intervals[np.argsort(intervals[:, 0])].tolist()
    if around and len(ends) and np.isfinite(ends).all():
        ends.append([end + math.tau for end in ends[0]])
        if len(ends) > 2:  # given in other turns
            low = ends[0][0]
            turned = [
                [e - math.tau * math.floor((one[0] - low) / math.tau) for e in one]
                for one in ends[:-1]
            ]
            ends = sorted(turned)
            ends.append([end + math.tau for end in ends[0]])
    elif ends:
        ends = [[-math.inf, -math.inf], *ends, [math.inf, math.inf]]
    gaps = [(one[1], two[0]) for one, two in pairwise(ends)]
    return np.array([gap for gap in gaps if gap[1] - gap[0] > NARROW]).reshape(-1, 2)


def _same_ends(want: Array, have: Array, unit: float, around: bool) -> bool:
    if want.shape != have.shape:
        return False
    if around:
        want, have = np.exp(1j * want), np.exp(1j * have)
        return all(np.abs(have - gap).max(axis=1).min() <= CLOSE_Q for gap in want)
    return bool(np.allclose(want, have, 0.0, CLOSE_Q * unit))


def same_extremes(p: Pairing, kind: str, name: str, order: int) -> Iterator[str]:
    """Of a link or a slide; angles modulo a turn, and only of one interval: each has its own."""
    try:
        a = p.one.extremes(name, order=order)
    except assur.PositionError as error:
        yield f"extremes of {name}: {error}"
        return
    except assur.InputError:
        # A link that turns fully: so it does however it is described.
        with suppress(assur.InputError):
            p.two.extremes(p.name(kind, name), order=order)
            yield f"extremes of {name}: it turns fully, and has some as {p.name(kind, name)}"
        return
    if kind == "link" and order == 0 and any(len(m.limits().intervals) > 1 for m in (p.one, p.two)):
        return
    limits = p.one.limits()
    if _in_other_interval(p, limits) or _runs_far(p, limits):
        return
    b = p.two.extremes(p.name(kind, name), order=order)
    have = np.array([b.min.value, b.max.value])
    own = np.array([a.min.value, a.max.value])
    if order:
        want = np.sort(own * p.grows(kind) / p.units[0] ** order)
    else:
        want = np.sort(p.value(kind, name, own))
    scale = np.abs([*want[np.isfinite(want)], *have[np.isfinite(have)], 0.0]).max()
    scale = max(scale, p.frame.scale if kind == "slide" else 1.0)
    with np.errstate(invalid="ignore"):
        apart = have - want
    if kind == "link" and order == 0 and np.isfinite(apart).all():
        apart = apart - math.tau * np.round(apart[0] / math.tau)
    allowed = CLOSE_VALUE + _rounding(p, limits, (a.min.q, a.max.q), order)
    with np.errstate(invalid="ignore"):
        good = (have == want) | (np.abs(apart) <= allowed.max() * scale)
    if not good.all():
        yield f"extremes of order {order} of {name}: {have.tolist()}, should be {want.tolist()}"


def _rounding(p: Pairing, limits: assur.Limits, places: tuple[float, float], order: int) -> Array:
    """The law of the digits at extremes: of those at an end, a little within.

    Values at a dead point come from farther away, where they have digits. An end that is not a dead
    point but the edge of rounding has no digits to either side.
    """
    q = np.nan_to_num(np.array(places), nan=float(p.one.q0))
    for low, high in limits.intervals:
        if math.isfinite(low) and math.isfinite(high):
            aside = NARROW * (high - low)
            within = (low - aside <= q) & (q <= high + aside)
            q = np.where(within, np.clip(q, low + aside, high - aside), q)
    condition = p.one.solve(q, order=0, on_error="nan", threads=1).condition
    return (ANALOGUE if order else POSITION) * np.nan_to_num(condition) ** (order + 1)


def same_assemblies(p: Pairing, q: Array) -> Iterator[str]:
    """As many, of as many complex ones, at the same places."""
    a, b = p.one.assemblies(p.plain(q)), p.two.assemblies(p.plain(p.q(q)))
    if not (a.is_complete and b.is_complete):
        return
    if sorted(a.complex_count) != sorted(b.complex_count) or len(a) != len(b):
        counts = [f"{len(one)} of {one.complex_count}" for one in (b, a)]
        yield f"{counts[0]} assemblies at {q}, should be {counts[1]}"
        return
    places = [_places(p, p.one, p.plain(q), one, False) for one in a]
    others = [_places(p, p.two, p.plain(p.q(q)), one, True) for one in b]
    size = float(np.abs(places).max()) if places else 1.0
    for place in places:
        want = place @ p.frame.matrix.T + p.frame.shift
        nearest = min(float(np.abs(want - other).max()) for other in others)
        if not nearest <= CLOSE_PLACE * size * p.frame.scale:
            yield f"an assembly at {q} is {nearest:.3g} m from any of the other description"
            return


def _places(p: Pairing, m: assur.Mechanism, q: Any, assembly: Any, second: bool) -> Array:
    motion = m.solve(q, order=0, assembly=assembly, on_error="nan")
    names = [p.name("joint", n) if second else n for n in p.d.joints]
    return np.array([motion.joint(n).value for n in names])


def same_finds(p: Pairing, kind: str, name: str, value: float) -> Iterator[str]:
    """All coordinates at which a link or a slide has a value; none for one that rests."""
    if not float(np.abs(getattr(p.at_first, kind)(name).d1).max()) > RESTS:
        return
    a = [q for q, _ in p.one.find(name, value)]
    b = [q for q, _ in p.two.find(p.name(kind, name), float(p.value(kind, name, value)))]
    want, have = (np.atleast_1d(np.array(one, np.float64)) for one in (p.q(np.array(a)), b))
    if want.shape == have.shape:
        if p.turning[0]:
            want, have = (np.sort(np.mod(one + 0.1, math.tau)) for one in (want, have))
        if np.abs(np.sort(want) - np.sort(have)).max(initial=0.0) <= CLOSE_Q * _unit(p):
            return
    yield f"find({name}, {value!r}): {b}, should be {p.q(np.array(a)).tolist()}"


def same_curve(p: Pairing) -> Iterator[str]:
    """Branches, circuits and folds; and no defect between two positions of the motion."""
    a, b = (m.configuration_curve() for m in (p.one, p.two))
    counts = [(len(c.branches), len(c.folds), len(c.circuits)) for c in (a, b)]
    if counts[0] != counts[1]:
        yield f"{counts[1]} branches, folds and circuits, should be {counts[0]}"
        return
    want, have = (np.array([fold.q for fold in c.folds]) for c in (a, b))
    want = p.q(want)
    if p.turning[0]:
        want, have = (np.exp(1j * one) for one in (want, have))
    if len(want) and np.abs(want[:, np.newaxis] - have).min(axis=1).max() > CLOSE_Q * _unit(p):
        yield f"folds at {have}, should be {want}"
