"""P4 (V. M. Dvorzhak): `assur.ClassIV`, and the paper's four equations beside the closures.

The numbers are those of the reference mechanism: at a root of the paper's equations the
quadrilateral 3-6-8-4 need not be closed, and where the rockers 5-9 and 7-10 are parallel they are
singular though the mechanism is not.
"""

from __future__ import annotations

import math
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt
import pytest

import assur
from assur import Status
from models.mechanisms.class_iv_model import class_iv
from models.mechanisms.mechanism_data import Description
from oracles.kinematics import oracle

Float: TypeAlias = npt.NDArray[np.float64]

JOINTS: dict[str, tuple[float, float]] = class_iv()["joints"]
PLACES = {name: complex(*place) for name, place in JOINTS.items()}
LEGS = (("2", "3"), ("2", "4"), ("3", "6"), ("3", "5"), ("4", "8"), ("8", "7"), ("8", "6"))
# Crank angle, rotations of 2-3-4, 3-6-5, 4-8, 8-7-6 from the drawing (degrees), and how far the
# quadrilateral is open there, m.
EXTRA_ROOTS = (
    (0.0, (-44.1306, -25.4882, 55.4852, 19.1045), 1.651998),
    (0.0, (0.4577, 0.1552, -57.1643, -0.4974), 1.148242),
    (100.0, (-61.5722, -3.8039, 68.0638, 8.6677), 0.894514),
    (100.0, (-17.2999, 3.6578, -63.0468, -7.8641), 1.267399),
)
# The two real assemblies at two crank angles: rotations of the same and of 5-9 and 7-10.
ASSEMBLIES = (
    (0.0, (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)),
    (0.0, (-42.0077, -22.8917, -23.1908, -36.5326, -60.2507, 117.0144)),
    (100.0, (-15.2148, 3.8602, 3.56, -9.7516, 8.3874, -0.7002)),
    (100.0, (-62.9749, -4.4311, 1.0313, -43.4921, -45.8886, 102.8392)),
)
# Rotation of each leg: its place among the unknowns.
TURNS = {"23": 0, "24": 0, "36": 1, "35": 1, "48": 2, "87": 3, "86": 3}


class Paper:
    """The paper's four equations and the closures, by rotations from the drawing."""

    def __init__(self, phi: float, ten: complex | None = None) -> None:
        self.two = abs(PLACES["2"]) * np.exp(1j * phi)
        self.nine, self.ten = PLACES["9"], PLACES["10"] if ten is None else ten
        self.drawn = {a + b: PLACES[b] - PLACES[a] for a, b in LEGS}
        self.l59 = abs(PLACES["5"] - PLACES["9"])
        self.l710 = abs(PLACES["7"] - self.ten)

    def routes(self, x: Float) -> tuple[list[tuple[complex, Float]], complex, Float]:
        """The four vectors to the rockers' pivots with their derivatives; the open contour's."""
        leg = {name: v * np.exp(1j * x[TURNS[name]]) for name, v in self.drawn.items()}

        def along(base: complex, **signs: int) -> tuple[complex, Any]:
            value, slope = base, np.zeros(4, complex)
            for name, sign in signs.items():
                value += sign * leg[name[1:]]
                slope[TURNS[name[1:]]] += sign * 1j * leg[name[1:]]
            return value, slope

        nine, ten = self.two - self.nine, self.two - self.ten
        four = [
            along(nine, _23=1, _35=1),
            along(nine, _24=1, _48=1, _86=1, _36=-1, _35=1),
            along(ten, _24=1, _48=1, _87=1),
            along(ten, _23=1, _36=1, _86=-1, _87=1),
        ]
        contour, slope = along(0j, _23=1, _36=1, _86=-1, _48=-1, _24=-1)
        return four, contour, slope

    def equations(self, x: Float) -> tuple[Float, Float]:
        """What they miss, in the paper's order, and the Jacobian."""
        four, _, _ = self.routes(x)
        lengths = (self.l59, self.l59, self.l710, self.l710)
        rows = [abs(v) ** 2 - length**2 for (v, _), length in zip(four, lengths, strict=True)]
        return np.array(rows), np.array([2 * (np.conj(v) * slope).real for v, slope in four])

    def closures(self, x: Float) -> tuple[Float, Float]:
        """Contour x, y, |5−9|², |7−10|², and the Jacobian."""
        four, contour, slope = self.routes(x)
        (a, a_slope), _, (b, b_slope), _ = four
        rows = [contour.real, contour.imag, abs(a) ** 2 - self.l59**2, abs(b) ** 2 - self.l710**2]
        slopes = [slope.real, slope.imag]
        slopes += [2 * (np.conj(a) * a_slope).real, 2 * (np.conj(b) * b_slope).real]
        return np.array(rows), np.array(slopes)

    def root(self, guess: Float) -> Float:
        x = guess
        for _ in range(20):
            rows, jacobian = self.equations(x)
            x = x - np.linalg.solve(jacobian, rows)
        return x


