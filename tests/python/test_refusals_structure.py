"""What is no mechanism is refused, with the thing and the number named; borderline ones are not."""

from __future__ import annotations

import contextlib
import math
from typing import Any

import numpy as np
import pytest

import assur

Table = dict[str, Any]
Refusal = tuple[dict[str, Any], tuple[str, ...], dict[str, Any]]

JOINTS: Table = {"A": (0, 0), "B": (1, 0), "C": (4.1, 3.2), "D": (4.8, 0), "P": (3, 4)}
LINKS: Table = {"ground": "AD", "crank": "AB", "coupler": "BCP", "rocker": "DC"}
FOUR: Table = {"ground": "AD", "crank": "AB", "rod": "BC", "second": "DC"}
FIVE: Table = {"A": (0, 0), "B": (0.3, 1), "C": (1.4, 2), "D": (2.5, 0.9), "E": (2, 0)}
FIVE_LINKS: Table = {"ground": "AE", "left": "AB", "l2": "BC", "l3": "CD", "right": "ED"}
BORE = assur.Slide("piston", on="ground", angle=0.0, origin="O")
ENGINE: Table = {
    "joints": {"O": (0, 0), "A": (0.03, 0.04), "B": (0.25, 0)},
    "links": {"ground": "O", "crank": "OA", "rod": "AB", "piston": "B"},
    "slides": {"bore": BORE},
}
SHAFTS: Table = {"ground": ["O1", "O2"], "shaft1": ["O1"], "disc": [], "shaft2": ["O2"]}
LOCOMOTIVE: Table = {"A": (0, 0), "B": (0.75, 1), "C": (3.75, 1), "D": (3, 0)}
LOCOMOTIVE |= {"E": (1.5, 0), "F": (2.25, 1)}
RODS: Table = {"ground": "ADE", "crank": "AB", "rod": "BCF", "second": "DC", "third": "EF"}


def build(**changed: Any) -> assur.Mechanism:
    """The crank-rocker, or what is said instead."""
    parts: Table = {"joints": JOINTS, "links": LINKS, "driver": "crank", **changed}
    return assur.Mechanism(**parts)


def joint(**more: Any) -> Table:
    return {"joints": {**JOINTS, **more}}


def link(**more: Any) -> Table:
    return {"links": {**LINKS, **more}}


def engine(driver: Any = "crank", **slides: Any) -> Table:
    return {**ENGINE, "slides": {**ENGINE["slides"], **slides}, "driver": driver}


def oldham(**slides: Any) -> Table:
    tongue = assur.Slide("disc", on="shaft1", angle=0.4, origin="O1")
    joints = {"O1": (0, 0), "O2": (0.3, 0.1)}
    slides = {"tongue1": tongue, **slides}
    return {"joints": joints, "links": SHAFTS, "slides": slides, "driver": "shaft1"}


def twice(**more: Any) -> Table:
    """Two crank-rockers, 10 m apart."""
    joints = {**JOINTS, **{f"{k}2": (x + 10, y) for k, (x, y) in JOINTS.items()}}
    second = {f"{k}2": [f"{j}2" for j in on] for k, on in LINKS.items() if k != "ground"}
    return {
        "joints": joints,
        "links": {**LINKS, **second, "ground": ["A", "D", "A2", "D2"]},
        **more,
    }


def slide(link: str, on: str, angle: float, origin: str | None = None) -> assur.Slide:
    return assur.Slide(link, on=on, angle=angle, origin=origin)


