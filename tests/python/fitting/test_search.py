"""`assur.search`: what it returns draws the path, turns, and keeps its conditions.

Limits are counted in evaluations: the same on every machine.
"""

from __future__ import annotations

import copy
import functools
import pickle
import signal
import threading
import time
from typing import TYPE_CHECKING, Any

import matplotlib as mpl
import numpy as np
import pytest

import assur
from oracles.fitting.circles import chamfer, distances, line, places, radius
from search.letters import path

if TYPE_CHECKING:
    from pathlib import Path

mpl.use("Agg")
HOOK = [(0.0, 2.0), (0.0, 0.5), (0.4, 0.0), (1.2, 0.2)]
ANGLES = np.linspace(0.0, 2.0 * np.pi, 40, endpoint=False)
EGG = np.stack([2.0 * np.cos(ANGLES), np.sin(ANGLES) + 0.2 * np.cos(2.0 * ANGLES)], axis=-1)
TURN = np.linspace(0.0, 2.0 * np.pi, 5001)


@functools.cache
def hook() -> assur.Fits[assur.LinkageFit]:
    return assur.search({"P": HOOK}, evaluations=1)


@functools.cache
def egg() -> assur.Fits[assur.LinkageFit]:
    return assur.search({"foot": EGG}, closed=True, joints=9, evaluations=1)


@functools.cache
def letter(name: str) -> assur.Fits[assur.LinkageFit]:
    return assur.search({"P": path(name)}, evaluations=40_000, threads=2)


FOUND: dict[str, tuple[Any, Any, str, bool]] = {
    "hook": (hook, HOOK, "P", False),
    "egg": (egg, EGG, "foot", True),
    "L": (functools.partial(letter, "L"), path("L"), "P", False),
}


def drawn(fit: assur.LinkageFit, turns: Any) -> dict[str, Any]:
    return places(fit.mechanism.joints, fit.mechanism.links, turns)


@pytest.mark.parametrize("which", FOUND)
def test_errors_by_another_method(which: str) -> None:
    make, points, joint, is_closed = FOUND[which]
    target = line([*points, points[0]] if is_closed else points)
    for fit in make()[:5]:
        curve = drawn(fit, fit.arc * np.linspace(0.0, 1.0, 4001))[joint]
        # Its 1 000 positions are good to a few parts in a thousand.
        assert fit.error == pytest.approx(chamfer(curve, target), rel=0.01, abs=2e-5)
        ends = fit.mechanism.solve([fit.mechanism.q0, fit.mechanism.q0 + fit.arc]).joint(joint)
        np.testing.assert_allclose(line(ends.value), curve[[0, -1]], atol=1e-9)


@pytest.mark.parametrize("which", FOUND)
def test_conditions_hold_over_the_whole_turn(which: str) -> None:
    make, points, _, is_closed = FOUND[which]
    centre, size = radius(line([*points, points[0]] if is_closed else points))
    for fit in make():
        m, at = fit.mechanism, drawn(fit, TURN)
        limits = m.limits()
        assert limits.full_rotation
        assert limits.period == 1
        extent = 2.0 * max(np.abs(z - centre).max() for z in at.values()) / size
        assert np.isfinite(extent)
        assert fit.extent == pytest.approx(extent, rel=1e-4)
        assert fit.extent <= 20.0
        least = np.pi / 2.0
        for inner in m.assembly:
            ends = [other for on in m.links.values() if inner in on for other in on[:1]]
            a, b = (at[end] - at[inner] for end in ends[:2])
            cosine = np.abs((a.conjugate() * b).real) / np.abs(a * b)
            least = min(least, float(np.arccos(cosine.max())))
        assert fit.transmission_angle == pytest.approx(least, rel=1e-4)
        assert fit.transmission_angle >= np.deg2rad(20.0)
        assert fit.joints == len(m.joints) <= (9 if is_closed else 12)
        assert abs(fit.arc) >= np.pi / 2.0
        assert not is_closed or abs(fit.arc) == pytest.approx(2.0 * np.pi, rel=1e-12)


