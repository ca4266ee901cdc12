"""Instant centres, centrodes, inflection circles: closed forms, Kennedy, rolling."""

from __future__ import annotations

from itertools import combinations
from typing import Any

import numpy as np
import pytest

import assur
from assur.pictures import centrodes, inflection_circle, instant_centres
from assur.pictures.centres.rate_centres import centres_of
from pictures.picture_reading import gids, named, one, texts, vector

ONE_DRIVER = [
    name for name in assur.examples.ALL if not isinstance(assur.examples.RANGES[name][0], tuple)
]


def _mechanism(name: str) -> assur.Mechanism:
    made = assur.examples.ALL[name]()
    mechanism = made if isinstance(made, assur.Mechanism) else made.mechanism
    assert mechanism is not None
    return mechanism


def _example(name: str) -> assur.Motion:
    low, high = assur.examples.RANGES[name]
    assert isinstance(low, float)
    assert isinstance(high, float)
    return _mechanism(name).solve(low + 0.29 * (high - low))


def _crossing(a: Any, b: Any, c: Any, d: Any) -> np.ndarray[Any, Any]:
    """Return where the lines ab and cd cross."""
    matrix = np.stack([b - a, c - d], axis=1)
    return np.asarray(a + (b - a) * np.linalg.solve(matrix, c - a)[0])


def test_centres_of_a_four_bar() -> None:
    motion = assur.FourBar(1.0, 3.0, 2.5, 3.0).solve(1.0)
    a, b, c, d = (motion.joint(name).value for name in "ABCD")
    ax = instant_centres(motion)
    for pair, place in (
        ("ground coupler", _crossing(a, b, c, d)),
        ("crank rocker", _crossing(a, d, b, c)),
    ):
        np.testing.assert_allclose(one(ax, f"centre {pair}").get_xydata()[0], place, atol=1e-9)
    written = {text.get_text() for text in texts(ax) if str(text.get_gid()).startswith("centre")}
    assert written == {f"$P_{{{pair}}}$" for pair in ("12", "13", "14", "23", "24", "34")}
    assert one(ax, "heading").get_text() == "1 ground, 2 crank, 3 coupler, 4 rocker"
    # Two lines through each centre that is not a joint.
    assert len(named(ax, "line of Kennedy ground coupler")) == 2
    assert not named(instant_centres(motion, lines=False), "line of Kennedy ground coupler")


def test_slides_have_centres_at_infinity() -> None:
    motion = assur.SliderCrank(0.1, 0.35).solve(0.5)
    ax = instant_centres(motion)
    tail, tip = vector(ax, "centre ground piston beyond")
    assert tip[0] == pytest.approx(tail[0], abs=1e-12)
    assert "$P_{14}^{\\infty}$" in {text.get_text() for text in texts(ax)}
    b, crank = motion.joint("B").value, motion.joint("A").value
    centre = np.array([b[0], b[0] * crank[1] / crank[0]])
    np.testing.assert_allclose(one(ax, "centre ground rod").get_xydata()[0], centre, atol=1e-9)


@pytest.mark.parametrize("name", ONE_DRIVER)
def test_kennedy(name: str) -> None:
    """All n (n - 1) / 2 centres are there, and any three of three links lie on a line."""
    motion = _example(name)
    links = list(motion.mechanism.links)
    centres = centres_of(motion, links)
    resting = sum(1 for pair in combinations(links, 2) if frozenset(pair) not in centres)
    # Links that do not move relative to each other have none: Oldham's shafts do not turn so.
    assert len(centres) == len(links) * (len(links) - 1) // 2 - resting
    assert resting == 0
    size = float(np.ptp(np.array(list(motion.mechanism.joints.values())), axis=0).max())

    def homogeneous(pair: Any) -> np.ndarray[Any, Any]:
        centre = centres[frozenset(pair)]
        at = [*centre.direction, 0.0] if centre.at is None else [*centre.at / size, 1.0]
        return np.array(at) / float(np.linalg.norm(at))

    for triple in combinations(links, 3):
        points = [homogeneous(pair) for pair in combinations(triple, 2)]
        assert abs(np.linalg.det(np.array(points))) < 1e-7, triple


