"""Checks of overconstrained mechanisms whose data are rounded.

Construction either refuses the data and says by how much they misfit, or the mechanism moves
wherever the exact one does.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import numpy as np

import assur
from assur import Status
from campaigns.campaign_report import Findings
from campaigns.checks import campaign_checks as checks
from campaigns.checks.campaign_mixed import Path
from models.mechanisms.mechanism_data import arguments
from oracles.kinematics.closures import Closures

if TYPE_CHECKING:
    from campaigns.checks.campaign_geometry import Sample
    from models.mechanisms.redundant_models import Rounded

# Data of so many digits or more fit to rounding: they must be taken.
FITTING = 14
# The rounding moves a position by about κ times itself (of the size; at most 2.3 times that was
# seen). From κ = ROOM / sqrt(rounding) on it may move a fold past the position.
MOVED = 20.0
ROOM = 0.03
# Designs of the exact one: scaled as a whole, and every dimension off by so much of itself.
SCALE, OFF = 1.1, 1e-12
MISFIT = re.compile(r"\d m\b|\d rad\b")


class Overconstrained(Findings):
    """All checks of one overconstrained mechanism."""

    def __init__(self, case: Rounded) -> None:
        super().__init__()
        self.case, self.rng = case, np.random.default_rng(case.seed)
        self.rounding = 0.5 * 10.0 ** (1 - case.digits)
        self.guarded(self.compare)

    def compare(self) -> None:
        case, counts = self.case, self.report.counts
        counts["overconstrained"] += 1
        try:
            exact = assur.Mechanism(**arguments(case.exact))
        except assur.AssurError as error:
            self.fail("refused", f"exact: {error}")
            return
        if not exact.structure.redundant:
            self.fail("redundant", "none was found")
        path = Path(exact, self.rng)
        there = path.sample(exact, path.grid)
        if case.everywhere and not there.reached.all():
            k = int(np.argmin(there.reached))
            self.fail("moves", f"exact: {there.motion.explain(k)}")
        self.designs(exact, path, there)
        try:
            typed = assur.Mechanism(**arguments(case.typed))
        except assur.AssurError as error:
            counts["refused"] += 1
            if not MISFIT.search(str(error)) or case.digits >= FITTING:
                self.fail("refused", f"{case.digits} digits: {error}")
            return
        here = path.sample(typed, path.grid - float(exact.q0) + float(typed.q0))
        counts["positions"] += 2 * here.q.size
        self.moves(there, here)
        self.closes(typed, here)
        found, _, count = checks.broken(
            lambda q: path.sample(typed, q),
            here,
            Closures(case.typed, dict(typed.dimensions)).drawn,
            checks.jumps,
        )
        self.report.counts.update(count)
        self.fail("jump", *found)

    def designs(self, exact: assur.Mechanism, path: Path, there: Sample) -> None:
        """Designs whose redundant links fit only to rounding move too."""
        own, rng = exact.dimensions, self.rng
        spare = exact.structure.redundant
        by = {n: OFF * rng.uniform(-1.0, 1.0) if n.split(".")[0] in spare else 0.0 for n in own}
        off = {n: v * (1.0 + by[n]) for n, v in own.items()}
        angles = (".angle", ".link_angle")
        scaled = {n: v if n.endswith(angles) else SCALE * v for n, v in own.items()}
        batch = exact.with_dimensions({n: [off[n], scaled[n]] for n in off})
        motion = batch.solve(path.q(path.grid), order=1, on_error="nan", threads=1)
        self.report.counts["positions"] += motion.status.size
        wanted = there.reached & (np.asarray(there.motion.condition) < ROOM / np.sqrt(OFF))
        for i, what in enumerate(("off by 1e-12", "scaled")):
            missing = np.flatnonzero(wanted & (motion.status[i] > Status.SINGULAR))
            self.fail(f"design {what}", *(motion.explain((i, int(k))) for k in missing))

    def moves(self, there: Sample, here: Sample) -> None:
        """Solved wherever the exact one is, at the same position."""
        condition = np.asarray(there.motion.condition)
        near = condition < ROOM / np.sqrt(self.rounding)
        wanted = there.reached & (near | self.case.everywhere)
        self.report.counts["rounded positions"] += int(wanted.sum())
        missing = np.flatnonzero(wanted & ~here.reached)
        of = f"{self.case.kind} of {self.case.digits} digits"
        self.fail("moves", *(f"{of}: {here.motion.explain(int(k))}" for k in missing))
        both = here.reached & there.reached & near
        lengths = slice(0, there.lengths)
        apart = np.abs(here.value[both, lengths] - there.value[both, lengths]).max(axis=1)
        size = np.abs(there.value[both, lengths]).max(axis=1)
        worst = apart / (condition[both] * self.rounding * size)
        self.report.note("moved", float(np.max(worst, initial=0.0)))
        for k in np.flatnonzero(~(worst <= MOVED))[:1]:
            self.fail("moved", f"{of}: at q = {here.q[both][k]!r} by {apart[k]:.3g} m")

    def closes(self, typed: assur.Mechanism, here: Sample) -> None:
        """All pairs hold, the redundant ones to the rounding."""
        misfit, _ = Closures(self.case.typed, dict(typed.dimensions)).misfit(here.motion)
        law = 8 * np.finfo(float).eps
        given = here.status <= Status.SINGULAR
        with np.errstate(invalid="ignore"):
            excess = misfit * law / (law + MOVED * self.rounding)
        for k in np.flatnonzero(given & ~(excess <= checks.TERMS))[:1]:
            self.fail("false", f"q = {here.q[k]!r}: {misfit[k]:.3g} × 8 u κ of the size")
