"""What is offered where a linkage is refused: changes that were tried, in plain words."""

from __future__ import annotations

import copy
import math
import pickle
import re
from pathlib import Path
from typing import Any

import pytest

import assur
from models.errors.refusals import FIVE, FIVE_LINKS, build, engine, joint, link, slide, twice

ROOT = Path(__file__).parents[3]
ENUM = (ROOT / "rust/core/src/remedies/remedy.rs").read_text(encoding="utf-8")
VARIANTS = re.findall(r"^    (\w+),$", ENUM, re.MULTILINE)
KINDS = {re.sub(r"\B(?=[A-Z])", "_", variant).lower() for variant in VARIANTS}

BRACED: dict[str, Any] = {
    "joints": {
        "A": (0, 0),
        "B": (0.6, 1.7),
        "C": (5.3, 3.7),
        "D": (6.2, 0),
        "E": (3.0, 1.56),
        "F": (3.5, 0),
    },
    "links": {"ground": "ADF", "crank": "AB", "coupler": "BCE", "rocker": "CD", "brace": "EF"},
    "driver": "crank",
}
TRUSS: dict[str, Any] = {
    "joints": {"A": (0, 0), "B": (2, 1.5), "C": (4, 0), "D": (6, 1.5)},
    "links": {"ground": "AC", "l1": "AB", "l2": "BC", "l3": "BD", "l4": "CD"},
    "driver": "l1",
}
PENDULUM: dict[str, Any] = {
    "joints": {"A": (0, 0), "B": (1, 2), "C": (4, 2.5)},
    "links": {"ground": "A", "upper": "AB", "lower": "BC"},
    "driver": "upper",
}
# A crank and a rocker, each with a block; the blocks are pinned to each other.
SLOTS: dict[str, Any] = {
    "joints": {"O": (0, 0), "C": (2, 1), "D": (4, 0)},
    "links": {"ground": "OD", "crank": "O", "rocker": "D", "b1": "C", "b2": "C"},
    "slides": {
        "s1": slide("b1", "crank", math.atan2(1, 2), "O"),
        "s2": slide("b2", "rocker", math.atan2(1, -2), "D"),
    },
    "driver": "crank",
}


def error_of(**changed: Any) -> assur.StructureError:
    with pytest.raises(assur.StructureError) as caught:
        build(**changed)
    return caught.value


def texts(error: assur.StructureError) -> list[str]:
    """The remedies' texts; each makes a mechanism."""
    for remedy in error.remedies:
        structure = assur.Mechanism(**remedy.arguments).structure
        drivers = remedy.arguments["driver"]
        count = len(drivers) if isinstance(drivers, list) else 1
        assert structure.mobility == structure.mobility_at_drawing == count, remedy
    return [remedy.text for remedy in error.remedies]


def test_a_brace() -> None:
    error = error_of(**BRACED)
    assert [str(remedy) for remedy in error.remedies] == [
        "Let F slide on the ground: brace stays, its foot follows",
        "Take out brace: crank, coupler and rocker remain",
        "Add a link between E and brace: two links in place of one",
    ]
    assert [remedy.kind for remedy in error.remedies] == ["let_slide", "take_out", "part"]
    slides, without, parted = (assur.Mechanism(**one.arguments) for one in error.remedies)
    assert slides.links["F_block"] == ("F",)
    assert (slides.slides["F_slide"].link, slides.slides["F_slide"].on) == ("F_block", "ground")
    # The guide is along AD or square to it.
    assert abs(slides.slides["F_slide"].angle) in (0.0, pytest.approx(1.5707963267948966))
    assert set(without.links) == {"ground", "crank", "coupler", "rocker"}
    assert set(without.joints) == {"A", "B", "C", "D", "E"}
    assert (parted.links["brace"], parted.links["brace2"]) == (("G", "F"), ("E", "G"))
    for mechanism in (slides, without, parted):
        assert mechanism.structure.groups[0].links == ("coupler", "rocker")
        assert mechanism.joints["C"] == BRACED["joints"]["C"]


