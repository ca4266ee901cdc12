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
    """Whether the joints of a JSON text are numbered: none of the formats does so."""
    try:
        data = json.loads(text)
    except (ValueError, RecursionError):
        return False
    joints = data.get("joints") if isinstance(data, dict) else None
    if not isinstance(joints, list):
        return False
    ids = [joint.get("id") for joint in joints if isinstance(joint, dict)]
    return bool(ids) and all(isinstance(one, int | float) for one in ids)


def items_of(source: Source, data: dict[str, Any], key: str) -> list[dict[str, Any]]:
    """Return a list of objects."""
    found = data.get(key)
    if not isinstance(found, list) or not found:
        raise source.wrong("", repr(key), found, "a list of objects")
    for index, item in enumerate(found):
        if not isinstance(item, dict):
            raise source.error(f"{key}[{index}]", f"an object is needed, not {short(item)}")
    return found


def words_of(source: Source, item: dict[str, Any], key: str, place: str) -> list[str]:
    """Return a list of names that is not empty."""
    found = item.get(key)
    if not isinstance(found, list) or not found or not all(isinstance(w, str) for w in found):
        raise source.wrong(place, repr(key), found, "a list of names")
    return found


def word_of(source: Source, item: dict[str, Any], key: str, place: str) -> str:
    """Return a name."""
    found = item.get(key)
    if not isinstance(found, str):
        raise source.wrong(place, repr(key), found, "a name")
    return found


def point_of(source: Source, item: dict[str, Any], key: str, place: str) -> tuple[float, float]:
    """Return two numbers."""
    found = item.get(key)
    if not isinstance(found, list) or len(found) != 2:
        raise source.wrong(place, repr(key), found, "a list of two numbers")
    x, y = (source.number(number, place, key) for number in found)
    return x, y
