"""The library of named mechanisms (examples/library.py): each against what is known of it."""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING, TypeAlias

import library
import numpy as np
import numpy.typing as npt
import pytest

import assur
import named_models
from assur import Status
from description import arguments

if TYPE_CHECKING:
    from collections.abc import Iterator

Float: TypeAlias = npt.NDArray[np.float64]
Group: TypeAlias = tuple[str, ...]

U = 2.220446049250313e-16
TURN = np.linspace(0.0, math.tau, 721)
POSITION = 8 * U  # of size times condition: what docs/conventions.md promises
EXACT = 1e-14  # of the size: some tens of roundings, where the condition is below 10
STRAIGHT = 1e-13  # of the size: the same with a condition near the ends of the range of 20
STEP = 1e-5  # rad or m: differences then err by about as much by truncation as by rounding
DRAWN = 2e-4  # m: two coordinates rounded to 1e-4 m, times a leg's leverage
NEAR_TOGGLE = 1e-9  # relative, 0.5° from the toggle: 1/d1, and d1 is of the third order there
RRR, RRP, RPR, PRP, RPP = "RRR", "RRP", "RPR", "PRP", "RPP"
STRUCTURE: dict[str, tuple[str, Group]] = {
    "crank_rocker": ("I(crank) → II(coupler, rocker)", (RRR,)),
    "chebyshev_lambda": ("I(crank) → II(coupler, rocker)", (RRR,)),
    "engine": ("I(crank) → II(rod, piston)", (RRP,)),
    "whitworth": ("I(crank) → II(block, lever) → II(rod, ram)", (RPR, RRP)),
    "shaper": ("I(crank) → II(block, lever) → II(rod, ram)", (RPR, RRP)),
    "scotch_yoke": ("I(crank) → II(block, yoke)", (RPP,)),
    "tangent_generator": ("I(lever) → II(block, cursor)", (PRP,)),
    "trammel": ("I(bar) → II(x_block, y_block)", (PRP,)),
    "watt_six_bar": ("I(crank) → II(coupler, rocker) → II(link, arm)", (RRR,) * 2),
    "stephenson_six_bar": ("I(crank) → II(coupler, rocker) → II(link, lever)", (RRR,) * 2),
    "jansen_leg": (
        "I(crank) → II(upper_rod, upper) → II(lower_rod, lower_rocker) → II(link, foot)",
        (RRR,) * 3,
    ),
    "klann_leg": ("I(crank) → II(rod, lower_rocker) → II(upper_rocker, leg)", (RRR,) * 2),
    "peaucellier": (
        "I(crank) → II(arm1, side1) → II(arm2, side2) → II(side3, side4)",
        (RRR,) * 3,
    ),
    "hart": ("I(crank) → II(short1, long1) → II(short2, long2)", (RRR,) * 2),
    "excavator": (
        (
            "I(boom_cylinder, stick_cylinder, bucket_cylinder) → "
            "II(boom, boom_barrel, boom_rod) → II(stick, stick_barrel, stick_rod) → "
            "II(rocker, bucket_barrel, bucket_rod) → II(link, bucket)"
        ),
        (RRR,) * 4,
    ),
    "toggle_press": ("I(crank) → II(rod, upper) → II(lower, ram)", (RRR, RRP)),
}


# -- every mechanism ------------------------------------------------------------------------------


def coordinates(name: str, count: int = 241) -> Float:
    """Over the whole range: (N,), or (N, n) for n drivers: along its diagonals."""
    low, high = (np.array(end) for end in library.RANGES[name])
    if low.ndim == 0:
        return np.linspace(float(low), float(high), count)
    ways = []
    for backwards in diagonals(len(low)):
        start, stop = np.where(backwards, high, low), np.where(backwards, low, high)
        ways.append(start + np.linspace(0.0, 1.0, count)[:, np.newaxis] * (stop - start))
    return np.concatenate(ways)


def diagonals(drivers: int) -> Iterator[tuple[bool, ...]]:
    """Which drivers run backwards: every diagonal once."""
    return itertools.product((False,), *[(False, True)] * (drivers - 1))


def distance(motion: assur.Motion, a: str, b: str) -> Float:
    """Between two joints."""
    gap: Float = np.hypot(*np.moveaxis(motion.joint(a).value - motion.joint(b).value, -1, 0))
    return gap


def span(mechanism: assur.Mechanism) -> float:
    """Greatest distance of drawn joints."""
    places = list(mechanism.joints.values())
    return max(math.dist(a, b) for a, b in itertools.combinations(places, 2))


