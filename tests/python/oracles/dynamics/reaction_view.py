"""The oracle's reactions in the form in which `Machine.reactions` gives them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from oracles.dynamics.multipliers import Reactions

if TYPE_CHECKING:
    from assur import Machine


class Slide:
    """What happens at a sliding pair."""

    def __init__(self, normal: Any, moment: Any, value: Any) -> None:
        self.normal, self.moment = normal, moment
        with np.errstate(divide="ignore", invalid="ignore"):  # no force: nowhere on the guide
            self.along = value + moment / normal


class View:
    """At any number of positions, (N,) or with n drivers (N, n); or at one."""

    def __init__(self, machine: Machine, q: Any, speed: Any = 0.0, acceleration: Any = 0.0) -> None:
        m = machine.mechanism
        assert m is not None
        given = np.broadcast_arrays(*(np.asarray(v, np.float64) for v in (q, speed, acceleration)))
        self.drivers = int(np.size(m.q0))
        self.shape = given[0].shape if self.drivers == 1 else given[0].shape[:-1]
        rows = zip(*(g.reshape(-1, self.drivers) for g in given), strict=True)
        self.all = [Reactions(machine, a if self.drivers > 1 else a[0], b, c) for a, b, c in rows]

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
        one = self.drivers == 1
        every = [[r.driver(k) for k in range(self.drivers)] for r in self.all]
        return self.shaped([row[0] if one else row for row in every])

    @property
    def shaking_force(self) -> Any:
        return self.vectors(r.shaking[0] for r in self.all)

    @property
    def shaking_moment(self) -> Any:
        return self.shaped([r.shaking[1] for r in self.all])
