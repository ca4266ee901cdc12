"""`assur.fit`: what it returns meets targets and conditions, by a motion of its own.

Limits are counted in evaluations: the same on every machine.
"""

from __future__ import annotations

import copy
import pickle
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur import metric, target
from oracles.fitting.four_bar import moved, transmission, turns

if TYPE_CHECKING:
    from pathlib import Path

ROUND = 5_000
TURN = np.linspace(0.0, 2.0 * np.pi, 2001)


def four_bar(names: str = "BCP") -> assur.Mechanism:
    return assur.Mechanism(
        joints={"A": (0, 0), "B": (1, 1), "C": (4, 2), "D": (4, 0), "P": (2, 3)},
        links={
            "ground": ["A", "D"],
            "crank": ["A", "B"],
            "coupler": list(names),
            "rocker": ["D", "C"],
        },
        driver="crank",
    )


def numbers(fit: assur.DesignFit) -> tuple[dict[str, float], int]:
    dimensions = {name: float(value) for name, value in fit.mechanism.dimensions.items()}
    return dimensions, fit.mechanism.assembly["C"]


def radius(points: Any) -> float:
    points = np.asarray(points)
    return float(np.sqrt(((points - points.mean(axis=0)) ** 2).sum(axis=1).mean()))


DRAWN = {
    "ground.A.x": 0.3,
    "ground.A.y": -0.2,
    "ground.D.x": 3.1,
    "ground.D.y": 0.6,
    "crank.length": 0.9,
    "coupler.length": 2.8,
    "rocker.length": 2.4,
    "coupler.P.x": 1.7,
    "coupler.P.y": 1.3,
}


def path(count: int = 24) -> Any:
    q = np.linspace(0.0, 2.0 * np.pi, count, endpoint=False)
    p = moved(DRAWN, 1, q)["P"]
    return np.stack([p.real, p.imag], axis=-1)


def test_a_curve_gives_back_a_mechanism_that_draws_it() -> None:
    found = assur.fit(four_bar(), {"P": path()}, closed=True, evaluations=20 * ROUND)
    best = found[0]
    assert best.error < 1e-9
    assert best.full_rotation
    dimensions, sign = numbers(best)
    assert turns(dimensions)
    p = moved(dimensions, sign, best.q)["P"]
    away = np.abs(p - path() @ (1, 1j))
    # The error is that of the oracle.
    assert np.sqrt((away**2).mean()) / radius(path()) == pytest.approx(best.error, abs=1e-12)
    # Cognates draw it too; each is a design of its own.
    values = [tuple(np.round(list(fit.mechanism.dimensions.values()), 4)) for fit in found]
    assert len(set(values)) == len(found)


def test_errors_are_those_of_an_independent_motion() -> None:
    egg = np.stack(
        [2.0 * np.cos(TURN[:2000:100]), np.sin(TURN[:2000:100]) + 0.2 * np.cos(TURN[:2000:100])],
        axis=-1,
    )
    for fit in assur.fit(four_bar(), {"P": egg}, closed=True, evaluations=1):
        dimensions, sign = numbers(fit)
        assert turns(dimensions)
        p = moved(dimensions, sign, fit.q)["P"]
        away = np.abs(p - egg @ (1, 1j))
        assert np.sqrt((away**2).mean()) / radius(egg) == pytest.approx(fit.error, rel=1e-9)
        # In order, once round.
        steps = np.diff(fit.q)
        assert (steps > 0).all() or (steps < 0).all()
        assert abs(fit.q[-1] - fit.q[0]) < 2.0 * np.pi
        least = transmission(dimensions, sign, TURN).min()
        assert fit.transmission_angle == pytest.approx(least, abs=1e-5)


