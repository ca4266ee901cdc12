"""What must not matter: frame, scale, order of the description, grid; and redundant links.

Two solutions of the same motion may each be off by the law (agreement.py), and the moved drawing
is itself rounded: they agree to three times what the law allows.
"""

from __future__ import annotations

import math
import random
from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st

import assur
from assur import Status
from models.mechanisms import dyad_models, mixed_models, named_drawings, named_models
from models.mechanisms.frames import Frame
from models.mechanisms.mechanism_data import GROUND, Description, arguments
from oracles.kinematics import agreement
from support.samples import sample

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

# A seed has no simpler one.
SEEDS = settings(max_examples=sample(30, 100), phases=(Phase.explicit, Phase.reuse, Phase.generate))
moves = st.floats(-0.5, 0.5)
# Dyads alone as often as dyads and higher groups in any order.
ANY = dyad_models.sequences() | mixed_models.mixed()
PARTS = (0.0, 0.1, 1.0)  # of a move: half of the whole ones end beyond a fold
# Positions checked for a gap on the path.
CHECKED = 1001


def made(d: Description) -> assur.Mechanism:
    return assur.Mechanism(**arguments(d))


def solve(m: assur.Mechanism, change: NDArray[np.float64]) -> assur.Motion:
    q = np.atleast_1d(m.q0) + change
    return m.solve(q if q.size > 1 else q[0], order=3, on_error="nan")


def check_same(
    d: Description,
    motions: tuple[assur.Motion, assur.Motion],
    frame: Frame,
    shifted: bool = False,
    across: bool = False,
) -> None:
    """Values and analogues of two motions, the second in another frame.

    Angles (and, where `shifted`, slides' values) are compared from the drawing on; `across` a gap
    but for whole turns: a link that is half a turn on behind it has turned clockwise by convention,
    in a mirror too.
    """
    one, two = motions
    size = max(float(np.max(np.abs(one.joint(n).value))) for n in d.joints)
    size = max(size, *(abs(float(one.slide(n).value)) for n in d.slides), 1e-300)
    offset = max(map(abs, frame.shift)) / frame.scale  # lost in rounding the moved drawing
    size = 2 * max(size, offset, *(max(map(abs, p)) for p in d.joints.values()))
    kappa = max(float(one.condition), float(two.condition))
    hand = -1.0 if frame.mirror else 1.0
    units = [frame.scale if kind == "slide" else hand for kind, *_ in d.drivers]
    # where an order vanishes (pure translation) the one below, by the size, stands for its size
    least, long = 0.0, size if d.drivers[0][0] == "slide" else 1.0
    drawn = [m.mechanism.solve(m.mechanism.q0, order=0) for m in motions]
    for k in range(4):
        index = "value" if k == 0 else f"d{k}"
        shape = (len(units),) * k if len(units) > 1 else ()
        grow = np.ones(shape)  # of dq' for dq, for each partial
        for place in np.ndindex((len(units),) * k):
            part = math.prod(units[i] for i in place)
            if shape:
                grow[place] = part
            else:
                grow = np.array(part)
        own, worst, whose = 0.0, 0.0, ""
        for name in d.joints:
            a, b = (getattr(m.joint(name), index) for m in motions)
            want = np.tensordot(frame.matrix, a, (1, 0))
            want = want + np.array(frame.shift) if k == 0 else want
            own, error = max(own, float(np.max(np.abs(a)))), np.abs(b * grow - want) / frame.scale
            worst, whose = max((worst, whose), (float(np.max(error)), f"joint {name}"))
        for name in d.slides:
            a, b = (getattr(m.slide(name), index) for m in motions)
            if k == 0 and shifted:
                a, b = a - drawn[0].slide(name).value, b - drawn[1].slide(name).value
            own, error = max(own, float(np.max(np.abs(a)))), np.abs(b * grow / frame.scale - a)
            worst, whose = max((worst, whose), (float(np.max(error)), f"slide {name}"))
        arm = min(
            (math.dist(d.joints[n[0]], d.joints[n[1]]) for n in d.links.values() if n[1:]),
            default=size,
        )
        for name in d.links:
            a, b = (getattr(m.link(name), index) for m in motions)
            if k == 0:
                a, b = a - drawn[0].link(name).value, b - drawn[1].link(name).value
            own = max(own, arm * float(np.max(np.abs(a))))
            error = arm * np.abs(less_turns(b * grow - hand * a, across and k == 0))
            worst, whose = max((worst, whose), (float(np.max(error)), f"link {name}"))
        if k:
            least = own if k == 1 else max(own, least / long)
        law = agreement.ANALOGUE * kappa**2 * least if k else agreement.POSITION * kappa * size
        assert worst <= 3 * law + 1e-300, f"order {k}, {whose}: {worst:.3g}, law {law:.3g}"


