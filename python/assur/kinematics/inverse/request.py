"""What `Mechanism.find` is asked: designs, coordinates, and the values that these are to have."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from assur._arrays import counted, real_array, short
from assur._callers import level_of_caller
from assur.errors import AssurWarning, InputError
from assur.kinematics.solve_arguments import LIKE_DEGREES

if TYPE_CHECKING:
    from assur._arrays import Float
    from assur.kinematics.model import MechanismModel

# Angles beyond two turns are probably in degrees.
TWO_TURNS = 4.0 * np.pi


@dataclass(frozen=True, slots=True)
class InverseRequest:
    """Designs, coordinates, and their values: positions + (n,), or S + positions + (n,)."""

    mechanism: MechanismModel
    names: tuple[str, ...]
    values: Float
    positions: tuple[int, ...]
    per_design: bool

    @classmethod
    def of(cls, mechanism: MechanismModel, names: tuple[str, ...], value: Any) -> InverseRequest:
        """Return the request for a value as a user wrote it."""
        values = real_array(value, "value")
        count, designs = len(names), mechanism.shape
        if count == 1:
            values = values[..., np.newaxis]
        elif not values.ndim or values.shape[-1] != count:
            of = ", ".join(names)
            message = (
                f"value is {short(value)}: with {counted(count, 'driver')} the last axis must hold "
                f"the finite numbers ({of})"
            )
            raise InputError(message)
        positions = values.shape[:-1]
        per_design = len(positions) > 1 and bool(designs)
        if per_design and positions[:-1] != designs:
            batch = ", ".join(map(str, designs))
            tail = "" if count == 1 else f", {count}"
            message = (
                f"value has shape {np.shape(value)}: for designs {designs} one value, "
                f"(N{tail}{',' if count == 1 else ''}) or ({batch}, N{tail}) is needed"
            )
            raise InputError(message)
        if per_design:
            positions = positions[-1:]
        return cls(mechanism, names, values, positions, per_design)

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of the answers: S + positions."""
        return (*self.mechanism.shape, *self.positions)

    @property
    def rows(self) -> tuple[Float, Float, bool]:
        """Flat dimensions and values, and whether each design has its own."""
        values = self.values.reshape(-1)
        if self.per_design and 0 in self.mechanism.shape:
            # With no designs the number of values of each is undefined.
            values = np.zeros(len(self.names) * math.prod(self.positions))
            return self.mechanism.values.reshape(-1), values, False
        return self.mechanism.values.reshape(-1), values, self.per_design

    @property
    def is_single(self) -> bool:
        """Whether it is about one design and one value."""
        return not self.shape

    def warn_of_turns(self) -> None:
        """Warn of a link's angle of many turns: it may be in degrees."""
        name, given = self.names[0], float(self.values[0])
        if len(self.names) == 1 and name in self.mechanism.links and abs(given) > TWO_TURNS:
            turns = abs(given) / (2.0 * np.pi)
            message = (
                f"{name} = {given:g} is in rad, {turns:.3g} turns; for degrees: deg=… or "
                "np.radians()"
            )
            warnings.warn(message, AssurWarning, stacklevel=level_of_caller())

    def warn_if_degrees(self) -> None:
        """Warn of a link's angles that look like degrees."""
        name = self.names[0]
        if len(self.names) > 1 or name not in self.mechanism.links or not self.values.size:
            return
        most = float(np.abs(self.values).max())
        whole = LIKE_DEGREES[0] < most < LIKE_DEGREES[1] and (self.values % 1.0 == 0.0).all()
        if whole:
            turns = most / (2.0 * np.pi)
            message = (
                f"{name} = {most:g} is in rad, {turns:.3g} turns; for degrees: deg=… or "
                "np.radians()"
            )
            warnings.warn(message, AssurWarning, stacklevel=level_of_caller())
