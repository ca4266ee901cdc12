"""`assur.sweep`: many designs, for their motions or for metrics of these."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, overload

import numpy as np
import numpy.typing as npt

from assur._arrays import short
from assur._validate import checked_name, checked_threads, one_of, real_array
from assur.errors import InputError
from assur.kinematics.solve import checked_assembly
from assur.metric import Condition, Function, Leaf, Metric, encoded
from assur.sweeps.designs import Designs
from assur.sweeps.measures import Measures

if TYPE_CHECKING:
    from collections.abc import Iterable

    from assur.kinematics.mechanism import Mechanism
    from assur.kinematics.motion import Motion

__all__ = ["sweep"]

Float: TypeAlias = npt.NDArray[np.float64]
Progress: TypeAlias = bool | Callable[[int, int], object]

# Designs of a block, between two reports of progress, and positions whose motions a function in
# Python sees at once.
BLOCK_OF_METRICS = 262_144
POSITIONS_OF_FUNCTIONS = 262_144


@overload
def sweep(
    mechanism: Mechanism,
    dimensions: Mapping[str, npt.ArrayLike],
    q: npt.ArrayLike,
    outputs: Iterable[str] | None = ...,
    order: int = ...,
    *,
    assembly: Mapping[str, int] | None = ...,
    metrics: None = ...,
    where: None = ...,
    on_error: Literal["nan", "raise", "drop"] = ...,
    threads: int | None = ...,
    progress: Progress = ...,
    out: Motion | None = ...,
) -> Motion: ...
@overload
def sweep(
    mechanism: Mechanism,
    dimensions: Mapping[str, npt.ArrayLike],
    q: npt.ArrayLike,
    *,
    assembly: Mapping[str, int] | None = ...,
    metrics: Mapping[str, Metric],
    where: Iterable[Condition] | None = ...,
    threads: int | None = ...,
    progress: Progress = ...,
) -> Measures: ...
def sweep(
    mechanism: Mechanism,
    dimensions: Mapping[str, npt.ArrayLike],
    q: npt.ArrayLike,
    outputs: Iterable[str] | None = None,
    order: int = 2,
    *,
    assembly: Mapping[str, int] | None = None,
    metrics: Mapping[str, Metric] | None = None,
    where: Iterable[Condition] | None = None,
    on_error: Literal["nan", "raise", "drop"] = "nan",
    threads: int | None = None,
    progress: Progress = False,
    out: Motion | None = None,
) -> Motion | Measures:
    """Solve many designs of a mechanism, or measure them.

    Parameters
    ----------
    mechanism : Mechanism
        Of any class.
    dimensions : mapping of str to array_like
        Dimensions of the designs, m or rad, as for `Mechanism.with_dimensions`: arrays of
        one length pair, an `assur.Grid` makes every combination.
    q : array_like
        Coordinate of the driver, rad or m: as for `Mechanism.solve`; with `metrics` of
        shape (N,), n drivers add a last axis of n.
    outputs : iterable of str, optional
        Names of joints, links and slides to keep; all by default.
    order : {2, 0, 1, 3}
        Highest order of the analogues.
    assembly : mapping of str to int, optional
        Signs of dyads where they differ from the drawing's.
    metrics : mapping of str to metric, optional
        What is measured of each design (see `assur.metric`). Positions are not kept: memory
        does not grow with them.
    where : iterable of Condition, optional
        Conditions on metrics, ``assur.metric.least_transmission("C") > 0.7``. A design that
        misses one is dropped, often after a few positions; put the quickest first.
    on_error : {"nan", "raise", "drop"}
        For positions that cannot be solved: NaN, each with its status; an error for the first
        one; or the motion of the designs alone that move over all of q, with their indices in
        `Motion.kept`.
    threads : int, optional
        Maximum number of threads; by default one per core. Results do not depend on it.
    progress : bool or callable, default False
        Called with the number of designs done, and of all; True shows a bar (needs tqdm).
    out : Motion, optional
        A motion of the same call: overwritten.

    Returns
    -------
    Motion or Measures
        Arrays of shape S + (N,), of one design shape S; or, with `metrics`, arrays of shape S
        by name, with ``.status`` and ``.kept``.

    Raises
    ------
    InputError, PositionError, DimensionError
        As of `Mechanism.solve`.

    Examples
    --------
    The straightest path of a coupler point, of four-bars that transmit well:

    >>> import assur, numpy as np
    >>> four_bar = assur.Mechanism(
    ...     joints={"A": (0, 0), "B": (1, 0), "C": (4.1, 3.2), "D": (4.8, 0), "P": (3, 4)},
    ...     links={"ground": "AD", "crank": "AB", "coupler": "BCP", "rocker": "DC"},
    ...     driver="crank",
    ... )
    >>> q = np.linspace(0, 2 * np.pi, 72, endpoint=False)
    >>> rng = np.random.default_rng(1)
    >>> space = {name: rng.uniform(1.5, 5, 2000) for name in ("coupler.length", "rocker.length")}
    >>> found = assur.sweep(
    ...     four_bar, space, q,
    ...     metrics={"off": assur.metric.deviation("P", "line", relative=True)},
    ...     where=[assur.metric.least_transmission("C") > np.radians(40)],
    ... )
    >>> bool(0.0 < np.nanmin(found["off"]) < 0.02)
    True
    """
    designs = Designs(mechanism, dimensions)
    one_of(on_error, ("nan", "raise", "drop"), "on_error")
    if metrics is None:
        if where is not None:
            message = "where= is for metrics=; on_error='drop' keeps the designs that move"
            raise InputError(message)
        return _motions(designs, q, outputs, order, assembly, on_error, threads, progress, out)
    if out is not None or outputs is not None:
        message = f"{'out' if outputs is None else 'outputs'}= is for motions, not for metrics="
        raise InputError(message)
    return _Measuring(designs, q, metrics, where, assembly, threads, progress).run()


def _motions(
    designs: Designs,
    q: npt.ArrayLike,
    outputs: Iterable[str] | None,
    order: int,
    assembly: Mapping[str, int] | None,
    on_error: str,
    threads: int | None,
    progress: Progress,
    out: Motion | None,
) -> Motion:
    if on_error == "drop":
        moving = {"moves": Leaf("moves")}
        found = _Measuring(designs, q, moving, None, assembly, threads, progress).run()
        some = designs.some(found.kept)
        motion = some.solve(q, order, outputs, assembly, "nan", threads, out)
        motion.kept = found.kept
        return motion
    every: Any = on_error
    report = _reporter(progress, designs.count)
    motion = designs.all().solve(q, order, outputs, assembly, every, threads, out)
    report(designs.count)
    return motion


class _Measuring:
    """One sweep for metrics."""

    def __init__(
        self,
        designs: Designs,
        q: npt.ArrayLike,
        metrics: Any,
        where: Any,
        assembly: Mapping[str, int] | None,
        threads: Any,
        progress: Progress,
    ) -> None:
        if not isinstance(metrics, Mapping):
            message = f"metrics is {short(metrics)}: a mapping of names to metrics is needed"
            raise InputError(message)
        self.metrics = {
            checked_name(name, "metrics"): _metric(name, m) for name, m in metrics.items()
        }
        self.conditions = [] if where is None else [_condition(one) for one in where]
        self.designs = designs
        self.assembly = assembly
        self.threads = checked_threads(threads)
        self.signs = checked_assembly(designs.mechanism, assembly)
        self.report = _reporter(progress, designs.count)
        self.q = real_array(q, "q")
        drivers = designs.mechanism._driver_count
        needed = 1 if drivers == 1 else 2
        if self.q.ndim != needed or (drivers > 1 and self.q.shape[-1] != drivers):
            shape = "(N,)" if drivers == 1 else f"(N, {drivers})"
            message = f"q has shape {self.q.shape}: metrics need {shape}, the same for all designs"
            raise InputError(message)
        if not np.isfinite(self.q).all():
            message = "q: a coordinate is not finite: no design could move over all of q"
            raise InputError(message)
        everything = [*self.metrics.values(), *(c.metric for c in self.conditions)]
        leaves = list(dict.fromkeys(leaf for metric in everything for leaf in metric.leaves()))
        self.leaves = [leaf for leaf in leaves if isinstance(leaf, Leaf)]
        self.functions = [leaf for leaf in leaves if isinstance(leaf, Function)]
        if drivers > 1 and any(leaf.order or leaf.over for leaf in self.leaves):
            message = "order= and over= of metrics are for mechanisms with one driver"
            raise InputError(message)
        flat = self.q if drivers == 1 else self.q[:, 0]
        self.encoded = [encoded(leaf, designs.mechanism, flat) for leaf in self.leaves]
        self.early = [
            (self.leaves.index(c.metric), c.relation, c.limit)
            for c in self.conditions
            if isinstance(c.metric, Leaf)
        ]
        self.late = [c for c in self.conditions if not isinstance(c.metric, Leaf)]

    def run(self) -> Measures:
        """Measure all designs, block by block."""
        count, shape = self.designs.count, self.designs.shape
        values = {name: np.full(count, np.nan) for name in self.metrics}
        status = np.zeros(count, dtype=np.uint8)
        kept = np.zeros(count, dtype=np.bool_)
        memory = np.empty(self.designs.size * min(count, BLOCK_OF_METRICS))
        for first in range(0, count, BLOCK_OF_METRICS):
            block = slice(first, min(first + BLOCK_OF_METRICS, count))
            some = self.designs.some(block, memory)
            status[block], kept[block] = self._measure(some, values, block)
            self.report(block.stop)
        for array in (*values.values(), status):
            array.flags.writeable = False
        indices = np.flatnonzero(kept)
        arrays = {name: array.reshape(shape) for name, array in values.items()}
        return Measures(arrays, status.reshape(shape), indices, self.designs)

    def _measure(
        self, some: Mechanism, values: dict[str, Float], block: slice
    ) -> tuple[npt.NDArray[np.uint8], npt.NDArray[np.bool_]]:
        """Measure a block into `values`; return statuses, and which are kept."""
        found, status, kept = some._core.measure(
            some._values.reshape(-1),
            np.ascontiguousarray(self.q).reshape(-1),
            self.signs,
            self.encoded,
            self.early,
            self.threads,
        )
        of: dict[Leaf | Function, Float] = dict(zip(self.leaves, found, strict=True))
        if self.functions:
            indices = np.flatnonzero(kept)
            for function in self.functions:
                of[function] = self._called(function, some, indices)
        for condition in self.late:
            kept &= condition.holds(condition.metric.value(of.__getitem__))
        for name, metric in self.metrics.items():
            one = metric.value(of.__getitem__)
            values[name][block] = np.where(kept, one, np.nan) if self.late else one
        return status, kept

    def _called(self, function: Function, some: Mechanism, indices: npt.NDArray[np.intp]) -> Float:
        """Call a function with the motions of some designs."""
        found = np.full(some.shape[0], np.nan)
        size = max(1, POSITIONS_OF_FUNCTIONS // max(1, len(self.q)))
        for first in range(0, len(indices), size):
            few = indices[first : first + size]
            batch = some._make(some._description, some._values[:, few], some._core)
            motion = batch.solve(
                self.q, function.order, function.outputs, self.assembly, "nan", self.threads
            )
            numbers = real_array(function.function(motion), f"the values of {function!r}")
            if numbers.shape != few.shape:
                message = f"{function!r} returned shape {numbers.shape} for designs {few.shape}"
                raise InputError(message)
            found[few] = numbers
        return found


def _metric(name: str, metric: Any) -> Metric:
    if not isinstance(metric, Metric):
        message = f"metrics[{name!r}] is {short(metric)}: one of assur.metric is needed"
        raise InputError(message)
    return metric


def _condition(condition: Any) -> Condition:
    if not isinstance(condition, Condition):
        message = f"where: {short(condition)} is no condition, as metric > limit is"
        raise InputError(message)
    return condition


def _reporter(progress: Any, total: int) -> Callable[[int], object]:
    """Return what is called with the number of designs done."""
    if progress is False or progress is None:
        return lambda _: None
    if callable(progress):
        return lambda done: progress(done, total)
    if progress is not True:
        message = f"progress is {short(progress)}: True, False or a function is needed"
        raise InputError(message)
    try:
        from tqdm.auto import tqdm
    except ImportError as error:
        message = "progress=True needs tqdm: pip install assur[progress], or pass a function"
        raise ImportError(message) from error
    bar = tqdm(total=total, unit="design", unit_scale=True)

    def show(done: int) -> None:
        bar.update(done - bar.n)
        if done == total:
            bar.close()

    return show
