"""Designs whose group folds during the homotopy from the drawing's dimensions to theirs."""

from __future__ import annotations

import numpy as np
import pytest

import assur
from assur import Status

# P4's group between the crank and the ground, and a dyad hung on one of its links.
JOINTS = {
    "1": (0.0, 0.0), "2": (0.35, 0.0), "3": (1.24, 0.99), "4": (0.75, 1.91), "5": (3.02, -0.73),
    "6": (2.45, 1.02), "7": (3.2, 2.24), "8": (1.85, 2.35), "9": (1.62, -1.11), "10": (4.28, 1.52),
}  # fmt: skip
FAR = {"l48.length": [1.2, 50.0]}  # the second is not reached
Q = np.linspace(0.0, 0.4, 21)


def with_dyad(driver: str = "crank") -> assur.Mechanism:
    links = {name: list(on) for name, on in assur.ClassIV(joints=JOINTS).links.items()}
    links["ground"].append("G")
    links |= {"r1": ["7", "K"], "r2": ["G", "K"]}
    joints = {**JOINTS, "G": (4.0, 3.0), "K": (4.2, 2.2)}
    return assur.Mechanism(joints=joints, links=links, driver=driver)


@pytest.mark.parametrize("order", [0, 2])
def test_a_design_that_is_not_reached_is_lost_and_the_others_are_not(order: int) -> None:
    m = with_dyad().with_dimensions(FAR)
    motion = m.solve(Q, order=order, on_error="nan")
    assert (motion.status == [[Status.OK], [Status.LOST]]).all()
    own = m.design(0).solve(Q, order=order)
    for name in m.joints:
        np.testing.assert_array_equal(motion.joint(name).value[0], own.joint(name).value)
        assert np.isnan(motion.joint(name).value[1]).all()
    assert "to these dimensions" in motion.explain((1, 0))
    with pytest.raises(assur.PositionError, match="to these dimensions") as caught:
        m.solve(Q)
    assert caught.value.design == (1,)


def test_other_methods_raise_the_same_error() -> None:
    m = with_dyad().with_dimensions(FAR)
    assert np.isnan(m.joints["K"][1]).all()
    assert np.isfinite(m.joints["K"][0]).all()
    motion = m.solve(Q, on_error="nan")
    assert np.isnan(motion.condition[1]).all()
    assert np.isnan(motion.sensitivity("crank.length").joint("K").value[1]).all()
    machine = assur.Machine(m, bodies={"r1": assur.Body(mass=1.0, inertia=0.1)})
    inertia = machine.reduced_inertia(Q, on_error="nan").value
    assert np.isfinite(inertia[0]).all()
    assert np.isnan(inertia[1]).all()
    with pytest.raises(assur.PositionError, match=r"design \(1,\): cannot track the assembly"):
        machine.reduced_inertia(Q)
    with pytest.raises(assur.PositionError, match="to these dimensions"):
        machine.design(1).run(0.1, 0.0, 1.0)


def test_several_drivers_are_lost_likewise() -> None:
    """Two cranks drive a triad, and a dyad hangs on it."""
    m = assur.Mechanism(
        joints={
            "A": (0, 0), "B": (1, 0.2), "C": (6, 0), "D": (5.2, 0.8), "E": (3, 5), "F": (1.6, 2.6),
            "G": (2.6, 2.2), "H": (2.2, 3.4), "I": (4.6, 3.2), "K": (5.4, 4.4), "L": (6.8, 3.0),
        },
        links={
            "ground": "ACEL", "crank": "AB", "other": "CD", "b": "BF", "c": "DG", "e": "EH",
            "triad": "FGH", "r1": ["H", "K"], "r2": ["L", "K"], "free": "IK",
        } | {"free": ["I", "K"]},
        driver=["crank", "other", "free"],
    )  # fmt: skip
    assert m.structure.cls == 3
    q = m.q0 + np.array([[0.0, 0.0, 0.0], [0.01, -0.02, 0.03]])
    wide = m.with_dimensions({"b.length": [m.dimensions["b.length"], 40.0]})
    assert (wide.solve(q, on_error="nan").status == [[Status.OK], [Status.LOST]]).all()
