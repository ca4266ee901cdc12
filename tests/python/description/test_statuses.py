"""What a status says of a position, in one place."""

from __future__ import annotations

import re
from pathlib import Path

import assur
from assur import Status
from assur.description.words import has_analogues, is_reached

NUMBERED = re.compile(r"status(?:\[[^\]]*\])?\)? (?:[<>]=?|[=!]=) \d")


def test_which_positions_exist_and_which_have_analogues() -> None:
    every = list(Status)
    assert [x for x in every if is_reached(x)] == [
        Status.OK,
        Status.NEAR_SINGULAR,
        Status.SINGULAR,
    ]
    assert [x for x in every if has_analogues(x)] == [Status.OK, Status.NEAR_SINGULAR]
    assert is_reached(every).tolist() == [bool(is_reached(x)) for x in every]


def test_no_status_is_compared_with_a_bare_number() -> None:
    found = [
        f"{path.name}: {match.group()}"
        for path in Path(assur.__file__).parent.rglob("*.py")
        for match in NUMBERED.finditer(path.read_text(encoding="utf-8"))
    ]
    assert not found
