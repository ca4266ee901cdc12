"""The parts of a machine as files name them: the words are those of the Python classes."""

from __future__ import annotations

import inspect
from typing import TYPE_CHECKING, Any, TypeAlias

from assur.dynamics.loads.friction import JointFriction, SlideFriction
from assur.dynamics.loads.loads import (
    Body,
    Damper,
    Force,
    Gravity,
    Spring,
    Torque,
    TorsionDamper,
    TorsionSpring,
)
from assur.dynamics.loads.motors import ConstantTorque, InductionMotor, LinearMotor
from assur.dynamics.loads.pressure import Gas, Pressure
from assur.dynamics.loads.table import Table
from assur.files.node import Node

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

# How the value of each key of a class is read; in the order of the class.
Words: TypeAlias = "dict[str, Callable[[Node], Any]]"


def build(cls: type, words: Words, node: Node, besides: Iterable[str] = ()) -> Any:
    """Return an object of a class from a table with its words."""
    parameters = inspect.signature(cls).parameters
    required = [name for name in words if parameters[name].default is inspect.Parameter.empty]
    entries = node.keys((*besides, *words), required=required)
    arguments = {name: read(entries[name]) for name, read in words.items() if name in entries}
    with node.refusing():
        return cls(**arguments)


def pair_of_values(node: Node) -> tuple[Any, Any]:
    """Return two values of a load."""
    nodes = node.entries("a list of two values, [fx, fy],")
    if len(nodes) != 2:
        raise node.error(f"has {len(nodes)} entries: two values, [fx, fy], are needed")
    return value(nodes[0]), value(nodes[1])


def value(node: Node) -> Any:
    """Return a number or a table over q or another coordinate."""
    if isinstance(node.value, dict):
        return build(Table, ROWS, node)
    if isinstance(node.value, bool) or not isinstance(node.value, int | float):
        raise node.wrong("a number, or a table { q = […], value = […] },")
    return node.number()


def pressure(node: Node) -> Any:
    """Return a closed gas, a number or a table."""
    if isinstance(node.value, dict) and "volume" in node.value:
        return build(Gas, GAS, node)
    return value(node)


def place(node: Node) -> str | tuple[float, float]:
    """Return a joint or a point (x, y)."""
    if isinstance(node.value, str):
        return node.text()
    return node.pair() if isinstance(node.value, list) else _no_place(node, "[x, y]")


def point(node: Node) -> str | tuple[str, tuple[float, float]]:
    """Return a joint or a point in the frame of a link."""
    if isinstance(node.value, str):
        return node.text()
    if not isinstance(node.value, list) or len(node.value) != 2:
        _no_place(node, '["link", [x, y]]')
    link, at = node.entries()
    return link.text(), at.pair()


def _no_place(node: Node, other: str) -> Any:
    raise node.wrong(f"the name of a joint, or {other},")


number, text, flag = Node.number, Node.text, Node.flag

ROWS: Words = {
    "q": Node.array,
    "value": Node.array,
    "spline": text,
    "periodic": flag,
    "over": text,
}
GAS: Words = dict.fromkeys(("pressure", "volume", "at", "exponent"), number)
WAY: Words = {"while_": text, "over": text}
SHAFT: Words = {"ratio": number, "rotor_inertia": number}
BODY: Words = {"mass": number, "inertia": number, "at": place, "drawn": Node.pair}
LOADS: dict[type, Words] = {
    Gravity: {"acceleration": Node.pair},
    Force: {"at": point, "force": pair_of_values, "axes": text, "on": text, **WAY},
    Torque: {"link": text, "torque": value, "on": text, **WAY},
    Pressure: {
        "slide": text,
        "area": number,
        "pressure": pressure,
        "expands": text,
        "ambient": number,
        **WAY,
    },
    Spring: {
        "first": point,
        "second": point,
        **dict.fromkeys(("stiffness", "length", "preload"), number),
    },
    TorsionSpring: {
        "link": text,
        "stiffness": number,
        "angle": number,
        "on": text,
        "preload": number,
    },
    Damper: {"first": point, "second": point, "damping": number},
    TorsionDamper: {"link": text, "damping": number, "on": text},
}
MOTORS: dict[type, Words] = {
    ConstantTorque: {"torque": value, **SHAFT},
    LinearMotor: {"stall": number, "no_load": number, **SHAFT},
    InductionMotor: {"breakdown": number, "slip": number, "synchronous": number, **SHAFT},
    Table: {**{name: read for name, read in ROWS.items() if name != "over"}, **SHAFT},
}
FRICTIONS: dict[type, Words] = {
    cls: dict.fromkeys(("coefficient", size, "viscous", "static_coefficient"), number)
    for cls, size in ((JointFriction, "radius"), (SlideFriction, "length"))
}
PARTS: dict[type, Words] = {Body: BODY, Gas: GAS, **LOADS, **MOTORS, **FRICTIONS}
