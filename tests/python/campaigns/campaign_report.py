"""The counts and findings of a campaign."""

from __future__ import annotations

import sys
import traceback
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable


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
        """A figure whose maximum is reported."""
        self.worst[name] = max(self.worst.get(name, 0.0), value)


class Findings:
    """The report of one mechanism or machine, with one failure of each kind."""

    def __init__(self) -> None:
        self.report = Report()
        self.failed: set[str] = set()

    def fail(self, kind: str, *texts: str) -> None:
        """The first of each kind: the others mostly have the same cause."""
        if texts and kind not in self.failed:
            self.failed.add(kind)
            self.report.failures.append(f"{kind}: {texts[0]}")

    def guarded(self, check: Callable[..., None], *of: int) -> None:
        """Run a check; any exception or panic is a failure."""
        try:
            check(*of)
        except KeyboardInterrupt:
            raise
        except BaseException:  # noqa: BLE001 (a panic of the core is not an Exception)
            self.fail(f"raised in {check.__name__}", raised())


def raised() -> str:
    """The exception being handled and where it was raised, on one line."""
    error = sys.exc_info()[1]
    frames = traceback.extract_tb(error.__traceback__ if error else None)
    where = " < ".join(f"{Path(f.filename).name}:{f.lineno}" for f in reversed(frames[-3:]))
    return f"{type(error).__name__} ({' '.join(str(error).split())}) at {where}"
