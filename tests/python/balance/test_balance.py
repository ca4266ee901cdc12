"""Counterweights of four-bars and slider-cranks: published numbers, any names and places."""

from __future__ import annotations

import math
import random
from typing import Any

import numpy as np
import pytest

import assur
from assur import Body, balance
from oracles.dynamics.reaction_view import View

# Numbers are given to ten digits.
LAST = 6e-10
TURN = np.arange(60) * (math.tau / 60)


def same(found: Any, *wanted: float) -> None:
    np.testing.assert_allclose(np.ravel(found), wanted, rtol=LAST)


def polar(radius: float, angle: float) -> tuple[float, float]:
    return radius * math.cos(angle), radius * math.sin(angle)


def force(machine: assur.Machine, oracle: bool = False) -> float:
    """The greatest shaking force of a turn at changing speed."""
    find: Any = View(machine, TURN, 20.0, 5.0) if oracle else machine.reactions(TURN, 20.0, 5.0)
    return float(np.abs(find.shaking_force).max())


def four_bar() -> assur.Machine:
    bodies = {
        "crank": Body(mass=0.5, inertia=2e-4, at=polar(0.02, 0.3)),
        "coupler": Body(mass=1.2, inertia=3e-3, at=polar(0.08, 0.15)),
        "rocker": Body(mass=0.8, inertia=1.5e-3, at=polar(0.06, -0.2)),
    }
    return assur.Machine(assur.FourBar(0.05, 0.15, 0.12, 0.16), bodies=bodies)


def test_counterweights_of_a_four_bar() -> None:
    """Numbers worked by hand from Berkof and Lowen's equations, and the moment that remains."""
    machine = four_bar()
    crank, rocker = balance.four_bar(machine)
    assert (crank.link, crank.about, rocker.link, rocker.about) == ("crank", "A", "rocker", "D")
    same([crank.moment, crank.angle], 0.03795667738, 3.0934450203)
    same([rocker.moment, rocker.angle], 0.1229961265, -3.1258132848)
    after = machine.with_counterweights([crank.with_radius(0.04), rocker.with_radius(0.05)])
    q = np.radians([40.0, 130.0])
    same(after.reactions(q, 20.0, 0.0).shaking_moment, -5.49709331, 1.076717832)
    same(View(after, q, 20.0, 0.0).shaking_moment, -5.49709331, 1.076717832)
    assert force(after) <= 1e-12 * force(machine)
    assert force(after, oracle=True) <= 1e-12 * force(machine, oracle=True)


def chain(rng: random.Random, sliding: bool) -> assur.Machine:
    """A linkage with other names and orders, points off the lines, and centres anywhere."""
    crank, coupler, other, a, b, c, d = rng.sample(["p", "q", "Ω", "x-y", "7", "rod", "Z"], 7)
    turn = rng.uniform(0.0, math.tau)

    def place(x: float, y: float) -> tuple[float, float]:
        z = complex(x, y) * complex(math.cos(turn), math.sin(turn)) + complex(3.0, -2.0)
        return z.real, z.imag

    joints = {a: place(0.0, 0.0), b: place(0.3, 0.5), c: place(3.1, 1.4), "T": place(1.0, 2.0)}
    members = {crank: [a, b], coupler: [b, c, "T"], other: [c] if sliding else [c, d]}
    for joined in members.values():
        rng.shuffle(joined)
    links: dict[str, list[str]] = {"ground": [a]}
    slides = {}
    if sliding:
        guide = (other, "ground") if rng.random() < 0.5 else ("ground", other)
        slides["s"] = assur.Slide(*guide, angle=turn + rng.uniform(-0.2, 0.2))
    else:
        joints[d] = place(3.0, -0.8)
        links["ground"].append(d)
    links |= dict(rng.sample(list(members.items()), 3))
    bodies = {
        link: Body(
            mass=rng.uniform(0.1, 3.0), inertia=0.02, at=(rng.uniform(-1, 1), rng.uniform(-1, 1))
        )
        for link in members
        if rng.random() < 0.8
    }
    bodies[coupler] = Body(mass=1.0, inertia=0.1, at=rng.choice(["T", None, (0.4, -0.3)]))
    return assur.Machine(assur.Mechanism(joints, links, crank, slides=slides), bodies=bodies)


@pytest.mark.parametrize("seed", range(12))
def test_any_four_bar_is_balanced(seed: int) -> None:
    rng = random.Random(seed)
    machine = chain(rng, sliding=False)
    weights = [one.with_radius(rng.uniform(0.1, 2.0)) for one in balance.four_bar(machine)]
    after = machine.with_counterweights(weights)
    assert force(after) <= 1e-12 * force(machine)
    if seed < 2:
        assert force(after, oracle=True) <= 1e-12 * force(machine, oracle=True)


