"""Hodographs, and vectors along a path."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import assur
from assur.pictures import hodograph
from assur.pictures.linkage.subject import Subject
from assur.pictures.style import LIGHT
from assur.pictures.vectors.arrows import LOOKS, arrow, moment_arc, path_vectors
from pictures.picture_reading import named, one, texts, vector


def _canvas(motion: assur.Motion) -> Any:
    return Subject(motion).canvas(None, LIGHT)


def test_vectors_along_a_path() -> None:
    motion = assur.FourBar(0.1, 0.3, 0.25, 0.3).solve(np.linspace(0.0, 6.0, 7))
    on = _canvas(motion)
    points, vectors = motion.joint("C").value, motion.joint("C").velocity(10.0)
    scale = path_vectors(on, points, vectors, "velocity", [f"velocity C {i}" for i in range(7)])
    sizes = np.hypot(*vectors.T)
    for i in range(7):
        start, tip = vector(on.ax, f"velocity C {i}")
        np.testing.assert_allclose(start, points[i], atol=1e-12)
        np.testing.assert_allclose((tip - start) * on.scale, vectors[i] * scale, rtol=1e-9)
    assert sizes.max() * scale == pytest.approx(60.0)
    written = one(on.ax, "velocity C 3 text").get_text()
    assert written == f"$v$ {sizes[3]:#.3g} m/s"
    # A given scale is kept: other vectors can be compared with these.
    assert path_vectors(on, points, vectors, "velocity", ["v"] * 7, scale=3.0, texts=False) == 3.0


def test_vectors_that_do_not_exist_are_left_out() -> None:
    motion = assur.FourBar(0.1, 0.3, 0.25, 0.3).solve([0.0, 3.0])
    on = _canvas(motion)
    velocities = motion["C"].velocity(1.0)
    velocities[1] = np.nan
    path_vectors(on, motion["C"].value, velocities, "velocity", ["first", "second"])
    assert named(on.ax, "first")
    assert not named(on.ax, "second")
    assert not named(on.ax, "second text")


def test_heads() -> None:
    """Velocities have one filled head, accelerations two open ones; short vectors small heads."""
    on = _canvas(assur.FourBar(0.1, 0.3, 0.25, 0.3).solve(0.5))
    start, unit = np.zeros(2), np.array([1.0, 0.0]) / on.scale
    for kind, heads, filled in (
        ("velocity", 1, True),
        ("acceleration", 2, False),
        ("force", 1, True),
    ):
        drawn = arrow(on, start, 60.0 * unit, LOOKS[kind], LIGHT.ink, kind)
        assert len(drawn) == 1 + heads
        assert drawn[1].get_fill() == filled or drawn[1].get_facecolor()[3] == 0.0
    (_, full), (_, half) = (
        arrow(on, start, length * unit, LOOKS["force"], LIGHT.ink, "f") for length in (26.0, 13.0)
    )
    widths = [np.ptp(head.get_path().vertices[:, 1]) for head in (full, half)]
    assert widths[0] * on.scale == pytest.approx(11.0 * on.size)
    assert widths[1] == pytest.approx(widths[0] / 2.0)
    assert arrow(on, start, start, LOOKS["force"], LIGHT.ink, "nothing") == []


def test_moments_turn_as_their_sign() -> None:
    on = _canvas(assur.FourBar(0.1, 0.3, 0.25, 0.3).solve(0.5))
    centre = np.array([0.1, 0.2])
    for sign in (1.0, -1.0):
        line = moment_arc(on, centre, sign, LIGHT.force, "moment") - centre
        turned = np.unwrap(np.arctan2(line[:, 1], line[:, 0]))
        assert np.sign(turned[-1] - turned[0]) == sign
        np.testing.assert_allclose(np.hypot(*line.T) * on.scale, 26.0 * on.size)


def test_hodograph_of_rows() -> None:
    """The curve passes through what was asked for, and is refined between."""
    motion = assur.FourBar(0.1, 0.3, 0.25, 0.3).solve(np.linspace(0.0, 2.0 * np.pi, 25))
    ax = hodograph(motion, "C", speed=10.0, order=2)
    curve = one(ax, "hodograph C").get_xydata()
    exact = motion.joint("C").acceleration(10.0)
    steps = (len(curve) - 1) // 24
    assert len(curve) >= 361
    np.testing.assert_allclose(curve[::steps], exact, atol=1e-9 * np.abs(exact).max())
    greatest = np.hypot(*curve.T).max()
    tip = vector(ax, "greatest")[1]
    assert np.hypot(*tip) == pytest.approx(greatest)
    assert one(ax, "greatest text").get_text() == f"$a_{{C}}$ = {greatest:#.3g} m/s²"
    numbers = {t.get_text() for t in texts(ax) if str(t.get_gid()).startswith("number")}
    # Every second position; the last is the first again.
    assert numbers == {str(i) for i in range(0, 24, 2)}


def test_hodograph_of_the_whole_motion() -> None:
    motion = assur.SliderCrank(0.1, 0.4).solve(0.0)
    ax = hodograph(motion, "B", speed=10.0)
    curve = one(ax, "hodograph B").get_xydata()
    assert np.abs(curve[:, 1]).max() < 1e-9
    assert np.abs(curve[:, 0]).max() == pytest.approx(
        float(assur.slider_crank.greatest_speed(4.0).value), rel=1e-4
    )
    assert any(t.get_text() == "90°" for t in texts(ax))


def test_hodograph_keeps_the_assembly() -> None:
    """A motion of one position goes on in its own assembly."""
    mechanism = assur.FourBar(0.1, 0.3, 0.25, 0.3)
    own = mechanism.solve(1.0).joint("C").value
    motions = [mechanism.solve(1.0, assembly=one) for one in mechanism.assemblies(1.0)]
    (motion,) = [other for other in motions if abs(other.joint("C").value - own).max() > 0.01]
    curve = one(hodograph(motion, "C", speed=2.0), "hodograph C").get_xydata()
    exact = motion.joint("C").velocity(2.0)
    assert np.hypot(*(curve - exact).T).min() < 0.01 * np.hypot(*exact)


def test_hodographs_refused() -> None:
    motion = assur.FourBar(0.1, 0.3, 0.25, 0.3).solve(0.0)
    with pytest.raises(assur.InputError, match="order is 3"):
        hodograph(motion, "C", order=3)
    with pytest.raises(assur.InputError, match="rests"):
        hodograph(motion, "A")
    with pytest.raises(assur.InputError, match='no joint "Z"'):
        hodograph(motion, "Z")
    batch = motion.mechanism.with_dimensions({"coupler.length": [0.29, 0.3]}).solve([0.0, 1.0])
    with pytest.raises(assur.InputError, match=r"batch \(2, 2\)"):
        hodograph(batch, "C")
