"""P5 (Manzhosov and Petrova): positions, rates, zones and friction of the crank-rocker."""

from __future__ import annotations

import math
from typing import Any

import mpmath  # type: ignore[import-untyped]
import numpy as np
import pytest

import assur
from assur import crank_rocker as cr

MP = mpmath.MPContext()
MP.dps = 50
GROUNDS = (4.8, 4.85, 4.9, 4.95, 4.995)
# As printed: the paper took π for 3.14.
PRINTED = """
0 0.598674 0.517372 0.421431 0.297036 0.092704
30 0.750869 0.686961 0.617005 0.538638 0.457366
60 1.079962 1.034711 0.987770 0.938874 0.892922
90 1.454310 1.418244 1.381601 1.344321 1.31017
120 1.327578 1.360466 1.393500 1.426714 1.456788
150 1.045703 1.079280 1.112677 1.145939 1.175795
180 0.930995 0.965868 1.000360 1.034536 1.065072
210 1.044394 1.077982 1.111388 1.144657 1.174518
240 1.325557 1.358439 1.391465 1.424670 1.454733
270 1.456591 1.420559 1.383954 1.346717 1.312608
300 1.082185 1.037015 0.990166 0.941378 0.895538
330 0.752529 0.688765 0.619001 0.540910 0.460025
360 0.598680 0.517379 0.421440 0.297049 0.092743
"""
TRUE = """
0 0.600266 0.518964 0.423024 0.298629 0.094296
30 0.752600 0.688704 0.618764 0.540420 0.459180
60 1.081925 1.036688 0.989762 0.940884 0.894951
90 1.456473 1.420415 1.383782 1.346513 1.312372
120 1.326904 1.359790 1.392821 1.426032 1.456102
150 1.045157 1.078739 1.112139 1.145404 1.175262
180 0.930994 0.965867 1.000359 1.034535 1.065070
"""


def rows(text: str) -> np.ndarray[Any, np.dtype[np.float64]]:
    return np.array([[float(x) for x in line.split()] for line in text.strip().splitlines()])


def test_table_1_printed_and_true() -> None:
    table = cr.table1()
    assert table.printed.shape == table.true.shape == (13, 5)
    for line in rows(PRINTED):
        row = int(line[0]) // 30
        assert np.abs(table.printed[row] - line[1:]).max() < 1e-6, line[0]
    for line in rows(TRUE):
        row = int(line[0]) // 30
        for mirrored in (row, 12 - row):
            assert np.abs(table.true[mirrored] - line[1:]).max() < 6e-7, line[0]
    assert tuple(table.l4) == GROUNDS


def triangle(phi: Any, lengths: tuple[Any, ...], side: int) -> dict[str, Any]:
    """Positions by the triangle BCD, from D as seen by the paper: x toward A."""
    l1, l2, l3, l4 = lengths
    b = l4 + l1 * MP.expj(phi)
    s = abs(b)
    turn = MP.acos((s**2 + l3**2 - l2**2) / (2 * s * l3))
    c = l3 * MP.expj(MP.arg(b) + side * turn)
    return {
        "S": s,
        "phi3": MP.arg(c),
        "phi2": MP.arg(c - b),
        "gamma23": MP.acos((l2**2 + l3**2 - s**2) / (2 * l2 * l3)),
        "phi3_first": MP.arg(b),
        "phi3_second": side * turn,
        "beta": side * MP.acos((s**2 + l2**2 - l3**2) / (2 * s * l2)),
    }


CASES: list[tuple[float, float, float, float]] = [
    (1.0, 4.5, 1.5, 4.9),
    (1.0, 2.5, 3.5, 2.5),  # β passes a right angle
    (2.0, 3.0, 2.8, 0.7),  # a ground shorter than the crank: φ₃′ passes a right angle
]


