"""Errors of a description, of a request and of a position: a case for each kind."""

from __future__ import annotations

import cmath
import math
from typing import Any

import assur
from assur import DimensionError, InputError, PositionError, StructureError
from models.errors.error_case import Case
from models.errors.refusals import (
    APART,
    LOCOMOTIVE,
    RODS,
    M,
    build,
    engine,
    joint,
    slide,
)
from models.errors.refused_structures import REFUSED
from models.mechanisms import higher_models
from models.mechanisms.mechanism_data import arguments
from models.mechanisms.rings import ring

nan = math.nan

# P4: a group of class IV behind a crank.
LOOM = assur.ClassIV(
    joints={
        "1": (0.0, 0.0), "2": (0.35, 0.0), "3": (1.24, 0.99), "4": (0.75, 1.91), "5": (3.02, -0.73),
        "6": (2.45, 1.02), "7": (3.2, 2.24), "8": (1.85, 2.35), "9": (1.62, -1.11),
        "10": (4.28, 1.52),
    }
)  # fmt: skip
RING = ring(7)
LOOM_GROUP = "IV(l234, l365, l48, l876, l95, l107)"
# Driven by its rocker, it comes to a dead point where crank and coupler are in line.
ROCKER = assur.FourBar(1.0, 3.0, 3.0, 3.0).with_driver("rocker")
DEAD = math.pi - math.acos(14.0 / 18.0)
# The rod at its drawing's two-fold reach.
PULLED = assur.Mechanism(**engine("bore"))
TRIAD = build(
    joints={
        "O": (0, 0), "A": (0.3, 0.2), "B": (1, 2), "C": (2.5, 1.5), "D": (2, 3), "E": (4, 0),
        "G": (4.3, -0.4), "F": (0, 4),
    },
    links={
        "ground": "OGF", "left": "OA", "right": "GE",
        "b1": "AB", "plate": "BCD", "b2": "CE", "b3": "DF",
    },
    driver=["left", "right"],
)  # fmt: skip
LOCO = build(joints=LOCOMOTIVE, links=RODS)


def described(name: str) -> assur.Mechanism:
    return build(**REFUSED[name][0])


def no_link_to_spare() -> assur.Mechanism:
    """A locomotive whose second and third crank carry a dyad each."""
    at = {"P": (3.5, 0.6), "Q": (4, 2), "R": (5, 0), "S": (2.2, 0.4), "T": (1.9, 2), "U": (-1, 1.5)}
    links = {**RODS, "ground": "ADERU", "second": "DCP", "third": "EFS"}
    more = {"a": "PQ", "b": "RQ", "c": "ST", "d": "UT"}
    return build(joints={**LOCOMOTIVE, **at}, links={**links, **more})


def on_two_cranks() -> assur.Mechanism:
    """A crank and a cart that are both driven, and a dyad between them."""
    return build(
        joints={"O": (0, 0), "A": (0.3, 0.4), "B": (2.3, 0), "G": (5, 1)},
        links={"ground": "O", "crank": "OA", "cart": "B", "long": "AG", "short": "GB"},
        slides={"s": slide("cart", "ground", 0)},
        driver=["crank", "s"],
    )


def two_carts() -> assur.Mechanism:
    """Two driven carts on one line, with bars of the same length between them."""
    return build(
        joints={"A": (0, 0), "C": (1.2, 1.1), "E": (2.4, 0)},
        links={"ground": [], "s1": "A", "b1": "AC", "b2": "CE", "s2": "E"},
        slides={"p": slide("s1", "ground", 0), "r": slide("s2", "ground", 0)},
        driver=["p", "r"],
    )


def two_guides() -> assur.Mechanism:
    """A pin in the slots of the crank and of the ground."""
    return build(
        joints={"O": (0, 0), "A": (1, 0.5), "C": (2, 1)},
        links={"ground": "O", "crank": "OA", "b1": "C", "b2": "C"},
        slides={
            "s1": slide("b1", "crank", math.atan2(0.5, 1.0), "O"),
            "s2": slide("b2", "ground", 0, "O"),
        },
        driver="crank",
    )


def kites(count: int) -> assur.Mechanism:
    """Kites in a row: each turns half as fast as the one before."""
    along = cmath.rect(1.0, 0.3)
    pivot, pin = 0j, cmath.rect(1.0, 1.3)
    joints: dict[str, Any] = {"A": (0, 0), "B0": (pin.real, pin.imag)}
    links: dict[str, list[str]] = {"ground": ["A"], "crank": ["A", "B0"]}
    for i in range(count):
        other = pivot + along
        # The long bars, 2.5 m, end on the axis of the short ones.
        half = 0.5 * (pin - other)
        axis = 0.5 * (pin + other) - pivot
        end = pivot + axis + axis / abs(axis) * math.sqrt(2.5**2 - abs(half) ** 2)
        next_pin = other + (end - other) / abs(end - other) * cmath.rect(1.0, 0.4)
        for name, at in ((f"D{i}", other), (f"C{i}", end), (f"B{i + 1}", next_pin)):
            joints[name] = (at.real, at.imag)
        links["ground"].append(f"D{i}")
        links |= {f"bar{i}": [f"B{i}", f"C{i}"], f"rocker{i}": [f"D{i}", f"C{i}", f"B{i + 1}"]}
        pivot, pin = other, next_pin
    return assur.Mechanism(joints, links, "crank")