def less_turns(gap: NDArray[np.float64], wanted: bool) -> NDArray[np.float64]:
    turns: NDArray[np.float64] = math.tau * np.round(gap / math.tau) * wanted
    return gap - turns


def check_frame(case: dyad_models.Case, move: float, frame: Frame) -> None:
    d = case.description
    hand = -1.0 if frame.mirror else 1.0
    one, two = made(d), made(frame.of(d))
    assert one.structure.formula == two.structure.formula
    units = [frame.scale if kind == "slide" else hand for kind, *_ in d.drivers]
    for part in PARTS:
        change = part * move
        motions = solve(one, change * np.ones(len(units))), solve(two, change * np.array(units))
        assert motions[0].status == motions[1].status
        if motions[0].status <= Status.NEAR_SINGULAR:
            across = frame.mirror and gap_before(one, change)
            check_same(d, motions, frame, across=across)


def gap_before(m: assur.Mechanism, change: float) -> bool:
    """Whether a gap lies between the drawing and there."""
    if np.size(m.q0) > 1:
        return False
    path = float(m.q0) + np.linspace(0.0, change, CHECKED)
    return bool((m.solve(path, order=0, on_error="nan").status == Status.UNREACHABLE).any())


@SEEDS
@given(ANY, moves, st.floats(-math.pi, math.pi))
def test_rotation(case: dyad_models.Case, move: float, turn: float) -> None:
    check_frame(case, move, Frame(turn=turn))


@SEEDS
@given(ANY, moves, st.tuples(st.floats(-9, 9), st.floats(-9, 9)))
def test_translation(case: dyad_models.Case, move: float, shift: tuple[float, float]) -> None:
    check_frame(case, move, Frame(shift=shift))


def test_a_half_turn_behind_a_gap() -> None:
    """Found once: a link half a turn on, whose mirror image turned in the same direction."""
    case = dyad_models.build(2635, "cylinder", ("PRP", "RRP", "PRP", "PRP", "PRP", "RPR"))
    check_frame(case, 0.06597458344611529, Frame(mirror=True))


@SEEDS
@given(dyad_models.sequences(), moves, st.booleans())
def test_mirror(case: dyad_models.Case, move: float, upright: bool) -> None:
    check_frame(case, move, Frame(mirror=True, turn=0.0 if upright else math.pi))


@SEEDS
@given(ANY, moves, st.floats(1e-3, 1e3))
def test_scale(case: dyad_models.Case, move: float, scale: float) -> None:
    check_frame(case, move, Frame(scale=scale))


@SEEDS
@given(ANY, moves, st.integers(-300, 300))
def test_scale_by_a_power_of_two(case: dyad_models.Case, move: float, power: int) -> None:
    """No bit changes."""
    d, scale = case.description, 2.0**power
    one, two = made(d), made(Frame(scale=scale).of(d))
    slide = [kind == "slide" for kind, *_ in d.drivers]
    q = np.atleast_1d(one.q0) + move / 8
    q_two = q * np.where(slide, scale, 1.0)
    flat = len(slide) == 1
    motions = [
        m.solve(x[0] if flat else x, order=3, on_error="nan") for m, x in ((one, q), (two, q_two))
    ]
    assert motions[0].status == motions[1].status
    per_q = np.array(slide if len(slide) > 1 else slide[0], int)
    for k, index in enumerate(("value", "d1", "d2", "d3")):
        # By every slide once a length less: of several drivers one index each, last fastest.
        less = np.zeros((1,) * k, int)
        for axis in range(k):
            less = less + np.reshape(per_q, (1,) * axis + (-1,) + (1,) * (k - axis - 1))
        for kind, names, length in (
            ("joint", d.joints, 1),
            ("slide", d.slides, 1),
            ("link", d.links, 0),
        ):
            for name in names:
                a, b = (getattr(getattr(m, kind)(name), index) for m in motions)
                powers = power * (length - (less if per_q.ndim else k * per_q))
                if kind == "joint" and per_q.ndim:
                    powers = powers[np.newaxis]  # x and y come first
                want = np.ldexp(a, powers)
                assert np.array_equal(want, b, equal_nan=True), (kind, name, index)


# -- dimensions from 1e-150 to 1e150 ---------------------------------------------------------------


def drawn_larger(m: assur.Mechanism, scale: float) -> assur.Mechanism:
    """The same drawing, every coordinate times `scale`."""
    joints = {n: (x * scale, y * scale) for n, (x, y) in m.joints.items()}
    drivers = m.driver if isinstance(m.driver, (str, assur.Drive)) else list(m.driver)
    return assur.Mechanism(joints, m.links, drivers, slides=m.slides)


