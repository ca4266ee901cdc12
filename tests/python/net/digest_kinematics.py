"""Positions, analogues, statuses, sensitivities and diagnostics of all classes."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

import assur
from models.mechanisms import (
    dyad_models,
    higher_models,
    mixed_models,
    named_drawings,
    named_models,
    redundant_models,
)
from models.mechanisms.mechanism_data import Description, arguments
from net import bits

if TYPE_CHECKING:
    from collections.abc import Iterator

DECIMALS = 10
RANDOM, HIGHER, MIXED, REDUNDANT = range(30), range(12), range(24), range(9)
# Every how many of the cases the costlier questions are asked.
ASKED = 3
# Redundant links have no sensitivities by one dimension.
UNASKED = ("overflow", "redundant", "model parallelogram")


def rounded(d: Description) -> Description:
    joints = {n: (round(x, DECIMALS), round(y, DECIMALS)) for n, (x, y) in d.joints.items()}
    slides = {n: replace(s, angle=round(s.angle, DECIMALS)) for n, s in d.slides.items()}
    return replace(d, joints=joints, slides=slides)


def again(m: assur.Mechanism) -> assur.Mechanism:
    """The same mechanism, its drawing rounded."""
    joints = {n: tuple(round(float(x), DECIMALS) for x in at) for n, at in m.joints.items()}
    slides = {
        n: assur.Slide(s.link, on=s.on, angle=round(s.angle, DECIMALS), origin=s.origin)
        for n, s in m.slides.items()
    }
    return assur.Mechanism(joints, m.links, m.driver, slides=slides)


def made(d: Description) -> assur.Mechanism:
    return assur.Mechanism(**arguments(rounded(d)))


def mechanisms() -> Iterator[tuple[str, assur.Mechanism]]:
    for name in named_drawings.CLASS_II:
        yield f"library {name}", again(named_drawings.CLASS_II[name]())
    for name in named_drawings.HIGHER:
        yield f"higher library {name}", again(named_drawings.HIGHER[name]())
    for name in named_models.NAMED:
        yield f"model {name}", made(named_models.NAMED[name]())
    for seed in RANDOM:
        yield f"dyads {seed}", made(dyad_models.random_case(seed, max_dyads=4).description)
    for seed in HIGHER:
        yield f"higher {seed}", made(higher_models.higher_case(seed).description)
    for seed in MIXED:
        yield f"mixed {seed}", made(mixed_models.mixed_case(seed).description)
    for seed in REDUNDANT:
        yield f"redundant {seed}", made(redundant_models.redundant_case(seed).exact)
    yield "overflow", assur.SliderCrank(5e36, 7e-73)


def change_points() -> Iterator[tuple[str, assur.Mechanism]]:
    """Lengths with which dyads fold on the path, and lengths just beside them."""
    near = [0.0, 1e-13, -1e-13, 1e-10, 1e-6, -1e-6, 1e-3]
    yield "parallelogram", assur.FourBar(1.0, 3.0 + np.array(near), 1.0, 3.0)
    yield "antiparallelogram", assur.FourBar(1.0, 3.0 + np.array(near), 1.0, 3.0, mode="crossed")
    yield "kite", assur.FourBar(1.0, 2.0, 2.0, 1.0 + np.array(near))
    yield "folding engine", assur.SliderCrank(1.0, 1.0 + np.abs(near))
    yield "folding offset", assur.SliderCrank(1.0, 3.0, 2.0 + np.array(near))
    yield "many", assur.FourBar(*np.random.default_rng(7).uniform(0.5, 3.0, (4, 200)))


def questions(m: assur.Mechanism, q: Any) -> Iterator[Any]:
    """Diagnostics, sensitivities by every third dimension, and all metrics."""
    motion = m.solve(q, order=2, on_error="nan")
    yield motion.residual, motion.condition
    for name in list(m.dimensions)[::3]:
        found = motion.sensitivity(name)
        for kind, names in (("joint", m.joints), ("link", m.links), ("slide", m.slides)):
            for one in names:
                if kind == "link" and one == "ground":
                    continue
                analogues = getattr(found, kind)(one)
                yield analogues.value, analogues.d1, analogues.d2
    if np.ndim(m.q0):
        return
    for joint in m.joints:
        yield motion.curvature(joint)
        try:
            yield motion.transmission_angle(joint)
        except assur.InputError:
            yield "none"
    moving = [name for name in m.links if name != "ground"]
    for link in moving:
        yield motion.instant_centre(link)
        yield motion.instant_centre(link, moving[0])


def inverse() -> Iterator[tuple[str, Any]]:
    """Positions at which coordinates have values: all of them, and those along a path."""
    bars: Any = again(assur.FourBar(1.0, 3.0, 2.5, 3.0, point=(1.5, 1.0)))
    for name in ("rocker", "P.x", "C.y"):
        found = bars.find(name, np.arange(-8.0, 25.0) * 0.125)
        yield f"find, {name}", [found.q, found.count, found.status]
    path = bars.find("P.x", np.arange(8.0, 17.0) * 0.0625, near=1.0)
    yield "find, near", [path.q, path.status]
    robot: Any = again(assur.examples.five_bar())
    places = np.array(robot.joints["P"]) + np.arange(-3.0, 4.0)[:, np.newaxis] * [0.03125, -0.0625]
    found, path = robot.find("P", places), robot.find("P", places[3:], near=robot.q0)
    yield "find, two drivers", [found.q, found.status, path.q, path.status]


def results() -> Iterator[tuple[str, Any]]:
    yield from inverse()
    for index, (name, m) in enumerate(mechanisms()):
        rng = np.random.default_rng(1)
        short = name.removeprefix("library ").removeprefix("higher ")
        q = bits.coordinates(m, rng, bits.few(m), short)
        both = bits.solve(m, q), bits.solve(bits.designs(m, rng, 3), q[:9])
        yield name, [m.structure.formula, *both]
        if index % ASKED == 0 and not name.startswith(UNASKED):
            yield f"{name}, asked", list(questions(m, q[:9]))
        if m.structure.cls == 2:
            signs = [repr(assembly) for assembly in m.assemblies(m.q0)]
            yield f"{name}, assemblies", signs
    q = np.concatenate([np.arange(-720, 721, 45) * (math.pi / 180), [1e3, -1e5]])
    for name, m in change_points():
        yield f"change points, {name}", bits.solve(m, q)
    paper = named_drawings.HIGHER["quadrilateral"]()
    yield "far turns", bits.solve(again(paper), np.array([0.1, 20.0, -60.0, 300.0]))
