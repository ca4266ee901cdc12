"""Classes III, IV and V with one driver.

A group above class II has no dyad in it: take away any of its links and all of it is loose.
`stephenson_2` of the six-bars and the `platforms` have such groups too.
"""

from __future__ import annotations

from assur.kinematics.mechanism import Mechanism
from assur.mechanisms.class_iv import ClassIV

__all__ = ["loom", "pentagon", "stephenson_reversed", "triad"]


def triad() -> Mechanism:
    """Class III at its simplest: a plate on a rod and two rockers.

    Crank 0.36 m, plate B, C, D of some 1.6 m, rockers CE and DF of 2.1 m and 2.2 m. The crank turns
    fully. Look at ``assemblies``: up to six for one crank angle, as for every triad of turning
    pairs.

    Returns
    -------
    Mechanism
        Class III, order 3; q is the crank's angle, rad.

    References
    ----------
    I. I. Artobolevsky, *Theory of Mechanisms and Machines* (1988), groups of class III; own
    dimensions.

    Examples
    --------
    >>> import assur
    >>> m = assur.examples.triad()
    >>> found = m.assemblies(m.q0)
    >>> found.complex_count, len(found)
    ((6,), 2)
    """
    return Mechanism(
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


def stephenson_reversed() -> Mechanism:
    """Stephenson III driven by the rocker that its coupler plate hangs on by the rod: class III.

    Rod, coupler, crank and rocker hang together then. Driven by crank or rocker of its four-bar
    loop the same chain is of class II: the class depends on the driver. Crank 78 mm, rocker 141 mm.
    The input swings through 75° between its two dead points.

    Returns
    -------
    Mechanism
        Class III, order 3; q is the angle of the input rocker, rad.

    References
    ----------
    I. I. Artobolevsky, *Theory of Mechanisms and Machines* (1988), groups of class III; own
    dimensions.

    Examples
    --------
    >>> import assur
    >>> m = assur.examples.stephenson_reversed()
    >>> m.structure.cls, m.with_driver("crank").structure.cls
    (3, 2)
    """
    return Mechanism(
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


def loom() -> Mechanism:
    """V. M. Dvorzhak's mechanism of class IV, order 3: six links, no dyad.

    Three ternary links and a bar make a quadrilateral that changes its form, on two rockers. Crank
    0.35 m. The crank turns fully.

    Returns
    -------
    ClassIV
        Class IV, order 3; q is the crank's angle, rad.

    References
    ----------
    V. M. Dvorzhak, *Computer study of plane mechanisms of the fourth class* (in Ukrainian), which
    prints no lengths; own dimensions.

    Examples
    --------
    >>> import assur
    >>> found = assur.examples.loom().assemblies(1.0)
    >>> found.complex_count, len(found)
    ((16,), 2)
    """
    return ClassIV(
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


def pentagon() -> Mechanism:
    """Class V: two rockers, two bars and a plate make a closed pentagon that changes its form.

    The two rockers with the bar between them are a four-bar; the plate on the first rocker, tied to
    the second by the other bar and to the crank by a rod, holds it. Crank 0.16 m, ground EF 3.7 m.
    The crank turns through 198° between two dead points.

    Returns
    -------
    Mechanism
        Class V, order 3; q is the crank's angle, rad.

    References
    ----------
    I. I. Artobolevsky, *Theory of Mechanisms and Machines* (1988), groups by their closed contours;
    own dimensions.

    Examples
    --------
    >>> import assur
    >>> assur.examples.pentagon().structure.formula
    'I(crank) → V(rod, left, right, lower, plate, upper)'
    """
    return Mechanism(
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