def seven_kites_back() -> assur.Motion:
    m = kites(7)
    return m.solve(float(m.q0) - 1.0)


def to_infinity() -> assur.Motion:
    """Guides become parallel, and a block runs off."""
    return assur.Mechanism(**arguments(higher_models.higher_case(1313).description)).solve(-1.46)


def nearly_in_line() -> assur.Machine:
    linkage = assur.FourBar(1.0, 3.0, 2.0 + 1e-10, 4.0)
    return assur.Machine(
        linkage,
        bodies={
            "rocker": assur.Body(mass=1.0, inertia=0.5),
            "coupler": assur.Body(mass=2.0, inertia=0.3),
        },
    )


def door(driver: str = "lift", **slide: Any) -> assur.Mechanism:
    """A door that a cylinder holds, or a slide between the same joints."""
    links: dict[str, Any] = {"ground": ["hinge", "foot"], "door": ["hinge", "eye"]}
    lift: Any = assur.Cylinder("foot", "eye")
    if slide:
        links |= {"tube": ["foot"], "ram": ["eye"]}
        lift = assur.Slide("ram", "tube", origin="foot", **slide)
    joints = {"hinge": (0, 0), "foot": (0, -1.0), "eye": (1.0, 0)}
    return assur.Mechanism(joints, links, driver, slides={"lift": lift})


def rocker_machine() -> assur.Machine:
    return assur.Machine(ROCKER, bodies={"rocker": assur.Body(inertia=1.0)})


STRUCTURE: dict[str, Case] = {
    "bad_name": Case(StructureError, lambda: build(**joint(**{"a.b": (1, 2)})), {"joint": "a.b"}),
    "doubled_name": Case(StructureError, lambda: described("joint for link"), {"link": "crank"}),
    "doubled_joint": Case(
        StructureError, lambda: described("listed twice"), {"link": "coupler", "joint": "B"}
    ),
    "unknown": Case(StructureError, lambda: described("slide link"), {"link": "pistn"}),
    "not_finite": Case(StructureError, lambda: described("NaN"), {"joint": "P", "value": nan}),
    "out_of_range": Case(
        StructureError, lambda: build(**joint(P=(1e200, 0))), {"joint": "P", "value": 1e200}
    ),
    "loose_joint": Case(StructureError, lambda: described("loose joint"), {"joint": "Q"}),
    "zero_length": Case(
        StructureError,
        lambda: described("zero length"),
        {"link": "crank", "joint": "B", "value": 0.0},
    ),
    "no_ground": Case(StructureError, lambda: described("no ground"), {"link": "ground"}),
    "same_link": Case(StructureError, lambda: described("on itself"), {"link": "piston"}),
    "origin_not_on_link": Case(
        StructureError,
        lambda: described("origin elsewhere"),
        {"slide": "bore", "joint": "A", "link": "ground"},
    ),
    "guide_nowhere": Case(
        StructureError, lambda: described("tongue nowhere"), {"slide": "tongue2", "link": "disc"}
    ),
    "unplaced": Case(StructureError, lambda: described("jointless"), {"link": "x"}),
    "no_driver": Case(StructureError, lambda: described("no driver")),
    "ground_driven": Case(StructureError, lambda: described("ground driven"), {"driver": "ground"}),
    "doubled_driver": Case(StructureError, lambda: described("driven twice"), {"driver": "crank"}),
    "unconnected": Case(StructureError, lambda: described("two apart"), {"link": "crank2"}),
    "slides_only": Case(StructureError, lambda: described("wedge"), {"slide": "s1"}),
    "immovable": Case(
        StructureError, lambda: described("diagonal"), {"link": "crank", "value": 0.0}
    ),
    "mobility": Case(StructureError, lambda: described("dangling"), {"link": "tail", "value": 2.0}),
    "cannot_drive": Case(
        StructureError,
        lambda: described("angle of a piston"),
        {"driver": "piston", "link": "piston"},
    ),
    "over_constrained": Case(StructureError, no_link_to_spare, {"link": "crank", "value": 1.0}),
    "flat_dyad": Case(
        StructureError, lambda: described("in line"), {"joint": "C", "group": "C", "value": 0.0}
    ),
    "almost_fits": Case(
        StructureError,
        lambda: described("third rod 1e-3 too long"),
        {"link": "crank", "value": 2.183387e-4},
    ),
    "no_length": Case(
        StructureError,
        lambda: door("door", angle=-0.75 * math.pi, length=True),
        {"slide": "lift", "value": -math.sqrt(2.0)},
    ),
    "bad_sign": Case(StructureError, lambda: described("sign"), {"joint": "C", "value": 2.0}),
}

