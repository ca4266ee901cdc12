"""Reactions from body coordinates and Lagrange multipliers, in float64 or at 50 digits.

Every moving link is a body with the coordinates (x, y, θ) of its reference point; every turning
pair, sliding pair and driver is a constraint Φ = 0 with the row J = ∂Φ/∂(x, y, θ) (Haug, Computer
Aided Kinematics and Dynamics of Mechanical Systems, 1989, sections 3.3, 6.3 and 6.6):

    J v = ν (rates of the drivers),   J a = γ,   Jᵀ λ = −W,   W = loads + inertia forces.

λ times a row is what the pair does to each of its links.  Only places of joints and angles of
links at the position are taken from what is tested: no derivative, no group, no dimension.

Where J has more rows than columns the links are redundant.  λ is then the solution of least norm,
and a reaction is determined if and only if it is zero for every self-stress, the vectors of
null(Jᵀ) (Wojtyra, Joint reaction forces in multibody systems with redundant constraints, Multibody
Syst. Dyn. 14, 2005).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from body_places import GROUND, Places, cross, dot
from body_wrenches import inertia_wrenches, load_wrenches

if TYPE_CHECKING:
    from collections.abc import Iterable

    from assur import Machine
    from body_wrenches import Wrench

# Of a unit self-stress; it is known to some 1e-13 where lengths fit to rounding.
DETERMINED = 1e-6
# Refinements: the residual shrinks by roundoff × condition each time.
ROUNDS = {False: 3, True: 12}


@dataclass(frozen=True)
class Row:
    """A constraint: by link the force and the couple about its reference point of a unit λ."""

    parts: dict[str, tuple[Any, Any]]
    turns: bool  # λ is a moment
    driver: int | None = None


class Reactions:
    """All forces of a machine at one position."""

    def __init__(
        self,
        machine: Machine,
        q: Any,
        speed: Any = 0.0,
        acceleration: Any = 0.0,
        exact: bool = False,
    ) -> None:
        m = machine.mechanism
        assert m is not None
        self.exact, self.machine = exact, machine
        drivers = np.size(m.q0)
        self.q = np.asarray(q, np.float64).reshape(drivers)
        self.speed = np.broadcast_to(np.asarray(speed, np.float64), (drivers,))
        self.acceleration = np.broadcast_to(np.asarray(acceleration, np.float64), (drivers,))
        self.places = Places(m, q, exact)
        self.moving = [link for link in m.links if link != GROUND]
        self.column = {link: 3 * k for k, link in enumerate(self.moving)}
        self.rows: list[Row] = []
        self.links_at = {
            joint: [link for link, own in m.links.items() if joint in own] for joint in m.joints
        }
        self.pin_rows: dict[str, list[tuple[str, int]]] = {}  # other link and its first row
        self.slide_rows: dict[str, int] = {}  # turning, then across
        self.pair_rows()
        self.driver_rows()
        self.factorize()
        self.move()
        self.loads = list(load_wrenches(self))
        self.inertia = list(inertia_wrenches(self))
        self.balance()

    # -- constraints --------------------------------------------------------------------------

    def at(self, link: str, place: Any, direction: Any) -> tuple[Any, Any]:
        """A unit force along a direction at a place, reduced to the link's reference point."""
        return direction, cross(place - self.places.reference[link], direction)

    def between(self, a: str, b: str, place: Any, direction: Any, driver: int | None = None) -> Row:
        """The relative velocity of two links' points at one place, along a direction."""
        x, couple = self.at(b, place, direction)
        return Row({a: self.at(a, place, direction), b: (-x, -couple)}, False, driver)

    def turning(self, a: str, b: str, driver: int | None = None) -> Row:
        return Row({a: (0.0, 1.0), b: (0.0, -1.0)}, True, driver)

    def pair_rows(self) -> None:
        places, m = self.places, self.machine.mechanism
        assert m is not None
        for joint, place in places.joints.items():
            first, *others = self.links_at[joint]
            self.pin_rows[joint] = []
            for other in others:
                self.pin_rows[joint].append((other, len(self.rows)))
                self.rows += [self.between(first, other, place, d) for d in (1.0, 1j)]
        for name, slide in m.slides.items():
            self.slide_rows[name] = len(self.rows)
            self.rows.append(self.turning(slide.link, slide.on))
            across = 1j * places.guide[name]
            self.rows.append(self.between(slide.link, slide.on, places.sliding[name], across))

    def driver_rows(self) -> None:
        places = self.places
        for k, (kind, a, b) in enumerate(places.drivers):
            if kind == "angle":
                self.rows.append(self.turning(a, b, k))
            else:
                slide = places.mechanism.slides[kind]
                place, along = places.sliding[kind], places.guide[kind]
                self.rows.append(self.between(slide.link, slide.on, place, along, k))

    def right_sides(self) -> list[Any]:
        """γ: what the constraints' second derivatives are without accelerations, negative."""
        places, m = self.places, self.machine.mechanism
        assert m is not None
        rates, spin, reference = self.velocity, self.spin, places.reference
        out: list[Any] = []
        for joint, place in places.joints.items():
            first, *others = self.links_at[joint]
            for other in others:
                gap = spin[first] ** 2 * (place - reference[first])
                gap = gap - spin[other] ** 2 * (place - reference[other])
                out += [gap.real, gap.imag]

        def along(name: str, direction: Any) -> Any:
            """Of direction · (sliding point − guide's reference point); the direction turns."""
            slide, place = m.slides[name], places.sliding[name]
            a, b = slide.link, slide.on
            arm, far = place - reference[a], place - reference[b]
            apart = rates[a] + 1j * spin[a] * arm - rates[b]
            out = spin[a] ** 2 * dot(direction, arm) + spin[b] ** 2 * dot(direction, far)
            return out - 2 * spin[b] * dot(1j * direction, apart)

        for name in m.slides:
            out += [0.0, along(name, 1j * places.guide[name])]
        for k, (kind, _, _) in enumerate(places.drivers):
            own = 0.0 if kind == "angle" else along(kind, places.guide[kind])
            out.append(own + self.acceleration[k])
        return out

    # -- linear equations ---------------------------------------------------------------------

    def factorize(self) -> None:
        """The rows in float64, lengths in parts of the size; refinement does the rest."""
        size = self.places.size
        matrix = np.zeros((len(self.rows), 3 * len(self.moving)))
        for i, row in enumerate(self.rows):
            for link, (force, couple) in row.parts.items():
                if link != GROUND:
                    k, unit = self.column[link], size if row.turns else 1.0
                    matrix[i, k : k + 3] = (
                        complex(force).real,
                        complex(force).imag,
                        float(couple) / size * unit,
                    )
        left, values, right = np.linalg.svd(matrix)
        count = values.size
        if matrix.shape[0] < count or values[-1] < 1e-12 * values[0]:
            message = f"the position is singular: {values[-1] / values[0]:.1e}"
            raise ArithmeticError(message)
        self.condition = float(values[0] / values[-1])
        self.inverse = right.T @ np.diag(1 / values) @ left[:, :count].T
        self.self_stress = left[:, count:].T  # of scaled multipliers, a row each
        self.unit = np.array([size if row.turns else 1.0 for row in self.rows])

    def rate(self, x: list[Any]) -> list[Any]:
        """J x, x a list of (velocity, spin) of the moving links, flat: complex, real."""
        return [
            sum(
                dot(force, x[2 * self.moving.index(n)]) + couple * x[2 * self.moving.index(n) + 1]
                for n, (force, couple) in row.parts.items()
                if n != GROUND
            )
            for row in self.rows
        ]

    def solve_rates(self, right: Iterable[Any]) -> list[Any]:
        """x with J x = right, by refinement of the float64 pseudoinverse."""
        wanted = [self.places.real(v) for v in right]
        x: list[Any] = [self.places.real(0)] * (2 * len(self.moving))
        for _ in range(ROUNDS[self.exact]):
            left = [a - b for a, b in zip(wanted, self.rate(x), strict=True)]
            top = max((abs(v) for v in left), default=0)
            if top == 0:
                break
            scaled = np.array([float(v / top) for v in left]) * self.unit
            step = self.inverse @ scaled
            for k in range(len(self.moving)):
                u, v, w = (float(s) for s in step[3 * k : 3 * k + 3])
                x[2 * k] = x[2 * k] + complex(u, v) * top
                x[2 * k + 1] = x[2 * k + 1] + w * top / self.places.size
        return x

    def move(self) -> None:
        """Velocities, then accelerations, of reference points and angles."""
        given = [0.0 if r.driver is None else self.speed[r.driver] for r in self.rows]
        self.velocity, self.spin = self.by_link(self.solve_rates(given))
        accelerations = self.solve_rates(self.right_sides())
        self.second, self.second_spin = self.by_link(accelerations)

    def by_link(self, x: list[Any]) -> tuple[dict[str, Any], dict[str, Any]]:
        zero = self.places.real(0)
        first = {GROUND: zero} | {n: x[2 * k] for k, n in enumerate(self.moving)}
        second = {GROUND: zero} | {n: x[2 * k + 1] for k, n in enumerate(self.moving)}
        return first, second

    def balance(self) -> None:
        """λ, by refinement of the pseudoinverse's transpose."""
        self.multipliers: list[Any] = [self.places.real(0)] * len(self.rows)
        for _ in range(ROUNDS[self.exact]):
            force, couple = self.unbalanced()
            left = [v for n in self.moving for v in (force[n].real, force[n].imag, couple[n])]
            top = max((abs(v) for v in left), default=0)
            if top == 0:
                break
            scaled = np.array([float(v / top) for v in left])
            scaled[2::3] /= self.places.size
            step = -(self.inverse.T @ scaled) * self.unit
            self.multipliers = [
                a + float(b) * top for a, b in zip(self.multipliers, step, strict=True)
            ]

    def unbalanced(self, multipliers: Any = None) -> tuple[dict[str, Any], dict[str, Any]]:
        """Force and couple about the reference point that are left on each link."""
        own = self.multipliers if multipliers is None else multipliers
        force, couple = self.reduced([*self.loads, *self.inertia])
        for row, value in zip(self.rows, own, strict=True):
            for link, (f, c) in row.parts.items():
                force[link] = force[link] + f * value
                couple[link] = couple[link] + c * value
        return force, couple

    def reduced(self, wrenches: list[Wrench]) -> tuple[dict[str, Any], dict[str, Any]]:
        """The sum of wrenches on each link, about its reference point."""
        zero = self.places.real(0)
        force: dict[str, Any] = dict.fromkeys((GROUND, *self.moving), zero + 0j)
        couple: dict[str, Any] = dict.fromkeys((GROUND, *self.moving), zero)
        for one in wrenches:
            force[one.link] = force[one.link] + one.force
            arm = one.place - self.places.reference[one.link]
            couple[one.link] = couple[one.link] + one.couple + cross(arm, one.force)
        return force, couple

    # -- what is asked for --------------------------------------------------------------------

    def joint(self, name: str, on: str) -> complex:
        """The force on a link at a joint from all others there."""
        return complex(self.pin_force(name, on, self.multipliers))

    def pin_force(self, name: str, on: str, multipliers: Any) -> Any:
        total: Any = 0.0
        for other, k in self.pin_rows[name]:
            one = multipliers[k] + 1j * multipliers[k + 1]
            if other == on:
                return -one
            total = total + one
        return total

    def moment(self, slide: str) -> float:
        """On the sliding link, about the sliding point."""
        return float(self.multipliers[self.slide_rows[slide]])

    def normal(self, slide: str) -> float:
        """On the sliding link, along the guide turned +90°."""
        return float(self.multipliers[self.slide_rows[slide] + 1])

    def driver(self, k: int = 0) -> float:
        """Torque on the driven link, or force along the guide on the sliding link."""
        row = next(i for i, row in enumerate(self.rows) if row.driver == k)
        return float(self.multipliers[row])

    @property
    def shaking(self) -> tuple[complex, float]:
        """−Σ m a, and −Σ (r × m a + I α) about the origin."""
        force, couple = sum(w.force for w in self.inertia), 0.0
        for w in self.inertia:
            couple = couple + w.couple + cross(w.place, w.force)
        return complex(force), float(couple)

    def on_ground(self) -> tuple[complex, float]:
        """What pairs and drivers do to the ground, about the origin."""
        force, couple = self.unbalanced()
        loads, moments = self.reduced(self.loads)
        return complex(force[GROUND] - loads[GROUND]), float(couple[GROUND] - moments[GROUND])

    # -- redundant links ----------------------------------------------------------------------

    def joint_is_determined(self, name: str, on: str) -> bool:
        return all(abs(self.pin_force(name, on, v)) < DETERMINED for v in self.self_stress)

    def slide_is_determined(self, slide: str) -> tuple[bool, bool]:
        """Of the moment and the normal force."""
        k = self.slide_rows[slide]
        moment, normal = (np.abs(self.self_stress[:, j]) < DETERMINED for j in (k, k + 1))
        return bool(moment.all()), bool(normal.all())

    def driver_is_determined(self, k: int = 0) -> bool:
        row = next(i for i, row in enumerate(self.rows) if row.driver == k)
        return bool((np.abs(self.self_stress[:, row]) < DETERMINED).all())

    def largest(self) -> float:
        """The largest force of all; moments count by the mechanism's size."""
        size = self.places.size
        forces = [abs(w.force) for w in (*self.loads, *self.inertia)]
        forces += [abs(w.couple) / size for w in (*self.loads, *self.inertia)]
        for row, value in zip(self.rows, self.multipliers, strict=True):
            forces.append(abs(value) / (size if row.turns else 1.0))
        return float(max(forces))


def unit_roundoff() -> float:
    """As the conventions have it: u = 2.2e-16, the spacing of numbers at 1."""
    return float(np.finfo(np.float64).eps)
