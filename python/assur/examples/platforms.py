"""Planar platforms with three drivers, whose legs and platform are a triad (class III)."""

from __future__ import annotations

from assur._trig import arctan2
from assur.description.words import Slide
from assur.kinematics.mechanism import Mechanism

__all__ = ["platform_on_cranks", "platform_on_cylinders"]


def platform_on_cylinders() -> Mechanism:
    """The planar platform on three cylinders (3-RPR): up to six assemblies for given lengths.

    Base A, B, C of some 2 m, platform D, E, F of some 0.7 m. With the lengths of the legs given,
    legs and platform are a triad.

    Returns
    -------
    Mechanism
        Class III, three drivers; q are the lengths of the legs, m.

    References
    ----------
    C. M. Gosselin and J. Sefrioui, "Polynomial solutions for the direct kinematic problem of planar
    three-degree-of-freedom parallel manipulators", *5th International Conference on Advanced
    Robotics* (1991); own dimensions.

    Examples
    --------
    >>> import assur
    >>> m = assur.examples.platform_on_cylinders()
    >>> m.assemblies(m.q0).complex_count                                # Gosselin and Sefrioui: 6
    (6,)
    """
    joints = {
        "A": (0, 0),
        "B": (2.2, 0.1),
        "C": (1.0, 1.9),
        "D": (0.8, 0.7),
        "E": (1.5, 0.75),
        "F": (1.1, 1.25),
    }
    directions = arctan2([0.7, 0.65, -0.65], [0.8, -0.7, 0.1])
    return Mechanism(
        joints=joints,
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
            f"leg{number}": Slide(
                f"rod{number}", f"tube{number}", angle=float(direction), origin=base, length=True
            )
            for number, (base, direction) in enumerate(zip("ABC", directions, strict=True), 1)
        },
        driver=["leg1", "leg2", "leg3"],
    )


def platform_on_cranks() -> Mechanism:
    """The planar manipulator on three cranks (3-RRR).

    Base A, B, C of some 2.4 m, cranks of some 0.6 m, platform D, E, F of some 0.7 m. With the
    cranks given, rods and platform are a triad.

    Returns
    -------
    Mechanism
        Class III, three drivers; q are the angles of the cranks, rad.

    References
    ----------
    C. M. Gosselin and J. Angeles, "The optimum kinematic design of a planar
    three-degree-of-freedom parallel manipulator", *Journal of Mechanisms, Transmissions, and
    Automation in Design* 110 (1988); own dimensions.

    Examples
    --------
    >>> import assur
    >>> assur.examples.platform_on_cranks().structure.formula
    'I(crank1, crank2, crank3) → III(rod1, rod2, rod3, platform)'
    """
    return Mechanism(
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
