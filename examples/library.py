"""A library of named mechanisms, used by tests, benches and documentation.

Every function draws one mechanism, in metres; all are of class II and together have dyads of
all five kinds. `LIBRARY` has them by name, `RANGES` the coordinates over which each is used.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, TypeAlias

import assur

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["LIBRARY", "RANGES"]

Place: TypeAlias = tuple[float, float]
Coordinate: TypeAlias = float | tuple[float, ...]

RIGHT_ANGLE = math.pi / 2


def _meet(a: Place, from_a: float, b: Place, from_b: float) -> Place:
    """Return the place with these distances from a and b, to the left of the ray a → b."""
    s = math.dist(a, b)
    x, y = (b[0] - a[0]) / s, (b[1] - a[1]) / s
    along = (s * s + from_a**2 - from_b**2) / (2 * s)
    up = math.sqrt(from_a**2 - along**2)
    return (a[0] + along * x - up * y, a[1] + along * y + up * x)


# -- four-bars and slider-cranks ------------------------------------------------------------------

_FOUR_BAR = {"A": (0.0, 0.0), "B": (0.0, 0.04), "D": (0.1, 0.0)}
_FOUR_BAR["C"] = _meet(_FOUR_BAR["B"], 0.12, _FOUR_BAR["D"], 0.08)
_COUPLER_POINT = (0.03, 0.12)


def crank_rocker() -> assur.Mechanism:
    """Crank-rocker four-bar with a coupler point P.

    Crank 40 mm, coupler 120, rocker 80, ground 100: a textbook's round numbers. By Grashof
    40 + 120 < 80 + 100, and the shortest link is the crank: it turns fully, the rocker swings.
    """
    return assur.Mechanism(
        joints={**_FOUR_BAR, "P": _COUPLER_POINT},
        links={"ground": "AD", "crank": "AB", "coupler": "BCP", "rocker": "DC"},
        driver="crank",
    )


def chebyshev_lambda() -> assur.Mechanism:
    """Chebyshev's lambda linkage: P moves almost on a straight line for half a turn.

    Chebyshev's proportions: crank 1, ground 2, coupler half, its other half and rocker 2.5
    (Artobolevsky, *Mechanisms in Modern Engineering Design*); unit 50 mm. C is as far
    from B as from D and P, so that BD and DP are at right angles (Thales).
    """
    return assur.Mechanism(
        joints={"A": (0, 0), "B": (-0.05, 0), "C": (0.025, 0.1), "D": (0.1, 0), "P": (0.1, 0.2)},
        links={"ground": "AD", "crank": "AB", "coupler": "BCP", "rocker": "DC"},
        driver="crank",
    )


def engine() -> assur.Mechanism:
    """Central slider-crank of a car's engine: stroke 90 mm, rod 150 mm (λ = 0.3).

    Drawn at its outer dead point, all joints in line with the bore.
    """
    return assur.SliderCrank(crank=0.045, rod=0.15)


# -- slotted levers and slides --------------------------------------------------------------------


def whitworth() -> assur.Mechanism:
    """Whitworth's quick return: the slotted lever turns fully, because the crank passes round D.

    Crank 100 mm, OD 50 mm: the ram, its bed in line with D, goes out during 240° of the crank
    and back during 120° (time ratio 2; formula: Uicker, Pennock and Shigley, *Theory of Machines
    and Mechanisms*, quick-return mechanisms). Stroke 300 mm, twice DE.
    """
    return assur.Mechanism(
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
            "slot": assur.Slide("block", on="lever", angle=RIGHT_ANGLE, origin="D"),
            "bed": assur.Slide("ram", on="ground", angle=0.0, origin="D"),
        },
        driver="crank",
    )


def shaper() -> assur.Mechanism:
    """Crank-shaper: as `whitworth` with the crank shorter than OD, so that the lever swings.

    Crank 100 mm, OD 200 mm: the lever swings 30° to either side, out during 240° and back
    during 120° of the crank (time ratio 2; Uicker, Pennock and Shigley as above). Stroke 400 mm.
    """
    end = (math.sqrt(0.15**2 - 0.03**2), 0.17)
    return assur.Mechanism(
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
            "slot": assur.Slide("block", on="lever", angle=RIGHT_ANGLE, origin="D"),
            "bed": assur.Slide("ram", on="ground", angle=0.0, origin="O"),
        },
        driver="crank",
    )


def scotch_yoke() -> assur.Mechanism:
    """Scotch yoke, crank 50 mm: the yoke's motion is a pure cosine.

    The yoke has no joint at all: two slides place it, on the crank pin's block and on the bed.
    A dyad of the fifth kind (RPP), with one solution everywhere.
    """
    return assur.Mechanism(
        joints={"O": (0, 0), "A": (0.03, 0.04)},
        links={"ground": "O", "crank": "OA", "block": "A", "yoke": ""},
        slides={
            "slot": assur.Slide("yoke", on="block", angle=RIGHT_ANGLE, origin="A"),
            "bed": assur.Slide("yoke", on="ground", angle=0.0, origin="O"),
        },
        driver="crank",
    )


def tangent_generator() -> assur.Mechanism:
    """Tangent generator: a slotted lever moves a pin on a rail 100 mm away; it rises by tan q.

    After the tangent mechanisms of computing linkages (Artobolevsky). A dyad of the
    fourth kind (PRP): two blocks on one pin. Nothing to be had at q = ±90°, where the lever is
    parallel to the rail.
    """
    return assur.Mechanism(
        joints={"O": (0, 0), "A": (0.1, 0), "H": (0.1, 0)},
        links={"ground": "OH", "lever": "O", "block": "A", "cursor": "A"},
        slides={
            "slot": assur.Slide("block", on="lever", angle=0.0, origin="O"),
            "rail": assur.Slide("cursor", on="ground", angle=RIGHT_ANGLE, origin="H"),
        },
        driver="lever",
    )


def trammel() -> assur.Mechanism:
    """Elliptic trammel (of Archimedes), driven by its bar.

    A slides along x, B along y, 120 mm apart; P, 200 mm from B, traces the ellipse with the
    half axes BP = 200 mm and AP = 80 mm. The bar's angle is the ellipse's parameter;
    `with_driver("x")` drives it by a block.
    """
    return assur.Mechanism(
        joints={"O": (0, 0), "A": (0.096, 0), "B": (0, 0.072), "P": (0.16, -0.048)},
        links={"ground": "O", "x_block": "A", "y_block": "B", "bar": "BAP"},
        slides={
            "x": assur.Slide("x_block", on="ground", angle=0.0, origin="O"),
            "y": assur.Slide("y_block", on="ground", angle=RIGHT_ANGLE, origin="O"),
        },
        driver="bar",
    )


# -- six-bars and legs ----------------------------------------------------------------------------


def watt_six_bar() -> assur.Mechanism:
    """Watt's six-bar chain: a second four-bar C, P, S, Q on the first one's coupler and rocker.

    The first four-bar is `crank_rocker`. The ternary links share joint C: Watt's chain, not
    Stephenson's (Uicker, Pennock and Shigley, six-bar chains).
    """
    return assur.Mechanism(
        joints={**_FOUR_BAR, "P": _COUPLER_POINT, "Q": (0.15, 0.09), "S": (0.11, 0.17)},
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


def stephenson_six_bar() -> assur.Mechanism:
    """Stephenson's six-bar chain (III): the coupler point of `crank_rocker` swings a lever at E.

    The ternary links, coupler and ground, share no joint. Link 160 mm, lever 100 mm.
    """
    pivot = (0.18, 0.05)
    end = _meet(_COUPLER_POINT, 0.16, pivot, 0.1)
    return assur.Mechanism(
        joints={**_FOUR_BAR, "P": _COUPLER_POINT, "E": pivot, "S": end},
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


def jansen_leg() -> assur.Mechanism:
    """Leg of Theo Jansen's beach animals; foot F.

    His "holy numbers" (*The Great Pretender*, 2007; crank 15, a 38, b 41.5, …), here cm, as a
    drawing rounded to a tenth of a millimetre. The lower dyad does not depend on the upper one.
    """
    places = {
        "O": (0.0, 0.0),
        "M": (9.61, 11.52),
        "B": (-38.0, -7.8),
        "T": (-35.24, 33.61),
        "W": (-77.75, -2.54),
        "L": (-20.1, -42.79),
        "K": (-56.05, -35.42),
        "F": (-22.22, -91.74),
    }
    return assur.Mechanism(
        joints={name: (x / 100, y / 100) for name, (x, y) in places.items()},
        links={
            "ground": "OB",
            "crank": "OM",
            "upper_rod": "MT",
            "upper": "BTW",
            "lower_rod": "ML",
            "lower_rocker": "BL",
            "link": "WK",
            "foot": "LKF",
        },
        driver="crank",
    )


def klann_leg() -> assur.Mechanism:
    """Leg of Joe Klann's mechanical spider; foot F.

    The example of US patent 6,260,862, whose unit is the stride, with a stride of 0.5 m: drawn
    in its position X, with the foot at one end of the stride. E elbow, K knee, H hip. For half a
    turn the foot's height changes by 0.055 strides only; it is lifted by 0.53.
    """
    places = {
        "O": (1.599, 0.750),
        "U": (1.366, 1.366),
        "L": (1.009, 0.574),
        "M": (1.331, 0.750),
        "E": (0.741, 0.750),
        "K": (0.232, 0.866),
        "H": (0.866, 1.500),
        "F": (0.0, 0.0),
    }
    return assur.Mechanism(
        joints={name: (x / 2, y / 2) for name, (x, y) in places.items()},
        links={
            "ground": "OUL",
            "crank": "OM",
            "rod": "MEK",
            "lower_rocker": "LE",
            "upper_rocker": "UH",
            "leg": "HKF",
        },
        driver="crank",
    )


# -- exact straight lines -------------------------------------------------------------------------


def peaucellier() -> assur.Mechanism:
    """Peaucellier and Lipkin's inversor: the first planar linkage to draw an exact line (1864).

    Arms OA, OC 250 mm, rhombus A, B, C, P 170 mm: OB · OP = 0.25² − 0.17². B runs on a circle
    through O (crank QB = QO = 60 mm), so that P runs on the line x = 280 mm. It closes for
    cos(q/2) ≥ (0.25 − 0.17)/(2 · 0.06), |q| ≤ 96.4°.
    """
    return assur.Mechanism(
        joints={
            "O": (0, 0),
            "Q": (0.06, 0),
            "B": (0.12, 0),
            "A": (0.2, 0.15),
            "C": (0.2, -0.15),
            "P": (0.28, 0),
        },
        links={
            "ground": "OQ",
            "crank": "QB",
            "arm1": "OA",
            "arm2": "OC",
            "side1": "BA",
            "side2": "BC",
            "side3": "AP",
            "side4": "CP",
        },
        driver="crank",
    )


def hart() -> assur.Mechanism:
    """Hart's inversor: the same line with four bars of a crossed parallelogram (1874).

    Bars AB = CD = 200 mm, AD = BC = 130 mm; O, P, Q in the middles of AD, AB, CD are in line and
    OP · OQ = (0.2² − 0.13²)/4. The crank MP = MO = 52.5 mm leads P round a circle through O, so
    that Q runs on x = 55 mm. It closes for cos(q/2) ≥ 1/3, |q| ≤ 141°.
    """
    return assur.Mechanism(
        joints={
            "O": (0, 0),
            "M": (0.0525, 0),
            "P": (0.105, 0),
            "A": (0.025, 0.06),
            "B": (0.185, -0.06),
            "C": (0.135, 0.06),
            "D": (-0.025, -0.06),
            "Q": (0.055, 0),
        },
        links={
            "ground": "OM",
            "crank": "MP",
            "short1": "ADO",
            "long1": "ABP",
            "short2": "BC",
            "long2": "CDQ",
        },
        driver="crank",
    )


# -- machines -------------------------------------------------------------------------------------


def excavator() -> assur.Mechanism:
    """Arm of a 20 t excavator, three cylinders: boom, stick and bucket; q are their lengths.

    Round numbers of the class (boom 5.5 m, stick 2.9 m, bucket 1.4 m). The bucket hangs on a
    four-bar (rocker, link) whose joint `knuckle` joins three links.
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
    return assur.Mechanism(
        joints=joints,
        links=links,
        slides={
            f"{name}_cylinder": assur.Cylinder(
                f"{name}_base", end, barrel=f"{name}_barrel", rod=f"{name}_rod"
            )
            for name, end in ends.items()
        },
        driver=[f"{name}_cylinder" for name in ends],
    )


