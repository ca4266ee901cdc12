"""The oracle itself, against closed forms, printed numbers and its own differences."""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from models.mechanisms import dyad_models, named_models
from models.mechanisms.mechanism_data import Description, SlideSpec
from oracles.kinematics import oracle, oracle_guess
from oracles.kinematics.oracle import solve
from oracles.kinematics.oracle_system import MP, Pose, System

if TYPE_CHECKING:
    from collections.abc import Callable

TINY = MP.mpf("1e-30")
QUICK = settings(max_examples=15, deadline=None)


def at_drawing(d: Description, order: int = 3) -> oracle.Solution:
    return solve(d, oracle_guess.drawing_q(d), oracle_guess.drawing_pose(d), order)


def near_drawing(d: Description, move: float) -> tuple[tuple[float, ...], Pose]:
    """Towards q0 + move, or halfway to the fold before it."""
    start = oracle_guess.drawing_q(d)
    q = tuple(v + move for v in start)
    try:
        return q, oracle_guess.follow(d, q, 4)
    except oracle_guess.StuckError as stuck:
        q = tuple((a + b) / 2 for a, b in zip(start, stuck.q, strict=True))
        return q, oracle_guess.follow(d, q, 4)


def check_rigid(d: Description, s: oracle.Solution) -> None:
    """Distances within a link and angles between sliding links are those of the drawing."""
    for joints in d.links.values():
        for a, b in itertools.combinations(joints, 2):
            now = np.array(s.joints[a].partials[()]) - np.array(s.joints[b].partials[()])
            was = [MP.mpf(u) - MP.mpf(v) for u, v in zip(d.joints[a], d.joints[b], strict=True)]
            assert abs(MP.hypot(*now) - MP.hypot(*was)) < TINY
    for slide in d.slides.values():
        turns = [s.links[n].partials[()][0] for n in (slide.link, slide.on)]
        drawn = [at_drawing(d, 0).links[n].partials[()][0] for n in (slide.link, slide.on)]
        assert abs((turns[0] - turns[1]) - (drawn[0] - drawn[1])) < TINY


def check_derivatives(d: Description, q: tuple[float, ...], guess: Pose) -> None:
    """Each partial of order k + 1 against the difference of partials of order k."""
    h = MP.mpf("1e-12")
    here = solve(d, q, guess)
    for i in range(len(q)):
        moved = [MP.mpf(v) for v in q]
        ends = []
        for sign in (1, -1):
            moved[i] = MP.mpf(q[i]) + sign * h
            ends.append(solve(d, moved, here.pose))
        for kind in ("joints", "links", "slides"):
            for name, jet in getattr(here, kind).items():
                up, down = (getattr(e, kind)[name].partials for e in ends)
                size = max(abs(v) for values in jet.partials.values() for v in values) + 1
                for index in jet.partials:
                    if len(index) == 3:
                        continue
                    want = jet.partials[tuple(sorted((*index, i)))]
                    for p, m, w in zip(up[index], down[index], want, strict=True):
                        # truncation: h²/6 times two orders more, each perhaps size larger
                        assert abs((p - m) / (2 * h) - w) < h * size


@pytest.mark.parametrize("make", named_models.NAMED.values(), ids=named_models.NAMED)
def test_named(make: Callable[[], Description]) -> None:
    d = make()
    s = at_drawing(d)
    assert s.residual < 1e-40
    for name, place in d.joints.items():
        # q of the drawing is rounded
        assert s.joints[name].value == pytest.approx(place, rel=1e-14, abs=1e-14)
    q, pose = near_drawing(d, 0.25)
    check_rigid(d, solve(d, q, pose, 0))
    check_derivatives(d, q, pose)


@QUICK
@given(dyad_models.sequences(), st.floats(-0.3, 0.3))
def test_random(case: dyad_models.Case, move: float) -> None:
    d = case.description
    q, pose = near_drawing(d, move)
    s = solve(d, q, pose, 1)
    check_rigid(d, s)
    guess = oracle_guess.guess_from_joints(
        d,
        {n: j.value for n, j in s.joints.items()},
        {n: float(j.value) for n, j in s.links.items()},
    )
    for link, place in s.pose.items():
        assert guess[link] == pytest.approx(place, abs=1e-9)


