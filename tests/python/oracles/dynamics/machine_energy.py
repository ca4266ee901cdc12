"""Energy, power and generalised forces of machines, written from the definitions.

Nothing of the library's reductions: places of joints and angles of links with their first
derivatives, and from these kinetic energy, potentials and powers one load after another.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from scipy.interpolate import CubicSpline, PchipInterpolator

import assur
from models.mechanisms.mechanism_data import GROUND

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from numpy.typing import NDArray

    from assur import Machine


# A force (N,) and the rates (N, n) of what it acts on; whether these are an angle's.
Acting: TypeAlias = "tuple[Any, Any, bool]"


class Moving:
    """A complex quantity (or an angle) and its derivatives by the drivers, a row a position."""

    def __init__(self, value: Any, rates: Any) -> None:
        self.value, self.rates = value, rates  # (N,), (N, n)

    def __sub__(self, other: Moving) -> Moving:
        return Moving(self.value - other.value, self.rates - other.rates)


class Balance:
    """A machine at positions (N, n) with speeds (N, n) at times (N,)."""

    def __init__(self, machine: Machine, t: Any, q: Any, speed: Any) -> None:
        m = machine.mechanism
        assert m is not None
        self.machine, self.mechanism = machine, m
        self.t = np.asarray(t, np.float64)
        self.count = self.t.size
        self.q = np.asarray(q, np.float64).reshape(self.count, -1)
        self.speed = np.asarray(speed, np.float64).reshape(self.count, -1)
        self.drivers = self.q.shape[1]
        self.motion = m.solve(self.q if self.drivers > 1 else self.q[:, 0], order=1, on_error="nan")

    # -- places and angles --------------------------------------------------------------------

    def joint(self, name: str) -> Moving:
        track = self.motion.joint(name)
        rates = track.d1.reshape(self.count, 2, self.drivers)
        return Moving(track.value @ [1, 1j], rates[:, 0] + 1j * rates[:, 1])

    def angle(self, link: str) -> Moving:
        if link == GROUND:
            return Moving(np.zeros(self.count), np.zeros((self.count, self.drivers)))
        track = self.motion.link(link)
        return Moving(track.value, track.d1.reshape(self.count, self.drivers))

    def frame(self, link: str) -> Moving:
        """The x axis of a link: along its first two joints, otherwise by its angle."""
        own = self.mechanism.links[link]
        if link == GROUND or len(own) < 2:
            angle = self.angle(link)
            along = np.exp(1j * angle.value)
            return Moving(along, 1j * along[:, np.newaxis] * angle.rates)
        side = self.joint(own[1]) - self.joint(own[0])
        length = np.abs(side.value)
        with np.errstate(invalid="ignore"):  # NaN where there is no position
            along = side.value / length
        turned = np.imag(np.conj(along)[:, np.newaxis] * side.rates) / length[:, np.newaxis]
        return Moving(along, 1j * along[:, np.newaxis] * turned)

    def place(self, at: Any) -> Moving:
        """A joint, or a point in a link's frame; the ground's frame is the drawing's."""
        if isinstance(at, str):
            return self.joint(at)
        link, (x, y) = at
        frame, local = self.frame(link), complex(x, y)
        if link == GROUND:
            return Moving(frame.value * local, frame.rates * local)
        origin = self.joint(self.mechanism.links[link][0])
        return Moving(origin.value + frame.value * local, origin.rates + frame.rates * local)

    def centre(self, link: str, body: assur.Body) -> Moving:
        own = self.mechanism.links[link]
        if body.at is None or isinstance(body.at, str):
            return self.joint(own[0] if body.at is None else body.at)
        return self.place((link, body.at))

    def along(self, first: Any, second: Any) -> Moving:
        """The distance between two points."""
        span = self.place(second) - self.place(first)
        length = np.abs(span.value)
        with np.errstate(invalid="ignore"):
            unit = np.conj(span.value / length)[:, np.newaxis]
        return Moving(length, np.real(unit * span.rates))

    def relative(self, load: Any) -> Moving:
        return self.angle(load.link) - self.angle(load.on)

    def velocity(self, what: Moving) -> Any:
        return (what.rates * self.speed).sum(axis=1)

    # -- values -------------------------------------------------------------------------------

    def number(self, value: Any) -> Any:
        if isinstance(value, assur.Table):
            return spline(value, value.periodic)(self.q[:, 0])
        if not callable(value):
            return np.full(self.count, float(value))
        rows = zip(self.t.tolist(), self.q.tolist(), self.speed.tolist(), strict=True)
        one = self.drivers == 1
        return np.array([value(t, a[0], b[0]) if one else value(t, a, b) for t, a, b in rows])

    # -- energies -----------------------------------------------------------------------------

    def kinetic(self) -> NDArray[np.float64]:
        total = np.zeros(self.count)
        for link, body in self.machine.bodies.items():
            total += 0.5 * body.inertia * self.velocity(self.angle(link)) ** 2
            if body.mass:
                total += 0.5 * body.mass * np.abs(self.velocity(self.centre(link, body))) ** 2
        for k, motor in self.motors():
            total += 0.5 * motor.rotor_inertia * (motor.ratio * self.speed[:, k]) ** 2
        return total

    def potentials(self) -> NDArray[np.float64]:
        """Of every weight and spring, (parts, N)."""
        parts = [np.zeros(self.count)]
        for load in self.machine.loads:
            if isinstance(load, assur.Gravity):
                pull = complex(*load.acceleration)
                for link, body in self.machine.bodies.items():
                    if body.mass:
                        high = np.real(np.conj(pull) * self.centre(link, body).value)
                        parts.append(-body.mass * high)
            elif isinstance(load, assur.Spring):
                longer = self.along(load.first, load.second).value - load.length
                parts.append((0.5 * load.stiffness * longer + load.preload) * longer)
            elif isinstance(load, assur.TorsionSpring):
                apart = self.relative(load).value - load.angle
                parts.append((0.5 * load.stiffness * apart + load.preload) * apart)
        return np.array(parts)

    # -- generalised forces -------------------------------------------------------------------

    def conservative(self) -> NDArray[np.float64]:
        """Generalised forces of weights and springs on the drivers, (parts, N, n)."""
        return self.to_drivers(self.stored())

    def applied(self) -> NDArray[np.float64]:
        """Generalised forces of all other loads on the drivers, (parts, N, n)."""
        return self.to_drivers(self.other())

    def to_drivers(self, acting: Iterable[Acting]) -> NDArray[np.float64]:
        parts = [np.zeros((self.count, self.drivers))]
        for force, rates, _ in acting:
            parts.append(np.real(np.conj(force)[:, np.newaxis] * rates))
        return np.array(parts)

    def strength(self) -> NDArray[np.float64]:
        """What all forces would do on an arm of the mechanism's size, and all torques, (N,)."""
        places = np.array(list(self.motion.mechanism.joints.values()))
        size = float(np.ptp(places, axis=0).max())
        total = np.zeros(self.count)
        for force, _, turns in (*self.stored(), *self.other()):
            total += np.abs(force) * (1.0 if turns else size)
        return total

    def stored(self) -> Iterator[Acting]:
        """Weights and springs."""
        for load in self.machine.loads:
            if isinstance(load, assur.Gravity):
                pull = np.full(self.count, complex(*load.acceleration))
                for link, body in self.machine.bodies.items():
                    if body.mass:
                        yield body.mass * pull, self.centre(link, body).rates, False
            elif isinstance(load, assur.Spring):
                distance = self.along(load.first, load.second)
                tension = load.stiffness * (distance.value - load.length) + load.preload
                yield -tension, distance.rates, False
            elif isinstance(load, assur.TorsionSpring):
                angle = self.relative(load)
                back = load.stiffness * (angle.value - load.angle) + load.preload
                yield -back, angle.rates, True

    def other(self) -> Iterator[Acting]:
        """Loads that have no potential."""
        for load in self.machine.loads:
            if isinstance(load, assur.Force):
                force = self.number(load.force[0]) + 1j * self.number(load.force[1])
                if load.axes is not None:
                    force = force * self.frame(load.axes).value
                yield force, self.place(load.at).rates, False
            elif isinstance(load, assur.Torque):
                yield self.number(load.torque), self.relative(load).rates, True
            elif isinstance(load, assur.Damper):
                what = self.along(load.first, load.second)
                yield -load.damping * self.velocity(what), what.rates, False
            elif isinstance(load, assur.TorsionDamper):
                what = self.relative(load)
                yield -load.damping * self.velocity(what), what.rates, True
            elif not isinstance(load, assur.Gravity | assur.Spring | assur.TorsionSpring):
                message = f"the oracle does not know the load {load}"
                raise TypeError(message)

    def motors(self) -> list[tuple[int, Any]]:
        motor = self.machine.motor
        many = motor if isinstance(motor, list | tuple) else [motor]
        return [(k, one) for k, one in enumerate(many) if one is not None]

    def motor_powers(self) -> NDArray[np.float64]:
        parts = [np.zeros(self.count)]
        for k, motor in self.motors():
            own = motor.ratio * self.speed[:, k]
            if isinstance(motor, assur.ConstantTorque):
                torque = self.number(motor.torque)
            elif isinstance(motor, assur.LinearMotor):
                torque = motor.stall * (1.0 - own / motor.no_load)
            elif isinstance(motor, assur.InductionMotor):
                slip = 1.0 - own / motor.synchronous
                torque = 2.0 * motor.breakdown / (slip / motor.slip + motor.slip / slip)
            else:
                torque = spline(motor, False)(own)
            parts.append(torque * own)
        return np.array(parts)

    def powers(self) -> NDArray[np.float64]:
        """Of every load that has no potential, and every motor, (parts, N)."""
        loads = (self.applied() * self.speed).sum(axis=2)
        return np.concatenate([loads, self.motor_powers()])


def spline(table: assur.Table, periodic: bool) -> Callable[[Any], Any]:
    """SciPy's curves, or straight pieces; a periodic table goes on in either direction."""
    knots, values = np.asarray(table.q, np.float64), np.asarray(table.value, np.float64)
    period = knots[-1] - knots[0]

    def within(x: Any) -> Any:
        return knots[0] + np.mod(x - knots[0], period) if periodic else x

    if table.spline == "linear":
        return lambda x: np.interp(within(x), knots, values)
    kind: Any = table.spline
    if kind == "pchip":
        # The slopes at the ends of a period are those of three periods one after another.
        turns = (-1, 0, 1) if periodic else (0,)
        starts = [knots[: len(knots) - periodic] + k * period for k in turns]
        rows = np.tile(values[: len(values) - periodic], len(turns))
        curve: Any = PchipInterpolator(np.concatenate(starts), rows)
    else:
        curve = CubicSpline(knots, values, bc_type=kind)
    return lambda x: curve(within(x))
