"""How records are printed: a line, or a few, however much they hold.

Results show of long arrays the least and the greatest number (`summary`); what users write
themselves can be typed back, with arrays shortened as NumPy does (`typed`).
"""

from __future__ import annotations

import math
from dataclasses import fields, is_dataclass
from textwrap import wrap
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

__all__ = ["FORMULA", "LINES", "listed", "shortened", "summary", "typed"]

# Arrays of more numbers are printed by their range, or with their ends alone.
MOST = 6
# What is shown at most: columns, lines, entries of a list, lists in each other.
WIDTH, LINES, ENTRIES, DEPTH = 120, 20, 12, 4
# Of a further line.
INDENT = " " * 4
# Letters of a structural formula in a line with other things.
FORMULA = 72
# Numbers of more letters are rounded to six digits in results.
LETTERS = 10


def summary(record: Any) -> str:
    """Return the repr of a result, short however long its arrays are."""
    return _record(record, _short)


def typed(record: Any) -> str:
    """Return the repr of what users write, which gives it again where its arrays are short."""
    return _record(record, _typed)


def listed(entries: Iterable[object], opening: str = "[", closing: str = "]") -> str:
    """Return the repr of a list: of a long one the first entries, and how many there are more."""
    every = list(entries)
    shown = [repr(entry) for entry in every[:ENTRIES]]
    if len(every) > ENTRIES:
        shown.append(f"… {len(every) - ENTRIES} more")
    return _packed(opening, shown, closing)


def _record(record: Any, show: Callable[[Any], str]) -> str:
    if is_dataclass(record):
        names = [field.name for field in fields(record) if field.repr]
    else:
        names = list(record._fields)
    parts = [f"{name}={show(getattr(record, name))}" for name in names]
    return _packed(f"{type(record).__qualname__}(", parts, ")")


def _packed(opening: str, parts: list[str], closing: str) -> str:
    """Return the parts in a line, or in as few as hold them."""
    text = f"{opening}{', '.join(' '.join(part.split()) for part in parts)}{closing}"
    if len(text) <= WIDTH:
        return text
    lines, line = [], opening
    for k, part in enumerate(parts):
        flat = " ".join(part.split()) + (", " if k < len(parts) - 1 else closing)
        if line.strip() and line != opening and len(line) + len(flat.rstrip()) > WIDTH:
            lines.append(line)
            line = INDENT
        *full, line = wrap(line + flat, WIDTH, subsequent_indent=INDENT, drop_whitespace=False)
        lines += full
    lines.append(line)
    if len(lines) > LINES:
        lines[LINES:] = [f"{INDENT}… {len(lines) - LINES} lines more{closing}"]
    return "\n".join(line.rstrip() for line in lines)


def shortened(text: str, most: int = WIDTH) -> str:
    """Return a text, or its beginning and its end if it has more letters."""
    if len(text) <= most:
        return text
    end = most // 3
    return f"{text[: most - end - 3].rstrip()} … {text[-end:].lstrip()}"


def _six(number: float) -> str:
    return f"{number:.6g}"


SIX_DIGITS: Any = {"float_kind": _six}


def _short(value: Any) -> str:
    if isinstance(value, float):
        plain = repr(float(value))
        return _six(value) if len(plain) > LETTERS and math.isfinite(value) else plain
    if type(value) in (tuple, list) and len(value) > MOST:
        return f"<{len(value)} of them>" if len(value) > ENTRIES else repr(value)
    if not isinstance(value, np.ndarray) or value.size <= MOST:
        return repr(value)
    shape = "×".join(map(str, value.shape))
    if value.dtype.kind not in "fiu":
        return f"<{shape}: {value.dtype}>"
    finite = value[np.isfinite(value)]
    if not finite.size:
        return f"<{shape}: NaN>"
    return f"<{shape}: {finite.min():.6g} … {finite.max():.6g}>"


def _typed(value: Any, depth: int = 0) -> str:
    if isinstance(value, np.ndarray):
        if value.size <= MOST:
            return f"array({value.tolist()!r})"
        numbers = np.array2string(
            value, threshold=MOST, edgeitems=2, separator=", ", formatter=SIX_DIGITS
        )
        return f"array({' '.join(numbers.split())})"
    if type(value) in (tuple, list):
        ends = "()" if type(value) is tuple else "[]"
        if depth == DEPTH:
            return f"{ends[0]}…{ends[1]}"
        shown = [_typed(entry, depth + 1) for entry in value[:ENTRIES]]
        shown += [f"… {len(value) - ENTRIES} more"] if len(value) > ENTRIES else []
        comma = "," if len(shown) == 1 and type(value) is tuple else ""
        return f"{ends[0]}{', '.join(shown)}{comma}{ends[1]}"
    if callable(value) and hasattr(value, "__qualname__"):
        return f"<function {value.__qualname__}>"
    return repr(value)
