"""While a mechanism is drawn the studio says what is missing."""

from __future__ import annotations

from typing import Any

import pytest

from studio.asking import FOUR_BAR, PRESS, ask, refused

WITHOUT_DRIVER = {key: value for key, value in FOUR_BAR.items() if key != "driver"}


def links(**more: Any) -> dict[str, Any]:
    own = {**FOUR_BAR["links"], **more}
    return {**FOUR_BAR, "links": {name: on for name, on in own.items() if on is not None}}


def at_b(place: list[float]) -> dict[str, Any]:
    return {**FOUR_BAR, "joints": {**FOUR_BAR["joints"], "B": place}}


def test_states_on_the_way() -> None:
    empty = ask("check", document={})
    assert (empty["state"], empty["counted"]["mobility"]) == ("empty", 0)
    one = {"joints": {"A": [0, 0], "B": [1, 0]}, "links": {"ground": ["A"], "crank": ["A", "B"]}}
    first = ask("check", document=one)
    assert (first["state"], first["candidates"]) == ("no_driver", ["crank"])
    assert first["message"] == "Nothing drives it yet. Click the link that is driven."
    done = ask("check", document=FOUR_BAR)
    assert (done["state"], done["message"]) == ("moves", "Moves: mobility 1.")
    assert done["structure"]["groups"][0]["kind"] == "RRR"


def test_names_in_advice_are_not_concerned() -> None:
    """The message gives ["A", "B"] as a pattern, whatever joints there are."""
    guide = {"link": "rocker", "on": "ground", "along": ["A"]}
    reply = ask("check", document={**FOUR_BAR, "slides": {"s": guide}})
    assert 'needs two joints, ["A", "B"]' in reply["message"]
    assert reply["concerned"] == {"joints": [], "links": [], "slides": []}


def test_candidates_are_tried() -> None:
    reply = ask("check", document=WITHOUT_DRIVER)
    assert reply["candidates"] == ["crank", "rocker"]
    assert reply["structure"]["mobility"] == 1
    assert reply["counted"] == {
        "moving_links": 3,
        "turning_pairs": 4,
        "sliding_pairs": 0,
        "mobility": 1,
    }


@pytest.mark.parametrize("own", [FOUR_BAR, WITHOUT_DRIVER])
def test_stuck(own: dict[str, Any]) -> None:
    braced = {**own, "links": {**own["links"], "brace": ["A", "C"]}}
    reply = ask("check", document=braced)
    assert reply["state"] == "stuck"
    assert reply["message"] == (
        "Cannot move: crank, coupler, rocker and brace hold each other. "
        "Take one out, or let a joint slide."
    )
    assert reply["concerned"]["links"] == ["crank", "coupler", "rocker", "brace"]
    assert reply["counted"]["mobility"] == 0
    assert [one["text"] for one in reply["remedies"]] == [
        "Let brace slide on the ground at A",
        "Take out brace",
        "Add a link between C and brace",
    ]


def test_loose() -> None:
    reply = ask("check", document=links(rocker=None))
    assert (reply["state"], reply["needed"]) == ("loose", 2)
    assert reply["message"].startswith("Two drivers are needed: with what is driven held, coupler")
    assert reply["concerned"]["links"] == ["coupler"]


@pytest.mark.parametrize(
    ("own", "state", "joint", "link", "said"),
    [
        (links(coupler=["B", "C"]), "incomplete", "P", None, 'joint "P" is on no link'),
        (links(lost=["E", "F"]), "incomplete", "E", None, 'link "lost" names the joint "E"'),
        ({**FOUR_BAR, "driver": "cranck"}, "incomplete", None, "cranck", 'did you mean "crank"?'),
        (at_b([0, 0]), "incomplete", "B", "crank", 'link "crank" has length zero'),
        (at_b([0]), "invalid", None, None, "joints.B: has 1 entries"),
        (at_b([1e200, 0]), "invalid", "B", None, 'x coordinate of joint "B" is 1e200'),
    ],
)
def test_what_is_wrong(
    own: dict[str, Any], state: str, joint: str | None, link: str | None, said: str
) -> None:
    reply = ask("check", document=own)
    assert (reply["state"], reply["structure"]) == (state, None)
    assert (reply["joint"], reply["link"]) == (joint, link)
    assert said in reply["message"]


@pytest.mark.parametrize(
    ("own", "said"),
    [
        (7, "is 7: a table is needed"),
        ([], "is an empty list: a table is needed"),
        ("text", "is the text 'text': a table is needed"),
        ({"links": {"a": 3}}, 'links.a: is 3: a list of names, ["A", "B"], is needed'),
        ({"links": {"a": [[]]}}, "links.a[0]: is an empty list: a text in quotes is needed"),
        ({"wheels": {}}, "wheels: unknown key; known are driver, joints, links"),
    ],
)
def test_no_documents(own: Any, said: str) -> None:
    assert refused("check", document=own)["message"].startswith(said)


