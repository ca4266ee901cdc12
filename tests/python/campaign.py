"""A campaign over random mechanisms: nothing jumps, nothing is called solved that is not, every
gap is real.

    python tests/python/campaign.py --count 100000 --out docs/campaign.md
    python tests/python/campaign.py --higher --count 10000 --out docs/campaign-higher.md
"""

from __future__ import annotations

import argparse
import os
import sys
import time
import traceback
from collections import Counter
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

import assur
import campaign_cases as cases
import campaign_checks as checks
from assur import Status
from campaign_geometry import Geometry, Sample
from campaign_page import page
from description import arguments

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    import models
    from campaign_geometry import Array

# Mechanisms given to a process at once, and one in how many is built to have change points.
PORTION = 200
CHANGING = 10
SHOWN = 20  # failures printed as they come


@dataclass
class Report:
    """Counts, worst figures and failures; reports of different mechanisms add up."""

    counts: Counter[str] = field(default_factory=Counter)
    worst: dict[str, float] = field(default_factory=dict)
    failures: list[str] = field(default_factory=list)

    def add(self, other: Report) -> None:
        self.counts.update(other.counts)
        self.failures += other.failures
        for name, value in other.worst.items():
            self.note(name, value)

    def note(self, name: str, value: float) -> None:
        """A figure of which the greatest is wanted."""
        self.worst[name] = max(self.worst.get(name, 0.0), value)


class Check:
    """All checks of one mechanism."""

    def __init__(self, case: models.Case) -> None:
        self.report = Report()
        self.failed: set[str] = set()
        self.rng = np.random.default_rng(case.seed)
        self.changing = case.driver in cases.CHANGING
        try:
            self.m = assur.Mechanism(**arguments(case.description))
        except assur.AssurError as error:  # they are assembled by construction
            self.fail("refused", str(error))
            return
        self.higher = self.m.structure.cls > 2
        # Of a group above class II nothing is told beyond a fold.
        self.ends = Status.LOST if self.higher else Status.UNREACHABLE
        self.report.counts["mechanisms"] += 1
        self.report.counts[f"class {self.m.structure.cls}"] += 1
        self.report.counts["sliding"] += bool(case.description.slides)
        self.report.counts["changing"] += self.changing
        self.geometry = Geometry(case.description)
        grid, turn = cases.grid_of(self.m, self.rng)
        fine = self.solve(grid)
        self.bits(fine, turn)
        for status, many in zip(*np.unique(fine.status, return_counts=True), strict=True):
            self.report.counts[Status(status).name] += int(many)
        condition = self.closures(fine)
        self.motion(fine)
        found, points, worst = checks.differences(self.solve, fine, condition, self.rng)
        self.fail("analogues", *found)
        self.report.counts["differences"] += points
        self.report.note("difference", worst)

    def fail(self, kind: str, *texts: str) -> None:
        """Of each kind the first: the others mostly have its cause."""
        if texts and kind not in self.failed:
            self.failed.add(kind)
            self.report.failures.append(f"{kind}: {texts[0]}")

    def solve(self, q: Array) -> Sample:
        """Positions and first analogues; their statuses must fit them."""
        self.report.counts["positions"] += q.size
        sample = Sample(self.m.solve(q, order=1, on_error="nan", threads=1))
        strange = (sample.status > Status.SINGULAR) & (sample.status != self.ends)
        for i in np.flatnonzero(sample.wrong | strange)[:1]:
            self.fail("status", f"{sample.status[i]} does not fit the values at q = {q[i]!r}")
        return sample

    def rates(self, q: Array) -> Sample:
        """First analogues and second."""
        return Sample(self.m.solve(q, order=2, on_error="nan", threads=1), order=1)

    def bits(self, fine: Sample, turn: int) -> None:
        """At the user's steps, over one turn and all: the same to the bit."""
        coarse = fine.q[:: cases.FINER]
        for q in (coarse, coarse[:turn]) if turn else (coarse,):
            track = self.solve(q)
            self.report.counts["shared"] += len(q)
            apart = np.flatnonzero(fine.differs(track, cases.FINER))
            self.fail("bits", *(f"{len(apart)} positions, q = {q[i]!r}" for i in apart))

    def closures(self, fine: Sample) -> Array:
        """What is called solved closes; κ."""
        misfit, condition = self.geometry.misfit(fine)
        self.report.counts["closures"] += int(fine.reached.sum())
        self.report.note("misfit", float(np.max(misfit[fine.reached], initial=0.0)))
        false = np.flatnonzero(fine.reached & ~(misfit <= checks.TERMS))
        self.fail("false", *(f"status {fine.status[i]} at q = {fine.q[i]!r}" for i in false))
        return condition

    def is_pole(self, edges: Array) -> NDArray[np.bool_]:
        """Whether a point goes to infinity right behind the ends."""
        size = self.geometry.drawn
        way = np.sign(edges[:, 1] - edges[:, 0])
        inside, before = (
            self.solve(edges[:, 0]),
            self.solve(edges[:, 0] - way * checks.POLE_STEP),
        )
        near, far = (np.abs(sample.value[:, : sample.lengths]) for sample in (inside, before))
        if not self.higher:
            return np.asarray(near.max(axis=1) > checks.POLE * size)
        place = np.arange(len(near)), near.argmax(axis=1)
        with np.errstate(invalid="ignore", divide="ignore"):
            distance = checks.POLE_STEP * far[place] / (near[place] - far[place])
        is_near = (distance > 0.0) & (distance < checks.POLE_NEAR)
        return np.asarray((near[place] > checks.POLE_OF_GROUPS * size) & is_near)

    def motion(self, fine: Sample) -> None:
        """Nothing jumps; where it ends is a dead point."""
        size = self.geometry.drawn
        if self.higher and fine.given.any():
            # Between ends another assembly beside a fold has the other sign.
            given = self.m.solve(fine.q[fine.given], order=0, on_error="nan", threads=1)
            signs = np.sign(self.geometry.determinants(given))
            self.report.counts["determinants"] += len(signs)
            self.fail("sign", *(f"q = {given.q[i]!r}" for i in np.flatnonzero(signs != signs[0])))
        found, edges, count = checks.broken(self.solve, fine, size, checks.jumps)
        self.fail("jump", *found)
        self.report.counts.update(count)
        if self.changing:
            found, _, _ = checks.broken(self.rates, self.rates(fine.q), size, checks.bends)
            self.fail("bend", *found)
        if not len(edges):
            return
        edges = checks.bisected(self.solve, edges)
        far = self.is_pole(edges)
        edges = edges[~far]
        self.report.counts["infinite"] += int(far.sum())
        self.report.counts["gaps"] += len(edges)
        found, worst = checks.unreal(self.solve, self.geometry, edges)
        self.fail("gap", *found)
        self.report.note("fold", worst)
        beyond = self.m.solve(edges[:, 1], order=0, on_error="nan", threads=1)
        told = [beyond.explain(i) for i in range(len(edges))]
        # The dead point of a group may itself be a number: it is flat there.
        words = ("dead point", "is flat", "too far") if self.higher else ("does not close",)
        self.fail("explain", *(text for text in told if not any(word in text for word in words)))


