"""`find` of a coordinate that is the same in every position says so."""

from __future__ import annotations

import re

import pytest

import assur


def test_a_link_that_does_not_turn() -> None:
    mechanism = assur.Mechanism(
        {"A": (0, 0), "B": (1, 1), "C": (3, 0)},
        {"ground": "A", "crank": "AB", "rod": "BC", "block": "C"},
        "crank",
        slides={"way": assur.Slide("block", on="ground", angle=0.0)},
    )
    text = "'block' cannot be set: the angle of link 'block' does not change (it is 0 rad)"
    with pytest.raises(assur.InputError, match=re.escape(text)) as caught:
        mechanism.find("block", 0.3)
    assert caught.value.link == "block"
    assert mechanism.find("rod", -0.3)


def test_a_slide_that_does_not_move() -> None:
    """The bar turns about the crank's pivot: its block is always as far out."""
    mechanism = assur.Mechanism(
        {"A": (0, 0), "B": (1, 0)},
        {"ground": "A", "crank": "AB", "block": "B", "bar": "A"},
        "crank",
        slides={"way": assur.Slide("block", on="bar", angle=0.0, origin="A")},
    )
    text = "'way' cannot be set: the value of slide 'way' does not change (it is 1 m)"
    with pytest.raises(assur.InputError, match=re.escape(text)) as caught:
        mechanism.find("way", 0.5)
    assert caught.value.slide == "way"
