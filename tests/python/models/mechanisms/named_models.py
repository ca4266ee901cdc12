"""Named mechanisms for tests, and structures to be refused."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from models.mechanisms.mechanism_data import GROUND, Description, DriverSpec, SlideSpec

if TYPE_CHECKING:
    from collections.abc import Callable

Place = tuple[float, float]


def _bars(joints: dict[str, Place], links: dict[str, str], *drivers: DriverSpec) -> Description:
    """Links written as strings of one-letter joints; the ground is `ground`."""
    return Description(joints, {n: list(js) for n, js in links.items()}, {}, list(drivers))


_CRANK: DriverSpec = ("angle", "crank", GROUND)


def four_bar(
    crank: float, coupler: float, rocker: float, ground: float, q: float = 1.0, sign: int = -1
) -> Description:
    """A, B, C, D with the ground along +x; sign −1: C right of D → B ("open"), 1: left."""
    b = (crank * math.cos(q), crank * math.sin(q))
    s = math.dist(b, (ground, 0.0))
    along = (s * s + rocker**2 - coupler**2) / (2 * s)
    up = sign * math.sqrt(rocker**2 - along**2)
    u = ((b[0] - ground) / s, b[1] / s)
    c = (ground + along * u[0] - up * u[1], along * u[1] + up * u[0])
    joints = {"A": (0.0, 0.0), "B": b, "C": c, "D": (ground, 0.0)}
    links = {GROUND: "AD", "crank": "AB", "coupler": "BC", "rocker": "DC"}
    return _bars(joints, links, _CRANK)


def crank_rocker() -> Description:
    """A crank-rocker with a coupler point, drawn with its crank along the ground."""
    joints = {"A": (0.0, 0.0), "B": (1.0, 0.0), "C": (4.1, 3.2), "D": (4.8, 0.0), "P": (3.0, 4.0)}
    links = {GROUND: "AD", "crank": "AB", "coupler": "BCP", "rocker": "DC"}
    return _bars(joints, links, _CRANK)


def engine(crank: float = 0.05, rod: float = 0.2, offset: float = 0.0) -> Description:
    """Slider-crank drawn at q = 0, the piston's path at y = offset."""
    joints = {
        "O": (0.0, 0.0),
        "A": (crank, 0.0),
        "B": (crank + math.sqrt(rod**2 - offset**2), offset),
    }
    links = {GROUND: ["O"], "crank": ["O", "A"], "rod": ["A", "B"], "piston": ["B"]}
    return Description(joints, links, {"bore": SlideSpec("piston", GROUND, 0.0, "O")}, [_CRANK])


def whitworth() -> Description:
    """Quick return: block on a swinging arm, then a ram."""
    joints = {
        "O": (0.0, 0.0),
        "A": (1.0, 0.5),
        "D": (0.0, -2.0),
        "E": (2.0, 3.0),
        "F": (-1.0, 3.5),
    }
    links = {
        GROUND: ["O", "D"],
        "crank": ["O", "A"],
        "block": ["A"],
        "arm": ["D", "E"],
        "rod": ["E", "F"],
        "ram": ["F"],
    }
    slides = {
        "slot": SlideSpec("block", "arm", math.atan2(2.5, 1.0), "D"),
        "bed": SlideSpec("ram", GROUND, math.pi, "O"),
    }
    return Description(joints, links, slides, [_CRANK])


def scotch_yoke() -> Description:
    """Block in a slot of a sliding yoke."""
    joints = {"O": (0.0, 0.0), "A": (0.6, 0.8), "Y": (2.0, 0.0)}
    links = {GROUND: ["O"], "crank": ["O", "A"], "block": ["A"], "yoke": ["Y"]}
    slides = {
        "slot": SlideSpec("block", "yoke", math.pi / 2, "Y"),
        "bed": SlideSpec("yoke", GROUND, 0.0, "O"),
    }
    return Description(joints, links, slides, [_CRANK])


def trammel(driver: str = "rod") -> Description:
    """Ellipse of P; driver "rod" (its angle, turns fully) or "x" (a slide)."""
    joints = {"O": (0.0, 0.0), "A": (1.2, 0.0), "B": (0.0, 0.5), "P": (2.4, -0.5)}
    links = {GROUND: ["O"], "sx": ["A"], "sy": ["B"], "rod": ["B", "A", "P"]}
    slides = {
        "x": SlideSpec("sx", GROUND, 0.0, "O"),
        "y": SlideSpec("sy", GROUND, math.pi / 2, "O"),
    }
    drive: DriverSpec = ("slide", "x") if driver == "x" else ("angle", "rod", GROUND)
    return Description(joints, links, slides, [drive])


