"""Machines in redundant coordinates: three a link, constraints with multipliers, solved by SciPy.

Nothing of Assur's groups, closures or analogues: every link is a free body, joints and slides are
constraints differentiated twice (index 1; E. J. Haug, Computer Aided Kinematics and Dynamics of
Mechanical Systems, 1989, chapter 6).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.integrate import solve_ivp

import assur

if TYPE_CHECKING:
    from collections.abc import Callable

TIGHT = 1e-13


def turned(angle: float) -> Any:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s], [s, c]])


@dataclass
class Point:
    """A point fixed to a link (-1: the frame)."""

    link: int
    at: Any

    def now(self, z: Any) -> Any:
        if self.link < 0:
            return self.at
        return z[3 * self.link : 3 * self.link + 2] + turned(z[3 * self.link + 2]) @ self.at

    def rows(self, z: Any) -> Any:
        """Derivative by the coordinates, (2, 3 n)."""
        rows = np.zeros((2, z.size))
        if self.link >= 0:
            k = 3 * self.link
            rows[:, k : k + 2] = np.eye(2)
            rows[:, k + 2] = turned(z[k + 2] + np.pi / 2) @ self.at
        return rows

    def centripetal(self, z: Any, v: Any) -> Any:
        if self.link < 0:
            return np.zeros(2)
        k = 3 * self.link
        return -(v[k + 2] ** 2) * (turned(z[k + 2]) @ self.at)


class Dae:
    """A machine of one design at its drawing."""

    def __init__(self, machine: assur.Machine) -> None:
        m = machine.mechanism
        assert m is not None
        self.machine, self.mechanism = machine, m
        self.links = [name for name in m.links if name != "ground"]
        places = {name: np.array(at) for name, at in m.joints.items()}
        self.z = np.zeros(3 * len(self.links))
        self.homes: dict[str, list[Point]] = {name: [] for name in places}
        self.local: dict[tuple[str, str], Any] = {}
        for k, name in enumerate(self.links):
            joints = m.links[name]
            origin = places[joints[0]]
            angle = 0.0
            if len(joints) > 1:
                angle = float(np.arctan2(*(places[joints[1]] - origin)[::-1]))
            self.z[3 * k : 3 * k + 3] = [*origin, angle]
            for joint in joints:
                at = turned(-angle) @ (places[joint] - origin)
                self.homes[joint].append(Point(k, at))
        for joint in m.links["ground"]:
            self.homes[joint].insert(0, Point(-1, places[joint]))
        self.rest = self.z.copy()

    def constraints(self, z: Any, v: Any) -> tuple[Any, Any]:
        """Rows and right-hand sides of rows @ accelerations = right-hand sides."""
        rows, right = [], []
        for homes in self.homes.values():
            first = homes[0]
            for other in homes[1:]:
                rows.extend(other.rows(z) - first.rows(z))
                right.extend(first.centripetal(z, v) - other.centripetal(z, v))
        for slide in self.mechanism.slides.values():
            k = self.links.index(slide.link)
            assert slide.on == "ground", "the oracle knows slides on the frame alone"
            across = np.array([-np.sin(slide.angle), np.cos(slide.angle)])
            straight = np.zeros(z.size)
            straight[3 * k : 3 * k + 2] = across
            still = np.zeros(z.size)
            still[3 * k + 2] = 1.0
            rows += [straight, still]
            right += [0.0, 0.0]
        return np.array(rows), np.array(right)

    def point(self, place: Any) -> Point:
        if isinstance(place, str):
            return self.homes[place][0]
        link, at = place
        return Point(-1 if link == "ground" else self.links.index(link), np.array(at))

    def angle(self, link: str, numbers: Any) -> Any:
        return 0.0 if link == "ground" else numbers[3 * self.links.index(link) + 2]

    def turning(self, link: str, on: str) -> Any:
        row = np.zeros(self.z.size)
        for name, sign in ((link, 1.0), (on, -1.0)):
            if name != "ground":
                row[3 * self.links.index(name) + 2] += sign
        return row

    def bodies(self, z: Any, v: Any) -> tuple[Any, Any]:
        """Mass matrix, and forces of weight and of the masses' own motion."""
        mass, force = np.zeros((z.size, z.size)), np.zeros(z.size)
        gravity = sum(
            (
                np.array(load.acceleration)
                for load in self.machine.loads
                if type(load) is assur.Gravity
            ),
            np.zeros(2),
        )
        for link, body in self.machine.bodies.items():
            k = self.links.index(link)
            at = body.at
            if at is None or isinstance(at, str):
                joint = self.mechanism.links[link][0] if at is None else at
                centre = next(p for p in self.homes[joint] if p.link == k)
            else:
                centre = Point(k, np.array(at))
            rows = centre.rows(z)
            mass += body.mass * rows.T @ rows
            mass[3 * k + 2, 3 * k + 2] += body.inertia
            force += body.mass * rows.T @ (gravity - centre.centripetal(z, v))
        return mass, force

    def loads(self, t: float, z: Any, v: Any) -> Any:
        total = np.zeros(z.size)
        for load in self.machine.loads:
            if isinstance(load, assur.Force):
                point = self.point(load.at)
                total += point.rows(z).T @ np.array(
                    [self.value(one, t, z, v) for one in load.force]
                )
            elif isinstance(load, assur.Torque):
                total += self.turning(load.link, load.on) * self.value(load.torque, t, z, v)
            elif isinstance(load, assur.Spring | assur.Damper):
                a, b = self.point(load.first), self.point(load.second)
                span, rows = b.now(z) - a.now(z), b.rows(z) - a.rows(z)
                length = np.hypot(*span)
                grows = rows.T @ (span / length)
                if isinstance(load, assur.Spring):
                    total -= grows * (load.stiffness * (length - load.length) + load.preload)
                else:
                    total -= grows * load.damping * (grows @ v)
            elif isinstance(load, assur.TorsionSpring):
                apart = self.angle(load.link, z) - self.angle(load.on, z) - load.angle
                row = self.turning(load.link, load.on)
                total -= row * (load.stiffness * apart + load.preload)
            elif isinstance(load, assur.TorsionDamper):
                row = self.turning(load.link, load.on)
                total -= row * load.damping * (row @ v)
            elif not isinstance(load, assur.Gravity):
                raise TypeError(type(load).__name__)
        return total

    def value(self, value: Any, t: float, z: Any, v: Any) -> float:
        if not callable(value):
            return float(value)
        driver = self.links.index(str(self.mechanism.driver))
        return float(value(t, z[3 * driver + 2], v[3 * driver + 2]))

    def accelerations(
        self, t: float, z: Any, v: Any, drive: Callable[[float], tuple[float, float]] | None
    ) -> Any:
        mass, force = self.bodies(z, v)
        force += self.loads(t, z, v)
        if drive is not None:
            # A motor on the one driver: its torque and its rotor's inertia on it.
            k = 3 * self.links.index(str(self.mechanism.driver)) + 2
            torque, inertia = drive(float(v[k]))
            force[k] += torque
            mass[k, k] += inertia
        rows, right = self.constraints(z, v)
        none = np.zeros((len(rows), len(rows)))
        whole = np.block([[mass, rows.T], [rows, none]])
        return np.linalg.solve(whole, np.concatenate([force, right]))[: z.size]

    def coordinate(self, driver: str) -> Any:
        """Derivative of a driver's coordinate: a link's angle, or a slide on the frame.

        A slide without an origin is 0 in the drawing.
        """
        if driver not in self.mechanism.slides:
            return self.turning(driver, "ground")
        slide = self.mechanism.slides[driver]
        assert (slide.on, slide.origin) == ("ground", None)
        k = 3 * self.links.index(slide.link)
        row = np.zeros(self.z.size)
        row[k : k + 2] = np.cos(slide.angle), np.sin(slide.angle)
        return row

    def start(self, speeds: dict[str, float]) -> Any:
        """Velocities of all links at which drivers have theirs."""
        rows, _ = self.constraints(self.z, np.zeros_like(self.z))
        own = np.array([self.coordinate(name) for name in speeds])
        whole = np.vstack([rows, own])
        right = np.concatenate([np.zeros(len(rows)), list(speeds.values())])
        found, *_ = np.linalg.lstsq(whole, right, rcond=None)
        return found

    def run(
        self,
        times: Any,
        speeds: dict[str, float],
        drive: Callable[[float], tuple[float, float]] | None = None,
    ) -> tuple[Any, Any]:
        """Coordinates of the drivers and their speeds at times, (N, drivers)."""
        n = self.z.size

        def rates(t: float, y: Any) -> Any:
            return np.concatenate([y[n:], self.accelerations(t, y[:n], y[n:], drive)])

        start = np.concatenate([self.z, self.start(speeds)])
        scale = np.concatenate([np.full(n, 1.0), np.full(n, np.abs(start[n:]).max() + 1.0)])
        span = (0.0, float(times[-1]))
        made: Any = solve_ivp(
            rates, span, start, "DOP853", t_eval=times, rtol=TIGHT, atol=TIGHT * scale
        )
        assert made.success, made.message
        own = np.array([self.coordinate(name) for name in speeds])
        slides = np.array([name in self.mechanism.slides for name in speeds])
        drawn = np.where(slides, own @ self.z, 0.0)
        return made.y[:n].T @ own.T - drawn, made.y[n:].T @ own.T
