"""Special cases that an attack found: one-pin links, far designs, dead points, self-motion."""

from __future__ import annotations

import copy
import math
import pickle
from functools import partial
from typing import Any

import numpy as np
import pytest

import assur
from assemblies.test_loci import five_bar
from models.errors.refusals import refused

Slide, Mechanism = assur.Slide, assur.Mechanism


def one_pin_rocker() -> assur.Mechanism:
    """An inverted slider-crank whose rocker has the pin D alone: joints do not tell its angle."""
    b = (math.cos(0.7), math.sin(0.7))
    angle = math.atan2(b[1], b[0] - 2.0)
    return Mechanism(
        {"A": (0, 0), "B": b, "D": (2, 0)},
        {"ground": "AD", "crank": "AB", "block": ["B"], "rock": ["D"]},
        "crank",
        slides={"s": Slide("block", on="rock", angle=angle, origin="D")},
    )


def test_assemblies_that_joints_do_not_tell_apart() -> None:
    m = one_pin_rocker()
    for name, value in (("s", -2.0), ("rock", -0.3)):
        found = m.find(name, value)
        assert len(found) == 2
        for q, assembly in found:
            gap = float(m.solve(q, assembly=assembly)[name].value) - value
            assert abs(math.remainder(gap, math.tau) if name == "rock" else gap) < 1e-9
    one, other = m.assemblies(1.0)
    curve = m.configuration_curve()
    assert len(curve.branches) == 2
    assert curve.defects([(1.0, one), (2.0, other)]).circuit


@pytest.mark.parametrize("scale", [1e-9, 1e6])
def test_find_and_workspace_of_designs_unlike_the_drawing(scale: float) -> None:
    base = five_bar()
    lengths = {name: value * scale for name, value in base.dimensions.items()}
    m = base.with_dimensions(lengths)
    assert len(m.workspace("P", positions=12).boundary) == 6
    point = np.array([0.3, 1.1]) * scale
    found = m.find("P", (point[0], point[1]))
    assert len(found) == 4
    for q, assembly in found:
        there = m.solve(q, assembly=assembly).joint("P").value
        np.testing.assert_allclose(there, point, rtol=0.0, atol=1e-12 * scale)


def test_a_workspace_far_from_the_origin() -> None:
    base = five_bar()
    far = {name: (x + 1e6, y) for name, (x, y) in base.joints.items()}
    m = Mechanism(far, dict(base.links), base.driver)
    space = m.workspace("P", positions=12)
    assert len(space.boundary) == 6
    assert np.ptp(space.x) < 6.0


def test_a_slide_carried_farther_than_all_lengths() -> None:
    """Guides at a small angle: the limit is six times as far as the lengths say."""
    m = Mechanism(
        {"A": (-1.0, 3.0), "B": (-2.0, 3.0), "C": (2.0, 3.0)},
        {"ground": "A", "k": "AB", "b": "B", "o": "C"},
        "t",
        slides={
            "s": Slide("b", on="o", angle=0.3, origin="C"),
            "t": Slide("o", on="ground", angle=0.45202189551171257, origin="A"),
        },
    )
    ((low, high),) = m.limits().intervals.tolist()
    for q in (low + 1e-7, high - 1e-7):
        assert m.solve(q, on_error="nan").status < assur.Status.UNREACHABLE
    for q in (low - 1e-7, high + 1e-7):
        assert m.solve(q, on_error="nan").status == assur.Status.UNREACHABLE
    travel = m.extremes("t")
    assert (travel.min.value, travel.max.value) == pytest.approx((low, high), abs=1e-9)
    assert not m.configuration_curve().defects([(0.0, m.assembly)]).circuit


def test_a_slide_that_nothing_stops() -> None:
    m = Mechanism(
        {"A": (0, 0), "B": (1, 1), "C": (3, 1)},
        {"ground": "A", "k": "AB", "b": "B", "o": "C"},
        "t",
        slides={
            "s": Slide("b", on="o", angle=0.0, origin="C"),
            "t": Slide("o", on="ground", angle=0.0, origin="A"),
        },
    )
    assert m.limits().intervals.tolist() == [[-math.inf, math.inf]]
    travel = m.extremes("t")
    assert (travel.min.value, travel.max.value) == (-math.inf, math.inf)
    curve = m.configuration_curve()
    assert not curve.circuits[0].is_closed
    assert np.isfinite(curve.motion().q).all()


def test_a_coordinate_that_goes_to_infinity() -> None:
    """A tangent: the slide passes through infinity at a right angle."""
    tangent = Mechanism(
        {"A": (0, 0), "B": (1, 0.7)},
        {"ground": "A", "k": "A", "blk": "B", "sl": "B"},
        "k",
        slides={
            "a": Slide("blk", on="k", angle=math.atan2(0.7, 1.0)),
            "b": Slide("sl", on="ground", angle=math.pi / 2),
        },
    )
    found = tangent.extremes("b")
    assert (found.min.value, found.max.value) == (-math.inf, math.inf)
    assert math.cos(found.max.q) == pytest.approx(0.0, abs=1e-9)


def test_a_dead_point_half_a_turn_from_the_drawing() -> None:
    """A period must not be cut where the motion ends."""
    m = Mechanism(
        {"A": (2.0, 1.0), "B": (2.0, -1.0), "D": (3.0, 2.0), "E": (1.0, -2.0)},
        {"ground": "AD", "k": "AB", "b": "B", "r": "DE"},
        "r",
        slides={"s": Slide("b", on="r", angle=math.pi / 2, origin="D")},
    )
    assert {one.group for one in m.limits().dead_points} == {"II(k, b)"}
    assert m.extremes("s").max.value == pytest.approx(1.0, abs=1e-9)


