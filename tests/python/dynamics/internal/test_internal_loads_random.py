"""Loads inside the links of random machines of all classes, beside cuts of the oracle's rods."""

from __future__ import annotations

import random
from typing import Any

import numpy as np

import assur
from assur import Body, Torque, TorsionDamper, TorsionSpring
from models.machines.reaction_machines import Case, reaction_case
from models.mechanisms.mechanism_data import GROUND
from oracles.dynamics.cut_rod import CutRod
from oracles.dynamics.multipliers import unit_roundoff

SEEDS = 40
# As the reactions, in u κ of the largest force; moments by the machine's size.
LIMIT = 64.0
WITHOUT_A_PLACE = Torque | TorsionSpring | TorsionDamper


def place(m: assur.Mechanism, link: str, joint: str) -> complex:
    first, second, *_ = m.links[link]
    if joint == first:
        return 0j
    if joint == second:
        return complex(m.dimensions[f"{link}.length"])
    return complex(m.dimensions[f"{link}.{joint}.x"], m.dimensions[f"{link}.{joint}.y"])


def rods(case: Case) -> Any:
    """Each link with a thin rod between two of its joints, and loads that have a place."""
    m, rng = case.mechanism, random.Random(f"rods {case.seed}")
    loads = [one for one in case.machine.loads if not isinstance(one, WITHOUT_A_PLACE)]
    for link, joints in m.links.items():
        if link == GROUND or len(joints) < 2:
            continue
        along = rng.sample(list(joints), 2)
        a, b = (place(m, link, joint) for joint in along)
        mass, middle = case.machine.bodies[link].mass, (a + b) / 2
        body = Body(mass=mass, inertia=mass * abs(b - a) ** 2 / 12, at=(middle.real, middle.imag))
        yield link, along, assur.Machine(m, bodies={**case.machine.bodies, link: body}, loads=loads)


def compare(case: Case, link: str, along: Any, machine: assur.Machine) -> float:
    """The greatest difference at all positions, in u κ of the largest force."""
    found = machine.internal_loads(link, case.q, case.speed, case.acceleration, along=along, n=9)
    condition = case.mechanism.solve(case.q).condition
    worst = 0.0
    for k in range(len(case.q)):
        cut = CutRod(machine, link, along, *case.position(k))
        density = [0.0, cut.length], [machine.bodies[link].mass / cut.length] * 2
        axial, shear, moment = np.transpose([cut.at(float(x), density) for x in found.x])
        off = [found.axial[k] - axial, found.shear[k] - shear]
        off += [(found.moment[k] - moment) / cut.of.places.size, found._beam.end[k, :2]]
        off += [found._beam.end[k, 2:] / cut.of.places.size]
        unit = unit_roundoff() * float(condition[k]) * cut.of.largest()
        worst = max(worst, *(float(np.abs(one).max()) / unit for one in off))
    return worst


def share(case: Case, link: str, along: Any, machine: assur.Machine) -> float | None:
    """What `compare` gives; None where something acts beyond the rod's ends or has no place."""
    try:
        return compare(case, link, along, machine)
    except assur.InputError as error:
        if "outside its length" in str(error) or "where it acts" in str(error):
            return None
        raise


def test_rods_of_random_machines() -> None:
    cases = [reaction_case(seed) for seed in range(SEEDS)]
    every = [share(case, *rod) for case in cases for rod in rods(case)]
    shares = [one for one in every if one is not None]
    assert len(shares) > 0.5 * len(every) > 100
    assert max(shares) <= LIMIT
