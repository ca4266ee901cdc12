"""An invalid mechanism is refused; the error names the part and the number."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import assur
from models.errors.refusals import (
    JOINTS,
    LINKS,
    Table,
    build,
    is_whole_word,
    joint,
    link,
    slide,
)
from models.errors.refused_structures import REFUSED

nan, inf = math.nan, math.inf


@pytest.mark.parametrize("case", REFUSED)
def test_refused(case: str) -> None:
    arguments, words, fields = REFUSED[case]
    with pytest.raises(assur.StructureError) as caught:
        build(**arguments)
    missing = [word for word in words if not is_whole_word(word, str(caught.value))]
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
        with pytest.raises(assur.StructureError, match="not allowed") as caught:
            build(**parts)
        assert caught.value.kind == "bad_name"


@pytest.mark.parametrize("name", ["é", "γ1", "A′", "1", "-", "a_b", "x" * 1000])
def test_names_allowed(name: str) -> None:
    m = build(**joint(**{name: (5, 5)}), **link(rocker=["D", "C", name]))
    assert f"rocker.{name}.x" in m.dimensions


# What is no description at all, and the fields that name where.
WRONG_VALUES: list[tuple[Table, dict[str, Any]]] = [
    *(
        (joint(P=at), {"joint": "P"})
        for at in ((1,), (1, 2, 3), 5, None, "ab", (1 + 2j, 0), (10**400, 0), np.zeros(3))
    ),
    ({"joints": {**JOINTS, 3: (0, 0)}}, {}),
    ({"links": {**LINKS, 3: "AB"}}, {}),
    ({"joints": [("A", (0, 0))]}, {}),
    ({"slides": {"s": ("rocker", "ground", 0.0)}}, {"slide": "s"}),
    ({"slides": {"s": slide("rocker", "ground", "x")}}, {"slide": "s"}),  # type: ignore[arg-type]
    ({"joints": {**JOINTS, "a\ud800": (0, 0)}}, {}),
    (link(coupler=["B", "C", 3]), {"link": "coupler"}),
    (link(coupler=None), {"link": "coupler"}),
    ({"driver": None}, {}),
    ({"driver": [None]}, {}),
    ({"driver": assur.Drive(3)}, {}),  # type: ignore[arg-type]
    ({"assembly": {"C": "x"}}, {"joint": "C"}),
    ({"assembly": ["C"]}, {}),
]
NAMES = ("joint", "link", "slide", "driver", "dimension", "group")


@pytest.mark.parametrize(("changed", "fields"), WRONG_VALUES)
def test_wrong_values_are_errors_of_ours(changed: Table, fields: dict[str, Any]) -> None:
    with pytest.raises(assur.InputError) as caught:
        build(**changed)
    found = {name: getattr(caught.value, name) for name in NAMES}
    assert found == dict.fromkeys(NAMES) | fields
