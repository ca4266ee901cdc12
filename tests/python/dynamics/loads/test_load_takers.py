"""Which link takes a load at a joint of several links: the piston or block, else the first one."""

from __future__ import annotations

import math
import pickle
import re
import warnings
from typing import TYPE_CHECKING, Any, get_args

import numpy as np
import pytest

import assur
from assur import Damper, Force, JointFriction, Machine, Slide, SlideFriction, Spring
from assur.dynamics.forces.force_system import force_system
from assur.dynamics.loads.loads import BetweenPoints
from models.machines.every_load import missing

if TYPE_CHECKING:
    from pathlib import Path

PIN = {"B": JointFriction(0.2, 0.02)}
# q°, speed, driver, efficiency, normal, moment: 0.1, 0.35, (-800, 0) on the piston.
ENGINE = [
    (60, 1, -74.33975914, 0.9351252958, 192.3701292, 0.7719481170),
    (150, 1, -26.92104636, 0.8973682118, 111.4692941, -0.7648221677),
    (250, 1, 72.4977057, 0.9317434993, -232.0803164, -0.8210849956),
    (60, -1, -85.08696765, 0.9343041933, 217.2690956, -0.8159666669),
    (150, -1, -33.18998836, 0.9038870298, 119.6612467, 0.7879066886),
    (250, -1, 62.91605592, 0.9314099123, -214.5038736, 0.7752565643),
]


@pytest.mark.parametrize("case", ENGINE, ids=str)
def test_a_load_at_the_pistons_pin_is_on_the_piston(case: tuple[float, ...]) -> None:
    degrees, speed, driver, efficiency, normal, moment = case
    circles = {"O": (0.08, 0.02), "A": (0.08, 0.025), "B": (0.08, 0.012)}
    friction: Any = {name: JointFriction(*numbers) for name, numbers in circles.items()}
    friction["bore"] = SlideFriction(0.1, 0.06)
    machine = Machine(
        assur.SliderCrank(0.1, 0.35), loads=[Force("B", (-800.0, 0.0))], friction=friction
    )
    found = machine.reactions(np.radians(degrees), speed)
    np.testing.assert_allclose(found.driver, driver, rtol=1e-9)
    np.testing.assert_allclose(found.efficiency, efficiency, rtol=1e-9)
    np.testing.assert_allclose(found.slide("bore")[:2], [normal, moment], rtol=1e-9)


def friction_circle(q: float, load: float, circle: float) -> tuple[float, float]:
    """Torque and efficiency of a slider-crank whose piston's pin alone rubs, at crank speed −1.

    The line of the rod's force is turned from the rod by the angle whose sine is ρ/l, found by
    iteration of the moment that the pin's force makes.
    """
    crank, rod = 0.1, 0.3
    sine = crank * np.sin(q) / rod
    cosine = np.sqrt(1.0 - sine * sine)
    pin = np.array([crank * np.cos(q), crank * np.sin(q)])
    piston = np.array([pin[0] + rod * cosine, 0.0])
    # Both angles' rates at dq/dt = −1; the rod turns against the piston, which does not.
    rod_rate = crank * np.cos(q) / (rod * cosine)
    moment = 0.0
    for _ in range(200):
        # Force of the piston on the rod at B: (−load, y); the rod balances about A.
        arm = piston - pin
        y = (-arm[1] * load - moment) / arm[0]
        force = np.array([-load, y])
        moment = -np.sign(rod_rate) * circle * np.hypot(*force)
    torque = -(pin[0] * force[1] - pin[1] * force[0])
    bare = -(pin[0] * (-arm[1] * load / arm[0]) - pin[1] * -load)
    loss = circle * np.hypot(*force) * abs(rod_rate)
    return torque, 1.0 - loss / max(-bare + loss, bare)


