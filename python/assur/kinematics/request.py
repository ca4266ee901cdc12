"""One request to the core, and its results as arrays by name."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from assur.kinematics.result_columns import Buffers, Layout, Names, Results

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur.errors import AssurError
    from assur.kinematics.model import MechanismModel

Float: TypeAlias = npt.NDArray[np.float64]
Kind: TypeAlias = Literal["joint", "link", "slide"]
# A joint, link or slide, its index, and the order of its derivative by the drivers.
ResultKey: TypeAlias = tuple[Kind, int, int]
# Indices of joints, links (angles), links (reference points), slides.
Outputs: TypeAlias = tuple[list[int], list[int], list[int], list[int]]


@dataclass(eq=False, slots=True)
class SolveRequest:
    """Everything a motion depends on."""

    mechanism: MechanismModel
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
        designs = self.mechanism.shape
        return (*designs, *self.positions) if designs else self.positions

    def arrays(
        self,
        joints: Names,
        links: Names,
        slides: Names,
        buffers: Buffers | None = None,
        report: bool = False,
    ) -> tuple[Results, npt.NDArray[np.uint8], AssurError | None]:
        """Solve for joints, angles of links, and slides, into the buffers if given.

        With `report`, return the exception of the first position that failed.
        """
        outputs: Outputs = [*joints.values()], [*links.values()], [], [*slides.values()]
        buffers, failure = self._solve(outputs, buffers, report)
        layout = self.layout(joints, links, slides)
        status = buffers.status.reshape(layout.shape)
        status.flags.writeable = False
        return Results(layout, buffers), status, failure

    def derivatives(
        self, joints: Names, links: Names, slides: Names, dimension: int
    ) -> tuple[Results, npt.NDArray[np.uint8]]:
        """Return the derivatives of joints, angles of links, and slides by a dimension."""
        # In the order of a layout.
        kinds: tuple[tuple[Kind, Names], ...] = (
            ("joint", joints),
            ("slide", slides),
            ("link", links),
        )
        keys = [
            (kind, index, order)
            for kind, names in kinds
            for index in names.values()
            for order in range(self.order + 1)
        ]
        rates = np.zeros(len(self.mechanism.core.dimension_names))
        rates[dimension] = 1.0
        arrays, status = self.sensitivities(keys, [], rates=rates)
        layout = self.layout(joints, links, slides)
        status = status.reshape(layout.shape)
        status.flags.writeable = False
        return Results(layout, Buffers(arrays, status)), status

    def sensitivities(
        self,
        keys: list[ResultKey],
        by: list[int],
        *,
        rates: Float | None = None,
        weights: list[Float] | None = None,
        total: bool = False,
        of_squares: bool = False,
    ) -> tuple[list[Float], npt.NDArray[np.uint8]]:
        """Return derivatives of results by dimensions, or their products with vectors, flat."""
        return self.mechanism.core.sensitivities(
            *self.flat(),
            self.signs,
            (math.prod(self.mechanism.shape), math.prod(self.positions)),
            keys,
            by,
            self.threads,
            rates=rates,
            weights=weights,
            total=total,
            of_squares=of_squares,
        )

    def layout(self, joints: Names, links: Names, slides: Names) -> Layout:
        """Return what the columns of a result are."""
        return Layout(joints, links, slides, self.shape, self.mechanism.driver_count, self.order)

    def reference_point(self, link: str) -> tuple[Float, ...]:
        """Solve for a link's reference point, the origin of its frame."""
        index = self.mechanism.core.index_of("link", link)
        buffers, _ = self._solve(([], [], [index], []))
        # Its columns are as those of a joint.
        return self.layout({link: index}, {}, {}).held("joint", buffers)[link]

    def flat(self) -> tuple[Float, Float, bool]:
        """Return flat dimensions and coordinates, and whether each design has its own."""
        values = self.mechanism.values.reshape(-1)
        if self.per_design and 0 in self.mechanism.shape:
            # With no designs the number of coordinates per design is undefined.
            drivers = self.mechanism.driver_count
            return values, np.zeros(drivers * math.prod(self.positions)), False
        return values, self.q.reshape(-1), self.per_design

    def _solve(
        self,
        outputs: Outputs,
        buffers: Buffers | None = None,
        report: bool = False,
    ) -> tuple[Buffers, AssurError | None]:
        shape = list(self.mechanism.shape) if report else None
        arrays, status, failure = self.mechanism.core.solve(
            *self.flat(),
            self.signs,
            self.order,
            outputs,
            self.threads,
            buffers,
            shape,
            self.mechanism.known_signs if self.own_signs else None,
        )
        return buffers or Buffers(arrays, status), failure


def at_position(
    mechanism: MechanismModel, q: Sequence[float]
) -> tuple[Results, npt.NDArray[np.uint8]]:
    """Solve one design at one position, with a coordinate for each driver: NaN where it is open."""
    coordinates = np.array(q[0] if len(q) == 1 else q)
    request = SolveRequest(mechanism, coordinates, (), False, 0, mechanism.signs, True, None)
    results, status, _ = request.arrays(*mechanism.indices)
    return results, status
