"""Gradients of metrics by dimensions: of each design, at the positions that decide.

An extreme moves with the dimensions as its coordinate does at the position where it is (the
envelope theorem, J. M. Danskin 1966): no other position counts, nor where the extreme is. Metrics
are of the positions of q alone, and so are their gradients. Where another position takes over the
extreme, as at a tie, there is a bend: the gradient is that of the first of the two.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from assur.errors import InputError
from assur.kinematics import transmission
from assur.kinematics.derivatives.jacobian import named_dimensions
from assur.kinematics.request import SolveRequest
from assur.kinematics.solve import solve
from assur.sweeps.target_metrics import TARGETS
from assur.sweeps.terms import Combination, Leaf, Metric

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from assur._arrays import Float
    from assur.kinematics.mechanism import Mechanism
    from assur.kinematics.motion import Motion
    from assur.kinematics.request import Kind, ResultKey
    from assur.sweeps.terms import Single

# Kinds that change smoothly with the dimensions. Others are places among the positions, flags,
# fits, or functions in Python.
# For every extreme the positions that decide it, each with its sign.
EXTREMES = {
    "min": (("min", 1.0),),
    "max": (("max", 1.0),),
    "span": (("max", 1.0), ("min", -1.0)),
    "min_transmission_angle": (("min_transmission_angle", 1.0),),
}
MEANS = ("mean", "rms")


class _Coordinate(NamedTuple):
    """A coordinate of a motion: its output, and which of a joint's two numbers."""

    name: str
    kind: Kind
    component: int | None


class Gradients:
    """Gradients of metrics by dimensions; it can be sent to other processes."""

    def __init__(
        self,
        mechanism: Mechanism,
        metrics: Mapping[str, Metric],
        q: Float,
        by: Any,
        threads: int | None,
    ) -> None:
        known = mechanism.core.dimension_names
        self._by = named_dimensions(mechanism, by)
        self.names = tuple(known[index] for index in self._by)
        self._metrics, self._q, self._threads = metrics, q, threads
        for name, metric in metrics.items():
            for leaf in metric.leaves():
                if not (isinstance(leaf, Leaf) and leaf.kind in (*EXTREMES, *MEANS, *TARGETS)):
                    message = (
                        f"gradient: metrics[{name!r}] holds {leaf!r}, which has none: there are "
                        "those of min, max, span, mean, rms, min_transmission_angle, path_error, "
                        "function_error and pose_error"
                    )
                    raise InputError(message)
        if any(mechanism.core.redundant):
            names = ", ".join(repr(one) for of in mechanism.core.redundant for one in of)
            message = (
                f"gradient: {names} is redundant: changing one dimension alone would break its fit"
            )
            raise InputError(message)

    @property
    def indices(self) -> list[Leaf]:
        """What else to measure: the positions that decide extremes."""
        return [index for leaf in self._leaves for index in _indices(leaf)]

    @property
    def summed(self) -> list[Leaf]:
        """What the core derives with its value, from the same positions: sums over all of q."""
        kinds = (*MEANS, *TARGETS)
        return [leaf for leaf in self._leaves if leaf.kind in kinds and leaf.over is None]

    @property
    def by(self) -> list[int]:
        """Indices of the dimensions."""
        return self._by

    @property
    def _leaves(self) -> list[Leaf]:
        leaves = dict.fromkeys(
            leaf for metric in self._metrics.values() for leaf in metric.leaves()
        )
        return [leaf for leaf in leaves if isinstance(leaf, Leaf)]

    def of(
        self, some: Mechanism, values: Callable[[Single], Float], known: Mapping[Leaf, Float]
    ) -> dict[str, Float]:
        """Return the gradients (n, D) of designs (n,) that have all metrics with these values.

        Those of some leaves are known.
        """
        each = {leaf: np.empty((some.shape[0], len(self.names))) for leaf in self._leaves}
        each.update(known)
        for leaf in self._leaves:
            if leaf in known:
                continue
            places = self._places(some, leaf)
            # NaN where a design has no metric: that has none of its positions either.
            at = [np.nan_to_num(values(index)).astype(np.intp) for index in _indices(leaf)]
            if at:
                each[leaf][:] = self._of_extreme(some, leaf, places[np.stack(at, axis=-1)])
                continue
            each[leaf][:] = self._of_mean(some, leaf, places, values(leaf))
        return {name: _chained(metric, values, each)[1] for name, metric in self._metrics.items()}

    def _of_mean(self, some: Mechanism, leaf: Leaf, places: Any, means: Float) -> Float:
        assert leaf.of is not None
        coordinate = _coordinate(some, leaf.of)
        # The same at all positions; without any no design has a mean.
        weights = np.array(1.0 / max(1, len(places)))
        of_all = {coordinate.name: _spread(weights, coordinate)}
        is_root = leaf.kind == "rms"
        found = self._pulled(some, self._q[places], of_all, leaf.order, of_squares=is_root)
        if not is_root:
            return found
        # A root has no derivative at 0: 0 / 0 is NaN.
        with np.errstate(invalid="ignore"):
            return found / means[:, np.newaxis]

    def _of_extreme(self, some: Mechanism, leaf: Leaf, places: Any) -> Float:
        assert leaf.of is not None
        if leaf.kind == "min_transmission_angle":
            return self._of_transmission(some, leaf, places)
        coordinate = _coordinate(some, leaf.of)
        signs = np.broadcast_to([sign for _, sign in EXTREMES[leaf.kind]], places.shape)
        of_ends = {coordinate.name: _spread(signs, coordinate)}
        return self._pulled(some, self._q[places], of_ends, leaf.order)

    def _of_transmission(self, some: Mechanism, leaf: Leaf, places: Any) -> Float:
        assert leaf.of is not None
        between: Any = leaf.options[0] if leaf.options else None
        pair, complement = transmission.lines(some, leaf.of, between)
        read = {
            name
            for line in pair
            for name in (
                [line.start, line.end] if isinstance(line, transmission.JointLine) else [line.link]
            )
        }
        motion = self._solved(some, self._q[places], 0, sorted(read))
        directions = [
            np.broadcast_to(transmission.direction(motion, line), (*places.shape, 2))
            for line in pair
        ]
        weights = transmission.derivatives_by_places(pair, directions, complement)
        found = self._pulled(some, self._q[places], weights, 0)
        guides = transmission.of_guides(some, (pair, directions, complement), self._by)
        return found + guides[:, 0]

    def _pulled(
        self,
        batch: Mechanism,
        q: Float,
        weights: Mapping[str, Float],
        order: int,
        of_squares: bool = False,
    ) -> Float:
        """Return the derivatives of weighted sums over positions, (n, D).

        The positions are (N,) of all designs, or (n, N) of each; the weights are of every
        position, or the same for all. Of squares: half their derivatives.
        """
        shape = q.shape if batch.driver_count == 1 else q.shape[:-1]
        request = SolveRequest(
            batch,
            np.ascontiguousarray(q),
            shape[-1:],
            len(shape) > 1,
            order,
            batch.signs,
            True,
            self._threads,
        )
        keys: list[ResultKey] = []
        flat: list[Float] = []
        for name, weight in weights.items():
            kind: Kind = "joint" if name in batch.joint_names else _coordinate(batch, name).kind
            keys.append((kind, batch.core.index_of(kind, name), order))
            flat.append(np.ascontiguousarray(weight).reshape(-1))
        arrays, _ = request.sensitivities(
            keys, self._by, weights=flat, total=True, of_squares=of_squares
        )
        return arrays[0].reshape(batch.shape[0], len(self._by))

    def _places(self, batch: Mechanism, leaf: Leaf) -> Any:
        if leaf.over is None:
            return np.arange(len(self._q))
        return np.array(batch.core.places_within(self._q, leaf.over), dtype=np.intp)

    def _solved(self, batch: Mechanism, q: Float, order: int, outputs: list[str]) -> Motion:
        return solve(batch, q, order, outputs, None, "nan", self._threads, None)


