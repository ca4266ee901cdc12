"""What each load does to each link, beside wrenches written from the loads' definitions."""

from __future__ import annotations

import math

import numpy as np
import pytest

import assur
from assur import Force, Gravity, Machine, Pressure, Spring, Torque
from assur.dynamics.forces.force_system import force_system
from assur.dynamics.forces.load_forces import loads_of
from models.machines.reaction_machines import reaction_case
from oracles.dynamics.multipliers import Reactions, unit_roundoff

SEEDS = 30
# In u κ of the largest force: angles and places of a position are good to u κ.
LIMIT = 64.0


@pytest.mark.parametrize("seed", range(SEEDS))
def test_random_machines_load_their_links_as_the_oracle_says(seed: int) -> None:
    case = reaction_case(seed)
    m, loads = case.mechanism, case.machine.loads
    machine = Machine(
        m, bodies=case.machine.bodies, loads=[one for one in loads if not isinstance(one, Gravity)]
    )
    found = loads_of(machine.reactions(case.q, case.speed, case.acceleration))
    assert len(found) > 1
    condition = m.solve(case.q).condition
    for k in range(len(case.q)):
        of = Reactions(machine, *case.position(k))
        assert [one.link for one in found] == [wrench.link for wrench in of.loads]
        size, unit = of.places.size, LIMIT * unit_roundoff() * float(condition[k])
        for one, wrench in zip(found, of.loads, strict=True):
            assert abs(complex(*one.force[k]) - wrench.force) <= unit * of.largest()
            assert abs(one.couple[k] - wrench.couple) <= unit * of.largest() * size
            if one.place is not None:
                assert abs(complex(*one.place[k]) - wrench.place) <= unit * size


def test_a_pressure_pushes_both_links_of_its_slide_at_the_sliding_point() -> None:
    gas = Pressure("bore", 0.01, 3e5, "backward", ambient=1e5)
    slider = assur.SliderCrank(0.1, 0.4)
    machine = Machine(slider, loads=[Gravity(), gas])
    piston, ground = loads_of(machine.reactions([0.5, 2.0], speed=1.0))
    assert (piston.load, piston.link, piston.joint) == (1, "piston", "B")
    assert (ground.load, ground.link, ground.joint) == (1, "ground", None)
    np.testing.assert_allclose(piston.force, [[-2000.0, 0.0]] * 2, rtol=1e-15)
    np.testing.assert_array_equal(ground.force, -piston.force)
    place = slider.solve([0.5, 2.0]).joint("B").value
    np.testing.assert_array_equal(piston.place, place)
    np.testing.assert_array_equal(ground.place, place)


@pytest.mark.parametrize(("sense", "size"), [(1.0, 0.0), (-1.0, 300.0)])
def test_at_rest_a_load_of_one_sense_acts_as_the_drive_is_about_to_move(
    sense: float, size: float
) -> None:
    cut = Force("B", (300.0, 0.0), on="piston", while_="backward")
    machine = Machine(assur.SliderCrank(0.1, 0.4), loads=[cut])
    found = machine.reactions(1.0, sense=sense)
    (load,) = loads_of(found)
    np.testing.assert_array_equal(load.force, [size, 0.0])
    # What acts on the piston adds up to nothing, the load with it.
    forces = [one.force for one in force_system(found, "piston", ()).forces]
    np.testing.assert_allclose(sum(forces, np.zeros(2)), 0.0, atol=1e-12)


def test_where_a_position_is_not_solved_loads_are_nan() -> None:
    spring = Spring("C", ("ground", (0.0, 1.0)), 10.0, 0.1)
    machine = Machine(assur.FourBar(0.2, 0.1, 0.15, 0.22), loads=[spring, Torque("rocker", 3.0)])
    found = machine.reactions(np.linspace(0.0, 2.0 * math.pi, 9), on_error="nan")
    solved = found.status <= assur.Status.NEAR_SINGULAR
    assert solved.any()
    assert not solved.all()
    for one in loads_of(found):
        values = one.couple[:, np.newaxis] if one.place is None else one.force
        np.testing.assert_array_equal(np.isfinite(values).all(axis=-1), solved)
