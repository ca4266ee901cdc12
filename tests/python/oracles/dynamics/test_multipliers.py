"""The oracle of reactions, against closed forms: dyads, power, shaking forces, redundant links."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import assur
from assur import Body
from models.machines.reaction_machines import reaction_case, redundant_reaction_case
from oracles.dynamics.body_places import cross, dot
from oracles.dynamics.multipliers import Reactions, unit_roundoff

CLOSE = 1e-12  # of the largest force: a few operations at conditions of some ten
# Of the float64 oracle against itself at 50 digits, in u κ of the largest force; 2 were seen.
SHARE = 16.0

# Where B, C, D are: bodies a and b of each dyad on a crank O-B, the guides slanted.
JOINTS = {"O": (0.0, 0.0), "B": (0.4, 0.9), "C": (2.1, 1.7), "D": (2.9, -0.2)}
U1, U2 = 0.35, 1.9


def dyad(kind: str) -> assur.Mechanism:
    """A crank and one dyad of links a, b."""
    links: dict[str, Any] = {"ground": ["O"], "crank": ["O", "B"]}
    slides: dict[str, assur.Slide] = {}
    if kind == "RRR":
        links |= {"ground": ["O", "D"], "a": ["B", "C"], "b": ["D", "C"]}
    elif kind == "RRP":
        links |= {"a": ["B", "C"], "b": ["C"]}
        slides["s"] = assur.Slide("b", on="ground", angle=U1)
    elif kind == "RPR":
        links |= {"ground": ["O", "D"], "a": ["B"], "b": ["D"]}
        slides["s"] = assur.Slide("b", on="a", angle=U1, origin="B")
    elif kind == "PRP":
        links |= {"a": ["C"], "b": ["C"]}
        slides["s1"] = assur.Slide("a", on="crank", angle=U1)
        slides["s2"] = assur.Slide("b", on="ground", angle=U2)
    else:
        links |= {"a": ["B"], "b": ["C"]}
        slides["i"] = assur.Slide("a", on="b", angle=U1)
        slides["e"] = assur.Slide("b", on="ground", angle=U2)
    used = {j for own in links.values() for j in own}
    joints = {n: p for n, p in JOINTS.items() if n in used}
    return assur.Mechanism(joints, links, driver="crank", slides=slides)


class Known:
    """Loads of a dyad: net forces and moments of its links, as the closed forms want them."""

    def __init__(self, kind: str) -> None:
        bodies = {
            "crank": Body(mass=1.3, inertia=0.2, at=(0.3, 0.1)),
            "a": Body(mass=0.9, inertia=0.15, at=(0.6, -0.3)),
            "b": Body(mass=1.7, inertia=0.4, at=(-0.2, 0.5)),
        }
        loads: list[Any] = [
            assur.Gravity((1.1, -9.0)),
            assur.Force(("a", (0.2, 0.4)), (-7.0, 5.0)),
            assur.Force(("b", (0.5, -0.7)), (3.0, 11.0)),
            assur.Torque("a", 4.0),
            assur.Torque("b", -6.0, on="crank"),
        ]
        m = dyad(kind)
        self.found = Reactions(
            assur.Machine(m, bodies=bodies, loads=loads), float(m.q0) + 0.1, 2.5, -4.0
        )
        self.force, self.couple = self.found.reduced([*self.found.loads, *self.found.inertia])
        self.places = self.found.places
        self.at = self.places.joints

    def moment(self, link: str, place: complex) -> float:
        """Net moment about a place."""
        arm = self.places.reference[link] - place
        return float(self.couple[link] + cross(arm, self.force[link]))

    def on(self, joint: str, link: str) -> complex:
        return self.found.joint(joint, link)

    def agree(self, *pairs: tuple[Any, Any]) -> None:
        scale = self.found.largest() * max(1.0, self.places.size)
        for found, formula in pairs:
            assert abs(complex(found) - complex(formula)) <= CLOSE * scale, (found, formula)


def test_rrr() -> None:
    """Both moments give the force at the inner pin; forces give the outer ones."""
    k = Known("RRR")
    b, c, d = (k.at[j] for j in "BCD")
    p, h = c - b, c - d
    force = (k.moment("a", b) * h + k.moment("b", d) * p) / cross(p, h)
    k.agree(
        (k.on("C", "b"), force),
        (k.on("B", "a"), force - k.force["a"]),
        (k.on("D", "b"), -force - k.force["b"]),
    )


def test_rrp() -> None:
    """b slides along u: the forces along u and a's moment about its outer pin."""
    k = Known("RRP")
    p, u = k.at["C"] - k.at["B"], k.places.guide["s"]
    n = 1j * u
    along = dot(k.force["b"], u)
    across = (k.moment("a", k.at["B"]) + along * cross(p, u)) / dot(p, u)
    force = -along * u + across * n
    k.agree(
        (k.on("C", "b"), force),
        (k.on("B", "a"), force - k.force["a"]),
        (k.found.normal("s"), -dot(k.force["b"], n) - across),
        (k.found.moment("s"), -k.moment("b", k.at["C"])),
    )


def test_rpr() -> None:
    """a at B carries the guide of b at D: the moment of both about B gives the normal force."""
    k = Known("RPR")
    b, d, u = k.at["B"], k.at["D"], k.places.guide["s"]
    normal = (k.moment("a", b) + k.moment("b", d)) / dot(d - b, u)
    k.agree(
        (k.found.normal("s"), normal),
        (k.found.moment("s"), -k.moment("b", d)),
        (k.on("D", "b"), -k.force["b"] - normal * 1j * u),
        (k.on("B", "a"), -k.force["a"] + normal * 1j * u),
    )


