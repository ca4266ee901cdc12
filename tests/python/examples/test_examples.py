"""What holds for every example: description, class, range, closure."""

from __future__ import annotations

import inspect
import itertools
import math
import re
from typing import TypeAlias

import numpy as np
import pytest

import assur
from assur import Status, examples
from example_checks import distance, mechanism_of, over_range, span

Groups: TypeAlias = tuple[tuple[int, int, str | None], ...]  # class, order, kind of each group

U = 2.220446049250313e-16
POSITION = 8 * U  # of size times condition: what docs/conventions.md promises
RRR, RRP, RPR, PRP, RPP = ((2, 2, kind) for kind in ("RRR", "RRP", "RPR", "PRP", "RPP"))
TRIAD, TETRAD = (3, 3, None), (4, 2, None)  # Assur's groups by their closed contours
# As the literature has them: dyads by Artobolevsky's kinds; Stephenson's chain is of class III
# where the driver is outside of its four-bar loop, and has the tetrad where it is on Stephenson II.
GROUPS: dict[str, Groups] = {
    "crank_rocker": (RRR,),
    "locomotive": (RRR, RRP),
    "engine": (RRP,),
    "scotch_yoke": (RPP,),
    "tangent_generator": (PRP,),
    "trammel": (PRP,),
    "oldham": (RPP,),
    "whitworth": (RPR, RRP),
    "shaper": (RPR, RRP),
    "watt_1": (RRR, RRR),
    "watt_2": (RRR, RRR),
    "stephenson_1": (RRR, RRR),
    "stephenson_2": (TETRAD,),
    "stephenson_3": (RRR, RRR),
    "jansen_leg": (RRR, RRR, RRR),
    "klann_leg": (RRR, RRR),
    "chebyshev_lambda": (RRR,),
    "peaucellier": (RRR, RRR, RRR),
    "hart": (RRR, RRR),
    "pantograph": (RRR, RRR),
    "five_bar": (RRR,),
    "excavator": (RRR, RRR, RRR, RRR),
    "platform_on_cylinders": (TRIAD,),
    "platform_on_cranks": (TRIAD,),
    "triad": (TRIAD,),
    "stephenson_reversed": (TRIAD,),
    "loom": ((4, 3, None),),
    "pentagon": ((5, 3, None),),
    "toggle_press": (RRR, RRP),
    "andrews_squeezer": (RRR, RRR, RRR),
}
DRIVERS = {"pantograph": 2, "five_bar": 2, "excavator": 3}
DRIVERS |= {"platform_on_cylinders": 3, "platform_on_cranks": 3}
# The six-bars with the number of joints of the ground, and whether the ternary links share one.
SIX_BARS = {
    "watt_1": (2, True),
    "watt_2": (3, True),
    "stephenson_1": (2, False),
    "stephenson_2": (2, False),
    "stephenson_3": (3, False),
    "stephenson_reversed": (3, False),
}
# Limits are a little outside of the range: it is used up to there.
LIMITED = ("peaucellier", "hart", "stephenson_reversed", "pentagon")


@pytest.fixture(params=list(examples.ALL))
def name(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def test_all_are_listed() -> None:
    assert list(GROUPS) == list(examples.ALL) == list(examples.RANGES)
    assert {*examples.__all__} == {*examples.ALL, "ALL", "RANGES"}
    own = {
        function.__name__
        for part in vars(examples).values()
        if inspect.ismodule(part) and part.__name__.startswith("assur.examples.")
        for function in (getattr(part, n) for n in part.__all__)
    }
    assert own == {*examples.ALL}


def test_docstring(name: str) -> None:
    text = inspect.getdoc(examples.ALL[name]) or ""
    assert text.partition("\n")[0].endswith(".")
    for section in ("Returns", "References", "Examples"):
        assert f"\n{section}\n{'-' * len(section)}\n" in text
    assert re.search(r"\d (mm|cm|m)\b", text)  # dimensions with their unit
    stated = re.search(r"^    Class (\w+)", text, re.MULTILINE)
    assert stated is not None
    assert {"II": 2, "III": 3, "IV": 4, "V": 5}[stated[1]] == max(c for c, _, _ in GROUPS[name])


def test_structure(name: str) -> None:
    made = examples.ALL[name]()
    structure = mechanism_of(made).structure
    assert structure.mobility == DRIVERS.get(name, 1) == np.size(mechanism_of(made).q0)
    assert tuple((g.cls, g.order, g.kind) for g in structure.groups) == GROUPS[name]
    redundant = ("wheel3",) if name == "locomotive" else ()
    assert structure.redundant == redundant
    assert structure.mobility_counted == structure.mobility - len(redundant)
    assert mechanism_of(examples.ALL[name]()) == mechanism_of(made)


@pytest.mark.parametrize("name", SIX_BARS)
def test_six_bar_chains(name: str) -> None:
    """Two ternary links among six; which of them the ground is, and whether they share a joint."""
    links = mechanism_of(examples.ALL[name]()).links
    joints = [joint for on in links.values() for joint in on]
    pairs = {n: [j for j in on if joints.count(j) > 1] for n, on in links.items()}  # no free points
    ternary = [set(on) for on in pairs.values() if len(on) == 3]
    assert sorted(map(len, pairs.values())) == [2, 2, 2, 2, 3, 3]
    assert (len(pairs["ground"]), bool(ternary[0] & ternary[1])) == SIX_BARS[name]


def test_range(name: str) -> None:
    """Solved everywhere, rigid, and on the drawing at its own coordinate."""
    mechanism = mechanism_of(examples.ALL[name]())
    motion = mechanism.solve(over_range(name), order=0)
    # The locomotive's change points are positions with coinciding assemblies.
    change = np.isclose(np.sin(over_range(name)), 0.0) if name == "locomotive" else False
    assert np.all((motion.status == Status.OK) | change)
    condition = np.where(np.isfinite(motion.condition), motion.condition, 1.0 / U**0.5)
    assert np.all(motion.residual <= POSITION * condition)
    allowed = POSITION * condition * span(mechanism)
    for on in mechanism.links.values():
        for a, b in itertools.combinations(on, 2):
            drawn = math.dist(mechanism.joints[a], mechanism.joints[b])
            assert np.all(np.abs(distance(motion, a, b) - drawn) <= allowed), (a, b)
    at = mechanism.solve(mechanism.q0, order=0)
    for joint, place in mechanism.joints.items():
        gap = math.dist(at.joint(joint).value, place)
        assert gap <= POSITION * float(at.condition) * span(mechanism), joint


def test_full_turns(name: str) -> None:
    """A range of one turn is the whole motion; others end before the mechanism does."""
    mechanism = mechanism_of(examples.ALL[name]())
    if np.ndim(mechanism.q0):
        return
    first, last = examples.RANGES[name]
    whole = (first, last) == (0.0, math.tau)
    limits = mechanism.limits()
    assert bool(limits.full_rotation) == whole
    if name in LIMITED:
        (low, high) = limits.intervals[np.argmin(np.abs(limits.intervals.mean(axis=-1)))]
        assert low < float(np.asarray(first)) < float(np.asarray(last)) < high


def test_a_machine_is_only_the_squeezer() -> None:
    made = {name: type(make()) for name, make in examples.ALL.items()}
    assert [n for n, kind in made.items() if not issubclass(kind, assur.Mechanism)] == [
        "andrews_squeezer"
    ]
