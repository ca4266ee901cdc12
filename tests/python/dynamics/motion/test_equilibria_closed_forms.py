"""Positions of rest whose coordinate, stability and frequency have a closed form."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

import assur
from assur import (
    Body,
    Damper,
    Force,
    Gravity,
    Machine,
    Spring,
    Torque,
    TorsionDamper,
    TorsionSpring,
)
from models.machines.every_load import missing
from models.machines.machines import four_bar

G = 9.81


def column(length: float = 0.5) -> assur.Mechanism:
    """A bar on a pin, drawn upright."""
    return assur.Mechanism(
        joints={"O": (0, 0), "A": (0, length), "B": (0, -length)},
        links={"ground": ["O"], "bar": ["O", "A", "B"]},
        driver="bar",
    )


def ladder(length: float, q: float) -> assur.Mechanism:
    """A bar that slides along both axes, driven by its angle (a trammel)."""
    return assur.Mechanism(
        joints={
            "O": (0, 0),
            "A": (length * math.cos(q), 0),
            "B": (0, length * math.sin(q)),
            "M": (length * math.cos(q) / 2, length * math.sin(q) / 2),
        },
        links={"ground": ["O"], "bar": ["B", "A", "M"], "foot": ["A"], "head": ["B"]},
        slides={
            "floor": assur.Slide("foot", on="ground", angle=0.0, origin="O"),
            "wall": assur.Slide("head", on="ground", angle=math.pi / 2, origin="O"),
        },
        driver="bar",
    )


def crank(radius: float = 0.3) -> assur.Mechanism:
    return assur.Mechanism(
        joints={"O": (0, 0), "A": (radius, 0)},
        links={"ground": ["O"], "crank": ["O", "A"]},
        driver="crank",
    )


def root(f: Any, low: float, high: float) -> float:
    return float(brentq(f, low, high, xtol=1e-16, rtol=1e-15))


def near(found: Any, wanted: Any, rtol: float = 1e-13) -> None:
    np.testing.assert_allclose(found, wanted, rtol=rtol, atol=rtol)


@pytest.mark.parametrize("excess", [9.0, 0.5, 1e-3, 1e-6, 1e-8])
def test_a_column_with_a_hinge_spring_buckles(excess: float) -> None:
    """k θ = P l sin θ: upright alone below P l = k, above it two more that lean (a pitchfork)."""
    k, length, mass = 3.0, 0.5, 2.0
    load = (1.0 + excess) * k / length
    bodies = {"bar": Body(mass=mass, at="A")}
    hinge = TorsionSpring("bar", k, angle=math.pi / 2)
    found = Machine(column(), bodies=bodies, loads=[hinge, Force("A", (0.0, -load))]).equilibria()
    lean = root(lambda x: (1.0 + excess) * math.sin(x) / x - 1.0, 1e-7, 3.0)
    near(found.q - math.pi / 2, [-lean, 0.0, lean], 1e-15 / excess + 1e-15)
    assert found.stable.tolist() == [True, False, True]
    stiffness = k - load * length * np.cos([lean, 0.0])
    near(found.stiffness[:2], stiffness, 1e-13 + 1e-15 / math.sqrt(excess))
    if excess > 1e-8:
        frequency = math.sqrt(stiffness[0] / mass) / length
        near(found.frequency, [frequency, math.nan, frequency], 1e-14 / excess + 1e-13)


@pytest.mark.parametrize("excess", [-0.5, -1e-6, 0.0])
def test_below_the_buckling_load_it_stays_upright(excess: float) -> None:
    k, length = 3.0, 0.5
    loads: list[Any] = [
        TorsionSpring("bar", k, angle=math.pi / 2),
        Force("A", (0.0, -(1.0 + excess) * k / length)),
    ]
    found = Machine(column(), bodies={"bar": Body(mass=2.0, at="A")}, loads=loads).equilibria()
    # At the buckling load V is of the fourth order: flat, still stable.
    # The moment is known to 1e-15 and its slope is the excess: so is the place.
    near(found.q, [math.pi / 2], 1e-4 if excess == 0.0 else 1e-15 / -excess + 1e-15)
    assert found.stable.tolist() == [True]
    near(found.frequency, [math.sqrt(-excess * k / 2.0) / length], 1e-4 if excess == 0 else 1e-8)


@pytest.mark.parametrize("force", [1.0, 30.0, 400.0])
def test_a_bar_on_two_guides_lifted_against_a_spring(force: float) -> None:
    """(1 − cos θ) tan θ = W/(2 k l), as in textbooks of statics (virtual work).

    A force W lifts the middle of the bar, and the spring pulls its foot back to where it lies flat.
    """
    k, length, mass = 80.0, 1.2, 2.5
    m = ladder(length, 0.7)
    spring = Spring("A", ("ground", (9.0, 0.0)), k, 9.0 - length)
    loads: list[Any] = [Force("M", (0.0, force)), spring]
    found = Machine(
        m, bodies={"bar": Body(mass=mass, inertia=mass * length**2 / 12, at="M")}, loads=loads
    ).equilibria(between=(-1.55, 0.0))
    ratio = force / (2 * k * length)
    theta = root(lambda x: (1 - math.cos(x)) * math.tan(x) - ratio, 1e-9, 1.5707963)
    # The bar goes from B to A, so its angle is −θ.
    near(found.q, [-theta], 1e-12)
    s, c = math.sin(theta), math.cos(theta)
    stiffness = force * length / 2 * s + k * length**2 * (c - c * c + s * s)
    near(found.stiffness, [stiffness], 1e-11)
    assert found.stable.tolist() == [True]
    # A bar on both guides: m l²/3 about its instant centre, wherever it is.
    near(found.frequency, [math.sqrt(stiffness / (mass * length**2 / 3))], 1e-11)


@pytest.mark.parametrize("free", [0.2, 0.5, 1.0, 1.6])
def test_a_toggle_spring(free: float) -> None:
    """A spring from the pin to a point: rest in line with it, and at the free length."""
    k, r, d, inertia = 500.0, 0.3, 0.9, 0.02
    spring = Spring("A", ("ground", (d, 0.0)), k, free)
    found = Machine(crank(r), bodies={"crank": Body(inertia=inertia)}, loads=[spring]).equilibria()
    wanted = [
        (0.0, k * (d - r - free) * r * d / (d - r)),
        (math.pi, -k * (d + r - free) * r * d / (d + r)),
    ]
    if d - r < free < d + r:
        side = math.acos((r * r + d * d - free * free) / (2 * r * d))
        stiffness = k * (r * d * math.sin(side) / free) ** 2
        wanted += [(side, stiffness), (-side, stiffness)]
    assert len(found.q) == len(wanted)
    for q, stiffness in wanted:
        away = np.abs(np.remainder(found.q - q + 1.0, math.tau) - 1.0)
        at = int(np.argmin(away))
        assert away[at] < 1e-13
        assert found.stable[at] == (stiffness > 0.0)
        near(found.stiffness[at], stiffness, 1e-11)
        frequency = math.sqrt(stiffness / inertia) if stiffness > 0.0 else math.nan
        near(found.frequency[at], frequency, 1e-11)


def test_a_mass_on_a_spring_is_driven_by_its_slide() -> None:
    k, mass, free = 200.0, 3.0, 0.5
    m = assur.Mechanism(
        joints={"O": (0, 0), "B": (0, -0.4)},
        links={"ground": ["O"], "block": ["B"]},
        slides={"rail": assur.Slide("block", on="ground", angle=-math.pi / 2, origin="O")},
        driver="rail",
    )
    machine = Machine(
        m, bodies={"block": Body(mass=mass)}, loads=[Gravity((0.0, -G)), Spring("O", "B", k, free)]
    )
    hangs = free + mass * G / k
    found = machine.equilibria(between=(0.1, 5.0))
    near(found.q, [hangs])
    near(found.frequency, [math.sqrt(k / mass)])
    near(found.stiffness, [k])
    # The ends of the range belong to it.
    assert machine.equilibria(between=(hangs, 5.0)).q.size == 1
    assert machine.equilibria(between=(0.1, hangs)).q.size == 1
    assert machine.equilibria(between=(hangs + 1e-9, 5.0)).q.size == 0


def test_a_pendulum_over_several_turns_and_at_the_seam_of_a_turn() -> None:
    bodies = {"crank": Body(mass=2.0, at="A")}
    for turned in (0.0, 0.5, 1e-17, math.pi / 2, math.pi, -3.0):
        gravity = (G * math.cos(turned), G * math.sin(turned))
        machine = Machine(crank(), bodies=bodies, loads=[Gravity(gravity)])
        found = machine.equilibria()
        assert found.q.shape == (2,)
        near(np.cos(found.q - turned), np.where(found.stable, 1.0, -1.0))
        near(found.frequency[found.stable], [math.sqrt(G / 0.3)])
        many = machine.equilibria(between=(turned - 10.0, turned + 10.0))
        near((many.q - turned) / math.pi, np.arange(-3, 4), 1e-14)
        assert many.stable.tolist() == [False, True, False, True, False, True, False]


def test_a_spring_that_balances_a_weight_leaves_it_indifferent() -> None:
    """V = m g l sin q + ½ k (l² + a² − 2 a l sin q) is constant if k a = m g."""
    mass, length, a = 2.0, 0.5, 0.8
    bodies = {"bar": Body(mass=mass, inertia=0.1, at="A")}
    for factor in (1.0, 1.0 + 1e-9):
        spring = Spring("A", ("ground", (0.0, a)), factor * mass * G / a, 0.0)
        found = Machine(
            column(length), bodies=bodies, loads=[Gravity((0.0, -G)), spring]
        ).equilibria()
        if factor == 1.0:
            assert found.q.size == 0
            near(found.indifferent, [[math.pi / 2 - math.pi, math.pi / 2 + math.pi]])
        else:
            near(np.abs(np.sin(found.q)), [1.0, 1.0])
            assert found.indifferent.shape == (0, 2)


def test_a_balanced_crank_is_indifferent() -> None:
    m = column(0.7)
    at_pin = Machine(m, bodies={"bar": Body(mass=3.0, at="O")}, loads=[Gravity()]).equilibria()
    no_load = Machine(m, bodies={"bar": Body(mass=3.0, at="A")}).equilibria()
    two = [Force("A", (3.1, -7.7)), Force("B", (3.1, -7.7))]
    both = Machine(m, bodies={"bar": Body(mass=3.0, at="O")}, loads=two).equilibria()
    for found in (at_pin, no_load, both):
        assert found.q.size == found.stable.size == found.frequency.size == 0
        near(found.indifferent, [[-math.pi / 2, 3 * math.pi / 2]])


def test_without_equilibrium_nothing_is_listed() -> None:
    found = Machine(
        crank(), bodies={"crank": Body(mass=1.0, at="A")}, loads=[Torque("crank", 5.0)]
    ).equilibria()
    assert found.q.shape == found.stable.shape == found.frequency.shape == (0,)
    assert found.indifferent.shape == (0, 2)


@pytest.mark.parametrize("part", [1.0 - 1e-6, 1.0, 1.0 + 1e-6])
def test_a_moment_that_only_just_holds_the_weight(part: float) -> None:
    """m g l cos q = M: two positions, one where they meet, then none."""
    weight = Body(mass=2.0, at="A")
    machine = Machine(
        crank(),
        bodies={"crank": weight},
        loads=[Gravity((0.0, -G)), Torque("crank", part * 2.0 * G * 0.3)],
    )
    found = machine.equilibria()
    if part > 1.0:
        assert found.q.size == 0
    elif part < 1.0:
        near(found.q, [-math.acos(part), math.acos(part)], 1e-9)
        # The moment left falls through zero where the pin rises faster: on the way up.
        assert found.stable.tolist() == [True, False]
    else:
        assert found.stable.tolist() == [False]
        near(found.q, [0.0], 1e-7)


def test_rest_at_change_points() -> None:
    """A parallelogram pulled along its ground rests where all its links are in line."""
    m = assur.FourBar(1.0, 3.0, 1.0, 3.0)
    pulled = Machine(m, bodies={"coupler": Body(mass=2.0, inertia=0.3)}, loads=[Gravity((-G, 0.0))])
    found = pulled.equilibria(between=(-1.0, 5.5))
    near(found.q, [0.0, math.pi], 1e-12)
    assert found.stable.tolist() == [False, True]
    near(found.frequency[1], math.sqrt(G), 1e-9)
    hung = Machine(m, bodies={"coupler": Body(mass=2.0, inertia=0.3)}, loads=[Gravity((0.0, -G))])
    found = hung.equilibria(between=(-2.0, 2.0))
    near(found.q, [-math.pi / 2, math.pi / 2], 1e-12)
    assert found.stable.tolist() == [True, False]


def test_tables_count_and_functions_do_not() -> None:
    table = assur.Table([0.0, 2.0, 3.0, 5.0, math.tau], [1.0, 1.0, -2.0, 1.0, 1.0], spline="linear")
    found = Machine(
        crank(), bodies={"crank": Body(inertia=0.5)}, loads=[Torque("crank", table)]
    ).equilibria(between=(0.0, math.tau))
    near(found.q, [2.0 + 1.0 / 3.0, 3.0 + 4.0 / 3.0])
    assert found.stable.tolist() == [True, False]
    near(found.frequency[0], math.sqrt(3.0 / 0.5))
    # Zero over a part of the turn: an interval of indifferent rest.
    flat = assur.Table([0.0, 2.0, 3.0, 5.0, math.tau], [0.0, 0.0, -2.0, 1.0, 0.0], spline="linear")
    found = Machine(
        crank(), bodies={"crank": Body(inertia=0.5)}, loads=[Torque("crank", flat)]
    ).equilibria(between=(-0.5, 6.0))
    near(found.q, [3.0 + 4.0 / 3.0])
    near(found.indifferent, [[0.0, 2.0]], 1e-6)


def test_a_machine_of_tables() -> None:
    phi = np.linspace(0.0, math.tau, 200)
    machine = Machine.from_table(phi, -10 * np.sin(phi), np.full(200, 2.0), spline="periodic")
    found = machine.equilibria()
    near(np.sort(np.remainder(found.q + 1e-6, math.tau)), [1e-6, math.pi + 1e-6], 1e-9)
    assert found.stable[np.argmin(np.abs(found.q - math.pi))] == np.False_
    near(found.frequency[found.stable], [math.sqrt(5.0)], 1e-5)


def test_a_motor_and_dampers_are_no_load_but_the_rotor_is_inertia() -> None:
    bodies, loads = {"crank": Body(mass=2.0, at="A")}, [Gravity((G, 0.0))]
    plain = Machine(crank(), bodies=bodies, loads=loads).equilibria()
    damped: list[Any] = [
        *loads,
        assur.TorsionDamper("crank", 3.0),
        assur.Damper("A", ("ground", (1, 1)), 9.0),
    ]
    driven = Machine(
        crank(),
        bodies=bodies,
        loads=damped,
        motor=assur.LinearMotor(5.0, 20.0, ratio=2.0, rotor_inertia=0.045),
    ).equilibria()
    near(driven.q, plain.q)
    near(driven.frequency, plain.frequency / math.sqrt(2.0))


def test_without_inertia_there_is_no_frequency() -> None:
    found = Machine(crank(), bodies={}, loads=[Force("A", (1.0, 0.0))]).equilibria()
    assert found.stable.sum() == 1
    assert np.isnan(found.frequency).all()
    near(found.stiffness[found.stable], [0.3])


def test_a_spring_whose_length_goes_through_zero_is_refused_there() -> None:
    """Its force turns round at once: the moment jumps, and no position there is one of rest."""
    spring = Spring("A", ("ground", (0.3, 0.0)), 100.0, 0.2)
    machine = Machine(crank(), bodies={"crank": Body(mass=1.0, at="A")}, loads=[spring])
    with pytest.raises(assur.MotionError, match=r"jump at q = .*between="):
        machine.equilibria()
    found = machine.equilibria(between=(0.1, 6.0))
    free = 2 * math.asin(0.2 / 0.6)
    near(found.q, [free, math.pi, math.tau - free])
    assert found.stable.tolist() == [True, False, True]


def test_gaps_between_positions_of_rest() -> None:
    """A driver that cannot turn fully: nothing beyond its dead points, and all between them."""
    m = assur.FourBar(2.0, 1.7, 1.5, 3.0)
    bodies = {
        "coupler": Body(mass=2.0, inertia=0.1, at=(0.8, 0.3)),
        "rocker": Body(mass=1.0, inertia=0.1, at=(0.5, 0.1)),
    }
    for angle in np.linspace(0.0, 6.0, 13):
        gravity = Gravity((G * math.cos(angle), G * math.sin(angle)))
        machine = Machine(m, bodies=bodies, loads=[gravity, Spring("A", "C", 9.0, 1.0)])
        found = machine.equilibria()
        grid = m.q0 + np.linspace(-math.pi, math.pi, 20001)
        moment = machine.reduced_moment(grid, on_error="nan")
        assert np.isnan(moment).any()
        changes = np.flatnonzero(moment[:-1] * moment[1:] < 0.0)
        assert len(found.q) == len(changes)
        assert ((grid[changes] <= found.q) & (found.q <= grid[changes + 1])).all()


def test_stiffness_of_every_load() -> None:
    """Against differences of the moment, of the fourth order, at any position of rest."""
    bodies = {
        "crank": Body(mass=3.0, inertia=0.4, at=(0.3, 0.2)),
        "coupler": Body(mass=2.0, inertia=0.5, at=(1.1, 0.4)),
    }
    table = assur.Table([0.0, 2.0, 4.0, math.tau], [1.0, 4.0, -3.0, 1.0], spline="periodic")
    each: list[Any] = [
        Force("P", (11.0, -4.0), axes="coupler"),
        Force(("rocker", (0.3, 0.9)), (table, 5.0)),
        Force("P", (table, -4.0), axes="rocker"),
        Torque("coupler", 3.0, on="rocker"),
        Torque("rocker", table),
        Spring("P", "D", 30.0, 0.4, preload=2.0),
        Spring("P", "D", 30.0, 0.0),
        TorsionSpring("coupler", 8.0, angle=0.3, on="rocker", preload=2.0),
        Damper("P", "D", 30.0),
        TorsionDamper("coupler", 8.0, on="rocker"),
    ]
    # Weight is in each machine; pressures are in test_pressures.py.
    assert missing(each) == {"Gravity", "Pressure"}
    for load in each:
        machine = Machine(four_bar(), bodies=bodies, loads=[load, Gravity()])
        offset = -float(machine.reduced_moment(0.7))
        machine = Machine(
            four_bar(), bodies=bodies, loads=[load, Gravity(), Torque("crank", offset)]
        )
        found = machine.equilibria(between=(0.2, 1.2))
        at = int(np.argmin(np.abs(found.q - 0.7)))
        near(found.q[at], 0.7, 1e-12)
        h = 1e-3
        m = machine.reduced_moment(0.7 + h * np.arange(-2, 3))
        slope = (m[0] - 8 * m[1] + 8 * m[3] - m[4]) / (12 * h)
        near(found.stiffness[at], -slope, 1e-8 * max(1.0, abs(slope)))
        inertia = float(machine.reduced_inertia(0.7).value)
        if found.stable[at]:
            near(found.frequency[at], math.sqrt(-slope / inertia), 1e-8)


def five_bar_machine() -> Machine:
    from models.machines.machines import five_bar

    return Machine(five_bar(), bodies={"b1": Body(mass=1.0)})


def driven_slide() -> Machine:
    from models.machines.machines import cylinder

    return Machine(cylinder(), bodies={"arm": Body(mass=1.0)}, loads=[Gravity()])


REFUSED: list[tuple[Any, Any, str]] = [
    (five_bar_machine, None, "2 drivers"),
    (driven_slide, None, 'slide "ram".*between='),
    (
        lambda: Machine(crank().with_dimensions({"crank.length": [0.2, 0.3]}), bodies={}),
        None,
        r"shape \(2,\).*design\(index\)",
    ),
    (lambda: Machine(crank(), bodies={}, loads=[Torque("crank", math.hypot)]), None, "function of"),
    (lambda: Machine(crank()), (1.0, 0.0), "between is"),
    (lambda: Machine(crank()), (1.0, 1.0), "between is"),
    (lambda: Machine(crank()), (math.nan, 1.0), "between is"),
    (lambda: Machine(crank()), (0.0, math.inf), "between is"),
    (lambda: Machine(crank()), (0.0, 1e9), "at most 100"),
    (lambda: Machine(crank()), [], "between is"),
    (lambda: Machine(crank()), 3.0, "between is"),
    (lambda: Machine(crank()), "turn", "between is"),
    (lambda: Machine(crank()), (0.0, 1.0, 2.0), "between is"),
]


@pytest.mark.parametrize(("make", "between", "message"), REFUSED)
def test_what_has_no_equilibria_is_refused(make: Any, between: Any, message: str) -> None:
    with pytest.raises(assur.InputError, match=message):
        make().equilibria(between=between)


def test_a_range_without_positions_names_the_dyad() -> None:
    machine = driven_slide()
    with pytest.raises(assur.PositionError, match="dyad"):
        machine.equilibria(between=(50.0, 60.0))


def test_a_range_without_a_moment_is_refused() -> None:
    table = assur.Table([5.0, 6.0], [1.0, 2.0], spline="linear", periodic=False)
    machine = Machine(
        four_bar(), bodies={"coupler": Body(mass=1.0)}, loads=[Torque("crank", table)]
    )
    with pytest.raises(assur.MotionError, match=r"no finite moment from q = 0 to 1: a table"):
        machine.equilibria(between=(0.0, 1.0))
    great = Machine(
        crank(), bodies={"crank": Body(mass=1e300, at="A")}, loads=[Gravity((0.0, -1e10))]
    )
    with pytest.raises(assur.MotionError, match="too great"):
        great.equilibria()


@pytest.mark.parametrize("size", [1e-150, 1e-3, 1.0, 1e6, 1e150])
def test_the_size_of_a_mechanism_does_not_matter(size: float) -> None:
    machine = Machine(
        assur.FourBar(size, 3.0 * size, 2.5 * size, 3.0 * size),
        bodies={"coupler": Body(mass=1.0)},
        loads=[Gravity((0.3, -1.0))],
    )
    found = machine.equilibria()
    near(found.q, np.arctan2([-1.0, 1.0], [0.3, -0.3]))
    near(found.stiffness / size, [math.hypot(0.3, 1.0), -math.hypot(0.3, 1.0)])
    near(found.frequency[0] * math.sqrt(size), math.sqrt(math.hypot(0.3, 1.0)))
