"""Drawings of which a dyad is nearly flat, or guides nearly parallel: taken, and moved."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

import assur
from assur import Status
from campaigns.campaign_report import Findings
from campaigns.checks.campaign_checks import TERMS
from models.mechanisms.mechanism_data import arguments
from oracles.kinematics.agreement import POSITION
from oracles.kinematics.closures import Closures

if TYPE_CHECKING:
    from models.mechanisms import dyad_models

STEPS = 200
REACH = math.pi


class Flat(Findings):
    """One mechanism: built, at its drawing, and closed wherever it has positions."""

    def __init__(self, case: dyad_models.Case) -> None:
        super().__init__()
        self.d = case.description
        self.report.counts["drawings with a flat dyad"] += 1
        try:
            self.m = assur.Mechanism(**arguments(self.d))
        except assur.StructureError as error:
            self.fail("flat refused", str(error))
            return
        self.guarded(self.drawing)
        self.guarded(self.limits)

    def drawing(self) -> None:
        """Every joint at its place; all pairs closed about it."""
        m, d = self.m, self.d
        motion = m.solve(m.q0, order=0, on_error="nan")
        if motion.status > Status.SINGULAR:
            self.fail("flat drawing", motion.explain())
            return
        kappa = float(motion.condition)
        self.report.note("condition", kappa)
        drawn = np.array(list(d.joints.values()))
        found = np.array([motion.joint(n).value for n in d.joints])
        law = POSITION * kappa * float(np.abs(drawn).max())
        worst = float(np.abs(found - drawn).max())
        if not worst <= TERMS * law:
            self.fail("flat drawing", f"a joint is {worst:.3g} m from its place, κ {kappa:.3g}")
        q = float(m.q0) + REACH * np.linspace(-1.0, 1.0, STEPS) ** 3
        motion = m.solve(q, order=0, on_error="nan", threads=1)
        misfit, _ = Closures(d, dict(m.dimensions)).misfit(motion)
        reached = np.asarray(motion.status) <= Status.SINGULAR
        for i in np.flatnonzero(reached & ~(np.ravel(misfit) <= TERMS))[:1]:
            self.fail("flat false", f"q = {q[i]!r}: {np.ravel(misfit)[i]:.3g} × 8 u κ")

    def limits(self) -> None:
        """An interval holds the drawing."""
        if isinstance(self.m.driver, str) and self.m.driver in self.m.slides:
            return
        q0, found = float(self.m.q0), self.m.limits().intervals
        if not ((found[:, 0] - 1e-9 <= q0) & (q0 <= found[:, 1] + 1e-9)).any():
            self.fail("flat limits", f"no interval of {found.tolist()} holds q0 = {q0!r}")
