"""Pairs that rest while others move: no friction by rounding, and none lost that is true."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import assur
from assur import Force, JointFriction, Machine, Slide, SlideFriction, Torque
from models.mechanisms.rigid_parts import RigidParts

Q = np.linspace(-3.0, 3.0, 60)


def one_body() -> assur.Mechanism:
    """Guides that are nearly parallel, and a dyad on them: all turns with the crank."""
    return assur.Mechanism(
        joints={"A": (-2.84, -1.94), "C": (-2.94, 0.46), "B": (-0.1, -1.29), "E": (1.34, 1.94)},
        links={"ground": "A", "crank": "BA", "p": "A", "q": "C", "u": "CE", "w": "BE"},
        driver="crank",
        slides={
            "s0": Slide("p", on="q", angle=0.587),
            "s1": Slide("q", on="crank", angle=0.585, origin="A"),
        },
    )


def test_a_pin_of_one_body_has_no_friction() -> None:
    load = Force("E", (0.0, -100.0), on="w")
    machine = Machine(one_body(), bodies={}, loads=[load], friction={"B": JointFriction(0.2, 0.3)})
    for speed, sense in ((1.0, None), (-7e3, None), (0.0, -1.0)):
        found = machine.reactions(Q, speed, sense=sense)
        np.testing.assert_array_equal(found.joint_moment("B", on="w"), 0.0)
        np.testing.assert_array_equal(found.losses["B"], 0.0)
        np.testing.assert_array_equal(found.safety, 1e6)
    bare = Machine(one_body(), bodies={}, loads=[load])
    np.testing.assert_array_equal(machine.effort(Q, speed=1.0), bare.reactions(Q).driver)
    locking = machine.self_locking()
    assert len(locking.locked) == len(locking.holding) == 0


def test_it_does_not_slow_a_run() -> None:
    bodies = {"w": assur.Body(mass=2.0, inertia=0.5)}
    runs = [
        Machine(one_body(), bodies=bodies, loads=[Torque("crank", 3.0)], friction=friction).run(
            t_end=1.0
        )
        for friction in ({}, {"B": JointFriction(0.2, 0.3)})
    ]
    np.testing.assert_allclose(runs[1].speed[-1], runs[0].speed[-1], rtol=1e-8)


COUNT = 60


@pytest.mark.parametrize("first", range(0, COUNT, 20))
def test_random_bodies_of_several_links(first: int) -> None:
    """Friction within a body changes nothing, whatever that in the pins between bodies is."""
    pairs = moving = 0
    for seed in range(first, first + 20):
        parts = RigidParts(seed, 1 + seed % 5)
        try:
            mechanism = parts.mechanism()
        except assur.AssurError:
            continue
        friction, between = frictions(parts, mechanism)
        loads: list[Any] = [Force(("rocker", (0.4, 0.3)), (30.0, -100.0))]
        loads += [Torque(body[-1], 25.0) for body in parts.bodies]
        q = mechanism.q0 + np.linspace(-0.2, 0.2, 5)
        with_all, with_few = (
            Machine(mechanism, bodies={}, loads=loads, friction=own).reactions(
                q, 1.0, on_error="nan"
            )
            for own in (friction, between)
        )
        known = np.isfinite(with_few.driver)
        condition = np.nanmax(mechanism.solve(q, on_error="nan").condition, initial=1.0)
        np.testing.assert_allclose(
            with_all.driver[known], with_few.driver[known], rtol=1e-13 * condition, err_msg=seed
        )
        for name in friction:
            if name not in between:
                np.testing.assert_array_equal(with_all.losses[name][known], 0.0, err_msg=str(seed))
                pairs += 1
            else:
                moving += int((with_all.losses[name][known] > 0.0).any())
    assert pairs > 20
    assert moving > 20


def frictions(parts: RigidParts, mechanism: assur.Mechanism) -> tuple[Any, Any]:
    """Friction in all pairs, and in those whose links do not all move as one."""
    friction: dict[str, Any] = {}
    between: dict[str, Any] = {}
    for name in mechanism.joint_names:
        links = [link for link, joints in mechanism.links.items() if name in joints]
        if len(links) > 1:
            friction[name] = JointFriction(0.01, 0.05)
            if not set(links) <= set(parts.moves_with(links[0])):
                between[name] = friction[name]
    for name, slide in mechanism.slides.items():
        friction[name] = SlideFriction(0.01, 0.2)
        assert slide.on in parts.moves_with(slide.link)
    # A pin between two bodies at which others are fast to one of them is left out.
    for name in list(between):
        links = [link for link, joints in mechanism.links.items() if name in joints]
        if len(links) > 2:
            del friction[name], between[name]
    return friction, between


@pytest.mark.parametrize("crank", [1e-3, 1e-6, 1e-9])
def test_small_true_speeds_have_friction(crank: float) -> None:
    """An eccentric moves a rocker by little: at D it turns at some `crank` rad per rad."""
    rubs = {name: JointFriction(0.1, 0.02) for name in "CD"}
    load = Torque("rocker", 1.0)
    machine = Machine(assur.FourBar(crank, 1.0, 1.2, 1.5), loads=[load], friction=rubs)
    q = np.linspace(0.1, 6.2, 40)
    motion = machine.mechanism.solve(q, order=1)  # type: ignore[union-attr]
    found = machine.reactions(q, speed=1.0)
    rates = {
        "C": motion.link("rocker").d1 - motion.link("coupler").d1,
        "D": motion.link("rocker").d1,
    }
    for name, rate in rates.items():
        # To the first order in the crank the rates are sinusoidal.
        assert 0.05 * crank < abs(rate).max() < 20.0 * crank
        moving = abs(rate) > 1e-3 * crank
        force = found.joint(name, on="rocker")
        moment = -np.sign(rate) * 0.1 * 0.02 * np.hypot(force[:, 0], force[:, 1])
        own = found.joint_moment(name, on="rocker")
        np.testing.assert_allclose(own[moving], moment[moving], rtol=1e-9)
        assert moving.sum() > 35


def test_a_long_chain_loses_no_friction() -> None:
    """Conditions multiply along ten dyads; their speeds stay true to many digits."""
    joints = {"O": (0.0, 0.0), "J0": (0.6, 0.8)}
    links: dict[str, list[str]] = {"ground": ["O"], "crank": ["O", "J0"]}
    friction = {}
    for i in range(1, 11):
        lean = 0.05 * math.sin(7.0 * i)
        joints |= {f"J{i}": (0.6 + i, 0.8 + lean), f"G{i}": (i + 0.3 * lean, lean - 0.2)}
        links |= {f"rod{i}": [f"J{i - 1}", f"J{i}"], f"rocker{i}": [f"G{i}", f"J{i}"]}
        links["ground"].append(f"G{i}")
        friction[f"J{i}"] = JointFriction(1e-4, 0.01)
    mechanism = assur.Mechanism(joints, links, driver="crank")
    machine = Machine(mechanism, loads=[Torque("rocker10", 1.0)], friction=friction)
    q = mechanism.q0 + np.linspace(-0.05, 0.05, 11)
    motion = mechanism.solve(q, order=1)
    assert motion.condition.max() > 1e3
    found = machine.reactions(q, speed=1.0)
    for i in range(1, 11):
        name, fast = f"J{i}", motion.link(f"rod{i}").d1
        loss = np.zeros(q.shape)
        for link in (f"rocker{i}", f"rod{i + 1}"):
            if link in links:
                force = found.joint(name, on=link)
                rate = abs(motion.link(link).d1 - fast)
                loss += 1e-6 * np.hypot(force[:, 0], force[:, 1]) * rate
        np.testing.assert_allclose(found.losses[name], loss, rtol=1e-9)
        assert (loss > 0.0).all()


@pytest.mark.parametrize("viscous", [0.0, 0.5])
def test_where_nothing_slides_safety_is_the_greatest(viscous: float) -> None:
    mechanism = assur.Mechanism(
        joints={"A": (0, 0), "B": (1, 0), "K": (0.4, 0.8)},
        links={"ground": "A", "crank": "AB", "u": "BK", "w": "AK"},
        driver="crank",
    )
    friction = {"K": JointFriction(0.1, 0.02, viscous=viscous)}
    for loads in ([], [Torque("crank", -1.0)]):
        found = Machine(mechanism, bodies={}, loads=loads, friction=friction).reactions(
            [0.5, 0.9], speed=1.0
        )
        np.testing.assert_array_equal(found.safety, 1e6)
        np.testing.assert_array_equal(found.locked, False)
        np.testing.assert_array_equal(found.residual, 0.0)
        assert len(found.solutions) == 1


@pytest.mark.parametrize("power", [-13, -8, 8, 10])
def test_the_window_of_rest_grows_with_the_size(power: int) -> None:
    """Of a named mechanism too, whose drawing has a size of its own."""

    def rubs(length: float, q: float) -> bool:
        machine = assur.Machine(
            assur.SliderCrank(0.13 * length, 0.37 * length),
            loads=[assur.Force("B", (-100.0, -30.0), on="piston")],
            friction={"bore": assur.SlideFriction(0.2, 0.1 * length)},
        )
        return float(machine.reactions(q, speed=1.0).slide("bore").friction) != 0.0

    for q in (-1e-10, -2e-12, -1e-12, -1e-13):
        assert rubs(1.0, q) == rubs(2.0**power, q), q
    assert rubs(1.0, -1e-10)
    assert not rubs(1.0, -1e-13)
