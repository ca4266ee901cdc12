"""Which group folds at a dead point: the first whose own coordinates turn infinitely fast."""

from __future__ import annotations

import random
from typing import TYPE_CHECKING

import numpy as np
import pytest

import assur
from models.mechanisms import higher_models, mixed_models
from models.mechanisms.mechanism_data import Description, arguments
from models.mechanisms.variants import Variant, shuffled

if TYPE_CHECKING:
    from collections.abc import Callable

    from models.mechanisms import dyad_models

# Toward a dead point rates grow as the inverse root of the distance: over these parts of the way to
# the drawing by 31.6. Those of groups that do not fold grow by less than a factor of 8.
BEFORE = np.array([1e-6, 1e-9])
GROWS = 8.0
ROMAN = ["0", "I", "II", "III", "IV", "V", "VI", "VII", "VIII", "IX", "X"]
KINDS: dict[str, Callable[[int], dyad_models.Case]] = {
    "mixed": mixed_models.mixed_case,
    "higher": higher_models.higher_case,
}


def name(group: assur.Group) -> str:
    return f"{ROMAN[group.cls]}({', '.join(group.links)})"


def folding(mechanism: assur.Mechanism, q: float) -> str | None:
    """In solving order: groups after the one that folds turn as fast, those before do not."""
    motion = mechanism.solve(q + BEFORE * (float(mechanism.q0) - q), on_error="nan", threads=1)
    for group in mechanism.structure.groups:
        rates = [motion.link(link).d1 for link in group.links]
        rates += [motion.slide(slide).d1 for slide in group.slides]
        far, near = np.abs(np.array(rates, np.float64)).T
        if (near > GROWS * np.maximum(far, 1e-9)).any():
            return name(group)
    return None


def check(d: Description) -> int:
    mechanism = assur.Mechanism(**arguments(d))
    points = mechanism.limits().dead_points if mechanism.structure.cls > 2 else []
    for point in points:
        assert point.group == folding(mechanism, point.q), point
    return len(points)


@pytest.mark.parametrize(
    ("kind", "seed"),
    [*(("mixed", seed) for seed in (1, 37, 52)), *(("higher", seed) for seed in (0, 1, 2, 4, 5))],
)
def test_the_group_that_folds_is_named_in_any_order(kind: str, seed: int) -> None:
    d = KINDS[kind](seed).description
    assert len(d.drivers) == 1, "limits are those of one driver"
    for turn in range(3):
        order = d if turn == 0 else shuffled(Variant.same(d), random.Random(turn)).description
        assert check(order) > 0


def test_groups_that_fold_in_random_mechanisms() -> None:
    many = sum(
        check(d)
        for d in (mixed_models.mixed_case(seed).description for seed in range(25))
        if len(d.drivers) == 1
    )
    assert many > 30


def test_the_reason_names_the_group_that_folds() -> None:
    d = mixed_models.mixed_case(1).description
    mechanism = assur.Mechanism(**arguments(d))
    end = mechanism.limits().dead_points[-1]
    text = mechanism.solve(end.q + 1e-4, on_error="nan").explain()
    assert "the motion of group II(L1, L3) ends at q" in text
    assert end.group == "II(L1, L3)"
    assert end.inner == "J2"
