"""Mechanisms and motions with any arguments."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any

import numpy as np

import assur

if TYPE_CHECKING:
    from fuzzing.fuzz_values import Choices

DESCRIPTION: dict[str, Any] = {
    "joints": {"A": (0, 0), "B": (1, 0), "C": (4.1, 3.2), "D": (4.8, 0), "P": (3, 4), "E": (8, 1)},
    "links": {
        "ground": ["A", "D"],
        "crank": ["A", "B"],
        "coupler": ["B", "C", "P"],
        "rocker": ["D", "C"],
        "rod": ["P", "E"],
        "block": ["E"],
    },
    "driver": "crank",
    "slides": {"bore": assur.Slide("block", "ground", angle=0.3, origin="A")},
    "assembly": {"C": 1},
}
CLASS_IV = {
    "1": (0, 0),
    "2": (0.35, 0),
    "3": (1.24, 0.99),
    "4": (0.75, 1.91),
    "5": (3.02, -0.73),
    "6": (2.45, 1.02),
    "7": (3.2, 2.24),
    "8": (1.85, 2.35),
    "9": (1.62, -1.11),
    "10": (4.28, 1.52),
}


@functools.cache
def mechanisms() -> tuple[assur.Mechanism, ...]:
    """One of every sort, a batch and one with change points among them."""
    pins = {"A": (0, 0), "B": (0.3, 1), "C": (1.4, 2), "D": (2.5, 0.9), "E": (2, 0)}
    bars = {"ground": "AE", "left": "AB", "l2": "BC", "l3": "CD", "right": "ED"}
    four_bar = assur.FourBar(1.0, 3.0, 2.5, 3.0)
    return (
        four_bar,
        assur.SliderCrank(0.1, 0.4),
        assur.Mechanism(**DESCRIPTION),
        assur.Mechanism(pins, bars, ["left", "right"]),
        assur.ClassIV(joints=CLASS_IV),
        four_bar.with_driver("rocker"),
        four_bar.with_dimensions({"rocker.length": [2.5, 1.0, 0.1]}),
        assur.FourBar(1.0, 2.0, 1.0, 2.0),
    )


def describe(c: Choices) -> object:
    key = c.among(list(DESCRIPTION))
    if c.byte() % 8 == 0:
        fields = {"link": c.odd, "on": c.odd, "angle": c.number, "origin": c.odd}
        slide = c.call(assur.Slide, **fields)
        return assur.Mechanism(**{**DESCRIPTION, "slides": {"bore": slide}})
    return assur.Mechanism(**{**DESCRIPTION, key: c.spoiled(DESCRIPTION[key])})


def construct(c: Choices) -> object:
    if c.byte() % 2:
        return c.call(assur.SliderCrank, crank=c.positive, rod=c.positive, offset=c.number)
    lengths = dict.fromkeys(("crank", "coupler", "rocker", "ground"), c.positive)
    return c.call(assur.FourBar, **lengths, mode=lambda: c.among(("open", "crossed")))


def change(c: Choices) -> object:
    m = c.among(mechanisms())
    kind = c.byte() % 4
    if kind == 0:
        return c.call(m.with_driver, driver=lambda: c.among(list(m.links)), assembly=dict)
    if kind == 1:
        return m.design(c.argument(c.small))
    names = [c.among(list(m.dimensions)) for _ in range(c.byte() % 3)]
    return m.with_dimensions(c.argument(lambda: {n: c.argument(c.numbers) for n in names}))


def coordinates(c: Choices, m: assur.Mechanism) -> Any:
    """One position where there are several drivers: each is followed from the drawing."""
    if m.shape == () and np.size(m.q0) > 1:
        return m.q0 + np.clip([c.number() for _ in range(np.size(m.q0))], -9.0, 9.0)
    return c.numbers()


def assemblies(c: Choices) -> object:
    m = c.among(mechanisms())
    return m.assemblies(c.argument(lambda: coordinates(c, m)))


def move(c: Choices) -> object:
    m = c.among(mechanisms())
    names = [*m.joints, *m.links, *m.slides]
    motion = c.call(
        m.solve,
        q=lambda: coordinates(c, m),
        order=lambda: c.byte() % 4,
        outputs=lambda: [c.among(names) for _ in range(c.byte() % 4)],
        assembly=lambda: m.assembly,
        on_error=lambda: "nan" if c.byte() % 4 else "raise",
        threads=lambda: 1,
        out=lambda: None,
    )
    return _rates(c, motion) if c.byte() % 2 else _ask(c, motion)


def _rates(c: Choices, motion: assur.Motion) -> object:
    m = motion.mechanism
    quantity = c.either(
        lambda: motion.joint(c.argument(lambda: c.among(list(m.joints)))),
        lambda: motion.link(c.argument(lambda: c.among(list(m.links)))),
        lambda: motion.slide(c.argument(lambda: c.among([*m.slides, "bore"]))),
    )
    return c.either(
        lambda: c.call(quantity.velocity, speed=c.numbers),
        lambda: c.call(quantity.acceleration, speed=c.numbers, acceleration=c.numbers),
        lambda: c.call(quantity.jerk, speed=c.numbers, acceleration=c.numbers, jerk=c.numbers),
        lambda: (quantity.value, quantity.d1),
        lambda: (quantity.d2, quantity.d3),
    )


def _ask(c: Choices, motion: assur.Motion) -> object:
    m = motion.mechanism

    def joint() -> Any:
        return c.among(list(m.joints))

    def link() -> Any:
        return c.among([*m.links, *m.slides])

    return c.either(
        lambda: c.call(motion.curvature, joint=joint),
        lambda: c.call(motion.instant_centre, link=link, other=link),
        lambda: c.call(motion.mechanical_advantage, name=link),
        lambda: c.call(
            motion.transmission_angle, name=joint, between=lambda: (c.argument(joint), joint())
        ),
        lambda: motion.sensitivity(c.argument(lambda: c.among(list(m.dimensions)))).joint(joint()),
        lambda: motion.coordinate(c.argument(c.small)),
        lambda: motion.explain(c.argument(c.small)),
        lambda: (motion.residual, motion.condition, motion.status),
        lambda: m.solve(c.argument(c.numbers), out=motion),
    )