@pytest.mark.parametrize("lengths", CASES)
@pytest.mark.parametrize(("assembly", "side"), [("printed", 1), ("other", -1)])
def test_positions_and_rates_at_fifty_digits(
    lengths: tuple[float, float, float, float], assembly: Any, side: int
) -> None:
    w, v = MP.mpf(3), MP.mpf("0.7")
    exact = tuple(MP.mpf(x) for x in lengths)
    for phi in (0.1, 1.0, 2.1, 3.0, 4.4, 6.0):
        found = cr.solve(phi, *lengths, speed=3.0, ground_speed=0.7, assembly=assembly)

        def moving(t: Any, phi: float = phi) -> dict[str, Any]:
            l1, l2, l3, l4 = exact
            return triangle(MP.mpf(phi) + w * t, (l1, l2, l3, l4 + v * t), side)

        h = MP.mpf("1e-15")
        before, here, after = (moving(t) for t in (-h, MP.mpf(0), h))
        for name, wanted in here.items():
            got = float(getattr(found, name))
            gap = got - wanted
            if name not in ("S", "gamma23"):
                gap -= 2 * MP.pi * MP.nint(gap / (2 * MP.pi))
            assert abs(gap) < 4e-15, (name, phi)
            change = after[name] - before[name]
            if name not in ("S", "gamma23"):
                change -= 2 * MP.pi * MP.nint(change / (2 * MP.pi))
            rate = float(getattr(found, f"d{name}"))
            assert abs(rate - change / (2 * h)) < 4e-14 * (1 + abs(rate)), (name, phi)
        assert abs(found.gamma - min(found.gamma23, math.pi - found.gamma23)) < 1e-15
        # C by both ways round.
        l1, l2, l3, l4 = lengths
        c = -l4 + l3 * np.exp(1j * found.phi3)
        b = l1 * np.exp(1j * phi)
        assert abs(c - (b + l2 * np.exp(1j * found.phi2))) < 1e-14
        velocity = -0.7 + 1j * l3 * found.dphi3 * np.exp(1j * found.phi3)
        assert math.isclose(found.v_C, abs(velocity), rel_tol=1e-13)
        assert math.isclose(found.v_B, 3.0 * l1)
        assert bool(found.pushes) == (found.dphi3 > 0)


def test_rates_of_the_reference() -> None:
    found = cr.solve(2.1, 1.0, 4.5, 1.5, 4.9, speed=3.0, ground_speed=0.7)
    for got, wanted in (
        (found.dS, -2.14608490763),
        (found.dphi3_first, -0.25049132693),
        (found.dphi3_second, 1.37345647286),
        (found.dbeta, 0.07442402876),
        (found.dgamma23, -1.44788050162),  # 30 digits: −1.447880501617
    ):
        assert abs(got - wanted) < 6e-12
    assert abs(found.v_C - 2.38405545) < 6e-9
    # Its own v_C is the speed relative to D.
    assert math.isclose(found.v_C_relative, 1.5 * found.dphi3)


def test_the_general_engine_agrees() -> None:
    """In terms of `FourBar`: "open" mirrored, q = π − φ₁; "crossed" turned, q = φ₁ + π."""
    phi = np.linspace(0.05, 6.2, 41)
    for lengths in CASES[:2]:
        found = cr.solve(phi, *lengths)
        mirrored = assur.FourBar(*lengths, mode="open").solve(np.pi - phi)
        for link, name in (("coupler", "phi2"), ("rocker", "phi3")):
            angle = np.pi - mirrored.link(link).value
            gap = getattr(found, name) - angle
            assert np.abs(gap - 2 * np.pi * np.round(gap / (2 * np.pi))).max() < 1e-13
            rate = getattr(found, f"d{name}")
            assert np.abs(rate - mirrored.link(link).d1).max() < 1e-13 * (1 + np.abs(rate).max())
        crossed = assur.FourBar(*lengths, mode="crossed").solve(phi + np.pi)
        for link, name in (("coupler", "phi2"), ("rocker", "phi3")):
            gap = getattr(found, name) - (crossed.link(link).value - np.pi)
            assert np.abs(gap - 2 * np.pi * np.round(gap / (2 * np.pi))).max() < 1e-13
        gamma = mirrored.transmission_angle("C")
        np.testing.assert_allclose(found.gamma, gamma, atol=1e-13)


def test_printed_angles_are_wrong_where_they_pass_a_right_angle() -> None:
    """β = arcsin(l₃ sin φ₃″ / l₂) for 104.5° < φ₁ < 255.5°; φ₃′ where l₄ < l₁ cos δ."""
    phi = np.radians(np.arange(0.0, 360.0, 0.5) + 0.25)
    found = cr.solve(phi, 1.0, 2.5, 3.5, 2.5)
    printed = np.arcsin(np.clip(3.5 / 2.5 * np.sin(found.phi3_second), -1, 1))
    wrong = np.degrees(phi[np.abs(printed - found.beta) > 1e-9])
    assert abs(wrong.min() - 104.5) < 0.5
    assert abs(wrong.max() - 255.5) < 0.5
    short = cr.solve(3.0, 2.0, 3.0, 2.8, 0.7)
    assert abs(math.asin(2.0 / short.S * math.sin(math.pi - 3.0)) - short.phi3_first) > 1


