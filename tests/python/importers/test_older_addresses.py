"""Older addresses of PMKS+: fields j, l, f, s with rows parted by line ends."""

from __future__ import annotations

import math
import random
from urllib.parse import quote

import numpy as np
import pytest

import assur
from assur import importers

JOINTS = (
    "A,0,0,AB,R,t,0,0.1,t,",
    "AB,0,1,AB|BC,R,f,0,0.1,f,",
    "C,3,2.5,BC|CD,R,f,0,0.1,f,",
    "D,4,0,CD,R,t,0,0.1,f,",
)
JOINTS = (JOINTS[0], JOINTS[1].replace("AB,0", "B,0", 1), *JOINTS[2:])
LINKS = (
    "AB,2,0.3,0,0.5,A|B,,l,0,0,0,1,0,1,0,0",
    "BC,2,0.3,1.5,1.75,B|C,,l,0,1,3,1,3,2.5,0,2.5",
    "CD,2,0.3,3.5,1.25,C|D,F1,l,3,0,4,0,4,2.5,3,2.5",
)
FORCE = "F1,CD,3.5,1.25,3.5,0.5,t,true,0,-50"


def address(
    joints: tuple[str, ...] = JOINTS,
    links: tuple[str, ...] = LINKS,
    forces: tuple[str, ...] = (FORCE,),
    settings: str = "20,false,true,m",
    encoded: bool = True,
) -> str:
    fields = {"j": joints, "l": links, "f": forces}
    found = {name: "".join(f"{row}\n" for row in rows) for name, rows in fields.items()}
    found |= {"pp": "", "tp": "", "s": settings}
    text = "&".join(f"{name}={quote(rows, safe=',')}" for name, rows in found.items())
    return "https://linkages.example.org/?" + (text if encoded else text.replace("%7C", "|"))


@pytest.mark.parametrize("encoded", [True, False])
def test_a_four_bar(encoded: bool) -> None:
    text = address(encoded=encoded)
    assert importers.detect(None, text) == "pmks_plus"
    for found in (
        importers.read(text),
        importers.pmks_plus.read(text),
        importers.read(text, format="pmks_plus"),
    ):
        assert found.format == "pmks_plus"
        assert found.mechanism.structure.formula == "I(AB) → II(BC, CD)"
        assert dict(found.mechanism.joints) == {
            "A": (0, 0),
            "B": (0, 1),
            "C": (3, 2.5),
            "D": (4, 0),
        }
        assert found.input_speed == pytest.approx(20 * math.tau / 60, rel=1e-15)
        assert found.omitted == (
            "Gravity is left out.",
            "Masses, inertias and centres of mass are left out.",
            "Forces are left out: F1.",
        )


def test_clockwise_inputs_turn_back() -> None:
    found = importers.read(address(settings="20,true,false,m"))
    assert found.input_speed == pytest.approx(-20 * math.tau / 60)
    assert "Gravity" not in " ".join(found.omitted)
    still = importers.read(address(settings="0,true,false,m")).input_speed
    assert isinstance(still, float)
    assert math.copysign(1.0, still) == 1.0
    assert importers.read(address(settings="")).input_speed is None


@pytest.mark.parametrize(("unit", "said"), [("cm", "scale=0.01"), ("inch", "scale=0.0254")])
def test_units_are_said(unit: str, said: str) -> None:
    text = address(settings=f"20,false,false,{unit}")
    found = importers.read(text)
    assert found.mechanism.joints["B"] == (0, 1)
    assert any(said in sentence for sentence in found.omitted)
    scaled = importers.read(text, scale=0.01)
    assert scaled.mechanism.joints["B"] == (0, 0.01)
    assert not any("stand" in sentence for sentence in scaled.omitted)
    unknown = importers.read(address(settings="20,false,false,parsec"))
    assert any("parsec is not known" in sentence for sentence in unknown.omitted)


SLIDER = (*JOINTS[:2], "C,3,0,BC,P,t,30,0.1,f,")


