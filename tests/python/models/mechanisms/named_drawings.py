"""Drawings that many tests and the net share: sixteen of class II, twelve with a higher group.

Most are `assur.examples`. Names and order are those of net/digests.json, which new examples leave
alone.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from assur import examples
from models.mechanisms import higher_drawings

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    import assur

__all__ = ["CLASS_II", "HIGHER", "RANGES"]

CLASS_II: Mapping[str, Callable[[], assur.Mechanism]] = {
    "crank_rocker": examples.crank_rocker,
    "chebyshev_lambda": examples.chebyshev_lambda,
    "engine": examples.engine,
    "whitworth": examples.whitworth,
    "shaper": examples.shaper,
    "scotch_yoke": examples.scotch_yoke,
    "tangent_generator": examples.tangent_generator,
    "trammel": examples.trammel,
    "watt_six_bar": examples.watt_1,
    "stephenson_six_bar": examples.stephenson_3,
    "jansen_leg": examples.jansen_leg,
    "klann_leg": examples.klann_leg,
    "peaucellier": examples.peaucellier,
    "hart": examples.hart,
    "excavator": examples.excavator,
    "toggle_press": examples.toggle_press,
}

RANGES = {name: examples.RANGES[make.__name__] for name, make in CLASS_II.items()}
"""From and to which q those of class II are used."""

HIGHER: Mapping[str, Callable[[], assur.Mechanism]] = {
    "triad": examples.triad,
    "stephenson_reversed": examples.stephenson_reversed,
    "triad_press": higher_drawings.triad_press,
    "triad_two_guides": higher_drawings.triad_two_guides,
    "triad_slotted_plate": higher_drawings.triad_slotted_plate,
    "platform_on_cylinders": examples.platform_on_cylinders,
    "platform_on_cranks": examples.platform_on_cranks,
    "quadrilateral": higher_drawings.quadrilateral,
    "quadrilateral_with_block": higher_drawings.quadrilateral_with_block,
    "quadrilateral_on_guide": higher_drawings.quadrilateral_on_guide,
    "loom": examples.loom,
    "pentagon": examples.pentagon,
}
