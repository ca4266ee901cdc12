"""The constraints of pairs and drivers on bodies: rows of the Jacobian, and the side γ of J a = γ.

A row is what a unit multiplier does to each link: a force and a couple about its reference point.
A turning pair of n links is n − 1 pairs between the first and each other, two rows each; a sliding
pair keeps the angle and the distance across the guide; a driver sets an angle or the distance
along a guide (E. J. Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems, 1989,
section 3.3).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from oracles.dynamics.body_places import GROUND, Places, cross, dot

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from assur import Mechanism


@dataclass(frozen=True)
class Row:
    """By link the force and the couple of a unit multiplier."""

    parts: dict[str, tuple[Any, Any]]
    turns: bool  # the multiplier is a moment
    driver: int | None = None


class Constraints:
    """All constraints at one position."""

    def __init__(self, m: Mechanism, places: Places) -> None:
        self.mechanism, self.places = m, places
        self.links_at = {
            joint: [link for link, own in m.links.items() if joint in own] for joint in m.joints
        }
        self.moving = [link for link in m.links if link != GROUND]
        self.rows: list[Row] = []
        self.pin_rows: dict[str, list[tuple[str, int]]] = {}  # other link and its first row
        self.slide_rows: dict[str, int] = {}  # turning, then across
        self.driver_rows: list[int] = []
        self.add_pairs()
        self.add_drivers()

    # -- rows ---------------------------------------------------------------------------------

    def at(self, link: str, place: Any, direction: Any) -> tuple[Any, Any]:
        """A unit force at a place, reduced to the link's reference point."""
        return direction, cross(place - self.places.reference[link], direction)

    def between(self, a: str, b: str, place: Any, direction: Any, driver: int | None = None) -> Row:
        """The relative velocity of two links' points at one place, along a direction."""
        x, couple = self.at(b, place, direction)
        return Row({a: self.at(a, place, direction), b: (-x, -couple)}, False, driver)

    def turning(self, a: str, b: str, driver: int | None = None) -> Row:
        return Row({a: (0.0, 1.0), b: (0.0, -1.0)}, True, driver)

    def add_pairs(self) -> None:
        places = self.places
        for joint, place in places.joints.items():
            first, *others = self.links_at[joint]
            self.pin_rows[joint] = []
            for other in others:
                self.pin_rows[joint].append((other, len(self.rows)))
                self.rows += [self.between(first, other, place, d) for d in (1.0, 1j)]
        for name, slide in self.mechanism.slides.items():
            self.slide_rows[name] = len(self.rows)
            self.rows.append(self.turning(slide.link, slide.on))
            across = 1j * places.guide[name]
            self.rows.append(self.between(slide.link, slide.on, places.sliding[name], across))

    def add_drivers(self) -> None:
        places = self.places
        for k, (kind, a, b) in enumerate(places.drivers):
            self.driver_rows.append(len(self.rows))
            if kind == "angle":
                self.rows.append(self.turning(a, b, k))
            else:
                place, along = places.sliding[kind], places.guide[kind]
                self.rows.append(self.between(a, b, place, along, k))

    def matrix(self) -> NDArray[np.float64]:
        """In float64; lengths in parts of the size, so that all unknowns and rows are alike."""
        size, column = self.places.size, {link: 3 * k for k, link in enumerate(self.moving)}
        out = np.zeros((len(self.rows), 3 * len(self.moving)))
        for i, row in enumerate(self.rows):
            for link, (force, couple) in row.parts.items():
                if link != GROUND:
                    z, k = complex(force), column[link]
                    turned = float(couple) / (1.0 if row.turns else size)
                    out[i, k : k + 3] = z.real, z.imag, turned
        return out

    def rates(self, velocity: dict[str, Any], spin: dict[str, Any]) -> list[Any]:
        """J times velocities of reference points and angular velocities."""
        out = []
        for row in self.rows:
            total = self.places.real(0)
            for link, (force, couple) in row.parts.items():
                total = total + dot(force, velocity[link]) + couple * spin[link]
            out.append(total)
        return out

    # -- the sides of J v = ν and J a = γ -----------------------------------------------------

    def speeds(self, speed: Sequence[float]) -> list[Any]:
        real = self.places.real
        return [real(0.0 if r.driver is None else speed[r.driver]) for r in self.rows]

    def centripetal(
        self, velocity: dict[str, Any], spin: dict[str, Any], acceleration: Sequence[float]
    ) -> list[Any]:
        """γ: the second derivatives without the accelerations, negative."""
        places, reference = self.places, self.places.reference
        out: list[Any] = []
        for joint, place in places.joints.items():
            first, *others = self.links_at[joint]
            for other in others:
                gap = spin[first] ** 2 * (place - reference[first])
                gap = gap - spin[other] ** 2 * (place - reference[other])
                out += [gap.real, gap.imag]

        def along(name: str, direction: Any) -> Any:
            """Of direction · (sliding point − guide's reference point); the direction turns."""
            slide, place = self.mechanism.slides[name], places.sliding[name]
            a, b = slide.link, slide.on
            arm, far = place - reference[a], place - reference[b]
            apart = velocity[a] + 1j * spin[a] * arm - velocity[b]
            own = spin[a] ** 2 * dot(direction, arm) + spin[b] ** 2 * dot(direction, far)
            return own - 2 * spin[b] * dot(1j * direction, apart)

        for name in self.mechanism.slides:
            out += [places.real(0), along(name, 1j * places.guide[name])]
        for k, (kind, _, _) in enumerate(places.drivers):
            given = places.real(acceleration[k])
            out.append(given if kind == "angle" else given + along(kind, places.guide[kind]))
        return out
