"""Cranks and slides: engine, Scotch yoke, tangent generator, elliptic trammel, Oldham's coupling.

Together they have the dyads RRP, RPP and PRP.
"""

from __future__ import annotations

import math

from assur.description.words import Slide
from assur.kinematics.mechanism import Mechanism
from assur.mechanisms.named import SliderCrank

__all__ = ["engine", "oldham", "scotch_yoke", "tangent_generator", "trammel"]

RIGHT_ANGLE = math.pi / 2


def engine() -> Mechanism:
    """Central slider-crank of a car's engine.

    Crank 45 mm (stroke 90 mm), rod 150 mm (λ = 0.3). Drawn at its outer dead point, all joints in
    line with the bore. Look at the piston's acceleration ``slide("bore").d2``: it is greater at the
    outer dead point, by (1 + λ) / (1 − λ).

    Returns
    -------
    Mechanism
        Class II; q is the crank's angle, rad.

    References
    ----------
    J. J. Uicker, G. R. Pennock and J. E. Shigley, *Theory of Machines and Mechanisms*,
    slider-crank; own dimensions.

    Examples
    --------
    >>> import assur
    >>> bore = assur.examples.engine().solve(deg=[0, 180]).slide("bore")
    >>> bore.value, (bore.d2 / 0.045).round(6)                           # −(1 + λ), 1 − λ
    (array([0.195, 0.105]), array([-1.3,  0.7]))
    """
    return SliderCrank(crank=0.045, rod=0.15)


def scotch_yoke() -> Mechanism:
    """Scotch yoke: its motion is a pure cosine.

    Crank 50 mm. The yoke has no joint at all: two slides place it, on the crank pin's block and on
    the bed. A dyad of the fifth kind (RPP), with one solution everywhere.

    Returns
    -------
    Mechanism
        Class II; q is the crank's angle, rad.

    References
    ----------
    J. J. Uicker, G. R. Pennock and J. E. Shigley, *Theory of Machines and Mechanisms*, Scotch
    yoke; own dimensions.

    Examples
    --------
    >>> import assur
    >>> bed = assur.examples.scotch_yoke().solve(deg=60).slide("bed")
    >>> bed.value.round(9), bed.d2.round(9)                              # 50 mm · cos 60°
    (np.float64(0.025), np.float64(-0.025))
    """
    return Mechanism(
        joints={"O": (0, 0), "A": (0.03, 0.04)},
        links={"ground": "O", "crank": "OA", "block": "A", "yoke": ""},
        slides={
            "slot": Slide("yoke", on="block", angle=RIGHT_ANGLE, origin="A"),
            "bed": Slide("yoke", on="ground", angle=0.0, origin="O"),
        },
        driver="crank",
    )


def tangent_generator() -> Mechanism:
    """Tangent generator of a computing linkage: a slotted lever moves a pin on a rail by tan q.

    The rail is 100 mm from the lever's pivot. A dyad of the fourth kind (PRP): two blocks on one
    pin. At q = ±90° the lever is parallel to the rail and no position exists.

    Returns
    -------
    Mechanism
        Class II; q is the lever's angle, rad.

    References
    ----------
    I. I. Artobolevsky, *Mechanisms in Modern Engineering Design*, tangent mechanisms; own
    dimensions.

    Examples
    --------
    >>> import assur
    >>> rail = assur.examples.tangent_generator().solve(deg=[-45, 0, 45]).slide("rail")
    >>> rail.value.round(9) + 0.0
    array([-0.1,  0. ,  0.1])
    """
    return Mechanism(
        joints={"O": (0, 0), "A": (0.1, 0), "H": (0.1, 0)},
        links={"ground": "OH", "lever": "O", "block": "A", "cursor": "A"},
        slides={
            "slot": Slide("block", on="lever", angle=0.0, origin="O"),
            "rail": Slide("cursor", on="ground", angle=RIGHT_ANGLE, origin="H"),
        },
        driver="lever",
    )


def trammel() -> Mechanism:
    """Elliptic trammel (of Archimedes), driven by its bar.

    A slides along x, B along y, 120 mm apart; P, 200 mm from B, traces the ellipse with the half
    axes BP = 200 mm and AP = 80 mm. The bar's angle is the ellipse's parameter;
    ``with_driver("x")`` drives it by a block.

    Returns
    -------
    Mechanism
        Class II; q is the bar's angle, rad.

    References
    ----------
    F. Reuleaux, *The Kinematics of Machinery* (1876); own dimensions.

    Examples
    --------
    >>> import assur
    >>> x, y = assur.examples.trammel().solve([0.0, 1.0, 2.0]).joint("P").value.T
    >>> ((x / 0.2)**2 + (y / 0.08)**2).round(12)
    array([1., 1., 1.])
    """
    return Mechanism(
        joints={"O": (0, 0), "A": (0.096, 0), "B": (0, 0.072), "P": (0.16, -0.048)},
        links={"ground": "O", "x_block": "A", "y_block": "B", "bar": "BAP"},
        slides={
            "x": Slide("x_block", on="ground", angle=0.0, origin="O"),
            "y": Slide("y_block", on="ground", angle=RIGHT_ANGLE, origin="O"),
        },
        driver="bar",
    )


def oldham() -> Mechanism:
    """Oldham's coupling of two parallel shafts that are not in line.

    The shafts are 20 mm apart. A disc without joints has two tongues at right angles, each in a
    groove of one shaft. Both shafts turn alike; look at the tongues: the disc's centre goes twice
    round a circle over the distance of the shafts while they turn once.

    Returns
    -------
    Mechanism
        Class II; q is the angle of shaft1, rad.

    References
    ----------
    J. Oldham (1821), in F. Reuleaux, *The Kinematics of Machinery* (1876); own dimensions.

    Examples
    --------
    >>> import assur
    >>> motion = assur.examples.oldham().solve([0.0, 1.0, 5.0])
    >>> motion.link("shaft2").d1                                         # ratio of the speeds
    array([1., 1., 1.])
    """
    return Mechanism(
        joints={"O1": (0, 0), "O2": (0.02, 0)},
        links={"ground": ["O1", "O2"], "shaft1": ["O1"], "disc": [], "shaft2": ["O2"]},
        slides={
            "tongue1": Slide("disc", on="shaft1", angle=0.5, origin="O1"),
            "tongue2": Slide("disc", on="shaft2", angle=0.5 + RIGHT_ANGLE, origin="O2"),
        },
        driver="shaft1",
    )