def toggle_press() -> assur.Mechanism:
    """Toggle press: crank, rod and two toggle links of 200 mm; the ram's force has no bound.

    The arrangement of Artobolevsky (knee-lever presses) and of Uicker, Pennock and Shigley
    (toggle positions), own dimensions. Drawn at its toggle, q = π: crank and rod are stretched
    where both toggle links are in line with the ram, so that the ram's distance from its lowest
    place is of the fourth order: it dwells.
    """
    return assur.Mechanism(
        joints={"O": (0.3, -0.2), "A": (0.25, -0.2), "B": (0, -0.2), "C": (0, -0.4), "D": (0, 0)},
        links={
            "ground": "OD",
            "crank": "OA",
            "rod": "AB",
            "upper": "DB",
            "lower": "BC",
            "ram": "C",
        },
        slides={"guide": assur.Slide("ram", on="ground", angle=-RIGHT_ANGLE, origin="D")},
        driver="crank",
    )


LIBRARY: dict[str, Callable[[], assur.Mechanism]] = {
    make.__name__: make
    for make in (
        *(crank_rocker, chebyshev_lambda, engine),
        *(whitworth, shaper, scotch_yoke, tangent_generator, trammel),
        *(watt_six_bar, stephenson_six_bar, jansen_leg, klann_leg),
        *(peaucellier, hart, excavator, toggle_press),
    )
}
"""The mechanisms by name."""

RANGES: dict[str, tuple[Coordinate, Coordinate]] = {
    **dict.fromkeys(LIBRARY, (0.0, math.tau)),
    "tangent_generator": (-1.4, 1.4),
    "peaucellier": (-1.6, 1.6),
    "hart": (-2.3, 2.3),
    "excavator": ((2.5, 2.0, 2.0), (3.3, 2.9, 2.65)),
}
"""From and to which q they are used, rad or m (of several drivers a tuple): mostly one turn."""
