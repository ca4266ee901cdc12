"""The same drawing in another frame: turned, shifted, mirrored, in another unit of length."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from models.mechanisms.mechanism_data import Description

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True)
class Frame:
    """x -> scale (mirror, then turn) x + shift."""

    turn: float = 0.0
    shift: tuple[float, float] = (0.0, 0.0)
    mirror: bool = False
    scale: float = 1.0

    @property
    def hand(self) -> float:
        """What an angle is multiplied by."""
        return -1.0 if self.mirror else 1.0

    @property
    def matrix(self) -> NDArray[np.float64]:
        c, s = math.cos(self.turn), math.sin(self.turn)
        return self.scale * np.array([[c, -s * self.hand], [s, c * self.hand]])

    def of(self, d: Description) -> Description:
        """The drawing in this frame."""
        moved = {n: tuple(self.matrix @ np.array(p) + self.shift) for n, p in d.joints.items()}
        joints = {n: (float(x), float(y)) for n, (x, y) in moved.items()}
        slides = {n: replace(s, angle=self.hand * s.angle + self.turn) for n, s in d.slides.items()}
        return Description(joints, d.links, slides, d.drivers)

    def units(self, d: Description) -> NDArray[np.float64]:
        """What the coordinate of each driver is multiplied by."""
        return np.array([self.scale if kind == "slide" else self.hand for kind, *_ in d.drivers])
