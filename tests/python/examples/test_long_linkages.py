"""Six-bars, walking, drawing, digging and pressing linkages."""

from __future__ import annotations

import math
from typing import TypeAlias

import numpy as np
import numpy.typing as npt
import pytest

import assur
from assur import Status, examples
from models.mechanisms import named_drawings, named_models
from models.mechanisms.mechanism_data import arguments
from oracles.kinematics.example_checks import EXACT, STRAIGHT, TURN, coordinates, distance, span

Float: TypeAlias = npt.NDArray[np.float64]

DRAWN = 2e-4  # m: two coordinates rounded to 1e-4 m, times a leg's leverage
NEAR_TOGGLE = 1e-9  # relative, 0.5° from the toggle: 1/d1, and d1 is of the third order there


def corner(a: Float, from_a: float, b: Float, from_b: float, side: int) -> Float:
    """Where two circles meet, left (+1) or right (−1) of a → b, by the angle at a."""
    s = np.hypot(*(b - a).T)
    angle = np.arctan2(*(b - a).T[::-1]) + side * np.arccos(
        (s * s + from_a**2 - from_b**2) / (2 * s * from_a)
    )
    place: Float = a + from_a * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    return place


def carried(a: Float, b: Float, drawn: tuple[tuple[float, float], ...]) -> Float:
    """A further joint of a link whose drawing had a, b and it at `drawn`."""
    z = [complex(*place) for place in drawn]
    ratio = (z[2] - z[0]) / (z[1] - z[0])
    at = (a[:, 0] + 1j * a[:, 1]) + ratio * ((b - a)[:, 0] + 1j * (b - a)[:, 1])
    return np.stack([at.real, at.imag], axis=-1)


@pytest.mark.parametrize("name", ["watt_six_bar", "stephenson_six_bar"])
def test_six_bars(name: str) -> None:
    """Both dyads by the law of cosines; the ternary links of Watt's chain share a joint."""
    mechanism = named_drawings.CLASS_II[name]()
    drawn, links = mechanism.joints, mechanism.links
    motion = mechanism.solve(TURN, order=0)
    pin = 0.04 * np.stack([np.cos(TURN), np.sin(TURN)], axis=-1)
    fixed = np.broadcast_to([0.1, 0.0], pin.shape)
    c = corner(pin, 0.12, fixed, 0.08, +1)
    p = carried(pin, c, (drawn["B"], drawn["C"], drawn["P"]))
    if name == "watt_six_bar":
        other, far = carried(fixed, c, (drawn["D"], drawn["C"], drawn["Q"])), "Q"
    else:
        other, far = np.broadcast_to(drawn["E"], pin.shape), "E"
    lengths = math.dist(drawn["P"], drawn["S"]), math.dist(drawn[far], drawn["S"])
    s = corner(p, lengths[0], other, lengths[1], +1)
    for joint, want in (("C", c), ("P", p), (far, other), ("S", s)):
        assert np.max(np.abs(motion.joint(joint).value - want)) <= EXACT, joint
    first, second = (set(on) for on in links.values() if len(on) == 3)
    assert bool(first & second) == (name == "watt_six_bar")


def test_jansen_leg() -> None:
    """The known foot; lengths are the holy numbers."""
    mechanism = examples.jansen_leg()
    foot = mechanism.solve(0.0).joint("F").value
    assert foot == pytest.approx([-0.43170055, -0.91753226], abs=5e-9)  # given to 1e-8 m
    holy = {
        "OM": 15.0,
        "MT": 50.0,
        "BT": 41.5,
        "TW": 55.8,
        "BW": 40.1,
        "ML": 61.9,
        "BL": 39.3,
        "WK": 39.4,
        "LK": 36.7,
        "KF": 65.7,
        "LF": 49.0,
    }
    for ends, length in holy.items():
        drawn = math.dist(mechanism.joints[ends[0]], mechanism.joints[ends[1]])
        assert drawn == pytest.approx(length / 100, abs=DRAWN)
    # the same leg as the tests' own, in centimetres there
    model = assur.Mechanism(**arguments(named_models.jansen()))
    gap = model.solve(TURN, order=0).joint("7").value / 100
    gap -= mechanism.solve(TURN, order=0).joint("F").value
    assert np.max(np.abs(gap)) <= STRAIGHT