nan, inf = math.nan, math.inf
REFUSED: dict[str, Refusal] = {
    # names
    "unknown joint": (link(coupler="BCZ"), ('"coupler"', '"Z"', "does not exist"), {"joint": "Z"}),
    "joint for link": (
        joint(crank=(1, 2)) | link(rocker=["D", "C", "crank"]),
        ("crank", "twice"),
        {},
    ),
    "slide for joint": (
        {"slides": {"C": slide("rocker", "ground", 0)}},
        ("C", "joint"),
        {"slide": "C"},
    ),
    # joints and links
    "NaN": (joint(P=(nan, 0)), ("P", "x", "NaN"), {"joint": "P"}),
    "infinite": (joint(P=(0, -inf)), ("P", "y", "-inf"), {"joint": "P", "value": -inf}),
    "loose joint": (joint(Q=(9, 9)), ("Q", "no link", "leave it out"), {"joint": "Q"}),
    "listed twice": (link(coupler="BCB"), ("coupler", "B"), {"link": "coupler", "joint": "B"}),
    "zero length": (joint(B=(0, 0)), ("crank", "A", "B"), {"link": "crank", "value": 0.0}),
    "rounded to zero": (
        joint(A=(0.1 + 0.2, 1 / 3), B=(0.3, 1 / 3)),
        ("crank", "length zero"),
        {"link": "crank"},
    ),
    "jointless": (link(x=[]), ("x", "no joint", "two slides"), {"link": "x"}),
    "no ground": (
        {"links": {k: LINKS[k] for k in ("crank", "coupler", "rocker")}},
        ("ground",),
        {},
    ),
    "ground empty": (link(ground=[]), ("connected", "crank", "rocker"), {"link": "crank"}),
    "apart": (joint(Q=(9, 9), R=(1, 9)) | link(x="QR"), ("connected", "x"), {"link": "x"}),
    "two apart": (
        twice() | {"links": {**twice()["links"], "ground": "AD"}},
        ("crank2", "rocker2"),
        {},
    ),
    # slides
    "slide link": (engine(bore=slide("pistn", "ground", 0)), ("bore", "pistn", "piston"), {}),
    "slide on": (engine(bore=slide("piston", "grund", 0)), ("bore", "grund", '"ground"'), {}),
    "slide origin": (engine(bore=slide("piston", "ground", 0, "Q")), ("bore", "Q"), {"joint": "Q"}),
    "origin elsewhere": (
        engine(bore=slide("piston", "ground", 0, "A")),
        ("bore", "A", "ground"),
        {"slide": "bore", "joint": "A"},
    ),
    "on itself": (
        engine(bore=slide("piston", "piston", 0)),
        ("bore", "piston"),
        {"link": "piston"},
    ),
    "slide NaN": (engine(bore=slide("piston", "ground", nan)), ("bore", "NaN"), {"slide": "bore"}),
    "guides cross": (engine(bore2=slide("piston", "ground", 0.3, "O")), ("piston",), {}),
    "wedge": (
        {
            "joints": {"O": (0, 0), "X": (1, 0), "Y": (2, 2)},
            "links": {"ground": "O", "a": "X", "b": "Y"},
            "slides": {
                "s1": slide("a", "ground", 0),
                "s2": slide("b", "ground", 1.5),
                "s3": slide("a", "b", 0.7),
            },
            "driver": "s1",
        },
        ("s1", "s2", "s3", "PPP"),
        {"slide": "s1"},
    ),
    "parallel tongues": (
        oldham(tongue2=slide("disc", "shaft2", 0.4, "O2")),
        ("disc",),
        {"link": "disc"},
    ),
    "opposite tongues": (
        oldham(tongue2=slide("disc", "shaft2", 0.4 + math.pi, "O2")),
        ("disc",),
        {},
    ),
    "tongue nowhere": (
        oldham(tongue2=slide("disc", "shaft2", 2)),
        ("tongue2", "disc", "shaft2"),
        {},
    ),
    # drivers
    "no driver": ({"driver": []}, ("driver",), {}),
    "ground driven": ({"driver": "ground"}, ("ground",), {}),
    "unknown driver": ({"driver": "cranck"}, ("cranck", '"crank"'), {}),
    "unknown Drive": ({"driver": assur.Drive("crank", "rockr")}, ("rockr", '"rocker"'), {}),
    "Drive itself": ({"driver": assur.Drive("crank", "crank")}, ("crank",), {"link": "crank"}),
    "driven twice": (
        {"driver": ["crank", assur.Drive("crank")]},
        ("crank", "twice"),
        {"driver": "crank"},
    ),
    "angle of a piston": (engine("piston"), ("piston", "cannot"), {"driver": "piston"}),
    # mobility
    "two for one": ({"driver": ["crank", "rocker"]}, ("1", "2 drivers"), {"value": 1.0}),
    "one for two": (
        {"joints": FIVE, "links": FIVE_LINKS, "driver": "left"},
        ("mobility is 2", "l2", "l3", "right"),
        {"link": "l2", "value": 2.0},
    ),
    "five-bar doubled": (
        {"joints": FIVE, "links": {**FIVE_LINKS, "again": "BC"}, "driver": "left"},
        ("mobility is 2", "counted 1", "l3", "right", "over-constrained by 1", '"again"'),
        {"value": 2.0},
    ),
    "dangling": (joint(Q=(9, 9)) | link(tail="PQ"), ("mobility is 2", "tail"), {"link": "tail"}),
    "pinned at one joint": (link(tail="C"), ("mobility is 2", "tail"), {"link": "tail"}),
    "one driver, two four-bars": (
        twice(),
        ("mobility is 2", "crank2", "rocker2"),
        {"link": "crank2"},
    ),
    "both in one": (twice(driver=["crank", "rocker"]), ("cannot", "coupler2"), {"driver": "crank"}),
    "rigid part driven": (
        joint(Q=(9, 9)) | link(diagonal="AC", tail="PQ"),
        ("crank", "cannot", "tail"),
        {"driver": "crank"},
    ),
    # structures: what is too much must be named
    "triangle": (
        {
            "joints": {"A": (0, 0), "B": (1, 2), "C": (3, 0)},
            "links": {"ground": "AC", "crank": "AB", "other": "CB"},
        },
        ("mobility 0", '"crank"', '"other"'),
        {"value": 0.0},
    ),
    "diagonal": (link(diagonal="AC"), ("mobility 0", '"diagonal"'), {"value": 0.0}),
    "third rod 1e-3 too long": (
        {"joints": {**LOCOMOTIVE, "E": (1.49925, -0.001)}, "links": RODS},
        ("mobility 0", '"third"'),
        {"value": 0.0},
    ),
    # flat drawings
    "in line": (
        {"joints": {"A": (0, 0), "B": (1, 0), "C": (4, 0), "D": (2, 0)}, "links": FOUR},
        ("flat", "C", "assembly"),
        {"joint": "C", "value": 0.0},
    ),
    "engine at its dead point": (
        engine("bore") | {"joints": {"O": (0, 0), "A": (0.05, 0), "B": (0.25, 0)}},
        ("flat", "A", "assembly"),
        {"joint": "A"},
    ),
    "no such dyad": ({"assembly": {"X": 1}}, ("X", "C"), {"joint": "X"}),
    "sign": ({"assembly": {"C": 2}}, ("C", "2", "+1", "-1"), {"joint": "C", "value": 2}),
}


