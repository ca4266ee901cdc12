"""The line of a sliding pair."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from assur.pictures.scene.geometry import left_of, unit_vector

if TYPE_CHECKING:
    from assur._arrays import Float


@dataclass(frozen=True, eq=False)
class Axis:
    """The line of a sliding pair.

    `angle` is its direction in either link's frame. The point `block` is fixed to `sliding`;
    seen from `guide` it goes from `low` to `high` along the line, `off` to its left.
    """

    name: str
    sliding: str
    guide: str
    block: Float
    angles: tuple[float, float]
    low: float
    high: float
    off: float

    def on_guide(self, along: float) -> Float:
        """Return a point of the line in the guide's frame."""
        return unit_vector(self.angles[1]) * along + left_of(self.angles[1]) * self.off
