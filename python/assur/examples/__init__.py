"""Named examples: each function returns a `Mechanism` or, with masses, a `Machine`.

``ALL`` has the functions by name, ``RANGES`` the coordinates over which each is used. Their
docstrings say what to look at, and where the mechanism comes from.

>>> import assur, numpy as np
>>> m = assur.examples.crank_rocker()
>>> first, last = assur.examples.RANGES["crank_rocker"]
>>> m.solve(np.linspace(first, last, 9)).joint("P").value.shape
(9, 2)
>>> assur.examples.ALL["hart"]().structure.formula
'I(crank) → II(short1, long1) → II(short2, long2)'
"""

from __future__ import annotations

import math
from types import MappingProxyType
from typing import TYPE_CHECKING, TypeAlias

from assur._other_names import refuse_attribute
from assur.examples.fourbars import crank_rocker, locomotive
from assur.examples.higher_classes import loom, pentagon, stephenson_reversed, triad
from assur.examples.legs import jansen_leg, klann_leg
from assur.examples.machines import andrews_squeezer, toggle_press
from assur.examples.platforms import platform_on_cranks, platform_on_cylinders
from assur.examples.quick_returns import shaper, whitworth
from assur.examples.several_drivers import excavator, five_bar, pantograph
from assur.examples.sixbars import stephenson_1, stephenson_2, stephenson_3, watt_1, watt_2
from assur.examples.sliders import engine, oldham, scotch_yoke, tangent_generator, trammel
from assur.examples.straight_lines import chebyshev_lambda, hart, peaucellier

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from assur.dynamics.machine import Machine
    from assur.kinematics.mechanism import Mechanism


__all__ = [
    "ALL",
    "RANGES",
    "andrews_squeezer",
    "chebyshev_lambda",
    "crank_rocker",
    "engine",
    "excavator",
    "five_bar",
    "hart",
    "jansen_leg",
    "klann_leg",
    "locomotive",
    "loom",
    "oldham",
    "pantograph",
    "peaucellier",
    "pentagon",
    "platform_on_cranks",
    "platform_on_cylinders",
    "scotch_yoke",
    "shaper",
    "stephenson_1",
    "stephenson_2",
    "stephenson_3",
    "stephenson_reversed",
    "tangent_generator",
    "toggle_press",
    "trammel",
    "triad",
    "watt_1",
    "watt_2",
    "whitworth",
]

Coordinate: TypeAlias = "float | tuple[float, ...]"
Example: TypeAlias = "Callable[[], Mechanism | Machine]"

ALL: Mapping[str, Example] = MappingProxyType(
    {
        make.__name__: make
        for make in (
            *(crank_rocker, locomotive),
            *(engine, scotch_yoke, tangent_generator, trammel, oldham),
            *(whitworth, shaper),
            *(watt_1, watt_2, stephenson_1, stephenson_2, stephenson_3),
            *(jansen_leg, klann_leg),
            *(chebyshev_lambda, peaucellier, hart),
            *(pantograph, five_bar, excavator),
            *(platform_on_cylinders, platform_on_cranks),
            *(triad, stephenson_reversed, loom, pentagon),
            *(toggle_press, andrews_squeezer),
        )
    }
)
"""The examples by name, simple ones first."""

RANGES: Mapping[str, tuple[Coordinate, Coordinate]] = MappingProxyType(
    {
        **dict.fromkeys(ALL, (0.0, math.tau)),
        "tangent_generator": (-1.4, 1.4),
        "peaucellier": (-1.6, 1.6),
        "hart": (-2.3, 2.3),
        "pantograph": ((0.1, -0.1), (0.22, 0.12)),
        "five_bar": ((1.4, 0.84), (2.3, 1.74)),
        "excavator": ((2.5, 2.0, 2.0), (3.3, 2.9, 2.65)),
        "platform_on_cylinders": ((1.1, 1.0, 0.7), (1.5, 1.4, 1.1)),
        "platform_on_cranks": ((0.7, 2.3, -1.2), (1.3, 2.9, -0.6)),
        "stephenson_reversed": (-0.2, 1.0),
        "pentagon": (-0.7, 2.6),
    }
)
"""From and to which q each is used, rad or m (of several drivers a tuple): mostly one turn."""

if not TYPE_CHECKING:

    def __getattr__(name):
        from difflib import get_close_matches

        similar = get_close_matches(name, ALL, n=3)
        hint = f"did you mean {' or '.join(similar)}?" if similar else "ALL lists them"
        refuse_attribute(None, "'assur.examples'", name, {name: hint})

    def __dir__():
        return sorted(__all__)
