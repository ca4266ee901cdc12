"""A machine solves its positions one by one, a motion in blocks: to the same analogues."""

from __future__ import annotations

import numpy as np
import pytest

import assur
from models.machines.reaction_machines import reaction_case
from net import bits, design_spaces

# Squares and their products are rounded, in another order: a few units in the last place.
ROUNDED = 8 * 2.0**-53


def space(name: str) -> assur.Mechanism:
    kind, seed = name.split()
    if kind == "slide":
        return design_spaces.slide_space(int(seed), 8)
    if kind == "crank":
        return design_spaces.crank_space(int(seed), 8)
    return design_spaces.space(bits.random(int(seed)), np.random.default_rng(int(seed)), 8)


@pytest.mark.parametrize("name", [f"{k} {s}" for s in range(6) for k in ("slide", "crank", "seed")])
def test_reduced_inertias_are_those_of_the_motion(name: str) -> None:
    m = space(name)
    drivers = int(np.prod(np.shape(m.q0)))
    q = np.random.default_rng(2).uniform(-0.8, 0.8, (20, *np.shape(m.q0))) + m.q0
    motion = m.solve(q, order=1, on_error="nan")
    for link in (link for link in m.links if link != "ground"):
        machine = assur.Machine(m, bodies={link: assur.Body(inertia=1.0)})
        found = machine.reduced_inertia(q, on_error="nan").value.reshape(8, 20, drivers, drivers)
        rate = motion.link(link).d1.reshape(8, 20, drivers)
        expected = rate[..., np.newaxis] * rate[..., np.newaxis, :]
        assert np.array_equal(np.isnan(found), np.isnan(expected)), link
        np.testing.assert_allclose(found, expected, rtol=ROUNDED, atol=0, err_msg=link)


@pytest.mark.parametrize("before", [1e-9, 1.275e-11, 2e-12])
def test_a_position_lost_beside_a_fold_has_no_moment(before: float) -> None:
    """It once had one, which depended on the positions asked for with it."""
    m = reaction_case(108).mechanism
    machine = assur.Machine(
        m, bodies={"L4": assur.Body(mass=1.0, inertia=0.1)}, loads=[assur.Gravity()]
    )
    q = 1.8877209835496425 - before
    lost = m.solve(q, on_error="nan").status > assur.Status.NEAR_SINGULAR
    for asked in ([q], [q, 1.5], [1.7, q]):
        found = machine.reduced_moment(asked, on_error="nan")
        assert np.isnan(found[asked.index(q)]) == lost
        assert np.isnan(found).sum() == lost


def test_positions_after_a_change_point_are_those_alone() -> None:
    """There a state is interpolated: even the ground in it is rounded."""
    m = assur.FourBar(1.0, 3.0, 1.0, 3.0)
    body, about = (
        assur.Body(mass=2.0, inertia=0.5, at=(0.3, 0.1)),
        assur.Body(mass=1.0, inertia=0.2),
    )
    machine = assur.Machine(
        m, bodies={"crank": body, "coupler": about, "rocker": body}, loads=[assur.Gravity()]
    )
    beside = np.pi + np.array([0.0, 1e-12, -3e-9, 2e-6, -1e-4, 5e-4])
    q = np.ravel(np.column_stack([beside, np.linspace(0.4, 2.9, len(beside))]))

    def numbers(at: np.ndarray) -> np.ndarray:
        inertia = machine.reduced_inertia(at)
        return np.stack([inertia.value, inertia.d1, machine.reduced_moment(at, 3.0)])

    alone = np.hstack([numbers(q[i : i + 1]) for i in range(len(q))])
    assert np.array_equal(numbers(q), alone)
