"""The inverse question by other means: another mechanism, made by hand, and a search along q.

A mechanism driven by a coordinate is described anew, with slides that carry the joint, and its
assemblies are listed; those of the mechanism itself that show the same pose have the answer. Or the
coordinate is followed over a turn, in every assembly, and its crossings of the value are located.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

import assur

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

# Poses nearer than this (in sizes) are the same.
SAME = 1e-6
# Samples of a turn.
SAMPLES = 1440


def driven_by(m: Any, names: Sequence[str]) -> assur.Mechanism:
    """Return the mechanism that coordinates drive; values are measured from the origin."""
    joints, slides = dict(m.joints), dict(m.slides)
    links = {name: list(on) for name, on in m.links.items()}
    joints["zero"] = (0.0, 0.0)
    links.setdefault("ground", []).append("zero")
    drivers = []
    for k, name in enumerate(names):
        joint, dot, axis = name.rpartition(".")
        if not dot:
            drivers.append(name)
            continue
        x, y = m.joints[joint]
        way = 0.0 if axis == "x" else 0.5 * math.pi
        foot, bar, block, drive, cross = (f"{word}{k}" for word in ("f", "bar", "b", "d", "c"))
        joints[foot] = (x, 0.0) if axis == "x" else (0.0, y)
        links[bar], links[block] = [foot], [joint]
        slides[drive] = assur.Slide(bar, on="ground", angle=way, origin="zero")
        slides[cross] = assur.Slide(block, on=bar, angle=0.5 * math.pi - way, origin=foot)
        drivers.append(drive)
    return assur.Mechanism(joints, links, drivers, slides=slides)


def coordinates(m: assur.Mechanism, found: Any, driven: assur.Mechanism) -> Any:
    """Return the drivers' coordinates of m in an assembly of one with the same parts."""
    there = driven.solve(found.q, order=0, assembly=found)
    q = []
    for driver in m.driver if isinstance(m.driver, tuple) else (m.driver,):
        if isinstance(driver, str) and driver in m.slides:
            q.append(float(there.slide(driver).value))
            continue
        link = driver if isinstance(driver, str) else driver.link
        base = None if isinstance(driver, str) else driver.relative_to
        angle = float(there.link(link).value)
        angle -= float(there.link(base).value) if base is not None else 0.0
        q.append(math.remainder(angle, math.tau))
    return np.array(q)


def by_assemblies(m: assur.Mechanism, names: Sequence[str], values: Sequence[float]) -> list[Any]:
    """Return q of every position at which coordinates have values, by q."""
    driven = driven_by(m, names)
    found = driven.assemblies(values[0] if len(values) == 1 else np.array(values))
    return sorted((coordinates(m, one, driven) for one in found), key=lambda q: q.tolist())


def every_assembly(m: assur.Mechanism) -> Iterator[dict[str, int]]:
    """Return all combinations of signs."""
    names = list(m.assembly)
    for choice in range(2 ** len(names)):
        yield {name: 1 - 2 * (choice >> k & 1) for k, name in enumerate(names)}


def by_crossings(m: assur.Mechanism, name: str, value: float) -> list[tuple[float, dict[str, int]]]:
    """Return q and signs of the crossings of a value over a turn; double ones are not found."""
    crossings = []
    for signs in every_assembly(m):
        q = np.linspace(-math.pi, math.pi, SAMPLES + 1) + 1e-3
        at = misfit(m, signs, name, value, q)
        with np.errstate(invalid="ignore"):
            is_crossed = (at[:-1] * at[1:] <= 0.0) & (np.abs(at[:-1] - at[1:]) < 1.0)
        for k in np.flatnonzero(is_crossed):
            low, high = float(q[k]), float(q[k + 1])
            for _ in range(60):
                middle = 0.5 * (low + high)
                if float(misfit(m, signs, name, value, middle)) * at[k] > 0.0:
                    low = middle
                else:
                    high = middle
            crossings.append((math.remainder(0.5 * (low + high), math.tau), signs))
    return sorted(crossings, key=lambda crossing: crossing[0])


def misfit(m: assur.Mechanism, signs: dict[str, int], name: str, value: float, q: Any) -> Any:
    """Return a coordinate less a value, of angles without whole turns."""
    joint, dot, axis = name.rpartition(".")
    motion = m.solve(q, order=0, assembly=signs, on_error="nan")
    if dot:
        return np.asarray(motion.joint(joint).value[..., "xy".index(axis)] - value)
    if name in m.slides:
        return np.asarray(motion.slide(name).value - value)
    turned = np.asarray(motion.link(name).value - value)
    return turned - np.round(turned / math.tau) * math.tau
