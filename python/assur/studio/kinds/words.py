"""Input laws and metrics as JSON: the names and arguments of the Python classes and functions."""

from __future__ import annotations

import inspect
from typing import TYPE_CHECKING, Any

from assur import laws, metric

if TYPE_CHECKING:
    from collections.abc import Callable

    from assur.files.node import Node
    from assur.laws import Law
    from assur.sweeps.terms import Metric

LAWS: dict[str, type[Law]] = {
    name: getattr(laws, name)
    for name in laws.__all__
    if name not in ("Law", "Sequence") and inspect.isclass(getattr(laws, name))
}
# Metrics without masses and with them; each takes its function's arguments.
METRICS: dict[str, Callable[..., Metric]] = {
    name: getattr(metric, name) for name in metric.__all__ if name.islower() and name != "function"
}


def law(node: Node) -> Law:
    """Return an input law; a list makes a sequence."""
    if isinstance(node.value, list):
        every = tuple(law(entry) for entry in node.entries())
        with node.refusing():
            return laws.Sequence(every)
    entries = node.table()
    cls = LAWS[_named(node, "law", LAWS)]
    known = list(inspect.signature(cls).parameters)
    arguments = {key: entry for key, entry in node.keys(("law", *known)).items() if key != "law"}
    _require(node, cls, entries)
    with node.refusing():
        return cls(**{key: _number_or_word(entry) for key, entry in arguments.items()})


def metric_of(node: Node) -> Metric:
    """Return a metric."""
    make = METRICS[_named(node, "metric", METRICS)]
    known = list(inspect.signature(make).parameters)
    entries = node.keys(("metric", *known))
    _require(node, make, entries)
    arguments = {key: entry for key, entry in entries.items() if key != "metric"}
    with node.refusing():
        return make(**{key: _argument(entry) for key, entry in arguments.items()})


def _named(node: Node, key: str, known: Any) -> str:
    entries = node.table()
    if key not in entries:
        raise node.missing(key, f": one of {', '.join(known)} is needed")
    return entries[key].word(known)


def _require(node: Node, call: Callable[..., Any], entries: dict[str, Node]) -> None:
    for name, parameter in inspect.signature(call).parameters.items():
        if parameter.default is inspect.Parameter.empty and name not in entries:
            raise node.missing(name)


def _number_or_word(node: Node) -> Any:
    return node.text() if isinstance(node.value, str) else node.array()


def _argument(node: Node) -> Any:
    """Return a number, a word, a switch or a list of two."""
    if not isinstance(node.value, list):
        if not isinstance(node.value, bool | int | float | str):
            raise node.wrong("a number or a word")
        return node.value
    if len(node.value) != 2:
        message = f"has {len(node.value)} entries: two are needed"
        raise node.error(message)
    return tuple(_argument(entry) for entry in node.entries())
