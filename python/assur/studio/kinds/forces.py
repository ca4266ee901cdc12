"""Forces and speeds of a machine: ``reactions``, ``flywheel``, ``steady``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.errors import InputError
from assur.pictures.scene.course import TURN
from assur.studio import document
from assur.studio.kinds.applied import applied_forces
from assur.studio.kinds.turn import reached_turn
from assur.studio.request import Fields
from assur.studio.session import Answer

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.dynamics.forces.reactions import Reactions
    from assur.dynamics.machine import Machine
    from assur.dynamics.motion.steady import SteadyState
    from assur.flywheel.result import Flywheel
    from assur.kinematics.mechanism import Mechanism
    from assur.studio.session import Session

ROWS = 361
MEANS = ("extremes", "period")
MOST_TURNS = 64


def reactions(data: dict[str, Any], session: Session) -> Answer:
    """Return the forces in all pairs over the turn, at the rows of ``turn``, or at one q."""
    del session
    known = ("document", "q", "begin", "speed", "acceleration", "rows", "sense")
    fields = Fields(data, known, ("document",))
    machine = document.read_machine(fields["document"])
    mechanism = _mechanism(machine)
    q = _rows(fields, mechanism)
    speed = fields.drivers("speed", mechanism, 0.0)
    solved = machine.reactions(
        q,
        speed,
        fields.drivers("acceleration", mechanism, 0.0),
        sense=fields.optional("sense"),
        on_error="nan",
    )
    header, arrays = forces_of(mechanism, solved)
    header["applied"], arrays["applied"] = applied_forces(machine, solved)
    return Answer(header, {"q": q, **arrays})


def forces_of(mechanism: Mechanism, solved: Reactions) -> tuple[dict[str, Any], dict[str, Float]]:
    """Return the list of forces, and the forces over the rows."""
    joints = list(_pins(mechanism))
    rows = np.asarray(solved.status).size
    forces = [solved.joint(joint, on=on).reshape(rows, 2) for joint, on, _ in joints]
    slides = [solved.slide(name) for name in mechanism.slides]
    along = [
        np.stack([np.reshape(part, rows) for part in (s.normal, s.moment, s.along)], axis=-1)
        for s in slides
    ]
    header = {
        "joints": [{"joint": joint, "on": on, "from": source} for joint, on, source in joints],
        "slides": [
            {"slide": name, "on": slide.link, "from": slide.on}
            for name, slide in mechanism.slides.items()
        ],
        "undetermined": solved.undetermined,
    }
    arrays = {
        "forces": _stacked(forces, (rows, 0, 2)),
        "slide_forces": _stacked(along, (rows, 0, 3)),
        "drive": np.asarray(solved.driver, dtype=float),
        "shaking_force": np.asarray(solved.shaking_force),
        "shaking_moment": np.asarray(solved.shaking_moment),
        "status": np.asarray(solved.status),
    }
    return header, arrays


def _stacked(parts: list[Float], empty: tuple[int, ...]) -> Float:
    return np.stack(parts, axis=1) if parts else np.zeros(empty)


def _pins(mechanism: Mechanism) -> Any:
    """Yield joints with the link that the force acts on; of two links the other exerts it.

    The force on that one is the opposite.
    """
    for joint in mechanism.joints:
        links = [link for link, on in mechanism.links.items() if joint in on]
        if len(links) == 2:
            # On the moving one.
            on, source = links if links[0] != "ground" else links[::-1]
            yield joint, on, source
        elif len(links) > 2:
            for link in links:
                yield joint, link, None


def _rows(fields: Fields, mechanism: Mechanism) -> Float:
    if "q" in fields or mechanism.driver_count > 1:
        return np.asarray(fields.drivers("q", mechanism))[None]
    begin, rows = fields.drivers("begin", mechanism), fields.rows(ROWS)
    return reached_turn(mechanism, begin, rows).coordinates()


def flywheel(data: dict[str, Any], session: Session) -> Answer:
    """Return the flywheel for a fluctuation, and the speed over the turn with it."""
    del session
    known = ("document", "fluctuation", "mean_speed", "mean", "turns", "rows")
    fields = Fields(data, known, ("document", "fluctuation"))
    machine = document.read_machine(fields["document"])
    turns, rows = fields.whole("turns", 1, 1, MOST_TURNS), fields.rows(ROWS)
    wheel = machine.flywheel(
        fields.number("fluctuation"),
        mean_speed=fields.optional("mean_speed"),
        mean="period" if fields.word("mean", MEANS, "extremes") == "period" else "extremes",
        turns=turns,
    )
    q = np.linspace(0.0, TURN * turns, rows)
    inertia, energy = wheel.energy_mass(points=rows)
    names = ("inertia", "delta", "speed0", "mean_speed", "mean", "motor_moment", "power", "period")
    header = {name: getattr(wheel, name) for name in names}
    header |= _ends(wheel)
    arrays = {
        "q": q,
        "speed": wheel.speed(q),
        "time": wheel.time(q),
        "moment": wheel.reduced_moment(q),
        "reduced_inertia": wheel.reduced_inertia(q),
        "work": wheel.work(q),
        "diagram": np.stack([inertia, energy], axis=-1),
    }
    return Answer(header, {name: np.asarray(array, dtype=float) for name, array in arrays.items()})


def steady(data: dict[str, Any], session: Session) -> Answer:
    """Return the periodic motion under motor and loads."""
    known = ("document", "speed", "turns", "flywheel", "mean", "rows")
    fields = Fields(data, known, ("document",))
    machine = document.read_machine(fields["document"])
    motion = machine.steady_state(
        fields.optional("speed"),
        turns=fields.whole("turns", 1, 1, MOST_TURNS),
        flywheel=fields.number("flywheel", 0.0),
        mean="period" if fields.word("mean", MEANS, "extremes") == "period" else "extremes",
        max_seconds=session.deadline.left(),
    )
    q = np.linspace(motion.q[0], motion.q[-1], fields.rows(ROWS))
    state = motion.at(q)
    names = ("period", "delta", "mean_speed", "multiplier", "motor_work", "power", "motor_moment")
    header = {name: getattr(motion, name) for name in names}
    header |= _ends(motion)
    return Answer(
        header,
        {"q": q, "t": state.t, "speed": state.speed, "acceleration": state.acceleration},
    )


def _ends(of: Flywheel | SteadyState) -> dict[str, dict[str, float]]:
    """Return the greatest and the least speed, and where they are."""
    ends = {"max": of.max, "min": of.min}
    return {name: {"value": float(end.value), "q": float(end.q)} for name, end in ends.items()}


def _mechanism(machine: Machine) -> Mechanism:
    if machine.mechanism is None:
        message = "a machine of a table has no mechanism"
        raise InputError(message)
    return machine.mechanism
