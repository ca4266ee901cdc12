"""What is asked for besides, before, or by whom changes no bit of what is asked for."""

from __future__ import annotations

import copy
import json
import os
import pickle
from typing import TYPE_CHECKING

import numpy as np
import pytest

from net import bits, partial_requests
from net.test_function_of_q import same
from support.samples import sample

if TYPE_CHECKING:
    import assur
    from net.bits import Bits, Float

# Random mechanisms of every kind.
COUNT = sample(10, 1000)
PARTS = 10


def asked(m: assur.Mechanism, q: Float, order: int, names: list[str]) -> Bits:
    motion = m.solve(q, order=order, outputs=names, on_error="nan")
    return partial_requests.part(motion, order, names)


def check(m: assur.Mechanism, q: Float, seed: int, of: str) -> None:
    """Each request first of all, again, of copies, and of a design without its neighbours."""
    rng = np.random.default_rng(seed)
    fresh = pickle.dumps(m)
    motion = partial_requests.whole(m, q)
    for order, names in partial_requests.requests(m, rng):
        what = f"{of}, {names} to order {order}"
        expected = partial_requests.part(motion, order, names)
        first = pickle.loads(fresh)
        same(asked(first, q, order, names), expected, f"{what}, first of all")
        same(asked(first, q, order, names), expected, f"{what}, again")
        same(asked(copy.copy(first), q, order, names), expected, f"{what}, of a copy")
        same(asked(m, q, order, names), expected, f"{what}, after everything")
        i = int(rng.integers(partial_requests.DESIGNS))
        alone = expected.reshape(partial_requests.DESIGNS, len(q), -1)[i]
        same(asked(m.design(i), q, order, names), alone, f"{what}, design {i} alone")


@pytest.mark.parametrize("part", range(PARTS))
def test_parts_of_random_motions(part: int) -> None:
    for seed in range(part, COUNT, PARTS):
        for name, batch, q in partial_requests.cases(seed):
            check(batch, q, seed, name)


def test_a_link_alone_steps_across_the_gaps_of_later_dyads() -> None:
    """Found once: nobody saw a dyad open of which nothing was asked for."""
    (_, batch, _) = next(c for c in partial_requests.cases(18) if c[0] == "changing 18")
    q = np.random.default_rng(18).uniform(-2.0, 8.0, 400)
    motion = partial_requests.whole(batch, q)
    for name in batch.links:
        same(asked(batch, q, 0, [name]), partial_requests.part(motion, 0, [name]), name)


def test_knot_by_knot_gives_the_same_bits() -> None:
    """Angles too."""
    assert "ASSUR_CARE" not in os.environ, "there would be nothing to compare with"
    with bits.elsewhere(partial_requests.__file__, COUNT, ASSUR_CARE="knots") as knots:
        own = dict(partial_requests.digests(COUNT))
        found = json.loads(knots.communicate()[0])
    assert own.keys() == found.keys()
    assert not [name for name in own if own[name] != found[name]]
