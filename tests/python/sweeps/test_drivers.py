"""Metrics of mechanisms with several drivers: the right number, or a refusal that says why."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import assur
from assur import metric
from models.mechanisms import named_drawings
from oracles.kinematics import textbook

Float = npt.NDArray[np.float64]

FIVE_BAR = assur.Mechanism(
    joints={"A": (0, 0), "B": (-0.4, 1.0), "C": (1.2, 2.0), "D": (2.6, 1.0), "E": (2, 0)},
    links={"ground": "AE", "left": "AB", "arm": "BC", "far": "DC", "right": "ED"},
    driver=["left", "right"],
)
# Mechanism, its coordinates, a point, a link, a slide, where transmission is measured.
MECHANISMS = {
    "excavator": (
        named_drawings.CLASS_II["excavator"](),
        np.linspace(*named_drawings.RANGES["excavator"], 23),
        "tip",
        "stick",
        "stick",
    ),
    "five-bar": (
        FIVE_BAR,
        np.asarray(FIVE_BAR.q0) + 0.4 * np.random.default_rng(1).uniform(-1, 1, (23, 2)),
        "C",
        "arm",
        "C",
    ),
}


@pytest.mark.parametrize("name", MECHANISMS)
def test_every_metric(name: str) -> None:
    m, q, point, link, at = MECHANISMS[name]
    at = at if name == "five-bar" else "stick_slide" if "stick_slide" in m.slides else at
    coordinates = [f"{point}.x", f"{point}.y", link, *m.slides]
    makes: dict[str, Any] = {
        word: getattr(metric, word) for word in ("span", "min", "max", "mean", "rms")
    }
    asked = {f"{word} {of}": make(of) for word, make in makes.items() for of in coordinates}
    asked["line"] = metric.deviation(point)
    asked["round"] = metric.deviation(point, shape="circle", part=0.4, relative=True)
    asked["moves"] = metric.reachable()
    slides = [s for s in m.slides if m.slides[s].on != "ground"]
    asked |= {f"at {s}": metric.min_transmission_angle(s) for s in slides}
    if name == "five-bar":
        asked["at C"] = metric.min_transmission_angle("C")
    found = assur.sweep(m, {}, q, metrics=asked)
    motion = m.solve(q, order=0)
    assert found.kept.tolist() == [0]
    reductions: dict[str, Any] = {
        "span": np.ptp,
        "min": np.min,
        "max": np.max,
        "mean": np.mean,
        "rms": lambda v: np.sqrt(np.mean(v * v)),
    }
    for of in coordinates:
        values = coordinate(motion, of)
        for word, reduce in reductions.items():
            assert found[f"{word} {of}"] == pytest.approx(reduce(values), rel=1e-13)
    path = motion.joint(point).value
    assert found["line"] == pytest.approx(textbook.off_line(path, 12, False, False), rel=1e-9)
    assert found["round"] == pytest.approx(textbook.off_circle(path, 9, False, True), rel=1e-8)
    assert found["moves"] == 1.0
    angles = [key for key in asked if key.startswith("at ")]
    assert len(angles) == (3 if name == "excavator" else 1)
    for key in angles:
        expected = motion.transmission_angle(key[3:]).min()
        assert found[key] == pytest.approx(expected, rel=1e-12)
    unreachable = np.concatenate([q, 90.0 + q[:1]]) if name == "excavator" else None
    if unreachable is not None:
        failed = assur.sweep(m, {}, unreachable, metrics=asked)
        assert failed.kept.tolist() == []
        assert failed["moves"] == 0.0
        assert np.isnan(failed["line"])


def coordinate(motion: assur.Motion, name: str) -> Float:
    joint, _, axis = name.rpartition(".")
    if joint:
        point: Float = motion.joint(joint).value[..., "xy".index(axis)]
        return point
    slide = name in motion.mechanism.slides
    value: Float = (motion.slide(name) if slide else motion.link(name)).value
    return value


@pytest.mark.parametrize("name", MECHANISMS)
@pytest.mark.parametrize(
    "refused",
    [
        "argmin",
        "argmax",
        "time_ratio",
        "order",
        "over",
        "over of a transmission",
    ],
)
def test_what_needs_one_driver_is_refused(name: str, refused: str) -> None:
    m, q, point, link, _ = MECHANISMS[name]
    asked = {
        "argmin": metric.argmin(link),
        "argmax": metric.argmax(f"{point}.y"),
        "time_ratio": metric.time_ratio(link),
        "order": metric.span(link, order=1),
        "over": metric.span(link, over=(0.0, 1.0)),
        "over of a transmission": metric.min_transmission_angle(
            point, between=("B", "D") if name == "five-bar" else ("foot", "elbow"), over=(0.0, 1.0)
        ),
    }[refused]
    drivers = q.shape[1]
    with pytest.raises(assur.InputError, match=f"one driver, here are {drivers}"):
        assur.sweep(m, {}, q, metrics={"a": asked})
    with pytest.raises(assur.InputError, match=f"one driver, here are {drivers}"):
        assur.sweep(m, {}, q, metrics={}, where=[2.0 * asked > 1.0])
