"""Work space kept from earlier calls changes no bit, whatever those requested."""

from __future__ import annotations

import pickle
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import pytest

from models.mechanisms import named_drawings
from net import bits

if TYPE_CHECKING:
    import assur
    from net.bits import Float

CALLS = 20
HIGHER = tuple(f"higher {name}" for name in named_drawings.HIGHER)


@dataclass(frozen=True)
class Request:
    """One request."""

    q: Float
    order: int
    outputs: tuple[str, ...]
    assembly: dict[str, int]
    threads: int
    size: int

    def bits_of(self, m: assur.Mechanism) -> bits.Bits:
        rng = np.random.default_rng(len(self.q) + self.size)
        batch = bits.designs(m, rng, self.size) if self.size else m
        return bits.bits(
            batch.solve(
                self.q,
                order=self.order,
                outputs=self.outputs,
                assembly=self.assembly,
                threads=self.threads,
                on_error="nan",
            )
        )


def requests(m: assur.Mechanism, rng: np.random.Generator, name: str) -> list[Request]:
    """A few sets of outputs, each asked for several times, among others."""
    outputs = [*m.joints, *m.links, *m.slides]
    sets = [tuple(rng.choice(outputs, rng.integers(1, 4), replace=False)) for _ in range(3)]
    found = []
    for _ in range(CALLS):
        signs = rng.choice([-1, 1], len(m.assembly))
        found.append(
            Request(
                bits.coordinates(m, rng, int(rng.choice([1, 7, 30])), name),
                int(rng.integers(0, 3)),
                tuple(str(of) for of in sets[rng.integers(len(sets))]),
                dict(zip(m.assembly, (int(sign) for sign in signs), strict=True)),
                int(rng.integers(1, 3)),
                int(rng.choice([0, 0, 5])),
            )
        )
    return found


def mechanism(name: str) -> assur.Mechanism:
    kind, _, own = name.partition(" ")
    return named_drawings.HIGHER[own]() if kind == "higher" else bits.named(name)


@pytest.mark.parametrize("name", [*bits.NAMES, *HIGHER])
def test_calls_after_others_give_the_bits_of_first_calls(name: str) -> None:
    m, rng = mechanism(name), np.random.default_rng(11)
    stored = pickle.dumps(m)
    for number, request in enumerate(requests(m, rng, name)):
        first = request.bits_of(pickle.loads(stored))
        assert np.array_equal(request.bits_of(m), first), (number, request)
