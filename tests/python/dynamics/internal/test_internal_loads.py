"""Loads inside links: worked and published numbers, and cuts of the oracle's rods."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import assur
from assur import Body, Damper, Force, Gravity, Spring, Table
from oracles.dynamics.cut_rod import CutRod

NAMES = ("axial", "shear", "moment")


def thin(mass: float, length: float) -> Body:
    """A uniform thin rod from the link's first joint to its second."""
    return Body(mass=mass, inertia=mass * length**2 / 12, at=(length / 2, 0.0))


def engine(*loads: Any, piston: float = 2.0) -> assur.Machine:
    bodies = {"rod": thin(1.2, 0.35), "piston": Body(mass=piston)}
    return assur.Machine(assur.SliderCrank(0.1, 0.35), bodies=bodies, loads=loads)


def pull(_: float, q: Any, speed: Any) -> float:
    return 7.0 + float(np.sum(q)) - 0.5 * float(np.sum(speed))


TABLE = Table([0.0, 2.0, 4.0, math.tau], [0.0, 50.0, -20.0, 0.0])
ON_THE_ROD = [
    Gravity((1.0, -9.81)),
    Gravity((0.0, -1.0)),
    Force("B", (-800.0, 35.0), on="rod"),
    Force("A", (3.0, 5.0), on="crank"),
    Force(("rod", (0.1, 0.02)), (TABLE, pull)),
    Force(("rod", (0.3, 0.0)), (10.0, TABLE), axes="crank"),
    Spring(("rod", (0.2, -0.05)), "O", 300.0, 0.1, preload=2.0),
    Spring("A", ("ground", (0.3, 0.4)), 100.0, 0.2),
    Damper(("piston", (0.02, 0.03)), ("rod", (0.05, 0.01)), 4.0),
]


# -- known numbers --------------------------------------------------------------------------------


def test_bending_of_an_engine_rod() -> None:
    """Worked twice before: with the crank across the rod, and over the turn."""
    machine = engine()
    across = math.atan2(0.35, 0.1)
    found = machine.internal_loads("rod", across, 300.0).extremes("moment")
    assert found.min == pytest.approx(-243.9454044, rel=6e-10)
    assert found.min_x == pytest.approx(0.1482386029, rel=6e-10)
    for count in (19, 37, 400):  # whatever the positions
        q = np.linspace(0.0, math.pi, count)
        peak = machine.internal_loads("rod", q, 300.0).peak("moment")
        assert peak.value == pytest.approx(-253.0759225, rel=6e-10)
        assert math.degrees(peak.q) == pytest.approx(61.355654, abs=2e-6)


@pytest.mark.parametrize("quantity", NAMES)
@pytest.mark.parametrize("loads", [(), ON_THE_ROD])
def test_peaks_of_a_turn(quantity: str, loads: Any) -> None:
    """From few positions, what a grid of many has: tension, compression, and the greater size."""
    machine = engine(*loads)
    few = machine.internal_loads("rod", np.linspace(0.0, math.tau, 61), 9.0, 3.0)
    q = np.linspace(0.0, math.tau, 20001)
    fine = machine.internal_loads("rod", q, 9.0, 3.0, n=2).extremes(quantity)
    scale = np.abs(few.axial).max() * (0.35 if quantity == "moment" else 1.0)
    least, greatest = fine.min.min(), fine.max.max()
    measures: dict[str, Any] = {"min": lambda v: -v, "max": lambda v: v, "size": abs}
    for of, measure in measures.items():
        peak = few.peak(quantity, of=of)
        known = max((least, greatest), key=measure)
        assert measure(peak.value) >= measure(known) - 1e-12 * scale
        assert peak.value == pytest.approx(known, abs=1e-6 * scale)
        alone = machine.internal_loads("rod", peak.q, 9.0, 3.0).extremes(quantity)
        assert min(abs(alone.min - peak.value), abs(alone.max - peak.value)) < 1e-12 * scale


