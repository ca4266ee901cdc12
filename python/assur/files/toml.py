"""A tree as TOML that reads back with the same bits, written as by hand."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from typing import Any

BARE = re.compile(r"[A-Za-z0-9_-]+")
WIDTH = 88
# A section whose tables are sections too; elsewhere a table in a table is on one line.
NESTED = "drawn"


def key_text(name: str) -> str:
    """Return a key, in quotes if it needs them."""
    return name if BARE.fullmatch(name) else string(name)


def string(text: str) -> str:
    """Return a text in quotes. JSON has the escapes of TOML, but lets DEL pass."""
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def value_text(value: Any) -> str:
    """Return a string, bool, number, list or table as TOML."""
    if isinstance(value, str):
        return string(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return repr(int(value))
    if isinstance(value, float):
        return repr(float(value))  # NumPy's own repr names its type
    if isinstance(value, Mapping):
        entries = ", ".join(f"{key_text(k)} = {value_text(v)}" for k, v in value.items())
        return f"{{ {entries} }}" if entries else "{}"
    return _list_text([value_text(entry) for entry in value])


def _list_text(entries: list[str]) -> str:
    """Return a list, on several lines if it is long: TOML allows that within inline tables too."""
    if sum(len(entry) + 2 for entry in entries) <= WIDTH:
        return f"[{', '.join(entries)}]"
    lines, line = ["["], "   "
    for entry in entries:
        if len(line) + len(entry) + 2 > WIDTH and line.strip():
            lines.append(line)
            line = "   "
        line += f" {entry},"
    return "\n".join([*lines, line, "]"])


def pair_text(key: str, value: Any) -> str:
    """Return a line of a table."""
    return f"{key} = {value_text(value)}"


def tree_text(tree: Mapping[str, Any], head: tuple[str, ...]) -> str:
    """Return the text of a file: the keys of its head, then a section for each other table."""
    lines = [pair_text(key, tree[key]) for key in head if key in tree]
    for name in (name for name in tree if name not in head):
        if isinstance(tree[name], list):
            for table in tree[name]:
                lines += _section(f"[{name}]", table)
        else:
            lines += _section(name, tree[name])
    return "\n".join([*lines, ""])


def _section(name: str, table: Mapping[str, Any]) -> Iterator[str]:
    """Yield the lines of a table; a name with dots is a key with dots."""
    yield from ("", f"[{name}]")
    inner = ("dimensions", NESTED) if name.endswith(NESTED) else ()
    for key, value in table.items():
        if key not in inner:
            yield pair_text(".".join(map(key_text, key.split("."))), value)
    for key in inner:
        if key in table:
            yield from _section(f"{name}.{key}", table[key])
