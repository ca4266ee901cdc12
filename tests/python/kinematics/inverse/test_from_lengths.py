"""Mechanisms from a rough sketch and lengths."""

from __future__ import annotations

import math
from functools import partial
from itertools import combinations
from typing import Any

import numpy as np
import pytest

import assur
from assur import examples
from models.errors.refusals import refused

SKETCH = {"A": (0, 0), "B": (0.2, 1), "C": (3, 2.2), "D": (3.1, 0), "P": (2, 3)}
LINKS = {"ground": "AD", "crank": "AB", "coupler": "BCP", "rocker": "DC"}


def made(lengths: Any, sketch: Any = None) -> assur.Mechanism:
    return assur.Mechanism.from_lengths(sketch or SKETCH, LINKS, "crank", lengths)


def test_distances_are_those_given() -> None:
    lengths = {"AD": 3.2, "AB": 1.0, "BC": 3.0, "BP": 2.0, ("P", "C"): 1.5, "CD": 2.5}
    m = made(lengths)
    for (one, other), length in lengths.items():
        gap = np.subtract(m.joints[one], m.joints[other])
        assert np.hypot(*gap) == pytest.approx(length, rel=1e-14)
    # P lies to the left of B-C, as sketched; and to the right with another sketch.
    assert m.dimensions["coupler.P.y"] > 0.0
    right = made(lengths, {**SKETCH, "P": (2, 1)})
    assert right.dimensions["coupler.P.y"] == pytest.approx(-m.dimensions["coupler.P.y"])


def test_what_is_not_given_remains() -> None:
    plain = assur.Mechanism(SKETCH, LINKS, "crank")
    m = made({"DC": 2.4})
    for name, value in plain.dimensions.items():
        wanted = 2.4 if name == "rocker.length" else value
        assert m.dimensions[name] == pytest.approx(wanted, rel=1e-15)


def test_a_rough_sketch_of_a_loom_finds_its_assembly() -> None:
    """All distances of the true drawing, from joints that are off by up to a tenth."""
    true = examples.loom()
    names = list(true.joints)
    at = {name: np.array(true.joints[name]) for name in names}
    random = np.random.default_rng(3)
    rough = {name: tuple(at[name] + random.uniform(-0.1, 0.1, 2)) for name in names}
    rough["1"], rough["2"] = tuple(at["1"]), tuple(at["2"])
    lengths = {
        pair: float(np.hypot(*(at[pair[0]] - at[pair[1]])))
        for on in true.links.values()
        for pair in combinations(on, 2)
    }
    rough |= {name: tuple(at[name]) for name in true.links["ground"]}
    m = assur.Mechanism.from_lengths(rough, dict(true.links), "crank", lengths)
    found = m.solve(true.q0)
    for name in names:
        np.testing.assert_allclose(found[name], at[name], rtol=0.0, atol=1e-9)


def test_refusals() -> None:
    refused(assur.InputError, "B D link", partial(made, {"BD": 1.0}))
    refused(assur.InputError, "pair", partial(made, {"BCP": 1.0}))
    refused(assur.InputError, "Z", partial(made, {"BZ": 1.0}))
    refused(assur.InputError, "B-C positive", partial(made, {"BC": -1.0}))
    refused(assur.InputError, "mapping", partial(made, [1.0]))
    refused(assur.InputError, "coupler triangle", partial(made, {"BC": 3.0, "BP": 1.0, "CP": 1.0}))
    joints = {**SKETCH, "Q": (2, 2)}
    links = {**LINKS, "coupler": "BCPQ"}
    lengths = {"BC": 3.0, "BP": 2.0, "CP": 1.5, "BQ": 2.0, "CQ": 1.5, "PQ": 0.7}
    ask = partial(assur.Mechanism.from_lengths, joints, links, "crank", lengths)
    refused(assur.InputError, "coupler 0.7", ask)
    refused(assur.PositionError, "position", partial(made, {"BC": 30.0}))


def test_a_length_given_twice_must_agree() -> None:
    message = "length C-D is 2.5 m and D-C is 2.4 m: give it once"
    refused(assur.InputError, message, partial(made, {"AB": 1, "CD": 2.5, "DC": 2.4}))
    assert made({"CD": 2.5, "DC": 2.5}) == made({"CD": 2.5})


@pytest.mark.parametrize("pair", [("base", "eye"), ("eye", "base")])
def test_the_length_of_a_cylinder_is_a_coordinate(pair: tuple[str, str]) -> None:
    ask = partial(
        assur.Mechanism.from_lengths,
        {"foot": (0, 0), "eye": (2, 1), "base": (1, -1)},
        {"ground": ["foot", "base"], "boom": ["foot", "eye"]},
        "lift",
        {pair: 3.0},
        slides={"lift": assur.Cylinder("base", "eye")},
    )
    refused(assur.InputError, f"{pair[0]}-{pair[1]} coordinate slide 'lift'", ask)


def coupler(height: float, lengths: dict[str, float]) -> assur.Mechanism:
    """A four-bar whose coupler point is sketched so far above the line B-C."""
    return assur.Mechanism.from_lengths(
        joints={"A": (0, 0), "B": (0, 1), "C": (3, 1), "D": (3, 0), "P": (1.5, 1 + height)},
        links={"ground": "AD", "crank": "AB", "coupler": "BCP", "rocker": "DC"},
        driver="crank",
        lengths=lengths,
    )


TRIANGLE = {"BC": 3.0, "BP": 1.6, "CP": 1.6}


@pytest.mark.parametrize("height", [0.0, -0.0, 1e-12])
def test_a_joint_on_a_line_has_no_side(height: float) -> None:
    message = "'P' is drawn on the line B-C, and the lengths put it beside it: draw it on its side"
    with pytest.raises(assur.InputError, match=message):
        coupler(height, TRIANGLE)
    # Where it stays on the line it needs none.
    straight = coupler(height, {"BC": 3.0, "BP": 1.2, "CP": 1.8})
    assert straight.dimensions["coupler.P.y"] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(("height", "side"), [(0.01, "left"), (-0.01, "right")])
def test_a_doubtful_side_is_named(height: float, side: str) -> None:
    with pytest.warns(assur.AssurWarning, match=f"taken on the {side} of B → C: draw it") as seen:
        own = coupler(height, TRIANGLE)
    assert seen[0].filename == __file__
    assert own.dimensions["coupler.P.y"] == pytest.approx(math.copysign(0.31**0.5, height))
    clear = coupler(20.0 * height, TRIANGLE)
    assert clear.dimensions["coupler.P.y"] == pytest.approx(math.copysign(0.31**0.5, height))