def test_whipping_moment() -> None:
    """Khurmi, A Textbook of Machine Design, chapter 32: 1.64 kg/m, 1800 rev/min: 51.3 N·m.

    Its theory lets the crankpin's acceleration be across the rod and the piston rest: here a rod
    that turns about a fixed pin, accelerated at the other by a link without mass.
    """
    r, length, omega = 0.095, 0.38, 1800.0 * math.tau / 60.0
    linkage = assur.FourBar(0.2, 0.5, length, 0.5)
    machine = assur.Machine(linkage, bodies={"rocker": thin(1.64 * length, length)})
    turned = float(linkage.solve(1.0, order=1).link("rocker").d1)
    acceleration = omega**2 * r / length / turned
    found = machine.internal_loads("rocker", 1.0, 0.0, acceleration).extremes("moment")
    size, place = max((abs(found.min), found.min_x), (abs(found.max), found.max_x))
    assert size == pytest.approx(51.2783, abs=6e-5)
    assert size == pytest.approx(1.64 * length**2 * omega**2 * r / (9 * math.sqrt(3.0)), rel=1e-12)
    assert place == pytest.approx(length / math.sqrt(3.0), rel=1e-12)
    # The true rod, its piston's end moving too, is a few percent above.
    true = assur.Machine(assur.SliderCrank(r, length), bodies={"rod": thin(1.64 * length, length)})
    peak = true.internal_loads("rod", np.linspace(0.0, math.pi, 37), omega).peak("moment")
    assert 1.02 < abs(peak.value) / 51.2783 < 1.06


def test_bar_in_tension_and_simple_beam() -> None:
    """Statics: a strut under its ends' forces, and w L²/8 of a beam under its weight."""
    machine = assur.Machine(assur.SliderCrank(0.3, 0.5), loads=[Force("B", (-100.0, 0.0))])
    found = machine.internal_loads("rod", math.pi / 2)
    np.testing.assert_allclose(found.axial, -100.0 / 0.8)
    np.testing.assert_allclose([found.shear, found.moment], 0.0, atol=1e-13)
    level = assur.FourBar(1.0, 2.0, 1.0, 2.0)
    beam = assur.Machine(level, bodies={"coupler": thin(6.0, 2.0)}, loads=[Gravity((0.0, -10.0))])
    found = beam.internal_loads("coupler", math.pi / 2, n=5)
    np.testing.assert_allclose(found.moment, [0.0, 11.25, 15.0, 11.25, 0.0], atol=1e-12)
    np.testing.assert_allclose(found.shear, [-30.0, -15.0, 0.0, 15.0, 30.0], atol=1e-12)
    assert found.extremes("moment").max == pytest.approx(15.0)
    assert found.extremes("moment").max_x == pytest.approx(1.0)


# -- against the oracle ---------------------------------------------------------------------------


def slotted() -> assur.Machine:
    """A quick return: the block on the crank slides on the rocker, which pushes a ram."""
    m = assur.Mechanism(
        joints={"O": (0, 0.5), "A": (0.2, 0.6), "P": (0, 0), "E": (0.3, 1.3), "F": (1.0, 1.4)},
        links={
            "ground": "OP",
            "crank": "OA",
            "block": "A",
            "rocker": "PE",
            "rod": "EF",
            "ram": "F",
        },
        driver="crank",
        slides={
            "slot": assur.Slide("block", on="rocker", angle=1.2),
            "way": assur.Slide("ram", on="ground", angle=0.1),
        },
    )
    length = m.dimensions["rocker.length"]
    bodies = {
        "rocker": thin(3.0, length),
        "block": Body(mass=0.5, inertia=0.01),
        "ram": Body(mass=2.0),
    }
    return assur.Machine(m, bodies=bodies, loads=[Gravity(), Force("F", (-40.0, 3.0))])


