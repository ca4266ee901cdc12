"""The six-bars: Watt's chain on two of its links, Stephenson's on three.

A six-bar chain of turning pairs has two ternary links. They share a joint in Watt's chain and not
in Stephenson's; the number says which link is the ground.
"""

from __future__ import annotations

from assur.examples.fourbars import COUPLER_POINT, FOUR_BAR
from assur.kinematics.mechanism import Mechanism

__all__ = ["stephenson_1", "stephenson_2", "stephenson_3", "watt_1", "watt_2"]


def watt_1() -> Mechanism:
    """Watt I: the ground is a binary link; a second four-bar rides on coupler and rocker.

    The first four-bar is `crank_rocker` (40, 120, 80, 100 mm). Look at S: the second loop C, P, S,
    Q moves as a whole.

    Returns
    -------
    Mechanism
        Class II; q is the crank's angle, rad.

    References
    ----------
    G. N. Sandor and A. G. Erdman, *Advanced Mechanism Design: Analysis and Synthesis*, vol. 2
    (1984), six-bar chains; own dimensions.

    Examples
    --------
    >>> import assur
    >>> assur.examples.watt_1().structure.formula
    'I(crank) → II(coupler, rocker) → II(link, arm)'
    """
    return Mechanism(
        joints={**FOUR_BAR, "P": COUPLER_POINT, "Q": (0.15, 0.09), "S": (0.11, 0.17)},
        links={
            "ground": "AD",
            "crank": "AB",
            "coupler": "BCP",
            "rocker": "DCQ",
            "link": "PS",
            "arm": "QS",
        },
        driver="crank",
    )


def watt_2() -> Mechanism:
    """Watt II: the ground is a ternary link; two four-bars in series.

    The first is that of `crank_rocker` (40, 120, 80, 100 mm); its rocker, a lever with the arm DE
    of 100 mm, drives the second one, whose link and rocker are 63 mm long. Look at the rocker: it
    swings farther than the lever.

    Returns
    -------
    Mechanism
        Class II; q is the crank's angle, rad.

    References
    ----------
    G. N. Sandor and A. G. Erdman, *Advanced Mechanism Design: Analysis and Synthesis*, vol. 2
    (1984), six-bar chains; own dimensions.

    Examples
    --------
    >>> import assur, numpy as np
    >>> m = assur.examples.watt_2()
    >>> [round(float(np.degrees(m.extremes(link).stroke)), 1) for link in ("lever", "rocker")]
    [73.8, 81.9]
    """
    return Mechanism(
        joints={**FOUR_BAR, "E": (0.2, 0), "F": (0.22, 0.06), "G": (0.24, 0)},
        links={
            "ground": "ADG",
            "crank": "AB",
            "coupler": "BC",
            "lever": "DCE",
            "link": "EF",
            "rocker": "GF",
        },
        driver="crank",
    )


def stephenson_1() -> Mechanism:
    """Stephenson I: both ternary links, crank and rocker, turn on the ground.

    The four-bar of `crank_rocker` (40, 120, 80, 100 mm), with a second pin E on the crank and F on
    the rocker, and a dyad S between them. Look at the path of S, on no link of the four-bar.

    Returns
    -------
    Mechanism
        Class II; q is the crank's angle, rad.

    References
    ----------
    G. N. Sandor and A. G. Erdman, *Advanced Mechanism Design: Analysis and Synthesis*, vol. 2
    (1984), six-bar chains; own dimensions.

    Examples
    --------
    >>> import assur
    >>> assur.examples.stephenson_1().structure.formula
    'I(crank) → II(coupler, rocker) → II(link1, link2)'
    """
    return Mechanism(
        joints={**FOUR_BAR, "E": (-0.03, 0.02), "F": (0.16, 0.07), "S": (0.07, 0.16)},
        links={
            "ground": "AD",
            "crank": "ABE",
            "coupler": "BC",
            "rocker": "DCF",
            "link1": "ES",
            "link2": "FS",
        },
        driver="crank",
    )


def stephenson_2() -> Mechanism:
    """Stephenson II: one ternary link turns on the ground, the other is the crank's coupler.

    Crank 40 mm, ground 200 mm, rocker DE 103 mm. Driven by the binary crank the other four links
    have no dyad: class IV, a quadrilateral C, E, G, F that changes its form. The crank turns fully.

    Returns
    -------
    Mechanism
        Class IV, order 2; q is the crank's angle, rad.

    References
    ----------
    G. N. Sandor and A. G. Erdman, *Advanced Mechanism Design: Analysis and Synthesis*, vol. 2
    (1984), six-bar chains; own dimensions.

    Examples
    --------
    >>> import assur
    >>> m = assur.examples.stephenson_2()
    >>> m.structure.formula, m.limits().full_rotation
    ('I(crank) → IV(plate, rocker, lower, upper)', True)
    """
    return Mechanism(
        joints={
            "A": (0, 0),
            "B": (0, 0.04),
            "C": (0.1, 0.03),
            "F": (0.06, 0.11),
            "D": (0.2, 0),
            "E": (0.15, 0.09),
            "G": (0.2, 0.11),
        },
        links={
            "ground": "AD",
            "crank": "AB",
            "plate": "BCF",
            "rocker": "DEG",
            "lower": "CE",
            "upper": "FG",
        },
        driver="crank",
    )


def stephenson_3() -> Mechanism:
    """Stephenson III: the ground is a ternary link; a coupler point swings a lever at E.

    The four-bar of `crank_rocker` (40, 120, 80, 100 mm); link 160 mm, lever 100 mm. Driven by the
    lever it would be of class III (`stephenson_reversed`).

    Returns
    -------
    Mechanism
        Class II; q is the crank's angle, rad.

    References
    ----------
    G. N. Sandor and A. G. Erdman, *Advanced Mechanism Design: Analysis and Synthesis*, vol. 2
    (1984), six-bar chains; own dimensions.

    Examples
    --------
    >>> import assur
    >>> m = assur.examples.stephenson_3()
    >>> m.structure.formula
    'I(crank) → II(coupler, rocker) → II(link, lever)'
    >>> m.with_driver("lever").structure.formula
    'I(lever) → III(crank, coupler, rocker, link)'
    """
    # S is 160 mm from P and 100 mm from E; all digits, so that the drawing is the same everywhere.
    end = (0.18721181772432, 0.14973960940925723)
    return Mechanism(
        joints={**FOUR_BAR, "P": COUPLER_POINT, "E": (0.18, 0.05), "S": end},
        links={
            "ground": "ADE",
            "crank": "AB",
            "coupler": "BCP",
            "rocker": "DC",
            "link": "PS",
            "lever": "ES",
        },
        driver="crank",
    )
