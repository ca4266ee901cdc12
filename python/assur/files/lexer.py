"""Tokens of TOML: enough to limit a text before it is parsed, and to find its keys afterwards."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator

TOKEN = re.compile(
    r"""(?P<space>[^\S\n]+)
    |(?P<word>[^\s"'\#\[\]{}=,.]+)
    |(?P<mark>[\[\]{}=,.])
    |(?P<newline>\n)
    |(?P<comment>\#[^\n]*)
    |(?P<quote>\"""|'''|"|')""",
    re.VERBOSE,
)
# A run of numbers in a list, perhaps a very long one: each with at most one dot.
NUMBERS = re.compile(
    r"(?:[+-]?[0-9][0-9_]{0,40}(?:\.[0-9]{1,40})?(?:[eE][+-]?[0-9]{1,9})?[ \t]*,\s*){1,500}"
)
# What ends a string, and what escapes an end.
ENDS = {
    '"': re.compile(r'\\.|"|\n'),
    "'": re.compile(r"'|\n"),
    '"""': re.compile(r'\\.|"{3,5}', re.DOTALL),
    "'''": re.compile(r"'{3,5}"),
}


class Token(NamedTuple):
    """A piece of text: "word", "string", "newline", "comment", or one of the marks ``[]{}=,.``."""

    kind: str
    start: int
    end: int


def tokens(text: str, skip_numbers: bool = False) -> Iterator[Token]:
    """Yield the tokens without blanks, up to a string that does not end.

    Always linear in the length. With `skip_numbers`, runs of numbers are left out.
    """
    at = 0
    while at < len(text):
        if skip_numbers and (run := NUMBERS.match(text, at)):
            at = run.end()
            continue
        match = TOKEN.match(text, at)
        assert match is not None  # the classes above have every character
        kind, end = str(match.lastgroup), match.end()
        if kind == "quote":
            kind, end = "string", _end_of_string(text, match.group(), end)
            if end < 0:
                return
        elif kind == "mark":
            kind = match.group()
        if kind != "space":
            yield Token(kind, at, end)
        at = end


def _end_of_string(text: str, quote: str, at: int) -> int:
    """Return where a string ends whose content begins at a place; -1 if it does not."""
    while match := ENDS[quote].search(text, at):
        if match.group()[0] == quote[0]:
            return match.end()
        if match.group() == "\n":
            return -1
        at = match.end()
    return -1


def line_and_column(text: str, at: int) -> tuple[int, int]:
    """Return the line and the column of a character, from 1."""
    return text.count("\n", 0, at) + 1, at - (text.rfind("\n", 0, at) + 1) + 1
