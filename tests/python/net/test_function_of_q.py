"""A motion is a function of (dimensions, assembly, q) and of nothing else.

The same bits, of NaN and statuses too, whatever the order, spacing, number and neighbours of the
coordinates, alone or in a batch, on one thread or two, with whichever vector instructions.
"""

from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
import pytest

import assur
from net import bits
from net.bits import Bits, Float, coordinates, designs, solve
from support.samples import sample

if TYPE_CHECKING:
    from collections.abc import Iterator

pytestmark = pytest.mark.usefixtures("threads_at_once")

# Random mechanisms: 250, or 5000 in a campaign.
COUNT = sample(80, 5000)
PARTS = 10
SIZES = (1, 7, 8, 9)
LARGE = ("library crank_rocker", "library whitworth", "library trammel")
CHUNK = 8192  # positions that one thread takes at a time; with several drivers 8


def same(found: Bits, expected: Bits, what: str) -> None:
    assert found.shape == expected.shape, what
    wrong = (found != expected).any(axis=1)
    assert not wrong.any(), f"{what}: {wrong.sum()} of {len(wrong)}, first {wrong.argmax()}"


def selections(n: int, rng: np.random.Generator) -> Iterator[npt.NDArray[np.int64]]:
    """Permuted, thinned, repeated, reversed, single and none."""
    yield rng.permutation(n)
    yield np.arange(0, n, 7)
    yield np.repeat(np.arange(0, n, 11), 3)
    yield np.arange(n)[::-1]
    yield np.array([n // 2])
    yield np.array([], dtype=np.int64)


def check_coordinates(
    m: assur.Mechanism, q: Float, rng: np.random.Generator, of: str, among: int | None = None
) -> None:
    """All at once on one thread and two, and (`among` of) them in other orders."""
    whole = solve(m, q, threads=1)
    same(solve(m, q, threads=2), whole, f"{of}, two threads")
    few = rng.choice(len(q), among or len(q), replace=False)
    for rows in selections(len(few), rng):
        same(solve(m, q[few[rows]]), whole[few[rows]], f"{of}, {len(rows)} rows")
    same(solve(m, q[few[0]]), whole[few[:1]], f"{of}, scalar")


def check_diagnostics(m: assur.Mechanism, q: Float, rng: np.random.Generator, of: str) -> None:
    order = rng.permutation(len(q))
    whole, permuted = (m.solve(c, order=0, on_error="nan") for c in (q, q[order]))
    for name in ("residual", "condition"):
        found, expected = getattr(permuted, name), getattr(whole, name)[order]
        assert found.tobytes() == expected.tobytes(), f"{of}, {name}"


def check_batch(m: assur.Mechanism, q: Float, rng: np.random.Generator, of: str, size: int) -> None:
    """Each design as alone, its coordinates shared with the others or its own; in any order."""
    batch = designs(m, rng, size)
    own = np.stack([rng.permutation(q) for _ in range(size)])
    of = f"{of}, {size} designs"
    shared, apart = (solve(batch, c, threads=1).reshape(size, len(q), -1) for c in (q, own))
    order = rng.permutation(size)
    turned = m.with_dimensions({n: v[order] for n, v in batch.dimensions.items()})
    for many, expected in ((q, shared[order]), (own[order], apart[order])):
        found = solve(turned, many, threads=2)
        same(found, expected.reshape(found.shape), f"{of}, permuted, two threads")
    for i in range(size):
        alone = batch.design(i)
        both = np.concatenate([q, own[i]]), np.concatenate([shared[i], apart[i]])
        same(solve(alone, both[0]), both[1], f"{of}, design {i}")
    assert alone == m.with_dimensions({n: v[i] for n, v in batch.dimensions.items()})


@pytest.mark.parametrize("name", bits.NAMES)
def test_named(name: str) -> None:
    m, rng = bits.named(name), np.random.default_rng(1)
    q = coordinates(m, rng, bits.few(m), name)
    check_coordinates(m, q, rng, name)
    check_diagnostics(m, q, rng, name)
    for size in SIZES:
        check_batch(m, q[:13], rng, name, size)


@pytest.mark.parametrize("part", range(PARTS))
def test_random(part: int) -> None:
    for seed in range(part, COUNT, PARTS):
        m, rng = bits.random(seed), np.random.default_rng(seed)
        q = coordinates(m, rng, bits.few(m))
        check_coordinates(m, q, rng, f"seed {seed}")
        check_diagnostics(m, q, rng, f"seed {seed}")
        check_batch(m, q[: len(q) // 4], rng, f"seed {seed}", SIZES[seed % len(SIZES)])


@pytest.mark.parametrize("name", bits.NAMES)
def test_several_chunks_of_positions(name: str) -> None:
    m, rng = bits.named(name), np.random.default_rng(2)
    count = 600 if np.ndim(m.q0) else 3 * CHUNK - 5
    check_coordinates(m, coordinates(m, rng, count, name), rng, name, among=100)


@pytest.mark.parametrize("name", LARGE)
def test_several_chunks_of_designs(name: str) -> None:
    m, rng = bits.named(name), np.random.default_rng(3)
    check_batch(m, coordinates(m, rng, 21, name), rng, name, 1000)


def test_many_turns_of_several_drivers() -> None:
    m, rng = bits.named("model five_bar"), np.random.default_rng(4)
    check_coordinates(m, rng.uniform(-314.0, 314.0, (9, 2)), rng, "five_bar")


@pytest.mark.parametrize("near", [1e-12, 1e-3, 1.0])
def test_pin_in_two_guides_beside_where_they_are_parallel(near: float) -> None:
    """The loop of these guides closes at the ground's origin, which is not an unknown."""
    m = assur.Mechanism(
        joints={"O": (0, 0), "P": (1.5, 1)},
        links={"ground": "O", "crank": "O", "block": "P", "cursor": "P"},
        slides={
            "slot": assur.Slide("block", on="crank", angle=0.0),
            "rail": assur.Slide("cursor", on="ground", angle=1.0, origin="O"),
        },
        driver="crank",
    )
    q = np.array([1.0 + near] * 8 + [0.2] * 9)
    same(solve(m, q), np.concatenate([solve(m, one) for one in q]), "in one")
    condition = m.solve(q, on_error="nan").condition
    assert len(np.unique(condition)) == 2
    # Where rounding cannot distinguish them from parallel guides there are no analogues.
    status = m.solve(q, on_error="nan").status
    assert ((status == assur.Status.SINGULAR) == (np.abs(np.sin(q - 1.0)) < 2.0**-24)).all()


@pytest.mark.parametrize("designs", [7, 8, 9, 100])
def test_designs_beside_invalid_ones(designs: int) -> None:
    rng = np.random.default_rng(designs)
    rocker = np.where(rng.random(designs) < 0.3, -1.0, rng.uniform(1.0, 3.0, designs))
    batch = assur.FourBar(1.0, rng.uniform(2.0, 4.0, designs), rocker, 3.0)
    q = rng.uniform(-20.0, 20.0, 13)
    whole = batch.solve(q, order=3, on_error="nan")
    assert ((whole.status == assur.Status.BAD_DIMENSION).all(axis=1) == (rocker < 0.0)).all()
    rows = bits.bits(whole).reshape(designs, len(q), -1)
    for i in np.flatnonzero(rocker > 0.0):
        same(solve(batch.design(int(i)), q), rows[i], f"design {i}")


def test_vector_instructions() -> None:
    assert "ASSUR_SIMD" not in os.environ, "there would be nothing to compare with"
    program = bits.__file__
    with (
        bits.elsewhere(program, COUNT, ASSUR_SIMD="baseline") as baseline,
        bits.elsewhere(program, COUNT, ASSUR_SIMD="avx2") as avx2,
    ):
        own = dict(bits.digests(COUNT))
        found = [process.communicate()[0] for process in (baseline, avx2)]
    for other in map(json.loads, found):
        assert other.keys() == own.keys()
        assert [name for name in own if other[name] != own[name]] == []
