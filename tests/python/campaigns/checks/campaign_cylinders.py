"""Cylinders: their length is the distance of their joints, and never negative."""

from __future__ import annotations

import random
from typing import TYPE_CHECKING

import numpy as np

from assur import Status
from campaigns.campaign_report import Findings

if TYPE_CHECKING:
    from models.mechanisms.cylinder_models import Case

POSITIONS = 300
ASSEMBLIES = 4
REACH = 4.0  # rad or m, to either side of the drawing
CLOSE = 1e-9  # of the size, times κ


class Cylinders(Findings):
    """One mechanism with cylinders."""

    def __init__(self, case: Case) -> None:
        super().__init__()
        self.case, self.m = case, case.mechanism
        self.rng = random.Random(f"lengths {case.seed}")
        self.report.counts["mechanisms with cylinders"] += 1
        self.guarded(self.lengths)
        if np.size(self.m.q0) == 1:
            self.guarded(self.questions)

    def lengths(self) -> None:
        """At every position with values, in every assembly of the drawing's coordinate."""
        start = np.atleast_1d(self.m.q0)
        q = start + np.array(
            [[self.rng.uniform(-REACH, REACH) for _ in start] for _ in range(POSITIONS)]
        )
        for assembly in (None, *list(self.m.assemblies(self.m.q0))[:ASSEMBLIES]):
            motion = self.m.solve(
                q if start.size > 1 else q[:, 0],
                order=0,
                assembly=assembly,
                on_error="nan",
                threads=1,
            )
            good = np.asarray(motion.status) <= Status.SINGULAR
            for name, (base, end) in self.case.cylinders.items():
                length = np.asarray(motion.slide(name).value)
                gap = motion.joint(end).value - motion.joint(base).value
                distance = np.hypot(gap[:, 0], gap[:, 1])
                allowed = CLOSE * np.maximum(np.asarray(motion.condition), 1.0) * 4.0
                for i in np.flatnonzero(good & ~(np.abs(length - distance) <= allowed))[:1]:
                    text = f"{name} is {length[i]!r} at q = {q[i]!r}, of {distance[i]!r}"
                    self.fail("cylinder length", text)

    def questions(self) -> None:
        """Limits and extremes know no negative length."""
        m = self.m
        driver = m.driver
        if isinstance(driver, str) and driver in self.case.cylinders:
            found = m.limits().intervals
            if found.min() < -1e-9:
                self.fail("cylinder limits", f"{found.tolist()}")
        for name in self.case.cylinders:
            least = m.extremes(name).min.value
            if least < -1e-9:
                self.fail("cylinder extremes", f"{name} from {least!r}")