def test_the_sine_over_a_right_angle() -> None:
    # Least squares of the structural error: 0.4437539016°, computed elsewhere in two ways, of
    # nine Chebyshev points; the crank from 97° over 120°, the rocker from 60° over 60°.
    k = np.arange(1, 10)
    x = np.deg2rad(45.0 - 45.0 * np.cos((2 * k - 1) * np.pi / 18.0))
    theta = np.deg2rad(97.0) + x * (120.0 / 90.0)
    psi = np.deg2rad(60.0 + 60.0 * np.sin(x))
    m = four_bar()
    found = assur.fit(
        m,
        {"rocker": (theta, psi)},
        vary=["*.length"],
        bounds={"*.length": (0.05, 20.0)},
        evaluations=4 * ROUND,
    )
    assert np.rad2deg(found[0].error) == pytest.approx(0.4437539016, abs=1e-9)
    dimensions, sign = numbers(found[0])
    rocker = moved(dimensions, sign, theta)["rocker"]
    off = np.rad2deg(np.angle(np.exp(1j * (rocker - psi))))
    assert np.sqrt((off**2).mean()) == pytest.approx(0.4437539016, abs=1e-9)


def test_poses_of_a_coupler() -> None:
    q = np.array([0.2, 0.9, 1.7, 2.4, 3.5])
    at = moved(DRAWN, 1, q)
    poses = np.stack([at["P"].real, at["P"].imag, np.angle(at["B"] - at["P"])], axis=-1)
    # The body is fixed to the coupler at any angle.
    poses[:, 2] += 0.7
    m = four_bar("PBC")
    wanted = {"coupler": target.Poses(poses, turned=True)}
    found = assur.fit(m, wanted, evaluations=60 * ROUND)
    assert found[0].error < 1e-8


def test_timing_up_to_a_phase() -> None:
    q = np.linspace(0.0, 2.0 * np.pi, 12, endpoint=False)
    p = moved(DRAWN, 1, q + 0.4)["P"]
    points = np.stack([p.real, p.imag], axis=-1)
    wanted = {"P": target.Path(points, timing=q, phase=True)}
    best = assur.fit(four_bar(), wanted, evaluations=10 * ROUND)[0]
    assert best.error < 1e-9
    assert np.ptp(best.q - q) < 1e-12


def test_conditions_hold_over_the_whole_turn() -> None:
    lemniscate = np.array(
        [
            (np.cos(t) / (1 + np.sin(t) ** 2), np.sin(t) * np.cos(t) / (1 + np.sin(t) ** 2))
            for t in np.linspace(0.0, 2.0 * np.pi, 20, endpoint=False)
        ]
    )
    limit = np.deg2rad(40.0)
    where = [metric.min_transmission_angle("C") > limit, metric.max("C.x") < 2.0]
    found = assur.fit(
        four_bar(), {"P": lemniscate}, closed=True, where=where, evaluations=3 * ROUND
    )
    for fit in found:
        dimensions, sign = numbers(fit)
        assert transmission(dimensions, sign, TURN).min() >= limit - 1e-9
        assert moved(dimensions, sign, TURN)["C"].real.max() < 2.0
    text = found[0].report()
    assert "min_transmission_angle('C')" in text
    assert "binds" in text


def test_bounds_and_ties_hold() -> None:
    found = assur.fit(
        four_bar(),
        {"P": path()},
        closed=True,
        vary="*",
        ties=[("rocker.length", "coupler.length"), ("ground.A.x", "ground.D.x", -1.0)],
        bounds={"crank.length": (1.0, 1.1), "ground.A.y": (0.0, 0.0)},
        evaluations=ROUND,
    )
    for fit in found:
        dimensions, _ = numbers(fit)
        assert dimensions["rocker.length"] == dimensions["coupler.length"]
        assert dimensions["ground.A.x"] == -dimensions["ground.D.x"]
        assert 1.0 <= dimensions["crank.length"] <= 1.1
        assert dimensions["ground.A.y"] == 0.0


def test_what_does_not_vary_stays() -> None:
    m = four_bar()
    wanted = {"P": target.Path(path(), closed=True, ordered=False)}
    fit = assur.fit(m, wanted, vary=["coupler.*"], evaluations=1)[0]
    for name, value in m.dimensions.items():
        if not name.startswith("coupler"):
            assert fit.mechanism.dimensions[name] == value