def oldham() -> Description:
    """Two shafts and a disc without joints between them."""
    joints = {"O1": (0.0, 0.0), "O2": (0.3, 0.1)}
    links = {GROUND: ["O1", "O2"], "shaft1": ["O1"], "disc": [], "shaft2": ["O2"]}
    slides = {
        "tongue1": SlideSpec("disc", "shaft1", 0.4, "O1"),
        "tongue2": SlideSpec("disc", "shaft2", 0.4 + math.pi / 2, "O2"),
    }
    return Description(joints, links, slides, [("angle", "shaft1", GROUND)])


def excavator() -> Description:
    """A boom lifted by one cylinder."""
    joints = {"D": (0.0, 0.0), "O": (0.6, -0.5), "T": (1.8, 1.1), "tip": (4.0, 1.5)}
    links = {GROUND: ["D", "O"], "barrel": ["O"], "rod": ["T"], "boom": ["D", "T", "tip"]}
    slides = {"cylinder": SlideSpec("rod", "barrel", math.atan2(1.6, 1.2), "O")}
    return Description(joints, links, slides, [("slide", "cylinder")])


def coupler_driven() -> Description:
    """The crank-rocker driven by its coupler's angle."""
    d = crank_rocker()
    return Description(d.joints, d.links, {}, [("angle", "coupler", GROUND)])


def parallelogram() -> Description:
    """A locomotive's third rod: redundant, and it moves (dimensions exact in binary)."""
    joints = {
        "A": (0.0, 0.0),
        "B": (0.75, 1.0),
        "C": (3.75, 1.0),
        "D": (3.0, 0.0),
        "E": (1.5, 0.0),
        "F": (2.25, 1.0),
    }
    links = {GROUND: "ADE", "crank": "AB", "rod": "BCF", "second": "DC", "third": "EF"}
    return _bars(joints, links, _CRANK)


def watt() -> Description:
    """Watt six-bar: a dyad between coupler and rocker of a four-bar."""
    d = crank_rocker()
    joints = {**d.joints, "Q": (5.5, 3.0), "S": (4.5, 5.5)}
    links = {**d.links, "rocker": ["D", "C", "Q"], "l5": ["P", "S"], "l6": ["S", "Q"]}
    return Description(joints, links, {}, d.drivers)


def stephenson() -> Description:
    """Stephenson III six-bar: a dyad between the coupler point and the ground."""
    d = crank_rocker()
    joints = {**d.joints, "E": (7.0, 1.0), "S": (6.0, 4.5)}
    links = {**d.links, GROUND: ["A", "D", "E"], "l5": ["P", "S"], "l6": ["E", "S"]}
    return Description(joints, links, {}, d.drivers)


def jansen() -> Description:
    """Theo Jansen's leg; foot "7"; crank drawn near 50°."""
    places = (
        (0.0, 0.0),
        (9.61, 11.52),
        (-38.0, -7.8),
        (-35.24, 33.61),
        (-77.75, -2.54),
        (-20.1, -42.79),
        (-56.05, -35.42),
        (-22.22, -91.74),
    )
    joints = {str(i): p for i, p in enumerate(places)}
    links = {GROUND: "02", "crank": "01", "b": "13", "c": "234", "d": "15", "e": "25", "f": "46"}
    return _bars(joints, {**links, "foot": "567"}, _CRANK)


def five_bar() -> Description:
    """Two cranks and a dyad: two drivers."""
    joints = {"A": (0.0, 0.0), "B": (0.3, 1.0), "C": (1.4, 2.0), "D": (2.5, 0.9), "E": (2.0, 0.0)}
    links = {GROUND: "AE", "left": "AB", "l2": "BC", "l3": "CD", "right": "ED"}
    return _bars(joints, links, ("angle", "left", GROUND), ("angle", "right", GROUND))


NAMED: dict[str, Callable[[], Description]] = {
    f.__name__: f
    for f in (
        *(crank_rocker, engine, whitworth, scotch_yoke, trammel, oldham, excavator),
        *(coupler_driven, parallelogram, watt, stephenson, jansen, five_bar),
    )
}


def locked() -> dict[str, Description]:
    """Invalid structures: refused with an error that names the wrong part."""
    d = crank_rocker()
    triangle = _bars(
        {"A": (0.0, 0.0), "B": (1.0, 2.0), "C": (3.0, 0.0)},
        {GROUND: "AC", "crank": "AB", "other": "CB"},
        _CRANK,
    )
    diagonal = {**d.links, "diagonal": ["A", "C"]}
    five = five_bar()
    doubled = {**five.links, "again": ["B", "C"]}  # counts 1, has 2 and one redundant link
    return {
        "triangle": triangle,
        "four_bar_with_diagonal": Description(d.joints, diagonal, {}, d.drivers),
        "five_bar_doubled": Description(five.joints, doubled, {}, five.drivers[:1]),
        "five_bar_one_driver": Description(five.joints, five.links, {}, five.drivers[:1]),
    }
