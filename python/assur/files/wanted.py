"""Results that a file asks for: the arguments of methods of the same names."""

from __future__ import annotations

import math
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from assur._validate import checked_order
from assur.errors import InputError
from assur.files.limits import MOST_POSITIONS
from assur.files.node import Node

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from assur._arrays import Float
    from assur.kinematics.mechanism import Mechanism

# A last step of a range that misses its end by so much of a step is not left out.
ROUNDING = 1e-9


@dataclass(frozen=True)
class Range:
    """Evenly spaced coordinates; an argument wherever an array is one.

    Parameters
    ----------
    start, stop : float or tuple of float
        The ends, both included; with several drivers one number for each.
    step : float, optional
        The distance of two coordinates (one driver). Give either this or:
    count : int, optional
        How many they are.
    endpoint : bool
        With `count`: whether `stop` is one of them.

    Examples
    --------
    >>> import assur
    >>> assur.files.Range(0.0, 90.0, step=30.0).values()
    array([ 0., 30., 60., 90.])
    >>> assur.files.Range(0.0, 360.0, count=4, endpoint=False).values()
    array([  0.,  90., 180., 270.])
    """

    start: float | tuple[float, ...]
    stop: float | tuple[float, ...]
    step: float | None = None
    count: int | None = None
    endpoint: bool = True

    def __post_init__(self) -> None:
        if (self.step is None) == (self.count is None):
            message = "a range needs either step or count"
            raise InputError(message)
        if np.shape(self.start) != np.shape(self.stop):
            message = "a range needs as many numbers for start as for stop"
            raise InputError(message)
        if self.step is not None and (np.shape(self.start) or not self.endpoint):
            message = "a range with several drivers, or without its end, needs count, not step"
            raise InputError(message)
        if not 1 <= self._size() <= MOST_POSITIONS:
            message = (
                f"a range must have from 1 to {MOST_POSITIONS} positions: its step must lead from "
                "start to stop"
            )
            raise InputError(message)

    def _size(self) -> float:
        if self.count is not None:
            return self.count
        assert self.step is not None
        length = float(self.stop) - float(self.start)  # type: ignore[arg-type]
        steps = length / self.step if self.step else math.inf
        return math.floor(steps + ROUNDING) + 1 if 0.0 <= steps < MOST_POSITIONS else math.inf

    def values(self) -> Float:
        """Return the coordinates: (N,), or (N, n) of n drivers."""
        if self.count is not None:
            return np.linspace(self.start, self.stop, self.count, endpoint=self.endpoint)
        steps: Any = np.arange(self._size())
        return np.asarray(self.start + steps * self.step)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Float:
        return np.asarray(self.values(), dtype)


class Result(NamedTuple):
    """A result that is asked for: the method's arguments, and where the file has them."""

    arguments: Mapping[str, Any]
    node: Node


def _positions(node: Node) -> Any:
    """Return coordinates: a number, a list, or a range."""
    if not isinstance(node.value, dict):
        return node.array()
    entries = node.keys(RANGE, required=("start", "stop"))
    given: dict[str, Any] = {name: RANGE[name](one) for name, one in entries.items()}
    with node.refusing():
        return Range(**given)


def _end(node: Node) -> float | tuple[float, ...]:
    if not isinstance(node.value, list):
        return node.number()
    return tuple(one.number() for one in node.entries())


def _order(node: Node) -> int:
    with node.refusing():
        return checked_order(node.whole())


def _one_of(*words: str) -> Callable[[Node], str]:
    return lambda node: node.word(words)


def _tolerances(node: Node) -> Any:
    return node.pair() if isinstance(node.value, list) else node.number()


number, whole = Node.number, Node.whole
ERRORS, MEANS = _one_of("raise", "nan"), _one_of("extremes", "period")
METHODS = _one_of("DOP853", "RK45")
RANGE: dict[str, Callable[[Node], Any]] = {
    "start": _end,
    "stop": _end,
    "step": number,
    "count": whole,
    "endpoint": Node.flag,
}
WANTED: dict[str, dict[str, Callable[[Node], Any]]] = {
    "solve": {
        "q": _positions,
        "deg": _positions,
        "order": _order,
        "outputs": Node.names,
        "on_error": ERRORS,
    },
    "reactions": {
        "q": _positions,
        "deg": _positions,
        "speed": Node.array,
        "acceleration": Node.array,
        "t": Node.array,
        "sense": Node.array,
        "on_error": ERRORS,
    },
    "run": {
        "t_end": number,
        "q_end": number,
        "q0": Node.array,
        "speed0": Node.array,
        "t0": number,
        "rtol": number,
        "atol": _tolerances,
        "method": METHODS,
        "breaks": Node.array,
        "max_step": number,
        "max_steps": whole,
        "max_seconds": number,
    },
    "steady_state": {
        "speed": number,
        "turns": whole,
        "q0": number,
        "mean": MEANS,
        "flywheel": number,
        "rtol": number,
        "method": METHODS,
        "breaks": Node.array,
        "max_steps": whole,
        "max_seconds": number,
    },
    "flywheel": {"fluctuation": number, "mean_speed": number, "mean": MEANS, "on_error": ERRORS},
}
NEEDED = {"flywheel": ("fluctuation",)}
# Which of two is given: exactly one.
EITHER = {"solve": ("q", "deg"), "reactions": ("q", "deg"), "run": ("t_end", "q_end")}


def read_wanted(root: Node, mechanism: Mechanism, has_machine: bool) -> Mapping[str, Result]:
    """Return the results that a file asks for, by the name of the method."""
    found: dict[str, Result] = {}
    for name, node in root.table().items():
        if name not in WANTED:
            continue
        if name != "solve" and not has_machine:
            raise node.error("needs a machine: give [bodies], [[loads]] or a [motor]")
        entries = node.keys(WANTED[name], required=NEEDED.get(name, ()))
        either = EITHER.get(name, ())
        if either and sum(key in entries for key in either) != 1:
            raise node.error(f"needs either {' or '.join(either)}")
        if "outputs" in entries:
            _check_outputs(entries["outputs"], mechanism)
        given = {key: WANTED[name][key](one) for key, one in entries.items()}
        found[name] = Result(MappingProxyType(given), node)
    return MappingProxyType(found)


def _check_outputs(node: Node, mechanism: Mechanism) -> None:
    known = (*mechanism._joint_names, *mechanism.links, *mechanism.slides)
    for one in node.entries("a list of names"):
        one.word(known)