def test_joints_are_not_read_before_there_is_a_link() -> None:
    assert ask("check", document={"joints": 3})["state"] == "empty"


def made(reply: Any, text: str) -> dict[str, Any]:
    """The document of a remedy; it is what the studio takes."""
    one = next(one for one in reply["remedies"] if one["text"] == text)
    assert ask("check", document=one["document"])["state"] == "moves"
    document: dict[str, Any] = one["document"]
    return document


def test_remedies_are_whole_documents() -> None:
    braced = {
        **links(brace=["P", "F"]),
        "joints": {**FOUR_BAR["joints"], "F": [2.5, 0]},
        "bodies": {"coupler": {"mass": 2, "inertia": 0.1}, "brace": {"mass": 3}},
        "loads": [
            {"type": "Gravity"},
            {"type": "Torque", "on": "rocker", "moment": 2},
            {"type": "Torque", "on": "brace", "moment": 2},
        ],
        "dimensions": {"coupler.length": 4.5, "brace.length": 4.2},
    }
    braced["links"]["ground"] = ["A", "D", "F"]
    reply = ask("check", document=braced)
    assert reply["state"] == "stuck"
    assert [(one["text"], one["detail"], one["kind"]) for one in reply["remedies"]] == [
        ("Let F slide on the ground", "brace stays, its foot follows", "let_slide"),
        ("Take out brace", "crank, coupler and rocker remain", "take_out"),
        ("Add a link between P and brace", "two links in place of one", "part"),
    ]
    taken = made(reply, "Take out brace")
    assert taken["links"] == {**FOUR_BAR["links"], "ground": ["A", "D"]}
    assert taken["bodies"] == {"coupler": {"mass": 2, "inertia": 0.1}}
    assert taken["loads"] == braced["loads"][:2]
    assert taken["dimensions"] == {"coupler.length": 4.5}
    slides = made(reply, "Let F slide on the ground")
    assert slides["bodies"] == braced["bodies"]
    assert slides["loads"] == braced["loads"]
    assert slides["dimensions"] == braced["dimensions"]
    parted = made(reply, "Add a link between P and brace")
    assert parted["dimensions"] == {"coupler.length": 4.5}


def test_remedies_of_what_is_loose_or_without_driver() -> None:
    loose = ask("check", document=links(rocker=None))
    made(loose, "Add a link between C and D")
    made(loose, "Let C slide on the ground")
    assert made(loose, "Drive coupler too")["driver"] == ["crank", "coupler"]
    undriven = ask("check", document=WITHOUT_DRIVER)
    assert undriven["state"] == "no_driver"
    assert made(undriven, "Drive rocker")["driver"] == "rocker"
    unfinished = ask("check", document=links(coupler=["B", "C"]))
    assert (unfinished["state"], unfinished["reason"]) == ("incomplete", "loose_joint")
    assert made(unfinished, "Fix P to coupler")["links"]["coupler"] == ["B", "C", "P"]
    assert "P" not in made(unfinished, "Take out P")["joints"]


def test_motors_stay_with_their_drivers() -> None:
    machine = {**links(rocker=None), "bodies": {"coupler": {"mass": 2}}, "motor": PRESS["motor"]}
    reply = ask("check", document=machine)
    assert made(reply, "Add a link between C and D")["motor"] == PRESS["motor"]
    two = made(reply, "Drive coupler too")
    assert two["motor"] == [PRESS["motor"], {"type": "None"}]
    assert ask("turn", document=two)["payload"]
    many = {**FOUR_BAR, "driver": ["crank", "rocker"], "motor": two["motor"]}
    many["bodies"] = machine["bodies"]
    reply = ask("check", document=many)
    assert made(reply, "Leave rocker undriven")["motor"] == PRESS["motor"]
    assert "motor" not in made(reply, "Leave crank undriven")


def test_cylinders_and_guides_stay_in_remedies() -> None:
    lift = {
        "driver": "lift",
        "joints": {"foot": [0, 0], "eye": [2, 1], "base": [1, -1], "Q": [3, 0]},
        "links": {"ground": ["foot", "base", "Q"], "boom": ["foot", "eye"], "brace": ["eye", "Q"]},
        "slides": {"lift": {"base": "base", "end": "eye"}},
        "dimensions": {"brace.length": 1.5},
    }
    reply = ask("check", document=lift)
    assert reply["state"] == "stuck"
    taken = made(reply, "Take out brace")
    assert taken["slides"] == lift["slides"]
    assert taken["links"] == {"ground": ["foot", "base"], "boom": ["foot", "eye"]}
    guided = {**PRESS}
    guided["slides"] = {"guide": {"link": "ram", "on": "ground", "along": ["O", "B"]}}
    guided["joints"] = {**PRESS["joints"], "E": [0.2, 0.3]}
    guided["links"] = {**PRESS["links"], "rod": ["A", "B", "E"], "brace": ["O", "E"]}
    again = made(ask("check", document=guided), "Take out brace")
    assert again["slides"] == guided["slides"]
    assert again["loads"] == PRESS["loads"]