@pytest.mark.parametrize("name", ["engine", "jansen_leg", "oldham", "shaper", "triad"])
def test_every_centre_is_named(name: str) -> None:
    motion = _example(name)
    links = len(motion.mechanism.links)
    ax = instant_centres(motion)
    written = [t.get_text() for t in texts(ax) if str(t.get_gid()).startswith("centre")]
    assert sum(text.count("P_") for text in written) == links * (links - 1) // 2
    assert "title" in gids(ax)


def test_chosen_centres() -> None:
    motion = _mechanism("jansen_leg").solve([0.5, 1.0])
    links = list(motion.mechanism.links)[:3]
    ax = instant_centres(motion, at=1, links=links)
    written = [t.get_text() for t in texts(ax) if str(t.get_gid()).startswith("centre")]
    assert sum(text.count("P_") for text in written) == 3


def test_centrodes_of_a_trammel() -> None:
    """Cardan's circles: the moving one has half the diameter of the fixed one."""
    motion = _mechanism("trammel").solve(0.6)
    length = float(motion.mechanism.dimensions["bar.length"])
    ax = centrodes(motion, "bar")
    fixed, moving = (one(ax, f"{kind} centrode").get_xydata() for kind in ("fixed", "moving"))
    centre = motion.joint("O").value
    np.testing.assert_allclose(np.hypot(*(fixed - centre).T), length, rtol=1e-9)
    middle = motion.joint(["A", "B"]).value.mean(axis=0)
    np.testing.assert_allclose(np.hypot(*(moving - middle).T), length / 2.0, rtol=1e-9)
    # It goes round twice, and is drawn once.
    assert len(moving) == (len(fixed) + 1) // 2


def test_centrodes_roll() -> None:
    """They touch where the links are, have one tangent there, and arcs between are equal."""
    q = np.linspace(0.3, 1.1, 801)
    motion = assur.FourBar(1.0, 3.0, 2.5, 3.0).solve(q)
    ax = centrodes(motion, "coupler", at=400)
    fixed, moving = (one(ax, f"{kind} centrode").get_xydata() for kind in ("fixed", "moving"))
    np.testing.assert_allclose(fixed[400], moving[400], atol=1e-12)
    np.testing.assert_allclose(one(ax, "pole").get_xydata()[0], fixed[400], atol=1e-12)
    tangents = [curve[401] - curve[399] for curve in (fixed, moving)]
    np.testing.assert_allclose(tangents[0], tangents[1], rtol=1e-4)
    arcs = [np.hypot(*np.diff(curve, axis=0).T) for curve in (fixed, moving)]
    np.testing.assert_allclose(arcs[0], arcs[1], rtol=1e-4)
    np.testing.assert_allclose(arcs[0].sum(), arcs[1].sum(), rtol=1e-5)


def test_centrodes_of_an_antiparallelogram() -> None:
    """Seen from the crank the rocker rolls as an ellipse on an ellipse about the joints."""
    motion = assur.FourBar(1.0, 3.0, 1.0, 3.0, mode="crossed").solve(1.0)
    ax = centrodes(motion, "rocker", other="crank")
    curve = one(ax, "fixed centrode").get_xydata()
    a, b = motion.joint("A").value, motion.joint("B").value
    sums = np.hypot(*(curve - a).T) + np.hypot(*(curve - b).T)
    np.testing.assert_allclose(sums[np.isfinite(sums)], 3.0, rtol=1e-9)


