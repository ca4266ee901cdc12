"""Reactions with friction, by the oracle: the known cases to their digits, and power."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from models.machines.friction_cases import friction_cases
from oracles.dynamics.friction_steps import WithFriction

LAST = 6e-10  # numbers are given to ten digits
CASES = {case.name: case for case in friction_cases()}


def same(found: Any, wanted: Any) -> None:
    size = float(np.linalg.norm(wanted))
    assert float(np.linalg.norm(np.subtract(found, wanted))) <= LAST * size, (found, wanted)


@pytest.mark.parametrize("name", CASES)
def test_known_cases(name: str) -> None:
    case = CASES[name]
    solved = WithFriction(case)
    same(solved.found.driver(), case.driver)
    if case.efficiency is not None:
        same(solved.efficiency, case.efficiency)
    for what, value in case.forces.items():
        kind, *rest = what.split()
        if kind == "normal":
            same(solved.found.normal(*rest), value)
        elif kind == "moment":
            same(solved.found.moment(*rest), value)
        else:
            force = solved.found.joint(kind, rest[-1])
            same((force.real, force.imag), value)
    # input = what the loads and inertia take + what friction takes
    balance = solved.input - solved.ideal_input - solved.loss
    assert abs(balance) <= 1e-12 * max(abs(solved.input), abs(solved.ideal_input))
