"""Time over the number of designs, positions, dyads and threads: in proportion to each.

The last column is in ns: of one design, position or dyad.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numba
import numpy as np
import pytest
from side_by_side import ASSUR

import assur

if TYPE_CHECKING:
    from collections.abc import Callable

    from pytest_benchmark.fixture import BenchmarkFixture

RANDOM = np.random.default_rng(4)
ROUNDS = 9


def turn(count: int) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    return np.linspace(0.0, 2 * np.pi, count, endpoint=False)


def four_bars(designs: int) -> assur.Mechanism:
    """They turn fully."""
    nominal = {"crank.length": 1.0, "coupler.length": 3.0, "rocker.length": 2.5}
    lengths = {n: x * RANDOM.uniform(1.0, 1.01, designs) for n, x in nominal.items()}
    return assur.FourBar(1.0, 3.0, 2.5, 3.2).with_dimensions(lengths)


def chain(dyads: int) -> assur.Mechanism:
    """Rockers to the right and to the left in turns, each driven by the one before; none folds."""
    joints = {"O": (0.0, 0.0), "C0": (0.0, 0.5)}
    links = {"ground": ["O"], "crank": ["O", "C0"]}
    for k in range(1, dyads + 1):
        before, foot, tip = f"C{k - 1}", f"D{k}", f"C{k}"
        x, y = 3.0 if k % 2 else 0.02 * k, joints[before][1]
        joints |= {foot: (x, y - 3.0 + 0.01 * k), tip: (x, y + 0.01)}
        links["ground"].append(foot)
        links |= {f"coupler{k}": [before, tip], f"rocker{k}": [foot, tip]}
    return assur.Mechanism(joints, links, "crank")


def time(
    benchmark: BenchmarkFixture, run: Callable[[], object], each: int, rounds: int = ROUNDS
) -> None:
    benchmark.pedantic(run, rounds=rounds, warmup_rounds=1)
    if benchmark.stats:
        benchmark.extra_info["ns each"] = round(benchmark.stats["median"] / each * 1e9, 2)


@pytest.mark.benchmark(group="designs x 36 positions, an angle, 1 thread")
@pytest.mark.parametrize("designs", [10**k for k in range(2, 7)])
def test_designs(benchmark: BenchmarkFixture, designs: int) -> None:
    batch, q = four_bars(designs), turn(36)
    solve = partial(batch.solve, q, 0, ["rocker"], threads=1)
    time(benchmark, partial(solve, out=solve()), designs)


@pytest.mark.benchmark(group="100 designs x positions, an angle, 1 thread")
@pytest.mark.parametrize("positions", [36 * 10**k for k in range(4)])
def test_positions(benchmark: BenchmarkFixture, positions: int) -> None:
    batch, q = four_bars(100), turn(positions)
    solve = partial(batch.solve, q, 0, ["rocker"], threads=1)
    time(benchmark, partial(solve, out=solve()), 100 * positions)


@pytest.mark.benchmark(group="1000 designs x 72 positions of chains of dyads, 1 thread")
@pytest.mark.parametrize("order", [0, 2])
@pytest.mark.parametrize("dyads", [1, 3, 10, 30])
def test_dyads(benchmark: BenchmarkFixture, dyads: int, order: int) -> None:
    one = chain(dyads)
    batch = one.with_dimensions({"crank.length": RANDOM.uniform(0.5, 0.505, 1000)})
    solve = partial(batch.solve, turn(72), order, [f"C{dyads}"], threads=1)
    time(benchmark, partial(solve, out=solve()), 72_000 * dyads)


@numba.njit(parallel=True)
def arithmetic(sums: np.ndarray[tuple[int], np.dtype[np.float64]]) -> None:
    """A probe: nothing but multiplications and additions, each waiting for the last."""
    for i in numba.prange(sums.size):
        x = sums[i]
        for _ in range(10_000):
            x = x * 0.999 + 0.001
        sums[i] = x


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("what", ["four-bars", "chains of three dyads", "arithmetic"])
def test_threads(benchmark: BenchmarkFixture, what: str, threads: int) -> None:
    benchmark.group = f"threads: {what if what == 'arithmetic' else f'{ASSUR}, {what}'}"
    if what == "arithmetic":
        numba.set_num_threads(threads)
        time(benchmark, partial(arithmetic, np.ones(5000)), 5000)
        return
    batch, outputs = four_bars(10_000), ["coupler", "rocker"]
    if what != "four-bars":
        one = chain(3)
        batch = one.with_dimensions({"crank.length": RANDOM.uniform(0.5, 0.505, 10_000)})
        outputs = ["C3"]
    solve = partial(batch.solve, turn(72), 2, outputs, threads=threads)
    time(benchmark, partial(solve, out=solve()), 10_000)
