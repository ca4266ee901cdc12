"""Limits and extremes against plain scans: what `solve` says at positions close to each other."""

from __future__ import annotations

import math
import random
from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from assur import Status
from campaigns.campaign_report import Findings
from models.mechanisms.mechanism_data import arguments

if TYPE_CHECKING:
    from campaigns.checks.campaign_geometry import Array
    from models.mechanisms import dyad_models

SCANNED = 1500  # positions, over a turn, or over so much of a driven slide, m
SLIDE_REACH = 6.0
# To either side of an end `solve` has a position, or none: ends are good to 1e-9 or so.
BESIDE = 1e-6
# An extreme may be beaten by this part of the greatest value: its place is known to 1e-9, its value
# to 64 u κ² of itself, at 1/sqrt(BESIDE) from a dead point 1e-8.
BEATEN = 1e-7
# What does not move has the noise of rounding, m or rad: of solve's values by the law, of extremes'
# own at most this.
NOISE = 1e-11
U = 2.220446049250313e-16
# A value at its own place, beside a dead point.
RETURNED = 1e-6
# Beside a pole the condition is about the inverse of the distance.
POLE = 1e4
# Beyond this condition analogues are not compared.
FLAT = 1e4
COORDINATES = 2
# A driven slide's limits take a second each: asked of one mechanism in so many.
SLIDING = 20