@pytest.mark.parametrize("which", FOUND)
def test_coordinates_are_those_of_the_nearest_places(which: str) -> None:
    make, points, joint, _ = FOUND[which]
    fit = make()[0]
    curve = drawn(fit, fit.arc * np.linspace(0.0, 1.0, 200_001))[joint]
    nearest = distances(line(points), curve)
    at = fit.mechanism.solve(fit.q).joint(joint).value
    _, size = radius(line(points))
    np.testing.assert_allclose(np.abs(line(at) - line(points)), nearest, atol=2e-5 * size)
    part = (fit.q - fit.mechanism.q0) / fit.arc
    assert ((part >= -1e-12) & (part <= 1.0 + 1e-12)).all()


@pytest.mark.parametrize(("name", "most"), [("L", 0.005), ("C", 0.02)])
def test_letters(name: str, most: float) -> None:
    found = letter(name)
    assert found[0].error < most
    assert found[0].ordered_error < most


def test_the_same_bits_for_any_number_of_threads() -> None:
    one = assur.search({"P": path("L")}, evaluations=40_000, threads=1)
    two = letter("L")
    assert len(one) == len(two) > 0
    for first, second in zip(one, two, strict=True):
        assert first.mechanism == second.mechanism
        for name in ("error", "ordered_error", "arc", "sensitivity", "evaluations"):
            assert getattr(first, name) == getattr(second, name), name
        assert first.q.tobytes() == second.q.tobytes()


def test_another_seed_finds_others_and_a_price_saves_joints() -> None:
    other = assur.search({"P": HOOK}, seed=1, evaluations=1)
    assert other[0].mechanism != hook()[0].mechanism
    assert (other[0].seed, hook()[0].seed) == (1, 0)
    dear = assur.search({"P": HOOK}, joint_price=0.9, evaluations=1)
    assert dear[0].joints < hook()[0].joints


def test_the_best_come_first_and_differ() -> None:
    found = hook()
    ranks = [fit.error * 1.02**fit.joints for fit in found]
    assert ranks == sorted(ranks)
    assert len({fit.mechanism for fit in found}) == len(found) > 3
    assert found.rejected == 0
    assert [*found][1:3] == [*found[1:3]]


def test_size_and_place_of_the_path_do_not_matter() -> None:
    large = assur.search({"P": 2.0**400 * np.array(HOOK)}, evaluations=1)
    for one, other in zip(hook(), large, strict=True):
        assert (one.error, one.arc) == (other.error, other.arc)
        joints = np.array([*one.mechanism.joints.values()])
        np.testing.assert_array_equal(2.0**400 * joints, [*other.mechanism.joints.values()])


def test_repeated_and_crossing_points() -> None:
    twice = assur.search({"P": np.repeat(HOOK, 2, axis=0)}, evaluations=1)
    assert twice[0].mechanism == hook()[0].mechanism
    assert len(twice[0].q) == 8
    bow = [(0.0, 0.0), (1.0, 1.0), (0.0, 1.0), (1.0, 0.0), (0.0, 0.0)]
    crossing = assur.search({"P": bow}, evaluations=1)
    assert abs(crossing[0].arc) == pytest.approx(2.0 * np.pi, rel=1e-12)
    assert crossing[0].error < 0.05


def test_sensitivity_is_the_error_of_changed_lengths() -> None:
    fit = hook()[0]
    name, worst = next(iter(fit.sensitivities.items()))
    assert worst == fit.sensitivity == max(fit.sensitivities.values())
    assert set(fit.sensitivities) < set(fit.mechanism.dimensions)
    length = next(name for name in fit.sensitivities if name.endswith(".length"))
    errors = []
    for part in (0.999, 1.001):
        changed = fit.mechanism.with_dimensions({length: part * fit.mechanism.dimensions[length]})
        q = fit.mechanism.q0 + fit.arc * np.linspace(0.0, 1.0, 4001)
        errors.append(chamfer(line(changed.solve(q).joint("P").value), line(HOOK)))
    assert fit.sensitivities[length] == pytest.approx(max(errors), rel=0.02)
    assert fit.sensitivity > fit.error
    assert name in fit.report()


def test_robust_ranks_by_the_error_of_changed_lengths() -> None:
    robust = assur.search({"P": HOOK}, robust=1e-3, evaluations=1)
    ranks = [fit.sensitivity * 1.02**fit.joints for fit in robust]
    assert ranks == sorted(ranks)
    assert robust[0].sensitivity < hook()[0].sensitivity


