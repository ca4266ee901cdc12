"""One request to the core, and its results as arrays by name."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
import numpy.typing as npt

from assur.kinematics.held import Held

if TYPE_CHECKING:
    from assur.errors import AssurError
    from assur.kinematics.mechanism import Mechanism

Float: TypeAlias = npt.NDArray[np.float64]
# Arrays by name, one for each order.
Arrays: TypeAlias = Mapping[str, tuple[Float, ...]]
# Indices of joints, links (angles), links (reference points), slides.
Outputs: TypeAlias = tuple[list[int], list[int], list[int], list[int]]


@dataclass(eq=False)
class Buffers:
    """The arrays of a motion in the core's order, and its statuses.

    The core clears `complete` while it writes.
    """

    columns: list[Float]
    status: npt.NDArray[np.uint8]
    complete: bool = True


@dataclass(frozen=True, eq=False)
class Results:
    """The arrays of a motion by name, one for each order."""

    joints: Arrays
    links: Arrays
    slides: Arrays
    # The same arrays as written by the core; None in a copy.
    buffers: Buffers | None = None

    def copied(self) -> Results:
        """Return a copy with arrays of its own."""

        def own(held: Arrays) -> Arrays:
            return {name: tuple(a.copy() for a in arrays) for name, arrays in held.items()}

        return Results(own(self.joints), own(self.links), own(self.slides))


@dataclass(frozen=True, eq=False)
class SolveRequest:
    """Everything a motion depends on."""

    mechanism: Mechanism
    q: Float
    positions: tuple[int, ...]
    per_design: bool
    order: int
    signs: list[int]
    # Whether these are the mechanism's own.
    own_signs: bool
    threads: int | None

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of designs and positions, S + (N,)."""
        return (*self.mechanism.shape, *self.positions)

    def arrays(
        self,
        joints: dict[str, int],
        links: dict[str, int],
        slides: dict[str, int],
        buffers: Buffers | None = None,
        dimension: int | None = None,
        report: bool = False,
    ) -> tuple[Results, npt.NDArray[np.uint8], AssurError | None]:
        """Solve for joints, angles of links, and slides, into the buffers if given.

        With the index of a dimension, return the derivatives by that dimension. With
        `report`, return the exception of the first position that failed.
        """
        wanted = [list(of.values()) for of in (joints, links, slides)]
        outputs = (wanted[0], wanted[1], list[int](), wanted[2])
        found, status, failure = self._solve(outputs, buffers, dimension, report)
        shape = self.shape
        results = Results(
            joints=self._named("joint", joints, found, (*shape, 2)),
            links=self._named("link", links, found, shape),
            slides=self._named("slide", slides, found, shape),
            buffers=buffers or Buffers(list(found.values()), status),
        )
        status = status.reshape(shape)
        status.flags.writeable = False
        return results, status, failure

    def reference_point(self, link: str) -> tuple[Float, ...]:
        """Solve for a link's reference point, the origin of its frame."""
        index = self.mechanism._core.require("link", link)
        found, _, _ = self._solve(([], [], [index], []))
        return self._named("origin", {link: index}, found, (*self.shape, 2))[link]

    def flat(self) -> tuple[Float, Float, bool]:
        """Return flat dimensions and coordinates, and whether each design has its own."""
        values = self.mechanism._values.reshape(-1)
        if self.per_design and 0 in self.mechanism.shape:
            # With no designs the number of coordinates per design is undefined.
            drivers = self.mechanism._driver_count
            return values, np.zeros(drivers * math.prod(self.positions)), False
        return values, np.ascontiguousarray(self.q).reshape(-1), self.per_design

    def _solve(
        self,
        outputs: Outputs,
        buffers: Buffers | None = None,
        dimension: int | None = None,
        report: bool = False,
    ) -> tuple[dict[tuple[str, int, int], Float], npt.NDArray[np.uint8], AssurError | None]:
        shape = list(self.mechanism.shape) if report else None
        return self.mechanism._core.solve(
            *self.flat(),
            self.signs,
            self.order,
            outputs,
            self.threads,
            buffers,
            dimension,
            shape,
            self.mechanism._known_signs if self.own_signs else None,
        )

    def _named(
        self,
        kind: str,
        names: dict[str, int],
        found: dict[tuple[str, int, int], Float],
        shape: tuple[int, ...],
    ) -> Held:
        return Held(kind, names, found, shape, self.mechanism._driver_count, self.order)