def telescope() -> assur.Machine:
    """A cylinder whose rod is driven: the sliding link is a rod of two joints."""
    m = assur.Mechanism(
        joints={"A": (0, 0), "B": (2.0, 1.5), "C": (1.0, 0.75), "D": (3.0, 0.0)},
        links={"ground": "AD", "barrel": "A", "piston": "CB", "boom": "DB"},
        driver="jack",
        slides={"jack": assur.Slide("piston", on="barrel", angle=math.atan2(1.5, 2.0))},
    )
    length = m.dimensions["piston.length"]
    bodies = {
        "piston": thin(2.0, length),
        "boom": Body(mass=4.0, inertia=0.3, at=(0.6, 0.1)),
        "barrel": Body(mass=1.0),
    }
    return assur.Machine(m, bodies=bodies, loads=[Gravity()])


def six_bar() -> assur.Machine:
    """A coupler of three pins, the third beside its line, and density in steps."""
    m = assur.Mechanism(
        joints={
            "A": (0, 0), "B": (0.3, 0.8), "C": (3.0, 1.6), "D": (3.2, 0),
            "P": (1.2, 2.0), "Q": (2.0, 3.5), "R": (4.0, 3.0),
        },
        links={
            "ground": "ADR", "crank": "AB", "coupler": "BPC", "rocker": "CD",
            "link": "PQ", "arm": "QR",
        },
        driver="crank",
    )  # fmt: skip
    bodies = {
        "arm": Body(mass=2.0, inertia=0.4, at="Q"),
        "link": Body(mass=1.0),
        "crank": thin(2.0, math.hypot(0.3, 0.8)),
    }
    return assur.Machine(m, bodies=bodies, loads=[Gravity()])


def robot() -> assur.Machine:
    """Two drivers, the second between two links."""
    m = assur.Mechanism(
        joints={"A": (0, 0), "B": (1.0, 0.5), "E": (1.9, 0.1)},
        links={"ground": "A", "upper": "AB", "fore": "BE"},
        driver=["upper", assur.Drive("fore", relative_to="upper")],
    )
    bodies = {
        "upper": thin(3.0, m.dimensions["upper.length"]),
        "fore": thin(2.0, m.dimensions["fore.length"]),
    }
    return assur.Machine(m, bodies=bodies, loads=[Gravity(), Force("E", (5.0, -30.0))])


def with_mass(machine: assur.Machine, link: str, density: Any) -> assur.Machine:
    """The machine with the body of a density along the line of two joints, by quadrature."""
    mechanism = machine.mechanism
    assert mechanism is not None
    joints = mechanism.links[link]
    end = complex(
        mechanism.dimensions[f"{link}.{joints[2]}.x"], mechanism.dimensions[f"{link}.{joints[2]}.y"]
    )
    x, mu = (np.array(part) for part in density)
    nodes, weights = np.polynomial.legendre.leggauss(5)
    h = np.diff(x)[:, np.newaxis]
    s = x[:-1, np.newaxis] + h * (nodes + 1) / 2
    mass = (mu[:-1, np.newaxis] + np.diff(mu)[:, np.newaxis] * (nodes + 1) / 2) * weights * h / 2
    whole = mass.sum()
    centre = (mass * s).sum() / whole
    at = centre * end / abs(end)
    body = Body(mass=whole, inertia=(mass * (s - centre) ** 2).sum(), at=(at.real, at.imag))
    return assur.Machine(mechanism, bodies={**machine.bodies, link: body}, loads=machine.loads)


STEPPED = six_bar()
SPAN = math.hypot(2.7, 0.8)
STEPS = [0.0, 0.5, 0.5, 1.7, SPAN], [3.0, 2.0, 0.5, 1.0, 4.0]
CASES: dict[str, tuple[assur.Machine, str, Any, Any, Any]] = {
    "loads of all kinds": (engine(*ON_THE_ROD), "rod", None, None, [0.4, 2.0, 5.0]),
    "the other way": (engine(*ON_THE_ROD), "rod", ("B", "A"), None, [0.4, 2.0, 5.0]),
    "a driven crank": (six_bar(), "crank", None, None, [1.0, 1.4]),
    "a slot": (slotted(), "rocker", None, None, [0.3, 1.5, 2.6, 4.4]),
    "a rod without mass": (slotted(), "rod", None, None, [0.3, 1.5]),
    "a driven slide": (telescope(), "piston", None, None, [1.25, 1.4]),
    "three pins": (with_mass(STEPPED, "coupler", STEPS), "coupler", ("B", "C"), STEPS, [1.1, 1.5]),
    "two drivers": (robot(), "upper", None, None, [[0.3, -0.7], [0.8, 0.4]]),
    "a relative drive": (robot(), "fore", None, None, [[0.3, -0.7], [0.8, 0.4]]),
}


