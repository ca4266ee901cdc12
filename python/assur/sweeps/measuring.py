"""Measures designs, block by block: one number for each metric."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

from assur._arrays import short
from assur._validate import checked_name, real_array
from assur.description.words import Status, has_analogues, is_reached
from assur.errors import AssurError, InputError, subject_of
from assur.kinematics import transmission
from assur.kinematics.model import with_values
from assur.kinematics.solve import solve
from assur.sweeps._measured import Undefined
from assur.sweeps.engine import results
from assur.sweeps.gradients import Gradients
from assur.sweeps.machine_metrics import Driven, together
from assur.sweeps.measures import Measures
from assur.sweeps.target_metrics import placed
from assur.sweeps.terms import (
    Combination,
    Condition,
    FullRotation,
    Function,
    Leaf,
    Metric,
    OfMachine,
)

if TYPE_CHECKING:
    from collections.abc import Iterator

    from assur.dynamics.machine import Machine
    from assur.kinematics.mechanism import Mechanism
    from assur.sweeps.designs import Designs
    from assur.sweeps.progress import Report
    from assur.sweeps.terms import Single

Float: TypeAlias = npt.NDArray[np.float64]
# For some designs: values by name, statuses, which are kept, and gradients by name.
Block: TypeAlias = tuple[
    dict[str, Float], npt.NDArray[np.uint8], npt.NDArray[np.bool_], dict[str, Float]
]

# Positions of a block, between two reports of progress: some ten milliseconds. Positions whose
# motions a function in Python sees at once: as many as the caches hold.
POSITIONS_OF_BLOCK = 2_097_152
POSITIONS_OF_FUNCTIONS = 262_144


def blocks(count: int, positions: int) -> Iterator[slice]:
    """The size of blocks of designs with this many positions each."""
    size = max(1, POSITIONS_OF_BLOCK // max(1, positions))
    for first in range(0, count, size):
        yield slice(first, min(first + size, count))


class Measuring:
    """What to measure of the designs of one mechanism; it can be sent to other processes."""

    def __init__(
        self,
        mechanism: Mechanism,
        machine: Machine | None,
        q: npt.ArrayLike,
        metrics: Any,
        where: Any,
        threads: int | None,
        gradient: Any = None,
    ) -> None:
        if not isinstance(metrics, Mapping):
            message = f"metrics is {short(metrics)}: a mapping of names to metrics is needed"
            raise InputError(message)
        named = [
            (checked_name(name, "metrics"), definition) for name, definition in metrics.items()
        ]
        self.metrics = {name: _metric(name, definition) for name, definition in named}
        self.conditions = conditions = _conditions(where)
        self.threads = threads
        self.q = _coordinates(mechanism, q)
        everything = [*self.metrics.values(), *(c.metric for c in conditions)]
        leaves = list(dict.fromkeys(leaf for metric in everything for leaf in metric.leaves()))
        self.leaves = [leaf for leaf in leaves if isinstance(leaf, Leaf)]
        self.proved = [leaf for leaf in leaves if isinstance(leaf, FullRotation)]
        self.functions = [leaf for leaf in leaves if isinstance(leaf, Function | OfMachine)]
        for proved in self.proved:
            proved.check(mechanism)
        self.machine = machine
        for leaf in self.functions:
            if isinstance(leaf, OfMachine):
                _check(leaf, machine)
        # The core drops designs by all conditions without functions, the others are asked after it.
        self.late = [
            c for c in conditions if any(not isinstance(m, Leaf) for m in c.metric.leaves())
        ]
        early = [c for c in conditions if c not in self.late]
        self.gradients = None
        if gradient is not None:
            self.gradients = Gradients(mechanism, self.metrics, self.q, gradient, threads)
            self.leaves = list(dict.fromkeys([*self.leaves, *self.gradients.indices]))
        # What the core differentiates, and by what.
        self.summed: tuple[list[int], list[int]] = [], []
        asked: list[Metric] = list(dict.fromkeys([*self.leaves, *(c.metric for c in early)]))
        for measured in self.leaves:
            as_taken = located(measured, mechanism, self.q)
            refusal = mechanism.core.refusal_of_metric(self.q.reshape(-1), as_taken)
            if refusal is not None:
                message = f"{measured!r}: {refusal}"
                raise InputError(message)
        self.asked = [located(metric, mechanism, self.q) for metric in asked]
        if self.gradients is not None:
            self.summed = [asked.index(leaf) for leaf in self.gradients.summed], self.gradients.by
        self.early = [(asked.index(c.metric), c.relation, c.limit) for c in early]

    @property
    def gradient_by(self) -> tuple[str, ...]:
        """The dimensions by which there are gradients."""
        return () if self.gradients is None else self.gradients.names

    def run(self, designs: Designs, report: Report, engine: Any = None) -> Measures:
        """Measure all designs."""
        count, shape = designs.count, designs.shape
        values = {name: np.full(count, np.nan) for name in self.metrics}
        slopes: dict[str, Float] = {}
        if self.gradients is not None:
            width = len(self.gradients.names)
            slopes = {name: np.full((count, width), np.nan) for name in self.metrics}
        status = np.zeros(count, dtype=np.uint8)
        kept = np.zeros(count, dtype=np.bool_)
        # Allocate the indices now: a sweep without memory for them ends at once.
        room = np.empty(count, dtype=np.intp)
        parts = list(blocks(count, len(self.q)))
        # Here all blocks reuse the same memory.
        size = designs.size * max((part.stop - part.start for part in parts), default=0)
        memory = np.empty(size) if engine is None else None
        tasks = ((part, designs.some(part, memory)) for part in parts)
        done = results(engine, self.measure, tasks)
        for part, (block, status[part], kept[part], of_block) in done:
            for name, value in block.items():
                values[name][part] = value
            for name, slope in of_block.items():
                slopes[name][part] = slope
            report(part.stop)
        del room
        indices = np.flatnonzero(kept)
        for array in (*values.values(), *slopes.values(), status, indices):
            array.flags.writeable = False
        arrays = {name: array.reshape(shape) for name, array in values.items()}
        gradient = {name: array.reshape(*shape, array.shape[-1]) for name, array in slopes.items()}
        return Measures(arrays, status.reshape(shape), indices, designs, self, gradient)

    def measure(self, some: Mechanism) -> Block:
        """Measure a batch (n,)."""
        numbers, status, kept, summed = some.core.measure(
            some.values.reshape(-1),
            self.q.reshape(-1),
            some.signs,
            self.asked,
            self.early,
            self.summed,
            self.threads,
        )
        of: dict[Single, Float] = dict(zip(self.leaves, numbers, strict=False))
        if self.functions:
            indices = np.flatnonzero(kept)
            of.update(self._called(some, indices))
        of.update(self._proved(some, status, kept))
        values = {name: metric.value(of.__getitem__) for name, metric in self.metrics.items()}
        # A position that is singular has no analogues: its status says so.
        is_defined = has_analogues(status)
        without = np.zeros_like(kept)
        for condition in self.late:
            measured = condition.metric.value(of.__getitem__)
            misses = kept & ~condition.holds(measured)
            without |= misses & np.isnan(measured) & is_defined
            kept &= ~misses
            values = {name: np.where(misses, np.nan, value) for name, value in values.items()}
        for value in values.values():
            without |= kept & np.isnan(value) & is_defined
        kept &= ~without
        slopes = self._slopes(some, kept, of, summed)
        return values, np.where(without, np.uint8(Status.NO_VALUE), status), kept, slopes

    def _slopes(
        self,
        some: Mechanism,
        kept: npt.NDArray[np.bool_],
        of: dict[Single, Float],
        summed: list[Float],
    ) -> dict[str, Float]:
        """Return the gradients of the designs that are kept: NaN of the others."""
        if self.gradients is None:
            return {}
        indices = np.flatnonzero(kept)
        batch = with_values(some, np.ascontiguousarray(some.values[:, indices]))
        width = len(self.gradients.names)
        rows = [found.reshape(len(kept), width)[indices] for found in summed]
        known = dict(zip(self.gradients.summed, rows, strict=True))
        slopes = {}
        for name, found in self.gradients.of(batch, lambda leaf: of[leaf][indices], known).items():
            slopes[name] = np.full((len(kept), found.shape[1]), np.nan)
            slopes[name][indices] = found
        return slopes

    def undefined(self, design: Mechanism) -> Undefined:
        """Return which metric of a design has no value, and why."""
        some = with_values(design, design.values[:, None])
        asked = {
            **self.metrics,
            **{repr(condition): condition.metric for condition in self.conditions},
        }
        for name, metric in asked.items():
            for part in (*metric.leaves(), metric):
                alone = Measuring(some, self.machine, self.q, {name: part}, None, self.threads)
                if not np.isnan(alone.measure(some)[0][name][0]):
                    continue
                if isinstance(part, OfMachine):
                    assert self.machine is not None
                    why = part.why(self.machine.of(design), self.q)
                    subject = subject_of(why) if isinstance(why, AssurError) else None
                    return Undefined(name, str(why), subject)
                return Undefined(name, f"{part!r} is not defined for this motion")
        return Undefined("a metric", "it has no value")

    def _proved(
        self, some: Mechanism, status: npt.NDArray[np.uint8], kept: npt.NDArray[np.bool_]
    ) -> Iterator[tuple[Single, Float]]:
        """Yield what positions do not show, also for designs that some of them stop."""
        asked = np.flatnonzero(kept | (~is_reached(status) & (status < Status.BAD_DIMENSION)))
        for leaf in self.proved:
            values = np.full(some.shape[0], np.nan)
            if len(asked):
                values[asked] = leaf.values(with_values(some, some.values[:, asked]), self.threads)
            yield leaf, values

    def _called(self, some: Mechanism, indices: npt.NDArray[np.intp]) -> dict[Single, Float]:
        """Call the functions with the motions, or machines, of some designs."""
        values: dict[Single, Float] = {
            function: np.full(some.shape[0], np.nan) for function in self.functions
        }
        # Reactions do not keep positions.
        keeps = not all(isinstance(function, Driven) for function in self.functions)
        size = max(1, POSITIONS_OF_FUNCTIONS // len(self.q)) if keeps else max(1, len(indices))
        for first in range(0, len(indices), size):
            few = indices[first : first + size]
            batch = with_values(some, some.values[:, few])
            for function, numbers in self._numbers(batch):
                if numbers.shape != few.shape:
                    message = f"{function!r} returned shape {numbers.shape} for designs {few.shape}"
                    raise InputError(message)
                values[function][few] = numbers
        return values

    def _numbers(self, batch: Mechanism) -> Iterator[tuple[Function | OfMachine, Float]]:
        """Yield all functions with their values for a batch."""
        of_machine = [metric for metric in self.functions if isinstance(metric, OfMachine)]
        if of_machine:
            assert self.machine is not None
            values = together(of_machine, self.machine.of(batch), self.q, self.threads)
            yield from zip(of_machine, values, strict=True)
        for function in self.functions:
            if not isinstance(function, OfMachine):
                yield function, self._of_motion(function, batch)

    def _of_motion(self, function: Function, batch: Mechanism) -> Float:
        options = function.order, function.outputs, None
        motion = solve(batch, self.q, *options, "nan", self.threads, None)
        return real_array(function.function(motion), f"the values of {function!r}")


def located(metric: Metric, mechanism: Mechanism, q: Float) -> Metric:
    """Return a metric as the core takes it.

    Transmission angles have the lines between which they are, functions the places of their
    coordinates in q.
    """
    if isinstance(metric, Combination):
        left, right = (
            located(side, mechanism, q) if isinstance(side, Metric) else side
            for side in (metric.left, metric.right)
        )
        return replace(metric, left=left, right=right)
    if isinstance(metric, Leaf) and metric.kind.endswith("min_transmission_angle"):
        assert metric.of is not None
        pair, complement = transmission.lines(mechanism, metric.of, *metric.options)
        return replace(metric, options=(*pair, complement))
    if isinstance(metric, Leaf) and metric.kind == "function_error":
        return placed(metric, mechanism, q)
    return metric


def _check(metric: OfMachine, machine: Machine | None) -> None:
    """Raise InputError if there is no machine, or the metric has no meaning for it."""
    if machine is None:
        message = f"{metric!r} is of a machine: pass it, sweep(machine, ...)"
        raise InputError(message)
    metric.check(machine)


def _metric(name: str, metric: Any) -> Metric:
    if not isinstance(metric, Metric):
        message = f"metrics[{name!r}] is {short(metric)}: one of assur.metric is needed"
        raise InputError(message)
    return metric


def _conditions(where: Any) -> list[Condition]:
    if isinstance(where, Condition | Metric):
        message = f"where={where!r}: a list of conditions is needed, where=[{where!r}]"
        raise InputError(message)
    try:
        conditions = [] if where is None else list(where)
    except TypeError as error:
        message = f"where is {short(where)}: a list of conditions is needed"
        raise InputError(message) from error
    # What is 1 or 0 is a condition by itself.
    conditions = [c > 0.5 if _is_flag(c) else c for c in conditions]
    for condition in conditions:
        if not isinstance(condition, Condition):
            message = f"where: {short(condition)} is not a condition, such as metric > limit"
            if isinstance(condition, bool):
                message += "; metrics are compared by <, <=, > and >=, not by =="
            raise InputError(message)
    return conditions


def _is_flag(condition: Any) -> bool:
    is_reachable = isinstance(condition, Leaf) and condition.kind == "moves"
    return is_reachable or isinstance(condition, FullRotation)


def _coordinates(mechanism: Mechanism, q: npt.ArrayLike) -> Float:
    array = real_array(q, "q")
    drivers = mechanism.driver_count
    if array.ndim != (1 if drivers == 1 else 2) or (drivers > 1 and array.shape[-1] != drivers):
        shape = "(N,)" if drivers == 1 else f"(N, {drivers})"
        message = f"q has shape {array.shape}: metrics need {shape}, the same for all designs"
        raise InputError(message)
    if len(array) == 0:
        message = "q is empty: metrics need a position at least"
        raise InputError(message)
    if not np.isfinite(array).all():
        message = "q: a coordinate is not finite: no design could move over all of q"
        raise InputError(message)
    return array
