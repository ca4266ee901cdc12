"""Input laws, against published peaks and their own derivatives; motions over time."""

from __future__ import annotations

import math
import pickle
import re
from functools import partial
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import assur
from assur import laws
from models.errors.refusals import refused

if TYPE_CHECKING:
    from pathlib import Path

KINDS: list[type[Any]] = [
    laws.Cycloidal,
    laws.Harmonic,
    laws.ModifiedSine,
    laws.Polynomial345,
    laws.Polynomial4567,
    laws.Trapezoidal,
    laws.Uniform,
]
# Greatest speed, acceleration and jerk of a unit rise in unit time: R. L. Norton, Cam Design and
# Manufacturing Handbook, table of peaks; the jerk of the first is 4π², of the second π³/2.
PEAKS = {
    laws.Cycloidal: (2.0, 2.0 * math.pi, 4.0 * math.pi**2),
    laws.Harmonic: (0.5 * math.pi, 0.5 * math.pi**2, 0.5 * math.pi**3),
    laws.ModifiedSine: (1.760, 5.528, 69.466),
    laws.Polynomial345: (1.875, 5.7735, 60.0),
    laws.Polynomial4567: (2.1875, 7.5132, 52.5),
    laws.Trapezoidal: (1.5, 4.5, 0.0),
}


@pytest.mark.parametrize("kind", list(PEAKS), ids=lambda kind: kind.__name__)
def test_published_peaks(kind: Any) -> None:
    _, *rates = kind(0.0, 1.0, 1.0).at(np.linspace(0.0, 1.0, 20_001))
    found = [float(np.abs(rate).max()) for rate in rates]
    np.testing.assert_allclose(found, PEAKS[kind], rtol=3e-4)


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_each_rate_is_the_derivative_of_the_one_before(kind: Any) -> None:
    law = kind(0.3, -1.1, 0.7, begin=2.0)
    random = np.random.default_rng(2)
    t, h = 2.0 + 0.7 * random.uniform(0.02, 0.98, 200), 1e-5
    # Not across a corner of the law.
    corners = 2.0 + 0.7 * np.array([1 / 8, 1 / 3, 2 / 3, 7 / 8])
    t = t[np.abs(t[:, None] - corners).min(axis=1) > 1e-3]
    ahead, behind, here = law.at(t + h), law.at(t - h), law.at(t)
    for order in range(3):
        slope = (ahead[order] - behind[order]) / (2.0 * h)
        scale = 1.0 + np.abs(here[order + 1]).max() + np.abs(here[min(order + 3, 3)]).max()
        np.testing.assert_allclose(slope, here[order + 1], rtol=0.0, atol=1e-6 * scale)


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
def test_from_rest_to_rest(kind: Any) -> None:
    law = kind(0.3, -1.1, 0.7, begin=2.0)
    q, *rates = law.at([1.0, 2.0, 2.7, 9.0])
    np.testing.assert_allclose(q, [0.3, 0.3, -1.1, -1.1], rtol=0.0, atol=1e-15)
    assert all(rate[0] == rate[3] == 0.0 for rate in rates)
    if kind is not laws.Uniform:
        np.testing.assert_allclose(rates[0][1:3], 0.0, atol=1e-14)
    # The middle of the way in the middle of the time.
    np.testing.assert_allclose(law.at(2.35)[0], -0.4, rtol=0.0, atol=1e-15)


def test_sequences() -> None:
    up = laws.Polynomial345(0.0, 1.0, 0.5)
    down = laws.Cycloidal(1.0, 0.2, 0.4, begin=0.8)
    both = laws.Sequence((up, down))
    t = np.linspace(-0.1, 1.4, 31)
    for own, first, second in zip(both.at(t), up.at(t), down.at(t), strict=True):
        np.testing.assert_array_equal(own, np.where(t < 0.8, first, second))
    assert both.span == (0.0, 1.2000000000000002)
    refused(assur.InputError, "begins before", partial(laws.Sequence, (down, up)))
    jump = laws.Harmonic(0.9, 0.0, 0.5, begin=0.6)
    refused(assur.InputError, "jumps", partial(laws.Sequence, (up, jump)))
    nothing: Any = ()
    refused(assur.InputError, "one law", partial(laws.Sequence, nothing))


