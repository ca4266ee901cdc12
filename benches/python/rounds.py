"""Times of contenders, interleaved: A B C A B C …, this package at every level of instructions.

A level is read once a process, so each has a process of its own; they take turns, one call at a
time. Everything else runs beside `assur` in the process of the best level.
"""

from __future__ import annotations

import multiprocessing
import os
import statistics
from contextlib import contextmanager
from dataclasses import dataclass
from time import perf_counter
from typing import TYPE_CHECKING, Any, TypeAlias

from assur import _core
from subject import OURS, Others

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from multiprocessing.connection import Connection

    from subject import Case, Contender, Subject

# Levels below the best one, if the processor has it.
LOWER = ("avx2", "baseline")
# Rounds at least and at most, and the time after which there are enough, s.
LEAST, MOST, ENOUGH = 7, 31, 4.0
# A call that takes less is repeated within a round; one that takes more runs once to warm up, s.
SHORT, LONG = 2e-3, 1.0

Key: TypeAlias = tuple[str, str]  # a contender's name and the level of its process


@dataclass(frozen=True)
class Timing:
    """Medians over the rounds: seconds of a call, and its ratio to the first contender's."""

    name: str
    level: str
    seconds: float
    ratio: float
    spread: float
    designs: int
    rounds: int


class Bench:
    """The contenders of a subject in this process."""

    def __init__(self, subject: Subject, only_ours: bool = False) -> None:
        self.subject = subject
        self.contenders = {
            name: contender
            for name, contender in subject.contenders.items()
            if not only_ours or (name.startswith(OURS) and contender.every_level)
        }
        self.repeats = dict.fromkeys(self.contenders, 1)

    def names(self) -> list[str]:
        return list(self.contenders)

    def warm(self) -> None:
        """Run all once, and see how often a short one must be repeated."""
        for name in self.contenders:
            once = self.seconds(name)
            if once < LONG:  # the first call of a short one says little
                once = self.seconds(name)
            self.repeats[name] = max(1, int(SHORT / max(once, 1e-7)))

    def seconds(self, name: str) -> float:
        """Return the seconds of a call, scaled to all designs."""
        contender: Contender = self.contenders[name]
        repeats = self.repeats[name] if contender.prepare is None else 1
        held = contender.prepare() if contender.prepare is not None else None
        run = contender.run
        start = perf_counter()
        for _ in range(repeats):
            run()
        time = (perf_counter() - start) / repeats
        del held
        part = self.subject.designs / (contender.designs or self.subject.designs)
        return time * part


def measure(
    case: Case, label: str | int, quick: bool = False, rounds: int | None = None
) -> tuple[dict[str, Any], list[Timing]]:
    """Check that a subject's contenders agree; return its facts and their times.

    quick: in this process alone. rounds: so many of them, not as many as there is time for.
    """
    with _benches(case, label, quick) as benches:
        facts, names = benches[0].facts, benches[0].names
        # The levels of a contender follow each other.
        keys = [(name, bench) for name in names for bench in benches if name in bench.names]
        times: dict[Key, list[float]] = {(name, bench.level): [] for name, bench in keys}
        start = perf_counter()
        for done in range(1, (rounds or MOST) + 1):
            for name, bench in keys:
                times[name, bench.level].append(bench.seconds(name))
            if rounds is None and done >= LEAST and perf_counter() - start > ENOUGH:
                break
        designs = {(name, bench.level): bench.designs[name] for name, bench in keys}
    return facts, list(_medians(times, designs))


def _medians(times: dict[Key, list[float]], designs: dict[Key, int]) -> Iterator[Timing]:
    first = next(iter(times.values()))
    for (name, level), found in times.items():
        ratios = [one / other for one, other in zip(found, first, strict=True)]
        middle = statistics.median(found)
        quarters = statistics.quantiles(found) if len(found) > 1 else [middle, middle, middle]
        yield Timing(
            name=name,
            level=level,
            seconds=middle,
            ratio=statistics.median(ratios),
            spread=(quarters[2] - quarters[0]) / middle,
            designs=designs[name, level],
            rounds=len(found),
        )


# -- benches here and in other processes ----------------------------------------------------------


@dataclass(frozen=True)
class _Side:
    """A bench, here or in another process."""

    level: str
    names: Sequence[str]
    designs: dict[str, int]
    facts: dict[str, Any]
    seconds: Callable[[str], float]


def _opened(case: Case, label: str | int, only_ours: bool) -> tuple[Bench, tuple[Any, ...]]:
    subject = case.subjects[label]()
    bench = Bench(subject, only_ours)
    if not only_ours:
        subject.check()
    bench.warm()
    designs = {name: one.designs or subject.designs for name, one in bench.contenders.items()}
    facts = {
        "designs": subject.designs,
        "positions": subject.positions,
        "units": subject.units,
        "note": subject.note,
        **subject.facts,
    }
    return bench, (_core.simd_level(), bench.names(), designs, facts)


def _serve(pipe: Connection, case: Case, label: str | int, only_ours: bool) -> None:
    """Answer with times until there is no more question."""
    Others.wanted = not only_ours
    bench, about = _opened(case, label, only_ours)
    pipe.send(about)
    while (name := pipe.recv()) is not None:
        pipe.send(bench.seconds(name))


@contextmanager
def _benches(case: Case, label: str | int, quick: bool) -> Iterator[list[_Side]]:
    """One bench in this process if it is to be quick, else one a level."""
    if quick:
        bench, about = _opened(case, label, only_ours=False)
        yield [_Side(*about, bench.seconds)]
        return
    opened: list[tuple[Any, Connection]] = []
    sides = []
    try:
        for limit in ("", *LOWER):
            process, pipe = _process(case, label, limit)
            opened.append((process, pipe))
            about = pipe.recv()
            # A limit above what the processor has changes nothing: the level is there already.
            if about[0] not in [side.level for side in sides]:
                sides.append(_Side(*about, _asker(pipe)))
        yield sides
    finally:
        for process, pipe in opened:
            try:
                pipe.send(None)
            except OSError:  # it has ended with an error of its own
                pipe.close()
            process.join()


def _process(case: Case, label: str | int, limit: str) -> tuple[Any, Connection]:
    context = multiprocessing.get_context("spawn")
    ours, theirs = context.Pipe()
    before = os.environ.get("ASSUR_SIMD")
    if limit:
        os.environ["ASSUR_SIMD"] = limit
    try:
        process = context.Process(target=_serve_named, args=(theirs, case.name, label, bool(limit)))
        process.start()
    finally:
        if before is not None:
            os.environ["ASSUR_SIMD"] = before
        elif limit:
            del os.environ["ASSUR_SIMD"]
    theirs.close()
    return process, ours


def _serve_named(pipe: Connection, name: str, label: str | int, only_ours: bool) -> None:
    from cases import cases

    _serve(pipe, cases(quick=False)[name], label, only_ours)


def _asker(pipe: Connection) -> Callable[[str], float]:
    def ask(name: str) -> float:
        pipe.send(name)
        seconds: float = pipe.recv()
        return seconds

    return ask