def reference() -> assur.ClassIV:
    return assur.ClassIV(joints=JOINTS)


def in_papers_words(shake: float = 0.0) -> dict[str, Any]:
    """The reference mechanism by lengths and angles; starting angles off by so much, rad."""
    angle = {a + "-" + b: np.angle(PLACES[b] - PLACES[a]) for a, b in LEGS}
    pairs = ["1-2", "2-3", "2-4", "3-5", "3-6", "4-8", "6-8", "7-8", "5-9", "7-10"]
    ends = {pair: pair.split("-") for pair in pairs}
    return {
        "lengths": {p: abs(PLACES[b] - PLACES[a]) for p, (a, b) in ends.items()},
        "angles": {
            "4-2-3": angle["2-3"] - angle["2-4"],
            "6-3-5": angle["3-5"] - angle["3-6"],
            "7-8-6": angle["8-6"] - angle["8-7"],
        },
        "pivots": {name: JOINTS[name] for name in ("1", "9", "10")},
        "start": {
            "1-2": 0.0,
            "2-4": angle["2-4"] + shake,
            "3-6": angle["3-6"] - shake,
            "4-8": angle["4-8"] + shake,
            "7-8": angle["8-7"] - shake,
        },
    }


@pytest.mark.parametrize("shake", [0.0, 0.02, -0.05])
def test_the_papers_data_give_the_same_mechanism(shake: float) -> None:
    m, by_joints = assur.ClassIV(**in_papers_words(shake)), reference()
    for name, value in by_joints.dimensions.items():
        assert math.isclose(m.dimensions[name], value, rel_tol=1e-15, abs_tol=2e-15), name
    q = np.linspace(0.0, 4 * math.pi, 73)
    found, wanted = m.solve(q), by_joints.solve(q)
    for name in JOINTS:
        for of in ("value", "d1", "d2"):
            a, b = getattr(found.joint(name), of), getattr(wanted.joint(name), of)
            np.testing.assert_allclose(a, b, atol=1e-13)


def test_each_solution_meets_the_papers_equations() -> None:
    m = reference()
    motion = m.solve(np.deg2rad(np.arange(360.0)))
    misses = m.paper_equations(motion)
    assert misses.shape == (360, 4)
    assert np.abs(misses).max() < 2e-14
    # The check can fail: another mechanism's motion does not meet them.
    other = m.with_dimensions({"l48.length": 1.2})
    assert np.abs(m.paper_equations(other.solve(np.deg2rad(np.arange(360.0))))).max() > 1e-2


def test_both_assemblies_are_those_of_the_reference() -> None:
    m = reference()
    for degrees, rotations in ASSEMBLIES:
        paper = Paper(math.radians(degrees))
        x = paper.root(np.deg2rad(rotations[:4]))
        assert np.abs(np.rad2deg(x) - rotations[:4]).max() < 6e-5
        assert np.abs(paper.closures(x)[0]).max() < 1e-14
    first = m.solve(math.radians(100.0))
    turned = [first.link(n).value - m.solve(0.0).link(n).value for n in m.links if n[0] == "l"]
    by_name = dict(zip((n for n in m.links if n[0] == "l"), np.rad2deg(turned), strict=True))
    names = ("l234", "l365", "l48", "l876", "l95", "l107")
    np.testing.assert_allclose([by_name[n] for n in names], ASSEMBLIES[2][1], atol=6e-5)


@pytest.mark.parametrize(("degrees", "rotations", "gap"), EXTRA_ROOTS)
def test_extra_roots_of_the_paper_are_not_positions(
    degrees: float, rotations: tuple[float, ...], gap: float
) -> None:
    phi = math.radians(degrees)
    paper = Paper(phi)
    x = paper.root(np.deg2rad(rotations))
    assert np.abs(np.rad2deg(x) - rotations).max() < 6e-5
    assert np.abs(paper.equations(x)[0]).max() < 1e-13
    _, contour, _ = paper.routes(x)
    assert abs(abs(contour) - gap) < 6e-7
    # Started there, the library comes to an assembly that closes, or says that it does not.
    words = in_papers_words()
    angle = {a + b: np.angle(PLACES[b] - PLACES[a]) for a, b in LEGS}
    words["start"] = {
        "1-2": phi,
        "2-4": angle["24"] + x[0],
        "3-6": angle["36"] + x[1],
        "4-8": angle["48"] + x[2],
        "7-8": angle["87"] + x[3],
    }
    try:
        m = assur.ClassIV(**words)
    except assur.InputError as error:
        assert "quadrilateral stays open by" in str(error)  # noqa: PT017
        return
    motion = m.solve(m.q0)
    assert motion.residual < 1e-14
    found = [float(motion.link(n).value) for n in ("l234", "l365", "l48", "l876")]
    drawn = [float(reference().solve(0.0).link(n).value) for n in ("l234", "l365", "l48", "l876")]
    turned = np.array(found) - drawn
    assert np.abs(paper.closures(turned)[0]).max() < 1e-13


