"""Numbers of the papers and of textbooks, to all printed digits; P1's closed forms to 1e-14.

P1: Chernysh and others (2021), the slider-crank by vector loops. P5: V. K. Manzhosov and T. E.
Petrova, the crank-rocker with friction.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import mpmath  # type: ignore[import-untyped]
import numpy as np
import pytest

import assur
from models.mechanisms import named_models

if TYPE_CHECKING:
    from numpy.typing import NDArray

MP = mpmath.MPContext()
MP.dps = 40

# every eighth of a turn to the last bit, several turns, and places between
PHI: list[float] = [
    *(k * math.pi / 8 for k in range(-16, 33)),
    *(0.1 + 0.37 * k for k in range(40)),
    1e-9,
    -1e-9,
    math.pi / 2 + 1e-9,
    math.nextafter(math.pi, 0),
]

# P5, Table 1 with true pi: rows phi1 in degrees, columns l4 = 4.8 .. 4.995
TABLE_1 = {
    0: (0.600266, 0.518964, 0.423024, 0.298629, 0.094296),
    30: (0.752600, 0.688704, 0.618764, 0.540420, 0.459180),
    60: (1.081925, 1.036688, 0.989762, 0.940884, 0.894951),
    90: (1.456473, 1.420415, 1.383782, 1.346513, 1.312372),
    120: (1.326904, 1.359790, 1.392821, 1.426032, 1.456102),
    150: (1.045157, 1.078739, 1.112139, 1.145404, 1.175262),
    180: (0.930994, 0.965867, 1.000359, 1.034535, 1.065070),
}
L4 = (4.8, 4.85, 4.9, 4.95, 4.995)


# -- Jansen's leg ---------------------------------------------------------------------------------


@pytest.mark.parametrize("turned", range(4))
def test_jansen_foot(turned: int) -> None:
    """Foot 7 at crank angle 0, with the joints of the links in either order."""
    d = named_models.jansen()
    links = {
        name: joints[::-1] if turned & 1 and name != "crank" else joints
        for name, joints in d.links.items()
    }
    if turned & 2:
        links = dict(reversed(links.items()))
    m = assur.Mechanism(d.joints, links, driver="crank")
    x, y = m.solve(0.0, order=0).joint("7").value
    assert f"{x:.6f} {y:.6f}" == "-43.170055 -91.753226"


# -- the four-bar ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("mode", "coupler", "rocker"),
    [("open", "20.298", "57.325"), ("crossed", "-60.978", "-98.005")],
)
def test_four_bar(mode: str, coupler: str, rocker: str) -> None:
    m = assur.FourBar(40, 120, 80, 100, mode="open" if mode == "open" else "crossed")
    motion = m.solve(math.radians(40))
    assert f"{math.degrees(motion.link('coupler').value):.3f}" == coupler
    assert f"{math.degrees(motion.link('rocker').value):.3f}" == rocker


# -- P1: slider-crank -----------------------------------------------------------------------------


def close(got: NDArray[np.float64], want: list[float], size: float, what: str) -> None:
    """Within 1e-14 of the size, at every angle."""
    error = np.max(np.abs(got - np.array(want))) / size
    assert error <= 1e-14, f"{what}: {error:.3g} of the size"


@pytest.mark.parametrize(("crank", "rod"), [(0.05, 0.2), (0.11, 0.407), (1.0, 3.0), (30.0, 150.0)])
def test_central_slider_crank(crank: float, rod: float) -> None:
    """Stroke, velocity and acceleration (eqs 4, 7, 8), analogues (33-40), the rod's (41, 42)."""
    motion = assur.SliderCrank(crank, rod).solve(np.array(PHI), order=3)
    l1, l2 = MP.mpf(crank), MP.mpf(rod)
    k = l2 / l1
    rows: list[list[float]] = []
    for p in PHI:
        phi = MP.mpf(p)
        delta = MP.asin(MP.sin(phi) / k)
        c, cd, p2 = MP.cos(phi), MP.cos(delta), -delta
        stroke = l1 * (k + 1 - c - k * cd)
        v = l1 * MP.sin(phi + delta) / cd
        a = l1 * (MP.cos(phi + delta) + c**2 / (k * cd**2)) / cd
        p2d = -l1 * c / (l2 * MP.cos(p2))
        s3d = l1 * MP.sin(p2 - phi) / MP.cos(p2)
        p2dd = (l1 * MP.sin(phi) + l2 * p2d**2 * MP.sin(p2)) / (l2 * MP.cos(p2))
        s3dd = -l1 * c - l2 * p2d**2 * MP.cos(p2) - l2 * p2dd * MP.sin(p2)
        # eq 29 with the rod's term that the paper lost
        corrected = -(l1 * MP.cos(phi - p2) + l2 * p2d**2) / MP.cos(p2)
        rows.append([float(x) for x in (stroke, v, a, p2, p2d, p2dd, s3d, s3dd, corrected)])
    stroke_, v_, a_, p2_, p2d_, p2dd_, s3d_, s3dd_, corrected_ = map(list, zip(*rows, strict=True))
    bore, link = motion.slide("bore"), motion.link("rod")
    close(crank + rod - bore.value, stroke_, crank + rod, "stroke")
    close(-bore.velocity(1.0), v_, crank, "velocity")  # stroke grows as the slide's value falls
    close(-bore.acceleration(1.0), a_, crank, "acceleration")
    close(link.value, p2_, 1.0, "rod angle")
    close(link.d1, p2d_, 1.0, "its first analogue")
    close(link.d2, p2dd_, 1.0, "its second analogue")
    close(bore.d1, s3d_, crank, "slide's first analogue")
    close(bore.d2, s3dd_, crank, "slide's second analogue")
    close(bore.d2, corrected_, crank, "eq 29, corrected")
    speed, epsilon = 31.0, -4.0
    want = [speed**2 * b + epsilon * a for a, b in zip(s3d_, s3dd_, strict=True)]
    close(bore.acceleration(speed, epsilon), want, speed**2 * crank, "eq 42")
    want = [speed**2 * b + epsilon * a for a, b in zip(p2d_, p2dd_, strict=True)]
    close(link.acceleration(speed, epsilon), want, speed**2, "eq 41")
    at_b = motion.joint("B")
    assert np.array_equal(at_b.value[:, 0], bore.value)
    assert np.all(np.abs(at_b.value[:, 1]) <= 1e-15 * rod)


