"""Addresses as they are pasted: from Markdown, mails, and with what newer programs append."""

from __future__ import annotations

import pytest

import assur
from assur import importers

ADDRESS = (
    "https://linkages.example.org/?0.Fe.A,0.2111.6A,,0,0,0.0B,,0,Fe,0.0C,,k_,VG,0.4D,,k_,0,0.."
    "YRAB,,0,0,0,0,,A,B,,.YRBC,,0,0,0,0,,B,C,,.YRCD,,0,0,0,0,,C,D,,..N_1"
)
LINES = (
    "https://linkages.example.org/?mech=ground a R 0 0 0 ffft|a b R 0 1|b c R 3 2|c ground R 4 0"
)


@pytest.mark.parametrize("address", [ADDRESS, LINES])
@pytest.mark.parametrize(
    "around",
    [
        "{})",
        "({})",
        "<{}>",
        "[four-bar]({})",
        "See [the four-bar]({}) of 2024.",
        '"{}"',
        "  {}  \n",
        "{}>",
        "Here: {}",
        "`{}`",
    ],
)
def test_what_is_around_an_address_is_no_part_of_it(address: str, around: str) -> None:
    text = around.format(address)
    plain = importers.read(address)
    assert importers.read(text).mechanism == plain.mechanism
    assert importers.read(text).omitted == plain.omitted


def test_brackets_within_an_address_stay() -> None:
    text = LINES.replace(" a ", " a(1) ").replace("|a ", "|a(1) ")
    named = importers.read(f"({text})")
    assert named.mechanism.driver == importers.read(text).mechanism.driver == "a_1_"


def test_what_newer_addresses_append_is_left_out() -> None:
    plain = importers.read(ADDRESS)
    for tail in ("3gSQPQ", "a.b,c*d"):
        found = importers.read(f"{ADDRESS}*{tail}")
        assert found.mechanism == plain.mechanism
        assert found.omitted == (
            "What the address holds behind its * is left out.",
            *plain.omitted,
        )
    assert importers.read(f"{ADDRESS}*").omitted == plain.omitted
    assert importers.detect(None, f"{ADDRESS}*3gSQPQ") == "pmks_plus"


def test_an_address_that_was_cut_is_refused() -> None:
    for text in (ADDRESS[:-1], ADDRESS[:-1] + "*3gSQPQ"):
        with pytest.raises(assur.InputError, match="was cut or changed"):
            importers.read(text)


def test_texts_that_only_mention_an_address_stay() -> None:
    xml = '<linkage2 xmlns="https://linkages.example.org/"></linkage2>'
    with pytest.raises(assur.InputError, match="no driver"):
        importers.read(xml)


def test_json_with_numbered_joints_is_of_another_program() -> None:
    foreign = '{"joints": [{"id": 1, "x": 0, "y": 0}, {"id": 2, "x": 1, "y": 0}], "links": []}'
    assert importers.detect(None, foreign) is None
    with pytest.raises(assur.InputError, match="the text is of no known format"):
        importers.read(foreign)
    own = '{"joints": [{"id": "1", "type": "ground", "position": [0, 0]}]}'
    assert importers.detect(None, own) == "pylinkage"
    assert importers.detect(None, '{"joints": [') == "pylinkage"
