"""What sweeps and metrics refuse, and what the messages say to do."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, cast

import numpy as np
import pytest

import assur
from assur import metric

Q = np.linspace(0.0, 2 * np.pi, 72, endpoint=False)
SWING = metric.span("rocker")
ASKED = {"swing": SWING}
WRONG: Any = 5


def four_bar() -> assur.Mechanism:
    return assur.FourBar(1.0, 3.0, 2.5, 3.0)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (
            {"where": SWING > 1.0},
            r"a list of conditions is needed, where=\[span\('rocker'\) > 1.0\]",
        ),
        ({"where": 3}, "where is 3: a list of conditions"),
        ({"where": [False]}, "False is not a condition"),
        ({"order": 2}, r"order= is for motions.*metric.span\('rocker', order=1\)"),
        ({"order": 0}, "order= is for motions"),
        ({"on_error": "drop"}, r"on_error='drop' is for motions.*\.kept has the indices"),
        ({"on_error": "raise"}, "on_error='raise' is for motions"),
        ({"outputs": ["C"]}, "outputs= is for motions"),
        ({"out": 1}, "out= is for motions"),
        ({"q": []}, "q is empty: metrics need a position"),
        ({"q": Q[None]}, r"q has shape \(1, 72\): metrics need \(N,\)"),
        ({"metrics": {"off": metric.deviation("C.x")}}, "C.x"),
        (
            {"metrics": {"a": metric.min_transmission_angle("C", between=("B", "B"))}},
            "two joints are needed",
        ),
    ],
)
def test_of_metrics(arguments: dict[str, Any], message: str) -> None:
    given = {"dimensions": {}, "q": Q, "metrics": ASKED, **arguments}
    with pytest.raises(assur.InputError, match=message):
        assur.sweep(four_bar(), **given)


@pytest.mark.parametrize(
    ("name", "kind"),
    [("C", "no_axis"), ("C.z", "no_axis"), ("lever", "unknown"), ("X.y", "unknown")],
)
def test_a_name_is_refused_as_in_extremes(name: str, kind: str) -> None:
    """In a combination or a condition too: the core knows names."""
    with pytest.raises(assur.InputError) as wanted:
        four_bar().extremes(name)
    for asked in (metric.span(name), 1.0 - metric.rms(name, over=(0.0, 1.0)) / SWING):
        for metrics, where in (({"a": asked}, []), (ASKED, [asked > 0.0])):
            with pytest.raises(assur.InputError) as caught:
                assur.sweep(four_bar(), {}, Q, metrics=metrics, where=where)
            assert str(caught.value) == str(wanted.value)
            assert caught.value.kind == wanted.value.kind == kind


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (
            lambda: metric.function(len, outputs="rocker"),
            r"outputs='rocker': a list of names.*\['rocker'\]",
        ),
        (lambda: metric.function(len, outputs=WRONG), "outputs is 5: a list of names"),
        (lambda: metric.function(WRONG), "a function of a motion is needed"),
        (lambda: metric.span("C.x", over=(6.0, 1.0)), r"write \(6.0, 7.283185307179586\)"),
        (lambda: metric.span("C.x", over=WRONG), r"\(from, to\)"),
        (lambda: metric.min_transmission_angle("C", between=WRONG), "between=5: two joints"),
        (
            lambda: metric.min_transmission_angle("C", between=("B", WRONG)),
            "the name 5 is not a string",
        ),
        (lambda: metric.deviation("C", relative=WRONG), "relative is 5: True or False"),
        (lambda: metric.deviation("C", part=0.0), "more than 0 and at most 1"),
        (lambda: bool(0.5 < SWING < 2.0), "two of them for a range"),
        (lambda: cast("Any", "1") < SWING, "the limit of a condition"),
    ],
)
def test_of_functions(make: Any, message: str) -> None:
    with pytest.raises(assur.InputError, match=message):
        make()


def test_one_design_with_bad_dimensions() -> None:
    for wrong in ({"coupler.length": -1.0}, {"coupler.length": np.nan}):
        for metrics in ({}, {"metrics": ASKED}):
            with pytest.raises(assur.DimensionError, match=r"coupler\.length"):
                assur.sweep(four_bar(), wrong, Q, **metrics)  # type: ignore[call-overload]
    designs: list[Any] = [{}, {"coupler.length": 3.1}, assur.Grid()]
    for dimensions in designs:
        one = assur.sweep(four_bar(), dimensions, Q)
        assert one.shape == (72,)
        expected = four_bar().with_dimensions(dimensions)
        assert one.mechanism == expected
        assert (one.joint("C").d2 == expected.solve(Q).joint("C").d2).all()
        found = assur.sweep(four_bar(), dimensions, Q, metrics=ASKED)
        assert found.shape == ()
        assert found["swing"] == np.ptp(expected.solve(Q).link("rocker").value)
        dropped = assur.sweep(four_bar(), dimensions, Q, on_error="drop")
        assert dropped.shape == (1, 72)


def test_metrics_compare_and_arrays_do_not_swallow_them() -> None:
    lengths = np.linspace(2.0, 3.0, 20)
    asked = {"one": metric.span("C.x"), "other": 1.9 * metric.span("C.y")}
    every = assur.sweep(four_bar(), {"coupler.length": lengths}, Q, metrics=asked)
    conditions: list[Any] = [
        (asked["one"] > asked["other"], every["one"] > every["other"]),
        (asked["one"] <= asked["other"], every["one"] <= every["other"]),
        (asked["one"] > 1.5, every["one"] > 1.5),
        (np.float64(1.5) < asked["one"], every["one"] > 1.5),
    ]
    for condition, expected in conditions:
        found = assur.sweep(
            four_bar(), {"coupler.length": lengths}, Q, metrics=asked, where=[condition]
        )
        assert found.kept.tolist() == np.flatnonzero(expected).tolist()
        assert 0 < len(found.kept) < 20
    assert repr(np.float64(2.0) * SWING) == "(2.0 * span('rocker'))"
    with pytest.raises((TypeError, assur.InputError)):
        np.array([1.0, 2.0]) * SWING


@dataclass
class Height:
    """A callable without a hash."""

    joint: str

    def __call__(self, motion: assur.Motion) -> Any:
        return motion.joint(self.joint).value[..., 1].max(axis=-1)


def test_a_function_without_a_hash() -> None:
    with pytest.raises(TypeError):
        hash(Height("C"))
    high = metric.function(Height("C"))
    found = assur.sweep(four_bar(), {}, Q, metrics={"a": high, "b": 2.0 * high}, where=[high > 0.0])
    assert found["b"] == 2.0 * found["a"] > 0.0


@pytest.mark.parametrize("factor", [2.0, -2.0, 0.5, -0.5])
def test_sums_and_multiples_stop_early(factor: float) -> None:
    """What they drop after a few positions is what they would drop after all."""
    rng = np.random.default_rng(4)
    space = {name: rng.uniform(1.5, 4.0, 400) for name in ("coupler.length", "rocker.length")}
    swing, high, low = SWING, metric.max("C.y"), metric.min("C.x")
    quality = factor * swing + 3.0 * factor * high - factor * low / 2.0 + 1.0
    asked = {"quality": quality, "swing": swing}
    every = assur.sweep(four_bar(), space, Q, metrics=asked)
    middle = float(np.nanmedian(every["quality"]))
    for where, meets in [
        ([quality < middle], every["quality"] < middle),
        ([quality >= middle], every["quality"] >= middle),
        ([1.0 - quality / 3.0 > 0.2], 1.0 - every["quality"] / 3.0 > 0.2),
        ([quality < 1e9, swing / quality < 0.1], every["swing"] / every["quality"] < 0.1),
    ]:
        found = assur.sweep(four_bar(), space, Q, metrics=asked, where=where)
        assert found.kept.tolist() == np.flatnonzero(meets).tolist()
        kept = found.kept
        assert (found["quality"][kept] == every["quality"][kept]).all()


def test_sums_are_asked_after_a_few_positions() -> None:
    """The first positions are spread over q; what misses by them is not solved at the others.

    Here one of the others cannot be reached: that is not seen.
    """
    q = np.linspace(1.5, 4.5, 72)
    q[5] = 0.0
    lengths = {"coupler.length": [5.2, 5.1]}
    assert (assur.sweep(four_bar(), lengths, q, metrics=ASKED).status > assur.Status.SINGULAR).all()
    short = metric.span("C.x")
    for condition in (
        *(2.0 * SWING < 0.01, SWING + short < 0.01, -SWING > -0.01, 1.0 - SWING / 2.0 > 0.99),
        *(SWING - metric.min("C.y") < -9.0, -2.0 * short > SWING, SWING / -2.0 > 0.0),
    ):
        found = assur.sweep(four_bar(), lengths, q, metrics=ASKED, where=[condition])
        assert found.missed.tolist() == [0, 1], condition
    # These may change either way.
    for condition in (SWING - short < -9.0, metric.mean("C.x") < -9.0, 1.0 / SWING > 99.0):
        found = assur.sweep(four_bar(), lengths, q, metrics=ASKED, where=[condition])
        assert found.missed.tolist() == [], condition