@pytest.mark.parametrize(
    ("name", "link"), [("crank_rocker", "coupler"), ("engine", "rod"), ("triad", "plate")]
)
def test_points_of_the_inflection_circle_go_straight(name: str, link: str) -> None:
    mechanism = _mechanism(name)
    motion = mechanism.solve(2.0)
    ax = inflection_circle(motion, link)
    circle = one(ax, "inflection circle")
    centre, radius = np.array(circle.get_center()), circle.get_radius()
    frame, turn = motion.reference_points[link].value, float(motion.link(link).value)
    angles = np.linspace(0.3, 6.0, 9)
    points = centre + radius * np.stack([np.cos(angles), np.sin(angles)], axis=1) - frame
    cosine, sine = np.cos(turn), np.sin(turn)
    local = points @ np.array([[cosine, -sine], [sine, cosine]])
    path = motion.point(link, local)
    cross = path.d1[:, 0] * path.d2[:, 1] - path.d1[:, 1] * path.d2[:, 0]
    scale = np.hypot(*path.d1.T) * np.hypot(*path.d2.T)
    assert (np.abs(cross) < 1e-9 * scale.max()).all()


def test_diameter_is_the_speed_of_the_pole() -> None:
    mechanism = assur.FourBar(1.0, 3.0, 2.5, 3.0)
    step = 1e-5
    rows = mechanism.solve([0.8 - step, 0.8, 0.8 + step])
    poles, angles = rows.instant_centre("coupler"), rows.link("coupler").value
    change = (poles[2] - poles[0]) / (angles[2] - angles[0])
    ax = inflection_circle(rows, "coupler", at=1, bresse=True)
    circle = one(ax, "inflection circle")
    assert 2.0 * circle.get_radius() == pytest.approx(np.hypot(*change), rel=1e-8)
    normal = np.array(circle.get_center()) - poles[1]
    assert abs(normal @ change) < 1e-8 * (change @ change)
    # On the second circle the speed does not change: the acceleration is across the velocity.
    second = one(ax, "second circle")
    for angle in (0.4, 2.0, 4.0):
        point = np.array(second.get_center()) + second.get_radius() * np.array(
            [np.cos(angle), np.sin(angle)]
        )
        arm = point - rows.joint("B").value[1]
        turn = float(angles[1])
        local = [
            arm @ [np.cos(turn), np.sin(turn)],
            arm @ [-np.sin(turn), np.cos(turn)],
        ]
        path = rows.point("coupler", local)
        v, a = path.d1[1], path.d2[1]
        assert abs(v @ a) < 1e-9 * np.hypot(*v) * max(np.hypot(*a), 1.0)
    # Where both meet, nothing accelerates.
    arm = one(ax, "acceleration pole").get_xydata()[0] - rows.joint("B").value[1]
    local = [arm @ [np.cos(turn), np.sin(turn)], arm @ [-np.sin(turn), np.cos(turn)]]
    assert np.hypot(*rows.point("coupler", local).d2[1]) < 1e-9


def test_names_differ_from_those_of_joints() -> None:
    motion = _mechanism("crank_rocker").solve(0.3)
    assert "P" in motion.mechanism.joints
    assert one(inflection_circle(motion, "coupler"), "pole name").get_text() == "I"
    other = assur.FourBar(1.0, 3.0, 2.5, 3.0).solve(0.8)
    assert one(inflection_circle(other, "coupler"), "pole name").get_text() == "P"


def test_centres_refused() -> None:
    motion = assur.SliderCrank(0.1, 0.35).solve([0.5, 1.0])
    with pytest.raises(assur.InputError, match="at"):
        instant_centres(motion)
    with pytest.raises(assur.InputError, match='no link "tower"'):
        instant_centres(motion, at=0, links=["tower", "rod"])
    with pytest.raises(assur.InputError, match="two links"):
        instant_centres(motion, at=0, links=["rod"])
    with pytest.raises(assur.InputError, match="both 'rod'"):
        centrodes(motion, "rod", other="rod")
    with pytest.raises(assur.InputError, match="does not turn"):
        centrodes(motion, "piston")
    with pytest.raises(assur.InputError, match="does not turn"):
        inflection_circle(motion, "piston", at=0)
    with pytest.raises(assur.InputError, match="is a point"):
        inflection_circle(motion, "crank", at=0)
    several = assur.examples.five_bar().solve((1.6, 1.2))
    for draw in (
        instant_centres,
        lambda m: centrodes(m, "left"),
        lambda m: inflection_circle(m, "left"),
    ):
        with pytest.raises(assur.InputError, match="one driver"):
            draw(several)