def larger(m: assur.Mechanism, scale: float) -> assur.Mechanism:
    """The same mechanism, every length times `scale`; the drawing stays."""
    turns = (".angle", ".link_angle")
    lengths = {n: v * scale for n, v in m.dimensions.items() if not n.endswith(turns)}
    return m.with_dimensions(lengths)


def library_motions(
    name: str, scale: float, make: Callable[[assur.Mechanism, float], assur.Mechanism]
) -> tuple[assur.Motion, assur.Motion]:
    """Sixty positions over the range and the drawing's, in metres and in other units."""
    drawn = named_drawings.CLASS_II[name]()
    one, two = make(drawn, 1.0), make(drawn, scale)
    low, high = (np.asarray(end) for end in named_drawings.RANGES[name])
    t = np.linspace(0.0, 1.0, 60).reshape(-1, *(1,) * low.ndim)
    q = np.concatenate([low + t * (high - low), [one.q0]])
    drivers = {one.driver} if isinstance(one.driver, (str, assur.Drive)) else set(one.driver)
    unit = scale if drivers <= set(one.slides) else 1.0
    return one.solve(q, order=3, on_error="nan"), two.solve(q * unit, order=3, on_error="nan")


def tracks(m: assur.Mechanism) -> list[tuple[str, str, int]]:
    """Kind and name of every output, and its power of the length."""
    kinds = (("joint", m.joints, 1), ("slide", m.slides, 1), ("link", m.links, 0))
    return [(kind, name, length) for kind, names, length in kinds for name in names]


def per_q(m: assur.Mechanism) -> int:
    return int(set(np.atleast_1d(np.asarray(m.driver, dtype=object))) <= set(m.slides))


# The branch of a driven slide starts from its value in the drawing, which `larger` leaves as it is.
of_library = pytest.mark.parametrize(
    ("name", "make"),
    [
        *((name, drawn_larger) for name in named_drawings.CLASS_II),
        *((name, larger) for name in named_drawings.CLASS_II if name != "excavator"),
    ],
)


@of_library
@pytest.mark.parametrize("power", [-498, -100, -10, 10, 100, 498])
def test_library_by_a_power_of_two(
    name: str, make: Callable[[assur.Mechanism, float], assur.Mechanism], power: int
) -> None:
    """2^-498 to 2^498, 1e-150 to 1e150: no bit of an angle or an analogue changes."""
    one, two = library_motions(name, 2.0**power, make)
    assert np.array_equal(one.status, two.status)
    assert np.array_equal(one.condition, two.condition)
    by = per_q(one.mechanism)
    for kind, track, length in tracks(one.mechanism):
        for k, index in enumerate(("value", "d1", "d2", "d3")):
            a, b = (getattr(getattr(m, kind)(track), index) for m in (one, two))
            with np.errstate(over="ignore"):  # angles per m³
                want = np.ldexp(a, power * (length - by * k))
            assert np.array_equal(want, b, equal_nan=True), (kind, track, index)


@of_library
@pytest.mark.parametrize("scale", [1e-150, 1e-3, 1e3, 1e150])
def test_library_in_other_units(
    name: str, make: Callable[[assur.Mechanism, float], assur.Mechanism], scale: float
) -> None:
    """Millimetres: lengths are rounded anew, so all agree to three times the law.

    A second analogue loses κ³, a third κ⁴ to rounded lengths (test_change_points.py).
    """
    one, two = library_motions(name, scale, make)
    m, by = one.mechanism, per_q(one.mechanism)
    assert np.array_equal(one.status, two.status)
    solved = one.status <= Status.NEAR_SINGULAR
    assert solved.sum() >= len(one.q) - 4  # but for drawings and ends in line
    kappa = np.maximum(one.condition, two.condition)[solved]
    size = max(float(np.nanmax(np.abs(one.joint(n).value))) for n in m.joints)
    arm = min(math.dist(m.joints[on[0]], m.joints[on[1]]) for on in m.links.values() if on[1:])
    for k, index in enumerate(("value", "d1", "d2", "d3")):
        own, errors = np.zeros(len(kappa)), []
        for kind, track, length in tracks(m):
            a, b = (getattr(getattr(motion, kind)(track), index)[solved] for motion in (one, two))
            power, unit = by * k - length, arm if kind == "link" else 1.0
            if abs(power * math.log10(scale)) > 307:  # beyond any number: angles per m³
                continue
            error = unit * np.abs(b * scale**power - a)
            errors.append(error.reshape(len(kappa), -1).max(axis=1))
            own = np.maximum(own, unit * np.abs(a).reshape(len(kappa), -1).max(axis=1))
        own = np.maximum(own, size if k < 2 else 0.0)
        law = agreement.ANALOGUE * kappa ** max(2, k + 1) * own
        law = agreement.POSITION * kappa * size if k == 0 else law
        assert (np.max(errors, axis=0) <= 3 * law).all(), (index, np.max(errors / law))


