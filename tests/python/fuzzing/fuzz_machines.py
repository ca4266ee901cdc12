"""Machines, runs and flywheels with any arguments."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from assur import balance, events, flywheel
from fuzzing.fuzz_kinematics import mechanisms

if TYPE_CHECKING:
    from collections.abc import Callable

    from fuzzing.fuzz_values import Choices

SPLINES = ("not-a-knot", "natural", "periodic")
# A run takes no longer than this, whatever the loads are.
MOST_STEPS = 300
MOST_SECONDS = 1.0


def _against(t: float, q: float | tuple[float, ...], speed: float | tuple[float, ...]) -> float:
    return float(-np.sum(speed) - 0.1 * np.sum(q) + 0.01 * t)


def table(c: Choices, **over: Any) -> Any:
    count = 2 + c.byte() % 8
    even = np.linspace(0.0, 2.0 * np.pi, count)
    q = even if c.byte() % 2 else np.cumsum([c.positive() for _ in range(count)])
    if c.byte() % 4 == 0:
        q = np.sort(np.append(q, q[c.byte() % count]))
        count += 1
    values = np.array([c.number() for _ in range(count)])
    values[-1] = values[0]
    return c.call(
        assur.Table,
        q=lambda: q,
        value=lambda: values,
        spline=lambda: c.among(SPLINES),
        periodic=lambda: bool(c.byte() % 2),
        ratio=c.number,
        rotor_inertia=c.positive,
        **over,
    )


def _load(c: Choices, m: assur.Mechanism) -> Any:
    def link() -> Any:
        return c.among(list(m.links))

    def place() -> Any:
        return c.either(lambda: c.among(list(m.joints)), lambda: (link(), (c.number(), c.number())))

    def value() -> Any:
        return c.either(
            c.number, lambda: table(c), lambda: table(c, over=followed), lambda: _against
        )

    def force() -> Any:
        return c.argument(value), value()

    def way() -> Any:
        return c.among(("forward", "backward"))

    def followed() -> Any:
        return c.among([*m.slides, *m.links])

    def gas() -> Any:
        return c.call(
            assur.Gas, pressure=c.positive, volume=c.positive, at=c.number, exponent=c.positive
        )

    return c.either(
        lambda: c.call(assur.Gravity, acceleration=lambda: (0.0, c.argument(c.number))),
        lambda: c.call(assur.Force, at=place, force=force, axes=link, while_=way, over=followed),
        lambda: c.call(assur.Torque, link=link, torque=value, on=link, while_=way, over=followed),
        lambda: c.call(
            assur.Pressure,
            slide=followed,
            area=c.positive,
            pressure=lambda: c.either(value, gas),
            expands=way,
            ambient=c.positive,
            while_=way,
        ),
        lambda: c.call(
            assur.Spring, first=place, second=place, stiffness=c.positive, length=c.positive
        ),
        lambda: c.call(assur.Damper, first=place, second=place, damping=c.positive),
        lambda: c.call(assur.TorsionSpring, link=link, stiffness=c.positive, angle=c.number),
        c.odd,
    )


def _machine(c: Choices) -> Any:
    m = c.among(mechanisms())

    def at() -> Any:
        return c.among((None, c.among(list(m.joints)), (c.number(), c.number())))

    def body() -> Any:
        return c.call(assur.Body, mass=c.positive, inertia=c.positive, at=at)

    return c.call(
        assur.Machine,
        mechanism=lambda: m,
        bodies=lambda: {link: body() for link in m.links if link != "ground"},
        loads=lambda: [_load(c, m) for _ in range(c.byte() % 3)],
        motor=lambda: c.either(
            lambda: c.call(assur.ConstantTorque, torque=c.number),
            lambda: c.call(assur.LinearMotor, stall=c.positive, no_load=c.positive),
            lambda: table(c),
        ),
    )


def reduce(c: Choices) -> object:
    machine = _machine(c)
    return c.either(
        lambda: c.call(machine.reduced_inertia, q=c.numbers, on_error=lambda: "nan"),
        lambda: c.call(machine.reduced_moment, q=c.numbers, speed=c.numbers),
        lambda: c.call(machine.potential, q=c.numbers),
        lambda: c.call(machine.equilibria, between=lambda: (c.number(), c.number())),
        lambda: c.call(
            machine.duty, q=c.numbers, speed=c.numbers, acceleration=c.numbers, t=c.numbers
        ),
        lambda: c.call(machine.flywheel, fluctuation=lambda: 0.1, mean_speed=c.positive),
        lambda: machine.design(c.argument(c.small)),
    )


def balanced(c: Choices) -> object:
    machine = _machine(c)
    links = list(machine.mechanism.links) if machine.mechanism else ["crank"]

    def bounds() -> Any:
        return c.call(balance.MomentBounds, x=lambda: (-c.positive(), c.number()))

    def places() -> Any:
        def point() -> tuple[float, float]:
            return c.number(), c.number()

        return {c.among(links): c.either(point, bounds, lambda: [point(), point()], c.odd)}

    weights = c.either(
        lambda: c.call(
            balance.fit,
            machine=lambda: machine,
            q=c.numbers,
            places=places,
            speed=c.number,
            most=c.positive,
            moment_weight=c.positive,
        ),
        lambda: balance.four_bar(machine),
        lambda: c.call(
            balance.slider_crank,
            machine=lambda: machine,
            fraction=c.positive,
            rod_radius=c.positive,
        ),
        lambda: [c.call(balance.Counterweight, link=lambda: c.among(links), moment=c.positive)],
    )
    radius = c.argument(c.positive)
    return machine.with_counterweights([one.with_radius(radius) for one in weights])


def harmonics(c: Choices) -> object:
    count = 1 + c.byte() % 20
    q = c.number() + np.arange(count) * (2.0 * np.pi / count)
    values = np.array([c.number() for _ in range(count)])
    found = c.call(balance.harmonics, q=lambda: q, values=lambda: values, count=c.small)
    return found.phase, c.call(
        balance.rotating_parts, q=lambda: q, force=lambda: np.stack([values, values], -1)
    )


def inside(c: Choices) -> object:
    machine = _machine(c)
    links = list(machine.mechanism.links) if machine.mechanism else ["crank"]
    joints = list(machine.mechanism.joints) if machine.mechanism else ["A"]
    motion: dict[str, Any] = {"q": c.numbers, "speed": c.number, "acceleration": c.number}

    def rods() -> object:
        found = c.call(
            machine.internal_loads,
            link=lambda: c.among(links),
            **motion,
            along=lambda: c.among((None, (c.among(joints), c.among(joints)))),
            n=lambda: 3,
            on_error=lambda: c.among(("raise", "nan")),
        )
        return found.peak(c.among(("axial", "shear", "moment")))

    def pins() -> object:
        found = c.call(machine.reactions, **motion, on_error=lambda: "nan")
        pin = c.call(found.bearing, name=lambda: c.among(joints), on=lambda: c.among(links))
        return pin.max, pin.mean, c.call(pin.pv, diameter=c.positive, width=c.positive)

    return c.either(rods, pins)


def run(c: Choices) -> object:
    machine = _machine(c)

    def event() -> Any:
        return c.either(
            lambda: c.call(events.Rest, stop=lambda: True),
            lambda: c.call(events.Speed, speed=c.number),
            lambda: c.call(events.Position, q=c.number, driver=c.small),
        )

    result = c.call(
        machine.run,
        t_end=lambda: 0.2,
        q0=c.number,
        speed0=c.number,
        q_end=c.number,
        t0=lambda: 0.0,
        rtol=lambda: 1e-6,
        atol=lambda: 1e-6,
        method=lambda: c.among(("DOP853", "RK45")),
        events=lambda: [event()],
        breaks=c.numbers,
        max_step=c.positive,
        max_steps=MOST_STEPS,
        max_seconds=MOST_SECONDS,
    )
    return result.at(c.argument(lambda: 0.1)), result.energy


def runs(c: Choices) -> object:
    machine = _machine(c)
    result = c.call(
        machine.run,
        t_end=lambda: 0.2,
        q0=c.numbers,
        speed0=c.number,
        rtol=lambda: 1e-6,
        max_steps=MOST_STEPS,
        max_seconds=MOST_SECONDS,
        keep=lambda: c.among(("all", "ends")),
        on_error=lambda: c.among(("raise", "nan")),
        threads=lambda: 2,
    )
    if not isinstance(result, assur.Runs) or not len(result):
        return result
    return result.at(c.argument(lambda: 0.1)), result.explain(0), result[0].energy


def steady(c: Choices) -> object:
    found = c.call(
        _machine(c).steady_state,
        speed=c.positive,
        turns=c.small,
        q0=c.number,
        mean=lambda: c.among(("extremes", "period")),
        flywheel=c.positive,
        breaks=c.numbers,
        max_steps=MOST_STEPS,
        max_seconds=MOST_SECONDS,
    )
    return found.at(c.argument(c.numbers))


def wheel(c: Choices) -> object:
    count = 3 + c.byte() % 20
    named: dict[str, Callable[[], Any]] = {
        "phi": lambda: np.linspace(0.0, 2.0 * np.pi, count),
        "moment": lambda: np.array([c.number() for _ in range(count)]),
        "inertia": lambda: np.array([c.positive() for _ in range(count)]),
        "mean_speed": c.positive,
        "mean": lambda: c.among(("extremes", "period")),
        "spline": lambda: c.among(SPLINES),
        "on_error": lambda: "nan",
        "threads": lambda: 1,
    }
    made = c.either(
        lambda: c.call(flywheel.from_table, fluctuation=lambda: 0.125, **named),
        lambda: c.call(flywheel.evaluate, flywheel=c.positive, speed0=c.positive, **named),
    )
    return made.inertia, made.delta, made.speed(c.argument(c.numbers)), made.time(c.number())