@pytest.mark.parametrize("case", REFUSED)
def test_refused(case: str) -> None:
    arguments, words, fields = REFUSED[case]
    with pytest.raises(assur.StructureError) as caught:
        build(**arguments)
    missing = [word for word in words if word not in str(caught.value)]
    assert not missing, f"{missing} not in: {caught.value}"
    assert {name: getattr(caught.value, name) for name in fields} == fields


BAD_NAMES = ["", " ", "a b", "a\tb", "a\u00a0b", "a\nb", "a\u2028", "\0", "a.b", "a/b", "a\\b"]
BAD_NAMES += ["a'b", 'a"b', "a`b", "a(b", "a)b", "a[b", "a]b", "{", "}", "<", ">"]


@pytest.mark.parametrize("name", BAD_NAMES)
def test_names_not_allowed(name: str) -> None:
    for parts in (
        joint(**{name: (9, 9)}) | link(rocker=["D", "C", name]),
        {"links": {**LINKS, name: ["C", "P"]}},
        {"slides": {name: slide("rocker", "ground", 0)}},
    ):
        with pytest.raises(assur.StructureError, match="not allowed"):
            build(**parts)


@pytest.mark.parametrize("name", ["é", "γ1", "A′", "1", "-", "a_b", "x" * 1000])
def test_names_allowed(name: str) -> None:
    m = build(**joint(**{name: (5, 5)}), **link(rocker=["D", "C", name]))
    assert f"rocker.{name}.x" in m.dimensions


