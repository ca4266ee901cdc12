"""What does not carry over is said, and the rest is a mechanism."""

from __future__ import annotations

from urllib.parse import quote

import pytest

import assur
from assur import importers
from importers.foreign_more import LINKAGE, PYLINKAGE
from importers.pmks_plus_writer import Joint, Link, written

BAR = "ground a R 0 0 0 ffft\na b R 0 1\nb c R 3 2\nc ground R 4 0\n"
XML = LINKAGE["two inputs"].text
SLIDERS = LINKAGE["sliders on a moving link and between anchors"].text


def said(text: str, sentence: str) -> assur.Mechanism:
    """The mechanism of a text, which must come with a sentence."""
    found = importers.read(text)
    assert sentence in found.omitted
    return found.mechanism


def test_links_without_a_frame() -> None:
    mechanism = said(
        BAR + "d e R 8 8\ne f R 9 9\nd f R 7 9",
        "Links d, e and f are not connected with the frame: left out.",
    )
    assert mechanism.links.keys() == {"ground", "a", "b", "c"}
    assert mechanism.joints.keys() == {"J1", "J2", "J3", "J4"}


def test_links_of_one_joint() -> None:
    mechanism = said(BAR + "c x R 3.5 1", "Link x is held by a single joint: left out.")
    assert mechanism.links["c"] == ("J3", "J4", "J5")
    text = BAR + "c x y R 3.5 1"
    assert said(text, "Links x and y are held by a single joint: left out.") == mechanism


def test_a_link_that_the_frame_holds_twice() -> None:
    mechanism = said(
        BAR.replace("R 4 0", "d R 4 0") + "d ground R 6 0\n",
        "Link d has two joints on the frame: it is part of it.",
    )
    assert mechanism.links["ground"] == ("J1", "J4", "J5")


def test_the_last_of_several_inputs_drives() -> None:
    text = BAR.replace("R 4 0", "R 4 0 0 ffft")
    mechanism = said(
        text, "Joints J1 and J4 are marked as inputs: as in PMKS, the last one drives."
    )
    assert mechanism.driver == "c"


def test_names_that_assur_does_not_take() -> None:
    text = BAR.replace("b", "b.1").replace("c ", "(c) ").replace(" a", " J1").replace("\na", "\nJ1")
    found = importers.read(text)
    assert found.omitted == (
        "Link 'J1' is called J1_2.",
        "Link 'b.1' is called b_1.",
        "Link '(c)' is called _c_.",
    )
    assert found.mechanism.links.keys() == {"ground", "J1_2", "b_1", "_c_"}
    assert found.mechanism.driver == "J1_2"


def test_a_moving_link_called_ground() -> None:
    text = PYLINKAGE["four-bar, tracker, steps"].text.replace('"rod"', '"ground"')
    mechanism = said(text, "Link 'ground ' is called ground_.")
    assert mechanism.links["ground_"] == ("A", "B", "T")
    text = LINKAGE["two inputs"].text.replace('<Link id="2">', '<Link id="2" name="ground">')
    assert importers.read(text).mechanism.links["ground_2"] == ("c2", "c3")


def test_a_slider_without_limits_is_a_pin() -> None:
    text = XML.replace('x="0.7" y="1.2"', 'x="0.7" y="1.2" slider="true"')
    mechanism = said(text, "Slider c3 has no two limits: it is a pin.")
    assert mechanism == importers.read(XML).mechanism


def test_measuring_lines_and_inputs_that_turn_nothing() -> None:
    more = (
        '<connector id="8" x="5" y="5" anchor="true" input="true"/>'
        '<Link id="9" measurementelement="true"><connector id="2"/><connector id="4"/></Link>'
        "</linkage2>"
    )
    text = XML.replace("</linkage2>", more)
    mechanism = said(text, "Drawing L9 is left out.")
    assert mechanism == said(text, "Input c8 has no link: left out.")
    assert mechanism.driver == ("L1", "L4")


def test_a_bead_in_a_slot() -> None:
    bead = (
        '<connector id="8" x="2.5" y="1" slider="true"><slidelimit id="2"/><slidelimit id="3"/>'
        "</connector></linkage2>"
    )
    mechanism = said(
        SLIDERS.replace("</linkage2>", bead), "Joint c8 slides and carries no link: left out."
    )
    assert mechanism == importers.read(SLIDERS).mechanism


def test_welded_links_are_one() -> None:
    joints = [
        Joint("A", (0, 0), "input frame"),
        Joint("B", (0, 1)),
        Joint("C", (2, 2), "weld"),
        Joint("D", (3, 2)),
        Joint("E", (4, 0), "frame"),
    ]
    text = written(joints, [Link("AB", "AB"), Link("BC", "BC"), Link("CD", "CD"), Link("DE", "DE")])
    mechanism = said(text, "Links BC and CD are welded at C: they are one link, BC.")
    assert mechanism.links["BC"] == ("B", "C", "D")
    assert mechanism.structure.formula == "I(AB) → II(BC, DE)"


def test_ids_of_pmks_plus_may_have_any_letters() -> None:
    joints = [
        Joint("a b", (0, 0), "input frame"),
        Joint("B", (0, 1)),
        Joint("é", (3, 2)),
        Joint("d", (4, 0), "frame"),
    ]
    links = [Link("1", ("a b", "B")), Link("2", ("B", "é")), Link("3", ("é", "d"))]
    found = importers.read(written(joints, links), format="pmks_plus")
    assert found.omitted[-1] == "Joint 'a b' is called a_b."
    assert found.mechanism.links["2"] == ("B", "é")
    # In an address blanks and letters are written with percents.
    address = f"https://pmks.example/?{quote(written(joints, links))}"
    assert importers.read(address).mechanism == found.mechanism


def test_a_whole_turn_of_an_angle_changes_nothing() -> None:
    text = "ground a R 0 0 0 ffft\na b R 0 1\nground b RP 3 0 {}\n"
    first = importers.read(text.format(10)).mechanism
    for angle in (370, -350, 3610):
        again = importers.read(text.format(angle)).mechanism
        assert again.slides["J3_slide"].angle == first.slides["J3_slide"].angle
    opposite = importers.read(text.format(190)).mechanism
    assert opposite.slides["J3_slide"].angle == pytest.approx(-2.9670597283903604, abs=1e-15)
