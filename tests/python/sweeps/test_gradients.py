"""Gradients of metrics against differences of sweeps."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import pytest

import assur
from assur import metric

Q = np.linspace(0.0, 2.0 * np.pi, 90, endpoint=False)
# More positions than are linearised at once, and the last registers not full.
MANY = np.linspace(0.1, 6.3, 301)
# Step of central differences, relative to the dimension, and how near their limit is (Richardson
# 1911), relative to the greatest entry.
STEP, CLOSE = 1e-4, 1e-7


def beside_the_crank() -> assur.Mechanism:
    """An engine whose bore misses the crank's centre: else two positions tie, half a turn apart."""
    return assur.examples.engine().with_dimensions({"bore.offset": 0.01})


CASES: dict[str, tuple[Any, Any, Any]] = {
    "span of a joint": (assur.examples.crank_rocker, Q, metric.span("P.x")),
    "least y": (assur.examples.crank_rocker, Q, metric.min("P.y")),
    "greatest angle": (assur.examples.crank_rocker, Q, metric.max("rocker")),
    "stroke": (assur.examples.engine, Q, metric.span("bore")),
    "greatest speed": (assur.examples.engine, Q, metric.max("bore", order=1)),
    "greatest acceleration": (assur.examples.crank_rocker, Q, metric.max("P.x", order=2)),
    "mean": (assur.examples.crank_rocker, Q, metric.mean("P.x")),
    "root mean square": (assur.examples.crank_rocker, Q, metric.rms("rocker", order=2)),
    "mean angle": (assur.examples.crank_rocker, MANY, metric.mean("rocker")),
    "mean acceleration": (
        assur.examples.engine,
        MANY,
        metric.mean("B.x", order=2, over=(1.0, 2.0)),
    ),
    "root mean square of a joint": (assur.examples.crank_rocker, MANY, metric.rms("P.y")),
    "root mean square of a slide": (assur.examples.engine, MANY, metric.rms("bore", order=1)),
    "root mean square of a turned guide": (assur.examples.whitworth, Q, metric.rms("F.x")),
    "two dyads": (
        assur.examples.stephenson_1,
        np.linspace(0.0, 0.5, 150),
        metric.rms("S.x") + metric.mean("link2", order=1),
    ),
    "transmission": (assur.examples.crank_rocker, Q, metric.min_transmission_angle("C")),
    "pressure": (beside_the_crank, Q + 0.01, metric.min_transmission_angle("bore")),
    "between joints": (
        assur.examples.crank_rocker,
        Q,
        metric.min_transmission_angle("C", between=("B", "D")),
    ),
    "a part of a turn": (
        assur.examples.crank_rocker,
        Q,
        metric.span("P.x", over=(5.5, 7.0)) + metric.mean("P.y", over=(1.0, 2.0)),
    ),
    "made of several": (
        assur.examples.crank_rocker,
        Q,
        metric.span("P.x") * metric.span("P.y") / (2.0 + metric.rms("rocker")) - metric.min("P.y"),
    ),
    "class IV": (assur.examples.loom, np.linspace(0.2, 1.4, 9), metric.span("6.x")),
    "class IV, root mean square": (
        assur.examples.loom,
        np.linspace(0.2, 1.4, 9),
        metric.rms("6.y") + metric.mean("6.x", order=1),
    ),
    "two drivers, root mean square": (
        assur.examples.five_bar,
        np.array([1.85, 1.29]) + np.random.default_rng(3).uniform(-0.2, 0.2, (21, 2)),
        metric.rms("P.x"),
    ),
    "two drivers": (
        assur.examples.five_bar,
        np.array([1.85, 1.29]) + np.random.default_rng(2).uniform(-0.2, 0.2, (6, 2)),
        metric.max("P.x") + metric.mean("P.y"),
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_gradients_are_differences(name: str) -> None:
    make, q, measured = CASES[name]
    m = make()
    names = [one for one in m.dimensions if not one.startswith("ground.")][:6]
    drawn = {one: float(m.dimensions[one]) for one in names}
    found = assur.sweep(m, {}, q, metrics={"it": measured}, gradient=names)
    assert found.gradient_by == tuple(names)
    gradient = found.gradient["it"]
    assert gradient.shape == (len(names),)
    wanted = []
    for one in names:
        size = STEP * max(abs(drawn[one]), 0.1)
        values = drawn[one] + size * np.array([-1.0, 1.0, -0.5, 0.5])
        low, high, lower, higher = assur.sweep(m, {one: values}, q, metrics={"it": measured})["it"]
        wanted.append((4.0 * (higher - lower) / size - (high - low) / (2.0 * size)) / 3.0)
    error = np.abs(gradient - wanted).max()
    assert error <= CLOSE * max(1.0, np.abs(wanted).max())


def test_designs_in_rows() -> None:
    m = assur.FourBar(1.0, 3.0, 2.5, 3.0)
    space = assur.Grid({"coupler.length": [2.8, 3.0, 9.0], "rocker.length": [2.4, 2.6]})
    asked = {
        "swing": metric.span("rocker"),
        "angle": metric.min_transmission_angle("C"),
        "mean": metric.mean("C.x"),
        "rms": metric.rms("coupler"),
    }
    where = [metric.min_transmission_angle("C") > 0.3]
    found = assur.sweep(m, space, Q, metrics=asked, where=where, gradient="*.length")
    assert found.gradient["swing"].shape == (3, 2, 3)
    kept = np.zeros((3, 2), bool)
    kept.reshape(-1)[found.kept] = True
    assert 0 < kept.sum() < 6
    for name in asked:
        assert (np.isfinite(found.gradient[name]).all(axis=-1) == kept).all()
        for threads in (1, 2):
            again = assur.sweep(
                m, space, Q, metrics=asked, where=where, gradient="*.length", threads=threads
            )
            assert np.array_equal(again.gradient[name], found.gradient[name], equal_nan=True)
    lengths = {"coupler.length": 3.0, "rocker.length": 2.6}
    alone = assur.sweep(m, lengths, Q, metrics=asked, gradient="*.length")
    for name in asked:
        assert (alone.gradient[name] == found.gradient[name][1, 1]).all()
        assert not found.gradient[name].flags.writeable
    with ThreadPoolExecutor(1) as engine:
        remote = assur.sweep(
            m, space, Q, metrics=asked, where=where, gradient="*.length", engine=engine
        )
    for name in ("mean", "rms"):
        assert np.array_equal(remote.gradient[name], found.gradient[name], equal_nan=True)


# Conditions that read the joint row after row, and ask for two positions of the next turn.
BESIDE = [
    metric.deviation("P") < 10.0,
    metric.time_ratio("rocker") < 10.0,
    metric.min_transmission_angle("C") > 0.1,
    metric.span("P.y") > 0.0,
]


@pytest.mark.parametrize("count", [7, 8, 90, 301])
def test_means_beside_other_metrics(count: int) -> None:
    """Gradients are those of weighted sums; values are those of a sweep without gradients."""
    m = assur.examples.crank_rocker()
    q = np.linspace(0.0, 2.0 * np.pi, count, endpoint=False)
    names = {"x": "P.x", "y": "P.y", "angle": "rocker"}
    means = {key: metric.mean(name) for key, name in names.items()}
    roots = {f"rms {key}": metric.rms(name) for key, name in names.items()}
    asked = {**means, **roots, "speed": metric.rms("coupler", order=1)}
    lengths = {"coupler.length": float(m.dimensions["coupler.length"]) * np.array([1.0, 9.0, 1.01])}
    found = assur.sweep(m, lengths, q, metrics=asked, where=BESIDE, gradient="*")
    plain = assur.sweep(m, lengths, q, metrics=asked, where=BESIDE)
    assert list(found.kept) == list(plain.kept) == [0, 2]
    for name, measured in asked.items():
        assert np.array_equal(found[name], plain[name], equal_nan=True)
        assert np.isnan(found.gradient[name][1]).all()
        alone = assur.sweep(m, lengths, q, metrics={"it": measured}, gradient="*")
        assert np.array_equal(found.gradient[name], alone.gradient["it"], equal_nan=True)
    motion = found.designs([0, 2]).solve(q)
    jacobian = motion.jacobian("P", by="*")
    x = motion.joint("P").value[..., 0]
    most = 1e-12 * float(np.abs(jacobian).max())
    slope = jacobian[..., 0, :]
    assert np.abs(found.gradient["x"][[0, 2]] - slope.mean(axis=1)).max() < most
    wanted = (x[..., None] * slope).mean(axis=1) / np.sqrt((x * x).mean(axis=1))[:, None]
    assert np.abs(found.gradient["rms x"][[0, 2]] - wanted).max() < most


def test_a_root_has_no_derivative_at_zero() -> None:
    """The pin of a piston stays on the line of its bore."""
    asked = {"across": metric.rms("B.y"), "along": metric.rms("B.x")}
    by = ["crank.length", "rod.length"]
    found = assur.sweep(assur.SliderCrank(1.0, 3.0), {}, Q, metrics=asked, gradient=by)
    assert found["across"] == 0.0
    assert np.isnan(found.gradient["across"]).all()
    assert np.isfinite(found.gradient["along"]).all()


def test_a_part_without_positions_has_no_gradient() -> None:
    part = (0.01, 0.02)
    asked = {"mean": metric.mean("C.x", over=part), "rms": metric.rms("C.x", over=part)}
    found = assur.sweep(
        assur.FourBar(1.0, 3.0, 2.5, 3.0), {}, Q, metrics=asked, gradient="*.length"
    )
    assert np.isnan(found.gradient["mean"]).all()
    assert np.isnan(found.gradient["rms"]).all()


def test_a_sweep_without_gradients_has_none() -> None:
    found = assur.sweep(assur.FourBar(1.0, 3.0, 2.5, 3.0), {}, Q, metrics={"a": metric.span("C.x")})
    assert dict(found.gradient) == {}
    assert found.gradient_by == ()


def test_a_gradient_descends() -> None:
    """Steps along it raise the least transmission angle."""
    m = assur.FourBar(1.0, 3.2, 2.0, 3.4)
    asked = {"angle": metric.min_transmission_angle("C")}
    names = ("coupler.length", "rocker.length", "ground.D.x")
    x = np.array([float(m.dimensions[name]) for name in names])
    angles = []
    for _ in range(12):
        at = dict(zip(names, x, strict=True))
        found = assur.sweep(m, at, Q, metrics=asked, gradient=names)
        angles.append(float(found["angle"]))
        slope = found.gradient["angle"]
        x = x + 0.01 * slope / np.linalg.norm(slope)
    assert (np.diff(angles) > 0.0).all()


def nothing(motion: assur.Motion) -> Any:
    return np.zeros(motion.shape[:-1])


REFUSED: dict[str, tuple[dict[str, Any], str]] = {
    "a place": ({"metrics": {"a": metric.argmax("C.x")}}, r"argmax\('C.x'\), which has none"),
    "a fit": ({"metrics": {"a": metric.deviation("C")}}, "which has none"),
    "a function": ({"metrics": {"a": metric.function(nothing)}}, "which has none"),
    "a motion": ({}, r"gradient= is for metrics=; .*motion\.jacobian"),
    "an unknown dimension": (
        {"metrics": {"a": metric.span("C.x")}, "gradient": "foo"},
        'no dimension "foo"',
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refusals(name: str) -> None:
    options, message = REFUSED[name]
    with pytest.raises(assur.InputError, match=message):
        assur.sweep(assur.FourBar(1.0, 3.0, 2.5, 3.0), {}, Q, **{"gradient": "*.length", **options})


def test_redundant_links_are_refused() -> None:
    redundant = assur.Mechanism(
        joints={"A": (0, 0), "B": (0, 1), "D": (2, 0), "C": (2, 1), "E": (1, 0), "F": (1, 1)},
        links={"ground": "AED", "one": "AB", "two": "DC", "three": "EF", "bar": "BFC"},
        driver="one",
    )
    with pytest.raises(assur.InputError, match="redundant"):
        assur.sweep(redundant, {}, Q, metrics={"a": metric.span("C.x")}, gradient="*.length")


def test_no_designs() -> None:
    found = assur.sweep(
        assur.FourBar(1.0, 3.0, 2.5, 3.0),
        {"coupler.length": np.zeros(0)},
        Q,
        metrics={"a": metric.max("C.x"), "b": metric.mean("C.x")},
        gradient="*.length",
    )
    assert found.gradient["a"].shape == found.gradient["b"].shape == (0, 3)
