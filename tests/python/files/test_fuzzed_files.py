"""A thousand files that are broken by chance: each loads or raises an error with line and key."""

from __future__ import annotations

import random
import re
import warnings
from typing import TYPE_CHECKING

import pytest

import assur
from assur.files.lexer import tokens
from assur.files.write import text_of
from files.sample_files import BY_HAND, WANTED, saved

if TYPE_CHECKING:
    from pathlib import Path

GOOD = [*BY_HAND.values(), *saved().values()]
GOOD.append(saved()["everything"] + WANTED)
BLOCKS, EACH = 10, 100
# What one may write in place of something else.
OTHERS = (
    *(
        "0",
        "-1",
        "1e999",
        "-0.0",
        "nan",
        "inf",
        "5e-324",
        "1e200",
        "2",
        "0x7f",
        "1_0",
        "1979-05-27",
    ),
    *('"x"', '""', '"ground"', '"A"', "'C'", "true", "[]", "{}", "[1, 2]", "[[1]]", '["A", "B"]'),
    *("{ q = [0, 1], value = [0, 1] }", '{ type = "Table" }'),
)
PIECES = ("a.b", "[a]", "[[loads]]", "=", ",", '"', "]", "{", "\n", "'''", "\\", "#", "é")
BYTES = (b"\xff", b"\x00", b"\r\n", b"\xef\xbb\xbf", b"\r", b"\xc3", b"\x7f")
NOT_TOML = ("not TOML", "not UTF-8")
VALUE = re.compile(
    r"""(?<![\w."'])(?:"[^"\n]*"|[-+]?\d[\d.eE+-]*|true|false)(?![\w."'])"""
    r"""|\[[^\[\]\n]*\](?=[ ,}\n])|\{[^{}\n]*\}"""
)
KEY = re.compile(r"""[\w-]+(?=[\w.-]* = )|(?<=\[)\w+(?=\])""")


def broken(text: str, rng: random.Random) -> bytes:
    """A text with one to three faults."""
    for _ in range(rng.choice((1, 1, 2, 3))):
        text = rng.choice(FAULTS)(text, rng)
    raw = text.encode()
    if rng.random() < 0.1:
        at = rng.randrange(len(raw) + 1)
        raw = raw[:at] + rng.choice(BYTES) + raw[at:]
    return raw


def put(text: str, span: tuple[int, int], new: str) -> str:
    return text[: span[0]] + new + text[span[1] :]


def spans(pattern: re.Pattern[str], text: str) -> list[tuple[int, int]]:
    return [found.span() for found in pattern.finditer(text)] or [(0, 0)]


def other_value(text: str, rng: random.Random) -> str:
    return put(text, rng.choice(spans(VALUE, text)), rng.choice(OTHERS))


def value_of_another(text: str, rng: random.Random) -> str:
    own, (start, end) = (rng.choice(spans(VALUE, text)) for _ in range(2))
    return put(text, own, text[start:end])


def swapped_values(text: str, rng: random.Random) -> str:
    one, other = sorted(rng.choice(spans(VALUE, text)) for _ in range(2))
    if one[1] > other[0]:
        return text
    return put(put(text, other, text[slice(*one)]), one, text[slice(*other)])


def other_key(text: str, rng: random.Random) -> str:
    own, (start, end) = (rng.choice(spans(KEY, text)) for _ in range(2))
    return put(text, own, rng.choice((text[start:end], text[start:end] + "x", "a.b", "1")))


def other_line(text: str, rng: random.Random) -> str:
    """A line is left out, doubled, or stands elsewhere."""
    lines = text.splitlines(keepends=True) or [""]
    line = lines.pop(rng.randrange(len(lines)))
    for _ in range(rng.choice((0, 0, 1, 2))):
        lines.insert(rng.randrange(len(lines) + 1), line)
    return "".join(lines)


def other_token(text: str, rng: random.Random) -> str:
    """A token is left out, doubled, or another one."""
    found = [(t.start, t.end) for t in tokens(text) if t.kind not in ("comment", "newline")]
    own, (start, end) = (rng.choice(found or [(0, 0)]) for _ in range(2))
    new = ("", text[slice(*own)] * 2, text[start:end], rng.choice(PIECES))
    return put(text, own, rng.choice(new))


def cut(text: str, rng: random.Random) -> str:
    return text[: rng.randrange(len(text) + 1)]


VALID = (other_value, value_of_another, swapped_values, other_key, other_line)
FAULTS = (*VALID * 4, other_token, cut)


def outcome(path: Path) -> assur.files.Contents | assur.files.FileError:
    """What reading gives; a warning of assur is none of it (a table may go to 360)."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", category=assur.AssurWarning)
        try:
            return assur.files.read(path)
        except assur.files.FileError as error:
            return error


def check_error(error: assur.files.FileError, raw: bytes) -> bool:
    """Check that an error has its place; whether the text is TOML."""
    is_toml = not any(words in str(error) for words in NOT_TOML)
    assert isinstance(error.line, int), raw
    assert isinstance(error.column, int), raw
    assert 1 <= error.line <= raw.count(b"\n") + 1, raw
    assert error.column >= 1, raw
    assert bool(error.key) == is_toml, raw
    return is_toml


def check_contents(contents: assur.files.Contents, path: Path) -> None:
    """Check that what was loaded is whole: it moves, and saves to what loads again."""
    mechanism = contents.mechanism
    if not all(mechanism.shape):
        return  # no designs
    mechanism.solve(mechanism.q0, order=0, on_error="nan")
    text = text_of(contents)
    path.write_text(text, encoding="utf-8")
    again = outcome(path)
    assert isinstance(again, assur.files.Contents), text
    assert text_of(again) == text


@pytest.mark.parametrize("block", range(BLOCKS))
def test_broken_files(block: int, tmp_path: Path) -> None:
    rng, path = random.Random(block), tmp_path / "m.toml"
    counts = {"loaded": 0, "refused": 0, "not TOML": 0}
    for _ in range(EACH):
        raw = broken(rng.choice(GOOD), rng)
        path.write_bytes(raw)
        found = outcome(path)
        if isinstance(found, assur.files.Contents):
            counts["loaded"] += 1
            check_contents(found, path)
        else:
            counts["refused" if check_error(found, raw) else "not TOML"] += 1
    # The faults are neither all fatal nor all harmless.
    assert min(counts.values()) >= 1, counts
