"""Edits of the page (edits.mjs runs them in Node): the server reads what they make."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur
from assur.files.node import Node
from assur.files.parts import BODY, LOADS, MOTORS, ROWS, place, point
from assur.files.read_mechanism import CYLINDER, SLIDE
from assur.studio.document import document_of, read
from studio.asking import ask
from support.node import MODULES, run_node
from support.samples import IS_CAMPAIGN

if TYPE_CHECKING:
    from assur.kinematics.mechanism import Mechanism

Document = dict[str, Any]
Edit = list[Any]


def edited(*cases: tuple[Document, list[Edit]]) -> list[Document]:
    """Return each document after its edits."""
    text = run_node(str(MODULES / "edits.mjs"), stdin=json.dumps(cases))
    documents: list[Document] = json.loads(text)
    return documents


def mechanism_of(what: Any) -> Mechanism:
    mechanism: Mechanism = getattr(what, "mechanism", what)
    return mechanism


def positions(mechanism: Mechanism) -> dict[str, Any]:
    """Return all joints over some positions about the drawing."""
    q0 = np.asarray(mechanism.q0, dtype=float)
    steps = np.linspace(0.0, 0.05, 5).reshape(-1, *(1,) * q0.ndim)
    motion = mechanism.solve(q0 + steps, order=0, on_error="nan")
    return {name: motion.joint(name).value for name in mechanism.joints}


def all_names(document: Document) -> list[tuple[str, str]]:
    kinds = (("renameJoint", "joints"), ("renameLink", "links"), ("renameSlide", "slides"))
    return [
        (edit, name) for edit, key in kinds for name in document.get(key, ()) if name != "ground"
    ]


@pytest.fixture(scope="module")
def examples() -> dict[str, Any]:
    return {name: make() for name, make in assur.examples.ALL.items()}


def test_renamed_examples_move_as_before(examples: dict[str, Any]) -> None:
    documents = {name: document_of(one) for name, one in examples.items()}
    # All at once, and their links and cylinders too; every name is another one afterwards.
    edits = {
        name: [[edit, own, f"{own}_new"] for edit, own in all_names(document)]
        for name, document in documents.items()
    }
    after = edited(*((documents[name], edits[name]) for name in documents))
    assert len(after) == 30
    for name, document in zip(documents, after, strict=True):
        before, now = mechanism_of(examples[name]), read(document)
        assert ("bodies" in document) == (now.machine is not None)
        assert all(own.endswith("_new") for own in now.mechanism.joints)
        wanted, found = positions(before), positions(now.mechanism)
        assert np.isfinite(np.array(list(wanted.values()))[:, 0]).all()
        for joint, places in wanted.items():
            assert np.array_equal(places, found[f"{joint}_new"], equal_nan=True), (name, joint)
        assert list(now.mechanism.dimensions.values()) == list(before.dimensions.values())


def test_machines_renamed_have_the_same_forces(examples: dict[str, Any]) -> None:
    squeezer = examples["andrews_squeezer"]
    document = document_of(squeezer)
    (after,) = edited((document, [[e, own, f"{own}_new"] for e, own in all_names(document)]))
    now = read(after).machine
    assert now is not None
    q0 = squeezer.mechanism.q0
    wanted, found = (one.reactions(q0, speed=3.0) for one in (squeezer, now))
    assert np.array_equal(wanted.driver, found.driver)


def test_a_place_found_elsewhere_is_renamed(examples: dict[str, Any]) -> None:
    triad = examples["triad"]
    other = triad.with_assembly(triad.assemblies(triad.q0)[1])
    document = document_of(other)
    assert "drawn" in document
    (after,) = edited((document, [[e, own, f"{own}_new"] for e, own in all_names(document)]))
    wanted, found = positions(other), positions(read(after).mechanism)
    assert all(np.array_equal(at, found[f"{joint}_new"]) for joint, at in wanted.items())


def test_dimensions_of_a_place_found_elsewhere(examples: dict[str, Any]) -> None:
    triad = examples["triad"]
    other = triad.with_assembly(triad.assemblies(triad.q0)[1])
    length = other.dimensions["left.length"] * 1.01
    wanted = other.with_dimensions({"left.length": length})
    twice = [
        ["setDimension", "left.length", 1.005 * length],
        ["setDimension", "left.length", length],
    ]
    (after,) = edited((document_of(other), twice))
    found = read(after).mechanism
    assert found.dimensions["left.length"] == length
    assert all(np.array_equal(at, positions(found)[j]) for j, at in positions(wanted).items())


def test_redrawn_documents_move_as_before(examples: dict[str, Any]) -> None:
    """Drawn at a position that is not the drawing's, without dimensions or assembly."""
    cases, wanted = [], []
    for name in ("crank_rocker", "engine", "shaper", "excavator", "triad", "watt_1"):
        mechanism = mechanism_of(examples[name])
        sized = {
            key: 1.01 * mechanism.dimensions[key]
            for key in mechanism.dimensions
            if key.endswith(".length")
        }
        design = mechanism.with_dimensions(sized)
        q = np.asarray(design.q0) + 0.02
        motion = design.solve(q, order=0)
        places = {joint: motion.joint(joint).value.tolist() for joint in design.joints}
        angles = {
            slide: float(motion.link(own.on).value) + design.dimensions.get(f"{slide}.angle", 0.0)
            for slide, own in design.slides.items()
        }
        cases.append((document_of(design), [["redrawn", places, angles]]))
        wanted.append((name, design, motion, q))
    for (name, design, motion, q), document in zip(wanted, edited(*cases), strict=True):
        assert "dimensions" not in document
        drawn = read(document).mechanism
        size = float(np.ptp(np.array(list(design.joints.values())), axis=0).max())
        for key, value in design.dimensions.items():
            assert abs(drawn.dimensions[key] - value) < 1e-9 * max(size, 1.0), (name, key)
        there = drawn.solve(np.asarray(q), order=0)
        for joint in design.joints:
            assert np.allclose(
                there.joint(joint).value, motion.joint(joint).value, atol=1e-9 * size
            )


