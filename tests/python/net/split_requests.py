"""Coordinates solved all at once and in parts, and (as a program) digests of these motions.

``ASSUR_SIMD=baseline python split_requests.py 80`` solves 1 to 80 coordinates with other vector
instructions.
"""

from __future__ import annotations

import hashlib
import json
import sys
from typing import TYPE_CHECKING

import numpy as np

from models.mechanisms import named_drawings
from net import bits, design_spaces

if TYPE_CHECKING:
    from collections.abc import Iterator

    import assur
    from net.bits import Bits, Float

NAMED = ("crank_rocker", "engine", "whitworth", "jansen_leg")
SEEDS = (3, 10, 28)
SLIDES = (0, 1, 7)
DESIGNS = 5
ORDERS = 3


def cases() -> Iterator[tuple[str, assur.Mechanism]]:
    """Spaces of designs with all kinds of dyads and drivers; most have gaps."""
    rng = np.random.default_rng(6)
    for name in NAMED:
        yield name, design_spaces.space(named_drawings.CLASS_II[name](), rng, DESIGNS)
    for seed in SEEDS:
        yield f"seed {seed}", design_spaces.space(bits.random(seed), rng, DESIGNS)
    for seed in SLIDES:
        yield f"slide {seed}", design_spaces.slide_space(seed, DESIGNS)
    yield "five_bar", design_spaces.space(bits.named("model five_bar"), rng, DESIGNS)


def solve(m: assur.Mechanism, q: Float, order: int, threads: int) -> Bits:
    rows = bits.bits(m.solve(q, order=order, on_error="nan", threads=threads))
    return rows.reshape(DESIGNS, len(q), -1)


def check(m: assur.Mechanism, q: Float, order: int, counts: range, of: str) -> Bits:
    """Numbers of coordinates, on one thread and three, and split at random places."""
    rng = np.random.default_rng(order)
    whole = solve(m, q, order, 1)
    for count in counts:
        chosen = rng.permutation(len(q))[:count] if count % 2 else np.arange(count)
        found = solve(m, q[chosen], order, 1 + 2 * (count // 3 % 2))
        assert np.array_equal(found, whole[:, chosen]), f"{of}, {count} at once, order {order}"
    cuts = np.sort(rng.choice(np.arange(1, len(q)), min(4, len(q) - 1), replace=False))
    parts = [solve(m, some, order, 3) for some in np.split(q, cuts)]
    assert np.array_equal(np.concatenate(parts, axis=1), whole), f"{of}, cut at {cuts}"
    return whole


def digests(count: int) -> Iterator[tuple[str, str]]:
    for case, (name, m) in enumerate(cases()):
        q = np.random.default_rng(count).uniform(-4.0, 9.0, (count, *np.shape(m.q0)))
        if isinstance(m.driver, str) and m.driver in m.slides:
            q = m.q0 + (q - m.q0) / 4.0
        for order in range(ORDERS):
            # Every number: a third of them in each order, and another third of the next case.
            counts = range(1 + (case + order) % 3, count + 1, 3)
            own = check(m, q, order, counts, name)
            yield f"{name}, order {order}", hashlib.blake2b(own.tobytes()).hexdigest()


if __name__ == "__main__":
    json.dump(dict(digests(int(sys.argv[1]))), sys.stdout)
