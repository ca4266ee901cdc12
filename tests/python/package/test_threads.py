"""Threads, Ctrl-C, fork and calls at the same time; coordinates and batches at their limits."""

from __future__ import annotations

import math
import multiprocessing
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur import Status
from net import bits
from net.bits import Float, coordinates, designs, solve
from support.interruptions import is_heard

if TYPE_CHECKING:
    from collections.abc import Callable
    from multiprocessing.connection import Connection

STRANGE = [0.3, math.nan, math.inf, -math.inf, 1e15, -1e15, 1e300, -1e300, 1.7e308, 5e-324, -0.0]
MANY = 30_000  # rows: more than one thread takes at a time
Call = tuple[assur.Mechanism, Float]
Work = tuple[assur.Mechanism, Float, list[str]]


@pytest.mark.parametrize("threads", [0, -1, True, 1.5, "2", 10**6, 2**70, math.nan, [2], b"2"])
def test_threads_refused(threads: Any) -> None:
    with pytest.raises(assur.InputError, match=r"^threads is .*: a whole number from 1 to 4096"):
        assur.FourBar(1.0, 3.0, 2.5, 3.0).solve(0.0, threads=threads)


@pytest.mark.parametrize("threads", [1, 4096, np.int8(2)])
def test_threads_accepted(threads: int) -> None:
    m, q = assur.FourBar(1.0, 3.0, 2.5, 3.0), np.linspace(-9.0, 9.0, MANY)
    assert (solve(m, q, threads=threads) == solve(m, q)).all()


