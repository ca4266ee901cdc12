"""Pictures of flywheels: speeds, areas and tangents against worked examples and energy balances."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from matplotlib.patches import Rectangle

import assur
from assur import flywheel
from assur.pictures.style import DARK
from pictures.diagrams.chart_overlaps import overlapping

TURN = 2.0 * math.pi
PHI = np.linspace(0.0, TURN, 361)
KINDS: tuple[Any, ...] = ("speed", "moment", "energy")


def engine() -> flywheel.Flywheel:
    """Khurmi and Gupta, 16.11: 180 rpm, 1 %."""
    moment = 9500.0 * np.sin(2.0 * PHI) - 5700.0 * np.cos(2.0 * PHI) + 20000.0
    return flywheel.from_table(
        PHI, moment, 0.0 * PHI, fluctuation=0.01, mean_speed=6.0 * math.pi, mean="extremes"
    )


def press(motor: Any = None) -> assur.Machine:
    return assur.Machine(
        assur.SliderCrank(0.1, 0.4),
        bodies={"piston": assur.Body(mass=20.0), "crank": assur.Body(inertia=0.5)},
        loads=[assur.Torque("crank", -20.0)],
        motor=motor or assur.LinearMotor(stall=50.0, no_load=15.0),
    )


def line(ax: Any, gid: str) -> Any:
    return next(one for one in ax.lines if one.get_gid() == gid).get_data()


def said(ax: Any, gid: str) -> list[str]:
    return [text.get_text() for text in ax.texts if text.get_gid() == gid]


def test_the_speed_has_its_band_mean_and_extremes() -> None:
    f = engine()
    ax = f.plot("speed", degrees=True)
    assert ax.get_title(loc="left") == f"Speed, rad/s: δ = 0.01 with {f.inertia:.4g} kg·m²"
    x, y = line(ax, "curve speed")
    np.testing.assert_allclose(x, np.degrees(np.linspace(0.0, TURN, 721)))
    np.testing.assert_array_equal(y, f.speed(np.radians(x)))
    (band,) = (patch for patch in ax.patches if patch.get_gid() == "fluctuation")
    assert isinstance(band, Rectangle)
    low, high = band.get_y(), band.get_y() + band.get_height()
    assert (low, high) == pytest.approx((f.min.value, f.max.value))
    assert (high - low) / (3.0 * math.pi * 2.0) == pytest.approx(0.01, rel=1e-8)
    assert said(ax, "mean text") == [f"mean {6.0 * math.pi:.3f}"]
    texts = said(ax, "extreme speed")
    # tan 2θ = 5700/9500: the moment crosses its mean at 15.48° and 90° on.
    assert texts[0].endswith((" at 105°", " at 285°"))
    assert texts[1].endswith((" at 15°", " at 195°"))


def test_areas_of_the_moment_are_khurmi_and_guptas() -> None:
    """ΔE = √(9500² + 5700²) = 11078.8 J in each lobe."""
    f = engine()
    ax = f.plot("moment")
    greatest = math.hypot(9500.0, 5700.0)
    energies = said(ax, "energy")
    assert energies[1:4] == [f"+{greatest:.0f} J", f"−{greatest:.0f} J", f"+{greatest:.0f} J"]
    assert said(ax, "sentence")[0].endswith(f"greatest change of energy {greatest:.0f} J")
    assert {area.get_gid() for area in ax.collections} == {"surplus", "deficit"}
    ends = f.plot("energy")
    (top,), (bottom,) = (
        np.array(mark.get_ydata()) for mark in ends.lines if mark.get_gid() == "mark"
    )
    assert top - bottom == pytest.approx(greatest, rel=1e-6)
    # Without inertia of its own the machine leaves all of it to the flywheel.
    np.testing.assert_allclose(
        line(ends, "curve flywheel")[1], line(ends, "curve work")[1], atol=1e-6 * greatest
    )


def test_the_motor_of_a_machine_is_its_law() -> None:
    """The motor's curve follows from the motion: it is stall (1 − ω/no_load)."""
    f = press().flywheel(0.05)
    ax = f.plot("moment")
    q, motor = line(ax, "curve motor")
    speed = f.speed(q)
    # The acceleration of dense output is less accurate than the speed.
    np.testing.assert_allclose(motor, 50.0 * (1.0 - speed / 15.0), atol=1e-3)
    np.testing.assert_allclose(line(ax, "curve resistance")[1], -f.reduced_moment(q))


