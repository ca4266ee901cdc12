"""Change points: both solutions of a dyad meet, and the smooth motion goes on.

Closed forms over four turns, on grids that hit the change points exactly (every 45° from a start
at 0 or 90°) and on fine ones.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import pytest

import assur
from assur import Status

Float = npt.NDArray[np.float64]
GRIDS = [np.deg2rad(np.arange(0.0, 1440.0 + step / 2, step)) for step in (45.0, 7.5, 1.0, 0.1)]
U = 2.2e-16


def bounds(motion: assur.Motion) -> tuple[Float, Float]:
    """8 u κ and 64 u κ² of design "Numbers"; at a change point κ is taken at the nearest other."""
    kappa = np.where(motion.status == Status.SINGULAR, 1e3, motion.condition)
    return 8 * U * kappa, 64 * U * kappa**2


def gaps(angle: Float) -> Float:
    """Angles apart from whole turns."""
    apart: Float = np.abs(np.angle(np.exp(1j * angle)))
    return apart


@pytest.mark.parametrize("q", GRIDS, ids=len)
def test_parallelogram(q: Float) -> None:
    motion = assur.FourBar(1.0, 3.0, 1.0, 3.0).solve(q, order=3)
    position, analogue = bounds(motion)
    rocker, coupler = motion.link("rocker"), motion.link("coupler")
    assert (motion.status <= Status.SINGULAR).all()
    assert (np.abs(rocker.value - q) <= 3 * position).all()
    assert (np.abs(coupler.value) <= 3 * position).all()
    assert (np.abs(rocker.d1 - 1.0) <= analogue).all()
    # Their own size is 0; it grows like the condition's odd powers.
    kappa = analogue / (64 * U)
    assert (np.abs(rocker.d2) <= analogue * kappa).all()


@pytest.mark.parametrize("q", GRIDS, ids=len)
def test_antiparallelogram(q: Float) -> None:
    """The diagonals of its trapezium are parallel: tan(θ/2) tan(q/2) is constant."""
    crank, ground = 1.0, 3.0
    motion = assur.FourBar(crank, ground, crank, ground, mode="crossed").solve(q, order=1)
    position, _ = bounds(motion)
    ratio = (ground + crank) / (ground - crank)
    closed = 2.0 * np.arctan2(ratio * np.sin(q / 2), np.cos(q / 2))
    assert (gaps(motion.link("rocker").value + closed) <= 16 * position).all()
    # It turns the other way, once a turn, without a jump.
    assert motion.link("rocker").value[-1] - motion.link("rocker").value[0] == pytest.approx(
        -8 * np.pi, abs=1e-9
    )


@pytest.mark.parametrize("q", GRIDS, ids=len)
def test_kite_turns_half_as_fast(q: Float) -> None:
    """Crank = ground, coupler = rocker: two turns of the crank to return."""
    motion = assur.FourBar(1.0, 2.0, 2.0, 1.0).solve(q, order=1)
    position, _ = bounds(motion)
    assert (motion.status <= Status.SINGULAR).all()
    # D sees A and B under q/2 + 90°: C is on the bisector.
    apex = np.arccos(np.sin(q / 2) / 2.0)
    closed = np.pi / 2 + q / 2 - apex
    other = np.pi / 2 + q / 2 + apex
    value = motion.link("rocker").value
    error = np.minimum(gaps(value - closed), gaps(value - other))
    assert (error <= 16 * position).all()
    c = motion.joint("C").value
    jumps = np.abs(np.diff(c, axis=0)).max()
    assert jumps <= 2.5 * (q[1] - q[0])
    assert np.allclose(c[q == 0.0], c[np.isclose(q, 4 * np.pi)], atol=1e-9)


@pytest.mark.parametrize("q", GRIDS, ids=len)
def test_isosceles_slider_crank(q: Float) -> None:
    motion = assur.SliderCrank(1.5, 1.5).solve(q, order=2)
    position, analogue = bounds(motion)
    bore = motion.slide("bore")
    assert (np.abs(bore.value - 3.0 * np.cos(q)) <= 3 * position).all()
    assert (np.abs(bore.d1 + 3.0 * np.sin(q)) <= 3 * analogue).all()
    kappa = analogue / (64 * U)
    assert (np.abs(bore.d2 + 3.0 * np.cos(q)) <= 3 * analogue * kappa).all()


@pytest.mark.parametrize("attitude", np.linspace(0.1, 6.0, 20))
def test_parallelogram_drawn_from_coordinates(attitude: float) -> None:
    """Lengths equal only to rounding; with a third bar, which must fit all the way."""
    turn = np.array([[np.cos(attitude), np.sin(attitude)], [-np.sin(attitude), np.cos(attitude)]])
    places = {
        "A": (0, 0),
        "B": (0.6, 0.8),
        "D": (2, 0),
        "C": (2.6, 0.8),
        "F": (1, 0),
        "E": (1.6, 0.8),
    }
    m = assur.Mechanism(
        joints={name: tuple(np.array(at) @ turn) for name, at in places.items()},
        links={
            "ground": ["A", "D", "F"],
            "crank": ["A", "B"],
            "rod": ["B", "C", "E"],
            "second": ["D", "C"],
            "third": ["F", "E"],
        },
        driver="crank",
    )
    assert m.structure.redundant == ("third",)
    q = m.q0 + np.linspace(0.0, 8 * np.pi, 721)
    motion = m.solve(q, order=1)
    position, _ = bounds(motion)
    for link in ("second", "third"):
        assert (gaps(motion.link(link).value - q) <= 8 * position).all()


def test_a_near_miss_is_no_change_point() -> None:
    """Lengths off by 1e-4: the crank turns, the assembly stays, nothing jumps."""
    motion = assur.FourBar(1.0, 3.0, 1.0 + 1e-4, 3.0).solve(np.linspace(0, 2 * np.pi, 3601))
    rocker = motion.link("rocker").value
    assert (motion.status == Status.OK).sum() > 3000
    assert rocker[-1] != pytest.approx(rocker[0] + 2 * np.pi, abs=0.1)


def test_a_gap_is_no_change_point() -> None:
    """Lengths off the other way: two dead points close together, the same assembly beyond."""
    m = assur.FourBar(1.0, 3.0, 1.0, 3.0 + 1e-4)
    q = np.linspace(0, 2 * np.pi, 3601)
    motion = m.solve(q, on_error="nan")
    assert (motion.status == Status.UNREACHABLE).any()
    beyond = motion.link("rocker").value[np.isclose(q, 1.5 * np.pi)]
    assert np.isfinite(beyond).all()


@pytest.mark.parametrize("step", [45.0, 7.5, 0.5])
def test_chain_of_ten_parallelograms(step: float) -> None:
    """All of them change at once, each upon the other; their rods stay parallel to the ground."""
    crank, rod = np.array([np.cos(1.0), np.sin(1.0)]), 2.0 * np.array([np.cos(0.3), np.sin(0.3)])
    joints = {f"O{i}": tuple(i * rod) for i in range(11)}
    joints |= {f"A{i}": tuple(i * rod + crank) for i in range(11)}
    links = {"ground": [f"O{i}" for i in range(11)]}
    links |= {f"crank{i}": [f"O{i}", f"A{i}"] for i in range(11)}
    links |= {f"rod{i}": [f"A{i - 1}", f"A{i}"] for i in range(1, 11)}
    m = assur.Mechanism(joints=joints, links=links, driver="crank0")
    q = 0.3 + np.deg2rad(np.arange(0.0, 1440.0 + step / 2, step))  # in line at 0.3 + k π
    motion = m.solve(q, order=1)
    for i in range(1, 11):
        assert np.abs(motion.link(f"crank{i}").value - q).max() < 1e-11
        assert np.abs(motion.link(f"crank{i}").d1 - 1.0).max() < 1e-7
        assert np.abs(motion.link(f"rod{i}").value - 0.3).max() < 1e-11
