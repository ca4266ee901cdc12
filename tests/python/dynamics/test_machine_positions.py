"""A machine solves its positions one by one, a motion in blocks: to the same analogues."""

from __future__ import annotations

import numpy as np
import pytest

import assur
import bits
import design_spaces

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
        machine = assur.Machine(m, {link: assur.Body(inertia=1.0)})
        found = machine.reduced_inertia(q, on_error="nan").value.reshape(8, 20, drivers, drivers)
        rate = motion.link(link).d1.reshape(8, 20, drivers)
        expected = rate[..., np.newaxis] * rate[..., np.newaxis, :]
        assert np.array_equal(np.isnan(found), np.isnan(expected)), link
        np.testing.assert_allclose(found, expected, rtol=ROUNDED, atol=0, err_msg=link)
