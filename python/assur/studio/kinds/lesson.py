"""``lesson``: the crank-rocker with friction of Manzhosov and Petrova, and its change of structure.

Angles are the paper's: φ1 = 0 where the crank's pin is farthest from the support D, which is at
(−l4, 0) of A. What locks when γ falls to γ_min is an assumption: see `assur.crank_rocker.run`.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import fields as fields_of
from typing import TYPE_CHECKING, Any

import numpy as np

from assur.errors import AssurError
from assur.laws import Tabulated
from assur.papers import crank_rocker
from assur.pictures.scene.course import TURN
from assur.studio.kinds import lesson_motion
from assur.studio.kinds.lesson_motion import Lengths
from assur.studio.limits import MOST_ROWS
from assur.studio.request import Fields
from assur.studio.session import Answer

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt

    from assur._arrays import Float
    from assur.files.node import Node
    from assur.studio.session import Session

ROWS = 361
LENGTHS = ("l1", "l2", "l3", "l4")
MOVING = ("phi1", "speed", "ground_speed", "turns", "support")
FRICTION = ("f_c", "r_c", "f_d", "r_d")
# The three sums of lengths, with the names that a message gives them.
CONDITIONS = (
    ("l1 + l4", "l2 + l3"),
    ("l1 + l2", "l3 + l4"),
    ("l1 + l3", "l2 + l4"),
)
MOST_TURNS, MOST_GROUNDS = 20, 12


def lesson(data: dict[str, Any], session: Session) -> Answer:
    """Return what the lengths allow, the figures at φ1, the whole turn, and the run."""
    known = (*LENGTHS, *MOVING, "gamma_min", "friction", "rows", "run", "motion", "grounds")
    fields = Fields(data, known, LENGTHS)
    lengths = Lengths(*(fields.number(name) for name in LENGTHS))
    l1, l2, l3, l4 = lengths
    least = _least_angle(fields, l3)
    phi1, speed = fields.number("phi1", np.pi / 2.0), fields.number("speed", 1.0)
    ground_speed = fields.number("ground_speed", 0.0)
    header = _conditions(lengths, least)
    instant = crank_rocker.solve(phi1, l1, l2, l3, l4, speed=speed, ground_speed=ground_speed)
    names = [field.name for field in fields_of(instant)]
    header["instant"] = {"phi1": phi1, **{name: getattr(instant, name) for name in names}}
    turn = np.linspace(0.0, TURN, fields.rows(ROWS))
    over = crank_rocker.solve(turn, l1, l2, l3, l4, speed=speed)
    shown = ("phi2", "phi3", "gamma23", "gamma", "dphi2", "dphi3", "dgamma23", "v_B", "v_C")
    arrays = {"phi1": turn, **{name: getattr(over, name) for name in shown}}
    if "grounds" in fields:
        grounds = _grounds(fields)
        arrays["gamma_of"] = crank_rocker.solve(turn, l1, l2, l3, grounds[:, np.newaxis]).gamma
    if fields.flag("motion"):
        session.deadline.check()
        held = _needed(fields, least, "a motion")
        stretches = lesson_motion.stretches(lengths, held)
        header["stretches"] = [stretch._asdict() for stretch in stretches]
        header["position"] = lesson_motion.position(lengths, stretches, phi1, speed, ground_speed)
        arrays |= lesson_motion.tables(lengths, stretches, len(turn))
    if fields.flag("run"):
        session.deadline.check()
        header["run"], moved = _run(fields, lengths, least, phi1, speed)
        arrays |= moved
    return Answer(header, arrays)


def _least_angle(fields: Fields, rocker: float) -> float | None:
    """Return γ_min as given, or by the friction at C and D."""
    if "friction" not in fields:
        return fields.optional("gamma_min")
    node = fields.node("friction")
    entries = node.keys(FRICTION, FRICTION)
    f_c, r_c, f_d, r_d = (entries[key].number() for key in FRICTION)
    with node.refusing():
        return float(crank_rocker.least_transmission_angle(f_c, r_c, f_d, r_d, rocker))


def _needed(fields: Fields, least: float | None, what: str) -> float:
    """Return γ_min, which a motion with changes of structure needs."""
    if least is None:
        raise fields.error("gamma_min", f"is missing: {what} needs it, or friction")
    if least <= 0.0:
        raise fields.error("gamma_min", f"is {least:g}: {what} needs an angle above 0")
    return least


def _grounds(fields: Fields) -> Float:
    """Return other grounds to compare with."""
    node = fields.node("grounds")
    grounds = node.array()
    if grounds.ndim != 1 or not 0 < len(grounds) <= MOST_GROUNDS:
        raise node.error(f"a list of 1 to {MOST_GROUNDS} lengths is needed")
    return grounds


def _conditions(lengths: tuple[float, float, float, float], least: float | None) -> dict[str, Any]:
    """Return Grashof's type, each inequality with its sums, and where friction blocks."""
    turns, margins = crank_rocker.crank_turns(*lengths)
    named = dict(zip(LENGTHS, lengths, strict=True))
    l1, l2, l3, l4 = lengths
    failed = [
        condition for condition, margin in zip(CONDITIONS, margins, strict=True) if margin <= 0.0
    ]
    header: dict[str, Any] = {
        "type": crank_rocker.grashof(*lengths),
        "turns": turns,
        "conditions": [
            {
                "less": less,
                "greater": greater,
                "sums": [sum(named[n] for n in side.split(" + ")) for side in (less, greater)],
                "holds": bool(margin > 0.0),
            }
            for (less, greater), margin in zip(CONDITIONS, margins, strict=True)
        ],
        "message": "",
        "gamma_min": least,
        "gamma": None,
        "blocked": [],
        "ground_range": None,
        "turning_range": None,
    }
    if not turns and failed:
        sums = [f"{side} ({sum(named[n] for n in side.split(' + ')):.4g})" for side in failed[0]]
        header["message"] = f"The crank cannot turn: {sums[0]} must be less than {sums[1]}."
    if turns:
        header["gamma"] = crank_rocker.transmission_extremes(*lengths)
    # Also for a crank that does not turn: there D must slide so that it goes on.
    if least is not None:
        header["blocked"] = crank_rocker.blocked(l1, l2, l3, l4, least)
    if turns and header["blocked"]:
        header["message"] = f"C jams below γmin = {least:.4g} rad."
    for name, angle in (("ground_range", least or 0.0), ("turning_range", 0.0)):
        # Perhaps no ground fits these two.
        with suppress(AssurError):
            ends = crank_rocker.ground_range(l2 / l1, l3 / l1, margin=0.0, gamma_min=angle)
            header[name] = [end * l1 for end in ends]
    return header


