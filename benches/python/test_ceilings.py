"""Sweeps beside what memory allows: writing as many numbers, into new pages and into old ones."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numba
import numpy as np
import pytest
import specialist
from closed_form import textbook
from library import jansen_leg
from side_by_side import ASSUR, SIZE, Case

import assur

if TYPE_CHECKING:
    from collections.abc import Callable

    from pytest_benchmark.fixture import BenchmarkFixture

THREADS = 2


def four_bar() -> Case:
    names = ["crank.length", "coupler.length", "rocker.length", "ground.D.x"]
    outputs = ["B", "C", "coupler", "rocker"]
    return Case.make(assur.FourBar(1.0, 3.0, 2.5, 3.0), names, outputs, 2, designs=10_000)


def jansen(order: int) -> Case:
    leg = jansen_leg()
    return Case.make(leg, list(leg.dimensions), list("MTWLKF"), order, designs=10_000)


CASES: dict[str, Callable[[], Case]] = {
    "four-bar, order 2": four_bar,
    "Jansen, order 0": lambda: jansen(0),
    "Jansen, order 2": lambda: jansen(2),
}
RUNS: dict[str, Callable[[Case], object]] = {
    f"{ASSUR}, out=": lambda case: case.assur(THREADS, case.motion),
    "old pages": lambda case: specialist.fill(tuple(case.out), 1.5),
    f"{ASSUR}, new arrays": lambda case: case.assur(THREADS),
    "new pages": lambda case: specialist.fill(tuple(map(np.empty_like, case.out)), 1.5),
    "textbook": lambda case: case.numpy(textbook),
}


@pytest.fixture(scope="module", params=CASES)
def case(request: pytest.FixtureRequest) -> Case:
    numba.set_num_threads(THREADS)
    return CASES[request.param]()


@pytest.mark.parametrize("name", RUNS)
def test_memory(
    benchmark: BenchmarkFixture, case: Case, name: str, request: pytest.FixtureRequest
) -> None:
    which = request.node.callspec.params["case"]
    if name == "textbook" and which != "four-bar, order 2":
        pytest.skip("the textbook's formulas are for the four-bar")
    benchmark.group = f"{which}, {SIZE}, {THREADS} threads"
    benchmark.pedantic(RUNS[name], (case,), rounds=9, warmup_rounds=1)