@pytest.mark.parametrize("driver", dyad_models.DRIVERS)
@pytest.mark.parametrize("kind", dyad_models.KINDS)
def test_analogues_are_differences(driver: str, kind: str) -> None:
    d = dyad_models.build(7, driver, (kind,)).description
    check_derivatives(d, oracle_guess.drawing_q(d), oracle_guess.drawing_pose(d))


@QUICK
@given(dyad_models.sequences())
def test_jacobian(case: dyad_models.Case) -> None:
    system = System(case.description, exact=False)
    z, q = system.drawing()
    z = [v + 0.1 * math.sin(i) for i, v in enumerate(z)]  # off the drawing, not assembled
    system.put(0, z)
    jacobian = system.jacobian()
    for i in range(len(z)):
        ends = []
        for h in (1e-6, -1e-6):
            system.put(0, [*z[:i], z[i] + h, *z[i + 1 :]])
            ends.append(np.array(system.residual(0, q)))
        scale = 1 + np.max(np.abs(z))
        assert (ends[0] - ends[1]) / 2e-6 == pytest.approx(jacobian[:, i], abs=1e-8 * scale)


@pytest.mark.parametrize("kind", dyad_models.KINDS)
@pytest.mark.parametrize("driver", dyad_models.DRIVERS)
def test_built_as_asked(kind: str, driver: str) -> None:
    for seed in range(4):
        case = dyad_models.build(seed, driver, (kind, kind))
        assert case == dyad_models.build(seed, driver, (kind, kind))
        assert [k for k, _ in case.dyads] == [kind, kind]
        assert math.isfinite(at_drawing(case.description, 1).condition)


def test_slider_crank_closed_form() -> None:
    r, rod, q = MP.mpf(0.05), MP.mpf(0.05 + 0.2) - MP.mpf(0.05), MP.mpf(2.1)

    def x(t: Any) -> Any:
        return r * MP.cos(t) + MP.sqrt(rod**2 - (r * MP.sin(t)) ** 2)

    joints = {"O": (0.0, 0.0), "A": (0.05, 0.0), "B": (0.05 + 0.2, 0.0)}
    links = {"ground": ["O"], "piston": ["B"], "crank": ["O", "A"], "rod": ["A", "B"]}
    slides = {"bore": SlideSpec("piston", "ground", 0.0, "O")}
    d = Description(joints, links, slides, [("angle", "crank", "ground")])
    s = solve(d, q, oracle_guess.follow(d, float(q)))
    for k, index in enumerate([(), (0,), (0, 0), (0, 0, 0)]):
        # numerical differentiation keeps only a part of the digits
        want = MP.diff(x, q, k) if k else x(q)
        assert abs(s.slides["bore"].partials[index][0] - want) < (MP.mpf("1e-20") if k else TINY)
        assert s.joints["B"].partials[index][0] == pytest.approx(want, rel=1e-20)
    rod_angle = -MP.asin(r * MP.sin(q) / rod)
    assert abs(s.links["rod"].partials[()][0] - rod_angle) < TINY


@pytest.mark.parametrize(
    ("sign", "coupler", "rocker"), [(-1, 20.298, 57.325), (1, -60.978, -98.005)]
)
def test_four_bar_numbers(sign: int, coupler: float, rocker: float) -> None:
    d = named_models.four_bar(40, 120, 80, 100, q=1.0, sign=sign)
    q = math.radians(40)
    s = solve(d, q, oracle_guess.follow(d, q))
    assert math.degrees(s.links["coupler"].value) == pytest.approx(coupler, abs=5e-4)
    assert math.degrees(s.links["rocker"].value) == pytest.approx(rocker, abs=5e-4)


