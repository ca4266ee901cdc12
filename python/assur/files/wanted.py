"""Results that a file asks for: the arguments of methods of the same names."""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

from assur._validate import checked_order
from assur.files.node import Node
from assur.files.ranges import Range

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from assur.kinematics.mechanism import Mechanism


class Result(NamedTuple):
    """A result that is asked for: the method's arguments, and where the file has them."""

    arguments: Mapping[str, Any]
    node: Node


def _positions(node: Node) -> Any:
    """Return coordinates: a number, a list, or a range."""
    if not isinstance(node.value, dict):
        return node.array()
    entries = node.keys(RANGE, required=("start", "stop"))
    arguments: dict[str, Any] = {name: RANGE[name](entry) for name, entry in entries.items()}
    with node.refusing():
        return Range(**arguments)


def _end(node: Node) -> float | tuple[float, ...]:
    if not isinstance(node.value, list):
        return node.number()
    return tuple(entry.number() for entry in node.entries())


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
    "flywheel": {
        "fluctuation": number,
        "mean_speed": number,
        "mean": MEANS,
        "on_error": ERRORS,
        "turns": whole,
    },
}
NEEDED = {"flywheel": ("fluctuation",)}
# Pairs of keys, exactly one of which is given.
EITHER = {"solve": ("q", "deg"), "reactions": ("q", "deg"), "run": ("t_end", "q_end")}


def read_wanted(root: Node, mechanism: Mechanism, has_machine: bool) -> Mapping[str, Result]:
    """Return the results that a file asks for, by the name of the method."""
    results: dict[str, Result] = {}
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
        arguments = {key: WANTED[name][key](entry) for key, entry in entries.items()}
        results[name] = Result(MappingProxyType(arguments), node)
    return MappingProxyType(results)


def _check_outputs(node: Node, mechanism: Mechanism) -> None:
    known = (*mechanism.joint_names, *mechanism.links, *mechanism.slides)
    for entry in node.entries("a list of names"):
        entry.word(known)