def test_jansen_foot() -> None:
    """A closed path, flat to a centimetre for two fifths of the turn, passed in one direction."""
    foot = examples.jansen_leg().solve(TURN, order=1).joint("F")
    assert foot.value[0] == pytest.approx(foot.value[-1], abs=STRAIGHT)
    flat = foot.value[:, 1] < foot.value[:, 1].min() + 0.01
    assert np.mean(flat) > 0.4
    along = foot.d1[flat, 0]
    assert np.all(along > 0.0) or np.all(along < 0.0)
    assert np.ptp(foot.value[flat, 0]) > 0.8 * np.ptp(foot.value[:, 0])


def test_klann_leg() -> None:
    """The patent's two positions; a closed path with half a turn flat."""
    stride = 0.5
    foot = examples.klann_leg().solve(TURN).joint("F").value / stride
    assert foot[0] == pytest.approx(foot[-1], abs=EXACT)
    at = examples.klann_leg().solve([math.pi, 0.0]).joint("F").value / stride
    assert at[0] == pytest.approx([0.0, 0.0], abs=EXACT)
    assert at[1] == pytest.approx([1.0, 0.0], abs=1e-3)  # the patent's three decimals
    half = len(TURN) // 2
    flat, lift = foot[: half + 1], foot[half:]
    assert np.ptp(flat[:, 1]) == pytest.approx(0.055, abs=5e-4)  # Klann: deviation 5.5 %
    assert lift[:, 1].max() - flat[:, 1].min() == pytest.approx(0.53, abs=5e-3)
    ends = np.argmax(flat[:, 0]), np.argmin(flat[:, 0])
    assert np.all(np.diff(flat[slice(*ends), 0]) < 0)  # one way on the ground
    assert ends[1] - ends[0] > 0.9 * half


def test_peaucellier() -> None:
    mechanism = examples.peaucellier()
    motion = mechanism.solve(coordinates("peaucellier"))
    pen = motion.joint("P")
    assert np.max(np.abs(pen.value[:, 0] - 0.28)) <= STRAIGHT * 0.28
    assert np.max(np.abs(pen.d1[:, 0])) <= STRAIGHT * np.max(np.abs(pen.d1))
    assert np.ptp(pen.value[:, 1]) > 0.5  # a line, not a point
    inverse = np.hypot(*motion.joint("B").value.T) * np.hypot(*pen.value.T)
    assert np.max(np.abs(inverse - (0.25**2 - 0.17**2))) <= STRAIGHT
    assert pen.value[:, 1] == pytest.approx(0.28 * np.tan(motion.q / 2), abs=STRAIGHT)
    ends_at(mechanism, 2 * math.acos((0.25 - 0.17) / 0.12))


def test_hart() -> None:
    mechanism = examples.hart()
    motion = mechanism.solve(coordinates("hart"))
    pen = motion.joint("Q")
    assert np.max(np.abs(pen.value[:, 0] - 0.055)) <= STRAIGHT * 0.2
    assert np.max(np.abs(pen.d1[:, 0])) <= STRAIGHT * np.max(np.abs(pen.d1))
    assert np.ptp(pen.value[:, 1]) > 0.2
    inverse = np.hypot(*motion.joint("P").value.T) * np.hypot(*pen.value.T)
    assert np.max(np.abs(inverse - (0.2**2 - 0.13**2) / 4)) <= STRAIGHT
    assert pen.value[:, 1] == pytest.approx(0.055 * np.tan(motion.q / 2), abs=STRAIGHT)
    ends_at(mechanism, 2 * math.acos((0.2 - 0.13) / 2 / 0.105))


def ends_at(mechanism: assur.Mechanism, limit: float) -> None:
    """The gaps begin beyond ±limit."""
    near = 1e-9  # rad: far above rounding, far below the spacing of any use
    for side in (-1, 1):
        q = [side * (limit - near), side * (limit + near)]
        inside, outside = mechanism.solve(q, on_error="nan").status
        assert inside in {Status.OK, Status.NEAR_SINGULAR}
        assert outside == Status.UNREACHABLE


def turned(place: tuple[float, float], by: float) -> tuple[float, float]:
    (x, y), c, s = place, math.cos(by), math.sin(by)
    return (c * x - s * y, s * x + c * y)