def test_the_friction_circle_of_the_pistons_pin() -> None:
    machine = Machine(assur.SliderCrank(0.1, 0.3), loads=[Force("B", (-2000.0, 0.0))], friction=PIN)
    found = machine.reactions(np.pi / 3, speed=-1.0)
    torque, efficiency = friction_circle(np.pi / 3, 2000.0, 0.2 * 0.02)
    np.testing.assert_allclose(found.driver, -204.8167621208586, rtol=1e-13)
    np.testing.assert_allclose(found.efficiency, 0.9928690069549455, rtol=1e-13)
    np.testing.assert_allclose([found.driver, found.efficiency], [torque, efficiency], rtol=1e-12)
    assert found.joint("B", on="piston")[0] == 2000.0


def test_without_friction_the_pin_bears_the_load() -> None:
    loads = [Force("B", (-2000.0, 0.0))]
    found = Machine(assur.SliderCrank(0.1, 0.3), loads=loads).reactions(1.0)
    assert found.joint("B", on="piston")[0] == 2000.0
    on_piston = force_system(found, "piston", ()).forces
    (load,) = (force for force in on_piston if force.kind == "load")
    assert load.force.tolist() == [-2000.0, 0.0]


def levers(*names: str) -> assur.Mechanism:
    """Levers on the ground, each with a block on it; all blocks are on the pin of the crank."""
    joints = {"O": (0.0, 0.0), "A": (0.1, 0.05), "D": (0.0, -0.3), "E": (0.5, 0.2)}
    links = {"ground": ["O"], "crank": ["O", "A"]}
    slides = {}
    for pivot in names:
        (x, y), (px, py) = joints["A"], joints[pivot]
        links["ground"].append(pivot)
        links |= {f"block{pivot}": ["A"], f"lever{pivot}": [pivot]}
        angle = math.atan2(y - py, x - px)
        slides[pivot.lower()] = Slide(f"block{pivot}", on=f"lever{pivot}", angle=angle)
    used = {name: at for name, at in joints.items() if name in ("O", "A", *names)}
    return assur.Mechanism(used, links, driver="crank", slides=slides)


def test_a_block_on_a_lever_takes_the_load_of_its_pin() -> None:
    mechanism = levers("D")
    found, named = (
        Machine(mechanism, loads=[Force("A", (3.0, -9.0), on=on)]).reactions(0.3)
        for on in (None, "blockD")
    )
    np.testing.assert_array_equal(found.joint("A", on="crank"), named.joint("A", on="crank"))


def test_at_a_fixed_joint_the_first_link_takes_it() -> None:
    """A swinging guide on the ground is a block, but what is fastened to its pivot is fixed."""
    mechanism = assur.Mechanism(
        joints={"O": (0, 0), "A": (0.1, 0.0), "D": (0.4, -0.3)},
        links={"ground": "OD", "crank": "OA", "rod": "A", "guide": "D"},
        slides={"s": Slide("rod", on="guide", angle=-0.785)},
        driver="crank",
    )
    loads = [Spring("D", ("crank", (0.05, 0.02)), 100.0, 0.1)]
    found = Machine(mechanism, loads=loads).reactions(0.3)
    named = Machine(mechanism, loads=[Spring(("ground", (0.4, -0.3)), *rest(loads[0]))])
    np.testing.assert_allclose(
        found.joint("D", on="guide"), named.reactions(0.3).joint("D", on="guide"), rtol=1e-12
    )


def rest(spring: Spring) -> tuple[Any, ...]:
    return spring.second, spring.stiffness, spring.length


@pytest.mark.parametrize("kind", [Force, Spring, Damper])
def test_springs_and_dampers_follow_the_same_rule(kind: Any) -> None:
    slider = assur.SliderCrank(0.1, 0.35)
    ends: Any = {
        Force: lambda at: Force(at, (-50.0, 3.0)),
        Spring: lambda at: Spring(("ground", (0.6, 0.1)), at, 300.0, 0.1),
        Damper: lambda at: Damper(at, ("ground", (0.6, 0.1)), 20.0),
    }[kind]
    at_pin, on_piston = (
        Machine(slider, loads=[ends(at)], friction=PIN).reactions([0.4, 2.0], speed=3.0)
        for at in ("B", ("piston", (0.0, 0.0)))
    )
    np.testing.assert_allclose(at_pin.driver, on_piston.driver, rtol=1e-14)
    np.testing.assert_allclose(
        at_pin.joint("B", on="rod"), on_piston.joint("B", on="rod"), rtol=1e-14
    )


