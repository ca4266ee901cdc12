"""How things print: in a line, or in a small table."""

from __future__ import annotations

import pickle

import numpy as np

import assur
from assur import examples
from assur.description.structure import roman


def test_mobility_is_counted_term_by_term() -> None:
    for make in (examples.jansen_leg, examples.shaper, examples.excavator, examples.loom):
        structure = make().structure
        pairs = structure.turning_pairs + structure.sliding_pairs
        assert 3 * structure.moving_links - 2 * pairs == structure.mobility_counted


def test_a_structure_prints_as_a_table() -> None:
    lines = str(examples.loom().structure).splitlines()
    assert lines[0].endswith("class IV")
    assert "3·7 − 2·10 = 1" in lines[1]
    assert len(lines) == 4
    # Three cranks of a parallelogram: the third is redundant.
    joints = {"A": (0, 0), "B": (0, 1), "C": (1, 0), "D": (1, 1), "E": (2, 0), "F": (2, 1)}
    links = {"ground": "ACE", "crank": "AB", "rod": "BDF", "second": "CD", "third": "EF"}
    text = str(assur.Mechanism(joints, links, "crank", assembly={"D": 1}).structure)
    assert "by the rank of the closures it is 1" in text
    assert "redundant: " in text


def test_numerals() -> None:
    assert [roman(n) for n in (2, 3, 4, 5, 6, 9, 14)] == ["II", "III", "IV", "V", "VI", "IX", "XIV"]


def test_short_reprs() -> None:
    m = assur.FourBar(1.0, 3.0, 2.5, 3.2)
    assert "time ratio" in repr(m.extremes("rocker"))
    run = assur.Machine(m, bodies={"crank": assur.Body(inertia=1.0)}).run(1.0, 0.0, 1.0)
    assert repr(run.at(0.5)) == "<State t=0.5, q=0.5, speed=1, acceleration=0>"
    assert repr(run.at(np.array([0.1, 0.2]))) == "<State at 2 times>"


def test_an_assembly_shows_joints_in_which_it_differs() -> None:
    found = examples.loom().assemblies(examples.loom().q0)
    assert len(found) > 1
    shown = [repr(one) for one in found]
    assert len(set(shown)) == len(found)
    fixed = set(found[0].place.mechanism.links["ground"]) if found[0].place else {""}
    named = [part.partition("=(")[0] for part in shown[0].split(", ") if "=(" in part]
    assert len(named) == 2
    for name in named:
        assert name not in fixed
        assert len({one.joints[name] for one in found if one.joints}) > 1
    # A copy shows the same; one alone its last joint that moves.
    assert repr(pickle.loads(pickle.dumps(found[0]))) == shown[0]
    alone = examples.loom().assembly
    assert repr(alone) == "Assembly({})"


def test_motions_along_a_circuit_print_in_a_line() -> None:
    motion = assur.FourBar(3.0, 2.5, 2.0, 4.0).configuration_curve().motion(samples=90)
    assert repr(motion) == (
        "<assur.CircuitMotion of 179 positions, 2 branches, q = -1.37156 … 1.37156>"
    )


def test_equilibria_print_line_by_line() -> None:
    pendulum = assur.Mechanism(
        {"O": (0, 0), "A": (0.2, 0)}, {"ground": ["O"], "rod": ["O", "A"]}, "rod"
    )
    bob = {"rod": assur.Body(mass=3.0, at="A")}
    rest = assur.Machine(pendulum, bodies=bob, loads=[assur.Gravity()]).equilibria()
    assert repr(rest).splitlines() == [
        "<assur.Equilibria>",
        "q = -1.5708: stable, 7.00357 rad/s",
        "q = 1.5708: not stable",
    ]
    free = assur.Machine(pendulum, bodies=bob).equilibria()
    assert repr(free).splitlines()[1].endswith(": indifferent")
    pushed = assur.Machine(pendulum, bodies=bob, loads=[assur.Torque("rod", 5.0)]).equilibria()
    assert repr(pushed) == "<assur.Equilibria: none>"