@pytest.mark.parametrize(
    "changed",
    [
        *(joint(P=at) for at in ((1,), (1, 2, 3), 5, None, "ab", (1 + 2j, 0), (10**400, 0))),
        joint(P=np.zeros(3)),
        {"joints": {**JOINTS, 3: (0, 0)}},
        {"links": {**LINKS, 3: "AB"}},
        {"joints": [("A", (0, 0))]},
        {"slides": {"s": ("rocker", "ground", 0.0)}},
        {"slides": {"s": slide("rocker", "ground", "x")}},  # type: ignore[arg-type]
        {"driver": [None]},
        {"joints": {**JOINTS, "a\ud800": (0, 0)}},
    ],
)
def test_wrong_values_are_errors_of_ours(changed: Table) -> None:
    with pytest.raises(assur.AssurError):
        build(**changed)


@pytest.mark.parametrize(
    "changed",
    [
        link(coupler=["B", "C", 3]),
        link(coupler=None),
        {"driver": None},
        {"driver": assur.Drive(3)},  # type: ignore[arg-type]
        {"assembly": {"C": "x"}},
        {"assembly": ["C"]},
    ],
)
def test_wrong_types(changed: Table) -> None:
    with pytest.raises((assur.AssurError, TypeError)):
        build(**changed)


@pytest.mark.parametrize("size", [1e-300, 1e-170, 1e170, 1e300])
def test_sizes_beyond_reach_are_named_so(size: float) -> None:
    """Not as flat dyads: 1e-150 to 1e150 is what the design promises."""
    with pytest.raises(assur.StructureError) as caught:
        build(joints={name: (x * size, y * size) for name, (x, y) in JOINTS.items()})
    assert "flat" not in str(caught.value)
    assert "1e-153" in str(caught.value) or "1e153" in str(caught.value)


@pytest.mark.parametrize("size", [1e-150, 1e-9, 1e9, 1e150])
def test_sizes_within_reach(size: float) -> None:
    m = build(joints={name: (x * size, y * size) for name, (x, y) in JOINTS.items()})
    np.testing.assert_allclose(
        m.solve(1.0).joint("C").value / size, build().solve(1.0).joint("C").value, rtol=1e-14
    )


@pytest.mark.parametrize("far", [1e5, 1e6, 1e7, 1e9, 1e12])
def test_a_far_coupler_point_changes_no_structure(far: float) -> None:
    m = build(**joint(P=(far, far)))
    assert m.structure.formula == "I(crank) → II(coupler, rocker)"
    assert m.solve(1.0, order=1).status <= assur.Status.NEAR_SINGULAR


@pytest.mark.parametrize("length", [1e4, 1e6, 1e7])
def test_long_four_bars_move(length: float) -> None:
    long = {"A": (0, 0), "B": (1, 0), "C": (length, 3.2), "D": (length, 0)}
    assert build(joints=long, links=FOUR).structure.mobility == 1


# -- accepted at the border ----------------------------------------------------------------------


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize(
    "places",
    [
        {"A": (0, 0), "B": (1, 0), "C": (4, 0), "D": (2, 0)},  # four-bar in line
        {"A": (0, 0), "B": (1, 0), "C": (4, 0), "D": (3, 0)},  # parallelogram
        {"A": (0, 0), "B": (1, 0), "C": (2, 0), "D": (1, 0)},  # rhombus: B on D
    ],
)
def test_flat_drawings_with_the_assembly_named(places: Table, sign: int) -> None:
    m = build(joints=places, links=FOUR, assembly={"C": sign})
    assert dict(m.assembly) == {"C": sign}
    assert m.structure.mobility == 1
    assert m.solve(0.3).status == assur.Status.OK