def test_eq_28() -> None:
    motion = assur.SliderCrank(0.11, 0.407).solve(0.7)
    assert f"{motion.slide('bore').acceleration(31.0):.6f}" == "-86.313406"


@pytest.mark.parametrize("offset", [0.3, -0.3, 1.2, 1.99])
def test_offset_slider_crank(offset: float) -> None:
    """Its own closed form: x = l1 cos φ + r, r = √(l2² − (e − l1 sin φ)²)."""
    crank, rod = 1.0, 3.0
    motion = assur.SliderCrank(crank, rod, offset).solve(np.array(PHI), order=3)
    bore, link = motion.slide("bore"), motion.link("rod")
    rows: list[list[float]] = []
    for p in PHI:
        phi = MP.mpf(p)
        w, wd, wdd = offset - MP.sin(phi), -MP.cos(phi), MP.sin(phi)
        r = MP.sqrt(rod**2 - w**2)
        rd = -w * wd / r
        rdd = -(wd**2 + w * wdd + rd**2) / r
        rddd = -(3 * wd * wdd - w * wd + 3 * rd * rdd) / r
        theta = MP.asin(w / rod)
        td = wd / r
        tdd = (wdd - td * rd) / r
        s, c = MP.sin(phi), MP.cos(phi)
        values = (c + r, -s + rd, -c + rdd, s + rddd, theta, td, tdd)
        rows.append([float(x) for x in values])
    x, xd, xdd, xddd, angle, first, second = map(list, zip(*rows, strict=True))
    # κ is up to 3/√(9 − 2.99²) = 12: to 8 u κ and 64 u κ² (1e-14 where κ is near 1)
    kappa, u = motion.condition, np.finfo(float).eps
    assert np.all(np.abs(bore.value - x) <= 8 * u * kappa * 4)
    assert np.all(np.abs(link.value - angle) <= 8 * u * kappa * 4 / rod)
    for got, want in ((bore.d1, xd), (bore.d2, xdd), (bore.d3, xddd), (link.d1, first)):
        assert np.all(np.abs(got - want) <= 64 * u * kappa**2 * np.maximum(1.0, np.abs(want)))
    assert np.all(np.abs(link.d2 - second) <= 64 * u * kappa**2 * np.maximum(1, np.abs(second)))
    if abs(offset) < 1:
        close(bore.value, x, 4.0, "value")
        close(bore.d1, xd, 1.0, "first")
        close(bore.d2, xdd, 1.0, "second")
        close(link.value, angle, 1.0, "angle")
        close(link.d1, first, 1.0, "its first")
        close(link.d2, second, 1.0, "its second")