@pytest.fixture(params=list(library.LIBRARY))
def name(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def test_all_are_described() -> None:
    assert list(STRUCTURE) == list(library.LIBRARY) == list(library.RANGES)
    assert {kind for _, kinds in STRUCTURE.values() for kind in kinds} == {RRR, RRP, RPR, PRP, RPP}
    for make in library.LIBRARY.values():
        assert make.__doc__
        assert make() == make()


def test_structure(name: str) -> None:
    mechanism = library.LIBRARY[name]()
    structure = mechanism.structure
    drivers = np.size(mechanism.q0)
    assert structure.mobility == structure.mobility_counted == drivers
    assert structure.mobility_at_drawing == drivers
    assert structure.cls == 2
    assert structure.redundant == ()
    formula, kinds = STRUCTURE[name]
    assert structure.formula == formula
    assert tuple(group.kind for group in structure.groups) == kinds


def test_range(name: str) -> None:
    """Solved everywhere, rigid, and on the drawing at its own coordinate."""
    mechanism = library.LIBRARY[name]()
    motion = mechanism.solve(coordinates(name), order=0)
    assert np.all(motion.status == Status.OK)
    allowed = POSITION * motion.condition * span(mechanism)
    assert np.all(motion.residual <= POSITION * motion.condition)
    for on in mechanism.links.values():
        for a, b in itertools.combinations(on, 2):
            drawn = math.dist(mechanism.joints[a], mechanism.joints[b])
            assert np.all(np.abs(distance(motion, a, b) - drawn) <= allowed), (a, b)
    at = mechanism.solve(mechanism.q0, order=0)
    for joint, place in mechanism.joints.items():
        gap = math.dist(at.joint(joint).value, place)
        assert gap <= POSITION * float(at.condition) * span(mechanism), joint


def test_analogues_against_differences(name: str) -> None:
    """First analogues against central differences of the positions."""
    mechanism = library.LIBRARY[name]()
    q = coordinates(name, 61)
    motion = mechanism.solve(q, order=3)
    drivers = np.size(mechanism.q0)
    shortest = min(
        math.dist(mechanism.joints[on[0]], mechanism.joints[on[1]])
        for on in mechanism.links.values()
        if len(on) > 1
    )
    noise = POSITION * float(np.max(motion.condition)) * span(mechanism) / STEP
    for driver, step in enumerate(STEP * np.eye(drivers)):
        move = step if drivers > 1 else STEP
        after, before = (mechanism.solve(x, order=0) for x in (q + move, q - move))
        parts: list[tuple[str, str, float]] = [("joint", n, noise) for n in mechanism.joints]
        parts += [("slide", n, noise) for n in mechanism.slides]
        parts += [("link", n, noise / shortest) for n in mechanism.links]
        for kind, part, rounding in parts:
            here, plus, minus = (getattr(m, kind)(part) for m in (motion, after, before))
            # |third derivative| h²/6, doubled because it is greater nearby
            truncation = 2 * float(np.max(np.abs(here.d3))) * STEP**2 / 6
            along = here.d1[..., driver] if drivers > 1 else here.d1
            difference = (plus.value - minus.value) / (2 * STEP)
            assert np.max(np.abs(along - difference)) <= truncation + rounding, part


# -- four-bars and slider-cranks ------------------------------------------------------------------


def test_crank_rocker() -> None:
    """Freudenstein's equation (1954): K1 cos ψ − K2 cos φ + K3 = cos(φ − ψ)."""
    a, b, c, d = 0.04, 0.12, 0.08, 0.1
    motion = library.crank_rocker().solve(TURN, order=1)
    psi = motion.link("rocker").value
    k1, k2, k3 = d / a, d / c, (a * a - b * b + c * c + d * d) / (2 * a * c)
    misfit = k1 * np.cos(psi) - k2 * np.cos(TURN) + k3 - np.cos(TURN - psi)
    assert np.max(np.abs(misfit)) <= EXACT * (k1 + k2 + abs(k3))
    # it swings between the positions with crank and coupler in one line
    ends = [math.pi - math.acos((c * c + d * d - (b + e) ** 2) / (2 * c * d)) for e in (a, -a)]
    assert [psi.min(), psi.max()] == pytest.approx(sorted(ends), abs=1e-4)  # between samples
    forty = library.crank_rocker().solve(math.radians(40), order=0)
    angles = [math.degrees(forty.link(n).value) for n in ("coupler", "rocker")]
    assert angles == pytest.approx([20.298, 57.325], abs=5e-4)  # shared/reference.md, 3 decimals


def test_chebyshev_lambda() -> None:
    """P from the right angle BDP; a straight half, and x as even as Chebyshev has it."""
    unit = 0.05
    motion = library.chebyshev_lambda().solve(TURN, order=1)
    b = np.stack([unit * np.cos(TURN), unit * np.sin(TURN)], axis=-1) - [2 * unit, 0.0]
    s = np.hypot(*b.T)
    up = np.sqrt((5 * unit - s) * (5 * unit + s)) / s
    want = np.stack([2 * unit + up * b[:, 1], -up * b[:, 0]], axis=-1)
    point = motion.joint("P").value
    assert np.max(np.abs(point - want)) <= EXACT * 5 * unit
    half = point[np.abs(motion.q - math.pi) <= 0.5 * math.pi] / unit
    assert np.ptp(half[:, 0]) == pytest.approx(4.0, abs=STRAIGHT)
    assert half[:, 1].min() == pytest.approx(4.0, abs=STRAIGHT)
    assert half[:, 1].max() <= 4.01


def test_engine() -> None:
    r, rod = 0.045, 0.15
    motion = library.engine().solve(TURN)
    s = r * np.sin(TURN)
    bore, cos_delta = motion.slide("bore"), np.sqrt(1 - (s / rod) ** 2)
    sin_delta = s / rod
    assert np.max(np.abs(bore.value - (r * np.cos(TURN) + rod * cos_delta))) <= EXACT * rod
    assert np.ptp(bore.value) == pytest.approx(2 * r, rel=EXACT)
    speed = -r * (np.sin(TURN) + np.cos(TURN) * sin_delta / cos_delta)
    assert np.max(np.abs(bore.d1 - speed)) <= EXACT * rod
    turned = (np.cos(TURN) / cos_delta) ** 2 / cos_delta * r / rod
    acceleration = -r * (np.cos(TURN) - np.sin(TURN) * sin_delta / cos_delta + turned)
    assert np.max(np.abs(bore.d2 - acceleration)) <= EXACT * rod


# -- slotted levers and slides --------------------------------------------------------------------


def lever_angle(r: float, d: float) -> Float:
    """Direction from D, d below O, to the crank pin; continuous from near 0."""
    return np.unwrap(np.arctan2(r * np.sin(TURN) + d, r * np.cos(TURN)))


def time_ratio(mechanism: assur.Mechanism) -> float:
    """Crank angle of the ram's way out over that of its way back, to a sample of 0.5°."""
    out = mechanism.solve((TURN[1:] + TURN[:-1]) / 2, order=1).slide("bed").d1 > 0
    return float(np.sum(out) / np.sum(~out))


def test_whitworth() -> None:
    r, d, e, rod = 0.1, 0.05, 0.15, 0.39
    mechanism = library.whitworth()
    motion = mechanism.solve(TURN)
    beta = lever_angle(r, d)
    lever = motion.link("lever")
    assert np.max(np.abs(lever.value - (beta - math.pi))) <= EXACT * 10
    assert lever.value[-1] - lever.value[0] == pytest.approx(math.tau, abs=EXACT)
    s = motion.slide("slot").value
    assert np.max(np.abs(s**2 - (r * r + d * d + 2 * r * d * np.sin(TURN)))) <= EXACT * (r + d) ** 2
    assert lever.d1 == pytest.approx((r * r + r * d * np.sin(TURN)) / s**2, abs=10 * EXACT)
    ram = -e * np.cos(beta) + np.sqrt(rod**2 - (e * np.sin(beta)) ** 2)
    bed = motion.slide("bed")
    assert np.max(np.abs(bed.value - ram)) <= EXACT * (e + rod)
    # the ram turns where the lever lies along the bed, 30° beyond the crank's own level
    alpha = math.asin(d / r)
    ends = mechanism.solve([-alpha, math.pi + alpha], order=1)
    assert np.max(np.abs(ends.slide("bed").d1)) <= EXACT
    assert ends.slide("bed").value == pytest.approx([rod - e, rod + e], abs=EXACT)
    assert time_ratio(mechanism) == pytest.approx((math.pi + 2 * alpha) / (math.pi - 2 * alpha))


def test_shaper() -> None:
    r, d, e, rod = 0.1, 0.2, 0.4, 0.15
    mechanism = library.shaper()
    motion = mechanism.solve(TURN)
    beta = lever_angle(r, d)
    assert np.max(np.abs(motion.link("lever").value - beta)) <= EXACT * 10
    end = np.stack([e * np.cos(beta), e * np.sin(beta) - d], axis=-1)
    ram = end[:, 0] + np.sqrt(rod**2 - (end[:, 1] - 0.17) ** 2)
    bed = motion.slide("bed")
    assert np.max(np.abs(bed.value - ram)) <= EXACT
    # the lever turns back where the crank is at right angles to it
    alpha = math.asin(r / d)
    ends = mechanism.solve([-alpha, math.pi + alpha], order=1)
    assert ends.link("lever").value == pytest.approx(
        [math.pi / 2 - alpha, math.pi / 2 + alpha], abs=EXACT
    )
    assert np.max(np.abs(ends.link("lever").d1)) <= EXACT
    assert np.max(np.abs(ends.slide("bed").d1)) <= EXACT
    assert time_ratio(mechanism) == pytest.approx((math.pi - 2 * alpha) / (math.pi + 2 * alpha))


def test_scotch_yoke() -> None:
    r = 0.05
    q = np.concatenate([TURN, -3 * TURN])
    motion = library.scotch_yoke().solve(q, order=3)
    bed, c, s = motion.slide("bed"), r * np.cos(q), r * np.sin(q)
    for got, want in ((bed.value, c), (bed.d1, -s), (bed.d2, -c), (bed.d3, s)):
        assert np.max(np.abs(got - want)) <= EXACT * r
    assert np.max(np.abs(np.abs(motion.slide("slot").value) - np.abs(s))) <= EXACT * r
    assert np.max(np.abs(motion.link("yoke").value - motion.link("yoke").value[0])) <= EXACT


def test_tangent_generator() -> None:
    h = 0.1
    q = coordinates("tangent_generator")
    mechanism = library.tangent_generator()
    motion = mechanism.solve(q, order=3)
    rail, t = motion.slide("rail"), np.tan(q)
    g = 1 + t * t  # its own derivative: 2 t g
    for got, want in (
        (rail.value, h * t),
        (rail.d1, h * g),
        (rail.d2, 2 * h * t * g),
        (rail.d3, 2 * h * g * (g + 2 * t * t)),
    ):
        assert np.max(np.abs(got - want)) <= EXACT * np.max(np.abs(want))
    assert np.max(np.abs(motion.slide("slot").value - h / np.cos(q))) <= EXACT * h / math.cos(1.4)


def test_trammel() -> None:
    """An ellipse: half axes BP and AP; the bar's middle runs on a circle."""
    motion = library.trammel().solve(TURN)
    x, y = motion.joint("P").value.T
    assert np.max(np.abs((x / 0.2) ** 2 + (y / 0.08) ** 2 - 1)) <= EXACT
    assert np.max(np.abs(x - 0.2 * np.cos(TURN))) <= EXACT * 0.2
    assert np.max(np.abs(y - 0.08 * np.sin(TURN))) <= EXACT * 0.2
    assert np.max(np.abs(motion.slide("x").value - 0.12 * np.cos(TURN))) <= EXACT * 0.2
    assert np.max(np.abs(motion.slide("y").value + 0.12 * np.sin(TURN))) <= EXACT * 0.2
    by_slide = library.trammel().with_driver("x").solve(np.linspace(-0.119, 0.119, 101), order=0)
    x, y = by_slide.joint("P").value.T
    assert np.max(np.abs((x / 0.2) ** 2 + (y / 0.08) ** 2 - 1)) <= EXACT
    assert np.all(y < 0)  # as drawn
    middle = (motion.joint("A").value + motion.joint("B").value) / 2
    assert np.max(np.abs(np.hypot(*middle.T) - 0.06)) <= EXACT * 0.2


# -- six-bars and legs ----------------------------------------------------------------------------


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
    mechanism = library.LIBRARY[name]()
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
    mechanism = library.jansen_leg()
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


def test_klann_leg() -> None:
    """The patent's two positions; a closed path with half a turn flat."""
    stride = 0.5
    foot = library.klann_leg().solve(TURN).joint("F").value / stride
    assert foot[0] == pytest.approx(foot[-1], abs=EXACT)
    at = library.klann_leg().solve([math.pi, 0.0]).joint("F").value / stride
    assert at[0] == pytest.approx([0.0, 0.0], abs=EXACT)
    assert at[1] == pytest.approx([1.0, 0.0], abs=1e-3)  # the patent's three decimals
    half = len(TURN) // 2
    flat, lift = foot[: half + 1], foot[half:]
    assert np.ptp(flat[:, 1]) == pytest.approx(0.055, abs=5e-4)  # Klann: deviation 5.5 %
    assert lift[:, 1].max() - flat[:, 1].min() == pytest.approx(0.53, abs=5e-3)
    ends = np.argmax(flat[:, 0]), np.argmin(flat[:, 0])
    assert np.all(np.diff(flat[slice(*ends), 0]) < 0)  # one way on the ground
    assert ends[1] - ends[0] > 0.9 * half


# -- exact straight lines -------------------------------------------------------------------------


def test_peaucellier() -> None:
    mechanism = library.peaucellier()
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
    mechanism = library.hart()
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


# -- machines -------------------------------------------------------------------------------------


def turned(place: tuple[float, float], by: float) -> tuple[float, float]:
    (x, y), c, s = place, math.cos(by), math.sin(by)
    return (c * x - s * y, s * x + c * y)


def test_excavator() -> None:
    """Cylinders as long as q; every joint by triangles alone, one link after another."""
    mechanism = library.excavator()
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
    mechanism = library.toggle_press()
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
