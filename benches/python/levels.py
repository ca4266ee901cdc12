"""One process a level of vector instructions, which is read once a process; they take turns.

All contenders are in that of the best level, this package alone in the others.
"""

from __future__ import annotations

import multiprocessing
import os
from contextlib import contextmanager
from dataclasses import dataclass
from time import perf_counter
from typing import TYPE_CHECKING, Any, Protocol

from assur import _core
from subject import OURS, Others

if TYPE_CHECKING:
    from collections.abc import Iterator
    from multiprocessing.connection import Connection

    from subject import Case, Contender

# Levels below the best one, if the processor has it.
LOWER = ("avx2", "baseline")
# A call that takes less is repeated within a round; one that takes more runs once to warm up, s.
SHORT, LONG = 2e-3, 1.0


@dataclass(frozen=True)
class About:
    """A subject that is open: see `Subject`. run: designs that each contender does."""

    designs: int
    positions: int
    units: int
    note: str
    run: dict[str, int]


class Side(Protocol):
    """Contenders at a level, here or in another process."""

    level: str

    def open(self, label: str | int) -> About:
        """Make a subject, check that its contenders agree, and run all once."""

    def seconds(self, name: str) -> float:
        """Return the seconds of a contender's call, scaled to all designs."""


class Here:
    """Contenders in this process."""

    def __init__(self, case: Case, only_ours: bool = False) -> None:
        self.case, self.only_ours = case, only_ours
        self.level = _core.simd_level()
        self.designs = 0
        self.contenders: dict[str, Contender] = {}
        self.repeats: dict[str, int] = {}
        Others.wanted = not only_ours

    def open(self, label: str | int) -> About:
        self.contenders = {}  # drops the last subject's arrays
        subject = self.case.subjects[label]()
        if not self.only_ours:
            subject.check()
        self.designs = subject.designs
        self.contenders = {
            name: contender
            for name, contender in subject.contenders.items()
            if not self.only_ours or (name.startswith(OURS) and contender.every_level)
        }
        self.repeats = {name: self._repeats(name) for name in self.contenders}
        run = {
            name: contender.designs or self.designs for name, contender in self.contenders.items()
        }
        return About(subject.designs, subject.positions, subject.units, subject.note, run)

    def _repeats(self, name: str) -> int:
        """How often a short call is repeated; none is cold afterwards."""
        once = self.seconds(name, 1)
        if once < LONG:  # the first calls of a short one say little
            once = min(self.seconds(name, 1) for _ in range(5))
        return max(1, int(SHORT / max(once, 1e-7)))

    def seconds(self, name: str, repeats: int | None = None) -> float:
        contender = self.contenders[name]
        repeats = repeats or self.repeats[name]
        held = None
        if contender.prepare is not None:
            held, repeats = contender.prepare(), 1
        run = contender.run
        start = perf_counter()
        for _ in range(repeats):
            run()
        time = (perf_counter() - start) / repeats
        del held
        return time * self.designs / (contender.designs or self.designs)


class There:
    """Contenders in a process of their own, with a limit on its level."""

    def __init__(self, case: Case, limit: str) -> None:
        context = multiprocessing.get_context("spawn")
        self.pipe, theirs = context.Pipe()
        before = dict(os.environ)
        if limit:
            os.environ["ASSUR_SIMD"] = limit
        try:
            self.process = context.Process(target=_serve, args=(theirs, case.name, bool(limit)))
            self.process.start()
        finally:
            os.environ.clear()
            os.environ.update(before)
        theirs.close()
        self.level: str = self.pipe.recv()

    def open(self, label: str | int) -> About:
        about: About = self._ask("open", label)
        return about

    def seconds(self, name: str) -> float:
        seconds: float = self._ask("seconds", name)
        return seconds

    def close(self) -> None:
        try:
            self.pipe.send(None)
        except OSError:  # it has ended with an error of its own
            self.pipe.close()
        self.process.join()

    def _ask(self, method: str, argument: Any) -> Any:
        self.pipe.send((method, argument))
        return self.pipe.recv()


def _serve(pipe: Connection, name: str, only_ours: bool) -> None:
    """Carry out requests until there are no more."""
    from cases import cases

    here = Here(cases(quick=False)[name], only_ours)
    pipe.send(here.level)
    while (asked := pipe.recv()) is not None:
        method, argument = asked
        pipe.send(getattr(here, method)(argument))


@contextmanager
def sides(case: Case, quick: bool) -> Iterator[list[Side]]:
    """One side a level; to be quick, one in this process alone."""
    if quick:
        yield [Here(case)]
        return
    opened: list[There] = []
    try:
        for limit in ("", *(LOWER if case.every_level else ())):
            there = There(case, limit)
            # A limit above what the processor has changes nothing: the level is there already.
            if there.level in [side.level for side in opened]:
                there.close()
            else:
                opened.append(there)
        yield list(opened)
    finally:
        for side in opened:
            side.close()
