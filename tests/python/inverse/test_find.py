"""Every position at which a coordinate has a value: none is missing, each is once there."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from models.mechanisms.assembly_models import CASES
from oracles.kinematics.inverse_by_hand import by_assemblies, by_crossings
from support.samples import sample

if TYPE_CHECKING:
    from assur.kinematics.inverse.find import InverseSolution

# q of the same position, found in two ways, rad or m.
CLOSE = 1e-8


def value_of(m: assur.Mechanism, name: str, q: Any = None) -> float:
    motion = m.solve(m.q0 if q is None else q, order=0)
    joint, dot, axis = name.rpartition(".")
    if dot:
        return float(motion.joint(joint).value["xy".index(axis)])
    return float((motion.slide(name) if name in m.slides else motion.link(name)).value)


def same(found: list[InverseSolution], q: list[Any]) -> None:
    have = np.array([np.ravel(solution.q) for solution in found])
    want = np.array(q)
    assert have.shape == want.shape
    if len(want):
        # ±π is one angle.
        gaps = np.abs(np.angle(np.exp(1j * (have[:, None] - want[None])))).max(axis=-1)
        assert gaps.min(axis=1).max() < CLOSE
        assert gaps.min(axis=0).max() < CLOSE
    assert [np.ravel(one.q).tolist() for one in found] == sorted(have.tolist())


def random_four_bar(rng: np.random.Generator) -> assur.Mechanism:
    while True:
        lengths = rng.uniform(0.5, 3.0, 4)
        if 2.0 * lengths.max() < 0.95 * lengths.sum():
            a, b, c, d = lengths.tolist()
            return assur.FourBar(a, b, c, d, point=tuple(rng.uniform(-1.0, 1.0, 2)))


@pytest.mark.parametrize("seed", range(sample(12, 300)))
def test_four_bars_against_their_crossings(seed: int) -> None:
    rng = np.random.default_rng(seed)
    m = random_four_bar(rng)
    limits = m.limits()
    low, high = limits.interval if not limits.full_rotation else (-math.pi, math.pi)
    q = float(rng.uniform(low + 0.1 * (high - low), high - 0.1 * (high - low)))
    for name in ("rocker", "coupler", "C.x", "C.y", "P.x", "P.y"):
        value = value_of(m, name, q)
        found = m.find(name, value)
        same(found, by_assemblies(m, [name], [value]))
        crossings = by_crossings(m, name, value)
        # Beside a dead point of the crank samples may have missed some.
        assert 0 < len(crossings) <= len(found)
        for q, signs in crossings:
            assert any(
                abs(math.remainder(one.q - q, math.tau)) < CLOSE and dict(one.assembly) == signs
                for one in found
            )
        for solution in found:
            there = m.solve(solution.q, order=0, assembly=solution.assembly)
            joint, dot, axis = name.rpartition(".")
            if dot:
                again = float(there.joint(joint).value["xy".index(axis)])
                assert again == pytest.approx(value, abs=1e-11)
            else:
                turned = float(there.link(name).value) - value
                assert abs(math.remainder(turned, math.tau)) < 1e-11


@pytest.mark.parametrize("kind", CASES)
@pytest.mark.parametrize("seed", range(sample(2, 40)))
def test_higher_classes_against_a_mechanism_made_by_hand(kind: str, seed: int) -> None:
    m = CASES[kind][0](np.random.default_rng(seed)).mechanism
    fixed = m.links["ground"]
    joint = [name for name in m.joints if name not in fixed][-1]
    link = [name for name in m.links if name not in ("ground", m.driver)][-1]
    for name in (f"{joint}.x", f"{joint}.y", link):
        value = value_of(m, name)
        try:
            expected = by_assemblies(m, [name], [value])
        except assur.StructureError:
            continue  # drawn at a dead point of the inverse, or the link does not turn
        same(m.find(name, value), expected)


def test_a_five_bar_against_a_mechanism_made_by_hand() -> None:
    m = assur.examples.five_bar()
    for shift in ((0.0, 0.0), (0.03, -0.05), (-0.1, 0.02)):
        place = (m.joints["P"][0] + shift[0], m.joints["P"][1] + shift[1])
        found = m.find("P", place)
        assert len(found) == 4
        same(found, by_assemblies(m, ["P.x", "P.y"], place))
        for other in (
            m.find(["P.x", "P.y"], place),
            m.find(["P.y", "P.x"], (place[1], place[0])),
        ):
            assert isinstance(other, list)
            assert [one.assembly for one in other] == [one.assembly for one in found]
            np.testing.assert_allclose(
                [one.q for one in other], [one.q for one in found], rtol=0.0, atol=1e-12
            )


def test_the_pose_of_a_platform_with_three_drivers() -> None:
    m = assur.examples.platform_on_cranks()
    angle = float(m.solve(m.q0, order=0).link("platform").value)
    names = ["D.x", "D.y", "platform"]
    values = (*m.joints["D"], angle)
    found = m.find(names, values)
    assert len(found) == 8  # two elbows of each leg
    same(found, by_assemblies(m, names, values))
    assert any(np.allclose(one.q, m.q0, rtol=0.0, atol=1e-9) for one in found)
    moved = (values[0] + 0.1, values[1] - 0.05, angle + 0.2)
    for q, assembly in m.find(names, moved):
        there = m.solve(q, order=0, assembly=assembly)
        np.testing.assert_allclose(there.joint("D").value, moved[:2], rtol=0.0, atol=1e-11)
        turned = float(there.link("platform").value) - moved[2]
        assert abs(math.remainder(turned, math.tau)) < 1e-11


def test_drivers_that_slide_or_turn_against_another_link() -> None:
    engine = assur.SliderCrank(1.0, 3.0, 0.4)
    press = engine.with_driver("bore", q=3.2)
    for angle in (0.3, 1.2, 2.8):
        found = press.find("crank", angle)
        want = sorted(
            np.cos(angle) + s * np.sqrt(9.0 - (np.sin(angle) - 0.4) ** 2) for s in (-1, 1)
        )
        np.testing.assert_allclose([one.q for one in found], want, rtol=0.0, atol=1e-12)
    joint = assur.FourBar(1.0, 3.0, 2.5, 3.0).with_driver(
        assur.Drive("coupler", relative_to="crank"), q=1.0
    )
    own = joint.solve(joint.q0, order=0)
    value = float(own.link("rocker").value)
    found = joint.find("rocker", value)
    assert any(abs(one.q - float(joint.q0)) < 1e-9 for one in found)
    for q, assembly in found:
        again = joint.solve(q, order=0, assembly=assembly).link("rocker").value
        assert abs(math.remainder(float(again) - value, math.tau)) < 1e-11
    same(found, by_assemblies(joint, ["rocker"], [value]))


def test_double_positions_are_found_once_and_beyond_them_none() -> None:
    engine = assur.SliderCrank(1.0, 3.0)
    assert [round(q, 9) for q, _ in engine.find("bore", 4.0)] == [0.0]
    assert engine.find("bore", 4.0 + 1e-9) == []
    assert len(engine.find("bore", 4.0 - 1e-9)) == 2
    # The coupler curve's extremes are double, and simple positions are beside them.
    m = assur.FourBar(1.0, 3.0, 2.5, 3.0, point=(1.5, 1.0))
    ends = m.extremes("P.x")
    for value, outward in ((ends.max.value, 1e-9), (ends.min.value, -1e-9)):
        inside, outside = m.find("P.x", value - outward), m.find("P.x", value + outward)
        assert len(inside) == len(outside) + 2


def test_dimensions_of_the_design_and_not_of_the_drawing_count() -> None:
    m = assur.FourBar(1.0, 3.0, 2.5, 3.0, point=(1.5, 1.0))
    for change in ({"coupler.length": 3.2}, {"ground.D.x": 2.7, "ground.D.y": 0.2}):
        other = m.with_dimensions(change)
        for name in ("rocker", "P.x"):
            value = value_of(other, name, 1.0)
            found = other.find(name, value)
            assert any(abs(one.q - 1.0) < 1e-9 for one in found)
            same(found, [np.array([q]) for q, _ in by_crossings(other, name, value)])
    far = m.with_dimensions({"ground.A.x": 10.0, "ground.D.x": 13.0})
    np.testing.assert_allclose(
        [q for q, _ in far.find("P.x", 11.5)], [q for q, _ in m.find("P.x", 1.5)], atol=1e-12
    )


def test_only_so_many_are_kept() -> None:
    m = assur.FourBar(1.0, 3.0, 2.5, 3.0)
    other = m.with_dimensions({"coupler.length": 3.1})
    assert len(m.find("rocker", 1.9)) == len(other.find("rocker", 1.9)) == 2
    assert m.inverses is other.inverses
    assert list(m.inverses) == [("rocker",)]
    assert m.with_driver("rocker", q=1.0).inverses == {}


def with_sliding_pairs() -> dict[str, assur.Mechanism]:
    """Mechanisms whose inverse is a triad with a block on the ground, on the plate, or between."""
    rod = {"O": (0.0, 0.0), "A": (0.6, 0.8), "B": (3.4, 0.3), "P": (1.8, 1.6)}
    return {
        "slider-crank": assur.Mechanism(
            rod,
            {"ground": "O", "crank": "OA", "rod": "ABP", "piston": "B"},
            "crank",
            slides={"bore": assur.Slide("piston", on="ground", angle=0.1, origin="O")},
        ),
        "swinging block": assur.Mechanism(
            {"O": (0.0, 0.0), "A": (0.6, 0.8), "C": (2.4, 0.2), "P": (1.5, 1.3)},
            {"ground": "OC", "crank": "OA", "rod": "AP", "block": "C"},
            "crank",
            slides={"way": assur.Slide("block", on="rod", along=("A", "C"), origin="A")},
        ),
        "turning guide": assur.Mechanism(
            {"O": (0.0, 0.0), "A": (0.6, 0.8), "C": (1.4, -0.7), "P": (0.9, 1.9)},
            {"ground": "OC", "crank": "OA", "block": "AP", "guide": "C"},
            "crank",
            slides={"way": assur.Slide("block", on="guide", along=("C", "A"), origin="C")},
        ),
        "elliptic": assur.Mechanism(
            {"O": (0.0, 0.0), "A": (1.2, 0.0), "B": (0.0, 1.6), "P": (1.5, 1.9)},
            {"ground": "O", "x": "A", "y": "B", "bar": "ABP"},
            "along",
            slides={
                "along": assur.Slide("x", on="ground", angle=0.0, origin="O"),
                "up": assur.Slide("y", on="ground", angle=1.4, origin="O"),
            },
        ),
    }


@pytest.mark.parametrize("kind", with_sliding_pairs())
@pytest.mark.parametrize("axis", ["x", "y"])
def test_sliding_pairs_against_a_mechanism_made_by_hand(kind: str, axis: str) -> None:
    m = with_sliding_pairs()[kind]
    start = value_of(m, f"P.{axis}")
    count = 0
    for value in start + np.linspace(-0.4, 0.4, 9):
        found = m.find(f"P.{axis}", float(value))
        same(found, by_assemblies(m, [f"P.{axis}"], [float(value)]))
        for q, assembly in found:
            there = m.solve(q, order=0, assembly=assembly).joint("P").value["xy".index(axis)]
            assert float(there) == pytest.approx(value, abs=1e-11)
        count += len(found)
    assert count >= 9
