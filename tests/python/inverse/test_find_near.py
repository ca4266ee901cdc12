"""A position near another one, and positions followed along values, in one assembly."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import assur
from models.mechanisms.assembly_models import CASES

Status = assur.Status


def five_bar() -> Any:
    return assur.examples.five_bar()


def test_a_piston_goes_up_and_down() -> None:
    engine: Any = assur.SliderCrank(1.0, 3.0)
    values = 3.0 + 0.9 * np.sin(np.linspace(0.0, 20.0, 200))
    path = engine.find("bore", values, near=1.0)
    # The law of cosines: r² + x² − 2 r x cos q = l².
    want = np.arccos((1.0 + values**2 - 9.0) / (2.0 * values))
    np.testing.assert_allclose(path.q, want, rtol=0.0, atol=1e-12)
    assert (path.status == Status.OK).all()
    np.testing.assert_allclose(engine.find("bore", values, near=-1.0).q, -want, atol=1e-12)
    for value, q in zip(values[:5], want, strict=False):
        assert engine.find("bore", float(value), near=1.2).q == pytest.approx(q, abs=1e-12)


def test_beyond_the_reach_it_waits() -> None:
    engine: Any = assur.SliderCrank(1.0, 3.0)
    path = engine.find("bore", [3.9, 4.0, 4.1, 4.5, 4.0, 3.9, 3.0], near=1.0)
    gone = [False, False, True, True, False, False, False]
    assert np.isnan(path.q).tolist() == gone
    assert path.status.tolist() == [Status.UNREACHABLE if one else Status.OK for one in gone]
    # The dead centre itself is there, to the half of the digits that it leaves.
    np.testing.assert_allclose(path.q[[1, 4]], 0.0, atol=1e-6)
    np.testing.assert_allclose(path.q[[5, 0]], path.q[0], atol=1e-12)
    assert path.q[-1] == pytest.approx(math.acos(1.0 / 6.0), abs=1e-12)
    with pytest.raises(assur.PositionError, match=r"bore = 4.1 is not reached"):
        engine.find("bore", 4.1, near=1.0)


def test_a_start_at_a_fold() -> None:
    engine: Any = assur.SliderCrank(1.0, 3.0)
    path = engine.find("bore", [4.0, 3.9, 3.0], near=0.0)
    assert np.isfinite(path.q).all()
    assert abs(path.q[-1]) == pytest.approx(math.acos(1.0 / 6.0), abs=1e-12)
    assert abs(engine.find("bore", 3.0, near=0.0).q) == pytest.approx(math.acos(1.0 / 6.0))


def test_a_whole_turn_and_more() -> None:
    """Angles of the driver and of the link go on without jumps."""
    m: Any = assur.FourBar(3.0, 2.5, 3.0, 1.0)  # a double crank
    q = np.linspace(0.5, 20.0, 300)
    rocker = m.solve(q, order=0).link("rocker").value
    np.testing.assert_allclose(m.find("rocker", rocker, near=0.5).q, q, rtol=0.0, atol=1e-10)
    folded = np.angle(np.exp(1j * rocker))
    np.testing.assert_allclose(m.find("rocker", folded, near=0.5).q, q, rtol=0.0, atol=1e-10)


def test_a_rocker_that_swings_by_more_than_half_a_turn() -> None:
    """The shorter way to the other end is barred: it goes back as it came."""
    m = assur.FourBar(2.7, 1.9, 1.2, 1.6)
    q = np.array([-0.75, 1.5, -0.5])
    rocker = m.solve(q, order=0).link("rocker").value
    assert abs(rocker[1] - rocker[0]) > 1.2 * math.pi
    path: Any = m.find("rocker", rocker, near=-0.75)
    np.testing.assert_allclose(path.q, q, rtol=0.0, atol=1e-12)


def test_a_robot_along_a_line() -> None:
    m = five_bar()
    start = np.array(m.joints["P"])
    points = start + np.linspace(0.0, 1.0, 400)[:, None] * [0.03, -0.06]
    path = m.find("P", points, near=m.q0)
    assert (path.status == Status.OK).all()
    np.testing.assert_allclose(path.q[0], m.q0, rtol=0.0, atol=1e-12)
    there = m.solve(path.q, order=0, assembly=path.assembly).joint("P").value
    np.testing.assert_allclose(there, points, rtol=0.0, atol=1e-14)
    # Of all positions it is the one that goes on from the one before.
    every = m.find("P", points)
    for k in (50, 200, 399):
        gaps = np.abs(every.q[k] - path.q[k]).max(axis=1)
        assert gaps.min() < 1e-10
        assert np.abs(every.q[k][gaps.argmin()] - path.q[k - 1]).max() < 0.05
    # One position after another is the same as all.
    q = np.asarray(m.q0)
    for point, want in zip(points[:20], path.q[:20], strict=True):
        q = np.asarray(m.find("P", point, near=q).q)
        np.testing.assert_allclose(q, want, rtol=0.0, atol=1e-12)


def test_the_assembly_is_kept() -> None:
    """The other elbows never appear, though the way there is shorter."""
    m = five_bar()
    place = (m.joints["P"][0] + 0.02, m.joints["P"][1] - 0.05)
    found = m.find("P", place)
    assert len({tuple(one.assembly.items()) for one in found}) == 2
    for solution in found:
        beside = np.asarray(solution.q) + 0.02
        own = m.solve(beside, order=0, assembly=solution.assembly).joint("P").value
        start = type(solution)(beside, solution.assembly)
        again = m.find("P", place, near=start)
        assert dict(again.assembly) == dict(solution.assembly)
        assert np.abs(own - place).max() > 1e-4
        np.testing.assert_allclose(again.q, solution.q, rtol=0.0, atol=1e-10)


def test_where_the_way_ends_the_nearest_is_found_once() -> None:
    """Two values, a fold between them: only the first position may be across it."""
    m: Any = assur.FourBar(1.0, 3.0, 2.5, 3.0, point=(1.5, 1.0))
    ends = m.extremes("P.x")
    inside = 0.5 * (ends.min.value + ends.max.value)
    path = m.find("P.x", [inside, ends.max.value + 0.1, inside], near=1.0)
    assert np.isnan(path.q).tolist() == [False, True, False]
    assert path.q[0] == pytest.approx(path.q[2], abs=1e-12)
    every = [q for q, one in m.find("P.x", inside) if one == m.assembly]
    assert min(abs(path.q[0] - q) for q in every) < 1e-10


def moving(kind: str) -> tuple[Any, str, Any, Any]:
    """Return the first random mechanism that moves well beside its drawing: a joint, q, its x."""
    for seed in range(20):
        m: Any = CASES[kind][0](np.random.default_rng(seed)).mechanism
        joint = [name for name in m.joints if name not in m.links["ground"]][-1]
        q = m.q0 + np.linspace(0.0, 0.02, 5)
        motion = m.solve(q, order=1, on_error="nan").joint(joint)
        rate = motion.d1[..., 0]
        if rate.min() > 1e-2 or rate.max() < -1e-2:  # neither NaN nor an extreme
            return m, joint, q, motion.value[..., 0]
    raise AssertionError(kind)


@pytest.mark.parametrize("kind", CASES)
def test_higher_classes(kind: str) -> None:
    m, joint, q, x = moving(kind)
    path = m.find(f"{joint}.x", x, near=m.q0)
    np.testing.assert_allclose(path.q, q, rtol=0.0, atol=1e-8)
    solution = next(one for one in m.find(f"{joint}.x", float(x[0])) if abs(one.q - m.q0) < 1e-9)
    again = m.find(f"{joint}.x", x, near=solution)
    np.testing.assert_allclose(again.q, q, rtol=0.0, atol=1e-8)
    assert again.assembly == solution.assembly


def test_a_platform_with_a_group_of_class_iii() -> None:
    m: Any = assur.examples.platform_on_cranks()
    q = np.asarray(m.q0) + np.linspace(0.0, 0.1, 6)[:, None] * [0.3, -0.2, 0.25]
    motion = m.solve(q, order=0)
    angle = motion.link("platform").value[:, np.newaxis]
    poses = np.concatenate([motion.joint("D").value, angle], axis=1)
    names = ["D.x", "D.y", "platform"]
    path = m.find(names, poses, near=m.q0)
    np.testing.assert_allclose(path.q, q, rtol=0.0, atol=1e-10)
    # A pose that the legs do not reach is left out.
    poses[2, 2] += 1.0
    path = m.find(names, poses, near=m.q0)
    assert path.status.tolist() == [0, 0, Status.UNREACHABLE, 0, 0, 0]
    reached = path.status == Status.OK
    np.testing.assert_allclose(path.q[reached], q[reached], rtol=0.0, atol=1e-10)
    assert np.isnan(path.q[2]).all()


def test_designs_and_sliding_drivers() -> None:
    engine: Any = assur.SliderCrank(1.0, [3.0, 3.5, 4.0])
    value = np.array([3.0, 3.2])
    path = engine.find("bore", value, near=1.0)
    rods = np.array([3.0, 3.5, 4.0])[:, np.newaxis]
    cosine = (1.0 + value**2 - rods**2) / (2.0 * value)
    np.testing.assert_allclose(path.q, np.arccos(cosine), rtol=0.0, atol=1e-12)
    each = engine.find("bore", value, near=[1.0, -1.0, 1.5])
    np.testing.assert_array_equal(each.q[[0, 2]], path.q[[0, 2]])
    np.testing.assert_allclose(each.q[1], -path.q[1], rtol=0.0, atol=1e-12)
    assert path[2, 1].q == path.q[2, 1]
    assert len(path) == 6
    assert [one.q for one in path] == path.q.ravel().tolist()
    press: Any = assur.SliderCrank(1.0, 3.0).with_driver("bore", q=3.0)
    angle = math.acos(1.0 / 6.0)
    turned = press.find("crank", [angle, angle + 0.2, angle - 0.3], near=3.0).q
    x = [math.cos(a) + math.sqrt(9.0 - math.sin(a) ** 2) for a in (angle, angle + 0.2, angle - 0.3)]
    np.testing.assert_allclose(turned, x, rtol=0.0, atol=1e-12)
    two: Any = assur.SliderCrank(1.0, [3.0, np.nan])
    bad = two.find("bore", [3.0, np.nan], near=1.0)
    assert bad.status.tolist() == [[0, Status.BAD_INPUT], [Status.BAD_DIMENSION] * 2]


def test_a_cylinder_as_driver() -> None:
    boom: Any = assur.Mechanism(
        {"O": (0, 0), "eye": (1, 0), "base": (0, -1)},
        {"ground": ("O", "base"), "boom": ("O", "eye")},
        "ram",
        slides={"ram": assur.Cylinder("base", "eye")},
    )
    angles = np.linspace(0.0, 0.9, 10)
    path = boom.find("boom", angles, near=boom.q0)
    want = 2.0 * np.sin(0.5 * (angles + 0.5 * np.pi))
    np.testing.assert_allclose(path.q, want, rtol=0.0, atol=1e-12)


def test_far_from_the_origin() -> None:
    at = {"A": (0, 0), "B": (0.3, 1), "P": (1.4, 2), "D": (2.5, 0.9), "E": (2, 0)}
    links = {"ground": "AE", "left": "AB", "rod": "BP", "arm": "DP", "right": "ED"}
    m: Any = assur.Mechanism(at, links, ["left", "right"])
    away = {name: (x + 2.0**27, y - 2.0**26) for name, (x, y) in at.items()}
    far: Any = assur.Mechanism(away, links, ["left", "right"])
    shift = np.array([2.0**27, -(2.0**26)])
    points = np.array([[1.4, 2.0], [1.5, 1.875], [1.625, 1.75]])
    path = far.find("P", points + shift, near=far.q0)
    assert path.status.tolist() == [Status.OK] * 3
    np.testing.assert_allclose(path.q, m.find("P", points, near=m.q0).q, rtol=0.0, atol=1e-6)


def test_refusals() -> None:
    m: Any = assur.SliderCrank(1.0, 3.0)
    for near, text in (
        ([1.0, 2.0], "near is"),
        (math.nan, "finite coordinates"),
        ("a", "near"),
        (None, None),
    ):
        if text is None:
            assert isinstance(m.find("bore", 3.0, near=near), list)
            continue
        with pytest.raises(assur.InputError, match=text):
            m.find("bore", 3.0, near=near)
    with pytest.raises(assur.InputError, match="2 numbers"):
        five_bar().find("P", (0.1, 0.4), near=1.0)
    other = assur.FourBar(1.0, 3.0, 2.5, 3.0).find("rocker", 1.9)[0]
    with pytest.raises(assur.InputError, match="assembly"):
        m.find("bore", 3.0, near=other)
