"""Reactions from body coordinates and Lagrange multipliers, in float64 or at 50 digits.

Every moving link is a body with the coordinates (x, y, θ) of its reference point, every pair and
driver a constraint with the Jacobian J:

    J v = ν (rates of the drivers),   J a = γ,   Jᵀ λ = −W,   W = loads + inertia forces

(E. J. Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems, 1989, sections 3.6 and
6.6).  A multiplier times its row is what the pair does to its links.  Only places of joints and
angles of links at the position are taken from what is tested: no derivative, no group, no
dimension.

Where J has more rows than columns, links are redundant.  λ is then the solution of least norm,
and a reaction is determined if and only if it is zero in every self-stress, the vectors of
null(Jᵀ) (M. Wojtyra, Joint reaction forces in multibody systems with redundant constraints,
Multibody Syst. Dyn. 14 (2005) 23).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from oracles.dynamics.body_constraints import Constraints
from oracles.dynamics.body_places import GROUND, Places, cross
from oracles.dynamics.body_wrenches import inertia_wrenches, load_wrenches

if TYPE_CHECKING:
    from assur import Machine
    from oracles.dynamics.body_wrenches import Wrench

# Of a unit self-stress; it is known to some 1e-13 where lengths fit to rounding.
DETERMINED = 1e-6
# Refinements: the residual shrinks by roundoff × condition each time.
ROUNDS = {False: 2, True: 12}


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
        drivers = (np.size(m.q0),)
        self.q = np.asarray(q, np.float64).reshape(drivers)
        self.speed = np.broadcast_to(np.asarray(speed, np.float64), drivers)
        self.acceleration = np.broadcast_to(np.asarray(acceleration, np.float64), drivers)
        self.places = Places(m, q, exact)
        self.constraints = Constraints(m, self.places)
        self.rows, self.moving = self.constraints.rows, self.constraints.moving
        self.links_at = self.constraints.links_at
        self.factorize()
        self.move()
        self.loads = list(load_wrenches(self))
        self.inertia = list(inertia_wrenches(self))
        self.balance()

    # -- linear equations ---------------------------------------------------------------------

    def factorize(self) -> None:
        """The pseudoinverse in float64; refinement does the rest."""
        matrix = self.constraints.matrix()
        left, values, right = np.linalg.svd(matrix)
        count = values.size
        if matrix.shape[0] < count or values[-1] < 1e-12 * values[0]:
            message = f"the position is singular: {values[-1] / values[0]:.1e}"
            raise ArithmeticError(message)
        self.condition = float(values[0] / values[-1])
        self.inverse = right.T @ np.diag(1 / values) @ left[:, :count].T
        size = self.places.size
        self.unit = np.array([size if row.turns else 1.0 for row in self.rows])
        # multipliers in balance without load, a row each; moments in parts of the size
        self.self_stress = left[:, count:].T

    def solve_rates(self, wanted: list[Any]) -> tuple[dict[str, Any], dict[str, Any]]:
        """Rates of reference points and angles for given sides."""
        zero = self.places.real(0)
        velocity: dict[str, Any] = dict.fromkeys((GROUND, *self.moving), zero)
        spin: dict[str, Any] = dict.fromkeys((GROUND, *self.moving), zero)
        for _ in range(ROUNDS[self.exact]):
            now = self.constraints.rates(velocity, spin)
            left = [a - b for a, b in zip(wanted, now, strict=True)]
            top = max(abs(v) for v in left)
            if top == 0:
                break
            # rows of moments are rates of angles: times the size they are lengths as the others
            step = self.inverse @ (np.array([float(v / top) for v in left]) * self.unit)
            for k, link in enumerate(self.moving):
                x, y, turned = step[3 * k : 3 * k + 3].tolist()
                velocity[link] = velocity[link] + complex(x, y) * top
                spin[link] = spin[link] + turned * top / self.places.size
        return velocity, spin

    def move(self) -> None:
        """Velocities, then accelerations, of reference points and angles."""
        rows = self.constraints
        self.velocity, self.spin = self.solve_rates(rows.speeds(self.speed.tolist()))
        side = rows.centripetal(self.velocity, self.spin, self.acceleration.tolist())
        self.second, self.second_spin = self.solve_rates(side)

    def balance(self) -> None:
        """λ, by refinement of the pseudoinverse's transpose."""
        self.multipliers: list[Any] = [self.places.real(0)] * len(self.rows)
        for _ in range(ROUNDS[self.exact]):
            force, couple = self.unbalanced()
            left = [v for n in self.moving for v in (force[n].real, force[n].imag, couple[n])]
            top = max(abs(v) for v in left)
            if top == 0:
                break
            scaled = np.array([float(v / top) for v in left])
            scaled[2::3] /= self.places.size
            step = (-(self.inverse.T @ scaled) * self.unit).tolist()
            self.multipliers = [a + b * top for a, b in zip(self.multipliers, step, strict=True)]

    def unbalanced(self) -> tuple[dict[str, Any], dict[str, Any]]:
        """Force and couple about the reference point that are left on each link."""
        force, couple = self.reduced([*self.loads, *self.inertia])
        for row, value in zip(self.rows, self.multipliers, strict=True):
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
        for other, k in self.constraints.pin_rows[name]:
            one = multipliers[k] + 1j * multipliers[k + 1]
            if other == on:
                return -one
            total = total + one
        return total

    def moment(self, slide: str) -> float:
        """On the sliding link, about the sliding point."""
        return float(self.multipliers[self.constraints.slide_rows[slide]])

    def normal(self, slide: str) -> float:
        """On the sliding link, along the guide turned +90°."""
        return float(self.multipliers[self.constraints.slide_rows[slide] + 1])

    def driver(self, k: int = 0) -> float:
        """Torque on the driven link, or force along the guide on the sliding link."""
        return float(self.multipliers[self.constraints.driver_rows[k]])

    @property
    def shaking(self) -> tuple[complex, float]:
        """−Σ m a, and −Σ (r × m a + I α) about the origin."""
        force, couple = 0j, 0.0
        for w in self.inertia:
            force, couple = force + w.force, couple + w.couple + cross(w.place, w.force)
        return complex(force), float(couple)

    def on_ground(self) -> tuple[complex, float]:
        """What pairs and drivers do to the ground, about the origin."""
        force, couple = self.unbalanced()
        loads, moments = self.reduced(self.loads)
        return complex(force[GROUND] - loads[GROUND]), float(couple[GROUND] - moments[GROUND])

    def largest(self) -> float:
        """The largest force of all; moments count by the mechanism's size."""
        size, acting = self.places.size, (*self.loads, *self.inertia)
        forces = [abs(w.force) for w in acting] + [abs(w.couple) / size for w in acting]
        forces += [abs(v) / u for v, u in zip(self.multipliers, self.unit.tolist(), strict=True)]
        return float(max(forces))

    # -- redundant links ----------------------------------------------------------------------

    def joint_is_determined(self, name: str, on: str) -> bool:
        return all(abs(self.pin_force(name, on, v)) < DETERMINED for v in self.self_stress)

    def slide_is_determined(self, slide: str) -> tuple[bool, bool]:
        """Of the moment and the normal force."""
        k = self.constraints.slide_rows[slide]
        return self.row_is_determined(k), self.row_is_determined(k + 1)

    def driver_is_determined(self, k: int = 0) -> bool:
        return self.row_is_determined(self.constraints.driver_rows[k])

    def row_is_determined(self, k: int) -> bool:
        return bool((np.abs(self.self_stress[:, k]) < DETERMINED).all())


def unit_roundoff() -> float:
    """As the conventions have it: u = 2.2e-16, the spacing of numbers at 1."""
    return float(np.finfo(np.float64).eps)
