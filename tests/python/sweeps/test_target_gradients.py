"""Gradients of errors of paths, functions and poses against differences of sweeps."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur import metric

if TYPE_CHECKING:
    from collections.abc import Callable

TURN = np.linspace(0.0, 2.0 * np.pi, 90, endpoint=False)
# Step of central differences, relative to the dimension (short: where a nearest place leaves a
# corner the error has a bend), and how near their limit is (Richardson 1911), relative to the
# greatest entry.
STEP, CLOSE = 2e-7, 1e-6


def slider_crank() -> assur.Mechanism:
    """One with a point on the rod, and a bore beside the crank's centre."""
    return assur.Mechanism(
        joints={"O": (0, 0), "A": (0.3, 0.4), "B": (2.0, 0.1), "P": (1.0, 0.8)},
        links={"ground": "O", "crank": "OA", "rod": "ABP", "piston": "B"},
        slides={"bore": assur.Slide("piston", on="ground", angle=0.1, origin="O")},
        driver="crank",
    )


# The mechanism, its positions, a joint and a link.
MOTIONS: dict[str, tuple[Callable[[], assur.Mechanism], Any, str, str]] = {
    "four-bar": (assur.examples.crank_rocker, TURN, "P", "coupler"),
    "part of a turn": (assur.examples.crank_rocker, TURN[10:43], "P", "rocker"),
    "slider-crank": (slider_crank, TURN, "P", "rod"),
    "six-bar": (assur.examples.stephenson_1, TURN, "S", "link2"),
    "class III": (assur.examples.triad, TURN, "C", "plate"),
}
KINDS: tuple[Any, ...] = ("points", "chamfer", "ordered")


def targets(m: assur.Mechanism, q: Any, joint: str, link: str) -> dict[str, metric.Metric]:
    """Errors from the motion itself, much distorted."""
    rng = np.random.default_rng(5)
    first = m.links[link][0]
    motion = m.solve(q, outputs=[joint, first, link])
    path = motion.joint(joint).value
    size = float(np.ptp(path))
    some = np.arange(1, len(q), 5)
    points = path[some] + 0.1 * size * rng.normal(size=(len(some), 2))
    angle = motion.link(link).value[some]
    poses = np.column_stack([motion.joint(first).value[some], angle])
    poses += 0.05 * rng.normal(size=poses.shape) * [size, size, 1.0]
    wanted = angle + 0.1 * rng.normal(size=len(some))
    closed = len(q) == len(TURN)
    asked = {
        kind: metric.path_error(
            joint, points, kind=kind, closed=None if kind == "points" else closed
        )
        for kind in KINDS
    }
    asked["open target"] = metric.path_error(joint, points, kind="ordered", closed=False)
    asked["function"] = metric.function_error(link, q[some], wanted)
    asked["function free"] = metric.function_error(link, q[some], wanted, offset="free")
    asked["function scaled"] = metric.function_error(
        f"{joint}.y", q[some], np.sin(wanted), offset="free", scale="free"
    )
    for slide in m.slides:
        asked["slide"] = metric.function_error(slide, q[some], 1.0 + 0.1 * np.sin(wanted))
    asked["poses"] = metric.pose_error(link, poses, length=size)
    asked["combined"] = asked["points"] * asked["poses"] + 2.0 * asked["function"]
    return asked


@pytest.mark.parametrize("name", MOTIONS)
def test_gradients_are_differences(name: str) -> None:
    make, q, joint, link = MOTIONS[name]
    m = make()
    asked = targets(m, q, joint, link)
    names = list(m.dimensions)
    found = assur.sweep(m, {}, q, metrics=asked, gradient=names)
    wanted: dict[str, list[float]] = {key: [] for key in asked}
    for one in names:
        drawn = float(m.dimensions[one])
        size = STEP * max(abs(drawn), 0.1 * max(map(abs, m.dimensions.values())))
        values = drawn + size * np.array([-1.0, 1.0, -0.5, 0.5])
        measured = assur.sweep(m, {one: values}, q, metrics=asked)
        for key, differences in wanted.items():
            low, high, lower, higher = measured[key]
            far, near = (high - low) / (2.0 * size), (higher - lower) / size
            differences.append((4.0 * near - far) / 3.0)
    for key, differences in wanted.items():
        gradient = found.gradient[key]
        assert np.isfinite(found[key])
        assert found[key] > 1e-3
        error = np.abs(gradient - differences).max()
        assert error <= CLOSE * np.abs(differences).max(), (key, gradient, differences)


def test_of_no_error_there_is_none() -> None:
    m = assur.examples.crank_rocker()
    motion = m.solve(TURN, outputs=["B", "coupler"])
    theta, angle = TURN[:3], motion.link("coupler").value[:3]
    asked = {
        "path": metric.path_error("B", motion.joint("B").value[:9]),
        "function": metric.function_error("coupler", theta, angle),
    }
    found = assur.sweep(m, {}, TURN, metrics=asked, gradient="crank.length")
    assert found["function"] == 0.0
    assert np.isnan(found.gradient["function"]).all()
    assert found["path"] < 1e-15


def test_along_the_gradient_the_error_falls() -> None:
    """A design finds the path of another by steps against the gradient."""
    m = assur.examples.crank_rocker()
    target = m.with_dimensions({"coupler.P.x": 0.07, "coupler.P.y": 0.05})
    points = target.solve(TURN, outputs=["P"]).joint("P").value
    names = ["coupler.P.x", "coupler.P.y"]
    asked = {"it": metric.path_error("P", points, kind="ordered", closed=True)}
    at = np.array([float(m.dimensions[one]) for one in names])
    step, errors = 0.002, []
    for _ in range(60):
        found = assur.sweep(
            m, dict(zip(names, at, strict=True)), TURN, metrics=asked, gradient=names
        )
        errors.append(float(found["it"]))
        if len(errors) > 1 and errors[-1] >= errors[-2]:
            step *= 0.5
        slope = found.gradient["it"]
        at = at - step * slope / np.linalg.norm(slope)
    assert errors[-1] < 1e-3 * errors[0]
    assert at == pytest.approx([0.07, 0.05], abs=1e-4)
