"""Singular loci and workspaces, against closed forms and the geometry of singular positions."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np
import pytest

import assur
from models.errors.refusals import refused

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Float = NDArray[np.float64]

# The closures hold to rounding; beside a singular position half of the digits are lost.
TRACED = 1e-9
LENGTHS = (0.8, 1.1, 0.9, 0.7)


def five_bar() -> assur.Mechanism:
    """Cranks at 2 and 1 rad: P as in the closed form with the positive sign."""
    left, right = LENGTHS[0] * np.exp(2j), 1.0 + LENGTHS[3] * np.exp(1j)
    at = {"A": 0j, "B": left, "P": 0.679851549731 + 1.15673843554j, "D": right, "E": 1.0 + 0j}
    return assur.Mechanism(
        {name: (point.real, point.imag) for name, point in at.items()},
        {"ground": "AE", "crank": "AB", "rod": "BP", "arm": "DP", "rocker": "ED"},
        ("crank", "rocker"),
    )


def apart(locus: assur.SingularLocus, one: str, other: str) -> Float:
    gap = locus.joints[one] - locus.joints[other]
    return np.hypot(gap[:, 0], gap[:, 1])


def beside_lines(points: Float, lines: list[Float]) -> Float:
    """How far points of the plane of both angles are from lines, modulo whole turns."""
    nearest = np.full(len(points), np.inf)
    for line in lines:
        steps = np.diff(line, axis=0)
        gap = points[:, None] - line[None, :-1]
        gap -= 2.0 * np.pi * np.round(gap / (2.0 * np.pi))
        part = (gap * steps).sum(axis=2) / (steps * steps).sum(axis=1)
        foot = gap - np.clip(part, 0.0, 1.0)[..., None] * steps
        nearest = np.minimum(nearest, np.hypot(foot[..., 0], foot[..., 1]).min(axis=1))
    return nearest


def test_second_kind_of_a_five_bar() -> None:
    """The distal links in line: all of it, and nothing else."""
    loci = five_bar().singular_loci(positions=24)
    assert all(locus.is_closed and locus.kind == 2 for locus in loci)
    stretched = LENGTHS[1] + LENGTHS[2]
    folded = LENGTHS[1] - LENGTHS[2]
    found = sorted(round(float(apart(locus, "B", "D").mean()), 6) for locus in loci)
    assert found == pytest.approx([folded, folded, stretched])
    for locus in loci:
        rho = apart(locus, "B", "D")
        np.testing.assert_allclose(rho, rho[0], rtol=0.0, atol=TRACED)
        # The coordinates are those of the joints.
        b = LENGTHS[0] * np.exp(1j * locus.q[:, 0])
        np.testing.assert_allclose(locus.joints["B"], np.stack([b.real, b.imag], 1), atol=TRACED)
    # Rotation of the rocker at every crank angle, in closed form.
    q1 = np.linspace(-np.pi, np.pi, 300)
    base = 1.0 - LENGTHS[0] * np.exp(1j * q1)
    for reach in (stretched, folded):
        cosine = (reach**2 - np.abs(base) ** 2 - LENGTHS[3] ** 2) / (2 * np.abs(base) * LENGTHS[3])
        ok = np.abs(cosine) < 0.999
        for sign in (1.0, -1.0):
            q2 = np.angle(base[ok]) + sign * np.arccos(cosine[ok])
            lines = [locus.q for locus in loci]
            # Between traced positions a curve bends away from the chord.
            assert beside_lines(np.stack([q1[ok], q2], 1), lines).max() < 5e-3


def test_the_numbers_of_one_crank_angle() -> None:
    loci = five_bar().singular_loci(positions=16)
    places = np.array([[2.0, 0.469059269516], [2.0, -1.46820602702]])
    assert beside_lines(places, [locus.q for locus in loci]).max() < 5e-3


def test_workspace_of_a_five_bar() -> None:
    """Both rings; the boundaries are their four circles, within the other ring."""
    space = five_bar().workspace("P", positions=24)
    x, y = np.meshgrid(space.x, space.y, indexing="ij")
    l1, l2, l3, l4 = LENGTHS

    def reached(x: Float, y: Float) -> NDArray[np.bool_]:
        one, other = np.hypot(x, y), np.hypot(x - 1.0, y)
        return (
            (abs(l1 - l2) <= one) & (one <= l1 + l2) & (abs(l4 - l3) <= other) & (other <= l3 + l4)
        )

    np.testing.assert_array_equal(space.count, np.where(reached(x, y), 4, 0))
    radii = np.array([l1 + l2, abs(l1 - l2), l3 + l4, abs(l3 - l4)])
    kinds = []
    for locus in space.boundary:
        at = locus.joints["P"]
        one, other = np.hypot(*at.T), np.hypot(at[:, 0] - 1.0, at[:, 1])
        off = np.abs(np.stack([one, one, other, other]) - radii[:, None]).max(axis=1)
        assert off.min() < TRACED
        assert locus.kind == 1
        assert locus.is_closed
        kinds.append(int(off.argmin()))
    # A whole circle of one leg has two curves: one for each sign of the other leg.
    assert sorted(kinds) == [0, 1, 1, 2, 3, 3]
    corner = 1.59980467558
    assert space.contains([1.025, corner - 1e-9])
    assert not space.contains([1.025, corner + 1e-9])
    points = np.random.default_rng(1).uniform(-2.0, 2.5, (200, 2))
    np.testing.assert_array_equal(space.contains(points), reached(points[:, 0], points[:, 1]))


def test_a_triad_with_two_cranks_is_singular_where_its_legs_meet() -> None:
    """Three forces in equilibrium: the legs' lines go through one point, or are parallel."""
    at = {"O": (0, 0), "A": (0.3, 0.5), "P": (0.8, 2), "Q": (2, 2.3), "R": (2.4, 1.1)}
    at |= {"U": (1.6, 3.6), "W": (3.4, 0.2), "V": (3.5, 0.9)}
    links = {"ground": "OUW", "crank": "OA", "second": "WV", "plate": "PQR"}
    links |= {"l1": "AP", "l2": "UQ", "l3": "VR"}
    loci = assur.Mechanism(at, links, ("crank", "second")).singular_loci(positions=10)
    assert loci
    for locus in loci:
        lines = []
        for start, end in ("AP", "UQ", "VR"):
            p, q = locus.joints[start], locus.joints[end]
            way = (q - p) / np.hypot(*(q - p).T)[:, None]
            lines.append(np.column_stack([way, p[:, 0] * way[:, 1] - p[:, 1] * way[:, 0]]))
        triple = np.einsum("ni,ni->n", lines[0], np.cross(lines[1], lines[2]))
        assert np.abs(triple).max() < 1e-8