@pytest.mark.parametrize("seed", range(12))
def test_any_slider_crank_is_balanced_by_two_weights(seed: int) -> None:
    rng = random.Random(seed)
    machine = chain(rng, sliding=True)
    crank, rod = balance.slider_crank(machine, rod_radius=rng.uniform(0.1, 2.0))
    after = machine.with_counterweights([crank.with_mass(1.5), rod])
    assert force(after) <= 1e-12 * force(machine)
    if seed < 2:
        assert force(after, oracle=True) <= 1e-12 * force(machine, oracle=True)


@pytest.mark.parametrize(
    ("fraction", "greatest"),
    [(0.0, 4 / 3), (0.5, 5 / 6), (2 / 3, 0.7644043564), (0.611449341, 0.7218839918)],
)
def test_partly_balanced_engine(fraction: float, greatest: float) -> None:
    """The greatest force of a turn in parts of m ω² r, a rod of three cranks."""
    machine = assur.Machine(assur.SliderCrank(1.0, 3.0), bodies={"piston": Body(mass=1.0)})
    weights = balance.slider_crank(machine, fraction=fraction)
    after = machine.with_counterweights(one.with_radius(0.5) for one in weights)
    found = after.reactions(np.linspace(0.0, math.tau, 1441), 1.0).shaking_force
    size = np.hypot(found[:, 0], found[:, 1])
    # The grid misses the peak by half a step of curvature.
    assert size.max() == pytest.approx(greatest, rel=2e-5)
    parts = balance.rotating_parts(TURN, after.reactions(TURN, 1.0).shaking_force)
    assert parts.forward[1] == pytest.approx(abs(0.5 - fraction), abs=1e-14)
    assert parts.backward[1] == pytest.approx(0.5, abs=1e-14)


def test_half_is_the_least_mean_square() -> None:
    """Also with the rod's centre off its line, where the reciprocating mass is complex."""

    def rms(fraction: float) -> float:
        bodies = {
            "piston": Body(mass=1.0),
            "rod": Body(mass=0.6, inertia=0.1, at=(1.0, 0.7)),
            "crank": Body(mass=0.2),
        }
        machine = assur.Machine(assur.SliderCrank(1.0, 3.5), bodies=bodies)
        (weight,) = balance.slider_crank(machine, fraction=fraction)
        after = machine.with_counterweights([weight.with_radius(0.5)])
        return float(np.sqrt(np.mean(after.reactions(TURN, 1.0).shaking_force ** 2)))

    assert rms(0.5) < min(rms(0.49), rms(0.51))
    assert rms(0.49) == pytest.approx(rms(0.51), rel=1e-12)


@pytest.mark.parametrize(
    ("crank", "reciprocating", "rotating", "radius", "wanted", "digits"),
    [(0.15, 50.0, 37.0, 0.4, 26.38, 2), (0.09, 120.0, 70.0, 0.15, 90.0, 1)],
)
def test_published_partial_balance(
    crank: float,
    reciprocating: float,
    rotating: float,
    radius: float,
    wanted: float,
    digits: int,
) -> None:
    """Two examples of textbooks: two thirds of the reciprocating masses are balanced."""
    bodies = {"piston": Body(mass=reciprocating), "crank": Body(mass=rotating, at="A")}
    machine = assur.Machine(assur.SliderCrank(crank, 4 * crank), bodies=bodies)
    (weight,) = balance.slider_crank(machine, fraction=2 / 3)
    mass = weight.with_radius(radius).mass
    assert mass is not None
    assert mass == pytest.approx(wanted, abs=0.5001 * 10**-digits)
    assert weight.angle == math.pi


def test_published_residue_of_partial_balance() -> None:
    """At 30° and 250 rev/min, of the first harmonic: 3263.971 N in print, with π to few digits."""
    bodies = {"piston": Body(mass=120.0), "crank": Body(mass=70.0, at="A")}
    machine = assur.Machine(assur.SliderCrank(0.09, 0.36), bodies=bodies)
    (weight,) = balance.slider_crank(machine, fraction=2 / 3)
    after = machine.with_counterweights([weight.with_radius(0.15)])
    found = after.reactions(TURN, 250.0 * math.tau / 60.0).shaking_force
    parts = balance.rotating_parts(TURN, found, count=1)
    angle = math.radians(30.0)
    whole = parts.forward[1] * np.exp(1j * (parts.forward_angle[1] + angle))
    whole += parts.backward[1] * np.exp(1j * (parts.backward_angle[1] - angle))
    assert abs(whole) == pytest.approx(3264.065, abs=6e-4)
    assert abs(whole) == pytest.approx(3263.971, rel=5e-5)


