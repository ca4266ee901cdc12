"""Mechanisms of class III, IV and V, used by tests, benches and documentation.

Every function draws one, in metres. A group above class II has no dyad in it: take away any of its
links and all of it is loose. `HIGHER` has them by name.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import assur

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["HIGHER"]

RIGHT_ANGLE = math.pi / 2

# -- class III: a plate on three legs -------------------------------------------------------------


def triad() -> assur.Mechanism:
    """Crank, plate B-C-D on the rod A-B and two rockers C-E and D-F: the simplest class III."""
    return assur.Mechanism(
        joints={
            "O": (0, 0),
            "A": (0.3, 0.2),
            "B": (1, 2),
            "C": (2.5, 1.5),
            "D": (2, 3),
            "E": (4, 0),
            "F": (0, 4),
        },
        links={
            "ground": "OEF",
            "crank": "OA",
            "rod": "AB",
            "plate": "BCD",
            "right": "CE",
            "left": "DF",
        },
        driver="crank",
    )


def stephenson_reversed() -> assur.Mechanism:
    """Stephenson's six-bar driven by the rocker that its coupler plate hangs on by the rod.

    Class III then: rod, coupler, crank and rocker hang together. Driven by crank or rocker of its
    four-bar loop the same chain is of class II.
    """
    return assur.Mechanism(
        joints={
            "A": (0, 0),
            "B": (0.05, 0.06),
            "C": (0.2, 0.14),
            "D": (0.22, 0),
            "P": (0.12, 0.22),
            "Q": (0.02, 0.3),
            "G": (-0.12, 0.1),
        },
        links={
            "ground": "ADG",
            "input": "GQ",
            "rod": "QP",
            "coupler": "BCP",
            "crank": "AB",
            "rocker": "DC",
        },
        driver="input",
    )


def triad_press() -> assur.Mechanism:
    """A press: the plate hangs on rod and rocker; its third corner runs in a guide."""
    return assur.Mechanism(
        joints={
            "O": (0, 0),
            "A": (0.06, 0.03),
            "B": (0.3, 0.12),
            "C": (0.42, 0.3),
            "D": (0.5, 0.02),
            "E": (0.7, 0.42),
        },
        links={
            "ground": "OE",
            "crank": "OA",
            "rod": "AB",
            "plate": "BCD",
            "rocker": "EC",
            "ram": "D",
        },
        slides={"guide": assur.Slide("ram", on="ground", angle=-RIGHT_ANGLE)},
        driver="crank",
    )


def triad_two_guides() -> assur.Mechanism:
    """The plate's two other corners in straight guides of the frame: Cardan's motion, pushed."""
    return assur.Mechanism(
        joints={"O": (0, 0), "A": (0.1, 0.1), "B": (0.6, 0.5), "C": (1.0, 0.2), "D": (0.9, 0.9)},
        links={
            "ground": "O",
            "crank": "OA",
            "rod": "AB",
            "plate": "BCD",
            "lower": "C",
            "upper": "D",
        },
        slides={
            "floor": assur.Slide("lower", on="ground", angle=0.3),
            "wall": assur.Slide("upper", on="ground", angle=1.8),
        },
        driver="crank",
    )


def triad_slotted_plate() -> assur.Mechanism:
    """The plate has a slot that slides over a block pinned to the frame: the guide moves."""
    return assur.Mechanism(
        joints={
            "O": (0, 0),
            "A": (0.2, 0.1),
            "B": (0.9, 1.1),
            "C": (1.8, 0.9),
            "E": (2.6, 0),
            "F": (1.3, 1.9),
        },
        links={
            "ground": "OEF",
            "crank": "OA",
            "rod": "AB",
            "plate": "BC",
            "right": "CE",
            "block": "F",
        },
        slides={"slot": assur.Slide("block", on="plate", angle=0.7, origin="B")},
        driver="crank",
    )


def platform_on_cylinders() -> assur.Mechanism:
    """The planar platform on three cylinders (3-RPR): three drivers, a triad with legs of length q.

    C. Gosselin & J. Sefrioui (1991): up to six assemblies for given lengths.
    """
    return assur.Mechanism(
        joints={
            "A": (0, 0),
            "B": (2.2, 0.1),
            "C": (1.0, 1.9),
            "D": (0.8, 0.7),
            "E": (1.5, 0.75),
            "F": (1.1, 1.25),
        },
        links={
            "ground": "ABC",
            "tube1": "A",
            "tube2": "B",
            "tube3": "C",
            "rod1": "D",
            "rod2": "E",
            "rod3": "F",
            "platform": "DEF",
        },
        slides={
            "leg1": assur.Slide("rod1", on="tube1", angle=math.atan2(0.7, 0.8), origin="A"),
            "leg2": assur.Slide("rod2", on="tube2", angle=math.atan2(0.65, -0.7), origin="B"),
            "leg3": assur.Slide("rod3", on="tube3", angle=math.atan2(-0.65, 0.1), origin="C"),
        },
        driver=["leg1", "leg2", "leg3"],
    )


def platform_on_cranks() -> assur.Mechanism:
    """The planar manipulator with three cranks (3-RRR)."""
    return assur.Mechanism(
        joints={
            "A": (0, 0),
            "B": (2.4, 0),
            "C": (1.2, 2.1),
            "a": (0.1, 0.6),
            "b": (2.0, 0.45),
            "c": (1.7, 1.75),
            "D": (0.8, 0.7),
            "E": (1.5, 0.75),
            "F": (1.1, 1.25),
        },
        links={
            "ground": "ABC",
            "crank1": "Aa",
            "crank2": "Bb",
            "crank3": "Cc",
            "rod1": "aD",
            "rod2": "bE",
            "rod3": "cF",
            "platform": "DEF",
        },
        driver=["crank1", "crank2", "crank3"],
    )


# -- class IV: a closed quadrilateral that changes its form ---------------------------------------


def quadrilateral() -> assur.Mechanism:
    """Two ternary links and two bars between them: class IV, order 2."""
    return assur.Mechanism(
        joints={
            "O": (0, 0),
            "A": (0.3, 0.2),
            "P": (1, 2),
            "Q": (1.5, 0.7),
            "R": (2.5, 2.2),
            "S": (3, 0.5),
            "E": (4, 0.2),
        },
        links={
            "ground": "OE",
            "crank": "OA",
            "left": "APQ",
            "right": "ERS",
            "upper": "PR",
            "lower": "QS",
        },
        driver="crank",
    )


def quadrilateral_with_block() -> assur.Mechanism:
    """One of the two bars is a block that slides in the right link: a P pair in the contour."""
    return assur.Mechanism(
        joints={
            "O": (0, 0),
            "A": (0.3, 0.2),
            "P": (1, 2),
            "Q": (1.5, 0.7),
            "R": (2.5, 2.2),
            "E": (4, 0.2),
        },
        links={
            "ground": "OE",
            "crank": "OA",
            "left": "APQ",
            "right": "ER",
            "upper": "PR",
            "block": "Q",
        },
        slides={"slot": assur.Slide("block", on="right", angle=0.4)},
        driver="crank",
    )


def quadrilateral_on_guide() -> assur.Mechanism:
    """The right link slides on the frame instead of turning on it."""
    return assur.Mechanism(
        joints={
            "O": (0, 0),
            "A": (0.3, 0.2),
            "P": (1, 2),
            "Q": (1.5, 0.7),
            "R": (2.5, 2.2),
            "S": (3, 0.5),
        },
        links={
            "ground": "O",
            "crank": "OA",
            "left": "APQ",
            "ram": "RS",
            "upper": "PR",
            "lower": "QS",
        },
        slides={"guide": assur.Slide("ram", on="ground", angle=-0.2)},
        driver="crank",
    )


def loom() -> assur.Mechanism:
    """V. M. Dvorzhak's mechanism of class IV, order 3: six links, no dyad."""
    return assur.ClassIV(
        joints={
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
    )


# -- class V: a closed pentagon that changes its form ---------------------------------------------


def pentagon() -> assur.Mechanism:
    """Class V with eight links: rocker, bar, rocker, bar and plate make the closed pentagon.

    The two rockers with the bar between them are a four-bar; the plate on the first rocker, tied
    to the second by the other bar and to the crank by a rod, holds it.
    """
    return assur.Mechanism(
        joints={
            "O": (0, 0),
            "A": (0.12, 0.1),
            "B": (1.9, 2.9),
            "C": (0.6, 1.9),
            "D": (2.4, 3.4),
            "P": (2.0, 0.9),
            "Q": (3.6, 1.2),
            "R": (3.3, 2.2),
            "E": (0.5, 0.5),
            "F": (4.2, 0.2),
        },
        links={
            "ground": "OEF",
            "crank": "OA",
            "rod": "AC",
            "left": "EPB",
            "right": "FQR",
            "lower": "PQ",
            "plate": "BCD",
            "upper": "DR",
        },
        driver="crank",
    )


HIGHER: dict[str, Callable[[], assur.Mechanism]] = {
    make.__name__: make
    for make in (
        triad,
        stephenson_reversed,
        triad_press,
        triad_two_guides,
        triad_slotted_plate,
        platform_on_cylinders,
        platform_on_cranks,
        quadrilateral,
        quadrilateral_with_block,
        quadrilateral_on_guide,
        loom,
        pentagon,
    )
}