REQUEST: dict[str, Case] = {
    "too_many_assemblies": Case(
        StructureError,
        lambda: RING.assemblies(RING.q0),
        {"group": RING.core.formula.partition("→ ")[2]},
    ),
    "bad_dimension": Case(
        DimensionError,
        lambda: M.with_dimensions({"coupler.length": -1.0}),
        {"dimension": "coupler.length", "value": -1.0},
    ),
    "redundant": Case(
        InputError, lambda: LOCO.solve(0.3).sensitivity("rod.length"), {"link": "third"}
    ),
    "no_axis": Case(InputError, lambda: M.extremes("B.z"), {"joint": "B"}),
    "coordinate_too_far": Case(InputError, lambda: M.assemblies(1e9), {"q": 1e9}),
    "unknown": Case(
        InputError,
        lambda: M.with_dimensions({"cupler.length": 1.0}),
        {"dimension": "cupler.length"},
    ),
}

POSITION: dict[str, Case] = {
    "bad_dimension": Case(
        DimensionError,
        lambda: M.with_dimensions({"coupler.length": [4.4, nan]}).solve([0.0, 1.0]),
        {"dimension": "coupler.length", "design": (1,), "q": 0.0, "value": nan},
    ),
    "coordinate_not_finite": Case(
        InputError, lambda: M.solve([1.0, nan]), {"q": nan, "value": nan}
    ),
    "coordinate_too_far": Case(
        InputError,
        lambda: on_two_cranks().solve([1e9, 1.0]),
        {"q": (1e9, 1.0), "value": 1e9},
    ),
    "not_closed": Case(
        PositionError,
        lambda: APART.solve([0.0, 3.0]),
        # Crank 40, ground 210 and an angle of 3 rad span more than coupler and rocker.
        {
            "joint": "C",
            "group": "C",
            "q": 3.0,
            "value": math.sqrt(40**2 + 210**2 - 2 * 40 * 210 * math.cos(3.0)) - 200.0,
        },
    ),
    "too_far_apart": Case(
        PositionError, lambda: PULLED.solve(1e300), {"joint": "A", "group": "A", "q": 1e300}
    ),
    "negative_length": Case(
        PositionError, lambda: door().solve(-1.0), {"slide": "lift", "q": -1.0, "value": -1.0}
    ),
    "zero_length": Case(
        PositionError,
        lambda: assur.Machine(door("door"), bodies={"door": assur.Body(inertia=1.0)}).run(
            1.0, q0=-0.5 * math.pi
        ),
        {"slide": "lift", "q": -0.5 * math.pi},
    ),
    "undetermined": Case(
        PositionError,
        lambda: two_carts().solve([1.2, -1.2]),
        {"joint": "C", "group": "C", "q": (1.2, -1.2)},
    ),
    "parallel_guides": Case(
        PositionError, lambda: two_guides().solve(0.0), {"slide": "s1", "q": 0.0}
    ),
    "redundant_misfit": Case(
        PositionError,
        lambda: LOCO.with_dimensions({"third.length": 1.251}).solve(0.5),
        {"link": "third", "q": 0.5, "value": 1e-3},
    ),
    "flat": Case(
        PositionError, lambda: ROCKER.solve(DEAD), {"joint": "B", "group": "B", "q": DEAD}
    ),
    "beside_dead_point": Case(
        PositionError,
        lambda: rocker_machine().run(1.0, q0=DEAD - 1e-9),
        {"joint": "B", "group": "B", "q": DEAD - 1e-9},
    ),
    "near_change_point": Case(
        PositionError,
        lambda: nearly_in_line().run(1.0, q0=math.pi),
        {"joint": "C", "group": "C", "q": math.pi},
    ),
    "signs_do_not_return": Case(PositionError, seven_kites_back, {"q": 0.3}),
    "design_not_tracked": Case(
        PositionError,
        lambda: LOOM.with_dimensions({"l48.length": [1.2, 50.0]}).solve(0.0),
        {"group": LOOM_GROUP, "design": (1,), "q": 0.0, "value": 0.0443418},
    ),
    "beyond_dead_point": Case(
        PositionError,
        lambda: LOOM.with_driver("l107").solve(3.0),
        {"group": "IV(crank, l234, l365, l48, l876, l95)", "q": 3.0, "value": 2.9188325},
    ),
    "joint_goes_to_infinity": Case(
        PositionError,
        to_infinity,
        {"group": "IV(L0, L1, L2, L3, L4, L5)", "q": -1.46, "value": -1.4667513},
    ),
    "dead_point_on_path": Case(
        PositionError,
        lambda: TRIAD.solve([1.4, 0.8]),
        {"group": "III(b1, plate, b2, b3)", "q": (1.4, 0.8)},
    ),
}