def test_what_is_left_is_understood(examples: dict[str, Any]) -> None:
    cases = []
    for name, one in examples.items():
        document = document_of(one)
        joints = list(document["joints"])
        cuts: list[Edit] = [["removeJoint", joint] for joint in joints]
        cuts += [["removeLink", link] for link in document["links"]]
        cuts += [["removeSlide", slide] for slide in document.get("slides", ())]
        cuts += [["mergeJoints", joints[-1], joint] for joint in joints[:-1]]
        cuts += [["setGround", joint, joint not in document["links"]["ground"]] for joint in joints]
        cuts += [["joinToLink", joints[0], link] for link in document["links"]]
        cuts += [["withoutCylinder", slide] for slide in document.get("slides", ())]
        cases += [(name, document, [cut]) for cut in cuts]
    # Every third; `make campaign` makes all.
    cases = cases if IS_CAMPAIGN else cases[::3]
    after = edited(*((document, cut) for _, document, cut in cases))
    seen: set[str] = set()
    for (name, _, cut), document in zip(cases, after, strict=True):
        reply = ask("check", document=document).header
        # Something is missing or too much, but all that is named is there.
        assert reply["state"] != "invalid", (name, cut, reply)
        assert reply.get("reason") != "unknown", (name, cut, reply)
        if cut[0][0] == "removeJoint":
            assert reply.get("reason") != "unplaced", (name, cut, reply)
        seen.add(reply["state"])
    assert seen >= {"moves", "loose", "stuck", "no_driver", "incomplete"}


def test_places_of_names_are_those_of_files() -> None:
    """What edits.test.js has at every place is all that a file can name."""
    entries = [entry for words in LOADS.values() for entry in words.items()]
    texts = {key for key, reader in [*entries, *ROWS.items()] if reader is Node.text}
    assert texts == {"link", "on", "axes", "slide", "over", "while_", "expands", "spline"}
    assert {key for key, reader in entries if reader is point} == {"at", "first", "second"}
    assert [key for key, reader in BODY.items() if reader is place] == ["at"]
    assert (SLIDE, CYLINDER) == (
        ("link", "on", "angle", "origin", "along", "length"),
        ("base", "end", "barrel", "rod"),
    )
    motors = [entry for words in MOTORS.values() for entry in words.items()]
    assert {key for key, reader in motors if reader is Node.text} == {"spline"}


def test_names_are_allowed_as_the_core_allows_them() -> None:
    letters = [chr(i) for i in (*range(1, 0x3100), *range(0xFE00, 0x10000), 0x1F600, 0xE0001)]
    assert not any("\ud800" <= letter <= "\udfff" for letter in letters)
    names = [f"a{letter}b" for letter in letters]
    found = edited(*(({}, [["nameError", name]]) for name in names))
    answers: list[Any] = list(found)
    for name, error in zip(names, answers, strict=True):
        assert (None if error is None else error["error"]) == refusal(name), ascii(name)


def refusal(name: str) -> str | None:
    """Return what the core says of a name, by the page's key."""
    links = {"ground": ["A"], "crank": ["A", name]}
    try:
        assur.Mechanism({"A": (0, 0), name: (1, 0)}, links, "crank")
    except assur.AssurError as error:
        return "badName" if error.kind == "bad_name" else error.kind
    return None


def test_a_crank_rocker_and_a_slider_crank_from_nothing() -> None:
    drawn: list[Edit] = [["addJoint", at] for at in ([0, 0], [0, 0.1], [0.4, 0], [0.3, 0.3])]
    drawn += [["setGround", "A", True], ["addLink", ["A", "B"]], ["addLink", ["B", "C"]]]
    drive: list[Edit] = [["setDriver", "crank"], ["removeJoint", "D"]]
    slide: Edit = ["addSlide", {"joint": "C", "origin": "A"}]
    rocker: list[Edit] = [["setGround", "D", True], ["addLink", ["D", "C"]], ["setDriver", "crank"]]
    lift: list[Edit] = [
        ["setGround", "D", True],
        ["addCylinder", "D", "B"],
        ["setDriver", "cylinder1"],
    ]
    lift += [["removeLink", "link1"]]
    after = edited(({}, [*drawn, slide, *drive]), ({}, [*drawn, *rocker]), ({}, [*drawn, *lift]))
    formulas = [read(document).mechanism.structure.formula for document in after]
    assert formulas == [
        "I(crank) → II(link1, block1)",
        "I(crank) → II(link1, link2)",
        "I(cylinder1) → II(crank, cylinder1_barrel, cylinder1_rod)",
    ]
