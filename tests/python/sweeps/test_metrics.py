"""Metrics of sweeps against NumPy on the stored motions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt
import pytest

import assur
from assur import metric
from models.mechanisms import named_drawings
from net import design_spaces
from oracles.kinematics import textbook

if TYPE_CHECKING:
    from collections.abc import Callable

Float = npt.NDArray[np.float64]

Q = np.linspace(0.0, 2 * np.pi, 72, endpoint=False)
MECHANISMS = ["crank_rocker", "engine", "whitworth", "stephenson_six_bar"]


def space(name: str) -> assur.Mechanism:
    return design_spaces.space(named_drawings.CLASS_II[name](), np.random.default_rng(5), 300)


def coordinate(motion: assur.Motion, name: str, order: int = 0) -> Float:
    joint, _, axis = name.rpartition(".")
    word = ("value", "d1", "d2", "d3")[order]
    if joint:
        point: Float = getattr(motion.joint(joint), word)[..., "xy".index(axis)]
        return point
    of = motion.slide(name) if name in motion.mechanism.slides else motion.link(name)
    found: Float = getattr(of, word)
    return found


@pytest.mark.parametrize("name", MECHANISMS)
def test_metrics_are_those_of_the_motion(name: str) -> None:
    one, batch = named_drawings.CLASS_II[name](), space(name)
    names = [j for j in one.joints if j not in one.links["ground"]]
    links = [link for link in one.links if link != "ground"]
    of = [f"{names[-1]}.x", f"{names[0]}.y", links[-1], *one.slides]
    q = Q + one.q0
    motion = batch.solve(q, order=2, on_error="nan")
    moves = (motion.status < assur.Status.SINGULAR).all(axis=-1)
    assert moves.sum() > 20
    asked: dict[str, tuple[metric.Metric, Callable[[Float], Any], str, int]] = {}
    for what in of:
        for order in (0, 1, 2):
            reductions: dict[str, tuple[Any, Callable[[Float], Any]]] = {
                "span": (metric.span, lambda v: np.ptp(v, axis=-1)),
                "least": (metric.min, lambda v: v.min(axis=-1)),
                "greatest": (metric.max, lambda v: v.max(axis=-1)),
                "at least": (metric.argmin, lambda v: q[v.argmin(axis=-1)]),
                "at greatest": (metric.argmax, lambda v: q[v.argmax(axis=-1)]),
                "mean": (metric.mean, lambda v: v.mean(axis=-1)),
                "rms": (metric.rms, lambda v: np.sqrt((v * v).mean(axis=-1))),
            }
            for word, (make, reduce) in reductions.items():
                asked[f"{word} {what} {order}"] = (make(what, order=order), reduce, what, order)
    found = assur.sweep(batch, {}, q, metrics={name: m for name, (m, *_) in asked.items()})
    assert found.kept.tolist() == np.flatnonzero(moves).tolist()
    assert (np.asarray(found.status[~moves]) > assur.Status.NEAR_SINGULAR).all()
    for key, (_, reduce, what, order) in asked.items():
        values = coordinate(motion, what, order)[moves]
        np.testing.assert_allclose(found[key][moves], reduce(values), rtol=1e-13, atol=1e-13)
        assert np.isnan(found[key][~moves]).all()


def test_least_transmission() -> None:
    for name, at in [("crank_rocker", "C"), ("engine", "B"), ("engine", "bore")]:
        batch = space(name)
        motion = batch.solve(Q, order=0, on_error="nan")
        found = assur.sweep(batch, {}, Q, metrics={"angle": metric.min_transmission_angle(at)})
        expected = motion.transmission_angle(at).min(axis=-1)
        np.testing.assert_allclose(found["angle"], expected, rtol=0, atol=1e-15)
    between = ("B", "D")
    found = assur.sweep(
        space("crank_rocker"),
        {},
        Q,
        metrics={"angle": metric.min_transmission_angle("C", between=between)},
    )
    motion = space("crank_rocker").solve(Q, order=0, on_error="nan")
    expected = motion.transmission_angle("C", between=between).min(axis=-1)
    np.testing.assert_allclose(found["angle"], expected, rtol=0, atol=1e-15)


@pytest.mark.parametrize("part", [0.1, 0.5, 1.0])
def test_deviation(part: float) -> None:
    batch = space("stephenson_six_bar")
    found = assur.sweep(
        batch,
        {},
        Q,
        metrics={
            "line": metric.deviation("P", shape="line", part=part),
            "relative": metric.deviation("P", shape="line", part=part, relative=True),
            "circle": metric.deviation("P", shape="circle", part=part),
        },
    )
    paths = batch.solve(Q, order=0, on_error="nan").joint("P").value
    count = min(round(part * 72) + 1, 72) if part > 0.1 else 8
    for design in found.kept[:40]:
        path = paths[design]
        np.testing.assert_allclose(
            [found["line"][design], found["relative"][design], found["circle"][design]],
            [
                textbook.off_line(path, count, True, False),
                textbook.off_line(path, count, True, True),
                textbook.off_circle(path, count, True, False),
            ],
            rtol=1e-8,
            atol=1e-15,
        )


def test_time_ratio_is_that_of_the_positions() -> None:
    batch = space("engine")
    found = assur.sweep(batch, {}, Q, metrics={"ratio": metric.time_ratio("bore")})
    values = batch.solve(Q, order=0, on_error="nan").slide("bore").value[found.kept]
    ahead = np.abs(values.argmax(axis=-1) - values.argmin(axis=-1)) / 72
    expected = np.maximum(ahead, 1 - ahead) / np.minimum(ahead, 1 - ahead)
    np.testing.assert_allclose(found["ratio"][found.kept], expected, rtol=1e-12)


def test_metrics_of_a_part_of_the_turn() -> None:
    batch = space("crank_rocker")
    found = assur.sweep(
        batch,
        {},
        Q,
        metrics={
            "inside": metric.max("C.y", over=(1.0, 2.0)),
            "across": metric.mean("rocker", over=(6.0, 7.0)),
            "none": metric.span("rocker", over=(0.001, 0.002)),
        },
    )
    motion = batch.solve(Q, order=0, on_error="nan")
    inside, across = (Q >= 1.0) & (Q <= 2.0), (Q >= 6.0) | (Q + 2 * np.pi <= 7.0)
    height, angle = motion.joint("C").value[..., 1], motion.link("rocker").value
    kept = found.kept
    assert (found["inside"][kept] == height[kept][:, inside].max(axis=-1)).all()
    np.testing.assert_allclose(found["across"][kept], angle[kept][:, across].mean(axis=-1), 1e-13)
    assert np.isnan(found["none"]).all()


def test_combinations_conditions_and_functions() -> None:
    batch = space("crank_rocker")

    def height(motion: assur.Motion) -> Float:
        highest: Float = motion.joint("C").value[..., 1].max(axis=-1)
        return highest

    angle, high = metric.min_transmission_angle("C"), metric.function(height, outputs=["C"])
    quality = 2.0 * metric.span("rocker") - high / 3.0 + 1.0
    found = assur.sweep(
        batch,
        {},
        Q,
        metrics={"quality": quality, "high": high, "turns": metric.reachable()},
        where=[angle > 0.5, metric.span("C.x") <= 2.0, quality < 2.0],
    )
    motion = batch.solve(Q, order=0, on_error="nan")
    highest = motion.joint("C").value[..., 1].max(axis=-1)
    expected = 2.0 * np.ptp(motion.link("rocker").value, axis=-1) - highest / 3.0 + 1.0
    moves = (motion.status <= assur.Status.SINGULAR).all(axis=-1)
    meets = (
        moves
        & (motion.transmission_angle("C").min(axis=-1) > 0.5)
        & (np.ptp(motion.joint("C").value[..., 0], axis=-1) <= 2.0)
        & (expected < 2.0)
    )
    assert 0 < meets.sum() < moves.sum()
    assert found.kept.tolist() == np.flatnonzero(meets).tolist()
    assert np.isnan(found["quality"][~meets]).all()
    assert (found["turns"][meets] == 1.0).all()
    assert (found["high"][meets] == highest[meets]).all()
    np.testing.assert_allclose(found["quality"][meets], expected[meets], rtol=1e-13)


def test_a_link_that_keeps_its_angle_by_slides_is_no_crank() -> None:
    """Its pin stands still: a dyad on it reaches the ground at every position or at none."""
    m = assur.Mechanism(
        joints={
            "O": (0, 0),
            "B": (1, 0),
            "D": (3, 0),
            "F": (3.5, 1.5),
            "G": (1.5, 2.0),
            "H": (3, -2),
        },
        links={
            "ground": "OD",
            "crank": "OB",
            "table": "FD",
            "block": "H",
            "k4": "FG",
            "k5": "GO",
        },
        driver="crank",
        slides={
            "s1": assur.Slide("table", on="block", angle=2.5),
            "s2": assur.Slide("block", on="ground", angle=-0.9),
        },
    )
    q = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)
    lengths = [1.0, 1.7, 1.9, 2.0, 2.2, 2.5, 3.0]
    measures = {"full": assur.metric.reachable(), "x": assur.metric.max("B.x")}
    found = assur.sweep(m, {"k5.length": lengths}, q, metrics=measures)
    for index, length in enumerate(lengths):
        reaches = (
            m.with_dimensions({"k5.length": length}).solve(q, on_error="nan").status.max() == 0
        )
        assert (found.status[index] == 0) == reaches, length
    assert found.status[-1] == 0
    assert found["full"][-1] == 1.0
    np.testing.assert_allclose(found["x"][found.status == 0], 1.0)
    assert 0 < np.sum(found.status == 0) < len(lengths)
