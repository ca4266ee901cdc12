"""Errors of paths, functions and poses against brute force in NumPy."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import assur
from assur import metric
from oracles.kinematics import target_distances as by_hand

TURN = np.linspace(0.0, 2.0 * np.pi, 90, endpoint=False)
RNG = np.random.default_rng(11)
# A curve with a loop, and one with corners.
T = np.linspace(0.0, 2.0 * np.pi, 40, endpoint=False)
EIGHT = np.column_stack([1.4 + 1.1 * np.cos(T), 2.4 + 0.6 * np.sin(2.0 * T) + 0.2 * np.cos(T)])
ZIGZAG = np.array([[0.5, 2.0], [2.0, 3.1], [2.4, 1.8], [3.0, 2.9]])


def four_bar() -> assur.Mechanism:
    return assur.Mechanism(
        joints={"A": (0, 0), "B": (1, 0), "C": (4.1, 3.2), "D": (4.8, 0), "P": (3, 4)},
        links={"ground": "AD", "crank": "AB", "coupler": "BCP", "rocker": "DC"},
        driver="crank",
    )


def measured(m: assur.Mechanism, q: Any, asked: metric.Metric) -> float:
    return float(assur.sweep(m, {}, q, metrics={"it": asked})["it"])


def path(m: assur.Mechanism, q: Any, closed: bool, name: str = "P") -> Any:
    return by_hand.corners(m.solve(q, outputs=[name]).joint(name).value, closed)


@pytest.mark.parametrize("q", [TURN, TURN[:50], TURN[::-1], TURN[5:7], TURN[:1]])
@pytest.mark.parametrize("points", [EIGHT, ZIGZAG, EIGHT[:2]])
def test_points_by_all_pairs(q: Any, points: Any) -> None:
    m = four_bar()
    line = path(m, q, len(q) == len(TURN))
    wanted = by_hand.points_error(line if len(line) > 1 else np.vstack([line, line]), points)
    assert measured(m, q, metric.path_error("P", points)) == pytest.approx(wanted, rel=1e-12)


@pytest.mark.parametrize(("points", "closed"), [(EIGHT, True), (EIGHT, False), (ZIGZAG, False)])
@pytest.mark.parametrize("q", [TURN, TURN[:50]])
def test_chamfer_by_all_pairs(q: Any, points: Any, closed: bool) -> None:
    m = four_bar()
    asked = metric.path_error("P", points, kind="chamfer", closed=closed)
    found = measured(m, q, asked)
    line, target = path(m, q, len(q) == len(TURN)), by_hand.corners(points, closed)
    # The radius by many points is good to ten digits.
    assert found == pytest.approx(by_hand.chamfer_at_corners(line, target, 256), rel=1e-9)
    assert found == pytest.approx(by_hand.chamfer(line, target, 5000), rel=3e-3)


@pytest.mark.parametrize("q", [TURN, TURN[:50], TURN[40::-1]])
def test_ordered_by_trying_every_start(q: Any) -> None:
    m = four_bar()
    closes = len(q) == len(TURN)
    for points, closed in ((EIGHT, True), (EIGHT[::-1], True), (EIGHT, False), (ZIGZAG, False)):
        asked = metric.path_error("P", points, kind="ordered", closed=closed)
        line, target = path(m, q, closes and closed), by_hand.corners(points, closed)
        # 2π times the square is the ordered distance (OD) with 2000 points.
        wanted = 2.0 * np.pi * by_hand.ordered_square(line, target, 2000, closed)
        assert 2.0 * np.pi * measured(m, q, asked) ** 2 == pytest.approx(wanted, rel=3e-3)
        coarse = by_hand.ordered_square(line, target, 256, closed)
        assert measured(m, q, asked) ** 2 <= coarse * (1.0 + 1e-9)


@pytest.mark.parametrize("kind", ["points", "chamfer", "ordered"])
def test_a_path_has_no_error_from_itself(kind: Any) -> None:
    m = four_bar()
    points = m.solve(TURN, outputs=["P"]).joint("P").value
    moved = np.roll(points[::-1], 31, axis=0)
    closed = None if kind == "points" else True
    error = measured(m, TURN, metric.path_error("P", moved, kind=kind, closed=closed))
    assert error < 1e-9


def test_where_the_target_is_counts_and_its_unit_does_not() -> None:
    m = four_bar()
    for kind in ("points", "chamfer", "ordered"):
        closed = None if kind == "points" else True
        here, far = (
            measured(
                m.with_dimensions({n: size * v for n, v in m.dimensions.items()}),
                TURN,
                metric.path_error("P", size * EIGHT, kind=kind, closed=closed),
            )
            for size in (1.0, 2.0**-400)
        )
        assert far == pytest.approx(here, rel=1e-12)
        away = metric.path_error("P", EIGHT + np.array([5.0, 0.0]), kind=kind, closed=closed)
        assert measured(m, TURN, away) > 2.0 * here


def test_a_joint_at_rest_and_conditions() -> None:
    m = four_bar()
    far = np.sqrt(np.mean(np.sum((EIGHT - m.joints["D"]) ** 2, axis=1)))
    asked = metric.path_error("D", EIGHT)
    expected = far / by_hand.radius_of_points(EIGHT)
    assert measured(m, TURN, asked) == pytest.approx(expected, rel=1e-12)
    line = by_hand.corners(EIGHT, closed=True)
    for kind in ("chamfer", "ordered"):
        assert np.isfinite(measured(m, TURN, metric.path_error("D", line, kind=kind)))
    lengths = {"coupler.length": np.linspace(3.5, 5.0, 20)}
    errors = assur.sweep(m, lengths, TURN, metrics={"it": metric.path_error("P", EIGHT)})["it"]
    limit = float(np.nanmedian(errors))
    where = [metric.path_error("P", EIGHT) < limit]
    kept = assur.sweep(m, lengths, TURN, metrics={}, where=where).kept
    assert np.array_equal(kept, np.flatnonzero(errors < limit))
    assert 0 < len(kept) < 20


@pytest.mark.parametrize("of", ["rocker", "coupler", "crank", "P.x"])
@pytest.mark.parametrize("q", [TURN, TURN[::-1], np.linspace(-4.0 * np.pi, 4.0 * np.pi, 361)])
def test_functions_by_hand(of: str, q: Any) -> None:
    """Also where theta, or an angle, passes the end of the turn."""
    m = four_bar()
    theta = np.arange(-30, 31) * (q[1] - q[0])
    motion = m.solve(theta, outputs=["P", of.partition(".")[0]])
    exact = motion.joint("P").value[:, 0] if of == "P.x" else motion.link(of).value
    off = 0.01 * RNG.normal(size=len(theta))
    wrapped = exact if of == "P.x" else np.angle(np.exp(1j * exact))
    shuffled = RNG.permutation(len(theta))
    pair = theta[shuffled], (wrapped - off)[shuffled]
    fixed = metric.function_error(of, *pair)
    assert measured(m, q, fixed) == pytest.approx(np.sqrt(np.mean(off**2)), rel=1e-9)
    value = pair[1] + 1.7
    free = metric.function_error(of, pair[0], value, offset="free")
    assert measured(m, q, free) == pytest.approx(np.std(off), rel=1e-9)
    values = np.polyval([0.7, 0.2], exact) + off
    scaled = metric.function_error(of, theta, values, offset="free", scale="free")
    residual = values - np.polyval(np.polyfit(exact, values, 1), exact)
    if q is not TURN or of in ("P.x", "rocker"):
        assert measured(m, q, scaled) == pytest.approx(np.sqrt(np.mean(residual**2)), rel=1e-7)


def test_a_coordinate_at_rest_matches_no_function() -> None:
    m, theta = four_bar(), TURN[:20]
    asked = metric.function_error("D.x", theta, np.sin(theta), offset="free", scale="free")
    assert measured(m, theta, asked) == pytest.approx(np.std(np.sin(theta)), rel=1e-12)


def test_a_slide_and_a_driven_slide() -> None:
    engine = assur.examples.engine()
    bore = engine.solve(TURN, outputs=["bore"]).slide("bore").value
    asked = metric.function_error("bore", TURN[::5], bore[::5] + 0.001)
    assert measured(engine, TURN, asked) == pytest.approx(0.001, rel=1e-9)
    turned = engine.with_driver("bore", q=1.0)
    q = float(turned.q0) + np.linspace(-0.01, 0.01, 11)
    crank = turned.solve(q, outputs=["crank"]).link("crank").value
    asked = metric.function_error("crank", q[2:5], crank[2:5] - 2.0 * np.pi)
    assert measured(turned, q, asked) < 1e-12


@pytest.mark.parametrize("link", ["coupler", "crank", "rocker", "ground"])
@pytest.mark.parametrize("q", [TURN, TURN[:40], TURN[::-1], np.linspace(-7.0, 7.0, 200)])
def test_poses_by_fine_steps(link: str, q: Any) -> None:
    m = four_bar()
    first = {"coupler": "B", "crank": "A", "rocker": "D", "ground": "A"}[link]
    motion = m.solve(q, outputs=[first, link])
    taken = np.column_stack([motion.joint(first).value, motion.link(link).value])
    poses = taken[2:40:9] + RNG.normal(scale=0.1, size=(5, 3)) + [0.0, 0.0, 4.0 * np.pi]
    if len(q) == len(TURN):
        last = taken[0, 2] + 2.0 * np.pi * np.round((taken[-1, 2] - taken[0, 2]) / (2.0 * np.pi))
        taken = np.vstack([taken, [*taken[0, :2], last]])
    for length in (0.3, 2.0):
        found = measured(m, q, metric.pose_error(link, poses, length=length))
        assert found == pytest.approx(by_hand.poses_error(taken, poses, length), rel=1e-4)
    spread = by_hand.radius_of_points(poses[:, :2])
    found = measured(m, q, metric.pose_error(link, poses))
    assert found == pytest.approx(measured(m, q, metric.pose_error(link, poses, length=spread)))


def test_several_drivers() -> None:
    m = assur.examples.five_bar()
    q = np.asarray(m.q0) + np.linspace(0.0, 0.2, 12)[:, np.newaxis] * [1.0, -0.5]
    line = path(m, q, closed=False)
    points = line[3:8] + np.array([0.0, 0.01])
    wanted = by_hand.points_error(line, points)
    assert measured(m, q, metric.path_error("P", points)) == pytest.approx(wanted, rel=1e-12)
    with pytest.raises(assur.InputError, match="one driver; this mechanism has 2"):
        measured(m, q, metric.function_error("P.x", [0.0], [0.0]))


def test_designs_and_threads() -> None:
    m = four_bar()
    space = {"coupler.length": np.linspace(3.5, 9.0, 30)}
    theta = TURN[::9]
    asked = {
        **{k: metric.path_error("P", EIGHT, kind=k) for k in ("points", "chamfer", "ordered")},
        "function": metric.function_error("rocker", theta, 2.0 + 0.3 * np.sin(theta)),
        "pose": metric.pose_error("coupler", [(1.0, 0.2, 0.4), (0.2, 1.0, 0.6)]),
    }
    found = [
        assur.sweep(m, space, TURN, metrics=asked, gradient="*.length", threads=threads)
        for threads in (1, 2)
    ]
    assert 5 < len(found[0].kept) < 30
    for name, one in asked.items():
        assert np.array_equal(found[0][name], found[1][name], equal_nan=True)
        assert np.array_equal(found[0].gradient[name], found[1].gradient[name], equal_nan=True)
        for design in (0, 5, found[0].kept[-1]):
            alone = m.with_dimensions({"coupler.length": space["coupler.length"][design]})
            assert measured(alone, TURN, one) == found[0][name][design]


PATH: Any = metric.path_error
FUNCTION: Any = metric.function_error
POSE: Any = metric.pose_error
REFUSED: dict[str, tuple[Any, str]] = {
    "no points": (lambda: PATH("P", []), "points: it is empty"),
    "one point": (lambda: PATH("P", [(1, 2)]), "one point has no size: two different ones"),
    "one point thrice": (lambda: PATH("P", [(1, 2)] * 3), "all 3 points are the same"),
    "a NaN": (lambda: PATH("P", [(1, 2), (np.nan, 1)]), "points: entry 1 is not finite"),
    "too large": (lambda: PATH("P", [(-1e308, 0), (1e308, 1)]), "too far apart"),
    "three columns": (lambda: PATH("P", np.zeros((4, 3))), r"shape \(4, 3\): \(N, 2\) is needed"),
    "one row": (lambda: PATH("P", [1.0, 2.0]), r"shape \(2,\): \(N, 2\)"),
    "closed points": (lambda: PATH("P", EIGHT, closed=True), "closed=True is for kind='chamfer'"),
    "two in a circle": (
        lambda: PATH("P", [(1, 2), (1, 2), (2, 2)], kind="ordered", closed=True),
        "2 points do not make a closed path: 3 are needed",
    ),
    "an unknown kind": (lambda: PATH("P", EIGHT, kind="hausdorff"), "kind is 'hausdorff': one of"),
    "text": (lambda: PATH("P", "circle"), "path_error: points is 'circle'"),
    "no name": (lambda: PATH(3, EIGHT), "path_error: the name 3"),
    "no function": (lambda: FUNCTION("P.x", [], []), "theta has 0 numbers, at least 1 are needed"),
    "different lengths": (lambda: FUNCTION("P.x", [1, 2], [1]), "theta has 2 entries, value 1"),
    "a NaN in a function": (lambda: FUNCTION("P.x", [1], [np.nan]), "value has nan"),
    "a table": (lambda: FUNCTION("P.x", [[1]], [1]), r"theta has shape \(1, 1\): \(N,\)"),
    "too few for a line": (
        lambda: FUNCTION("P.x", [1, 2], [1, 2], offset="free", scale="free"),
        "theta has 2 numbers, at least 3 are needed: with what is free fewer fit any motion",
    ),
    "a scale alone": (lambda: FUNCTION("P.x", [1], [1], scale="free"), "needs offset='free'"),
    "an odd offset": (lambda: FUNCTION("P.x", [1], [1], offset=True), "offset is True: one of"),
    "no poses": (lambda: POSE("coupler", []), "poses: it is empty"),
    "one pose": (lambda: POSE("coupler", [(1, 2, 3)]), "two different ones are needed; give leng"),
    "turned on the spot": (
        lambda: POSE("coupler", [(1, 2, 3), (1, 2, 4)]),
        "all 2 points are the same: two different ones are needed; give length=",
    ),
    "points as poses": (lambda: POSE("coupler", EIGHT), r"shape \(40, 2\): \(N, 3\) is needed"),
    "a NaN in a pose": (lambda: POSE("coupler", [(1, 2, 3), (2, 1, np.inf)]), "entry 1 is not fin"),
    "no length": (lambda: POSE("coupler", [(1, 2, 3)], length=0.0), "length is 0: it must be"),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_targets_without_meaning(name: str) -> None:
    make, words = REFUSED[name]
    with pytest.raises(assur.InputError, match=words):
        make()


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        (PATH("Q", EIGHT), 'no joint "Q"'),
        (PATH("coupler", EIGHT), 'no joint "coupler"'),
        (POSE("P", [(1, 2, 3)], length=1.0), 'no link "P"'),
        (FUNCTION("P", [0.0], [1.0]), 'coordinate "P" is a joint: "P.x" or "P.y" is needed'),
        (
            FUNCTION("rocker", [0.0, 0.5, 7.0], [1.0, 1.0, 1.0]),
            r"theta\[1\] = 0.5 is not one of the positions of q: pass q=theta",
        ),
    ],
)
def test_names_and_coordinates_that_are_not_there(asked: metric.Metric, words: str) -> None:
    with pytest.raises(assur.InputError, match=words):
        measured(four_bar(), TURN, asked)
