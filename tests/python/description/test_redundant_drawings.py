"""Drawings with redundant links: adjusted within nine digits, refused with the misfit beyond."""

from __future__ import annotations

import math

import numpy as np
import pytest

import assur
from assur import Status

PIVOTS = [(0.0, 0.0), (1.5, 0.3), (3.1, -0.2)]
PINS = [(x + 0.4, y + 0.3) for x, y in PIVOTS]
Q = np.linspace(0.0, 6.2, 200)
SIZE = 4.0  # of the drawing, about


def typed(place: tuple[float, float], digits: int) -> tuple[float, float]:
    """A point turned by 0.7 rad, rounded to so many significant digits."""
    c, s = math.cos(0.7), math.sin(0.7)
    x, y = place[0] * c - place[1] * s, place[0] * s + place[1] * c
    return float(f"{x:.{digits - 1}e}"), float(f"{y:.{digits - 1}e}")


def locomotive(digits: int = 17) -> assur.Mechanism:
    joints = {f"O{i}": typed(p, digits) for i, p in enumerate(PIVOTS)}
    joints |= {f"A{i}": typed(p, digits) for i, p in enumerate(PINS)}
    links = {"ground": ["O0", "O1", "O2"], "rod": ["A0", "A1", "A2"]}
    links |= {f"w{i}": [f"O{i}", f"A{i}"] for i in range(3)}
    return assur.Mechanism(joints, links, driver="w0")


@pytest.mark.parametrize("digits", [10, 11, 12, 13, 14, 15, 16, 17])
def test_a_locomotive_typed_with_ten_digits_moves_through_its_change_points(digits: int) -> None:
    m = locomotive(digits)
    assert m.structure.redundant == ("w2",)
    motion = m.solve(m.q0 + Q)
    # The rod only translates: pins go round their pivots as drawn.
    for i, (o, a) in enumerate(zip(PIVOTS, PINS, strict=True)):
        arm = complex(*a) - complex(*o)
        pivot = complex(*o) * np.exp(0.7j)
        place = pivot + arm * np.exp(1j * (Q + 0.7))
        got = motion.joint(f"A{i}").value @ [1.0, 1.0j]
        assert np.abs(got - place).max() < 2.0 * 10.0 ** (1 - digits) + 1e-13
    np.testing.assert_allclose(motion.link("rod").d1, 0.0, atol=1e-9)


@pytest.mark.parametrize("digits", [9, 10, 12])
def test_the_adjustment_stays_within_the_typed_digits(digits: int) -> None:
    m = locomotive(digits)
    half_a_unit = 0.5 * 10.0 ** (1 - digits)  # of coordinates from 1 m to 10 m
    assert 0.0 < m.structure.adjustment < half_a_unit
    for name, place in m.joints.items():
        drawn = typed(
            dict(zip(["O0", "O1", "O2", "A0", "A1", "A2"], PIVOTS + PINS, strict=True))[name],
            digits,
        )
        assert math.dist(place, drawn) < 2.0 * half_a_unit
    # An adjusted drawing moves like an exact one: misfits are rounding.
    assert m.solve(m.q0 + Q).residual.max() < 1e-13


def test_a_drawing_that_fits_stays_as_it_is() -> None:
    exact = locomotive()
    assert exact.structure.adjustment == 0.0
    assert dict(exact.joints)["A1"] == typed(PINS[1], 17)


@pytest.mark.parametrize("digits", [6, 7, 8])
def test_fewer_digits_are_refused_with_the_misfit(digits: int) -> None:
    with pytest.raises(assur.StructureError, match=r"lengths agree.*m off.*more digits") as caught:
        locomotive(digits)
    assert caught.value.value is not None
    assert 0.01 < caught.value.value / 10.0 ** (1 - digits) < 10.0


@pytest.mark.parametrize("off", [1e-12, -1e-10, 1e-9])
def test_designs_whose_redundant_link_misses_by_little_move(off: float) -> None:
    m = locomotive()
    own = m.dimensions["w2.length"]
    motion = m.with_dimensions({"w2.length": own + off}).solve(m.q0 + Q)
    assert (motion.status <= Status.SINGULAR).all()
    assert 0.1 * abs(off) / SIZE < motion.residual.max() < 4.0 * abs(off)


@pytest.mark.parametrize("off", [1e-7, 1e-6, 1e-3])
def test_designs_whose_redundant_link_misses_by_more_do_not(off: float) -> None:
    m = locomotive()
    own = m.dimensions["w2.length"]
    motion = m.with_dimensions({"w2.length": own + off}).solve(m.q0 + Q[1:], on_error="nan")
    assert (motion.status == Status.UNREACHABLE).all()
    assert '"w2" does not fit: it misses by' in motion.explain(100)


@pytest.mark.parametrize("far", [5.0, 1e3, 1e6])
@pytest.mark.parametrize("crank", ["APB", "ABP", "PAB"])
def test_a_point_far_away_lets_no_misfit_through(crank: str, far: float) -> None:
    """The misfit is relative to the greatest length between pairs, wherever other points are."""
    joints = {"A": (0, 0), "B": (0.75, 1), "C": (3.75, 1), "D": (3, 0), "E": (1.5, 0)}
    m = assur.Mechanism(
        {**joints, "F": (2.25, 1), "P": (far, 0)},
        {"ground": "ADE", "crank": crank, "rod": "BCF", "second": "DC", "third": "EF"},
        driver="crank",
    )
    q = [0.9, 1.2, 2.0]
    for part in (1e-5, 1e-3, 0.3):
        other = m.with_dimensions({"third.length": 1.25 * (1 + part)})
        assert (other.solve(q, on_error="nan").status == Status.UNREACHABLE).all()
    fits = m.with_dimensions({"third.length": 1.25 * (1 + 1e-10)}).solve(q)
    assert (fits.status <= Status.NEAR_SINGULAR).all()


def test_a_second_guide_typed_with_ten_digits_moves() -> None:
    angle = 0.7
    along, across = (
        np.array([math.cos(angle), math.sin(angle)]),
        np.array([-math.sin(angle), math.cos(angle)]),
    )
    places = {
        "O": 0.0 * along,
        "A": 0.3 * along + 0.4 * across,
        "B": 1.2 * along,
        "C": 1.2 * along + 0.5 * across,
    }
    joints = {name: tuple(float(f"{x:.9e}") for x in at) for name, at in places.items()}
    m = assur.Mechanism(
        joints | {"E": tuple(float(f"{x:.9e}") for x in 0.5 * across)},
        {"ground": ["O", "E"], "crank": "OA", "rod": "AB", "cross": "BC"},
        "crank",
        slides={
            "lower": assur.Slide("cross", "ground", angle=round(angle, 10), origin="O"),
            "upper": assur.Slide("cross", "ground", angle=round(angle + 3e-11, 10), origin="E"),
        },
    )
    assert m.structure.redundant == ("upper",)
    assert (m.solve(m.q0 + Q).status == Status.OK).all()