class Ends(Findings):
    """The limits and some extremes of one mechanism with one driver."""

    def __init__(self, case: dyad_models.Case) -> None:
        super().__init__()
        self.rng = random.Random(f"ends {case.seed}")
        self.m = assur.Mechanism(**arguments(case.description))
        driver = self.m.driver
        if isinstance(driver, tuple):
            return
        self.turning = not (isinstance(driver, str) and driver in self.m.slides)
        if not self.turning and self.rng.randrange(SLIDING):
            return
        self.higher = self.m.structure.cls > 2
        places = list(case.description.joints.values())
        self.size = max(1.0, *np.ptp(places, axis=0)) if places else 1.0
        self.report.counts["limits scanned"] += 1
        reach = math.pi if self.turning else SLIDE_REACH
        self.q = float(self.m.q0) + reach * np.linspace(-1.0, 1.0, SCANNED)
        self.motion = self.m.solve(self.q, order=2, on_error="nan", threads=1)
        self.there = np.asarray(self.motion.status) <= Status.SINGULAR
        self.intervals = np.asarray(self.m.limits().intervals)
        self.guarded(self.limits)
        self.guarded(self.extremes)

    def limits(self) -> None:
        """Intervals are where `solve` has positions, and one holds the drawing."""
        q0, all_q = float(self.m.q0), self.intervals
        held = (all_q[:, 0] <= q0 + BESIDE) & (q0 - BESIDE <= all_q[:, 1])
        if not held.any():
            self.fail("limits", f"no interval of {all_q.tolist()} holds q0 = {q0!r}")
        inside, beside = self.inside(self.q)
        if self.higher:  # the drawing's own interval alone
            beside |= ~inside
        for i in np.flatnonzero((inside != self.there) & ~beside)[:1]:
            name = Status(self.motion.status[i]).name
            self.fail("limits scan", f"{name} at q = {self.q[i]!r}, limits {all_q.tolist()}")
        ends = all_q[np.isfinite(all_q)]
        near = np.array([ends - BESIDE, ends + BESIDE])
        found = self.m.solve(near.ravel(), order=0, on_error="nan", threads=1)
        reached = (np.asarray(found.status) <= Status.SINGULAR).reshape(near.shape)
        # Beyond a pole a mechanism with a group above class II has positions in another interval.
        condition = np.asarray(found.condition).reshape(near.shape)
        wanted = np.array([self.inside(row, 0.0)[0] for row in near])
        for i in np.argwhere((reached != wanted).T)[:1, 0]:
            if self.higher and (wanted[:, i].all() or (condition[:, i] > POLE).all()):
                continue
            self.fail(
                "limits end",
                f"solve beside q = {ends[i]!r}: {reached[:, i]}, by limits {wanted[:, i]}",
            )

    def inside(self, q: Array, margin: float = BESIDE) -> tuple[Any, Any]:
        """Whether an interval holds each coordinate, and whether it is as near to an end."""
        held, beside = np.zeros(q.shape, bool), np.zeros(q.shape, bool)
        around = self.turning and not self.higher
        for low, high in self.intervals:
            x = q
            if around and math.isfinite(high - low):
                x = low - margin + np.mod(q - low + margin, math.tau)
            held |= (low <= x) & (x <= high)
            beside |= (np.abs(x - low) <= margin) | (np.abs(x - high) <= margin)
        return held, beside

    def extremes(self) -> None:
        """No position has less or more, and the extremes are taken where they are said to be."""
        m, rng = self.m, self.rng
        names = [("link", n, n) for n in m.links if n != "ground"]
        names += [("slide", n, n) for n in m.slides]
        names += [("joint", n, f"{n}.{axis}") for n in m.joints for axis in "xy"]
        for kind, own, name in rng.sample(names, min(COORDINATES, len(names))):
            for order in range(3):
                self.report.counts["extremes scanned"] += 1
                self.extreme(kind, own, name, order)

    def extreme(self, kind: str, own: str, name: str, order: int) -> None:
        try:
            found = self.m.extremes(name, order=order)
        except (assur.InputError, assur.PositionError) as error:
            turns = kind == "link" and order == 0 and "turns fully" in str(error)
            if not turns:
                self.fail("extremes refused", f"{name}: {error}")
            return
        low, high = found.min.value, found.max.value
        angle = kind == "link" and order == 0
        if angle and (len(self.intervals) > 1 or not math.isfinite(high - low)):
            return  # each interval is counted from its own turn
        value, noise = self.scanned(kind, own, name, order, angle)
        if not len(value):
            return
        if angle:
            value = value - math.tau * round((value.mean() - 0.5 * (low + high)) / math.tau)
        known = [0.0, *(abs(v) for v in (low, high) if math.isfinite(v))]
        tolerance = max(BEATEN * max(*known, np.abs(value).min()), NOISE)
        if ((value < low - tolerance - noise) | (value > high + tolerance + noise)).any():
            text = f"[{low!r}, {high!r}], a scan has [{value.min()!r}, {value.max()!r}]"
            self.fail("extremes beaten", f"order {order} of {name}: {text}")
            return
        for end in (found.min, found.max):
            if angle or not math.isfinite(end.value) or not math.isfinite(end.q):
                continue
            motion = self.m.solve(np.array([end.q]), order=order, on_error="nan")
            back = self.values(motion, kind, own, name, order)[0]
            allowed = max(RETURNED * max(known), NOISE)
            if motion.status[0] == Status.OK and not abs(back - end.value) <= allowed:
                self.fail(
                    "extremes place", f"order {order} of {name}: {end}, solve has {back!r} there"
                )

    def scanned(
        self, kind: str, own: str, name: str, order: int, angle: bool
    ) -> tuple[Array, Array]:
        """Values at the scan's positions, and their rounding.

        Of an angle over the one interval, in its own turn.
        """
        if angle and np.isfinite(self.intervals).all():
            low, high = self.intervals[0].tolist()
            q = np.linspace(low, high, SCANNED)
            motion = self.m.solve(q, order=order, on_error="nan", threads=1)
        else:
            q, motion = self.q, self.motion
        inside, beside = self.inside(q)
        # Where a joint runs to infinity values are of no use.
        condition = np.asarray(motion.condition)
        good = (np.asarray(motion.status) <= Status.SINGULAR) & (condition < FLAT)
        kept = inside & ~beside & good
        value = self.values(motion, kind, own, name, order)
        known = condition[kept]
        # A joint that stands has no size of its own, to which 64 u κ² would be relative.
        error = 8 * U * known ** (order + 1)
        return value[kept], self.size * (np.maximum(error, 64 * U * known**2) if order else error)

    def values(self, motion: assur.Motion, kind: str, own: str, name: str, order: int) -> Array:
        found = getattr(getattr(motion, kind)(own), f"d{order}" if order else "value")
        if kind == "joint":
            found = found[..., "xy".index(name[-1])]
        return np.asarray(found, np.float64)
