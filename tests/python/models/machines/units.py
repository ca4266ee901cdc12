"""A machine and its motion in other units of length, time and mass."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from models.mechanisms.mechanism_data import arguments, described

if TYPE_CHECKING:
    from assur import Machine, Mechanism, Run
    from models.mechanisms.mechanism_data import Description


@dataclass(frozen=True)
class Units:
    """How many new units one old unit of length, time and mass is."""

    length: float = 1.0
    time: float = 1.0
    mass: float = 1.0

    @property
    def force(self) -> float:
        return self.mass * self.length / self.time / self.time

    @property
    def torque(self) -> float:
        return self.force * self.length

    @property
    def inertia(self) -> float:
        return self.mass * self.length * self.length

    # -- the machine --------------------------------------------------------------------------

    def mechanism(self, d: Description) -> Mechanism:
        joints = {n: (x * self.length, y * self.length) for n, (x, y) in d.joints.items()}
        return assur.Mechanism(**arguments(replace(d, joints=joints)))

    def machine(self, machine: Machine) -> Machine:
        assert machine.mechanism is not None
        description = described(machine.mechanism)
        # A motor of a slide has its gear ratio in rad/m.
        coordinates = self.coordinates(machine.mechanism)
        given = machine.motor
        motors = given if isinstance(given, tuple) else (given,) * len(coordinates)
        own = [self.motor(one, by) for one, by in zip(motors, coordinates, strict=True)]
        return assur.Machine(
            self.mechanism(description),
            bodies={name: self.body(one) for name, one in machine.bodies.items()},
            loads=[self.load(one, machine.mechanism) for one in machine.loads],
            motor=own if any(own) else None,
            friction={name: self.friction(one) for name, one in machine.friction.items()},
        )

    def coordinates(self, m: Mechanism) -> list[float]:
        """The units of all drivers' coordinates."""
        given = m.driver if isinstance(m.driver, tuple) else (m.driver,)
        return [self.length if one in m.slides else 1.0 for one in given]

    def place(self, place: Any) -> Any:
        if place is None or isinstance(place, str):
            return place
        if isinstance(place[0], str):
            return place[0], self.place(place[1])
        return tuple(x * self.length for x in place)

    def body(self, body: assur.Body) -> assur.Body:
        return assur.Body(
            mass=body.mass * self.mass, inertia=body.inertia * self.inertia, at=self.place(body.at)
        )

    def load(self, load: Any, m: Mechanism) -> Any:
        by = getattr(load, "over", None)
        # A table over the driver, or over another slide or link.
        over = self.length if (m.driver if by is None else by) in m.slides else 1.0
        match load:
            case assur.Force():
                x, y = (self.value(one, self.force, over) for one in load.force)
                return replace(load, at=self.place(load.at), force=(x, y))
            case assur.Torque():
                return replace(load, torque=self.value(load.torque, self.torque, over))
            case assur.Pressure():
                return self.pressure(load, over)
        return self.passive(load)

    def passive(self, load: Any) -> Any:
        match load:
            case assur.Gravity():
                x, y = load.acceleration
                by = self.length / self.time / self.time
                return assur.Gravity((x * by, y * by))
            case assur.Spring():
                return assur.Spring(
                    self.place(load.first),
                    self.place(load.second),
                    load.stiffness * self.force / self.length,
                    load.length * self.length,
                    preload=load.preload * self.force,
                )
            case assur.Damper():
                damping = load.damping * self.mass / self.time
                return assur.Damper(self.place(load.first), self.place(load.second), damping)
            case assur.TorsionSpring():
                stiffness, preload = load.stiffness * self.torque, load.preload * self.torque
                return replace(load, stiffness=stiffness, preload=preload)
        return replace(load, damping=load.damping * self.torque * self.time)

    def pressure(self, load: assur.Pressure, over: float) -> assur.Pressure:
        area = self.length * self.length
        unit, own = self.force / area, load.pressure
        if isinstance(own, assur.Gas):
            volume, at = own.volume * area * self.length, own.at * self.length
            own = replace(own, pressure=own.pressure * unit, volume=volume, at=at)
        else:
            own = self.value(own, unit, over)
        ambient = load.ambient * unit
        return replace(load, area=load.area * area, pressure=own, ambient=ambient)

    def value(self, value: Any, unit: float, coordinate: float) -> Any:
        if isinstance(value, assur.Table):
            return replace(value, q=value.q * coordinate, value=value.value * unit)
        if callable(value):
            return lambda t, q, v: (
                value(t / self.time, q / coordinate, v * (self.time / coordinate)) * unit
            )
        return value * unit

    def motor(self, motor: Any, coordinate: float) -> Any:
        if motor is None:
            return None
        ratio, inertia = motor.ratio / coordinate, motor.rotor_inertia * self.inertia
        made = replace(motor, ratio=ratio, rotor_inertia=inertia)
        match motor:
            case assur.Table():
                speeds, torques = motor.q / self.time, motor.value * self.torque
                return replace(made, q=speeds, value=torques)
            case assur.ConstantTorque():
                return replace(made, torque=self.value(motor.torque, self.torque, coordinate))
            case assur.LinearMotor():
                speed = motor.no_load / self.time
                return replace(made, stall=motor.stall * self.torque, no_load=speed)
        speed = motor.synchronous / self.time
        return replace(made, breakdown=motor.breakdown * self.torque, synchronous=speed)

    def friction(self, friction: Any) -> Any:
        if isinstance(friction, assur.JointFriction):
            viscous = friction.viscous * self.torque * self.time
            return replace(friction, radius=friction.radius * self.length, viscous=viscous)
        viscous = friction.viscous * self.mass / self.time
        return replace(friction, length=friction.length * self.length, viscous=viscous)

    # -- its motion ---------------------------------------------------------------------------

    def events(self, events: Any, coordinate: float) -> list[Any]:
        """Events of one driver."""
        made: list[Any] = []
        for one in events:
            match one:
                case assur.events.Position():
                    made.append(replace(one, q=one.q * coordinate))
                case assur.events.Speed():
                    made.append(replace(one, speed=one.speed * coordinate / self.time))
                case assur.events.Obstacle():
                    [at] = self.events([one.at], coordinate)
                    made.append(replace(one, at=at))
                case assur.events.Crossing():
                    made.append(replace(one, function=self.value(one.function, 1.0, coordinate)))
                case _:
                    made.append(one)
        return made

    def run(self, machine: Machine, q0: Any, speed0: Any, **options: Any) -> Run:
        """The run of a machine of the old units in the new ones."""
        assert machine.mechanism is not None
        by = np.array(self.coordinates(machine.mechanism))
        by = by if by.size > 1 else by[0]
        own = dict(options)
        along = by if "q_end" in own else self.time
        for name in ("t_end", "q_end", "max_step"):
            if name in own:
                own[name] = own[name] * along
        if "breaks" in own:
            own["breaks"] = np.asarray(own["breaks"]) * along
        if "events" in own:
            own["events"] = self.events(own["events"], float(np.ravel(by)[0]))
        made = self.machine(machine)
        run: Run = made.run(q0=q0 * by, speed0=np.asarray(speed0) * by / self.time, **own)
        return run

    def numbers(self, run: Run) -> dict[str, Any]:
        """Every number of a run in the new units, in the old ones."""
        by = np.ones(1) if run.mechanism is None else np.array(self.coordinates(run.mechanism))
        by = by if by.size > 1 else by[0]
        energy = run.energy
        along = by if run.along_q else self.time
        steps = (run.statistics.smallest_step, run.statistics.largest_step)
        return {
            "t": run.t / self.time,
            "q": run.q / by,
            "speed": run.speed / by * self.time,
            "acceleration": run.acceleration / by * self.time * self.time,
            **{name: one / self.torque for name, one in energy._asdict().items()},
            "events": [
                x
                for one in run.events
                for x in np.hstack([one.t / self.time, one.q / by, one.speed / by * self.time])
            ],
            "statistics": run.statistics[:4],
            "steps": [None if one is None else one / along for one in steps],
            "end": run.end,
        }


def differences(one: dict[str, Any], other: dict[str, Any]) -> list[str]:
    """The numbers that differ in any bit."""
    different = []
    for name, own in one.items():
        if name in ("statistics", "steps", "end"):
            if own != other[name]:
                different.append(f"{name}: {own} {other[name]}")
        elif len(own) != len(other[name]) or not np.array_equal(own, other[name], equal_nan=True):
            different.append(name)
    return different
