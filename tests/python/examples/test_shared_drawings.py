"""Drawings of class II that many tests share: structure, ranges, analogues by differences."""

from __future__ import annotations

import itertools
import math
from typing import TypeAlias

import numpy as np
import numpy.typing as npt
import pytest

import named_drawings
from assur import Status
from example_checks import coordinates, distance, span

Float: TypeAlias = npt.NDArray[np.float64]
Group: TypeAlias = tuple[str, ...]

U = 2.220446049250313e-16
POSITION = 8 * U  # of size times condition: what docs/conventions.md promises
STEP = 1e-5  # rad or m: differences then err by about as much by truncation as by rounding
RRR, RRP, RPR, PRP, RPP = "RRR", "RRP", "RPR", "PRP", "RPP"
STRUCTURE: dict[str, tuple[str, Group]] = {
    "crank_rocker": ("I(crank) → II(coupler, rocker)", (RRR,)),
    "chebyshev_lambda": ("I(crank) → II(coupler, rocker)", (RRR,)),
    "engine": ("I(crank) → II(rod, piston)", (RRP,)),
    "whitworth": ("I(crank) → II(block, lever) → II(rod, ram)", (RPR, RRP)),
    "shaper": ("I(crank) → II(block, lever) → II(rod, ram)", (RPR, RRP)),
    "scotch_yoke": ("I(crank) → II(block, yoke)", (RPP,)),
    "tangent_generator": ("I(lever) → II(block, cursor)", (PRP,)),
    "trammel": ("I(bar) → II(x_block, y_block)", (PRP,)),
    "watt_six_bar": ("I(crank) → II(coupler, rocker) → II(link, arm)", (RRR,) * 2),
    "stephenson_six_bar": ("I(crank) → II(coupler, rocker) → II(link, lever)", (RRR,) * 2),
    "jansen_leg": (
        "I(crank) → II(upper_rod, upper) → II(lower_rod, lower_rocker) → II(link, foot)",
        (RRR,) * 3,
    ),
    "klann_leg": ("I(crank) → II(rod, lower_rocker) → II(upper_rocker, leg)", (RRR,) * 2),
    "peaucellier": (
        "I(crank) → II(arm1, side1) → II(arm2, side2) → II(side3, side4)",
        (RRR,) * 3,
    ),
    "hart": ("I(crank) → II(short1, long1) → II(short2, long2)", (RRR,) * 2),
    "excavator": (
        (
            "I(boom_cylinder, stick_cylinder, bucket_cylinder) → "
            "II(boom, boom_barrel, boom_rod) → II(stick, stick_barrel, stick_rod) → "
            "II(rocker, bucket_barrel, bucket_rod) → II(link, bucket)"
        ),
        (RRR,) * 4,
    ),
    "toggle_press": ("I(crank) → II(rod, upper) → II(lower, ram)", (RRR, RRP)),
}


@pytest.fixture(params=list(named_drawings.CLASS_II))
def name(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def test_all_are_described() -> None:
    assert list(STRUCTURE) == list(named_drawings.CLASS_II) == list(named_drawings.RANGES)
    assert {kind for _, kinds in STRUCTURE.values() for kind in kinds} == {RRR, RRP, RPR, PRP, RPP}
    for make in named_drawings.CLASS_II.values():
        assert make.__doc__
        assert make() == make()


def test_structure(name: str) -> None:
    mechanism = named_drawings.CLASS_II[name]()
    structure = mechanism.structure
    drivers = np.size(mechanism.q0)
    assert structure.mobility == structure.mobility_counted == drivers
    assert structure.mobility_at_drawing == drivers
    assert structure.cls == 2
    assert structure.redundant == ()
    formula, kinds = STRUCTURE[name]
    assert structure.formula == formula
    assert tuple(group.kind for group in structure.groups) == kinds


def test_range(name: str) -> None:
    """Solved everywhere, rigid, and on the drawing at its own coordinate."""
    mechanism = named_drawings.CLASS_II[name]()
    motion = mechanism.solve(coordinates(name), order=0)
    assert np.all(motion.status == Status.OK)
    allowed = POSITION * motion.condition * span(mechanism)
    assert np.all(motion.residual <= POSITION * motion.condition)
    for on in mechanism.links.values():
        for a, b in itertools.combinations(on, 2):
            drawn = math.dist(mechanism.joints[a], mechanism.joints[b])
            assert np.all(np.abs(distance(motion, a, b) - drawn) <= allowed), (a, b)
    at = mechanism.solve(mechanism.q0, order=0)
    for joint, place in mechanism.joints.items():
        gap = math.dist(at.joint(joint).value, place)
        assert gap <= POSITION * float(at.condition) * span(mechanism), joint


def test_analogues_against_differences(name: str) -> None:
    """First analogues against central differences of the positions."""
    mechanism = named_drawings.CLASS_II[name]()
    q = coordinates(name, 61)
    motion = mechanism.solve(q, order=3)
    drivers = np.size(mechanism.q0)
    shortest = min(
        math.dist(mechanism.joints[on[0]], mechanism.joints[on[1]])
        for on in mechanism.links.values()
        if len(on) > 1
    )
    noise = POSITION * float(np.max(motion.condition)) * span(mechanism) / STEP
    for driver, step in enumerate(STEP * np.eye(drivers)):
        move = step if drivers > 1 else STEP
        after, before = (mechanism.solve(x, order=0) for x in (q + move, q - move))
        parts: list[tuple[str, str, float]] = [("joint", n, noise) for n in mechanism.joints]
        parts += [("slide", n, noise) for n in mechanism.slides]
        parts += [("link", n, noise / shortest) for n in mechanism.links]
        for kind, part, rounding in parts:
            here, plus, minus = (getattr(m, kind)(part) for m in (motion, after, before))
            # |third derivative| h²/6, doubled because it is greater nearby
            truncation = 2 * float(np.max(np.abs(here.d3))) * STEP**2 / 6
            along = here.d1[..., driver] if drivers > 1 else here.d1
            difference = (plus.value - minus.value) / (2 * STEP)
            assert np.max(np.abs(along - difference)) <= truncation + rounding, part
