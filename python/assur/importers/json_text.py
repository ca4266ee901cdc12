"""JSON within limits: no NaN, no nesting without end, errors with their line."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from assur._arrays import short

if TYPE_CHECKING:
    from assur.importers.source import Source


def parse_json(source: Source) -> dict[str, Any]:
    """Return the object of a JSON text."""

    def constant(word: str) -> float:
        raise ValueError(f"{word} is not a number")

    try:
        data = json.loads(source.text, parse_constant=constant)
    except json.JSONDecodeError as error:
        raise source.error(f"line {error.lineno}", f"this is not JSON: {error.msg}") from error
    except (ValueError, RecursionError) as error:
        # Whole numbers of more than 4300 digits are ValueErrors.
        raise source.error("", f"this JSON cannot be read: {short(str(error))}") from error
    if not isinstance(data, dict):
        raise source.error("", "the JSON must be an object {...}")
    return data


def has_numbers_as_ids(text: str) -> bool:
    """Whether the joints of a JSON text are numbered, as in none of the formats."""
    try:
        data = json.loads(text)
    except (ValueError, RecursionError):
        return False
    joints = data.get("joints") if isinstance(data, dict) else None
    if not isinstance(joints, list):
        return False
    ids = [joint.get("id") for joint in joints if isinstance(joint, dict)]
    return bool(ids) and all(isinstance(identifier, int | float) for identifier in ids)


def items_of(source: Source, data: dict[str, Any], key: str) -> list[dict[str, Any]]:
    """Return a list of objects."""
    items = data.get(key)
    if not isinstance(items, list) or not items:
        raise source.wrong("", repr(key), items, "a list of objects")
    for index, item in enumerate(items):
        if not isinstance(item, dict):
            raise source.error(f"{key}[{index}]", f"an object is needed, not {short(item)}")
    return items


def words_of(source: Source, item: dict[str, Any], key: str, place: str) -> list[str]:
    """Return a list of names that is not empty."""
    words = item.get(key)
    if not isinstance(words, list) or not words or not all(isinstance(w, str) for w in words):
        raise source.wrong(place, repr(key), words, "a list of names")
    return words


def word_of(source: Source, item: dict[str, Any], key: str, place: str) -> str:
    """Return a name."""
    word = item.get(key)
    if not isinstance(word, str):
        raise source.wrong(place, repr(key), word, "a name")
    return word


def point_of(source: Source, item: dict[str, Any], key: str, place: str) -> tuple[float, float]:
    """Return two numbers."""
    numbers = item.get(key)
    if not isinstance(numbers, list) or len(numbers) != 2:
        raise source.wrong(place, repr(key), numbers, "a list of two numbers")
    x, y = (source.number(number, place, key) for number in numbers)
    return x, y