def gantry() -> assur.Mechanism:
    """Two blocks on parallel guides, and two rods to P."""
    return assur.Mechanism(
        {"O": (0, 0), "B": (0, 0), "P": (0.9, 0.5), "D": (2, 0)},
        {"ground": "O", "left": "B", "right": "D", "rod": "BP", "arm": "DP"},
        ("at", "to"),
        slides={
            "at": assur.Slide("left", on="ground", angle=0.0, origin="O"),
            "to": assur.Slide("right", on="ground", angle=0.0, origin="O"),
        },
    )


def test_driven_slides_end_where_their_range_ends() -> None:
    loci = gantry().singular_loci(positions=12)
    m = gantry()
    rod, arm = m.dimensions["rod.length"], m.dimensions["arm.length"]
    wanted = sorted([rod + arm, -rod - arm, abs(rod - arm), -abs(rod - arm)])
    gaps = [locus.q[:, 1] - locus.q[:, 0] for locus in loci]
    for gap in gaps:
        np.testing.assert_allclose(gap, gap[0], rtol=0.0, atol=TRACED)
    np.testing.assert_allclose(sorted(gap[0] for gap in gaps), wanted, atol=TRACED)
    assert not any(locus.is_closed for locus in loci)
    # Of a joint, |y| is at most the shorter rod; the other one lies either way.
    heights = [locus.joints["P"][:, 1] for locus in m.workspace("P", positions=12).boundary]
    shorter = min(rod, arm)
    for height in heights:
        np.testing.assert_allclose(height, height[0], rtol=0.0, atol=TRACED)
    wanted = [-shorter, -shorter, shorter, shorter]
    np.testing.assert_allclose(sorted(height[0] for height in heights), wanted, atol=TRACED)


def test_with_three_drivers_the_third_is_held() -> None:
    """A platform on three cylinders: two of them move."""
    m = assur.Mechanism(
        {"U": (0, 0), "V": (4, 0), "W": (2, 4), "P": (1.2, 1), "Q": (2.8, 1.1), "R": (2.1, 2.2)},
        {"ground": "UVW", "plate": "PQR", "t1": "U", "t2": "V", "t3": "W", "r1": "P"}
        | {"r2": "Q", "r3": "R"},
        ("s1", "s2", "s3"),
        slides={
            f"s{i}": assur.Slide(f"r{i}", on=f"t{i}", angle=angle, origin=origin)
            for i, origin, angle in zip(
                (1, 2, 3),
                "UVW",
                (np.arctan2(1, 1.2), np.arctan2(1.1, -1.2), np.arctan2(-1.8, 0.1)),
                strict=True,
            )
        },
    )
    loci = m.singular_loci(drivers=("s1", "s2"), positions=8)
    assert loci
    for locus in loci:
        np.testing.assert_allclose(locus.q[:, 2], np.array(m.q0)[2], rtol=0.0, atol=TRACED)
    refused(assur.InputError, "name the two", m.singular_loci)


def test_refusals() -> None:
    m = five_bar()
    refused(
        assur.InputError, "see limits()", partial(assur.FourBar(1.0, 3.0, 2.5, 3.2).workspace, "C")
    )
    refused(assur.InputError, "Z", partial(m.workspace, "Z"))
    refused(assur.InputError, "positions from 4", partial(m.singular_loci, positions=2))
    refused(assur.InputError, "name the two", partial(m.singular_loci, drivers=("crank", "rod")))
    refused(
        assur.InputError,
        "batch",
        partial(m.with_dimensions({"rod.length": [1.0, 1.1]}).workspace, "P"),
    )
    space = m.workspace("P", positions=8)
    refused(assur.InputError, "finite", partial(space.contains, [1.0, 2.0, 3.0]))
    assert "of P" in repr(space)
    assert "kind 1" in repr(space.boundary[0])
