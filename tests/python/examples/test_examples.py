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
from oracles.kinematics.example_checks import distance, mechanism_of, over_range, span

Groups: TypeAlias = tuple[tuple[int, int, str | None], ...]  # class, order, kind of each group

U = 2.220446049250313e-16
POSITION = 8 * U  # of size times condition: what docs/reference/conventions.md promises
RRR, RRP, RPR, PRP, RPP = ((2, 2, kind) for kind in ("RRR", "RRP", "RPR", "PRP", "RPP"))
TRIAD, TETRAD = (3, 3, None), (4, 2, None)  # Assur's groups by their closed contours
# As the literature has them: dyads by Artobolevsky's kinds; Stephenson's chain is of class III
# where the driver is outside of its four-bar loop, and has the tetrad where it is on Stephenson II.
STRUCTURE: dict[str, tuple[str, Groups]] = {
    "crank_rocker": ("I(crank) → II(coupler, rocker)", (RRR,)),
    "locomotive": ("I(wheel2) → II(wheel1, coupling_rod) → II(main_rod, crosshead)", (RRR, RRP)),
    "engine": ("I(crank) → II(rod, piston)", (RRP,)),
    "scotch_yoke": ("I(crank) → II(block, yoke)", (RPP,)),
    "tangent_generator": ("I(lever) → II(block, cursor)", (PRP,)),
    "trammel": ("I(bar) → II(x_block, y_block)", (PRP,)),
    "oldham": ("I(shaft1) → II(disc, shaft2)", (RPP,)),
    "whitworth": ("I(crank) → II(block, lever) → II(rod, ram)", (RPR, RRP)),
    "shaper": ("I(crank) → II(block, lever) → II(rod, ram)", (RPR, RRP)),
    "watt_1": ("I(crank) → II(coupler, rocker) → II(link, arm)", (RRR, RRR)),
    "watt_2": ("I(crank) → II(coupler, lever) → II(link, rocker)", (RRR, RRR)),
    "stephenson_1": ("I(crank) → II(coupler, rocker) → II(link1, link2)", (RRR, RRR)),
    "stephenson_2": ("I(crank) → IV(plate, rocker, lower, upper)", (TETRAD,)),
    "stephenson_3": ("I(crank) → II(coupler, rocker) → II(link, lever)", (RRR, RRR)),
    "jansen_leg": (
        "I(crank) → II(upper_rod, upper) → II(lower_rod, lower_rocker) → II(link, foot)",
        (RRR, RRR, RRR),
    ),
    "klann_leg": ("I(crank) → II(rod, lower_rocker) → II(upper_rocker, leg)", (RRR, RRR)),
    "chebyshev_lambda": ("I(crank) → II(coupler, rocker)", (RRR,)),
    "peaucellier": (
        "I(crank) → II(arm1, side1) → II(arm2, side2) → II(side3, side4)",
        (RRR, RRR, RRR),
    ),
    "hart": ("I(crank) → II(short1, long1) → II(short2, long2)", (RRR, RRR)),
    "pantograph": ("I(x, y) → II(arm, inner) → II(pen_arm, outer)", (RRR, RRR)),
    "five_bar": ("I(left, right) → II(left_rod, right_rod)", (RRR,)),
    "excavator": (
        (
            "I(boom_cylinder, stick_cylinder, bucket_cylinder) → "
            "II(boom, boom_barrel, boom_rod) → II(stick, stick_barrel, stick_rod) → "
            "II(rocker, bucket_barrel, bucket_rod) → II(link, bucket)"
        ),
        (RRR, RRR, RRR, RRR),
    ),
    "platform_on_cylinders": (
        "I(leg1, leg2, leg3) → III(tube1, tube2, tube3, rod1, rod2, rod3, platform)",
        (TRIAD,),
    ),
    "platform_on_cranks": ("I(crank1, crank2, crank3) → III(rod1, rod2, rod3, platform)", (TRIAD,)),
    "triad": ("I(crank) → III(rod, plate, right, left)", (TRIAD,)),
    "stephenson_reversed": ("I(input) → III(rod, coupler, crank, rocker)", (TRIAD,)),
    "loom": ("I(crank) → IV(l234, l365, l48, l876, l95, l107)", ((4, 3, None),)),
    "pentagon": ("I(crank) → V(rod, left, right, lower, plate, upper)", ((5, 3, None),)),
    "toggle_press": ("I(crank) → II(rod, upper) → II(lower, ram)", (RRR, RRP)),
    "andrews_squeezer": ("I(K1) → II(K2, K3) → II(K4, K5) → II(K6, K7)", (RRR, RRR, RRR)),
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
    assert list(STRUCTURE) == list(examples.ALL) == list(examples.RANGES)
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
    assert {"II": 2, "III": 3, "IV": 4, "V": 5}[stated[1]] == max(
        c for c, _, _ in STRUCTURE[name][1]
    )


def test_structure(name: str) -> None:
    made = examples.ALL[name]()
    structure = mechanism_of(made).structure
    assert structure.mobility == DRIVERS.get(name, 1) == np.size(mechanism_of(made).q0)
    groups = tuple((g.cls, g.order, g.kind) for g in structure.groups)
    assert (structure.formula, groups) == STRUCTURE[name]
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