def test_grashof() -> None:
    for lengths, kind in (
        ((1, 4.5, 1.5, 4.8), "crank-rocker"),
        ((1.5, 4.5, 1, 4.8), "rocker-crank"),
        ((4.5, 1.5, 4.8, 1), "double-crank"),
        ((4.5, 1, 4.8, 1.5), "double-rocker"),
        ((1, 1.5, 4, 3.2), "triple-rocker"),
        ((1, 3, 1, 3), "change-point"),
        ((0.1, 0.3, 0.2, 0.4), "change-point"),  # equal but for rounding
    ):
        assert cr.grashof(*lengths) == kind
    assert cr.grashof(1, 3, 1.001, 3, tolerance=1e-2) == "change-point"
    assert cr.grashof(1, 3, 1.001, 3) == "crank-rocker"


def test_all_three_inequalities_count() -> None:
    """(1, 1.5, 4, 3.2) meets the printed two and cannot turn."""
    turns, margins = cr.crank_turns(1, 1.5, 4, 3.2)
    assert not turns
    assert margins[0] > 0
    assert margins[1] > 0
    assert margins[2] < 0
    rng = np.random.default_rng(1)
    phi = np.linspace(0, 2 * np.pi, 721)
    for lengths in rng.uniform(0.5, 5.0, (400, 4)):
        turns, margins = cr.crank_turns(*lengths)
        closes = bool(np.isfinite(cr.solve(phi, *lengths).S).all())
        assert turns == closes
        if lengths[3] > lengths[0]:
            assert turns == (min(margins) > 0)


def test_zone_of_figure_3() -> None:
    """l₂ = 4, Δ = 0.05: the range of the ground is 2 (l₃ − 1) − Δmin − Δmax for l₃ ≤ l₂."""
    for rocker in (1.05, 2.0, 3.3, 4.0):
        least, greatest = cr.ground_range(4.0, rocker)
        assert math.isclose(least, 5.0 - rocker + 0.05)
        assert math.isclose(greatest, 3.0 + rocker - 0.05)
        assert math.isclose(greatest - least, 2 * (rocker - 1) - 0.1, abs_tol=1e-14)
    assert cr.ground_range(4.0, 2.0, margin=(0.1, 0.3)) == pytest.approx((3.1, 4.7))
    # Longer rockers than the paper's.
    assert cr.ground_range(2.0, 4.0, margin=0.0) == pytest.approx((3.0, 5.0))
    least, greatest = cr.ground_range(4.5, 1.5, margin=0.0, gamma_min=0.2)
    assert abs(least - 4.04451986) < 6e-9
    assert abs(greatest - 4.97753284) < 6e-9
    inside = [least < ground < greatest for ground in GROUNDS]
    assert inside == [True] * 4 + [False]
    with pytest.raises(assur.InputError, match="no length of the ground fits"):
        cr.ground_range(4.0, 1.02)


def test_friction() -> None:
    """(8), and what it neglects: the friction moment in the coupler's own balance."""
    gamma = cr.least_transmission_angle(0.1, 0.5, 0.1, 1.5, 1.5)
    assert math.isclose(math.sin(gamma), 0.2 / 1.5)
    assert abs(gamma - 0.1337316) < 6e-8
    b, c, d, l2, l3 = 0.0, 0.1, 0.1, 4.5, 1.5
    assert abs(math.asin((c + d) / l3) + math.asin((c - b) / l2) - 0.1559556) < 6e-8
    with pytest.raises(assur.InputError, match="not below 1"):
        cr.least_transmission_angle(1.0, 1.0, 1.0, 1.0, 1.5)


