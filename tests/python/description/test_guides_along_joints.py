"""Guides given by two joints of the drawing, and angles that look like degrees."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any

import pytest

import assur

if TYPE_CHECKING:
    from pathlib import Path

JOINTS = {"O": (0, 0), "A": (0.12, 0), "D": (0, -0.3), "E": (0.22, 0.25)}
LINKS = {"ground": "OD", "crank": "OA", "lever": "DE", "block": "A"}


def shaper(**guide: Any) -> assur.Mechanism:
    slot = assur.Slide("block", on="lever", origin="D", **guide)
    return assur.Mechanism(JOINTS, LINKS, "crank", slides={"slot": slot})


def test_a_guide_along_two_joints_has_their_direction(tmp_path: Path) -> None:
    m = shaper(along=("D", "E"))
    assert m == shaper(angle=math.atan2(0.55, 0.22))
    assert m.slides["slot"].along is None
    m.save(tmp_path / "m.toml")
    text = (tmp_path / "m.toml").read_text()
    angle = f"angle = {m.slides['slot'].angle!r}"
    assert angle in text
    (tmp_path / "m.toml").write_text(text.replace(angle, 'along = ["D", "E"]'))
    assert assur.load(tmp_path / "m.toml") == m


@pytest.mark.parametrize(
    ("guide", "words"),
    [
        ({"along": ("D", "X")}, "is along ('D', 'X'): two joints of the drawing"),
        ({"along": "DE"}, "is along 'DE': two joints"),
        ({"along": ("D", "D")}, "'D' and 'D' are in one place"),
        ({"along": ("D", "E"), "angle": 1.0}, "has both angle and along"),
        ({"angle": ("D", "E")}, 'a number (rad) is needed, or along=("A", "B")'),
    ],
)
def test_other_guides_are_refused(guide: dict[str, Any], words: str) -> None:
    with pytest.raises(assur.InputError, match=re.escape(words)):
        shaper(**guide)


def test_an_angle_in_degrees_is_doubted() -> None:
    with pytest.warns(assur.AssurWarning, match=r"68\.2 rad: is it in degrees") as seen:
        shaper(angle=68.2)
    assert seen[0].filename == __file__
