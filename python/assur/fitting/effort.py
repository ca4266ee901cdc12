"""How long a search may go on: for a time or for a number of evaluations."""

from __future__ import annotations

import time
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeAlias

from assur._arrays import real_number, short
from assur._validate import whole_number
from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from assur import _core

Progress: TypeAlias = "bool | Callable[[float, float], object]"
Report: TypeAlias = "Callable[[float, float], object]"

# A week, s; and what takes a year.
MOST_TIME = 604_800.0
MOST_EVALUATIONS = 10**12
# Parts of the effort at which candidates are put together, and at which the best are finished.
TOGETHER, FINISHED = 0.6, 0.9


@dataclass(slots=True)
class Effort:
    """A limit of time or of evaluations; what was done before does not count."""

    time_limit: float
    evaluations: int | None
    done: int = 0
    started: float = field(default_factory=time.monotonic)

    @property
    def elapsed(self) -> float:
        """Time since it began, s."""
        return time.monotonic() - self.started

    def part(self, search: _core.PathSearch | _core.Fit) -> float:
        """Return which part of it is spent."""
        if self.evaluations is None:
            return self.elapsed / self.time_limit
        return (search.evaluations - self.done) / self.evaluations


def checked_effort(time_limit: Any, evaluations: Any, done: int = 0) -> Effort:
    """Return the limit; evaluations are in place of a time."""
    seconds = real_number(time_limit, "time_limit")
    if not 0.0 < seconds <= MOST_TIME:
        message = f"time_limit is {seconds:g} s: more than 0 and at most {MOST_TIME:g} is needed"
        raise InputError(message, value=seconds)
    if evaluations is not None:
        evaluations = whole_number(evaluations, "evaluations", 1, MOST_EVALUATIONS)
    return Effort(seconds, evaluations, done)


def evolve(search: _core.PathSearch, effort: Effort, report: Report, apart: bool) -> None:
    """Let linkages evolve: on islands until a part of the effort is spent, or together."""
    # The last part of a time is for finishing; evaluations for that come on top.
    end = TOGETHER if apart else FINISHED if effort.evaluations is None else 1.0
    while (part := effort.part(search)) < end:
        report(part, search.best())
        if not search.round(apart):
            return


@contextmanager
def reporter(progress: Any, what: str = "error") -> Iterator[Report]:
    """Yield the function to call with the part that is done and a number: the least error so far.

    A bar shows `what` the number is.
    """
    if progress is False or progress is None:
        yield _silent
    elif callable(progress):
        yield progress
    elif progress is True:
        try:
            from tqdm.auto import tqdm
        except ImportError as error:
            message = "progress=True needs tqdm: pip install assur[progress], or pass a function"
            raise ImportError(message) from error
        with tqdm(total=100, unit="%", bar_format="{l_bar}{bar}| {elapsed}{postfix}") as bar:

            def show(part: float, best: float) -> None:
                bar.set_postfix_str(f"{what} {best:.3g}", refresh=False)
                bar.update(int(100.0 * part) - bar.n)

            yield show
            bar.update(100 - bar.n)
    else:
        message = f"progress is {short(progress)}: True, False or a function is needed"
        raise InputError(message)


def _silent(_part: float, _best: float) -> None:
    """Report nothing."""