def run(work: Iterable[tuple[str, int]]) -> Report:
    """The checks of (kind, seed); what a mechanism raises is a failure, panics too."""
    report = Report()
    for kind, seed in work:
        try:
            one = Check(cases.MAKE[kind](seed)).report
        except KeyboardInterrupt:
            raise
        except BaseException:  # noqa: BLE001 (a panic of the core is no Exception)
            one = Report(failures=[" ".join(traceback.format_exc(limit=-3).split())])
        one.failures = [f"{kind} {seed}: {text}" for text in one.failures]
        report.add(one)
    return report


def work(count: int, higher: bool = False) -> list[tuple[str, int]]:
    """So many mechanisms."""
    if higher:
        return [("higher", i) for i in range(count)]
    changing = count // CHANGING
    return [("changing", i) for i in range(changing)] + [
        ("random", i) for i in range(count - changing)
    ]


def run_all(count: int, processes: int, higher: bool = False) -> Report:
    """The same on several processes, with progress on stderr."""
    report, begun, todo = Report(), time.monotonic(), work(count, higher)
    with ProcessPoolExecutor(processes) as pool:
        portions = [todo[i : i + PORTION] for i in range(0, count, PORTION)]
        for future in as_completed([pool.submit(run, portion) for portion in portions]):
            one = future.result()
            for text in one.failures[: max(0, SHOWN - len(report.failures))]:
                sys.stderr.write(f"\r{text}\n")
            report.add(one)
            done, spent = report.counts["mechanisms"], time.monotonic() - begun
            left = spent / max(done, 1) * (count - done) / 60
            note = f"\r{done} of {count}, {len(report.failures)} failures, {left:.0f} min left "
            sys.stderr.write(note)
            sys.stderr.flush()
    sys.stderr.write("\n")
    report.failures.sort()
    return report


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=100_000, help="mechanisms")
    parser.add_argument("--higher", action="store_true", help="of class III and IV")
    parser.add_argument("--processes", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--out", type=Path, help="page to be written")
    given = parser.parse_args()
    report = run_all(given.count, given.processes, given.higher)
    text = page(report.counts, report.worst, report.failures, given.higher)
    if given.out:
        given.out.write_text(text, encoding="utf-8")
    else:
        sys.stdout.write(text)
    return 1 if report.failures else 0


if __name__ == "__main__":
    sys.exit(main())