def test_determinants_differ_by_the_rockers() -> None:
    """det J_paper = 4 (r59 × r710) det J_closure at every assembled position."""
    m = reference()
    q = np.deg2rad(np.arange(0.0, 360.0, 15.0))
    motion = m.solve(q)
    turned = [motion.link(n).value for n in ("l234", "l365", "l48", "l876")]
    for i, phi in enumerate(q):
        x = np.array([float(t[i] - t[0]) for t in turned])
        r59 = complex(*(motion.joint("9").value[i] - motion.joint("5").value[i]))
        r710 = complex(*(motion.joint("10").value[i] - motion.joint("7").value[i]))
        cross = (r59.conjugate() * r710).imag
        paper = Paper(phi)
        of_paper = np.linalg.det(paper.equations(x)[1])
        of_closures = np.linalg.det(paper.closures(x)[1])
        assert math.isclose(abs(of_paper), abs(4 * cross * of_closures), rel_tol=1e-11)


def test_parallel_rockers_need_no_special_case() -> None:
    """Pivot 10 moved: the rockers are parallel at φ = 0, where the paper's equations fail."""
    ten = (4.46, 2.582)
    paper, zero = Paper(0.0, complex(*ten)), np.zeros(4)
    assert math.isclose(paper.l710, 1.3055895, abs_tol=5e-8)
    assert np.linalg.cond(paper.equations(zero)[1]) > 1e10
    assert math.isclose(np.linalg.cond(paper.closures(zero)[1]), 6.55, abs_tol=0.005)
    m = assur.ClassIV(joints={**JOINTS, "10": ten})
    motion = m.solve(np.array([0.0, 0.05, -0.05]), order=3)
    assert (motion.status == Status.OK).all()
    links = {name: list(joints) for name, joints in m.links.items()}
    drawing = Description({**JOINTS, "10": ten}, links, {}, [("angle", "crank", "ground")])
    pose = {name: (*JOINTS[js[0]], 0.0) for name, js in links.items() if name != "ground"}
    pose["l107"] = (*ten, 0.0)
    exact = oracle.solve(drawing, (0.0,), pose, 3)
    for name in JOINTS:
        for k, of in enumerate(("value", "d1", "d2", "d3")):
            wanted = exact.joints[name].tensor(k)
            got = getattr(motion.joint(name), of)[0]
            np.testing.assert_allclose(got, wanted, rtol=1e-13, atol=1e-13)


@pytest.mark.parametrize(
    ("change", "kind", "words"),
    [
        ({"joints": JOINTS, "lengths": {}}, assur.InputError, "together"),
        ({"lengths": None}, assur.InputError, "together"),
        ({"angles": {"4-2-3": 1.0}}, assur.InputError, "'6-3-5', '7-8-6' missing"),
        ({"lengths": {"1-2": 0.35, "2-9": 1.0}}, assur.InputError, "'2-9' unknown"),
        ({"pivots": {"1": (0, 0), "9": (1, 2, 3), "10": (1, 1)}}, assur.InputError, "two finite"),
        ({"pivots": {"1": (0, 0), "9": (1, math.nan), "10": (1, 1)}}, assur.InputError, "finite"),
        ({"start": 3.0}, assur.InputError, "mapping"),
    ],
)
def test_bad_input_is_refused(change: dict[str, Any], kind: type[Exception], words: str) -> None:
    with pytest.raises(kind, match=words):
        assur.ClassIV(**{**in_papers_words(), **change})


@pytest.mark.parametrize("value", [0.0, -0.2])
def test_lengths_must_be_positive(value: float) -> None:
    words = in_papers_words()
    words["lengths"]["4-8"] = value
    with pytest.raises(assur.DimensionError, match="'4-8'") as error:
        assur.ClassIV(**words)
    assert error.value.value == value


def test_numbers_must_be_finite() -> None:
    words = in_papers_words()
    words["start"]["2-4"] = math.nan
    with pytest.raises(assur.InputError, match="start"):
        assur.ClassIV(**words)
    with pytest.raises(assur.InputError, match="'8' missing"):
        assur.ClassIV(joints={name: place for name, place in JOINTS.items() if name != "8"})


def test_links_that_cannot_meet_are_named() -> None:
    words = in_papers_words()
    words["lengths"]["5-9"] = 9.0
    with pytest.raises(assur.InputError, match="lead to no assembly"):
        assur.ClassIV(**words)