def _spread(numbers: Float, coordinate: _Coordinate) -> Float:
    """Return numbers of a coordinate as those of its output: of a joint x or y."""
    if coordinate.component is None:
        return numbers
    spread = np.zeros((*numbers.shape, 2))
    spread[..., coordinate.component] = numbers
    return spread


def _indices(leaf: Leaf) -> list[Leaf]:
    """Return the metrics that tell which positions decide an extreme."""
    return [replace(leaf, kind=f"index of {end}") for end, _ in EXTREMES.get(leaf.kind, ())]


def _coordinate(mechanism: Mechanism, name: str) -> _Coordinate:
    joint, _, axis = name.rpartition(".")
    if axis in ("x", "y") and joint in mechanism.joint_names:
        return _Coordinate(joint, "joint", "xy".index(axis))
    return _Coordinate(name, "slide" if name in mechanism.slides else "link", None)


def _chained(
    metric: Metric | float, values: Callable[[Single], Float], each: Mapping[Any, Float]
) -> tuple[Float | float, Any]:
    """Return values and gradients of a combination, by the rules of differentiation."""
    if isinstance(metric, Leaf):
        return values(metric), each[metric]
    if not isinstance(metric, Combination):
        assert isinstance(metric, float)
        return metric, 0.0
    (left, d_left), (right, d_right) = (
        _chained(side, values, each) for side in (metric.left, metric.right)
    )
    a, b = (np.asarray(side)[..., np.newaxis] for side in (left, right))
    with np.errstate(divide="ignore", invalid="ignore"):
        if metric.sign == "+":
            return left + right, d_left + d_right
        if metric.sign == "-":
            return left - right, d_left - d_right
        if metric.sign == "*":
            return left * right, d_left * b + d_right * a
        return left / right, (d_left - d_right * a / b) / b
