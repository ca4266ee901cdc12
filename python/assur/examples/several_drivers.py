"""Several drivers and dyads: pantograph and five-bar with two drivers, excavator with three."""

from __future__ import annotations

import math

from assur.description.words import Cylinder, Slide
from assur.kinematics.mechanism import Mechanism

__all__ = ["excavator", "five_bar", "pantograph"]

RIGHT_ANGLE = math.pi / 2


def pantograph() -> Mechanism:
    """Pantograph: the pen P draws three times as large what the tracer T follows.

    O is the fixed pole. OA = 150 mm, OB = 450 mm, and ABCT is a parallelogram, so that O, T and P
    are always in line, OP = 3 · OT. Two slides lead the tracer: q is its place (x, y).

    Returns
    -------
    Mechanism
        Class II, two drivers; q are the coordinates of T, m.

    References
    ----------
    C. Scheiner, *Pantographice seu ars delineandi* (1631); own dimensions.

    Examples
    --------
    >>> import assur
    >>> motion = assur.examples.pantograph().solve([[0.18, 0.05], [0.12, 0.1]])
    >>> motion.joint("P").value.round(9)
    array([[0.54, 0.15],
           [0.36, 0.3 ]])
    """
    return Mechanism(
        joints={
            "O": (0, 0),
            "A": (0.09, 0.12),
            "B": (0.27, 0.36),
            "C": (0.36, 0.24),
            "T": (0.18, 0),
            "P": (0.54, 0),
        },
        links={
            "ground": "O",
            "arm": "OAB",
            "pen_arm": "BCP",
            "inner": "AT",
            "outer": "CT",
            "carriage": "",
            "tracer": "T",
        },
        slides={
            "x": Slide("carriage", on="ground", angle=0.0, origin="O"),
            "y": Slide("tracer", on="carriage", angle=RIGHT_ANGLE),
        },
        driver=("x", "y"),
    )


def five_bar() -> Mechanism:
    """Symmetrical five-bar: two cranks lead the point P over a plane.

    Cranks 250 mm, rods 300 mm, pivots 220 mm apart. The pick-and-place robots of this form have
    both motors on the ground. Where the rods are in line the cranks no longer hold P
    (``singular_loci``).

    Returns
    -------
    Mechanism
        Class II, two drivers; q are the angles of the cranks, rad.

    References
    ----------
    X.-J. Liu, J. Wang and G. Pritschow, "Kinematics, singularity and workspace of planar 5R
    symmetrical parallel mechanisms", *Mechanism and Machine Theory* 41 (2006); own dimensions.

    Examples
    --------
    >>> import assur
    >>> point = assur.examples.five_bar().solve(deg=[90, 90]).joint("P").value
    >>> point.round(6)                                                  # y = 0.25 + √(0.3² − 0.11²)
    array([0.11    , 0.529106])
    """
    return Mechanism(
        joints={
            "A": (0, 0),
            "B": (-0.07, 0.24),
            "P": (0.11, 0.48),
            "D": (0.29, 0.24),
            "E": (0.22, 0),
        },
        links={
            "ground": "AE",
            "left": "AB",
            "left_rod": "BP",
            "right_rod": "DP",
            "right": "ED",
        },
        driver=("left", "right"),
    )


def excavator() -> Mechanism:
    """Arm of a 20 t excavator on three cylinders: boom, stick and bucket.

    Boom 5.5 m, stick 2.9 m, bucket 1.4 m: round numbers of the class. The bucket hangs on a
    four-bar (rocker, link) whose joint ``knuckle`` joins three links. Look at the path of the tip
    while one cylinder after the other moves.

    Returns
    -------
    Mechanism
        Class II, three drivers; q are the lengths of the cylinders, m.

    References
    ----------
    Own dimensions, of the size of makers' data sheets.

    Examples
    --------
    >>> import assur
    >>> m = assur.examples.excavator()
    >>> m.structure.mobility, m.q0.round(3)
    (3, array([2.843, 2.558, 2.148]))
    """
    joints = {
        "foot": (0.0, 0.0),
        "boom_base": (0.55, -0.45),
        "boom_eye": (2.35, 1.75),
        "elbow": (5.2, 1.9),
        "stick_base": (2.9, 2.75),
        "stick_eye": (5.45, 2.55),
        "wrist": (4.6, -0.9),
        "bucket_base": (5.65, 1.75),
        "rocker_pin": (4.75, -0.45),
        "knuckle": (5.2, -0.35),
        "bucket_eye": (5.0, -0.95),
        "tip": (4.0, -2.15),
    }
    ends = {"boom": "boom_eye", "stick": "stick_eye", "bucket": "knuckle"}
    links = {
        "ground": ["foot", "boom_base"],
        "boom": ["foot", "elbow", "boom_eye", "stick_base"],
        "stick": ["elbow", "wrist", "stick_eye", "bucket_base", "rocker_pin"],
        "rocker": ["rocker_pin", "knuckle"],
        "link": ["knuckle", "bucket_eye"],
        "bucket": ["wrist", "bucket_eye", "tip"],
    }
    return Mechanism(
        joints=joints,
        links=links,
        slides={
            f"{name}_cylinder": Cylinder(
                f"{name}_base", end, barrel=f"{name}_barrel", rod=f"{name}_rod"
            )
            for name, end in ends.items()
        },
        driver=[f"{name}_cylinder" for name in ends],
    )