FOUR_BAR = assur.FourBar(1.0, 3.0, 2.5, 3.0)
RUBS = {name: JointFriction(0.1, 0.1) for name in "ABCD"}


GUESS = 'acts at joint "C", which has friction: "coupler" takes it, and the friction depends on '
WHICH = f"{GUESS}which link does; name the link, "
GUESSES: dict[str, Any] = {
    "a Force " + WHICH + 'on="coupler" or another one': Force("C", (1.0, 2.0)),
    "a Spring " + WHICH + "as a point (link, (x, y)) of it": Spring("C", "A", 10.0, 1.0),
    "a Damper " + WHICH + "as a point (link, (x, y)) of it": Damper("A", "C", 10.0),
}


def test_every_load_between_points_is_guessed() -> None:
    assert not missing(GUESSES.values(), get_args(BetweenPoints))


@pytest.mark.parametrize("said", GUESSES)
def test_a_guess_that_friction_depends_on_is_said(said: str) -> None:
    with pytest.warns(assur.AssurWarning, match=re.escape(said)) as heard:
        machine = Machine(FOUR_BAR, loads=[GUESSES[said]], friction=RUBS)
    assert len(heard) == 1
    assert heard[0].filename == __file__
    # Of what is made from it the user knows.
    machine.of(FOUR_BAR.with_dimensions({"coupler.length": [3.1, 3.2]})).design(1)
    pickle.loads(pickle.dumps(machine)).effort(0.4, speed=1.0)


def test_nothing_is_said_where_nothing_is_guessed() -> None:
    """Every warning is an error here."""
    for load in (
        Force("C", (1.0, 2.0), on="rocker"),
        Spring("A", ("rocker", (1.0, 0.0)), 1.0, 1.0),
    ):
        Machine(FOUR_BAR, loads=[load], friction=RUBS)
    Machine(FOUR_BAR, loads=[Force("C", (1.0, 2.0))])
    Machine(FOUR_BAR, loads=[Force("C", (1.0, 2.0))], friction={"B": RUBS["B"]})
    Machine(assur.SliderCrank(0.1, 0.3), loads=[Force("B", (-1.0, 0.0))], friction=PIN)


def test_of_two_blocks_on_a_pin_neither_is_meant() -> None:
    with pytest.warns(assur.AssurWarning, match='"crank" takes it'):
        Machine(levers("D", "E"), loads=[Force("A", (1.0, 2.0))], friction={"A": PIN["B"]})


def test_a_file_keeps_the_rule(tmp_path: Path) -> None:
    path = tmp_path / "press.toml"
    machine = Machine(assur.SliderCrank(0.1, 0.3), loads=[Force("B", (-2000.0, 0.0))], friction=PIN)
    machine.save(path)
    assert "on =" not in path.read_text().split("[[loads]]")[-1]
    loaded = assur.load(path)
    assert isinstance(loaded, Machine)
    assert isinstance(loaded.loads[0], Force)
    assert loaded.loads[0].on is None
    assert loaded.effort(1.0, speed=-1.0) == machine.effort(1.0, speed=-1.0)


def test_motion_without_friction_does_not_depend_on_it() -> None:
    slider = assur.SliderCrank(0.1, 0.3)
    bodies = {"piston": assur.Body(mass=2.0), "crank": assur.Body(inertia=0.01)}
    runs = [
        Machine(slider, bodies=bodies, loads=[Force("B", (-20.0, 0.0), on=on)]).run(
            t_end=0.5, q0=1.0
        )
        for on in (None, "rod", "piston")
    ]
    assert runs[0].q[-1] == runs[1].q[-1] == runs[2].q[-1]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert Machine(slider, loads=[Force("B", (-1.0, 0.0))]).effort(1.0) != 0.0
