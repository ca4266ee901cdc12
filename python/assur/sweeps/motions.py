"""Motions of many designs, block by block into the arrays of one motion."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

import numpy as np
import numpy.typing as npt

from assur.description.words import is_reached
from assur.kinematics import solve as solver
from assur.kinematics.motion import Motion
from assur.kinematics.motion_model import overwrite
from assur.kinematics.result_columns import Buffers, Results
from assur.kinematics.solve_arguments import checked_coordinates
from assur.sweeps.engine import results
from assur.sweeps.measuring import blocks

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from assur.kinematics.mechanism import Mechanism
    from assur.sweeps.designs import Designs
    from assur.sweeps.progress import Report

Number = TypeVar("Number", bound=np.generic)
Float: TypeAlias = npt.NDArray[np.float64]
# A batch (n,) and its coordinates.
Task: TypeAlias = tuple["Mechanism", Float]
# Arrays as the core writes them, and statuses.
Arrays: TypeAlias = tuple[list[Float], npt.NDArray[np.uint8]]


@dataclass
class Solving:
    """How motions are solved; it can be sent to other processes."""

    order: int
    outputs: Iterable[str] | None
    threads: int | None

    def solve(self, task: Task, out: Motion | None = None) -> Motion:
        """Solve a batch."""
        some, q = task
        options = self.order, self.outputs, None
        return solver.solve(some, q, *options, "nan", self.threads, out)

    def arrays(self, task: Task) -> Arrays:
        """Solve a batch and return its arrays alone."""
        return _arrays(self.solve(task))

    def moves(self, task: Task) -> npt.NDArray[np.bool_]:
        """Whether each design of a batch moves over all of its positions."""
        some, q = task
        status = solver.solve(some, q, 0, (), None, "nan", self.threads, None).status
        moves = is_reached(status).reshape(some.shape[0], -1)
        every: npt.NDArray[np.bool_] = np.logical_and.reduce(moves, axis=-1)
        return every


class Course:
    """The coordinates of some designs: the same for all, or each design's own."""

    def __init__(self, every: Mechanism, q: npt.ArrayLike) -> None:
        array, positions, self.is_own = checked_coordinates(every, q)
        array.flags.writeable = False
        self.whole = array
        axes = len(every.shape)
        count = math.prod(every.shape)
        self.q = array.reshape(count, *array.shape[axes:]) if self.is_own else array
        self.positions = math.prod(positions)

    def of(self, which: slice | npt.NDArray[np.intp]) -> Float:
        """Those of some designs."""
        return self.q[which] if self.is_own else self.q

    def tasks(self, designs: Designs) -> Iterator[tuple[slice, Task]]:
        """Blocks of designs with their coordinates."""
        for block in blocks(designs.count, self.positions):
            yield block, (designs.some(block), self.of(block))


def moving(
    designs: Designs, course: Course, solving: Solving, report: Report, engine: Any
) -> npt.NDArray[np.intp]:
    """Return the indices of the designs that move over all of q; report those that do not."""
    moves = np.zeros(designs.count, dtype=np.bool_)
    for block, moves[block] in results(engine, solving.moves, course.tasks(designs)):
        report(block.stop - int(np.count_nonzero(moves[: block.stop])))
    kept = np.flatnonzero(moves)
    kept.flags.writeable = False
    return kept


def in_blocks(
    designs: Designs,
    every: Mechanism,
    course: Course,
    solving: Solving,
    out: Motion | None,
    report: Report,
    engine: Any,
) -> Motion:
    """Solve designs block by block; there is at least one, and their shape is not ()."""
    tasks = course.tasks(designs)
    # The first block shows which arrays to write, and that the arguments are right.
    block, task = next(tasks)
    first = solving.solve(task)
    motion = _whole(first, every, course, out)
    columns, status = _arrays(motion)

    def rows(of: slice) -> Arrays:
        parts = [_rows(column, of, designs.count) for column in columns]
        return parts, _rows(status, of, designs.count)

    def store(of: slice, arrays: Arrays) -> None:
        own_columns, own_status = rows(of)
        own_status[:] = arrays[1]
        for part, column in zip(own_columns, arrays[0], strict=True):
            part[:] = column
        report(of.stop)

    buffers = motion.stored.buffers
    assert buffers is not None
    # An interrupted result cannot be read.
    buffers.complete = False
    store(block, _arrays(first))
    if engine is None:
        indices = first.held_indices
        for of, (some, own_q) in tasks:
            request = replace(first.request, mechanism=some, q=own_q)
            request.arrays(*indices, buffers=Buffers(*rows(of)))
            report(of.stop)
    else:
        for of, arrays in results(engine, solving.arrays, tasks):
            store(of, arrays)
    buffers.complete = True
    return motion


def _whole(first: Motion, every: Mechanism, course: Course, out: Motion | None) -> Motion:
    """Return a motion of all designs like that of the first ones, with arrays to be written."""
    request = replace(first.request, mechanism=every, q=course.whole)
    indices = first.held_indices
    if out is None:
        columns, status = _arrays(first)
        designs, count = first.shape[0], math.prod(every.shape)
        columns = [np.empty(len(column) // designs * count) for column in columns]
        buffers = Buffers(columns, np.empty(len(status) // designs * count, dtype=np.uint8))
    else:
        buffers = solver.buffers_of(out, request, indices)
    status = buffers.status.reshape(request.shape)
    status.flags.writeable = False
    whole = Results(request.layout(*indices), buffers)
    if out is None:
        return Motion(request, whole, status)
    overwrite(out, request, whole, status)
    return out


def _rows(column: npt.NDArray[Number], block: slice, count: int) -> npt.NDArray[Number]:
    """Return what a column, or the statuses, holds of a block of designs."""
    size = len(column) // count
    return column[block.start * size : block.stop * size]


def _arrays(motion: Motion) -> Arrays:
    stored = motion.stored
    assert stored.buffers is not None
    return stored.columns(), stored.buffers.status
