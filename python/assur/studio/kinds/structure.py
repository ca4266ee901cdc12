"""The structure and dimensions of a mechanism, for the page."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from assur.description.dotted_names import unit_of
from assur.description.structure import roman
from assur.pictures.page.payload import ARROW

if TYPE_CHECKING:
    from assur._faces import Mechanism


def structure_of(mechanism: Mechanism) -> dict[str, Any]:
    """Return mobility, formula and groups."""
    structure = mechanism.structure
    return {
        "mobility": structure.mobility,
        "mobility_at_drawing": structure.mobility_at_drawing,
        "counted": structure.mobility_counted,
        "moving_links": structure.moving_links,
        "turning_pairs": structure.turning_pairs,
        "sliding_pairs": structure.sliding_pairs,
        "class": roman(structure.cls),
        "formula": structure.formula.split(ARROW),
        "redundant": structure.redundant,
        "groups": [
            {
                "class": roman(group.cls),
                "order": group.order,
                "kind": group.kind,
                "links": group.links,
                "joints": group.joints,
                "slides": group.slides,
            }
            for group in structure.groups
        ],
    }


def dimensions_of(mechanism: Mechanism) -> list[dict[str, Any]]:
    """Return every dimension: name, value in m or rad, unit."""
    return [
        {"name": name, "value": float(value), "unit": unit_of(name)}
        for name, value in mechanism.dimensions.items()
    ]


def described(mechanism: Mechanism) -> dict[str, Any]:
    """Return what the page must know of a mechanism that moves, beside its document."""
    return {
        "structure": structure_of(mechanism),
        "dimensions": dimensions_of(mechanism),
        "assembly": dict(mechanism.assembly),
        "q0": mechanism.q0,
    }
