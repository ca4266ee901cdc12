"""What the compiled core returns as dictionaries, for type checkers: it makes them itself."""

from typing import Literal, TypedDict

import numpy as np
import numpy.typing as npt

Float = npt.NDArray[np.float64]


class SlideFields(TypedDict):
    """A slide of a drawing."""

    link: str
    on: str
    angle: float
    origin: str | None
    length: bool


class Drawing(TypedDict):
    """A drawing of a named mechanism."""

    joints: list[tuple[str, list[float]]]
    links: list[tuple[str, list[str]]]
    slides: list[tuple[str, SlideFields]]
    driver: str | None


class GroupFields(TypedDict):
    """An Assur group."""

    cls: int
    order: int
    kind: str | None
    artobolevsky_kind: int | None
    links: list[str]
    joints: list[str]
    slides: list[str]


class RemedyFields(TypedDict):
    """A change that makes a mechanism of a refused description."""

    kind: str
    names: list[str]
    text: str
    detail: str
    joints: list[tuple[str, float, float]]
    links: list[tuple[str, list[str]]]
    slides: list[tuple[str, SlideFields]]
    drivers: list[tuple[str, str | None]]
    assembly: list[tuple[str, int]]


class FlywheelNumbers(TypedDict):
    """Flywheels of designs."""

    inertia: Float
    speed0: Float
    motor_moment: Float
    greatest_at: Float
    greatest: Float
    least_at: Float
    least: Float
    period: Float


class EventFields(TypedDict):
    """An event of a run."""

    event: int
    t: float
    q: list[float]
    speed: list[float]


class NearChangePointFields(TypedDict):
    """A change point that a run passed by a little."""

    dyad: str
    miss: float
    q: float


class Ending(TypedDict):
    """Why a run ended."""

    kind: str
    event: int | None
    table: int | None
    motor: int | None
    stiff: bool | None
    why: str | None
    near_change_point: NearChangePointFields | None
    slide: str | None


class ExtremeNumbers(TypedDict):
    """An extreme of a speed."""

    at: float
    value: float


class SteadyNumbers(TypedDict):
    """A periodic motion."""

    multiplier: float
    found_moment: float
    motor_work: float
    inertia: float
    least: ExtremeNumbers
    greatest: ExtremeNumbers


class JammingEventFields(TypedDict):
    """An event of a crank-rocker that jams."""

    kind: Literal["jam", "return", "dead point", "no return"]
    side: Literal["outer", "inner"]
    t: float
    phi1: float
    l4: float
    ground: float
    ground_speed: tuple[float, float]
    rod_speed: tuple[float, float]


class JammingRunFields(TypedDict):
    """A motion of a crank-rocker that jams."""

    t: Float
    l4: Float
    gamma: Float
    sliding: npt.NDArray[np.bool_]
    b: Float
    c: Float
    events: list[JammingEventFields]
