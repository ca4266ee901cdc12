"""While a mechanism is drawn the studio says what is missing."""

from __future__ import annotations

from typing import Any

import pytest

from asking import FOUR_BAR, ask, refused

WITHOUT_DRIVER = {key: value for key, value in FOUR_BAR.items() if key != "driver"}


def links(**more: Any) -> dict[str, Any]:
    own = {**FOUR_BAR["links"], **more}
    return {**FOUR_BAR, "links": {name: on for name, on in own.items() if on is not None}}


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
    assert (reply["counted"]["mobility"], reply["remedies"]) == (0, [])


def test_loose() -> None:
    reply = ask("check", document=links(rocker=None))
    assert (reply["state"], reply["needed"]) == ("loose", 2)
    assert reply["message"].startswith("Two drivers are needed: with what is driven held, coupler")
    assert reply["concerned"]["links"] == ["coupler"]


@pytest.mark.parametrize(
    ("own", "state", "field", "name"),
    [
        (links(coupler=["B", "C"]), "incomplete", "joint", "P"),
        (links(lost=["E", "F"]), "incomplete", "link", "lost"),
        ({**FOUR_BAR, "driver": "cranck"}, "incomplete", None, None),
        (
            {**FOUR_BAR, "joints": {**FOUR_BAR["joints"], "B": [0, 0]}},
            "incomplete",
            "link",
            "crank",
        ),
        ({**FOUR_BAR, "joints": {**FOUR_BAR["joints"], "B": [0]}}, "invalid", None, None),
        ({**FOUR_BAR, "joints": {**FOUR_BAR["joints"], "B": [1e200, 0]}}, "invalid", "joint", "B"),
    ],
)
def test_what_is_wrong(own: dict[str, Any], state: str, field: str | None, name: str) -> None:
    reply = ask("check", document=own)
    assert (reply["state"], reply["structure"]) == (state, None)
    assert reply["message"]
    if field == "link" and name == "lost":
        assert "E" in reply["message"]
    elif field is not None:
        assert reply[field] == name


@pytest.mark.parametrize(
    "own",
    [7, [], {"joints": 3}, {"links": {"a": 3}}, {"links": {"a": [[]]}}, {"wheels": {}}, "text"],
)
def test_no_documents(own: Any) -> None:
    reply = None
    try:
        reply = ask("check", document=own)
    except AssertionError:
        assert refused("check", document=own)["message"]
    else:
        assert reply["state"] in ("empty", "invalid", "no_driver", "incomplete")
