"""Special cases that break other programs, each against a closed form or the oracle."""

from __future__ import annotations

import math

import numpy as np
import pytest

import assur
from assur import Slide, Status
from models.mechanisms import named_models
from models.mechanisms.mechanism_data import GROUND, Description, DriverSpec, SlideSpec, arguments
from oracles.kinematics import agreement, oracle, oracle_guess

U = agreement.U
TURN = np.linspace(0.0, math.tau, 97)  # with the quarters, to the last bit
CRANK: DriverSpec = ("angle", "crank", GROUND)


def made(d: Description) -> assur.Mechanism:
    return assur.Mechanism(**arguments(d))


def against_oracle(d: Description, moves: list[tuple[float, ...]]) -> None:
    """The law, all orders, at the drawing and at moves from it that the oracle can follow."""
    start, mechanism = oracle_guess.drawing_q(d), made(d)
    tracer = agreement.Tracer(d)
    for move in [(0.0,) * len(start), *moves]:
        q = tuple(a + b for a, b in zip(start, move, strict=True))
        path = tracer.follow(move)
        assert path.fold is None, f"stuck at {path.fold} of {move}"
        solution = oracle.solve(d, q, path.pose(1.0))
        motion = mechanism.solve(q if len(q) > 1 else q[0], order=3)
        gap = agreement.compare(d, motion, (), solution, 3)
        assert max(gap.position, *gap.analogues) <= 1, gap


def whole_turn(d: Description, pieces: int = 12) -> None:
    against_oracle(d, [(math.tau * k / pieces,) for k in range(1, pieces + 1)])


# -- slider-cranks --------------------------------------------------------------------------------


def test_central_slider_crank() -> None:
    """Drawn at its dead point, joints in one line with the guide."""
    r, rod = 0.05, 0.2
    d = named_models.engine(r, rod)
    motion = made(d).solve(TURN, order=1)
    s = r * np.sin(TURN)
    assert np.all(motion.status == Status.OK)
    assert motion.slide("bore").value == pytest.approx(
        r * np.cos(TURN) + np.sqrt((rod - s) * (rod + s)), abs=4 * U * (r + rod)
    )
    assert motion.link("rod").value == pytest.approx(-np.arcsin(s / rod), abs=8 * U)
    whole_turn(d)


@pytest.mark.parametrize("off", [0.05, -0.05, 0.0, 1e-7])
def test_guide_almost_vertical(off: float) -> None:
    """A slope would be 1146, or none."""
    r, rod, offset = 1.0, 2.5, 0.25
    angle = math.radians(90 - off)
    c, s = math.cos(angle), math.sin(angle)
    # drawn with the crank along the guide, the piston's path `offset` to the left of it
    along = r + math.sqrt(rod**2 - offset**2)
    joints = {
        "O": (0.0, 0.0),
        "A": (r * c, r * s),
        "B": (along * c - offset * s, along * s + offset * c),
    }
    links = {GROUND: ["O"], "crank": ["O", "A"], "rod": ["A", "B"], "piston": ["B"]}
    d = Description(joints, links, {"bore": SlideSpec("piston", GROUND, angle, "O")}, [CRANK])
    m = made(d)
    motion = m.solve(m.q0 + TURN, order=1)
    want = r * np.cos(TURN) + np.sqrt(rod**2 - (offset - r * np.sin(TURN)) ** 2)
    assert motion.slide("bore").value == pytest.approx(want, abs=8 * U * 1.2 * 3.5)
    whole_turn(d)


def test_two_joints_with_the_same_y() -> None:
    """A, D and B, C level: a square parallelogram's cousin without a change point."""
    joints = {"A": (0.0, 0.0), "B": (0.0, 1.0), "C": (3.5, 1.0), "D": (3.0, 0.0)}
    links = {GROUND: ["A", "D"], "crank": ["A", "B"], "coupler": ["B", "C"], "rocker": ["D", "C"]}
    d = Description(joints, links, {}, [CRANK])
    assert made(d).solve(math.pi / 2).joint("C").value == pytest.approx([3.5, 1.0], abs=4 * U * 3.5)
    against_oracle(d, [(move,) for move in (-0.7, -0.5, 0.5, 1.0, 3.0)])
    d = named_models.jansen()
    d.joints["5"] = (d.joints["5"][0], d.joints["6"][1])
    whole_turn(d)


