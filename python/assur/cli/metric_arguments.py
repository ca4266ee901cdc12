"""Arguments of metrics as text, each by the kind of its parameter."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from assur.cli.units import numbers

NUMBERS = ("part", "speed", "acceleration", "fluctuation", "mean_speed")
FLAGS = {"true": True, "false": False}


def parts(inside: str) -> list[str]:
    """Split arguments at commas that are in no brackets."""
    parts, depth = [""], 0
    for letter in inside:
        depth += {"(": 1, ")": -1}.get(letter, 0)
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return parts if inside.strip() else []


def argument_of(name: str, text: str) -> Any:
    """Return an argument of a metric by the kind of its parameter."""
    if name in ("over", "between"):
        ends = parts(text.removeprefix("(").removesuffix(")")) if text.startswith("(") else [text]
        if name == "between":
            return tuple(_unquoted(end) for end in ends)
        return tuple(np.atleast_1d(numbers(",".join(ends)).values).tolist())
    if name in NUMBERS:
        return numbers(text.strip("()")).values.tolist()
    if name == "order":
        return int(text) if re.fullmatch(r"\d", text, re.ASCII) else text
    if name == "relative":
        return FLAGS.get(text.lower(), text)
    return _unquoted(text)


def _unquoted(text: str) -> str:
    text = text.strip()
    quoted = len(text) > 1 and text[0] == text[-1] and text[0] in "'\""
    return text[1:-1] if quoted else text
