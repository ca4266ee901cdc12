"""``turn``: the scene, and the frames of all links over a turn or what can be reached of it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from assur._search import bisected
from assur.description.words import has_analogues
from assur.errors import InputError
from assur.kinematics.table import driven_angles
from assur.pictures.page.payload import payload, played_of
from assur.pictures.page.turn import Turn, frames_in_time, passing_turn, turn_of
from assur.pictures.scene.course import FREE_STROKE, TURN
from assur.studio import document
from assur.studio.kinds.dead_ends import dead_ends
from assur.studio.kinds.least import min_transmission_angle
from assur.studio.kinds.structure import dimensions_of
from assur.studio.request import Fields
from assur.studio.session import Answer

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur._faces import Limits
    from assur.kinematics.mechanism import Mechanism
    from assur.pictures.page.turn import Unit
    from assur.studio.session import Session

ROWS = 361
# Steps to the end of what one of several drivers can reach, then halvings of the last.
STEPS, HALVINGS = 24, 6
# What a request may say of the picture.
SHOWN = ("rows", "orders", "paths", "diagrams", "axis")


def turn(data: dict[str, Any], session: Session) -> Answer:
    """Return what the page draws and plays without the server."""
    del session
    fields = Fields(data, ("document", "q", *SHOWN), ("document",))
    mechanism = document.read_mechanism(fields["document"])
    q = fields.drivers("q", mechanism)
    return turn_answer(mechanism, q, fields)


def turn_answer(mechanism: Mechanism, q: Any, fields: Fields) -> Answer:
    """Return a turn with the scene, as the fields want it, that begins at q."""
    rows, orders = fields.rows(ROWS), fields.whole("orders", 3, 2, 3)
    axis = fields.whole("axis", 0, 0, mechanism.driver_count - 1)
    is_single = mechanism.driver_count == 1
    turn = passing_turn(mechanism, q, rows) if is_single and orders < 3 else None
    if turn is None:
        turn = (
            reached_turn(mechanism, q, rows)
            if is_single
            else _along(mechanism, np.asarray(q), axis, rows)
        )
    answer = played_answer(turn, fields, orders)
    if orders < 3:
        return answer
    # At rest there is time for more.
    place = turn.coordinates()
    line = place if is_single else np.repeat(np.asarray(q, float)[None, :], len(place), axis=0)
    if not is_single:
        line[:, axis] = place
    reach = None if is_single else [_reach(mechanism, np.asarray(q), i) for i in range(len(q))]
    more = {"transmission": min_transmission_angle(mechanism, line, place), "reach": reach}
    return Answer({**answer.header, **more}, answer.arrays)


def played_answer(turn: Turn, fields: Fields, orders: int, speed: float | None = None) -> Answer:
    """Return the turn to play with its scene."""
    kept: list[Float] = []
    shown = payload(
        played_of(turn), "", speed, fields["paths"], fields["diagrams"], encode=kept.append
    )
    shown["turn"] |= {
        "orders": orders,
        "limits": None if turn.limits is None else reach_of(turn.limits),
        "dead": dead_ends(turn),
    }
    header = {"payload": shown, "dimensions": dimensions_of(turn.mechanism)}
    values = kept[0][:orders]
    # Pictures that pass need no more digits than the screen has.
    return Answer(header, {"values": values if orders > 2 else values.astype(np.float32)})


def reached_turn(mechanism: Mechanism, q: float, rows: int) -> Turn:
    """Return the turn from q, or from what can be reached next to it."""
    try:
        return turn_of(mechanism, q, rows)
    except InputError as error:
        intervals = mechanism.limits().intervals
        if not len(intervals):
            mechanism.solve(q, order=0)  # says what is too short
            raise
        if not np.isfinite(intervals).all():
            raise
        middles = intervals.mean(axis=1)
        nearest = float(middles[np.argmin(np.abs(middles - q))])
        if nearest == q:
            raise error from None
        return turn_of(mechanism, nearest, rows)


def _along(mechanism: Mechanism, q: Float, axis: int, rows: int) -> Turn:
    """Return what one of several drivers moves while the others are held."""
    angle = driven_angles(mechanism)[axis]
    low, high = _reach(mechanism, q, axis)
    line = np.repeat(q[None, :], rows, axis=0)
    line[:, axis] = np.linspace(low, high, rows)
    motion = mechanism.solve(line, order=2, on_error="nan")
    speed = np.zeros_like(line)
    speed[:, axis] = 1.0
    frames = frames_in_time(motion, speed, np.zeros_like(line))
    ends = frames.values[0][-1] - frames.values[0][0]
    ends[:, 2] -= TURN * np.round(ends[:, 2] / TURN)
    goes_round = angle and abs(high - low - TURN) < 1e-12 and bool(frames.is_known.all())
    closes = goes_round and float(np.abs(ends).max()) < 1e-9
    grid = {"kind": "linear", "low": float(line[0, axis]), "high": float(line[-1, axis])}
    unit: Unit = "angle" if angle else "length"
    return Turn(mechanism, frames, grid, closes, unit, float(q[axis]))


def _reach(mechanism: Mechanism, q: Float, axis: int) -> tuple[float, float]:
    """Return from and to where one of several drivers can go while the others are held."""
    points = np.array(list(mechanism.joints.values()))
    free = FREE_STROKE * float(np.ptp(points, axis=0).max() or 1.0)
    half = TURN / 2.0 if driven_angles(mechanism)[axis] else free
    low, high = (float(q[axis]) + _end(mechanism, q, axis, way) for way in (-half, half))
    return low, high


def _end(mechanism: Mechanism, q: Float, axis: int, reach: float) -> float:
    """Return how far a driver can go, step by step: positions out of reach are slow to show."""

    def holds(way: float) -> bool:
        at = q.copy()
        at[axis] += way
        return bool(has_analogues(mechanism.solve(at, order=0, on_error="nan").status))

    known, beyond = 0.0, reach
    for way in np.linspace(0.0, reach, STEPS + 1)[1:]:
        if not holds(float(way)):
            beyond = float(way)
            break
        known = float(way)
    if known == reach:
        return reach
    return float(bisected(holds, known, beyond, HALVINGS)[0])


def reach_of(limits: Limits) -> dict[str, Any]:
    """Return where the driver can be; null stands for no end."""
    return {
        "intervals": limits.intervals,
        "full_rotation": limits.full_rotation,
        "period": limits.period,
        "dead_points": [{"q": point.q, "group": point.group} for point in limits.dead_points],
    }
