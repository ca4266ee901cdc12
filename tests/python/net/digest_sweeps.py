"""Metrics of all kinds over wide design spaces, of every class and with several drivers."""

from __future__ import annotations

from contextlib import suppress
from itertools import product
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

import assur
from assur import metric
from models.mechanisms import named_drawings
from net import design_spaces
from net.digest_kinematics import again

if TYPE_CHECKING:
    from collections.abc import Iterator

DESIGNS, POSITIONS = 48, 60
# The labels are pinned, whatever the names.
COORDINATES = {
    "span": metric.span,
    "least": metric.min,
    "greatest": metric.max,
    "mean": metric.mean,
    "rms": metric.rms,
}
# Metrics with gradients, of which every position counts.
MEANS = ("mean", "rms", "part")
SHAPES: tuple[Literal["line", "circle"], ...] = ("line", "circle")
PLACES = {"place_of_least": metric.argmin, "place_of_greatest": metric.argmax}
TURN = np.arange(POSITIONS) * (2 * np.pi / POSITIONS)


def metrics(m: assur.Mechanism, is_turn: bool) -> dict[str, metric.Metric]:
    """All metrics, of a joint, a link and the slides."""
    joint = [name for name in m.joints if name not in m.links["ground"]][-1:]
    of = [f"{name}.{axis}" for name in joint for axis in "xy"]
    of += [[link for link in m.links if link != "ground"][-1], *m.slides]
    asked: dict[str, metric.Metric] = {"moves": metric.reachable()}
    for name in of:
        asked.update(of_coordinate(name, m, is_turn))
    for name, shape, part, relative in product(joint, SHAPES, (0.25, 0.5, 1.0), (False, True)):
        asked[f"off {name} {shape} {part} {relative}"] = metric.deviation(
            name, shape=shape, part=part, relative=relative
        )
    fixed = [name for name, slide in m.slides.items() if slide.on == "ground"]
    for name in (*joint, *fixed):
        angle = metric.min_transmission_angle(name)
        with suppress(assur.InputError):  # where no two lines meet
            assur.sweep(m, {}, np.array([m.q0]), metrics={"angle": angle})
            asked[f"angle {name}"] = angle
    return asked


def of_coordinate(name: str, m: assur.Mechanism, is_turn: bool) -> dict[str, metric.Metric]:
    single = np.ndim(m.q0) == 0
    makes, orders = COORDINATES | (PLACES if single else {}), range(4 if single else 1)
    asked = {
        f"{label} {name} {order}": make(name, order=order)
        for label, make in makes.items()
        for order in orders
    }
    if single:
        asked[f"part {name}"] = metric.mean(name, over=(float(m.q0), float(m.q0) + 1.0))
    if is_turn:
        asked[f"ratio {name}"] = metric.time_ratio(name)
    return asked


def results() -> Iterator[tuple[str, Any]]:
    named = {**named_drawings.CLASS_II, **named_drawings.HIGHER}
    for seed, (name, make) in enumerate(named.items()):
        m = again(make())
        is_crank = np.ndim(m.q0) == 0 and m.driver not in m.slides
        low, high = named_drawings.RANGES.get(name, (0.0, 2 * np.pi))
        is_turn = is_crank and high == 2 * np.pi
        if is_turn:
            q = m.q0 + TURN
        elif name in named_drawings.RANGES:
            q = np.linspace(low, high, POSITIONS)
        else:
            q = np.add.outer(0.002 * np.arange(POSITIONS), m.q0)
        batch = design_spaces.space(m, np.random.default_rng(seed), DESIGNS)
        asked = metrics(m, is_turn)
        name_of = next(key for key in asked if key.startswith("span")).split()[1]
        quality = 2.0 * metric.span(name_of) - metric.min(name_of)
        found = assur.sweep(batch, {}, q, metrics={**asked, "quality": quality})
        values = np.sort(found["quality"][found.kept])
        where = [quality <= float(values[len(values) // 2]) if len(values) else quality < 0.0]
        some = assur.sweep(batch, {}, q, metrics={"quality": quality}, where=where)
        yield name, [dict(found), found.status, found.kept, some.kept, dict(some)]
        if not any(m.core.redundant):
            means = {key: asked[key] for key in asked if key.startswith(MEANS)}
            by = list(m.dimensions)
            slopes = assur.sweep(batch, {}, q, metrics=means, gradient=by)
            yield f"{name}: gradients", [dict(slopes.gradient), slopes.kept]
