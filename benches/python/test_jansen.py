"""Jansen's leg beside NumPy: the places of its joints."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from closed_form import jansen
from library import jansen_leg
from side_by_side import DESIGNS, MANY, ONE, ONE_THREAD, SIZE, Case

if TYPE_CHECKING:
    from collections.abc import Callable

    from pytest_benchmark.fixture import BenchmarkFixture

OUTPUTS = ["M", "T", "W", "L", "K", "F"]

RUNS_OF_ONE: dict[str, Callable[[Case], object]] = ONE_THREAD | {
    "circles": lambda case: case.numpy(jansen),
}
RUNS = (
    RUNS_OF_ONE
    | MANY
    | {
        "circles blocked, 1 thread": lambda case: case.blocked(jansen, 1),
        "circles blocked, 2 threads": lambda case: case.blocked(jansen, 2),
    }
)


def case(designs: int | None) -> Case:
    leg = jansen_leg()
    return Case.make(leg, list(leg.dimensions), OUTPUTS, 0, designs)


@pytest.fixture(scope="module")
def many() -> Case:
    c = case(DESIGNS)
    c.check(c.numpy(jansen), c.blocked(jansen))
    return c


@pytest.fixture(scope="module")
def one() -> Case:
    c = case(None)
    c.check(c.numpy(jansen))
    return c


@pytest.mark.benchmark(group=f"Jansen, {SIZE}, order 0")
@pytest.mark.parametrize("name", RUNS)
def test_designs(benchmark: BenchmarkFixture, many: Case, name: str) -> None:
    benchmark.pedantic(RUNS[name], (many,), rounds=9, warmup_rounds=1)


@pytest.mark.benchmark(group=f"Jansen, {ONE}, order 0")
@pytest.mark.parametrize("name", RUNS_OF_ONE)
def test_one_design(benchmark: BenchmarkFixture, one: Case, name: str) -> None:
    benchmark(RUNS_OF_ONE[name], one)
