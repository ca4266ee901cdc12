"""A design without one of the metrics is not kept; its status and `explain` say why."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import assur
from assur import Force, Machine, Status, Table, metric
from assur.sweeps.measures import counts_text
from assur.sweeps.reasons import reasons

Q = np.linspace(0.0, 2.0 * np.pi, 36, endpoint=False)
CRANKS = {"crank.length": [0.04, 0.05, 0.06, 0.5]}
SHORT = Table([0.35, 0.45], [0.0, 10.0], over="bore")
MACHINE_METRICS: dict[str, Any] = {
    "peak": metric.peak_effort(),
    "rms": metric.rms_effort(speed=2.0),
    "joint": metric.peak_reaction("A"),
    "mean force": metric.rms_reaction("B"),
    "combined": 2.0 * metric.peak_effort() - metric.span("bore"),
    "flywheel": metric.flywheel_inertia(0.1, mean_speed=10.0),
}


def press(**options: Any) -> Machine:
    bodies = {"crank": assur.Body(inertia=0.01), "piston": assur.Body(mass=1.0)}
    return Machine(
        assur.SliderCrank(0.05, 0.4), bodies=bodies, loads=[Force("B", (SHORT, 0.0))], **options
    )


@pytest.mark.parametrize("name", MACHINE_METRICS)
def test_a_table_that_ends(name: str) -> None:
    asked = {name: MACHINE_METRICS[name], "stroke": metric.span("bore")}
    found = assur.sweep(press(), CRANKS, Q, metrics=asked)
    assert found.status.tolist() == [0, 0, Status.NO_VALUE, Status.UNREACHABLE]
    assert found.kept.tolist() == [0, 1]
    assert found.missed.tolist() == []
    assert np.isnan(found[name]).tolist() == [False, False, True, True]
    # The other metrics are there.
    assert found["stroke"][:3] == pytest.approx([0.08, 0.1, 0.12])
    why = found.explain(2)
    assert why is not None
    assert why.startswith(f"{name}: ")
    if name != "flywheel":
        assert "loads[0], the Force at 'B': a table over 'bore' covers 0.35 to 0.45" in why
        assert "0.46, at q = 0, is not in it; extend the table" in why
    assert found.explain(1) is None
    assert "q = " in str(found.explain((3,)))
    assert "1 do not move, 0 miss a condition, 1 lack a metric, 2 are kept" in counts_text(found)


def test_a_condition_without_a_value_is_not_missed() -> None:
    where = [metric.peak_effort() < 0.35]
    found = assur.sweep(press(), CRANKS, Q, metrics={"stroke": metric.span("bore")}, where=where)
    assert found.status.tolist()[2:] == [Status.NO_VALUE, Status.UNREACHABLE]
    assert sorted([*found.kept, *found.missed]) == [0, 1]
    assert "a table over 'bore'" in str(found.explain(2))
    for index in found.missed:
        assert "misses a condition: peak_effort() ≥ 0.35" in str(found.explain(int(index)))


def test_a_function_that_gives_nan() -> None:
    lengths = np.array([2.9, 3.1])

    def short(motion: assur.Motion) -> Any:
        own = motion.mechanism.dimensions["coupler.length"]
        return np.where(np.asarray(own) > 3.0, np.nan, 1.0)

    own, asked = assur.FourBar(1.0, 3.0, 2.5, 3.0), {"one": metric.function(short)}
    found = assur.sweep(own, {"coupler.length": lengths}, Q, metrics=asked)
    assert found.status.tolist() == [Status.OK, Status.NO_VALUE]
    assert found.kept.tolist() == [0]
    assert str(found.explain(1)).endswith("is not defined for this motion")


def test_a_metric_that_is_not_defined() -> None:
    """A point that rests has no shape to be compared with."""
    asked = {"off": metric.deviation("A", shape="line", relative=True), "y": metric.mean("C.y")}
    found = assur.sweep(assur.FourBar(1.0, 3.0, 2.5, 3.0), {}, Q, metrics=asked)
    assert np.isnan(found["off"])
    assert np.isfinite(found["y"])
    assert (int(found.status), found.kept.size) == (Status.NO_VALUE, 0)
    assert found.explain(0) == found.explain(())
    assert str(found.explain(0)).startswith("off: deviation('A', ")


def test_a_locked_machine() -> None:
    friction = {"A": assur.JointFriction(0.9, 0.2), "B": assur.JointFriction(0.9, 0.3)}
    own = Machine(
        assur.SliderCrank(0.1, 0.35),
        bodies={},
        loads=[Force("B", (-100.0, 0.0))],
        friction=friction,
    )
    asked = {"T": metric.peak_effort(speed=10.0)}
    found = assur.sweep(own, {"rod.length": [0.35, 0.4]}, Q, metrics=asked)
    locked = np.isnan(found["T"])
    assert locked.any()
    assert (found.status[locked] == Status.NO_VALUE).all()
    assert "friction locks the machine at q = " in str(found.explain(int(np.argmax(locked))))


def test_the_map_names_the_load() -> None:
    pytest.importorskip("matplotlib")
    grid = assur.Grid({"crank.length": np.linspace(0.04, 0.07, 7), "rod.length": [0.39, 0.4, 0.41]})
    found = assur.sweep(press(), grid, Q, metrics={"T": metric.peak_effort()})
    axes = found.plot("T")
    texts = [text.get_text() for text in axes.texts if text.get_gid() == "reason"]
    assert any("loads[0], the Force at B has no value" in text for text in texts)


@pytest.mark.parametrize("name", ["T", "effort: peak", "a: b: c"])
def test_what_has_no_value_is_named_whatever_metrics_are_called(name: str) -> None:
    for asked, subject in (
        (metric.peak_effort(), "loads[0], the Force at B"),
        (metric.deviation("O", shape="line", relative=True), name),
    ):
        found = assur.sweep(press(), {"crank.length": [0.05, 0.06]}, Q, metrics={name: asked})
        assert [text for text, _ in reasons(found, found[name])] == [f"{subject} has no value"]
