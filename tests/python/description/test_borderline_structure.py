"""Borderline mechanisms are not refused; sizes out of range are named as such."""

from __future__ import annotations

import contextlib
import math
from typing import Any

import numpy as np
import pytest

import assur
from models.errors.refusals import (
    BORE,
    FIVE,
    FIVE_LINKS,
    FOUR,
    JOINTS,
    LOCOMOTIVE,
    RODS,
    Table,
    build,
    engine,
    joint,
    link,
    oldham,
    slide,
    twice,
)


@pytest.mark.parametrize("size", [1e-300, 1e-170, 1e170, 1e300])
def test_sizes_beyond_reach_are_named_so(size: float) -> None:
    """Not as flat dyads: 1e-150 to 1e150 is what the design promises."""
    with pytest.raises(assur.StructureError) as caught:
        build(joints={name: (x * size, y * size) for name, (x, y) in JOINTS.items()})
    assert "collinear" not in str(caught.value)
    assert "1e-153" in str(caught.value) or "1e153" in str(caught.value)


@pytest.mark.parametrize("size", [1e-150, 1e-9, 1e9, 1e150])
def test_sizes_within_reach(size: float) -> None:
    m = build(joints={name: (x * size, y * size) for name, (x, y) in JOINTS.items()})
    np.testing.assert_allclose(
        m.solve(1.0).joint("C").value / size, build().solve(1.0).joint("C").value, rtol=1e-14
    )


@pytest.mark.parametrize("far", [1e5, 1e6, 1e7, 1e9, 1e12])
def test_a_far_coupler_point_changes_no_structure(far: float) -> None:
    m = build(**joint(P=(far, far)))
    assert m.structure.formula == "I(crank) → II(coupler, rocker)"
    assert m.solve(1.0, order=1).status <= assur.Status.NEAR_SINGULAR


@pytest.mark.parametrize("length", [1e4, 1e6, 1e7])
def test_long_four_bars_move(length: float) -> None:
    long = {"A": (0, 0), "B": (1, 0), "C": (length, 3.2), "D": (length, 0)}
    assert build(joints=long, links=FOUR).structure.mobility == 1


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize(
    "places",
    [
        {"A": (0, 0), "B": (1, 0), "C": (4, 0), "D": (2, 0)},  # four-bar in line
        {"A": (0, 0), "B": (1, 0), "C": (4, 0), "D": (3, 0)},  # parallelogram
        {"A": (0, 0), "B": (1, 0), "C": (2, 0), "D": (1, 0)},  # rhombus: B on D
    ],
)
def test_flat_drawings_with_the_assembly_named(places: Table, sign: int) -> None:
    m = build(joints=places, links=FOUR, assembly={"C": sign})
    assert dict(m.assembly) == {"C": sign}
    assert m.structure.mobility == 1
    assert m.solve(0.3).status == assur.Status.OK


def test_square_rhombus() -> None:
    m = build(joints={"A": (0, 0), "B": (0, 1), "C": (1, 1), "D": (1, 0)}, links=FOUR)
    np.testing.assert_allclose(
        m.solve(2.0).joint("C").value, [1 + np.cos(2.0), np.sin(2.0)], atol=1e-15
    )


def test_an_assembly_against_the_drawing_is_not_half_believed() -> None:
    """Refused with the dyad named, or the joints stand as assembled."""
    with contextlib.suppress(assur.StructureError):
        m = build(assembly={"C": -build().assembly["C"]})
        np.testing.assert_allclose(m.joints["C"], m.solve(m.q0).joint("C").value, rtol=1e-12)


@pytest.mark.parametrize(
    ("changed", "redundant"),
    [
        ({"joints": LOCOMOTIVE, "links": RODS}, {"third"}),
        ({"joints": LOCOMOTIVE, "links": RODS, "driver": "third"}, {"second"}),
        (
            {
                "joints": {**LOCOMOTIVE, "G": (0.5, 0), "H": (1.25, 1)},
                "links": {**RODS, "ground": "ADEG", "rod": "BCFH", "fourth": "GH"},
            },
            {"third", "fourth"},
        ),
        (link(again="BC"), {"again"}),
        (link(again="DC"), {"again"}),
        (engine(bore2=BORE), {"bore2"}),
        (engine(bore2=slide("piston", "ground", math.pi, "O")), {"bore2"}),
    ],
)
def test_redundant_but_movable(changed: Table, redundant: set[str]) -> None:
    m = build(**changed)
    assert m.structure.mobility == 1
    assert set(m.structure.redundant) == redundant
    near = m.solve(m.q0 + np.linspace(-0.3, 0.3, 7))
    assert (near.status == assur.Status.OK).all()
    assert near.residual.max() < 1e-14


@pytest.mark.parametrize("error", [1e-6, 1e-7, 2e-8])
def test_a_third_rod_that_does_not_fit_is_never_said_to_move(error: float) -> None:
    """Too small for the rank to show, but the closure of every position does."""
    m = build(joints=LOCOMOTIVE, links=RODS).with_dimensions({"third.length": 1.25 * (1 + error)})
    motion = m.solve([0.2, 1.2, 2.0], on_error="nan")
    assert (motion.status == assur.Status.UNREACHABLE).all()
    assert np.isnan(motion.joint("F").value).all()
    with pytest.raises(assur.PositionError, match=r'q = 1\.2.*"third" does not fit.*m') as caught:
        m.solve(1.2)
    assert caught.value.link == "third"


def test_two_drivers_for_two_four_bars() -> None:
    m = build(**twice(driver=["crank", "crank2"]))
    assert m.structure.formula == "I(crank, crank2) → II(coupler, rocker) → II(coupler2, rocker2)"


def test_doubled_five_bar_with_two_drivers_moves() -> None:
    m = build(joints=FIVE, links={**FIVE_LINKS, "again": "BC"}, driver=["left", "right"])
    assert m.structure.redundant == ("again",)
    assert m.structure.mobility_counted == 1


@pytest.mark.parametrize(
    "driver", ["crank", "rocker", "coupler", assur.Drive("rocker", relative_to="crank")]
)
def test_any_link_of_a_four_bar_drives(driver: Any) -> None:
    assert build(driver=driver).structure.mobility == 1


def test_links_with_one_joint_or_without_joints() -> None:
    assert build(**oldham(tongue2=slide("disc", "shaft2", 2.0, "O2"))).structure.cls == 2
    trammel = {
        "joints": {"B": (1, 0), "C": (0, 1)},
        "links": {"ground": [], "sx": "B", "sy": "C", "rod": "BC"},
        "slides": {"x": slide("sx", "ground", 0), "y": slide("sy", "ground", math.pi / 2)},
    }
    for driver in ("rod", "x"):
        assert build(**trammel, driver=driver).structure.mobility == 1


def test_the_ground_may_be_the_sliding_link() -> None:
    m = build(**engine(bore=slide("ground", "piston", 0.0, "B")))
    assert m.structure.groups[0].kind == "RRP"