# -- P5: crank-rocker -----------------------------------------------------------------------------


@pytest.mark.parametrize("mode", ["open", "crossed"])
@pytest.mark.parametrize("row", TABLE_1)
def test_table_1(row: int, mode: str) -> None:
    """Transmission angles; φ1 = 0 puts the crank pin farthest from D."""
    m = assur.FourBar(1.0, 4.5, 1.5, np.array(L4), mode="open" if mode == "open" else "crossed")
    for phi1 in (math.radians(row), math.radians(360 - row)):
        q = math.pi - phi1 if mode == "open" else phi1 + math.pi
        gamma = m.solve(q).transmission_angle("C")
        assert [f"{g:.6f}" for g in gamma] == [f"{v:.6f}" for v in TABLE_1[row]]


def test_p5_check_numbers() -> None:
    """The rates at l = (1, 4.5, 1.5, 4.9), φ1 = 2.1 by section 1 of P5, with dl4/dt = 0.7.

    Those of a fixed frame and of the moving one are told apart by a second driver: D on a slide.
    """
    q, l4, spin, slip = math.pi - 2.1, 4.9, 3.0, 0.7
    b = (math.cos(q), math.sin(q))
    c = assur.FourBar(1.0, 4.5, 1.5, l4).solve(q).joint("C").value
    m = assur.Mechanism(
        joints={"A": (0.0, 0.0), "B": b, "C": (float(c[0]), float(c[1])), "D": (l4, 0.0)},
        links={"ground": "A", "crank": "AB", "coupler": "BC", "rocker": "DC", "block": "D"},
        slides={"frame": assur.Slide("block", on="ground", angle=0.0, origin="A")},
        driver=["crank", "frame"],
    )
    motion = m.solve([q, l4])
    rate = np.array([-spin, slip])  # "open" is P5 mirrored: θ = π − φ, rates change sign
    bd = motion.joint("D").value - motion.joint("B").value
    bd_rate = motion.joint("D").velocity(rate) - motion.joint("B").velocity(rate)
    distance = float(np.hypot(*bd))
    s_rate = float(bd @ bd_rate) / distance
    assert f"{s_rate:.11f}" == "-2.14608490763"
    # φ3 = φ3' + φ3'': its rate is the sum of the two printed
    phi3_rate = -float(motion.link("rocker").velocity(rate))
    assert phi3_rate == pytest.approx(-0.25049132693 + 1.37345647286, abs=2e-11)
    # φ2 = π + φ3' − β
    phi2_rate = -float(motion.link("coupler").velocity(rate))
    assert phi2_rate == pytest.approx(-0.25049132693 - 0.07442402876, abs=2e-11)
    # γ23 is the angle between the legs at C
    assert abs(phi3_rate - phi2_rate) == pytest.approx(1.44788050162, abs=2e-11)
    assert f"{np.hypot(*motion.joint('C').velocity(rate)):.8f}" == "2.38405545"
    still = assur.FourBar(1.0, 4.5, 1.5, l4).solve(q)
    assert still.link("rocker").d1 == pytest.approx(motion.link("rocker").d1[0], rel=1e-13)
    assert still.link("coupler").d2 == pytest.approx(motion.link("coupler").d2[0, 0], rel=1e-13)
