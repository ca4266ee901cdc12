"""Requests that ask for parts of what a motion holds, and (as a program) digests of all of it.

``ASSUR_CARE=knots python partial_requests.py 100`` traces every branch knot by knot.
"""

from __future__ import annotations

import hashlib
import json
import sys
from typing import TYPE_CHECKING

import numpy as np

import assur
from campaigns import campaign_cases
from models.mechanisms.mechanism_data import arguments
from net import bits, design_spaces

if TYPE_CHECKING:
    from collections.abc import Iterator

    from net.bits import Bits, Float

DESIGNS, POSITIONS = 12, 24
ORDERS = 4
# Names asked for together, at most, and how many such requests.
TOGETHER, REQUESTS = 3, 4


def cases(seed: int) -> Iterator[tuple[str, assur.Mechanism, Float]]:
    """Spaces of random mechanisms, whose designs mostly do not turn fully, with coordinates."""
    rng = np.random.default_rng(seed)
    turns = rng.uniform(-9.0, 15.0, POSITIONS)
    drawn = bits.random(seed)
    q = rng.uniform(-2.0, 8.0, (POSITIONS, *np.shape(drawn.q0)))
    yield f"seed {seed}", design_spaces.space(drawn, rng, DESIGNS), q
    yield f"crank {seed}", design_spaces.crank_space(seed, DESIGNS), turns
    slides = design_spaces.slide_space(seed, DESIGNS)
    yield f"slide {seed}", slides, slides.q0 + rng.choice([0.1, 0.5, 2.0, 4.0]) * turns / 12.0
    changing = assur.Mechanism(**arguments(campaign_cases.changing_case(seed).description))
    yield f"changing {seed}", design_spaces.space(changing, rng, DESIGNS), turns


def requests(m: assur.Mechanism, rng: np.random.Generator) -> Iterator[tuple[int, list[str]]]:
    """Every link alone, and some of everything; each of an order."""
    for name in m.links:
        yield int(rng.integers(ORDERS)), [name]
    names = [*m.joints, *m.links, *m.slides]
    for request in range(REQUESTS):
        some = rng.choice(names, rng.integers(min(TOGETHER, len(names))) + 1, replace=False)
        yield request % ORDERS, [str(name) for name in some]


def part(motion: assur.Motion, order: int, names: list[str]) -> Bits:
    """What the motion holds of these names up to an order, as `bits.bits` has it."""
    held = motion._results
    kinds = (held.joints, held.links, held.slides)
    arrays = [k[name][: order + 1] for k in kinds for name in sorted(names) if name in k]
    rows = [a.reshape(motion.status.size, -1) for derivatives in arrays for a in derivatives]
    together = np.concatenate(rows, axis=1)
    together[np.isnan(together)] = np.nan
    return np.concatenate([together.view(np.uint8), motion.status.reshape(-1, 1)], axis=1)


def whole(m: assur.Mechanism, q: Float) -> assur.Motion:
    return m.solve(q, order=ORDERS - 1, on_error="nan")


def digests(seeds: int) -> Iterator[tuple[str, str]]:
    """Of everything, a digest a design: islands that one tracer misses are few."""
    for seed in range(seeds):
        for name, batch, q in cases(seed):
            rows = bits.bits(whole(batch, q)).reshape(DESIGNS, -1)
            for design, row in enumerate(rows):
                yield f"{name}, {design}", hashlib.blake2b(row.tobytes()).hexdigest()


if __name__ == "__main__":
    json.dump(dict(digests(int(sys.argv[1]))), sys.stdout)
