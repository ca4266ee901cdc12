"""Four-bar beside NumPy: B, C and both angles with first and second analogues."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from closed_form import textbook, vectors
from side_by_side import DESIGNS, MANY, ONE, ONE_THREAD, SIZE, Case

import assur

if TYPE_CHECKING:
    from collections.abc import Callable

    from pytest_benchmark.fixture import BenchmarkFixture

NAMES = ["crank.length", "coupler.length", "rocker.length", "ground.D.x"]
OUTPUTS = ["B", "C", "coupler", "rocker"]

RUNS_OF_ONE: dict[str, Callable[[Case], object]] = ONE_THREAD | {
    "textbook": lambda case: case.numpy(textbook),
    "vectors": lambda case: case.numpy(vectors),
}
RUNS = (
    RUNS_OF_ONE
    | MANY
    | {
        "vectors blocked, 1 thread": lambda case: case.blocked(vectors, 1),
        "vectors blocked, 2 threads": lambda case: case.blocked(vectors, 2),
    }
)


def case(designs: int | None) -> Case:
    return Case.make(assur.FourBar(1.0, 3.0, 2.5, 3.0), NAMES, OUTPUTS, 2, designs)


@pytest.fixture(scope="module")
def many() -> Case:
    c = case(DESIGNS)
    c.check(c.numpy(textbook), c.numpy(vectors), c.blocked(vectors))
    return c


@pytest.fixture(scope="module")
def one() -> Case:
    c = case(None)
    c.check(c.numpy(textbook), c.numpy(vectors))
    return c


@pytest.mark.benchmark(group=f"four-bar, {SIZE}, order 2")
@pytest.mark.parametrize("name", RUNS)
def test_designs(benchmark: BenchmarkFixture, many: Case, name: str) -> None:
    benchmark.pedantic(RUNS[name], (many,), rounds=9, warmup_rounds=1)


@pytest.mark.benchmark(group=f"four-bar, {ONE}, order 2")
@pytest.mark.parametrize("name", RUNS_OF_ONE)
def test_one_design(benchmark: BenchmarkFixture, one: Case, name: str) -> None:
    benchmark(RUNS_OF_ONE[name], one)
