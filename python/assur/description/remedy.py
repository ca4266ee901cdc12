"""Finding changes that make a mechanism of a refused description."""

from __future__ import annotations

from typing import Any

from assur._core import remedies
from assur._remedy import Remedy
from assur.description.words import Drive, Slide

__all__ = ["find"]


def find(description: dict[str, Any]) -> tuple[Remedy, ...]:
    """Return up to three remedies of a refused description, as the core takes it."""
    return tuple(
        Remedy(
            text=parts["text"],
            detail=parts["detail"],
            kind=parts["kind"],
            names=tuple(parts["names"]),
            _joints=tuple(parts["joints"]),
            _links=tuple((name, tuple(on)) for name, on in parts["links"]),
            _slides=tuple((name, Slide(**fields)) for name, fields in parts["slides"]),
            _drivers=tuple(
                name if base is None else Drive(name, relative_to=base)
                for name, base in parts["drivers"]
            ),
            _assembly=tuple(parts["assembly"]),
        )
        for parts in remedies(**description)
    )