@pytest.mark.parametrize("positions", [360, 3000, 70_000])
def test_others_help_after_a_trial(positions: int) -> None:
    """The first chunks are short, and one design may lie in chunks of both sizes."""
    lengths = np.linspace(2.9, 3.1, 2_000_000 // positions)
    m = assur.FourBar(1.0, 3.0, 2.5, 3.0).with_dimensions({"coupler.length": lengths})
    q = np.linspace(-9.0, 9.0, positions)
    one, two = (m.solve(q, order=0, outputs=["C"], threads=threads) for threads in (1, 2))
    assert np.array_equal(one.joint("C").value, two.joint("C").value)


@pytest.mark.usefixtures("threads_at_once")
@pytest.mark.parametrize("positions", [360, 361])
@pytest.mark.parametrize("threads", [1, 2])
def test_results_beyond_the_caches_have_the_same_bits(threads: int, positions: int) -> None:
    """From 32 MiB on whole lines bypass the caches; rows of 361 begin within lines."""
    q = np.linspace(0.0, 6.0, positions)
    lengths = np.linspace(2.9, 3.1, 1200)
    many = assur.FourBar(1.0, 3.0, 2.5, 3.0).with_dimensions({"coupler.length": lengths})
    motion = many.solve(q, threads=threads)
    few = assur.FourBar(1.0, 3.0, 2.5, 3.0).with_dimensions({"coupler.length": lengths[::100]})
    part = few.solve(q, threads=threads)
    assert motion.joint("C").value.size * 3 * 4 > 4 << 20
    for name in motion.mechanism.joints:
        for order in ("value", "d1", "d2"):
            whole, some = (getattr(m.joint(name), order) for m in (motion, part))
            assert np.array_equal(whole[::100], some), (name, order)


@pytest.mark.usefixtures("threads_at_once")
@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("positions", [8_201, 65_541])
def test_many_designs_at_many_positions_have_the_same_bits(positions: int, threads: int) -> None:
    """From 64 designs on all positions of one belong together, up to 65 536."""
    q = np.linspace(-9.0, 9.0, positions)
    four = assur.FourBar(1.0, 3.0, 2.5, 3.0)
    many = four.with_dimensions({"coupler.length": np.linspace(2.4, 3.1, 64)})
    motion = many.solve(q, order=1, outputs=["rocker"], on_error="nan", threads=threads)
    for i in (0, 40, 63):
        alone = many.design(i).solve(q, order=1, outputs=["rocker"], on_error="nan")
        assert np.array_equal(motion.status[i], alone.status)
        for order in ("value", "d1"):
            whole, one = (getattr(m.link("rocker"), order) for m in (motion, alone))
            assert np.array_equal(whole[i], one, equal_nan=True), order


# -- coordinates and dimensions -------------------------------------------------------------------


@pytest.mark.parametrize("name", bits.NAMES)
def test_strange_coordinates(name: str) -> None:
    """Each as alone, and those beside it too."""
    m, rng = bits.named(name), np.random.default_rng(5)
    q = coordinates(m, rng, 3 * len(STRANGE), name)
    strange = rng.permutation(np.repeat(STRANGE, 2))
    if q.ndim == 1:
        q[: len(strange)] = strange
    else:  # paths to far positions of several drivers are long
        q[: len(strange), -1] = np.where(np.abs(strange) > 1.0, math.nan, strange)
    q = rng.permutation(q)
    motion = m.solve(q, order=3, on_error="nan")
    refused = ~np.isfinite(q.reshape(len(q), -1)).all(axis=1)
    assert ((motion.status == Status.BAD_INPUT) == refused).all()
    alone = np.concatenate([solve(m, one) for one in q])
    assert (bits.bits(motion) == alone).all()


@pytest.mark.parametrize("size", [5e-324, 1e-310, 1e-154, 1e154, math.inf, math.nan])
def test_dimensions_out_of_range_beside_others(size: float) -> None:
    q = np.linspace(-9.0, 9.0, 13)
    batch = assur.FourBar([1.0, size, 1.0], 3.0, 2.5, 3.0)
    motion = batch.solve(q, order=3, on_error="nan")
    assert (motion.status == np.array([[0], [Status.BAD_DIMENSION], [0]])).all()
    rows = bits.bits(motion).reshape(3, len(q), -1)
    alone = solve(assur.FourBar(1.0, 3.0, 2.5, 3.0), q)
    assert (rows[[0, 2]] == alone).all()
    with pytest.raises(assur.DimensionError, match=r"crank\.length"):
        batch.design(1)


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("count", [0, 3, MANY])
@pytest.mark.parametrize("shape", [(0,), (0, 3), (2, 0)])
def test_no_designs(shape: tuple[int, ...], count: int, threads: int) -> None:
    m = assur.FourBar(np.ones(shape), 3.0, 2.5, 3.0)
    for q in (np.ones(count), np.ones((*shape, count))):
        motion = m.solve(q, order=3, threads=threads)
        assert motion.shape == (*shape, count)
        assert motion.joint("C").d3.shape == (*shape, count, 2)
        assert motion.condition.shape == motion.shape


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("shape", [(), (5,), (0,)])
def test_no_coordinates(shape: tuple[int, ...], threads: int) -> None:
    motion = assur.FourBar(np.ones(shape), 3.0, 2.5, 3.0).solve([], order=3, threads=threads)
    assert motion.shape == (*shape, 0)
    assert motion.joint("C").d3.shape == (*shape, 0, 2)


# -- Ctrl-C ---------------------------------------------------------------------------------------


def many_positions(rng: np.random.Generator, size: int) -> Work:
    m = bits.named("library excavator")
    return m, coordinates(m, rng, size, "library excavator"), []


def many_designs(rng: np.random.Generator, size: int) -> Work:
    """With results: what is solved without any takes less time than its designs to be made."""
    m = bits.named("library peaucellier")
    return designs(m, rng, size), np.array([0.3]), list(m.joints)


def many_turns(rng: np.random.Generator, size: int) -> Work:
    """The angle of a coupler: only requested angles are followed from the drawing."""
    return bits.named("model five_bar"), rng.uniform(-314.0, 314.0, (size, 2)), ["l3"]


LONG = (many_positions, many_designs, many_turns)


@pytest.mark.parametrize("threads", [1, None])
@pytest.mark.parametrize("make", LONG)
def test_interrupt(make: Callable[[np.random.Generator, int], Work], threads: int | None) -> None:
    """Stops long before the work is done, whatever it is; the next call works as usual."""

    def work(size: int) -> Callable[[], object]:
        m, q, outputs = make(np.random.default_rng(6), size)
        return lambda: m.solve(q, order=0, outputs=outputs, on_error="nan", threads=threads)

    assert is_heard(work, 8)
    four, few = assur.FourBar(1.0, 3.0, 2.5, 3.0), np.linspace(-9.0, 9.0, MANY)
    assert (solve(four, few, threads=threads) == solve(four, few, threads=1)).all()


# -- processes and threads of Python --------------------------------------------------------------


def answer(m: assur.Mechanism, q: Float, pipe: Connection) -> None:
    pipe.send_bytes(solve(m, q, threads=2).tobytes())


@pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")  # of threads that are not ours
@pytest.mark.parametrize("positions", [MANY, 2 * MANY, 8 * MANY])
def test_fork_after_threads(positions: int) -> None:
    """Threads that wait for work, and new ones, are not there in the child."""
    m, q = bits.named("library whitworth"), np.linspace(-9.0, 9.0, positions)
    expected = solve(m, q, threads=2)
    fork = multiprocessing.get_context("fork")
    here, there = fork.Pipe(duplex=False)
    child = fork.Process(target=answer, args=(m, q, there))
    child.start()
    try:
        assert here.poll(30.0), "the child hangs"
        assert here.recv_bytes() == expected.tobytes()
        child.join(30.0)
        assert child.exitcode == 0
    finally:
        child.kill()


def test_several_calls_at_once() -> None:
    """Of one mechanism and of others, each on two threads."""
    rng = np.random.default_rng(7)
    names = ["library crank_rocker", "library whitworth", "model trammel"]
    ones = [(bits.named(name), coordinates(bits.named(name), rng, MANY, name)) for name in names]
    calls = [*ones, *ones[:1], *ones]
    expected = [solve(m, q, threads=1) for m, q in calls]
    with ThreadPoolExecutor(len(calls)) as pool:
        futures = [pool.submit(solve, m, q, threads=2) for m, q in calls]
        for future, rows in zip(futures, expected, strict=True):
            assert (future.result() == rows).all()
