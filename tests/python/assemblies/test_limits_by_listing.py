"""Limits do not depend on the order in which links, joints and the joints of links are listed."""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
import pytest
from numpy.typing import NDArray

import assur
from assemblies.test_numbers import six_bar

if TYPE_CHECKING:
    from collections.abc import Iterator

Array: TypeAlias = NDArray[np.float64]

# Dead points are promised to this.
DEAD_POINT = 1e-10
JOINTS = {"A": (0.2, -0.1), "B": (3.0, 0.4), "C": (4.7, 1.9), "D": (4.2, 0.3)}
LINKS = {"ground": "AD", "crank": "AB", "coupler": "BC", "rocker": "DC"}
DRIVERS: list[str | assur.Drive] = [
    "crank",
    "rocker",
    "coupler",
    assur.Drive("ground", relative_to="crank"),
    assur.Drive("coupler", relative_to="crank"),
    assur.Drive("crank", relative_to="rocker"),
    assur.Drive("rocker", relative_to="coupler"),
]


def listings() -> Iterator[dict[str, str]]:
    """Every way to list the joints of the links."""
    for turned in itertools.product([False, True], repeat=len(LINKS)):
        yield {
            link: joints[::-1] if turn else joints
            for turn, (link, joints) in zip(turned, LINKS.items(), strict=True)
        }


def reached(m: assur.Mechanism, q: Array) -> Array:
    """Whether each position exists."""
    motion = m.solve(q, order=0, outputs=[], on_error="nan")
    return np.asarray(motion.status <= assur.Status.SINGULAR)


def agrees_with_positions(m: assur.Mechanism) -> None:
    """One interval holds the drawing, and positions exist within the intervals alone."""
    intervals = m.limits().intervals
    assert sum(low < m.q0 < high for low, high in intervals.tolist()) == 1, intervals
    q = float(m.q0) + np.linspace(-math.pi, math.pi, 721)
    shifted = q[:, None] + math.tau * np.array([-1, 0, 1])
    low, high = intervals.T
    inside = ((low <= shifted[..., None]) & (shifted[..., None] <= high)).any(axis=(1, 2))
    # At an end itself rounding decides.
    ends = intervals[np.isfinite(intervals)]
    apart = np.abs(np.remainder(q[:, None] - ends + math.pi, math.tau) - math.pi)
    clear = (apart > 1e-9).all(axis=1)
    assert (inside == reached(m, q))[clear].all()


@pytest.mark.parametrize("driver", DRIVERS, ids=str)
def test_a_four_bar_in_every_order(driver: str | assur.Drive) -> None:
    """The linkage is the same, so are its dead points; angles differ by half turns."""
    known: list[Array] = []
    for links in listings():
        m = assur.Mechanism(JOINTS, links, driver)
        agrees_with_positions(m)
        known.append(m.limits().intervals - m.q0)
        curve = m.configuration_curve()
        own = [b for c in curve.circuits for b, _ in c.branches]
        assert own
    for one in known[1:]:
        np.testing.assert_allclose(one, known[0], rtol=0.0, atol=DEAD_POINT)


@pytest.mark.parametrize("crank", ["AB", "BA"])
@pytest.mark.parametrize("order", list(itertools.permutations("ABCD"))[::5])
def test_dead_points_by_the_law_of_cosines(crank: str, order: tuple[str, ...]) -> None:
    joints = {name: JOINTS[name] for name in order}
    m = assur.Mechanism(joints, {**LINKS, "crank": crank}, "crank")
    a, b, c, d = (complex(*JOINTS[name]) for name in "ABCD")
    ground, radius, legs = abs(d - a), abs(b - a), abs(c - b) + abs(c - d)
    middle = math.atan2((d - a).imag, (d - a).real) + (math.pi if crank == "BA" else 0.0)
    half = math.acos((radius**2 + ground**2 - legs**2) / (2.0 * radius * ground))
    (found,) = m.limits().intervals
    turns = math.tau * round((float(m.q0) - middle) / math.tau)
    np.testing.assert_allclose(
        found, [middle + turns - half, middle + turns + half], rtol=0.0, atol=DEAD_POINT
    )
    rocker = m.extremes("rocker")
    assert math.isfinite(rocker.stroke)
    assert found[0] - 1e-12 <= rocker.min.q <= found[1] + 1e-12


@pytest.mark.parametrize("driver", ["crank", assur.Drive("ground", relative_to="crank")], ids=str)
def test_slider_cranks_in_every_order(driver: str | assur.Drive) -> None:
    joints = {"O": (0.1, 0.2), "A": (1.9, 1.0), "B": (3.1, 0.5), "G": (-1.0, 0.3)}
    links = {"ground": "OG", "crank": "OA", "rod": "AB", "piston": "B"}
    known = []
    for turned in itertools.product([False, True], repeat=3):
        listed = {
            link: own[::-1] if turn else own
            for turn, (link, own) in zip((*turned, False), links.items(), strict=True)
        }
        m = assur.Mechanism(
            joints,
            listed,
            driver,
            slides={"bore": assur.Slide("piston", on="ground", angle=0.1, origin="G")},
        )
        agrees_with_positions(m)
        known.append(m.limits().intervals - m.q0)
    assert np.isfinite(known[0]).all()
    for one in known[1:]:
        np.testing.assert_allclose(one, known[0], rtol=0.0, atol=DEAD_POINT)


