"""Broken files raise errors of assur: no other exception, no warning, no endless loop."""

from __future__ import annotations

import random
import re

import pytest

import assur
from assur import importers
from importers.pmks_plus_writer import LETTERS, checked
from importers.test_imported import CASES

SPECIAL = (
    *(
        "nan",
        "inf",
        "-1e400",
        "1e308",
        "1e-320",
        "9" * 50,
        "0x10",
        "-0",
        "１",
        "𝟙",
        "",
        "null",
        "true",
    ),
    *("\0", "\ud800", "\u202e", "ﬀ", "é", "\r", "\n", "\t", " " * 100, "|", ",", ".", "[", "]"),
    *(
        "{",
        "}",
        "<",
        ">",
        "<!--",
        "]]>",
        "&lt;",
        "&#0;",
        "&x;",
        '"',
        "'",
        "#",
        "#[",
        "ground",
        "L1",
    ),
    *(
        "R",
        "P",
        "RP",
        "G",
        "tttt",
        "mech=",
        "set=",
        "true",
        "NaN",
        "-",
        "_",
        "M[",
        "J[",
        "1e3",
        "é" * 70,
    ),
)
COUNT = 1000


WORD = re.compile(r'"[^"]*"|[-+.\w]+')
WORDS = (
    *(
        "null",
        "true",
        "[]",
        "{}",
        "[1, 2]",
        '"x"',
        '""',
        "0",
        "-1",
        "1e300",
        "1e-300",
        "1e999",
        "7",
    ),
    *(
        "NaN",
        '"1e300"',
        '"-0"',
        '"true"',
        '"0"',
        '"1"',
        "ground",
        "R",
        "P",
        "RP",
        '{"a": 1}',
        "[[]]",
    ),
)


def changed(text: str, rng: random.Random) -> str:
    """A text in which one to three words are others, so that most of its grammar holds."""
    for _ in range(rng.choice((1, 1, 2, 3))):
        words = list(WORD.finditer(text))
        if not words:
            return text
        word = rng.choice(words)
        # Quotes stay, so that JSON and XML are read to their end.
        own = [other[0] for other in words if other[0][0] == word[0][0] == '"'] or [
            rng.choice(words)[0]
        ]
        odd = [other for other in WORDS if (other[0] == '"') == (word[0][0] == '"')]
        text = text[: word.start()] + rng.choice(rng.choice((own, odd))) + text[word.end() :]
    return text


def broken(text: str, rng: random.Random) -> str:
    """A text with one to four faults, letter by letter."""
    for _ in range(rng.choice((1, 1, 2, 4))):
        start = rng.randrange(len(text) + 1)
        end = min(len(text), start + rng.choice((0, 1, 1, 2, 5, 20, 100)))
        match rng.randrange(6):
            case 0:
                text = text[:start] + text[end:]
            case 1:
                text = text[:start] + rng.choice(SPECIAL) + text[end:]
            case 2:
                text = text[:end] + text[start:]
            case 3:
                text = text[:start]
            case 4:
                other = rng.randrange(len(text) + 1)
                text = text[:start] + text[other : other + 20] + text[end:]
            case _:
                # A number becomes another one.
                digits = [i for i, letter in enumerate(text) if letter.isdigit()] or [0]
                at = rng.choice(digits)
                text = text[:at] + rng.choice(("", "7", "0", "99999999", "-")) + text[at + 1 :]
    return text


@pytest.mark.parametrize("part", range(10))
def test_broken_files(part: int) -> None:
    names = list(CASES)
    messages: list[str] = []
    for seed in range(part * COUNT // 10, (part + 1) * COUNT // 10):
        rng = random.Random(seed)
        case = CASES[names[seed % len(names)]]
        text = (broken if rng.random() < 0.5 else changed)(case.text, rng)
        if case.format == "pmks_plus" and rng.random() < 0.9:
            # Past the letter that checks the length.
            text = checked(text.rstrip("\n")[:-1]) if "?" not in text else text
            head, mark, held = text.partition("?")
            text = f"{head}{mark}{checked(held[:-1])}" if mark else text
        own = None if rng.random() < 0.3 else case.format
        drivers = None if own is None else case.drivers
        try:
            found = importers.read(text, format=own, drivers=drivers)
        except (assur.InputError, assur.StructureError, assur.DimensionError) as error:
            messages.append(str(error))
        else:
            assert found.mechanism.structure.mobility >= 1
    assert all(10 < len(message) < 2000 for message in messages)
    assert 20 < len(messages) < COUNT // 10


MANY = 40_000
CONNECTORS = "".join(f'<connector id="{i}" x="0" y="{i}"/>' for i in range(9000))
LARGE = {
    "lines": ("pmks", "ground a R 0 0|" * MANY),
    "links": ("pmks", " ".join(f"l{i}" for i in range(MANY)) + " R 0 0"),
    "comments": ("pyslvs", "M[" + "#[\n" * MANY),
    "closed comments": ("pyslvs", "#[ #]\n" * MANY + "M[]"),
    "joints": ("pyslvs", "M[" + "J[R, P[0, 0], L[ground, a]]," * (MANY // 2) + "]"),
    "names": ("pyslvs", "M[J[R, P[0, 0], L[" + "a," * MANY + "]]]"),
    "elements": ("linkage2", "<linkage2>" + "<a/>" * MANY + "</linkage2>"),
    "connectors": ("linkage2", f"<linkage2>{CONNECTORS}</linkage2>"),
    "quotes": ("linkage2", "<linkage2 " + '="' * (MANY * 4)),
    "ands": ("linkage2", "<linkage2>" + "&#" * (MANY * 4)),
    "parts": ("pmks_plus", checked("0.Fe.A,0.1111." + "0A,,0,0,0." * MANY)),
    "digits": ("pmks_plus", checked("0.Fe.A,0.1111.6A,," + LETTERS * 1000 + ",0,0....N_")),
    "arrays": ("pylinkage", '{"joints": ' + "[{" * MANY),
    "objects": ("pylinkage", '{"joints": [' + "{}," * MANY + "{}]}"),
}


def test_every_format_has_a_large_file() -> None:
    assert {own for own, _ in LARGE.values()} == set(importers.FORMATS)


@pytest.mark.parametrize("kind", LARGE)
def test_large_files(kind: str) -> None:
    own, text = LARGE[kind]
    for asked in (own, None):
        with pytest.raises(assur.AssurError) as raised:
            importers.read(text, format=asked)
        assert len(str(raised.value)) < 2000


def test_largest_linkages_are_read() -> None:
    """A chain of dyads near the limit is a mechanism."""
    lines = ["ground crank R 0 0 0 ffft", "crank a0 R 0 1"]
    for i in range(160):
        x = 2.0 * i + 3.0
        following = f"a{i + 1}" if i < 159 else ""
        lines += [f"ground b{i} R {x} 0", f"a{i} b{i} {following} R {x - 0.5} 1.5"]
    found = importers.read("\n".join(lines))
    assert len(found.mechanism.structure.groups) == 160
