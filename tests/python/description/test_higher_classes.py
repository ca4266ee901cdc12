"""Groups of class III and above are recognised."""

from __future__ import annotations

import math

import pytest

from models.errors.refusals import Table, build
from models.mechanisms.class_iv_model import class_iv

TRIAD: Table = {
    "joints": {"O": (0, 0), "A": (0.3, 0.2), "B": (1, 2), "C": (2.5, 1.5), "D": (2, 3), "E": (4, 0)}
    | {"F": (0, 4)},
    "links": {"ground": "OEF", "crank": "OA", "b1": "AB", "plate": "BCD", "b2": "CE", "b3": "DF"},
}
QUADRILATERAL: Table = {
    "joints": {"O": (0, 0), "A": (0.3, 0.2), "P": (1, 2), "Q": (1.5, 0.7), "R": (2.5, 2.2)}
    | {"S": (3, 0.5), "E": (4, 0.2)},
    "links": {"ground": "OE", "crank": "OA", "t1": "APQ", "t2": "ERS", "p": "PR", "q": "QS"},
}


def ring(sides: int) -> Table:
    """A closed contour of so many links, each hung on a bar: class and order `sides`."""
    joints: Table = {"O": (0, 0), "A": (0.5, 0.1)}
    links: Table = {"ground": ["O"], "crank": ["O", "A"]}
    for i in range(sides):
        corner, middle = math.tau * i / sides, math.tau * (i + 0.5) / sides
        joints[f"V{i}"] = (3 + (1 + 0.03 * i) * math.cos(corner), 3 + math.sin(corner))
        joints[f"X{i}"] = (3 + 1.8 * math.cos(middle), 3 + 1.7 * math.sin(middle))
        links[f"R{i}"] = [f"V{i}", f"V{(i + 1) % sides}", f"X{i}"]
        links[f"bar{i}"] = [f"G{i}" if i else "A", f"X{i}"]
        if i:
            joints[f"G{i}"] = (3 + 3.8 * math.cos(middle + 0.3), 3 + 3.7 * math.sin(middle + 0.3))
            links["ground"].append(f"G{i}")
    return {"joints": joints, "links": links}


@pytest.mark.parametrize(
    ("parts", "cls", "order", "formula"),
    [
        (TRIAD, 3, 3, "I(crank) → III(b1, plate, b2, b3)"),
        (QUADRILATERAL, 4, 2, "I(crank) → IV(t1, t2, p, q)"),
        (class_iv(), 4, 3, "I(crank) → IV(l234, l365, l48, l876, l95, l107)"),
        (ring(4), 4, 4, None),
        (ring(5), 5, 5, None),
    ],
)
def test_higher_classes_are_recognised(
    parts: Table, cls: int, order: int, formula: str | None
) -> None:
    m = build(**parts)
    (group,) = m.structure.groups
    assert (group.cls, group.order, group.kind, m.structure.cls) == (cls, order, None, cls)
    assert formula is None or m.structure.formula == formula


def test_their_assemblies_are_found() -> None:
    triad = build(**TRIAD)
    found = triad.assemblies(triad.q0)
    assert found.complex_count == (6,)
    assert len(found) in (2, 4, 6)