def test_a_motion_over_time(tmp_path: Path) -> None:
    """Velocities and accelerations are the derivatives of positions over time."""
    engine = assur.SliderCrank(0.05, 0.2, 0.01)
    law = laws.ModifiedSine(0.2, 0.2 + math.pi, 0.5)
    t = np.linspace(0.01, 0.49, 25)
    moved, h = engine.follow(law, t), 1e-5
    ahead, behind = engine.follow(law, t + h), engine.follow(law, t - h)
    for name in ("A", "B"):
        now, later, before = (
            (of.value, of.velocity(), of.acceleration(), of.jerk())
            for of in (moved.joint(name), ahead.joint(name), behind.joint(name))
        )
        for order in range(3):
            slope = (later[order] - before[order]) / (2.0 * h)
            scale = 1.0 + np.abs(now[order + 1]).max()
            np.testing.assert_allclose(slope, now[order + 1], rtol=0.0, atol=2e-4 * scale)
    np.testing.assert_array_equal(moved.slide("bore").value, moved.motion.slide("bore").value)
    np.testing.assert_array_equal(
        moved.link("rod").velocity(), moved.motion["rod"].d1 * moved.speed
    )
    assert moved.point("rod", [(0.1, 0.0)]).velocity().shape == (1, 25, 2)
    table = moved.to_dataframe(degrees=True)
    assert list(table)[:3] == ["t", "q", "status"]
    np.testing.assert_array_equal(table["bore.a"], moved.slide("bore").acceleration())
    np.testing.assert_array_equal(table["bore.j"], moved.slide("bore").jerk())
    moved.to_excel(tmp_path / "moved.xlsx")


def test_two_drivers_one_held() -> None:
    at = {"A": (0, 0), "B": (0, 1), "P": (0.7, 1.2), "D": (1.4, 0.6), "E": (1, 0)}
    links = {"ground": "AE", "left": "AB", "rod": "BP", "arm": "DP", "right": "ED"}
    m = assur.Mechanism(at, links, ("left", "right"))
    left, right = np.array(m.q0)
    law = laws.Cycloidal(left, left + 0.2, 1.0)
    moved = m.follow([law, right], np.linspace(0.0, 1.0, 5))
    assert moved.q.shape == (5, 2)
    np.testing.assert_array_equal(moved.q[:, 1], right)
    np.testing.assert_array_equal(moved.joint("D").velocity(), 0.0)
    assert np.abs(moved.joint("P").velocity()[2]).max() > 0.1


def test_refusals() -> None:
    engine = assur.SliderCrank(0.05, 0.2)
    law = laws.Harmonic(0.0, 1.0, 1.0)
    refused(assur.InputError, "duration positive", partial(laws.Harmonic, 0.0, 1.0, 0.0))
    refused(assur.InputError, "start finite", partial(laws.Harmonic, math.nan, 1.0, 1.0))
    refused(assur.InputError, "Harmonic duration", partial(laws.Harmonic, 0.0, 1.0, 1e-320))
    refused(assur.InputError, "ramp", partial(laws.Trapezoidal, 0.0, 1.0, 1.0, ramp=0.6))
    refused(assur.InputError, "t finite", partial(law.at, [0.0, math.inf]))
    wrong: Any = 1.0
    refused(assur.InputError, "law", partial(engine.follow, wrong, [0.0]))
    refused(assur.InputError, "law", partial(engine.follow, [law, law], [0.0]))
    refused(assur.InputError, "times", partial(engine.follow, law, [[0.0]]))
    batch = engine.with_dimensions({"rod.length": [0.2, 0.3]})
    refused(assur.InputError, "batch", partial(batch.follow, law, [0.0]))


