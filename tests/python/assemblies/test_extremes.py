"""Extremes of coordinates, the inverse question, and other drivers from a position on."""

from __future__ import annotations

import math
import pickle
from typing import Literal

import numpy as np
import pytest

import assur
from assur import examples
from models.errors.refusals import refused
from models.mechanisms.assembly_models import CASES

# Printed numbers have twelve digits.
PRINTED = 2e-11


def test_slider_crank_stroke_and_time_ratio() -> None:
    bore = assur.SliderCrank(1.0, 3.0, 0.5).extremes("bore")
    assert bore.stroke == pytest.approx(2.03213529349, abs=PRINTED)
    assert bore.max == pytest.approx((3.96862696660, 0.125327831168), abs=1e-10)
    assert bore.min.value == pytest.approx(1.93649167310, abs=PRINTED)
    assert math.remainder(bore.min.q - 3.39427290873, math.tau) == pytest.approx(0.0, abs=1e-10)
    assert bore.time_ratio == pytest.approx(1.08450051374, abs=1e-9)


def test_rocker_swing_and_time_ratio() -> None:
    rocker = assur.FourBar(1.0, 4.0, 3.0, 4.5).extremes("rocker")
    for one, (value, q) in (
        (rocker.max, (2.41885840578, 3.86432690140)),
        (rocker.min, (1.72886110671, 0.634183840824)),
    ):
        assert one.value == pytest.approx(value, abs=PRINTED)
        assert math.remainder(one.q - q, math.tau) == pytest.approx(0.0, abs=1e-9)
    assert rocker.time_ratio == pytest.approx(1.05800798013, abs=1e-9)


def test_inverted_slider_crank_swings_by_a_third_of_half_a_turn() -> None:
    mechanism = assur.Mechanism(
        {"A": (0, 0), "B": (0, 1), "D": (2, 0)},
        {"ground": "AD", "crank": "AB", "block": "B", "rod": "D"},
        "crank",
        slides={"slot": assur.Slide("block", on="rod", angle=math.atan2(1, -2), origin="D")},
    )
    rod = mechanism.extremes("rod")
    assert rod.stroke == pytest.approx(math.pi / 3, abs=1e-10)
    assert rod.time_ratio == pytest.approx(2.0, abs=1e-9)


def test_extremes_at_dead_points() -> None:
    four_bar = assur.FourBar(3.0, 2.5, 2.0, 4.0)
    rocker = four_bar.extremes("rocker")
    q = four_bar.limits().intervals[0]
    dense = q[0] + (q[1] - q[0]) * (0.5 - 0.5 * np.cos(np.linspace(1e-7, np.pi - 1e-7, 20001)))
    values = four_bar.solve(dense).link("rocker").value
    assert rocker.max.value == pytest.approx(values.max(), abs=1e-6)
    assert rocker.max.value >= values.max() - 1e-12
    assert rocker.min.value == pytest.approx(values.min(), abs=1e-6)
    # Flat: crank, coupler and rocker form the triangle 3, 4.5, 4.
    angle = math.pi - math.acos((4.5**2 + 4.0**2 - 3.0**2) / (2 * 4.5 * 4.0))
    ends = [four_bar.extremes("C.x").min.value, four_bar.extremes("C.x").max.value]
    assert min(ends) <= 4.0 + 2.0 * math.cos(angle)
    assert four_bar.extremes("rocker", order=1).max.value == math.inf


@pytest.mark.parametrize("order", [0, 1, 2])
def test_extremes_of_analogues_against_dense_samples(order: int) -> None:
    for mechanism, name in (
        (assur.FourBar(1.0, 3.0, 2.5, 3.2), "C.x"),
        (assur.SliderCrank(1.0, 3.0, 0.5), "bore"),
        (assur.FourBar(1.0, 3.0, 2.5, 3.2), "coupler"),
    ):
        found = mechanism.extremes(name, order=order)
        motion = mechanism.solve(np.linspace(0.0, math.tau, 40001), order=max(order, 1))
        key = ("value", "d1", "d2")[order]
        if "." in name:
            values = getattr(motion.joint("C"), key)[:, 0]
        elif name == "bore":
            values = getattr(motion.slide(name), key)
        else:
            values = getattr(motion.link(name), key)
        for one, dense in ((found.max, values.max()), (found.min, values.min())):
            assert one.value == pytest.approx(dense, abs=1e-7)
            there = mechanism.solve(one.q, order=max(order, 1))
            own = there.joint("C") if "." in name else None
            quantity = own or (there.slide(name) if name == "bore" else there.link(name))
            again = getattr(quantity, key)
            assert float(again[0] if "." in name else again) == pytest.approx(one.value, abs=1e-12)
        assert found.max.value >= values.max() - 1e-12
        assert found.min.value <= values.min() + 1e-12


def test_a_link_that_goes_round_has_no_extremes() -> None:
    four_bar = assur.FourBar(1.0, 3.0, 2.5, 3.2)
    with pytest.raises(assur.InputError, match=r"'crank'.*turns fully.*order=1") as caught:
        four_bar.extremes("crank")
    assert caught.value.link == "crank"
    rate = four_bar.extremes("crank", order=1)
    assert (rate.min.value, rate.max.value) == (1.0, 1.0)


