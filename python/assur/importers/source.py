"""The text of another program's file: read within limits, with places for messages."""

from __future__ import annotations

import math
import re
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path, PurePath
from typing import TYPE_CHECKING, Any, TypeAlias

from assur._arrays import short
from assur._files import reason, shown_path
from assur.errors import InputError

if TYPE_CHECKING:
    from os import PathLike

SourceLike: TypeAlias = "str | PathLike[str] | Source"

# Files of linkages have some kilobytes; a greater one is something else.
LARGEST_FILE = 1_000_000
# No linkage that someone drew has more joints or links.
MOST_PARTS = 500
# Products of two coordinates stay finite.
LARGEST_NUMBER = 1e100
# A float64 is written in 24 letters at most; reading a longer one could take long.
LONGEST_NUMBER = 60
# Text that may precede an address on its line: a label, brackets, a quote.
LONGEST_LABEL = 300
LABEL = r"[^{}|\n?=]*"
CLOSING = {"(": ")", "[": "]", "<": ">", '"': '"', "'": "'", "`": "`"}
# Characters that are not part of an address at its end, unless they were opened within it.
ENDS = {")": "(", "]": "[", ">": "<"}
# Characters that only a text has, not a path.
TEXT_LETTERS = frozenset("\n\r{[<|?")


@dataclass(frozen=True)
class Source:
    """A text and what messages call it."""

    text: str
    name: str = ""

    def error(self, place: str, problem: str, **fields: Any) -> InputError:
        """Return the error for a problem at a place: "four-bar.txt, line 3: ..."."""
        where = ", ".join(part for part in (self.name, place) if part)
        return InputError(f"{where}: {problem}" if where else problem, **fields)

    def wrong(self, place: str, what: str, value: Any, needed: str, **fields: Any) -> InputError:
        """Return the error for a value that is missing (None) or of the wrong kind."""
        shown = "missing" if value is None else short(value)
        return self.error(place, f"{what} is {shown}: {needed} is needed", **fields)

    def require_few(self, count: int, what: str = "joints") -> None:
        """Refuse more items than any linkage has; the next steps may take time by their square."""
        if count > MOST_PARTS:
            raise self.error("", f"more than {MOST_PARTS} {what}: they are too many to be read")

    def number(self, word: Any, place: str, what: str) -> float:
        """Return a finite number that was written as text, or is one already."""
        if isinstance(word, str) and len(word) <= LONGEST_NUMBER and word.isascii():
            # float() also reads "nan", "infinity" and "1_000".
            plain = not set(word.strip()) - set("0123456789+-.eE")
            with suppress(ValueError):
                word = float(word) if plain else word
        if isinstance(word, bool) or not isinstance(word, int | float):
            raise self.wrong(place, what, word, "a number")
        # An integer may be beyond every float.
        if not -LARGEST_NUMBER <= word <= LARGEST_NUMBER:
            value = float(word) if isinstance(word, float) else math.copysign(math.inf, word)
            needed = f"a number between ±{LARGEST_NUMBER:g} is needed"
            raise self.error(place, f"{what} is {short(word)}: {needed}", value=value)
        return float(word)


def open_source(source: Any) -> Source:
    """Return the text of a path, of a text, or of a source already open.

    Raises
    ------
    InputError
        If the file is missing, too long, or not text.
    """
    if isinstance(source, Source):
        return source
    if isinstance(source, str) and not _is_path(source):
        text, name = source, ""
    else:
        text, name = _read(source)
    opened = Source(_unwrapped(text.removeprefix("\ufeff")), name)
    if len(text) > LARGEST_FILE:
        problem = f"more than {LARGEST_FILE} letters: this is not the file of a linkage"
        raise opened.error("", problem)
    if not text.strip():
        raise opened.error("", "the file is empty" if name else "the text is empty")
    return opened


def _unwrapped(text: str) -> str:
    """Return an address without the marks that a mail or a Markdown page puts around it."""
    start = re.search(r"https?://", text[:LONGEST_LABEL], re.IGNORECASE)
    line = text.strip()
    if start is None or "\n" in line or not re.fullmatch(LABEL, text[: start.start()]):
        return text
    before = text[: start.start()].rstrip()
    address = text[start.start() :].strip()
    closing = CLOSING.get(before[-1:], "")
    if closing and closing in address:
        return _up_to(address, before[-1], closing)
    while address[-1:] in ENDS and address.count(address[-1]) > address.count(ENDS[address[-1]]):
        address = address[:-1]
    return address


def _up_to(address: str, opening: str, closing: str) -> str:
    """Return what is before the bracket that closes one before the address, or the quote."""
    depth = 0
    for index, letter in enumerate(address):
        if letter == closing:
            if depth == 0:
                return address[:index]
            depth -= 1
        elif letter == opening:
            depth += 1
    return address


def _is_path(source: str) -> bool:
    if len(source) > 4096 or TEXT_LETTERS & set(source) or "\0" in source:
        return False
    try:
        path = Path(source)
        return path.suffix.lower() in ENDINGS or path.exists()
    except (OSError, ValueError):
        return False


# Endings of files: a text that ends so is a path, also of a file that is missing.
ENDINGS = {".txt": "", ".pmks": "pmks", ".json": "", ".linkage2": "linkage2", ".pyslvs": "pyslvs"}


def _read(path: Any) -> tuple[str, str]:
    try:
        file = Path(path)
        with file.open("rb") as stream:
            data = stream.read(LARGEST_FILE * 4 + 1)
    except (OSError, TypeError, ValueError) as error:
        named = shown_path(path) if isinstance(path, str | PurePath) else short(path)
        message = f"{named[:500]} cannot be read as a file: {reason(error).lower()}"
        raise InputError(message) from error
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError:
        # Linkage writes the code page of Windows.
        text = data.decode("cp1252", errors="replace")
    return text, file.name
