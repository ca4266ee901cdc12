"""What cannot be described is refused, with the line or part and the reason."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

import assur
from assur import importers
from importers.foreign import PMKS, PMKS_PLUS
from importers.foreign_more import LINKAGE, PYLINKAGE, PYSLVS
from importers.pmks_plus_writer import Block, Joint, Link, checked, written

if TYPE_CHECKING:
    from pathlib import Path

BAR = "ground a R 0 0 0 ffft\na b R 0 1\nb c R 3 2\nc ground R 4 0\n"
DYADS = '{"joints": [{"type": "Static", "name": "O", "x": 0, "y": 0}, %s]}'
CRANK = '{"type": "Crank", "name": "A", "x": 0, "y": 1, "joint0": {"ref": "O"}, "distance": 1}'
XML = LINKAGE["two inputs"].text
BOMB = (
    '<!DOCTYPE linkage2 [<!ENTITY a "aaaaaaaaaa">'
    + "".join(
        f'<!ENTITY {b} "{f"&{a};" * 10}">' for a, b in zip("abcdefgh", "bcdefghi", strict=True)
    )
    + "]><linkage2>&i;</linkage2>"
)
JSON = PMKS["JSON, three links in two records"].text
BARS = PYLINKAGE["four-bar, tracker, steps"].text
SLIDER = PYLINKAGE["slider on an oblique line, to and fro"].text
EXPRESSION = "M[J[R, P[0, 0], L[ground, a]],\nJ[R, P[0, 1], L[a, b]],\n%s]"
PAIR = [Joint("A", (0, 0), "input frame"), Joint("B", (1, 0)), Joint("C", (3, 1), "frame")]
ARMS = [Link("AB", "AB"), Link("BC", "BC")]

REFUSED = {
    # PMKS
    "a gear": (BAR + "a c G 2 2", "line 5: joint J5 of a and c is a gear mesh"),
    "a line of words": (BAR + "hello there", "line 5: 'hello there' is not a joint"),
    "too few numbers": (BAR + "a R 3", "line 5: joint of a has 1 number:"),
    "no number": (BAR + "a R 3 4m", "line 5: y is '4m': a number is needed"),
    "not a number": (BAR + "a R nan 4", "line 5: x is 'nan': a number is needed"),
    "a huge number": (BAR + "a R 1e300 4", "line 5: x is 1e+300"),
    "a sliding joint of three links": (BAR + "a b c P 1 1 0", "J5 has 3 links, a, b and c"),
    "an input that slides and turns": (
        BAR.replace("ffft", "ffff") + "ground b RP 1 1 0 ffft",
        "line 5: input joint J5 is a pin in a slot",
    ),
    "no frame": ("a b R 0 0\nb c R 1 1\nc a R 2 0", "no driver"),
    "two addresses": ("http://a?mech=a R 0 0\nhttp://a?mech=b R 0 0", "2 linkages (mech=)"),
    "no joint": ("set=s5\nmech=\n", "no line of a joint is there"),
    "an input of three links": (
        "ground a b R 0 0 0 ffft\na c R 1 1\nb d R 1 2\nc d R 4 1",
        "line 1: input joint 'J1' has several links, a and b",
    ),
    "a fixed input": ("ground a R 0 0 0 ffft\na ground R 1 1", "joins no two links"),
    "an index beyond the joints": (JSON.replace('"DrivingIndex": 3', '"DrivingIndex": 6'), "6"),
    "an unknown type": (JSON.replace('"RP"', '"X"'), "Joints[5]: TypeOfJoint is 'X'"),
    "a guide on a moving link": (
        JSON.replace('["ground", "d"]', '["a", "d"]'),
        "Joints[5]: the guide is on the moving link 'a'",
    ),
    "no text": (JSON.replace('"X": 6.0', '"X": "6"x'), "line 7: this is not JSON"),
    "infinity": (JSON.replace('"X": 6.0', '"X": Infinity'), "Infinity is not a number"),
    "joints that are no list": ('{"Joints": 5}', "'Joints' is 5: a list of objects is needed"),
    "a missing place": (JSON.replace('"X": 6.0,', ""), "Joints[5]: X is missing: a number is"),
    "missing links": (JSON.replace('"Links": ["ground", "d"]', '"L": 1'), "'Links' is missing"),
    # PMKS+
    "a cut address": (
        PMKS_PLUS["four-bar, clockwise"].text[:-40],
        "the last letter does not agree with the length",
    ),
    "a joint that does not exist": (
        written(PAIR, [*ARMS, Link("BD", "BD")]),
        "link 'BD' has the joint 'D', which does not exist",
    ),
    "two records of one id": (
        written([*PAIR, Joint("A", (2, 2))], ARMS),
        "two records have the id 'A'",
    ),
    "a slot without its link": (
        written([*PAIR, Joint("S", (1, 1), "slides", slot=("XY", "A", "B"))], ARMS),
        "joint 4: slot of joint 'S': no link has both joints A and B",
    ),
    "a slot with two words": (
        written([*PAIR, Joint("S", (1, 1), "slides", slot=("AB", "A"))], ARMS),
        "joint 4: the slot needs a link and two of its joints",
    ),
    "a slider on nothing": (
        written([*PAIR, Joint("S", (1, 0), "slides")], [*ARMS, Block("BS", "BS")]),
        "joint 4: joint 'S' slides on nothing",
    ),
    "an unknown kind of link": (
        checked(written(PAIR, ARMS)[:-1].replace("YRBC", "ZRBC")),
        "link 2: 'ZRBC",
    ),
    "a joint of two words": (
        checked(written(PAIR, ARMS)[:-1].replace("0B,B's,", "0B")),
        "is not a joint: flags, id, name, x, y and angle are needed",
    ),
    # pylinkage
    "a link with an unknown joint": (
        BARS.replace('["B", "C"]', '["B", "X"]'),
        "links[3]: link 'arm' has the joint 'X', which does not exist",
    ),
    "a motor that moves": (
        BARS.replace('"motor_joint": "O"', '"motor_joint": "A"'),
        "'A' of link 'crank'",
    ),
    "a type that is not known": (
        BARS.replace('"revolute"', '"cam"', 1),
        "the type of joint 'A' is 'cam': one of ground, revolute",
    ),
    "a tracker between links": (
        BARS.replace('"ref_joint2_id": "B"', '"ref_joint2_id": "C"'),
        "tracker 'T': no link has both 'A' and 'C'",
    ),
    "a slider off its line": (
        SLIDER.replace("[1.0, 0.0]", "[1.0, 0.5]"),
        "joints[2]: joint 'S' is 0.447214 off its line",
    ),
    "an axis of no length": (
        SLIDER.replace("[2.0, 1.0]", "[0, 0]"),
        "axis of joint 'S' has no direction",
    ),
    "dyads that do not meet": (
        DYADS
        % (
            CRANK + ', {"type": "Revolute", "name": "B", "x": 1, "y": 1, '
            '"joint0": {"ref": "A"}, "joint1": {"ref": "O"}, "distance0": 9, "distance1": 7}'
        ),
        "joints[2]: the links of joint 'B' miss each other by 1",
    ),
    "a slider out of reach": (
        DYADS
        % (
            CRANK + ', {"type": "Linear", "name": "B", "x": 1, "y": 1, "joint0": {"ref": "A"}, '
            '"joint1": {"inline": true, "x": 0, "y": 4}, "joint2": {"inline": true, "x": 1, "y": 4}, '  # noqa: E501
            '"revolute_radius": 2}'
        ),
        "the link of joint 'B' is 1 too short for its line",
    ),
    "dyads that wait for each other": (
        DYADS % '{"type": "Crank", "name": "A", "joint0": {"ref": "A"}, "distance": 1}',
        "joint 'A' waits for parents that wait for it",
    ),
    "a parent that does not exist": (
        DYADS % CRANK.replace('"O"', '"Q"'),
        "joint0 'Q' does not exist",
    ),
    "a distance that is zero": (DYADS % CRANK.replace("1}", "0}"), "distance of joint 'A' is 0"),
    "no driver in a file": (
        BARS.replace('"driver"', '"link"'),
        "the linkage has no driver: no joint is marked as its input",
    ),
    "a dyad without a parent": (
        DYADS % CRANK.replace("joint0", "joint5"),
        "joints[1]: joint0 of joint 'A' is missing",
    ),
    "a place of three numbers": (
        BARS.replace("[4, 0]", "[4, 0, 0]"),
        "joints[3]: 'position' is [4, 0, 0]: a list of two numbers is needed",
    ),
    # pyslvs
    "an expression without drivers": (EXPRESSION % "", "give drivers=[(0, 1)]"),
    "an unclosed expression": (
        "M[J[R, P[0, 0], L[ground, a]]",
        "line 1: ',' is needed here, not the end",
    ),
    "a wrong type": (
        EXPRESSION % "J[RR, P[0, 0], L[a]]",
        "line 3: R, P or RP is needed here, not 'RR'",
    ),
    "a place of one number": (
        EXPRESSION % "J[R, P[0], L[a]]",
        "line 3: ',' is needed here, not ']'",
    ),
    "no angle": (EXPRESSION % "J[P, P[0, 1], L[a, b]]", "line 3: sliding joint P2 has no angle"),
    "a text behind it": ("M[J[R, P[0, 0], L[a]]] x", "the end is needed here, not 'x'"),
    # Linkage
    "gears": (
        XML.replace(
            "</linkage2>",
            '<ratios>\n<ratio type="gears"><link id="1" size="1"/><link id="3" size="2"/></ratio>\n'
            "</ratios></linkage2>",
        ),
        "links L1 and L3 are joined by gears: they cannot be described",
    ),
    "a curved slot": (
        LINKAGE["sliders on a moving link and between anchors"].text.replace(
            'y="0.5" slider="true"', 'y="0.5" slider="true" slideradius="4"'
        ),
        "line 3: joint c1 slides in a curved slot",
    ),
    "a slot across two links": (
        LINKAGE["sliders on a moving link and between anchors"].text.replace(
            '<slidelimit id="2"/>', '<slidelimit id="7"/>'
        ),
        "joint c1 slides between c7 and c3, which are on different links",
    ),
    "an actuator of three connectors": (
        LINKAGE["actuator, fastened links"].text.replace(
            '<connector id="2"/>\n', '<connector id="0"/><connector id="2"/>\n'
        ),
        "line 7: actuator lift has 3 connectors: two are needed",
    ),
    "an input that moves": (
        XML.replace('x="0" y="0" anchor="true"', 'x="0" y="0"'),
        "is not an anchor",
    ),
    "a second connector": (XML.replace('id="4" x=', 'id="3" x='), "line 4: a second connector 3"),
    "a link on a connector": (
        LINKAGE["actuator, fastened links"].text.replace(
            '"1" fastenlink="0"', '"1" fastenconnector="0"'
        ),
        "line 6: link L1 is fastened to a connector: fasten it to a link",
    ),
    "a slider of its own link": (
        LINKAGE["actuator, fastened links"].text.replace(
            'x="4" y="4"/>',
            'x="4" y="4" slider="true"><slidelimit id="1"/><slidelimit id="3"/></connector>',
        ),
        "line 3: joint c3 cannot slide between c1 and c3",
    ),
    "an id of letters": (XML.replace('id="4" x=', 'id="d" x='), "<connector> has the id 'd'"),
    "unclosed XML": (XML.replace("</linkage2>", ""), "this is not XML: no element found"),
    "another XML": ("<linkage3><linkage2/></linkage3>", "<linkage3> is not <linkage2>"),
    "an entity bomb": (BOMB, "line 1: a document type (<!DOCTYPE) is not read"),
    "a file from elsewhere": (
        '<!DOCTYPE x [<!ENTITY f SYSTEM "file:///etc/hostname">]><linkage2>&f;</linkage2>',
        "a document type (<!DOCTYPE) is not read",
    ),
    "deep nesting": ("<linkage2>" + "<a>" * 100_000, "elements are nested more than 16 deep"),
    # any
    "deep JSON": ('{"joints": ' + "[" * 100_000, "this JSON cannot be read"),
    "a number of many digits": (
        '{"Joints": [{"X": ' + "9" * 5000 + "}]}",
        "this JSON cannot be read",
    ),
    "many joints": ("ground a R 0 0\n" * 501, "more than 500 joints"),
    "a long text": ("x\n" * 600_000, "more than 1000000 letters"),
    "nothing": (" \n", "the text is empty"),
    "a letter": ("Dear friend,\nhello", "the text is of no known format"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refused_with_the_place_and_the_reason(name: str) -> None:
    text, wanted = REFUSED[name]
    with pytest.raises(assur.InputError) as raised:
        importers.read(text)
    assert wanted in str(raised.value)


def test_every_format_has_refusals() -> None:
    own = {importers.detect(None, text) for text, _ in REFUSED.values()}
    assert own >= set(importers.FORMATS)


MECHANICALLY_WRONG = {
    "a truss": (BAR + "a c R 1 2", "mobility"),
    "too loose": (
        BAR.replace("b c R 3 2", "b c R 3 2\nb d R 5 5\nd e R 6 5\ne f R 6 8\nf ground R 7 7"),
        "mobility",
    ),
}


@pytest.mark.parametrize("name", MECHANICALLY_WRONG)
def test_a_wrong_mobility_is_a_structure_error(name: str) -> None:
    text, wanted = MECHANICALLY_WRONG[name]
    with pytest.raises(assur.StructureError, match=wanted):
        importers.read(text)


def test_an_assembly_can_be_named() -> None:
    """A coupler and rocker drawn in line do not show on which side they go on."""
    text = "ground a R 0 0 0 ffft\na b R 0 1\nb c R 2 1\nc ground R 4 1\n"
    with pytest.raises(assur.StructureError, match=r"assembly=\{\"J3\": \+1\}"):
        importers.read(text)
    for sign in (1, -1):
        found = importers.read(text, assembly={"J3": sign}).mechanism
        assert found.assembly == {"J3": sign}


def test_errors_name_the_file(tmp_path: Path) -> None:
    path = tmp_path / "press.txt"
    path.write_text("ground a R 0 0\na R 1", encoding="utf-8")
    with pytest.raises(assur.InputError, match=r"^press\.txt, line 2: joint of a has 1 number:"):
        importers.read(path)
    with pytest.raises(
        assur.InputError, match=r"missing\.pmks.* cannot be read as a file: no such"
    ):
        importers.read(tmp_path / "missing.pmks")
    with pytest.raises(assur.InputError, match=r"^missing\.linkage2 cannot be read as a file"):
        importers.read("missing.linkage2")
    with pytest.raises(assur.InputError, match="cannot be read as a file"):
        importers.read(tmp_path)
    with pytest.raises(assur.InputError, match="5 cannot be read as a file"):
        importers.read(5)  # type: ignore[arg-type]


def test_options_are_checked() -> None:
    with pytest.raises(assur.InputError, match="format is 'sam': one of 'pmks'"):
        importers.read(BAR, format="sam")
    with pytest.raises(assur.InputError, match="this is not JSON"):
        importers.read(BAR, format="pylinkage")
    for scale in (0.0, -1.0, 1e99):
        with pytest.raises(assur.InputError, match="scale is"):
            importers.read(BAR, scale=scale)
    with pytest.raises(assur.InputError, match="scale is 'mm'"):
        importers.read(BAR, scale="mm")  # type: ignore[arg-type]
    with pytest.raises(assur.InputError, match="drivers are for pyslvs"):
        importers.read(BAR, drivers=[(0, 1)])
    text = PYSLVS["four-bar, comments"].text
    for wrong in ([(0, 9)], [(0,)], 5, [(0, 1.0)], ["ab"], [(True, 1)]):
        with pytest.raises(assur.InputError, match="pairs of joints from 0 to 4 are needed"):
            importers.read(text, drivers=wrong)  # type: ignore[arg-type]
    with pytest.raises(assur.InputError, match="must have joints P0 and P2, not none"):
        importers.read(text, drivers=[(0, 2)])
    with pytest.raises(assur.InputError, match="joint P1 does not slide"):
        importers.read(text, drivers=[(1, 1)])


def test_nothing_is_detected_in_other_texts() -> None:
    for text in (
        "",
        "{}",
        '{"nodes": []}',
        "<svg/>",
        "R 1 2",
        "a.b.c",
        "M = 3",
        "\0",
        "format = 1",
    ):
        assert importers.detect(None, text) is None
    assert importers.detect("a.toml", "format = 1\n[joints]\nA = [0, 0]") is None