def test_extremes_and_blocked_angles() -> None:
    phi = np.linspace(0, 2 * np.pi, 200001)
    for lengths in (
        (1, 4.5, 1.5, 4.8),
        (1, 4.5, 1.5, 4.995),
        (1, 2.5, 3.5, 2.5),
        (1, 4.5, 1.5, 4.0),
    ):
        if not cr.crank_turns(*lengths)[0]:
            with pytest.raises(assur.InputError, match="does not turn"):
                cr.transmission_extremes(*lengths)
            continue
        gamma = cr.solve(phi, *lengths).gamma
        least, greatest = cr.transmission_extremes(*lengths)
        assert abs(least - gamma.min()) < 1e-9
        assert abs(greatest - gamma.max()) < 1e-4
        assert greatest >= gamma.max() - 1e-12
    (zone,) = cr.blocked(1, 4.5, 1.5, 4.995, 0.2)
    assert abs(math.degrees(zone[1]) - 11.7440973691) < 6e-11
    assert abs(math.degrees(zone[0]) + 360 - 348.2559026309) < 6e-11
    ends = cr.solve(np.array(zone), 1, 4.5, 1.5, 4.995)
    np.testing.assert_allclose(ends.gamma, 0.2, atol=1e-13)
    np.testing.assert_allclose(ends.S, 5.977532835615105, rtol=1e-15)
    assert cr.blocked(1, 4.5, 1.5, 4.8, 0.2) == []
    (inner,) = cr.blocked(1, 4.5, 1.5, 4.0, 0.2)
    assert abs(math.degrees(inner[0]) - 165.0969) < 6e-5
    (third,) = cr.blocked(1, 4.5, 1.5, 5.2, 0.2)
    assert abs(math.degrees(third[1]) - 42.3103) < 6e-5


@pytest.mark.parametrize(
    ("call", "kind", "words"),
    [
        (lambda: cr.solve(0.1, 1, -2, 3, 4), assur.DimensionError, "l2 is -2"),
        (lambda: cr.solve(0.1, 1, 2, math.nan, 4), assur.InputError, "l3 is nan"),
        (lambda: cr.solve(0.1, 1, 2, 3, 4, assembly="left"), assur.InputError, "assembly"),  # type: ignore[arg-type]
        (lambda: cr.solve([1, 2], [1, 2, 3], 2, 3, 4), assur.InputError, "broadcast"),
        (lambda: cr.grashof(1, 2, 0, 4), assur.DimensionError, "l3 is 0.0"),
        (lambda: cr.blocked(1, 2, [3], 4, 0.1), assur.InputError, "one mechanism"),  # type: ignore[arg-type]
        (lambda: cr.ground_range(4.0, 2.0, margin=-0.1), assur.InputError, "margin"),
        (
            lambda: cr.ground_range(4.0, 2.0, margin=0.0, gamma_min=1.7),
            assur.InputError,
            "gamma_min",
        ),
        (lambda: cr.least_transmission_angle(-0.1, 1, 0, 0, 1), assur.InputError, "f_c is -0.1"),
        (lambda: cr.blocked(1, 2, 3, 4, math.nan), assur.InputError, "gamma_min is nan"),
    ],
)
def test_bad_input_is_refused(call: Any, kind: type[Exception], words: str) -> None:
    with pytest.raises(kind, match=words):
        call()


def test_designs_at_once() -> None:
    """What is asked of many designs is what is asked of each."""
    rng = np.random.default_rng(3)
    lengths = rng.uniform(0.5, 5.0, (4, 60))
    kinds, (sure, margins) = cr.grashof(*lengths), cr.crank_turns(*lengths)
    turns = np.asarray(sure)
    least, greatest = cr.transmission_extremes(*lengths)
    assert turns.any()
    assert not turns.all()
    for i, one in enumerate(lengths.T.tolist()):
        assert kinds[i] == cr.grashof(*one)
        assert turns[i] == cr.crank_turns(*one)[0]
        np.testing.assert_array_equal(margins[i], cr.crank_turns(*one)[1])
        if turns[i]:
            assert (least[i], greatest[i]) == cr.transmission_extremes(*one)
        else:
            assert np.isnan(least[i])
    low, high = cr.ground_range(4.0, [1.02, 2.0, 3.0], gamma_min=[[0.0], [0.2]])
    assert low.shape == high.shape == (2, 3)
    assert np.isnan(low[0, 0])
    assert (low[0, 1], high[0, 1]) == cr.ground_range(4.0, 2.0)
    angles = cr.least_transmission_angle([0.1, 3.0], 1.0, 0.0, 0.0, 1.5)
    assert angles[0] == cr.least_transmission_angle(0.1, 1.0, 0.0, 0.0, 1.5)
    assert np.isnan(angles[1])


def test_lengths_that_do_not_reach_are_nan() -> None:
    found = cr.solve([0.0, math.pi], 1, 2.0, 1.5, 3.0)
    assert np.isnan(found.S[0])
    assert np.isfinite(found.gamma[1])
    assert np.isnan(found.v_B[0])
    assert len(repr(found)) < 80
