"""A campaign over random mechanisms: nothing jumps, nothing is called solved that is not, every
gap is real, and the energy of machines is kept.

``make campaign`` runs it for every kind (class II, ``--higher``, ``--mixed``, ``--machines``), with
``--count`` mechanisms, and writes the page ``--out``.
"""

from __future__ import annotations

import argparse
import os
import pickle
import sys
import time
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from assur import Status
from campaigns import campaign_cases as cases
from campaigns.campaign_report import Findings, Report, raised
from campaigns.checks import campaign_checks as checks
from campaigns.checks.campaign_further import further
from campaigns.checks.campaign_geometry import Geometry, Sample
from campaigns.checks.campaign_machines import Checked
from campaigns.checks.campaign_mixed import Mixed
from campaigns.checks.campaign_redundant import Overconstrained
from campaigns.pages.campaign_page import one_kind
from campaigns.pages.campaign_page_mixed import machines, mixed
from models.machines.machine_models import machine_case
from models.mechanisms.mechanism_data import arguments
from models.mechanisms.mixed_models import mixed_case
from models.mechanisms.redundant_models import redundant_case
from oracles.kinematics import gap_steps

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from campaigns.checks.campaign_geometry import Array
    from models.mechanisms import dyad_models

# Mechanisms given to a process at once.
PORTION = 200
# What most of a campaign are, and one in how many is of another kind.
MOST = {"class II": "random", "higher": "higher", "mixed": "mixed", "machines": "machine"}
FEW = {"class II": {"changing": 10}, "higher": {}, "mixed": {"overconstrained": 20}, "machines": {}}
SHOWN = 20  # failures printed as they come


class Check(Findings):
    """All checks of one mechanism."""

    def __init__(self, case: dyad_models.Case) -> None:
        super().__init__()
        self.rng = np.random.default_rng(case.seed)
        self.changing = case.driver in cases.CHANGING
        try:
            self.m = assur.Mechanism(**arguments(case.description))
        except assur.AssurError as error:  # they are assembled by construction
            self.fail("refused", str(error))
            return
        self.higher = self.m.structure.cls > 2
        # Of a group above class II nothing is known beyond a fold.
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
        """At the user's steps, over one turn and over all turns: the same to the bit."""
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
        far = checks.poles(self.solve, edges, size, self.higher)
        if not self.higher:
            # Angles of groups follow theirs, and end with them.
            across = gap_steps.gaps_between(self.m, edges, far)
            self.report.counts["steps"] += len(across)
            wrong = (text for gap in across for text in gap_steps.too_far(self.m, gap))
            self.fail("step", *wrong)
        edges = edges[~far]
        self.report.counts["infinite"] += int(far.sum())
        self.report.counts["gaps"] += len(edges)
        found, worst = checks.unreal(self.solve, self.geometry, edges)
        self.fail("gap", *found)
        self.report.note("fold", worst)
        beyond = self.m.solve(edges[:, 1], order=0, on_error="nan", threads=1)
        sentences = [beyond.explain(i) for i in range(len(edges))]
        # The dead point of a group may itself be a number: it is flat there.
        words = ("dead point", "is flat", "size away") if self.higher else ("cannot be assembled",)
        self.fail(
            "explain", *(text for text in sentences if not any(word in text for word in words))
        )


PAGES: dict[str, Callable[[Report], str]] = {
    "class II": lambda report: one_kind(report, higher=False),
    "higher": lambda report: one_kind(report, higher=True),
    "mixed": mixed,
    "machines": machines,
}


# How a mechanism or machine of each kind is drawn, and what is checked of every one.
CHECKS: dict[str, tuple[Callable[[int], Any], Callable[[Any], Findings]]] = {
    **{kind: (make, Check) for kind, make in cases.MAKE.items()},
    "mixed": (mixed_case, Mixed),
    "overconstrained": (redundant_case, Overconstrained),
    "machine": (machine_case, Checked),
}


def run(work: Iterable[tuple[str, int]], *, besides: bool = True) -> Report:
    """The checks of (kind, seed); what a mechanism raises is a failure, panics too.

    `besides`: what is asked of one in so many, too.
    """
    report = Report()
    for kind, seed in work:
        try:
            one = _checked(kind, seed, besides)
        except KeyboardInterrupt:
            raise
        except BaseException:  # noqa: BLE001 (a panic of the core is no Exception)
            one = Report(failures=[raised()])
        one.failures = [f"{kind} {seed}: {text}" for text in one.failures]
        report.add(one)
    return report


def _checked(kind: str, seed: int, besides: bool) -> Report:
    make, check = CHECKS[kind]
    case = make(seed)
    report = check(case).report
    if besides:
        for one in further(kind, seed, case):
            report.add(one.report)
    return report


def work(count: int, which: str = "class II") -> list[tuple[str, int]]:
    """Run `count` mechanisms (or machines) of a campaign."""
    few = [(kind, i) for kind, one_in in FEW[which].items() for i in range(count // one_in)]
    return few + [(MOST[which], i) for i in range(count - len(few))]


def run_all(
    count: int, processes: int, which: str = "class II", kept: Path | None = None
) -> Report:
    """The same on several processes, with progress on stderr.

    What is done is kept in a file (of Python's pickles, one a portion): a campaign that was stopped
    goes on from there.
    """
    report, todo = Report(), work(count, which)
    portions = {i: todo[i : i + PORTION] for i in range(0, count, PORTION)}
    for (first, some), one in _read(kept):
        if some == len(portions.get(first, ())):
            report.add(one)
            del portions[first]
    done = before = count - sum(map(len, portions.values()))
    start = time.monotonic()
    with ProcessPoolExecutor(processes) as pool:
        futures = {pool.submit(run, portion): (i, len(portion)) for i, portion in portions.items()}
        for future in as_completed(futures):
            one = future.result()
            if kept:
                with kept.open("ab") as file:
                    pickle.dump((futures[future], one), file)
            for text in one.failures[: max(0, SHOWN - len(report.failures))]:
                sys.stderr.write(f"\r{text}\n")
            report.add(one)
            done, spent = done + futures[future][1], time.monotonic() - start
            left = spent / (done - before) * (count - done) / 60
            note = f"\r{done} of {count}, {len(report.failures)} failures, {left:.0f} min left "
            sys.stderr.write(note)
            sys.stderr.flush()
    sys.stderr.write("\n")
    report.failures.sort()
    return report


def _read(kept: Path | None) -> Iterator[tuple[tuple[int, int], Report]]:
    """What a campaign has kept: the place and size of each portion, and its report."""
    if kept is None or not kept.exists():
        return
    size = kept.stat().st_size
    with kept.open("rb") as file:
        while file.tell() < size:
            yield pickle.load(file)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=100_000, help="mechanisms or machines")
    kinds = parser.add_mutually_exclusive_group()
    for which, text in (
        ("higher", "of class III and IV"),
        ("mixed", "of dyads and higher groups in any order"),
        ("machines", "with bodies, loads and motors"),
    ):
        kinds.add_argument(f"--{which}", dest="which", action="store_const", const=which, help=text)
    parser.add_argument("--processes", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--out", type=Path, help="page to be written")
    parser.add_argument("--keep", type=Path, help="file from which a stopped campaign goes on")
    given = parser.parse_args()
    which = given.which or "class II"
    report = run_all(given.count, given.processes, which, given.keep)
    text = PAGES[which](report)
    if given.out:
        given.out.write_text(text, encoding="utf-8")
    else:
        sys.stdout.write(text)
    return 1 if report.failures else 0


if __name__ == "__main__":
    sys.exit(main())