def test_weights_count_as_bodies() -> None:
    """The composite is what two bodies are: the same as forces of a machine with one body each."""
    machine = four_bar()
    mechanism = machine.mechanism
    assert mechanism is not None
    weight = balance.Counterweight("coupler", 0.3, angle=2.0, about="C", mass=1.7)
    both = machine.with_counterweights([weight, balance.Counterweight("rocker", 0.0, mass=0.0)])
    coupler = mechanism.dimensions["coupler.length"]
    at = coupler + 0.3 / 1.7 * math.cos(2.0), 0.3 / 1.7 * math.sin(2.0)
    alone = assur.Machine(mechanism, bodies={"coupler": Body(mass=1.7, inertia=0.0, at=at)})
    found = [one.reactions(TURN, 20.0, 5.0) for one in (both, machine, alone)]
    for name in ("shaking_force", "shaking_moment", "driver"):
        whole, first, second = (getattr(one, name) for one in found)
        np.testing.assert_allclose(whole, first + second, rtol=0, atol=1e-12 * np.abs(whole).max())
    assert both.bodies["rocker"] == machine.bodies["rocker"]


def test_machine_keeps_loads_and_motor() -> None:
    loads, motor = [assur.Gravity()], assur.ConstantTorque(3.0)
    machine = assur.Machine(assur.SliderCrank(1.0, 3.0), bodies={}, loads=loads, motor=motor)
    after = machine.with_counterweights([balance.Counterweight("crank", 2.0, mass=1.0)])
    assert (after.loads, after.motor) == (machine.loads, machine.motor)
    assert dict(after.bodies) == {"crank": Body(mass=1.0, inertia=0.0, at=(2.0, 0.0))}


FOUR_BAR = four_bar()
ENGINE = assur.Machine(assur.SliderCrank(0.1, 0.35), bodies={"piston": Body(mass=1.0)})
BATCH = assur.Machine(assur.FourBar([0.04, 0.05], 0.15, 0.12, 0.16))
TABLE = assur.Machine.from_table([0.0, 3.0, math.tau], [0.0, 1.0, 0.0], 1.0)
NAN: Any = math.nan
TWO = assur.Mechanism(
    joints={"A": (0, 0), "B": (0.3, 1), "C": (1.4, 2), "D": (2.5, 0.9), "E": (2, 0)},
    links={"ground": "AE", "left": "AB", "l2": "BC", "l3": "CD", "right": "ED"},
    driver=["left", "right"],
)
THREE_AT_A_PIN = assur.Mechanism(
    joints={"A": (0, 0), "B": (1, 1), "C": (3, 2), "D": (4, 0), "E": (2, 4), "F": (5, 3)},
    links={"ground": "ADF", "crank": "AB", "l2": "BC", "l3": "DC", "l4": "CE", "l5": "FE"},
    driver="crank",
)


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: balance.four_bar(ENGINE), "not a four-bar"),
        (lambda: balance.slider_crank(FOUR_BAR), "not a slider-crank"),
        (lambda: balance.four_bar(assur.Machine(TWO)), "l2, l3, right"),
        (lambda: balance.four_bar(assur.Machine(THREE_AT_A_PIN)), "joint 'C' has 3 links"),
        (lambda: balance.four_bar(BATCH), "design"),
        (lambda: balance.four_bar(TABLE), "table"),
        (lambda: balance.four_bar(None), "None"),  # type: ignore[arg-type]
        (lambda: balance.slider_crank(ENGINE, fraction=NAN), "fraction"),
        (lambda: balance.slider_crank(ENGINE, fraction=-0.1), "fraction is -0.1"),
        (lambda: balance.slider_crank(ENGINE, fraction=0.5, rod_radius=0.1), "fraction is 0.5"),
        (lambda: balance.slider_crank(ENGINE, rod_radius=0.0), "rod_radius"),
        (lambda: balance.slider_crank(ENGINE, rod_radius=math.inf), "rod_radius"),
        (lambda: balance.Counterweight("rod", -1.0), "moment"),
        (lambda: balance.Counterweight("rod", 1.0, angle=NAN), "angle"),
        (lambda: balance.Counterweight("rod", 1.0, mass=0.0), "mass is 0"),
        (lambda: balance.Counterweight(3, 1.0), "not a string"),  # type: ignore[arg-type]
        (lambda: balance.Counterweight("rod", 1.0).with_mass(-1.0), "mass"),
        (lambda: balance.Counterweight("rod", 1.0).with_radius(NAN), "radius"),
        (lambda: ENGINE.with_counterweights([balance.Counterweight("rod", 1.0)]), "no mass"),
        (lambda: ENGINE.with_counterweights([balance.Counterweight("rods", 1.0)]), "rods"),
        (
            lambda: ENGINE.with_counterweights(
                [balance.Counterweight("rod", 1.0, angle=0, about="O", mass=1.0)]
            ),
            "about 'O'",
        ),
        (lambda: ENGINE.with_counterweights(["rod"]), "'rod' is not"),  # type: ignore[list-item]
        (lambda: ENGINE.with_counterweights(3), "sequence"),  # type: ignore[arg-type]
        (lambda: BATCH.with_counterweights([]), "design"),
        (lambda: TABLE.with_counterweights([]), "table"),
    ],
)
def test_refusals(call: Any, said: str) -> None:
    with pytest.raises(assur.InputError, match=said):
        call()