def test_it_goes_on() -> None:
    found = assur.search({"P": HOOK}, evaluations=1)
    later = found.resume(evaluations=15_000)
    assert later[0].error < found[0].error
    assert later[0].evaluations > found[0].evaluations + 15_000
    for copied in (pickle.loads(pickle.dumps(later)), copy.deepcopy(later)):
        assert [fit.mechanism for fit in copied] == [fit.mechanism for fit in later]
        with pytest.raises(assur.InputError, match="has no search to go on with"):
            copied.resume()


def test_files_open_again(tmp_path: Path) -> None:
    files = egg().save(tmp_path / "new" / "folder")
    assert [file.name for file in files][:2] == ["fit_01.toml", "fit_02.toml"]
    for fit, file in zip(egg(), files, strict=True):
        assert assur.load(file) == fit.mechanism
    (tmp_path / "file").write_text("")
    with pytest.raises(assur.InputError, match="cannot be written"):
        egg().save(tmp_path / "file")


def test_time_and_progress() -> None:
    seen: list[tuple[float, float]] = []
    found = assur.search(
        {"P": HOOK}, time_limit=1.5, progress=lambda part, best: seen.append((part, best))
    )
    assert 1.0 < found[0].elapsed < 5.0
    parts = [part for part, _ in seen]
    assert parts == sorted(parts)
    assert seen[-1] == (1.0, found[0].error)


def test_the_traced_joint_may_have_any_name() -> None:
    for name in ("BC", "A_B"):
        fit = assur.search({name: HOOK}, evaluations=1)[0]
        assert fit.error == hook()[0].error
        assert name in fit.mechanism.joints
    for name in ("crank", "ground", "a b", ""):
        with pytest.raises(assur.AssurError, match=r"crank|ground|not allowed"):
            assur.search({name: HOOK}, evaluations=1)


def test_what_binds() -> None:
    lines = egg()[0].report().splitlines()
    assert lines[0].startswith(f"error {egg()[0].error:.3g} of")
    assert not any(line.startswith("arc") for line in lines)
    tight = assur.search({"P": HOOK}, joints=5, evaluations=1)[0].report()
    (joints,) = [line for line in tight.splitlines() if line.startswith("joints")]
    assert joints.split() == ["joints", "5", "at", "most", "5", "binds"]


def test_a_picture_has_path_and_target() -> None:
    axes = egg()[0].plot()
    lines = {line.get_gid(): np.array(line.get_xydata()) for line in axes.lines}
    np.testing.assert_allclose(lines["target foot"], [*EGG, EGG[0]], atol=1e-12)
    curve = drawn(egg()[0], egg()[0].arc * np.linspace(0.0, 1.0, 361))["foot"]
    np.testing.assert_allclose(line(lines["path foot"]), curve, atol=1e-9)
    (x0, x1), (y0, y1) = axes.get_xlim(), axes.get_ylim()
    assert x0 < EGG[:, 0].min() < EGG[:, 0].max() < x1
    assert y0 < EGG[:, 1].min() < EGG[:, 1].max() < y1
    axes.figure.clear()


def test_goals_that_conflict() -> None:
    with pytest.raises(assur.FitError, match="a frame of 4 radii") as raised:
        assur.search({"P": HOOK}, frame=4.0, min_apex_angle=0.9, evaluations=1)
    assert raised.value.hint is not None
    assert "min_apex_angle=0.1745 (10°)" in raised.value.hint
    with pytest.raises(assur.FitError, match="at least 75°"):
        # A crank alone would keep these.
        assur.search({"P": EGG}, closed=True, frame=4.0, min_apex_angle=1.309, evaluations=1)
    # It says the truth.
    assert assur.search({"P": HOOK}, frame=4.0, min_apex_angle=0.1745, evaluations=1)


