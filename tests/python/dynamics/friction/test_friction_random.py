"""Friction in all pairs of random machines: balance, law, power, and no solution missed."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
import pytest

import assur
from models.machines.rubbing_machines import rubbing_case, with_friction
from oracles.dynamics.friction_law import STILL, FrictionLaw
from support.samples import sample

COUNT, CHUNK = sample(60, 1000), 20
STARTS = 200
# Forces are compared to this part of the largest, times the condition of the position.
CLOSE = 1e-11
# Beyond, a solution may be one of infinite friction: locked but for rounding.
HUGE = 1e6


def check(seed: int, counts: dict[str, int]) -> None:
    case, machine = rubbing_case(seed)
    where = case.position(0)
    law = FrictionLaw(case.machine, machine.friction, where)
    if (abs(law.rates) < STILL).any():
        return
    found = machine.reactions(*where, on_error="nan")
    solutions = found.solutions
    counts["none" if not solutions else "one" if len(solutions) == 1 else "several"] += 1
    assert found.locked == (not solutions)
    known = [friction_of(law, one) for one in solutions]
    for one, friction in zip(solutions, known, strict=True):
        assert one.residual <= 1e-11, seed
        solved = law.solve(law.loads(friction))
        close = CLOSE * solved.condition * solved.largest()
        forces = law._forces(solved)
        own = np.array([of_pair(one, rub) for rub in law.rubs])
        assert abs(forces - own).max() <= close, seed
        assert abs(np.subtract(drives(one), drives_of(solved))).max() <= close, seed
        sizes = law.sizes(forces)
        assert abs(friction + np.sign(law.rates) * sizes).max() <= 1e-9 * sizes.max() + close, seed
        # What the drive gives beyond what it gave without friction is what friction takes.
        loss = sum(one.losses.values())
        np.testing.assert_allclose(
            loss, (sizes * abs(law.rates)).sum(), rtol=1e-8, err_msg=str(seed)
        )
        power = np.dot(drives(one), np.atleast_1d(where[1]))
        bare = np.dot(drives_of(law.without), np.atleast_1d(where[1]))
        # 1e-10 of the powers that add up, times the condition that all forces have.
        most = max(abs(power), abs(bare), loss) * max(1.0, solved.condition)
        assert abs(power - bare - loss) <= 1e-10 * most, seed
    for other in law.search(np.random.default_rng(seed), STARTS):
        size = abs(other).max()
        if size > HUGE * law.sizes(law.base).max():
            continue
        near = [abs(other - friction).max() <= 1e-5 * size for friction in known]
        assert any(near), f"{seed}: {other} is not one of {known}"


def friction_of(law: FrictionLaw, found: Any) -> Any:
    return np.array(
        [
            found.slide(rub.name).friction
            if rub.is_slide
            else found.joint_moment(rub.name, rub.link)
            for rub in law.rubs
        ]
    )


def of_pair(found: Any, rub: Any) -> tuple[float, float]:
    if rub.is_slide:
        guide = found.slide(rub.name)
        return guide.normal, guide.moment
    x, y = found.joint(rub.name, on=rub.link)
    return x, y


def drives(found: Any) -> Any:
    return np.atleast_1d(found.driver)


def drives_of(solved: Any) -> Any:
    return np.array([solved.driver(k) for k in range(solved.q.size)])


@pytest.mark.parametrize("first", range(0, COUNT, CHUNK))
def test_random_machines(first: int) -> None:
    counts = dict.fromkeys(("one", "several", "none"), 0)
    for seed in range(first, first + CHUNK):
        check(seed, counts)
    sys.stdout.write(f"{counts}\n")
    assert counts["one"] > CHUNK // 3


def test_no_friction_is_the_limit() -> None:
    """The smaller the coefficients, the nearer the forces are to those without friction."""
    for seed in range(12):
        case, machine = rubbing_case(seed)
        where = case.position(0)
        bare = np.atleast_1d(case.machine.reactions(*where).driver)
        last = np.inf
        for part in (1e-4, 1e-6, 1e-8):
            small = {
                name: assur.SlideFriction(part * one.coefficient, one.length)
                if isinstance(one, assur.SlideFriction)
                else assur.JointFriction(part * one.coefficient, one.radius)
                for name, one in machine.friction.items()
            }
            own = with_friction(case.machine, small)
            off = abs(np.atleast_1d(own.reactions(*where).driver) - bare).max()
            assert off <= 0.02 * last
            last = max(off, 1e-13 * abs(bare).max() * 50)