def test_square_rhombus() -> None:
    m = build(joints={"A": (0, 0), "B": (0, 1), "C": (1, 1), "D": (1, 0)}, links=FOUR)
    np.testing.assert_allclose(
        m.solve(2.0).joint("C").value, [1 + np.cos(2.0), np.sin(2.0)], atol=1e-15
    )


def test_an_assembly_against_the_drawing_is_not_half_believed() -> None:
    """Refused with the dyad named, or the joints stand as assembled."""
    with contextlib.suppress(assur.StructureError):
        m = build(assembly={"C": -build().assembly["C"]})
        np.testing.assert_allclose(m.joints["C"], m.solve(m.q0).joint("C").value, rtol=1e-12)


@pytest.mark.parametrize(
    ("changed", "redundant"),
    [
        ({"joints": LOCOMOTIVE, "links": RODS}, {"third"}),
        ({"joints": LOCOMOTIVE, "links": RODS, "driver": "third"}, {"second"}),
        (
            {
                "joints": {**LOCOMOTIVE, "G": (0.5, 0), "H": (1.25, 1)},
                "links": {**RODS, "ground": "ADEG", "rod": "BCFH", "fourth": "GH"},
            },
            {"third", "fourth"},
        ),
        (link(again="BC"), {"again"}),
        (link(again="DC"), {"again"}),
        (engine(bore2=BORE), {"bore2"}),
        (engine(bore2=slide("piston", "ground", math.pi, "O")), {"bore2"}),
    ],
)
def test_redundant_but_movable(changed: Table, redundant: set[str]) -> None:
    m = build(**changed)
    assert m.structure.mobility == 1
    assert set(m.structure.redundant) == redundant
    near = m.solve(m.q0 + np.linspace(-0.3, 0.3, 7))
    assert (near.status == assur.Status.OK).all()
    assert near.residual.max() < 1e-14


@pytest.mark.parametrize("error", [1e-6, 1e-9, 1e-12])
def test_a_third_rod_that_does_not_fit_is_never_said_to_move(error: float) -> None:
    """Too little for the rank, but the closure of every position shows it."""
    m = build(joints=LOCOMOTIVE, links=RODS).with_dimensions({"third.length": 1.25 * (1 + error)})
    motion = m.solve([0.2, 1.2, 2.0], on_error="nan")
    assert (motion.status == assur.Status.UNREACHABLE).all()
    assert np.isnan(motion.joint("F").value).all()
    with pytest.raises(assur.PositionError, match=r'q = 1\.2.*"third" does not fit.*m') as caught:
        m.solve(1.2)
    assert caught.value.link == "third"


def test_two_drivers_for_two_four_bars() -> None:
    m = build(**twice(driver=["crank", "crank2"]))
    assert m.structure.formula == "I(crank, crank2) → II(coupler, rocker) → II(coupler2, rocker2)"


def test_doubled_five_bar_with_two_drivers_moves() -> None:
    m = build(joints=FIVE, links={**FIVE_LINKS, "again": "BC"}, driver=["left", "right"])
    assert m.structure.redundant == ("again",)
    assert m.structure.mobility_counted == 1


@pytest.mark.parametrize("driver", ["crank", "rocker", "coupler", assur.Drive("rocker", "crank")])
def test_any_link_of_a_four_bar_drives(driver: Any) -> None:
    assert build(driver=driver).structure.mobility == 1