@pytest.mark.parametrize(
    ("points", "message"),
    [
        ([], r"shape \(0,\): points \(N, 2\)"),
        (np.empty((0, 2)), "has 0 points: from 2 to 2000"),
        ([(1.0, 2.0)], "has 1 point: from 2"),
        (np.zeros((4001, 2)), r"has 4001 points: .*points\[::3\]"),
        ([(0.0, 0.0), (1.0, np.nan)], r"point 1 of 2 is \(1.0, nan\)"),
        ([(3.0, 3.0)] * 4, r"all 4 points are \(3.0, 3.0\)"),
        (np.zeros((4, 3)), r"shape \(4, 3\)"),
        (1e200 * np.array(HOOK), r"is 2e\+200 m long"),
        (None, "real numbers are needed"),
    ],
)
def test_points_that_are_no_path(points: Any, message: str) -> None:
    with pytest.raises(assur.InputError, match=message):
        assur.search({"P": points}, evaluations=1)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"joints": 3}, "joints is 3: a whole number from 4 to 40"),
        ({"joints": 41}, "joints is 41"),
        ({"min_apex_angle": np.pi / 2}, r"min_apex_angle is 1.5708 rad: .* less than 1.571"),
        ({"min_apex_angle": 20}, r"np.deg2rad\(20\)"),
        ({"frame": 3.0}, "frame is 3: the path itself needs 3.604 of its radii"),
        ({"min_arc": 6.5}, "min_arc is 6.5 rad: more than 0 and at most 6"),
        ({"min_arc": 0.0}, "min_arc is 0.0 rad"),
        ({"joint_price": 1.0}, "joint_price is 1: from 0 to less than 1"),
        ({"robust": -1e-3}, "robust is -0.001"),
        ({"time_limit": 0.0}, "time_limit is 0 s: more than 0"),
        ({"evaluations": 0}, "evaluations is 0: a whole number from 1"),
        ({"seed": -1}, "seed is -1"),
        ({"threads": 0}, "threads is 0"),
        ({"closed": 1}, "closed is 1: True or False"),
        ({"progress": "yes"}, "progress is 'yes'"),
    ],
)
def test_arguments_without_meaning(options: dict[str, Any], message: str) -> None:
    with pytest.raises(assur.InputError, match=message):
        assur.search({"P": HOOK}, **{"evaluations": 1, **options})


@pytest.mark.parametrize("targets", [{}, {"A": HOOK, "B": HOOK}, HOOK, None])
def test_targets_are_the_path_of_one_joint(targets: Any) -> None:
    with pytest.raises(assur.InputError, match="the path of one joint is needed"):
        assur.search(targets, evaluations=1)


def test_a_circle_needs_a_crank_alone() -> None:
    circle = np.stack([np.cos(ANGLES), np.sin(ANGLES)], axis=-1)
    found = assur.search({"P": circle}, closed=True, evaluations=1)
    # The inscribed polygon of 40 corners is off by 1 - cos 4.5° at most, twice.
    assert found[0].error < 0.005
    assert found[0].joints == 3


def test_a_path_that_nearly_closes() -> None:
    with pytest.warns(assur.AssurWarning, match=r"closed=True closes it"):
        found = assur.search({"P": EGG}, joints=6, evaluations=1)
    assert abs(found[0].arc) < 6.2


def test_ctrl_c_keeps_what_was_found() -> None:
    def stop(part: float, _best: float) -> None:
        if part < 1.0:
            raise KeyboardInterrupt

    with pytest.warns(assur.AssurWarning, match="the search was interrupted after"):
        found = assur.search({"P": HOOK}, evaluations=10**9, progress=stop)
    assert found[0].mechanism == hook()[0].mechanism
    assert found.resume(evaluations=10_000)[0].error <= found[0].error


def test_ctrl_c_in_the_midst_of_a_round() -> None:
    going_on = threading.Event()

    def ctrl_c() -> None:
        going_on.wait()
        time.sleep(0.02)
        signal.raise_signal(signal.SIGINT)

    thread = threading.Thread(target=ctrl_c)
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        thread.start()
        with pytest.warns(assur.AssurWarning, match="the search was interrupted after"):
            found = assur.search({"P": HOOK}, evaluations=10**9, progress=lambda *_: going_on.set())
    finally:
        going_on.set()
        thread.join()
        signal.signal(signal.SIGINT, before)
    assert found[0].evaluations < 1_000_000