@SEEDS
@given(ANY, moves, st.integers(0, 2**32 - 1))
def test_order_of_the_description(case: dyad_models.Case, move: float, seed: int) -> None:
    """Joints, links and slides in any order, and the joints inside links."""
    rng = random.Random(seed)
    d = case.description

    def mixed(table: dict[str, dyad_models.T]) -> dict[str, dyad_models.T]:
        return dict(rng.sample(list(table.items()), len(table)))

    # a first and second joint far enough apart to give the angle as well as before
    links = {n: rng.sample(on, len(on)) if len(on) < 3 else on for n, on in d.links.items()}
    links[GROUND] = rng.sample(d.links[GROUND], len(d.links[GROUND]))
    for name, on in links.items():
        if name != GROUND and len(on) > 2:
            rest = rng.sample(on[2:], len(on) - 2)
            links[name] = [*rng.sample(on[:2], 2), *rest]
    other = Description(mixed(d.joints), mixed(links), mixed(d.slides), d.drivers)
    one, two = made(d), made(other)
    for part in PARTS:
        change = part * move * np.ones(len(d.drivers))
        motions = solve(one, change), solve(two, change)
        # a joint of several links is reached by another of them: κ, hence NEAR, may differ
        there = [m.status <= Status.NEAR_SINGULAR for m in motions]
        assert there[0] == there[1]
        if motions[0].status <= Status.NEAR_SINGULAR:
            check_same(d, motions, Frame(), shifted=True)


# -- a redundant link -----------------------------------------------------------------------------


def test_third_bar() -> None:
    """A locomotive's rods: solved, reported, and checked."""
    d = named_models.parallelogram()
    m = made(d)
    assert m.structure.mobility == 1
    assert len(m.structure.redundant) == 1
    (extra,) = m.structure.redundant
    q = np.linspace(m.q0 - 0.7, m.q0 + 0.7, 15)
    motion = m.solve(q, order=3)
    assert np.all(motion.status == Status.OK)
    for name in ("crank", "second", "third"):
        assert motion.link(name).value == pytest.approx(q, abs=16 * agreement.U * 4)
        assert motion.link(name).d1 == pytest.approx(np.ones(15), abs=64 * agreement.U * 4)
    moved = motion.joint("F").value - motion.joint("B").value
    assert moved == pytest.approx(np.tile([1.5, 0.0], (15, 1)), abs=16 * agreement.U * 4)
    for wrong in (1.3, 1.25 * (1 + 1e-7)):
        bad = m.with_dimensions({"third.length": wrong})
        caught = bad.solve(m.q0 + 0.1, on_error="nan")
        assert caught.status == Status.UNREACHABLE
        assert np.isnan(caught.joint("C").value).all()
        assert repr(extra) in caught.explain() or f'"{extra}"' in caught.explain()
        with pytest.raises(assur.PositionError, match=extra):
            bad.solve(m.q0 + 0.1)


# -- angles ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "make",
    [
        *(named_models.crank_rocker, named_models.whitworth, named_models.jansen),
        *(named_models.oldham, named_models.engine, named_models.trammel),
        named_models.scotch_yoke,
    ],
)
def test_angles_do_not_depend_on_the_grid(make: object) -> None:
    """Continuous over four turns both ways; the same bits alone, coarse, backwards or fine."""
    d = make()  # type: ignore[operator]
    m = made(d)
    fine = m.q0 + np.linspace(-4 * math.tau, 4 * math.tau, 4001)
    motion = m.solve(fine, order=1)
    coarse = np.random.default_rng(1).permutation(np.arange(3, 4001, 371))
    jumps = m.solve(fine[coarse], order=1)
    for name in d.links:
        angle = motion.link(name)
        step, rate = np.diff(angle.value), angle.d1
        assert np.all(np.abs(step) <= np.abs(fine[1] - fine[0]) * np.max(np.abs(rate)) * 1.001)
        assert -math.pi < angle.value[2000] <= math.pi
        assert np.array_equal(jumps.link(name).value, angle.value[coarse])
        for i in coarse[:4]:
            assert m.solve(fine[i], order=0).link(name).value == angle.value[i]
        turns = (angle.value[::500] - angle.value[0]) / math.tau  # one driver's turn apart
        assert turns == pytest.approx(np.round(turns), abs=1e-12)
        assert np.ptp(np.diff(np.round(turns))) == 0  # the same number in each
