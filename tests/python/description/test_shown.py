"""How things print: in a line, or in a small table."""

from __future__ import annotations

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
