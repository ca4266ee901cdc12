"""Metrics as text are those of `assur.metric`, and nothing else can be called."""

from __future__ import annotations

import contextlib
import inspect
import math

import numpy as np
import pytest

import assur
from assur import metric
from assur.cli.metric_arguments import argument_of
from assur.cli.metrics import FUNCTIONS, condition, named_metric

DEG = math.pi / 180


@pytest.mark.parametrize(
    ("text", "same"),
    [
        ("span(B.x)", metric.span("B.x")),
        ("min( 'bore' , order = 1)", metric.min("bore", order=1)),
        ("max(rocker, order=2)", metric.max("rocker", order=2)),
        ("mean(10.x, over=(0, 90deg))", metric.mean("10.x", over=(0.0, 90 * DEG))),
        ("rms(B.y, order=0, over=(1, 2))", metric.rms("B.y", order=0, over=(1.0, 2.0))),
        ("min_transmission_angle(C)", metric.min_transmission_angle("C")),
        (
            "min_transmission_angle(C, between=(B, D))",
            metric.min_transmission_angle("C", between=("B", "D")),
        ),
        (
            "deviation(P, circle, part=0.25, relative=True)",
            metric.deviation("P", shape="circle", part=0.25, relative=True),
        ),
        ("time_ratio(bore)", metric.time_ratio("bore")),
        (
            "path_error(P, points=((0, 0), (10mm, 0), (0, 20mm)), kind=chamfer, closed=true)",
            metric.path_error("P", [(0, 0), (0.01, 0), (0, 0.02)], kind="chamfer", closed=True),
        ),
        (
            "function_error(rocker, theta=(0, 90deg), value=(1, 1.5), offset=free)",
            metric.function_error("rocker", [0, 90 * DEG], [1, 1.5], offset="free"),
        ),
        (
            "pose_error(coupler, ((5mm, 0, 90deg)), length=10mm)",
            metric.pose_error("coupler", [(0.005, 0, 90 * DEG)], length=0.01),
        ),
        ("reachable()", metric.reachable()),
        ("peak_reaction(B, on=rod, speed=2)", metric.peak_reaction("B", on="rod", speed=2.0)),
        ("peak_effort(speed=(1, 2))", metric.peak_effort(speed=[1.0, 2.0])),
        (
            "flywheel_inertia(0.05, mean_speed=20, mean=period)",
            metric.flywheel_inertia(0.05, mean_speed=20.0, mean="period"),
        ),
        ("span(B.x) - 0.1*rms(r)", metric.span("B.x") - 0.1 * metric.rms("r")),
        ("-span(B.x)", -metric.span("B.x")),
        ("--span(B.x)", metric.span("B.x")),
        ("2 * (3 + 4) * span(a)", 14.0 * metric.span("a")),
        ("2 - 3 - span(a)", -1.0 - metric.span("a")),
        ("span(a) / span(b) / 2", metric.span("a") / metric.span("b") / 2.0),
        ("span(a) + span(b) * 2", metric.span("a") + metric.span("b") * 2.0),
        ("(span(a) + span(b)) * 5mm", (metric.span("a") + metric.span("b")) * 0.005),
        ("6 / 3 * span(a)", 2.0 * metric.span("a")),
        ("span(żółw)", metric.span("żółw")),
    ],
)  # fmt: skip
def test_text(text: str, same: metric.Metric) -> None:
    assert named_metric(text) == (text, same) or repr(named_metric(text)[1]) == repr(same)
    assert named_metric(f"a-1.b = {text}")[0] == "a-1.b"
    assert repr(named_metric(f"name={text}")[1]) == repr(same)


@pytest.mark.parametrize(
    ("text", "same"),
    [
        ("min_transmission_angle(C) > 40deg", metric.min_transmission_angle("C") > 40 * DEG),
        ("span(a) <= 2 * 3", metric.span("a") <= 6.0),
        ("3 < span(a)", metric.span("a") > 3.0),
        ("span(a) >= span(b)", metric.span("a") >= metric.span("b")),
        ("span(a) - span(b)<-1", metric.span("a") - metric.span("b") < -1.0),
    ],
)
def test_conditions(text: str, same: metric.Condition) -> None:
    assert repr(condition(text)) == repr(same)