IN_PLAIN_WORDS: list[tuple[dict[str, Any], list[str]]] = [
    (
        TRUSS,
        [
            "Let l2 slide on the ground at C",
            "Take out l2",
            "Add a link between B and l2",
        ],
    ),
    (
        PENDULUM,
        [
            "Add a link between C and the ground",
            "Let C slide on the ground",
            "Drive lower too",
        ],
    ),
    (
        engine() | {"slides": {}},
        [
            "Let piston slide on the ground",
            "Drive rod and piston too",
            "Take out piston and rod",
        ],
    ),
    (twice(driver="crank"), ["Drive crank2 too"]),
    (twice(driver=["crank", "rocker"]), ["Drive crank2 instead of rocker"]),
    ({"joints": FIVE, "links": FIVE_LINKS, "driver": "left"}, ["Drive right too"]),
    ({"driver": ["crank", "rocker"]}, ["Leave rocker undriven", "Leave crank undriven"]),
    ({"driver": "cranck"}, ["Drive crank instead of cranck"]),
    ({"driver": "ground"}, ["Drive crank instead of ground"]),
    ({"driver": []}, ["Drive crank", "Drive rocker", "Drive coupler"]),
    (engine("piston"), ["Drive crank instead of piston", "Drive bore instead of piston"]),
    (joint(Q=(9, 9)), ["Fix Q to coupler", "Fix Q to rocker", "Take out Q"]),
    (joint(Q=(9, 9), R=(1, 9)) | link(x="QR"), ["Take out x"]),
    (link(ground=[]), ["Hold A and D on the ground"]),
    (link(ground="A"), ["Hold D on the ground"]),
    (
        SLOTS,
        ["Drive rocker too", "Add a link between D and C", "Make b1 and b2 one link"],
    ),
]


@pytest.mark.parametrize(("changed", "wanted"), IN_PLAIN_WORDS)
def test_in_plain_words(changed: dict[str, Any], wanted: list[str]) -> None:
    assert texts(error_of(**changed))[: len(wanted)] == wanted


def test_every_kind_is_offered_and_in_the_docstring() -> None:
    offered = {one.kind for parts, _ in IN_PLAIN_WORDS for one in error_of(**parts).remedies}
    assert offered == KINDS
    assert set(re.findall(r"``\"(\w+)\"``", assur.Remedy.__doc__ or "")) == KINDS


def test_nothing_for_names_and_numbers() -> None:
    assert error_of(**joint(P=(float("nan"), 0))).remedies == ()
    assert error_of(**link(**{"a b": "AC"})).remedies == ()
    assert assur.StructureError("of no description").remedies == ()


def test_signs_of_dyads_that_are_gone_go() -> None:
    changed = {**BRACED, "assembly": {"C": 1}}
    assert error_of(**changed).remedies[1].arguments["assembly"] == {"C": 1}
    held = {**BRACED, "links": {**BRACED["links"], "brace": "EF", "b2": "DE"}, "assembly": {"E": 1}}
    (taken,) = error_of(**held).remedies
    assert "E" not in taken.arguments["assembly"]


def test_relative_drives_stay() -> None:
    arm = {
        "joints": {"A": (0, 0), "B": (1, 2), "C": (4, 2.5), "D": (5, 4)},
        "links": {"ground": "A", "upper": "AB", "fore": "BC", "hand": "CD"},
        "driver": ["upper", assur.Drive("fore", relative_to="upper")],
    }
    remedies = error_of(**arm).remedies
    assert len(remedies) == 3
    for remedy in remedies:
        drivers = remedy.arguments["driver"]
        assert isinstance(drivers, list)
        assert drivers[:2] == arm["driver"]


def test_remedies_are_kept_by_copies() -> None:
    asked, unasked = error_of(**BRACED), error_of(**BRACED)
    wanted = asked.remedies
    assert asked.remedies is wanted
    for error in (asked, unasked):
        for other in (copy.copy(error), pickle.loads(pickle.dumps(error))):
            assert other.remedies == wanted
    assert hash(wanted[0]) == hash(unasked.remedies[0])
    assert repr(wanted[1]) == "<assur.Remedy Take out brace>"
    # What a caller changes is not kept.
    wanted[0].arguments["links"].clear()
    assert wanted[0].arguments["links"]


def stages(count: int) -> dict[str, Any]:
    """Parallelograms in a row, each rocker the next one's crank; a brace holds the first."""
    joints: dict[str, Any] = {"A": (0, 0), "B": (0.3, 1.0)}
    links: dict[str, list[str]] = {"ground": ["A"], "crank": ["A", "B"]}
    pin = "B"
    for k in range(count):
        x = 2.0 * (k + 1)
        joints |= {f"C{k}": (x + 0.3, 1.0), f"D{k}": (x, 0)}
        links["ground"].append(f"D{k}")
        links[f"coupler{k}"] = [pin, f"C{k}"]
        links[f"rocker{k}"] = [f"D{k}", f"C{k}"]
        pin = f"C{k}"
    links["brace"] = ["A", "C0"]
    return {"joints": joints, "links": links, "driver": "crank"}


def test_of_two_hundred_links_the_one_that_is_too_many_is_found() -> None:
    remedies = error_of(**stages(99)).remedies
    assert "Take out brace" in [remedy.text for remedy in remedies]


def test_of_very_many_links_nothing_is_tried() -> None:
    assert error_of(**stages(300)).remedies == ()