@pytest.mark.parametrize("crank", list(itertools.permutations("ABP")), ids="".join)
def test_a_crank_of_three_joints(crank: tuple[str, ...]) -> None:
    joints = {**JOINTS, "P": (1.4, 1.3)}
    m = assur.Mechanism(joints, {**LINKS, "crank": "".join(crank)}, "crank")
    agrees_with_positions(m)
    plain = assur.Mechanism(JOINTS, LINKS, "crank")
    np.testing.assert_allclose(
        m.limits().intervals - m.q0, plain.limits().intervals - plain.q0, atol=DEAD_POINT
    )


def test_batches_and_what_stands_on_limits() -> None:
    """The moving pin first: by hand the angle is half a turn on."""
    one, other = (
        assur.Mechanism(JOINTS, {**LINKS, "crank": crank}, "crank") for crank in ("AB", "BA")
    )
    half = float(other.q0 - one.q0)
    assert abs(half) == pytest.approx(math.pi, abs=1e-12)
    lengths = {"coupler.length": np.linspace(2.0, 2.6, 4)}
    first, second = (m.with_dimensions(lengths).limits().intervals for m in (one, other))
    np.testing.assert_allclose(second, first + half, rtol=0.0, atol=DEAD_POINT)
    for order in range(4):
        least, greatest = (
            [getattr(m.extremes("C.x", order=order), end) for m in (one, other)]
            for end in ("min", "max")
        )
        for pair in (least, greatest):
            assert pair[1].value == pytest.approx(pair[0].value, rel=1e-9)
            assert pair[1].q == pytest.approx(pair[0].q + half, abs=1e-6)
    places = [
        (q, a) for q in (float(one.q0) - 0.1, float(one.q0) + 0.2) for a in one.assemblies(q)[:1]
    ]
    moved = [
        (q, a)
        for q in (float(other.q0) - 0.1, float(other.q0) + 0.2)
        for a in other.assemblies(q)[:1]
    ]
    assert one.configuration_curve().defects(places) == other.configuration_curve().defects(moved)


@pytest.mark.parametrize("q", [-1.5136502186650238, -3.0, 0.9, 2.0])
def test_the_interval_of_the_drawing_holds_its_coordinate(q: float) -> None:
    """Drawn at a negative angle, in its own count of turns."""
    near = math.acos((1.9**2 + 2.7**2 - (3.6 - 2.4) ** 2) / (2.0 * 1.9 * 2.7))
    pin = (1.9 * math.cos(q), 1.9 * math.sin(q))
    sized = assur.FourBar(1.9, 3.6, 2.4, 2.7)
    place = sized.assemblies(q)[0]
    assert place.joints is not None
    m = assur.Mechanism(
        {"A": (0, 0), "B": pin, "C": place.joints["C"], "D": (2.7, 0)}, LINKS, "crank"
    )
    assert m.q0 == pytest.approx(q, abs=1e-15)
    turn = 0.0 if q > 0.0 else -math.tau
    wanted = [[near + turn, math.tau - near + turn]]
    np.testing.assert_allclose(m.limits().intervals, wanted, rtol=0.0, atol=DEAD_POINT)
    # A batch counts from the coordinate that all its designs are drawn at.
    batch = m.with_dimensions({"coupler.length": [3.6, 3.5]}).limits()
    np.testing.assert_allclose(batch.intervals[0], wanted, rtol=0.0, atol=DEAD_POINT)
    # Values are those of the motion from the drawing.
    for end in (m.extremes("crank").min, m.extremes("crank").max):
        assert end.value == pytest.approx(end.q, abs=1e-12)
    low, high = m.extremes("rocker").min.q, m.extremes("rocker").max.q
    for at, value in ((low, m.extremes("rocker").min), (high, m.extremes("rocker").max)):
        inside = at + 1e-9 * (q - at)
        assert float(m.solve(inside).link("rocker").value) == pytest.approx(value.value, abs=1e-3)


@pytest.mark.parametrize("q0", [-3.0, -2.0, 2.5])
def test_a_six_bar_counts_from_its_drawing(q0: float) -> None:
    """Found by a search, not in closed form."""
    plain = six_bar(9.0)
    if not reached(plain, np.array([q0]))[0]:
        return
    drawn = plain.with_assembly(next(iter(plain.assemblies(q0))))
    for m in (plain, drawn):
        if m.limits().intervals.size:
            middles = m.limits().intervals.mean(axis=1)
            assert (np.abs(middles - m.q0) <= math.pi + 1e-12).all()
            agrees_with_positions(m)


@pytest.mark.parametrize("angle", [0.0, 1.0, -2.3])
@pytest.mark.parametrize("crank", ["OA", "AO"])
def test_a_guide_may_be_described_from_either_side(angle: float, crank: str) -> None:
    """The block slides on the ground, or the ground on the block: one linkage."""
    joints = {"O": (0.0, 0.0), "A": (1.0, 0.2), "B": (3.0, 1.0)}
    links = {"ground": "O", "crank": crank, "rod": "AB", "block": "B"}
    found = []
    for slide in (
        assur.Slide("block", on="ground", angle=angle),
        assur.Slide("ground", on="block", angle=angle),
    ):
        m = assur.Mechanism(joints, links, "crank", slides={"s": slide})
        agrees_with_positions(m)
        found.append(m.limits().intervals)
        batch = m.with_dimensions({"rod.length": [m.dimensions["rod.length"], 1.9]}).limits()
        np.testing.assert_array_equal(batch.intervals[0, : len(found[-1])], found[-1])
    np.testing.assert_allclose(found[0], found[1], rtol=0.0, atol=DEAD_POINT)