@pytest.mark.parametrize("name", list(CASES))
def test_cuts(name: str) -> None:
    machine, link, along, density, q = CASES[name]
    m = machine.mechanism
    assert m is not None
    speed, acceleration = (3.0, -7.0) if np.ndim(q) == 1 else ([3.0, -2.0], [-7.0, 4.0])
    found = machine.internal_loads(link, q, speed, acceleration, along=along, density=density, n=23)
    first, second = along or m.links[link][:2]
    for k, at in enumerate(q):
        cut = CutRod(machine, link, (first, second), at, speed, acceleration)
        mass = machine.bodies[link].mass if link in machine.bodies else 0.0
        spread = density or ([0.0, cut.length], [mass / cut.length] * 2)
        wanted = np.transpose([cut.at(float(x), spread) for x in found.x])
        scale = max(1.0, *(abs(f) for _, f, _ in cut.acting))
        for quantity, known in zip(NAMES, wanted, strict=True):
            own = getattr(found, quantity)[k]
            unit = scale * (cut.length if quantity == "moment" else 1.0)
            np.testing.assert_allclose(own, known, rtol=0, atol=1e-10 * unit)
        # In equilibrium nothing is left beyond the far end.
        assert np.abs(found._beam.end[k]).max() <= 1e-11 * scale * max(1.0, cut.length)


@pytest.mark.parametrize("name", list(CASES))
@pytest.mark.parametrize("quantity", NAMES)
def test_extremes_are_where_a_fine_grid_has_them(name: str, quantity: str) -> None:
    machine, link, along, density, q = CASES[name]
    speed: Any = 3.0 if np.ndim(q) == 1 else [3.0, -2.0]
    found = machine.internal_loads(link, q, speed, along=along, density=density, n=20001)
    values = getattr(found, quantity)
    extremes = found.extremes(quantity)
    tiny = 1e-12 * (1.0 + np.abs(values).max())
    slope = np.abs(np.diff(values, axis=1)).max()
    for exact, grid, sign in (
        (extremes.min, values.min(axis=1), 1.0),
        (extremes.max, values.max(axis=1), -1.0),
    ):
        assert (sign * (exact - grid) <= tiny).all()
        assert (np.abs(exact - grid) <= slope + tiny).all()
    for x, value in ((extremes.min_x, extremes.min), (extremes.max_x, extremes.max)):
        assert (x >= 0.0).all()
        assert (x <= found.x[-1]).all()
        near = [np.interp(a, found.x, row) for a, row in zip(x, values, strict=True)]
        assert (np.abs(near - value) <= 2.0 * slope + tiny).all()


def test_pins_are_the_ends() -> None:
    """At both ends the loads are the pins' forces: on the rod at A reversed, at B as they are."""
    machine = engine()
    q = np.array([0.4, 2.0])
    found, forces = machine.internal_loads("rod", q, 9.0), machine.reactions(q, 9.0)
    assert machine.mechanism is not None
    angle = machine.mechanism.solve(q).link("rod").value
    e = np.stack([np.cos(angle), np.sin(angle)], -1)
    for joint, end, sign in (("A", 0, -1.0), ("B", -1, 1.0)):
        force = forces.joint(joint, on="rod")
        np.testing.assert_allclose(found.axial[:, end], sign * (force * e).sum(axis=1))
        across = force[:, 1] * e[:, 0] - force[:, 0] * e[:, 1]
        np.testing.assert_allclose(found.shear[:, end], sign * across)


# -- shapes, peaks, refusals ----------------------------------------------------------------------


