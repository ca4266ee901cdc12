"""Numbers of PMKS+: base 64 with letters of its own, a leading 0 for minus, thousandths."""

from __future__ import annotations

from typing import TYPE_CHECKING

from assur._arrays import short

if TYPE_CHECKING:
    from assur.importers.source import Source

DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-"
# The last letter of a record gives its length, by the letters without _ and -.
CHECK = DIGITS[:62]
# 64**9 is beyond the whole numbers of the program's own language.
LONGEST = 10


def whole(source: Source, word: str, place: str, what: str) -> int:
    """Return a whole number."""
    minus = len(word) > 1 and word.startswith("0")
    digits = word[minus:]
    if not digits or len(digits) > LONGEST or not set(digits) <= set(DIGITS):
        needed = "digits 0-9, A-Z, a-z, _ and - are needed"
        raise source.error(place, f"{what} is {short(word)}: {needed}")
    value = 0
    for digit in digits:
        value = 64 * value + DIGITS.index(digit)
    return -value if minus else value


def decimal(source: Source, word: str, place: str, what: str) -> float:
    """Return a number of three decimals."""
    return whole(source, word, place, what) / 1000.0


def is_checked(text: str) -> bool:
    """Whether the last letter agrees with the length of the rest."""
    return len(text) > 1 and text[-1] == CHECK[(len(text) - 1) % len(CHECK)]