@pytest.mark.parametrize("similarity", [True, "place"])
def test_a_path_up_to_similarity(similarity: Any) -> None:
    m = four_bar()
    turned = (3.0 if similarity is True else 1.0) * np.exp(0.8j)
    p = path() @ (1, 1j) * turned + (7.0 - 2.0j)
    points = np.stack([p.real, p.imag], axis=-1)
    vary = [name for name in m.dimensions if not name.startswith("ground.A")]
    fit = assur.fit(
        m, {"P": points}, closed=True, vary=vary, similarity=similarity, evaluations=20 * ROUND
    )[0]
    assert fit.error < 1e-8
    dimensions, sign = numbers(fit)
    drawn = moved(dimensions, sign, fit.q)["P"]
    if fit.placement is not None:
        a, b, x, y = fit.placement
        drawn = complex(a, b) * drawn + complex(x, y)
    assert np.abs(drawn - p).max() < 1e-7 * radius(points)


def test_a_slide_and_a_metric() -> None:
    engine = assur.SliderCrank(1.0, 3.0)
    wanted = {
        "stroke": target.Near(metric.span("bore"), 0.1),
        "ratio": target.Near(metric.min("bore"), 0.25),
    }
    vary = ["crank.length", "rod.length"]
    bounds = {"*.length": (0.01, 1.0)}
    fit = assur.fit(engine, wanted, vary=vary, bounds=bounds, evaluations=1)[0]
    # Closed form: stroke = 2·crank, least value = rod − crank.
    assert fit.mechanism.dimensions["crank.length"] == pytest.approx(0.05, abs=1e-9)
    assert fit.mechanism.dimensions["rod.length"] == pytest.approx(0.3, abs=1e-9)


def test_same_bits_on_any_number_of_threads() -> None:
    one, two = (
        assur.fit(four_bar(), {"P": path()}, closed=True, evaluations=1, seed=3, threads=threads)
        for threads in (1, 2)
    )
    assert [dict(fit.mechanism.dimensions) for fit in one] == [
        dict(fit.mechanism.dimensions) for fit in two
    ]
    other = assur.fit(four_bar(), {"P": path()}, closed=True, evaluations=1, seed=4)
    assert dict(other[0].mechanism.dimensions) != dict(one[0].mechanism.dimensions)


def test_it_goes_on_copies_and_writes(tmp_path: Path) -> None:
    found = assur.fit(four_bar(), {"P": path(9)}, closed=True, evaluations=1)
    later = found.resume(evaluations=2 * ROUND)
    assert later[0].error <= found[0].error
    assert later[0].evaluations > found[0].evaluations
    again = pickle.loads(pickle.dumps(found))
    assert again[0].mechanism == found[0].mechanism
    assert copy.copy(found)[0].error == found[0].error
    file = found.save(tmp_path)[0]
    loaded = assur.load(file)
    assert isinstance(loaded, assur.Mechanism)
    assert dict(loaded.dimensions) == dict(found[0].mechanism.dimensions)


REFUSED: dict[str, tuple[dict[str, Any], str]] = {
    "no targets": ({"targets": {}}, "a mapping is needed"),
    "no such joint": ({"targets": {"Q": path()}}, "there is no 'Q'"),
    "shape": ({"targets": {"P": [1.0, 2.0]}}, r"points \(N, 2\)"),
    "one point": ({"targets": {"P": [(1.0, 2.0)]}}, "at least 2"),
    "equal points": ({"targets": {"P": [(1.0, 2.0)] * 3}}, "they must differ"),
    "NaN": ({"targets": {"P": [(1.0, 2.0), (np.nan, 1.0)]}}, "row 1 of 2"),
    "timing": ({"timing": [1.0, 2.0]}, "24 finite coordinates"),
    "vary": ({"vary": ["rod.length"]}, "'rod.length' is not a dimension"),
    "bounds order": ({"bounds": {"crank.length": (2.0, 1.0)}}, "the least comes first"),
    "bounds sign": ({"bounds": {"crank.length": (-2.0, -1.0)}}, "must be positive"),
    "bounds name": ({"bounds": {"krank.length": (1.0, 2.0)}}, "is not a dimension"),
    "tie": ({"ties": [("crank.length",)]}, "'follower', 'leader'"),
    "tie twice": (
        {"ties": [("crank.length", "rocker.length"), ("crank.length", "coupler.length")]},
        "two dimensions",
    ),
    "where": ({"where": [0.7]}, "a condition on a metric"),
    "no gradient": ({"where": [metric.time_ratio("rocker") > 1.2]}, "has no gradient"),
    "seed": ({"seed": -1}, "seed"),
    "no weight": ({"targets": {"P": target.Path(path(), weight=0.0)}}, "weight is 0"),
    "no weights": (
        {"targets": {"P": target.Path(path(), weights=np.zeros(24))}},
        "all 24 weights are 0",
    ),
    "too large": ({"targets": {"P": path() * 1e100}}, r"e\+100 m long"),
    "too small": ({"targets": {"P": path() * 1e-100}}, "e-100 m long"),
    "similarity of a function": (
        {"targets": {"rocker": ([0.1, 0.4], [1.0, 1.1])}, "similarity": True},
        "similarity is for paths",
    ),
    "timing of a function": (
        {"targets": {"rocker": ([0.1, 0.4], [1.0, 1.1])}, "timing": [0.1, 0.4]},
        "timing is for paths or poses",
    ),
    "metrics over a part": (
        {"targets": {"s": target.Near(metric.span("rocker"), 1.0)}, "full_rotation": False},
        "over a whole turn",
    ),
    "robust": ({"robust": 2.0}, "robust"),
    "time": ({"time_limit": 0.0}, "time_limit"),
}


