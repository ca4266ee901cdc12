"""Pairs that do not move have no friction: parts that turn as one body with the crank."""

from __future__ import annotations

import math
import random
import warnings
from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from campaigns.campaign_report import Findings

if TYPE_CHECKING:
    from models.machines.resting_models import Case

POSITIONS = 40
# Friction with viscosity, of a rate that is rounding: to this part of what moves elsewhere.
ROUNDED = 1e-9
# Rounding of a first analogue over κ²; and from which on it says too little of friction.
ANALOGUE = 64.0 * 2.0**-53
KNOWN = 1e-5


class Resting(Findings):
    """One machine: friction of its pairs at rest."""

    def __init__(self, case: Case) -> None:
        super().__init__()
        self.case, self.rng = case, random.Random(f"rest {case.seed}")
        self.report.counts["turning as one body"] += 1
        self.report.counts["machines with pairs at rest"] += bool(case.resting)
        self.guarded(self.moments)
        self.guarded(self.safety)

    def moments(self) -> None:
        """0 at every position, since other pairs move."""
        machine, m = self.case.machine, self.case.machine.mechanism
        assert m is not None
        q = float(m.q0) + np.array([self.rng.uniform(-math.pi, math.pi) for _ in range(POSITIONS)])
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", assur.AssurWarning)
            self.found = machine.reactions(q, speed=self.case.speed0, on_error="nan")
        for name, link in self.case.resting:
            if link:
                friction = np.asarray(self.found.joint_moment(name, on=link))
            else:
                friction = np.asarray(self.found.slide(name).friction)
            self.report.counts["positions of pairs at rest"] += int((~np.isnan(friction)).sum())
            force = np.abs(np.nan_to_num(self.found.driver)).max()
            # The viscous part is that of a speed which is rounding.
            speed = self.rounding(q) * abs(self.case.speed0)
            allowed = ROUNDED * force + machine.friction[name].viscous * speed
            wrong = np.abs(np.nan_to_num(friction)) > allowed
            if wrong.any():
                k = int(np.abs(np.nan_to_num(friction)).argmax())
                text = f"{friction[k]:.3g} in {name} at q = {q[k]!r}, {int(wrong.sum())} positions"
                self.fail("rest friction", text)

    def rounding(self, q: Any) -> Any:
        """By how much a first analogue may be off: 64 u κ² of the greatest length (conventions)."""
        m = self.case.machine.mechanism
        assert m is not None
        motion = m.solve(q, order=0, on_error="nan")
        lengths = [np.abs(motion.slide(name).value) for name in m.slides]
        size = np.nanmax([np.ones(q.shape), *lengths], axis=0)
        return np.nan_to_num(ANALOGUE * motion.condition**2) * size + ROUNDED

    def safety(self) -> None:
        """It is given, and no less than 1 where nothing is locked."""
        safety = np.asarray(self.found.safety)
        locked = np.asarray(self.found.locked)
        # Without digits the law of friction has none.
        known = np.nan_to_num(self.rounding(self.found.q)) < KNOWN
        low = known & ~locked & (safety < 1.0)
        if low.any():
            self.fail("rest safety", f"{safety[low].min()!r} where nothing is locked")