# -- guides and cylinders on moving links ---------------------------------------------------------


def test_whitworth() -> None:
    """Block on a swinging arm; the arm turns fully if the crank passes its pivot, else swings."""
    d = named_models.whitworth()
    m = made(d)
    motion = m.solve(m.q0 + TURN, order=1)
    r = math.hypot(1.0, 0.5)
    t = math.atan2(0.5, 1.0) + TURN
    arm = np.stack([r * np.cos(t), r * np.sin(t) + 2.0], axis=-1)
    assert motion.slide("slot").value == pytest.approx(np.hypot(*arm.T), abs=16 * U * 4)
    drawn = math.atan2(5.0, 2.0) - math.atan2(2.5, 1.0)  # from slot to D-E
    direction = np.unwrap(np.arctan2(arm[:, 1], arm[:, 0])) + drawn
    kappa = motion.condition
    assert np.all(np.abs(motion.link("arm").value - direction) <= 8 * U * kappa * 4)
    assert motion.link("block").value == pytest.approx(direction - drawn, abs=1e-14)
    whole_turn(d)


def test_cylinder_between_moving_links() -> None:
    """A boom on a cylinder, an arm at its tip, a second cylinder from boom to arm."""
    e = named_models.excavator()
    joints = {**e.joints, "R": (1.5, 1.6), "S": (4.2, 2.3), "bucket": (5.5, -0.5)}
    links = {**e.links, "boom": ["D", "T", "tip", "R"], "arm": ["tip", "S", "bucket"]}
    links = {**links, "barrel2": ["R"], "rod2": ["S"]}
    angle = math.atan2(0.7, 2.7)
    slides = {**e.slides, "second": SlideSpec("rod2", "barrel2", angle, "R")}
    drivers: list[DriverSpec] = [("slide", "cylinder"), ("slide", "second")]
    d = Description(joints, links, slides, drivers)
    against_oracle(d, [(0.2, 0.3), (-0.4, 0.1), (0.3, -0.3), (0.0, 0.2)])
    held = {n: joints[n] for n in ("R", "tip", "S", "bucket")}  # boom at rest: law of cosines
    still = {GROUND: ["R", "tip"], **{n: links[n] for n in ("arm", "barrel2", "rod2")}}
    one = Description(held, still, {"second": slides["second"]}, drivers[1:])
    lengths = np.linspace(2.4, 3.1, 8)
    motion = made(one).solve(lengths, order=0)
    for q, s, tip in zip(lengths, motion.joint("S").value, motion.joint("tip").value, strict=True):
        assert math.dist(s, joints["R"]) == pytest.approx(q, rel=1e-14)
        assert math.dist(s, tip) == pytest.approx(math.dist(joints["S"], joints["tip"]), rel=1e-14)


