"""Where the bodies of a mechanism are at one position: reference points, guides, sliding points.

Taken from places of joints and angles of links alone.  Directions are complex numbers.
"""

from __future__ import annotations

import cmath
from typing import TYPE_CHECKING, Any

import numpy as np

from models.mechanisms.mechanism_data import GROUND
from oracles.kinematics.oracle_system import MP

if TYPE_CHECKING:
    from assur import Mechanism

__all__ = ["GROUND", "Places", "cross", "dot"]


def dot(a: Any, b: Any) -> Any:
    return (a.conjugate() * b).real


def cross(a: Any, b: Any) -> Any:
    return (a.conjugate() * b).imag


class Places:
    """Bodies at one position, in float64 or with 50 digits (of the same float64 numbers)."""

    def __init__(self, m: Mechanism, q: Any, exact: bool) -> None:
        motion = m.solve(q, order=0)
        self.mechanism, self.exact = m, exact
        self.drawn = {n: complex(*p) for n, p in m.joints.items()}
        self.joints = {n: self.plane(motion.joint(n).value) for n in m.joints}
        self.angle = {n: self.real(motion.link(n).value) for n in m.links if n != GROUND}
        self.angle[GROUND] = self.real(0)
        self.value = {n: self.real(motion.slide(n).value) for n in m.slides}
        self.drivers = driver_links(m)
        self.frame = {n: self.axis(n) for n in m.links}
        self.guide = {n: self.guide_direction(n) for n in m.slides}
        self.reference = {n: self.plane(0j) for n in m.links}
        for link, own in m.links.items():
            if link != GROUND and own:
                self.reference[link] = self.joints[own[0]]
        self.place_links_without_joints()
        self.sliding = {n: self.reference[s.link] for n, s in m.slides.items()}
        for name, slide in m.slides.items():
            if m.links[slide.link]:  # the ground's reference point is the origin
                self.sliding[name] = self.joints[m.links[slide.link][0]]
        places = np.array([complex(p) for p in (*self.joints.values(), *self.reference.values())])
        self.size = float(max(np.ptp(places.real), np.ptp(places.imag)))

    # -- numbers ------------------------------------------------------------------------------

    def real(self, value: Any) -> Any:
        return MP.mpf(float(value)) if self.exact else float(value)

    def plane(self, value: Any) -> Any:
        z = complex(*value) if np.ndim(value) else complex(value)
        return MP.mpc(z) if self.exact else z

    def turn(self, angle: Any) -> Any:
        return MP.expj(angle) if self.exact else cmath.exp(1j * angle)

    # -- directions ---------------------------------------------------------------------------

    def axis(self, link: str) -> Any:
        """The x axis of a link's frame."""
        own = self.mechanism.links[link]
        if link == GROUND or len(own) < 2:
            return self.turn(self.angle[link])
        side = self.joints[own[1]] - self.joints[own[0]]
        return side / abs(side)

    def drawn_axis(self, link: str) -> Any:
        m, own = self.mechanism, self.mechanism.links[link]
        if link == GROUND:
            return self.plane(1)
        if len(own) >= 2:
            side = self.plane(self.drawn[own[1]]) - self.plane(self.drawn[own[0]])
            return side / abs(side)
        first = next(s for s in m.slides.values() if link in (s.link, s.on))
        return self.turn(self.real(first.angle))

    def guide_direction(self, name: str) -> Any:
        slide = self.mechanism.slides[name]
        drawn = self.turn(self.real(slide.angle))
        along = drawn * self.frame[slide.on] / self.drawn_axis(slide.on)
        return along / abs(along)

    # -- links without joints -----------------------------------------------------------------

    def place_links_without_joints(self) -> None:
        """Their guides stay as far from their marks as in the drawing: linear equations."""
        m = self.mechanism
        free = [n for n, own in m.links.items() if n != GROUND and not own]
        if not free:
            return
        start = {n: self.drawn_reference(n) for n in free}
        matrix, right = [], []
        for name, slide in m.slides.items():
            if slide.link not in free and slide.on not in free:
                continue
            row, across = np.zeros(2 * len(free)), complex(1j * self.guide[name])
            drawn = 1j * cmath.exp(1j * slide.angle)
            far = 0.0
            for link, sign, mark in (
                (slide.link, 1.0, next(iter(m.links[slide.link]), None)),
                (slide.on, -1.0, slide.origin or next(iter(m.links[slide.on]), None)),
            ):
                if link in free:
                    k = 2 * free.index(link)
                    row[k : k + 2] = sign * across.real, sign * across.imag
                    far += sign * dot(drawn, start[link])
                else:
                    assert mark is not None
                    far += sign * (
                        dot(drawn, self.drawn[mark]) - dot(across, complex(self.joints[mark]))
                    )
            matrix.append(row)
            right.append(far)
        found = np.linalg.lstsq(np.array(matrix), np.array(right), rcond=None)[0]
        for k, link in enumerate(free):
            self.reference[link] = self.plane(complex(*found[2 * k : 2 * k + 2]))

    def drawn_reference(self, link: str) -> complex:
        """Where in the drawing the two guides closest to perpendicular intersect."""
        m = self.mechanism
        lines = []
        for slide in m.slides.values():
            if link in (slide.link, slide.on):
                other = slide.on if slide.link == link else slide.link
                mark = slide.origin if slide.link == link else next(iter(m.links[other]), None)
                if mark is not None:
                    lines.append((self.drawn[mark], cmath.exp(1j * slide.angle)))
        pairs = [(a, b) for i, a in enumerate(lines) for b in lines[:i]]
        if not pairs:
            return lines[0][0]
        (p, d), (r, e) = max(pairs, key=lambda two: abs(cross(two[0][1], two[1][1])))
        if abs(cross(d, e)) < 1e-9:
            return lines[0][0]
        return complex(p + d * cross(r - p, e) / cross(d, e))


def driver_links(m: Mechanism) -> list[tuple[str, str, str]]:
    """Of each driver ("angle", link, other) or (slide, link, guide's link)."""
    given: Any = m.driver if isinstance(m.driver, tuple | list) else (m.driver,)
    out = []
    for one in given:
        if isinstance(one, str) and one in m.slides:
            out.append((one, m.slides[one].link, m.slides[one].on))
        elif isinstance(one, str):
            out.append(("angle", one, GROUND))
        else:
            out.append(("angle", one.link, one.relative_to))
    return out
