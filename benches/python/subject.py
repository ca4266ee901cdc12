"""What one bench is about: the same question to several contenders, whose answers must agree."""

from __future__ import annotations

from dataclasses import dataclass
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

Float: TypeAlias = npt.NDArray[np.float64]
Bool: TypeAlias = npt.NDArray[np.bool_]

# Names of contenders that are this package: they run at every level of vector instructions.
OURS = "assur"
# Two closed forms of one position differ by rounding times its condition (below `GOOD`).
TOLERANCE = 1e-8
GOOD = 1e3


class Others:
    """Whether contenders of other packages are made: not in the processes of the lower levels."""

    wanted = True


def installed(*modules: str) -> bool:
    """Whether contenders that need these packages run."""
    return Others.wanted and all(find_spec(module) is not None for module in modules)


def turn(count: int) -> Float:
    """Coordinates of one turn."""
    return np.linspace(0.0, 2 * np.pi, count, endpoint=False)


@dataclass(frozen=True)
class Contender:
    """One way to an answer.

    run: the function to time. answer: arrays of what `run` returned, compared with those of the
    first contender; None: it has no answer (writing to memory). designs: how many of the designs it
    does, the first ones; its time is scaled. where: the only places where it is compared. prepare:
    called before each run, outside the clock; what it returns is held until the run has ended.
    every_level: of this package, whether it runs at the lower levels too.
    """

    run: Callable[[], Any]
    answer: Callable[[Any], Sequence[Any]] | None = None
    designs: int | None = None
    where: Bool | None = None
    prepare: Callable[[], Any] | None = None
    every_level: bool = True


@dataclass(frozen=True)
class Subject:
    """One question.

    units: how many designs (positions, dyads …) a call does, which its time is divided by.
    angles: places among the answers whose turns are not compared. good: finds where answers are
    compared, of the shape of the first axes; everywhere by default. A NaN agrees with a NaN.
    """

    designs: int
    positions: int
    contenders: dict[str, Contender]
    units: int = 1
    angles: Sequence[int] = ()
    good: Callable[[], Bool] | None = None
    tolerance: float = TOLERANCE
    note: str = ""

    def check(self) -> None:
        """Assert that all contenders give the first one's answer."""
        first: Sequence[Any] | None = None
        good = None if self.good is None else self.good()
        for name, contender in self.contenders.items():
            if contender.answer is None:
                contender.run()
                continue
            arrays = [np.atleast_1d(array) for array in contender.answer(contender.run())]
            if first is None:
                # Arrays that are used again must not be compared with themselves.
                first = [np.array(array) for array in arrays]
                continue
            assert len(arrays) == len(first), f"{name}: {len(arrays)} arrays"
            for place, (every, theirs) in enumerate(zip(first, arrays, strict=True)):
                ours = every[: contender.designs]
                assert ours.shape == theirs.shape, f"{name}: {theirs.shape}, not {ours.shape}"
                where = np.ones(ours.shape, dtype=bool) if good is None else good[: len(ours)]
                if contender.where is not None:
                    where = where & contender.where
                self._compare(f"{name}, array {place}", ours[where], theirs[where], place)

    def _compare(self, what: str, ours: Float, theirs: Float, place: int) -> None:
        assert ours.size, f"{what}: nothing to compare"
        missing = np.isnan(ours)
        assert np.array_equal(missing, np.isnan(theirs)), f"{what}: others are missing"
        difference = (ours - theirs)[~missing]
        if place in self.angles:
            difference -= 2 * np.pi * np.round(difference / (2 * np.pi))
        most = np.abs(difference).max(initial=0.0)
        assert most < self.tolerance, f"{what}: differs by {most:.2e}"


@dataclass(frozen=True)
class Case:
    """One section of the page: a question, or one that grows.

    name: of its marker in the page. unit: what a time is divided by. subjects: a function each,
    by label (a number where something grows); `axis` says what the labels count. every_level:
    whether vector instructions matter. rounds: of a case whose calls take long.
    """

    name: str
    unit: str
    subjects: dict[str | int, Callable[[], Subject]]
    axis: str = ""
    plotted: bool = True
    every_level: bool = True
    rounds: int | None = None
