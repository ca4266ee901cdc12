"""What friction cannot be given, or asked for."""

from __future__ import annotations

import math
import pickle
from typing import Any

import numpy as np
import pytest

import assur
from assur import Body, JointFriction, Machine, SlideFriction, Torque
from assur.examples import loom

FOUR_BAR = assur.FourBar(1.0, 3.0, 2.5, 3.2)
PIN = {"C": JointFriction(0.1, 0.2)}


def machine(**friction: Any) -> Machine:
    return Machine(FOUR_BAR, loads=[Torque("rocker", 10.0)], friction=friction or PIN)


def three_cranks() -> Machine:
    """Three parallel cranks on one coupler: the middle one is redundant."""
    joints = {"A": (0, 0), "B": (1, 0), "C": (2, 0), "P": (0, 1), "Q": (1, 1), "R": (2, 1)}
    links = {"ground": "ABC", "first": "AP", "second": "BQ", "third": "CR", "coupler": "PQR"}
    one = assur.Mechanism(joints=joints, links=links, driver="first")
    return Machine(one, loads=[Torque("third", 1.0)], friction={"Q": JointFriction(0.1, 0.2)})


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: JointFriction(-0.1, 0.2), "JointFriction: coefficient is -0.1"),
        (lambda: JointFriction(0.1, math.nan), "JointFriction: radius"),
        (lambda: JointFriction(0.1, 0.2, static_coefficient=0.05), "below the coefficient 0.1"),
        (lambda: SlideFriction(0.1, 0.0), "length is 0"),
        (lambda: SlideFriction(0.1, -1.0), "length is -1"),
        (lambda: SlideFriction(0.1, 1.0, viscous=math.inf), "viscous"),
        (lambda: machine(Z=JointFriction(0.1, 0.2)), "Z"),
        (lambda: machine(rocker=SlideFriction(0.1, 0.2)), "rocker"),
        (lambda: machine(C=0.1), "an assur.JointFriction or SlideFriction is needed"),
        (lambda: Machine(FOUR_BAR, friction=[0.1]), "a mapping of joints"),  # type: ignore[arg-type]
        (lambda: machine().reactions(1.0), "friction needs sense="),
        (lambda: machine().reactions([0.5, 1.0], [1.0, 0.0]), "friction needs sense="),
        (lambda: machine().effort(1.0), "friction needs sense="),
        (lambda: machine().reactions(1.0, sense=0), "sense is 0"),
        (lambda: machine().reactions(1.0, sense=[1, 1]), "sense is"),
        (lambda: machine().self_locking(sense=0), "sense is 0"),
        (lambda: machine().self_locking(sense=1, speed=-1.0), "must agree"),
        (lambda: machine().self_locking(sense=1, n=0), "n is 0"),
        (lambda: machine().self_locking(sense=1, between=(1.0, 1.0)), "between"),
        (lambda: Machine(FOUR_BAR).self_locking(), "has no friction"),
        (lambda: three_cranks().reactions(1.5, 1.0), "redundant links"),
        (lambda: three_cranks().effort(1.5, 1.0), "redundant links"),
    ],
)
def test_refusals(call: Any, said: str) -> None:
    with pytest.raises(assur.InputError, match=said):
        call()


def test_a_joint_of_one_link_does_not_rub() -> None:
    one = assur.Mechanism(
        joints={"O": (0, 0), "A": (1, 0)}, links={"ground": "O", "rod": "OA"}, driver="rod"
    )
    with pytest.raises(assur.InputError, match='belongs to "rod" alone'):
        Machine(one, friction={"A": JointFriction(0.1, 0.2)})


def test_a_loom_of_class_iv() -> None:
    """Its pins depend on one another: some thousand paths are followed if friction is great."""
    one = loom()
    pins = [name for name in one.joints if sum(name in of for of in one.links.values()) > 1]
    bodies = {name: Body(mass=1.0, inertia=0.1) for name in one.links if name != "ground"}
    for coefficient, several in ((0.01, False), (0.8, True)):
        friction = {name: JointFriction(coefficient, 0.3) for name in pins}
        rubbing = Machine(one, bodies=bodies, loads=[assur.Gravity()], friction=friction)
        found = rubbing.reactions(one.q0, 1.0)
        assert several or len(found.solutions) == 1
        for each in found.solutions:
            for name in pins:
                link = [link for link, joints in one.links.items() if name in joints][1]
                size = coefficient * 0.3 * np.hypot(*each.joint(name, on=link))
                np.testing.assert_allclose(abs(each.joint_moment(name, link)), size, rtol=1e-9)


def test_pickles() -> None:
    rubbing = machine()
    found = rubbing.reactions([0.5, 1.0], 1.0)
    again = pickle.loads(pickle.dumps(found))
    np.testing.assert_array_equal(again.driver, found.driver)
    np.testing.assert_array_equal(again.safety, found.safety)
    assert len(again.solutions) == 1
    copied = pickle.loads(pickle.dumps(rubbing))
    assert copied.friction == rubbing.friction
    np.testing.assert_array_equal(copied.reactions(0.5, 1.0).driver, found.driver[0])


def test_designs_and_positions_keep_their_places() -> None:
    """A design that cannot be assembled, and one that is locked, leave the others alone."""
    lengths = np.array([4.985, 4.9, 9.0])
    batch = assur.FourBar(1.0, 4.5, 1.5, 4.9).with_dimensions({"ground.D.x": lengths})
    pins = {name: JointFriction(0.1, 1.0) for name in "ABCD"}
    pushed = Machine(batch, loads=[Torque("rocker", -100.0)], friction=pins)
    q = np.array([1.0, math.pi - 0.04])
    found = pushed.reactions(q, 1.0, on_error="nan")
    assert found.locked.tolist() == [[False, True], [False, False], [False, False]]
    assert np.isnan(found.driver).tolist() == [[False, True], [False, False], [True, True]]
    for k in range(2):
        for place in range(2):
            own = pushed.design(k).reactions(q[place], 1.0)
            np.testing.assert_array_equal(own.driver, found.driver[k, place])
    assert found.status[2].tolist() == [assur.Status.UNREACHABLE] * 2
