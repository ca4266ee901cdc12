"""Guides that are nearly parallel and dyads that are nearly flat are taken as drawn."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import assur

JOINTS = {"A": (0, 0), "B": (1, 0.3), "C": (2, 1), "P": (0.3, 2), "D": (2.2, 1.5)}
LINKS = {"ground": "AP", "crank": "AB", "a": "PC", "b": "D"}


def on_two_guides(apart: float) -> assur.Mechanism:
    """Link a turns about P and slides on b, which slides on the ground."""
    slides = {
        "s0": assur.Slide("a", on="b", angle=1.0),
        "s1": assur.Slide("b", on="ground", angle=1.0 + apart),
    }
    return assur.Mechanism(JOINTS, LINKS, "crank", slides=slides)


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("apart", [1e-3, 2e-4, 1e-5, 1e-6, 1e-7, 1e-8])
def test_guides_apart_by_a_small_angle_leave_one_freedom(apart: float, sign: int) -> None:
    m = on_two_guides(sign * apart)
    assert m.structure.formula == "I(crank) → II(a, b)"
    assert (m.structure.mobility, m.structure.redundant, m.structure.adjustment) == (1, (), 0.0)
    # The angle between the guides is not changed.
    between = m.slides["s1"].angle - m.slides["s0"].angle
    assert between == pytest.approx(sign * apart, abs=3e-16)
    motion = m.solve(m.q0, on_error="nan")
    assert motion.joint("B").value == pytest.approx((1.0, 0.3))
    assert motion.residual < 1e-9


def test_parallel_guides_leave_two() -> None:
    with pytest.raises(assur.StructureError, match=r"mobility is 2 \(counted 1"):
        on_two_guides(0.0)


def bed_on_rails(apart: float) -> assur.Mechanism:
    """A bed that slides on two rails of the ground, of which one is redundant."""
    return assur.Mechanism(
        {"A": (0, 0), "B": (1, 0.3), "C": (3, 1), "D": (4, 1.5), "E": (0, 1), "F": (0, 1.5)},
        {"ground": "AEF", "crank": "AB", "rod": "BC", "bed": "CD"},
        "crank",
        slides={
            "s0": assur.Slide("bed", on="ground", angle=0.0, origin="E"),
            "s1": assur.Slide("bed", on="ground", angle=apart, origin="F"),
        },
    )


@pytest.mark.parametrize("apart", [1e-8, 1e-6, 1e-4, 1e-3])
def test_redundant_rails_are_turned_no_further_than_joints_are_moved(apart: float) -> None:
    assert bed_on_rails(0.0).structure.redundant == ("s1",)
    assert bed_on_rails(2e-9).structure.redundant == ("s1",)
    with pytest.raises(assur.StructureError, match="lengths agree"):
        bed_on_rails(apart)


def random_chain(rng: np.random.Generator) -> tuple[Any, Any, Any] | None:
    """A crank and dyads, one of them nearly singular."""
    joints = {name: tuple(rng.uniform(-3, 3, 2)) for name in "AB"}
    links: dict[str, list[str]] = {"ground": ["A"], "crank": ["A", "B"]}
    slides: dict[str, assur.Slide] = {}
    count = int(rng.integers(1, 4))
    near = int(rng.integers(count))
    for i in range(count):
        small = 10.0 ** rng.uniform(-6.5, -2) * rng.choice([-1, 1]) if i == near else None
        on, other = (list(links)[k] for k in rng.choice(len(links), 2, replace=False))
        ends = []
        for link in (on, other):
            fresh = f"J{i}{link}"
            if links[link] and rng.random() < 0.5:
                ends.append(links[link][rng.integers(len(links[link]))])
            else:
                joints[fresh] = tuple(rng.uniform(-3, 3, 2))
                links[link].append(fresh)
                ends.append(fresh)
        if ends[0] == ends[1]:
            return None
        first, second, inner = f"u{i}", f"w{i}", f"K{i}"
        (x, y), (u, v) = joints[ends[0]], joints[ends[1]]
        towards = math.atan2(v - y, u - x)
        free = rng.uniform(0, 6)
        kind = rng.choice(["RRR", "RPR", "PRP", "RPP"])
        if kind == "RRR":
            joints[inner] = tuple(rng.uniform(-3, 3, 2))
            if small is not None:
                joints[inner] = (
                    x + 0.4 * (u - x) - small * (v - y),
                    y + 0.4 * (v - y) + small * (u - x),
                )
            links |= {first: [ends[0], inner], second: [inner, ends[1]]}
        elif kind == "RPR":
            links |= {first: [ends[0]], second: [ends[1]]}
            angle = free if small is None else towards + math.pi / 2 + small
            slides[f"s{i}"] = assur.Slide(second, on=first, angle=angle)
        else:
            joints[inner] = tuple(rng.uniform(-3, 3, 2))
            links |= {first: [inner if kind == "PRP" else ends[0]], second: [inner]}
            guide = on if kind == "PRP" else second
            apart = rng.uniform(0, 6) if small is None else free + small
            slides[f"s{i}"] = assur.Slide(first, on=guide, angle=free)
            slides[f"t{i}"] = assur.Slide(second, on=other, angle=apart)
    return joints, links, slides


def test_chains_with_a_nearly_singular_dyad_have_one_freedom() -> None:
    rng = np.random.default_rng(20)
    built = 0
    while built < 150:
        drawn = random_chain(rng)
        if drawn is None:
            continue
        joints, links, slides = drawn
        structure = assur.Mechanism(joints, links, "crank", slides=slides).structure
        assert (structure.mobility, structure.adjustment) == (1, 0.0)
        assert not structure.redundant
        built += 1
