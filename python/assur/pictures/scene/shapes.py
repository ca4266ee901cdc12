"""What a scene is made of: strokes, discs and hatched lines, each fixed to a link.

A scene knows no drawing library. Whoever draws it places the frame of each link, and decides how
many px a metre has; sizes of symbols are in px at any zoom.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

# "link" is the colour of the part's link: its group's if groups are shown, the driver's, or ink.
Colour = Literal["link", "ink", "second", "driver"]
# "tint" is a tenth of the part's colour on the canvas.
Fill = Literal["canvas", "tint", "solid"]


class Vertex(NamedTuple):
    """A point in a link's frame: coordinates in m, and px to be added to them."""

    x: float
    y: float
    dx: float = 0.0
    dy: float = 0.0


@dataclass(frozen=True, slots=True)
class Stroke:
    """A line through vertices, or an area if it is closed.

    Parts of a lower floor lie under those of a higher one: plates (0), bars and guides (1), blocks
    and barrels (2), rods and what lies on blocks (3).
    """

    link: str
    name: str
    vertices: tuple[Vertex, ...]
    width: float
    colour: Colour = "link"
    closed: bool = False
    fill: Fill | None = None
    hatched: bool = False
    dashes: tuple[float, ...] = ()
    floor: int = 1


@dataclass(frozen=True, slots=True)
class Disc:
    """A circle of a radius in px."""

    link: str
    name: str
    centre: Vertex
    radius: float
    width: float
    colour: Colour = "ink"
    fill: Fill = "canvas"


@dataclass(frozen=True, slots=True)
class Hatching:
    """Short strokes at 45° along a line, on its right as one goes from start to end."""

    link: str
    name: str
    start: Vertex
    end: Vertex
    spacing: float
    colour: Colour = "ink"
    floor: int = 1


Line = Stroke | Hatching
Part = Line | Disc


class Name(NamedTuple):
    """The name of a joint, where the joint is, and the radius of its symbol, px."""

    text: str
    link: str
    at: Vertex
    radius: float


@dataclass(frozen=True, slots=True)
class Scene:
    """A mechanism as it is drawn.

    Attributes
    ----------
    links : tuple of str
        All links, in the order of their frames.
    parts : tuple of Part
        From the undermost to the uppermost.
    names : tuple of Name
        Of the joints.
    driven : frozenset of str
        Links drawn in the colour of drivers.
    groups : dict of str to int
        The Assur group of each link, numbered in solving order; none of drivers and ground.
    """

    links: tuple[str, ...]
    parts: tuple[Part, ...]
    names: tuple[Name, ...]
    driven: frozenset[str]
    groups: dict[str, int]
