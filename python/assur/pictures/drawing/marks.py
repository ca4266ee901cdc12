"""What a drawing is made of, in mm of the mechanism; heights of texts are mm of the paper."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterable

    from assur._arrays import Float

# Line weights, mm of the paper (ISO 128: thick is twice thin).
THICK, THIN = 0.5, 0.25
# Heights of texts (ISO 3098), arrows, gaps of dimensions, mm of the paper.
TEXT_HEIGHT, NAME_HEIGHT = 2.5, 3.5
ARROW, ARROW_WIDTH = 3.0, 1.0
GAP, BEYOND = 1.0, 1.5
# Width of a letter relative to its height: a bit more than any font needs.
LETTER = 0.75


@dataclass(frozen=True, slots=True, eq=False)
class Outline:
    """Lines and arcs through points; the bulge of an arc is the tangent of a quarter of it.

    `bulges[i]` is that from point i to the next, positive to the left; None: lines alone.
    """

    layer: str
    points: Float
    bulges: Float | None = None
    closed: bool = False
    weight: float = THICK
    dash_dotted: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Circle:
    """A circle."""

    layer: str
    centre: Float
    radius: float
    weight: float = THICK
    filled: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Filled:
    """A filled area."""

    layer: str
    points: Float


@dataclass(frozen=True, slots=True, eq=False)
class Text:
    """A text; `at` is the middle of its box, or of its lower edge, or its lower left corner."""

    layer: str
    at: Float
    text: str
    height: float = TEXT_HEIGHT
    anchor: Literal["middle", "below", "left"] = "middle"


@dataclass(frozen=True, slots=True, eq=False)
class Distance:
    """A dimension: the distance of two points along a direction; its line goes through `base`."""

    layer: str
    start: Float
    end: Float
    base: Float
    angle: float

    @property
    def along(self) -> Float:
        """Direction of the dimension line."""
        return np.array([np.cos(self.angle), np.sin(self.angle)])

    @property
    def value(self) -> float:
        """What is measured, mm."""
        return abs(float((self.end - self.start) @ self.along))

    def feet(self) -> tuple[Float, Float]:
        """Return the ends of the dimension line."""
        along = self.along
        first = self.base + along * float((self.start - self.base) @ along)
        second = self.base + along * float((self.end - self.base) @ along)
        return first, second


@dataclass(frozen=True, slots=True, eq=False)
class Diameter:
    """The diameter of one of `count` equal holes, on a leader that leaves at an angle."""

    layer: str
    centre: Float
    radius: float
    angle: float
    count: int = 1
    reach: float = 9.0

    def text_at(self, per: float) -> Float:
        """Return where the leader ends."""
        away = np.array([np.cos(self.angle), np.sin(self.angle)])
        return self.centre + (self.radius + self.reach * per) * away


Mark = Outline | Circle | Filled | Text | Distance | Diameter

_PLACES = ("points", "centre", "at", "start", "end", "base")


def moved(mark: Mark, shift: Float, angle: float = 0.0) -> Mark:
    """Return a mark turned about the origin, then moved."""
    cosine, sine = float(np.cos(angle)), float(np.sin(angle))
    turn = np.array([[cosine, sine], [-sine, cosine]])
    names = [field.name for field in fields(mark) if field.name in _PLACES]
    # A turn of 0 changes no bit.
    places: dict[str, Any] = {
        name: (getattr(mark, name) @ turn if angle else getattr(mark, name)) + shift
        for name in names
    }
    if isinstance(mark, Distance | Diameter) and angle:
        places["angle"] = mark.angle + angle
    return replace(mark, **places)


def bounds(marks: Iterable[Mark], per: float) -> tuple[Float, Float]:
    """Return the corners of what marks cover; `per` is the length of a mm of the paper."""
    corners = [_corners(mark, per) for mark in marks]
    points = np.concatenate([np.zeros((0, 2)), *corners])
    if not len(points):
        return np.zeros(2), np.zeros(2)
    return points.min(axis=0), points.max(axis=0)


def _corners(mark: Mark, per: float) -> Float:
    if isinstance(mark, Outline | Filled):
        return mark.points
    if isinstance(mark, Circle):
        return np.stack([mark.centre - mark.radius, mark.centre + mark.radius])
    if isinstance(mark, Distance):
        room = (TEXT_HEIGHT + GAP + BEYOND) * per
        feet = np.stack(mark.feet())
        return np.concatenate([feet - room, feet + room])
    if isinstance(mark, Diameter):
        at = mark.text_at(per)
        return np.stack([at, at + np.array([LETTER * 9.0, 1.0]) * TEXT_HEIGHT * per])
    half = np.array([LETTER * len(mark.text), 1.0]) * mark.height * per / 2.0
    middles = {"middle": (0.0, 0.0), "below": (0.0, half[1]), "left": tuple(half)}
    middle = mark.at + np.array(middles[mark.anchor])
    return np.stack([middle - half, middle + half])


def number_text(value: float, decimals: int) -> str:
    """Write a length in mm without zeros at its end."""
    text = f"{value:.{decimals}f}"
    return text.rstrip("0").rstrip(".") if "." in text else text
