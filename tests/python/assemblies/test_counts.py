"""The number of assemblies of random groups, against a scan that knows nothing of them."""

from __future__ import annotations

import numpy as np
import pytest

from assembly_models import CASES, Case
from scan import count

# The sample of each kind; `make campaign` counts all.
SAMPLE = 12


def expected(case: Case) -> int:
    """The number that two scans agree on."""
    samples = 1500
    last = count(case.misfit, case.dyads, samples)
    while samples < 200_000:
        samples = 2 * samples + 1
        found = count(case.misfit, case.dyads, samples)
        if found == last and samples > 6000:
            return found
        last = found
    raise AssertionError("the scans do not agree")


@pytest.mark.parametrize("kind", CASES)
def test_counts_of_random_groups(kind: str) -> None:
    make, _ = CASES[kind]
    rng = np.random.default_rng(len(kind))
    for _ in range(SAMPLE):
        case = make(rng)
        found = case.mechanism.assemblies(case.mechanism.q0)
        assert found.complex_count == (case.complex_count,)
        assert found.is_complete, found.failures
        assert len(found) == expected(case), found