def test_links_of_one_joint_and_of_none() -> None:
    assert build(**oldham(tongue2=slide("disc", "shaft2", 2.0, "O2"))).structure.cls == 2
    trammel = {
        "joints": {"B": (1, 0), "C": (0, 1)},
        "links": {"ground": [], "sx": "B", "sy": "C", "rod": "BC"},
        "slides": {"x": slide("sx", "ground", 0), "y": slide("sy", "ground", math.pi / 2)},
    }
    for driver in ("rod", "x"):
        assert build(**trammel, driver=driver).structure.mobility == 1


def test_the_ground_may_be_the_sliding_link() -> None:
    m = build(**engine(bore=slide("ground", "piston", 0.0, "B")))
    assert m.structure.groups[0].kind == "RRP"


# -- classes above II ----------------------------------------------------------------------------

TRIAD: Table = {
    "joints": {"O": (0, 0), "A": (0.3, 0.2), "B": (1, 2), "C": (2.5, 1.5), "D": (2, 3), "E": (4, 0)}
    | {"F": (0, 4)},
    "links": {"ground": "OEF", "crank": "OA", "b1": "AB", "plate": "BCD", "b2": "CE", "b3": "DF"},
}
QUADRILATERAL: Table = {
    "joints": {"O": (0, 0), "A": (0.3, 0.2), "P": (1, 2), "Q": (1.5, 0.7), "R": (2.5, 2.2)}
    | {"S": (3, 0.5), "E": (4, 0.2)},
    "links": {"ground": "OE", "crank": "OA", "t1": "APQ", "t2": "ERS", "p": "PR", "q": "QS"},
}


def class_iv() -> Table:
    """P4 at crank angle 0."""
    places = {"1": (0, 0), "2": (0.35, 0), "3": (1.24, 0.99), "4": (0.75, 1.91), "6": (2.45, 1.02)}
    places |= {"8": (1.85, 2.35), "5": (3.02, -0.73), "9": (1.62, -1.11), "7": (3.2, 2.24)}
    links = {"ground": ["1", "9", "10"], "crank": "12", "l234": "234", "l365": "365", "l48": "48"}
    links |= {"l876": "876", "l95": "95", "l107": ["10", "7"]}
    return {"joints": {**places, "10": (4.28, 1.52)}, "links": links}


def ring(sides: int) -> Table:
    """A closed contour of so many links, each hung on a bar: class and order `sides`."""
    joints: Table = {"O": (0, 0), "A": (0.5, 0.1)}
    links: Table = {"ground": ["O"], "crank": ["O", "A"]}
    for i in range(sides):
        corner, middle = math.tau * i / sides, math.tau * (i + 0.5) / sides
        joints[f"V{i}"] = (3 + (1 + 0.03 * i) * math.cos(corner), 3 + math.sin(corner))
        joints[f"X{i}"] = (3 + 1.8 * math.cos(middle), 3 + 1.7 * math.sin(middle))
        links[f"R{i}"] = [f"V{i}", f"V{(i + 1) % sides}", f"X{i}"]
        links[f"bar{i}"] = [f"G{i}" if i else "A", f"X{i}"]
        if i:
            joints[f"G{i}"] = (3 + 3.8 * math.cos(middle + 0.3), 3 + 3.7 * math.sin(middle + 0.3))
            links["ground"].append(f"G{i}")
    return {"joints": joints, "links": links}


@pytest.mark.parametrize(
    ("parts", "cls", "order", "formula"),
    [
        (TRIAD, 3, 3, "I(crank) → III(b1, plate, b2, b3)"),
        (QUADRILATERAL, 4, 2, "I(crank) → IV(t1, t2, p, q)"),
        (class_iv(), 4, 3, "I(crank) → IV(l234, l365, l48, l876, l95, l107)"),
        (ring(4), 4, 4, None),
        (ring(5), 5, 5, None),
    ],
)
def test_higher_classes_are_recognised(
    parts: Table, cls: int, order: int, formula: str | None
) -> None:
    m = build(**parts)
    (group,) = m.structure.groups
    assert (group.cls, group.order, group.kind, m.structure.cls) == (cls, order, None, cls)
    assert formula is None or m.structure.formula == formula
