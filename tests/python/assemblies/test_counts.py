"""The number of assemblies of random groups, against a scan that knows nothing of them."""

from __future__ import annotations

import random

import numpy as np
import pytest

import assur
from models.mechanisms.assembly_models import CASES
from models.mechanisms.mechanism_data import arguments
from models.mechanisms.mixed_models import mixed_case
from models.mechanisms.variants import Variant, shuffled
from oracles.kinematics.assembly_checks import expected

SAMPLE = 5  # of each kind; `make campaign` counts all


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


# Groups of ten and eleven links, a few of whose complex assemblies are ill-conditioned: with random
# dimensions, too, Newton's last step is then a million units in the last place.
@pytest.mark.parametrize(("seed", "count"), [(6009, 120)])
def test_counts_do_not_depend_on_the_listing(seed: int, count: int) -> None:
    same = Variant.same(mixed_case(seed).description)
    for v in (same, *(shuffled(same, random.Random(order)) for order in range(2))):
        m = assur.Mechanism(**arguments(v.description))
        found = m.assemblies(m.q0)
        assert found.complex_count == (count,)
        assert found.is_complete, found.failures
        assert len(found) == 4
