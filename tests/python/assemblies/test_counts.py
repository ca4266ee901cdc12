"""The number of assemblies of random groups, against a scan that knows nothing of them."""

from __future__ import annotations

import numpy as np
import pytest

from assembly_checks import expected
from assembly_models import CASES

# The sample of each kind; `make campaign` counts all.
SAMPLE = 12


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
