"""The same branches, folds and circuits, however a mechanism is described and wherever drawn."""

from __future__ import annotations

import random
import time
from typing import TYPE_CHECKING

import pytest

import assur
from campaigns import campaign_cases
from campaigns.checks.campaign_variants import variant_of
from models.mechanisms import mixed_models
from models.mechanisms.mechanism_data import arguments
from oracles.kinematics.variant_queries import same_curve
from oracles.kinematics.variant_results import Pairing

if TYPE_CHECKING:
    from models.mechanisms.mechanism_data import Description

# Of a curve with 26 branches that once took half a minute, with a margin for slow machines.
SECONDS = 15.0


def differences(d: Description, seed: str) -> list[str]:
    mechanism = assur.Mechanism(**arguments(d))
    variant = variant_of(d, mechanism, random.Random(seed))
    return list(same_curve(Pairing(d, mechanism, variant)))


@pytest.mark.parametrize(
    ("seed", "variant"),
    [
        (5, "5 1"),
        (6, "6 0"),
        (30, "30 1"),
        (426, "variants 426"),
        *((s, f"{s}") for s in (27, 102)),
    ],
)
def test_class_ii(seed: int, variant: str) -> None:
    """Ovals between two positions of the fan, and folds beside a pole."""
    assert not differences(campaign_cases.random_case(seed).description, variant)


@pytest.mark.parametrize("seed", [35, 39])
def test_above_class_ii(seed: int) -> None:
    """Branches that end at a pole, and an oval where a slide hardly moves."""
    assert not differences(mixed_models.mixed_case(seed).description, f"{seed} 0")


def test_a_fold_beside_a_joint_that_goes_to_infinity() -> None:
    """A branch of 1.1e-4 from a dead point to a pole: all ends but those at the poles are folds."""
    d = campaign_cases.random_case(6).description
    curve = assur.Mechanism(**arguments(d)).configuration_curve()
    assert len(curve.branches) == 8
    assert sum(abs(fold.q + 0.0179844989) < 1e-9 for fold in curve.folds) == 1
    # An open circuit has two ends, which no fold joins.
    open_ends = sum(2 for circuit in curve.circuits if not circuit.is_closed)
    assert 2 * len(curve.branches) - 2 * len(curve.folds) == open_ends


def test_a_curve_of_many_branches_takes_seconds() -> None:
    mechanism = assur.Mechanism(**arguments(mixed_models.mixed_case(1).description))
    start = time.process_time()
    curve = mechanism.configuration_curve()
    assert time.process_time() - start < SECONDS
    assert (len(curve.branches), len(curve.folds), len(curve.circuits)) == (26, 21, 7)
