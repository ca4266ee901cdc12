"""A dragged joint is where the pointer holds it, and nothing else has moved."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from assur import examples
from assur.studio import document
from studio.asking import FOUR_BAR, PRESS, Reply, ask, refused


def drag(own: dict[str, Any], q: Any, joint: str, to: Any) -> Reply:
    return ask("drag", document=own, q=q, joint=joint, to=list(map(float, to)), rows=19, orders=2)


def places(own: dict[str, Any], q: Any) -> dict[str, Any]:
    mechanism = document.read_mechanism(own)
    motion = mechanism.solve(q, order=0)
    return {name: motion.joint(name).value for name in mechanism.joints}


def size(at: dict[str, Any]) -> float:
    return float(np.ptp(np.array(list(at.values())), axis=0).max())


# The locomotive's rods move only while several dimensions change together.
@pytest.mark.parametrize("name", [name for name in examples.ALL if name != "locomotive"])
def test_everywhere(name: str) -> None:
    own = ask("open", example=name)["document"]
    low, high = map(np.array, examples.RANGES[name])
    rng = np.random.default_rng(3)
    q = (low + 0.37 * (high - low)).tolist()
    before = places(own, q)
    # One joint of each, and one of the ground: each costs a turn.
    fixed = own["links"]["ground"]
    for joint in (fixed[0], next((j for j in before if j not in fixed), fixed[-1])):
        assert drag(own, q, joint, before[joint])["changed"] == []
        to = before[joint] + 0.02 * size(before) * rng.standard_normal(2)
        reply = drag(own, q, joint, to)
        after = places(reply["document"], reply["q"])
        for other, at in {**before, joint: to}.items():
            assert after[other] == pytest.approx(at, abs=1e-7 * size(before)), other


def test_only_its_links_change() -> None:
    q = 0.7
    to = places(FOUR_BAR, q)["C"] + [0.2, -0.1]
    reply = drag(FOUR_BAR, q, "C", to)
    assert reply["changed"] == ["coupler.length", "coupler.P.x", "coupler.P.y", "rocker.length"]
    assert reply["document"]["joints"] == FOUR_BAR["joints"]
    assert reply["q"] == q
    length = reply["document"]["dimensions"]["rocker.length"]
    assert length == pytest.approx(np.hypot(*(to - [4.8, 0.0])))
    named = {one["name"]: one["value"] for one in reply["dimensions"]}
    assert named["rocker.length"] == length


def test_the_crank_turns_with_its_pin() -> None:
    for turns in (0, 1, -2):
        q = 0.7 + turns * 2.0 * np.pi
        reply = drag(FOUR_BAR, q, "B", [np.cos(0.8) * 1.1, np.sin(0.8) * 1.1])
        assert reply["q"] == pytest.approx(0.8 + turns * 2.0 * np.pi)
        assert reply["document"]["dimensions"]["crank.length"] == pytest.approx(1.1)


def test_through_the_line_of_its_dyad() -> None:
    """On the other side it is drawn anew, for the dimensions are those of the old side too."""
    q = 0.7
    at = places(FOUR_BAR, q)
    along = (at["D"] - at["B"]) / np.hypot(*(at["D"] - at["B"]))
    arm = at["C"] - at["B"]
    mirrored = at["B"] + 2.0 * (arm @ along) * along - arm
    reply = drag(FOUR_BAR, q, "C", mirrored)
    assert "dimensions" not in reply["document"]
    after = places(reply["document"], reply["q"])
    assert after["C"] == pytest.approx(mirrored)
    assert after["P"] == pytest.approx(at["P"])


def test_dimensions_typed_before_are_kept() -> None:
    own = {**FOUR_BAR, "dimensions": {"rocker": {"length": 3.5}, "ground.D.x": 4.7}}
    reply = drag(own, 0.7, "P", [2.0, 4.0])
    kept = reply["document"]["dimensions"]
    assert (kept["rocker.length"], kept["ground.D.x"]) == (3.5, 4.7)
    assert set(reply["changed"]) == {"coupler.P.x", "coupler.P.y"}


def test_machines_keep_their_masses() -> None:
    reply = drag(PRESS, 1.0, "A", [0.06, 0.08])
    assert reply["document"]["bodies"] == PRESS["bodies"]
    assert document.read_machine(reply["document"]).loads


@pytest.mark.parametrize(
    ("joint", "to", "said"),
    [
        ("Q", [0, 0], "known are A, B, C, D, P"),
        ("C", [0], "two numbers"),
        ("C", "here", "a list of two numbers"),
        ("B", [0, 0], "length zero"),
    ],
)
def test_refused(joint: str, to: Any, said: str) -> None:
    error = refused("drag", document=FOUR_BAR, q=0.7, joint=joint, to=to)
    assert said in error["message"]


def test_parallel_rods_say_why() -> None:
    own = ask("open", example="locomotive")["document"]
    error = refused("drag", document=own, joint=own["links"]["ground"][0], to=[0.01, 0.02])
    # Rods as long as each other are what lets it move: with one drawn anew nothing does.
    assert (error["kind"], error["link"]) == ("immovable", "wheel1")
