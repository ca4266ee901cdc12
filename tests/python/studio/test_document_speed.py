"""The speed of the driver stays in a document, whatever is made of it."""

from __future__ import annotations

import json
import math
from typing import Any

import pytest

import assur
from assur.studio import document
from studio.asking import FOUR_BAR, PRESS, ask, refused
from support.node import MODULES, run_node

SPEED = math.pi / 30.0


def test_drags_assemblies_and_files_keep_it() -> None:
    own = {**FOUR_BAR, "input_speed": SPEED}
    dragged = ask("drag", document=own, q=0.3, joint="C", to=[4.0, 3.0])["document"]
    assert dragged["input_speed"] == SPEED
    # Through the line of its dyad: another drawing.
    through = ask("drag", document=own, q=0.3, joint="C", to=[4.0, -3.0])["document"]
    assert through["input_speed"] == SPEED
    for one in ask("assemblies", document=own, q=0.3)["assemblies"]:
        assert one["document"]["input_speed"] == SPEED
    triad = {**document.document_of(assur.examples.triad()), "input_speed": SPEED}
    listed = ask("assemblies", document=triad, q=assur.examples.triad().q0)["assemblies"]
    assert [one["document"]["input_speed"] for one in listed] == [SPEED] * len(listed)
    text = bytes(ask("export", document=own, format="toml").arrays["bytes"]).decode()
    again = ask("open", text=text, name="m.toml")
    assert again["document"]["input_speed"] == again["speed"] == SPEED


def test_what_mends_a_mechanism_keeps_it_unless_another_driver_does() -> None:
    braced = {
        **FOUR_BAR,
        "input_speed": SPEED,
        "links": {**FOUR_BAR["links"], "brace": ["B", "D"]},
    }
    answer = ask("check", document=braced)
    assert answer["state"] == "stuck"
    kept = [one["document"] for one in answer["remedies"]]
    assert kept
    for one in kept:
        same = one["driver"] == "crank"
        assert ("input_speed" in one) == same
        document.read(one)
    undriven = {key: value for key, value in braced.items() if key != "driver"}
    del undriven["links"]["brace"]
    for one in ask("check", document=undriven)["remedies"]:
        assert "input_speed" not in one["document"]


def test_it_is_no_part_of_the_geometry() -> None:
    assert document.read_mechanism({**FOUR_BAR, "input_speed": SPEED}) is document.read_mechanism(
        {**FOUR_BAR, "input_speed": 2.0}
    )


@pytest.mark.parametrize("speed", ["fast", [1.0, 2.0], True])
def test_refused(speed: Any) -> None:
    error = refused("export", document={**PRESS, "input_speed": speed}, format="toml")
    assert error["key"] == "input_speed"
    assert "a number is needed" in error["message"]


def edited(*cases: tuple[dict[str, Any], list[list[Any]]]) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = json.loads(
        run_node(str(MODULES / "edits.mjs"), stdin=json.dumps(cases))
    )
    return found


def test_a_speed_goes_with_its_driver() -> None:
    own = {**FOUR_BAR, "input_speed": SPEED}
    two = {**own, "driver": ["crank", "rocker"], "input_speed": [1, 2]}
    renamed, removed, changed, first, second, both = edited(
        (own, [["renameLink", "crank", "arm"]]),
        (own, [["removeLink", "crank"]]),
        (own, [["setDriver", "rocker"]]),
        (two, [["removeLink", "rocker"]]),
        (two, [["removeLink", "crank"]]),
        (two, [["renameJoint", "C", "K"]]),
    )
    assert (renamed["driver"], renamed["input_speed"]) == ("arm", SPEED)
    for one in (removed, changed):
        assert "input_speed" not in one
    assert (first["driver"], first["input_speed"]) == ("crank", 1)
    assert (second["driver"], second["input_speed"]) == ("rocker", 2)
    assert both["input_speed"] == [1, 2]