def test_a_joint_that_slides_on_the_frame() -> None:
    found = importers.read(address(SLIDER, LINKS[:2], ()))
    slide = found.mechanism.slides["C_slide"]
    assert slide.on == "ground"
    assert slide.angle == pytest.approx(math.radians(30))
    assert found.mechanism.structure.formula == "I(AB) → II(BC, C_block)"
    assert any("angle 30 is read in degrees" in sentence for sentence in found.omitted)


def test_two_inputs() -> None:
    joints = (*JOINTS[:3], "E,5,1,CE|DE,R,f,0,0.1,f,", "D,4,0,DE,R,t,0,0.1,t,")
    own = tuple(row.replace("BC|CD", "BC|CE") for row in joints)
    links = (*LINKS[:2], "CE,1,1,0,0,C|E,,l", "DE,1,1,0,0,D|E,,l")
    found = importers.read(address(own, links, ()))
    assert found.mechanism.driver == ("AB", "DE")
    assert np.array(found.input_speed) == pytest.approx([2 * math.tau / 6] * 2)


def test_three_points_on_a_link() -> None:
    joints = (*JOINTS, "P,1.5,3,BC,R,f,0,0.1,f,")
    links = (LINKS[0], LINKS[1].replace("B|C", "B|C|P"), LINKS[2])
    found = importers.read(address(joints, links))
    assert found.mechanism.links["BC"] == ("B", "C", "P")


REFUSED = {
    "a joint without a type": (JOINTS[0].replace(",R,", ",X,"), "the type of joint 'A' is 'X'"),
    "a place that is no number": (JOINTS[0].replace("A,0", "A,x"), "x is 'x': a number is needed"),
    "a short row": ("A,0,0", "joint 1: 3 words, 'A,0,0': id, x, y, links"),
    "a flag": (JOINTS[0].replace("R,t", "R,y"), "on the frame is 'y': t or f is needed"),
    "a link that does not have it": (
        JOINTS[0].replace("AB", "AB|ZZ"),
        "joint 'A' is on link 'ZZ', which does not have it",
    ),
    "a guide on a moving link": (
        JOINTS[0].replace("R,t", "P,f"),
        "joint 'A' slides on a moving link, and the address does not say on which",
    ),
    "a second joint": (JOINTS[1], "a second joint 'B'"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_cannot_be_read_is_named(name: str) -> None:
    row, message = REFUSED[name]
    with pytest.raises(assur.InputError, match="joint") as caught:
        importers.read(address((row, *JOINTS[1:])))
    assert message in str(caught.value)


def test_links_without_joints_are_refused() -> None:
    for row, message in (
        ("AB,2,0.3", "is not a link"),
        ("AB,2,0.3,0,0.5,A|Z,", "has the joint 'Z', which does not exist"),
        (LINKS[1], "a second link 'BC'"),
    ):
        with pytest.raises(assur.InputError, match=message):
            importers.read(address(links=(row, *LINKS[1:])))
    with pytest.raises(assur.InputError, match="no joint is there"):
        importers.read("https://linkages.example.org/?j=&l=&s=")


def test_broken_addresses_raise_errors_of_assur() -> None:
    whole, rng = address(), random.Random(3)
    letters = [*"tfRP|,%&=.-0123456789AB", "%0A", "%00", "%ff", "nan", "1e999", "\n", "é", "*"]
    built = 0
    for _ in range(800):
        text = whole
        for _ in range(rng.choice((1, 1, 2, 4))):
            at = rng.randrange(30, len(text))
            text = text[:at] + rng.choice(letters) + text[at + rng.choice((0, 1, 3)) :]
        try:
            found = importers.read(text, format="pmks_plus")
        except (assur.InputError, assur.StructureError):
            # Any other exception would fail the test.
            continue
        else:
            assert np.isfinite(found.mechanism.q0).all()
            built += 1
    assert 50 < built < 790


def test_digits_of_the_address_are_kept() -> None:
    rows = (JOINTS[0], "B,0.123456789012,1,AB|BC,R,f,0,0.1,f,", *JOINTS[2:])
    assert importers.read(address(rows)).mechanism.joints["B"] == (0.123456789012, 1)
