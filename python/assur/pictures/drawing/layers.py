"""Names of layers that every program reads."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

# What DXF forbids in the name of a layer.
FORBIDDEN = frozenset('<>/\\":;?*|=`,')
# Letters of a name; DXF allows 255.
MOST = 100


def valid_text(text: str) -> str:
    """Return a text on one line, without characters that a file cannot hold."""
    return "".join(letter if letter.isprintable() else "_" for letter in text)


def layer_names(names: Iterable[str]) -> dict[str, str]:
    """Return a valid name for each, different from the others in any case of letters."""
    layers: dict[str, str] = {}
    taken: set[str] = set()
    for name in names:
        text = "".join(
            "_" if letter in FORBIDDEN else letter for letter in valid_text(name)
        ).strip()
        text = text[:MOST] or "_"
        unique, number = text, 2
        while unique.casefold() in taken:
            unique, number = f"{text}_{number}", number + 1
        taken.add(unique.casefold())
        layers[name] = unique
    return layers