def _run(
    fields: Fields,
    lengths: tuple[float, float, float, float],
    least: float | None,
    phi1: float,
    speed: float,
) -> tuple[dict[str, Any], dict[str, Float]]:
    """Return the run from φ1, with the changes of structure."""
    least = _needed(fields, least, "a run")
    turns = fields.number("turns", 1.0)
    if not 0.0 < turns <= MOST_TURNS:
        raise fields.error("turns", f"is {turns:g}: above 0, up to {MOST_TURNS} is needed")
    l1, l2, l3, l4 = lengths
    ground: float | Callable[[float], float] = l4
    if "support" in fields:
        ground = _support(fields.node("support"))
    jammed = crank_rocker.run(
        l1, l2, l3, ground, gamma_min=least, speed=speed, phi0=phi1, turns=turns
    )
    events = [
        {field.name: getattr(event, field.name) for field in fields_of(event)}
        for event in jammed.events
    ]
    rows = _thinned(len(jammed.t), [float(event.t) for event in jammed.events], jammed.t)
    names = ("t", "phi1", "l4", "gamma", "sliding", "B", "C", "D")
    arrays = {f"run_{name}": np.asarray(getattr(jammed, name), dtype=float)[rows] for name in names}
    return {"events": events, "assumption": "C locks and D slides"}, arrays


def _thinned(count: int, events: list[float], t: Float) -> npt.NDArray[np.intp]:
    """Return the rows kept: evenly, with those of events."""
    if count <= MOST_ROWS:
        return np.arange(count)
    even = np.linspace(0, count - 1, MOST_ROWS).round().astype(int)
    return np.unique(np.concatenate([even, np.flatnonzero(np.isin(t, events))]))


def _support(node: Node) -> Callable[[float], float]:
    """Return l4 over time, through the places that the pointer had."""
    entries = node.keys(("t", "l4"), required=("t", "l4"))
    with node.refusing():
        law = Tabulated(entries["t"].array(), entries["l4"].array())
    return lambda t: float(law.at(t)[0])