def test_assemblies_lead_where_they_were_found() -> None:
    """A parallelogram behind another dyad: change points on the way from the drawing."""
    m = Mechanism(
        {"A": (1, 2), "B": (1, 0), "C": (2, 0), "D": (2, 2), "E": (0, 2), "F": (-3, -3)},
        {"ground": "AD", "k": "AB", "c": "BC", "r": "DCE", "l": "EF", "b": "F"},
        "s",
        slides={"s": Slide("b", on="ground", angle=0.0, origin="A")},
    )
    for q in np.linspace(-4.2, -3.4, 17).tolist():
        found = m.assemblies(q)
        assert len(found) == 4
        for assembly in found:
            assert assembly.joints is not None
            motion = m.solve(q, assembly=assembly, on_error="nan")
            for name, at in assembly.joints.items():
                np.testing.assert_allclose(motion.joint(name).value, at, rtol=0.0, atol=1e-6)


def test_self_motion_is_no_complete_list() -> None:
    with pytest.warns(assur.AssurWarning, match="moves while its driver is locked"):
        found = assur.FourBar(1.0, 3.0, 3.0, 1.0).assemblies(0.0)
    assert not found.is_complete
    with pytest.warns(assur.AssurWarning, match="moves while its driver is locked"):
        assur.SliderCrank(1.0, 1.0).find("bore", 0.0)


def test_answers_at_dead_and_change_points() -> None:
    parallel = assur.FourBar(1.0, 3.0, 1.0, 3.0)
    ((q, assembly),) = parallel.find("rocker", 0.0)
    rocker = parallel.solve(q, assembly=assembly, on_error="nan").link("rocker").value
    assert math.remainder(float(rocker), math.tau) == pytest.approx(0.0, abs=1e-6)
    double = assur.FourBar(3.0, 2.5, 2.0, 4.0)
    end = double.limits().dead_points[0].q
    there = float(double.solve(end + 1e-9, order=0).link("rocker").value)
    assert any(q == pytest.approx(end, abs=1e-6) for q, _ in double.find("rocker", there))
    # A dead point is an end of both assemblies: it is found once.
    ((q, _),) = assur.SliderCrank(1.0, 3.0).find("bore", 4.0)
    assert q == pytest.approx(0.0, abs=1e-6)


def test_the_drawing_belongs_to_its_curve() -> None:
    """Its circuit is narrower than the fan."""
    at = {
        "A": (0.16454532545677125, -2.9380044842126125),
        "B": (-0.7037207873855245, 1.3310391488824003),
        "C": (-1.6112317964205476, -0.1879888577205273),
        "D": (-1.2974440796422513, 0.13546091094969803),
        "E": (0.8775794357625246, 1.181923102446417),
        "F": (2.764318137100009, -0.711509707958975),
    }
    links = {"ground": "AD", "k": "AB", "c": "BC", "r": "DCE", "l": "EF", "b": "F"}
    guide = Slide("b", on="ground", angle=-1.3678132290110292, origin="A")
    m = Mechanism(at, links, "k", slides={"s": guide})
    assert not m.configuration_curve().defects([(float(np.array(m.q0)), m.assembly)]).circuit


def test_what_is_returned_can_be_copied() -> None:
    m = five_bar()
    space = m.workspace("P", positions=6)
    for again in (pickle.loads(pickle.dumps(space)), copy.deepcopy(space)):
        np.testing.assert_array_equal(again.count, space.count)
        np.testing.assert_array_equal(again.boundary[0].q, space.boundary[0].q)
        assert again.contains([0.3, 1.1])
    batch = assur.FourBar(1.0, 3.0, [2.4, 2.5], 3.2).limits()
    assert [one.period for one in batch] == [1, 1]
    index: Any = np.int64(0)
    assert batch[index].period == 1


BAD: list[Any] = [None, 3, 1.5, True, b"x", "\ud800", [1.0, 2.0], {}, object()]


@pytest.mark.parametrize("bad", BAD, ids=range(len(BAD)))
def test_what_is_no_name(bad: Any) -> None:
    m, two = assur.FourBar(1.0, 3.0, 2.5, 3.2), five_bar()
    for ask in (
        partial(m.find, bad, 1.0),
        partial(two.find, bad, [1.0, 1.0]),
        partial(two.workspace, bad, positions=4),
        partial(m.map, "assemblies", bad),
        partial(m.defects, [1.0], bad),
    ):
        with pytest.raises(assur.InputError):
            ask()
    for argument in ("joint", "drivers"):
        if bad is not None:
            with pytest.raises(assur.InputError):
                two.singular_loci(**{argument: bad}, positions=4)


def test_messages() -> None:
    m, two = assur.FourBar(1.0, 3.0, 2.5, 3.2), five_bar()
    refused(assur.InputError, "B along a curve", partial(two.workspace, "B", positions=6))
    refused(assur.InputError, "P.x", partial(two.find, "P.x", [1.0, 1.0]))
    refused(assur.InputError, "positions 2000", partial(two.workspace, "P", positions=10**9))
    over = {"rocker.length": [1.0, 2.0], "ground.D.x": [1.0, 2.0]}
    refused(assur.InputError, "q one position", partial(m.map, "assemblies", over, q=[0.5, 1.0]))
    refused(assur.InputError, "full rotation", partial(m.map, "full_rotation", over, q=1.0))
    refused(assur.InputError, "C finite", partial(m.defects, [1.0], {"C": [[np.nan, 1.0]]}))
    refused(assur.InputError, "B determine", partial(m.defects, [1.0], {"B": m.solve([1.0])["B"]}))
    space = two.workspace("P", positions=6)
    assert not space.contains([1e4, 0.0])
    assert m.assemblies([]) == []
