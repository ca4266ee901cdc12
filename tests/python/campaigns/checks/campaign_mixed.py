"""All checks of one mechanism of mixed groups, its batch of designs and its motions."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING

import numpy as np

import assur
from assur import Status
from campaigns.campaign_report import Findings
from campaigns.checks import campaign_checks as checks
from campaigns.checks.campaign_geometry import Sample
from models.mechanisms.mechanism_data import arguments
from oracles.kinematics.agreement import POSITION
from oracles.kinematics.closures import Closures

if TYPE_CHECKING:
    from campaigns.checks.campaign_geometry import Array
    from models.mechanisms import dyad_models

DESIGNS = 3  # beside the drawing
CHANGES = (0.02, 0.40)  # of dimensions, up or down
# The path: mean steps, and ends to either side in rad or (of a slide, of two drivers together) m.
STEPS = (0.08, 0.16)
TURN = 1.2 * math.pi
REACH = 1.2
FINER = 4  # steps of motions; with two drivers every position is followed by itself: 1
# Every design's statuses, closures and bits are checked, every drawing's motion. One in so many:
DESIGN_MOTIONS = 4
GAPS, GAPS_OF_TWO = 3, 20
EXPLAINED = 2  # positions of every design


class Path:
    """A straight path through a design's coordinates, from the drawing's to either side."""

    def __init__(self, m: assur.Mechanism, rng: np.random.Generator) -> None:
        drivers = m.driver if isinstance(m.driver, tuple) else (m.driver,)
        turning = [not (isinstance(d, str) and d in m.slides) for d in drivers]
        self.many = len(drivers) > 1
        self.start = m.q0
        angle = rng.uniform(-math.pi, math.pi)
        self.direction = np.array([math.cos(angle), math.sin(angle)])
        reach = TURN if all(turning) and not self.many else REACH
        count = int(reach / rng.uniform(*STEPS))
        part = (np.arange(-count, count) + rng.uniform(0.1, 0.9)) / count
        # Closer to the drawing, because some motions end soon.
        t = np.asarray(reach * part * np.abs(part), np.float64)
        # With one driver the parameter is q itself, so that its neighbours are q's.
        base = 0.0 if self.many else float(m.q0)
        self.grid: Array = base + t
        self.fine: Array = base + (t if self.many else _finer(t))

    def q(self, t: Array) -> Array:
        if not self.many:
            return t
        return np.asarray(self.start + t[:, np.newaxis] * self.direction)

    def sample(self, m: assur.Mechanism, t: Array) -> Sample:
        motion = m.solve(self.q(t), order=1, on_error="nan", threads=1)
        return Sample(motion, 0, t, self.direction) if self.many else Sample(motion)


class Mixed(Findings):
    """All checks of one mechanism."""

    def __init__(self, case: dyad_models.Case) -> None:
        super().__init__()
        self.rng = np.random.default_rng(case.seed)
        self.case, self.description = case, case.description
        try:
            self.m = assur.Mechanism(**arguments(case.description))
        except assur.AssurError as error:  # the drawing is regular
            self.fail("refused", str(error))
            return
        self.count()
        self.path = Path(self.m, self.rng)
        self.batch = designs(self.m, self.rng)
        self.guarded(self.drawing)
        self.guarded(self.designs)
        self.guarded(self.motion, 0)
        if self.rng.integers(DESIGN_MOTIONS) == 0:
            self.guarded(self.motion, int(self.rng.integers(1, DESIGNS + 1)))

    def count(self) -> None:
        structure, counts = self.m.structure, self.report.counts
        counts["mechanisms"] += 1
        counts[f"class {min(structure.cls, 5)}"] += 1
        counts["groups"] += len(structure.groups)
        counts["sliding"] += bool(self.description.slides)
        counts["two drivers"] += len(self.description.drivers) > 1
        counts[f"driver {self.case.driver}"] += 1
        higher = [group.cls > 2 for group in structure.groups]
        counts["mixed"] += any(higher) and not all(higher)
        if structure.redundant:
            self.fail("redundant", f"{structure.redundant} of a regular drawing")

    def drawing(self) -> None:
        """At the drawing's coordinate every joint is where it was drawn."""
        motion = self.m.solve(self.m.q0, order=1, on_error="nan")
        if int(motion.status) not in (Status.OK, Status.NEAR_SINGULAR):
            self.fail("drawing", motion.explain())
            return
        drawn = np.array(list(self.description.joints.values()), np.float64)
        found = np.array([motion.joint(n).value for n in self.description.joints])
        base = np.array(self.description.joints[self.description.links["ground"][0]])
        size = float(np.abs(drawn - base).max())
        law = POSITION * float(motion.condition) * size
        worst = float(np.abs(found - drawn).max()) / law
        self.report.note("drawing", worst)
        if not worst <= checks.TERMS:
            self.fail("drawing", f"a joint is {worst:.3g} × 8 u κ of the size from its place")

    def designs(self) -> None:
        """Statuses, closures, sentences and bits of the whole batch."""
        q = self.path.q(self.path.grid)
        motion = self.batch.solve(q, order=1, on_error="nan", threads=1)
        status = motion.status
        self.report.counts["positions"] += status.size
        for code, many in zip(*np.unique(status, return_counts=True), strict=True):
            self.report.counts[Status(code).name] += int(many)
        legal = (status <= Status.LOST) & (status != Status.SINGULAR)
        self.fail("status", *(f"{Status(s).name}" for s in np.unique(status[~legal])))
        reached = status <= Status.SINGULAR
        closures = Closures(self.description, dict(self.batch.dimensions))
        misfit, _ = closures.misfit(motion)
        self.report.counts["closures"] += int(reached.sum())
        self.report.note("misfit", float(np.max(misfit[reached], initial=0.0)))
        for i, k in np.argwhere(reached & ~(misfit <= checks.TERMS))[:1]:
            self.fail("false", f"design {i}, q = {q[k]!r}: {misfit[i, k]:.3g}")
        for i in range(DESIGNS + 1):
            failed = np.flatnonzero(~reached[i])
            for k in self.rng.choice(failed, min(EXPLAINED, len(failed)), replace=False):
                self.explained(motion.explain((i, int(k))), f"design {i}, q = {q[k]!r}")
        self.bits(motion)

    def explained(self, text: str, where: str) -> None:
        """A sentence that names a part of the mechanism."""
        d = self.description
        named = {*d.joints, *d.links, *d.slides} & set(re.findall(r"\w+", text))
        self.report.counts["explained"] += 1
        if len(text) < 20 or not named:
            self.fail("explain", f"{where}: {text!r}")

    def bits(self, motion: assur.Motion) -> None:
        """The drawing and another design alone, at some positions in any order: the same bits."""
        grid, width = self.path.grid, len(self.path.grid)
        whole = _rows(motion).reshape(DESIGNS + 1, width, -1)
        for i in (0, int(self.rng.integers(1, DESIGNS + 1))):
            m = self.batch.design(i) if i else self.m
            few = self.rng.permutation(width)[: self.rng.integers(1, width)]
            other = _rows(m.solve(self.path.q(grid[few]), order=1, on_error="nan", threads=1))
            apart = np.flatnonzero((other != whole[i, few]).any(axis=1))
            self.report.counts["shared"] += len(few)
            self.fail("bits", *(f"design {i}, q = {self.path.q(grid)[few[k]]!r}" for k in apart))

    def motion(self, which: int) -> None:
        """Nothing jumps, gaps are real, analogues are differences."""
        m = self.batch.design(which) if which else self.m
        closures = Closures(self.description, dict(m.dimensions))

        def solve(t: Array) -> Sample:
            self.report.counts["positions"] += t.size
            sample = self.path.sample(m, t)
            if sample.wrong.any():
                i = int(sample.wrong.argmax())
                self.fail("status", f"{sample.status[i]} does not fit the values, t = {t[i]!r}")
            return sample

        sample, of = solve(self.path.fine), f"design {which}"
        found, edges, count = checks.broken(solve, sample, closures.drawn, checks.jumps)
        self.fail("jump", *(f"{of}: {text}" for text in found))
        self.report.counts.update(count)
        condition = np.asarray(sample.motion.condition)
        found, points, worst = checks.differences(solve, sample, condition, self.rng)
        self.fail("analogues", *(f"{of}: {text}" for text in found))
        self.report.counts["differences"] += points
        self.report.note("difference", worst)
        if len(edges) and self.rng.integers(GAPS_OF_TWO if self.path.many else GAPS) == 0:
            self.gap(m, solve, edges[self.rng.integers(len(edges))][np.newaxis], closures)

    def gap(self, m: assur.Mechanism, solve: checks.Solve, edge: Array, closures: Closures) -> None:
        """A motion ends at a dead point, at infinity, or where two branches of a group cross."""
        edge = checks.bisected(solve, edge, 4 if self.path.many else 8)
        higher = m.structure.cls > 2
        far = checks.poles(solve, edge, closures.drawn, higher).any()
        if far or (higher and checks.narrow_poles(solve, edge).any()):
            self.report.counts["infinite"] += 1
            return
        if higher and checks.crossings(solve, closures, edge).any():
            self.report.counts["crossings"] += 1
            return
        self.report.counts["gaps"] += 1
        found, worst = checks.unreal(solve, closures, edge)
        self.report.note("fold", worst)
        beyond = solve(edge[:, 1]).motion.explain(0)
        self.fail("gap", *(f"{text} ({beyond})" for text in found))