def test_jansen_foot() -> None:
    d = named_models.jansen()
    foot = solve(d, 0.0, oracle_guess.follow(d, 0.0)).joints["7"]
    assert foot.value == pytest.approx([-43.170055, -91.753226], abs=5e-7)


def test_whole_turn_comes_back() -> None:
    d = named_models.crank_rocker()
    q = oracle_guess.drawing_q(d)[0] + math.tau
    s = solve(d, q, oracle_guess.follow(d, q), 0)
    assert s.joints["C"].value == pytest.approx(d.joints["C"], abs=1e-12)
    assert s.links["crank"].value == pytest.approx(math.tau)
    # the same place asked from a guess one turn away
    s = solve(d, q, oracle_guess.drawing_pose(d), 0)
    assert abs(oracle.angle_gap(s.links["crank"].value, q)) < 1e-15


def test_stuck_at_a_dead_point() -> None:
    c = named_models.crank_rocker()
    d = Description(c.joints, c.links, {}, [("angle", "rocker", "ground")])
    with pytest.raises(oracle_guess.StuckError) as caught:
        oracle_guess.follow(d, oracle_guess.drawing_q(d)[0] + 2.0)
    # there crank and coupler are in line: B, A, C
    s = solve(d, caught.value.q, caught.value.pose, 0)
    gap = oracle.angle_gap(s.links["crank"].value, s.links["coupler"].value)
    assert abs(math.sin(gap)) < 1e-3


def test_no_assembly_is_an_error() -> None:
    c = named_models.crank_rocker()
    d = Description(c.joints, c.links, {}, [("angle", "rocker", "ground")])
    with pytest.raises(oracle.NoConvergenceError):
        solve(d, oracle_guess.drawing_q(d)[0] + 2.0, oracle_guess.drawing_pose(d))


@pytest.mark.parametrize("name", ["triangle", "four_bar_with_diagonal"])
def test_locked_has_no_motion(name: str) -> None:
    d = named_models.locked()[name]
    system = System(d)
    system.drawing()
    assert np.linalg.matrix_rank(system.jacobian()[:-1]) == system.jacobian().shape[1]


def test_known_motions() -> None:
    yoke = at_drawing(named_models.scotch_yoke())
    assert yoke.slides["bed"].d1 == pytest.approx(-0.8, rel=1e-15)
    assert yoke.slides["bed"].d2 == pytest.approx(-0.6, rel=1e-15)
    assert yoke.joints["Y"].value.tolist() == [2.0, 0.0]
    shafts = at_drawing(named_models.oldham())
    assert shafts.links["shaft2"].d1 == 1.0
    assert abs(shafts.links["shaft2"].d2) < 1e-40
    assert shafts.links["shaft2"].value == pytest.approx(0.4 + math.pi / 2)
    # the disc's centre runs twice a turn round the circle on O1 O2: its value is the projection
    along = 0.3 * math.cos(0.4) + 0.1 * math.sin(0.4)
    assert shafts.slides["tongue1"].value == pytest.approx(along, rel=1e-14)
    boom = named_models.excavator()
    s = solve(boom, 2.3, oracle_guess.follow(boom, 2.3), 0)
    assert math.dist(s.joints["O"].value, s.joints["T"].value) == pytest.approx(2.3, rel=1e-15)
    arm = at_drawing(named_models.coupler_driven())
    plain = at_drawing(named_models.crank_rocker())
    assert arm.links["crank"].d1 == pytest.approx(1 / plain.links["coupler"].d1, rel=1e-14)


def test_two_drivers_shapes() -> None:
    s = at_drawing(named_models.five_bar())
    c, link = s.joints["C"], s.links["l2"]
    assert [c.tensor(k).shape for k in range(4)] == [(2,), (2, 2), (2, 2, 2), (2, 2, 2, 2)]
    assert [link.tensor(k).shape for k in range(4)] == [(), (2,), (2, 2), (2, 2, 2)]
    assert s.joints["B"].d1[:, 1].tolist() == [0.0, 0.0]
