"""Metrics as the core reads them: every class here has the fields of a struct of the binding."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias


@dataclass(frozen=True, slots=True)
class Coordinate:
    """A component of a joint, the angle of a link or the value of a slide, or its analogue."""

    kind: str
    index: int
    component: int
    order: int


@dataclass(frozen=True, slots=True)
class JointLine:
    """The line through two joints."""

    start: int
    end: int


@dataclass(frozen=True, slots=True)
class GuideLine:
    """A guide on a link; its angle in the link is this dimension, or zero."""

    link: int
    angle: int | None


Line: TypeAlias = JointLine | GuideLine


@dataclass(frozen=True, slots=True)
class Moves:
    """Whether the design moves over all positions."""


@dataclass(frozen=True, slots=True)
class Scalar:
    """A measure of one coordinate, called by its word."""

    measure: str
    coordinate: Coordinate


@dataclass(frozen=True, slots=True)
class LeastTransmission:
    """The least acute angle of two lines, or its complement."""

    lines: tuple[Line, Line]
    complement: bool


@dataclass(frozen=True, slots=True)
class Deviation:
    """How far a joint's path is from a line or circle, over the best part of the turn."""

    joint: int
    shape: str
    part: float
    is_relative: bool


@dataclass(frozen=True, slots=True)
class Part:
    """A metric over a part of the motion; of an angle, modulo a turn."""

    metric: Spec
    start: float
    end: float
    is_of_turn: bool


@dataclass(frozen=True, slots=True)
class Combination:
    """Two metrics, or a metric and a number."""

    operation: str
    left: Spec | float
    right: Spec | float


Spec: TypeAlias = Moves | Scalar | LeastTransmission | Deviation | Part | Combination