def designs(m: assur.Mechanism, rng: np.random.Generator) -> assur.Mechanism:
    """A batch: the drawing, then designs with every dimension changed by up to 2 to 40 %."""
    spread = np.concatenate([[0.0], rng.uniform(*CHANGES, DESIGNS)])
    changed = {}
    for name, value in m.dimensions.items():
        changed[name] = value * (1.0 + spread * rng.uniform(-1.0, 1.0, DESIGNS + 1))
    return m.with_dimensions(changed)


def _rows(motion: assur.Motion) -> Array:
    """Everything in the motion, a row of whole numbers a position."""
    m, n = motion.mechanism, motion.status.size
    tracks = [motion.joint(j) for j in dict.fromkeys(j for own in m.links.values() for j in own)]
    tracks += [motion.link(j) for j in m.links] + [motion.slide(j) for j in m.slides]
    parts = [one.reshape(n, -1) for track in tracks for one in (track.value, track.d1)]
    rows = np.concatenate([*parts, motion.status.reshape(n, 1)], axis=1)
    rows[np.isnan(rows)] = np.nan
    return rows.view(np.uint64)


def _finer(t: Array) -> Array:
    """The same span in smaller steps."""
    k = np.arange(len(t))
    return np.interp(np.linspace(0.0, k[-1], FINER * int(k[-1]) + 1), k, t)
