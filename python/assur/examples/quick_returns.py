"""Quick returns: a slotted lever turned or swung by a crank (dyads RPR and RRP)."""

from __future__ import annotations

import math

from assur.description.words import Slide
from assur.kinematics.mechanism import Mechanism

__all__ = ["shaper", "whitworth"]

RIGHT_ANGLE = math.pi / 2


def whitworth() -> Mechanism:
    """Whitworth's quick return: the slotted lever turns fully, because the crank passes round D.

    Crank 100 mm, OD 50 mm, DE 150 mm, rod 390 mm: the ram, its bed in line with D, goes out during
    240° of the crank and back during 120° (time ratio 2). Stroke 300 mm, twice DE.

    Returns
    -------
    Mechanism
        Class II; q is the crank's angle, rad.

    References
    ----------
    J. J. Uicker, G. R. Pennock and J. E. Shigley, *Theory of Machines and Mechanisms*,
    quick-return mechanisms; own dimensions.

    Examples
    --------
    >>> import assur
    >>> ram = assur.examples.whitworth().extremes("bed")
    >>> round(ram.stroke, 9), round(ram.time_ratio, 9)
    (0.3, 2.0)
    """
    return Mechanism(
        joints={"O": (0, 0), "A": (0, 0.1), "D": (0, -0.05), "E": (0, -0.2), "F": (0.36, -0.05)},
        links={
            "ground": "OD",
            "crank": "OA",
            "block": "A",
            "lever": "DE",
            "rod": "EF",
            "ram": "F",
        },
        slides={
            "slot": Slide("block", on="lever", angle=RIGHT_ANGLE, origin="D"),
            "bed": Slide("ram", on="ground", angle=0.0, origin="D"),
        },
        driver="crank",
    )


def shaper() -> Mechanism:
    """Crank-shaper: as `whitworth` with the crank shorter than OD, so that the lever swings.

    Crank 100 mm, OD 200 mm, DE 400 mm, rod 150 mm: the lever swings 30° to either side, out during
    240° and back during 120° of the crank (time ratio 2). Stroke 400 mm.

    Returns
    -------
    Mechanism
        Class II; q is the crank's angle, rad.

    References
    ----------
    J. J. Uicker, G. R. Pennock and J. E. Shigley, *Theory of Machines and Mechanisms*,
    quick-return mechanisms; own dimensions.

    Examples
    --------
    >>> import assur
    >>> ram = assur.examples.shaper().extremes("bed")
    >>> round(ram.stroke, 9), round(ram.time_ratio, 9)
    (0.4, 2.0)
    """
    end = (math.sqrt(0.15**2 - 0.03**2), 0.17)
    return Mechanism(
        joints={"O": (0, 0), "A": (0, 0.1), "D": (0, -0.2), "E": (0, 0.2), "F": end},
        links={
            "ground": "OD",
            "crank": "OA",
            "block": "A",
            "lever": "DE",
            "rod": "EF",
            "ram": "F",
        },
        slides={
            "slot": Slide("block", on="lever", angle=RIGHT_ANGLE, origin="D"),
            "bed": Slide("ram", on="ground", angle=0.0, origin="O"),
        },
        driver="crank",
    )
