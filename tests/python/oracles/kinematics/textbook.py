"""Four-bars and slider-cranks by the formulas of textbooks, for many designs at once.

Positions by the triangle of the rocker's dyad, rates by the loop equation differentiated (Norton,
*Design of Machinery*, chapters 4, 6 and 7). Nothing here calls the package.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

Float = npt.NDArray[np.float64]


@dataclass(frozen=True)
class FourBars:
    """Lengths of the links, (n,), and a point P of the coupler in the frame B, C."""

    crank: Float
    coupler: Float
    rocker: Float
    ground: Float
    point: tuple[float, float]

    def moves(self, q: Float) -> npt.NDArray[np.bool_]:
        """Whether the dyad closes at all of q."""
        chord = self._chord(q)
        long = self.coupler[:, None] + self.rocker[:, None]
        short = np.abs(self.coupler - self.rocker)[:, None]
        closes: npt.NDArray[np.bool_] = np.all((short < chord) & (chord < long), axis=1)
        return closes

    def _chord(self, q: Float) -> Float:
        a, d = self.crank[:, None], self.ground[:, None]
        return np.sqrt(a * a + d * d - 2 * a * d * np.cos(q))

    def angles(self, q: Float) -> list[Float]:
        """The angles of coupler and rocker; C is to the right of the ray from D to B."""
        a, b = self.crank[:, None], self.coupler[:, None]
        c, d = self.rocker[:, None], self.ground[:, None]
        chord = self._chord(q)
        towards = np.arctan2(a * np.sin(q), a * np.cos(q) - d)
        at_d = np.arccos((chord**2 + c * c - b * b) / (2 * chord * c))
        rocker = np.unwrap(towards - at_d, axis=1)
        joint = d + c * np.exp(1j * rocker)
        coupler = np.unwrap(np.angle(joint - a * np.exp(1j * q)), axis=1)
        return [coupler, rocker]

    def transmission(self, q: Float) -> Float:
        """The acute angle of coupler and rocker: by the law of cosines."""
        b, c = self.coupler[:, None], self.rocker[:, None]
        angle = np.arccos((b * b + c * c - self._chord(q) ** 2) / (2 * b * c))
        return np.minimum(angle, np.pi - angle)

    def motion(self, q: Float) -> dict[str, list[Float]]:
        """Coordinates with three derivatives by the crank's angle."""
        coupler, rocker = ([angle] for angle in self.angles(q))
        crank = [np.broadcast_to(q, rocker[0].shape), np.ones((1, 1)), *[np.zeros((1, 1))] * 2]
        a, b, c = self.crank[:, None], self.coupler[:, None], self.rocker[:, None]
        for order in (1, 2, 3):
            # Of the loop a e^(i q) + b e^(i θ3) = d + c e^(i θ4): what does not have the unknown.
            zero = np.zeros_like(rocker[0])
            known = [
                length * turned([*angle[:order], zero], order)
                for length, angle in ((b, coupler), (c, rocker))
            ]
            rest = known[1] - known[0] - a * turned(crank, order)
            one, two = 1j * b * np.exp(1j * coupler[0]), -1j * c * np.exp(1j * rocker[0])
            scale = (np.conj(one) * two).imag
            coupler.append((np.conj(rest) * two).imag / scale)
            rocker.append((np.conj(one) * rest).imag / scale)
        x, y = self.point
        pins = [a * turned(crank, order) for order in range(4)]
        points = [p + (x + 1j * y) * turned(coupler, k) for k, p in enumerate(pins)]
        joints = [c * turned(rocker, k) + (self.ground[:, None] if k == 0 else 0) for k in range(4)]
        return {
            "rocker": rocker,
            "coupler": coupler,
            "C.x": [p.real for p in joints],
            "C.y": [p.imag for p in joints],
            "P.x": [p.real for p in points],
            "P.y": [p.imag for p in points],
        }


def turned(angle: list[Float], order: int) -> npt.NDArray[np.complex128]:
    """A derivative of e^(iθ), given θ and its derivatives."""
    factor: Any = 1.0
    if order == 1:
        factor = 1j * angle[1]
    elif order == 2:
        factor = 1j * angle[2] - angle[1] ** 2
    elif order == 3:
        factor = 1j * angle[3] - 3 * angle[1] * angle[2] - 1j * angle[1] ** 3
    found: npt.NDArray[np.complex128] = factor * np.exp(1j * angle[0])
    return found


def piston(crank: Float, rod: Float, offset: Float, q: Float) -> Float:
    """The place of a slider-crank's piston along the bore, the offset to its left."""
    r, lever = rod[:, None], crank[:, None] * np.sin(q) - offset[:, None]
    place: Float = crank[:, None] * np.cos(q) + np.sqrt(r * r - lever * lever)
    return place


def windows(path: Float, count: int, closed: bool) -> Float:
    """Every stretch of so many points; those of a closed path pass its end."""
    starts = len(path) if closed else len(path) - count + 1
    return np.stack(
        [np.take(path, range(k, k + count), axis=0, mode="wrap") for k in range(starts)]
    )


def off_line(path: Float, count: int, closed: bool, relative: bool) -> float:
    """The least of the greatest distances from lines of least squares, by singular values."""
    best = np.inf
    for stretch in windows(path, count, closed):
        from_middle = stretch - stretch.mean(axis=0)
        _, _, (along, across) = np.linalg.svd(from_middle)
        off = np.abs(from_middle @ across).max()
        if relative:
            off /= np.ptp(from_middle @ along)
        best = min(best, off)
    return best


def off_circle(path: Float, count: int, closed: bool, relative: bool) -> float:
    """The same from circles by linear least squares (Kåsa)."""
    best = np.inf
    for stretch in windows(path, count, closed):
        middle = stretch.mean(axis=0)
        about = stretch - middle
        matrix = np.column_stack([2 * about, np.ones(count)])
        (a, b, c), *_ = np.linalg.lstsq(matrix, (about**2).sum(axis=1), rcond=None)
        radius = np.sqrt(c + a * a + b * b)
        off = np.abs(np.hypot(*(about - [a, b]).T) - radius).max()
        best = min(best, off / radius if relative else off)
    return best