def test_oldham() -> None:
    """Shafts turn alike; the disc's middle runs twice as fast round the circle on O1 O2."""
    d = named_models.oldham()
    o1, o2 = np.array(d.joints["O1"]), np.array(d.joints["O2"])
    t = 0.4
    ray = np.array([math.cos(t), math.sin(t)])
    middle = o1 + ((o2 - o1) @ ray) * ray
    joints = {**d.joints, "M": (float(middle[0]), float(middle[1]))}
    for disc in ([], ["M"]):
        full = Description(
            joints if disc else d.joints, {**d.links, "disc": disc}, d.slides, d.drivers
        )
        m = made(full)
        q = m.q0 + 3 * TURN
        motion = m.solve(q, order=3)
        assert np.all(motion.status == Status.OK)
        two, theta = motion.link("shaft2"), t + 3 * TURN
        assert two.value - two.value[0] == pytest.approx(q - q[0], abs=16 * U * 20)
        assert np.all(np.abs(two.d1 - 1) <= 4 * U)
        assert max(np.max(np.abs(two.d2)), np.max(np.abs(two.d3))) <= 64 * U
        rays = np.stack([np.cos(theta), np.sin(theta)], axis=-1)
        along = rays @ (o2 - o1)
        assert motion.slide("tongue1").value == pytest.approx(along, abs=64 * U)
        if disc:
            centre, w = (o1 + o2) / 2, o2 - o1
            turn = 2 * theta
            circle = 0.5 * np.stack(
                [
                    np.cos(turn) * w[0] + np.sin(turn) * w[1],
                    np.sin(turn) * w[0] - np.cos(turn) * w[1],
                ],
                axis=-1,
            )
            at = motion.joint("M")
            assert at.value == pytest.approx(centre + circle, abs=32 * U)
            speed = np.hypot(*at.d1.T)
            assert speed == pytest.approx(np.full_like(speed, np.hypot(*w)), rel=32 * U)
        whole_turn(full, 8)


# -- drivers anywhere -----------------------------------------------------------------------------


def test_coupler_driven() -> None:
    """Backwards through the crank-driven linkage."""
    d, plain = named_models.coupler_driven(), made(named_models.crank_rocker())
    m = made(d)
    forward = plain.solve(np.linspace(plain.q0 - 0.4, plain.q0 + 0.4, 17), order=1)
    back = m.solve(forward.link("coupler").value, order=1, on_error="nan")
    # on one side of a dead point only, where the coupler stands still
    same = np.sign(forward.link("coupler").d1) == np.sign(plain.solve(plain.q0).link("coupler").d1)
    same &= back.status == Status.OK
    assert same.sum() >= 8
    kappa = back.condition[same]
    error = np.abs(back.link("crank").value - forward.q)[same]
    assert np.all(error <= 16 * U * 4.8 * kappa)
    against_oracle(d, [(0.02,), (-0.02,), (-0.1,)])


def test_scotch_yoke() -> None:
    """x = r cos q to rounding, wherever the crank stands."""
    m = assur.Mechanism(
        joints={"O": (0, 0), "A": (0.75, 0), "Y": (0.75, 0.0)},
        links={GROUND: ["O"], "crank": ["O", "A"], "block": ["A"], "yoke": ["Y"]},
        slides={
            "slot": Slide("block", on="yoke", angle=math.pi / 2, origin="Y"),
            "bed": Slide("yoke", on=GROUND, angle=0.0, origin="O"),
        },
        driver="crank",
    )
    q = np.concatenate([TURN, -3 * TURN])
    motion = m.solve(q, order=3)
    c, s = 0.75 * np.cos(q), 0.75 * np.sin(q)
    bed = motion.slide("bed")
    for got, want in ((bed.value, c), (bed.d1, -s), (bed.d2, -c), (bed.d3, s)):
        assert np.max(np.abs(got - want)) <= 2 * U
    assert np.max(np.abs(motion.slide("slot").value - s)) <= 2 * U
    whole_turn(named_models.scotch_yoke())


@pytest.mark.parametrize("driver", ["rod", "x"])
def test_trammel(driver: str) -> None:
    """Every point of the rod but A and B traces an ellipse."""
    m = made(named_models.trammel(driver))
    q = m.q0 + TURN if driver == "rod" else np.linspace(-1.299, 1.299, 53)
    motion = m.solve(q, order=0)
    x, y = motion.joint("P").value.T
    error = np.abs((x / 2.6) ** 2 + (y / 1.3) ** 2 - 1)
    assert np.all(error <= 2 * 8 * U * motion.condition * 2)
    if driver == "rod":
        whole_turn(named_models.trammel())
    else:
        against_oracle(named_models.trammel("x"), [(0.09,), (-1.0,), (-2.4,)])
