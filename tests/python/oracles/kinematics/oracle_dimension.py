"""Dimensions of the oracle's bodies, changed one by one: for differences at 50 digits.

A drawing ties the dimensions of all links together; the bodies' own coordinates do not.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from models.mechanisms.mechanism_data import GROUND
from oracles.kinematics.oracle_system import MP, System, Vec

if TYPE_CHECKING:
    from collections.abc import Callable

    from models.mechanisms.mechanism_data import Description


def changed(name: str, by: Any) -> Callable[[System], None]:
    """A system's change of one dimension, called as in `Mechanism.dimensions`, m or rad."""

    def change(system: System) -> None:
        owner, *what = name.split(".")
        if owner in system.description.slides:
            _slide(system, owner, what, by)
        else:
            _joint(system, owner, what, by / system.size)

    return change


def _along(system: System, body: int) -> Vec:
    """Direction of a link's x axis in the drawing: first to second joint; the ground's own."""
    joints = system.joint_lists[body]
    if body == 0:
        return MP.mpf(1), MP.mpf(0)
    (ax, ay), (bx, by) = (system._drawn[j] for j in joints[:2])
    length = MP.hypot(bx - ax, by - ay)
    return (bx - ax) / length, (by - ay) / length


def _joint(system: System, link: str, what: list[str], by: Any) -> None:
    """``link.length``, ``link.P.x``, ``ground.D.y``."""
    body = system.index[link]
    c, s = _along(system, body)
    joint = system.joint_lists[body][1] if what == ["length"] else what[0]
    dx, dy = (-s * by, c * by) if what[-1] == "y" else (c * by, s * by)
    old = system._local(body, system._drawn[joint])
    new = (old[0] + dx, old[1] + dy)
    first = system.joint_lists[body][0] == joint and body != 0
    if first:
        raise ValueError(f"{joint} is where {link} begins")

    def moved(which: int, local: Vec) -> Vec:
        return new if which == body and local == old else local

    system.pins = [(a, moved(a, u), b, moved(b, w)) for a, u, b, w in system.pins]
    # A guide passes its origin at a distance: it goes along.
    slides = system.description.slides.values()
    for place, slide in enumerate(slides):
        if slide.on == link and slide.origin == joint:
            r = system.reaches[place]
            system.reaches[place] = replace(r, w=(r.w[0] + dx, r.w[1] + dy))
    system.points = {n: (b, moved(b, u)) for n, (b, u) in system.points.items()}
    drivers = system.reaches[len(slides) :]
    system.reaches[len(slides) :] = [
        replace(r, u=moved(r.a, r.u), w=moved(r.b, r.w)) for r in drivers
    ]
    system.values = {
        n: replace(r, u=moved(r.a, r.u), w=moved(r.b, r.w)) for n, r in system.values.items()
    }


def _slide(system: System, name: str, what: list[str], by: Any) -> None:
    """``bore.offset`` and ``bore.angle``."""
    slides = list(system.description.slides)
    place = slides.index(name)
    reach, value = system.reaches[place], system.values[name]
    (kind,) = what
    if kind == "offset":
        shift = by / system.size
        w = (reach.w[0] + shift * reach.d[0], reach.w[1] + shift * reach.d[1])
        system.reaches[place] = replace(reach, w=w)
        return
    if kind != "angle":
        raise ValueError(f"{name}.{kind}")
    c, s = MP.cos_sin(by)

    def turned(v: Vec) -> Vec:
        return c * v[0] - s * v[1], s * v[0] + c * v[1]

    # The path turns about the origin, which is where values are counted from.
    arm = turned((reach.w[0] - value.w[0], reach.w[1] - value.w[1]))
    w = (value.w[0] + arm[0], value.w[1] + arm[1])
    system.reaches[place] = replace(reach, w=w, d=turned(reach.d))
    system.values[name] = replace(value, d=turned(value.d))
    for k, (drive, driver, *_) in enumerate(system.description.drivers):
        if (drive, driver) == ("slide", name):
            row = next(i for i, r in enumerate(system.reaches) if r.q == k)
            own = system.reaches[row]
            system.reaches[row] = replace(own, d=turned(own.d))
    turn = system.turns[place]
    system.turns[place] = replace(turn, shift=turn.shift - by)


def known(description: Description, name: str) -> bool:
    """Whether `changed` can change it: not the frame of a slide drawn in place, nor its own."""
    owner, *what = name.split(".")
    if owner in description.slides:
        return what in (["offset"], ["angle"])
    return not (owner == GROUND and description.links[GROUND][0] == what[0])