def test_shapes() -> None:
    machine = engine()
    one = machine.internal_loads("rod", 1.0, 3.0, n=7)
    assert (one.moment.shape, one.x.shape, one.q.shape) == ((7,), (7,), ())
    assert one.extremes("shear").min.shape == ()
    assert machine.internal_loads("rod", [1.0], 3.0, n=7).axial.shape == (1, 7)
    assert machine.internal_loads("rod", [], 3.0, n=7).axial.shape == (0, 7)
    two = robot().internal_loads("fore", [[0.3, -0.7]] * 4, [1.0, 2.0], n=3)
    assert (two.moment.shape, two.q.shape) == ((4, 3), (4, 2))
    assert two.peak("moment").q.tolist() == [0.3, -0.7]
    np.testing.assert_array_equal(
        one.moment, machine.internal_loads("rod", [1.0, 2.0], 3.0, n=7).moment[0]
    )


def test_a_spring_at_rest_has_no_direction() -> None:
    """Of length zero and without tension, as the core has it."""
    spring = Spring(("rod", (0.2, 0.0)), "A", 300.0, 0.2)
    found, bare = (one.internal_loads("rod", 1.0, 9.0) for one in (engine(spring), engine()))
    np.testing.assert_allclose(found.axial, bare.axial, atol=1e-10)
    short = engine(Spring("A", ("rod", (0.0, 0.0)), 300.0, 0.0))
    np.testing.assert_array_equal(short.internal_loads("rod", 1.0, 9.0).axial, bare.axial)


@pytest.mark.parametrize("off", [0.0, 1e-16, -1e-16, 1e-11])
def test_a_load_at_an_end_but_for_rounding(off: float) -> None:
    """It acts beyond the far end: what is given there is what holds just before it."""
    at_pin = engine(Force("B", (50.0, -700.0), on="rod")).internal_loads("rod", 1.0, 9.0, n=5)
    beside = engine(Force(("rod", (0.35 - off, 0.1)), (50.0, -700.0)))
    found = beside.internal_loads("rod", 1.0, 9.0, n=5)
    # Moved off the pin it also turns the rod; of its end only the couple is left.
    assert beside.mechanism is not None
    angle = float(beside.mechanism.solve(1.0).link("rod").value)
    along = 50.0 * math.cos(angle) - 700.0 * math.sin(angle)
    assert found.moment[-1] == pytest.approx(-0.1 * along, rel=1e-9)
    assert at_pin.moment[-1] == pytest.approx(0.0, abs=1e-12)
    assert np.abs(found._beam.end).max() < 1e-11


def test_peak_at_positions_only() -> None:
    """Speeds that differ, or coordinates in no order: nothing between is known."""
    machine, q = engine(), np.linspace(0.0, 3.0, 30)
    for where, speed in (
        (q, np.linspace(9.0, 9.0001, 30)),
        (q[::-1] * (-1.0) ** np.arange(30), 9.0),
    ):
        peak = machine.internal_loads("rod", where, speed).peak("moment")
        assert peak.q in where
    assert engine().internal_loads("rod", 1.0, 3.0).peak("shear").q == 1.0


def test_positions_without_a_motion() -> None:
    m = assur.FourBar(1.0, 2.0, 1.5, 3.6)
    machine = assur.Machine(m, bodies={"rocker": thin(2.0, 1.5)}, loads=[Gravity()])
    with pytest.raises(assur.PositionError):
        machine.internal_loads("rocker", [0.2, 3.0])
    found = machine.internal_loads("rocker", [0.2, 3.0], on_error="nan")
    assert np.isfinite(found.moment[0]).all()
    assert np.isnan(found.moment[1]).all()
    assert np.isnan(found.extremes("moment").max[1])
    assert found.peak("moment").q == 0.2
    assert machine.internal_loads("rocker", [-3.0, 0.2], on_error="nan").peak("shear").q == 0.2
    with pytest.raises(assur.InputError, match="no position"):
        machine.internal_loads("rocker", [3.0], on_error="nan").peak("moment")