@pytest.mark.parametrize("given", ["paper", "machine", "backward"])
def test_wittenbauers_loop_fills_the_picture_and_the_tangents_meet(given: str) -> None:
    paper: dict[str, Any] = {
        "moment": [-0.23, -274.4, -950.5, 19.9, 1.26, -300.0, -23.9, -15.9, -0.23],
        "inertia": [4.93, 5.07, 5.1, 5.1, 4.93, 5.05, 5.1, 5.14, 4.93],
    }
    f = {
        "paper": lambda: flywheel.from_table(
            np.linspace(0.0, TURN, 9), **paper, fluctuation=1 / 8, mean_speed=15.0
        ),
        "machine": lambda: press().flywheel(0.05),
        "backward": lambda: press(assur.LinearMotor(50.0, 15.0, ratio=-1.0)).flywheel(0.05),
    }[given]()
    if given == "backward":
        assert f.speed0 < 0.0
    ax = f.plot("energy-mass")
    inertia, energy = line(ax, "curve loop")
    (x0, x1), (y0, y1) = ax.get_xlim(), ax.get_ylim()
    assert 0.5 < np.ptp(inertia) / (x1 - x0) < 0.7
    assert 0.5 < np.ptp(energy) / (y1 - y0) < 0.85
    # Every point lies between the tangents, which touch it; both pass through the corner.
    corner = -f.inertia, -f.inertia * f.speed0**2 / 2.0
    slopes = []
    for name, sign in (("greatest", -1.0), ("least", 1.0)):
        (xa, xb), (ya, yb) = line(ax, f"tangent {name}")
        assert (xa, xb) == (x0, x1)
        slope = (yb - ya) / (xb - xa)
        apart = sign * (energy - (ya + slope * (inertia - xa)))
        size = np.ptp(energy)
        assert -1e-6 * size < apart.min() < 1e-3 * size
        assert ya + slope * (corner[0] - xa) == pytest.approx(corner[1], abs=1e-6 * abs(corner[1]))
        slopes.append(slope)
    # What they cut off the frame by similar triangles: an energy, of steep ones an inertia.
    (text,) = said(ax, "intercept text")
    if given == "paper":
        assert float(text.split()[0]) == pytest.approx(
            (slopes[0] - slopes[1]) * (x0 - corner[0]), rel=5e-3
        )
        assert text.endswith("J\nat the frame")
    else:
        level = y0 + 0.04 * (y1 - y0) - corner[1]
        cut = abs(level / slopes[0] - level / slopes[1])
        assert float(text.split()[0]) == pytest.approx(cut, rel=5e-3)
        assert text.endswith("kg·m²\nat the frame")
    (sentence,) = said(ax, "sentence")
    assert sentence.startswith(f"δ = {f.delta:.3g}; the tangents meet at I = −{f.inertia:.4g}")
    x, _ = line(ax, "dots")
    assert len(x) == 12
    step = math.copysign(math.pi / 6.0, f.speed0)
    own = np.sort(np.asarray(f.reduced_inertia(step * np.arange(12))))
    np.testing.assert_allclose(np.sort(x), own, rtol=1e-9)
    angles = said(ax, "angle")
    assert 3 <= len(angles) <= 6
    assert set(angles) <= {f"{60 * k}°".replace("-", "−") for k in range(-6, 7)}
    count, bad = overlapping(ax.figure)
    assert count > 6
    assert not bad


def test_reduced_moment_and_inertia() -> None:
    f = press().flywheel(0.05)
    moment, inertia = f.plot("reduced", dark=True)
    x, y = line(inertia, "curve Reduced inertia")
    np.testing.assert_array_equal(y, f.reduced_inertia(x))
    assert moment.get_title(loc="left") == "Reduced moment of the loads, N·m"
    assert inertia.lines[0].get_color() == DARK.ink
    # At the dead points the piston adds nothing to the crank's 0.5 kg·m².
    lowest = [mark.get_ydata()[0] for mark in inertia.lines if mark.get_gid() == "mark"][1]
    assert lowest == pytest.approx(0.5, rel=1e-9)


def test_a_batch_is_refused() -> None:
    phi = np.linspace(0.0, TURN, 49)
    batch = flywheel.from_table(
        phi, 100.0 * np.sin(phi), 0 * phi, fluctuation=[0.1, 0.2], mean_speed=10.0
    )
    with pytest.raises(assur.InputError, match=r"batch \(2,\)"):
        batch.plot()


def test_texts_are_clear() -> None:
    count = 0
    bad: list[str] = []
    for f in (engine(), press().flywheel(0.05)):
        for what in KINDS:
            axes: Any = f.plot(what)
            written, wrong = overlapping(np.ravel(axes)[0].figure)
            count += written
            bad += [f"{what}: {one}" for one in wrong]
    assert count > 30
    assert len(bad) <= 0.02 * count, bad
