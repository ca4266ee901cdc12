"""Known signs change no bit of any later motion."""

from __future__ import annotations

import pickle
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import assur
from assur import _core
from models.mechanisms import named_drawings
from net import bits, design_spaces

NAMES = ("crank_rocker", "watt_six_bar", "stephenson_six_bar", "jansen_leg")
# Driven slides; several drivers; dyads of all kinds.
OTHERS = (
    *(f"slide {seed}" for seed in range(3)),
    *(f"seed {seed}" for seed in range(8)),
    "model five_bar",
)
ORDER = 1


def answers(batch: assur.Mechanism, q: bits.Float) -> list[bits.Bits]:
    """Bits of joints alone, then of everything, joints again, and of the mirrored assembly."""
    joints = [name for name in batch.joints if name not in batch.links["ground"]]
    mirrored = {name: -sign for name, sign in batch.assembly.items()}
    motions = [
        batch.solve(q, order=ORDER, outputs=joints, on_error="nan"),
        batch.solve(q, order=ORDER, on_error="nan"),
        batch.solve(q, order=ORDER, outputs=joints, on_error="nan"),
        batch.solve(q, order=ORDER, outputs=joints, assembly=mirrored, on_error="nan"),
    ]
    return [bits.bits(motion) for motion in motions]


def space(name: str, rng: np.random.Generator) -> assur.Mechanism:
    if name in NAMES:
        return design_spaces.space(named_drawings.CLASS_II[name](), rng, 300)
    kind, _, seed = name.partition(" ")
    if kind == "slide":
        return design_spaces.slide_space(int(seed), 60)
    one = bits.random(int(seed)) if kind == "seed" else bits.named(name)
    return design_spaces.space(one, rng, 12 if np.ndim(one.q0) else 60)


@pytest.mark.parametrize("name", NAMES + OTHERS)
def test_first_second_and_concurrent_calls_give_the_same_bits(name: str) -> None:
    rng = np.random.default_rng(5)
    batch = space(name, rng)
    q = rng.uniform(-7.0, 9.0, (23, *np.shape(batch.q0)))
    if isinstance(batch.driver, str) and batch.driver in batch.slides:
        q = batch.q0 + 0.2 * (q - 1.0)
    first = answers(batch, q)
    fresh = pickle.loads(pickle.dumps(batch))
    with ThreadPoolExecutor(4) as threads:
        shared = list(threads.map(lambda _: answers(fresh, q), range(4)))
    for again in [answers(batch, q), *shared]:
        for one, other in zip(first, again, strict=True):
            assert np.array_equal(one, other)
    assert np.array_equal(first[0], first[2])


def test_a_design_with_a_change_point_is_traced_every_time() -> None:
    """A parallelogram goes on as one through its change points, alone and in a batch."""
    batch = assur.FourBar(1.0, 3.0, 1.0, [3.0, 3.2])
    q = np.linspace(0.1, 12.0, 50)
    motions = [
        batch.solve(q, order=0, outputs=["C"], on_error="nan").joint("C").value for _ in range(3)
    ]
    for motion in motions:
        assert np.allclose(motion[0], np.stack([3.0 + np.cos(q), np.sin(q)], -1), atol=1e-9)


def test_too_many_designs_to_remember_are_refused() -> None:
    with pytest.raises(MemoryError, match=str(10**18)):
        _core.KnownSigns(10**18)