def test_find_a_piston_position() -> None:
    engine = assur.SliderCrank(1.0, 3.0, 0.5)
    found = engine.find("bore", 3.0)
    assert len(found) == 2
    for q, assembly in found:
        assert float(engine.solve(q, assembly=assembly).slide("bore").value) == pytest.approx(3.0)
        assert assembly == engine.assembly
    assert engine.find("bore", 5.0) == []
    # Behind the crank the other assembly is found, too.
    assert {one["B"] for _, one in engine.find("bore", -3.0)} == {-1}


def test_find_joints_and_angles_of_any_class() -> None:
    rng = np.random.default_rng(3)
    for kind, name in (("triad", "R.x"), ("triad", "plate"), ("IV", "8.y"), ("V", "K.x")):
        mechanism = CASES[kind][0](rng).mechanism
        joint, _, axis = name.rpartition(".")
        motion = mechanism.solve(mechanism.q0, order=0)
        if joint:
            value = float(motion.joint(joint).value["xy".index(axis)])
        else:
            value = float(motion.link(name).value)
        found = mechanism.find(name, value)
        assert any(abs(math.remainder(q - mechanism.q0, math.tau)) < 1e-9 for q, _ in found)
        for q, assembly in found:
            there = mechanism.solve(q, order=0, assembly=assembly)
            if joint:
                again = float(there.joint(joint).value["xy".index(axis)])
                assert again == pytest.approx(value, abs=1e-9)
            else:
                turned = float(there.link(name).value) - value
                assert math.remainder(turned, math.tau) == pytest.approx(0.0, abs=1e-9)


def five_bar() -> assur.Mechanism:
    # B1, P and B2 at q = (2, 1), first assembly.
    first = (0.8 * math.cos(2), 0.8 * math.sin(2))
    second = (1 + 0.7 * math.cos(1), 0.7 * math.sin(1))
    return assur.Mechanism(
        {
            "A1": (0, 0),
            "A2": (1, 0),
            "B1": first,
            "B2": second,
            "P": (0.679851549731, 1.15673843554),
        },
        {
            "ground": ["A1", "A2"],
            "l1": ["A1", "B1"],
            "l4": ["A2", "B2"],
            "l2": ["B1", "P"],
            "l3": ["B2", "P"],
        },
        ["l1", "l4"],
    )


def test_five_bar_by_the_place_of_its_point() -> None:
    mechanism = five_bar()
    found = mechanism.assemblies([2.0, 1.0])
    assert isinstance(found, assur.Assemblies)
    places = sorted(one.joints["P"] for one in found if one.joints)
    printed = [(0.597686864095, 0.140943632210), (0.679851549731, 1.15673843554)]
    np.testing.assert_allclose(places, printed, atol=PRINTED)
    place = (0.7, 0.9)
    answers = mechanism.find("P", place)
    assert len(answers) == 4
    for q, assembly in answers:
        at = mechanism.solve(q, order=0, assembly=assembly).joint("P").value
        np.testing.assert_allclose(at, place, atol=1e-12)
    assert mechanism.find("P", (5.0, 5.0)) == []


def test_with_driver_keeps_position_and_assembly() -> None:
    rng = np.random.default_rng(8)
    for kind, driver in (("triad", "l2"), ("IV", "l95"), ("triad, block on the ground", "guide")):
        mechanism = CASES[kind][0](rng).mechanism
        for assembly in mechanism.assemblies(mechanism.q0):
            drawn = mechanism.with_assembly(assembly)
            other = drawn.with_driver(driver)
            assert assembly.joints
            for name in mechanism.joints:
                np.testing.assert_allclose(other.joints[name], assembly.joints[name], atol=1e-11)
            back = other.with_driver("crank")
            assert back.q0 == pytest.approx(drawn.q0, abs=1e-11)
            assert pickle.loads(pickle.dumps(other)) == other
    engine = assur.SliderCrank(1.0, 3.0, 0.5)
    for q in (0.7, 4.0):
        piston = engine.with_driver("bore", q=q)
        assert piston.q0 == pytest.approx(float(engine.solve(q).slide("bore").value), abs=1e-14)
        np.testing.assert_allclose(piston.joints["A"], engine.solve(q).joint("A").value, atol=1e-12)
        step = piston.solve(float(piston.q0) + 1e-3)
        np.testing.assert_allclose(step.joint("A").value, piston.joints["A"], atol=5e-3)


def test_a_named_mechanism_whose_drawing_is_flat_for_the_driver() -> None:
    piston = assur.SliderCrank(1.0, 2.5, offset=-0.7).with_driver("bore")
    assert piston.structure.formula == "I(bore) → II(crank, rod)"
    refused(
        assur.StructureError,
        "collinear",
        lambda: assur.SliderCrank(1.0, 3.0).with_driver("bore", q=0.0),
    )


