"""Mechanisms of class III and IV for tests alone: sliding pairs at every place of a group.

Most of them do not turn fully; those that show something to a user are in `assur.examples`.
"""

from __future__ import annotations

import math

import assur

__all__ = [
    "quadrilateral",
    "quadrilateral_on_guide",
    "quadrilateral_with_block",
    "triad_press",
    "triad_slotted_plate",
    "triad_two_guides",
]

RIGHT_ANGLE = math.pi / 2


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
