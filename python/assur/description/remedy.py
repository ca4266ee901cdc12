"""Finding what would make a mechanism of a description that is refused."""

from __future__ import annotations

from typing import Any

from assur._core import remedies
from assur._remedy import Remedy
from assur.description.words import Drive, Slide

__all__ = ["find"]


def find(description: dict[str, Any]) -> tuple[Remedy, ...]:
    """Return up to three remedies of a description, as the core takes it, that is refused."""
    return tuple(
        Remedy(
            text=own["text"],
            detail=own["detail"],
            kind=own["kind"],
            names=tuple(own["names"]),
            _joints=tuple(own["joints"]),
            _links=tuple((name, tuple(on)) for name, on in own["links"]),
            _slides=tuple((name, Slide(**fields)) for name, fields in own["slides"]),
            _drivers=tuple(
                name if other is None else Drive(name, other) for name, other in own["drivers"]
            ),
            _assembly=tuple(own["assembly"]),
        )
        for own in remedies(**description)
    )
