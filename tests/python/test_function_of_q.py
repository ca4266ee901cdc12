"""A motion is a function of (dimensions, assembly, q) and of nothing else: the same bits whatever
the order, spacing, number and neighbours of the coordinates, alone or in a batch."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import pytest

import assur
import description
import models
import named_models

Float = npt.NDArray[np.float64]
SINGLE = [name for name, make in named_models.NAMED.items() if len(make().drivers) == 1]


def bits(motion: assur.Motion) -> list[npt.NDArray[np.uint8]]:
    """Everything the motion holds, one row a position, as bytes."""
    held = motion._tracks
    rows = [motion.status.reshape(motion.status.size, 1)]
    for kind in (held.joints, held.links, held.slides):
        for arrays in kind.values():
            for array in arrays:
                width = int(np.prod(array.shape[motion.status.ndim :]))
                rows.append(np.array(array).reshape(motion.status.size, width).view(np.uint8))
    return rows


def same(motion: assur.Motion, rows: npt.NDArray[np.int64], of: assur.Motion) -> None:
    for a, b in zip(bits(motion), bits(of), strict=True):
        assert (a == b[rows]).all()


def check(m: assur.Mechanism, q: Float, rng: np.random.Generator) -> None:
    whole = m.solve(q, order=3, on_error="nan")
    n = len(q)
    for rows in (
        rng.permutation(n),
        np.arange(0, n, 7),
        np.repeat(np.arange(0, n, 11), 3),
        np.arange(n)[::-1],
        np.array([n // 2]),
        np.array([], dtype=np.int64),
    ):
        same(m.solve(q[rows], order=3, on_error="nan"), rows, whole)
    one = m.solve(q[3], order=3, on_error="nan")
    same(one, np.array([3]), whole)


@pytest.mark.parametrize("name", SINGLE)
def test_named(name: str) -> None:
    d = named_models.NAMED[name]()
    m = assur.Mechanism(**description.arguments(d))
    rng = np.random.default_rng(1)
    span = 3.0 if isinstance(m.driver, str) and m.driver in m.slides else 40.0
    check(m, float(m.q0) + rng.uniform(-span, span, 60), rng)


@pytest.mark.parametrize("seed", range(60))
def test_random(seed: int) -> None:
    case = models.random_case(seed, max_dyads=4)
    m = assur.Mechanism(**description.arguments(case.description))
    rng = np.random.default_rng(seed)
    q0 = np.asarray(m.q0)
    moves = rng.uniform(-2.0, 2.0, (30, *q0.shape))
    check(m, q0 + moves, rng)


@pytest.mark.parametrize("designs", [1, 7, 8, 9, 100])
def test_batches(designs: int) -> None:
    rng = np.random.default_rng(designs)
    coupler = rng.uniform(2.0, 4.0, designs)
    rocker = np.where(rng.random(designs) < 0.1, -1.0, rng.uniform(1.0, 3.0, designs))
    batch = assur.FourBar(1.0, coupler, rocker, 3.0)
    q = rng.uniform(-20.0, 20.0, 13)
    whole = batch.solve(q, order=2, on_error="nan")
    for i in range(designs):
        if rocker[i] < 0.0:
            assert (whole.status[i] == assur.Status.BAD_DIMENSION).all()
            continue
        own = assur.FourBar(1.0, coupler[i], rocker[i], 3.0).solve(q, order=2, on_error="nan")
        same(own, i * len(q) + np.arange(len(q)), whole)
