"""Frames of all links over a turn, over what can be reached, or over given positions."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from assur._arrays import real_number
from assur.description.words import is_reached
from assur.errors import InputError
from assur.pictures.scene.course import TURN, free_stroke, interval_at
from assur.pictures.scene.frames import FAR, Frames, frames_of

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur._faces import Limits, Mechanism, Motion

ROWS = 181
# Motions that close only after more turns than this are shown over one, to and fro.
MOST_TURNS = 4
# q = middle − half · cos u: dense at dead points, where everything is smooth in u, not in q. So
# near 0 and π u begins and ends.
GAP = 2e-3

Unit = Literal["angle", "length", "time"]


@dataclass(frozen=True, eq=False)
class Turn:
    """What is played.

    Attributes
    ----------
    mechanism : Mechanism
        What moves.
    frames : Frames
        Values and two derivatives by the grid's parameter, at each row.
    grid : dict
        How the coordinate goes along the rows: ``linear`` from low to high, ``cosine``
        (middle − half · cos of a parameter from low to high), or ``rows`` with its values.
    closes : bool
        Whether the last position is the first.
    unit : {"angle", "length", "time"}
        What the coordinate is.
    at : float
        Where to begin.
    dead_points : list of (float, str)
        Ends where the driver cannot go on, each with the group that is flat there.
    limits : Limits or None
        All places of the driver, if they were searched.
    """

    mechanism: Mechanism
    frames: Frames
    grid: dict[str, Any]
    closes: bool
    unit: Unit
    at: float
    dead_points: list[tuple[float, str]] = field(default_factory=list)
    limits: Limits | None = None

    def coordinates(self) -> Float:
        """Return the coordinate of each row."""
        grid, rows = self.grid, len(self.frames.values[0])
        if grid["kind"] == "rows":
            return np.asarray(grid["q"], float)
        parameter = np.linspace(grid["low"], grid["high"], rows)
        if grid["kind"] == "linear":
            return parameter
        places: Float = grid["middle"] - grid["half"] * np.cos(parameter)
        return places


def turn_of(mechanism: Mechanism, at: Any = None, rows: int = ROWS) -> Turn:
    """Return the whole turn of the driver, or what can be reached from the drawing."""
    require_one(mechanism)
    if mechanism.driver_count > 1:
        message = (
            f"to_html plays one coordinate, this mechanism has {mechanism.driver_count} drivers: "
            "solve its positions, then motion.to_html()"
        )
        raise InputError(message)
    q0 = float(mechanism.q0_array) if at is None else real_number(at, "q")
    turns = mechanism.driver not in mechanism.slides
    limits = mechanism.limits()
    low, high = interval_at(limits, q0, turns)
    if not low < high:
        places = " ".join(f"[{a:.6g}, {b:.6g}]" for a, b in limits.intervals.tolist())
        message = f"q is {q0:g}, beyond what can be reached: {places or 'nothing'}"
        raise InputError(message)
    unit: Unit = "angle" if turns else "length"
    if turns and np.isinf(low) and np.isinf(high):
        period = limits.period
        closes = period is not None and period <= MOST_TURNS
        count = period if closes else 1
        frames = _linear(mechanism, 0.0, TURN * count, (rows - 1) * count + 1)
        if frames is not None:
            grid = {"kind": "linear", "low": 0.0, "high": TURN * count}
            return Turn(mechanism, frames, grid, closes, unit, q0 % (TURN * count), [], limits)
    free = TURN / 2.0 if turns else free_stroke(mechanism)
    low, high = max(low, q0 - free), min(high, q0 + free)
    # No picture can follow a part toward infinity.
    low, high = _nearby(mechanism, q0, low, high, rows)
    frames, grid = _cosine(mechanism, low, high, rows)
    dead = [
        (point.q + shift, point.group)
        for point in limits.dead_points
        for shift in ((-TURN, 0.0, TURN) if turns else (0.0,))
        if point.group is not None and min(abs(point.q + shift - end) for end in (low, high)) < 1e-9
    ]
    return Turn(mechanism, frames, grid, False, unit, q0, dead, limits)


def passing_turn(mechanism: Mechanism, at: float, rows: int) -> Turn | None:
    """Return a turn that is known at every row and comes back, or None.

    Limits are not searched: gaps between two rows are not seen. So it serves for passing pictures,
    while a hand moves a joint.
    """
    if mechanism.driver_count > 1 or mechanism.driver in mechanism.slides:
        return None
    frames = _linear(mechanism, 0.0, TURN, rows, order=1)
    if frames is None or not _comes_back(frames):
        return None
    grid = {"kind": "linear", "low": 0.0, "high": TURN}
    return Turn(mechanism, frames, grid, True, "angle", at % TURN)


def _comes_back(frames: Frames) -> bool:
    """Whether the last row is the first; angles may differ by turns."""
    apart = frames.values[0][-1] - frames.values[0][0]
    apart[:, 2] -= TURN * np.round(apart[:, 2] / TURN)
    return bool((np.abs(apart) < 1e-9).all())


def turn_of_rows(motion: Motion, duration: float | None = None) -> Turn:
    """Return the positions of a motion, in their order.

    With one driver whose coordinate only grows, or only falls, it is played along the coordinate;
    otherwise along time, as if the positions were equally far apart in time.
    """
    mechanism = motion.mechanism
    require_one(mechanism)
    if len(motion.shape) != 1 or motion.shape[0] < 2:
        message = f"to_html plays positions (N,), at least 2; this motion has shape {motion.shape}"
        raise InputError(message)
    signs: dict[str, int] | None = None
    if motion.request.signs != mechanism.signs:
        names = (name for name, _ in mechanism.core.assembly)
        signs = dict(zip(names, motion.request.signs, strict=True))
    q = motion.q
    steps = np.diff(q, axis=0)
    along_q = mechanism.driver_count == 1 and ((steps > 0).all() or (steps < 0).all())
    if along_q and steps[0] < 0:
        q = q[::-1]
    # Again: this motion may keep fewer outputs and orders.
    again = mechanism.solve(q, order=2, assembly=signs, on_error="nan")
    if along_q and duration is None:
        unit: Unit = "length" if mechanism.driver in mechanism.slides else "angle"
        grid = {"kind": "rows", "q": q.tolist()}
        return Turn(
            mechanism,
            frames_of(again),
            grid,
            _closes(q, unit, again),
            unit,
            float(motion.q[0]),
        )
    duration = 4.0 if duration is None else duration
    t = np.linspace(0.0, duration, len(q))
    speed = _slope(q, t)
    acceleration = _slope(speed, t)
    frames = frames_in_time(again, speed, acceleration)
    grid = {"kind": "linear", "low": 0.0, "high": duration}
    return Turn(mechanism, frames, grid, _comes_back(frames), "time", 0.0)


def _slope(values: Float, t: Float) -> Float:
    """Return derivatives along evenly spaced times, across the end of a motion that comes back."""
    if (np.abs(values[-1] - values[0]) > 1e-9 * np.abs(values).max()).any():
        return np.asarray(np.gradient(values, t, axis=0, edge_order=2 if len(t) > 2 else 1))
    step = t[1] - t[0]
    around = np.concatenate([values[-2:-1], values, values[1:2]])
    slopes: Float = (around[2:] - around[:-2]) / (2.0 * step)
    return slopes


def frames_in_time(motion: Motion, speed: Float, acceleration: Float) -> Frames:
    """Return frames with derivatives by time, of drivers with these speeds and accelerations."""
    rows, drivers = len(motion.q), motion.mechanism.driver_count
    speed, acceleration = speed.reshape(rows, drivers), acceleration.reshape(rows, drivers)
    position = frames_of(motion)
    first, second = np.zeros_like(position.values[0]), np.zeros_like(position.values[0])
    for i, link in enumerate(position.links):
        origin, angle = motion.reference_points[link].arrays, motion.link(link).arrays
        for columns, arrays in ((slice(0, 2), origin), (slice(2, 3), angle)):
            d1 = arrays[1].reshape(rows, -1, drivers)
            d2 = arrays[2].reshape(rows, -1, drivers, drivers)
            first[:, i, columns] = np.einsum("ncd,nd->nc", d1, speed)
            bent = np.einsum("ncde,nd,ne->nc", d2, speed, speed)
            second[:, i, columns] = bent + np.einsum("ncd,nd->nc", d1, acceleration)
    return Frames(position.links, (position.values[0], first, second), position.local)


def require_one(mechanism: Mechanism) -> None:
    """Refuse a batch."""
    if mechanism.shape:
        message = (
            f"to_html plays one mechanism, this is a batch {mechanism.shape}: take one with "
            "design(i)"
        )
        raise InputError(message)


def _closes(q: Float, unit: Unit, motion: Motion) -> bool:
    """Whether rows go round a whole turn."""
    if unit != "angle" or abs(q[-1] - q[0] - TURN) > 1e-9:
        return False
    joints = (motion.joint(name).value for name in motion.mechanism.joints)
    return all(bool(np.abs(joint[-1] - joint[0]).max() < 1e-9) for joint in joints)


def _linear(
    mechanism: Mechanism, low: float, high: float, rows: int, order: int = 2
) -> Frames | None:
    motion = mechanism.solve(np.linspace(low, high, rows), order=order, on_error="nan")
    return frames_of(motion) if bool(is_reached(motion.status).all()) else None


def _nearby(
    mechanism: Mechanism, q0: float, low: float, high: float, rows: int
) -> tuple[float, float]:
    """Return the part of an interval about q0 in which all joints are near the drawing."""
    joints = np.array(list(mechanism.joints.values()))
    centre = joints.mean(axis=0)
    reach = FAR * float(np.abs(joints - centre).max())
    q = np.linspace(low, high, rows)
    motion = mechanism.solve(q, order=0, on_error="nan")
    paths = motion.joint(list(mechanism.joints)).value
    with np.errstate(invalid="ignore"):
        far = (np.abs(paths - centre) > reach).any(axis=(0, 2))
    below, above = q[far & (q < q0)], q[far & (q > q0)]
    return float(below.max(initial=low)), float(above.min(initial=high))


def _cosine(
    mechanism: Mechanism, low: float, high: float, rows: int
) -> tuple[Frames, dict[str, Any]]:
    """Return frames with derivatives by u, q = middle − half · cos u."""
    middle, half = (low + high) / 2.0, (high - low) / 2.0
    u = np.linspace(GAP, np.pi - GAP, rows)
    motion = mechanism.solve(middle - half * np.cos(u), order=2, on_error="nan")
    by_q = frames_of(motion).values
    first, second = (half * f(u)[:, None, None] for f in (np.sin, np.cos))
    values = (by_q[0], by_q[1] * first, by_q[2] * first**2 + by_q[1] * second)
    grid = {"kind": "cosine", "middle": middle, "half": half, "low": GAP, "high": np.pi - GAP}
    frames = frames_of(motion)
    return Frames(frames.links, values, frames.local), grid
