"""Gradients of a metric by all dimensions beside the sweep without them."""

from __future__ import annotations

from functools import partial
from itertools import product
from typing import TYPE_CHECKING

import numpy as np

import assur
import spaces
from assur import metric
from subject import OURS, Case, Contender, Subject, turn

if TYPE_CHECKING:
    from collections.abc import Callable

    from subject import Float

# Share by which the dimensions of designs differ: all turn fully.
NEAR = 0.01


def case(quick: bool) -> Case:
    designs = 20 if quick else 2000
    pairs = product(MECHANISMS, METRICS)
    subjects: dict[str | int, Callable[[], Subject]] = {
        f"{name}, {kind}": partial(subject, name, kind, designs) for name, kind in pairs
    }
    return Case("gradients", "position", subjects, plotted=False, every_level=False)


def four_bar() -> tuple[assur.Mechanism, str, str]:
    """A mechanism, a joint whose x is measured, and one with a transmission angle."""
    return assur.Mechanism(spaces.JOINTS, spaces.LINKS, "crank"), "P", "C"


def six_bar() -> tuple[assur.Mechanism, str, str]:
    return spaces.random_six_bars(1).mechanism, "T", "C"


def chain() -> tuple[assur.Mechanism, str, str]:
    return spaces.chain(10, 1).mechanism, "C10", "C10"


MECHANISMS = {"four-bar": four_bar, "six-bar": six_bar, "ten dyads": chain}
METRICS = {
    "mean": lambda joint, _: metric.mean(f"{joint}.x"),
    "rms": lambda joint, _: metric.rms(f"{joint}.x"),
    "span": lambda joint, _: metric.span(f"{joint}.x"),
    "transmission angle": lambda _, joint: metric.min_transmission_angle(joint),
}


def subject(name: str, kind: str, designs: int) -> Subject:
    mechanism, joint, dyad = MECHANISMS[name]()
    q, asked = turn(360), {"it": METRICS[kind](joint, dyad)}
    random = np.random.default_rng(1)
    columns = {
        one: value * random.uniform(1.0 - NEAR, 1.0 + NEAR, designs)
        for one, value in mechanism.dimensions.items()
        if value != 0.0
    }
    by = list(mechanism.dimensions)

    def run(gradient: list[str] | None) -> assur.Measures:
        return assur.sweep(mechanism, columns, q, metrics=asked, gradient=gradient)

    def answer(measures: assur.Measures) -> list[Float]:
        assert len(measures.kept) == designs
        return [measures["it"]]

    contenders = {
        f"{OURS}, the sweep": Contender(partial(run, None), answer),
        f"{OURS}, with gradients": Contender(partial(run, by), answer),
    }
    return Subject(designs, len(q), contenders, designs * len(q))