ENGINE = engine()
BATCH = assur.Machine(assur.SliderCrank(0.1, [0.35, 0.4]))
OF_TABLE = assur.Machine.from_table([0.0, 3.0, math.tau], [0.0, 1.0, 0.0], 1.0)
NAN = math.nan


@pytest.mark.parametrize(
    ("machine", "given", "said"),
    [
        (ENGINE, {"link": "rods"}, "rods"),
        (ENGINE, {"link": 3}, "not a string"),
        (ENGINE, {"link": "ground"}, "'ground' is not a rod"),
        (ENGINE, {"link": "piston"}, "'piston' is not a rod"),
        (ENGINE, {"along": ("A", "O")}, "'O' is not"),
        (ENGINE, {"along": ("A", "A")}, "along"),
        (ENGINE, {"along": "A"}, "along"),
        (ENGINE, {"along": 3}, "along"),
        (ENGINE, {"along": ("A", NAN)}, "along"),
        (ENGINE, {"n": 1}, "n is 1"),
        (ENGINE, {"n": 2.5}, "n is"),
        (ENGINE, {"q": NAN}, "q"),
        (ENGINE, {"q": "now"}, "q is 'now'"),
        (ENGINE, {"speed": math.inf}, "speed"),
        (ENGINE, {"acceleration": [1.0, 2.0]}, "acceleration"),
        (ENGINE, {"on_error": "drop"}, "on_error"),
        (ENGINE, {"density": 3.0}, "density"),
        (ENGINE, {"density": ([0.0, 0.35], [3.0])}, "two lists"),
        (ENGINE, {"density": ([0.0, 0.3], [4.0, 4.0])}, "covers 0 to 0.3"),
        (ENGINE, {"density": ([0.0, 0.2, 0.1, 0.35], [4.0] * 4)}, "ascend"),
        (ENGINE, {"density": ([0.0, 0.35], [-4.0, 12.0])}, "negative"),
        (ENGINE, {"density": ([0.0, 0.35], [NAN, 12.0])}, "nan"),
        (ENGINE, {"density": ([0.0, 0.35], [3.0, 4.0])}, "the body of 'rod' has 1.2 kg"),
        (ENGINE, {"link": "crank", "density": ([0.0, 0.1], [3.0, 3.0])}, "'crank' has 0 kg"),
        (BATCH, {}, "design"),
        (OF_TABLE, {}, "table"),
        (engine(assur.Torque("rod", 3.0)), {}, "a Torque acts on 'rod'"),
        (engine(assur.TorsionSpring("crank", 3.0, on="rod")), {}, "a TorsionSpring"),
        (engine(assur.TorsionDamper("rod", 3.0)), {}, "a TorsionDamper"),
        (engine(Force(("rod", (0.5, 0.0)), (1.0, 0.0))), {}, "at 0.5 m along A–B"),
    ],
)
def test_refusals(machine: assur.Machine, given: dict[str, Any], said: str) -> None:
    with pytest.raises(assur.InputError, match=said):
        machine.internal_loads(**{"link": "rod", "q": 1.0, **given})


@pytest.mark.parametrize(
    "body", [Body(mass=1.2, inertia=0.015, at=(0.12, 0.0)), thin(1.2, 0.34), Body(mass=1.2)]
)
def test_a_body_that_is_no_thin_rod_is_refused(body: Body) -> None:
    machine = assur.Machine(assur.SliderCrank(0.1, 0.35), bodies={"rod": body})
    with pytest.raises(assur.InputError, match="the mass along its line"):
        machine.internal_loads("rod", 1.0)


def test_other_refusals() -> None:
    found = ENGINE.internal_loads("rod", 1.0)
    for ask in (found.extremes, found.peak):
        with pytest.raises(assur.InputError, match="quantity"):
            ask("torsion")
    with pytest.raises(assur.InputError, match="of is 'mean'"):
        found.peak("moment", of="mean")
    with pytest.raises(assur.MotionError):
        ENGINE.internal_loads("rod", 1.0, 1e200)
    with pytest.raises(assur.InputError, match="no position"):
        ENGINE.internal_loads("rod", []).peak("moment")