@pytest.mark.parametrize("ends", ["clamped", "natural", "not-a-knot", "periodic"])
def test_a_table_is_the_spline_that_scipy_draws(ends: Literal["clamped", "natural"]) -> None:
    times = np.array([0.5, 0.9, 1.0, 1.8, 2.5, 3.0])
    places = np.array([0.2, 0.7, 0.6, -0.4, 0.1, 0.2])
    law = laws.Tabulated(times, places, spline=ends)
    spline = CubicSpline(times, places, bc_type=ends)
    t = np.linspace(0.5, 3.0, 101)[:-1]
    for order, found in enumerate(law.at(t)):
        wanted = spline(t, order)
        np.testing.assert_allclose(found, wanted, rtol=0.0, atol=1e-12 * np.abs(wanted).max())


def test_a_table_rests_outside_its_times() -> None:
    law = laws.Tabulated([1.0, 2.0, 4.0], [0.3, 0.8, 0.5], spline="linear")
    assert law.span == (1.0, 4.0)
    for t, place in ((0.0, 0.3), (9.0, 0.5)):
        assert [float(one) for one in law.at(t)] == [place, 0.0, 0.0, 0.0]
    assert float(law.at(3.0)[0]) == pytest.approx(0.65, rel=1e-15)
    assert float(law.at(4.0)[0]) == 0.5
    again = pickle.loads(pickle.dumps(law))
    assert np.array_equal(again.at([1.5, 3.3]), law.at([1.5, 3.3]))


def test_a_table_drives_a_mechanism_through_its_points() -> None:
    engine = assur.SliderCrank(1.0, 3.0)
    times, angles = np.array([0.0, 0.4, 1.0]), np.array([0.3, 0.9, 2.0])
    motion = engine.follow(laws.Tabulated(times, angles), times)
    rod = np.sqrt(9.0 - np.sin(angles) ** 2)
    np.testing.assert_allclose(motion.slide("bore").value, np.cos(angles) + rod, rtol=1e-14)
    np.testing.assert_allclose(motion.slide("bore").velocity()[[0, 2]], 0.0, atol=1e-14)


@pytest.mark.parametrize(
    ("t", "value", "words"),
    [
        ([0.0, 1.0], [0.0], "t has shape (2,), value (1,)"),
        ([0.0], [0.0], "1 row: at least 2"),
        ([0.0, 0.0], [0.0, 1.0], "t[1] = 0.0 is not above t[0] = 0.0"),
        ([0.0, math.nan], [0.0, 1.0], "Tabulated t has nan"),
        ([0.0, 1e-300], [0.0, 1e300], "beyond the greatest number"),
    ],
)
def test_bad_tables_are_refused(t: list[float], value: list[float], words: str) -> None:
    with pytest.raises(assur.InputError, match=re.escape(words)):
        laws.Tabulated(t, value)


def test_forces_along_a_law() -> None:
    engine = assur.SliderCrank(0.1, 0.4)
    machine = assur.Machine(engine, bodies={"piston": assur.Body(mass=20.0)})
    motion = engine.follow(laws.Cycloidal(0.3, 2.0, 0.5), np.linspace(0.0, 0.5, 11))
    of_law = machine.reactions(motion)
    numbers = motion.q, motion.speed, motion.acceleration
    np.testing.assert_array_equal(of_law.driver, machine.reactions(*numbers, t=motion.t).driver)
    np.testing.assert_array_equal(machine.effort(motion), machine.effort(*numbers))
    # The drive gives the piston its kinetic energy and takes it back.
    power = machine.effort(motion) * motion.speed
    speed = motion.slide("bore").velocity()
    gained = motion.slide("bore").acceleration() * speed * 20.0
    np.testing.assert_allclose(power, gained, rtol=1e-12, atol=1e-12)
    with pytest.raises(assur.InputError, match="speed is given with a TimedMotion"):
        machine.reactions(motion, 3.0)
