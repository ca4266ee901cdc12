"""Arguments of metrics as text, each by the kind of its parameter."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from assur.cli.units import ANGLE, LENGTH, LINEAR, ROTARY, UNITS, numbers
from assur.errors import InputError

# Numbers, with the kinds of their units.
NUMBERS: dict[str, tuple[str, ...]] = {
    "over": (ANGLE, LENGTH),
    "part": (),
    "speed": (ROTARY, LINEAR),
    "acceleration": (),
    "fluctuation": (),
    "mean_speed": (ROTARY,),
    "theta": (ANGLE, LENGTH),
    "value": (ANGLE, LENGTH),
    "length": (LENGTH,),
    "points": (LENGTH,),
    "poses": (LENGTH, ANGLE),
}
# Several numbers, and rows of them: ((0, 10mm), (5mm, 20mm)).
LISTS = ("over", "theta", "value")
ROWS = ("points", "poses")
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
    if name in ROWS:
        rows = [parts(_inside(row.strip())) for row in parts(_inside(text))]
        return [[_numbers(name, number) for number in row] for row in rows]
    if name in NUMBERS:
        return _numbers(name, _inside(text))
    if name == "between":
        return tuple(_unquoted(end) for end in parts(_inside(text)))
    if name == "order":
        return int(text) if re.fullmatch(r"\d", text, re.ASCII) else text
    if name in ("relative", "closed"):
        return FLAGS.get(text.lower(), text)
    return _unquoted(text)


def _inside(text: str) -> str:
    return text[1:-1] if text.startswith("(") and text.endswith(")") else text


def _numbers(name: str, text: str) -> Any:
    parsed = numbers(text)
    if parsed.unit is not None and UNITS[parsed.unit][0] not in NUMBERS[name]:
        message = f"{name}={text}: its unit cannot be {parsed.unit}"
        raise InputError(message)
    values = np.atleast_1d(parsed.values) if name in LISTS else parsed.values
    return values.tolist()


def _unquoted(text: str) -> str:
    text = text.strip()
    quoted = len(text) > 1 and text[0] == text[-1] and text[0] in "'\""
    return text[1:-1] if quoted else text