@pytest.mark.parametrize("which", REFUSED)
def test_what_is_refused(which: str) -> None:
    options, text = REFUSED[which]
    arguments: dict[str, Any] = {"targets": {"P": path()}, "evaluations": 1, **options}
    with pytest.raises(assur.InputError, match=text):
        assur.fit(four_bar(), arguments.pop("targets"), **arguments)


def test_machines_that_are_refused() -> None:
    with pytest.raises(assur.InputError, match="is redundant"):
        assur.fit(assur.examples.locomotive(), {"P": path()})
    ram = assur.SliderCrank(0.05, 0.2).with_driver("bore", q=1.0)
    with pytest.raises(assur.InputError, match="'bore' is a slide: say by timing="):
        assur.fit(ram, {"A": path()})
    with pytest.raises(assur.InputError, match="which does not turn"):
        assur.fit(ram, {"crank": ([0.2, 0.22], [0.9, 0.7])}, full_rotation=True)
    with pytest.raises(assur.InputError, match="metrics alone"):
        assur.fit(ram, {"s": target.Near(metric.span("crank"), 1.0)})
    wanted = ([0.2, 0.22, 0.24], [0.9, 0.7, 0.4])
    assert assur.fit(ram, {"crank": wanted}, evaluations=1)[0].error < 1e-3


def test_without_dyads_there_is_no_transmission_angle() -> None:
    k = np.arange(1, 11)
    m = assur.ClassIV(joints={str(n): (np.cos(n), np.sin(2 * n)) for n in k})
    points = [(0.0, 0.0), (0.5, 0.4), (1.0, 0.5)]
    fit = assur.fit(m, {"4": points}, evaluations=1)[0]
    assert np.isnan(fit.transmission_angle)
    assert fit.cells()["transmission"] == "–"


def test_impossible_goals_say_what_is_missed() -> None:
    where = [metric.min_transmission_angle("C") > 1.58]
    with pytest.raises(assur.FitError, match="still misses min_transmission_angle"):
        assur.fit(four_bar(), {"P": path()}, closed=True, where=where, evaluations=1)
    bounds = {"crank.length": (5.0, 6.0), "rocker.length": (0.1, 0.2), "ground.*": (-0.1, 0.1)}
    with pytest.raises(assur.FitError, match="turns fully"):
        assur.fit(four_bar(), {"P": path()}, closed=True, bounds=bounds, evaluations=1)


def test_several_targets_at_once() -> None:
    theta = np.linspace(1.0, 2.0, 6)
    at = moved(DRAWN, 1, theta)
    wanted = {
        "P": target.Path(np.stack([at["P"].real, at["P"].imag], axis=-1), timing=theta),
        "rocker": (theta, at["rocker"]),
    }
    fit = assur.fit(four_bar(), wanted, evaluations=40 * ROUND)[0]
    assert set(fit.errors) == {"P", "rocker"}
    assert max(fit.errors.values()) < 1e-6