def test_excavator() -> None:
    """Cylinders as long as q; every joint by triangles alone, one link after another."""
    mechanism = examples.excavator()
    q = coordinates("excavator", 9)
    motion = mechanism.solve(q, order=1)
    ends = {"boom": "boom_eye", "stick": "stick_eye", "bucket": "knuckle"}
    for driver, (part, end) in enumerate(ends.items()):
        length = distance(motion, f"{part}_base", end)
        assert np.max(np.abs(length - q[:, driver])) <= EXACT * 10
        value = motion.slide(f"{part}_cylinder").value
        assert np.max(np.abs(value - q[:, driver])) <= EXACT * 10
    drawn = mechanism.joints

    def direction(a: str, b: str) -> float:
        return math.atan2(drawn[b][1] - drawn[a][1], drawn[b][0] - drawn[a][0])

    def angle(at: str, base: str, end: str, length: float) -> float:
        """Angle at a pivot between the lines to a cylinder's ends."""
        a, b = math.dist(drawn[at], drawn[base]), math.dist(drawn[at], drawn[end])
        return math.acos((a * a + b * b - length * length) / (2 * a * b))

    def change(at: str, base: str, end: str, length: float) -> float:
        drawn_length = math.dist(drawn[base], drawn[end])
        return angle(at, base, end, length) - angle(at, base, end, drawn_length)

    for row, (boom, stick, bucket) in enumerate(q):
        # a longer cylinder raises the boom, draws the stick in and curls the bucket
        boom_turn = change("foot", "boom_base", "boom_eye", boom)
        stick_turn = boom_turn - change("elbow", "stick_base", "stick_eye", stick)
        rocker_turn = -change("rocker_pin", "bucket_base", "knuckle", bucket)
        # the bucket's four-bar in the drawing's stick: triangles wrist-knuckle
        pin, rocker = drawn["rocker_pin"], math.dist(drawn["rocker_pin"], drawn["knuckle"])
        at = direction("rocker_pin", "knuckle") + rocker_turn
        knuckle = (pin[0] + rocker * math.cos(at), pin[1] + rocker * math.sin(at))
        wrist = drawn["wrist"]
        s = math.dist(wrist, knuckle)
        lever = math.dist(wrist, drawn["bucket_eye"])
        link = math.dist(drawn["knuckle"], drawn["bucket_eye"])
        toward = math.atan2(knuckle[1] - wrist[1], knuckle[0] - wrist[0])
        apart = math.acos((s * s + lever**2 - link**2) / (2 * s * lever))
        bucket_turn = toward - apart - direction("wrist", "bucket_eye")
        # forward: foot, elbow, wrist, tip
        place = (0.0, 0.0)
        for a, b, turn in (
            ("foot", "elbow", boom_turn),
            ("elbow", "wrist", stick_turn),
            ("wrist", "tip", stick_turn + bucket_turn),
        ):
            dx, dy = turned((drawn[b][0] - drawn[a][0], drawn[b][1] - drawn[a][1]), turn)
            place = (place[0] + dx, place[1] + dy)
            gap = math.dist(place, motion.joint(b).value[row])
            assert gap <= STRAIGHT * span(mechanism), (b, row)


def test_toggle_press() -> None:
    """Ram from two circles; force without bound at the toggle, as statics have it."""
    side = 0.2
    mechanism = examples.toggle_press()
    q = np.delete(TURN, len(TURN) // 2)  # the toggle itself is below
    motion = mechanism.solve(q, order=3)
    crank = np.stack([0.3 + 0.05 * np.cos(q), -0.2 + 0.05 * np.sin(q)], axis=-1)
    knee = corner(crank, 0.25, np.zeros_like(crank), side, +1)
    assert np.max(np.abs(motion.joint("B").value - knee)) <= EXACT
    guide = motion.slide("guide")
    assert np.max(np.abs(guide.value + 2 * knee[:, 1])) <= EXACT
    # statics: rod force 1, the toggle links' forces from the balance of the knee
    rod = (knee - crank) / 0.25
    arm = crank - [0.3, -0.2]
    torque = arm[:, 0] * rod[:, 1] - arm[:, 1] * rod[:, 0]
    upper, lower = (
        knee / side,
        knee * [1.0, -1.0] / side,
    )  # their pushes on it
    det = upper[:, 0] * lower[:, 1] - upper[:, 1] * lower[:, 0]
    lower_force = -(upper[:, 0] * rod[:, 1] - upper[:, 1] * rod[:, 0]) / det
    pressed = lower_force * lower[:, 1]
    assert motion.mechanical_advantage("guide") == pytest.approx(pressed / torque, rel=NEAR_TOGGLE)
    # the toggle: lowest place, and three analogues that vanish
    toggle = mechanism.solve(math.pi, order=3)
    dead = toggle.slide("guide")
    assert dead.value == pytest.approx(2 * side, abs=EXACT)
    assert max(abs(float(d)) for d in (dead.d1, dead.d2, dead.d3)) <= EXACT
    beside = mechanism.solve(math.pi - 0.05, order=1).mechanical_advantage("guide")
    assert float(beside) > 1e4  # N/(N·m); the crank alone would give 1/0.05 = 20
