"""Pairs that do not move have no friction: parts that turn as one body with the crank."""

from __future__ import annotations

import math
import random
import warnings
from typing import TYPE_CHECKING

import numpy as np

import assur
from campaign_report import Findings

if TYPE_CHECKING:
    from resting_models import Case

POSITIONS = 40
# Friction with viscosity, of a rate that is rounding: to this part of what moves elsewhere.
ROUNDED = 1e-9


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
            allowed = ROUNDED * (force + machine.friction[name].viscous * abs(self.case.speed0))
            wrong = np.abs(np.nan_to_num(friction)) > allowed
            if wrong.any():
                k = int(np.abs(np.nan_to_num(friction)).argmax())
                text = f"{friction[k]:.3g} in {name} at q = {q[k]!r}, {int(wrong.sum())} positions"
                self.fail("rest friction", text)

    def safety(self) -> None:
        """It is given, and no less than 1 where nothing is locked."""
        safety = np.asarray(self.found.safety)
        locked = np.asarray(self.found.locked)
        if not (locked | np.isnan(safety) | (safety >= 1.0)).all():
            self.fail("rest safety", f"{safety.min()!r} where nothing is locked")
