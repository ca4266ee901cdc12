"""Defects of designs in a batch, against what the signs and the circuits of four-bars say."""

from __future__ import annotations

from functools import partial

import numpy as np

import assur
from assemblies.test_numbers import triad
from models.errors.refusals import refused

NONE, CIRCUIT, BRANCH, ORDER, MISSING = (0, 1, 2, 4, 8)


def test_a_batch_of_four_bars() -> None:
    """Grashof: signs are circuits. Not Grashof: both signs are one circuit, and two branches."""
    rocker = np.array([2.5, 2.5, 2.0, 2.0, 2.0])
    four_bars = assur.FourBar(1.0, 3.0, 2.5, 3.2).with_dimensions(
        {
            "crank.length": np.array([1.0, 1.0, 3.0, 3.0, 3.0]),
            "coupler.length": np.array([3.0, 3.0, 2.5, 2.5, 2.5]),
            "rocker.length": rocker,
            "ground.D.x": np.array([3.2, 3.2, 4.0, 4.0, 4.0]),
        }
    )
    q = np.array([0.2, 0.5, 1.0])
    one = four_bars.solve(q).joint("C").value
    other = four_bars.solve(q, assembly={"C": -1}).joint("C").value
    c = one.copy()
    c[1, 1] = other[1, 1]
    c[3, 2] = other[3, 2]
    c[4, 0] += 0.01
    found = np.asarray(four_bars.defects(q, {"C": c}))
    np.testing.assert_array_equal(found, [NONE, CIRCUIT | BRANCH, NONE, BRANCH, MISSING])
    assert found.dtype == np.uint8
    for index in range(len(rocker)):
        assert four_bars.design(index).defects(q, {"C": c[index]}) == found[index]


def test_order_on_one_circuit() -> None:
    """Positions of a four-bar that turns, two of them exchanged: order needs four."""
    m = assur.FourBar(1.0, 3.0, 2.5, 3.2)
    q = np.array([0.2, 1.0, 2.0, 4.0])
    assert m.defects(q, {"C": m.solve(q).joint("C").value}) is assur.Defect.NONE
    mixed = q[[0, 2, 1, 3]]
    found = m.defects(mixed, {"C": m.solve(mixed).joint("C").value})
    assert found is assur.Defect.ORDER


def test_a_triads_three_circuits() -> None:
    m = triad()
    curve = m.configuration_curve()
    homes = [{number for number, _ in circuit.branches} for circuit in curve.circuits]
    q = float(np.array(m.q0))
    found = list(m.assemblies(q))
    names = tuple(m.joints)
    for one in found[:2]:
        for other in found[2:]:
            assert one.joints
            assert other.joints
            wanted = {n: np.array([one.joints[n], other.joints[n]]) for n in names}
            defect = m.defects([q, q], wanted)
            branches = curve.defects([(q, one), (q, other)]).branches
            apart = not any(set(branches) <= home for home in homes)
            assert bool(defect & assur.Defect.CIRCUIT) == apart
            assert bool(defect & assur.Defect.BRANCH) == (branches[0] != branches[1])


def test_refusals() -> None:
    m = assur.FourBar(1.0, 3.0, 2.5, 3.2)
    c = m.solve([0.1, 0.2]).joint("C").value
    refused(assur.InputError, "joints names", partial(m.defects, [0.1, 0.2], {}))
    refused(assur.InputError, "Z", partial(m.defects, [0.1, 0.2], {"Z": c}))
    refused(assur.InputError, "broadcast", partial(m.defects, [0.1, 0.2, 0.3], {"C": c}))
    refused(assur.InputError, "finite", partial(m.defects, [0.1, np.nan], {"C": c}))
    three = np.zeros((2, 3))
    refused(assur.InputError, "broadcast", partial(m.defects, [0.1, 0.2], {"C": three}))
    batch = m.with_dimensions({"rocker.length": [2.4, 2.5, 2.6]})
    refused(assur.InputError, "broadcast", partial(batch.defects, [0.1, 0.2], {"C": c[:, None]}))
