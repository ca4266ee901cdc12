"""Limits of files: all are far above what a mechanism needs, and save memory and time."""

from __future__ import annotations

from assur.files.lexer import tokens

# Bytes: dimensions of 60 000 designs, and a second or two to read.
MOST_BYTES = 8 * 2**20
# Brackets within brackets. The parser of Python calls itself for each.
MOST_BRACKETS = 16
# Parts of a key, a.b.c; the parser takes time by their square.
MOST_PARTS = 16
# Letters of a name, a key or a number; messages quote them.
MOST_LETTERS = 200
# Joints, links or slides: a third of a second to read. A single group this large would take hours:
# the time for its contours grows with the fourth power of its links (Ctrl-C stops it).
MOST_ITEMS = 4000
# Positions of a range.
MOST_POSITIONS = 10_000_000


def beyond_limits(text: str) -> tuple[int, str] | None:
    """Return where a text exceeds a limit, and how, before it is parsed."""
    depth = dots = 0
    for kind, start, end in tokens(text, skip_numbers=True):
        if kind in "[{":
            depth += 1
        elif kind in "]}":
            depth = max(depth - 1, 0)
        if kind == ".":
            dots += 1
        elif kind not in ("word", "string"):
            dots = 0
        if depth > MOST_BRACKETS:
            return start, f"brackets are nested deeper than {MOST_BRACKETS}"
        if dots >= MOST_PARTS:
            return start, f"a key has more than {MOST_PARTS} parts"
        if end - start > MOST_LETTERS and kind in ("word", "string"):
            what = "text" if kind == "string" else "name or number"
            return start, f"a {what} is longer than {MOST_LETTERS} characters"
    return None
