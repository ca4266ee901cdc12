"""Which reaction: the names by which the core finds it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Key:
    """A reaction: its kind, and the indices of the joint or slide and of the link."""

    kind: str
    index: int = 0
    on: int = 0

    @property
    def has_two_axes(self) -> bool:
        """Whether each position has two numbers, x and y."""
        return self.kind in ("joint", "shaking force", "load force", "load place")


SOLUTIONS, SAFETY, RESIDUAL = Key("solutions"), Key("safety"), Key("residual")
