"""The oracle's reactions in the form in which `Machine.reactions` gives them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from multipliers import Reactions

if TYPE_CHECKING:
    from assur import Machine


class Slide:
    """What happens at a sliding pair."""

    def __init__(self, normal: Any, moment: Any, value: Any) -> None:
        self.normal, self.moment = normal, moment
        self.along = value + moment / normal


class View:
    """At any number of positions (N,) of one driver, or at one."""

    def __init__(self, machine: Machine, q: Any, speed: Any = 0.0, acceleration: Any = 0.0) -> None:
        given = np.broadcast_arrays(*(np.asarray(v, np.float64) for v in (q, speed, acceleration)))
        self.shape = given[0].shape
        self.all = [
            Reactions(machine, *one) for one in zip(*(g.ravel() for g in given), strict=True)
        ]

    def shaped(self, values: Any) -> Any:
        values = np.array(values)
        return values.reshape(self.shape + values.shape[1:])[()]

    def vectors(self, values: Any) -> Any:
        return self.shaped([[z.real, z.imag] for z in values])

    def joint(self, name: str, on: str) -> Any:
        return self.vectors(r.joint(name, on) for r in self.all)

    def slide(self, name: str) -> Slide:
        return Slide(
            self.shaped([r.normal(name) for r in self.all]),
            self.shaped([r.moment(name) for r in self.all]),
            self.shaped([float(r.places.value[name]) for r in self.all]),
        )

    @property
    def driver(self) -> Any:
        return self.shaped([r.driver() for r in self.all])

    @property
    def shaking_force(self) -> Any:
        return self.vectors(r.shaking[0] for r in self.all)

    @property
    def shaking_moment(self) -> Any:
        return self.shaped([r.shaking[1] for r in self.all])
