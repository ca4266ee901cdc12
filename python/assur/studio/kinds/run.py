"""``run``: a motion over time: at constant speed, by input laws, or under motor and loads."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur.dynamics.motion.run import State
from assur.pictures.page.turn_in_time import course_of_run, turn_over_time
from assur.studio import document
from assur.studio.kinds.applied import applied_forces
from assur.studio.kinds.forces import forces_of
from assur.studio.kinds.turn import played_answer
from assur.studio.kinds.words import law
from assur.studio.request import Fields
from assur.studio.session import Answer

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.dynamics.machine import Machine
    from assur.kinematics.mechanism import Mechanism
    from assur.studio.session import Session

ROWS = 361
MODES = ("speed", "law", "machine")
RTOL = 1e-8
KNOWN = ("document", "by", "q0", "speed", "t_end", "q_end", "law", "rows", "paths", "diagrams")


def run(data: dict[str, Any], session: Session) -> Answer:
    """Return the motion to play, with t, q, speed and acceleration of the driver at its rows."""
    fields = Fields(data, (*KNOWN, "reactions"), ("document", "by"))
    by = fields.word("by", MODES)
    wants_forces = fields.flag("reactions")
    machine: Machine | None = None
    if by == "machine" or wants_forces:
        machine = document.read_machine(fields["document"])
    if machine is None or machine.mechanism is None:
        mechanism = document.read_mechanism(fields["document"])
    else:
        mechanism = machine.mechanism
    header: dict[str, Any] = {"by": by, "end": "reached", "message": "", "events": []}
    arrays: dict[str, Float] = {}
    if by == "machine":
        assert machine is not None
        course = _integrated(machine, mechanism, fields, session, header, arrays)
    elif by == "law":
        course = _by_laws(mechanism, fields)
    else:
        course = _at_speed(mechanism, fields)
    t, q, speed, acceleration = course
    played = played_answer(turn_over_time(mechanism, *course), fields, 3, 1.0)
    arrays |= {"t": t, "q": q, "speed": speed, "acceleration": acceleration}
    if wants_forces:
        assert machine is not None
        session.deadline.check()
        # The sense of a run is known where its speed is 0.
        if by == "machine":
            state = State(t, q, speed, acceleration)
            solved = machine.reactions(state, on_error="nan")
        else:
            solved = machine.reactions(q, speed, acceleration, t=t, on_error="nan")
        named, forces = forces_of(mechanism, solved)
        applied, forces["applied"] = applied_forces(machine, solved)
        header["reactions"] = {**named, "applied": applied}
        arrays |= forces
    return Answer({**header, **played.header}, {**played.arrays, **arrays})


def _at_speed(mechanism: Mechanism, fields: Fields) -> tuple[Float, Float, Float, Float]:
    q0 = np.asarray(fields.drivers("q0", mechanism))
    speed = np.asarray(fields.drivers("speed", mechanism, 1.0))
    t = _times(fields)
    at = t if not speed.ndim else t[:, None]
    rates = np.broadcast_to(speed, (len(t), *speed.shape))
    return t, q0 + speed * at, rates, np.zeros_like(rates)


def _by_laws(mechanism: Mechanism, fields: Fields) -> tuple[Float, Float, Float, Float]:
    node = fields.node("law")
    laws: Any
    if mechanism.driver_count > 1:
        laws = [
            entry.number() if isinstance(entry.value, int | float) else law(entry)
            for entry in node.entries()
        ]
    else:
        laws = law(node)
    spans = [
        each_law.span
        for each_law in np.atleast_1d(np.array(laws, dtype=object))
        if hasattr(each_law, "span")
    ]
    t = _times(fields, *(max(spans, key=lambda span: span[1]) if spans else (0.0, 1.0)))
    with node.refusing():
        timed = mechanism.follow(laws, t, on_error="nan")
    return t, timed.q, timed.speed, timed.acceleration


def _times(fields: Fields, start: float = 0.0, end: float | None = None) -> Float:
    end = fields.number("t_end", end)
    if not end > start:
        raise fields.error("t_end", f"is {end:g} s: it must be after {start:g} s")
    return np.linspace(start, end, fields.rows(ROWS))


def _integrated(
    machine: Machine,
    mechanism: Mechanism,
    fields: Fields,
    session: Session,
    header: dict[str, Any],
    arrays: dict[str, Float],
) -> tuple[Float, Float, Float, Float]:
    """Integrate the equation of motion; say how it ended, and its energies."""
    integrated = machine.run(
        fields.optional("t_end"),
        fields.drivers("q0", mechanism),
        fields.drivers("speed", mechanism, 0.0),
        q_end=fields.optional("q_end"),
        rtol=RTOL,
        max_seconds=session.deadline.left() / 2.0,
    )
    header |= {
        "end": integrated.end,
        "message": integrated.message,
        "events": [
            {"event": str(event.event), "t": event.t, "q": event.q, "speed": event.speed}
            for event in integrated.events
        ],
    }
    energy = integrated.energy
    names = ("kinetic", "potential", "work", "balance")
    arrays |= {"steps": integrated.t, **{name: getattr(energy, name) for name in names}}
    return course_of_run(integrated, fields.rows(ROWS))
