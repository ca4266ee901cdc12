"""P5's changing structure: the crank-rocker that jams, slides and returns."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur import crank_rocker as cr

if TYPE_CHECKING:
    from assur.papers.crank_rocker import JammingRun

LENGTHS = (1.0, 4.5, 1.5)


def degrees(run: JammingRun) -> list[float]:
    return [math.degrees(event.phi1) for event in run.events]


def check_geometry(run: JammingRun, lengths: tuple[float, float, float] = LENGTHS) -> None:
    """Every length holds at every moment, and nothing jumps."""
    l1, l2, l3 = lengths
    np.testing.assert_allclose(np.hypot(*run.B.T), l1, rtol=2e-13)
    np.testing.assert_allclose(np.hypot(*(run.B - run.C).T), l2, rtol=2e-13)
    np.testing.assert_allclose(np.hypot(*(run.C - run.D).T), l3, rtol=2e-13)
    np.testing.assert_allclose(run.D[:, 0], -run.l4)
    for event in run.events:
        at = np.flatnonzero(run.t == event.t)[:2]
        if len(at) == 2:
            assert np.abs(run.C[at[0]] - run.C[at[1]]).max() < 1e-9
            assert abs(run.l4[at[0]] - run.l4[at[1]]) < 1e-9


def test_figure_8() -> None:
    run = cr.run(*LENGTHS, 4.995, gamma_min=0.2)
    check_geometry(run)
    jam, back = run.events
    assert (jam.kind, back.kind, jam.side) == ("jam", "return", "outer")
    assert abs(math.degrees(jam.phi1) - 348.2559026309) < 6e-11
    assert abs(math.degrees(back.phi1) - 360 - 11.7440973691) < 6e-11
    s = np.hypot(*(run.B - run.D).T)
    np.testing.assert_allclose(s[run.sliding], 5.977532835615105, rtol=1e-15)
    np.testing.assert_allclose(run.gamma[run.sliding], 0.2, atol=1e-13)
    assert (run.gamma[~run.sliding] > 0.2 - 1e-12).all()
    # D goes inward, the farthest where the crank points away.
    moment = cr.run(*LENGTHS, 4.995, gamma_min=0.2, phi0=math.pi, turns=0.5)
    assert abs(4.995 - moment.l4[-1] - 0.0174671643849) < 6e-14
    assert abs(jam.ground_speed[0]) == 0.0
    assert abs(jam.ground_speed[1] + 0.170183366214) < 6e-13
    assert abs(jam.rod_speed[0] + 0.405181031767) < 6e-13
    assert abs(jam.rod_speed[1] - 0.163886099242) < 6e-13
    # The way back is its mirror image.
    assert math.isclose(back.ground_speed[0], 0.170183366214, abs_tol=6e-13)
    assert back.ground_speed[1] == 0.0
    assert "D slides" in jam.text
    assert "jam, return" in repr(run)


@pytest.mark.parametrize(
    ("ground", "first", "second", "side"),
    [
        (5.2, 317.6896, 42.3103, "outer"),
        (4.0, 165.0969, 194.9031, "inner"),
        (4.005, 165.9661861905, 194.0338138095, "inner"),
    ],
)
def test_other_grounds(ground: float, first: float, second: float, side: str) -> None:
    phi0 = math.pi / 2 if side == "outer" else 0.0
    run = cr.run(*LENGTHS, ground, gamma_min=0.2, phi0=phi0)
    check_geometry(run)
    jam, back = run.events
    assert jam.side == side
    assert abs(math.degrees(jam.phi1) % 360 - first) < 6e-5
    assert abs(math.degrees(back.phi1) % 360 - second) < 6e-5
    if ground == 4.005:
        assert abs(math.degrees(jam.phi1) - first) < 6e-11
        far = cr.run(*LENGTHS, ground, gamma_min=0.2, phi0=0.0, turns=0.5)
        assert abs(far.l4[-1] - ground - 0.0395198634831) < 6e-14


def test_backwards_and_many_turns() -> None:
    """With a fixed ground the motion has the period of one turn; backwards it is the same."""
    back = cr.run(*LENGTHS, 4.995, gamma_min=0.2, speed=-2.0, turns=3, phi0=-math.pi / 2)
    check_geometry(back)
    assert [e.kind for e in back.events] == ["jam", "return"] * 3
    expected = [-348.2559026309, -371.7440973691]
    for i, angle in enumerate(degrees(back)):
        assert abs(angle - (expected[i % 2] - 360.0 * (i // 2))) < 1e-9
    forth = cr.run(*LENGTHS, 4.995, gamma_min=0.2, turns=5)
    assert len(forth.events) == 10
    # What it leaves forward it enters backward, twice as fast.
    np.testing.assert_allclose(
        back.events[0].rod_speed, -2 * np.array(forth.events[1].rod_speed[::-1]), rtol=1e-9
    )


def test_no_events_without_jamming() -> None:
    run = cr.run(*LENGTHS, 4.8, gamma_min=0.2, turns=2)
    check_geometry(run)
    assert not run.events
    assert not run.sliding.any()
    found = cr.solve(run.phi1, *LENGTHS, 4.8)
    np.testing.assert_allclose(run.gamma, found.gamma, atol=1e-13)


def test_a_touch_between_two_looks_is_seen() -> None:
    """A ground for which the blocked zone is a hundredth of a degree wide."""
    limit = math.sqrt(4.5**2 + 1.5**2 + 2 * 4.5 * 1.5 * math.cos(0.2))
    half = math.radians(0.005)
    # S² = l1² + l4² + 2 l1 l4 cos φ at the limit.
    ground = -math.cos(half) + math.sqrt(limit**2 - math.sin(half) ** 2)
    run = cr.run(*LENGTHS, ground, gamma_min=0.2, phi0=1.0001)
    assert [e.kind for e in run.events] == ["jam", "return"]
    angles = [a - 360 for a in degrees(run)]
    np.testing.assert_allclose(angles, [-0.005, 0.005], atol=1e-7)


def test_a_moving_ground() -> None:
    """The support is drawn out while the crank turns, and let in again while D slides."""

    def ground(t: float) -> float:
        return 4.8 + 0.05 * t

    run = cr.run(*LENGTHS, ground, gamma_min=0.2, turns=2)
    check_geometry(run)
    kinds = [e.kind for e in run.events]
    assert kinds[:2] == ["jam", "return"]
    jam = run.events[0]
    assert math.isclose(jam.ground_speed[0], 0.05, rel_tol=1e-9)
    assert abs(jam.l4 - ground(jam.t)) < 1e-12
    s = abs(ground(jam.t) + np.exp(1j * jam.phi1))
    assert math.isclose(s, 5.977532835615105, rel_tol=1e-13)
    back = run.events[1]
    assert abs(back.l4 - ground(back.t)) < 1e-12
    # Against the general engine: speeds before the jam by its differences.
    h = 1e-6
    rocker = [
        cr.solve(jam.phi1 + s * h, *LENGTHS, ground(jam.t + s * h)).phi3 for s in (-1.0, -2.0, -3.0)
    ]
    slope = (1.5 * (rocker[0] - rocker[1]) - 0.5 * (rocker[1] - rocker[2])) / h
    assert abs(slope - jam.rod_speed[0]) < 1e-4


def test_a_ground_that_never_lets_it_return() -> None:
    def ground(t: float) -> float:
        return 4.9 + 0.4 * t

    run = cr.run(*LENGTHS, ground, gamma_min=0.2, turns=4)
    check_geometry(run)
    assert [e.kind for e in run.events] == ["jam", "no return"]
    assert "does not come back" in run.events[-1].text
    assert run.sliding[-1]


def test_a_slide_that_ends_at_a_dead_point() -> None:
    """A jammed rod shorter than the crank does not reach the line of centres all round."""
    lengths = (1.0, 1.2, 1.0)
    rod = math.sqrt(1.2**2 + 1.0 - 2 * 1.2 * math.cos(0.6))
    assert rod < 1.0

    def ground(t: float) -> float:
        return 1.1 - 0.3 * t

    run = cr.run(*lengths, ground, gamma_min=0.6, phi0=2.3)
    check_geometry(run, lengths)
    assert [(e.kind, e.side) for e in run.events] == [("jam", "inner"), ("dead point", "inner")]
    # There the rod is across the line of centres.
    end = run.events[-1]
    assert abs(end.phi1 - (math.pi + math.asin(rod))) < 1e-7
    assert run.t[-1] == end.t
    assert "dead point" in end.text
    # A ground that stays lets it return before.
    assert [e.kind for e in cr.run(*lengths, 1.1, 0.6, phi0=2.3, turns=0.4).events] == [
        "jam",
        "return",
    ]


@pytest.mark.parametrize(
    ("change", "kind", "words"),
    [
        ({"phi0": 0.0}, assur.PositionError, "blocked"),
        ({"ground": 9.0}, assur.PositionError, "does not reach"),
        ({"gamma_min": 0.0}, assur.InputError, "gamma_min"),
        ({"speed": 0.0}, assur.InputError, "must turn"),
        ({"turns": math.nan}, assur.InputError, "turns"),
        ({"l2": -1.0}, assur.DimensionError, "l2 is -1"),
        ({"ground": -1.0}, assur.DimensionError, "ground is -1"),
        ({"ground": lambda t: math.nan if t > 1 else 4.9}, assur.InputError, "ground at t"),
    ],
)
def test_bad_input_is_refused(change: dict[str, Any], kind: type[Exception], words: str) -> None:
    given: dict[str, Any] = {"l1": 1.0, "l2": 4.5, "l3": 1.5, "ground": 4.995, "gamma_min": 0.2}
    with pytest.raises(kind, match=words):
        cr.run(**{**given, **change})
