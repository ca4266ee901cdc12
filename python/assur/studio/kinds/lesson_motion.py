"""The motion of the lesson: the crank-rocker over a turn, and the slider-crank while C is jammed.

The transmission angle depends on BD alone, so C is jammed exactly where the ground would make BD
longer than the outer rod, or shorter than the inner one, regardless of what came before. A turn is
therefore a row of stretches, each of them smooth: the rocker swings, or D slides.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from assur._trig import arctan2, sin_cos
from assur.description.words import Slide
from assur.kinematics.mechanism import Mechanism
from assur.papers import crank_rocker
from assur.papers.crank_rocker.jamming_picture import with_sliding_support
from assur.pictures.scene.course import TURN

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.kinematics.quantity import Analogues
    from assur.papers.crank_rocker import Solution

# Links of a row, each x, y and angle; what begins at which joint.
LINKS = ("crank", "coupler", "rocker", "support")
JOINTS = ("B", "C", "D")


class Lengths(NamedTuple):
    """Crank, coupler, rocker and ground, m."""

    l1: float
    l2: float
    l3: float
    l4: float


class Stretch(NamedTuple):
    """A part of the turn, φ₁ from where to where; while D slides the side, and the length BD, m."""

    start: float
    end: float
    side: str | None = None
    rod: float | None = None


def stretches(lengths: Lengths, least: float) -> list[Stretch]:
    """Return the parts of a turn in their order, for a least transmission angle."""
    blocked = crank_rocker.blocked(*lengths, least)
    if not blocked:
        return [Stretch(0.0, TURN)]
    parts = []
    for (start, end), after in zip(blocked, [*blocked[1:], blocked[0]], strict=True):
        # Around φ₁ = 0 coupler and rocker are nearly stretched, around π nearly folded.
        sign, side = (1.0, "outer") if start < 0.0 else (-1.0, "inner")
        cosine = float(sin_cos(least)[1])
        square = lengths.l2**2 + lengths.l3**2 + sign * 2.0 * lengths.l2 * lengths.l3 * cosine
        parts.append(Stretch(start, end, side, math.sqrt(square)))
        begin = after[0] + TURN if after is blocked[0] else after[0]
        if begin > end:
            parts.append(Stretch(end, begin))
    return parts


def tables(lengths: Lengths, parts: list[Stretch], rows: int) -> dict[str, Float]:
    """Return each stretch in even rows.

    `frames` has value, first and second derivative by φ₁ of the links, `by_ground` the derivatives
    by l₄ of the angles of coupler and rocker: none while D slides.
    """
    frames, by_ground = [], []
    for part in parts:
        phi = np.linspace(part.start, part.end, rows)
        frames.append(_swing(lengths, phi) if part.rod is None else _slide(lengths, part.rod, phi))
        rates = np.zeros((rows, 2))
        if part.rod is None:
            moved = crank_rocker.solve(phi, *lengths, speed=0.0, ground_speed=1.0)
            rates = np.stack([moved.dphi2, moved.dphi3], axis=-1)
        by_ground.append(rates)
    return {"frames": np.stack(frames), "by_ground": np.stack(by_ground)}


def position(
    lengths: Lengths, parts: list[Stretch], phi1: float, speed: float, ground_speed: float
) -> dict[str, Any]:
    """Return the figures at φ₁ of the mechanism that moves there: crank-rocker or slider-crank."""
    *held, by_ground = _with_moving_support(lengths, phi1, speed, ground_speed)
    here = next((part for part in parts if _is_within(phi1, part)), parts[0])
    value, first, second = held
    if here.rod is not None:
        frames = _slide(lengths, here.rod, np.array([phi1]))[:, 0]
        value, first, second = frames[0], frames[1] * speed, frames[2] * speed**2
    joints = {
        name: dict(zip(("value", "speed", "acceleration"), states, strict=True))
        for name, states in _joints(lengths, value, first, second).items()
    }
    links = {
        name: {"value": value[i, 2], "speed": first[i, 2], "acceleration": second[i, 2]}
        for i, name in enumerate(LINKS[:3])
    }
    gamma23 = _angle_at_c(value)
    return {
        "sliding": here.side,
        "rod": here.rod,
        "l4": -value[3, 0],
        "gamma": min(gamma23, math.pi - gamma23),
        "joints": joints,
        "links": links,
        "held": held[0],
        "by_ground": dict(zip(LINKS[1:3], by_ground, strict=True)),
    }


def _is_within(phi1: float, stretch: Stretch) -> bool:
    """Whether a crank angle, of any turn, is in a stretch."""
    return (phi1 - stretch.start) % TURN < stretch.end - stretch.start


def _angle_at_c(value: Float) -> float:
    """Return the angle between coupler and rocker, 0 to π."""
    if not np.isfinite(value).all():
        return math.nan
    return abs(math.remainder(value[2, 2] - value[1, 2], TURN))


def _joints(
    lengths: Lengths, value: Float, first: Float, second: Float
) -> dict[str, tuple[Float, Float, Float]]:
    """Return place, velocity and acceleration of B, C and D by the frames that begin there."""
    origins = {"B": 1, "D": 3}
    states = {name: (value[i, :2], first[i, :2], second[i, :2]) for name, i in origins.items()}
    # C is on the rocker.
    sine, cosine = (float(number) for number in sin_cos(value[2, 2]))
    along, across = lengths.l3 * np.array([cosine, sine]), lengths.l3 * np.array([-sine, cosine])
    rate, growth = first[2, 2], second[2, 2]
    states["C"] = (
        value[2, :2] + along,
        first[2, :2] + rate * across,
        second[2, :2] + growth * across - rate**2 * along,
    )
    return {name: states[name] for name in JOINTS}


def _drawing(lengths: Lengths, phi1: float) -> tuple[dict[str, tuple[float, float]], Solution]:
    """Return the joints at a crank angle, and the angles there."""
    angles = crank_rocker.solve(phi1, *lengths)
    sines, cosines = sin_cos(np.array([phi1, float(angles.phi3)]))
    places = {
        "A": (0.0, 0.0),
        "B": (lengths.l1 * float(cosines[0]), lengths.l1 * float(sines[0])),
        "C": (lengths.l3 * float(cosines[1]) - lengths.l4, lengths.l3 * float(sines[1])),
        "D": (-lengths.l4, 0.0),
    }
    return places, angles


def _right_angle(lengths: Lengths) -> float:
    """Return the crank angle at which the angle at C is nearest to a right one."""
    l1, l2, l3, l4 = lengths
    cosine = (l2 * l2 + l3 * l3 - l1 * l1 - l4 * l4) / (2.0 * l1 * l4)
    cosine = min(max(cosine, -1.0), 1.0)
    return float(arctan2(math.sqrt(1.0 - cosine * cosine), cosine))


def _swing(lengths: Lengths, phi: Float) -> Float:
    """Return value, first and second derivative by φ₁ of the frames, the ground held."""
    frames = np.zeros((3, len(phi), len(LINKS), 3))
    # Drawn within the stretch: between two a change point may lie, beyond which the assembly is
    # the other.
    right = _right_angle(lengths)
    drawn = next(
        (angle for angle in (right, -right) if (angle - phi[0]) % TURN <= phi[-1] - phi[0]), right
    )
    before = TURN * math.ceil((phi[0] - drawn) / TURN)
    places, angles = _drawing(lengths, drawn)
    if np.isnan(float(angles.phi3)):
        frames[:] = np.nan
        return frames
    links = {"ground": ["A", "D"], "crank": ["A", "B"], "coupler": ["B", "C"], "rocker": ["D", "C"]}
    motion = Mechanism(places, links, "crank").solve(phi - before, order=2, on_error="nan")
    frames[0, :, 0, 2], frames[1, :, 0, 2] = phi, 1.0
    frames[0, :, 2:, 0] = -lengths.l4
    pin = motion.joint("B")
    for order, name in enumerate(("value", "d1", "d2")):
        frames[order, :, 1, :2] = getattr(pin, name)
        for i in (1, 2):
            frames[order, :, i, 2] = getattr(motion.link(LINKS[i]), name)
    frames[0, :, 1:3, 2] = _continuous(frames[0, :, 1:3, 2])
    # Where the coupler does not reach there is no position at all.
    frames[0, np.isnan(frames[0]).any(axis=(1, 2))] = np.nan
    return frames


def _with_moving_support(
    lengths: Lengths, phi1: float, speed: float, ground_speed: float
) -> tuple[Float, Float, Float, Float]:
    """Return the frames at φ₁ and their derivatives by time, the support moving too.

    The last are second derivatives of the angles of coupler and rocker: by φ₁ and l₄, twice by l₄.
    """
    # Coordinates of two drivers: the crank, and the support on its line.
    places, _ = _drawing(lengths, phi1)
    value, first, second = np.full((3, len(LINKS), 3), np.nan)
    by_ground = np.full((2, 2), np.nan)
    if np.isnan(places["C"]).any():
        return value, first, second, by_ground
    mechanism = with_sliding_support(places)
    q = np.atleast_2d(mechanism.q0)
    motion = mechanism.solve(q, order=2, on_error="nan")
    rates = np.array([speed, -ground_speed])
    value[:], first[:], second[:] = 0.0, 0.0, 0.0
    value[0, 2], first[0, 2] = phi1, speed
    value[2:, 0], first[2:, 0] = -lengths.l4, -ground_speed
    moved: list[tuple[Analogues, Any]] = [(motion.joint("B"), (1, slice(2)))]
    moved += [(motion.link(LINKS[i]), (i, 2)) for i in (1, 2)]
    for quantity, at in moved:
        value[at] = quantity.value[0]
        first[at] = quantity.d1[0] @ rates
        second[at] = quantity.d2[0] @ rates @ rates
    for i in (1, 2):
        # The second driver is D's place: −l₄.
        twice = motion.link(LINKS[i]).d2[0]
        by_ground[i - 1] = -twice[0, 1], twice[1, 1]
    return value, first, second, by_ground


def _continuous(angles: Float) -> Float:
    """Return angles of rows without the jumps by turns that links make which go around."""
    steps = np.nan_to_num(np.round(np.diff(angles, axis=0) / TURN))
    angles[1:] -= TURN * np.cumsum(steps, axis=0)
    return angles


def _slide(lengths: Lengths, rod: float, phi: Float) -> Float:
    """Return value, first and second derivative by φ₁ of the frames of a slider-crank."""
    # The crank towards D: there a rod of any length reaches the line of centres.
    widened = lengths._replace(l4=lengths.l1 + rod)
    places, angles = _drawing(widened, math.pi)
    links = {
        "ground": ["A"],
        "crank": ["A", "B"],
        "rod": ["B", "C", "D"],
        "support": ["D"],
    }
    slides = {"line": Slide("support", on="ground", angle=0.0, origin="A")}
    motion = Mechanism(places, links, "crank", slides=slides).solve(phi, order=2, on_error="nan")
    frames = np.zeros((3, len(phi), len(LINKS), 3))
    frames[0, :, 0, 2], frames[1, :, 0, 2] = phi, 1.0
    pin, support, turned = motion.joint("B"), motion.joint("D"), motion.link("rod")
    for order, name in enumerate(("value", "d1", "d2")):
        frames[order, :, 1, :2] = getattr(pin, name)
        frames[order, :, 2, :2] = frames[order, :, 3, :2] = getattr(support, name)
        frames[order, :, 1:3, 2] = getattr(turned, name)[:, np.newaxis]
    # Coupler and rocker stand at a fixed angle to each other.
    frames[0, :, 2, 2] += float(angles.phi3) - float(angles.phi2)
    frames[0, np.isnan(frames[0]).any(axis=(1, 2))] = np.nan
    return frames