def test_four_bars_are_drawn_where_they_exist() -> None:
    modes: tuple[tuple[Literal["open", "crossed"], int], ...] = (("open", 1), ("crossed", -1))
    for mode, sign in modes:
        four_bar = assur.FourBar(3.0, 1.0, 2.5, 3.2, mode=mode)
        low, high = four_bar.limits().intervals[1]
        assert low < four_bar.q0 < high
        assert all(math.isfinite(x) for at in four_bar.joints.values() for x in at)
        assert four_bar.assembly["C"] in (-1, 1)
        b, c, d = (np.array(four_bar.joints[name]) for name in "BCD")
        (x, y), (u, v) = b - d, c - d
        side = x * v - y * u
        assert side * sign < 0.0
        plain = four_bar.solve(0.8)
        assert pickle.loads(pickle.dumps(four_bar)).solve(0.8).joint("C").value.tobytes() == (
            plain.joint("C").value.tobytes()
        )
    none = assur.FourBar(1.0, 1.0, 1.0, 5.0)
    assert none.limits().intervals.shape == (0, 2)


def test_a_change_point_in_the_middle_of_the_motion() -> None:
    # Crank + coupler = rocker + ground: flat at q = 0; the crank does not reach 90 degrees.
    four_bar = assur.FourBar(2.2, 1.2, 0.9, 2.5)
    assert not four_bar.limits().full_rotation
    for q in (0.3, -0.3, 6.1):
        found = four_bar.assemblies(q)
        assert len(found) == 2
        for assembly in found:
            assert assembly.joints is not None
            solved = four_bar.solve(q, order=0, assembly=assembly).joint("C").value
            np.testing.assert_allclose(solved, assembly.joints["C"], atol=1e-9)


def test_refusals() -> None:
    four_bar = assur.FourBar(1.0, 3.0, 2.5, 3.2)
    batch = four_bar.with_dimensions({"coupler.length": [3.0, 3.1]})
    refused(assur.InputError, "one design", lambda: batch.extremes("rocker"))
    refused(assur.InputError, "one design", lambda: batch.with_driver("rocker", q=1.0))
    refused(assur.InputError, '"C.x" or "C.y"', lambda: four_bar.extremes("C"))
    refused(assur.InputError, "order is 4", lambda: four_bar.extremes("C.x", order=4))
    refused(assur.InputError, "finite number", lambda: four_bar.find("rocker", math.nan))
    refused(assur.InputError, "one driver", lambda: five_bar().extremes("P.x"))
    refused(assur.InputError, "one driver", lambda: five_bar().limits())
    missing = assur.FourBar(1.0, 1.0, 1.0, 5.0)
    refused(assur.PositionError, "does not exist", lambda: missing.extremes("C.x"))


def test_dwells_of_a_slider_crank() -> None:
    bore = assur.SliderCrank(1.0, 3.0).extremes("bore")
    least, greatest = bore.dwells(0.01)
    for stretches, level in ((least, 2.01), (greatest, 3.99)):
        assert len(stretches) == 1
        values = assur.SliderCrank(1.0, 3.0).solve(stretches[0]).slide("bore").value
        np.testing.assert_allclose(values, level, atol=1e-12)
    assert greatest[0][0] == pytest.approx(-greatest[0][1], abs=1e-12)
    assert sum(least[0]) == pytest.approx(math.tau, abs=1e-12) or sum(least[0]) == pytest.approx(
        -math.tau, abs=1e-12
    )
    refused(assur.InputError, "tolerance is 0.0", lambda: bore.dwells(0.0))


def test_an_assembly_is_drawn() -> None:
    plt = pytest.importorskip("matplotlib.pyplot")
    mechanism = CASES["triad"][0](np.random.default_rng(3)).mechanism
    found = mechanism.assemblies(mechanism.q0)
    assert len(found) == 4
    for assembly in found:
        ax = mechanism.plot(assembly=assembly)
        drawn = np.concatenate(
            [
                (line.get_transform() - ax.transData).transform(line.get_xydata())
                for line in ax.lines
            ]
        )
        assert assembly.joints is not None
        x, y = assembly.joints["R"]
        assert np.hypot(drawn[:, 0] - x, drawn[:, 1] - y).min() < 1e-9
        plt.close(ax.figure)


@pytest.mark.parametrize("name", ["crank_rocker", "stephenson_1", "jansen_leg", "loom", "shaper"])
def test_dwells_contain_their_extreme(name: str) -> None:
    m = examples.ALL[name]()
    assert isinstance(m, assur.Mechanism)
    of = [*m.slides, *(link for link in m.links if link not in ("ground", "crank"))]
    count = 0
    for coordinate in of:
        found = m.extremes(coordinate)
        for tolerance in (0.002, 0.02, 0.2):
            dwells = found.dwells(tolerance)
            for end, stretches in zip((found.min, found.max), dwells, strict=True):
                assert stretches == sorted(stretches)
                if math.isfinite(end.value) and stretches:
                    low, high = min(stretches, key=lambda one: abs(sum(one) / 2.0 - end.q))
                    assert low <= end.q <= high, (coordinate, tolerance)
                    values = m.solve(np.linspace(low, high, 9))[coordinate].value
                    assert (np.abs(values - end.value) < tolerance * (1.0 + 1e-6)).all()
                    count += 1
    assert count > 5
