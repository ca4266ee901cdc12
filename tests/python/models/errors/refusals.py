"""Mechanisms and helpers for the tests of refusals."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import assur

if TYPE_CHECKING:
    from collections.abc import Callable

Table = dict[str, Any]

JOINTS: Table = {"A": (0, 0), "B": (1, 0), "C": (4.1, 3.2), "D": (4.8, 0), "P": (3, 4)}
LINKS: Table = {"ground": "AD", "crank": "AB", "coupler": "BCP", "rocker": "DC"}
FOUR: Table = {"ground": "AD", "crank": "AB", "rod": "BC", "second": "DC"}
FIVE: Table = {"A": (0, 0), "B": (0.3, 1), "C": (1.4, 2), "D": (2.5, 0.9), "E": (2, 0)}
FIVE_LINKS: Table = {"ground": "AE", "left": "AB", "l2": "BC", "l3": "CD", "right": "ED"}
BORE = assur.Slide("piston", on="ground", angle=0.0, origin="O")
ENGINE: Table = {
    "joints": {"O": (0, 0), "A": (0.03, 0.04), "B": (0.25, 0)},
    "links": {"ground": "O", "crank": "OA", "rod": "AB", "piston": "B"},
    "slides": {"bore": BORE},
}
SHAFTS: Table = {"ground": ["O1", "O2"], "shaft1": ["O1"], "disc": [], "shaft2": ["O2"]}
LOCOMOTIVE: Table = {"A": (0, 0), "B": (0.75, 1), "C": (3.75, 1), "D": (3, 0)}
LOCOMOTIVE |= {"E": (1.5, 0), "F": (2.25, 1)}
RODS: Table = {"ground": "ADE", "crank": "AB", "rod": "BCF", "second": "DC", "third": "EF"}


def build(**changed: Any) -> assur.Mechanism:
    """The crank-rocker, or what is said instead."""
    parts: Table = {"joints": JOINTS, "links": LINKS, "driver": "crank", **changed}
    return assur.Mechanism(**parts)


def joint(**more: Any) -> Table:
    return {"joints": {**JOINTS, **more}}


def link(**more: Any) -> Table:
    return {"links": {**LINKS, **more}}


def engine(driver: Any = "crank", **slides: Any) -> Table:
    return {**ENGINE, "slides": {**ENGINE["slides"], **slides}, "driver": driver}


def oldham(**slides: Any) -> Table:
    tongue = assur.Slide("disc", on="shaft1", angle=0.4, origin="O1")
    joints = {"O1": (0, 0), "O2": (0.3, 0.1)}
    slides = {"tongue1": tongue, **slides}
    return {"joints": joints, "links": SHAFTS, "slides": slides, "driver": "shaft1"}


def twice(**more: Any) -> Table:
    """Two crank-rockers, 10 m apart."""
    joints = {**JOINTS, **{f"{k}2": (x + 10, y) for k, (x, y) in JOINTS.items()}}
    second = {f"{k}2": [f"{j}2" for j in on] for k, on in LINKS.items() if k != "ground"}
    return {
        "joints": joints,
        "links": {**LINKS, **second, "ground": ["A", "D", "A2", "D2"]},
        **more,
    }


def slide(link: str, on: str, angle: float, origin: str | None = None) -> assur.Slide:
    return assur.Slide(link, on=on, angle=angle, origin=origin)


M = build()
APART = assur.FourBar(40, 120, 80, 210)  # opens near the top of the turn
TWO = build(joints=FIVE, links=FIVE_LINKS, driver=["left", "right"])
BATCH = M.with_dimensions({"coupler.length": [4.4, math.nan, -1, 0, math.inf, 4.5, 20]})
MOTION = M.solve([0.0, 1.0, 2.0])


def refused(
    kind: type[assur.AssurError], words: str, ask: Callable[[], object], **fields: object
) -> assur.AssurError:
    """Ask; every word must be in the message as a whole word, every field of the error equal.

    A word is whole if no letter or digit goes on beside it, nor a dotted name or a decimal part:
    "q" is not in "sequence", "P" is not in "coupler.P.x", "1" is not in "1.5".
    """
    with pytest.raises(kind) as caught:
        ask()
    message = str(caught.value)
    missing = [word for word in words.split() if not is_whole_word(word, message)]
    assert not missing, f"{missing} not in: {message}"
    found = {name: getattr(caught.value, name) for name in fields}
    np.testing.assert_equal(found, fields, message)  # NaN is NaN
    return caught.value


def is_whole_word(word: str, message: str) -> bool:
    before = r"(?<![\w.])" if word[0].isalnum() else ""
    after = r"(?!\w|\.\w)" if word[-1].isalnum() else ""
    return re.search(before + re.escape(word) + after, message) is not None