def test_every_metric_but_functions_can_be_written() -> None:
    own = {name for name in metric.__all__ if inspect.isfunction(getattr(metric, name))}
    assert own - set(FUNCTIONS) == {"function"}
    assert set(FUNCTIONS) <= own


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_argument_is_read_as_what_it_is(name: str) -> None:
    """A number, a flag or a pair would else reach the function as text."""
    for parameter in inspect.signature(getattr(metric, name)).parameters.values():
        if not parameter.annotation.startswith(("str", "Literal", "Mean")):
            text = "true" if parameter.annotation.startswith("bool") else "1"
            assert not isinstance(argument_of(parameter.name, text), str), parameter


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "a number or a metric is missing"),
        ("a=", "a number or a metric is missing"),
        ("3", "is not a metric"),
        ("span(B.x) > 2", "is not a metric"),
        ("span", "'(' is missing after span"),
        ("span(B.x", "')' is missing"),
        ("(span(B.x)", "')' is missing"),
        ("span(B.x))", "')' is left over"),
        ("span(B.x) span(B.y)", "'span' is left over"),
        ("1 < span(B.x) < 2", "'<' is left over"),
        ("span()", "missing a required argument: 'of'"),
        ("span(B.x, colour=3)", "unexpected keyword argument 'colour'"),
        ("span(B.x, order=4)", "0, 1, 2 or 3"),
        ("span(B.x, order=x)", "0, 1, 2 or 3"),
        ("span(B.x, over=1)", "the first and the last coordinate are needed"),
        ("span(B.x, over=(1,2,3))", "the first and the last coordinate are needed"),
        ("span(B.x, over=0:1:0.5)", "the first and the last coordinate are needed"),
        ("deviation(P, part=x)", "is not a number"),
        ("deviation(P, part=50mm)", "its unit cannot be mm"),
        ("peak_reaction(B, speed=5mm)", "its unit cannot be mm"),
        ("span(B.x, over=(0, 5rpm))", "its unit cannot be rpm"),
        ("flywheel_inertia(0.1, mean_speed=5m/s)", "its unit cannot be m/s"),
        ("span(B.x, over=(1)", "')' is missing"),
        ("min_transmission_angle(C, between=(B))", "two joints are needed"),
        ("deviation(P, part=0:1:0.5)", "part is"),
        ("deviation(P, relative=maybe)", "relative is 'maybe': True or False is needed"),
        ("deviation(P, square)", "shape is 'square'"),
        ("function(print)", "there is no metric 'function'"),
        ("__import__(os)", "there is no metric '__import__'"),
        ("Metric()", "there is no metric 'Metric'"),
        ("span.__class__", "'.__class__' is not understood"),
        ("span(B.x) ** 2", "'*' is not expected here"),
        ("span(B.x) / 0", "a division by zero"),
        ("1 / (1 - 1) * span(B.x)", "a division by zero"),
        ("1e308 * 1e308 * span(B.x)", "a finite number is needed"),
        ("1e999 * span(B.x)", "is not a number"),
        ("2furlong * span(B.x)", "the unit 'furlong' is unknown"),
        ("span(B.x) # 3", "'# 3' is not understood"),
        ("(" * 50 + "span(B.x)" + ")" * 50, "nested deeper than 20"),
        ("-" * 1900 + "span(B.x", "')' is missing"),
        ("+".join(["span(a)"] * 300), "2000 at most"),
    ],
)
def test_what_is_no_metric(text: str, said: str) -> None:
    with pytest.raises(assur.InputError) as caught:
        named_metric(text)
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("text", ["span(a)", "1 < 2", "span(a) = 2", "span(a) == 2", ""])
def test_what_is_no_condition(text: str) -> None:
    with pytest.raises(assur.InputError):
        condition(text)


def test_random_text_is_read_or_refused() -> None:
    """Pieces of metrics in any order: an InputError or a metric, nothing else."""
    rng = np.random.default_rng(7)
    pieces = [
        "span",
        "(",
        ")",
        "B.x",
        ",",
        "order=",
        "1",
        "2deg",
        "+",
        "-",
        "*",
        "/",
        "<",
        "'",
        "=",
    ]
    pieces += ["min(a)", " ", "over=(0,1)", "\0", "é", "1e9", ".", "\n", '"', "mean(b)"]
    read = 0
    for _ in range(3000):
        text = "".join(rng.choice(pieces, size=rng.integers(1, 7)))
        for reader in (named_metric, condition):
            with contextlib.suppress(assur.InputError):
                reader(text)
                read += 1
    assert read > 30
