"""Change points: both solutions of a dyad meet, and the smooth motion goes on.

Closed forms of values, first and second analogues over four turns, forward, backward and far from
the drawing, at steps of 0.1° to 45°. All grids are multiples of 0.1° from a change point, which
they hit to rounding; what is asked at a coarser step has the same bits as at 0.1°.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt
import pytest

import assur
from assur import Status

if TYPE_CHECKING:
    from collections.abc import Callable

Float = npt.NDArray[np.float64]
U = 2.220446049250313e-16
STEPS = (10, 75, 300, 450)  # tenths of a degree: 1°, 7.5°, 30°, 45°
TURN = 3600
# Four turns from the drawing in either direction, and four far away; tenths of a degree.
DIRECTIONS = {"forward": (0, 1), "backward": (0, -1), "far": (1000 * TURN, 1)}

# The law: a position is good to 8 u κ of the size, a first analogue to 64 u κ² of its own.
POSITION, ANALOGUE = 8 * U, 64 * U
# A discriminant N whose square is rounded is off by 8 u/N of the size, and its second derivative
# by 2 N'²/N³ times as much, whatever the program: 16 u κ³, more than the law beyond κ = 4.
SECOND = 16 * U
# At a change point the motion is a polynomial's through 16 positions, the nearest 0.1 cos(15π/32)
# from it: κ there is 1.5/0.0098.
NEAREST = 150.0
# κ is 1/sin of the angle between the legs, more where one leg is short: no excuse beyond that.
SHARPEST = 4.0


@dataclass(frozen=True)
class Form:
    """Closed form of an output: value, d1, d2 at q; `arm`: what its error displaces."""

    kind: str
    name: str
    jet: Callable[[Float], tuple[Float, Float, Float]]
    arm: float = 1.0  # m for links; 1 for joints and slides


@dataclass(frozen=True)
class Case:
    """A mechanism with change points at first + k every."""

    mechanism: assur.Mechanism
    size: float
    forms: list[Form]
    first: float = 0.0
    every: float = math.pi

    def sharpness(self, q: Float) -> Float:
        """1/sin of the distance to the nearest change point; at most 1e12."""
        sine = np.abs(np.sin((q - self.first) * (math.pi / self.every)))
        return np.asarray(1.0 / np.maximum(sine, 1e-12))

    def check(self, motion: assur.Motion, links: float = 1.0) -> None:
        """Values and two analogues against the closed forms; `links`: dyads one upon another."""
        q, at = motion.q, motion.status == Status.SINGULAR
        kappa = motion.condition if links == 1.0 else SHARPEST * self.sharpness(q)
        assert (kappa[~at] <= SHARPEST * self.sharpness(q)[~at]).all()
        kappa = np.where(at, NEAREST, kappa)
        analogues = ANALOGUE * kappa**2
        for form in self.forms:
            got, want = getattr(motion, form.kind)(form.name), form.jet(q)
            # q of many turns is rounded in angles, and in their closed forms
            turns = U * np.abs(q)
            own = [max(1.0, float(np.abs(w).max()) * form.arm) / form.arm for w in want]
            laws = (
                POSITION * kappa * self.size / form.arm + turns,
                (analogues + turns) * own[1],
                (np.maximum(analogues, SECOND * kappa**3 * self.size / form.arm) + turns) * own[2],
            )
            for order, law in enumerate(laws):
                have = (got.value, got.d1, got.d2)[order]
                error = np.abs(have - want[order]).reshape(len(q), -1).max(axis=1)
                bad = ~(error <= links * law)  # NaN is bad
                worst = int(np.argmax(np.where(bad, error / law, 0.0)))
                assert not bad.any(), (
                    f"{form.name}, order {order}, q = {q[worst]}: {error[worst]:.3g}, "
                    f"law {links * law[worst]:.3g}"
                )


def angle(name: str, jet: Callable[[Float], tuple[Float, Float, Float]], arm: float) -> Form:
    return Form("link", name, jet, arm)


def circle(jet: Callable[[Float], tuple[Float, Float, Float]], r: float, x: float) -> Form:
    """Joint C at the radius r round (x, 0), under an angle."""

    def of(q: Float) -> tuple[Float, Float, Float]:
        a, a1, a2 = (v[:, None] for v in jet(q))
        ray = np.hstack([np.cos(a), np.sin(a)])
        across = np.hstack([-np.sin(a), np.cos(a)])
        return r * ray + (x, 0.0), r * across * a1, r * (across * a2 - ray * a1**2)

    return Form("joint", "C", of)


def parallelogram(crank: float = 1.0, ground: float = 3.0) -> Case:
    def rocker(q: Float) -> tuple[Float, Float, Float]:
        return q, np.ones_like(q), np.zeros_like(q)

    def coupler(q: Float) -> tuple[Float, Float, Float]:
        return np.zeros_like(q), np.zeros_like(q), np.zeros_like(q)

    forms = [angle("rocker", rocker, crank), angle("coupler", coupler, ground)]
    m = assur.FourBar(crank, ground, crank, ground)
    return Case(m, crank + ground, [*forms, circle(rocker, crank, ground)])


def antiparallelogram() -> Case:
    """The diagonals of its trapezium are parallel: tan(θ/2) tan(q/2) is constant."""
    crank, ground = 1.0, 3.0
    ratio = (ground + crank) / (ground - crank)

    def rocker(q: Float) -> tuple[Float, Float, Float]:
        c, s = np.cos(q / 2), np.sin(q / 2)
        # q/2 and what its image is ahead by, less than a right angle: no jumps
        turned = q + 2.0 * np.arctan2((ratio - 1) * s * c, c**2 + ratio * s**2)
        below = c**2 + ratio**2 * s**2
        return -turned, -ratio / below, ratio * (ratio**2 - 1) * s * c / below**2

    m = assur.FourBar(crank, ground, crank, ground, mode="crossed")
    return Case(m, crank + ground, [angle("rocker", rocker, crank), circle(rocker, crank, ground)])


def kite() -> Case:
    """Crank = ground, coupler = rocker: C is on the bisector of AB and AD."""
    short, long = 1.0, 2.0

    def half(q: Float, side: float) -> tuple[Float, Float, Float]:
        x, x1 = np.sin(q / 2) * short / long, np.cos(q / 2) * short / (2 * long)
        r = np.sqrt(1 - x**2)
        bend = -x / (4 * r) + x * x1**2 / r**3
        return q / 2 + side * np.arcsin(x), 0.5 + side * x1 / r, side * bend

    def rocker(q: Float) -> tuple[Float, Float, Float]:
        return half(q, 1.0)

    def coupler(q: Float) -> tuple[Float, Float, Float]:
        return half(q, -1.0)

    forms = [angle("rocker", rocker, long), angle("coupler", coupler, long)]
    m = assur.FourBar(short, long, long, short)
    return Case(m, short + long, [*forms, circle(rocker, long, short)], every=math.tau)


def isosceles() -> Case:
    """Slider-crank, rod = crank: x = 2 r cos q."""
    r = 1.5

    def bore(q: Float) -> tuple[Float, Float, Float]:
        return 2 * r * np.cos(q), -2 * r * np.sin(q), -2 * r * np.cos(q)

    def rod(q: Float) -> tuple[Float, Float, Float]:
        return -q, -np.ones_like(q), np.zeros_like(q)

    forms = [Form("slide", "bore", bore), angle("rod", rod, r)]
    return Case(assur.SliderCrank(r, r), 2 * r, forms, first=math.pi / 2)


CASES = [parallelogram, antiparallelogram, kite, isosceles]
directions = pytest.mark.parametrize("direction", DIRECTIONS)
cases = pytest.mark.parametrize("make", CASES, ids=lambda make: make.__name__)


def grid(direction: str, first: float = 0.0) -> Float:
    """Four turns by 0.1° from `first` (drawn: a change point)."""
    start, sign = DIRECTIONS[direction]
    return np.asarray(first + np.deg2rad((start + sign * np.arange(4 * TURN + 1)) / 10))


def same_bits(m: assur.Mechanism, fine: assur.Motion) -> None:
    """Asked at coarser steps: value, analogues and statuses as at 0.1°."""
    for step in STEPS:
        coarse = m.solve(fine.q[::step], threads=1)
        assert np.array_equal(coarse.status, fine.status[::step])
        for kind, names in (("joint", m.joints), ("link", m.links), ("slide", m.slides)):
            for name in names:
                a, b = (getattr(motion, kind)(name) for motion in (coarse, fine))
                for index in ("value", "d1", "d2"):
                    want = getattr(b, index)[::step]
                    assert np.array_equal(getattr(a, index), want), (name, index, step)


@directions
@cases
def test_closed_forms(make: Callable[[], Case], direction: str) -> None:
    case = make()
    q = grid(direction)
    motion = case.mechanism.solve(q, threads=1)
    at = case.sharpness(q) > 1e10
    assert 4 <= at.sum() <= 9
    assert (motion.status == np.where(at, Status.SINGULAR, Status.OK)).all()
    case.check(motion)
    same_bits(case.mechanism, motion)


@cases
def test_the_same_alone(make: Callable[[], Case]) -> None:
    """At change points: bits do not depend on what else is requested, nor on threads."""
    case = make()
    q = case.first + case.every * np.arange(-8.0, 9.0)
    alone = [case.mechanism.solve(x) for x in q]
    for motion in (case.mechanism.solve(q, threads=1), case.mechanism.solve(q, threads=2)):
        for form in case.forms:
            for index in ("value", "d1", "d2"):
                one = [getattr(getattr(m, form.kind)(form.name), index) for m in alone]
                many = getattr(getattr(motion, form.kind)(form.name), index)
                assert np.array_equal(np.stack(one), many), (form.name, index)


@cases
def test_beside_a_change_point(make: Callable[[], Case]) -> None:
    """From 1e-3 down to 1e-15 on both sides: the nearer, the fewer digits, never wrong."""
    case = make()
    off = 10.0 ** -np.arange(3.0, 15.5, 0.25)
    for k in (-3, 0, 1, 1000):
        q = case.first + k * case.every + np.concatenate([-off, off[::-1]])
        motion = case.mechanism.solve(q)
        apart = 1.0 / case.sharpness(q)
        # κ reaches 2^24 where N is 6e-8; it is 1.5 to 4 times the sharpness
        near, far = apart < 2e-8, apart > 4e-7
        assert (motion.status[near] == Status.SINGULAR).all()
        assert (motion.status[far] <= Status.NEAR_SINGULAR).all()
        assert (motion.status[~near & ~far] >= Status.NEAR_SINGULAR).all()
        assert (motion.status[apart > 1e-3 / 1.01] == Status.OK).all()
        case.check(motion)


def test_turns_to_return() -> None:
    """Antiparallelogram: one, backward. Kite: two turns of the crank."""
    m = antiparallelogram().mechanism
    rocker = m.solve(np.linspace(0.0, 8 * math.pi, 5)).link("rocker").value
    assert np.diff(rocker) == pytest.approx(-math.tau, abs=1e-12)  # bound at a change point
    q = np.linspace(0.1, 6.1, 61)
    c = [kite().mechanism.solve(q + turns * math.tau).joint("C").value for turns in range(3)]
    assert c[2] == pytest.approx(c[0], abs=1e-13)  # q is rounded at two turns: 2e-15 κ
    assert (np.abs(c[1] - c[0]).max(axis=1) > 0.1).all()


@pytest.mark.parametrize("seed", range(20))
def test_parallelogram_drawn_from_coordinates(seed: int) -> None:
    """At random attitudes and places: lengths are equal only to rounding."""
    rng = np.random.default_rng(seed)
    crank, ground = rng.uniform(0.5, 2.0), rng.uniform(2.5, 4.0)
    drawn, attitude = rng.uniform(0.3, 2.8) * rng.choice([-1, 1]), rng.uniform(-3.1, 3.1)
    shift = rng.uniform(-5.0, 5.0, 2)
    turn = np.array([[np.cos(attitude), np.sin(attitude)], [-np.sin(attitude), np.cos(attitude)]])
    b = crank * np.array([np.cos(drawn), np.sin(drawn)])
    places = {"A": (0, 0), "B": b, "D": (ground, 0), "C": b + np.array([ground, 0])}
    third = {"F": (ground / 2, 0), "E": b + np.array([ground / 2, 0])} if seed % 5 == 0 else {}
    m = assur.Mechanism(
        joints={name: tuple(at @ turn + shift) for name, at in (places | third).items()},
        links={
            "ground": ["A", "D", *("F" if third else "")],
            "crank": ["A", "B"],
            "coupler": ["B", "C", *("E" if third else "")],
            "rocker": ["D", "C"],
            **({"third": ["F", "E"]} if third else {}),
        },
        driver="crank",
    )
    assert m.structure.redundant == (("third",) if third else ())
    # the drawn angles are within (−π, π]: whole turns between crank, rocker and coupler
    ahead = round((attitude + drawn - float(m.q0)) / math.tau) * math.tau

    def rocker(q: Float) -> tuple[Float, Float, Float]:
        return q, np.ones_like(q), np.zeros_like(q)

    def coupler(q: Float) -> tuple[Float, Float, Float]:
        return attitude + 0 * q, 0 * q, 0 * q

    bars = ["rocker", "third"] if third else ["rocker"]
    forms = [*(angle(n, rocker, crank) for n in bars), angle("coupler", coupler, ground)]
    # what coordinates are rounded to, they lose of the lengths
    size = crank + ground + float(np.abs(shift).max())
    case = Case(m, size, forms, first=attitude - ahead)
    for direction in DIRECTIONS if seed % 10 == 0 else ("forward",):
        motion = m.solve(grid(direction, case.first), threads=1)
        at = case.sharpness(motion.q) > 1e10
        assert (motion.status == np.where(at, Status.SINGULAR, Status.OK)).all()
        case.check(motion)
        same_bits(m, motion)


@directions
def test_chain_of_ten_parallelograms(direction: str) -> None:
    """All of them change at once, each upon the other; their rods stay parallel to the ground.

    Each adds an error like one's, which goes on undiminished: ten times the bound, with κ of one.
    """
    crank, rod = np.array([np.cos(1.0), np.sin(1.0)]), 2.0 * np.array([np.cos(0.3), np.sin(0.3)])
    joints = {f"O{i}": tuple(i * rod) for i in range(11)}
    joints |= {f"A{i}": tuple(i * rod + crank) for i in range(11)}
    links = {"ground": [f"O{i}" for i in range(11)]}
    links |= {f"crank{i}": [f"O{i}", f"A{i}"] for i in range(11)}
    links |= {f"rod{i}": [f"A{i - 1}", f"A{i}"] for i in range(1, 11)}
    m = assur.Mechanism(joints=joints, links=links, driver="crank0")

    def cranks(q: Float) -> tuple[Float, Float, Float]:
        return q, np.ones_like(q), np.zeros_like(q)

    def rods(q: Float) -> tuple[Float, Float, Float]:
        return 0.3 + 0 * q, 0 * q, 0 * q

    forms = [angle(f"crank{i}", cranks, 1.0) for i in range(1, 11)]
    forms += [angle(f"rod{i}", rods, 2.0) for i in range(1, 11)]
    case = Case(m, 21.0, forms, first=0.3)
    motion = m.solve(grid(direction, 0.3), threads=1)
    at = case.sharpness(motion.q) > 1e10
    assert (motion.status[at] == Status.SINGULAR).all()
    # the product of the conditions overrates the chain, so all but OK are called near
    assert (motion.status[~at] <= Status.NEAR_SINGULAR).all()
    case.check(motion, links=10.0)
    same_bits(m, motion)


@pytest.mark.parametrize("phase", [225, 0, 137])
@directions
def test_whitworth_turns_188_degrees_in_a_step(direction: str, phase: int) -> None:
    """A guide whose pivot is just within the crank circle: 188° while the crank turns 45°."""
    r, narrow, wide = 0.1, math.radians(22.5), math.radians(4.0)
    d = r * (math.cos(narrow) + math.sin(narrow) * math.tan(wide))
    assert r > d > 0.95 * r
    drawn = 2.0
    tip = np.array([r * math.cos(drawn) - d, r * math.sin(drawn)])
    at = math.atan2(tip[1], tip[0])
    m = assur.Mechanism(
        joints={
            "O": (0, 0),
            "A": (r * math.cos(drawn), r * math.sin(drawn)),
            "D": (d, 0),
            "E": (d + 0.3 * math.cos(at), 0.3 * math.sin(at)),
        },
        links={"ground": "OD", "crank": "OA", "block": "A", "lever": "DE"},
        slides={"slot": assur.Slide("block", on="lever", angle=at, origin="D")},
        driver="crank",
    )

    def square(q: Float) -> tuple[Float, Float, Float]:
        half = np.sin(q / 2)
        return (r - d) ** 2 + 4 * r * d * half**2, r * d * np.sin(q), r * d * np.cos(q)

    def lever(q: Float) -> tuple[Float, Float, Float]:
        s2, a1, _ = square(q)
        on = r * ((r - d) + 2 * d * np.sin(q / 2) ** 2)
        # A - D, turned back by q, is ahead of the crank by less than a right angle
        return q + np.arctan2(d * np.sin(q), on / r), on / s2, (a1 - 2 * on / s2 * a1) / s2

    def slot(q: Float) -> tuple[Float, Float, Float]:
        s2, a1, a2 = square(q)
        s = np.sqrt(s2)
        return s, a1 / s, a2 / s - a1**2 / s**3

    q = grid(direction, math.radians(phase / 10))
    motion = m.solve(q, threads=1)
    assert (motion.status == Status.OK).all()
    plain = np.unwrap(np.arctan2(r * np.sin(q), r * np.cos(q) - d))
    whole = (plain - lever(q)[0]) / math.tau
    assert whole == pytest.approx(np.round(whole[0]), abs=1e-11)  # κ u |q| far away
    kappa = motion.condition
    for got, want, arm in (
        (motion.link("lever"), lever(q), 0.3),
        (motion.slide("slot"), slot(q), 1.0),
    ):
        turns = U * np.abs(q) if arm != 1.0 else 0.0
        assert (np.abs(got.value - want[0]) <= POSITION * kappa * 0.3 / arm + turns).all()
        own = [max(0.1, float(np.abs(w).max()) * arm) / arm for w in want[1:]]
        assert (np.abs(got.d1 - want[1]) <= ANALOGUE * kappa**2 * own[0]).all()
        assert (np.abs(got.d2 - want[2]) <= ANALOGUE * kappa**2 * own[1]).all()
    same_bits(m, motion)
    if phase == 225:
        turned = np.abs(np.diff(m.solve(q[::450]).link("lever").value))
        assert turned.max() == pytest.approx(math.radians(188.0), abs=1e-10)  # κ u |q| far off
        assert (turned > math.pi).sum() == 4


def above_diagonal(lengths: tuple[float, float, float, float], q: Float) -> Float:
    """Rocker's angle of the four-bar whose joint C is on the left of the ray from B to D.

    Law of cosines at D in the triangle of B, C and D.
    """
    crank, coupler, rocker, ground = lengths
    x, y = crank * np.cos(q) - ground, crank * np.sin(q)
    diagonal2 = x**2 + y**2
    cosine = (diagonal2 + rocker**2 - coupler**2) / (2.0 * rocker * np.sqrt(diagonal2))
    angle = np.arctan2(y, x) - np.arccos(cosine)
    return np.asarray(np.arctan2(np.sin(angle), np.cos(angle)))


def test_a_near_miss_is_not_a_change_point() -> None:
    """Lengths off by 1e-4: the crank turns, the assembly stays, the rocker comes back."""
    lengths = (1.0, 3.0, 1.0 + 1e-4, 3.0)
    q = np.linspace(0, 2 * np.pi, 3601)
    motion = assur.FourBar(*lengths).solve(q)
    rocker = motion.link("rocker").value
    assert (motion.status == Status.OK).sum() > 3000
    # An arccosine near 0 or π loses what one over its sine is: κ, as in the law itself.
    error = np.abs(rocker - above_diagonal(lengths, q))
    assert (error <= POSITION * motion.condition * sum(lengths)).all()
    assert rocker[-1] == pytest.approx(rocker[0], abs=1e-13)


def test_a_gap_is_not_a_change_point() -> None:
    """Lengths off in the other direction: two dead points close together, the same assembly beyond.

    At the dead points coupler and rocker are in one line: their sum is the distance from B to D.
    """
    lengths = (1.0, 3.0, 1.0, 3.0 + 1e-4)
    crank, coupler, rocker, ground = lengths
    dead = math.acos((crank**2 + ground**2 - (coupler + rocker) ** 2) / (2.0 * crank * ground))
    q = np.linspace(0, 2 * np.pi, 3601)
    motion = assur.FourBar(*lengths).solve(q, on_error="nan")
    gap = (q > dead) & (q < 2.0 * np.pi - dead)
    assert gap.any()
    assert ((motion.status == Status.UNREACHABLE) == gap).all()
    error = np.abs(motion.link("rocker").value[~gap] - above_diagonal(lengths, q[~gap]))
    assert (error <= POSITION * motion.condition[~gap] * sum(lengths)).all()


def kite_with_a_rod(*order: str) -> assur.Mechanism:
    """The crank is as long as the ground, the other two links are equal: at q = 0 B meets D.

    A short rod hangs on the crank, its block on a guide: it reaches about q = π/2 alone.
    """
    joints = {"A": (0, 0), "D": (1, 0), "B": (0, 1), "C": (1.3, 1.1), "E": (0.1, 1.2)}
    links = {"ground": "AD", "crank": "AB", "coupler": "BC", "rocker": "DC", "rod": "BE"}
    joints["C"] = kite_point(joints["B"], joints["D"], 1.4)
    return assur.Mechanism(
        joints=joints,
        links={name: links.get(name, "E") for name in order},
        slides={"guide": assur.Slide("block", on="ground", angle=0.0)},
        driver="crank",
    )


def kite_point(b: tuple[float, float], d: tuple[float, float], leg: float) -> tuple[float, float]:
    """The point at the same distance from both, on the side away from the origin."""
    across = math.dist(b, d)
    height = math.sqrt(leg**2 - across**2 / 4) / across
    return (b[0] + d[0]) / 2 + height * (b[1] - d[1]), (b[1] + d[1]) / 2 - height * (b[0] - d[0])


KITE_FIRST = ("ground", "crank", "coupler", "rocker", "rod", "block")
ROD_FIRST = ("ground", "crank", "rod", "block", "coupler", "rocker")


@pytest.mark.parametrize("order", [KITE_FIRST, ROD_FIRST])
def test_a_change_point_in_a_gap_is_not_passed(order: tuple[str, ...]) -> None:
    """Across a gap the assembly does not change, whichever dyad is solved first."""
    m = kite_with_a_rod(*order)
    assert len(m.limits().intervals) == 1
    turns = m.q0 + 2 * math.pi * np.arange(-2, 3)
    motion = m.solve(turns, on_error="nan")
    assert (np.asarray(motion.status) == Status.OK).all()
    for name in "BCE":
        np.testing.assert_allclose(motion.joint(name).value, [m.joints[name]] * 5, atol=1e-12)


@pytest.mark.parametrize("miss", [1e-3, 1e-5, 2e-6, 1e-6, -1e-6, -2e-6, -1e-4])
def test_a_pin_that_misses_the_pivot_of_its_guide(miss: float) -> None:
    """The crank is nearly as long as the ground: the block keeps to its side of the pivot."""
    crank = 1.0 + miss
    a = crank * math.cos(0.73), crank * math.sin(0.73)
    m = assur.Mechanism(
        joints={"O": (0, 0), "A": a, "D": (1, 0)},
        links={"ground": "OD", "crank": "OA", "lever": "D", "block": "A"},
        slides={"s": assur.Slide("block", on="lever", along=("D", "A"), origin="D")},
        driver="crank",
    )
    assert m.limits().period == 1
    q = np.array([-1e-3, -1e-5, -1e-6, 0.0, 1e-6, 1e-5, 1e-3])
    distance = np.hypot(crank * np.cos(q) - 1.0, crank * np.sin(q))
    np.testing.assert_allclose(m.solve(q).slide("s").value, distance, rtol=0, atol=1e-12)