def test_prp() -> None:
    """Two guides meet in a pin: the forces along each."""
    k = Known("PRP")
    u1, u2 = k.places.guide["s1"], k.places.guide["s2"]
    a, b = dot(k.force["a"], u1), dot(k.force["b"], u2)
    force = -(a * 1j * u2 + b * 1j * u1) / cross(u1, u2)
    k.agree(
        (k.found.moment("s1"), -k.moment("a", k.at["C"])),
        (k.found.moment("s2"), -k.moment("b", k.at["C"])),
        (k.on("C", "b"), force),
    )


def test_rpp() -> None:
    """a at B slides on b, b on the carrier: the forces on b along the outer guide."""
    k = Known("RPP")
    inner, outer = k.places.guide["i"], k.places.guide["e"]
    normal = -dot(k.force["b"], outer) / cross(inner, outer)  # of a on b, along the inner guide's n
    k.agree(
        (-k.found.normal("i"), normal),
        (k.found.moment("i"), -k.moment("a", k.at["B"])),
    )


@pytest.mark.parametrize("seed", range(12))
def test_random_machines(seed: int) -> None:
    """Power, the ground's share, velocities of the library; float64 against 50 digits."""
    case = reaction_case(seed)
    q, speed, acceleration = case.position(seed % 2)
    found = Reactions(case.machine, q, speed, acceleration)
    exact = Reactions(case.machine, q, speed, acceleration, exact=True)
    m, u = case.mechanism, unit_roundoff()
    kappa, largest, size = float(m.solve(q).condition), exact.largest(), exact.places.size
    for row, one, two in zip(found.rows, found.multipliers, exact.multipliers, strict=True):
        unit = size if row.turns else 1.0
        assert abs(one - float(two)) <= SHARE * u * kappa * largest * unit
    # the drivers' power is what loads and inertia take
    power = sum(exact.driver(k) * float(v) for k, v in enumerate(exact.speed))
    for w in (*exact.loads, *exact.inertia):
        arm = w.place - exact.places.reference[w.link]
        velocity = exact.velocity[w.link] + 1j * exact.spin[w.link] * arm
        power += float(dot(w.force, velocity) + w.couple * exact.spin[w.link])
    assert abs(power) <= CLOSE * largest * size * float(np.abs(exact.speed).max()) * kappa
    # the ground takes the shaking force and the loads on moving links
    force, couple = exact.on_ground()
    shaking, moment = exact.shaking
    for w in exact.loads:
        if w.link != "ground":
            force, couple = force - complex(w.force), couple - float(cross(w.place, w.force))
            couple -= float(w.couple)
    reach = max(abs(complex(p)) for p in exact.places.reference.values()) + size
    assert abs(force - shaking) <= CLOSE * largest
    assert abs(couple - moment) <= CLOSE * largest * reach
    for link in exact.moving:
        d1 = m.solve(q, order=1).link(link).d1.reshape(-1)
        assert abs(d1 @ exact.speed - float(exact.spin[link])) <= 1e-10 * kappa**2


def test_accelerations() -> None:
    """By the library's second analogues."""
    for seed in range(12):
        case = reaction_case(seed)
        q, speed, acceleration = case.position(1)
        found = Reactions(case.machine, q, speed, acceleration)
        m = case.mechanism
        motion = m.solve(q, order=2)
        kappa = float(motion.condition)
        for link, own in m.links.items():
            if link == "ground" or not own:
                continue
            track = motion.joint(own[0])
            expected = np.asarray(track.acceleration(speed, acceleration)) @ [1, 1j]
            scale = 1.0 + abs(expected)
            assert abs(found.second[link] - expected) <= 1e-12 * kappa**3 * scale, (seed, link)


def test_three_cranks() -> None:
    """One crank too many: along the cranks 1 : −2 : 1, driver and components across are known."""
    places = {"A": (0, 0), "B": (1, 0), "C": (2, 0)}
    tip = (0.3 * math.cos(0.7), 0.3 * math.sin(0.7))
    joints = places | {n.lower(): (x + tip[0], y + tip[1]) for n, (x, y) in places.items()}
    cranks = {f"crank{n}": [n, n.lower()] for n in "ABC"}
    links = {"ground": list("ABC"), "rod": list("abc")} | cranks
    m = assur.Mechanism(joints, links, driver="crankA")
    machine = assur.Machine(
        m, bodies={"rod": Body(mass=2.0, inertia=0.1, at=(0.7, 0.2))}, loads=[assur.Gravity()]
    )
    found = Reactions(machine, m.q0, 3.0, 1.0)
    assert found.self_stress.shape[0] == 1
    along = complex(*tip) / 0.3
    stress = [found.pin_force(j, "rod", found.self_stress[0]) for j in "abc"]
    for value, share in zip(stress, (1.0, -2.0, 1.0), strict=True):
        assert abs(value - share * stress[0]) < CLOSE
        assert abs(cross(along, value)) < CLOSE
    assert found.driver_is_determined()
    assert not found.joint_is_determined("b", "rod")


@pytest.mark.parametrize("seed", range(6))
def test_redundant(seed: int) -> None:
    """Equilibrium holds with self-stress of any size added."""
    case = redundant_reaction_case(seed)
    found = Reactions(case.machine, *case.position(0))
    assert found.self_stress.shape[0] >= 1
    force, couple = found.unbalanced()
    bound = 1e-10 * found.largest() * max(found.places.size, 1.0)
    assert max(abs(force[n]) for n in found.moving) < bound
    assert max(abs(couple[n]) for n in found.moving) < bound
