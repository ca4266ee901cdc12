"""P4's mechanism of class IV against 30 digits, and a triad that is elsewhere after a turn."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import assur
from assur import Status
from models.errors.refusals import build
from models.mechanisms.class_iv_model import class_iv

CASE: dict[str, Any] = json.loads(
    (Path(__file__).parent / "cases" / "class_iv_reference.json").read_text(encoding="utf-8")
)
POSITIONS: list[dict[str, Any]] = CASE["positions"]
Q = np.array([float(p["crank_rad"]) for p in POSITIONS])
# The case's names: rotations from the drawing, or angles; the link, and whether it is a rotation.
ANGLES = {
    "alpha_link_2_3_4": ("l234", True),
    "beta_link_3_6_5": ("l365", True),
    "gamma_link_4_8": ("l48", False),
    "delta_link_8_7_6": ("l876", True),
    "rocker_9_5": ("l95", False),
    "rocker_10_7": ("l107", False),
}
TOLERANCE = 1e-12
STEPS_DEG = (0.1, 1.0, 5.0, 7.3, 45.0)
# Rotations of (2-3-4, 3-6-5, 4-8, 8-7-6) in the other assembly, degrees, at φ = 0.
OTHER_DEG = (-42.0077, -22.8917, -23.1908, -36.5326)


@pytest.fixture(scope="module")
def mechanism() -> assur.Mechanism:
    return build(**class_iv())


@pytest.fixture(scope="module")
def motion(mechanism: assur.Mechanism) -> assur.Motion:
    return mechanism.solve(Q)


@pytest.mark.parametrize(
    ("of", "key"), [("value", "joints"), ("d1", "d_joints"), ("d2", "d2_joints")]
)
def test_joints_to_thirty_digits(motion: assur.Motion, of: str, key: str) -> None:
    for name in POSITIONS[0][key]:
        exact = np.array([[float(x) for x in p[key][name]] for p in POSITIONS])
        assert np.abs(getattr(motion.joint(name), of) - exact).max() < TOLERANCE, name


@pytest.mark.parametrize(
    ("of", "key"), [("value", "angles"), ("d1", "d_angles"), ("d2", "d2_angles")]
)
def test_angles_to_thirty_digits(motion: assur.Motion, of: str, key: str) -> None:
    for name, (link, rotation) in ANGLES.items():
        exact = np.array([float(p[key][name]) for p in POSITIONS])
        found = getattr(motion.link(link), of)
        if rotation and of == "value":
            found = found - found[0]
        assert np.abs(found - exact).max() < TOLERANCE, name


@pytest.mark.parametrize("step", STEPS_DEG)
def test_a_full_turn_at_any_step_has_the_same_bits(mechanism: assur.Mechanism, step: float) -> None:
    q = np.deg2rad(np.arange(0.0, 360.0 + 1e-9, step))
    whole, alone = mechanism.solve(q), [mechanism.solve(x) for x in q[:: max(1, len(q) // 9)]]
    assert (whole.status == Status.OK).all()
    for one, i in zip(alone, range(0, len(q), max(1, len(q) // 9)), strict=True):
        for name in mechanism.joints:
            for of in ("value", "d1", "d2"):
                a, b = getattr(one.joint(name), of), getattr(whole.joint(name), of)[i]
                np.testing.assert_array_equal(a, b)


def rotated(degrees: tuple[float, ...]) -> dict[str, tuple[float, float]]:
    """The joints of the other assembly at φ = 0, to the digits of its angles."""
    places = {name: complex(*place) for name, place in class_iv()["joints"].items()}
    new = {name: places[name] for name in ("1", "2", "9", "10")}
    turn = [np.exp(1j * np.deg2rad(d)) for d in degrees]
    new["3"] = new["2"] + turn[0] * (places["3"] - places["2"])
    new["4"] = new["2"] + turn[0] * (places["4"] - places["2"])
    new["6"] = new["3"] + turn[1] * (places["6"] - places["3"])
    new["5"] = new["3"] + turn[1] * (places["5"] - places["3"])
    new["8"] = new["4"] + turn[2] * (places["8"] - places["4"])
    new["7"] = new["8"] + turn[3] * (places["7"] - places["8"])
    return {name: (float(z.real), float(z.imag)) for name, z in new.items()}


def test_the_other_assembly_is_followed(mechanism: assur.Mechanism) -> None:
    other = build(**{**class_iv(), "joints": rotated(OTHER_DEG)})
    exact = other.with_dimensions(dict(mechanism.dimensions))
    q = np.deg2rad([0.0, 100.0])
    motion = exact.solve(q)
    assert (motion.status == Status.OK).all()
    # At φ = 100° the rotations from the drawing that reference values give.
    expected = (-62.9749, -4.4311, 1.0313, -43.4921)
    for link, degrees in zip(("l234", "l365", "l48", "l876"), expected, strict=True):
        first = mechanism.solve(0.0).link(link).value
        turned = np.rad2deg(motion.link(link).value[1] - first)
        assert abs((turned - degrees + 180.0) % 360.0 - 180.0) < 1e-3, link
    assert motion.residual.max() < 1e-14


def test_the_triad_that_is_elsewhere_after_a_turn() -> None:
    joints = {"O": (0, 0), "A": (0.1685, -0.767), "P": (0.53, 0.6925), "Q": (0.0554, -1.3097)}
    joints |= {"R": (-1.4824, -0.9703), "U": (-1, 1.7419), "V": (0.77, 0.5304)}
    links = {"ground": "OUV", "crank": "OA", "rod": "AP", "plate": "PQR", "left": "UQ"}
    m = build(joints=joints, links={**links, "right": "VR"})
    q = float(m.q0) + np.deg2rad(np.arange(0, 720))
    motion = m.solve(q, on_error="nan")
    assert (motion.status[:361] <= Status.NEAR_SINGULAR).all()
    moved = motion.joint("P").value[360] - motion.joint("P").value[0]
    assert abs(np.hypot(*moved) - 3.0) < 0.05
    lost = np.flatnonzero(motion.status == Status.LOST)
    assert len(lost)
    assert lost[0] > 361
    assert (motion.status[lost[0] :] == Status.LOST).all()
    assert np.isnan(motion.joint("P").value[lost]).all()
    assert "dead point" in motion.explain(int(lost[0]))
    with pytest.raises(assur.PositionError, match=r"III\(.*\) ends at"):
        m.solve(q)


def test_change_points_after_a_group_that_folds() -> None:
    """A parallelogram on the rocker of a triad passes its change point on the way to a fold."""
    joints = {"O": (0, 0), "A": (0.6, 0.4), "B": (1, 2), "C": (2.5, 1.5), "D": (2, 3), "E": (4, 0)}
    joints |= {"F": (0, 4)}
    links = {"ground": "OEF", "crank": "OA", "b1": "AB", "plate": "BCD", "b2": "CE", "b3": "DF"}
    triad = build(joints=joints, links=links)
    q = float(triad.q0) + np.linspace(-6.0, 6.0, 2401)
    motion = triad.solve(q, on_error="nan")
    given = motion.status <= Status.NEAR_SINGULAR
    assert (motion.status[~given] == Status.LOST).all()
    # A second rocker of that length, and a rod as long as the ground between the pivots; along a
    # direction that the rocker passes.
    rocker = motion.link("b2").value[given]
    angle = 0.7 * rocker.min() + 0.3 * rocker.max()
    shift = 0.8 * np.array([np.cos(angle), np.sin(angle)])
    places = {**joints, "G": tuple(np.array([4, 0]) + shift)}
    places["H"] = tuple(np.array(joints["C"]) + shift)
    double = build(joints=places, links={**links, "ground": "OEFG", "rod": "CH", "second": "HG"})
    other = double.solve(q, on_error="nan")
    np.testing.assert_array_equal(other.status <= Status.SINGULAR, given)
    assert (other.status == Status.NEAR_SINGULAR).any()
    apart = other.joint("H").value[given] - motion.joint("C").value[given]
    np.testing.assert_allclose(apart, np.broadcast_to(shift, apart.shape), atol=1e-10)
