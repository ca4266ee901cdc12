"""Periodic curves at coordinates of any size: those of the exact remainder within the period."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import assur
from assur import Machine, Table, Torque, flywheel

PHI = np.linspace(0.5, 0.5 + 2.0 * math.pi, 25)
MOMENT = 100.0 * np.sin(PHI) + 20.0 * np.cos(2.0 * PHI)
INERTIA = 5.0 + np.cos(PHI)
for column in (MOMENT, INERTIA):
    column[-1] = column[0]
FAR = [7.0, -3.0, 1000.5, -1e6, 1e9, 1e15, -1e16, 1e17, 1e18, -1e18, 1e22, 1e100, 1e300, -1e308]


def remainder(q: float) -> float:
    """The place in the first period, by whole numbers."""
    start, period = float(PHI[0]), float(PHI[-1]) - float(PHI[0])
    return start + float((Fraction(q - start)) % Fraction(period))


@pytest.mark.parametrize("q", FAR)
@pytest.mark.parametrize("curve", ["speed", "reduced_moment", "reduced_inertia", "work"])
def test_a_flywheels_curves_are_those_of_the_remainder(q: float, curve: str) -> None:
    f = flywheel.evaluate(PHI, MOMENT, INERTIA, flywheel=20.0, speed0=30.0)
    own, exact = getattr(f, curve)(q), getattr(f, curve)(remainder(q))
    assert own == pytest.approx(exact, rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("q", FAR)
def test_the_time_and_its_inverse_count_turns(q: float) -> None:
    f = flywheel.evaluate(PHI, MOMENT, INERTIA, flywheel=20.0, speed0=30.0)
    within = remainder(q)
    turns = (q - within) / (PHI[-1] - PHI[0])
    assert f.time(q) == pytest.approx(round(turns) * f.period + f.time(within), rel=1e-12)
    if abs(q) < 1e307:
        assert f.coordinate(f.time(q)) == pytest.approx(q, rel=1e-12)


@pytest.mark.parametrize("q", FAR)
def test_a_load_over_the_coordinate_is_that_of_the_remainder(q: float) -> None:
    crank = assur.SliderCrank(0.1, 0.4)
    machine = Machine(crank, loads=[Torque("crank", Table(PHI, MOMENT))])
    exact: Any = machine.reduced_moment(remainder(q))
    assert machine.reduced_moment(q) == pytest.approx(exact, rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("q", FAR)
def test_a_machine_of_a_table_is_that_of_the_remainder(q: float) -> None:
    machine = Machine.from_table(PHI, MOMENT, INERTIA)
    inertia, exact = machine.reduced_inertia(q), machine.reduced_inertia(remainder(q))
    assert inertia.value == pytest.approx(exact.value, rel=1e-12)
    assert inertia.d1 == pytest.approx(exact.d1, rel=1e-12, abs=1e-12)
    moment = machine.reduced_moment(remainder(q))
    assert machine.reduced_moment(q) == pytest.approx(moment, rel=1e-12, abs=1e-12)
