"""Reactions of random machines: balance of every link, power, and an oracle with multipliers."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from models.machines.reaction_machines import reaction_case, redundant_reaction_case
from oracles.dynamics.multipliers import Reactions, unit_roundoff
from oracles.dynamics.reaction_shares import Compared, Worst
from support.samples import sample

if TYPE_CHECKING:
    import assur

MACHINES, CHUNK = sample(300, 1000), 50
# One machine of a hundred.
FEW = range(0, 1000, 97)
# In u κ of the largest force, moments by force × size (the requirement's own figure).
SHARE = 64.0
REDUNDANT = 60


@pytest.mark.parametrize("first", range(0, MACHINES, CHUNK))
def test_random_machines(first: int) -> None:
    """All classes, slides, several drivers, loads of all kinds."""
    worst = Worst()
    for seed in range(first, first + CHUNK):
        case = reaction_case(seed)
        machine: Any = case.machine
        where = case.q, case.speed, case.acceleration
        Compared(case, worst, machine.reactions(*where), machine.effort(*where))
    sys.stdout.write(f"{worst}\n")
    assert worst.greatest <= SHARE, str(worst)


@pytest.mark.parametrize("seed", FEW)
def test_one_position_is_any(seed: int) -> None:
    """A single position has no axis for positions, and the same numbers to the bit."""
    case = reaction_case(seed)
    machine: Any = case.machine
    many = machine.reactions(case.q, case.speed, case.acceleration)
    one = machine.reactions(*case.position(1))
    for joint, links in links_at(case.mechanism).items():
        for link in links:
            own = one.joint(joint, on=link)
            assert own.shape == (2,)
            np.testing.assert_array_equal(own, many.joint(joint, on=link)[1])
    for name in case.mechanism.slides:
        a, b = one.slide(name), many.slide(name)
        for field in ("normal", "moment", "along"):
            assert np.shape(getattr(a, field)) == ()
            np.testing.assert_array_equal(getattr(a, field), getattr(b, field)[1])
    np.testing.assert_array_equal(one.driver, many.driver[1])
    np.testing.assert_array_equal(one.shaking_force, many.shaking_force[1])
    np.testing.assert_array_equal(one.shaking_moment, many.shaking_moment[1])


@pytest.mark.parametrize("seed", FEW)
def test_along(seed: int) -> None:
    """Where on the guide one force does what the normal force and the moment do."""
    case = reaction_case(seed)
    machine: Any = case.machine
    found = machine.reactions(case.q, case.speed, case.acceleration)
    motion = case.mechanism.solve(case.q)
    for name in case.mechanism.slides:
        own, value = found.slide(name), motion.slide(name).value
        there = own.normal != 0.0
        assert not np.isfinite(own.along[~there]).any()
        value, aside = value[there], own.moment[there] / own.normal[there]
        bound = 4 * unit_roundoff() * (abs(value) + abs(aside))
        assert (abs(own.along[there] - (value + aside)) <= bound).all()


@pytest.mark.parametrize("seed", FEW)
def test_pins_are_in_balance(seed: int) -> None:
    """What the links at a joint do to each other sums to nothing."""
    case = reaction_case(seed)
    machine: Any = case.machine
    found = machine.reactions(case.q, case.speed, case.acceleration)
    for joint, links in links_at(case.mechanism).items():
        forces = [found.joint(joint, on=link) for link in links]
        total, size = sum(forces), sum(np.abs(f) for f in forces)
        assert (np.abs(total) <= 8 * unit_roundoff() * size).all()


@pytest.mark.parametrize("seed", range(REDUNDANT))
def test_redundant_machines(seed: int) -> None:
    """Determined reactions are given, the others are NaN and named."""
    case = redundant_reaction_case(seed)
    machine: Any = case.machine
    found = machine.reactions(case.q, case.speed, case.acceleration)
    condition = case.mechanism.solve(case.q).condition
    missing = 0
    for k in range(len(case.q)):
        known = Reactions(case.machine, *case.position(k))
        bound = SHARE * unit_roundoff() * float(condition[k]) * known.largest()
        for joint, links in known.links_at.items():
            for link in links:
                own = found.joint(joint, on=link)[k]
                if known.joint_is_determined(joint, link):
                    assert abs(complex(*own) - known.joint(joint, link)) <= bound, (joint, link)
                else:
                    assert np.isnan(own).all(), (joint, link)
                    missing += 1
        for name in case.mechanism.slides:
            own = found.slide(name)
            turns, across = known.slide_is_determined(name)
            for value, there, wanted, unit in (
                (own.normal[k], across, known.normal(name), 1.0),
                (own.moment[k], turns, known.moment(name), known.places.size),
            ):
                if there:
                    assert abs(value - wanted) <= bound * unit, name
                else:
                    assert np.isnan(value), name
                    missing += 1
        for i, value in enumerate(np.reshape(found.driver, (len(case.q), -1))[k]):
            assert known.driver_is_determined(i)
            assert abs(value - known.driver(i)) <= bound * known.places.size
    assert missing
    assert found.undetermined


def links_at(m: assur.Mechanism) -> dict[str, list[str]]:
    """Links at each joint that two or more share."""
    out = {joint: [n for n, own in m.links.items() if joint in own] for joint in m.joints}
    return {joint: links for joint, links in out.items() if len(links) > 1}
